//! What happens to a run that can't be solved as asked: as little as possible is weakened, and every
//! place is named with its reason.

use std::ops::RangeInclusive;

use super::budget::Budget;
use super::spline::{ConstraintSpline, Means, Solved, is_interior};
use super::strategy::UNSETTLED;
use crate::frame::{direction, wrap_angle};
use crate::numeric::order::sort_by;
use crate::outline::Join;
use crate::plan::Run;
use crate::spline::{Place, Relaxation};
use crate::tolerance::SOLVED;

impl ConstraintSpline<'_> {
    /// Weakens what is asked where the run doesn't settle, until it does: joins to G2, and if that
    /// isn't enough to G1; curvatures given at bad ends to none. First one knot or two
    /// ([`few`](Self::relax_few)); then more at once, with a search each time
    /// ([`many`](Self::relax_many)), unless three do.
    ///
    /// Returns the solution and the run as weakened.
    pub(super) fn relax(&self, run: &Run, first: Solved, budget: Budget) -> (Solved, Run) {
        /// Shares of the budget for a few knots and for many; the rest is for asking again.
        const SHARES: [f64; 2] = [0.4, 0.4];
        let all = budget.left() as f64;
        let [mut few, mut many] = SHARES.map(|share| Budget::new((all * share) as usize));
        let mut rest = budget;
        rest.spend(few.left() + many.left());
        let (mut last, mut weaker) = (first, run.clone());
        for join in [Join::G2, Join::G1] {
            if let Some(found) = self.relax_few(&weaker, &last, join, 1..=2, &mut few) {
                return found;
            }
            let found = self.relax_many(&weaker, &last, join, &mut many);
            if found.0.is_solved() {
                rest.put_back(many);
                let found = self.restore(run, found, &mut rest);
                if weakened(run, &found.1).len() <= 3 {
                    return found;
                }
                few.put_back(rest);
                return self.relax_few(&weaker, &last, join, 3..=3, &mut few).unwrap_or(found);
            }
            (last, weaker) = found;
        }
        self.relax_all(weaker, last)
    }

    /// Weakens one knot or two of a run that is solved with loops so that it has none: to G2 if that
    /// does, else to G1, else to corners (a closed curve through knots on a line has no other way). None
    /// if no two do.
    ///
    /// This has a budget of its own, since what was spent on getting rid of the loops is gone.
    pub(super) fn unloop(&self, run: &Run, looping: &Solved) -> Option<(Solved, Run)> {
        /// Plain solves; one knot and two of eight make 36 with each join.
        const SOLVES: usize = 3 * 36;
        let mut budget = Budget::new(SOLVES * 20 * run.segment_count());
        [Join::G2, Join::G1, Join::Corner].into_iter().find_map(|join| {
            self.relax_few(run, looping, join, 1..=2, &mut budget)
                .filter(|(solved, _)| solved.is_good())
        })
    }

    /// Weakens so many knots, whichever come first that make the run good; or the first that solve it
    /// with loops.
    fn relax_few(
        &self,
        run: &Run,
        last: &Solved,
        join: Join,
        sizes: RangeInclusive<usize>,
        budget: &mut Budget,
    ) -> Option<(Solved, Run)> {
        /// Knots that are tried: those that are bad before others, the most strained first.
        const TRIED: usize = 8;
        let mut candidates = weakenable(run, last, join);
        candidates.truncate(TRIED);
        let mut looping: Option<(Solved, Run)> = None;
        let mut iterations = last.iterations;
        for set in sizes.flat_map(|size| subsets(&candidates, size)) {
            if budget.is_spent() {
                break;
            }
            let mut trial = run.clone();
            set.iter().for_each(|&i| weaken(&mut trial, i, join));
            let mut solved = self.solve_split(&trial, Means::Plain, budget);
            iterations += solved.iterations;
            solved.iterations = iterations;
            if solved.is_good() {
                return Some((solved, trial));
            }
            if looping.is_none() && solved.is_solved() {
                looping = Some((solved, trial));
            }
        }
        looping
    }

    /// Weakens the most strained knots of each bad stretch, twice as many every round.
    fn relax_many(
        &self,
        run: &Run,
        first: &Solved,
        join: Join,
        budget: &mut Budget,
    ) -> (Solved, Run) {
        const ROUNDS: u32 = 4;
        let n = run.knots.len();
        let mut weaker = run.clone();
        let mut last = first.clone();
        for round in 1..=ROUNDS {
            let bad = |i: usize| !(last.residuals[i] <= UNSETTLED);
            let stretches = (0..n).filter(|&i| bad(i) && !bad((i + n - 1) % n)).count().max(1);
            let mut candidates = weakenable(&weaker, &last, join);
            candidates.retain(|&i| bad(i));
            candidates.truncate(stretches << round);
            candidates.iter().for_each(|&i| weaken(&mut weaker, i, join));
            let solved = self.solve_split(&weaker, Means::Search, budget);
            last = Solved { iterations: last.iterations + solved.iterations, ..solved };
            if last.is_solved() {
                break;
            }
        }
        (last, weaker)
    }

    /// The last resort: G1 everywhere. Each segment then stands alone and can be drawn unless it
    /// would have to close into a circle; such a one becomes a line.
    fn relax_all(&self, mut weaker: Run, before: Solved) -> (Solved, Run) {
        let n = weaker.knots.len();
        for i in 0..n {
            weaker.knots[i].curvature = None;
            if is_interior(&weaker, i) {
                weaker.knots[i].join = Join::G1;
            }
        }
        let mut last = self.solve_split(&weaker, Means::Plain, &mut Budget::new(0));
        last.iterations += before.iterations;
        for i in 0..weaker.segment_count() {
            let ends = [i, (i + 1) % n];
            if ends.iter().any(|&end| !(last.residuals[end] <= SOLVED)) {
                last.parameters[i] = [0.0; 4];
                for end in ends {
                    weaker.knots[end].join = Join::Corner;
                    weaker.knots[end].tangent = None;
                }
            }
        }
        // Nothing is asked any more where a line was drawn.
        last.residuals.iter_mut().filter(|r| !(**r <= SOLVED)).for_each(|r| *r = 0.0);
        (last, weaker)
    }

    /// Asks again for what was weakened, knot by knot, the least strained first, and keeps what
    /// plain Newton iteration solves without more loops.
    fn restore(
        &self,
        run: &Run,
        (mut solved, mut weaker): (Solved, Run),
        budget: &mut Budget,
    ) -> (Solved, Run) {
        let mut weakened = weakened(run, &weaker);
        sort_by(&mut weakened, |&a, &b| strain(run, a).total_cmp(&strain(run, b)));
        for i in weakened {
            if budget.is_spent() {
                break;
            }
            let mut trial = weaker.clone();
            trial.knots[i] = run.knots[i];
            let attempt = self.solve_split(&trial, Means::Plain, budget);
            if attempt.is_solved() && attempt.loops <= solved.loops {
                let iterations = solved.iterations + attempt.iterations;
                (solved, weaker) = (Solved { iterations, ..attempt }, trial);
            }
        }
        (solved, weaker)
    }
}

/// The knots at which a run has been weakened.
fn weakened(run: &Run, weaker: &Run) -> Vec<usize> {
    (0..run.knots.len()).filter(|&i| run.knots[i] != weaker.knots[i]).collect()
}

/// The knots at which something can be weakened to `join`: bad ones first, then the most strained.
fn weakenable(run: &Run, solved: &Solved, join: Join) -> Vec<usize> {
    let is_good = |i: usize| solved.residuals[i] <= UNSETTLED;
    let mut knots: Vec<usize> = (0..run.knots.len())
        .filter(|&i| {
            let knot = &run.knots[i];
            let is_stronger = is_interior(run, i) && ![join, Join::G1].contains(&knot.join);
            is_stronger || knot.curvature.is_some()
        })
        .collect();
    sort_by(&mut knots, |&a, &b| {
        is_good(a).cmp(&is_good(b)).then(strain(run, b).total_cmp(&strain(run, a)))
    });
    knots
}

/// All subsets of a size from 1 to 3, those of early members first.
fn subsets(of: &[usize], size: usize) -> Vec<Vec<usize>> {
    let mut sets: Vec<Vec<usize>> = vec![Vec::new()];
    for _ in 0..size {
        sets = sets
            .iter()
            .flat_map(|set| {
                let from = set.last().map_or(0, |&last: &usize| last + 1);
                (from..of.len()).map(|next| [set.as_slice(), &[next]].concat())
            })
            .collect();
    }
    sets.into_iter().map(|set| set.into_iter().map(|i| of[i]).collect()).collect()
}

/// Asks less at a knot: no curvature where one is given, else this join. A G2 knot has no room for
/// a tangent.
fn weaken(run: &mut Run, i: usize, join: Join) {
    let is_interior = is_interior(run, i);
    let knot = &mut run.knots[i];
    if knot.curvature.take().is_none() && is_interior {
        knot.join = if knot.tangent.is_some() { Join::G1 } else { join };
    }
}

/// How hard it is to be smooth at a knot: large for sharp turns and for neighbours at very different
/// distances.
fn strain(run: &Run, i: usize) -> f64 {
    chord_ratio(run, i).ln() + run.knots[i].turn.abs()
}

/// The longer of the two chords at a knot over the shorter.
fn chord_ratio(run: &Run, i: usize) -> f64 {
    let n = run.knots.len();
    let (before, after) = (run.chord((i + n - 1) % n).hypot(), run.chord(i).hypot());
    (before / after).max(after / before)
}

/// Why a run is weakened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cause {
    /// No curve was found that is as asked.
    Unsolved,
    /// Those that were found loop.
    Loop,
}

/// What the weakened run no longer asks, knot by knot.
pub(super) fn relaxations(run: &Run, weaker: &Run, cause: Cause) -> Vec<Relaxation> {
    let mut relaxed = Vec::new();
    for i in weakened(run, weaker) {
        let (asked, got) = (&run.knots[i], &weaker.knots[i]);
        let (no_tangent, no_curvature) =
            (asked.tangent != got.tangent, asked.curvature != got.curvature);
        let mut relax = |asked, got| {
            let reason = if cause == Cause::Loop {
                "every curve that was found as asked loops between two knots; relaxed here, none does"
                    .to_owned()
            } else if asked == "curvature" {
                "no curve was found that has this curvature here".to_owned()
            } else {
                reason(run, i)
            };
            relaxed.push(Relaxation { place: Place::Knot(i), asked, got, reason });
        };
        // At the end of a run that goes on beyond, tangent and curvature are what it meets there: a
        // straight line's, or the tangent that a G1 knot has.
        let meets = !is_interior(run, i) && asked.join != Join::Corner;
        if meets && no_tangent {
            relax(asked.join.name(), Join::Corner.name());
        } else if meets && no_curvature && asked.join != Join::G1 {
            relax(asked.join.name(), Join::G1.name());
        } else {
            if is_interior(run, i) && asked.join != got.join {
                relax(asked.join.name(), got.join.name());
            }
            if no_tangent {
                relax("tangent", "free");
            }
            if no_curvature {
                relax("curvature", "free");
            }
        }
    }
    relaxed
}

/// Why, in words for a designer that don't depend on the contour's direction.
fn reason(run: &Run, i: usize) -> String {
    /// Neighbours at distances in a larger ratio than this make curvature hard to join.
    const UNEVEN: f64 = 10.0;
    /// Knots that turn by more than this are hard to pass smoothly, in degrees.
    const SHARP: f64 = 120.0;
    let knot = &run.knots[i];
    if !is_interior(run, i) {
        let (chord, is_start) = if i == 0 { (0, true) } else { (run.segment_count() - 1, false) };
        let chord = direction(run.chord(chord));
        let tangent = knot.tangent.unwrap_or(chord);
        let off = wrap_angle(if is_start { chord - tangent } else { tangent - chord });
        let off = off.abs().to_degrees().round();
        return if knot.join == Join::Corner {
            format!("no curve was found that turns {off}° between this end and its neighbour")
        } else {
            format!(
                "the curve can't turn {off}° between this knot and its neighbour and also join the \
                 straight line smoothly"
            )
        };
    }
    let turn = knot.turn.abs().to_degrees().round();
    let ratio = chord_ratio(run, i);
    if ratio >= UNEVEN {
        format!(
            "one neighbour is {ratio:.0} times as far away as the other, where the knots turn {turn}°: \
             no curve was found that is as smooth as that on both sides"
        )
    } else if turn >= SHARP {
        format!("the knots turn {turn}° here, too sharply for any curve that was found")
    } else if matches!(knot.join, Join::CurveToTerminal | Join::TerminalToCurve) {
        format!(
            "no curve was found that turns {turn}° here and leaves the straight side of this knot \
             undisturbed"
        )
    } else {
        format!("no curve was found that joins in this way where the knots turn {turn}°")
    }
}
