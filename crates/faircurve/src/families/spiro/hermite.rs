//! Segments with given directions and curvatures at both ends: Hermite's problem, which for
//! polynomial spirals has infinitely many answers, one or more for every way of winding up.
//!
//! With log c + iψ the logarithm of the spiro integral, two unknowns are left
//! ([`PolynomialSpirals`](super::PolynomialSpirals) has the formulas). The answers worth having are
//! straight: most of the arc lies along the chord, the ends curl. Then curvature and its slope are
//! small in the middle, k₀ ≈ k₁ ≈ 0, and so is ψ, which for a given c fixes the sum and the
//! difference of the end angles: T ≈ S/6c, D ≈ F/8c. The angles are known up to full turns, so that
//! only the few windings near that point need trying.

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::numeric::order::sort_by;
use crate::numeric::spiro_integral::spiro_moments;
use crate::numeric::trig::{argument, unit_vector};

/// Segments with the ends `[theta0, theta1, kappa0, kappa1]` (unit chord, angles modulo full turns),
/// as k₀ … k₃, the straightest first.
///
/// Of 30 random ends with curvatures up to 80, the straightest of all segments is the first one
/// returned for 29; a search on a fine grid misses two of them. Nothing is found for curvatures
/// beyond 200: such segments are too wound up to be worth drawing.
pub(super) fn between_ends(ends: [f64; 4]) -> Vec<[f64; 4]> {
    /// Values of chord over arc to start from.
    const STRAIGHTNESS: [f64; 5] = [0.9, 0.7, 0.5, 0.35, 0.25];
    /// Windings further from the expected sum and difference of angles than this give nothing new.
    const REACH: f64 = 6.5;
    const LARGEST_CURVATURE: f64 = 200.0;
    let [theta0, theta1, kappa0, kappa1] = ends;
    if !(kappa0.abs().max(kappa1.abs()) <= LARGEST_CURVATURE) {
        return Vec::new();
    }
    let (sum, difference) = (kappa0 + kappa1, kappa1 - kappa0);
    let mut found: Vec<(f64, [f64; 4])> = Vec::new();
    for c in STRAIGHTNESS {
        let (t, d) = (sum / (6.0 * c), difference / (8.0 * c));
        let nearest = |theta: f64, expected: f64| theta + TAU * ((expected - theta) / TAU).round();
        let (near0, near1) = (nearest(theta0, (t - d) / 2.0), nearest(theta1, (t + d) / 2.0));
        for (more0, more1) in NEIGHBOURS {
            let (theta0, theta1) = (near0 + TAU * more0, near1 + TAU * more1);
            if (theta0 + theta1 - t).hypot(theta1 - theta0 - d) > REACH {
                continue;
            }
            let ends = Sums { t: theta0 + theta1, d: theta1 - theta0, s: sum, f: difference };
            let is_new = |k: &[f64; 4]| {
                let same = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-3 * (1.0 + a.abs());
                !found.iter().any(|(_, other)| k.iter().zip(other).all(same))
            };
            if let Some((c, k)) = ends.solve(c).filter(|(_, k)| is_new(k)) {
                found.push((c, k));
            }
        }
    }
    sort_by(&mut found, |a, b| b.0.total_cmp(&a.0));
    found.into_iter().map(|(_, k)| k).collect()
}

/// Full turns added to both angles.
const NEIGHBOURS: [(f64, f64); 9] = [
    (0.0, 0.0),
    (-1.0, 0.0),
    (1.0, 0.0),
    (0.0, -1.0),
    (0.0, 1.0),
    (-1.0, -1.0),
    (1.0, 1.0),
    (-1.0, 1.0),
    (1.0, -1.0),
];

/// Sums and differences of a segment's end angles and curvatures, for unit chord.
#[derive(Clone, Copy, Debug)]
struct Sums {
    t: f64,
    d: f64,
    s: f64,
    f: f64,
}

impl Sums {
    /// k₀ … k₃ for ln(chord/arc) and the chord's direction ψ in the frame of the middle.
    fn parameters(self, log_c: f64, psi: f64) -> [f64; 4] {
        let arc = (-log_c).exp();
        let (a, b, e) = (self.s / 2.0 * arc, self.f * arc, self.d + 2.0 * psi);
        [(3.0 * self.t - a) / 2.0, 8.0 * e - b, 12.0 * (a - self.t), 48.0 * (b - 4.0 * e)]
    }

    /// How far ln M₀ of those parameters is from log_c + iψ, and Newton's step in log_c and ψ.
    fn linearize(self, log_c: f64, psi: f64) -> (Complex64, [f64; 2]) {
        let moments = spiro_moments(self.parameters(log_c, psi));
        let m0 = moments.integral();
        let inverse = m0.inv();
        let g: [Complex64; 4] = std::array::from_fn(|j| moments.derivative(j) * inverse);
        let turned = m0 * unit_vector(-psi);
        let off = Complex64::new(0.5 * turned.norm_sqr().ln() - log_c, argument(turned));
        let arc = (-log_c).exp();
        let (a, b) = (self.s / 2.0 * arc, self.f * arc);
        let by_log_c = a * (0.5 * g[0] - 12.0 * g[2]) + b * (g[1] - 48.0 * g[3]) - 1.0;
        let by_psi = 16.0 * g[1] - 384.0 * g[3] - Complex64::i();
        let cross = |x: Complex64, y: Complex64| x.re * y.im - x.im * y.re;
        let determinant = cross(by_log_c, by_psi);
        (off, [cross(by_psi, off) / determinant, cross(off, by_log_c) / determinant])
    }

    /// Newton's method from a guess of chord over arc, for a chord along the middle's direction.
    /// Returns chord over arc and the parameters, good to about six digits.
    fn solve(self, c: f64) -> Option<(f64, [f64; 4])> {
        const STEPS: usize = 14;
        const LONGEST_STEP: f64 = 0.4;
        const CLOSE: f64 = 1e-6;
        /// No segment is straighter than its chord; beyond this one is a curl.
        const LOG_C: std::ops::Range<f64> = -5.0..0.5;
        let (mut log_c, mut psi) = (c.ln(), 0.0);
        for _ in 0..STEPS {
            let (off, step) = self.linearize(log_c, psi);
            let size = step[0].abs().max(step[1].abs());
            if !size.is_finite() || !LOG_C.contains(&log_c) {
                return None;
            }
            let share = (LONGEST_STEP / size).min(1.0);
            log_c += share * step[0];
            psi += share * step[1];
            if size < CLOSE && off.norm_sqr() < CLOSE * CLOSE {
                return Some((log_c.exp(), self.parameters(log_c, psi)));
            }
        }
        None
    }
}
