//! How a run is solved when plain Newton iteration isn't enough. See
//! `docs/decisions/0004-strategy.md` for the measurements behind it.
//!
//! 1. **Newton** from straight segments, each segment's step limited on its own, so that good
//!    stretches settle while bad ones still bounce. Nearly all real contours end here.
//! 2. **Windings.** Where a stretch doesn't settle, or loops, the curve may have to take a turn the
//!    other way round: a knot with turning t joined as t ∓ 2π. The bad stretch alone, with its rim
//!    held, is restarted with other windings and other seeds until it settles; then the whole run
//!    is solved on from there.
//!
//! Deterministic: the seeds are fixed, and the budget counts work, not time.

use std::f64::consts::TAU;

use super::family::FourParamFamily;
use super::system::RunSystem;
use crate::numeric::block_tridiagonal::BlockTridiagonal;
use crate::numeric::newton::{Limits, Outcome, newton};
use crate::tolerance::{LOOP, SOLVED};

/// Work that the rescue of one run may take, in segment evaluations: some 50 ms.
pub(super) const BUDGET: usize = 200_000;

/// How plain Newton iteration is limited. Runs that converge take 3 to 10 steps.
const PLAIN: Limits = Limits {
    iterations: 30,
    patience: 12,
};

/// A stretch that settles does so in fewer.
const WINDOW: Limits = Limits {
    iterations: 20,
    patience: 8,
};

/// Knots whose residual exceeds this haven't settled.
pub(super) const UNSETTLED: f64 = 1e-4;

/// What an attempt has come to.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Badness {
    /// Knots that haven't settled.
    unsettled: usize,
    /// Segments that loop.
    loops: usize,
}

/// Solves the system as well as the budget allows; returns the steps taken and the residual. `arcs`
/// are segments between circle tangents.
pub(super) fn solve<F: FourParamFamily>(
    system: &mut RunSystem<'_, F>,
    matrix: &mut BlockTridiagonal<2>,
    arcs: &[[f64; 4]],
    budget: usize,
) -> Outcome {
    // Three knots always lie on a circle, two too many times.
    if system.knots.len() <= 3
        && let Some(round) = solve_round(system, matrix, arcs)
    {
        return round;
    }
    let plain = newton(system, matrix, PLAIN);
    if plain.residual <= SOLVED && badness(system).loops == 0 {
        return plain;
    }
    if let Some(round) = solve_round(system, matrix, arcs) {
        return round;
    }
    system.evaluate();
    // Seeds mirror with the run.
    let sense = system
        .knots
        .iter()
        .find(|knot| knot.turn.abs() > 1e-6)
        .map_or(1.0, |knot| knot.turn.signum());
    let mut rescue = Rescue {
        budget,
        random: Random(0),
        sense,
        iterations: plain.iterations,
    };
    let residual = rescue.run(system, matrix, plain.residual);
    Outcome {
        iterations: rescue.iterations,
        residual,
    }
}

/// Knots on a circle: the circle it is, however much of it lies between two of them.
fn solve_round<F: FourParamFamily>(
    system: &mut RunSystem<'_, F>,
    matrix: &mut BlockTridiagonal<2>,
    arcs: &[[f64; 4]],
) -> Option<Outcome> {
    let before = std::mem::replace(&mut system.parameters, arcs.to_vec());
    let round = newton(
        system,
        matrix,
        Limits {
            iterations: 0,
            patience: 0,
        },
    );
    if round.residual <= SOLVED {
        Some(newton(system, matrix, PLAIN))
    } else {
        system.parameters = before;
        None
    }
}

struct Rescue {
    budget: usize,
    random: Random,
    /// The sign of the run's first turn.
    sense: f64,
    iterations: usize,
}

impl Rescue {
    fn run<F: FourParamFamily>(
        &mut self,
        system: &mut RunSystem<'_, F>,
        matrix: &mut BlockTridiagonal<2>,
        mut residual: f64,
    ) -> f64 {
        let mut best = badness(system);
        let mut attempt = 0;
        while self.budget > 0 && (residual > SOLVED || best.loops > 0) {
            let stretches = bad_stretches(system, 1 + attempt % 5);
            let Some(&(from, to)) = stretches.get((attempt / 5) % stretches.len().max(1)) else {
                break;
            };
            attempt += 1;
            let Some(window) = self.restart(system, from, to, attempt) else {
                continue;
            };
            let saved = (system.parameters.clone(), system.knots.clone());
            system.adopt(&window, if from == to { 0 } else { from });
            let outcome = self.newton(system, matrix, PLAIN);
            let now = badness(system);
            let better = (now.unsettled, now.loops) < (best.unsettled, best.loops)
                || now == best && outcome.residual < 0.5 * residual && residual > SOLVED;
            if better && outcome.residual.is_finite() {
                (best, residual) = (now, outcome.residual);
                attempt = 0;
            } else {
                (system.parameters, system.knots) = saved;
                system.evaluate();
            }
        }
        residual
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
        let mut window = if from == to {
            system.whole()
        } else {
            system.window(from, to)
        };
        let amplitude = (attempt % 4) as f64 / 3.0;
        for knot in &mut window.knots {
            let principal = crate::frame::wrap_angle(knot.turn);
            knot.turn = principal;
            if principal.abs() > 1.0 && self.random.next() < 0.3 {
                knot.turn -= TAU.copysign(principal);
            }
        }
        for parameters in &mut window.parameters {
            *parameters = [1.0, 4.0, 10.0, 40.0]
                .map(|scale| self.sense * amplitude * scale * (2.0 * self.random.next() - 1.0));
        }
        let mut matrix = BlockTridiagonal::new(window.knots.len(), window.is_closed());
        let outcome = self.newton(&mut window, &mut matrix, WINDOW);
        (outcome.residual <= UNSETTLED).then_some(window)
    }

    fn newton<F: FourParamFamily>(
        &mut self,
        system: &mut RunSystem<'_, F>,
        matrix: &mut BlockTridiagonal<2>,
        limits: Limits,
    ) -> Outcome {
        let outcome = newton(system, matrix, limits);
        self.iterations += outcome.iterations;
        let work = (outcome.iterations + 1) * system.parameters.len();
        self.budget = self.budget.saturating_sub(work);
        outcome
    }
}

fn badness<F: FourParamFamily>(system: &RunSystem<'_, F>) -> Badness {
    let settled = |i: &usize| system.knot_residual(*i) <= UNSETTLED;
    Badness {
        unsettled: (0..system.knots.len()).filter(|i| !settled(i)).count(),
        loops: (0..system.parameters.len())
            .filter(|&i| is_loop(system, i))
            .count(),
    }
}

fn is_loop<F: FourParamFamily>(system: &RunSystem<'_, F>, segment: usize) -> bool {
    !(system.straightness(segment) * LOOP > 1.0)
}

/// The stretches around bad knots and segments, with a margin of so many knots on either side, as
/// first and last knot; a stretch that covers a whole closed run has both the same.
fn bad_stretches<F: FourParamFamily>(
    system: &RunSystem<'_, F>,
    margin: usize,
) -> Vec<(usize, usize)> {
    let n = system.knots.len();
    let mut bad = vec![false; n];
    for i in 0..n {
        bad[i] |= !(system.knot_residual(i) <= UNSETTLED);
    }
    for segment in 0..system.parameters.len() {
        if is_loop(system, segment) {
            bad[segment] = true;
            bad[(segment + 1) % n] = true;
        }
    }
    let closed = system.is_closed();
    let mut near = bad.clone();
    for _ in 0..margin {
        let before = near.clone();
        for i in 0..n {
            let neighbour = |j: usize, inside: bool| (closed || inside) && before[j];
            near[i] |= neighbour((i + n - 1) % n, i > 0) || neighbour((i + 1) % n, i + 1 < n);
        }
    }
    if near.iter().all(|&bad| bad) {
        return vec![if closed { (0, 0) } else { (0, n - 1) }];
    }
    let mut stretches = Vec::new();
    for i in 0..n {
        let starts = near[i] && !((closed || i > 0) && near[(i + n - 1) % n]);
        if starts {
            let mut length = 1;
            while near[(i + length) % n] && (closed || i + length < n) {
                length += 1;
            }
            if length > 1 {
                stretches.push((i, (i + length - 1) % n));
            }
        }
    }
    stretches
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
