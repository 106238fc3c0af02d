//! A spline is a method from contours to curves. This file holds the method's trait, its result,
//! and the driver that every spline shares.

use std::fmt;

use kurbo::Point;

use crate::curve::Curve;
use crate::outline::{Contour, Join};
use crate::plan::{InputError, Plan, Run};
use crate::segment::Segment;

/// A method that finds a curve through knots; chosen at run time by name from the
/// [catalogue](crate::catalog).
///
/// Implementors see only [`Run`]s: stretches between corners in a normal frame. Everything else
/// ([`Plan`]) is settled once for all splines.
pub trait Spline: fmt::Debug + Send + Sync {
    /// The name under which the catalogue knows this spline.
    fn name(&self) -> &'static str;

    /// The join of a knot that names none.
    fn default_join(&self) -> Join;

    /// The join that stands in for `join` where this spline lacks it.
    fn adapt(&self, join: Join) -> Join;

    /// Solves one run the straight way; `None` where that doesn't lead to a curve without loops, so
    /// that it takes a search.
    fn solve_plainly(&self, run: &Run) -> Option<RunSolution>;

    /// Solves one run from a curve that is known: `near` has a segment for each chord, drawn for
    /// knots not far from these. `None` where that doesn't lead to a curve with no more loops, or
    /// where this spline has but one curve anyway.
    fn follow(&self, _run: &Run, _near: &[Segment]) -> Option<RunSolution> {
        None
    }

    /// Solves one run, searching as far as `effort` allows. Never fails: where something can't be
    /// met the curve is relaxed and the result says so.
    fn solve_run(&self, run: &Run, effort: Effort) -> RunSolution;

    /// Solves a contour's only run, which has all of the effort: plainly if that does. Where
    /// [`solve_run`](Self::solve_run) starts plainly itself, it alone is as good.
    fn solve_lone_run(&self, run: &Run, effort: Effort) -> RunSolution {
        self.solve_plainly(run).unwrap_or_else(|| self.solve_run(run, effort))
    }
}

/// How far to search where the straight way doesn't solve a contour as asked, before something is
/// relaxed; and whether a loop is reason enough to relax.
///
/// Counted in work, not in time, so that the result is the same on every machine; relaxing is part of
/// it. The default is at most about 50 ms a contour on a machine of 2024, and less for short runs;
/// nearly all contours need none of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// In units of the default.
    times: f64,
    /// Whether a curve that is relaxed comes before one that loops.
    avoids_loops: bool,
}

impl Default for Effort {
    fn default() -> Self {
        Effort::times(1.0)
    }
}

impl Effort {
    /// No search at all.
    pub const NONE: Effort = Effort { times: 0.0, avoids_loops: false };

    /// Segments evaluated for one contour at the default effort; 200 to 250 ns each.
    const EVALUATIONS: f64 = 150_000.0;

    /// So many times the default; what isn't a number counts as 0, and more than 10⁵ (over an hour a
    /// contour) as that.
    pub fn times(factor: f64) -> Effort {
        Effort { times: if factor > 0.0 { factor.min(1e5) } else { 0.0 }, ..Effort::NONE }
    }

    /// The same effort, where loops aren't wanted: if every curve that was found as asked has a
    /// segment longer than four chords, one or two knots (of each run) are relaxed when that
    /// gives a curve without, and reported like all that is relaxed.
    ///
    /// That costs up to some 2,200 segment evaluations a segment on top of the effort, on runs that loop only.
    /// Otherwise what is asked comes first, and a contour may have to loop for it. Only splines with
    /// four parameters a segment (`spiro`, `mvc`) ever weigh one against the other.
    pub fn avoiding_loops(self) -> Effort {
        Effort { avoids_loops: true, ..self }
    }

    /// Whether a curve that is relaxed comes before one that loops.
    pub(crate) fn avoids_loops(self) -> bool {
        self.avoids_loops
    }

    /// The same effort, for segments whose evaluation takes so many times as long.
    pub(crate) fn of_costlier(self, times: f64) -> Effort {
        Effort { times: self.times / times, ..self }
    }

    /// Segment evaluations for a run of so many knots. What a short run doesn't find early, it
    /// doesn't find late: of four random knots nearly all are solved within these.
    pub(crate) fn evaluations(self, knots: usize) -> usize {
        /// For runs of up to ten knots. With half as much again, one more contour in a thousand is solved.
        const PER_CUBE: f64 = 130.0;
        (self.times * Self::EVALUATIONS.min(PER_CUBE * (knots as f64).powi(3))) as usize
    }

    /// What is left for each of several runs, given by their numbers of knots, that share it.
    fn shared(self, runs: impl Iterator<Item = usize>) -> Effort {
        let wanted: f64 = runs.map(|knots| self.evaluations(knots) as f64).sum();
        let share = (self.times * Self::EVALUATIONS / wanted.max(1.0)).min(1.0);
        Effort { times: self.times * share, ..self }
    }
}

/// How far a solver had to go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Newton's method, from where it always starts.
    #[default]
    Plain,
    /// Solved the run with two knots that nearly coincide made one, and started from there.
    Fused,
    /// Hung a segment between the chains on both sides, solved alone.
    Bridged,
    /// Restarted stretches with other windings and other seeds; for two-parameter splines, took
    /// shorter steps from the same start.
    Mended,
    /// Built the curve anew knot by knot.
    Grown,
}

impl Stage {
    /// All stages, in the order in which they are tried.
    pub const ALL: [Stage; 5] =
        [Stage::Plain, Stage::Fused, Stage::Bridged, Stage::Mended, Stage::Grown];

    /// `plain`, `fused`, `bridged`, `mended` or `grown`.
    pub const fn name(self) -> &'static str {
        match self {
            Stage::Plain => "plain",
            Stage::Fused => "fused",
            Stage::Bridged => "bridged",
            Stage::Mended => "mended",
            Stage::Grown => "grown",
        }
    }
}

/// What a spline returns for one run: a segment for each chord, in the run's frame.
#[derive(Clone, Debug, Default)]
pub struct RunSolution {
    /// One segment for each chord of the run.
    pub segments: Vec<Segment>,
    /// What could not be met; knots and segments numbered as in the run.
    pub relaxed: Vec<Relaxation>,
    /// What of the input this spline can't use; knots and segments numbered as in the run.
    pub adapted: Vec<Adaptation>,
    /// Newton steps taken.
    pub iterations: usize,
    /// The largest violated equation, as defined at [`SolveReport::residual`].
    pub residual: f64,
    /// The stage that the segments come from.
    pub stage: Stage,
}

/// A place in a contour, by the input's numbering.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Place {
    /// The knot of that index.
    Knot(usize),
    /// The segment that leaves the knot of that index.
    Segment(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Knot(index) => write!(f, "knot {index}"),
            Place::Segment(index) => write!(f, "segment {index}"),
        }
    }
}

/// Something that was asked for and could not be met, so that something weaker holds instead.
#[derive(Clone, Debug, PartialEq)]
pub struct Relaxation {
    /// Where.
    pub place: Place,
    /// What was asked: a join's or a spline's name.
    pub asked: &'static str,
    /// What holds instead: a join's or a spline's name.
    pub got: &'static str,
    /// Why, in words for a designer.
    pub reason: String,
}

/// Something that the chosen spline doesn't have, and what stands in for it. Not an error.
#[derive(Clone, Debug, PartialEq)]
pub struct Adaptation {
    /// Where.
    pub place: Place,
    /// What was asked: a join's name, or the name of a given quantity.
    pub asked: &'static str,
    /// What stands in for it; `ignored` where nothing does.
    pub got: &'static str,
}

/// Whether all that was asked holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Everything asked holds, to [`SolveReport::residual`].
    Solved,
    /// Something could not be met; [`SolveReport::relaxed`] says what and why.
    Relaxed,
}

impl Status {
    /// `solved` or `relaxed`.
    pub const fn name(self) -> &'static str {
        match self {
            Status::Solved => "solved",
            Status::Relaxed => "relaxed",
        }
    }
}

/// How a solution came about and how good it is.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct SolveReport {
    /// What could not be met, in the input's numbering; empty when all was solved as asked.
    pub relaxed: Vec<Relaxation>,
    /// What the spline doesn't have, in the input's numbering.
    pub adapted: Vec<Adaptation>,
    /// Newton steps of the run that took most.
    pub iterations: usize,
    /// Dimensionless: the largest over all required equations of |Δκ⁽ʲ⁾|·hʲ⁺¹ (j = 0, 1, 2) with
    /// h the harmonic mean of the two chords, of |Δθ|, and of (end-point error)/chord. Two-parameter
    /// splines may have what is all but a cusp at a knot: where |κ|·h > 32 on both sides, |Δκ|·h is
    /// divided by the square of how many times so large the smaller is.
    pub residual: f64,
    /// The stage that the curve comes from: of the run that had to go furthest.
    pub stage: Stage,
}

impl SolveReport {
    /// Whether all that was asked holds.
    pub fn status(&self) -> Status {
        if self.relaxed.is_empty() { Status::Solved } else { Status::Relaxed }
    }
}

/// What holds at a knot of the solved curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolvedKnot {
    /// The knot's place, exactly as given.
    pub point: Point,
    /// The join that the curve has here (after adapting and relaxing).
    pub join: Join,
    /// Direction of arrival in radians, in (−π, π]; `None` where no segment arrives.
    pub direction_in: Option<f64>,
    /// Direction of departure in radians, in (−π, π]; `None` where no segment leaves.
    pub direction_out: Option<f64>,
    /// Curvature just before the knot, 1/units; `None` where no segment arrives.
    pub curvature_in: Option<f64>,
    /// Curvature just after the knot, 1/units; `None` where no segment leaves.
    pub curvature_out: Option<f64>,
}

/// A solved contour: the curve, what holds at its knots, and the report. All numbers are finite.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The curve: one segment for each of the contour's, in the input's numbering. A zero chord is
    /// a segment of length 0.
    pub curve: Curve,
    /// One entry for each knot of the contour, in the input's numbering.
    pub knots: Vec<SolvedKnot>,
    /// How it came about and how good it is.
    pub report: SolveReport,
}

/// Finds the curve that `spline` puts through `contour`.
///
/// The result is a function of the contour alone: the same curve from every starting knot, in
/// both directions, and under translation, rotation, mirroring and scaling (to rounding).
///
/// # Errors
/// [`InputError`] if a number isn't finite, there is no knot, or what is given contradicts itself.
/// A contour that can't be solved as asked is *not* an error: it is relaxed and says so.
///
/// ```
/// use faircurve::{Contour, catalog, solve};
/// let contour = Contour::open([(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]);
/// let solution = solve(&contour, &*catalog::spline("spiro")?)?;
/// // Three knots on a circle are joined by the circle.
/// assert!((solution.curve.length() - std::f64::consts::PI).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solve(contour: &Contour, spline: &dyn Spline) -> Result<Solution, InputError> {
    solve_with(contour, spline, Effort::default())
}

/// Like [`solve`], with another effort for contours that are hard.
///
/// # Errors
/// As for [`solve`].
pub fn solve_with(
    contour: &Contour,
    spline: &dyn Spline,
    effort: Effort,
) -> Result<Solution, InputError> {
    let plan = Plan::new(contour, spline)?;
    Ok(solve_planned(&plan, spline, effort, |_, _| None))
}

/// Finds a curve near one that is known, for a contour that is being changed by hand: it stays on
/// its branch where [`solve`] would change to another, and it takes fewer steps.
///
/// `near` has a segment for each of the contour's, drawn for knots not far from these; what is no
/// such list is ignored. Runs that don't settle from there are solved as [`solve_with`] does. The
/// result depends on `near`: of several curves that a contour may have, `solve` gives the canonical
/// one. See [`LiveContour`](crate::live::LiveContour), which keeps `near` in step with the edits.
///
/// # Errors
/// As for [`solve`].
pub fn solve_near(
    contour: &Contour,
    spline: &dyn Spline,
    effort: Effort,
    near: &[Segment],
) -> Result<Solution, InputError> {
    let plan = Plan::new(contour, spline)?;
    let known = plan.by_run(near);
    Ok(solve_planned(&plan, spline, effort, |index, run| {
        known.get(index).and_then(|near| spline.follow(run, near))
    }))
}

/// Follows the curve known of every run; those for which that isn't enough are solved plainly, or else with
/// their share of the effort.
fn solve_planned(
    plan: &Plan,
    spline: &dyn Spline,
    effort: Effort,
    follow: impl Fn(usize, &Run) -> Option<RunSolution>,
) -> Solution {
    if let [run] = plan.runs() {
        let solved = follow(0, run).unwrap_or_else(|| spline.solve_lone_run(run, effort));
        return plan.assemble(vec![solved]);
    }
    let quickly = |index: usize, run| follow(index, run).or_else(|| spline.solve_plainly(run));
    let plain: Vec<_> =
        plan.runs().iter().enumerate().map(|(i, run)| (run, quickly(i, run))).collect();
    let hard = plain.iter().filter(|(_, solved)| solved.is_none());
    let effort = effort.shared(hard.map(|(run, _)| run.knots.len()));
    let solved = plain
        .into_iter()
        .map(|(run, solved)| solved.unwrap_or_else(|| spline.solve_run(run, effort)))
        .collect();
    plan.assemble(solved)
}
