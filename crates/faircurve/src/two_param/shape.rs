//! Shapes: what fills a segment once its tangents are known.

use std::fmt;

use kurbo::Point;

use super::curvature_map::SegmentContext;
use crate::frame::{ChordAngles, EndCurvature};
use crate::segment::Segment;

/// What is known of a segment before it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentEnds {
    /// The tangents.
    pub angles: ChordAngles,
    /// Curvatures at the start and the end for unit chord, where the rule speaks of them.
    pub curvatures: Option<[EndCurvature; 2]>,
    /// What else is given.
    pub context: SegmentContext,
}

/// Another shape in the place of the one asked for: same tangents, perhaps other curvatures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandIn {
    /// The name of the shape asked for.
    pub asked: &'static str,
    /// The name of the shape drawn.
    pub got: &'static str,
    /// Why, in words for a designer.
    pub reason: &'static str,
}

/// Fills segments.
pub trait SegmentShape: fmt::Debug + Send + Sync {
    /// The segment from `start` to `end`, which differ; finite for all angles.
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment;

    /// Like [`place`](Self::place), and what stands in where this shape can't fill the segment.
    fn place_or_stand_in(
        &self,
        start: Point,
        end: Point,
        ends: &SegmentEnds,
    ) -> (Segment, Option<StandIn>) {
        (self.place(start, end, ends), None)
    }

    /// Whether the segment has the end curvatures that it is told, or those of the map that it
    /// belongs to; if not, only tangents are continuous.
    fn keeps_curvature(&self) -> bool;
}

impl SegmentShape for Box<dyn SegmentShape> {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        (**self).place(start, end, ends)
    }

    fn place_or_stand_in(
        &self,
        start: Point,
        end: Point,
        ends: &SegmentEnds,
    ) -> (Segment, Option<StandIn>) {
        (**self).place_or_stand_in(start, end, ends)
    }

    fn keeps_curvature(&self) -> bool {
        (**self).keeps_curvature()
    }
}
