//! KURGLA 1, the spline of the Autokon system: segments whose curvature is linear in the distance
//! along the chord, joined with continuous curvature (thesis sections 3.11, 4.9).

mod along;
mod segment;

use kurbo::Point;

use super::catalog::{Claim, Params, SplineInfo};
use super::ends;
use super::euler::EulerSpirals;
use super::shapes::{self, SHAPE};
use crate::frame::ChordAngles;
use crate::outline::Join;
use crate::segment::Segment;
use crate::spline::Spline;
use crate::two_param::continuity::Continuity;
use crate::two_param::curvature_map::{CurvatureMap, EndCurvatures, SegmentContext};
use crate::two_param::shape::{SegmentEnds, SegmentShape, StandIn};
use crate::two_param::spline::TwoParamSpline;

use segment::LIMIT;
pub use segment::{SiMec, fit_si_mec};

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "kurgla1",
    summary: "curvature linear along each chord, continuous at knots: Mehlum's KURGLA 1",
    source: "thesis 3.11, 4.9",
    params: &[ends::END, SHAPE],
    default_join: Join::G2,
    joins: &[Join::Corner, Join::G1, Join::G2],
    ends: ends::NAMES,
    claims: &[
        Claim::Parameters(2),
        Claim::Continuity(2),
        Claim::Round,
        Claim::SimilarityInvariant,
        Claim::Symmetric,
        Claim::Ripple(0.267_949_192_431_122_7),
    ],
    build: |params| Ok(build(params)),
};

fn build(params: &Params) -> Box<dyn Spline> {
    let end = ends::chosen(params);
    let rule = Continuity { map: SiMecs, end };
    Box::new(TwoParamSpline::new(&INFO, rule, shapes::chosen(params, SiMecs)))
}

/// The family: pieces of elastica whose line of action is perpendicular to the chord.
#[derive(Clone, Copy, Debug)]
pub struct SiMecs;

impl CurvatureMap for SiMecs {
    fn curvatures(&self, angles: ChordAngles, context: &SegmentContext) -> EndCurvatures {
        match segment::fit(angles) {
            Ok((fit, along)) => fit.response(&along),
            // Nowhere within `limit`.
            Err(_) => EulerSpirals.curvatures(angles, context),
        }
    }

    fn limit(&self) -> f64 {
        LIMIT
    }
}

impl SegmentShape for SiMecs {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        self.place_or_stand_in(start, end, ends).0
    }

    fn place_or_stand_in(
        &self,
        start: Point,
        end: Point,
        ends: &SegmentEnds,
    ) -> (Segment, Option<StandIn>) {
        match fit_si_mec(ends.angles) {
            Ok(fit) => (Segment::elastica(start, end, fit.elastica()), None),
            Err(_) => {
                let reason = "the tangents given there would close the segment into a circle \
                              without a chord; turn them, or add a knot";
                let stand_in = StandIn { asked: INFO.name, got: "euler", reason };
                (EulerSpirals.place(start, end, ends), Some(stand_in))
            }
        }
    }

    fn keeps_curvature(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests;
