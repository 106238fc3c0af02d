//! Curves as Béziers (thesis chapter 9).

mod certificate;
mod contact;
mod cuts;
mod fitter;
mod minimax;
mod options;
mod piece;
mod series;

use kurbo::BezPath;

use crate::curve::Curve;
use crate::segment::Segment;

use fitter::Fitter;
use piece::Stretch;

pub use options::{Cuts, Fit, Metric, Options};

/// A curve as Béziers, and how near to it they are.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Conversion {
    /// The Béziers.
    pub path: BezPath,
    /// An upper bound of the distance of every point of the path from the curve and of every point of the
    /// curve from the path, in the drawing's units.
    pub bound: f64,
    /// The largest error of a cubic in the metric's units; for [`Metric::Distance`] that is `bound`.
    pub error: f64,
    /// How many cubics there are.
    pub cubics: usize,
    /// How many straight lines.
    pub lines: usize,
}

/// The curve as straight lines and cubic Béziers that deviate from it by at most `accuracy`, in user
/// units.
///
/// Knots are end points of Béziers, bit for bit; tangents there are those of the curve; straight
/// segments are lines; segments that end where they start leave no trace; a closed curve ends on its start and
/// closes its path. An empty curve is an empty path.
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
    convert(curve, &Options::new(accuracy)).path
}

/// The curve as straight lines and cubic Béziers, as the options say.
pub fn convert(curve: &Curve, options: &Options) -> Conversion {
    let mut result = Conversion::default();
    let Some(start) = curve.start() else {
        return result;
    };
    result.path.move_to(start);
    let segments = curve.segments();
    let mut i = 0;
    while i < segments.len() {
        if segments[i].is_line() {
            if segments[i].start() != segments[i].end() {
                result.path.line_to(segments[i].end());
                result.lines += 1;
            }
            i += 1;
            continue;
        }
        let mut end = i + 1;
        if options.span_knots {
            while end < segments.len() && is_smooth(&segments[end - 1], &segments[end]) {
                end += 1;
            }
        }
        append_stretch(&mut result, &segments[i..end], options);
        i = end;
    }
    if curve.is_closed() {
        result.path.close_path();
    }
    result
}

fn is_smooth(before: &Segment, after: &Segment) -> bool {
    let turn = after.direction(0.0) - before.direction(before.length());
    !after.is_line() && turn.sin().abs() < 1e-9 && turn.cos() > 0.0
}

fn append_stretch(result: &mut Conversion, segments: &[Segment], options: &Options) {
    const FINEST: f64 = 1e-12;
    let stretch = Stretch::new(segments);
    let finest = FINEST * stretch.length();
    let accuracy = if options.accuracy > finest { options.accuracy } else { finest };
    let fitter =
        Fitter { stretch: &stretch, metric: options.metric, fit: options.fit, accuracy };
    let cubics = cuts::greedy(&fitter, 0.0, stretch.length());
    for cubic in &cubics {
        let placed = fitter.place(cubic);
        result.path.curve_to(placed.p1, placed.p2, placed.p3);
        result.bound = result.bound.max(cubic.bound);
        result.error = result.error.max(cubic.error);
        result.cubics += 1;
    }
}

#[cfg(test)]
mod explore {
    use super::*;
    use crate::segment::PolynomialSpiral;
    use kurbo::{Point, Vec2};

    fn of(c: [f64; 4]) -> Segment {
        let m = 0.5;
        let k = [
            c[0] + m * (c[1] + m * (c[2] + m * c[3])),
            c[1] + m * (2.0 * c[2] + m * 3.0 * c[3]),
            2.0 * c[2] + 6.0 * m * c[3],
            6.0 * c[3],
        ];
        let spiral = PolynomialSpiral::new(k);
        let end = Point::ZERO + Vec2::from_angle(0.3) * 1000.0 * spiral.chord().length;
        Segment::spiral(Point::ZERO, end, spiral)
    }

    #[test]
    #[ignore]
    fn profile() {
        for (c, from) in [([-6.0, 12.0, 0.0, 0.0], 0.0), ([1.0, 8.0, -20.0, 16.0], 0.0), ([0.0, 2.4, 0.0, 0.0], 0.0),([0.0, 28.27, 0.0, 0.0], 0.0)] {
            let segment = of(c);
            let all = [segment];
            let stretch = Stretch::new(&all);
            let fitter = Fitter { stretch: &stretch, metric: Metric::Distance, fit: Fit::Optimal, accuracy: 0.1 };
            println!("{c:?}");
            let mut last = 0.0f64;
            for i in 1..=50 {
                let to = from + (1000.0 - from) * f64::from(i) / 50.0;
                let candidate = fitter.try_piece(from, to);
                let bound = fitter.certify(&candidate).bound;
                let slope = (candidate.error / last).ln() / (f64::from(i) / f64::from(i - 1)).ln();
                last = candidate.error;
                let starts = contact::expansions(candidate.piece.series.unwrap().kappa);
                let e6: Vec<f64> = starts.as_slice().iter().map(|s| s.e6 * candidate.piece.half * 0.1059).collect();
                println!("{to:6.0} {:10.3e} bound/est {:.4} slope {slope:5.1} arms {:.3?} e6 {e6:.4?}", candidate.error, bound / candidate.error, candidate.arms.arms);
            }
        }
    }

    #[test]
    #[ignore]
    fn trace() {
        for (c, acc) in [([0.0, 2.4, 0.0, 0.0], 1e-5), ([-6.0, 12.0, 0.0, 0.0], 1e-5), ([1.0, 8.0, -20.0, 16.0],1e-5)] {
            let all = [of(c)];
            let stretch = Stretch::new(&all);
            let fitter = Fitter { stretch: &stretch, metric: Metric::Distance, fit: Fit::Optimal, accuracy: acc };
            println!("{c:?}");
            for cubic in cuts::greedy(&fitter, 0.0, stretch.length()) {
                println!("  == {:.3} {:.3} err {:.4}", cubic.from, cubic.to, cubic.error / acc);
            }
        }
    }
}
