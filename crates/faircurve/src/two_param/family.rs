//! The rung of two-parameter families: a curvature map and a shape.

use kurbo::Point;

use crate::frame::{ChordAngles, EndCurvature};
use crate::segment::Segment;

/// Curvatures at a segment's ends for unit chord, and how they respond to the end tangents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndCurvatures {
    /// At the start and at the end.
    pub value: [EndCurvature; 2],
    /// `by_angle[end][angle]`: derivative of numerator and denominator at that end by `theta0` or
    /// `theta1`.
    pub by_angle: [[EndCurvature; 2]; 2],
}

/// What holds at a free end of an open run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NaturalEnd {
    /// The last segment is symmetric, `theta0` = `theta1`: an arc, for round families.
    Arc,
    /// The curvature is zero.
    ZeroCurvature,
}

/// A family of segments determined by their end tangents: a curvature map, all that the solver
/// sees, and the shape that fills a segment once its tangents are known (Bespoke section 2).
pub trait TwoParamFamily {
    /// End curvatures for angles within ±[`limit`](Self::limit).
    fn curvatures(&self, angles: ChordAngles) -> EndCurvatures;

    /// The segment from `start` to `end` with these end tangents.
    fn shape(&self, start: Point, end: Point, angles: ChordAngles) -> Segment;

    /// What holds at free ends.
    fn natural_end(&self) -> NaturalEnd;

    /// The largest magnitude of either angle that the family (or its solver) can deal with, below
    /// π.
    fn limit(&self) -> f64;
}
