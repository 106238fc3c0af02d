//! What could not be met, on stderr, and the exit code that says so.

use std::collections::BTreeMap;
use std::process::ExitCode;

use faircurve_format::SolvedGlyph;

use crate::failure::{hint, note};
use crate::select::Job;

/// The exit code when something was relaxed.
const RELAXED: u8 = 3;

/// Names everything relaxed and counts what was adapted.
pub(crate) fn report(jobs: &[Job], solved: &[SolvedGlyph], allow_relaxed: bool) -> ExitCode {
    report_adapted(solved);
    let mut relaxed_contours = 0;
    for (job, glyph) in jobs.iter().zip(solved) {
        for (index, contour) in glyph.contours.iter().enumerate() {
            let relaxed = &contour.solution.report.relaxed;
            relaxed_contours += usize::from(!relaxed.is_empty());
            for entry in relaxed {
                let place = format!("{}, {}", job.place(index), entry.place);
                let exchange = format!("asked {}, got {}", entry.asked, entry.got);
                note("relaxed", &format!("{place}: {exchange}: {}", entry.reason));
            }
        }
    }
    if relaxed_contours == 0 || allow_relaxed {
        return ExitCode::SUCCESS;
    }
    let all = solved.iter().map(|glyph| glyph.contours.len()).sum::<usize>();
    hint(&format!(
        "{relaxed_contours} of {all} contours could not be solved as asked: move knots or ask for \
         less there, or accept the nearest curve with --allow-relaxed"
    ));
    ExitCode::from(RELAXED)
}

/// One line for each kind of thing that a spline doesn't have.
fn report_adapted(solved: &[SolvedGlyph]) {
    let mut counts: BTreeMap<(&str, &str, &str), usize> = BTreeMap::new();
    for contour in solved.iter().flat_map(|glyph| &glyph.contours) {
        for entry in &contour.solution.report.adapted {
            *counts.entry((&contour.spline, entry.asked, entry.got)).or_default() += 1;
        }
    }
    for ((spline, asked, got), count) in counts {
        let places = if count == 1 { "place" } else { "places" };
        let message =
            format!("spline `{spline}` has no {asked}: {got} instead, in {count} {places}");
        note("note", &message);
    }
}
