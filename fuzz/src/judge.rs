//! Whether the joins that a solution states hold, from its segments alone.
//!
//! Dimensionless, as defined at [`SolveReport::residual`](faircurve::SolveReport::residual), but read off
//! the finished curve in user units.

use faircurve::frame::{direction, wrap_angle};
use faircurve::{Contour, Join, Place, Segment, Solution};

/// More than this is no rounding error, on [ordinary](is_ordinary) contours. The library promises a
/// thousandth of it.
pub const BOUND: f64 = 1e-6;

/// Whether rounding is small beside everything in the contour: the shortest chord, the largest
/// coordinate and the sharpest curvature given are within some powers of ten of each other.
pub fn is_ordinary(contour: &Contour) -> bool {
    const RANGE: f64 = 1e4;
    let points = contour.knots.iter().map(|knot| knot.point);
    let largest = points.fold(0.0f64, |a, p| a.max(p.x.abs()).max(p.y.abs()));
    let chords = chords(contour).filter(|chord| *chord != 0.0);
    let shortest = chords.fold(f64::INFINITY, f64::min);
    let curvatures =
        contour.knots.iter().flat_map(|knot| [knot.curvature_in, knot.curvature_out]).flatten();
    largest <= RANGE * shortest
        && curvatures.into_iter().all(|k| k.abs() * shortest <= RANGE.sqrt())
}

fn chords(contour: &Contour) -> impl Iterator<Item = f64> {
    let next = |i: usize| contour.knots[(i + 1) % contour.knots.len()].point;
    (0..contour.segment_count()).map(move |i| (next(i) - contour.knots[i].point).hypot())
}

/// The most violated of what is given and of what the joins at the knots require, in words.
pub fn violation(contour: &Contour, solution: &Solution) -> (f64, String) {
    let (n, report) = (contour.knots.len(), &solution.report);
    // Segments with a chord; knots in one place are one knot between two of these.
    let segments: Vec<(usize, &Segment)> = solution
        .curve
        .segments()
        .iter()
        .enumerate()
        .filter(|(_, segment)| segment.chord_length() > 0.0)
        .collect();
    let mut worst = (0.0, "nothing".to_owned());
    let mut require = |knot: usize, what: &str, violation: f64| {
        let violation = if violation.is_finite() { violation.abs() } else { f64::INFINITY };
        if violation > worst.0 {
            worst = (violation, format!("{what} at knot {knot}"));
        }
    };
    let pairs = segments.iter().zip(segments.iter().cycle().skip(1));
    let inner = segments.len().saturating_sub(usize::from(!contour.closed));
    for (&(index, before), &(next, after)) in pairs.take(inner) {
        let first = (index + 1) % n;
        let at = &solution.knots[first];
        if at.join == Join::Corner {
            continue;
        }
        let (a, b) = (before.chord_length(), after.chord_length());
        let h = 2.0 / (a.recip() + b.recip());
        let turn = after.direction(0.0) - before.direction(before.length());
        require(first, "direction", wrap_angle(turn));
        let (arriving, leaving) = (before.curvature_jet(before.length()), after.curvature_jet(0.0));
        let jump = |order: usize| (leaving[order] - arriving[order]) * h.powi(order as i32 + 1);
        if at.join != Join::G1 {
            // At what is all but a cusp, as the library defines it.
            let least = arriving[0].abs().min(leaving[0].abs()) * h / 32.0;
            require(first, "curvature", jump(0) / least.max(1.0).powi(2));
        }
        let is_free = [first, next].map(|i| &contour.knots[i]).into_iter().all(|knot| {
            let tangents = [knot.tangent_in, knot.tangent_out];
            let curvatures = [knot.curvature_in, knot.curvature_out];
            tangents.iter().all(Option::is_none) && curvatures.iter().all(Option::is_none)
        });
        if at.join == Join::G4 && is_free {
            require(first, "first derivative of curvature", jump(1));
            require(first, "second derivative of curvature", jump(2));
        }
    }
    if report.relaxed.is_empty() {
        // Knots in one place, to rounding, are reported as the first of them.
        let rounding = 1e-12 * chords(contour).fold(0.0, f64::max);
        let is_ignored = |knot: usize| {
            let point = |knot: usize| contour.knots[knot].point;
            report.adapted.iter().any(|adapted| match adapted.place {
                Place::Knot(named) => (point(named) - point(knot)).hypot() <= rounding,
                Place::Segment(_) => false,
            })
        };
        for &(index, segment) in &segments {
            let (start, end) = (&contour.knots[index], &contour.knots[(index + 1) % n]);
            for (knot, tangent, curvature, s) in [
                (index, start.tangent_out, start.curvature_out, 0.0),
                ((index + 1) % n, end.tangent_in, end.curvature_in, segment.length()),
            ] {
                if is_ignored(knot) {
                    continue;
                }
                if let Some(tangent) = tangent {
                    let off = wrap_angle(segment.direction(s) - direction(tangent));
                    require(knot, "the tangent given", off);
                }
                if let Some(curvature) = curvature {
                    let off = segment.curvature(s) - curvature;
                    require(knot, "the curvature given", off * segment.chord_length());
                }
            }
        }
    }
    worst
}
