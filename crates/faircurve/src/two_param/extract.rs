//! Theorem 1 as a measurement (thesis section 4.1): is there one curve that all segments of a spline
//! are cut from, and which?
//!
//! At any place of a curve x = κ′/κ² and y = κ″/κ³ don't change with its size, and but for the sign
//! of x not with mirroring or reversal either. On a single curve, y is a function of |x|. So take
//! many segments, look where |x| has a given value, and compare y: if it is always the same, the
//! segments are cut from one curve, which follows from that function.

use kurbo::Vec2;

use crate::frame::ChordAngles;
use crate::numeric::roots::monotone_root;
use crate::outline::{Contour, Knot};
use crate::segment::Segment;
use crate::spline::{Spline, solve};

/// What many segments have in common where |κ′/κ²| is `sharpness`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extracted {
    /// |κ′/κ²|.
    pub sharpness: f64,
    /// The mean of κ″/κ³ there.
    pub bend: f64,
    /// The largest difference of two such values, over `sharpness`² + |`bend`|: rounding for a
    /// generating curve, 0.01 to 1 for splines without one.
    pub spread: f64,
    /// The number of places found.
    pub count: usize,
}

/// The segment that a spline has between two knots at unit distance with these tangents given; what
/// its family has for these angles. `None` where it doesn't have these tangents.
pub fn segment_with(spline: &dyn Spline, angles: ChordAngles) -> Option<Segment> {
    let direction = Vec2::from_angle;
    let contour = Contour::open([
        Knot::new((0.0, 0.0)).tangent(direction(angles.start_direction(0.0))),
        Knot::new((1.0, 0.0)).tangent(direction(angles.end_direction(0.0))),
    ]);
    let solution = solve(&contour, spline).ok()?;
    let is_solved = solution.report.relaxed.is_empty();
    solution.curve.segments().first().filter(|_| is_solved).cloned()
}

/// Segments of a spline with end tangents spread evenly over |θ| ≤ `widest`, `side` by `side`.
pub fn segments_of(spline: &dyn Spline, widest: f64, side: usize) -> Vec<Segment> {
    // Not quite symmetric, so that no segment is another's mirror image.
    let angle = |i: usize, off: f64| widest * (2.0 * (i as f64 + off) / side as f64 - 1.0);
    (0..side * side)
        .filter_map(|n| {
            let angles = ChordAngles::new(angle(n / side, 0.46), angle(n % side, 0.53));
            segment_with(spline, angles)
        })
        .collect()
}

/// Looks at segments wherever |κ′/κ²| has one of the values `sharpnesses`. Values that fewer than
/// two segments have are left out.
///
/// Places are found by changes between 64 samples in each smooth stretch. The accuracy is that of
/// the second derivative of curvature: about 1e-12 for curves that have theirs in closed form.
pub fn extract(segments: &[Segment], sharpnesses: &[f64]) -> Vec<Extracted> {
    sharpnesses.iter().filter_map(|sharpness| extract_at(segments, *sharpness)).collect()
}

/// The largest spread, which tells whether there is a generating curve; `None` if nothing was found.
pub fn largest_spread(extracted: &[Extracted]) -> Option<f64> {
    extracted.iter().map(|at| at.spread).reduce(f64::max)
}

fn extract_at(segments: &[Segment], sharpness: f64) -> Option<Extracted> {
    const SAMPLES: usize = 64;
    let mut bends = Vec::new();
    let mut seen = 0;
    for segment in segments {
        // Free of division, and without a jump at inflections.
        let off = |s: f64| {
            let [curvature, slope, ..] = segment.curvature_jet(s);
            slope.abs() - sharpness * curvature * curvature
        };
        let place = |i: usize| segment.length() * i as f64 / SAMPLES as f64;
        let found = bends.len();
        for i in 0..SAMPLES {
            let Some(s) = monotone_root(off, place(i), place(i + 1)) else { continue };
            let [curvature, slope, second, _] = segment.curvature_jet(s);
            let is_there = (slope.abs() / (curvature * curvature) / sharpness - 1.0).abs() < 1e-6;
            let bend = second / (curvature * curvature * curvature);
            if is_there && bend.is_finite() {
                bends.push(bend);
            }
        }
        seen += usize::from(bends.len() > found);
    }
    if seen < 2 {
        return None;
    }
    let bend = bends.iter().sum::<f64>() / bends.len() as f64;
    let (low, high) =
        bends.iter().fold((f64::MAX, f64::MIN), |(low, high), b| (low.min(*b), high.max(*b)));
    let spread = (high - low) / (sharpness * sharpness + bend.abs());
    Some(Extracted { sharpness, bend, spread, count: bends.len() })
}

/// The generating curve of what was extracted, as places (arc length, curvature), from the sharpest
/// on; scaled so that curvature there is 1 at arc length 0. `extracted` must be sorted by falling
/// sharpness and closely spaced: the error is of fourth order in the spacing of its logarithm. It
/// ends where curvature no longer rises.
///
/// From x = κ′/κ², y = κ″/κ³ follows dx/ds = κ(y − 2x²), so that with g = y/x²
/// d log κ/d log x = 1/(g − 2) and ds/d log x = 1/(κ x (g − 2)).
pub fn reconstruct(extracted: &[Extracted]) -> Vec<(f64, f64)> {
    const STEPS: usize = 8;
    let n = extracted.len();
    let logs: Vec<f64> = extracted.iter().map(|at| at.sharpness.ln()).collect();
    let ratios: Vec<f64> =
        extracted.iter().map(|at| at.bend / (at.sharpness * at.sharpness)).collect();
    // The cubic through four neighbours.
    let ratio = |i: usize, x: f64| {
        let first = i.saturating_sub(1).min(n.saturating_sub(4));
        let nodes = first..(first + 4).min(n);
        nodes
            .clone()
            .map(|j| {
                let others = nodes.clone().filter(|k| *k != j);
                ratios[j] * others.map(|k| (x - logs[k]) / (logs[j] - logs[k])).product::<f64>()
            })
            .sum::<f64>()
    };
    let mut curve = Vec::new();
    let (mut s, mut log_curvature) = (0.0, 0.0f64);
    for i in 0..n {
        curve.push((s, log_curvature.exp()));
        let Some(next) = logs.get(i + 1) else { break };
        let h = (next - logs[i]) / STEPS as f64;
        for step in 0..STEPS {
            let x = logs[i] + h * step as f64;
            let [r0, r1, r2] = [0.0, 0.5, 1.0].map(|part| 1.0 / (ratio(i, x + part * h) - 2.0));
            if !(r0 < 0.0 && r1 < 0.0 && r2 < 0.0) {
                return curve;
            }
            // Simpson's rule, with log κ at the middle from the parabola through the three.
            let middle = log_curvature + h * (5.0 * r0 + 8.0 * r1 - r2) / 24.0;
            let end = log_curvature + h * (r0 + 4.0 * r1 + r2) / 6.0;
            let speed = |r: f64, log_curvature: f64, x: f64| r * (-log_curvature - x).exp();
            s += h / 6.0
                * (speed(r0, log_curvature, x)
                    + 4.0 * speed(r1, middle, x + h / 2.0)
                    + speed(r2, end, x + h));
            log_curvature = end;
        }
    }
    curve
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::{self, Params};

    fn places() -> Vec<f64> {
        (0..60).map(|i| 10.0 * 0.9f64.powi(i)).collect()
    }

    fn extracted(name: &str, params: &Params) -> Vec<Extracted> {
        let spline = catalog::build(name, params).unwrap();
        extract(&segments_of(&*spline, 2.0, 16), &places())
    }

    #[test]
    fn splines_of_a_generating_curve_have_one() {
        let alpha = |alpha: f64| Params::new().with("alpha", alpha);
        let kappa = |text: &str| Params::new().with("kappa", text);
        for (name, params, bound) in [
            ("euler", Params::new(), 1e-12),
            ("log-aesthetic", alpha(0.5), 1e-12),
            ("log-aesthetic", alpha(1.78), 1e-12),
            ("log-aesthetic", alpha(4.0), 1e-12),
            ("generated", kappa("tanh(s)"), 1e-10),
            ("generated", kappa("s+s^3"), 1e-10),
            ("generated", kappa("exp(s)"), 1e-10),
        ] {
            let found = extracted(name, &params);
            assert!(found.len() > 20, "{name} {params:?}: {}", found.len());
            let spread = largest_spread(&found).unwrap();
            assert!(spread < bound, "{name} {params:?}: {spread:e}");
        }
    }

    #[test]
    fn others_do_not() {
        // Two log-aesthetic curves are not one.
        let mut segments = Vec::new();
        for alpha in [1.5, 2.0] {
            let spline = catalog::build("log-aesthetic", &Params::new().with("alpha", alpha));
            segments.extend(segments_of(&*spline.unwrap(), 2.0, 8));
        }
        let spread = largest_spread(&extract(&segments, &places())).unwrap();
        // (α − 1)/α is 1/3 and 1/2.
        assert!(spread > 0.1, "{spread}");
    }

    #[test]
    fn the_curve_comes_back() {
        // κ = s^α: κ = x^(−α/(α+1)), s falling with x.
        for alpha in [0.5, 1.0, 1.78] {
            let found = extracted("log-aesthetic", &Params::new().with("alpha", alpha));
            let start = (alpha / found[0].sharpness).powf(1.0 / (alpha + 1.0));
            let size = start.powf(alpha);
            for (s, curvature) in reconstruct(&found) {
                // In units in which curvature starts at 1.
                let expected = (start + s / size).powf(alpha) / size;
                assert!((curvature / expected - 1.0).abs() < 1e-9, "{alpha} {s}: {curvature}");
            }
        }
        let found = extracted("generated", &Params::new().with("kappa", "tanh(s)"));
        let start = (1.0 / found[0].sharpness.sqrt()).asinh();
        let curve = reconstruct(&found);
        assert!(curve.len() > 20);
        for (s, curvature) in curve {
            let size = start.tanh();
            let expected = (start + s / size).tanh() / size;
            assert!((curvature / expected - 1.0).abs() < 1e-6, "{s}: {curvature} {expected}");
        }
    }
}
