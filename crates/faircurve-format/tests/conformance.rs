//! The cases that every way into faircurve must agree on: `conformance/README.md`.

use std::fs;
use std::path::PathBuf;

use faircurve::{catalog, solve};
use faircurve_format::{SolvedGlyph, json, solution_json};
use serde_json::{Value, json};

fn cases() -> Vec<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../conformance/cases");
    let mut cases: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    cases.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    cases.sort();
    cases
}

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

/// Units in which numbers of one contour are compared.
#[derive(Clone, Copy, Default)]
struct Units {
    coordinate: f64,
    curvature: f64,
    kappa: f64,
}

impl Units {
    fn of(contour: &Value) -> Units {
        let size = |value: &Value| value.as_f64().unwrap_or(0.0).abs();
        let rows = |key: &str| contour[key].as_array().cloned().unwrap_or_default();
        let mut units = Units { kappa: 1.0, ..Units::default() };
        for knot in rows("knots") {
            units.coordinate = units.coordinate.max(size(&knot["x"])).max(size(&knot["y"]));
            let sides = size(&knot["curvature_in"]).max(size(&knot["curvature_out"]));
            units.curvature = units.curvature.max(sides);
        }
        for segment in rows("segments") {
            for row in segment["samples"].as_array().into_iter().flatten() {
                units.curvature = units.curvature.max(size(&row[4]));
            }
            for k in segment["kappa"].as_array().into_iter().flatten() {
                units.kappa = units.kappa.max(size(k));
            }
        }
        units
    }

    /// That of the number with this key, or in this column of the samples.
    fn unit(&self, key: &str, column: usize) -> f64 {
        match (key, column) {
            ("x" | "y" | "length", _) | ("samples", 0..=2) => self.coordinate,
            ("direction_in" | "direction_out", _) | ("samples", 3) => 1.0,
            ("curvature_in" | "curvature_out", _) | ("samples", _) => self.curvature,
            ("kappa", _) => self.kappa,
            ("variation_energy", _) => self.curvature.powi(3),
            _ => 0.0,
        }
    }
}

/// Where two solutions differ, if they do.
fn difference(a: &Value, b: &Value, key: &str, column: usize, units: Units) -> Option<String> {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64()?, b.as_f64()?);
            let unit = a.abs().max(b.abs()).max(units.unit(key, column));
            ((a - b).abs() > 1e-12 * unit).then(|| format!("{key}: {a} {b}"))
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            let mut pairs = a.iter().zip(b).enumerate();
            pairs.find_map(|(i, (a, b))| {
                let units = if key == "contours" { Units::of(b) } else { units };
                difference(a, b, key, i, units).map(|at| format!("{key}[{i}] {at}"))
            })
        }
        (Value::Object(a), Value::Object(b)) if a.len() == b.len() => {
            a.iter().find_map(|(key, a)| {
                let is_free = ["iterations", "residual", "path"].contains(&key.as_str());
                let b = b.get(key).unwrap_or(&Value::Null);
                if is_free { None } else { difference(a, b, key, 0, units) }
            })
        }
        _ => (a != b).then(|| format!("{key}: {a} {b}")),
    }
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
        let off = difference(&solution, &case["solution"], "", 0, Units::default());
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
    let off = difference(&other, &case["solution"], "", 0, Units::default());
    assert!(off.is_some_and(|off| off.contains("samples[2] samples[1]")));
}
