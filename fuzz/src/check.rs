//! What holds of every solution and of its Béziers, whatever the numbers.

use faircurve::convert::{Options, convert};
use faircurve::kurbo::{BezPath, ParamCurve, PathEl, PathSeg, Point, Rect};
use faircurve::tolerance::SOLVED;
use faircurve::{Contour, Curve, CurvePoint, Place, Segment, Solution, Status};

use crate::judge;

/// Every number is finite, every query is answered, every knot is met, and `solved` is true.
pub fn solution(contour: &Contour, solution: &Solution) {
    segments(contour, &solution.curve);
    curve(&solution.curve);
    knots(contour, solution);
    report(contour, solution);
    // Curves that rounding distorts prove nothing.
    if judge::is_ordinary(contour) {
        let (violation, what) = judge::violation(contour, solution);
        assert!(
            violation <= judge::BOUND,
            "{what}: violated by {violation:e}, while the report says {:e}",
            solution.report.residual
        );
    }
}

fn finite(what: &str, numbers: impl IntoIterator<Item = f64>) {
    for number in numbers {
        assert!(number.is_finite(), "{what}: {number}");
    }
}

fn finite_point(what: &str, at: CurvePoint) {
    finite(what, [at.point.x, at.point.y, at.direction, at.curvature]);
}

fn finite_box(what: &str, bounds: Rect) {
    finite(what, [bounds.x0, bounds.y0, bounds.x1, bounds.y1]);
}

/// Segments end on the knots to the bit, and answer every question with finite numbers.
fn segments(contour: &Contour, curve: &Curve) {
    let (knots, segments) = (&contour.knots, curve.segments());
    assert_eq!(
        segments.len(),
        if knots.len() == 1 && !contour.closed { 0 } else { contour.segment_count() }
    );
    assert_eq!(curve.is_closed(), contour.closed);
    assert_eq!(curve.start(), Some(knots[0].point));
    for (i, segment) in segments.iter().enumerate() {
        assert_eq!(segment.start(), knots[i].point, "segment {i} starts at its knot");
        assert_eq!(
            segment.end(),
            knots[(i + 1) % knots.len()].point,
            "segment {i} ends at its knot"
        );
        self::segment(segment);
    }
}

fn segment(segment: &Segment) {
    /// As a part of the length: what points between the ends may be off by.
    const ROUNDING: f64 = 1e-9;
    let length = segment.length();
    finite("length", [length, segment.bending_energy(), segment.variation_energy()]);
    finite("kappa", segment.kappa().unwrap_or_default());
    finite_box("box of a segment", segment.bounding_box());
    assert!(
        segment.chord_length() <= length * (1.0 + ROUNDING),
        "a chord is no longer than its arc"
    );
    let size = largest_coordinate(segment.start()).max(largest_coordinate(segment.end()));
    let close = ROUNDING * (length + size);
    for s in [-1.0, 0.0, 0.25, 0.5, 1.0, 2.0].map(|along| along * length) {
        finite_point("a place on a segment", segment.at(s));
        finite("derivatives of curvature", segment.curvature_jet(s.clamp(0.0, length)));
    }
    // Points are measured from the nearer end: both ways meet in the middle.
    let [before, after] = [0.5 - ROUNDING / 8.0, 0.5].map(|along| segment.point(along * length));
    assert!((after - before).hypot() <= close, "a segment is torn: {before} {after}");
    for (what, places) in [
        ("inflections", segment.inflections()),
        ("curvature extrema", segment.curvature_extrema()),
        ("axis extrema", segment.axis_extrema()),
    ] {
        assert!(places.iter().all(|s| (0.0..=length).contains(s)), "{what}: {places:?}");
        assert!(places.is_sorted(), "{what}: {places:?}");
    }
}

/// The curve as a whole answers every question.
fn curve(curve: &Curve) {
    let length = curve.length();
    finite("length and energies", [length, curve.bending_energy(), curve.variation_energy()]);
    let bounds = curve.bounding_box().expect("a curve has a point");
    finite_box("bounding box", bounds);
    for s in [f64::NEG_INFINITY, -1.0, 0.0, 0.3, 0.5, 1.0, 1.5, f64::INFINITY, f64::NAN] {
        if let Some(at) = curve.at(s * length) {
            finite_point("a place on the curve", at);
            let rounding = 1e-9 * (length + largest_coordinate(at.point));
            let box_of_both = bounds.union_pt(at.point);
            let outside = (box_of_both.size() - bounds.size()).max_side();
            assert!(outside <= rounding, "the box doesn't hold {}", at.point);
        }
    }
    let nearest = curve.nearest(bounds.center(), 1e-3 * length);
    if let Some((segment, s, distance)) = nearest {
        finite("nearest point", [s, distance]);
        assert!((0.0..=curve.segments()[segment].length()).contains(&s), "nearest point: {s}");
    }
}

fn knots(contour: &Contour, solution: &Solution) {
    assert_eq!(solution.knots.len(), contour.knots.len());
    for (knot, solved) in contour.knots.iter().zip(&solution.knots) {
        assert_eq!(knot.point, solved.point);
        let directions = [solved.direction_in, solved.direction_out];
        for direction in directions.into_iter().flatten() {
            assert!(direction.abs() <= std::f64::consts::PI, "direction at a knot: {direction}");
        }
        finite(
            "curvature at a knot",
            [solved.curvature_in, solved.curvature_out].into_iter().flatten(),
        );
    }
}

/// The status, the residual and the places agree with each other and with the contour.
fn report(contour: &Contour, solution: &Solution) {
    let report = &solution.report;
    assert!(report.residual >= 0.0 && report.residual.is_finite(), "residual {}", report.residual);
    assert_eq!(report.status() == Status::Solved, report.relaxed.is_empty());
    if report.status() == Status::Solved {
        assert!(report.residual <= SOLVED, "solved with residual {:e}", report.residual);
    }
    let places = report.relaxed.iter().map(|relaxed| relaxed.place);
    for place in places.chain(report.adapted.iter().map(|adapted| adapted.place)) {
        let is_there = match place {
            Place::Knot(knot) => knot < contour.knots.len(),
            Place::Segment(segment) => segment < contour.segment_count(),
        };
        assert!(is_there, "the report speaks of {place}");
    }
    for relaxed in &report.relaxed {
        assert_ne!(relaxed.asked, relaxed.got, "relaxed to the same");
        assert!(!relaxed.reason.is_empty());
    }
}

/// The path is finite, runs through the knots, is no longer than it may be, and is as near as its bound says; so
/// are conversions of other kinds.
pub fn beziers(contour: &Contour, curve: &Curve, options: &Options) {
    /// What the conversion says a segment may become at most, and as much again for cuts that are asked for.
    const MOST_PIECES: usize = 2 * 4096;
    let conversion = convert(curve, options);
    let path = &conversion.path;
    finite_path(path);
    finite("bound and error", [conversion.bound, conversion.error]);
    let elements = path.elements();
    assert!(elements.len() <= 2 + MOST_PIECES * contour.segment_count(), "{}", elements.len());
    let segments = conversion.cubics + conversion.quadratics + conversion.lines;
    assert_eq!(elements.len(), 1 + segments + usize::from(contour.closed));
    assert_eq!(elements.first(), Some(&PathEl::MoveTo(contour.knots[0].point)));
    assert_eq!(elements.last() == Some(&PathEl::ClosePath), contour.closed);
    if !options.span_knots {
        // The knots are among the ends, in order.
        let mut ends = elements.iter().filter_map(PathEl::end_point);
        let around = contour.closed.then_some(&contour.knots[0]);
        let mut last = None;
        for knot in contour.knots.iter().chain(around) {
            // Segments of length 0 leave no trace.
            if last != Some(knot.point) {
                assert!(ends.any(|end| end == knot.point), "the path misses {}", knot.point);
                last = Some(knot.point);
            }
        }
    }
    deviation(curve, path, conversion.bound);
}

/// All of a path's coordinates.
pub fn finite_path(path: &BezPath) {
    assert!(path.is_finite(), "the path has a number that isn't finite");
}

/// Béziers are as near to the curve as the bound says.
fn deviation(curve: &Curve, path: &BezPath, bound: f64) {
    /// Beyond this, finding nearest points takes longer than everything else.
    const MOST_CUBICS: usize = 24;
    let Some(bounds) = curve.bounding_box() else { return };
    let size = bounds.width().max(bounds.height()).max(largest_coordinate(bounds.center()));
    let length = curve.length();
    let kappa = curve.segments().iter().filter_map(Segment::kappa).flatten();
    let largest_kappa = kappa.fold(0.0f64, |a, k| a.max(k.abs()));
    // Nearest points are no better than this.
    let resolution = 1e-11 * (size + length);
    if largest_kappa > 1e3 {
        return;
    }
    let is_cubic = |segment: &PathSeg| matches!(segment, PathSeg::Cubic(_));
    for cubic in path.segments().filter(is_cubic).take(MOST_CUBICS) {
        for t in [0.15, 0.5, 0.85] {
            let nearest = curve.nearest(cubic.eval(t), 0.01 * bound + resolution);
            let (_, _, off) = nearest.expect("a curve with a Bézier has segments");
            assert!(
                off <= 1.01 * bound + 2.0 * resolution,
                "a Bézier is off by {off:e}, not {bound:e}"
            );
        }
    }
}

fn largest_coordinate(point: Point) -> f64 {
    point.x.abs().max(point.y.abs())
}
