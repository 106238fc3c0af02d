//! The figures of the thesis about elastica and minimum variation curves, redrawn: 3.1, 3.2, 3.5, 3.10,
//! 3.11, 3.13 to 3.17, 4.2, 4.14, 5.15 and 7.1.
//!
//! ```sh
//! cargo run --release -p faircurve --example figures_elastica
//! ```
//!
//! writes `docs/figures/figure-*.svg`.

mod angles;
mod family;
mod lengths;
mod page;
mod splines;

use std::io::Write as _;

type Figure = fn() -> String;

fn main() -> std::io::Result<()> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/figures");
    let figures: [(&str, Figure); 14] = [
        ("3-1", family::curves),
        ("3-2", family::curvatures),
        ("3-5", family::pendulums),
        ("3-10", lengths::lambda_by_chord),
        ("3-11", angles::all_with_the_same_tangents),
        ("3-13", angles::minimum_energy_curves),
        ("3-14", angles::curvatures),
        ("3-15", lengths::energies_of_right_angles),
        ("3-16", lengths::energies_of_60_degrees),
        ("3-17", lengths::energies_of_opposite_angles),
        ("4-2", splines::roundness),
        ("4-14", splines::gradients),
        ("5-15", family::roulette),
        ("7-1", splines::oval),
    ];
    for (name, draw) in figures {
        std::fs::write(format!("{folder}/figure-{name}.svg"), draw())?;
        writeln!(std::io::stdout(), "wrote docs/figures/figure-{name}.svg")?;
    }
    Ok(())
}
