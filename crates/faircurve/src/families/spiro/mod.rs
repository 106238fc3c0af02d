//! The Spiro spline: polynomial spirals joined as Table 7.1 says (thesis sections 7.3, 7.4).

mod hermite;
mod segments;

use kurbo::Point;
use num_complex::Complex64;

use super::catalog::{Claim, SplineInfo};
use super::euler::fit_euler;
use crate::four_param::family::{Ends, FourParamFamily, Response};
use crate::four_param::spline::ConstraintSpline;
use crate::frame::ChordAngles;
use crate::numeric::spiro_integral::{
    SpiroMoments, curvature_jet, rough_spiro_moments, spiro_integral, spiro_moments,
};
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::{PolynomialSpiral, Segment, SpiralChord};
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

    fn solve_lone_run(&self, run: &Run, effort: Effort) -> RunSolution {
        self.solve_run(run, effort)
    }
}

/// The family of segments whose curvature is a cubic in arc length; its parameters are k₀ … k₃ of
/// eq. 8.1.
#[derive(Clone, Copy, Debug, Default)]
pub struct PolynomialSpirals;

impl FourParamFamily for PolynomialSpirals {
    fn respond(&self, k: [f64; 4]) -> Response {
        let mut response = Response::NONE;
        self.respond_to(k, false, &mut response);
        response
    }

    fn respond_roughly(&self, k: [f64; 4]) -> Response {
        let mut response = Response::NONE;
        self.respond_to(k, true, &mut response);
        response
    }

    fn respond_to(&self, k: [f64; 4], is_rough: bool, response: &mut Response) {
        let moments = if is_rough { rough_spiro_moments(k) } else { spiro_moments(k) };
        write_response(k, &moments, response);
    }

    fn ends(&self, k: [f64; 4]) -> Ends {
        ends(k, spiro_integral(k))
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

/// The ends of the segment with these parameters and this spiro integral.
fn ends(k: [f64; 4], integral: Complex64) -> Ends {
    let SpiralChord { length: c, direction: psi } = SpiralChord::new(integral, k[0]);
    let [k0, k1, k2, k3] = k;
    // Of the angle from the middle, what is the same on both sides, and what isn't.
    let (even, odd) = (k0 / 2.0 + k2 / 48.0, k1 / 8.0 + k3 / 384.0);
    // κ, κ′, κ″ at both ends for arc length 1.
    let [kappa0, first0, second0, _] = curvature_jet(k, -0.5);
    let [kappa1, first1, second1, _] = curvature_jet(k, 0.5);
    let (c2, c3) = (c * c, c * c * c);
    Ends {
        jets: [even - odd + psi, even + odd - psi, c * kappa0, c * kappa1],
        derivatives: [c2 * first0, c3 * second0, c2 * first1, c3 * second1],
        straightness: c,
    }
}

/// Writes the response of the segment with these parameters and moments.
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
fn write_response(k: [f64; 4], moments: &SpiroMoments, response: &mut Response) {
    let ends = ends(k, moments.integral());
    let c = ends.straightness;
    let [_, _, kappa0, kappa1] = ends.jets;
    let [first0, second0, first1, second1] = ends.derivatives;
    let (a, b) = ((kappa0 + kappa1) / (2.0 * c), (kappa1 - kappa0) / c);
    let (c2, c3) = (c * c, c * c * c);

    // Response of log M₀ to T, A, E, B (the factorials are in the numbers), and the two equations for
    // d(log c), dψ.
    let SpiroMoments([m0, moments @ ..]) = *moments;
    let i_over_m0 = Complex64::new(m0.im, m0.re) / (c * c);
    let [g0, g1, g2, g3] = moments.map(|moment| moment * i_over_m0);
    let by_t = 1.5 * g0 - 2.0 * g2;
    let by_a = 2.0 * g2 - 0.5 * g0;
    let by_e = 4.0 * g1 - 8.0 * g3;
    let by_b = 2.0 * g3 - 0.5 * g1;
    let log_c_column = 1.0 + by_a * a + by_b * b;
    let psi_column = Complex64::i() - 2.0 * by_e;
    let determinant = log_c_column.re * psi_column.im - log_c_column.im * psi_column.re;
    let (log_c_column, psi_column) = (log_c_column / determinant, psi_column / determinant);

    // Of T, D, S or F, what follows for k₀ … k₃ and for κ′, κ″ at both ends. By it, log M₀ changes by
    // `right`, and T, A, B and E as given, but for what the changes of log c and ψ add.
    let column = |right: Complex64, [t, a_alone, b_alone, e_alone]: [f64; 4]| {
        let log_c = right.re * psi_column.im - right.im * psi_column.re;
        let psi = log_c_column.re * right.im - log_c_column.im * right.re;
        let (da, db) = (a_alone - a * log_c, b_alone - b * log_c);
        let de = e_alone + 2.0 * psi;
        let (half_k2, half_k3) = (6.0 * (da - t), 24.0 * (db - 4.0 * de));
        let first = 5.0 * db - 16.0 * de;
        let by_k = [(3.0 * t - da) / 2.0, 8.0 * de - db, 2.0 * half_k2, 2.0 * half_k3];
        let derivatives = [
            c2 * (first - half_k2) + 2.0 * first0 * log_c,
            c3 * (2.0 * half_k2 - half_k3) + 3.0 * second0 * log_c,
            c2 * (first + half_k2) + 2.0 * first1 * log_c,
            c3 * (2.0 * half_k2 + half_k3) + 3.0 * second1 * log_c,
        ];
        (by_k, derivatives)
    };
    let t = column(by_t, [1.0, 0.0, 0.0, 0.0]);
    let d = column(by_e, [0.0, 0.0, 0.0, 1.0]);
    let s = column(by_a / (2.0 * c), [0.0, 1.0 / (2.0 * c), 0.0, 0.0]);
    let f = column(by_b / c, [0.0, 0.0, 1.0 / c, 0.0]);
    // T and D change by 1 and ∓1 with θ₀ and θ₁, S and F with κ₀ and κ₁.
    let by_jets = |t: [f64; 4], d: [f64; 4], s: [f64; 4], f: [f64; 4]| {
        std::array::from_fn(|row| {
            [t[row] - d[row], t[row] + d[row], s[row] - f[row], s[row] + f[row]]
        })
    };
    *response = Response {
        ends,
        derivatives_by_jets: by_jets(t.1, d.1, s.1, f.1),
        parameters_by_jets: by_jets(t.0, d.0, s.0, f.0),
    };
}

#[cfg(test)]
mod tests;
