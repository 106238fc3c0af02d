//! The spline of *Bespoke splines*, section 3: one cubic Bézier a segment, through cusps and
//! reversals, with a curvature map that is periodic in both tangents.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use kurbo::Point;
use num_complex::Complex64;

use super::catalog::{Claim, ParamKind, ParamSpec, Params, SplineInfo};
use super::shapes;
use crate::frame::{ChordAngles, EndCurvature};
use crate::numeric::trig::sin_cos;
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

/// The length of an arm, negative where it points backwards, and its derivatives.
#[derive(Clone, Copy, Debug)]
struct Arm {
    length: f64,
    by_own: f64,
    by_other: f64,
}

impl Arm {
    /// Bespoke section 3, with the cosine that its text prints as a sine (`docs/errata.md`).
    fn new(own: &Tangent, other: &Tangent) -> Arm {
        let (sin_2, cos_2) = (2.0 * other.sin * other.cos, 1.0 - 2.0 * other.sin * other.sin);
        let inner = 2.0 * other.angle - 0.4 * sin_2;
        let (sin_inner, cos_inner) = sin_cos(inner);
        let theta_a = own.angle - 0.3 * sin_inner;
        let by_other = -0.3 * cos_inner * (2.0 - 0.8 * cos_2);
        let (sin, cos) = sin_cos(theta_a);
        // cos 3x = 4 cos³ x − 3 cos x, so that the arm is exactly odd about π/2.
        let length = 5.0 / 12.0 * cos * (1.6 - 0.8 * cos * cos);
        let slope = 5.0 / 12.0 * sin * (2.4 * cos * cos - 1.6);
        Arm { length, by_own: slope, by_other: slope * by_other }
    }

    /// The same at an end whose direction is given: forwards, so that the curve has that direction
    /// and not its opposite.
    fn forwards(self) -> Arm {
        /// Shorter arms have no say about the direction. Chosen: a fiftieth of the chord shows as a
        /// sharp bend, and is far from rounding.
        const SHORTEST: f64 = 0.02;
        if self.length.abs() < SHORTEST {
            return Arm { length: SHORTEST, by_own: 0.0, by_other: 0.0 };
        }
        let sign = self.length.signum();
        Arm {
            length: sign * self.length,
            by_own: sign * self.by_own,
            by_other: sign * self.by_other,
        }
    }
}

/// A chord angle.
#[derive(Clone, Copy, Debug)]
struct Tangent {
    angle: f64,
    sin: f64,
    cos: f64,
}

impl Tangent {
    /// Those at the start and at the end.
    fn both(ChordAngles { theta0, theta1 }: ChordAngles) -> [Tangent; 2] {
        [theta0, theta1].map(|angle| {
            let (sin, cos) = sin_cos(angle);
            Tangent { angle, sin, cos }
        })
    }
}

/// Both arms, at the start and at the end.
fn arms([start, end]: &[Tangent; 2], context: &SegmentContext) -> [Arm; 2] {
    let settle = |arm: Arm, given: bool| if given { arm.forwards() } else { arm };
    [
        settle(Arm::new(start, end), context.given_direction[0]),
        settle(Arm::new(end, start), context.given_direction[1]),
    ]
}

impl CurvatureMap for BespokeCubics {
    /// Of the cubic with arms a and b on the unit chord: κ = (2/3)(sin θ₀ − b sin(θ₀ + θ₁))/(a·|a|)
    /// at the start, and the mirror image at the end.
    fn curvatures(&self, angles: ChordAngles, context: &SegmentContext) -> EndCurvatures {
        let tangents = Tangent::both(angles);
        let [first, last] = &tangents;
        let [start, end] = arms(&tangents, context);
        // Of the sum of both angles.
        let sin_t = first.sin * last.cos + first.cos * last.sin;
        let cos_t = first.cos * last.cos - first.sin * last.sin;
        // Numerator and denominator, and their derivatives by the angle here and the other one.
        let at_end = |&Tangent { sin, cos, .. }: &Tangent, here: &Arm, there: &Arm| {
            let scale = 2.0 / 3.0;
            let value = EndCurvature {
                num: scale * (sin - there.length * sin_t),
                den: here.length * here.length.abs(),
            };
            let slope = 2.0 * here.length.abs();
            let by_own = EndCurvature {
                num: scale * (cos - there.length * cos_t - there.by_other * sin_t),
                den: slope * here.by_own,
            };
            let by_other = EndCurvature {
                num: scale * (-there.length * cos_t - there.by_own * sin_t),
                den: slope * here.by_other,
            };
            (value, by_own, by_other)
        };
        let (start_value, start_by_0, start_by_1) = at_end(first, &start, &end);
        let (end_value, end_by_1, end_by_0) = at_end(last, &end, &start);
        EndCurvatures {
            value: [start_value, end_value],
            by_angle: [[start_by_0, start_by_1], [end_by_0, end_by_1]],
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
        let ChordAngles { theta0, theta1 } = ends.angles;
        let tangents = Tangent::both(ends.angles);
        let [a, b] = arms(&tangents, &ends.context).map(|arm| arm.length);
        let is_straight = a * tangents[0].sin == 0.0 && b * tangents[1].sin == 0.0;
        if is_straight && theta0.abs() < FRAC_PI_2 && theta1.abs() < FRAC_PI_2 {
            return Segment::line(start, end);
        }
        let [first, last] = tangents;
        let legs =
            [Complex64::new(first.cos, -first.sin) * a, Complex64::new(last.cos, last.sin) * b];
        let cubic = UnitBezier::from_legs(legs[0], legs[1]);
        Segment::unit_curve(start, end, Arc::new(Measured::new(cubic)))
    }

    fn keeps_curvature(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests;
