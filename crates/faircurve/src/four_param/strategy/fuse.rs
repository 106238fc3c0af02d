//! Fusing: two knots much nearer to each other than to all others are nearly one.
//!
//! As the segment between them vanishes it becomes straight, and says nothing but which way the
//! curve goes there. κ and κ′ are continuous in the limit; κ″ may jump, since the segment's own κ‴
//! has room to be as large as it must. That is a G4 knot with a given tangent. So the run with one
//! such knot for each such pair is solved, by whatever it takes; with the short segments put back,
//! straight, the whole settles in a few steps.

use super::{Best, LONG, Rescue};
use crate::four_param::budget::Budget;
use crate::four_param::system::RunSystem;
use crate::numeric::block_tridiagonal::BlockTridiagonal;
use crate::spline::Stage;

impl Rescue {
    /// Solves the run with its short segments fused, and lets the whole settle from there; `None` where
    /// no segment is so short, or too little is left to spend.
    pub(super) fn fuse(
        &mut self,
        system: &mut RunSystem<'_>,
        matrix: &mut BlockTridiagonal<2>,
    ) -> Option<Best> {
        /// A segment shorter than this share of its neighbours is nearly a point. Anything from 0.001
        /// to 0.3 solves about as many of those with one; from 0.1 on, random points have many, and
        /// their fused runs are as hard.
        const SHORT: f64 = 0.01;
        /// Share of the budget for the fused run. Anything from 0.15 to 0.6 solves about as many.
        const SHARE: f64 = 0.3;
        /// Less than this for each segment doesn't even pay for Newton's method.
        const COST: usize = 16;
        let segments = system.parameters.len();
        let part = (self.budget.left() as f64 * SHARE) as usize;
        if system.knots.len() <= 3 || part < segments * COST {
            return None;
        }
        let is_short = system.short_segments(SHORT);
        if !is_short.contains(&true) {
            return None;
        }
        let mut fused = system.fused(&is_short);
        self.budget.spend(part);
        let rest = std::mem::replace(&mut self.budget, Budget::new(part));
        let mut smaller = BlockTridiagonal::new(fused.knots.len(), fused.is_closed());
        self.run(&mut fused, &mut smaller);
        self.budget.put_back(rest);
        system.take_from_fused(&fused, &is_short);
        let residual = self.newton(system, matrix, LONG).residual;
        Some(Best::of(system, residual, Stage::Fused))
    }
}
