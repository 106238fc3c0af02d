//! The polygon: straight lines, the spline without parameters (thesis sections 2.2, 2.8), and the
//! baseline of the laws.

use super::catalog::{Claim, SplineInfo};
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::Segment;
use crate::spline::{Effort, RunSolution, Spline};

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "polygon",
    summary: "straight lines",
    source: "thesis 2.2, 2.8",
    params: &[],
    default_join: Join::Corner,
    joins: &[Join::Corner],
    ends: &["line"],
    claims: &[
        Claim::Parameters(0),
        Claim::Continuity(0),
        Claim::RoundToOrder(2),
        Claim::Extensional,
        Claim::MonotoneCurvature,
        Claim::SimilarityInvariant,
        Claim::Symmetric,
        Claim::AffineInvariant,
        Claim::FiniteSupport(1),
        Claim::Exists,
        Claim::Continuous,
    ],
    build: |_| Ok(Box::new(Polygon)),
};

/// Straight lines from knot to knot.
#[derive(Clone, Copy, Debug)]
pub struct Polygon;

impl Spline for Polygon {
    fn name(&self) -> &'static str {
        INFO.name
    }

    fn default_join(&self) -> Join {
        Join::Corner
    }

    fn adapt(&self, _join: Join) -> Join {
        Join::Corner
    }

    fn solve_plainly(&self, run: &Run) -> Option<RunSolution> {
        Some(self.solve_run(run, Effort::NONE))
    }

    fn solve_run(&self, run: &Run, _effort: Effort) -> RunSolution {
        let n = run.knots.len();
        let line = |i: usize| Segment::line(run.knots[i].point, run.knots[(i + 1) % n].point);
        let segments = (0..run.segment_count()).map(line).collect();
        RunSolution { segments, ..RunSolution::default() }
    }
}

#[cfg(test)]
mod tests;
