//! Contours that once broke a promise, found by the targets in `fuzz/`; each test says which.

use faircurve::convert::to_bezpath;
use faircurve::kurbo::{PathEl, Point};
use faircurve::{Contour, Join, Knot, Segment, Solution, catalog, solve};

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
