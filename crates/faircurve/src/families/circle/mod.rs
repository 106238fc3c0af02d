//! The circle spline of Séquin, Lee and Yen: at each knot the tangent of the circle through it and
//! its neighbours, between knots a blend of the two circles (thesis section 4.10).

mod blend;

use std::f64::consts::PI;
use std::sync::Arc;

use kurbo::Point;

use super::catalog::{Claim, SplineInfo};
use super::euler::EulerSpirals;
use super::shapes::{self, SHAPE};
use crate::frame::{EndCurvature, circle_tangent, direction, wrap_angle};
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::{Measured, PolynomialSpiral, Segment};
use crate::two_param::shape::{SegmentEnds, SegmentShape, StandIn};
use crate::two_param::spline::TwoParamSpline;
use crate::two_param::tangents::{TangentRule, Tangents};

pub use blend::CircleBlend;

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "circle",
    summary: "tangents of the circles through three knots each, and blends of these circles",
    source: "thesis 4.10; Séquin, Lee and Yen 2005",
    params: &[SHAPE],
    default_join: Join::G2,
    joins: &[Join::Corner, Join::G1, Join::G2],
    ends: &["arc"],
    claims: &[
        Claim::Parameters(2),
        Claim::Continuity(2),
        Claim::Round,
        Claim::SimilarityInvariant,
        Claim::Symmetric,
        Claim::FiniteSupport(2),
    ],
    build: |params| {
        let shape = shapes::chosen(params, CircleBlends);
        Ok(Box::new(TwoParamSpline::new(&INFO, CircleTangents, shape)))
    },
};

/// End tangents up to this can be blended: at π the circle is the straight line through infinity.
///
/// Tuned: here the arc is 3,100 chords long, larger than any drawing and far from where
/// rounding shows.
const LIMIT: f64 = PI - 1e-3;

/// At each knot the tangent of the circle through the knot and its two neighbours; at free ends
/// that of the circle through the first or last three knots.
#[derive(Clone, Copy, Debug)]
pub struct CircleTangents;

impl TangentRule for CircleTangents {
    fn tangents(&self, run: &Run) -> Tangents {
        let n = run.knots.len();
        let mut mismatch = vec![0.0; n];
        let mut directions = vec![0.0; n];
        for i in 0..n {
            if !run.closed && (i == 0 || i + 1 == n) {
                continue;
            }
            let (before, after) = ((i + n - 1) % n, (i + 1) % n);
            let [a, b, c] = [before, i, after].map(|i| run.knots[i].point);
            let chord = direction(run.chord(i));
            // theta0 of the chord after; theta1 of the one before is the rest of the turn.
            let wanted = wrap_angle(chord - circle_tangent(a, b, c));
            let turn = run.knots[i].turn;
            let theta0 = wanted.clamp((turn - LIMIT).max(-LIMIT), (turn + LIMIT).min(LIMIT));
            directions[i] = chord - theta0;
            if theta0 != wanted {
                let curvature = |theta: f64, chord: f64| 2.0 * theta.sin() / chord;
                let (l, r) = (run.chord(before).hypot(), run.chord(i).hypot());
                let jump = curvature(turn - theta0, l) - curvature(theta0, r);
                mismatch[i] = jump.abs() * 2.0 * l * r / (l + r);
            }
        }
        if !run.closed {
            // Arcs: as far on one side of the chord as on the other.
            for (end, inner) in [(0, 1), (n - 1, n - 2)] {
                let chord = direction(run.chord(end.min(inner)));
                let is_found = n > 2 || run.knots[inner].tangent.is_some();
                let known = run.knots[inner].tangent.unwrap_or(directions[inner]);
                directions[end] = if is_found { 2.0 * chord - known } else { chord };
            }
        }
        let mut tangents = Tangents::from_directions(run, directions);
        for ends in &mut tangents.ends {
            let circle = |theta: f64| EndCurvature::finite(2.0 * theta.sin());
            ends.curvatures = Some([circle(ends.angles.theta0), circle(ends.angles.theta1)]);
        }
        Tangents { mismatch, ..tangents }
    }
}

/// Segments that turn from one circle to the other.
#[derive(Clone, Copy, Debug)]
pub struct CircleBlends;

impl SegmentShape for CircleBlends {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        self.place_or_stand_in(start, end, ends).0
    }

    fn place_or_stand_in(
        &self,
        start: Point,
        end: Point,
        ends: &SegmentEnds,
    ) -> (Segment, Option<StandIn>) {
        let angles = ends.angles;
        // Only where such tangents are given: the rule keeps within the limit but for rounding.
        if !(angles.theta0.abs().max(angles.theta1.abs()) <= LIMIT + 1e-9) {
            let reason = "the tangents given there point back along the segment, where circles \
                          have no end; turn them, or add a knot";
            let stand_in = StandIn { asked: INFO.name, got: "euler", reason };
            return (EulerSpirals.place(start, end, ends), Some(stand_in));
        }
        let blend = CircleBlend::new(angles);
        if blend.is_arc() {
            let arc = PolynomialSpiral::new([angles.turning(), 0.0, 0.0, 0.0]);
            return (Segment::spiral(start, end, arc), None);
        }
        (Segment::unit_curve(start, end, Arc::new(Measured::new(blend))), None)
    }

    fn keeps_curvature(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests;
