//! Segments cut from one generating curve (thesis section 4.8), rung 1 of the ladder.
//!
//! By Theorem 1 (thesis 4.1) the extensional splines with two parameters are those whose segments
//! are cut from one curve, then scaled, turned and, where need be, mirrored. So a family of this
//! kind is a [`GeneratingCurve`]: it says which [`Cut`] has given end tangents. [`Cuts`] makes the
//! curvature map and the shape of it.
//!
//! What the map needs of a cut is little. Let a cut with end tangents θ₀, θ₁ and end curvatures
//! k₀, k₁ for unit chord slide along its curve, its ends by dσ₀ and dσ₁; then
//!
//! ```text
//! dθ₀ = (sin θ₀ − k₀) dσ₀ + sin θ₁ dσ₁        dk₀ = (k₀′ − k₀ cos θ₀) dσ₀ + k₀ cos θ₁ dσ₁
//! dθ₁ = −sin θ₀ dσ₀ + (k₁ − sin θ₁) dσ₁       dk₁ = −k₁ cos θ₀ dσ₀ + (k₁′ + k₁ cos θ₁) dσ₁
//! ```
//!
//! so that the derivatives of the map follow from curvature and its slope at the ends, whatever the
//! curve. On an arc, which slides along itself, that is 0/0. Near arcs every smooth curve has
//! curvature linear in arc length, and the Euler spiral's derivatives stand in.

use std::fmt;
use std::sync::Arc;

use kurbo::{PathSeg, Point};
use num_complex::Complex64;

use super::curvature_map::{CurvatureMap, EndCurvatures, SegmentContext};
use super::shape::{SegmentEnds, SegmentShape};
use crate::families::euler::EulerSpirals;
use crate::frame::{ChordAngles, EndCurvature};
use crate::segment::{Segment, UnitCurve};

/// A curve from which segments are cut: odd in arc length (point symmetric about an inflection), or
/// of one sign of curvature.
pub trait GeneratingCurve: fmt::Debug + Clone + Send + Sync {
    /// The pieces cut from it.
    type Cut: Cut + 'static;

    /// The cut with these end tangents, where `theta1` ≥ |`theta0`|; all others are its mirror
    /// images and reversals. `None` where there is none, or an angle isn't below π.
    ///
    /// Of several cuts, the one that continues the straight line.
    fn cut(&self, angles: ChordAngles) -> Option<Self::Cut>;

    /// The power of arc length with which curvature rises from an inflection: 1 where its slope
    /// there is a number other than zero.
    fn order(&self) -> f64 {
        1.0
    }
}

/// A piece of a generating curve, scaled to arc length 1, by arc length v from 0 to 1; it starts at
/// the origin in the direction of +x. Curvature never falls.
pub trait Cut: fmt::Debug + Send + Sync {
    /// Curvature and its first three derivatives; large but finite where they diverge.
    fn curvature_jet(&self, v: f64) -> [f64; 4];

    /// Upper bounds of |κ|, |κ′| and |κ″| between two places; each is [`f64::MAX`] where none is known.
    /// Curvature itself is largest at an end, since it never falls.
    fn curvature_bounds(&self, from: f64, to: f64) -> [f64; 3] {
        let [a, b] = [from, to].map(|v| self.curvature_jet(v)[0].abs());
        [a.max(b), f64::MAX, f64::MAX]
    }

    /// Direction at `v`: the integral of curvature from the start.
    fn turning(&self, v: f64) -> f64;

    /// The point at `v`.
    fn point(&self, v: f64) -> Complex64;

    /// Where, between the ends, curvature is zero.
    fn inflection(&self) -> Option<f64>;
}

/// The end tangents of a cut that starts in the direction of +x.
pub fn chord_angles(cut: &impl Cut) -> ChordAngles {
    let direction = cut.point(1.0).arg();
    ChordAngles { theta0: direction, theta1: cut.turning(1.0) - direction }
}

/// A cut on the unit chord, mirrored and reversed as its end tangents want it.
#[derive(Clone, Debug)]
pub struct PlacedCut<C> {
    cut: C,
    chord: Complex64,
    backwards: bool,
    mirrored: bool,
    breaks: Vec<f64>,
}

impl<C: Cut> PlacedCut<C> {
    /// The cut of `curve` with these end tangents, if there is one.
    pub fn new<G: GeneratingCurve<Cut = C>>(curve: &G, angles: ChordAngles) -> Option<Self> {
        let ChordAngles { theta0, theta1 } = angles;
        // Reversed and mirrored, a segment has its angles exchanged; reversed alone, exchanged and
        // negated.
        let swap = theta1 < theta0;
        let reverse = theta0 + theta1 < 0.0;
        let (mut canonical, mut backwards, mut mirrored) = (angles, false, false);
        if swap {
            canonical = ChordAngles { theta0: theta1, theta1: theta0 };
            (backwards, mirrored) = (true, true);
        }
        if reverse {
            canonical = canonical.reversed();
            backwards = !backwards;
        }
        let cut = curve.cut(canonical)?;
        let chord = cut.point(1.0);
        let length = 1.0 / chord.norm();
        if !(length < LONGEST) {
            return None;
        }
        let place = |v: f64| length * if backwards { 1.0 - v } else { v };
        let breaks = cut.inflection().map(place).into_iter().collect();
        Some(PlacedCut { cut, chord, backwards, mirrored, breaks })
    }

    /// The cut, before it is mirrored or reversed.
    pub fn cut(&self) -> &C {
        &self.cut
    }

    fn place(&self, s: f64) -> f64 {
        let v = (s * self.chord.norm()).clamp(0.0, 1.0);
        if self.backwards { 1.0 - v } else { v }
    }

    /// Of the unit chord: the sign of a mirror, and of a derivative of this order.
    fn sign(&self, order: usize) -> f64 {
        let flips = self.mirrored != (self.backwards && order.is_multiple_of(2));
        if flips { -1.0 } else { 1.0 }
    }

    /// Curvatures and their slopes at both ends, for unit chord.
    fn end_jets(&self) -> [[f64; 2]; 2] {
        let length = self.length();
        [0.0, length].map(|s| {
            let [curvature, slope, ..] = self.curvature_jet(s);
            [curvature, slope]
        })
    }
}

/// Cuts whose arc is longer than this times their chord are as good as closed: the chord is mostly
/// rounding.
const LONGEST: f64 = 1e9;

impl<C: Cut> UnitCurve for PlacedCut<C> {
    fn length(&self) -> f64 {
        (1.0 / self.chord.norm()).max(1.0)
    }

    fn point(&self, s: f64) -> Complex64 {
        let v = self.place(s);
        let forwards = if v == 1.0 { Complex64::ONE } else { self.cut.point(v) / self.chord };
        let point = if self.backwards { 1.0 - forwards } else { forwards };
        if self.mirrored { point.conj() } else { point }
    }

    fn direction(&self, s: f64) -> f64 {
        let direction = self.cut.turning(self.place(s)) - self.chord.arg();
        if self.mirrored { -direction } else { direction }
    }

    fn curvature_jet(&self, s: f64) -> [f64; 4] {
        let mut jet = self.cut.curvature_jet(self.place(s));
        let mut scale = 1.0;
        for (order, derivative) in jet.iter_mut().enumerate() {
            scale *= self.chord.norm();
            *derivative *= scale * self.sign(order);
        }
        jet
    }

    fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    fn curvature_bounds(&self, from: f64, to: f64) -> [f64; 3] {
        let (a, b) = (self.place(from), self.place(to));
        let bounds = self.cut.curvature_bounds(a.min(b), a.max(b));
        let chord = self.chord.norm();
        let scales = [chord, chord * chord, chord * chord * chord];
        std::array::from_fn(|order| match bounds[order] {
            f64::MAX => f64::MAX,
            bound => (bound * scales[order]).min(f64::MAX),
        })
    }

    fn bezier(&self, _from: f64, _to: f64) -> Option<PathSeg> {
        None
    }
}

/// The family of segments cut from a generating curve.
#[derive(Clone, Copy, Debug)]
pub struct Cuts<G> {
    /// The curve.
    pub curve: G,
}

impl<G: GeneratingCurve> Cuts<G> {
    /// The segment on the unit chord with these end tangents, if the curve has such a cut.
    pub fn unit(&self, angles: ChordAngles) -> Option<PlacedCut<G::Cut>> {
        PlacedCut::new(&self.curve, angles)
    }
}

impl<G: GeneratingCurve> CurvatureMap for Cuts<G> {
    /// Where there is no cut, as for the Euler spiral.
    fn curvatures(&self, angles: ChordAngles, context: &SegmentContext) -> EndCurvatures {
        /// Relative differences of end curvature below which derivatives are the Euler spiral's.
        /// The formula loses a digit for each digit here, and the spiral is off by this much; either
        /// is good enough for Newton's method.
        const NEARLY_AN_ARC: f64 = 1e-5;
        let Some(unit) = self.unit(angles) else {
            return EulerSpirals.curvatures(angles, context);
        };
        let [[k0, slope0], [k1, slope1]] = unit.end_jets();
        let value = [k0, k1].map(EndCurvature::finite);
        let (sin0, cos0) = angles.theta0.sin_cos();
        let (sin1, cos1) = angles.theta1.sin_cos();
        let determinant = (sin0 - k0) * (k1 - sin1) + sin0 * sin1;
        // dσ by (theta0, theta1), times the determinant.
        let sigma = [[k1 - sin1, -sin1], [sin0, sin0 - k0]];
        let by_sigma = [[slope0 - k0 * cos0, k0 * cos1], [-k1 * cos0, slope1 + k1 * cos1]];
        let by_angle = by_sigma.map(|[by0, by1]| {
            [0, 1].map(|angle| {
                let slope = (by0 * sigma[0][angle] + by1 * sigma[1][angle]) / determinant;
                EndCurvature { num: slope, den: 0.0 }
            })
        });
        let is_finite = by_angle.iter().flatten().all(|by| by.num.is_finite());
        let is_arc = (k1 - k0).abs() <= NEARLY_AN_ARC * k0.abs().max(k1.abs());
        if is_arc || !is_finite {
            return EndCurvatures { value, ..EulerSpirals.curvatures(angles, context) };
        }
        EndCurvatures { value, by_angle }
    }

    fn limit(&self) -> f64 {
        EulerSpirals.limit()
    }

    fn order(&self) -> f64 {
        self.curve.order()
    }
}

impl<G: GeneratingCurve> SegmentShape for Cuts<G> {
    /// The cut; an Euler spiral where there is none.
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        let ChordAngles { theta0, theta1 } = ends.angles;
        if theta0 == 0.0 && theta1 == 0.0 {
            return Segment::line(start, end);
        }
        match self.unit(ends.angles) {
            Some(unit) => Segment::unit_curve(start, end, Arc::new(unit)),
            None => EulerSpirals.place(start, end, ends),
        }
    }

    fn keeps_curvature(&self) -> bool {
        true
    }
}
