//! Curvature maps: all of a segment that the search for tangents sees (Bespoke section 2).

use std::fmt;

use crate::frame::{ChordAngles, EndCurvature};

/// What a segment knows besides the tangents at its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentContext {
    /// Length of the chord, in the run's units.
    pub chord: f64,
    /// Tension at the start and at the end, where given.
    pub tension: [Option<f64>; 2],
    /// Whether the direction at the start and at the end is given.
    pub given_direction: [bool; 2],
}

impl SegmentContext {
    /// A unit chord with nothing given.
    pub const UNIT: SegmentContext =
        SegmentContext { chord: 1.0, tension: [None, None], given_direction: [false, false] };
}

/// Curvatures at a segment's ends for unit chord, and how they respond to the end tangents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndCurvatures {
    /// At the start and at the end.
    pub value: [EndCurvature; 2],
    /// `by_angle[end][angle]`: derivative of numerator and denominator at that end by `theta0` or
    /// `theta1`.
    pub by_angle: [[EndCurvature; 2]; 2],
}

impl EndCurvatures {
    /// Of a straight line that nothing bends.
    pub(crate) const ZERO: EndCurvatures = EndCurvatures {
        value: [EndCurvature::finite(0.0); 2],
        by_angle: [[EndCurvature { num: 0.0, den: 0.0 }; 2]; 2],
    };

    /// What they become, to first order, when the tangents turn by so much.
    pub(crate) fn turn(&mut self, change: [f64; 2]) {
        for (value, by_angle) in self.value.iter_mut().zip(&self.by_angle) {
            for (by, change) in by_angle.iter().zip(change) {
                value.num += by.num * change;
                value.den += by.den * change;
            }
        }
    }
}

/// A segment, and what its map says of it.
#[derive(Clone, Copy, Debug)]
pub struct MappedSegment {
    /// What the segment knows besides its tangents.
    pub context: SegmentContext,
    /// The angles that the response is for; not numbers before there is one.
    pub angles: ChordAngles,
    /// The end curvatures.
    pub response: EndCurvatures,
    /// Whether the response has yet to be found.
    pub is_asked: bool,
}

impl MappedSegment {
    /// A segment of which nothing is known but its context.
    pub(crate) fn new(context: SegmentContext) -> Self {
        let angles = ChordAngles::new(f64::NAN, f64::NAN);
        MappedSegment { context, angles, response: EndCurvatures::ZERO, is_asked: false }
    }
}

/// From end tangents to end curvatures.
pub trait CurvatureMap: fmt::Debug + Send + Sync {
    /// End curvatures for angles within ±[`limit`](Self::limit); finite numbers always.
    fn curvatures(&self, angles: ChordAngles, context: &SegmentContext) -> EndCurvatures;

    /// Answers for all segments that are asked: one call of a map that isn't known by type, not one each.
    fn answer(&self, segments: &mut [MappedSegment]) {
        for segment in segments.iter_mut().filter(|segment| segment.is_asked) {
            segment.response = self.curvatures(segment.angles, &segment.context);
        }
    }

    /// The largest magnitude of either angle that the map can deal with; infinite if it is defined
    /// everywhere.
    fn limit(&self) -> f64;

    /// Whether it is linear with denominators of 1, so that one linear system gives the tangents.
    fn is_linear(&self) -> bool {
        false
    }

    /// Whether it has period π in both angles: the curve is the same, while at the end whose tangent
    /// is turned numerator and denominator change their sign (Bespoke section 2.2).
    fn is_periodic(&self) -> bool {
        false
    }

    /// The power of a change of angle with which curvature leaves zero, 1 for most. The search
    /// compares roots of that order of the curvatures at a knot, which are nearly linear.
    fn order(&self) -> f64 {
        1.0
    }
}
