//! Where good arms are: cubics in sixth-order contact with the curve (the local minima of thesis
//! section 9.5, to leading order, for every metric at once).
//!
//! Source of the formulas: an expansion of the curve about the middle of a piece to sixth order.
//! With x ∈ [−1, 1] along the piece, half its length the unit, k₀ … k₃ the curvature and its derivatives at the
//! middle, and
//! A = k₀/2, B = k₁/6, C = (3k₀³ + k₂)/24, D = (19k₀²k₁ + k₃)/120, E = k₀(45k₀⁴ + 34k₀k₂ + 48k₁²)/720,
//! the cubics in sixth-order contact belong to the real roots α of
//! 2A²α³ + 3ABα² + (9B² − 6AC)α + 3BC − 2AD = 0;
//! each deviates along the normal by −E₆(x² − 1)²(x² − q) to leading order, where the metric only sets q.

use kurbo::common::solve_quadratic;
use num_complex::Complex64;

use super::piece::Piece;
use super::tuning::NEARLY_REAL;
use crate::numeric::roots::cubic_roots;

/// q of the cubic that minimises the largest distance: the root of 4(1 − q)³ = 27q.
pub(super) const MINIMAX_Q: f64 = 0.105_892_543;

/// The largest distance of that cubic is this times |E₆|, in units of the half length (it is q: the
/// deviation at the middle).
pub(super) const MINIMAX_ERROR: f64 = MINIMAX_Q;

/// A start for the arms of a cubic.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    /// Arm lengths, in units of the half length.
    pub(super) arms: [f64; 2],
    /// E₆, signed: what is left of the deviation.
    pub(super) e6: f64,
}

/// The cubics in sixth-order contact, those with the smallest |E₆| first: at most three; moved so that
/// ends and end tangents are exact and the deviation is spread as `q` says.
pub(super) fn contact_starts(kappa: [f64; 4], piece: &Piece, q: f64) -> Starts {
    let mut starts = expansions(kappa);
    for start in &mut starts.starts[..starts.count] {
        // Curvature at the ends that spreads the deviation: δ = −8(1 − q)E₆.
        let shift = -8.0 * (1.0 - q) * start.e6;
        start.arms = meet_end_curvatures(piece, piece.end_curvature.map(|k| k + shift), start.arms);
    }
    starts
}

/// At most three starts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Starts {
    starts: [Start; 3],
    count: usize,
}

impl Starts {
    fn push(&mut self, start: Start) {
        if self.count < self.starts.len() {
            self.starts[self.count] = start;
            self.count += 1;
        }
    }

    /// The smallest |E₆| of those in contact.
    pub(super) fn least(&self) -> Option<f64> {
        self.as_slice().iter().map(|start| start.e6.abs()).find(|e6| *e6 > 0.0)
    }

    pub(super) fn as_slice(&self) -> &[Start] {
        &self.starts[..self.count]
    }
}

/// The arms by the expansion alone. `kappa`: curvature by powers of x.
pub(super) fn expansions(kappa: [f64; 4]) -> Starts {
    let [k0, k1, k2, k3] = [kappa[0], kappa[1], 2.0 * kappa[2], 6.0 * kappa[3]];
    let a = k0 / 2.0;
    let b = k1 / 6.0;
    let c = (3.0 * k0 * k0 * k0 + k2) / 24.0;
    let d = (19.0 * k0 * k0 * k1 + k3) / 120.0;
    let e = k0 * (45.0 * k0 * k0 * k0 * k0 + 34.0 * k0 * k2 + 48.0 * k1 * k1) / 720.0;
    let mut starts = Starts { starts: [Start { arms: [2.0 / 3.0; 2], e6: 0.0 }; 3], count: 0 };
    let contact = [3.0 * b * c - 2.0 * a * d, 9.0 * b * b - 6.0 * a * c, 3.0 * a * b, 2.0 * a * a];
    let (roots, count) = cubic_roots(contact);
    let roots = &roots[..count];
    for &alpha in roots {
        if let Some(start) = expansion([a, b, c, d, e], k0, alpha) {
            starts.push(start);
        }
    }
    starts.starts[..starts.count].sort_by(|a, b| a.e6.abs().total_cmp(&b.e6.abs()));
    // Where two of three roots have met and become complex, p ± iy with a small y, there is still a local
    // minimum near p, though nothing is in contact there.
    if let &[root] = roots {
        let extrema = solve_quadratic(contact[1], 2.0 * contact[2], 3.0 * contact[3]);
        let value = |x: f64| contact[0] + x * (contact[1] + x * (contact[2] + x * contact[3]));
        // The polynomial is contact[3]·(x − root)·((x − p)² + y²).
        let y2 = |x: f64| value(x) / (contact[3] * (x - root));
        let met = extrema.into_iter().min_by(|x, y| y2(*x).abs().total_cmp(&y2(*y).abs()));
        if let Some(p) = met
            && y2(p).abs() < NEARLY_REAL
            && let Some(start) = expansion([a, b, c, d, e], k0, p)
        {
            starts.push(Start { e6: 0.0, ..start });
        }
    }
    starts
}

/// α to a start, if it makes sense.
fn expansion([a, b, c, d, e]: [f64; 5], k0: f64, alpha: f64) -> Option<Start> {
    // Beyond, the expansion means nothing (and NaN, of a curve that is nearly straight).
    if !(alpha.abs() <= 2.0) {
        return None;
    }
    // Two forms of the same; the better conditioned one.
    let (first, second) = (2.0 * a, 2.0 * a * alpha + 3.0 * b);
    let beta = if first.abs() >= second.abs() {
        -(a * alpha * alpha + 3.0 * b * alpha + c) / first
    } else {
        -(3.0 * b * alpha * alpha + 4.0 * c * alpha + d) / second
    };
    let e6 = a * beta * beta
        + b * (alpha * alpha * alpha + 6.0 * alpha * beta)
        + c * (6.0 * alpha * alpha + 4.0 * beta)
        + 5.0 * d * alpha
        + e;
    // k₀²/6 turns the abscissa into arc length.
    let quadratic = beta + k0 * k0 / 6.0;
    let cubic = 2.0 * alpha * alpha - quadratic;
    let (from, to) = (-1.0 - alpha - cubic, 1.0 - alpha + cubic);
    let width = (to - from) / 3.0;
    let arm = |t: f64| width * (1.0 + 2.0 * alpha * t + 3.0 * quadratic * t * t);
    let arms = [arm(from), arm(to)];
    let sane = e6.is_finite() && arms.iter().all(|arm| *arm > 0.0 && *arm < 2.0);
    sane.then_some(Start { arms, e6 })
}

/// Newton's method for the arms at which the cubic's end curvatures are those given:
/// ³⁄₂κa² + bS = T₀×d and its mirror, S = T₀×T₁, d the chord. The start itself where it leads
/// nowhere.
pub(super) fn meet_end_curvatures(piece: &Piece, kappa: [f64; 2], start: [f64; 2]) -> [f64; 2] {
    let [t0, t1] = piece.end_tangents;
    let chord = piece.ends[1] - piece.ends[0];
    let s = cross(t0, t1);
    let (right_a, right_b) = (cross(t0, chord), cross(chord, t1));
    let [mut a, mut b] = start;
    for _ in 0..3 {
        let f = 1.5 * kappa[0] * a * a + b * s - right_a;
        let g = 1.5 * kappa[1] * b * b + a * s - right_b;
        let (fa, gb) = (3.0 * kappa[0] * a, 3.0 * kappa[1] * b);
        let determinant = fa * gb - s * s;
        if determinant.abs() < 1e-12 * (s * s).max((fa * gb).abs()).max(f64::MIN_POSITIVE) {
            break;
        }
        a -= (f * gb - g * s) / determinant;
        b -= (g * fa - f * s) / determinant;
    }
    let sane = |arm: f64| arm > 0.0 && arm < 2.0;
    if sane(a) && sane(b) { [a, b] } else { start }
}

pub(super) fn cross(a: Complex64, b: Complex64) -> f64 {
    a.re * b.im - a.im * b.re
}

pub(super) fn dot(a: Complex64, b: Complex64) -> f64 {
    a.re * b.re + a.im * b.im
}
