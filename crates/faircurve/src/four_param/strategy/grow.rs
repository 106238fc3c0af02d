//! Growing: a run built knot by knot.

use super::{REACH, Rescue, UNSETTLED, turn_round};
use crate::four_param::family::FourParamFamily;
use crate::four_param::system::RunSystem;
use crate::frame::wrap_angle;
use crate::tolerance::LOOP;

impl Rescue {
    /// Builds the run knot by knot, from its first one.
    pub(super) fn grow<F: FourParamFamily>(&mut self, system: &mut RunSystem<'_, F>) {
        let mut open = if system.is_closed() { system.opened() } else { system.clone() };
        self.grow_open(&mut open);
        system.set_state(&open.state());
    }

    /// Builds an open run knot by knot.
    pub(super) fn grow_open<F: FourParamFamily>(&mut self, open: &mut RunSystem<'_, F>) {
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
                    let least = window.least_straightness();
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
}
