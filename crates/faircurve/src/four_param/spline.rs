//! The spline of a four-parameter family: Table 7.1's conditions at every knot of a run.

use super::budget::Budget;
use super::family::FourParamFamily;
use super::relax::{Cause, relaxations};
use super::strategy;
use super::system::RunSystem;
use crate::frame::{circle_tangent, direction, wrap_angle};
use crate::numeric::block_tridiagonal::BlockTridiagonal;
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::Segment;
use crate::spline::{Effort, Relaxation, RunSolution, Stage};
use crate::tolerance::SOLVED;

/// A four-parameter family with the joins of Table 7.1.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintSpline<'a> {
    family: &'a dyn FourParamFamily,
}

/// A run solved with certain joins.
#[derive(Clone)]
pub(super) struct Solved {
    /// The family's parameters of each segment.
    pub parameters: Vec<[f64; 4]>,
    /// Largest residual at each knot.
    pub residuals: Vec<f64>,
    /// Segments that loop.
    pub loops: usize,
    pub iterations: usize,
    pub stage: Stage,
}

impl Solved {
    /// What a system has come to.
    fn of(mut system: RunSystem<'_>, iterations: usize, stage: Stage) -> Solved {
        system.clean();
        Solved {
            residuals: (0..system.knots.len()).map(|i| system.knot_residual(i)).collect(),
            loops: system.loops().count(),
            parameters: system.parameters,
            iterations,
            stage,
        }
    }

    pub(super) fn residual(&self) -> f64 {
        self.residuals.iter().fold(
            0.0,
            |worst, r| {
                if r.is_nan() { f64::INFINITY } else { worst.max(*r) }
            },
        )
    }

    pub(super) fn is_solved(&self) -> bool {
        self.residual() <= SOLVED
    }

    /// Solved without loops.
    pub(super) fn is_good(&self) -> bool {
        self.is_solved() && self.loops == 0
    }
}

/// How a run is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Means {
    /// By plain Newton iteration alone.
    Plain,
    /// By a search, where that doesn't lead to a curve without loops.
    Search,
}

impl<'a> ConstraintSpline<'a> {
    /// The spline of this family.
    pub fn new(family: &'a dyn FourParamFamily) -> Self {
        ConstraintSpline { family }
    }

    /// Solves one run if plain Newton iteration does, without loops.
    pub fn solve_plainly(&self, run: &Run) -> Option<RunSolution> {
        let solved = self.solve_smooth(run, Means::Plain, &mut Budget::new(0));
        solved.is_good().then(|| self.place(run, solved, Vec::new()))
    }

    /// Solves one run from segments that are known, in their windings, if plain Newton iteration
    /// does without more loops.
    pub fn follow(&self, run: &Run, near: &[Segment]) -> Option<RunSolution> {
        let mut system = RunSystem::new(self.family, run);
        let known: Option<Vec<_>> = near.iter().map(|s| self.family.parameters(s)).collect();
        system.parameters = known.filter(|known| known.len() == run.segment_count())?;
        system.evaluate();
        let loops = system.loops().count();
        system.unwind();
        let mut matrix = BlockTridiagonal::new(run.knots.len(), run.closed);
        let outcome = strategy::settle(&mut system, &mut matrix);
        let solved = Solved::of(system, outcome.iterations, Stage::Plain);
        (solved.is_solved() && solved.loops <= loops).then(|| self.place(run, solved, Vec::new()))
    }

    /// Solves one run: as asked if possible, else relaxed at the knots where it isn't.
    pub fn solve_run(&self, run: &Run, effort: Effort) -> RunSolution {
        /// Share of the effort that is kept for relaxing.
        const FOR_RELAXING: f64 = 0.25;
        let mut budget = Budget::new(effort.evaluations(run.knots.len()));
        budget.reserve(FOR_RELAXING);
        let solved = self.solve_smooth(run, Means::Search, &mut budget);
        if solved.is_solved() {
            if effort.avoids_loops()
                && solved.loops > 0
                && let Some((solved, weaker)) = self.unloop(run, &solved)
            {
                let relaxed = relaxations(run, &weaker, Cause::Loop);
                return self.place(run, solved, relaxed);
            }
            return self.place(run, solved, Vec::new());
        }
        budget.release();
        let (solved, weaker) = self.relax(run, solved, budget);
        let relaxed = relaxations(run, &weaker, Cause::Unsolved);
        self.place(run, solved, relaxed)
    }

    /// Solves a run without G1 knots, as well as means and budget allow.
    fn solve_smooth(&self, run: &Run, means: Means, budget: &mut Budget) -> Solved {
        let mut system = RunSystem::new(self.family, run);
        let mut matrix = BlockTridiagonal::new(run.knots.len(), run.closed);
        let (plain, is_good) =
            strategy::solve_plainly(&mut system, &mut matrix, budget, || self.arcs(run));
        let (outcome, stage) = if is_good || means == Means::Plain {
            (plain, Stage::Plain)
        } else {
            strategy::search(&mut system, &mut matrix, plain, budget)
        };
        Solved::of(system, outcome.iterations, stage)
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

    /// Solves a run that may have G1 knots and corners, at which it falls into stretches of their own.
    pub(super) fn solve_split(&self, run: &Run, means: Means, budget: &mut Budget) -> Solved {
        let n = run.knots.len();
        let is = |i: usize, join: Join| is_interior(run, i) && run.knots[i].join == join;
        let is_split = |i: usize| is(i, Join::G1) || is(i, Join::Corner);
        let mut bounds: Vec<usize> = (0..n).filter(|&i| is_split(i)).collect();
        let Some(&first) = bounds.first() else { return self.solve_smooth(run, means, budget) };
        if run.closed {
            bounds.push(first);
        } else {
            bounds.insert(0, 0);
            bounds.push(n - 1);
        }
        let mut whole = Solved {
            parameters: vec![[0.0; 4]; run.segment_count()],
            residuals: vec![0.0; n],
            loops: 0,
            iterations: 0,
            stage: Stage::Plain,
        };
        for pair in bounds.windows(2) {
            let mut stretch = run.stretch(pair[0], pair[1]);
            let count = stretch.knots.len();
            let ends = [(0, pair[0]), (count - 1, pair[1])];
            for (end, knot) in ends.into_iter().filter(|&(_, knot)| is(knot, Join::G1)) {
                stretch.knots[end].tangent = Some(self.g1_tangent(run, knot));
            }
            let solved = self.solve_smooth(&stretch, means, budget);
            for (i, parameters) in solved.parameters.into_iter().enumerate() {
                whole.parameters[(pair[0] + i) % n] = parameters;
            }
            for (i, residual) in solved.residuals.into_iter().enumerate() {
                let worst = &mut whole.residuals[(pair[0] + i) % n];
                *worst = if residual.is_nan() { residual } else { worst.max(residual) };
            }
            whole.loops += solved.loops;
            whole.iterations += solved.iterations;
            whole.stage = whole.stage.max(solved.stage);
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
            stage: solved.stage,
            ..RunSolution::default()
        }
    }
}

pub(super) fn is_interior(run: &Run, i: usize) -> bool {
    run.closed || (i > 0 && i + 1 < run.knots.len())
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use kurbo::Point;

    use super::*;
    use crate::families::spiro::{PolynomialSpirals, Spiro};
    use crate::four_param::family::{Ends, Response};
    use crate::outline::{Contour, Knot};
    use crate::plan::Plan;
    use crate::segment::Segment;

    /// Counts evaluations.
    #[derive(Debug)]
    struct Counted<'a>(&'a Cell<usize>);

    impl Counted<'_> {
        fn count(&self) {
            self.0.set(self.0.get() + 1);
        }
    }

    impl FourParamFamily for Counted<'_> {
        fn respond(&self, parameters: [f64; 4]) -> Response {
            self.count();
            PolynomialSpirals.respond(parameters)
        }
        fn respond_roughly(&self, parameters: [f64; 4]) -> Response {
            self.count();
            PolynomialSpirals.respond_roughly(parameters)
        }
        fn ends(&self, parameters: [f64; 4]) -> Ends {
            self.count();
            PolynomialSpirals.ends(parameters)
        }
        fn between_tangents(&self, theta0: f64, theta1: f64) -> [f64; 4] {
            PolynomialSpirals.between_tangents(theta0, theta1)
        }
        fn between_ends(&self, ends: [f64; 4]) -> Vec<[f64; 4]> {
            PolynomialSpirals.between_ends(ends)
        }
        fn shape(&self, start: Point, end: Point, parameters: [f64; 4]) -> Segment {
            PolynomialSpirals.shape(start, end, parameters)
        }
        fn bend(&self, change: [f64; 4]) -> f64 {
            PolynomialSpirals.bend(change)
        }
    }

    /// Knots all over a square of 101 units, by a fixed sequence; the same everywhere.
    fn scattered(count: usize, closed: bool, seed: usize) -> Contour {
        let knots = (0..count).map(|i| {
            let i = i + seed;
            let (x, y) = ((i * i * 37 + i * 11) % 101, (i * i * i * 53 + i * 29) % 101);
            Knot::new((x as f64, y as f64 + 1e-3 * i as f64)).join(Join::G4)
        });
        if closed { Contour::closed(knots) } else { Contour::open(knots) }
    }

    /// All work on a run, searching and relaxing, stays within its budget, but for plain solves: the
    /// one before it, those that are made even when nothing is left (each round of relaxing makes
    /// one), and by how much a single step may overspend.
    #[test]
    fn no_run_spends_more_than_its_budget() {
        /// Evaluations a segment: so many plain solves of at most 20 each, and two steps of a search.
        const BEYOND: usize = 14 * 20 + 2 * 50;
        let mut most = 0.0f64;
        for (count, effort) in
            [(5, 1.0), (8, 1.0), (8, 0.01), (16, 1.0), (48, 1.0), (48, 0.0), (120, 1.0)]
        {
            for closed in [false, true] {
                for seed in 0..3 {
                    let contour = scattered(count, closed, 100 * seed);
                    let plan = Plan::new(&contour, &Spiro).unwrap();
                    for run in plan.runs() {
                        let evaluations = Cell::new(0);
                        let effort = Effort::times(effort);
                        let budget = effort.evaluations(run.knots.len());
                        let _ =
                            ConstraintSpline::new(&Counted(&evaluations)).solve_run(run, effort);
                        let beyond = BEYOND * run.segment_count();
                        let spent = evaluations.get();
                        most = most.max(spent as f64 / budget.max(1) as f64);
                        assert!(
                            spent <= budget + beyond,
                            "{count} {closed} {seed}: {spent} of {budget} + {beyond}"
                        );
                    }
                }
            }
        }
        // Some are so hard that they need all of it.
        assert!(most > 0.9, "{most}");
    }
}
