//! Shapes by name: any tangents may be drawn by any of them (Bespoke section 2), which is what the
//! parameter `shape` of the two-parameter splines chooses.

use super::catalog::{ParamKind, ParamSpec, Params};
use super::euler::EulerSpirals;
use super::hobby::HobbyCubics;
use super::ikarus::Biarcs;
use super::potrace::PotraceCubics;
use crate::two_param::shape::SegmentShape;

/// The parameter that two-parameter splines share; `own` is the shape that belongs to the spline.
pub const SHAPE: ParamSpec = ParamSpec {
    name: "shape",
    summary: "what fills the segments, once their tangents are found",
    kind: ParamKind::Choice { options: &["own", "euler", "hobby", "potrace", "biarc"] },
};

/// The shape chosen, or `own`.
pub fn chosen(params: &Params, own: impl SegmentShape + 'static) -> Box<dyn SegmentShape> {
    match params.choice(SHAPE.name, "own") {
        "euler" => Box::new(EulerSpirals),
        "hobby" => Box::new(HobbyCubics { tension: 1.0 }),
        "potrace" => Box::new(PotraceCubics),
        "biarc" => Box::new(Biarcs),
        _ => Box::new(own),
    }
}
