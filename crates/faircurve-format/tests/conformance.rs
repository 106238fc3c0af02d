//! The cases that every way into faircurve must agree on: `conformance/README.md`.

#[path = "../../../conformance/agreement.rs"]
#[allow(unreachable_pub, reason = "shared by tests")]
mod agreement;

use std::fs;

use agreement::{cases, disagreement};
use faircurve::{catalog, solve};
use faircurve_format::{SolvedGlyph, json, solution_json};
use serde_json::{Value, json};

/// What the library answers a document with.
fn solution(document: &Value, samples: usize) -> Value {
    let document = json::read(document.to_string().as_bytes()).unwrap();
    let solved: Vec<SolvedGlyph> = document
        .glyphs
        .iter()
        .map(|glyph| {
            let contours = glyph.contours.iter().map(|contour| {
                let choice = document.spline_of(contour);
                let spline = catalog::build(&choice.name, &choice.params).unwrap();
                (choice.name.clone(), solve(&contour.contour, &*spline).unwrap())
            });
            SolvedGlyph::unconverted(glyph.name.clone(), glyph.layer.clone(), contours)
        })
        .collect();
    serde_json::from_str(&solution_json::write(&solved, Some(samples))).unwrap()
}

#[test]
fn rust_gives_the_numbers_of_every_case() {
    let cases = cases();
    assert!(cases.len() >= 20);
    for path in cases {
        let text = fs::read_to_string(&path).unwrap();
        let mut case: Value = serde_json::from_str(&text).unwrap();
        let samples = case["samples"].as_u64().unwrap() as usize;
        let solution = solution(&case["document"], samples);
        if std::env::var_os("FAIRCURVE_BLESS").is_some() {
            case["solution"] = solution;
            let lines = serde_json::to_string(&json!(case)).unwrap();
            fs::write(&path, lines.replace("{\"closed", "\n{\"closed") + "\n").unwrap();
            continue;
        }
        let off = disagreement(&solution, &case["solution"]);
        assert_eq!(off, None, "{}", path.display());
    }
}

#[test]
fn a_number_that_is_off_is_found() {
    let case = fs::read_to_string(&cases()[0]).unwrap();
    let case: Value = serde_json::from_str(&case).unwrap();
    let mut other = case["solution"].clone();
    let x = &mut other["glyphs"][0]["contours"][0]["segments"][1]["samples"][2][1];
    *x = json!(x.as_f64().unwrap() + 2e-9);
    let off = disagreement(&other, &case["solution"]);
    assert!(off.is_some_and(|off| off.contains("samples[2] samples[1]")));
}
