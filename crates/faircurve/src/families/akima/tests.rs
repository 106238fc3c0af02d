use kurbo::{Affine, PathSeg, Point, Vec2};

use crate::outline::Contour;
use crate::spline::solve;

fn directions(contour: &Contour) -> Vec<f64> {
    let spline = crate::catalog::spline("akima").unwrap();
    let solution = solve(contour, &*spline).unwrap();
    assert!(solution.report.relaxed.is_empty());
    solution.knots.iter().map(|knot| knot.direction_out.or(knot.direction_in).unwrap()).collect()
}

#[test]
fn straight_neighbours_pull_the_tangent_to_their_line() {
    // Akima's motive: three knots in line leave and enter without the wiggle of a polynomial.
    let contour = Contour::open([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 1.0), (4.0, 3.0)]);
    let directions = directions(&contour);
    assert!(directions[..3].iter().all(|direction| direction.abs() < 1e-15), "{directions:?}");
}

#[test]
fn directions_go_with_affine_maps() {
    let points = [(0.0, 0.0), (10.0, 7.0), (22.0, 5.0), (30.0, -8.0), (41.0, -3.0), (45.0, 9.0)];
    let map = Affine::new([1.3, 0.2, -0.7, 0.9, 5.0, -2.0]);
    let plain = directions(&Contour::open(points));
    let mapped = directions(&Contour::open(points.map(|p| map * Point::from(p))));
    for (a, b) in plain.into_iter().zip(mapped) {
        let expected = map * Vec2::from_angle(a).to_point() - map * Point::ZERO;
        assert!(expected.cross(Vec2::from_angle(b)).abs() < 1e-12, "{a} {b}");
    }
}

#[test]
fn knots_on_a_parabola_evenly_in_x_have_its_tangents() {
    // Differences of the chords are all alike, so that both weights are, too.
    let parabola = |x: i32| (f64::from(x), f64::from(x * x) / 4.0);
    let directions = directions(&Contour::open((-3..=3).map(parabola)));
    for (x, direction) in (-3..=3).zip(directions) {
        assert!((direction.tan() - f64::from(x) / 2.0).abs() < 1e-14, "{x} {direction}");
    }
}

#[test]
fn segments_are_cubics_with_arms_of_a_third_of_the_chord() {
    let contour = Contour::closed([(0.0, 0.0), (9.0, 1.0), (7.0, 8.0), (-2.0, 5.0)]);
    let spline = crate::catalog::spline("akima").unwrap();
    for segment in solve(&contour, &*spline).unwrap().curve.segments() {
        let beziers = segment.beziers().unwrap();
        let [PathSeg::Cubic(cubic)] = beziers[..] else { panic!("{beziers:?}") };
        let third = segment.chord_length() / 3.0;
        for arm in [cubic.p1 - cubic.p0, cubic.p3 - cubic.p2] {
            assert!((arm.hypot() - third).abs() < 1e-14 * third);
        }
    }
}
