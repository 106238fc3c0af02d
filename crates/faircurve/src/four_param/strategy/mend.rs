//! Mending: bad stretches are restarted alone, with their rim held.

use std::ops::Range;

use super::{Badness, REACH, Rescue, UNSETTLED, is_unsettled, turn_round};
use crate::four_param::system::RunSystem;
use crate::frame::wrap_angle;
use crate::numeric::order::sort_by;

/// A restart that leaves as many loops is kept if the run then bends less than so many times what
/// it did; less of a gain isn't worth an attempt.
const LESS: f64 = 0.98;

impl Rescue {
    /// Restarts bad stretches until all are good or one has had its share of attempts.
    pub(super) fn mend(&mut self, system: &mut RunSystem<'_>) {
        /// Attempts without success after which the run as a whole deserves a look.
        const PATIENCE: usize = 60;
        /// Knots on either side of a bad stretch that are restarted with it.
        const MARGINS: [usize; 6] = [1, 2, 3, 5, 8, 12];
        /// Looking over this many knots costs about as much as evaluating one segment.
        const BOOKKEEPING: usize = 16;
        let n = system.knots.len();
        let mut attempt = 0;
        while !self.budget.is_spent() && attempt < PATIENCE {
            let stretches = bad_stretches(system, MARGINS[attempt % MARGINS.len()]);
            let Some(&(from, to)) =
                stretches.get((attempt / MARGINS.len()) % stretches.len().max(1))
            else {
                return;
            };
            attempt += 1;
            self.budget.spend(n / BOOKKEEPING);
            let helped =
                self.try_restart(system, (from, to), attempt, |before, now, bends_less| {
                    now < before || (now == before && now.unsettled == 0 && bends_less)
                });
            if helped {
                attempt = 0;
            }
        }
    }

    /// Restarts the surroundings of segments that bend much, and keeps what bends less: a search may
    /// have come upon a curve that winds more than it must.
    pub(super) fn straighten(&mut self, system: &mut RunSystem<'_>) {
        /// Bend of a segment below which there is nothing to gain, in radians: an arc of 230°.
        const BENT: f64 = 2.0;
        const ATTEMPTS: usize = 24;
        /// Segments on either side that are restarted with it.
        const MARGINS: [usize; 3] = [1, 2, 3];
        let n = system.knots.len();
        for attempt in 0..ATTEMPTS {
            let mut bent: Vec<(f64, usize)> = (0..system.parameters.len())
                .map(|segment| (system.bend(segment), segment))
                .filter(|&(bend, _)| bend > BENT)
                .collect();
            sort_by(&mut bent, |a, b| b.0.total_cmp(&a.0));
            if bent.is_empty() || self.budget.is_spent() {
                return;
            }
            let (_, segment) = bent[(attempt / MARGINS.len()) % bent.len()];
            let margin = MARGINS[attempt % MARGINS.len()];
            let (from, to) = match (2 * margin + 1 < n, system.is_closed()) {
                (true, true) => ((segment + n - margin) % n, (segment + 1 + margin) % n),
                (true, false) => {
                    (segment.saturating_sub(margin), (segment + 1 + margin).min(n - 1))
                }
                (false, true) => (0, 0),
                (false, false) => (0, n - 1),
            };
            self.try_restart(system, (from, to), attempt, |before, now, bends_less| {
                now <= before && bends_less
            });
        }
    }

    /// Restarts the stretch between two knots, lets its surroundings settle, and comes back to what
    /// was unless that is worth keeping: by what was wrong before, what is now, and whether the run
    /// bends less. Whether it is kept, and less is wrong.
    fn try_restart(
        &mut self,
        system: &mut RunSystem<'_>,
        (from, to): (usize, usize),
        attempt: usize,
        is_worth_keeping: fn(Badness, Badness, bool) -> bool,
    ) -> bool {
        let Some(window) = self.restart(system, from, to, attempt) else { return false };
        let (before, badness, bend) = (system.state(), Badness::of(system), system.total_bend());
        system.adopt(&window, from);
        self.settle_around(system, from, to);
        let bends_less = system.total_bend() < LESS * bend;
        let now = Badness::of(system);
        let is_kept = is_worth_keeping(badness, now, bends_less);
        if !is_kept {
            self.return_to(system, &before);
        }
        is_kept && now < badness
    }

    /// Gives the stretch between two knots another winding and another start; returns it if it
    /// settles with its rim held.
    fn restart<'a>(
        &mut self,
        system: &RunSystem<'a>,
        from: usize,
        to: usize,
        attempt: usize,
    ) -> Option<RunSystem<'a>> {
        /// Turns smaller than this (in radians) are hardly ever the wrong way round.
        const GENTLE: f64 = 1.0;
        /// After so many attempts they are tried as well.
        const AT_A_LOSS: usize = 18;
        const SHARE_TURNED: f64 = 0.3;
        /// One attempt in this many builds the stretch knot by knot instead. The whole run is grown
        /// in its own stage.
        const GROWN: usize = 5;
        /// One attempt in this many, where something hasn't settled or loops already, puts a loop into
        /// one segment. Some runs have no curve without, those of mixed joins often, and one loop may
        /// be less than another.
        const LOOPED: usize = 3;
        let mut window = if from == to { system.clone() } else { system.window(from, to) };
        let is_whole = window.parameters.len() == system.parameters.len();
        let is_good = Badness::of(system) == Badness::NONE;
        if attempt % LOOPED == LOOPED - 1 && !is_good {
            self.seed_loop(&mut window);
        } else if attempt.is_multiple_of(GROWN) && !is_whole {
            self.grow_open(&mut window);
        } else {
            let amplitude = (attempt % 4) as f64 / 3.0;
            for knot in &mut window.knots {
                knot.turn = wrap_angle(knot.turn);
                let may_turn = knot.turn.abs() > GENTLE || attempt > AT_A_LOSS;
                if may_turn && self.random.next() < SHARE_TURNED {
                    turn_round(knot);
                }
            }
            for segment in 0..window.parameters.len() {
                self.seed(&mut window, segment, amplitude);
            }
        }
        let outcome = self.solve_window(&mut window);
        (outcome.residual <= UNSETTLED).then_some(window)
    }

    /// Gives a segment parameters of about the size that hard solutions have, with what is zero
    /// there zero.
    pub(super) fn seed(&mut self, window: &mut RunSystem<'_>, segment: usize, amplitude: f64) {
        const SIZES: [f64; 4] = [1.0, 4.0, 10.0, 40.0];
        window.parameters[segment] =
            SIZES.map(|size| self.sense * amplitude * size * (2.0 * self.random.next() - 1.0));
        window.enforce(segment);
    }

    /// Seeds all segments and makes one of them, whichever it is, a loop; windings are those in which
    /// directions then differ least.
    fn seed_loop(&mut self, window: &mut RunSystem<'_>) {
        /// Curvatures of a loop of length 1: around 2π, at which the chord vanishes.
        const CURVATURES: Range<f64> = 5.0..8.0;
        for segment in 0..window.parameters.len() {
            self.seed(window, segment, 1.0);
        }
        let looped = (self.random.next() * window.parameters.len() as f64) as usize;
        let side = if self.random.next() < 0.5 { -self.sense } else { self.sense };
        let width = CURVATURES.end - CURVATURES.start;
        window.parameters[looped][0] = side * (CURVATURES.start + width * self.random.next());
        window.evaluate();
        self.budget.spend(window.parameters.len());
        window.unwind();
    }

    /// Lets the surroundings of a mended stretch adapt to it.
    fn settle_around(&mut self, system: &mut RunSystem<'_>, from: usize, to: usize) {
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
}

/// The stretches around bad knots, or around loops if there are none, with a margin of so many knots on either side, as
/// first and last knot; a stretch that covers a whole closed run has both the same.
fn bad_stretches(system: &RunSystem<'_>, margin: usize) -> Vec<(usize, usize)> {
    let n = system.knots.len();
    let closed = system.is_closed();
    let mut near: Vec<bool> = (0..n).map(|i| is_unsettled(system, i)).collect();
    // Loops wait until all has settled: much of a budget could go into them.
    let all_settled = !near.contains(&true);
    for segment in system.loops().filter(|_| all_settled) {
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
