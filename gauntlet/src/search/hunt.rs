//! The search for the best root of a run's equations, for as long as it may take.

use std::time::{Duration, Instant};

use super::bridge::{bridges, divided};
use super::chain::{Chain, Ease, State, straightness};
use crate::generate::Random;
use crate::residual::{LOOP, turning_of};

/// Residuals up to this are roots.
const ROOT: f64 = 1e-10;

/// A knot is settled below this.
const SETTLED: f64 = 1e-6;

/// A solution as asked.
#[derive(Clone, Debug)]
pub(super) struct Root {
    pub(super) state: State,
    /// ∫|κ| ds, radians.
    pub(super) turning: f64,
    /// The fewest segments longer than 4 chords of any root found, which may be another one.
    pub(super) fewest_loops: usize,
    pub(super) how: &'static str,
}

/// A search under way.
struct Hunt<'a> {
    chain: &'a Chain,
    random: Random,
    start: Instant,
    limit: Duration,
    best: Option<Root>,
    last_gain: Duration,
}

/// The best root found in `limit`; sooner where nothing better has come for long.
pub(super) fn hunt(chain: &Chain, limit: Duration, seed: u64) -> Option<Root> {
    let mut hunt = Hunt {
        chain,
        random: Random::for_case("search", seed as usize),
        start: Instant::now(),
        limit,
        best: None,
        last_gain: Duration::ZERO,
    };
    hunt.easy_starts();
    hunt.bridged();
    hunt.divided();
    hunt.continued();
    while !hunt.is_over() {
        hunt.climb();
    }
    hunt.best
}

impl Hunt<'_> {
    /// Out of time, or a root without loops and nothing better for a tenth of the time.
    fn is_over(&self) -> bool {
        let elapsed = self.start.elapsed();
        let has_good = self.best.as_ref().is_some_and(|root| root.fewest_loops == 0);
        elapsed > self.limit || has_good && elapsed > self.last_gain + self.limit / 10
    }

    /// Takes a state as a root if it is one, and keeps it if it turns less than the best.
    fn offer(&mut self, mut state: State, how: &'static str) -> bool {
        if !(self.chain.newton(&mut state, 1.0, 12) <= ROOT) {
            return false;
        }
        let (turning, own_loops) = (state.turning(), loops(&state));
        let known = self.best.as_ref().map_or(usize::MAX, |best| best.fewest_loops);
        let fewest_loops = known.min(own_loops);
        if let (Some(best), true) = (&mut self.best, own_loops < known) {
            best.fewest_loops = own_loops;
            self.last_gain = self.start.elapsed();
        }
        if self.best.as_ref().is_none_or(|best| turning < best.turning - 1e-9) {
            self.best = Some(Root { state, turning, fewest_loops, how });
            self.last_gain = self.start.elapsed();
        }
        true
    }

    /// From straight lines and from arcs, with steps of several sizes.
    fn easy_starts(&mut self) {
        for clamp in [1.0, 0.3, 3.0] {
            for mut state in [self.chain.straight(), self.arcs()] {
                self.chain.newton(&mut state, clamp, 60);
                self.offer(state, "easy start");
            }
        }
    }

    /// Euler spirals, nearly, between the tangents of the circles through three neighbours.
    fn arcs(&self) -> State {
        let mut state = self.chain.straight();
        let (chords, turns) = (&self.chain.chords, &self.chain.turns);
        // The share of a knot's turn that a segment beside it takes.
        let share = |knot: usize, segment: usize| match self.chain.around(knot) {
            (Some(a), Some(b)) => turns[knot] * chords[segment] / (chords[a] + chords[b]),
            _ => f64::NAN,
        };
        for segment in 0..state.k.len() {
            let next = (segment + 1) % self.chain.knots();
            let (a, b) = (share(segment, segment), share(next, segment));
            let (a, b) = (if a.is_nan() { b } else { a }, if b.is_nan() { a } else { b });
            if !a.is_nan() && !b.is_nan() {
                state.k[segment] = [a + b, 6.0 * (b - a), 0.0, 0.0];
            }
        }
        state
    }

    /// With long segments laid between their neighbours as these are alone.
    fn bridged(&mut self) {
        const RATIOS: [f64; 5] = [100.0, 30.0, 10.0, 3.0, 1.5];
        const TRIES: usize = 200;
        for ratio in RATIOS {
            let Some((base, bridges)) = bridges(self.chain, ratio) else { continue };
            let single = if let [only] = &bridges[..] { only.ways.len() } else { TRIES };
            for attempt in 0..TRIES.min(single) {
                let mut state = base.clone();
                for bridge in &bridges {
                    // One after the other for a single bridge; for several, mostly the first ways.
                    let way = if bridges.len() == 1 {
                        attempt
                    } else {
                        self.random.below(1 + self.random.clone().below(1 + attempt / 2))
                    };
                    if let Some(k) = bridge.ways.get(way) {
                        state.k[bridge.segment] = *k;
                    }
                }
                self.chain.wind(&mut state);
                for clamp in [0.3, 1.0] {
                    let mut polished = state.clone();
                    self.chain.newton(&mut polished, clamp, 60);
                    self.offer(polished, "long segments bridged");
                }
                if self.is_over() {
                    return;
                }
            }
        }
    }

    /// Divided at long segments, these between their parts.
    fn divided(&mut self) {
        const TRIES: usize = 40;
        let until = self.start.elapsed() + self.limit / 3;
        for _ in 0..TRIES {
            if let Some(state) = divided(self.chain, &mut self.random) {
                self.offer(state, "divided at the longest");
            }
            if self.is_over() || self.start.elapsed() > until {
                return;
            }
        }
    }

    /// Along curves of solutions of easier equations.
    fn continued(&mut self) {
        const STEPS: usize = 3000;
        for by in [Ease::Chords, Ease::Turns] {
            let mut start = self.chain.straight();
            let eased = self.chain.eased(0.0, by);
            if !(eased.newton(&mut start, 1.0, 60) < ROOT) {
                continue;
            }
            let (chain, mut found) = (self.chain, Vec::new());
            let (clock, limit) = (Instant::now(), self.limit / 8);
            chain.follow(by, start, STEPS, |root| {
                found.push(root);
                found.len() > 20 || clock.elapsed() > limit
            });
            for root in found {
                self.offer(root, "continuation");
            }
        }
    }

    /// Changes a state here and there, and keeps what isn't worse, until that leads no further.
    fn climb(&mut self) {
        const PATIENCE: usize = 150;
        let from_best = self.best.is_some() && self.random.below(4) > 0;
        let mut state = match &self.best {
            Some(best) if from_best => best.state.clone(),
            _ => self.fresh(),
        };
        let mut score = self.score(&state);
        let mut patience = PATIENCE;
        while patience > 0 && !self.is_over() {
            patience -= 1;
            let mut changed = self.changed(&state);
            let whole = [8, 20][self.random.below(2)];
            self.chain.newton(&mut changed, 1.0, whole);
            if !changed.k.iter().flatten().all(|k| k.is_finite()) {
                continue;
            }
            let new = self.score(&changed);
            if new < score {
                patience = PATIENCE;
            }
            // Sideways always, and a little uphill now and then.
            if new <= score || self.random.below(40) == 0 && new.0 <= score.0 + 1 {
                if new.0 == 0 {
                    self.offer(changed.clone(), "local search");
                }
                (state, score) = (changed, new);
            }
        }
    }

    /// Unsettled knots, loops, and ∫|κ| ds in thousandths.
    fn score(&self, state: &State) -> (usize, usize, u64) {
        let unsettled = self.unsettled(state).len();
        (unsettled, loops(state), (1e3 * state.turning()) as u64)
    }

    fn unsettled(&self, state: &State) -> Vec<usize> {
        let violations = self.chain.violations(state);
        (0..violations.len()).filter(|&i| !(violations[i] < SETTLED)).collect()
    }

    /// A start of its own.
    fn fresh(&mut self) -> State {
        let mut state = match self.random.below(3) {
            0 => self.arcs(),
            _ => self.chain.straight(),
        };
        if self.random.below(2) == 0 {
            for segment in 0..state.k.len() {
                state.k[segment] = self.seed(state.k[segment]);
            }
        }
        self.chain.newton(&mut state, 1.0, 20);
        state
    }

    /// New parameters for a segment: of any size, the old ones smaller, mirrored, or a straight line.
    fn seed(&mut self, old: [f64; 4]) -> [f64; 4] {
        let random = &mut self.random;
        match random.below(6) {
            0 => [0.0; 4],
            1 => old.map(|k| -k),
            2 => {
                let factor = random.between(0.0, 1.2);
                old.map(|k| factor * k)
            }
            _ => {
                let size = 10f64.powf(random.between(-1.0, 1.3));
                let decay = random.between(0.0, 1.0);
                std::array::from_fn(|j| {
                    let unit = [1.0, 4.0, 24.0, 192.0][j] * decay.powi(j as i32);
                    size * unit * random.between(-1.0, 1.0)
                })
            }
        }
    }

    /// The state with a stretch started anew: around something unsettled, else around a segment that
    /// turns much, else anywhere.
    fn changed(&mut self, state: &State) -> State {
        let (n, m) = (self.chain.knots(), self.chain.segments());
        let unsettled = self.unsettled(state);
        let centre = if !unsettled.is_empty() && self.random.below(10) > 0 {
            unsettled[self.random.below(unsettled.len())]
        } else {
            // The one of some that turns most beyond what the chords ask.
            (0..3)
                .map(|_| self.random.below(m))
                .max_by(|&a, &b| turning_of(state.k[a]).total_cmp(&turning_of(state.k[b])))
                .unwrap_or(0)
        };
        let radius = 1 + self.random.below(1 + self.random.clone().below(6));
        let (from, count) = if self.chain.closed {
            ((centre + m - radius.min(m - 1) / 2) % m, (2 * radius).min(m))
        } else {
            let from = centre.saturating_sub(radius);
            (from, (2 * radius).min(m - from))
        };
        let mut changed = state.clone();
        let all_new = self.random.below(2) == 0;
        for i in 0..count {
            let segment = (from + i) % m;
            if all_new || self.random.below(2) == 0 {
                changed.k[segment] = self.seed(state.k[segment]);
            }
        }
        match self.random.below(3) {
            0 => self.chain.wind(&mut changed),
            1 => {
                for i in 0..=count {
                    let knot = (from + i) % n;
                    if self.random.below(3) == 0 {
                        changed.windings[knot] = match self.random.below(4) {
                            0 => 1,
                            1 => -1,
                            2 => -self.chain.turns[knot].signum() as i32,
                            _ => 0,
                        };
                    }
                }
            }
            _ => (0..=count).for_each(|i| changed.windings[(from + i) % n] = 0),
        }
        // The stretch alone first, its rim held.
        if count < m {
            let part = self.chain.part(from, count, Some(state));
            let mut alone = State {
                k: (0..count).map(|i| changed.k[(from + i) % m]).collect(),
                windings: (0..=count).map(|i| changed.windings[(from + i) % n]).collect(),
            };
            if self.chain.closed || from > 0 {
                alone.windings[0] = 0;
                changed.windings[from] = state.windings[from];
            }
            if self.chain.closed || from + count < m {
                alone.windings[count] = 0;
                changed.windings[(from + count) % n] = state.windings[(from + count) % n];
            }
            part.newton(&mut alone, [0.5, 1.0, 2.0][self.random.below(3)], 30);
            if alone.k.iter().flatten().all(|k| k.is_finite()) {
                (0..count).for_each(|i| changed.k[(from + i) % m] = alone.k[i]);
            }
        }
        changed
    }
}

/// Segments longer than 4 chords.
fn loops(state: &State) -> usize {
    state.k.iter().filter(|k| straightness(**k) * LOOP < 1.0).count()
}
