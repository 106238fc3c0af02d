use std::f64::consts::PI;

use super::*;
use crate::catalog;
use crate::{Contour, Knot, Status, solve};

fn angles() -> Vec<f64> {
    let mut angles: Vec<f64> = (-20..=20).map(|i| f64::from(i) * PI / 20.0).collect();
    angles.extend([1e-300, -1e-17, 1e-9, PI - 1e-9]);
    angles
}

#[test]
fn mock_curvature_is_that_of_the_cubic_to_first_order() {
    let tensions = [[1.0, 1.0], [0.75, 2.0], [-1.5, 10.0]];
    for given in tensions {
        let context = SegmentContext { tension: given.map(Some), ..SegmentContext::UNIT };
        for (theta0, theta1) in [(1.0, 0.0), (0.0, 1.0), (0.7, -0.4)] {
            let small = ChordAngles::new(1e-5 * theta0, 1e-5 * theta1);
            let mock = MockCurvature { tension: 1.0 }.curvatures(small, &context);
            // Without the limit of "at least", to which the mock curvature is blind.
            let context = SegmentContext { tension: given.map(|t| Some(t.abs())), ..context };
            let ends = SegmentEnds { angles: small, curvatures: None, context };
            let segment =
                HobbyCubics { tension: 1.0 }.place(Point::ORIGIN, Point::new(1.0, 0.0), &ends);
            let actual = [segment.curvature(0.0), segment.curvature(segment.length())];
            for end in 0..2 {
                let error = (mock.value[end].num - actual[end]).abs();
                assert!(error < 1e-7 * (1e-5 + actual[end].abs()), "{given:?} {end}: {error:e}");
            }
        }
    }
}

#[test]
fn arms_are_positive_and_at_most_four() {
    for &theta0 in &angles() {
        for &theta1 in &angles() {
            for tension in [0.75, -0.75, 1.0, 4096.0] {
                for arm in hobby_arms(ChordAngles::new(theta0, theta1), [tension; 2]) {
                    let least = if tension < 0.0 { 0.0 } else { 1e-5 };
                    assert!((least..=4.0).contains(&arm), "{theta0} {theta1} {tension}: {arm}");
                }
            }
        }
    }
    assert_eq!(hobby_arms(ChordAngles::new(PI, PI), [1.0; 2]), [4.0; 2]);
}

#[test]
fn a_tension_of_at_least_keeps_within_the_triangle() {
    for &theta0 in &angles() {
        for &theta1 in &angles() {
            let angles = ChordAngles::new(theta0, theta1);
            let (free, kept) = (hobby_arms(angles, [1.0; 2]), hobby_arms(angles, [-1.0; 2]));
            let is_triangle = theta0 * theta1 > 0.0 && (theta0 + theta1).abs() < PI - 1e-9;
            let sine = (theta0 + theta1).sin();
            for (i, opposite) in [theta1, theta0].into_iter().enumerate() {
                let meeting = opposite.sin() / sine;
                if is_triangle && theta0.abs().min(theta1.abs()) > 1e-8 {
                    assert!(kept[i] < meeting, "{theta0} {theta1}");
                    assert!(kept[i] == free[i] || kept[i] > 0.999 * meeting);
                } else {
                    assert!(kept[i] <= free[i]);
                }
            }
        }
    }
}

#[test]
fn what_is_out_of_range_is_ignored_and_named() {
    let spline = catalog::spline("hobby").unwrap();
    let points = [(0.0, 0.0), (50.0, 70.0), (100.0, 0.0), (140.0, 60.0)];
    let plain = solve(&Contour::open(points), &*spline).unwrap();
    let mut contour = Contour::open(points);
    contour.knots[0].curl = Some(-1.0);
    contour.knots[1].tension_in = Some(0.5);
    contour.knots[2].tension_out = Some(-1e300);
    contour.knots[3].curvature_in = Some(1.0);
    // Beyond an end there is nothing, and at other knots a curl means nothing.
    contour.knots[3].tension_out = Some(0.1);
    contour.knots[2].curl = Some(-3.0);
    let solution = solve(&contour, &*spline).unwrap();
    assert_eq!(solution.curve.segments().len(), plain.curve.segments().len());
    for (a, b) in solution.knots.iter().zip(&plain.knots) {
        assert_eq!(a, b);
    }
    let adapted: Vec<_> = solution
        .report
        .adapted
        .iter()
        .map(|adaptation| (adaptation.place, adaptation.asked, adaptation.got))
        .collect();
    assert_eq!(
        adapted,
        [
            (Place::Knot(0), "curl", "ignored"),
            (Place::Knot(1), "tension", "ignored"),
            (Place::Knot(2), "tension", "ignored"),
            (Place::Knot(3), "curvature", "ignored"),
        ]
    );
    assert_eq!(solution.report.status(), Status::Solved);
}

#[test]
fn parameters_stand_in_for_what_knots_lack() {
    let points = [(0.0, 0.0), (50.0, 70.0), (100.0, 0.0), (140.0, 60.0)];
    let given = Contour::open(points.map(|point| Knot {
        tension_in: Some(-1.3),
        tension_out: Some(-1.3),
        curl: Some(2.0),
        ..Knot::new(point)
    }));
    let params = Params::new().with("tension", -1.3).with("curl", 2.0);
    let by_params = solve(&Contour::open(points), &*catalog::build("hobby", &params).unwrap());
    let by_knots = solve(&given, &*catalog::spline("hobby").unwrap());
    assert_eq!(by_params.unwrap().knots, by_knots.unwrap().knots);
    for tension in [0.0, 0.7, -0.5] {
        let params = Params::new().with("tension", tension);
        let error = catalog::build("hobby", &params).unwrap_err();
        assert!(matches!(error, CatalogError::BadValue { .. }));
        assert!(error.hint().contains("0.75"), "{}", error.hint());
    }
}

/// The ripple of thesis 2.6: a knot pushed out of a straight row.
#[test]
fn a_ripple_shrinks_by_two_minus_the_root_of_three() {
    let push = 1e-6;
    let points: Vec<_> =
        (0..41).map(|i| (f64::from(i), if i == 20 { push } else { 0.0 })).collect();
    let solution = solve(&Contour::open(points), &*catalog::spline("hobby").unwrap()).unwrap();
    let direction = |i: usize| solution.knots[i].direction_in.unwrap();
    for i in 22..28 {
        let ratio = -direction(i + 1) / direction(i);
        assert!((ratio - (2.0 - 3f64.sqrt())).abs() < 1e-6, "{i}: {ratio}");
    }
}
