//! faircurve against the best curves known.

use std::collections::BTreeMap;
use std::path::Path;

use faircurve::Contour;
use faircurve_format::Document;
use serde::Serialize;
use serde_json::json;

use crate::classes::contour_of;
use crate::fonts_input::FontContour;
use crate::report::{Report, list, percent, table};
use crate::residual::LOOP;
use crate::rivals::Ours;
use crate::yardstick::{Entry, Yardstick};
use crate::{Failure, spiro};

/// The counts of one class or font.
#[derive(Debug, Default, Serialize)]
struct Tally {
    /// Contours that were searched.
    searched: usize,
    /// Contours of which a root is known by search.
    known: usize,
    /// Of these, solved as asked by faircurve.
    solved: usize,
    /// Known by search, not solved by faircurve.
    only_search: usize,
    /// Solved by faircurve, not found by search.
    only_ours: usize,
    /// Both; ours has a loop, and a root without is known.
    needless_loops: usize,
    /// Both; every root known has a loop, ours has none.
    loops_of_search: usize,
    /// ∫|κ| ds of ours over the search's, ascending, where both are solved.
    #[serde(skip)]
    ratios: Vec<f64>,
    median_ratio: f64,
    worst_ratio: f64,
    least_ratio: f64,
}

/// Compares on every contour of the yardstick in `folder` that is at hand: those of the classes, and
/// the given ones.
pub(crate) fn run(folder: &Path, filter: &str, fonts: &[FontContour]) -> Result<Report, Failure> {
    let spline = spiro()?;
    let yardstick = Yardstick::read(folder)?;
    let fonts: BTreeMap<String, &Contour> =
        fonts.iter().map(|font| (font.name(), &font.contour)).collect();
    let mut tallies: BTreeMap<&str, Tally> = BTreeMap::new();
    let (mut missed, mut looped, mut notable) = (Vec::new(), Vec::new(), Vec::new());
    let mut not_at_hand = 0;
    for entry in yardstick.entries().filter(|entry| entry.place.contains(filter)) {
        let contour = fonts.get(&entry.place).map(|contour| (*contour).clone());
        let Some(contour) = contour.or_else(|| contour_of(&entry.place)) else {
            not_at_hand += 1;
            continue;
        };
        let tally = tallies.entry(entry.group()).or_default();
        tally.searched += 1;
        tally.known += usize::from(entry.turning.is_some());
        let ours = Ours::solve(&contour, &*spline).ok().filter(Ours::is_solved);
        let (ours, turning) = match (ours, entry.turning) {
            (None, None) => continue,
            (Some(_), None) => {
                tally.only_ours += 1;
                continue;
            }
            (None, Some(turning)) => {
                tally.only_search += 1;
                missed.push(in_words(entry, turning));
                notable.push((format!("missed {}", entry.place), Document::unnamed([contour])));
                continue;
            }
            (Some(ours), Some(turning)) => (ours, turning),
        };
        tally.solved += 1;
        let has_loop = ours.longest > LOOP;
        tally.loops_of_search += usize::from(!has_loop && entry.fewest_loops > 0);
        if has_loop && entry.fewest_loops == 0 {
            tally.needless_loops += 1;
            looped.push(format!("{}; ours {:.2}", in_words(entry, turning), ours.turning));
            notable.push((format!("looped {}", entry.place), Document::unnamed([contour])));
        }
        // Straight lines turn by rounding errors only.
        const STRAIGHT: f64 = 1e-9;
        tally.ratios.push((ours.turning + STRAIGHT) / (turning + STRAIGHT));
    }
    for tally in tallies.values_mut() {
        tally.ratios.sort_by(f64::total_cmp);
        let at = |place: usize| tally.ratios.get(place).copied().unwrap_or(f64::NAN);
        let count = tally.ratios.len();
        (tally.least_ratio, tally.median_ratio) = (at(0), at(count / 2));
        tally.worst_ratio = at(count.saturating_sub(1));
    }
    let rows = tallies
        .iter()
        .map(|(group, t)| {
            [
                (*group).to_owned(),
                t.searched.to_string(),
                t.known.to_string(),
                t.solved.to_string(),
                percent(t.solved, t.known),
                t.only_search.to_string(),
                t.only_ours.to_string(),
                t.needless_loops.to_string(),
                t.loops_of_search.to_string(),
                ratio(t.least_ratio),
                ratio(t.median_ratio),
                ratio(t.worst_ratio),
            ]
        })
        .collect();
    let header = [
        "class or font",
        "searched",
        "known",
        "solved",
        "%",
        "only search",
        "only ours",
        "needless loops",
        "loops of search",
        "∫|κ| least",
        "median",
        "worst",
    ];
    let text = [
        table(header, rows),
        format!(
            "\nknown: a root as asked was found by search; solved: of these, by faircurve. needless \
             loops: ours has a segment longer\nthan {LOOP} chords, and a root without is known. ∫|κ|: ours \
             over the search's. Not at hand: {not_at_hand}.\n",
        ),
        list("found by search alone", &missed),
        list("loops that the search avoids", &looped),
    ]
    .concat();
    let json = json!({
        "classes": tallies,
        "only_search": missed,
        "needless_loops": looped,
        "not_at_hand": not_at_hand,
    });
    Ok(Report { text, json, notable, alarms: Vec::new() })
}

fn ratio(value: f64) -> String {
    if value.is_nan() { "–".to_owned() } else { format!("{value:.3}") }
}

fn in_words(entry: &Entry, turning: f64) -> String {
    let loops = if entry.loops > 0 { format!(", {} loops", entry.loops) } else { String::new() };
    format!("{}: ∫|κ| ds {turning:.2}{loops}, by {}", entry.place, entry.how)
}
