//! The metrics of thesis section 9.2 that compare directions.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use kurbo::common::GAUSS_LEGENDRE_COEFFS_16;
use num_complex::Complex64;

use super::minimax::LocalCubic;
use super::options::Metric;
use super::piece::{Piece, Stretch};
use crate::numeric::order::sort_by;
use crate::numeric::trig::{argument, unit_vector};

/// Nodes of one panel.
const NODES: usize = 16;

/// The panels' rule: nodes in [0, 1] ascending, weights, and for each node the weights of the integral from 0 to it.
struct Rule {
    nodes: [f64; NODES],
    weights: [f64; NODES],
    partial: [[f64; NODES]; NODES],
}

static RULE: LazyLock<Rule> = LazyLock::new(|| {
    let mut pairs: Vec<(f64, f64)> =
        GAUSS_LEGENDRE_COEFFS_16.iter().map(|(w, x)| (0.5 + 0.5 * x, w / 2.0)).collect();
    sort_by(&mut pairs, |a, b| a.0.total_cmp(&b.0));
    let nodes: [f64; NODES] = std::array::from_fn(|i| pairs[i].0);
    let weights: [f64; NODES] = std::array::from_fn(|i| pairs[i].1);
    // Lagrange's polynomials are of degree 15, which the rule itself integrates exactly.
    let lagrange = |j: usize, x: f64| -> f64 {
        (0..NODES).filter(|m| *m != j).map(|m| (x - nodes[m]) / (nodes[j] - nodes[m])).product()
    };
    let partial = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            (0..NODES).map(|m| weights[m] * nodes[i] * lagrange(j, nodes[m] * nodes[i])).sum()
        })
    });
    Rule { nodes, weights, partial }
});

/// Panels for smooth integrands: of ordinary cubics 1e-12 of the length, of those that nearly stand still somewhere
/// less.
const SMOOTH_PANELS: usize = 4;

/// Panels for |θ_approx − θ|, which has kinks: each costs 1/(32·16)² of the integral.
const KINKED_PANELS: usize = 32;

/// Arc length of a cubic.
pub(super) fn arc_length(cubic: &LocalCubic) -> f64 {
    let rule = &*RULE;
    let width = 1.0 / SMOOTH_PANELS as f64;
    let mut sum = 0.0;
    for panel in 0..SMOOTH_PANELS {
        for i in 0..NODES {
            let t = (panel as f64 + rule.nodes[i]) * width;
            sum += rule.weights[i] * width * cubic.velocity(t).norm();
        }
    }
    sum
}

/// E_abs or E_sq of a cubic in the frame of its piece, in user units. Directions are compared at equal fractions of arc length,
/// and weighted by the piece's own. `None` for [`Metric::Distance`].
pub(super) fn angle_error(
    stretch: &Stretch<'_>,
    piece: &Piece,
    cubic: &LocalCubic,
    metric: Metric,
) -> Option<f64> {
    let panels = match metric {
        Metric::Distance => return None,
        Metric::AbsoluteAngle => KINKED_PANELS,
        Metric::SquaredAngle => SMOOTH_PANELS,
    };
    let rule = &*RULE;
    let length = arc_length(cubic);
    let width = 1.0 / panels as f64;
    let (mut sum, mut before) = (0.0, 0.0);
    // The angle between the cubic and the piece, unwrapped from node to node.
    let mut off = 0.0;
    for panel in 0..panels {
        let velocities: [Complex64; NODES] =
            std::array::from_fn(|i| cubic.velocity((panel as f64 + rule.nodes[i]) * width));
        let speeds = velocities.map(|v| v.norm() * width);
        for i in 0..NODES {
            let partial: f64 = rule.partial[i].iter().zip(speeds).map(|(w, v)| w * v).sum();
            let along = ((before + partial) / length).clamp(0.0, 1.0);
            if speeds[i] > 0.0 {
                let heading = piece.end_tangents[0] * unit_vector(stretch.turn(piece, along));
                let near = argument(velocities[i] * heading.conj());
                off = near + TAU * ((off - near) / TAU).round();
            }
            let term = if metric == Metric::AbsoluteAngle { off.abs() } else { off * off };
            sum += rule.weights[i] * speeds[i] * term;
        }
        before += rule.weights.iter().zip(speeds).map(|(w, v)| w * v).sum::<f64>();
    }
    let error = sum / length * (2.0 * piece.half);
    let error = if metric == Metric::AbsoluteAngle { error } else { error.sqrt() };
    Some(if error.is_nan() { f64::INFINITY } else { error })
}
