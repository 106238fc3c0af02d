//! The structs and numbers of libspiro's interface, as its headers lay them out.

use std::ffi::{c_char, c_double, c_int};

/// `spiro_cp`: a point and its letter.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpiroCp {
    /// Where the point is.
    pub x: c_double,
    /// Where the point is.
    pub y: c_double,
    /// The letter that says how the curve passes here.
    pub ty: c_char,
}

impl SpiroCp {
    /// The letter, as ASCII.
    pub(crate) fn letter(&self) -> u8 {
        self.ty as u8
    }

    /// The same point with another letter.
    pub(crate) fn with_letter(self, letter: u8) -> Self {
        SpiroCp { ty: letter as c_char, ..self }
    }
}

/// `spiro_seg`: a solved segment.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct SpiroSeg {
    /// Where it starts, less the centre and over the scale of `run_spiro0`'s `dm`.
    pub x: c_double,
    /// Where it starts, likewise.
    pub y: c_double,
    /// The letter of its first point.
    pub ty: c_char,
    /// By how much the chord turns at its first point, in radians; 0 at corners and ends.
    pub bend_th: c_double,
    /// k₀ … k₃ of thesis eq. 8.1, for arc length 1.
    pub ks: [c_double; 4],
    /// The length of its chord.
    pub seg_ch: c_double,
    /// The direction of its chord, in radians.
    pub seg_th: c_double,
    /// Its arc length.
    pub l: c_double,
}

/// `bezctx`: what receives the Béziers. Callers put fields of their own after these.
#[repr(C)]
#[derive(Debug)]
pub struct BezCtx {
    /// Starts a contour.
    pub moveto: Option<unsafe extern "C" fn(*mut BezCtx, c_double, c_double, c_int)>,
    /// A straight line.
    pub lineto: Option<unsafe extern "C" fn(*mut BezCtx, c_double, c_double)>,
    /// A quadratic Bézier, or an arc through a point.
    pub quadto: Option<unsafe extern "C" fn(*mut BezCtx, c_double, c_double, c_double, c_double)>,
    /// A cubic Bézier.
    pub curveto: Option<
        unsafe extern "C" fn(
            *mut BezCtx,
            c_double,
            c_double,
            c_double,
            c_double,
            c_double,
            c_double,
        ),
    >,
    /// The knot of that number is here.
    pub mark_knot: Option<unsafe extern "C" fn(*mut BezCtx, c_int)>,
}

/// `curve_data`: one call that would have been made, kept.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct CurveData {
    /// `m`, `l`, `q`, `c` or `k`, as the calls of [`BezCtx`].
    pub ty: c_char,
    /// x and y of up to four points: where the pen was, and those of the call.
    pub points: [[c_double; 2]; 4],
}

/// `ls_bezctx`: an array of such calls.
#[repr(C)]
#[derive(Debug)]
pub struct LsBezCtx {
    /// All NULL.
    pub base: BezCtx,
    /// The array.
    pub cd: *mut CurveData,
    /// How many are in it; −1 once one didn't fit.
    pub l: c_int,
    /// How many fit.
    pub max: c_int,
    /// Whether the last contour is open.
    pub is_open: c_int,
}

/// Calls `mark_knot` at the end of an open contour, too.
pub(crate) const INCLUDE_LAST_KNOT: c_int = 0x0100;
/// The context is a [`LsBezCtx`].
pub(crate) const INTERNAL_BEZCTX: c_int = 0x0200;
/// Segments are left in the caller's units.
pub(crate) const RETRO_VER1: c_int = 0x0400;
/// The caller's points are reversed first, in place.
pub(crate) const REVERSE_SRC: c_int = 0x0800;
/// The bits that say what kind of pieces is asked for.
pub(crate) const OUTPUT_MASK: c_int = 0x7000;

#[cfg(test)]
mod tests {
    use super::*;
    use std::mem::offset_of;
    use std::process::Command;

    /// A C program that only compiles if the headers' structs and numbers are these.
    fn assertions(headers: &str) -> String {
        let mut lines = vec![format!("#include \"{headers}/spiroentrypoints.h\"")];
        let mut same = |c: &str, here: usize| {
            lines.push(format!("_Static_assert({c} == {here}, \"{c} isn't {here}\");"));
        };
        macro_rules! laid_out_alike {
            ($here:ident as $c:literal: $($field:ident = $c_field:literal),+ $(,)?) => {
                same(concat!("sizeof(", $c, ")"), size_of::<$here>());
                same(concat!("_Alignof(", $c, ")"), align_of::<$here>());
                $(same(
                    concat!("__builtin_offsetof(", $c, ", ", $c_field, ")"),
                    offset_of!($here, $field),
                );)+
            };
        }
        laid_out_alike!(SpiroCp as "spiro_cp": x = "x", y = "y", ty = "ty");
        laid_out_alike!(SpiroSeg as "spiro_seg": x = "x", y = "y", ty = "ty", bend_th = "bend_th",
            ks = "ks", seg_ch = "seg_ch", seg_th = "seg_th", l = "l");
        laid_out_alike!(BezCtx as "bezctx": moveto = "moveto", lineto = "lineto",
            quadto = "quadto", curveto = "curveto", mark_knot = "mark_knot");
        laid_out_alike!(CurveData as "curve_data": ty = "ty", points = "x0");
        laid_out_alike!(LsBezCtx as "ls_bezctx": base = "base", cd = "cd", l = "l", max = "max",
            is_open = "is_open");
        same("__builtin_offsetof(curve_data, y3)", offset_of!(CurveData, points) + 7 * 8);
        same("sizeof(((spiro_seg *)0)->ks)", 32);
        for (name, value) in [
            ("SPIRO_INCLUDE_LAST_KNOT", INCLUDE_LAST_KNOT),
            ("SPIRO_INTERNAL_BEZCTX", INTERNAL_BEZCTX),
            ("SPIRO_RETRO_VER1", RETRO_VER1),
            ("SPIRO_REVERSE_SRC", REVERSE_SRC),
            ("SPIRO_ARC_CUB_QUAD_MASK", OUTPUT_MASK),
            ("SPIRO_ARC_CUB_QUAD_CLR", 0x7fff),
            ("SPIRO_CUBIC_TO_BEZIER", 0),
            ("SPIRO_CUBIC_MIN_MAYBE", 0x1000),
            ("SPIRO_ARC_MAYBE", 0x2000),
            ("SPIRO_ARC_MIN_MAYBE", 0x3000),
            ("SPIRO_QUAD0_TO_BEZIER", 0x4000),
        ] {
            same(name, value as usize);
        }
        for (name, letter) in [
            ("CORNER", 'v'),
            ("G4", 'o'),
            ("G2", 'c'),
            ("LEFT", '['),
            ("RIGHT", ']'),
            ("END", 'z'),
            ("OPEN_CONTOUR", '{'),
            ("END_OPEN_CONTOUR", '}'),
            ("ANCHOR", 'a'),
            ("HANDLE", 'h'),
        ] {
            same(&format!("SPIRO_{name}"), letter as usize);
        }
        lines.join("\n") + "\n"
    }

    fn compiles(name: &str, headers: &str) -> bool {
        let name = format!("faircurve-{name}-{}.c", std::process::id());
        let source = std::env::temp_dir().join(name);
        std::fs::write(&source, assertions(headers)).unwrap();
        let compiled = Command::new("cc")
            .args(["-std=c11", "-Wall", "-Werror", "-fsyntax-only"])
            .arg(&source)
            .status()
            .expect("a C compiler");
        std::fs::remove_file(&source).unwrap();
        compiled.success()
    }

    #[test]
    fn the_structs_and_numbers_are_those_of_our_headers() {
        assert!(compiles("ours", concat!(env!("CARGO_MANIFEST_DIR"), "/include")));
    }

    #[test]
    #[expect(clippy::print_stdout, reason = "tests say why they are skipped")]
    fn the_structs_and_numbers_are_those_of_the_headers_of_libspiro() {
        let theirs = "/usr/include";
        if !std::path::Path::new(theirs).join("spiroentrypoints.h").exists() {
            println!("skipped: libspiro-dev is not installed");
            return;
        }
        assert!(compiles("theirs", theirs));
    }
}
