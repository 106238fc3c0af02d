//! kurbo's trait for curves to be fitted, so that its fitters run on ours.

use std::ops::Range;

use kurbo::common::GAUSS_LEGENDRE_COEFFS_16;
use kurbo::{CurveFitSample, ParamCurveFit, Point, Vec2};

use crate::curve::Curve;
use crate::segment::Segment;

/// kurbo's fitters on a solved curve: `t` from 0 to 1 is the fraction of arc length.
///
/// Finding the segment takes time proportional to their number. Corners at knots are reported by
/// `break_cusp`; cusps inside segments aren't. The moment integrals are sums over segments, each by Gauss–Legendre
/// quadrature over panels that turn by at most 2 radians, so that they are exact to rounding: 1e-14 of the
/// area of the piece's box and of its products with coordinates.
///
/// ```
/// use faircurve::kurbo::fit_to_bezpath;
/// use faircurve::{Contour, catalog, solve};
/// let contour = Contour::open([(0.0, 0.0), (100.0, 50.0), (200.0, 0.0)]);
/// let curve = solve(&contour, &*catalog::spline("spiro")?)?.curve;
/// assert!(fit_to_bezpath(&curve, 0.01).segments().count() > 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl ParamCurveFit for Curve {
    fn sample_pt_tangent(&self, t: f64, sign: f64) -> CurveFitSample {
        match place(self, t * self.length(), sign) {
            Some((segment, s)) => {
                CurveFitSample { p: segment.point(s), tangent: tangent(segment, s) }
            }
            None => CurveFitSample {
                p: self.start().unwrap_or(Point::ZERO),
                tangent: Vec2::new(1.0, 0.0),
            },
        }
    }

    fn sample_pt_deriv(&self, t: f64) -> (Point, Vec2) {
        let length = self.length();
        match place(self, t * length, 1.0) {
            Some((segment, s)) => (segment.point(s), tangent(segment, s) * length),
            None => (self.start().unwrap_or(Point::ZERO), Vec2::ZERO),
        }
    }

    fn moment_integrals(&self, range: Range<f64>) -> (f64, f64, f64) {
        let length = self.length();
        let (from, to) = (range.start * length, range.end * length);
        let mut sums = (0.0, 0.0, 0.0);
        let mut start = 0.0;
        for segment in self.segments() {
            let (a, b) = ((from - start).max(0.0), (to - start).min(segment.length()));
            if b > a {
                let part = moments(segment, a, b);
                sums = (sums.0 + part.0, sums.1 + part.1, sums.2 + part.2);
            }
            start += segment.length();
            if start >= to {
                break;
            }
        }
        sums
    }

    fn break_cusp(&self, range: Range<f64>) -> Option<f64> {
        let length = self.length();
        let mut end = 0.0;
        for pair in self.segments().windows(2) {
            end += pair[0].length();
            let t = end / length;
            let is_inside = t > range.start + ROUNDING && t < range.end - ROUNDING;
            if is_inside && !super::joins_smoothly(&pair[0], &pair[1]) {
                return Some(t);
            }
        }
        None
    }
}

/// Radians: 16 nodes integrate products of three coordinates and direction over this much of a turn to rounding.
const PANEL: f64 = 2.0;

/// What arc lengths are off by after a fraction and back, as a part of the whole.
const ROUNDING: f64 = 1e-13;

/// The segment at an arc length, at a knot the one after it or, where `sign` is negative, before it.
fn place(curve: &Curve, s: f64, sign: f64) -> Option<(&Segment, f64)> {
    let rounding = ROUNDING * s.abs();
    let mut rest = s;
    for segment in curve.segments() {
        let length = segment.length();
        let is_on = if sign < 0.0 {
            length > 0.0 && rest <= length + rounding
        } else {
            rest < length - rounding
        };
        if is_on {
            return Some((segment, rest.clamp(0.0, length)));
        }
        rest -= length;
    }
    curve.segments().last().map(|last| (last, last.length()))
}

/// The unit tangent. That of a line along an axis is so to the bit: by kurbo 0.13, rays across one that is off by
/// rounding miss it.
fn tangent(segment: &Segment, s: f64) -> Vec2 {
    let chord = (segment.end() - segment.start()).normalize();
    if segment.is_line() && chord.is_finite() {
        chord
    } else {
        Vec2::from_angle(segment.direction(s))
    }
}

/// ∫ y dx, ∫ xy dx and ∫ y² dx over part of a segment.
fn moments(segment: &Segment, from: f64, to: f64) -> (f64, f64, f64) {
    /// Beside a cusp curvature has no bound.
    const MOST_PANELS: f64 = 64.0;
    let bend = segment.largest_curvature(from, to) * (to - from);
    let panels = (bend / PANEL).ceil().clamp(1.0, MOST_PANELS);
    let half = (to - from) / panels / 2.0;
    let mut sums = (0.0, 0.0, 0.0);
    for panel in 0..panels as usize {
        let middle = from + half * (2 * panel + 1) as f64;
        for (weight, node) in GAUSS_LEGENDRE_COEFFS_16 {
            let s = middle + half * node;
            let point = segment.point(s);
            let area = weight * half * point.y * tangent(segment, s).x;
            sums = (sums.0 + area, sums.1 + area * point.x, sums.2 + area * point.y);
        }
    }
    sums
}
