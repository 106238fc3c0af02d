use std::f64::consts::PI;

use super::*;

const ANGLES: [f64; 9] = [-2.9, -1.7, -0.9, -0.3, 0.0, 0.4, 1.1, 1.8, 2.6];

fn map(theta0: f64, theta1: f64) -> EndCurvatures {
    BespokeCubics.curvatures(ChordAngles::new(theta0, theta1), &SegmentContext::UNIT)
}

#[test]
fn derivatives_agree_with_differences() {
    let h = 1e-6;
    let mut contexts = vec![SegmentContext::UNIT; 2];
    contexts[1].given_direction = [true, false];
    for context in contexts {
        for theta0 in ANGLES {
            for theta1 in ANGLES {
                let at = |a: f64, b: f64| {
                    BespokeCubics.curvatures(ChordAngles::new(theta0 + a, theta1 + b), &context)
                };
                let exact = at(0.0, 0.0);
                for angle in 0..2 {
                    let (a, b) = if angle == 0 { (h, 0.0) } else { (0.0, h) };
                    let (up, down) = (at(a, b), at(-a, -b));
                    for end in 0..2 {
                        let slope = |part: fn(&EndCurvature) -> f64| {
                            (part(&up.value[end]) - part(&down.value[end])) / (2.0 * h)
                        };
                        let claimed = exact.by_angle[end][angle];
                        let off = (slope(|e| e.num) - claimed.num).abs();
                        let off = off.max((slope(|e| e.den) - claimed.den).abs());
                        assert!(off < 1e-8, "{theta0} {theta1} {end} {angle}: {off:e}");
                    }
                }
            }
        }
    }
}

/// Bespoke 2.2, 3: period π in both tangents. The segment is the same; at the end that is turned,
/// its tangent points the other way, and so do numerator and denominator.
#[test]
fn the_map_is_periodic() {
    for theta0 in ANGLES {
        for theta1 in ANGLES {
            let (here, there) = (map(theta0, theta1), map(theta0 + PI, theta1));
            for (end, sign) in [(0, -1.0), (1, 1.0)] {
                let (a, b) = (here.value[end], there.value[end]);
                assert!((a.num - sign * b.num).abs() < 1e-14, "{theta0} {theta1}");
                assert!((a.den - sign * b.den).abs() < 1e-14, "{theta0} {theta1}");
            }
        }
    }
}

#[test]
fn arms_are_a_third_of_the_chord_on_a_line_and_vanish_at_a_right_angle() {
    let arm =
        |own: f64, other: f64| Arms::new(&Tangents::new(ChordAngles::new(own, other))).length[0];
    assert!((arm(0.0, 0.0) - 1.0 / 3.0).abs() < 1e-16);
    assert!(arm(FRAC_PI_2, 0.0).abs() < 1e-16);
    assert!(arm(2.0, 0.0) < 0.0);
}

/// An oracle: curvature of the placed Bézier by its control points, as kurbo has it.
#[test]
fn the_map_is_the_curvature_of_the_segment() {
    for theta0 in ANGLES {
        for theta1 in ANGLES {
            let angles = ChordAngles::new(theta0, theta1);
            let ends = SegmentEnds { angles, curvatures: None, context: SegmentContext::UNIT };
            let (start, end) = (Point::new(3.0, 4.0), Point::new(3.0, 6.0));
            let segment = BespokeCubics.place(start, end, &ends);
            if segment.is_line() {
                continue;
            }
            let map = map(theta0, theta1);
            for (end, s) in [(0, 0.0), (1, segment.length())] {
                let expected = map.value[end].num / map.value[end].den / 2.0;
                let off = segment.curvature(s) * map.value[end].den.signum().abs() - expected;
                assert!(off.abs() < 1e-11 * (1.0 + expected.abs()), "{theta0} {theta1} {off:e}");
            }
        }
    }
}

#[test]
fn end_rules_vanish_with_a_cusp_at_the_other_end() {
    for rule in [half_sine_end, parabola_end] {
        for turns in [0.0, 1.0, 2.0] {
            assert!(rule(FRAC_PI_2 + PI * turns).0.abs() < 1e-15);
        }
        for angle in ANGLES {
            let h = 1e-6;
            let slope = (rule(angle + h).0 - rule(angle - h).0) / (2.0 * h);
            assert!((slope - rule(angle).1).abs() < 1e-8);
        }
    }
    let theta: f64 = 1.2;
    assert!((parabola_end(theta).0 - ((2.0 * theta.tan()).atan() - theta)).abs() < 1e-15);
}

/// What the spline is for: any knots at all. Uniform in a square, open and closed, most of them with
/// turns far beyond what the Euler spline deals with.
#[test]
fn random_knots_are_solved_without_reversals() {
    let mut state = 7u64;
    let mut random = move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let spline = crate::catalog::spline("bespoke").unwrap();
    for case in 0..240 {
        let n = [4, 9, 20, 45][case % 4];
        let points: Vec<Point> = (0..n).map(|_| Point::new(random(), random())).collect();
        let contour = crate::Contour { closed: case % 8 < 4, ..crate::Contour::open(points) };
        let solution = crate::solve(&contour, &*spline).unwrap();
        assert_eq!(solution.report.relaxed, [], "{contour:?}");
        for knot in &solution.knots {
            if let (Some(arriving), Some(leaving)) = (knot.direction_in, knot.direction_out) {
                assert!((arriving - leaving).cos() > 1.0 - 1e-12, "{contour:?}");
            }
        }
    }
}

/// A direction given at an end is that in which the curve leaves, even where the arm of the free
/// spline would point backwards.
#[test]
fn given_directions_are_met() {
    let spline = crate::catalog::spline("bespoke").unwrap();
    for i in 0..24 {
        let direction = PI * f64::from(i) / 12.0;
        let mut contour = crate::Contour::open([(0.0, 0.0), (3.0, 1.0), (4.0, -2.0)]);
        contour.knots[0] = contour.knots[0].clone().tangent(kurbo::Vec2::from_angle(direction));
        let solution = crate::solve(&contour, &*spline).unwrap();
        assert_eq!(solution.report.relaxed, [], "{direction}");
        let off = solution.knots[0].direction_out.unwrap() - direction;
        assert!(off.cos() > 1.0 - 1e-15, "{direction} {off}");
    }
}

/// To first order: what is left is the square of the change, times second derivatives of a few units.
#[test]
fn turned_curvatures_are_those_of_the_turned_tangents() {
    let change = [1e-6, -2e-6];
    for (theta0, theta1) in ANGLES.into_iter().flat_map(|a| ANGLES.map(|b| (a, b))) {
        let mut turned = map(theta0, theta1);
        turned.turn(change);
        let exact = map(theta0 + change[0], theta1 + change[1]);
        for (turned, exact) in turned.value.iter().zip(exact.value) {
            let off = (turned.num - exact.num).abs().max((turned.den - exact.den).abs());
            assert!(off < 1e-11, "{theta0} {theta1}: {off:e}");
        }
    }
}
