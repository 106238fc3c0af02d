//! Curves as Béziers (thesis chapter 9).

mod cubic_fit;

use kurbo::{BezPath, PathSeg};

use crate::curve::Curve;
use crate::segment::{Segment, Shape};

/// The curve as straight lines and cubic Béziers that deviate from it by at most `accuracy`, in user
/// units.
///
/// Knots are end points of Béziers, bit for bit; tangents there are those of the curve; segments
/// that are Béziers pass through untouched; straight segments are lines; segments that end where they start leave no trace; a closed curve ends on its start and
/// closes its path. An empty curve is an empty path.
///
/// The deviation is checked at 16 places of each Bézier with a margin, not proved. Accuracies below
/// 1e-12 of a segment's arc length, zero and NaN count as that.
///
/// ```
/// use faircurve::{Contour, catalog, convert::to_bezpath, solve};
/// let circle = Contour::closed([(100.0, 0.0), (0.0, 100.0), (-100.0, 0.0)]);
/// let solution = solve(&circle, &*catalog::spline("euler")?)?;
/// let path = to_bezpath(&solution.curve, 0.01);
/// assert!((kurbo::Shape::area(&path).abs() - 31415.9).abs() < 5.0);
/// # use faircurve::kurbo;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn to_bezpath(curve: &Curve, accuracy: f64) -> BezPath {
    let mut path = BezPath::new();
    let Some(start) = curve.start() else {
        return path;
    };
    path.move_to(start);
    for segment in curve.segments() {
        append_segment(&mut path, segment, accuracy);
    }
    if curve.is_closed() {
        path.close_path();
    }
    path
}

fn append_segment(path: &mut BezPath, segment: &Segment, accuracy: f64) {
    if segment.is_line() {
        // The length of the very smallest is rounded to 0.
        if segment.start() != segment.end() {
            path.line_to(segment.end());
        }
        return;
    }
    if let Shape::Chain(members) = segment.shape() {
        members.iter().for_each(|member| append_segment(path, member, accuracy));
    } else if let Some(beziers) = segment.beziers() {
        path.extend(beziers.iter().map(PathSeg::as_path_el));
    } else {
        for cubic in cubic_fit::cubics(segment, accuracy) {
            path.curve_to(cubic.p1, cubic.p2, cubic.p3);
        }
    }
}
