//! How many contours of real fonts each program solves, and which it doesn't.

use std::collections::BTreeMap;

use faircurve_format::Document;
use serde::Serialize;
use serde_json::json;

use crate::fonts_input::FontContour;
use crate::report::{Report, describe, list, percent, table, tiny};
use crate::rivals::{Ours, Theirs};
use crate::worse::Differences;
use crate::{Failure, spiro};

/// The counts of one font.
#[derive(Debug, Default, Serialize)]
struct Tally {
    contours: usize,
    solved: usize,
    relaxed: usize,
    refused_input: usize,
    /// What the report claims doesn't hold.
    falsehoods: usize,
    not_finite: usize,
    /// As the library reports it, over what it calls solved.
    largest_reported_residual: f64,
    /// The same, recomputed.
    largest_true_residual: f64,
    /// Newton steps → contours.
    iterations: BTreeMap<usize, usize>,
    /// Contours of one or two points, which libspiro isn't given.
    libspiro_spared: usize,
    libspiro_returns_zero: usize,
    /// Truly solved by libspiro; ours relaxed, or with a loop that libspiro avoids, or turning more than
    /// 1.5 times as much.
    worse_than_libspiro: usize,
    libspiro_true_residual_above_limit: usize,
    libspiro_largest_true_residual: f64,
}

/// Runs both programs over the contours.
pub(crate) fn run(contours: &[FontContour]) -> Result<Report, Failure> {
    let spline = spiro()?;
    let mut tallies: BTreeMap<&str, Tally> = BTreeMap::new();
    let (mut ours_not, mut theirs_not, mut falsely) = (Vec::new(), Vec::new(), Vec::new());
    let (mut alarms, mut notable, mut unsolved) = (Vec::new(), Vec::new(), Vec::new());
    let mut differences = Differences::new();
    for FontContour { font, place, contour } in contours {
        let tally = tallies.entry(font).or_default();
        tally.contours += 1;
        let name = format!("{font} {place}");
        let theirs = Theirs::solve(contour);
        let their_verdict = match (&theirs.curve, theirs.returns_one) {
            _ if theirs.is_spared => "isn't asked".to_owned(),
            (_, false) => "refuses".to_owned(),
            (None, true) => "returns 1 without a curve".to_owned(),
            (Some(curve), true) => format!("true residual {}", tiny(curve.residual.value)),
        };
        if theirs.is_spared {
            tally.libspiro_spared += 1;
        } else if !theirs.returns_one {
            tally.libspiro_returns_zero += 1;
            theirs_not.push(format!("{name}: {}", describe(contour)));
        } else if !theirs.is_truly_solved() {
            tally.libspiro_true_residual_above_limit += 1;
            if let Some(curve) = &theirs.curve {
                let (value, knot) = (tiny(curve.residual.value), curve.residual.knot);
                falsely
                    .push(format!("{name}: {value} at knot {knot}: {}", curve.residual.equation));
            }
        } else {
            let largest = &mut tally.libspiro_largest_true_residual;
            *largest = largest.max(theirs.residual());
        }
        let ours = match Ours::solve(contour, &*spline) {
            Ok(ours) => ours,
            Err(error) => {
                tally.refused_input += 1;
                ours_not.push(format!("{name}: refused: {error}; libspiro {their_verdict}"));
                continue;
            }
        };
        let (worse, is_new) = differences.compare(&name, contour, &ours, &theirs);
        tally.worse_than_libspiro += usize::from(worse.is_some());
        if is_new {
            notable.push((format!("worse {name}"), Document::unnamed([contour.clone()])));
        }
        let report = &ours.solution.report;
        *tally.iterations.entry(report.iterations).or_default() += 1;
        if ours.is_solved() {
            tally.solved += 1;
            let (reported, recomputed) = (report.residual, ours.as_asked.value);
            tally.largest_reported_residual = tally.largest_reported_residual.max(reported);
            tally.largest_true_residual = tally.largest_true_residual.max(recomputed);
        } else {
            tally.relaxed += 1;
            let relaxed: Vec<String> = report
                .relaxed
                .iter()
                .map(|r| format!("{} {}→{} ({})", r.place, r.asked, r.got, r.reason))
                .collect();
            ours_not.push(format!(
                "{name}: {}; relaxed {}; residual of what is claimed {}; longest segment {:.1} chords; \
                 libspiro {their_verdict}",
                describe(contour),
                relaxed.join(", "),
                tiny(ours.as_claimed.value),
                ours.longest,
            ));
            unsolved.push(json!({
                "contour": name,
                "relaxed": relaxed,
                "residual_as_claimed": ours.as_claimed,
                "libspiro": their_verdict,
            }));
            notable.push((name.clone(), Document::unnamed([contour.clone()])));
        }
        if let Some(falsehood) = ours.falsehood(contour) {
            tally.falsehoods += 1;
            alarms.push(format!("{name}: {falsehood}; {}", describe(contour)));
            notable.push((name.clone(), Document::unnamed([contour.clone()])));
        }
        if !ours.is_finite() {
            tally.not_finite += 1;
            alarms.push(format!("{name}: a number isn't finite"));
        }
    }
    let text = [
        main_table(&tallies),
        "\nNewton steps (of the run that took most)\n".to_owned(),
        histogram(&tallies),
        list("not solved as asked by faircurve", &ours_not),
        list("refused by libspiro", &theirs_not),
        list("called solved by libspiro with a true residual above 1e-5", &falsely),
        differences.text(),
    ]
    .concat();
    alarms.extend(differences.alarms());
    let json = json!({
        "fonts": tallies,
        "differences": differences.json(),
        "unsolved": unsolved,
        "libspiro_refuses": theirs_not,
        "libspiro_false": falsely,
        "alarms": alarms,
    });
    Ok(Report { text, json, notable, alarms })
}

fn main_table(tallies: &BTreeMap<&str, Tally>) -> String {
    let rows = tallies
        .iter()
        .map(|(font, t)| {
            [
                (*font).to_owned(),
                t.contours.to_string(),
                t.solved.to_string(),
                percent(t.solved, t.contours),
                t.relaxed.to_string(),
                t.refused_input.to_string(),
                tiny(t.largest_reported_residual),
                tiny(t.largest_true_residual),
                t.falsehoods.to_string(),
                t.not_finite.to_string(),
                t.libspiro_spared.to_string(),
                t.libspiro_returns_zero.to_string(),
                t.libspiro_true_residual_above_limit.to_string(),
                tiny(t.libspiro_largest_true_residual),
                t.worse_than_libspiro.to_string(),
            ]
        })
        .collect();
    let header = [
        "font",
        "contours",
        "solved",
        "%",
        "relaxed",
        "bad input",
        "residual",
        "recomputed",
        "false",
        "not finite",
        "libspiro not asked",
        "refuses",
        "false",
        "residual",
        "ours worse",
    ];
    table(header, rows)
}

fn histogram(tallies: &BTreeMap<&str, Tally>) -> String {
    let mut by_steps: BTreeMap<usize, usize> = BTreeMap::new();
    for (steps, contours) in tallies.values().flat_map(|tally| &tally.iterations) {
        *by_steps.entry(*steps).or_default() += contours;
    }
    let rows = by_steps.iter().map(|(steps, n)| [steps.to_string(), n.to_string()]).collect();
    table(["steps", "contours"], rows)
}
