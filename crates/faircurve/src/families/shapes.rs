//! Shapes by name: any tangents may be drawn by any of them (Bespoke section 2), which is what the
//! parameter `shape` of the two-parameter splines chooses.

use kurbo::Point;

use super::bespoke::BespokeCubics;
use super::catalog::{ParamKind, ParamSpec, Params};
use super::euler::EulerSpirals;
use super::hobby::HobbyCubics;
use super::ikarus::Biarcs;
use super::kappa::BiParabolas;
use super::potrace::PotraceCubics;
use super::spiro::SpiroSegments;
use crate::segment::Segment;
use crate::two_param::shape::{SegmentEnds, SegmentShape};

/// The parameter that two-parameter splines share; `own` is the shape that belongs to the spline.
pub const SHAPE: ParamSpec = ParamSpec {
    name: "shape",
    summary: "what fills the segments, once their tangents are found",
    kind: ParamKind::Choice {
        options: &["own", "spiro", "euler", "hobby", "bespoke", "potrace", "biarc", "bi-parabola"],
    },
};

/// The shape chosen, or `own`.
pub fn chosen(params: &Params, own: impl SegmentShape + 'static) -> Box<dyn SegmentShape> {
    match params.choice(SHAPE.name, "own") {
        "spiro" => Box::new(SpiroSegments { own }),
        "euler" => Box::new(Borrowed(EulerSpirals)),
        "hobby" => Box::new(Borrowed(HobbyCubics { tension: 1.0 })),
        "bespoke" => Box::new(Borrowed(BespokeCubics)),
        "potrace" => Box::new(Borrowed(PotraceCubics)),
        "biarc" => Box::new(Borrowed(Biarcs)),
        "bi-parabola" => Box::new(Borrowed(BiParabolas)),
        _ => Box::new(own),
    }
}

/// A shape for tangents that another map found: it has curvatures of its own.
#[derive(Clone, Copy, Debug)]
struct Borrowed<S>(S);

impl<S: SegmentShape> SegmentShape for Borrowed<S> {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        self.0.place(start, end, ends)
    }

    fn keeps_curvature(&self) -> bool {
        false
    }
}
