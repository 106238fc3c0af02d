//! An upper bound of the distance between a cubic and a piece of a curve: proved, not sampled.
//!
//! **The inequality.** Let z(x), x ∈ [−1, 1], be the piece and B(t), t ∈ [0, 1], the cubic. For every
//! φ that grows from φ(−1) = 0 to φ(1) = 1 the pair z(x), B(φ(x)) runs through both curves at once, so
//! that their Fréchet distance, hence the distance of every point of one from the other, is at most
//!
//! ```text
//! max |e(x)|,   e(x) = B(φ(x)) − z(x).
//! ```
//!
//! φ is the polynomial of degree 8 through the feet of the perpendiculars, or nearly, at nine places; that it grows is
//! proved, below. On a spiral z is a power series to degree 24 with a bound of its tail. Then e is a polynomial of degree 24,
//! and with x = cos ϑ, e = Σ cⱼ cos jϑ, its derivatives by ϑ are at most Dₘ = Σ jᵐ|cⱼ|. On a grid of step δ in ϑ, between
//! neighbours,
//!
//! ```text
//! |e| ≤ max(|eᵢ|, |eᵢ₊₁|) + D₂ δ²/8,
//! ```
//!
//! the error of linear interpolation, and where that isn't sharp enough, by the parabola Q through three neighbours,
//!
//! ```text
//! |e| ≤ max |Q| + D₃ δ³/(9√3),
//! ```
//!
//! where max |Q| is bounded by the first inequality on a grid four times finer. The growth of φ is proved by the first inequality too.
//!
//! High powers of x that hardly matter are left out of all this, and the sum of their sizes is added. Where D₀ = Σ|cⱼ| is as little
//! as is asked for, it is the bound.
//!
//! What is left of the truth is small: δ = π/64 makes the bound of a deviation of degree 6 0.3 % too large, and the part of e along the
//! tangent, which a perfect φ would not have, enters squared; where it exceeds a tenth the piece is halved.
//!
//! **Other shapes** answer only for bounds of |κ|, |κ′| and |κ″|, for the first alone, or for their arc length. There φ is a cubic between the
//! feet at m places, with the slopes at which e′ has no part along the tangent. On each part, of arc length h, z is no farther from the cubic
//! with its ends and end tangents (Hermite's) than h⁴/384 times
//!
//! ```text
//! |z⁗| ≤ |(κ″ − κ³, 3κκ′)|,
//! ```
//!
//! and the polynomial of degree 9 by which B(φ) differs from that cubic is bounded by the first inequality on a grid of eighths.
//! Where the derivatives have no bound or φ wouldn't grow, φ is linear, and |e| ≤ max(|eᵢ|, |eᵢ₊₁|) + min(K·h²/8, ½√(h² − d²)) + max|B″|·φ′²·h²/8
//! with d the part's chord: linear interpolation again, K the segment's bound of its curvature; or, where that is infinite or large, at
//! a cusp, by the ellipse of all points that a curve of length h can reach between its ends.
//!
//! **Rounding** isn't proved but allowed for: [`rounding`].

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::PI;
use std::sync::LazyLock;

use num_complex::Complex64;

use crate::numeric::trig::{cis, unit_vector};
use crate::segment::{Segment, Shape};

use super::contact::dot;
use super::minimax::{Fit, LocalCubic, foot};
use super::piece::{NODES, PAIRS, Piece, Stretch};
use super::series::{Polynomial, Series, TERMS};

/// Steps of the grid: π/64 is where the parabola's remainder falls below the tangential part.
const STEPS: usize = 64;
/// How far apart they are in ϑ.
const STEP: f64 = PI / STEPS as f64;

/// Half of them: the grid is symmetric in x.
const HALF: usize = STEPS / 2;

/// cos(jϑᵢ) for ϑᵢ = iπ/64 in [0, π/2].
static COSINES: LazyLock<[[f64; HALF + 1]; TERMS]> = LazyLock::new(|| {
    let mut table = [[0.0; HALF + 1]; TERMS];
    for (j, row) in table.iter_mut().enumerate() {
        for (i, entry) in row.iter_mut().enumerate() {
            *entry = cis(STEP * (i * j) as f64).re;
        }
    }
    table
});

/// The polynomial of degree 8 through values at ±1, ±[`PAIRS`] and 0: row r gives the coefficient of x²ʳ
/// from the even parts at 0, 0.34, 0.6355, 0.9, 1.
static EVEN: LazyLock<[[f64; 5]; 5]> =
    LazyLock::new(|| lagrange([0.0, PAIRS[2], PAIRS[1], PAIRS[0], 1.0].map(|x| x * x)));

/// Likewise for x²ʳ⁺¹, from the odd parts over x.
static ODD: LazyLock<[[f64; 4]; 4]> =
    LazyLock::new(|| lagrange([PAIRS[2], PAIRS[1], PAIRS[0], 1.0].map(|x| x * x)));

/// Coefficients of Lagrange's polynomials: column j is the one that is 1 at node j and 0 at the others.
fn lagrange<const N: usize>(nodes: [f64; N]) -> [[f64; N]; N] {
    let mut table = [[0.0; N]; N];
    for j in 0..N {
        let mut product = [0.0; N];
        product[0] = 1.0;
        for (m, node) in nodes.into_iter().enumerate() {
            if m != j {
                for r in (0..N).rev() {
                    let lower = if r > 0 { product[r - 1] } else { 0.0 };
                    product[r] = (lower - node * product[r]) / (nodes[j] - node);
                }
            }
        }
        for r in 0..N {
            table[r][j] = product[r];
        }
    }
    table
}

/// How deep a piece is halved for a sharper bound.
const MOST_HALVINGS: u32 = 7;

/// How sharp a bound need be; lengths in user units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sharpness {
    /// The cubic is too far off to be worth a sharp bound.
    pub(super) is_hopeless: bool,
    /// Nor need one be sharp that can't be as small as this,
    pub(super) limit: f64,
    /// or that is within this.
    pub(super) enough: f64,
}

/// A bound of the distance between the cubic of these arms and its piece of the stretch, in user units;
/// infinite where the cubic doesn't run along the piece.
pub(super) fn distance_bound(
    stretch: &Stretch<'_>,
    piece: &Piece,
    fit: &Fit,
    sharpness: Sharpness,
) -> f64 {
    if !fit.error.is_finite() {
        return f64::INFINITY;
    }
    let halvings = if sharpness.is_hopeless { 1 } else { MOST_HALVINGS };
    let enough = sharpness.enough / piece.half;
    let bound = match &piece.series {
        Some(series) => {
            let cubic = LocalCubic::with_arms(piece, fit.arms);
            bound_on_series(series, &cubic, [0.0, 1.0], fit.params, enough, halvings)
        }
        None => {
            let cubic = LocalCubic::with_arms(piece, fit.arms);
            bound_over_segments(stretch, piece, &cubic, sharpness.limit / piece.half)
        }
    };
    bound * piece.half + rounding(stretch, piece)
}

/// What rounding can add to a deviation: of the curve's own points, of arc length along the stretch,
/// and of the polynomials here.
pub(super) fn rounding(stretch: &Stretch<'_>, piece: &Piece) -> f64 {
    let of_segments = rounding_of(&stretch.segments()[stretch.span(piece.from, piece.to)]);
    of_segments + f64::EPSILON * (8.0 * piece.to + 64.0 * piece.half)
}

/// What rounding can add wherever these segments take part.
pub(super) fn rounding_of(segments: &[Segment]) -> f64 {
    segments.iter().map(Segment::rounding).fold(0.0, f64::max)
}

/// Half-length units. `ends`: parameters of the cubic at x = ∓1; `params`: at the nodes inside; `enough`: a bound so small
/// need not be sharp.
fn bound_on_series(
    series: &Series,
    cubic: &LocalCubic,
    ends: [f64; 2],
    params: [f64; NODES],
    enough: f64,
    halvings: u32,
) -> f64 {
    let phi = substitution(ends, params);
    let check = if grows(&phi) {
        let e = difference(series, cubic, &phi);
        grid_bound(series, &e, enough)
    } else {
        GridBound { bound: f64::INFINITY, is_sharp: false }
    };
    if check.is_sharp || halvings == 0 {
        return check.bound + series.tail;
    }
    let middle = foot(cubic, Complex64::ZERO, Complex64::new(1.0, 0.0), params[NODES / 2]);
    let halves = [(-0.5, [ends[0], middle]), (0.5, [middle, ends[1]])].map(|(x, ends)| {
        let half = half_of(series, x);
        // The cubic in the frame of the half: its middle the origin, its half length the unit.
        let turn = cis(-series.angle(x)) * 2.0;
        let origin = series.z.pair(x)[0];
        let mut local = cubic.0;
        local[0] -= origin;
        let local = LocalCubic(local.map(|c| c * turn));
        let (places, tangents) = nodes_of(&half);
        let params = std::array::from_fn(|i| {
            let along = 0.5 + 0.5 * super::piece::PLACES[i];
            let guess = ends[0] + along * (ends[1] - ends[0]);
            foot(&local, places[i], tangents[i], guess)
        });
        bound_on_series(&half, &local, ends, params, 2.0 * enough, halvings - 1) / 2.0
    });
    (halves[0].max(halves[1]) + 2.0 * series.tail).min(check.bound + series.tail)
}

/// The half of a piece about x = ∓½.
fn half_of(series: &Series, x: f64) -> Series {
    let [c0, c1, c2, c3] = series.kappa;
    // Eq. 8.3 for half the width: the curvature about x, and half the unit.
    Series::of_curvature([
        (c0 + x * (c1 + x * (c2 + x * c3))) / 2.0,
        (c1 + x * (2.0 * c2 + x * 3.0 * c3)) / 4.0,
        (c2 + 3.0 * x * c3) / 8.0,
        c3 / 16.0,
    ])
}

fn nodes_of(series: &Series) -> ([Complex64; NODES], [Complex64; NODES]) {
    let piece = Piece::of_series(0.0, 2.0, *series);
    (piece.places, piece.tangents)
}

/// φ: coefficients by powers of x.
fn substitution(ends: [f64; 2], params: [f64; NODES]) -> [f64; 9] {
    let pairs = [(2, 4), (1, 5), (0, 6)].map(|(low, high)| [params[low], params[high]]);
    let mut even = [params[3], 0.0, 0.0, 0.0, (ends[0] + ends[1]) / 2.0];
    let mut odd = [0.0, 0.0, 0.0, (ends[1] - ends[0]) / 2.0];
    for (i, [low, high]) in pairs.into_iter().enumerate() {
        even[i + 1] = (low + high) / 2.0;
        odd[i] = (high - low) / 2.0 / PAIRS[2 - i];
    }
    let mut phi = [0.0; 9];
    for (r, row) in EVEN.iter().enumerate() {
        phi[2 * r] = row.iter().zip(even).map(|(l, v)| l * v).sum();
    }
    for (r, row) in ODD.iter().enumerate() {
        phi[2 * r + 1] = row.iter().zip(odd).map(|(l, v)| l * v).sum();
    }
    phi
}

/// Whether φ′ > 0 on [−1, 1], by the first inequality on every fourth point of the grid.
fn grows(phi: &[f64; 9]) -> bool {
    const STRIDE: usize = 4;
    let mut slope = [0.0; 8];
    for (n, c) in slope.iter_mut().enumerate() {
        *c = phi[n + 1] * (n + 1) as f64;
    }
    let slope = to_chebyshev(&slope);
    let step = STEP * STRIDE as f64;
    let d2: f64 = slope.iter().enumerate().map(|(j, c)| (j * j) as f64 * c.abs()).sum();
    let cosines = &*COSINES;
    let mut lowest = f64::INFINITY;
    for i in (0..=HALF).step_by(STRIDE) {
        let (mut even, mut odd) = (0.0, 0.0);
        for j in (0..8).step_by(2) {
            even += slope[j] * cosines[j][i];
            odd += slope[j + 1] * cosines[j + 1][i];
        }
        lowest = lowest.min(even - odd.abs());
    }
    lowest > d2 * step * step / 8.0
}

/// B(φ(x)) − z(x).
fn difference(series: &Series, cubic: &LocalCubic, phi: &[f64; 9]) -> Polynomial {
    let mut second = [0.0; 17];
    for (i, a) in phi.iter().enumerate() {
        for (j, b) in phi.iter().enumerate() {
            second[i + j] += a * b;
        }
    }
    let mut third = [0.0; TERMS];
    for (i, a) in phi.iter().enumerate() {
        for (j, b) in second.iter().enumerate() {
            third[i + j] += a * b;
        }
    }
    let [b0, b1, b2, b3] = cubic.0;
    let mut e = Polynomial::ZERO;
    for n in 0..TERMS {
        e.re[n] = b3.re * third[n] - series.z.re[n];
        e.im[n] = b3.im * third[n] - series.z.im[n];
    }
    for n in 0..17 {
        e.re[n] += b2.re * second[n];
        e.im[n] += b2.im * second[n];
    }
    for n in 0..9 {
        e.re[n] += b1.re * phi[n];
        e.im[n] += b1.im * phi[n];
    }
    e.re[0] += b0.re;
    e.im[0] += b0.im;
    e
}

/// From powers of x to Chebyshev's polynomials, by Horner's rule: x·T₀ = T₁, x·Tⱼ = (Tⱼ₋₁ + Tⱼ₊₁)/2.
fn to_chebyshev(powers: &[f64]) -> [f64; TERMS] {
    let mut c = [0.0; TERMS];
    for (degree, power) in powers.iter().rev().enumerate() {
        // Twice the coefficient below, as it was: T₀ counts double.
        let mut below = 2.0 * c[0];
        c[0] = power + 0.5 * c[1];
        for j in 1..=degree {
            let above = if j < degree { c[j + 1] } else { 0.0 };
            (below, c[j]) = (c[j], 0.5 * (below + above));
        }
    }
    c
}

struct GridBound {
    bound: f64,
    /// Whether it is as sharp as it need be: enough, or near the truth, as the part of e along the tangent is small where |e| is
    /// largest.
    is_sharp: bool,
}

/// The bound of |e| by its Chebyshev coefficients.
fn grid_bound(series: &Series, e: &Polynomial, enough: f64) -> GridBound {
    let Leading { terms, dropped } = Leading::of(e, enough);
    let (re, im) = (to_chebyshev(&e.re[..terms]), to_chebyshev(&e.im[..terms]));
    let (mut d0, mut d2, mut d3) = (0.0, 0.0, 0.0);
    for j in 0..terms {
        let size = (re[j] * re[j] + im[j] * im[j]).sqrt();
        let j = j as f64;
        d0 += size;
        d2 += j * j * size;
        d3 += j * j * j * size;
    }
    if d0 + dropped <= enough {
        return GridBound { bound: d0 + dropped, is_sharp: true };
    }
    // Values at ϑᵢ, i = 0 … 64.
    let mut even = [[0.0; HALF + 1]; 2];
    let mut odd = [[0.0; HALF + 1]; 2];
    for (j, cosines) in COSINES.iter().enumerate().take(terms) {
        let sums = if j % 2 == 0 { &mut even } else { &mut odd };
        for i in 0..=HALF {
            sums[0][i] += re[j] * cosines[i];
            sums[1][i] += im[j] * cosines[i];
        }
    }
    let mut values = [Complex64::ZERO; STEPS + 1];
    for i in 0..=HALF {
        let even = Complex64::new(even[0][i], even[1][i]);
        let odd = Complex64::new(odd[0][i], odd[1][i]);
        values[i] = even + odd;
        values[STEPS - i] = even - odd;
    }
    let mut squares = [0.0; STEPS + 1];
    for i in 0..=STEPS {
        squares[i] = values[i].norm_sqr();
    }
    let (mut top, mut largest) = (0, 0.0);
    for (i, square) in squares.into_iter().enumerate() {
        if square > largest {
            (top, largest) = (i, square);
        }
    }
    let largest = largest.sqrt();
    let linear = d2 * STEP * STEP / 8.0;
    // 1/(9√3): the largest |u(u² − 1)|/6.
    let parabolic = d3 * STEP * STEP * STEP * 0.064_150_03;
    let mut bound = largest;
    // Squares that the first inequality settles.
    let harmless = (largest - linear).max(0.0).powi(2);
    for i in 0..STEPS {
        if squares[i].max(squares[i + 1]) <= harmless {
            continue;
        }
        // The parabola about the larger of the two; at the ends about their neighbour.
        let centre = if squares[i] > squares[i + 1] { i } else { i + 1 }.clamp(1, STEPS - 1);
        let [before, here, after] = [values[centre - 1], values[centre], values[centre + 1]];
        let (slope, bend) = ((after - before) / 2.0, after - here * 2.0 + before);
        let from = i as f64 - centre as f64;
        let mut most = 0.0f64;
        for part in 0..=4 {
            let u = from + f64::from(part) / 4.0;
            most = most.max((here + slope * u + bend * (u * u / 2.0)).norm_sqr());
        }
        let refined = most.sqrt() + bend.norm() / 128.0 + parabolic;
        let simple = squares[i].max(squares[i + 1]).sqrt() + linear;
        bound = bound.max(refined.min(simple));
    }
    let x = cis(top as f64 * STEP).re;
    let tangent = cis(series.angle(x));
    let along = dot(values[top], tangent);
    // A tenth makes the bound half a percent too large. `!` so that NaN isn't sharp.
    let is_sharp = along.abs() <= 0.1 * largest || largest < 1e-15;
    if bound.is_nan() {
        return GridBound { bound: f64::INFINITY, is_sharp: false };
    }
    GridBound { bound: bound + dropped, is_sharp }
}

/// The coefficients of a difference that matter: of a piece that turns little, less than half of them.
struct Leading {
    terms: usize,
    /// What the others add up to at most.
    dropped: f64,
}

impl Leading {
    fn of(e: &Polynomial, enough: f64) -> Self {
        /// In parts of the largest coefficient, which is some twenty times the difference itself.
        const OF_LARGEST: f64 = 1e-6;
        const OF_ENOUGH: f64 = 1e-3;
        let size = |n: usize| e.re[n].abs() + e.im[n].abs();
        let most =
            (0..TERMS).map(size).fold(OF_ENOUGH * enough, |most, s| most.max(OF_LARGEST * s));
        let (mut terms, mut dropped) = (TERMS, 0.0);
        while terms > 0 && dropped + size(terms - 1) <= most {
            terms -= 1;
            dropped += size(terms);
        }
        Leading { terms, dropped }
    }
}

/// The bound that a piece of one segment would have if that answered only for the size of its curvature.
#[cfg(test)]
pub(super) fn bound_by_curvature_of(stretch: &Stretch<'_>, piece: &Piece, fit: &Fit) -> f64 {
    let cubic = LocalCubic::with_arms(piece, fit.arms);
    let part = Part {
        segment: &stretch.segments()[0],
        from: piece.from,
        to: piece.to,
        params: [0.0, 1.0],
    };
    let origin = stretch.joint(piece.from).point;
    bound_by_curvature(&part, &cubic, origin, piece.half, f64::INFINITY) * piece.half
        + rounding(stretch, piece)
}

/// A piece over several segments, or on one that isn't a spiral: each part by itself, the feet at the
/// knots being shared.
#[inline(never)] // rare: not for engines of the web to compile with the rest
fn bound_over_segments(
    stretch: &Stretch<'_>,
    piece: &Piece,
    cubic: &LocalCubic,
    limit: f64,
) -> f64 {
    let mut bound = 0.0f64;
    let origin = stretch.joint(piece.from).point;
    let mut start = 0.0;
    let span = stretch.span(piece.from, piece.to);
    let last = *span.end();
    for index in span {
        let (segment, offset) = (&stretch.segments()[index], stretch.start_of(index));
        let from = (piece.from - offset).max(0.0);
        let to = (piece.to - offset).min(segment.length());
        if !(to > from) {
            continue;
        }
        let end = if index == last {
            1.0
        } else {
            let (point, tangent) = in_frame(segment, to, origin, piece.half);
            let along = (offset + to - piece.from) / (2.0 * piece.half);
            foot(cubic, point, tangent, along)
        };
        if !(end > start) {
            return f64::INFINITY;
        }
        let part = Part { segment, from, to, params: [start, end] };
        bound = bound.max(match segment.shape() {
            Shape::Spiral(spiral) => {
                let middle = (from + to) / 2.0;
                let width = (to - from) / segment.length();
                let series = Series::new(spiral.k, middle / segment.length() - 0.5, width);
                let unit = (to - from) / 2.0;
                let turn = unit_vector(-segment.direction(middle)) * (piece.half / unit);
                let (centre, _) = in_frame(segment, middle, origin, piece.half);
                let mut local = cubic.0;
                local[0] -= centre;
                let local = LocalCubic(local.map(|c| c * turn));
                let (places, tangents) = nodes_of(&series);
                let params = std::array::from_fn(|i| {
                    let along = 0.5 + 0.5 * super::piece::PLACES[i];
                    foot(&local, places[i], tangents[i], start + along * (end - start))
                });
                bound_on_series(&series, &local, [start, end], params, 0.0, MOST_HALVINGS) * unit
                    / piece.half
            }
            _ => bound_by_curvature(&part, cubic, origin, piece.half, limit),
        });
        start = end;
    }
    bound
}

/// A place on a segment in the frame of a piece.
fn in_frame(segment: &Segment, s: f64, origin: kurbo::Point, half: f64) -> (Complex64, Complex64) {
    let off = (segment.point(s) - origin) / half;
    (Complex64::new(off.x, off.y), unit_vector(segment.direction(s)))
}

/// Part of a segment beside part of a cubic.
struct Part<'a> {
    segment: &'a Segment,
    from: f64,
    to: f64,
    params: [f64; 2],
}

/// The bound for segments that answer only for the size of their curvature, in half lengths of the piece.
fn bound_by_curvature(
    part: &Part<'_>,
    cubic: &LocalCubic,
    origin: kurbo::Point,
    half: f64,
    limit: f64,
) -> f64 {
    /// Parts are halved where what interpolation adds exceeds this share of the largest difference;
    /// the bound is that much too large.
    const SHARP: f64 = 0.005;
    /// The same where the bound is within the limit already: ten times that takes a third of the parts.
    const SHARP_ENOUGH: f64 = 0.05;
    /// At most so many parts: 4096 of them resolve a deviation of 1e-7 of the piece.
    const MOST_PARTS: usize = 4096;
    /// With so many the bound is fair where the limit can't be met.
    const FEW_PARTS: usize = 64;
    let Part { segment, from, to, params } = *part;
    let off = |place: &Place| (cubic.at(place.param) - place.point).norm();
    let place = |s: f64, param: f64| {
        let off = (segment.point(s) - origin) / half;
        Place { s, point: Complex64::new(off.x, off.y), direction: segment.direction(s), param }
    };
    let at = |s: f64, guess: f64, limits: [f64; 2]| {
        let here = place(s, guess);
        let tangent = unit_vector(here.direction);
        let param = foot(cubic, here.point, tangent, guess).clamp(limits[0], limits[1]);
        Place { param, ..here }
    };
    let bounded = |ends: [Place; 2]| {
        let [Place { s: from, param: t0, .. }, Place { s: to, param: t1, .. }] = ends;
        let (h, width) = ((to - from) / half, t1 - t0);
        let [curvature, first, second] = segment.curvature_bounds(from, to);
        let bounds = [curvature * half, first * half.powi(2), second * half.powi(3)];
        let hermite = from_hermite(h, bounds);
        if hermite < 1.0
            && let Some([least, most]) = largest_from_hermite(cubic, &ends, h)
        {
            return Bounded { least: least - hermite, bound: most + hermite, ends };
        }
        let bend = cubic.acceleration(t0).norm().max(cubic.acceleration(t1).norm());
        // Where curvature has no bound, as beside a cusp: a part of length h over a chord d is nowhere
        // farther than ½√(h² − d²) from the point that divides the chord as it divides the part.
        let d = (ends[1].point - ends[0].point).norm().min(h);
        let in_ellipse = ((h - d) * (h + d) + 4.0 * f64::EPSILON * h * h).sqrt() / 2.0;
        let slack = (curvature * half * h * h / 8.0).min(in_ellipse) + bend * width * width / 8.0;
        let least = off(&ends[0]).max(off(&ends[1]));
        Bounded { least, bound: least + slack, ends }
    };
    let ends = [place(from, params[0]), place(to, params[1])];
    let whole = bounded(ends);
    // What the deviation is somewhere.
    let mut largest = whole.least;
    // The part with the largest bound first: when that is sharp, it is the answer.
    let mut heap = BinaryHeap::from([whole]);
    for parts in 1.. {
        let Some(top) = heap.pop() else { break };
        let Bounded { bound, ends: [start, end], .. } = top;
        let slack = bound - largest;
        // Slack falls with the square of a part's length: so many like this one would get below the limit.
        let needed = (slack / (limit - largest)).sqrt() * (to - from) / (end.s - start.s);
        if parts > FEW_PARTS && (largest > limit || needed > MOST_PARTS as f64) {
            return bound;
        }
        // Rounding: below 1e-14 nothing gets sharper. `!` so that NaN ends here, too.
        let sharp = if limit.is_finite() && bound <= limit { SHARP_ENOUGH } else { SHARP };
        if !(slack > sharp * largest) || slack < 1e-14 || parts >= MOST_PARTS || bound.is_nan() {
            return if bound.is_nan() { f64::INFINITY } else { bound };
        }
        let params = [start.param, end.param];
        let middle = at((start.s + end.s) / 2.0, (params[0] + params[1]) / 2.0, params);
        for part in [[start, middle], [middle, end]] {
            let part = bounded(part);
            largest = largest.max(part.least);
            heap.push(part);
        }
    }
    f64::INFINITY
}

/// Part of the work of [`bound_by_curvature`], ordered by its bound.
struct Bounded {
    /// What the largest deviation on the part is at least, or nearly.
    least: f64,
    /// And at most.
    bound: f64,
    ends: [Place; 2],
}

/// How far a part of length h with these bounds of |κ|, |κ′| and |κ″| is at most from the cubic with its ends and end
/// tangents.
fn from_hermite(h: f64, [k, first, second]: [f64; 3]) -> f64 {
    (second + k * k * k).hypot(3.0 * k * first) * h.powi(4) / 384.0
}

/// How far a cubic is from the cubic with the ends and end tangents of a part of length h: by about how much at
/// least, and at most. `None` where the substitution would not grow.
fn largest_from_hermite(cubic: &LocalCubic, ends: &[Place; 2], h: f64) -> Option<[f64; 2]> {
    const STEPS: u32 = 8;
    let [start, end] = ends;
    let width = end.param - start.param;
    let tangents = [start, end].map(|place| unit_vector(place.direction));
    let [d0, d1] = [0, 1].map(|i| h / dot(cubic.velocity(ends[i].param), tangents[i]));
    // A cubic with such slopes grows (Fritsch and Carlson 1980).
    let may_be = 0.0..=3.0 * width;
    if !(may_be.contains(&d0) && may_be.contains(&d1)) {
        return None;
    }
    // φ less its start, and its powers, by powers of u from 1, 2 and 3 on.
    let phi = [d0, 3.0 * width - 2.0 * d0 - d1, d0 + d1 - 2.0 * width];
    let mut q = [Complex64::ZERO; 10];
    let t = start.param;
    let by_power = [cubic.velocity(t), cubic.acceleration(t) / 2.0, cubic.0[3]];
    for (i, a) in phi.iter().enumerate() {
        q[i + 1] += by_power[0] * a;
        for (j, b) in phi.iter().enumerate() {
            q[i + j + 2] += by_power[1] * (a * b);
            for (k, c) in phi.iter().enumerate() {
                q[i + j + k + 3] += by_power[2] * (a * b * c);
            }
        }
    }
    let chord = end.point - start.point;
    let [s0, s1] = tangents.map(|tangent| tangent * h);
    q[0] = cubic.at(t) - start.point;
    q[1] -= s0;
    q[2] -= chord * 3.0 - s0 * 2.0 - s1;
    q[3] -= s0 + s1 - chord * 2.0;
    let turn = end.direction - start.direction;
    let (mut least, mut largest) = (0.0f64, 0.0f64);
    for step in 0..=STEPS {
        let u = f64::from(step) / f64::from(STEPS);
        let off = q.iter().rev().fold(Complex64::ZERO, |sum, c| sum * u + c);
        let normal = unit_vector(start.direction + turn * u) * Complex64::I;
        least = least.max(dot(off, normal).abs());
        largest = largest.max(off.norm_sqr());
    }
    let bend: f64 = q.iter().enumerate().map(|(j, c)| (j * j - j) as f64 * c.norm()).sum();
    let largest = largest.sqrt() + bend / 8.0 / f64::from(STEPS * STEPS);
    largest.is_finite().then_some([least, largest])
}

/// A place on a segment and the parameter of the cubic's point beside it.
#[derive(Clone, Copy)]
struct Place {
    s: f64,
    point: Complex64,
    direction: f64,
    param: f64,
}

impl Ord for Bounded {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

impl PartialOrd for Bounded {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Bounded {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Bounded {}
