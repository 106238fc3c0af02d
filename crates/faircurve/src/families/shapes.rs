//! Shapes by name: any tangents may be drawn by any of them (Bespoke section 2), which is what the
//! parameter `shape` of the two-parameter splines chooses.

use super::bespoke::BespokeCubics;
use super::catalog::{ParamKind, ParamSpec, Params};
use super::euler::EulerSpirals;
use super::hobby::HobbyCubics;
use super::ikarus::Biarcs;
use super::kappa::BiParabolas;
use super::potrace::PotraceCubics;
use super::spiro::PolynomialSpirals;
use crate::two_param::shape::SegmentShape;

/// The parameter that two-parameter splines share; `own` is the shape that belongs to the spline.
pub const SHAPE: ParamSpec = ParamSpec {
    name: "shape",
    summary: "what fills the segments, once their tangents are found",
    kind: ParamKind::Choice {
        options: &["own", "euler", "spiro", "hobby", "bespoke", "potrace", "biarc", "bi-parabola"],
    },
};

/// The shape chosen, or `own`.
pub fn chosen(params: &Params, own: impl SegmentShape + 'static) -> Box<dyn SegmentShape> {
    match params.choice(SHAPE.name, "own") {
        "euler" => Box::new(EulerSpirals),
        "hobby" => Box::new(HobbyCubics { tension: 1.0 }),
        "potrace" => Box::new(PotraceCubics),
        "biarc" => Box::new(Biarcs),
        "bespoke" => Box::new(BespokeCubics),
        "bi-parabola" => Box::new(BiParabolas),
        "spiro" => Box::new(PolynomialSpirals),
        _ => Box::new(own),
    }
}
