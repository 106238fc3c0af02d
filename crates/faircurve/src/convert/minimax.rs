//! The cubic with exact ends and end tangents whose largest distance from a piece is least.
//!
//! Two arm lengths are free. To first order the deviation along the curve's normal is linear in them, and
//! of a linear problem with two unknowns the best solution has its largest deviation at three places: three equations
//! for the arms and the deviation, and an exchange finds the places (Remez). A few rounds of this
//! from the cubics in sixth-order [contact](super::contact).

use std::sync::LazyLock;

use num_complex::Complex64;

use super::contact::{MINIMAX_Q, Start, contact_starts, cross, dot};
use super::piece::{NODES, PLACES, Piece};

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

/// Rounds of the exchange for a start by contact, where one or two are enough, and for a cruder one.
const CONTACT_ROUNDS: usize = 3;
const CRUDE_ROUNDS: usize = 8;

/// A deviation within this factor of the best that the exchange promises is good enough: the cuts
/// lose a sixth of it in length.
const GOOD_ENOUGH: f64 = 1.01;

/// The best of the local minima of the largest deviation that were found.
pub(super) fn minimax(piece: &Piece) -> Fit {
    /// A contact worse than the best by more than this isn't tried: higher terms don't
    /// change a deviation by so much on the pieces that a conversion ends up with.
    const WORTH_TRYING: f64 = 4.0;
    /// Pieces that turn more than this (radians) are too long for the expansion to be trusted alone.
    const LONG: f64 = 1.5;
    let mut best: Option<Fit> = None;
    let mut consider = |fit: Fit| {
        if best.is_none_or(|best| fit.error < best.error) {
            best = Some(fit);
        }
    };
    let mut is_long = true;
    if let Some(series) = &piece.series {
        let starts = contact_starts(series.kappa, piece, MINIMAX_Q);
        let starts = starts.as_slice();
        for start in starts {
            if start.e6.abs() <= WORTH_TRYING * starts[0].e6.abs() {
                consider(refine(piece, *start, CONTACT_ROUNDS));
            }
        }
        is_long = starts.is_empty() || (series.angle(1.0) - series.angle(-1.0)).abs() > LONG;
    }
    if is_long {
        let thirds = Start { arms: [2.0 / 3.0; 2], e6: f64::INFINITY };
        consider(refine(piece, thirds, CRUDE_ROUNDS));
    }
    best.unwrap_or(Fit::none())
}

/// Exchange rounds from one start; the best arms seen.
pub(super) fn refine(piece: &Piece, start: Start, rounds: usize) -> Fit {
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
        if round == rounds {
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

/// Places at which deviations are known: ϑ = π/32 … 31π/32, x = −cos ϑ. The best cubic's lobes are about 5 wide.
const GRID: usize = 31;

/// Values on the grid from those at the nodes: a deviation, or what an arm adds to it, is zero twice at both ends, and
/// (1 − x²)² times the polynomial of degree 6 through the rest. Even and odd parts apart: the weights of the parts at
/// 0, 0.34, 0.6355, 0.9 for x = cos ϑ ≥ 0.
static WEIGHTS: LazyLock<[([f64; 4], [f64; 3]); GRID / 2 + 1]> = LazyLock::new(|| {
    let nodes = [0.0, PLACES[4], PLACES[5], PLACES[6]];
    let end = |x: f64| (1.0 - x * x) * (1.0 - x * x);
    std::array::from_fn(|g| {
        let x = (std::f64::consts::PI * (g + 1) as f64 / (GRID + 1) as f64).cos();
        let x = if g == GRID / 2 { 0.0 } else { x };
        let lagrange = |nodes: &[f64], i: usize| -> f64 {
            let others = nodes.iter().enumerate().filter(|(j, _)| *j != i);
            others.map(|(_, m)| (x * x - m * m) / (nodes[i] * nodes[i] - m * m)).product()
        };
        let even = std::array::from_fn(|i| lagrange(&nodes, i) * end(x) / end(nodes[i]));
        let odd = std::array::from_fn(|i| {
            lagrange(&nodes[1..], i) * x / nodes[i + 1] * end(x) / end(nodes[i + 1])
        });
        (even, odd)
    })
});

fn on_grid(nodes: &[f64; NODES]) -> [f64; GRID] {
    let mut even = [nodes[3], 0.0, 0.0, 0.0];
    let mut odd = [0.0; 3];
    for i in 0..3 {
        even[i + 1] = 0.5 * (nodes[4 + i] + nodes[2 - i]);
        odd[i] = 0.5 * (nodes[4 + i] - nodes[2 - i]);
    }
    let mut values = [0.0; GRID];
    for (g, (for_even, for_odd)) in WEIGHTS.iter().enumerate() {
        let e = (for_even[0] * even[0] + for_even[1] * even[1])
            + (for_even[2] * even[2] + for_even[3] * even[3]);
        let o = for_odd[0] * odd[0] + for_odd[1] * odd[1] + for_odd[2] * odd[2];
        values[GRID - 1 - g] = e + o;
        values[g] = e - o;
    }
    values
}

/// What a value or a slope of 1 at one of the ends adds to that: Hermite's cubic for it, less what [`on_grid`] makes of
/// its values at the nodes. Value and slope at x = −1; those at 1 follow by symmetry.
static END_WEIGHTS: LazyLock<[[f64; GRID]; 2]> = LazyLock::new(|| {
    let hermite: [fn(f64) -> f64; 2] =
        [|x| (1.0 - x) * (1.0 - x) * (2.0 + x) / 4.0, |x| (1.0 - x) * (1.0 - x) * (1.0 + x) / 4.0];
    hermite.map(|hermite| {
        let mut values = on_grid(&PLACES.map(hermite)).map(|v| -v);
        for (g, value) in values.iter_mut().enumerate() {
            *value += hermite(-(std::f64::consts::PI * (g + 1) as f64 / (GRID + 1) as f64).cos());
        }
        values
    })
});

/// The deviation of a cubic from a piece, whose values and slopes at the ends may be other than zero.
fn deviation_on_grid(piece: &Piece, nodes: &[f64; NODES]) -> [f64; GRID] {
    let mut values = on_grid(nodes);
    let Piece { offsets, slopes, .. } = piece;
    if *offsets != [0.0; 2] || *slopes != [0.0; 2] {
        let [by_value, by_slope] = &*END_WEIGHTS;
        for g in 0..GRID {
            let mirrored = GRID - 1 - g;
            values[g] += (offsets[0] * by_value[g] + slopes[0] * by_slope[g])
                + (offsets[1] * by_value[mirrored] - slopes[1] * by_slope[mirrored]);
        }
    }
    values
}

/// Where the deviation is largest, not counting how it comes down from the ends: those are as they are, and
/// a search for the longest piece is to see what its length changes.
fn worst_lobe(values: &[f64; GRID], ends: [f64; 2]) -> Option<usize> {
    let [mut first, mut last] = [0, GRID - 1];
    if ends[0] != 0.0 {
        while first < last && values[first + 1].abs() <= values[first].abs() {
            first += 1;
        }
    }
    if ends[1] != 0.0 {
        while last > first && values[last - 1].abs() <= values[last].abs() {
            last -= 1;
        }
    }
    (first..=last).max_by(|a, b| values[*a].abs().total_cmp(&values[*b].abs()))
}

/// The largest lobe, between points of the grid by a parabola.
fn largest(values: &[f64; GRID], ends: [f64; 2]) -> f64 {
    let Some(top) = worst_lobe(values, ends) else { return 0.0 };
    let (offset, _) = vertex(values, top);
    parabola(values, top, offset).abs().max(values[top].abs())
}

/// Where the parabola through three neighbours has its extremum, in steps from the middle one.
fn vertex(values: &[f64; GRID], at: usize) -> (f64, f64) {
    if at == 0 || at == GRID - 1 {
        return (0.0, 0.0);
    }
    let (slope, bend) = slopes(values, at);
    if bend == 0.0 { (0.0, 0.0) } else { ((-slope / bend).clamp(-0.5, 0.5), bend) }
}

fn slopes(values: &[f64; GRID], at: usize) -> (f64, f64) {
    let (before, after) = (values[at - 1], values[at + 1]);
    ((after - before) / 2.0, after - 2.0 * values[at] + before)
}

fn parabola(values: &[f64; GRID], at: usize, offset: f64) -> f64 {
    if at == 0 || at == GRID - 1 {
        return values[at];
    }
    let (slope, bend) = slopes(values, at);
    values[at] + offset * (slope + offset * bend / 2.0)
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
    /// Each exchange raises the level; on ordinary pieces two or three are enough.
    const MOST_EXCHANGES: usize = 12;
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
        let Some(worst) = worst_lobe(&left, piece.offsets) else { break };
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
