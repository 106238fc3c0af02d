//! What a subcommand hands back, and how tables and problem contours are written.

use std::fmt::Write as _;
use std::path::Path;

use comfy_table::{CellAlignment, Table, presets};
use faircurve::Contour;
use faircurve_format::{Document, json};
use serde_json::Value;

use crate::Failure;
use crate::residual::PlacedCurve;
use crate::rivals::letters;

/// The outcome of a subcommand.
#[derive(Debug)]
pub(crate) struct Report {
    /// For people.
    pub(crate) text: String,
    /// The same for programs.
    pub(crate) json: Value,
    /// Contours to look at, by a name that will be part of a file name.
    pub(crate) notable: Vec<(String, Document)>,
    /// Things that must never happen: a curve that claims to be solved and isn't, a number that
    /// isn't finite.
    pub(crate) alarms: Vec<String>,
}

impl Report {
    /// Writes the notable contours into `folder` as documents, one a file.
    ///
    /// # Errors
    /// If the folder or a file can't be written.
    pub(crate) fn dump(&self, folder: &Path) -> Result<(), Failure> {
        let failure = |error: std::io::Error| Failure {
            message: format!("can't write to {}: {error}", folder.display()),
            hint: "name a folder that can be written to".to_owned(),
        };
        std::fs::create_dir_all(folder).map_err(failure)?;
        for (name, document) in &self.notable {
            let safe = |c: char| {
                if c.is_ascii_alphanumeric() || "-.".contains(c) { c } else { '_' }
            };
            let file = folder.join(format!("{}.json", name.chars().map(safe).collect::<String>()));
            let text = json::write(document).map_err(|error| Failure {
                message: format!("can't write {name}: {error}"),
                hint: error.hint.unwrap_or_default(),
            })?;
            std::fs::write(file, text).map_err(failure)?;
        }
        Ok(())
    }
}

/// A table whose first column is words and whose others are numbers.
pub(crate) fn table<const N: usize>(header: [&str; N], rows: Vec<[String; N]>) -> String {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING).set_header(header);
    for row in rows {
        table.add_row(row);
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    format!("{table}\n")
}

/// A list under a title; nothing if it is empty.
pub(crate) fn list(title: &str, lines: &[String]) -> String {
    let mut text = String::new();
    if !lines.is_empty() {
        let _ = writeln!(text, "\n{title} ({}):", lines.len());
        for line in lines {
            let _ = writeln!(text, "  {line}");
        }
    }
    text
}

/// What a contour looks like, in a line.
pub(crate) fn describe(contour: &Contour) -> String {
    const MOST_LETTERS: usize = 48;
    let word = letters(contour);
    let shown: String = word.chars().take(MOST_LETTERS).collect();
    let more = if word.len() > MOST_LETTERS { "…" } else { "" };
    let placed = PlacedCurve::new(contour, &[]);
    let chords = placed
        .chord_range()
        .map_or("no chord".to_owned(), |(low, high)| format!("chords {low:.4}–{high:.1}"));
    let turn = placed.largest_turn().to_degrees();
    let how = if contour.closed { "closed" } else { "open" };
    format!("{how}, {} knots {shown}{more}, {chords}, turns to {turn:.1}°", contour.knots.len())
}

/// A share as a percentage, to a digit that can't round a miss away.
pub(crate) fn percent(part: usize, whole: usize) -> String {
    if whole == 0 {
        return "–".to_owned();
    }
    let share = 100.0 * part as f64 / whole as f64;
    if part == whole { "100".to_owned() } else { format!("{:.1}", (share * 10.0).floor() / 10.0) }
}

/// A small number such as a residual.
pub(crate) fn tiny(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faircurve::{Join, Knot};

    #[test]
    fn percentages_never_round_up_to_all() {
        assert_eq!(percent(2000, 2000), "100");
        assert_eq!(percent(1999, 2000), "99.9");
        assert_eq!(percent(0, 0), "–");
    }

    #[test]
    fn contours_are_described() {
        let contour = Contour::open([
            Knot::new((0.0, 0.0)),
            Knot::new((1.0, 0.0)).join(Join::G2),
            Knot::new((1.0, 2.0)),
        ]);
        assert_eq!(describe(&contour), "open, 3 knots {c}, chords 1.0000–2.0, turns to 90.0°");
    }
}
