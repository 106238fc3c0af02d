//! Real fonts through the drop-in: every contour solved, the same from every start, nearer to the exact spiral than
//! the system's libspiro, with no more pieces.
//!
//! ```sh
//! cargo test --release -p faircurve-capi-libspiro --test fonts -- --nocapture
//! ```
#![expect(clippy::print_stdout, reason = "the numbers are worth seeing")]

#[path = "../../tests/common/mod.rs"]
mod common;
mod library;

use faircurve::kurbo::{
    Arc, BezPath, CubicBez, Line, ParamCurve, ParamCurveNearest, PathSeg, Point, QuadBez, Vec2,
};
use faircurve::{Curve, Segment, catalog, solve};

use library::{Call, Cp, Library, Stored, contour_of, fonts, stored, system_library};

fn ours() -> Library {
    Library::open(&common::prefix().join("lib/libspiro.so.1"))
}

fn exact(list: &[Cp]) -> Curve {
    solve(&contour_of(list), &*catalog::spline("spiro").unwrap()).unwrap().curve
}

fn size(list: &[Cp]) -> f64 {
    let ends = list.iter().filter(|cp| cp.letter() != 'z');
    let (x, y): (Vec<f64>, Vec<f64>) = ends.map(|cp| (cp.x, cp.y)).unzip();
    let side = |v: &[f64]| {
        v.iter().copied().fold(f64::MIN, f64::max) - v.iter().copied().fold(f64::MAX, f64::min)
    };
    side(&x).max(side(&y))
}

const KINDS: [(&str, i32); 5] = [
    ("cubics", 0),
    ("few cubics", 0x1000),
    ("arcs", 0x2000),
    ("few arcs", 0x3000),
    ("quadratics", 0x4000),
];

/// The arc through a point, as cubics that are as good as it.
fn arc(start: Point, through: Point, end: Point) -> Vec<PathSeg> {
    let (a, b) = (through - start, end - start);
    let cross = a.cross(b);
    let toward =
        (a.hypot2() * Vec2::new(b.y, -b.x) - b.hypot2() * Vec2::new(a.y, -a.x)) / (2.0 * cross);
    let centre = start + toward;
    let turned = |from: Point, to: Point| {
        (from - centre).cross(to - centre).atan2((from - centre).dot(to - centre))
    };
    let sweep = turned(start, through) + turned(through, end);
    let radii = Vec2::new(toward.hypot(), toward.hypot());
    let path = Arc::new(centre, radii, (start - centre).atan2(), sweep, 0.0);
    let mut cubics = BezPath::new();
    cubics.move_to(start);
    cubics.extend(path.append_iter(1e-9 * b.hypot()));
    cubics.segments().collect()
}

/// The pieces of each span.
fn spans(calls: &[Call], ncq: i32) -> Vec<Vec<PathSeg>> {
    let (mut spans, mut pen): (Vec<Vec<PathSeg>>, Point) = (Vec::new(), Point::ZERO);
    for call in calls {
        let piece = match *call {
            Call::Move(..) => None,
            Call::Knot(_) => {
                spans.push(Vec::new());
                None
            }
            Call::Line(end) => Some(PathSeg::Line(Line::new(pen, end))),
            Call::Quad(through, end) if ncq & 0x6000 == 0x2000 => {
                spans.last_mut().unwrap().extend(arc(pen, through, end));
                None
            }
            Call::Quad(p1, end) => Some(PathSeg::Quad(QuadBez::new(pen, p1, end))),
            Call::Cubic(p1, p2, end) => Some(PathSeg::Cubic(CubicBez::new(pen, p1, p2, end))),
        };
        pen = call.end().unwrap_or(pen);
        if let Some(piece) = piece {
            spans.last_mut().unwrap().push(piece);
        }
    }
    spans
}

/// The largest distance of the pieces of a span from the exact segment, and of that from them.
fn distance(segment: &Segment, pieces: &[PathSeg], accuracy: f64) -> f64 {
    const POINTS: usize = 16;
    let places = || (0..=POINTS).map(|i| i as f64 / POINTS as f64);
    let from_pieces = pieces.iter().flat_map(|piece| places().map(|t| piece.eval(t)));
    let out = from_pieces.map(|p| segment.nearest(p, accuracy).1).fold(0.0, f64::max);
    let back = places().map(|t| {
        let p = segment.point(t * segment.length());
        let nearest = pieces.iter().map(|piece| piece.nearest(p, accuracy).distance_sq);
        nearest.fold(f64::INFINITY, f64::min).sqrt()
    });
    if pieces.is_empty() { out } else { out.max(back.fold(0.0, f64::max)) }
}

#[test]
fn every_contour_is_solved_and_only_the_straight_ones_come_back_straight() {
    let library = ours();
    for file in fonts() {
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        let (mut curved, mut straight) = (0, 0);
        for stored in stored(&file) {
            let Stored { glyph, list, .. } = &stored;
            let calls = library.draw(list, 0).unwrap_or_else(|| panic!("{name} {glyph}: 0"));
            let finite = |p: &Point| p.is_finite();
            assert!(calls.iter().all(|call| call.points().iter().all(finite)), "{name} {glyph}");
            // mark_knot before each span, and a closed contour back at its start to the bit.
            let knots = calls.iter().filter(|call| matches!(call, Call::Knot(_)));
            let marks = knots.enumerate().map(|(i, call)| *call == Call::Knot(i as i32));
            assert_eq!(marks.filter(|right| *right).count(), list.len() - 1, "{name} {glyph}");
            let end = calls.iter().rev().find_map(|call| call.end()).unwrap();
            let last = if stored.is_open() { &list[list.len() - 1] } else { &list[0] };
            assert_eq!((end.x, end.y), (last.x, last.y), "{name} {glyph}");
            // Straight spans are lines, curved ones aren't.
            let exact = exact(list);
            for (segment, pieces) in exact.segments().iter().zip(spans(&calls, 0)) {
                let lines = pieces.iter().filter(|piece| matches!(piece, PathSeg::Line(_))).count();
                assert_eq!(lines, usize::from(segment.is_line() && segment.length() > 0.0));
            }
            if stored.is_curved {
                curved += 1;
                let is_straight = !calls.iter().any(|call| call.is_curve());
                straight += usize::from(is_straight);
                assert_eq!(is_straight, exact.segments().iter().all(Segment::is_line));
            }
        }
        println!("{name}: {curved} contours with curve points, {straight} come back straight");
        match name.as_str() {
            "Cantarell-Regular-Spiro" => assert_eq!((curved, straight), (101, 0)),
            "Chomsky" => assert_eq!((curved, straight), (374, 3)),
            "KJV1611" => assert_eq!((curved, straight), (54, 6)),
            _ => assert_eq!(straight, 0),
        }
    }
}

#[test]
fn closed_contours_are_the_same_from_every_start() {
    /// Part of the contour's size.
    const SAME: f64 = 1e-7;
    let library = ours();
    let (mut contours, mut starts, mut worst) = (0, 0, 0.0f64);
    for stored in fonts().iter().flat_map(|file| stored(file)) {
        if stored.is_open() || !stored.is_curved {
            continue;
        }
        let Stored { glyph, list, .. } = stored;
        contours += 1;
        let count = list.len() - 1;
        let spans_from = |start: usize| {
            let mut turned = list.clone();
            turned[..count].rotate_left(start);
            spans(&library.draw(&turned, 0).unwrap_or_else(|| panic!("{glyph} from {start}: 0")), 0)
        };
        let first = spans_from(0);
        for start in 1..count {
            starts += 1;
            for (i, pieces) in spans_from(start).iter().enumerate() {
                let same = &first[(i + start) % count];
                assert_eq!(pieces.len(), same.len(), "{glyph} from {start}");
                for (a, b) in pieces.iter().zip(same) {
                    let moved = (0..=4).map(|t| f64::from(t) / 4.0).map(|t| a.eval(t) - b.eval(t));
                    worst = worst.max(moved.map(Vec2::hypot).fold(0.0, f64::max) / size(&list));
                }
            }
        }
    }
    println!(
        "{contours} closed contours from {starts} further starts: moved by at most {worst:.1e} of their size"
    );
    assert!(worst < SAME);
}

#[test]
fn ours_is_nearer_to_the_exact_spiral_with_no_more_pieces() {
    /// Farther from it, it is another curve.
    const ANOTHER: f64 = 0.02;
    let Some(system) = system_library() else { return };
    let (library, system) = (ours(), Library::open(&system));
    for (kind, ncq) in KINDS {
        let (mut compared, mut others) = (0, 0);
        let (mut pieces, mut errors) = ([0; 2], [Vec::new(), Vec::new()]);
        for Stored { glyph, list, .. } in fonts().iter().flat_map(|file| stored(file)) {
            let exact = exact(&list);
            if exact.segments().iter().all(Segment::is_line) {
                continue;
            }
            let Some(theirs) = system.draw(&list, ncq) else { continue };
            let ours = library.draw(&list, ncq).unwrap();
            let (size, accuracy) = (size(&list), 1e-8 * size(&list));
            let error = |calls: &[Call]| {
                let spans = spans(calls, ncq);
                assert_eq!(spans.len(), exact.segments().len(), "{glyph}");
                let pairs = exact.segments().iter().zip(&spans);
                pairs
                    .map(|(segment, pieces)| distance(segment, pieces, accuracy))
                    .fold(0.0, f64::max)
            };
            let both = [error(&ours), error(&theirs)];
            if both[1] > ANOTHER * size {
                others += 1;
                assert!(both[0] < both[1]);
                continue;
            }
            compared += 1;
            for (i, calls) in [&ours, &theirs].into_iter().enumerate() {
                pieces[i] += calls.iter().filter(|call| call.is_piece()).count();
                errors[i].push(both[i]);
            }
            // Arcs are made in the same way, and measured at other places.
            let slack = if kind.ends_with("arcs") { 0.01 * both[1] + accuracy } else { 0.0 };
            assert!(both[0] < both[1] + slack, "{glyph}, {kind}: {} against {}", both[0], both[1]);
        }
        println!(
            "{kind}: {compared} contours that both solve, {others} on which libspiro is far from the curve"
        );
        for (who, (pieces, errors)) in
            ["ours", "libspiro"].iter().zip(pieces.iter().zip(&mut errors))
        {
            errors.sort_by(f64::total_cmp);
            let at = |share: f64| errors[((errors.len() - 1) as f64 * share) as usize];
            println!(
                "  {who:8} {pieces:6} pieces; distance, in font units: median {:.4}, 90 % {:.4}, largest {:.4}",
                at(0.5),
                at(0.9),
                at(1.0)
            );
        }
        assert!(pieces[0] <= pieces[1], "{kind}");
    }
}
