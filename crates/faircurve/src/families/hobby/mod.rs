//! Hobby's spline, as METAFONT and MetaPost draw it: cubic Béziers whose *mock* curvatures agree
//! (thesis section 4.7).

use std::f64::consts::SQRT_2;
use std::sync::Arc;

use kurbo::Point;

use super::catalog::{CatalogError, Claim, ParamKind, ParamSpec, Params, SplineInfo};
use super::shapes;
use crate::frame::{ChordAngles, EndCurvature, wrap_angle};
use crate::numeric::trig::sin_cos;
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::{Measured, Segment, UnitBezier};
use crate::spline::{Adaptation, Place, Spline};
use crate::two_param::continuity::{Continuity, NaturalEnd};
use crate::two_param::curvature_map::{CurvatureMap, EndCurvatures, SegmentContext};
use crate::two_param::shape::{SegmentEnds, SegmentShape};
use crate::two_param::spline::TwoParamSpline;
use crate::two_param::tangents::{TangentRule, Tangents, ignored_curvature};

/// The smallest tension without sign that METAFONT takes: for smaller ones the equations may have
/// no solution.
pub const LEAST_TENSION: f64 = 0.75;

/// The largest tension without sign: METAFONT's infinity.
pub const LARGEST_TENSION: f64 = 4096.0;

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "hobby",
    summary: "METAFONT's cubics, whose mock curvatures agree; tension and curl",
    source: "thesis 4.7; Hobby 1986; METAFONT: The Program",
    params: &[
        ParamSpec {
            name: "tension",
            summary: "of knots that have none of their own: 0.75 or more; negative for `at least`",
            kind: ParamKind::Number { default: 1.0, min: -LARGEST_TENSION, max: LARGEST_TENSION },
        },
        ParamSpec {
            name: "curl",
            summary: "mock curvature at a free end over that at the segment's other end",
            kind: ParamKind::Number { default: 1.0, min: 0.0, max: 1e6 },
        },
        shapes::SHAPE,
    ],
    default_join: Join::G1,
    joins: &[Join::Corner, Join::G1],
    ends: &["curl"],
    claims: &[
        Claim::Parameters(2),
        Claim::Continuity(1),
        Claim::RoundToOrder(6),
        Claim::SimilarityInvariant,
        Claim::Symmetric,
        Claim::Ripple(0.267_949_192_431_122_7), // 2 − √3
        Claim::Exists,
    ],
    build,
};

fn build(params: &Params) -> Result<Box<dyn Spline>, CatalogError> {
    let tension = params.number("tension", 1.0);
    if !is_tension(tension) {
        return Err(CatalogError::BadValue {
            spline: INFO.name,
            param: "tension",
            value: tension.to_string(),
            expected: format!(
                "a number from {LEAST_TENSION} to {LARGEST_TENSION}, or minus that for `at least`"
            ),
        });
    }
    let rule = HobbyTangents { tension, curl: params.number("curl", 1.0) };
    let shape = shapes::chosen(params, HobbyCubics { tension });
    Ok(Box::new(TwoParamSpline::new(&INFO, rule, shape)))
}

fn is_tension(tension: f64) -> bool {
    (LEAST_TENSION..=LARGEST_TENSION).contains(&tension.abs())
}

/// The rule that mock curvature is continuous, with METAFONT's conventions: curl at free ends, and
/// what is out of range ignored.
#[derive(Clone, Copy, Debug)]
pub struct HobbyTangents {
    /// Tension where a knot gives none; negative for "at least".
    pub tension: f64,
    /// Curl where an end knot gives none, at least 0.
    pub curl: f64,
}

impl TangentRule for HobbyTangents {
    fn tangents(&self, run: &Run) -> Tangents {
        let (run, adapted) = usable(run);
        let map = MockCurvature { tension: self.tension };
        let mut tangents = Continuity { map, end: NaturalEnd::Curl(self.curl) }.tangents(&run);
        for ends in &mut tangents.ends {
            // A linear rule knows no bounds; every shape draws angles within half a turn.
            let ChordAngles { theta0, theta1 } = ends.angles;
            ends.angles = ChordAngles::new(wrap_angle(theta0), wrap_angle(theta1));
        }
        tangents.adapted = adapted;
        tangents
    }
}

/// The run without what this spline can't use: curvatures, which mock curvature would only mock;
/// tensions and curls out of range.
fn usable(run: &Run) -> (Run, Vec<Adaptation>) {
    let mut run = run.clone();
    let last = run.knots.len() - 1;
    let mut adapted = Vec::new();
    let ignored = |i: usize, asked| Adaptation { place: Place::Knot(i), asked, got: "ignored" };
    for (i, knot) in run.knots.iter_mut().enumerate() {
        let (is_start, is_end) = (!run.closed && i == 0, !run.closed && i == last);
        if knot.curvature.take().is_some() {
            adapted.push(ignored_curvature(i));
        }
        if (is_start || is_end) && knot.curl.is_some_and(|curl| curl < 0.0) {
            knot.curl = None;
            adapted.push(ignored(i, "curl"));
        }
        // The other side of an end is another run's.
        for (side, is_other) in [(0, is_start), (1, is_end)] {
            if !is_other && knot.tension[side].is_some_and(|tension| !is_tension(tension)) {
                knot.tension[side] = None;
                adapted.push(ignored(i, "tension"));
            }
        }
    }
    (run, adapted)
}

/// Tensions at start and end, where none is given `default`; out of range, 1.
fn tensions(context: &SegmentContext, default: f64) -> [f64; 2] {
    context.tension.map(|given| {
        let tension = given.unwrap_or(default);
        if is_tension(tension) { tension } else { 1.0 }
    })
}

/// Hobby's mock curvature: the end curvatures of his cubic to first order in the angles.
#[derive(Clone, Copy, Debug)]
pub struct MockCurvature {
    /// Tension where a knot gives none; negative for "at least", which here is the same.
    pub tension: f64,
}

impl CurvatureMap for MockCurvature {
    /// With a = 1/tension at the start and b at the end: κ₀ = 2((3 − b)·theta0 − b·theta1)/a², and
    /// the mirror image at the end ("METAFONT: The Program", part 18).
    fn curvatures(&self, angles: ChordAngles, context: &SegmentContext) -> EndCurvatures {
        let ChordAngles { theta0, theta1 } = angles;
        let [a, b] = tensions(context, self.tension).map(|tension| 1.0 / tension.abs());
        let start = [2.0 * (3.0 - b) / (a * a), -2.0 * b / (a * a)];
        let end = [-2.0 * a / (b * b), 2.0 * (3.0 - a) / (b * b)];
        let value = |by: [f64; 2]| EndCurvature::finite(by[0] * theta0 + by[1] * theta1);
        let change = |by: [f64; 2]| by.map(|num| EndCurvature { num, den: 0.0 });
        EndCurvatures { value: [start, end].map(value), by_angle: [start, end].map(change) }
    }

    fn limit(&self) -> f64 {
        f64::INFINITY
    }

    fn is_linear(&self) -> bool {
        true
    }
}

/// Hobby's cubics (thesis eq. 4.11).
#[derive(Clone, Copy, Debug)]
pub struct HobbyCubics {
    /// Tension where a knot gives none; negative for "at least".
    pub tension: f64,
}

impl SegmentShape for HobbyCubics {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        let arms = hobby_arms(ends.angles, tensions(&ends.context, self.tension));
        let ChordAngles { theta0, theta1 } = ends.angles;
        let cubic = UnitBezier::from_arms(-theta0, theta1, arms);
        Segment::unit_curve(start, end, Arc::new(Measured::new(cubic)))
    }

    fn keeps_curvature(&self) -> bool {
        false
    }
}

/// Lengths of the cubic's arms for unit chord: ρ/3τ and σ/3τ of thesis eq. 4.11, at most 4
/// (METAFONT's bound, which its angles reach only near half a turn).
///
/// Tensions are those at the start and at the end; a negative one means "at least": the arm is
/// shortened to stay within the triangle of the chord and the tangents, where there is one.
///
/// ```
/// use faircurve::{families::hobby::hobby_arms, frame::ChordAngles};
/// assert_eq!(hobby_arms(ChordAngles::new(0.0, 0.0), [1.0, 2.0]), [1.0 / 3.0, 1.0 / 6.0]);
/// ```
pub fn hobby_arms(angles: ChordAngles, tensions: [f64; 2]) -> [f64; 2] {
    let ChordAngles { theta0, theta1 } = angles;
    let ((s0, c0), (s1, c1)) = (sin_cos(theta0), sin_cos(theta1));
    let alpha = SQRT_2 * (s0 - s1 / 16.0) * (s1 - s0 / 16.0) * (c0 - c1);
    let c = (3.0 - 5f64.sqrt()) / 2.0;
    let arm = |alpha: f64, own: f64, other: f64, tension: f64| {
        const LONGEST: f64 = 4.0;
        let (num, den) = (2.0 + alpha, 1.0 + (1.0 - c) * own + c * other);
        let den = 3.0 * tension.abs() * den;
        if num >= LONGEST * den { LONGEST } else { num / den }
    };
    let mut arms = [arm(alpha, c0, c1, tensions[0]), arm(-alpha, c1, c0, tensions[1])];
    // METAFONT's safety factor keeps the arm's end within the triangle, not on its side.
    const SAFETY: f64 = 1.0 + 1.0 / 4096.0;
    let turning = s0.abs() * c1 + s1.abs() * c0;
    if s0 * s1 >= 0.0 && turning > 0.0 {
        for (i, opposite) in [s1, s0].into_iter().enumerate() {
            if tensions[i] < 0.0 {
                // The law of sines: the distance to where the tangents meet.
                arms[i] = arms[i].min(opposite.abs() / (turning * SAFETY));
            }
        }
    }
    arms
}

#[cfg(test)]
mod tests;
