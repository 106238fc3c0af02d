//! Synthetic classes, ordinary and hard, through both programs.

use faircurve::{Contour, catalog};
use faircurve_format::Document;
use serde::Serialize;
use serde_json::json;

use crate::generate::{Class, classes};
use crate::progress::Progress;
use crate::report::{Report, describe, list, percent, table, tiny};
use crate::residual::LOOP;
use crate::rivals::{Ours, TRULY_SOLVED, Theirs};
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
    /// What the report claims doesn't hold.
    falsehoods: usize,
    not_finite: usize,
    most_iterations: usize,
    our_seconds: f64,
    libspiro_returns_one: usize,
    libspiro_truly_solved: usize,
    /// Truly solved with a segment longer than 4 chords.
    libspiro_loops: usize,
    libspiro_seconds: f64,
    /// Truly solved by libspiro without a loop, and not by faircurve.
    libspiro_alone: usize,
}

/// The first contours of the class of that name, each with its own.
///
/// # Errors
/// If there is no such class.
pub(crate) fn contours(name: &str, cases: usize) -> Result<Vec<(String, Contour)>, Failure> {
    let class = classes().into_iter().find(|class| class.name == name).ok_or_else(|| Failure {
        message: format!("there is no class `{name}`"),
        hint: catalog::suggest(name, classes().iter().map(|class| class.name.as_str())),
    })?;
    Ok((0..cases).map(|case| (case_name(&class, case), class.contour(case))).collect())
}

fn case_name(class: &Class, case: usize) -> String {
    format!("{} case {case}", class.name)
}

/// Runs both programs over `cases` contours of each class whose name contains `filter`.
pub(crate) fn run(filter: &str, cases: usize) -> Result<Report, Failure> {
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
    let mut alone = Vec::new();
    let mut progress = Progress::new(chosen.len());
    for class in &chosen {
        progress.step(&class.name);
        let mut t =
            Tally { class: class.name.clone(), is_anchor: class.is_anchor, ..Tally::default() };
        for case in 0..cases {
            let contour = class.contour(case);
            t.cases += 1;
            let clock = std::time::Instant::now();
            let theirs = Theirs::solve(&contour);
            t.libspiro_seconds += clock.elapsed().as_secs_f64();
            let their_loop = theirs.curve.as_ref().is_some_and(|curve| curve.longest > LOOP);
            let theirs_is_true = theirs.is_truly_solved();
            t.libspiro_returns_one += usize::from(theirs.returns_one);
            t.libspiro_truly_solved += usize::from(theirs_is_true);
            t.libspiro_loops += usize::from(theirs_is_true && their_loop);
            let clock = std::time::Instant::now();
            let ours = Ours::solve(&contour, &*spline);
            t.our_seconds += clock.elapsed().as_secs_f64();
            let Ok(ours) = ours else {
                t.refused_input += 1;
                continue;
            };
            let name = case_name(class, case);
            t.most_iterations = t.most_iterations.max(ours.solution.report.iterations);
            if ours.is_solved() {
                t.solved += 1;
                t.loops += usize::from(ours.longest > LOOP);
                t.largest_residual = t.largest_residual.max(ours.as_asked.value);
            } else {
                let places = ours.solution.report.relaxed.len();
                t.relaxed += 1;
                t.relaxed_at_most_two += usize::from(places <= 2);
                t.largest_relaxed_residual = t.largest_relaxed_residual.max(ours.as_claimed.value);
                if theirs_is_true && !their_loop {
                    t.libspiro_alone += 1;
                    alone.push(format!("{name}: {}", describe(&contour)));
                    notable.push((format!("alone {name}"), Document::unnamed([contour.clone()])));
                }
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
        tallies.push(t);
    }
    progress.done();
    let text = [
        class_table(&tallies),
        format!(
            "\nPer cent of all cases. loops: with a segment longer than {LOOP} chords. ms: mean, both \
             with the judge's time.\nlibspiro counts as true when the residual recomputed from its \
             k₀…k₃ is at most {TRULY_SOLVED:e}; alone: true, loop-free, and not solved by faircurve.\n",
        ),
        list("truly solved by libspiro alone, without a loop", &alone),
    ]
    .concat();
    let json = json!({ "classes": tallies, "libspiro_alone": alone, "alarms": alarms });
    Ok(Report { text, json, notable, alarms })
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
                tiny(t.largest_residual),
                tiny(t.largest_relaxed_residual),
                t.falsehoods.to_string(),
                t.not_finite.to_string(),
                t.most_iterations.to_string(),
                milliseconds(t.our_seconds),
                of_all(t.libspiro_returns_one),
                of_all(t.libspiro_truly_solved),
                of_all(t.libspiro_loops),
                milliseconds(t.libspiro_seconds),
                t.libspiro_alone.to_string(),
            ]
        })
        .collect();
    let header = [
        "class",
        "solved",
        "relaxed ≤2",
        ">2",
        "loops",
        "residual",
        "if relaxed",
        "false",
        "not finite",
        "steps",
        "ms",
        "libspiro: 1",
        "true",
        "loops",
        "ms",
        "alone",
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
