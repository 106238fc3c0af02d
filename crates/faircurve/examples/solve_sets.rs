//! Solves the point sets of `tests/reference/mvc.json` from nothing, each once: how well, and in how
//! much work. And 64 knots by the elastic splines, with the time each takes.
//!
//! ```sh
//! cargo run --release -p faircurve --example solve_sets
//! valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect='*from_nothing*' \
//!     target/release/examples/solve_sets mvc o_metapost      # instructions of one set
//! ```

use std::f64::consts::TAU;
use std::hint::black_box;
use std::io::Write as _;
use std::time::Instant;

use faircurve::{Contour, Solution, Spline, catalog, solve};
use serde_json::Value;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/mvc.json");
    let file: Value = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let sets = file["splines"].as_object().ok_or("no splines")?;
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut out = std::io::stdout().lock();
    if let [name, set] = arguments.as_slice() {
        let contour = contour(sets.get(set).ok_or("no such set")?).ok_or("no points")?;
        let solution = from_nothing(&contour, &*catalog::spline(name)?)?;
        writeln!(out, "{name} {set}: residual {:.1e}", solution.report.residual)?;
        return Ok(());
    }
    for (set, points) in sets {
        let contour = contour(points).ok_or("no points")?;
        let solution = from_nothing(&contour, &*catalog::spline("mvc")?)?;
        let (residual, steps) = (solution.report.residual, solution.report.iterations);
        writeln!(out, "mvc {set}: residual {residual:.1e}, {steps} Newton steps")?;
    }
    for name in ["mec", "simec", "mvc", "euler", "spiro"] {
        for closed in [false, true] {
            let contour = Contour { closed, ..Contour::open(wavy_circle(64)) };
            let spline = catalog::spline(name)?;
            let status = from_nothing(&contour, &*spline)?.report.status().name();
            let least = (0..50).map(|_| {
                let start = Instant::now();
                let _ = black_box(from_nothing(black_box(&contour), &*spline));
                start.elapsed()
            });
            let least = least.min().unwrap_or_default();
            let which = if closed { "closed" } else { "open" };
            writeln!(out, "{name}, 64 knots, {which}: {status}, {least:.0?}")?;
        }
    }
    Ok(())
}

/// What is counted.
#[inline(never)]
fn from_nothing(contour: &Contour, spline: &dyn Spline) -> Result<Solution, faircurve::InputError> {
    solve(contour, spline)
}

fn contour(set: &Value) -> Option<Contour> {
    let knots: Option<Vec<(f64, f64)>> = set["points"]
        .as_array()?
        .iter()
        .map(|point| Some((point[0].as_f64()?, point[1].as_f64()?)))
        .collect();
    Some(Contour { closed: set["closed"].as_bool()?, ..Contour::open(knots?) })
}

/// Knots around a circle, in and out by a hundredth.
fn wavy_circle(count: usize) -> impl Iterator<Item = (f64, f64)> {
    (0..count).map(move |i| {
        let angle = TAU * i as f64 / count as f64;
        let radius = 500.0 * (1.0 + 0.01 * (7.0 * angle).sin() + 0.004 * (i as f64 * 2.3).sin());
        (radius * angle.cos(), radius * angle.sin())
    })
}
