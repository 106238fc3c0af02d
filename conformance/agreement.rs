//! When two solutions agree, and the cases on which all ways into faircurve must: see README.md. Part of
//! the tests of several packages.

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

/// The files of all cases.
pub fn cases() -> Vec<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../conformance/cases");
    let mut cases: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    cases.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    cases.sort();
    cases
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
pub fn disagreement(ours: &Value, theirs: &Value) -> Option<String> {
    difference(ours, theirs, "", 0, Units::default())
}

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
