//! The error of lookup tables (thesis section 8.4), on a million places off the grid.
//!
//! ```sh
//! cargo run --release -p faircurve --example lookup_table
//! ```

use std::io::Write as _;

use faircurve::families::euler::EulerSpirals;
use faircurve::families::log_aesthetic::LogAesthetic;
use faircurve::frame::ChordAngles;
use faircurve::two_param::curvature_map::{CurvatureMap, SegmentContext};
use faircurve::two_param::generating::Cuts;
use faircurve::two_param::lookup_table::LookupTable;
use faircurve::two_param::shape::SegmentShape;

fn main() -> std::io::Result<()> {
    let preferred = Cuts { curve: LogAesthetic::new(1.78) };
    let families: [(&str, &dyn CurvatureMap, &dyn SegmentShape); 2] = [
        ("euler", &EulerSpirals, &EulerSpirals),
        ("log-aesthetic, α = 1.78", &preferred, &preferred),
    ];
    let mut out = std::io::stdout();
    for (name, map, shape) in families {
        for range in [1.5, 2.0, 3.0] {
            for side in [32, 64, 128] {
                let table = LookupTable::new(map, shape, range, side);
                let error = largest_error(&table, map);
                writeln!(out, "{name}: |θ| ≤ {range}, {side} × {side} nodes: {error:.2e}")?;
            }
        }
    }
    Ok(())
}

/// Of end curvatures for unit chord.
fn largest_error(table: &LookupTable, map: &dyn CurvatureMap) -> f64 {
    let mut state = 1u64;
    let mut random = move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let mut worst = 0.0f64;
    for _ in 0..1_000_000 {
        let angles = ChordAngles::new(table.range() * random(), table.range() * random());
        let exact = map.curvatures(angles, &SegmentContext::UNIT).value;
        for (ours, exact) in table.end_curvatures(angles).into_iter().zip(exact) {
            worst = worst.max((ours - exact.num / exact.den).abs());
        }
    }
    worst
}
