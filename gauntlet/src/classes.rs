//! Synthetic classes, ordinary and hard, through both programs.

use std::ops::Range;
use std::time::Instant;

use faircurve::{Contour, Effort, Spline, Stage, catalog};
use faircurve_format::Document;
use serde::Serialize;
use serde_json::json;

use crate::clock::Clock;
use crate::generate::{Class, classes};
use crate::progress::Progress;
use crate::report::{Report, percent, table, tiny};
use crate::residual::LOOP;
use crate::rivals::{LibspiroInput, Ours, TRULY_SOLVED, Theirs};
use crate::worse::{Differences, Worse};
use crate::{Failure, spiro};

/// The counts of one class.
#[derive(Debug, Default, Serialize)]
struct Tally {
    class: String,
    is_anchor: bool,
    cases: usize,
    solved: usize,
    relaxed: usize,
    /// Relaxed at one or two places only.
    relaxed_at_most_two: usize,
    refused_input: usize,
    /// Recomputed, over what is called solved.
    largest_residual: f64,
    /// Recomputed with the joins that hold, over what is called relaxed.
    largest_relaxed_residual: f64,
    /// Solved with a segment longer than 4 chords.
    loops: usize,
    /// Solved or relaxed at one or two places, without such a segment, where loops are to be avoided.
    free_of_loops: usize,
    /// Length over chord of the longest segment of all that is called solved.
    longest: f64,
    /// What the report claims doesn't hold.
    falsehoods: usize,
    not_finite: usize,
    most_iterations: usize,
    /// How many of the solved come from each stage, in the order of `Stage::ALL`.
    stages: [usize; Stage::ALL.len()],
    /// Wall time of the solve, over all cases.
    our_seconds: f64,
    /// Of the slowest case, without what other programs took.
    our_most_seconds: f64,
    libspiro_returns_one: usize,
    libspiro_truly_solved: usize,
    /// Truly solved with a segment longer than 4 chords.
    libspiro_loops: usize,
    libspiro_seconds: f64,
    /// Solve times over the cases that both solve.
    our_seconds_of_both: f64,
    libspiro_seconds_of_both: f64,
    /// libspiro's time over ours there; null if there are none.
    time_ratio: Option<f64>,
    /// Truly solved by libspiro, and ours is relaxed.
    worse_relaxed: usize,
    /// Loop-free by libspiro, and ours loops.
    worse_loops: usize,
    /// Ours turns more than 1.5 times as much.
    worse_turns: usize,
}

/// The first contours of the class of that name, each with its own.
///
/// # Errors
/// If there is no such class.
pub(crate) fn contours(name: &str, cases: Range<usize>) -> Result<Vec<(String, Contour)>, Failure> {
    let class = classes().into_iter().find(|class| class.name == name).ok_or_else(|| Failure {
        message: format!("there is no class `{name}`"),
        hint: catalog::suggest(name, classes().iter().map(|class| class.name.as_str())),
    })?;
    Ok(cases.map(|case| (case_name(&class, case), class.contour(case))).collect())
}

/// The contour of a name that [`contours`] gives.
pub(crate) fn contour_of(name: &str) -> Option<Contour> {
    let (class, case) = name.split_once(" case ")?;
    let class = classes().into_iter().find(|known| known.name == class)?;
    Some(class.contour(case.parse().ok()?))
}

fn case_name(class: &Class, case: usize) -> String {
    format!("{} case {case}", class.name)
}

/// Runs both programs over a range of contours of each class whose name contains `filter`.
pub(crate) fn run(filter: &str, cases: Range<usize>) -> Result<Report, Failure> {
    let chosen: Vec<Class> =
        classes().into_iter().filter(|class| class.name.contains(filter)).collect();
    if chosen.is_empty() {
        return Err(Failure {
            message: format!("no class has a name with `{filter}` in it"),
            hint: "leave it out to see all of them".to_owned(),
        });
    }
    let spline = spiro()?;
    let (mut tallies, mut notable, mut alarms) = (Vec::new(), Vec::new(), Vec::new());
    let mut differences = Differences::new();
    let mut progress = Progress::new(chosen.len());
    for class in &chosen {
        progress.step(&class.name);
        let mut t =
            Tally { class: class.name.clone(), is_anchor: class.is_anchor, ..Tally::default() };
        for case in cases.clone() {
            let contour = class.contour(case);
            t.cases += 1;
            let (their_seconds, theirs) = timed(|| Theirs::solve(&contour));
            let their_loop = theirs.curve.as_ref().is_some_and(|curve| curve.longest > LOOP);
            let theirs_is_true = theirs.is_truly_solved();
            t.libspiro_seconds += their_seconds;
            t.libspiro_returns_one += usize::from(theirs.returns_one);
            t.libspiro_truly_solved += usize::from(theirs_is_true);
            t.libspiro_loops += usize::from(theirs_is_true && their_loop);
            let clock = Clock::start();
            let (our_seconds, solution) = timed(|| faircurve::solve(&contour, &*spline));
            t.our_most_seconds = t.our_most_seconds.max(clock.seconds());
            t.our_seconds += our_seconds;
            let Ok(solution) = solution else {
                t.refused_input += 1;
                continue;
            };
            let ours = Ours::judge(&contour, &*spline, solution);
            let name = case_name(class, case);
            t.most_iterations = t.most_iterations.max(ours.solution.report.iterations);
            if ours.is_solved() {
                t.solved += 1;
                t.stages[ours.solution.report.stage as usize] += 1;
                t.loops += usize::from(ours.longest > LOOP);
                t.longest = t.longest.max(ours.longest);
                t.largest_residual = t.largest_residual.max(ours.as_asked.value);
            } else {
                let places = ours.solution.report.relaxed.len();
                t.relaxed += 1;
                t.relaxed_at_most_two += usize::from(places <= 2);
                t.largest_relaxed_residual = t.largest_relaxed_residual.max(ours.as_claimed.value);
            }
            if let (true, true, Some(input)) =
                (ours.is_solved(), theirs_is_true, LibspiroInput::new(&contour))
            {
                t.our_seconds_of_both +=
                    least_of_three(|| drop(faircurve::solve(&contour, &*spline)), our_seconds);
                // libspiro's first time holds its entry point and the judge's work too.
                t.libspiro_seconds_of_both +=
                    least_of_three(|| input.solve_only(), timed(|| input.solve_only()).0);
            }
            t.free_of_loops += usize::from(is_free_of_loops(&contour, &*spline, &ours));
            let (worse, is_new) = differences.compare(&name, &contour, &ours, &theirs);
            match worse {
                Some(Worse::Relaxed) => t.worse_relaxed += 1,
                Some(Worse::Loops) => t.worse_loops += 1,
                Some(Worse::TurnsMore) => t.worse_turns += 1,
                None => {}
            }
            if is_new {
                notable.push((format!("worse {name}"), Document::unnamed([contour.clone()])));
            }
            if let Some(falsehood) = ours.falsehood(&contour) {
                t.falsehoods += 1;
                alarms.push(format!("{name}: {falsehood}"));
                notable.push((format!("false {name}"), Document::unnamed([contour.clone()])));
            }
            if !ours.is_finite() {
                t.not_finite += 1;
                alarms.push(format!("{name}: a number isn't finite"));
                notable.push((format!("not-finite {name}"), Document::unnamed([contour.clone()])));
            }
        }
        if t.our_seconds_of_both > 0.0 {
            t.time_ratio = Some(t.libspiro_seconds_of_both / t.our_seconds_of_both);
        }
        tallies.push(t);
    }
    progress.done();
    let text = [
        class_table(&tallies),
        format!(
            "\nPer cent of all cases. loops: with a segment longer than {LOOP} chords; none, ≤2: without, when asked to \
             avoid them, and relaxed at two\nplaces at most; longest: in chords. \
             ms: mean; most: of one. libspiro's with\nits entry point and the judge. time: libspiro's over ours where \
             both solve. libspiro counts as true when the residual\nrecomputed from its k₀…k₃ is at most \
             {TRULY_SOLVED:e}. worse (cases): libspiro's is true and ours relaxed; libspiro's has no\nloop \
             and ours has; ours turns more than 1.5 times as much.\n",
        ),
        differences.text(),
    ]
    .concat();
    alarms.extend(differences.alarms());
    let json = json!({ "classes": tallies, "differences": differences.json(), "alarms": alarms });
    Ok(Report { text, json, notable, alarms })
}

/// Whether there is a curve without loops that is relaxed at two places at most, when asked to avoid
/// loops. `ours` is what comes without asking.
fn is_free_of_loops(contour: &Contour, spline: &dyn Spline, ours: &Ours) -> bool {
    let is_free = |ours: &Ours| ours.longest <= LOOP && ours.solution.report.relaxed.len() <= 2;
    is_free(ours)
        || faircurve::solve_with(contour, spline, Effort::default().avoiding_loops())
            .map(|solution| Ours::judge(contour, spline, solution))
            .is_ok_and(|ours| ours.falsehood(contour).is_none() && is_free(&ours))
}

/// Seconds that some work takes, and its result.
fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let clock = Instant::now();
    let result = work();
    (clock.elapsed().as_secs_f64(), result)
}

/// Of a solve that took `first` seconds, the least time of three; of a long one, that.
fn least_of_three(solve: impl Fn(), first: f64) -> f64 {
    const LONG: f64 = 5e-3;
    let again = if first < LONG { 2 } else { 0 };
    (0..again).map(|_| timed(&solve).0).fold(first, f64::min)
}

fn class_table(tallies: &[Tally]) -> String {
    let rows = tallies
        .iter()
        .map(|t| {
            let of_all = |part: usize| percent(part, t.cases);
            let milliseconds = |seconds: f64| format!("{:.3}", 1e3 * seconds / t.cases as f64);
            [
                t.class.clone(),
                of_all(t.solved),
                of_all(t.relaxed_at_most_two),
                of_all(t.relaxed - t.relaxed_at_most_two),
                of_all(t.loops),
                of_all(t.free_of_loops),
                format!("{:.1}", t.longest),
                tiny(t.largest_residual),
                tiny(t.largest_relaxed_residual),
                t.falsehoods.to_string(),
                t.not_finite.to_string(),
                t.most_iterations.to_string(),
                t.stages.map(|stage| stage.to_string()).join(" "),
                milliseconds(t.our_seconds),
                format!("{:.1}", 1e3 * t.our_most_seconds),
                of_all(t.libspiro_returns_one),
                of_all(t.libspiro_truly_solved),
                of_all(t.libspiro_loops),
                milliseconds(t.libspiro_seconds),
                t.time_ratio.map_or("–".to_owned(), |ratio| format!("{ratio:.1}")),
                format!("{} {} {}", t.worse_relaxed, t.worse_loops, t.worse_turns),
            ]
        })
        .collect();
    let header = [
        "class",
        "solved",
        "relaxed ≤2",
        ">2",
        "loops",
        "none, ≤2",
        "longest",
        "residual",
        "if relaxed",
        "false",
        "not finite",
        "steps",
        "stages",
        "ms",
        "most",
        "libspiro: 1",
        "true",
        "loops",
        "ms",
        "time",
        "worse",
    ];
    table(header, rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_claimed_holds() {
        let spline = spiro().unwrap_or_else(|failure| panic!("{}", failure.message));
        for class in classes() {
            for case in 0..3 {
                let name = format!("{} case {case}", class.name);
                let contour = class.contour(case);
                let ours = Ours::solve(&contour, &*spline);
                let ours = ours.unwrap_or_else(|error| panic!("{name}: {error}"));
                assert!(ours.is_finite(), "{name}");
                assert_eq!(ours.falsehood(&contour), None, "{name}");
            }
        }
    }
}
