//! The spline of *Bespoke splines*, section 3: one cubic Bézier a segment, through cusps and
//! reversals, with a curvature map that is periodic in both tangents.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use kurbo::Point;
use num_complex::Complex64;

use super::catalog::{Claim, ParamKind, ParamSpec, Params, SplineInfo};
use super::shapes;
use crate::frame::{ChordAngles, EndCurvature};
use crate::numeric::trig::{sin_cos, sin_cos_of_small};
use crate::outline::Join;
use crate::segment::{Measured, Segment, UnitBezier};
use crate::two_param::continuity::{Continuity, NaturalEnd};
use crate::two_param::curvature_map::{CurvatureMap, EndCurvatures, SegmentContext};
use crate::two_param::shape::{SegmentEnds, SegmentShape};
use crate::two_param::spline::TwoParamSpline;

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "bespoke",
    summary: "cubic Béziers with continuous curvature, robust for any knots",
    source: "Bespoke 3",
    params: &[
        ParamSpec {
            name: "end",
            summary: "what holds at free ends: the spline's own rule, a parabola (as κ-curves have \
                      it), equal angles (as arcs have them), or zero curvature",
            kind: ParamKind::Choice { options: ENDS },
        },
        shapes::SHAPE,
    ],
    default_join: Join::G2,
    joins: &[Join::Corner, Join::G1, Join::G2],
    ends: ENDS,
    claims: &[
        Claim::Parameters(2),
        Claim::Continuity(2),
        Claim::SimilarityInvariant,
        Claim::Symmetric,
    ],
    build: |params| {
        let rule = Continuity { map: BespokeCubics, end: natural_end(params) };
        Ok(Box::new(TwoParamSpline::new(&INFO, rule, shapes::chosen(params, BespokeCubics))))
    },
};

const ENDS: &[&str] = &["half-sine", "parabola", "arc", "zero-curvature"];

fn natural_end(params: &Params) -> NaturalEnd {
    match params.choice("end", ENDS[0]) {
        "parabola" => NaturalEnd::Angle(parabola_end),
        "arc" => NaturalEnd::Arc,
        "zero-curvature" => NaturalEnd::ZeroCurvature,
        _ => NaturalEnd::Angle(half_sine_end),
    }
}

/// ½ sin 2θ and its derivative (Bespoke 3.1).
fn half_sine_end(angle: f64) -> (f64, f64) {
    let (sin, cos) = sin_cos(2.0 * angle);
    (0.5 * sin, cos)
}

/// arctan(2 tan θ) − θ and its derivative (Bespoke 3.1): the end of a parabola whose vertex is at
/// the segment's other end. With period π; 0 at multiples of π/2.
pub(crate) fn parabola_end(angle: f64) -> (f64, f64) {
    let (sin, cos) = sin_cos(angle);
    // tan(arctan(2 tan θ) − θ) = tan θ / (1 + 2 tan² θ), free of poles.
    let (opposite, adjacent) = (sin * cos, cos * cos + 2.0 * sin * sin);
    let slope = 2.0 / (1.0 + 3.0 * sin * sin) - 1.0;
    (opposite.atan2(adjacent), slope)
}

/// The family: cubic Béziers whose arms depend on both tangents.
#[derive(Clone, Copy, Debug)]
pub struct BespokeCubics;

/// The lengths of both arms, at the start and at the end, negative where they point backwards, and their
/// derivatives by the angle at their own end and at the other.
#[derive(Clone, Copy, Debug)]
struct Arms {
    length: [f64; 2],
    by_own: [f64; 2],
    by_other: [f64; 2],
}

impl Arms {
    /// Bespoke section 3, with the cosine that its text prints as a sine (`docs/errata.md`).
    #[inline(always)]
    fn new(tangents: &Tangents) -> Arms {
        // Both arms take the same steps side by side: two lanes of one register.
        let Tangents { sin, cos, .. } = *tangents;
        let (sin_b, cos_b) = (swapped(sin), swapped(cos));
        let doubled =
            [both(|i| 2.0 * sin_b[i] * cos_b[i]), both(|i| 1.0 - 2.0 * sin_b[i] * sin_b[i])];
        let [sin_inner, cos_inner] = turned_back(doubled, doubled[0].map(|sin| 0.4 * sin));
        let theta_a_by_other = both(|i| -0.3 * cos_inner[i] * (2.0 - 0.8 * doubled[1][i]));
        // Of θₐ.
        let [sin, cos] = turned_back([sin, cos], sin_inner.map(|sin| 0.3 * sin));
        // cos 3x = 4 cos³ x − 3 cos x, so that the arm is exactly odd about π/2.
        let by_own = both(|i| 5.0 / 12.0 * sin[i] * (2.4 * cos[i] * cos[i] - 1.6));
        Arms {
            length: both(|i| 5.0 / 12.0 * cos[i] * (1.6 - 0.8 * cos[i] * cos[i])),
            by_own,
            by_other: both(|i| by_own[i] * theta_a_by_other[i]),
        }
    }

    /// The same where the directions at these ends are given: forwards, so that the curve has that
    /// direction and not its opposite.
    fn forwards(mut self, given: [bool; 2]) -> Arms {
        /// Shorter arms have no say about the direction. Chosen: a fiftieth of the chord shows as a
        /// sharp bend, and is far from rounding.
        const SHORTEST: f64 = 0.02;
        for i in (0..2).filter(|&i| given[i]) {
            let sign = self.length[i].signum();
            let is_short = self.length[i].abs() < SHORTEST;
            self.length[i] = if is_short { SHORTEST } else { sign * self.length[i] };
            self.by_own[i] = if is_short { 0.0 } else { sign * self.by_own[i] };
            self.by_other[i] = if is_short { 0.0 } else { sign * self.by_other[i] };
        }
        self
    }
}

/// The chord angles at the start and at the end.
#[derive(Clone, Copy, Debug)]
struct Tangents {
    angle: [f64; 2],
    sin: [f64; 2],
    cos: [f64; 2],
}

impl Tangents {
    #[inline(always)]
    fn new(ChordAngles { theta0, theta1 }: ChordAngles) -> Tangents {
        let angle = [theta0, theta1];
        let (sin, cos) = sin_cos_of_both(angle);
        Tangents { angle, sin, cos }
    }
}

/// What holds at the start and at the end.
#[inline(always)]
fn both(f: impl Fn(usize) -> f64) -> [f64; 2] {
    [f(0), f(1)]
}

/// What each end has, at the other.
fn swapped([start, end]: [f64; 2]) -> [f64; 2] {
    [end, start]
}

#[inline(always)]
fn sin_cos_of_both(angles: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    let (start, end) = (sin_cos(angles[0]), sin_cos(angles[1]));
    ([start.0, end.0], [start.1, end.1])
}

/// Sine and cosine of angles, given by theirs, less at most 0.4.
#[inline(always)]
fn turned_back([sin, cos]: [[f64; 2]; 2], by: [f64; 2]) -> [[f64; 2]; 2] {
    let (a, b) = (sin_cos_of_small(by[0]), sin_cos_of_small(by[1]));
    let (sin_by, cos_by) = ([a.0, b.0], [a.1, b.1]);
    [
        both(|i| sin[i] * cos_by[i] - cos[i] * sin_by[i]),
        both(|i| cos[i] * cos_by[i] + sin[i] * sin_by[i]),
    ]
}

impl CurvatureMap for BespokeCubics {
    /// Of the cubic with arms a and b on the unit chord: κ = (2/3)(sin θ₀ − b sin(θ₀ + θ₁))/(a·|a|)
    /// at the start, and the mirror image at the end.
    #[inline(always)]
    fn curvatures(&self, angles: ChordAngles, context: &SegmentContext) -> EndCurvatures {
        const SCALE: f64 = 2.0 / 3.0;
        let tangents = Tangents::new(angles);
        let Tangents { sin, cos, .. } = tangents;
        let arms = Arms::new(&tangents).forwards(context.given_direction);
        // Of the sum of both angles.
        let sin_t = sin[0] * cos[1] + cos[0] * sin[1];
        let cos_t = cos[0] * cos[1] - sin[0] * sin[1];
        // The other end's arm.
        let there = swapped(arms.length);
        let (there_by_own, there_by_other) = (swapped(arms.by_other), swapped(arms.by_own));
        let slope = both(|i| 2.0 * arms.length[i].abs());
        // Numerators and denominators, and their derivatives by the angle here and the other one.
        let value = [
            both(|i| SCALE * (sin[i] - there[i] * sin_t)),
            both(|i| arms.length[i] * arms.length[i].abs()),
        ];
        let by_own = [
            both(|i| SCALE * (cos[i] - there[i] * cos_t - there_by_own[i] * sin_t)),
            both(|i| slope[i] * arms.by_own[i]),
        ];
        let by_other = [
            both(|i| SCALE * (-there[i] * cos_t - there_by_other[i] * sin_t)),
            both(|i| slope[i] * arms.by_other[i]),
        ];
        let at =
            |[num, den]: [[f64; 2]; 2], end: usize| EndCurvature { num: num[end], den: den[end] };
        EndCurvatures {
            value: [at(value, 0), at(value, 1)],
            by_angle: [[at(by_own, 0), at(by_other, 0)], [at(by_other, 1), at(by_own, 1)]],
        }
    }

    fn limit(&self) -> f64 {
        f64::INFINITY
    }

    fn is_periodic(&self) -> bool {
        true
    }
}

impl SegmentShape for BespokeCubics {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        let tangents = Tangents::new(ends.angles);
        let [a, b] = Arms::new(&tangents).forwards(ends.context.given_direction).length;
        let Tangents { angle, sin, cos } = tangents;
        let is_straight = a * sin[0] == 0.0 && b * sin[1] == 0.0;
        if is_straight && angle.iter().all(|angle| angle.abs() < FRAC_PI_2) {
            return Segment::line(start, end);
        }
        let legs = [Complex64::new(cos[0], -sin[0]) * a, Complex64::new(cos[1], sin[1]) * b];
        let cubic = UnitBezier::from_legs(legs, [-angle[0], angle[1]]);
        Segment::unit_curve(start, end, Arc::new(Measured::new(cubic)))
    }

    fn keeps_curvature(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests;
