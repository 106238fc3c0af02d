//! Shapes by name: any tangents may be drawn by any of them (Bespoke section 2), which is what the
//! parameter `shape` of the two-parameter splines chooses.

use kurbo::Point;

use super::catalog::{ParamKind, ParamSpec, Params};
use super::euler::EulerSpirals;
use super::spiro::SpiroSegments;
use crate::segment::Segment;
use crate::two_param::shape::{SegmentEnds, SegmentShape};

/// The parameter that two-parameter splines share; `own` is the shape that belongs to the spline.
pub const SHAPE: ParamSpec = ParamSpec {
    name: "shape",
    summary: "what fills the segments, once their tangents are found",
    kind: ParamKind::Choice { options: &["own", "euler", "spiro"] },
};

/// The shape chosen, or `own`.
pub fn chosen(params: &Params, own: impl SegmentShape + 'static) -> Box<dyn SegmentShape> {
    match params.choice(SHAPE.name, "own") {
        "euler" => Box::new(BorrowedEuler),
        "spiro" => Box::new(SpiroSegments { own }),
        _ => Box::new(own),
    }
}

/// Euler spirals for tangents that another map found: they have curvatures of their own.
#[derive(Clone, Copy, Debug)]
struct BorrowedEuler;

impl SegmentShape for BorrowedEuler {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        EulerSpirals.place(start, end, ends)
    }

    fn keeps_curvature(&self) -> bool {
        false
    }
}
