//! Bridging: a segment much longer than its neighbours hangs on them, not they on it.
//!
//! κ′ and κ″ of a long segment are tiny in its neighbours' units: by the square and the cube of how
//! much longer it is. So the chains on both sides end as if they ended freely, and solved alone they
//! say with which directions and curvatures the long segment starts and ends. Its own equations are
//! then a problem in two unknowns, whose straightest answers are found directly
//! ([`FourParamFamily::between_ends`]); with any of them in place the whole settles in a few steps.

use super::{Badness, FEW, LONG, REACH, Rescue, UNSETTLED};
use crate::four_param::system::RunSystem;
use crate::frame::wrap_angle;
use crate::numeric::block_tridiagonal::BlockTridiagonal;
use crate::tolerance::LOOP;

/// Segments less prominent than this don't dominate their neighbours. Anything from 1 to 10
/// solves about as many; up to 5 the straight forms also replace loops of closed walks of 4.
const PROMINENT: f64 = 5.0;

/// A chain that doesn't settle is itself bridged at a segment at least this prominent. Anything from 30
/// to 300 solves about as many; from 5 on, long runs of random points spend too much on it.
const PROMINENT_IN_CHAIN: f64 = 100.0;

impl Rescue {
    /// Rebuilds a run around its most prominent segment; whether it settles there.
    pub(super) fn bridge(&mut self, system: &mut RunSystem<'_>) -> bool {
        self.bridge_above(system, PROMINENT)
    }

    /// The same if it is more prominent than `least`.
    fn bridge_above(&mut self, system: &mut RunSystem<'_>, least: f64) -> bool {
        let n = system.knots.len();
        let candidates = (0..system.parameters.len()).map(|i| (system.prominence(i), i));
        let Some((_, segment)) = candidates
            .filter(|&(prominence, _)| prominence > least)
            .max_by(|a, b| a.0.total_cmp(&b.0))
        else {
            return false;
        };
        if !self.solve_chains(system, segment) {
            return false;
        }
        let (start, end) = (segment, (segment + 1) % n);
        if n <= 2 * REACH + 2 {
            return self.hang(system, segment);
        }
        let (from, to) = if system.is_closed() {
            ((start + n - REACH) % n, (end + REACH) % n)
        } else {
            (start.saturating_sub(REACH), (end + REACH).min(n - 1))
        };
        let mut around = system.window(from, to);
        around.evaluate();
        let hangs = self.hang(&mut around, (segment + n - from) % n);
        system.adopt(&around, from);
        hangs
    }

    /// Solves what lies on both sides of a segment as if it ended there; whether it settles.
    fn solve_chains(&mut self, system: &mut RunSystem<'_>, segment: usize) -> bool {
        let n = system.knots.len();
        let (start, end) = (segment, (segment + 1) % n);
        system.parameters.fill([0.0; 4]);
        system.knots.iter_mut().for_each(|knot| knot.turn = wrap_angle(knot.turn));
        system.evaluate();
        let mut chains = if system.is_closed() {
            let mut around = system.window(end, start);
            around.free_start();
            around.free_end();
            vec![(end, around)]
        } else {
            let (mut before, mut after) = (system.window(0, start), system.window(end, n - 1));
            before.free_end();
            after.free_start();
            vec![(0, before), (end, after)]
        };
        chains.iter_mut().all(|(first, chain)| {
            let mut matrix = BlockTridiagonal::new(chain.knots.len(), false);
            self.newton(chain, &mut matrix, LONG);
            if Badness::of(chain).unsettled > 0 && !self.budget.is_spent() {
                self.bridge_above(chain, PROMINENT_IN_CHAIN);
            }
            let unsettled = Badness::of(chain).unsettled;
            if unsettled > 0 && (unsettled as f64) < FEW * chain.knots.len() as f64 {
                self.mend(chain);
            }
            system.adopt(chain, *first);
            Badness::of(chain).unsettled == 0
        })
    }

    /// Hangs a segment between chains that are solved: in the straightest form with which the whole
    /// settles. Whether there is one.
    fn hang(&mut self, system: &mut RunSystem<'_>, segment: usize) -> bool {
        /// What finding the forms costs, in segment evaluations.
        const COST: usize = 300;
        /// Forms tried, the straightest first.
        const FORMS: usize = 12;
        let Some(ends) = system.ends_beside(segment) else { return false };
        self.budget.spend(COST);
        let chains = system.state();
        let mut straightest: Option<(f64, _)> = None;
        for form in system.family().between_ends(ends).into_iter().take(FORMS) {
            self.return_to(system, &chains);
            system.parameters[segment] = form;
            system.evaluate();
            system.unwind();
            if self.solve_window(system).residual <= UNSETTLED {
                let straightness = system.least_straightness();
                if straightest.as_ref().is_none_or(|(most, _)| straightness > *most) {
                    straightest = Some((straightness, system.state()));
                }
                if straightness * LOOP > 1.0 {
                    break;
                }
            }
            if self.budget.is_spent() {
                break;
            }
        }
        let found = straightest.is_some();
        self.return_to(system, &straightest.map_or(chains, |(_, state)| state));
        found
    }
}
