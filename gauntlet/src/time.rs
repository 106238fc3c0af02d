//! Solve times in one process, measured in turns so that a busy machine slows both alike.

use std::collections::BTreeMap;
use std::hint::black_box;
use std::time::Instant;

use faircurve::{Contour, Spline};
use serde::Serialize;
use serde_json::json;

use crate::fonts_input::FontContour;
use crate::generate::classes;
use crate::report::{Report, table};
use crate::rivals::{LibspiroInput, Ours, Theirs};
use crate::{Failure, spiro};

/// Contours in each synthetic class.
const CASES: usize = 20;

/// Times over one set of contours, each solved by both programs.
#[derive(Debug, Serialize)]
struct Timing {
    set: String,
    /// Contours that both solve, which alone are timed.
    contours: usize,
    /// Of how many.
    of: usize,
    /// Median over the rounds, for the whole set, seconds.
    our_seconds: f64,
    libspiro_seconds: f64,
    /// The median contour's time, seconds.
    our_typical_seconds: f64,
    libspiro_typical_seconds: f64,
    /// libspiro's time over ours: the median of the rounds' ratios, and the extremes.
    ratio: f64,
    lowest_ratio: f64,
    highest_ratio: f64,
}

/// Times the fonts, each on its own and all together, and if asked the ordinary synthetic classes.
pub(crate) fn run(
    fonts: &[FontContour],
    rounds: usize,
    synthetic: bool,
) -> Result<Report, Failure> {
    let spline = spiro()?;
    let mut by_font: BTreeMap<&str, Vec<Contour>> = BTreeMap::new();
    for font in fonts {
        by_font.entry(&font.font).or_default().push(font.contour.clone());
    }
    let mut timings: Vec<Timing> = by_font
        .into_iter()
        .filter_map(|(font, contours)| measure(font, &contours, &*spline, rounds))
        .collect();
    if synthetic {
        for class in classes().into_iter().filter(|class| class.is_anchor) {
            let contours: Vec<Contour> = (0..CASES).map(|case| class.contour(case)).collect();
            timings.extend(measure(&class.name, &contours, &*spline, rounds));
        }
    }
    let rows = timings
        .iter()
        .map(|t| {
            let microseconds = |seconds: f64| format!("{:.2}", 1e6 * seconds);
            [
                t.set.clone(),
                format!("{} of {}", t.contours, t.of),
                microseconds(t.our_typical_seconds),
                microseconds(t.libspiro_typical_seconds),
                microseconds(t.our_seconds / t.contours as f64),
                microseconds(t.libspiro_seconds / t.contours as f64),
                format!("{:.2}", t.ratio),
                format!("{:.2}–{:.2}", t.lowest_ratio, t.highest_ratio),
            ]
        })
        .collect();
    let header = [
        "set",
        "solved by both",
        "faircurve median µs",
        "libspiro",
        "mean µs",
        "libspiro",
        "total: libspiro/faircurve",
        "range",
    ];
    let text = format!(
        "{}\nMedians of {rounds} rounds, both programs in turn; µs a contour; solve only (libspiro: \
         run_spiro0 and free_spiro).\n",
        table(header, rows),
    );
    let json = json!({ "rounds": rounds, "timings": timings });
    Ok(Report { text, json, notable: Vec::new(), alarms: Vec::new() })
}

/// `None` where no contour is solved by both.
fn measure(set: &str, contours: &[Contour], spline: &dyn Spline, rounds: usize) -> Option<Timing> {
    let both: Vec<(&Contour, LibspiroInput)> = contours
        .iter()
        .filter(|contour| {
            Ours::solve(contour, spline).is_ok_and(|ours| ours.is_solved())
                && Theirs::solve(contour).is_truly_solved()
        })
        .filter_map(|contour| Some((contour, LibspiroInput::new(contour)?)))
        .collect();
    if both.is_empty() {
        return None;
    }
    // One pass over the set; each contour's seconds.
    let libspiro_pass = || each_timed(&both, |(_, input)| input.solve_only());
    let our_pass = || {
        each_timed(&both, |(contour, _)| {
            let _ = black_box(faircurve::solve(black_box(contour), spline));
        })
    };
    // The first pass warms the caches.
    let _ = (libspiro_pass(), our_pass());
    let (theirs, ours): (Vec<_>, Vec<_>) =
        (0..rounds).map(|_| (libspiro_pass(), our_pass())).unzip();
    let totals = |passes: &[Vec<f64>]| passes.iter().map(|pass| pass.iter().sum()).collect();
    let (their_totals, our_totals): (Vec<f64>, Vec<f64>) = (totals(&theirs), totals(&ours));
    let ratios = sorted(their_totals.iter().zip(&our_totals).map(|(theirs, ours)| theirs / ours));
    // The median contour, each at its median over the rounds.
    let typical = |passes: &[Vec<f64>]| {
        let of_contour = |i: usize| median(&sorted(passes.iter().map(|pass| pass[i])));
        median(&sorted((0..both.len()).map(of_contour)))
    };
    Some(Timing {
        set: set.to_owned(),
        contours: both.len(),
        of: contours.len(),
        our_typical_seconds: typical(&ours),
        libspiro_typical_seconds: typical(&theirs),
        ratio: median(&ratios),
        lowest_ratio: ratios[0],
        highest_ratio: ratios[ratios.len() - 1],
        our_seconds: median(&sorted(our_totals.into_iter())),
        libspiro_seconds: median(&sorted(their_totals.into_iter())),
    })
}

fn each_timed<T>(items: &[T], work: impl Fn(&T)) -> Vec<f64> {
    items
        .iter()
        .map(|item| {
            let clock = Instant::now();
            work(item);
            clock.elapsed().as_secs_f64()
        })
        .collect()
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values
}

fn median(sorted: &[f64]) -> f64 {
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { (sorted[middle - 1] + sorted[middle]) / 2.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians() {
        assert_eq!(median(&sorted([3.0, 1.0, 2.0].into_iter())), 2.0);
        assert_eq!(median(&sorted([4.0, 1.0, 2.0, 3.0].into_iter())), 2.5);
    }
}
