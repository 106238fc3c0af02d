//! Growing: a run built knot by knot.

use super::{Rescue, UNSETTLED, turn_round};
use crate::four_param::system::RunSystem;
use crate::frame::wrap_angle;
use crate::tolerance::LOOP;

/// Knots before a new one that settle with it. Of 6 to 10, where the work goes furthest.
const NEAR: usize = 8;

/// Attempts that try the windings of the last two knots, all four of them; those of the last three
/// take twice the work and find less.
const WINDINGS: usize = 4;

impl Rescue {
    /// Builds the run knot by knot, from its first one.
    pub(super) fn grow(&mut self, system: &mut RunSystem<'_>) {
        let mut open = if system.is_closed() { system.opened() } else { system.clone() };
        self.grow_open(&mut open);
        self.return_to(system, &open.state());
    }

    /// Builds an open run knot by knot.
    pub(super) fn grow_open(&mut self, open: &mut RunSystem<'_>) {
        /// Attempts at adding one knot. With 16 of them half as many random G4 runs are solved.
        const ATTEMPTS: usize = 32;
        /// Attempts made to get rid of a loop, where the knot could be added with one.
        const ATTEMPTS_AT_LOOPS: usize = WINDINGS;
        open.parameters.fill([0.0; 4]);
        open.knots.iter_mut().for_each(|knot| knot.turn = wrap_angle(knot.turn));
        open.evaluate();
        for last in 2usize..open.knots.len() {
            let first = last.saturating_sub(NEAR);
            let mut straightest: Option<(f64, RunSystem<'_>)> = None;
            for attempt in 0..ATTEMPTS {
                let mut window = open.window(first, last);
                self.vary(&mut window, attempt);
                if last + 1 < open.knots.len() {
                    window.free_end();
                }
                let outcome = self.solve_window(&mut window);
                if outcome.residual <= UNSETTLED {
                    let least = window.least_straightness();
                    if straightest.as_ref().is_none_or(|(best, _)| least > *best) {
                        straightest = Some((least, window));
                    }
                    if least * LOOP > 1.0 {
                        break;
                    }
                }
                let enough = straightest.is_some() && attempt + 1 >= ATTEMPTS_AT_LOOPS;
                if enough || self.budget.is_spent() {
                    break;
                }
            }
            if let Some((_, window)) = straightest {
                open.adopt(&window, first);
            }
            if self.budget.is_spent() {
                return;
            }
        }
    }

    /// How the end of a growing run is varied from one attempt to the next: first the windings of
    /// its last two knots, then the last few segments anew from seeds.
    fn vary(&mut self, window: &mut RunSystem<'_>, attempt: usize) {
        const SHARE_TURNED: f64 = 0.4;
        let (knots, segments) = (window.knots.len(), window.parameters.len());
        if attempt < WINDINGS {
            for back in (0..2).filter(|back| attempt >> back & 1 == 1 && knots > back + 2) {
                turn_round(&mut window.knots[knots - 2 - back]);
            }
            return;
        }
        let anew = 2 + attempt % 4;
        for segment in segments.saturating_sub(anew)..segments {
            self.seed(window, segment, 1.0);
        }
        for i in knots.saturating_sub(anew + 1).max(1)..knots - 1 {
            window.knots[i].turn = wrap_angle(window.knots[i].turn);
            if self.random.next() < SHARE_TURNED {
                turn_round(&mut window.knots[i]);
            }
        }
    }
}
