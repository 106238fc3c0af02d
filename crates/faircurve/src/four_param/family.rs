//! The rung of four-parameter families: what the spline solver sees of a segment.

use std::fmt;

use kurbo::Point;

use crate::segment::Segment;

/// Tangents and curvatures at a segment's ends for unit chord, with the curvature derivatives that
/// follow from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// `theta0`, `theta1` (see [`ChordAngles`](crate::frame::ChordAngles)), κ at the start, κ at the end.
    pub jets: [f64; 4],
    /// κ′ and κ″ at the start, κ′ and κ″ at the end.
    pub derivatives: [f64; 4],
    /// Chord over arc length, in [0, 1].
    pub straightness: f64,
}

/// The ends of a segment, and how they respond to a change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// The ends of the present segment.
    pub ends: Ends,
    /// ∂(derivatives)/∂(jets), by rows.
    pub derivatives_by_jets: [[f64; 4]; 4],
    /// ∂(the family's own parameters)/∂(jets), by rows.
    pub parameters_by_jets: [[f64; 4]; 4],
}

impl Response {
    /// Of nothing that was asked.
    pub(crate) const NONE: Response = Response {
        ends: Ends { jets: [f64::NAN; 4], derivatives: [f64::NAN; 4], straightness: 0.0 },
        derivatives_by_jets: [[f64::NAN; 4]; 4],
        parameters_by_jets: [[f64::NAN; 4]; 4],
    };
}

/// Curves with four parameters for given ends, such as polynomial spirals or minimum variation
/// curves. Parameters are the family's own business; all zero must be the straight line.
pub trait FourParamFamily: fmt::Debug {
    /// The ends of the segment with these parameters, and their response.
    fn respond(&self, parameters: [f64; 4]) -> Response;

    /// Writes that, or what is [roughly](Self::respond_roughly) that, where it belongs: it is large, and moved when it
    /// is returned by a family that isn't known by type.
    fn respond_to(&self, parameters: [f64; 4], is_rough: bool, response: &mut Response) {
        *response =
            if is_rough { self.respond_roughly(parameters) } else { self.respond(parameters) };
    }

    /// The ends alone.
    fn ends(&self, parameters: [f64; 4]) -> Ends;

    /// The same to about 1e-7, if that is faster: for searching. A smooth function too, whose
    /// derivatives are its own.
    fn respond_roughly(&self, parameters: [f64; 4]) -> Response {
        self.respond(parameters)
    }

    /// The parameters of the segment with these end tangents and κ″ = 0 at both ends (`theta0` and
    /// `theta1` as at [`ChordAngles`](crate::frame::ChordAngles), within ±π): what G1 knots are joined by. Must always
    /// be drawable.
    fn between_tangents(&self, theta0: f64, theta1: f64) -> [f64; 4];

    /// Segments with these ends (in the order of [`Ends::jets`], directions modulo full turns),
    /// the straightest first: all but the most wound up that a search on a grid finds.
    fn between_ends(&self, ends: [f64; 4]) -> Vec<[f64; 4]>;

    /// The segment from `start` to `end` with these parameters.
    fn shape(&self, start: Point, end: Point, parameters: [f64; 4]) -> Segment;

    /// The parameters of a segment that [`shape`](Self::shape) made, to start from; `None` for other
    /// segments.
    fn parameters(&self, _segment: &Segment) -> Option<[f64; 4]> {
        None
    }

    /// The largest change of direction, in radians, that a change of parameters makes anywhere on
    /// the segment (an upper bound), by which steps are limited.
    fn bend(&self, change: [f64; 4]) -> f64;
}
