//! The two parts of a two-parameter spline by its name: the curvature map that finds its tangents,
//! and the shape that fills its segments. For pictures, tables and tests; solving needs only the
//! catalogue.

use super::euler::EulerSpirals;
use crate::two_param::curvature_map::CurvatureMap;
use crate::two_param::shape::SegmentShape;

/// A curvature map and the shape that belongs to it.
#[derive(Debug)]
pub struct Parts {
    /// From end tangents to end curvatures.
    pub map: Box<dyn CurvatureMap>,
    /// What fills the segments.
    pub shape: Box<dyn SegmentShape>,
}

impl Parts {
    fn new(map: impl CurvatureMap + 'static, shape: impl SegmentShape + 'static) -> Option<Self> {
        Some(Parts { map: Box::new(map), shape: Box::new(shape) })
    }
}

/// The parts of the spline of that name with every default; `None` for splines that have no curvature
/// map.
pub fn parts(name: &str) -> Option<Parts> {
    match name {
        "euler" => Parts::new(EulerSpirals, EulerSpirals),
        _ => None,
    }
}
