//! Times of solving with a spline (`spiro` where none is named), alone and with the conversion to
//! Béziers, of closed contours in a JSON file: a list of lists of points. For the measurements of
//! the npm package.
//!
//! ```sh
//! cargo run --release -p faircurve --example solve_times -- points.json euler
//! ```
#![allow(clippy::print_stdout)]

use std::hint::black_box;
use std::time::{Duration, Instant};

use faircurve::convert::to_bezpath;
use faircurve::{Contour, catalog, solve};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("usage: solve_times points.json [spline]")?;
    let name = std::env::args().nth(2);
    let contours: Vec<Vec<(f64, f64)>> = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let spline = catalog::spline(name.as_deref().unwrap_or("spiro"))?;
    for points in contours {
        let contour = Contour::closed(points);
        let solved = median(|| drop(black_box(solve(&contour, &*spline))));
        let drawn = median(|| {
            let solution = solve(&contour, &*spline);
            drop(black_box(solution.map(|solution| to_bezpath(&solution.curve, 0.1))));
        });
        println!("{solved:.1} {drawn:.1}");
    }
    Ok(())
}

/// µs of one call.
fn median(mut does: impl FnMut()) -> f64 {
    let mut times = Vec::new();
    let end = Instant::now() + Duration::from_millis(400);
    while times.len() < 20 || Instant::now() < end {
        let start = Instant::now();
        does();
        times.push(start.elapsed().as_secs_f64() * 1e6);
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
