//! Curves as Béziers (thesis chapter 9).

mod certificate;
mod contact;
mod cuts;
mod fit_source;
mod fitter;
mod free_joints;
mod grid;
mod metric;
mod minimax;
mod options;
mod piece;
mod series;
mod single;
#[cfg(test)]
mod tests;
mod tuning;

use kurbo::{BezPath, CubicBez, PathSeg};

use crate::curve::Curve;
use crate::numeric::order::sort_by;
use crate::numeric::trig::unit_vector;
use crate::segment::{Segment, Shape};
use crate::tolerance::SOLVED;

use fitter::Fitter;
use piece::{Shift, Stretch};

pub use options::{Cuts, Fit, Metric, Options};

/// A curve as Béziers, and how near to it they are.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Conversion {
    /// The Béziers.
    pub path: BezPath,
    /// An upper bound of the distance of every point of the path from the curve and of every point of the
    /// curve from the path, in the drawing's units. On spirals it is within a percent of the truth where it is more than a
    /// quarter of the accuracy, and always with [`Cuts::EqualErrors`] and [`Cuts::Balanced`].
    pub bound: f64,
    /// The largest error of a cubic in the metric's units; for [`Metric::Distance`] that is `bound`.
    pub error: f64,
    /// How many cubics there are.
    pub cubics: usize,
    /// How many straight lines.
    pub lines: usize,
    /// How many quadratics: of curves that are made of them, such as κ-curves.
    pub quadratics: usize,
}

impl Conversion {
    /// A segment that is a Bézier passes through untouched; one of length 0 leaves no trace.
    fn append_exact(&mut self, bezier: PathSeg) {
        match bezier {
            PathSeg::Line(line) if line.p0 == line.p1 => return,
            PathSeg::Line(_) => self.lines += 1,
            PathSeg::Quad(_) => self.quadratics += 1,
            PathSeg::Cubic(_) => self.cubics += 1,
        }
        self.path.push(bezier.as_path_el());
    }
}

/// The curve as straight lines and cubic Béziers that deviate from it by at most `accuracy`, in user
/// units, or as little as can be proved if that is less ([`Options::accuracy`]).
///
/// Knots are end points of Béziers, bit for bit; tangents there are those of the curve; segments
/// that are Béziers pass through untouched; straight segments are lines; segments that end where they start leave no trace; a closed curve ends on its start and
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
    let Some(first) = curve.start() else {
        return result;
    };
    result.path.move_to(first);
    // The arc length at which a stretch starts, and how many segments that counts.
    let (mut start, mut counted) = (0.0, 0);
    let segments = simple_segments(curve);
    let mut i = 0;
    while i < segments.len() {
        if let Some(exact) = segments[i].beziers() {
            exact.into_iter().for_each(|bezier| result.append_exact(bezier));
            i += 1;
            continue;
        }
        let mut end = i + 1;
        if options.span_knots {
            while end < segments.len()
                && segments[end].beziers().is_none()
                && joins_smoothly(&segments[end - 1], &segments[end])
            {
                end += 1;
            }
        }
        start += segments[counted..i].iter().map(Segment::length).sum::<f64>();
        counted = i;
        append_stretch(&mut result, &segments[i..end], start, options);
        i = end;
    }
    if curve.is_closed() {
        result.path.close_path();
    }
    result
}

/// The segments of a curve, those of chains each by itself.
fn simple_segments(curve: &Curve) -> Vec<Segment> {
    fn append(segment: &Segment, all: &mut Vec<Segment>) {
        match segment.shape() {
            Shape::Chain(members) => members.iter().for_each(|member| append(member, all)),
            _ => all.push(segment.clone()),
        }
    }
    let mut all = Vec::with_capacity(curve.segments().len());
    curve.segments().iter().for_each(|segment| append(segment, &mut all));
    all
}

/// Whether the direction is continuous from one segment to the next.
fn joins_smoothly(before: &Segment, after: &Segment) -> bool {
    let turn = after.direction(0.0) - before.direction(before.length());
    let turned = unit_vector(turn);
    turned.im.abs() <= SOLVED && turned.re > 0.0
}

/// `start`: the arc length of the curve at which the stretch starts.
fn append_stretch(result: &mut Conversion, segments: &[Segment], start: f64, options: &Options) {
    /// Finer is rounding, as a part of the length, and in multiples of what rounding is allowed for.
    const FINEST: f64 = 1e-12;
    const ROUNDINGS: f64 = 4.0;
    /// As a part of the length, where segments don't answer for the derivatives of their curvature: the
    /// certificate takes as many parts as the accuracy's inverse root, and finer takes minutes.
    const FINEST_BY_CURVATURE: f64 = 1e-8;
    let stretch = Stretch::new(segments);
    let are_smooth = segments.iter().all(|segment| {
        segment.curvature_bounds(0.0, segment.length()).into_iter().all(|bound| bound < f64::MAX)
    });
    let part = if are_smooth { FINEST } else { FINEST_BY_CURVATURE };
    let finest = part * stretch.length() + ROUNDINGS * certificate::rounding_of(segments);
    let accuracy = if options.accuracy > finest { options.accuracy } else { finest };
    let fitter = Fitter {
        stretch: &stretch,
        metric: options.metric,
        fit: options.fit,
        accuracy,
        // The others compare errors.
        is_thorough: !matches!(options.cuts, Cuts::Greedy | Cuts::Halving | Cuts::HalvingBend),
        shifts: [Shift::NONE; 2],
    };
    let places = stretch_places(&stretch, start, options);
    let is_free =
        options.free_joints && options.metric == Metric::Distance && options.fit == Fit::Optimal;
    let between = places.windows(2).flat_map(|pair| match is_free {
        true => free_joints::cut(&fitter, pair[0], pair[1]),
        false => cuts::cut(&fitter, options.cuts, pair[0], pair[1]),
    });
    for cubic in between {
        let placed = fitter.place(&cubic);
        result.path.curve_to(placed.p1, placed.p2, placed.p3);
        result.bound = result.bound.max(cubic.bound);
        result.error = result.error.max(cubic.error);
        result.cubics += 1;
    }
}

/// One cubic for a whole segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingleFit {
    /// The cubic, with the segment's ends and end tangents.
    pub cubic: CubicBez,
    /// Its error in the metric's units: for [`Metric::Distance`] an upper bound, else computed as accurately as the metric
    /// says.
    pub error: f64,
}

/// One cubic for a whole segment, however far from it (thesis sections 9.3 to 9.5). A straight
/// line has arms of a third of its length; a segment that is one Bézier is its own best cubic.
pub fn fit_single(segment: &Segment, metric: Metric, fit: Fit) -> SingleFit {
    if segment.is_line() || !(segment.length() > 0.0) {
        let (start, end) = (segment.start(), segment.end());
        let cubic =
            CubicBez::new(start, start.lerp(end, 1.0 / 3.0), start.lerp(end, 2.0 / 3.0), end);
        return SingleFit { cubic, error: 0.0 };
    }
    if let (Fit::Optimal | Fit::EndCurvature, Some([own])) = (fit, segment.beziers().as_deref()) {
        return SingleFit { cubic: own.to_cubic(), error: 0.0 };
    }
    let all = std::slice::from_ref(segment);
    let stretch = Stretch::new(all);
    let fitter = Fitter {
        stretch: &stretch,
        metric,
        fit,
        accuracy: f64::INFINITY,
        is_thorough: true,
        shifts: [Shift::NONE; 2],
    };
    let cubic = fitter.certify(&fitter.try_piece(0.0, stretch.length()));
    SingleFit { cubic: fitter.place(&cubic), error: cubic.error }
}

/// All local minima of an angle metric among the cubics for a segment that have its ends, end tangents and arc
/// length, by ascending share of the first arm in both (thesis section 9.5). As many as a scan in steps of 1/64 tells
/// apart; empty for lines and for [`Metric::Distance`].
pub fn local_minima(segment: &Segment, metric: Metric) -> Vec<SingleFit> {
    if segment.is_line() || !(segment.length() > 0.0) || metric == Metric::Distance {
        return Vec::new();
    }
    let stretch = Stretch::new(std::slice::from_ref(segment));
    let piece = stretch.piece(0.0, stretch.length());
    let (from, to) = (stretch.joint(0.0), stretch.joint(stretch.length()));
    single::all_minima(&stretch, &piece, metric)
        .into_iter()
        .map(|minimum| {
            let [a, b] = minimum.arms.map(|arm| arm * piece.half);
            let (p1, p2) = (from.point + from.tangent * a, to.point - to.tangent * b);
            let cubic = CubicBez::new(from.point, p1, p2, to.point);
            SingleFit { cubic, error: minimum.error }
        })
        .collect()
}

/// Where a stretch must be cut, its ends included, ascending.
fn stretch_places(stretch: &Stretch<'_>, start: f64, options: &Options) -> Vec<f64> {
    /// Places nearer to each other than this part of the stretch are one.
    const SAME: f64 = 1e-9;
    let length = stretch.length();
    let mut places = vec![0.0];
    for (index, segment) in stretch.segments().iter().enumerate() {
        let offset = stretch.start_of(index);
        if options.at_extrema {
            places.extend(segment.axis_extrema().into_iter().map(|s| offset + s));
        }
        if options.at_inflections {
            places.extend(segment.inflections().into_iter().map(|s| offset + s));
        }
    }
    places.extend(options.at.iter().map(|s| s - start));
    places.retain(|s| *s == 0.0 || (*s > SAME * length && *s < (1.0 - SAME) * length));
    sort_by(&mut places, f64::total_cmp);
    places.dedup_by(|b, a| *b - *a <= SAME * length);
    places.push(length);
    places
}
