//! Contours that once broke a promise, found by the targets in `fuzz/`; each test says which.

use faircurve::catalog::{self, Params};
use faircurve::convert::to_bezpath;
use faircurve::kurbo::{PathEl, Point};
use faircurve::{Contour, InputError, Join, Knot, Place, Segment, Solution, solve};

fn solved(spline: &str, contour: &Contour) -> Solution {
    solve(contour, &*catalog::spline(spline).unwrap()).unwrap()
}

/// How far apart the two halves of a segment are in its middle, where they meet: points are
/// measured from the nearer end.
fn tear(segment: &Segment) -> f64 {
    let middle = segment.length() / 2.0;
    (segment.point(middle) - segment.point(middle * (1.0 - 1e-12))).hypot()
}

/// The length of a chord of 1e-321 is rounded to 0.
#[test]
fn beziers_meet_knots_at_a_distance_too_small_to_measure() {
    let knots = [(0.0, -1.0), (1e-321, 0.0), (0.0, 0.0)];
    let contour = Contour::closed(knots.map(|point| Knot::new(point).join(Join::Corner)));
    let path = to_bezpath(&solved("spiro", &contour).curve, 1e-3);
    for (x, y) in knots {
        let meets = |element: &PathEl| element.end_point() == Some(Point::new(x, y));
        assert!(path.elements().iter().any(meets), "{path:?}");
    }
}

/// In a drawing of 1e19 units, knots some units apart are one; the segment that leaves them starts
/// at the last of them, though it was solved from the first.
#[test]
fn segments_beside_merged_knots_are_whole() {
    let contour = Contour::closed([
        (107.0, 0.5),
        (0.0, 9e18),
        (-3337.0, -23807.0),
        (45.0, 41.0),
        (3.0, 0.0),
        (0.0, 0.0),
    ]);
    for spline in ["spiro", "euler"] {
        for segment in solved(spline, &contour).curve.segments() {
            assert!(tear(segment) <= 1e-9 * segment.length(), "{spline}: {segment:?}");
        }
    }
}

/// Each of these knots is within rounding of the one before, but together they come back to where
/// they started.
#[test]
fn a_chain_of_near_knots_leaves_no_chord_of_length_zero() {
    let near = |steps: u32| 1.0 + f64::from(steps) * f64::EPSILON;
    let xs = [near(0), near(60), near(120), near(0)];
    let knots = xs.map(|x| (x, 0.0)).into_iter().chain([(3.0, 1.0), (2.0, 4.0)]);
    let contour = Contour::closed(knots);
    for spline in ["spiro", "euler"] {
        let solution = solved(spline, &contour);
        assert!(solution.report.relaxed.is_empty(), "{spline}: {:?}", solution.report);
        for segment in solution.curve.segments() {
            assert!(segment.length().is_finite() && segment.length() < 30.0, "{segment:?}");
        }
    }
}

/// Two straight segments that turn back at a smooth knot: there is no such curve.
#[test]
fn a_knot_at_which_the_curve_turns_back_is_not_called_smooth() {
    let contour = Contour::open([
        Knot::new((0.0, 0.0)),
        Knot::new((10.0, 0.0)).join(Join::CurveToTerminal),
        Knot::new((5.0, 0.0)).join(Join::Corner),
    ]);
    let solution = solved("spiro", &contour);
    assert_eq!(solution.knots[1].join, Join::Corner, "{:?}", solution.report);
}

/// What can't be met here is a curvature at a knot that is g1 already.
#[test]
fn nothing_is_relaxed_to_itself() {
    let contour = Contour::closed([
        Knot::new((0.0, 0.0)).join(Join::Corner),
        Knot::new((10.0, -1.5)).join(Join::G4),
        Knot::new((20.25, 100.0)).join(Join::G2),
        Knot::new((30.0, 5.0)).join(Join::CurveToTerminal),
        Knot::new((40.0, 5.0)).join(Join::TerminalToCurve),
        Knot::new((50.0, 5.0))
            .join(Join::G1)
            .tangent((3.0, -4.0))
            .curvature_in(0.0)
            .curvature_out(0.0),
    ]);
    for relaxed in solved("spiro", &contour).report.relaxed {
        assert_ne!(relaxed.asked, relaxed.got, "{relaxed:?}");
    }
}

/// Drawn with a shape that promises a tangent only, a knot whose equation isn't met is smooth all the
/// same: what it lacks is the spline's own condition.
#[test]
fn a_tangent_that_the_rule_did_not_give_is_not_relaxed_to_itself() {
    let contour = Contour::open([
        Knot::new((1.221_015_077_810_775_5e26, 114.0)).tangent_out((1e-18, 1e-18)),
        Knot::new((0.0, 0.0)),
        Knot::new((2.289_403_270_895_204e26, 213.75)),
        Knot::new((30.0, -13670.0)),
    ]);
    let spline = catalog::build("circle", &Params::new().with("shape", "hobby")).unwrap();
    let relaxed = solve(&contour, &*spline).unwrap().report.relaxed;
    assert!(!relaxed.is_empty());
    for relaxed in relaxed {
        assert_ne!(relaxed.asked, relaxed.got, "{relaxed:?}");
    }
}

/// A lone Euler spiral whose curvature at a corner can't be met.
#[test]
fn corners_stay_corners() {
    let contour = Contour::closed([
        Knot::new((119.0, -546.0))
            .join(Join::Corner)
            .tangent_out((117.0, 91.0))
            .curvature_in(0.063)
            .curvature_out(0.063),
        Knot::new((0.0, 0.0)).join(Join::Corner),
    ]);
    let solution = solved("euler", &contour);
    assert_eq!(solution.knots[0].join, Join::Corner, "{:?}", solution.report);
}

/// An Euler spiral has no room for a curvature beside a tangent.
#[test]
fn a_curvature_of_zero_is_met_or_listed() {
    let knot = Knot::new((0.0, 90.0)).tangent_out((-60.0, 0.0)).curvature_out(0.0);
    let solution = solved("euler", &Contour::open([knot, Knot::new((0.0, 0.0))]));
    let is_met = solution.knots[0].curvature_out.is_some_and(|k| k.abs() < 1e-9);
    let is_listed = solution.report.adapted.iter().any(|a| a.place == Place::Knot(0));
    assert!(is_met || is_listed, "{solution:?}");
}

/// The product of this curvature with the chord is beyond the range of numbers; it was called met.
#[test]
fn curvatures_beyond_all_numbers_are_refused() {
    for curvature in [2.9e306, -9e290, 1e70] {
        let knot = Knot::new((-397309.7, 0.0)).curvature_out(curvature);
        let contour = Contour::open([knot, Knot::new((0.0, -7.5e24))]);
        for spline in ["spiro", "euler"] {
            let error = solve(&contour, &*catalog::spline(spline).unwrap()).unwrap_err();
            assert_eq!(error, InputError::CurvatureTooLarge { knot: 0, what: "curvature_out" });
        }
    }
}
