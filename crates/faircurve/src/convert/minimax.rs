//! The cubic with exact ends and end tangents whose largest distance from a piece is least.
//!
//! Two arm lengths are free. To first order the deviation along the curve's normal is linear in them, and
//! of a linear problem with two unknowns the best solution has its largest deviation at three places: three equations
//! for the arms and the deviation, and an exchange finds the places (Remez). A few rounds of this
//! from the cubics in sixth-order [contact](super::contact).

use num_complex::Complex64;

use super::contact::{MINIMAX_Q, Start, contact_starts, cross, dot};
use super::grid::{GRID, deviation_on_grid, largest, on_grid, parabola, vertex, worst_lobe};
use super::piece::{NODES, PLACES, Piece};
use super::tuning::{
    CONTACT_ROUNDS, CRUDE_ROUNDS, GOOD_ENOUGH, LONG, MOST_EXCHANGES, WORTH_TRYING,
};

/// A cubic in the frame of a piece, by powers of its parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalCubic(pub(super) [Complex64; 4]);

impl LocalCubic {
    /// The cubic with the piece's ends and end tangents and these arms, in units of the half length.
    pub(super) fn with_arms(piece: &Piece, arms: [f64; 2]) -> Self {
        let [p0, p3] = piece.ends;
        let p1 = p0 + piece.end_tangents[0] * arms[0];
        let p2 = p3 - piece.end_tangents[1] * arms[1];
        LocalCubic::of_points([p0, p1, p2, p3])
    }

    pub(super) fn of_points([p0, p1, p2, p3]: [Complex64; 4]) -> Self {
        LocalCubic([p0, (p1 - p0) * 3.0, (p2 - p1 * 2.0 + p0) * 3.0, p3 - p0 + (p1 - p2) * 3.0])
    }

    pub(super) fn at(&self, t: f64) -> Complex64 {
        let [c0, c1, c2, c3] = self.0;
        c0 + (c1 + (c2 + c3 * t) * t) * t
    }

    pub(super) fn velocity(&self, t: f64) -> Complex64 {
        let [_, c1, c2, c3] = self.0;
        c1 + (c2 * 2.0 + c3 * (3.0 * t)) * t
    }

    pub(super) fn acceleration(&self, t: f64) -> Complex64 {
        let [_, _, c2, c3] = self.0;
        c2 * 2.0 + c3 * (6.0 * t)
    }
}

/// A cubic for a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    /// Arm lengths, in units of the half length.
    pub(super) arms: [f64; 2],
    /// Parameters of the cubic beside the nodes of the piece.
    pub(super) params: [f64; NODES],
    /// Deviation along the normal at each node, in units of the half length.
    pub(super) deviation: [f64; NODES],
    /// The largest between them: an estimate, not a bound. Infinite where the cubic doesn't run along
    /// the piece.
    pub(super) error: f64,
}

impl Fit {
    /// Where no cubic was found.
    pub(super) fn none() -> Self {
        Fit {
            arms: [2.0 / 3.0; 2],
            params: PLACES.map(|x| 0.5 + 0.5 * x),
            deviation: [f64::INFINITY; NODES],
            error: f64::INFINITY,
        }
    }
}

/// The best of the local minima of the largest deviation that were found, or the first cubic whose deviation is at most
/// `enough`.
pub(super) fn minimax(piece: &Piece, enough: f64) -> Fit {
    let mut best = Fit::none();
    let mut consider = |start: Start, rounds: usize| {
        if best.error > enough {
            let fit = refine(piece, start, rounds, enough);
            if fit.error < best.error {
                best = fit;
            }
        }
    };
    let mut is_long = true;
    if let Some(series) = &piece.series {
        let starts = contact_starts(series.kappa, piece, MINIMAX_Q);
        let starts = starts.as_slice();
        for start in starts {
            if start.e6.abs() <= WORTH_TRYING * starts[0].e6.abs() {
                consider(*start, CONTACT_ROUNDS);
            }
        }
        is_long = starts.is_empty() || (series.angle(1.0) - series.angle(-1.0)).abs() > LONG;
    }
    if is_long {
        let thirds = Start { arms: [2.0 / 3.0; 2], e6: f64::INFINITY };
        consider(thirds, CRUDE_ROUNDS);
    }
    best
}

/// Exchange rounds from one start, as long as the deviation is more than `enough`; the best arms seen.
pub(super) fn refine(piece: &Piece, start: Start, rounds: usize, enough: f64) -> Fit {
    let mut arms = start.arms;
    let mut params = first_params(arms);
    let mut best: Option<Fit> = None;
    for round in 0..=rounds {
        let fit = measure(piece, arms, params);
        params = fit.params;
        if best.is_none_or(|best| fit.error < best.error) {
            best = Some(fit);
        } else if round > 1 || !fit.error.is_finite() {
            break;
        }
        if round == rounds || fit.error <= enough {
            break;
        }
        let Some((step, least)) = exchange(piece, &fit) else { break };
        if fit.error <= GOOD_ENOUGH * least {
            break;
        }
        for i in 0..2 {
            // Far steps leave the range of the linear model.
            let most = 0.3 * arms[i];
            arms[i] += step[i].clamp(-most, most);
        }
    }
    best.unwrap_or(Fit::none())
}

/// The cubic of Hermite's interpolation for t(x), whose slopes at the ends are 1/(3·arm).
pub(super) fn first_params([a, b]: [f64; 2]) -> [f64; NODES] {
    let (slope0, slope1) = (2.0 / (3.0 * a), 2.0 / (3.0 * b));
    PLACES.map(|x| {
        let u = 0.5 + 0.5 * x;
        let v = 1.0 - u;
        (u * u * (3.0 - 2.0 * u) + u * v * (v * slope0 - u * slope1)).clamp(0.0, 1.0)
    })
}

/// Deviations of the cubic with these arms along the normals of the piece, from approximate parameters.
pub(super) fn measure(piece: &Piece, arms: [f64; 2], mut params: [f64; NODES]) -> Fit {
    /// Newton's method for the foot on the cubic; the deviation feels what is left only squared.
    const STEPS: usize = 2;
    let cubic = LocalCubic::with_arms(piece, arms);
    let mut deviation = [0.0; NODES];
    let mut slowest = f64::INFINITY;
    for i in 0..NODES {
        let (place, tangent) = (piece.places[i], piece.tangents[i]);
        // Along the tangent and along the normal: two real cubics.
        let turned = cubic.0.map(|c| c * tangent.conj());
        let place = place * tangent.conj();
        let [r0, r1, r2, r3] = turned.map(|c| c.re);
        let mut t = params[i];
        for _ in 0..STEPS {
            let ahead = r0 - place.re + (r1 + (r2 + r3 * t) * t) * t;
            let speed = r1 + (2.0 * r2 + 3.0 * r3 * t) * t;
            slowest = slowest.min(speed);
            t = (t - ahead / speed).clamp(0.0, 1.0);
        }
        let [i0, i1, i2, i3] = turned.map(|c| c.im);
        params[i] = t;
        deviation[i] = i0 - place.im + (i1 + (i2 + i3 * t) * t) * t;
    }
    let mut error = largest(&deviation_on_grid(piece, &deviation), piece.offsets);
    // Where the cubic stands still or runs backwards beside the piece, it isn't a fit; nor is NaN.
    if !(slowest > 0.0) || deviation.iter().any(|d| d.is_nan()) {
        error = f64::INFINITY;
        params = PLACES.map(|x| 0.5 + 0.5 * x);
    }
    Fit { arms, params, deviation, error }
}

/// Three equations n + a·sₐ + b·s_b = ±level, the signs those of the combination in which the arms cancel.
struct Reference {
    level: f64,
    combination: [f64; 3],
}

impl Reference {
    fn new(n: [f64; 3], by_a: [f64; 3], by_b: [f64; 3]) -> Self {
        let pair = |i: usize, j: usize| by_a[i] * by_b[j] - by_a[j] * by_b[i];
        let combination = [pair(1, 2), pair(2, 0), pair(0, 1)];
        let sum: f64 = combination.iter().map(|c| c.abs()).sum();
        let product: f64 = combination.iter().zip(n).map(|(c, n)| c * n).sum();
        Reference { level: if sum > 0.0 { product / sum } else { 0.0 }, combination }
    }

    /// The arms, from the two equations that know them best.
    fn step(&self, n: [f64; 3], by_a: [f64; 3], by_b: [f64; 3]) -> Option<[f64; 2]> {
        let mut skipped = 0;
        for i in 1..3 {
            if self.combination[i].abs() > self.combination[skipped].abs() {
                skipped = i;
            }
        }
        let determinant = self.combination[skipped];
        let (i, j) = ((skipped + 1) % 3, (skipped + 2) % 3);
        let right_i = self.level * self.combination[i].signum() - n[i];
        let right_j = self.level * self.combination[j].signum() - n[j];
        let step = [
            (right_i * by_b[j] - right_j * by_b[i]) / determinant,
            (by_a[i] * right_j - by_a[j] * right_i) / determinant,
        ];
        (step[0].is_finite() && step[1].is_finite()).then_some(step)
    }
}

/// The change of the arms that makes the largest deviation least, by the linear model, and what is
/// then left.
fn exchange(piece: &Piece, fit: &Fit) -> Option<([f64; 2], f64)> {
    let [t0, t1] = piece.end_tangents;
    let mut by_a = [0.0; NODES];
    let mut by_b = [0.0; NODES];
    for i in 0..NODES {
        let (t, tangent) = (fit.params[i], piece.tangents[i]);
        let u = 1.0 - t;
        by_a[i] = 3.0 * u * u * t * cross(tangent, t0);
        by_b[i] = -3.0 * u * t * t * cross(tangent, t1);
    }
    let n = deviation_on_grid(piece, &fit.deviation);
    let (by_a, by_b) = (on_grid(&by_a), on_grid(&by_b));
    let at = |reference: [usize; 3]| {
        (reference.map(|g| n[g]), reference.map(|g| by_a[g]), reference.map(|g| by_b[g]))
    };
    let solve = |reference: [usize; 3]| {
        let (n, by_a, by_b) = at(reference);
        Reference::new(n, by_a, by_b)
    };
    // The extrema of the leading term.
    let mut reference = [8, 15, 22];
    let mut solved = solve(reference);
    let mut left = [0.0; GRID];
    for _ in 0..MOST_EXCHANGES {
        let (rn, ra, rb) = at(reference);
        let step = solved.step(rn, ra, rb)?;
        for g in 0..GRID {
            left[g] = n[g] + by_a[g] * step[0] + by_b[g] * step[1];
        }
        let worst = worst_lobe(&left, piece.offsets);
        if !(left[worst].abs() > solved.level.abs() * 1.000_001) {
            break;
        }
        // Of four places, the three with the highest level are the answer.
        let mut improved = None;
        let mut level = solved.level.abs();
        for out in 0..3 {
            let mut candidate = reference;
            candidate[out] = worst;
            let tried = solve(candidate);
            if tried.level.abs() > level {
                level = tried.level.abs();
                improved = Some((candidate, tried));
            }
        }
        let Some(improved) = improved else { break };
        (reference, solved) = improved;
    }
    // Once more at the true extrema, between the points of the grid.
    let offsets = reference.map(|g| vertex(&left, g).0);
    let between =
        |values: &[f64; GRID]| std::array::from_fn(|i| parabola(values, reference[i], offsets[i]));
    let (rn, ra, rb) = (between(&n), between(&by_a), between(&by_b));
    let solved = Reference::new(rn, ra, rb);
    Some((solved.step(rn, ra, rb)?, solved.level.abs()))
}

/// The parameter of the cubic's point whose projection onto the tangent at `place` is `place`; from a
/// start, at most six steps of Newton's method.
pub(super) fn foot(cubic: &LocalCubic, place: Complex64, tangent: Complex64, start: f64) -> f64 {
    let mut t = start;
    for _ in 0..6 {
        let ahead = dot(cubic.at(t) - place, tangent);
        let speed = dot(cubic.velocity(t), tangent);
        let next = (t - ahead / speed).clamp(0.0, 1.0);
        if !next.is_finite() {
            return start;
        }
        let change = (next - t).abs();
        t = next;
        if change < 1e-12 {
            break;
        }
    }
    t
}
