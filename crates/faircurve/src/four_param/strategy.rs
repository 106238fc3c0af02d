//! How a run is solved when plain Newton iteration isn't enough. The measurements behind it are in
//! `docs/decisions/0004-strategy.md`.
//!
//! 1. **Newton** from straight segments, each segment's step limited on its own, so that good
//!    stretches settle while bad ones still bounce. Nearly all real contours end here. Two and three
//!    knots, and knots on a circle, start from arcs, which are the solution.
//! 2. **Mending**, where few knots are bad. A stretch that doesn't settle, or loops, is restarted
//!    alone, its rim held, with other *windings* and other seeds, until it settles. Windings decide
//!    hard cases: a knot at which the chords turn by t may have to be joined as t ∓ 2π, the other
//!    way round.
//! 3. **Growing**, where something is still bad. The run is built anew knot by knot: each step adds
//!    one and lets the last few settle with a free end, in the few windings nearest to the natural
//!    one. What is left is mended, and the whole run solved on from there.
//!
//! The search sees rounded numbers, so that it takes the same course however the drawing is moved,
//! turned or scaled; the last word is Newton's, on the exact ones. It is deterministic: seeds are
//! fixed, and the budget counts work, not time.

use std::f64::consts::TAU;

use super::family::FourParamFamily;
use super::system::{RunSystem, SystemKnot};
use crate::frame::wrap_angle;
use crate::numeric::block_tridiagonal::BlockTridiagonal;
use crate::numeric::newton::{Limits, Outcome, newton};
use crate::tolerance::{LOOP, SOLVED};

/// Work that stages 2 and 3 may spend on a run of so many knots, in segment evaluations; at most
/// some 50 ms. What a short run doesn't find early, it doesn't find late: of four random knots all are
/// solved within 10,000, of sixteen (G4) 93 % within 24,000 and 99 % within 190,000.
pub(super) fn budget(knots: usize) -> usize {
    const LARGEST: usize = 200_000;
    LARGEST.min(knots.saturating_mul(knots).saturating_mul(750))
}

/// How plain Newton iteration is limited. Runs that converge take 3 to 10 steps; with more of them
/// success comes to depend on rounding errors, and so on how the drawing is turned.
const PLAIN: Limits = Limits { iterations: 16, patience: 8 };

/// The same within the search, whose numbers are rounded.
const LONG: Limits = Limits { iterations: 30, patience: 12 };

/// A stretch that settles does so in fewer.
const WINDOW: Limits = Limits { iterations: 12, patience: 8 };

/// Knots whose residual exceeds this haven't settled.
pub(super) const UNSETTLED: f64 = 1e-4;

/// The effect of one knot on another falls by a factor of about ¼ (G2) or ½ (G4) a knot: this far
/// away it is small.
const REACH: usize = 10;

/// Solves the system as well as the budget allows; returns the steps taken and the residual. `arcs`
/// gives segments between circle tangents; `budget` is what stages 2 and 3 may still spend.
pub(super) fn solve<F: FourParamFamily>(
    system: &mut RunSystem<'_, F>,
    matrix: &mut BlockTridiagonal<2>,
    arcs: impl Fn() -> Vec<[f64; 4]>,
    budget: &mut usize,
) -> Outcome {
    // Three knots always lie on a circle, two too many times.
    if system.knots.len() <= 3
        && let Some(round) = solve_round(system, matrix, arcs())
    {
        return round;
    }
    let plain = newton(system, matrix, PLAIN);
    if plain.residual <= SOLVED && !loops(system).any(|_| true) {
        return plain;
    }
    let plain_state = system.state();
    if let Some(round) = solve_round(system, matrix, arcs()) {
        return round;
    }
    if *budget == 0 {
        system.set_state(&plain_state);
        return plain;
    }
    let mut rounded = system.rounded();
    let mut rescue = Rescue::new(&rounded, *budget);
    rescue.run(&mut rounded, matrix);
    *budget = rescue.budget;
    system.take_from_rounded(&rounded);
    let rescued = newton(system, matrix, PLAIN);
    let iterations = plain.iterations + rescue.iterations + rescued.iterations;
    if rescued.residual > SOLVED && plain.residual <= SOLVED {
        system.set_state(&plain_state);
        return Outcome { iterations, ..plain };
    }
    Outcome { iterations, ..rescued }
}

/// Knots on a circle: the circle it is, though most of it may lie between two of them.
fn solve_round<F: FourParamFamily>(
    system: &mut RunSystem<'_, F>,
    matrix: &mut BlockTridiagonal<2>,
    arcs: Vec<[f64; 4]>,
) -> Option<Outcome> {
    let before = std::mem::replace(&mut system.parameters, arcs);
    let round = newton(system, matrix, Limits { iterations: 0, patience: 0 });
    if round.residual <= SOLVED {
        Some(newton(system, matrix, PLAIN))
    } else {
        system.parameters = before;
        None
    }
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
    fn of<F: FourParamFamily>(system: &RunSystem<'_, F>) -> Self {
        Badness {
            unsettled: (0..system.knots.len()).filter(|&i| is_unsettled(system, i)).count(),
            loops: loops(system).count(),
        }
    }
}

fn is_unsettled<F: FourParamFamily>(system: &RunSystem<'_, F>, knot: usize) -> bool {
    !(system.knot_residual(knot) <= UNSETTLED)
}

/// The segments that loop.
fn loops<F: FourParamFamily>(system: &RunSystem<'_, F>) -> impl Iterator<Item = usize> {
    (0..system.parameters.len()).filter(|&i| !(system.straightness(i) * LOOP > 1.0))
}

/// Stages 2 and 3.
struct Rescue {
    budget: usize,
    random: Random,
    /// The sign of the run's first turn: seeds mirror with the run.
    sense: f64,
    iterations: usize,
}

impl Rescue {
    fn new<F: FourParamFamily>(system: &RunSystem<'_, F>, budget: usize) -> Self {
        let first = system.knots.iter().find(|knot| knot.turn.abs() > 1e-6);
        let sense = first.map_or(1.0, |knot| knot.turn.signum());
        Rescue { budget, random: Random(0), sense, iterations: 0 }
    }

    /// Leaves the best state found in `system`.
    fn run<F: FourParamFamily>(
        &mut self,
        system: &mut RunSystem<'_, F>,
        matrix: &mut BlockTridiagonal<2>,
    ) {
        /// With fewer unsettled knots than this, the rest is good ground for mending.
        const FEW: f64 = 0.3;
        /// Growing costs at least this much a knot.
        const COST: usize = 40;
        let n = system.knots.len();
        let outcome = self.newton(system, matrix, LONG);
        let (mut best, mut least) = (system.state(), (Badness::of(system), outcome.residual));
        let mostly_good = (least.0.unsettled as f64) < FEW * n as f64;
        if mostly_good {
            self.mend(system);
        }
        if n > 4 && self.budget > n * COST && Badness::of(system).unsettled > 0 {
            self.grow(system);
            let (grown, badness) = (system.state(), Badness::of(system));
            self.newton(system, matrix, Limits { iterations: 8, patience: 8 });
            if Badness::of(system) > badness {
                system.set_state(&grown);
            }
        }
        loop {
            self.mend(system);
            let outcome = self.newton(system, matrix, LONG);
            let now = (Badness::of(system), outcome.residual);
            if now < least {
                (best, least) = (system.state(), now);
            } else {
                system.set_state(&best);
            }
            let (badness, residual) = least;
            if self.budget == 0 || residual <= SOLVED && badness.loops == 0 {
                return;
            }
        }
    }

    /// Restarts bad stretches until all are good or one has had its share of attempts.
    fn mend<F: FourParamFamily>(&mut self, system: &mut RunSystem<'_, F>) {
        /// Attempts without success after which the run as a whole deserves a look.
        const PATIENCE: usize = 60;
        /// Knots on either side of a bad stretch that are restarted with it.
        const MARGINS: [usize; 6] = [1, 2, 3, 5, 8, 12];
        /// Looking over this many knots costs about as much as evaluating one segment.
        const BOOKKEEPING: usize = 16;
        let n = system.knots.len();
        let mut attempt = 0;
        while self.budget > 0 && attempt < PATIENCE {
            let stretches = bad_stretches(system, MARGINS[attempt % MARGINS.len()]);
            let Some(&(from, to)) =
                stretches.get((attempt / MARGINS.len()) % stretches.len().max(1))
            else {
                return;
            };
            attempt += 1;
            self.spend(n / BOOKKEEPING);
            let Some(window) = self.restart(system, from, to, attempt) else { continue };
            let (before, badness) = (system.state(), Badness::of(system));
            system.adopt(&window, from);
            self.settle_around(system, from, to);
            if Badness::of(system) < badness {
                attempt = 0;
            } else {
                system.set_state(&before);
            }
        }
    }

    /// Gives the stretch between two knots another winding and another start; returns it if it
    /// settles with its rim held.
    fn restart<'a, F: FourParamFamily>(
        &mut self,
        system: &RunSystem<'a, F>,
        from: usize,
        to: usize,
        attempt: usize,
    ) -> Option<RunSystem<'a, F>> {
        /// Turns smaller than this (in radians) are never the wrong way round.
        const GENTLE: f64 = 1.0;
        const SHARE_TURNED: f64 = 0.3;
        /// One attempt in this many builds the stretch knot by knot instead.
        const GROWN: usize = 5;
        let mut window = if from == to { system.clone() } else { system.window(from, to) };
        if attempt.is_multiple_of(GROWN) && from != to {
            self.grow_open(&mut window);
        } else {
            let amplitude = (attempt % 4) as f64 / 3.0;
            for knot in &mut window.knots {
                knot.turn = wrap_angle(knot.turn);
                if knot.turn.abs() > GENTLE && self.random.next() < SHARE_TURNED {
                    turn_round(knot);
                }
            }
            for parameters in &mut window.parameters {
                *parameters = self.seed(amplitude);
            }
        }
        let outcome = self.solve_window(&mut window);
        (outcome.residual <= UNSETTLED).then_some(window)
    }

    /// Parameters of about the size that hard solutions have.
    fn seed(&mut self, amplitude: f64) -> [f64; 4] {
        const SIZES: [f64; 4] = [1.0, 4.0, 10.0, 40.0];
        SIZES.map(|size| self.sense * amplitude * size * (2.0 * self.random.next() - 1.0))
    }

    /// Lets the surroundings of a mended stretch adapt to it.
    fn settle_around<F: FourParamFamily>(
        &mut self,
        system: &mut RunSystem<'_, F>,
        from: usize,
        to: usize,
    ) {
        let n = system.knots.len();
        let inside = if to > from { to - from } else { to + n - from };
        if inside + 2 * REACH >= n {
            self.solve_window(system);
        } else {
            let (from, to) = if system.is_closed() {
                ((from + n - REACH) % n, (to + REACH) % n)
            } else {
                (from.saturating_sub(REACH), (to + REACH).min(n - 1))
            };
            let mut window = system.window(from, to);
            self.solve_window(&mut window);
            system.adopt(&window, from);
        }
    }

    /// Builds the run knot by knot, from its first one.
    fn grow<F: FourParamFamily>(&mut self, system: &mut RunSystem<'_, F>) {
        let mut open = if system.is_closed() { system.opened() } else { system.clone() };
        self.grow_open(&mut open);
        system.set_state(&open.state());
    }

    /// Builds an open run knot by knot.
    fn grow_open<F: FourParamFamily>(&mut self, open: &mut RunSystem<'_, F>) {
        /// Attempts at adding one knot.
        const ATTEMPTS: usize = 16;
        /// Attempts made to get rid of a loop, where the knot could be added with one.
        const ATTEMPTS_AT_LOOPS: usize = 4;
        open.parameters.fill([0.0; 4]);
        open.knots.iter_mut().for_each(|knot| knot.turn = wrap_angle(knot.turn));
        open.evaluate();
        for last in 2usize..open.knots.len() {
            let first = last.saturating_sub(REACH);
            let mut straightest: Option<(f64, RunSystem<'_, F>)> = None;
            for attempt in 0..ATTEMPTS {
                let mut window = open.window(first, last);
                if last + 1 < open.knots.len() {
                    window.free_end();
                }
                self.vary(&mut window, attempt);
                let outcome = self.solve_window(&mut window);
                if outcome.residual <= UNSETTLED {
                    let segments = 0..window.parameters.len();
                    let least = segments.map(|i| window.straightness(i)).fold(1.0, f64::min);
                    if straightest.as_ref().is_none_or(|(best, _)| least > *best) {
                        straightest = Some((least, window));
                    }
                    if least * LOOP > 1.0 {
                        break;
                    }
                }
                let enough = straightest.is_some() && attempt + 1 >= ATTEMPTS_AT_LOOPS;
                if enough || self.budget == 0 {
                    break;
                }
            }
            if let Some((_, window)) = straightest {
                open.adopt(&window, first);
            }
            if self.budget == 0 {
                return;
            }
        }
    }

    /// How the end of a growing run is varied from one attempt to the next: first all windings of
    /// its last three knots, then the last few segments anew from straight, then from seeds.
    fn vary<F: FourParamFamily>(&mut self, window: &mut RunSystem<'_, F>, attempt: usize) {
        let (knots, segments) = (window.knots.len(), window.parameters.len());
        if attempt < 8 {
            for back in (0..3).filter(|back| attempt >> back & 1 == 1 && knots > back + 2) {
                turn_round(&mut window.knots[knots - 2 - back]);
            }
            return;
        }
        let anew = 2 + attempt % 4;
        let seeded = attempt >= 12;
        for i in segments.saturating_sub(anew)..segments {
            window.parameters[i] = if seeded { self.seed(1.0) } else { [0.0; 4] };
        }
        for i in knots.saturating_sub(anew + 1).max(1)..knots - 1 {
            window.knots[i].turn = wrap_angle(window.knots[i].turn);
            if seeded && self.random.next() < 0.4 {
                turn_round(&mut window.knots[i]);
            }
        }
    }

    fn solve_window<F: FourParamFamily>(&mut self, window: &mut RunSystem<'_, F>) -> Outcome {
        let mut matrix = BlockTridiagonal::new(window.knots.len(), window.is_closed());
        self.newton(window, &mut matrix, WINDOW)
    }

    fn newton<F: FourParamFamily>(
        &mut self,
        system: &mut RunSystem<'_, F>,
        matrix: &mut BlockTridiagonal<2>,
        limits: Limits,
    ) -> Outcome {
        let outcome = newton(system, matrix, limits);
        self.iterations += outcome.iterations;
        self.spend((outcome.iterations + 1) * system.parameters.len());
        outcome
    }

    fn spend(&mut self, work: usize) {
        self.budget = self.budget.saturating_sub(work);
    }
}

/// Changes the winding at a knot: from the natural one to the other way round, or back.
fn turn_round(knot: &mut SystemKnot) {
    let natural = wrap_angle(knot.turn);
    knot.turn = if knot.turn == natural { natural - TAU.copysign(natural) } else { natural };
}

/// The stretches around bad knots and segments, with a margin of so many knots on either side, as
/// first and last knot; a stretch that covers a whole closed run has both the same.
fn bad_stretches<F: FourParamFamily>(
    system: &RunSystem<'_, F>,
    margin: usize,
) -> Vec<(usize, usize)> {
    let n = system.knots.len();
    let closed = system.is_closed();
    let mut near: Vec<bool> = (0..n).map(|i| is_unsettled(system, i)).collect();
    for segment in loops(system) {
        near[segment] = true;
        near[(segment + 1) % n] = true;
    }
    for _ in 0..margin {
        let before = near.clone();
        for i in 0..n {
            near[i] |= (closed || i > 0) && before[(i + n - 1) % n]
                || (closed || i + 1 < n) && before[(i + 1) % n];
        }
    }
    if near.iter().all(|&near| near) {
        return vec![if closed { (0, 0) } else { (0, n - 1) }];
    }
    let starts = |i: usize| near[i] && !((closed || i > 0) && near[(i + n - 1) % n]);
    (0..n)
        .filter(|&i| starts(i))
        .map(|i| {
            let more = (1..n).take_while(|d| near[(i + d) % n] && (closed || i + d < n)).count();
            (i, (i + more) % n)
        })
        .filter(|(from, to)| from != to)
        .collect()
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
