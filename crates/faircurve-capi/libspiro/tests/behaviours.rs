//! What callers of libspiro meet, one by one: the rows of docs/libspiro.md.

#[path = "../../tests/common/mod.rs"]
mod common;
mod library;

use std::f64::consts::TAU;

use faircurve::kurbo::{Point, Vec2};
use faircurve::{Join, Status, catalog, solve};

use library::{Call, Cp, Library, contour_of, list};

const ARCS: i32 = 0x2000;
const FEW_ARCS: i32 = 0x3000;
const QUADRATICS: i32 = 0x4000;

fn library() -> Library {
    Library::open(&common::prefix().join("lib/libspiro.so.1"))
}

fn draw(text: &str) -> Vec<Call> {
    library().draw(&list(text), 0).unwrap_or_else(|| panic!("{text}: 0"))
}

/// Where the pen is at each knot's mark, and at the end.
fn stops(calls: &[Call]) -> Vec<Point> {
    let (mut stops, mut pen) = (Vec::new(), Point::ZERO);
    for call in calls {
        match call {
            Call::Knot(_) => stops.push(pen),
            other => pen = other.end().unwrap_or(pen),
        }
    }
    stops.push(pen);
    stops
}

fn is_finite(calls: &[Call]) -> bool {
    calls.iter().all(|call| call.points().iter().all(|p| p.is_finite()))
}

/// That every knot is passed in order, with marks, and a closed contour comes back to its start to the bit.
fn passes(calls: &[Call], knots: &[(f64, f64)], closed: bool) {
    let first = Point::from(knots[0]);
    assert_eq!(calls[0], Call::Move(first, !closed));
    let mut expected: Vec<Point> = knots.iter().copied().map(Point::from).collect();
    if closed {
        expected.push(first);
    }
    assert_eq!(stops(calls), expected);
    assert!(is_finite(calls));
}

#[test]
fn two_points_are_a_line_or_a_round_shape() {
    let line = draw("0,0,{ 100,50,}");
    assert_eq!(line[1..], [Call::Knot(0), Call::Line(Point::new(100.0, 50.0))]);
    for letters in ["oo", "cc", "oc", "vo", "v]"] {
        let (a, b) = letters.split_at(1);
        let calls = draw(&format!("0,0,{a} 100,50,{b} 0,0,z"));
        passes(&calls, &[(0.0, 0.0), (100.0, 50.0)], true);
    }
    assert!(draw("0,0,o 100,50,o 0,0,z").iter().any(|call| call.is_curve()));
}

#[test]
fn a_single_point_is_a_start_and_nothing_more() {
    let start = [Call::Move(Point::new(3.0, 4.0), false), Call::Knot(0)];
    assert_eq!(draw("3,4,o 0,0,z"), start);
    assert_eq!(draw("3,4,o 3,4,o 0,0,z")[..2], start);
    assert!(draw("3,4,{ 3,4,}").iter().all(|call| !call.is_piece()));
}

#[test]
fn a_first_point_repeated_at_the_end_costs_nothing() {
    let (once, again) = ("500,250,o 250,500,o 0,250,o 250,0,o", "500,250,o");
    let ring = draw(&format!("{once} 0,0,z"));
    let repeated = draw(&format!("{once} {again} 0,0,z"));
    let drawn = |calls: &[Call]| -> Vec<Call> {
        calls.iter().copied().filter(|call| !matches!(call, Call::Knot(_))).collect()
    };
    assert_eq!(drawn(&repeated), drawn(&ring));
    let marks = repeated.iter().filter(|call| matches!(call, Call::Knot(_))).count();
    assert_eq!(marks, 5);
}

#[test]
fn closed_contours_may_start_and_end_with_one_way_points() {
    let knots =
        [(0.0, 0.0), (400.0, 0.0), (500.0, 150.0), (400.0, 300.0), (0.0, 300.0), (-100.0, 150.0)];
    // From a `]`, from a `[`, so that it ends in one, and from between.
    for start in 0..6 {
        let mut cps: Vec<Cp> = knots
            .iter()
            .zip("[]o[]o".chars())
            .map(|(&(x, y), letter)| Cp::new(x, y, letter))
            .collect();
        cps.rotate_left(start);
        let places: Vec<(f64, f64)> = cps.iter().map(|cp| (cp.x, cp.y)).collect();
        cps.push(Cp::new(0.0, 0.0, 'z'));
        let calls = library().draw(&cps, 0).unwrap();
        passes(&calls, &places, true);
        // Two straight sides.
        assert_eq!(calls.iter().filter(|call| matches!(call, Call::Line(_))).count(), 2);
    }
}

#[test]
fn unknown_letters_are_corners() {
    let corners = draw("0,0,o 100,100,v 200,0,o 300,150,o 100,300,o 0,0,z");
    for letter in ['x', '?', 'V', '{', '1'] {
        assert_eq!(
            draw(&format!("0,0,o 100,100,{letter} 200,0,o 300,150,o 100,300,o 0,0,z")),
            corners
        );
    }
}

#[test]
fn anchors_give_their_direction() {
    for text in [
        "0,0,{ 100,100,a 200,100,h 200,0,c 300,50,}",
        "100,100,a 200,100,h 200,0,o 0,0,v 0,0,z",
        "0,0,o 100,100,a 110,120,h 200,0,o 300,50,o 0,0,z",
    ] {
        let cps = list(text);
        let anchor = cps.iter().position(|cp| cp.letter() == 'a').unwrap();
        let at = Point::new(cps[anchor].x, cps[anchor].y);
        let along = Point::new(cps[anchor + 1].x, cps[anchor + 1].y) - at;
        let calls = draw(text);
        let (mut pen, mut met) = (Point::ZERO, 0);
        for call in &calls {
            if let Call::Cubic(p1, p2, end) = *call {
                for (handle, on) in [(p1 - pen, pen), (end - p2, end)] {
                    if on == at {
                        met += 1;
                        let turn = along.cross(handle) / (along.hypot() * handle.hypot());
                        assert!(turn.abs() < 1e-9 && along.dot(handle) > 0.0, "{text}: {turn}");
                    }
                }
            }
            pen = call.end().unwrap_or(pen);
        }
        assert_eq!(met, 2, "{text}");
    }
}

#[test]
fn the_source_is_turned_round_in_place() {
    let mut cps = list("0,0,{ 100,100,o 200,0,[ 300,50,}");
    let forward = library().draw(&cps, 0).unwrap();
    let backward = library().draw_tagged(&mut cps, 0x0800).unwrap();
    assert_eq!(cps, list("300,50,{ 200,0,] 100,100,o 0,0,}"));
    let mut places = stops(&forward);
    places.reverse();
    assert_eq!(stops(&backward), places);
}

#[test]
fn counted_lists_draw_what_marked_ones_do() {
    let library = library();
    let open = list("0,0,{ 100,100,c 200,0,c 300,60,}");
    let unmarked = list("0,0,c 100,100,c 200,0,c 300,60,v");
    assert_eq!(library.draw_counted(&unmarked, false, 0), library.draw(&open, 0));
    let closed = list("0,0,c 100,100,c 200,0,c 300,60,v 0,0,z");
    assert_eq!(library.draw_counted(&unmarked, true, 0), library.draw(&closed, 0));
    assert_eq!(library.draw_counted(&closed, true, 0), library.draw(&closed, 0));
    assert_eq!(library.draw_counted(&open, true, 0), library.draw(&open, 0));
}

/// A circle comes as arcs of exactly that circle; as quadratics whose tangents are its own.
#[test]
fn arcs_are_arcs_and_quadratics_are_quadratics() {
    let circle = list("500,250,o 250,500,o 0,250,o 250,0,o 0,0,z");
    let centre = Point::new(250.0, 250.0);
    for kind in [ARCS, FEW_ARCS] {
        let calls = library().draw(&circle, kind).unwrap();
        let arcs = calls.iter().filter(|call| call.is_piece());
        assert!(arcs.clone().count() <= 8);
        for call in arcs {
            let Call::Quad(through, end) = *call else { panic!("{call:?}") };
            assert!(((through - centre).hypot() - 250.0).abs() < 1e-9);
            assert!(((end - centre).hypot() - 250.0).abs() < 1e-9);
        }
    }
    let calls = library().draw(&circle, QUADRATICS).unwrap();
    let mut pen = Point::ZERO;
    for call in calls {
        if let Call::Quad(p1, end) = call {
            for (on, handle) in [(pen, p1 - pen), (end, end - p1)] {
                assert!((on - centre).dot(handle).abs() < 1e-6 * handle.hypot() * 250.0);
            }
        }
        assert!(!matches!(call, Call::Cubic(..) | Call::Line(_)));
        pen = call.end().unwrap_or(pen);
    }
}

/// Random points, some of which have no curve as asked: all are drawn, and close.
#[test]
fn what_has_to_be_relaxed_is_drawn() {
    let (library, spiro) = (library(), catalog::spline("spiro").unwrap());
    let mut state = 1u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as f64 / (1u64 << 31) as f64 * 1000.0
    };
    let mut relaxed = 0;
    for _ in 0..40 {
        let mut cps: Vec<Cp> =
            (0..24).map(|_| Cp::new(next().round(), next().round(), 'o')).collect();
        let places: Vec<(f64, f64)> = cps.iter().map(|cp| (cp.x, cp.y)).collect();
        cps.push(Cp::new(0.0, 0.0, 'z'));
        let status = solve(&contour_of(&cps), &*spiro).unwrap().report.status();
        relaxed += usize::from(status == Status::Relaxed);
        passes(&library.draw(&cps, 0).unwrap(), &places, true);
    }
    assert!(relaxed > 0, "all of these are solved: take harder ones");
}

/// Straight stretches between curves arrive as lines, and nothing else does.
#[test]
fn straight_stretches_are_lines() {
    let text = "0,0,v 200,0,[ 320,90,o 360,220,c 250,330,o 60,300,] 0,200,v 0,0,z";
    let calls = draw(text);
    let mut lines = Vec::new();
    let mut knot = 0;
    for call in &calls {
        match call {
            Call::Knot(number) => knot = *number,
            Call::Line(_) => lines.push(knot),
            _ => {}
        }
    }
    let contour = contour_of(&list(text));
    let exact = solve(&contour, &*catalog::spline("spiro").unwrap()).unwrap();
    let straight = exact.curve.segments().iter().enumerate().filter(|(_, s)| s.is_line());
    assert_eq!(lines, straight.map(|(i, _)| i as i32).collect::<Vec<_>>());
    assert!(!lines.is_empty() && contour.knots[1].join == Some(Join::CurveToTerminal));
}

/// Any size, from a speck to the solar system, and far from the origin.
#[test]
fn size_and_place_make_no_difference() {
    let library = library();
    let shape: Vec<Vec2> = (0..7)
        .map(|i| Vec2::from_angle(TAU * f64::from(i) / 7.0) * (1.0 + 0.2 * f64::from(i % 2)))
        .collect();
    let drawn = |scale: f64, offset: f64| {
        let cp = |v: &Vec2| Cp::new(v.x * scale + offset, v.y * scale + offset, 'o');
        let mut cps: Vec<Cp> = shape.iter().map(cp).collect();
        cps.push(Cp::new(0.0, 0.0, 'z'));
        library.draw(&cps, 0).unwrap()
    };
    let unit = drawn(1.0, 0.0);
    for (scale, offset) in [(1e-9, 0.0), (1e13, 0.0), (1.0, 1e5)] {
        let other = drawn(scale, offset);
        assert_eq!(other.len(), unit.len());
        for (a, b) in unit.iter().zip(&other) {
            for (p, q) in a.points().iter().zip(b.points()) {
                let back = (q.to_vec2() - Vec2::new(offset, offset)) / scale;
                assert!((back - p.to_vec2()).hypot() < 1e-7, "{scale} {offset}: {p:?} {back:?}");
            }
        }
    }
}
