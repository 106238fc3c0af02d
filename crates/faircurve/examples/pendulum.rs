//! The pendulum (thesis 3.5): its angle as it swings is the direction of an elastica as it goes on, its
//! angular velocity the curvature, time the arc length.
//!
//! ```sh
//! cargo run --release -p faircurve --example pendulum
//! ```
//!
//! steps a pendulum of length 1 through a quarter of its period, from angular velocity 1 at the bottom
//! with gravity λ, and says how far it ends from where the elastica of that λ has its inflection or its
//! place of least curvature. The error falls as the square of the time step.

use std::io::Write as _;

use faircurve::numeric::elastica::Elastica;

fn main() -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    for lambda in [0.1, 0.24, 0.25, 0.302_621_391_474_496_8, 0.5, 2.0] {
        let elastica = Elastica::with_lambda(lambda);
        // At λ = ¼ the pendulum never arrives at the top.
        let time = elastica.quarter_period().min(10.0);
        let there = elastica.at(time);
        writeln!(out, "gravity {lambda:.4}: at time {time:.6}, angle {:.6}", there.direction)?;
        for steps in [100, 200, 400, 800] {
            let (angle, velocity) = swung(lambda, time, steps);
            let (off, slower) = (angle - there.direction, velocity - there.curvature);
            writeln!(out, "  {steps:4} steps: off by {off:9.2e}, in velocity by {slower:9.2e}")?;
        }
    }
    Ok(())
}

/// Angle and angular velocity after some time, by the leapfrog method.
fn swung(gravity: f64, time: f64, steps: u32) -> (f64, f64) {
    let dt = time / f64::from(steps);
    let (mut angle, mut velocity) = (0.0f64, 1.0);
    for _ in 0..steps {
        velocity -= gravity * angle.sin() * dt / 2.0;
        angle += velocity * dt;
        velocity -= gravity * angle.sin() * dt / 2.0;
    }
    (angle, velocity)
}
