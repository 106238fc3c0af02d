//! How a run is solved when plain Newton iteration isn't enough. The measurements behind it are in
//! `docs/decisions/0004-strategy.md`.
//!
//! 1. **Newton** from straight segments, each segment's step limited on its own, so that good
//!    stretches settle while bad ones still bounce. Nearly all real contours end here. Two and three
//!    knots, and knots on a circle, start from arcs, which are the solution.
//! 2. **Fusing** ([`fuse`]), where segments are much shorter than their neighbours: the run in which
//!    the two knots of each are one is solved by all these stages, and the segments put back.
//! 3. **Bridging** ([`bridge`]), where a segment is much longer than its neighbours: the chains on
//!    both sides are solved alone, and the long segment is hung between them in its straightest form.
//! 4. **Mending** ([`mend`]), where few knots are bad. A stretch that doesn't settle, or loops, is
//!    restarted alone, its rim held, with other *windings* and other seeds, until it settles. Windings
//!    decide hard cases: a knot at which the chords turn by t may have to be joined as t ∓ 2π, the
//!    other way round.
//! 5. **Growing** ([`grow`]), where something is still bad. The run is built anew knot by knot: each
//!    step adds one and lets the last few settle with a free end, in the few windings nearest to the
//!    natural one. What is left is mended, and the whole run solved on from there.
//!
//! What stages 4 and 5 find is straightened in the end, where it winds more than it must.
//!
//! The search sees rounded numbers, so that it takes the same course however the drawing is moved,
//! turned or scaled; the last word is Newton's, on the exact ones. It is deterministic: seeds are
//! fixed, and the budget counts work, not time.

mod bridge;
mod fuse;
mod grow;
mod mend;

use std::cmp::Ordering;
use std::f64::consts::TAU;

use crate::four_param::budget::Budget;
use crate::four_param::system::{RunSystem, State, SystemKnot};
use crate::frame::wrap_angle;
use crate::numeric::block_tridiagonal::BlockTridiagonal;
use crate::numeric::newton::{Limits, Outcome, newton, newton_while};
use crate::spline::Stage;
use crate::tolerance::SOLVED;

/// How plain Newton iteration is limited. Runs that converge take 3 to 10 steps; with more of them
/// success comes to depend on rounding errors, and so on how the drawing is turned.
const PLAIN: Limits = Limits { iterations: 16, patience: 8 };

/// The same within the search, whose numbers are rounded.
const LONG: Limits = Limits { iterations: 30, patience: 12 };

/// A stretch that settles does so in fewer.
const WINDOW: Limits = Limits { iterations: 12, patience: 8 };

/// Whether a stretch is on its way to settle after so many steps, and not there yet.
fn is_promising(so_far: Outcome) -> bool {
    /// Steps after which the residual of a stretch must be below 10, and then fall tenfold in four.
    /// Of stretches whose restart was a success, hardly any would have been given up, of all work a
    /// fifth is saved.
    const GRACE: f64 = 6.0;
    /// The whole run settles it further.
    const SETTLED: f64 = 1e-6;
    let steps = so_far.iterations as f64;
    let bound = 10f64.powf(1.0 - (steps - GRACE) / 4.0);
    so_far.residual > SETTLED && (steps < GRACE || so_far.residual <= bound)
}

/// Knots whose residual exceeds this haven't settled.
pub(in crate::four_param) const UNSETTLED: f64 = 1e-4;

/// With a smaller share of unsettled knots than this, the rest is good ground for mending.
const FEW: f64 = 0.3;

/// The effect of one knot on another falls by a factor of about ¼ (G2) or ½ (G4) a knot: this far
/// away it is small.
const REACH: usize = 10;

/// Stage 1. Solves the system if plain iteration leads to a curve without loops; else leaves the
/// state that it ended in. `arcs` gives segments between circle tangents.
pub(in crate::four_param) fn solve_plainly(
    system: &mut RunSystem<'_>,
    matrix: &mut BlockTridiagonal<2>,
    budget: &mut Budget,
    arcs: impl Fn() -> Vec<[f64; 4]>,
) -> (Outcome, bool) {
    // Three knots always lie on a circle, two too many times.
    if system.knots.len() <= 3
        && let Some(round) = solve_round(system, matrix, budget, arcs())
    {
        return (round, true);
    }
    let plain = newton(system, matrix, PLAIN);
    budget.spend(cost(system, plain.iterations));
    if plain.residual <= SOLVED && system.loops().next().is_none() {
        return (plain, true);
    }
    match solve_round(system, matrix, budget, arcs()) {
        Some(round) => (round, true),
        None => (plain, false),
    }
}

/// Newton's method from a state that is nearly the solution.
pub(in crate::four_param) fn settle(
    system: &mut RunSystem<'_>,
    matrix: &mut BlockTridiagonal<2>,
) -> Outcome {
    newton(system, matrix, PLAIN)
}

/// Stages 2 to 5, from the state that [`solve_plainly`] left. Ends in the best state found.
pub(in crate::four_param) fn search(
    system: &mut RunSystem<'_>,
    matrix: &mut BlockTridiagonal<2>,
    plain: Outcome,
    budget: &mut Budget,
) -> (Outcome, Stage) {
    // The last word costs something too.
    let last_word = cost(system, PLAIN.iterations);
    if budget.left() <= last_word {
        return (plain, Stage::Plain);
    }
    let plain_state = system.state();
    let mut rounded = system.rounded();
    budget.spend(last_word);
    let mut rescue = Rescue::new(&rounded, std::mem::take(budget));
    let stage = rescue.run(&mut rounded, matrix);
    system.take_from_rounded(&rounded);
    let rescued = newton(system, matrix, PLAIN);
    *budget = rescue.budget;
    budget.put_back(Budget::new(last_word - cost(system, rescued.iterations)));
    let iterations = plain.iterations + rescue.iterations + rescued.iterations;
    if rescued.residual > SOLVED && plain.residual <= SOLVED {
        system.set_state(&plain_state);
        return (Outcome { iterations, ..plain }, Stage::Plain);
    }
    (Outcome { iterations, ..rescued }, stage)
}

/// Knots on a circle: the circle it is, though most of it may lie between two of them.
fn solve_round(
    system: &mut RunSystem<'_>,
    matrix: &mut BlockTridiagonal<2>,
    budget: &mut Budget,
    arcs: Vec<[f64; 4]>,
) -> Option<Outcome> {
    let before = std::mem::replace(&mut system.parameters, arcs);
    let mut round = newton(system, matrix, Limits { iterations: 0, patience: 0 });
    let is_round = round.residual <= SOLVED;
    if is_round {
        round = newton(system, matrix, PLAIN);
    } else {
        system.parameters = before;
        system.evaluate();
    }
    budget.spend(cost(system, 1 + round.iterations));
    is_round.then_some(round)
}

/// Segment evaluations of Newton's method that has taken so many steps.
fn cost(system: &RunSystem<'_>, steps: usize) -> usize {
    (steps + 1) * system.parameters.len()
}

/// What is wrong with a state; less is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Badness {
    /// Knots that haven't settled.
    unsettled: usize,
    /// Segments that loop.
    loops: usize,
}

impl Badness {
    const NONE: Badness = Badness { unsettled: 0, loops: 0 };

    fn of(system: &RunSystem<'_>) -> Self {
        Badness {
            unsettled: (0..system.knots.len()).filter(|&i| is_unsettled(system, i)).count(),
            loops: system.loops().count(),
        }
    }
}

fn is_unsettled(system: &RunSystem<'_>, knot: usize) -> bool {
    !(system.knot_residual(knot) <= UNSETTLED)
}

/// What orders states of which the best is kept; less is better.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Merit {
    badness: Badness,
    /// Largest over all knots.
    residual: f64,
    /// [`RunSystem::total_bend`].
    bend: f64,
}

impl Merit {
    /// By what is wrong; where that is the same, settled states by how much they bend, others by how
    /// far they are from settling.
    fn cmp(&self, other: &Merit) -> Ordering {
        self.badness.cmp(&other.badness).then_with(|| {
            if self.badness.unsettled == 0 {
                self.bend.total_cmp(&other.bend)
            } else {
                self.residual.total_cmp(&other.residual)
            }
        })
    }
}

/// The best state of the whole run so far.
struct Best {
    state: State,
    merit: Merit,
    stage: Stage,
}

impl Best {
    #[inline(never)] // for the size of the web's module
    fn of(system: &RunSystem<'_>, residual: f64, stage: Stage) -> Best {
        let merit = Merit { badness: Badness::of(system), residual, bend: system.total_bend() };
        Best { state: system.state(), merit, stage }
    }

    fn is_good(&self) -> bool {
        self.merit.residual <= SOLVED && self.merit.badness.loops == 0
    }
}

/// Stages 2 to 5 on one run.
struct Rescue {
    budget: Budget,
    random: Random,
    /// The sign of the run's first turn: seeds mirror with the run.
    sense: f64,
    iterations: usize,
}

impl Rescue {
    fn new(system: &RunSystem<'_>, budget: Budget) -> Self {
        let first = system.knots.iter().find(|knot| knot.turn.abs() > 1e-6);
        let sense = first.map_or(1.0, |knot| knot.turn.signum());
        Rescue { budget, random: Random(0), sense, iterations: 0 }
    }

    /// Leaves the best state found in `system`, and says which stage it comes from.
    fn run(&mut self, system: &mut RunSystem<'_>, matrix: &mut BlockTridiagonal<2>) -> Stage {
        let straight = system.state();
        let fused = self.fuse(system, matrix);
        match &fused {
            Some(fused) if fused.is_good() => return fused.stage,
            Some(_) => self.return_to(system, &straight),
            None => {}
        }
        let mut best = self.run_unfused(system, matrix);
        if let Some(fused) = fused.filter(|fused| fused.merit.cmp(&best.merit) == Ordering::Less) {
            self.return_to(system, &fused.state);
            best = fused;
        }
        best.stage
    }

    /// Stages 3 to 5. Once the run is solved, what is kept for relaxing serves to be rid of loops.
    fn run_unfused(
        &mut self,
        system: &mut RunSystem<'_>,
        matrix: &mut BlockTridiagonal<2>,
    ) -> Best {
        /// Growing costs at least this much a knot.
        const COST: usize = 40;
        let n = system.knots.len();
        let residual = self.newton(system, matrix, LONG).residual;
        let mut best = Best::of(system, residual, Stage::Plain);
        if n > 3 && self.bridge(system) {
            self.settle(system, matrix, Stage::Bridged, &mut best);
            if best.is_good() {
                return best;
            }
        }
        self.return_to(system, &best.state);
        if (best.merit.badness.unsettled as f64) < FEW * n as f64 {
            self.mend(system);
        }
        let mut stage = Stage::Mended;
        if n > 4 && self.budget.left() > n * COST && Badness::of(system).unsettled > 0 {
            self.grow(system);
            let (grown, badness) = (system.state(), Badness::of(system));
            self.newton(system, matrix, Limits { iterations: 8, patience: 8 });
            if Badness::of(system) > badness {
                self.return_to(system, &grown);
            }
            stage = Stage::Grown;
        }
        loop {
            self.mend(system);
            self.settle(system, matrix, stage, &mut best);
            self.return_to(system, &best.state);
            if best.is_good() {
                let found_in = best.stage;
                self.straighten(system);
                self.settle(system, matrix, found_in, &mut best);
                self.return_to(system, &best.state);
                return best;
            }
            let is_solved = best.merit.residual <= SOLVED;
            if self.budget.is_spent() {
                if !(is_solved && self.budget.release()) {
                    return best;
                }
                self.straighten(system);
            }
        }
    }

    /// Lets the whole run settle, and keeps it if that is the best so far.
    fn settle(
        &mut self,
        system: &mut RunSystem<'_>,
        matrix: &mut BlockTridiagonal<2>,
        stage: Stage,
        best: &mut Best,
    ) {
        let residual = self.newton(system, matrix, LONG).residual;
        let now = Best::of(system, residual, stage);
        if now.merit.cmp(&best.merit) == Ordering::Less {
            *best = now;
        }
    }

    fn solve_window(&mut self, window: &mut RunSystem<'_>) -> Outcome {
        let mut matrix = BlockTridiagonal::new(window.knots.len(), window.is_closed());
        let outcome = newton_while(window, &mut matrix, WINDOW, is_promising);
        self.count(window, outcome)
    }

    #[inline(never)] // for the size of the web's module
    fn newton(
        &mut self,
        system: &mut RunSystem<'_>,
        matrix: &mut BlockTridiagonal<2>,
        limits: Limits,
    ) -> Outcome {
        let outcome = newton(system, matrix, limits);
        self.count(system, outcome)
    }

    fn count(&mut self, system: &RunSystem<'_>, outcome: Outcome) -> Outcome {
        self.iterations += outcome.iterations;
        self.budget.spend(cost(system, outcome.iterations));
        outcome
    }

    /// Comes back to a state.
    #[inline(never)] // for the size of the web's module
    fn return_to(&mut self, system: &mut RunSystem<'_>, state: &State) {
        system.set_state(state);
        self.budget.spend(system.parameters.len());
    }
}

/// Changes the winding at a knot: from the natural one to the other way round, or back.
fn turn_round(knot: &mut SystemKnot) {
    let natural = wrap_angle(knot.turn);
    knot.turn = if knot.turn == natural { natural - TAU.copysign(natural) } else { natural };
}

/// A fixed sequence of numbers in [0, 1) (splitmix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        (z >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn merit(unsettled: usize, loops: usize, residual: f64, bend: f64) -> Merit {
        Merit { badness: Badness { unsettled, loops }, residual, bend }
    }

    /// What is settled comes before what has fewer loops, and that before what bends less.
    #[test]
    fn states_are_ordered_by_what_is_wrong_then_by_bend_or_residual() {
        let ordered = [
            merit(0, 0, 1e-12, 9.0),
            merit(0, 1, 1e-12, 3.0),
            merit(0, 1, 1e-14, 4.0),
            merit(0, 2, 1e-14, 1.0),
            merit(1, 0, 1e-3, 8.0),
            merit(1, 0, 2e-3, 1.0),
            merit(1, 0, f64::NAN, 1.0),
        ];
        for (i, a) in ordered.iter().enumerate() {
            for (j, b) in ordered.iter().enumerate() {
                assert_eq!(a.cmp(b), i.cmp(&j), "{a:?} {b:?}");
            }
        }
    }
}
