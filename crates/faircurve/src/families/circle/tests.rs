use super::*;
use crate::frame::ChordAngles;
use crate::outline::{Contour, Knot};
use crate::segment::{ParametricCurve, UnitCurve};
use crate::spline::{Status, solve};

fn blend(theta0: f64, theta1: f64) -> CircleBlend {
    CircleBlend::new(ChordAngles::new(theta0, theta1))
}

const ANGLES: [(f64, f64); 9] = [
    (0.0, 0.0),
    (0.5, 0.5),
    (0.3, -0.8),
    (1.5, 0.2),
    (-2.0, 1.0),
    (2.9, 2.7),
    (3.0, -3.0),
    (1e-9, -2e-9),
    (3.138, 0.0),
];

#[test]
fn the_velocity_series_are_those_of_the_points() {
    for (theta0, theta1) in ANGLES {
        let blend = blend(theta0, theta1);
        assert_eq!(blend.point(0.0), num_complex::Complex64::ZERO);
        let near = blend.point(1e-300);
        assert!(near.norm() < 1e-290 && near.is_finite());
        assert_eq!(blend.point(1.0), num_complex::Complex64::ONE);
        for i in 0..=20 {
            let u = f64::from(i) / 20.0;
            let series = blend.velocity_series(u);
            assert!((blend.velocity(u) - series[0]).norm() < 1e-13 * (1.0 + series[0].norm()));
            // Through t⁴, against the points on both sides.
            let t = 0.01;
            let size: f64 = series.iter().map(|c| c.norm()).fold(1.0, f64::max);
            let moved = |t: f64| -> num_complex::Complex64 {
                (0..5).map(|n| series[n] * t.powi(n as i32 + 1) / (n + 1) as f64).sum()
            };
            let off = blend.point(u + t) - blend.point(u) - moved(t);
            assert!(off.norm() < 1e-8 * size, "{theta0} {theta1} {u}: {:e}", off.norm());
        }
    }
}

/// At the ends the blend has the circles' curvatures. The thesis says that κ′ is 0 there; it is
/// (3π²/2)(θ₁ − θ₀)·(sin τ/τ)² with the sign of the mirror, for unit chord: the blend is G2.
#[test]
fn curvature_at_the_ends_is_the_circles_and_its_derivative_is_not_zero() {
    for (theta0, theta1) in ANGLES {
        let curve = Measured::new(blend(theta0, theta1));
        let (start, end) = (curve.curvature_jet(0.0), curve.curvature_jet(curve.length()));
        let close = |a: f64, b: f64| (a - b).abs() < 1e-10 * (1.0 + b.abs());
        assert!(close(start[0], 2.0 * theta0.sin()), "{theta0} {theta1} {}", start[0]);
        assert!(close(end[0], 2.0 * theta1.sin()), "{theta0} {theta1} {}", end[0]);
        let sinc = |x: f64| if x == 0.0 { 1.0 } else { x.sin() / x };
        let rate = 1.5 * PI * PI;
        let expected = [
            -rate * (theta1 - theta0) * sinc(theta0).powi(2),
            -rate * (theta1 - theta0) * sinc(theta1).powi(2),
        ];
        assert!(close(start[1], expected[0]), "{theta0} {theta1} {} {}", start[1], expected[0]);
        assert!(close(end[1], expected[1]), "{theta0} {theta1} {} {}", end[1], expected[1]);
    }
}

#[test]
fn at_knots_curvature_is_continuous_and_its_derivative_is_not() {
    let spline = crate::catalog::spline("circle").unwrap();
    let knots = [(0.0, 0.0), (4.0, 1.0), (5.0, 3.0), (4.0, 5.0), (1.0, 5.5)];
    let solution = solve(&Contour::open(knots), &*spline).unwrap();
    let segments = solution.curve.segments();
    for i in 1..4 {
        let (before, after) = (&segments[i - 1], &segments[i]);
        let (left, right) = (before.curvature_jet(before.length()), after.curvature_jet(0.0));
        assert!((left[0] - right[0]).abs() < 1e-13);
        assert!((left[1] - right[1]).abs() > 1e-3, "{left:?} {right:?}");
    }
}

/// Moving a knot changes two segments on either side and no others.
#[test]
fn support_is_two_segments_on_either_side() {
    let spline = crate::catalog::spline("circle").unwrap();
    let knots = |moved: f64| {
        (0..12).map(move |i| {
            let x = f64::from(i);
            (x, (x * x).sin() + if i == 6 { moved } else { 0.0 })
        })
    };
    for closed in [false, true] {
        let at = |moved: f64| {
            solve(&Contour { closed, ..Contour::open(knots(moved)) }, &*spline).unwrap()
        };
        let (before, after) = (at(0.0), at(0.1));
        for (i, (a, b)) in before.curve.segments().iter().zip(after.curve.segments()).enumerate() {
            let off = (a.point(a.length() / 2.0) - b.point(b.length() / 2.0)).hypot();
            let is_near = (4..=7).contains(&i);
            assert_eq!(off > 1e-3, is_near, "{i}: {off}");
            assert!(is_near || off < 1e-14, "{i}: {off}");
        }
    }
}

/// Figure 4.15: a knot added where the curve crosses its chord makes three in a line, which turns the
/// tangent there into that line and adds two inflections.
#[test]
fn it_is_far_from_extensional() {
    let spline = crate::catalog::spline("circle").unwrap();
    let knots = [(-2.0, 0.0), (-1.0, 1.0), (1.0, -1.0), (2.0, 0.0)];
    let before = solve(&Contour::open(knots), &*spline).unwrap();
    let middle = &before.curve.segments()[1];
    let center = middle.at(middle.length() / 2.0);
    assert!(center.point.to_vec2().hypot() < 1e-14);
    let [a, b, c, d] = knots;
    let after = solve(&Contour::open([a, b, (0.0, 0.0), c, d]), &*spline).unwrap();
    let turned = wrap_angle(after.knots[2].direction_in.unwrap() - center.direction);
    assert!((turned.abs() - 0.715_736).abs() < 1e-6, "{turned}");
    let inflections = |solution: &crate::Solution| {
        let curve = &solution.curve;
        let at = |i: i32| curve.at(curve.length() * (f64::from(i) + 0.37) / 1000.0).unwrap();
        (0..999).filter(|&i| at(i).curvature * at(i + 1).curvature < 0.0).count()
    };
    assert_eq!([inflections(&before), inflections(&after)], [1, 3]);
    let off = (0..=60)
        .map(|i| before.curve.at(before.curve.length() * f64::from(i) / 60.0).unwrap().point)
        .map(|point| after.curve.nearest(point, 1e-9).unwrap().2)
        .fold(0.0, f64::max);
    // A tenth of the middle chord.
    assert!((off / 8f64.sqrt() - 0.098_19).abs() < 1e-5, "{off}");
}

#[test]
fn hairpins_and_backward_tangents_are_drawn_and_reported() {
    let spline = crate::catalog::spline("circle").unwrap();
    // There and half the way back: no circle but the line through infinity.
    for knots in [
        vec![(0.0, 0.0), (2.0, 0.0), (1.0, 0.0)],
        vec![(0.0, 0.0), (2.0, 0.0), (1.0, 1e-6), (5.0, 3.0)],
        vec![(0.0, 0.0), (1.0, 0.0), (0.0, 0.0)],
        vec![(0.0, 0.0), (1.0, 0.0), (1e-9, 1e-20), (1.0, 1.0)],
    ] {
        for closed in [false, true] {
            let contour = Contour { closed, ..Contour::open(knots.clone()) };
            let solution = solve(&contour, &*spline).unwrap();
            assert!(solution.curve.length().is_finite());
            assert!(solution.report.residual.is_finite());
            for segment in solution.curve.segments() {
                assert!(segment.bending_energy().is_finite());
                assert!(segment.length() < 1e4 * segment.chord_length().max(1e-300));
            }
        }
    }
    let back = Knot::from((0.0, 0.0)).tangent((-1.0, 0.0));
    let contour = Contour::open([back, Knot::from((1.0, 0.0)).tangent((0.0, 1.0))]);
    let solution = solve(&contour, &*spline).unwrap();
    assert_eq!(solution.report.status(), Status::Relaxed);
    assert_eq!(solution.report.relaxed[0].got, "euler");
    assert!(wrap_angle(solution.knots[0].direction_out.unwrap() - PI).abs() < 1e-12);
}
