//! Shapes other than lines and spirals: a curve from (0, 0) to (1, 0), by arc length.

use std::fmt;

use kurbo::PathSeg;
use num_complex::Complex64;

use crate::numeric::quadrature::integrate;

/// What holds where a curve starts or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveEnd {
    /// Direction of travel in radians, not wrapped.
    pub direction: f64,
    /// Curvature, counterclockwise positive.
    pub curvature: f64,
}

/// A curve from 0 to 1 in the complex plane, by arc length from 0 to [`length`](Self::length): what
/// a family's segment looks like on the unit chord.
///
/// Implement this for curves whose natural parameter is arc length, and
/// [`ParametricCurve`](super::ParametricCurve) for others. All numbers must be finite, at cusps too.
pub trait UnitCurve: fmt::Debug + Send + Sync {
    /// Arc length, at least 1.
    fn length(&self) -> f64;

    /// The length, or where it isn't known yet something larger.
    fn length_bound(&self) -> f64 {
        self.length()
    }

    /// The point at arc length `s`: exactly 0 and 1 at the ends.
    fn point(&self, s: f64) -> Complex64;

    /// The direction of travel at arc length `s`, continuous except at cusps, where it jumps by
    /// half a turn.
    fn direction(&self, s: f64) -> f64;

    /// Curvature at arc length `s` and its first three derivatives by arc length; huge but finite
    /// at cusps.
    fn curvature_jet(&self, s: f64) -> [f64; 4];

    /// Curvature alone.
    fn curvature(&self, s: f64) -> f64 {
        self.curvature_jet(s)[0]
    }

    /// What holds at the start and at the end.
    fn ends(&self) -> [CurveEnd; 2] {
        let at = |s| CurveEnd { direction: self.direction(s), curvature: self.curvature(s) };
        [at(0.0), at(self.length())]
    }

    /// Arc lengths in (0, length), ascending, at which the curve isn't smooth or nearly so: joints,
    /// cusps, sharp bends.
    fn breaks(&self) -> &[f64];

    /// Upper bounds of |κ|, |κ′| and |κ″| between two arc lengths; each is [`f64::MAX`] where none is
    /// known.
    fn curvature_bounds(&self, from: f64, to: f64) -> [f64; 3];

    /// The piece between two arc lengths, which may lie beyond the curve, as a Bézier, if it is one exactly.
    fn bezier(&self, from: f64, to: f64) -> Option<PathSeg>;

    /// The integral of `f` (of the curvature jet) by arc length, to about 1e-13 of itself; the most
    /// that can be written where it diverges.
    fn integral(&self, from: f64, to: f64, f: &dyn Fn([f64; 4]) -> f64) -> f64 {
        integrate(&|s| f(self.curvature_jet(s)), &self.stops(from, to)).min(f64::MAX)
    }

    /// `from`, the breaks after it, `to`.
    fn stops(&self, from: f64, to: f64) -> Vec<f64> {
        let inner = self.breaks().iter().copied().filter(|s| (from..to).contains(s) && *s > from);
        std::iter::once(from).chain(inner).chain([to]).collect()
    }
}
