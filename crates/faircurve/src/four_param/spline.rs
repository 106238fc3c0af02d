//! The spline of a four-parameter family: Table 7.1's conditions at every knot of a run.

use super::family::FourParamFamily;
use super::strategy::{self, UNSETTLED};
use super::system::RunSystem;
use crate::frame::{circle_tangent, direction, wrap_angle};
use crate::numeric::block_tridiagonal::BlockTridiagonal;
use crate::outline::Join;
use crate::plan::Run;
use crate::spline::{Place, Relaxation, RunSolution};
use crate::tolerance::SOLVED;

/// A four-parameter family with the joins of Table 7.1.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintSpline<F> {
    family: F,
}

/// A run solved with certain joins.
struct Solved {
    /// The family's parameters of each segment.
    parameters: Vec<[f64; 4]>,
    /// Largest residual at each knot.
    residuals: Vec<f64>,
    iterations: usize,
}

impl Solved {
    fn residual(&self) -> f64 {
        self.residuals.iter().fold(
            0.0,
            |worst, r| {
                if r.is_nan() { f64::INFINITY } else { worst.max(*r) }
            },
        )
    }

    fn is_solved(&self) -> bool {
        self.residual() <= SOLVED
    }
}

impl<F: FourParamFamily> ConstraintSpline<F> {
    /// The spline of this family.
    pub fn new(family: F) -> Self {
        ConstraintSpline { family }
    }

    /// Solves one run: as asked if possible, else relaxed at the knots where it isn't.
    pub fn solve_run(&self, run: &Run) -> RunSolution {
        let mut budget = strategy::budget(run.knots.len());
        let solved = self.solve_smooth(run, &mut budget);
        if solved.is_solved() {
            return self.place(run, solved, Vec::new());
        }
        let (solved, weaker) = self.relax(run, solved);
        let relaxed = relaxations(run, &weaker);
        self.place(run, solved, relaxed)
    }

    /// Weakens what is asked where the run doesn't settle, until it does: joins to G2 and then to
    /// G1, first at the most strained knots of each bad stretch, then at more of them; curvatures
    /// given at bad ends to none. With G1 everywhere each segment stands alone and can be drawn
    /// unless it would have to close into a circle; such a one becomes a line.
    ///
    /// Returns the solution and the run as weakened.
    fn relax(&self, run: &Run, first: Solved) -> (Solved, Run) {
        /// Rounds of each kind; every round doubles what it weakens.
        const ROUNDS: u32 = 4;
        let n = run.knots.len();
        let mut weaker = run.clone();
        let mut budget = strategy::budget(n) / 2;
        let mut iterations = first.iterations;
        let mut last = first;
        for join in [Join::G2, Join::G1] {
            for round in 1..=ROUNDS {
                let bad: Vec<bool> = (0..n).map(|i| !(last.residuals[i] <= UNSETTLED)).collect();
                let stretches = (0..n).filter(|&i| bad[i] && !bad[(i + n - 1) % n]).count().max(1);
                let mut candidates: Vec<usize> = (0..n)
                    .filter(|&i| bad[i] && is_interior(run, i))
                    .filter(|&i| ![join, Join::G1].contains(&weaker.knots[i].join))
                    .collect();
                candidates.sort_by(|&a, &b| strain(run, b).total_cmp(&strain(run, a)));
                candidates.truncate(stretches << round);
                candidates.iter().for_each(|&i| weaker.knots[i].join = join);
                let ends = (0..n).filter(|&i| bad[i] && !is_interior(run, i));
                ends.for_each(|i| weaker.knots[i].curvature = None);
                let solved = self.solve_split(&weaker, &mut budget);
                iterations += solved.iterations;
                last = Solved { iterations, ..solved };
                if last.is_solved() {
                    return self.restore(run, weaker, last);
                }
            }
        }
        for i in 0..n {
            weaker.knots[i].curvature = None;
            if is_interior(run, i) {
                weaker.knots[i].join = Join::G1;
            }
        }
        last = self.solve_split(&weaker, &mut 0);
        last.iterations += iterations;
        for i in 0..run.segment_count() {
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
    /// plain Newton iteration solves.
    fn restore(&self, run: &Run, mut weaker: Run, mut solved: Solved) -> (Solved, Run) {
        /// Segments that the trials may solve for in all.
        const MOST_WORK: usize = 5000;
        let mut weakened: Vec<usize> =
            (0..run.knots.len()).filter(|&i| run.knots[i].join != weaker.knots[i].join).collect();
        weakened.sort_by(|&a, &b| strain(run, a).total_cmp(&strain(run, b)));
        weakened.truncate(MOST_WORK / run.knots.len());
        for i in weakened {
            let mut trial = weaker.clone();
            trial.knots[i].join = run.knots[i].join;
            let attempt = self.solve_split(&trial, &mut 0);
            if attempt.is_solved() {
                let iterations = solved.iterations + attempt.iterations;
                (solved, weaker) = (Solved { iterations, ..attempt }, trial);
            }
        }
        (solved, weaker)
    }

    /// Solves a run without G1 knots.
    fn solve_smooth(&self, run: &Run, budget: &mut usize) -> Solved {
        let mut system = RunSystem::new(&self.family, run);
        let mut matrix = BlockTridiagonal::new(run.knots.len(), run.closed);
        let outcome = strategy::solve(&mut system, &mut matrix, || self.arcs(run), budget);
        system.clean();
        Solved {
            residuals: (0..run.knots.len()).map(|i| system.knot_residual(i)).collect(),
            parameters: system.parameters,
            iterations: outcome.iterations,
        }
    }

    /// Segments between the tangents that are given, or those of the circle through each knot and
    /// its neighbours (thesis 4.10): already the solution for knots on a circle, and for a lone
    /// segment between given tangents.
    fn arcs(&self, run: &Run) -> Vec<[f64; 4]> {
        let n = run.knots.len();
        let tangent = |i: usize| {
            let circle = || is_interior(run, i).then(|| self.g1_tangent(run, i));
            run.knots[i].tangent.or_else(circle)
        };
        (0..run.segment_count())
            .map(|i| {
                let chord = direction(run.chord(i));
                let theta0 = tangent(i).map(|t| wrap_angle(chord - t));
                let theta1 = tangent((i + 1) % n).map(|t| wrap_angle(t - chord));
                // Symmetric at free ends.
                let (theta0, theta1) =
                    (theta0.or(theta1).unwrap_or(0.0), theta1.or(theta0).unwrap_or(0.0));
                self.family.between_tangents(theta0, theta1)
            })
            .collect()
    }

    /// Solves a run that may have G1 knots, at which it falls into stretches of their own.
    fn solve_split(&self, run: &Run, budget: &mut usize) -> Solved {
        let n = run.knots.len();
        let is_split = |i: usize| is_interior(run, i) && run.knots[i].join == Join::G1;
        let mut bounds: Vec<usize> = (0..n).filter(|&i| is_split(i)).collect();
        let Some(&first) = bounds.first() else { return self.solve_smooth(run, budget) };
        if run.closed {
            bounds.push(first);
        } else {
            bounds.insert(0, 0);
            bounds.push(n - 1);
        }
        let mut whole = Solved {
            parameters: vec![[0.0; 4]; run.segment_count()],
            residuals: vec![0.0; n],
            iterations: 0,
        };
        for pair in bounds.windows(2) {
            let mut stretch = run.stretch(pair[0], pair[1]);
            let count = stretch.knots.len();
            let ends = [(0, pair[0]), (count - 1, pair[1])];
            for (end, knot) in ends.into_iter().filter(|&(_, knot)| is_split(knot)) {
                stretch.knots[end].tangent = Some(self.g1_tangent(run, knot));
                stretch.knots[end].curvature = None;
            }
            let solved = self.solve_smooth(&stretch, budget);
            for (i, parameters) in solved.parameters.into_iter().enumerate() {
                whole.parameters[(pair[0] + i) % n] = parameters;
            }
            for (i, residual) in solved.residuals.into_iter().enumerate() {
                let worst = &mut whole.residuals[(pair[0] + i) % n];
                *worst = if residual.is_nan() { residual } else { worst.max(residual) };
            }
            whole.iterations += solved.iterations;
        }
        whole
    }

    /// The tangent of a knot relaxed to G1: the given one, or that of the circle.
    fn g1_tangent(&self, run: &Run, i: usize) -> f64 {
        let n = run.knots.len();
        let point = |i: usize| run.knots[i % n].point;
        run.knots[i]
            .tangent
            .unwrap_or_else(|| circle_tangent(point(i + n - 1), point(i), point(i + 1)))
    }

    fn place(&self, run: &Run, solved: Solved, relaxed: Vec<Relaxation>) -> RunSolution {
        let n = run.knots.len();
        let point = |i: usize| run.knots[i % n].point;
        let segment = |(i, parameters): (usize, &[f64; 4])| {
            self.family.shape(point(i), point(i + 1), *parameters)
        };
        RunSolution {
            segments: solved.parameters.iter().enumerate().map(segment).collect(),
            relaxed,
            iterations: solved.iterations,
            residual: solved.residual(),
            ..RunSolution::default()
        }
    }
}

fn is_interior(run: &Run, i: usize) -> bool {
    run.closed || (i > 0 && i + 1 < run.knots.len())
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

/// What the weakened run no longer asks.
fn relaxations(run: &Run, weaker: &Run) -> Vec<Relaxation> {
    let mut relaxed = Vec::new();
    for (i, (asked, got)) in run.knots.iter().zip(&weaker.knots).enumerate() {
        let mut relax = |asked, got| {
            let reason = reason(run, i);
            relaxed.push(Relaxation { place: Place::Knot(i), asked, got, reason });
        };
        if is_interior(run, i) {
            if asked.join != got.join {
                relax(asked.join.name(), got.join.name());
            }
            continue;
        }
        if asked.tangent != got.tangent {
            relax("tangent", "free");
        }
        if asked.curvature != got.curvature {
            // At the contour's own end or a corner the curvature was given; elsewhere it is that of
            // the straight line which the join continues.
            match asked.join {
                Join::Corner => relax("curvature", "free"),
                join => relax(join.name(), Join::G1.name()),
            }
        }
    }
    relaxed
}

/// Words for a designer.
fn reason(run: &Run, i: usize) -> String {
    if !is_interior(run, i) {
        return "no curve was found that starts or ends in this way".to_owned();
    }
    let turn = run.knots[i].turn.abs().to_degrees().round();
    let ratio = chord_ratio(run, i);
    let mut words =
        format!("no curve was found that joins in this way where the knots turn {turn}°");
    if ratio >= 10.0 {
        words += &format!(" and one neighbour is {ratio:.0} times as far as the other");
    }
    words
}
