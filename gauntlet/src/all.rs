//! Everything at modest size, in one report.

use std::time::Instant;

use serde_json::{Map, Value};

use crate::fonts_input::FontContour;
use crate::hostile_inputs::Inputs;
use crate::report::{Report, table};
use crate::{Failure, against_search, classes, fonts, hostile, tangents, time, yardstick};

/// Contours of each class.
const CASES: usize = 20;

/// Hostile inputs.
const HOSTILE: usize = 20_000;

/// Rounds in which times are taken.
const ROUNDS: usize = 5;

/// Runs every part, those about fonts if there are any.
pub(crate) fn run(font_contours: &[FontContour]) -> Result<Report, Failure> {
    type Part<'a> = (&'a str, &'a dyn Fn() -> Result<Report, Failure>);
    let about_fonts: [Part<'_>; 3] = [
        ("fonts", &|| fonts::run(font_contours)),
        ("tangents", &|| tangents::run(font_contours)),
        ("time", &|| time::run(font_contours, ROUNDS, false)),
    ];
    let others: [Part<'_>; 3] = [
        ("classes", &|| classes::run("", 0..CASES)),
        ("against-search", &|| {
            against_search::run(&yardstick::default_folder(), "", font_contours)
        }),
        ("hostile", &|| Ok(hostile::run(0..HOSTILE, Inputs::few(0))?.1)),
    ];
    let has_fonts = !font_contours.is_empty();
    let parts = about_fonts.iter().filter(|_| has_fonts).chain(&others);
    let (mut texts, mut rows, mut json) = (String::new(), Vec::new(), Map::new());
    let (mut notable, mut alarms) = (Vec::new(), Vec::new());
    for (name, part) in parts {
        let clock = Instant::now();
        let report = part()?;
        let seconds = clock.elapsed().as_secs_f64();
        rows.push([(*name).to_owned(), format!("{seconds:.0}"), report.alarms.len().to_string()]);
        texts += &format!("\n== {name}\n\n{}", report.text);
        json.insert((*name).to_owned(), report.json);
        notable.extend(report.notable);
        alarms.extend(report.alarms.into_iter().map(|alarm| format!("{name}: {alarm}")));
    }
    let text = format!("{}{texts}", table(["part", "seconds", "alarms"], rows));
    Ok(Report { text, json: Value::Object(json), notable, alarms })
}
