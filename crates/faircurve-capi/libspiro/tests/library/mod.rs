//! Libraries with libspiro's interface, loaded by the name of their file: ours as installed, and the
//! system's where there is one.
#![allow(dead_code, unreachable_pub, reason = "not every test needs all of it")]
#![allow(unsafe_code, reason = "this is the boundary to C, from the other side")]

use std::ffi::{c_char, c_int};
use std::path::{Path, PathBuf};
use std::process::Command;

use faircurve::kurbo::Point;
use faircurve::{Contour, Join, Knot};

/// `spiro_cp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cp {
    pub x: f64,
    pub y: f64,
    pub ty: c_char,
}

impl Cp {
    pub fn new(x: f64, y: f64, letter: char) -> Cp {
        Cp { x, y, ty: letter as c_char }
    }

    pub fn letter(&self) -> char {
        char::from(self.ty as u8)
    }
}

/// `0,0,o 100,50,c`: points with their letters.
pub fn list(text: &str) -> Vec<Cp> {
    let point = |word: &str| {
        let parts: Vec<&str> = word.splitn(3, ',').collect();
        let number = |i: usize| parts[i].parse().unwrap();
        Cp::new(number(0), number(1), parts[2].chars().next().unwrap())
    };
    text.split_whitespace().map(point).collect()
}

/// What the receiver's functions were called with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Call {
    Move(Point, bool),
    Line(Point),
    Quad(Point, Point),
    Cubic(Point, Point, Point),
    Knot(c_int),
}

impl Call {
    /// Where the pen is afterwards.
    pub fn end(self) -> Option<Point> {
        match self {
            Call::Move(end, _) | Call::Line(end) | Call::Quad(_, end) | Call::Cubic(_, _, end) => {
                Some(end)
            }
            Call::Knot(_) => None,
        }
    }

    /// Every point of the call.
    pub fn points(self) -> Vec<Point> {
        match self {
            Call::Move(end, _) | Call::Line(end) => vec![end],
            Call::Quad(p1, end) => vec![p1, end],
            Call::Cubic(p1, p2, end) => vec![p1, p2, end],
            Call::Knot(_) => vec![],
        }
    }

    /// Whether it draws.
    pub fn is_piece(self) -> bool {
        matches!(self, Call::Line(_) | Call::Quad(..) | Call::Cubic(..))
    }

    pub fn is_curve(self) -> bool {
        matches!(self, Call::Quad(..) | Call::Cubic(..))
    }
}

/// A receiver that keeps the calls.
#[repr(C)]
struct Receiver {
    moveto: extern "C" fn(&mut Receiver, f64, f64, c_int),
    lineto: extern "C" fn(&mut Receiver, f64, f64),
    quadto: extern "C" fn(&mut Receiver, f64, f64, f64, f64),
    curveto: extern "C" fn(&mut Receiver, f64, f64, f64, f64, f64, f64),
    mark_knot: extern "C" fn(&mut Receiver, c_int),
    calls: Vec<Call>,
}

type Tagged = unsafe extern "C" fn(*mut Cp, c_int, *mut Receiver) -> c_int;
type Counted = unsafe extern "C" fn(*mut Cp, c_int, c_int, c_int, *mut Receiver) -> c_int;

/// A loaded library.
#[derive(Debug)]
pub struct Library {
    tagged: Tagged,
    counted: Counted,
    _library: libloading::Library,
}

impl Library {
    pub fn open(file: &Path) -> Library {
        // SAFETY: the library runs nothing when it is loaded, and its functions have these types.
        unsafe {
            let library = libloading::Library::new(file).unwrap();
            let tagged = *library.get::<Tagged>(b"TaggedSpiroCPsToBezier2").unwrap();
            let counted = *library.get::<Counted>(b"SpiroCPsToBezier2").unwrap();
            Library { tagged, counted, _library: library }
        }
    }

    /// What is drawn of a list with an end mark, which may come back turned round; `None` for the answer 0, after
    /// which nothing may have been drawn.
    pub fn draw_tagged(&self, list: &mut [Cp], ncq: c_int) -> Option<Vec<Call>> {
        assert!(list.iter().any(|cp| "z}".contains(cp.letter())), "a list without its end mark");
        let mut receiver = Receiver::new();
        // SAFETY: the list is marked, and the receiver is what its functions expect.
        let answer = unsafe { (self.tagged)(list.as_mut_ptr(), ncq, &raw mut receiver) };
        receiver.answer(answer)
    }

    pub fn draw(&self, list: &[Cp], ncq: c_int) -> Option<Vec<Call>> {
        self.draw_tagged(&mut list.to_vec(), ncq)
    }

    /// The same for a list that the caller counts.
    pub fn draw_counted(&self, list: &[Cp], closed: bool, ncq: c_int) -> Option<Vec<Call>> {
        let mut list = list.to_vec();
        let mut receiver = Receiver::new();
        let (count, closed) = (list.len() as c_int, c_int::from(closed));
        // SAFETY: so many points are there, and the receiver is what its functions expect.
        let answer =
            unsafe { (self.counted)(list.as_mut_ptr(), count, ncq, closed, &raw mut receiver) };
        receiver.answer(answer)
    }
}

impl Receiver {
    fn new() -> Receiver {
        extern "C" fn moveto(to: &mut Receiver, x: f64, y: f64, open: c_int) {
            to.calls.push(Call::Move(Point::new(x, y), open != 0));
        }
        extern "C" fn lineto(to: &mut Receiver, x: f64, y: f64) {
            to.calls.push(Call::Line(Point::new(x, y)));
        }
        extern "C" fn quadto(to: &mut Receiver, a: f64, b: f64, x: f64, y: f64) {
            to.calls.push(Call::Quad(Point::new(a, b), Point::new(x, y)));
        }
        extern "C" fn curveto(to: &mut Receiver, a: f64, b: f64, c: f64, d: f64, x: f64, y: f64) {
            let points = (Point::new(a, b), Point::new(c, d), Point::new(x, y));
            to.calls.push(Call::Cubic(points.0, points.1, points.2));
        }
        extern "C" fn mark_knot(to: &mut Receiver, knot: c_int) {
            to.calls.push(Call::Knot(knot));
        }
        Receiver { moveto, lineto, quadto, curveto, mark_knot, calls: Vec::new() }
    }

    fn answer(self, answer: c_int) -> Option<Vec<Call>> {
        match answer {
            1 => Some(self.calls),
            0 => {
                assert!(self.calls.is_empty(), "0, yet drawn: {:?}", self.calls);
                None
            }
            other => panic!("an answer of {other}"),
        }
    }
}

/// The system's libspiro, where it is installed; says so where it isn't.
#[expect(clippy::print_stdout, reason = "tests say why they are skipped")]
pub fn system_library() -> Option<PathBuf> {
    let asked = Command::new("pkg-config").args(["--variable=libdir", "libspiro"]).output().ok();
    let folder = asked.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    let file = folder.map(|folder| Path::new(&folder).join("libspiro.so.1"));
    let file = file.filter(|file| file.exists());
    if file.is_none() {
        println!("skipped: the system has no libspiro");
    }
    file
}

/// The contour that a list with an end mark says, read anew: an independent reading of letters.
pub fn contour_of(list: &[Cp]) -> Contour {
    let open = list[0].letter() == '{';
    let ends = if open { list.len() } else { list.len() - 1 };
    let knots = list[..ends].iter().map(|cp| {
        let knot = Knot::new((cp.x, cp.y));
        match cp.letter() {
            '{' | '}' => knot,
            'o' => knot.join(Join::G4),
            'c' => knot.join(Join::G2),
            '[' => knot.join(Join::CurveToTerminal),
            ']' => knot.join(Join::TerminalToCurve),
            _ => knot.join(Join::Corner),
        }
    });
    Contour { knots: knots.collect(), closed: !open }
}

/// A Spiro contour of a font.
#[derive(Clone, Debug)]
pub struct Stored {
    pub glyph: String,
    /// Its points, with an end mark.
    pub list: Vec<Cp>,
    /// Whether any point is one of a curve, be it the last of an open contour.
    pub is_curved: bool,
}

impl Stored {
    pub fn is_open(&self) -> bool {
        self.list[0].letter() == '{'
    }
}

/// The Spiro contours of an SFD file; those of one point left out.
pub fn stored(file: &Path) -> Vec<Stored> {
    let bytes = std::fs::read(file).unwrap();
    let text: String = bytes.iter().map(|&byte| char::from(byte)).collect();
    let (mut contours, mut glyph, mut points) = (Vec::new(), String::new(), None);
    for line in text.lines().map(str::trim) {
        if let Some(name) = line.strip_prefix("StartChar: ") {
            glyph = name.to_owned();
        } else if line == "Spiro" {
            points = Some(Vec::new());
        } else if line == "EndSpiro" {
            let mut list: Vec<Cp> = points.take().unwrap_or_default();
            // As FontForge hands them over.
            if list.len() < 3 {
                continue;
            }
            let is_curved = list.iter().any(|cp| "oc".contains(cp.letter()));
            if list[0].letter() == '{' {
                list.pop();
                list.last_mut().unwrap().ty = '}' as c_char;
            }
            contours.push(Stored { glyph: glyph.clone(), list, is_curved });
        } else if let Some(list) = &mut points {
            let words: Vec<&str> = line.split_whitespace().collect();
            let letter = char::from(words[2].chars().next().unwrap() as u8 & 0x7f);
            list.push(Cp::new(words[0].parse().unwrap(), words[1].parse().unwrap(), letter));
        }
    }
    contours
}

/// The fonts beside the repository, where they are; else a file of our own, after saying so.
#[expect(clippy::print_stdout, reason = "tests say what they leave out")]
pub fn fonts() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let folder = root.join("../shared/data");
    let names = ["Cantarell-Regular-Spiro.sfd", "Chomsky.sfd", "KJV1611.sfd"];
    let files: Vec<PathBuf> = names.iter().map(|name| folder.join(name)).collect();
    if files.iter().all(|file| file.exists()) {
        return files;
    }
    println!("skipped: the fonts don't lie next to the repository; examples/comma.sfd instead");
    vec![root.join("examples/comma.sfd")]
}
