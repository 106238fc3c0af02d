//! The Spiro spline: polynomial spirals joined as Table 7.1 says (thesis sections 7.3, 7.4).

mod hermite;
mod segments;

use kurbo::Point;
use num_complex::Complex64;

use super::catalog::{Claim, SplineInfo};
use super::euler::fit_euler;
use crate::four_param::family::{FourParamFamily, Response};
use crate::four_param::spline::ConstraintSpline;
use crate::frame::ChordAngles;
use crate::numeric::spiro_integral::{SpiroMoments, rough_spiro_moments, spiro_moments};
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::{PolynomialSpiral, Segment};
use crate::spline::{Effort, RunSolution, Spline};

pub use segments::{SpiroSegments, fit_spiral};

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "spiro",
    summary: "polynomial spirals with every join of thesis Table 7.1",
    source: "thesis 7.3, 7.4",
    params: &[],
    default_join: Join::G4,
    joins: &Join::ALL,
    ends: &["natural"],
    claims: &[
        Claim::Parameters(4),
        Claim::Continuity(4),
        Claim::Round,
        Claim::Extensional,
        Claim::SimilarityInvariant,
        Claim::Symmetric,
    ],
    build: |_| Ok(Box::new(Spiro)),
};

/// The Spiro spline. It takes no parameters.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spiro;

impl Spline for Spiro {
    fn name(&self) -> &'static str {
        INFO.name
    }

    fn default_join(&self) -> Join {
        INFO.default_join
    }

    fn adapt(&self, join: Join) -> Join {
        join
    }

    fn solve_plainly(&self, run: &Run) -> Option<RunSolution> {
        ConstraintSpline::new(&PolynomialSpirals).solve_plainly(run)
    }

    fn follow(&self, run: &Run, near: &[Segment]) -> Option<RunSolution> {
        ConstraintSpline::new(&PolynomialSpirals).follow(run, near)
    }

    fn solve_run(&self, run: &Run, effort: Effort) -> RunSolution {
        ConstraintSpline::new(&PolynomialSpirals).solve_run(run, effort)
    }
}

/// The family of segments whose curvature is a cubic in arc length; its parameters are k₀ … k₃ of
/// eq. 8.1.
#[derive(Clone, Copy, Debug, Default)]
pub struct PolynomialSpirals;

impl FourParamFamily for PolynomialSpirals {
    fn respond(&self, k: [f64; 4]) -> Response {
        respond(k, &spiro_moments(k))
    }

    fn respond_roughly(&self, k: [f64; 4]) -> Response {
        respond(k, &rough_spiro_moments(k))
    }
    fn between_tangents(&self, theta0: f64, theta1: f64) -> [f64; 4] {
        fit_euler(ChordAngles::new(theta0, theta1)).map_or([0.0; 4], |spiral| spiral.k)
    }

    fn between_ends(&self, ends: [f64; 4]) -> Vec<[f64; 4]> {
        hermite::between_ends(ends)
    }

    fn shape(&self, start: Point, end: Point, k: [f64; 4]) -> Segment {
        Segment::spiral(start, end, PolynomialSpiral::new(k))
    }

    fn parameters(&self, segment: &Segment) -> Option<[f64; 4]> {
        segment.kappa()
    }

    fn bend(&self, change: [f64; 4]) -> f64 {
        change[0].abs() / 2.0
            + change[1].abs() / 8.0
            + change[2].abs() / 48.0
            + change[3].abs() / 384.0
    }
}

/// The response of the segment with these parameters and moments.
///
/// With c e^{iψ} the spiro integral (chord and arc length 1), and sums and differences of the
/// ends T = θ₀ + θ₁, D = θ₁ − θ₀, S = κ₀ + κ₁, F = κ₁ − κ₀ (unit chord), the definitions
/// (eq. 8.19–8.20, 8.6) turn round exactly into
///
/// A = S/2c, B = F/c, E = D + 2ψ;
/// k₀ = (3T − A)/2, k₁ = 8E − B, k₂ = 12(A − T), k₃ = 48(B − 4E),
///
/// so that only log c and ψ depend on the ends nonlinearly, through
/// d(log c + iψ) = Σ i M_{j+1}/((j+1)! M₀) dk_j: two real equations.
fn respond(k: [f64; 4], moments: &SpiroMoments) -> Response {
    let m0 = moments.integral();
    let c = m0.norm_sqr().sqrt();
    let psi = m0.arg();
    let inverse = m0.inv();
    let g: [Complex64; 4] = std::array::from_fn(|j| moments.derivative(j) * inverse);

    // κ, κ′, κ″ at both ends for arc length 1.
    let [k0, k1, k2, k3] = k;
    let curvature = [-0.5, 0.5].map(|s| k0 + s * (k1 + s * (k2 / 2.0 + s * k3 / 6.0)));
    let first = [-0.5, 0.5].map(|s| k1 + s * (k2 + s * k3 / 2.0));
    let second = [-0.5, 0.5].map(|s| k2 + s * k3);
    let (even, odd) = (k0 / 2.0 + k2 / 48.0, k1 / 8.0 + k3 / 384.0);
    let (c2, c3) = (c * c, c * c * c);

    // Response of log M₀ to T, A, E, B, and the two equations for d(log c), dψ.
    let by_t = 1.5 * g[0] - 12.0 * g[2];
    let by_a = 12.0 * g[2] - 0.5 * g[0];
    let by_e = 8.0 * g[1] - 192.0 * g[3];
    let by_b = 48.0 * g[3] - g[1];
    let a = (curvature[0] + curvature[1]) / 2.0;
    let b = curvature[1] - curvature[0];
    let log_c_column = 1.0 + by_a * a + by_b * b;
    let psi_column = Complex64::i() - 2.0 * by_e;
    let determinant = log_c_column.re * psi_column.im - log_c_column.im * psi_column.re;

    // One column for each of T, D, S, F.
    let column = |t: f64, d: f64, s: f64, f: f64| -> [f64; 5] {
        let right = by_t * t + by_e * d + (by_a * (s / 2.0) + by_b * f) / c;
        let log_c = (right.re * psi_column.im - right.im * psi_column.re) / determinant;
        let psi = (log_c_column.re * right.im - log_c_column.im * right.re) / determinant;
        let da = s / (2.0 * c) - a * log_c;
        let db = f / c - b * log_c;
        let de = d + 2.0 * psi;
        [(3.0 * t - da) / 2.0, 8.0 * de - db, 12.0 * (da - t), 48.0 * (db - 4.0 * de), log_c]
    };
    let columns = [
        column(1.0, -1.0, 0.0, 0.0),
        column(1.0, 1.0, 0.0, 0.0),
        column(0.0, 0.0, 1.0, -1.0),
        column(0.0, 0.0, 1.0, 1.0),
    ];
    let mut derivatives_by_jets = [[0.0; 4]; 4];
    let mut parameters_by_jets = [[0.0; 4]; 4];
    for (jet, [d0, d1, d2, d3, log_c]) in columns.into_iter().enumerate() {
        let by_k = [d0, d1, d2, d3];
        (0..4).for_each(|row| parameters_by_jets[row][jet] = by_k[row]);
        for (end, s) in [-0.5, 0.5].into_iter().enumerate() {
            let d_first = d1 + s * (d2 + s * d3 / 2.0);
            let d_second = d2 + s * d3;
            derivatives_by_jets[2 * end][jet] = c2 * (d_first + 2.0 * first[end] * log_c);
            derivatives_by_jets[2 * end + 1][jet] = c3 * (d_second + 3.0 * second[end] * log_c);
        }
    }
    Response {
        jets: [even - odd + psi, even + odd - psi, c * curvature[0], c * curvature[1]],
        derivatives: [c2 * first[0], c3 * second[0], c2 * first[1], c3 * second[1]],
        derivatives_by_jets,
        parameters_by_jets,
        straightness: c,
    }
}

#[cfg(test)]
mod tests;
