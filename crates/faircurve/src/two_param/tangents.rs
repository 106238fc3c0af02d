//! Rules that give each knot of a run its tangent.

use std::fmt;

use super::curvature_map::SegmentContext;
use super::shape::SegmentEnds;
use crate::frame::{ChordAngles, direction, wrap_angle};
use crate::plan::{Run, around};
use crate::spline::{Adaptation, Effort, Place, Stage};

/// A way to find the tangents of a run.
pub trait TangentRule: fmt::Debug + Send + Sync {
    /// The tangents found the straight way.
    fn tangents(&self, run: &Run) -> Tangents;

    /// The tangents found the straight way from those that are known, one pair a segment; for rules
    /// that have but one answer, the answer.
    fn tangents_near(&self, run: &Run, _near: &[ChordAngles]) -> Tangents {
        self.tangents(run)
    }

    /// The tangents found by a search, where the straight way leaves equations unmet.
    fn search(&self, run: &Run, _effort: Effort) -> Tangents {
        self.tangents(run)
    }
}

/// The tangents of a run.
#[derive(Clone, Debug, Default)]
pub struct Tangents {
    /// One entry for each segment.
    pub ends: Vec<SegmentEnds>,
    /// How far each knot's equation is from being met, in radians; all zero for rules without
    /// equations.
    pub mismatch: Vec<f64>,
    /// What of the input the rule can't use.
    pub adapted: Vec<Adaptation>,
    /// Newton steps taken.
    pub iterations: usize,
    /// How far the rule had to go.
    pub stage: Stage,
}

impl Tangents {
    /// Tangents in these directions at the knots of a run, as a local rule has them: those given at
    /// the ends of the run take their place, and so does nothing else that is given.
    pub fn from_directions(run: &Run, mut directions: Vec<f64>) -> Tangents {
        let (n, segments) = (run.knots.len(), run.segment_count());
        for (i, knot) in run.knots.iter().enumerate() {
            directions[i] = knot.tangent.unwrap_or(directions[i]);
        }
        let ends = (0..segments)
            .map(|i| {
                let chord = direction(run.chord(i));
                let (start, end) = (directions[i], directions[(i + 1) % n]);
                SegmentEnds {
                    angles: ChordAngles::new(wrap_angle(chord - start), wrap_angle(end - chord)),
                    curvatures: None,
                    context: context(run, i),
                }
            })
            .collect();
        let adapted =
            (0..n).filter(|&i| run.knots[i].curvature.is_some()).map(ignored_curvature).collect();
        Tangents { ends, mismatch: vec![0.0; n], adapted, ..Tangents::default() }
    }

    /// The tangents alone.
    pub fn angles(&self) -> Vec<ChordAngles> {
        self.ends.iter().map(|ends| ends.angles).collect()
    }

    /// The largest mismatch.
    pub fn residual(&self) -> f64 {
        self.mismatch
            .iter()
            .fold(0.0, |most, off| if off.is_nan() { f64::MAX } else { most.max(*off) })
    }
}

/// The chord and the tensions of a segment.
pub(crate) fn context(run: &Run, segment: usize) -> SegmentContext {
    let (start, end) = (&run.knots[segment], &run.knots[around(segment + 1, run.knots.len())]);
    let (is_first, is_last) = (segment == 0, segment + 1 == run.segment_count());
    SegmentContext {
        chord: run.chord(segment).hypot(),
        tension: [start.tension[1], end.tension[0]],
        given_direction: [
            !run.closed && is_first && start.tangent.is_some(),
            !run.closed && is_last && end.tangent.is_some(),
        ],
    }
}

/// A given curvature that the spline has no room for.
pub(crate) fn ignored_curvature(knot: usize) -> Adaptation {
    Adaptation { place: Place::Knot(knot), asked: "curvature", got: "ignored" }
}

/// A given curvature that the tangents were found with, and that the shape drawn hasn't.
pub(crate) fn curvature_of_tangents_only(knot: usize) -> Adaptation {
    Adaptation { place: Place::Knot(knot), asked: "curvature", got: "tangents only" }
}
