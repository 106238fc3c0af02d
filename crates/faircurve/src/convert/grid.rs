//! A deviation between the places at which it is measured: the polynomial through them, on a grid.

use std::f64::consts::PI;
use std::sync::LazyLock;

use super::piece::{NODES, PLACES, Piece};
use crate::numeric::trig::cis;

/// Places at which deviations are known: ϑ = π/32 … 31π/32, x = −cos ϑ. The best cubic's lobes are about 5 wide.
pub(super) const GRID: usize = 31;

/// x of a point of the grid.
fn place(g: usize) -> f64 {
    if g == GRID / 2 { 0.0 } else { -cis(PI * (g + 1) as f64 / (GRID + 1) as f64).re }
}

/// Half of the grid: places x ≥ 0, the middle first.
const HALF: usize = GRID / 2 + 1;

/// Values on the grid from those at the nodes: a deviation, or what an arm adds to it, is zero twice at both ends, and
/// (1 − x²)² times the polynomial of degree 6 through the rest. Even and odd parts apart: the weights of the parts at
/// 0, 0.34, 0.6355, 0.9, for each place x ≥ 0.
struct Weights {
    even: [[f64; HALF]; 4],
    odd: [[f64; HALF]; 3],
}

static WEIGHTS: LazyLock<Weights> = LazyLock::new(|| {
    let nodes = [0.0, PLACES[4], PLACES[5], PLACES[6]];
    let end = |x: f64| (1.0 - x * x) * (1.0 - x * x);
    let lagrange = |x: f64, nodes: &[f64], i: usize| -> f64 {
        let others = nodes.iter().enumerate().filter(|(j, _)| *j != i);
        let product: f64 =
            others.map(|(_, m)| (x * x - m * m) / (nodes[i] * nodes[i] - m * m)).product();
        product * end(x) / end(nodes[i])
    };
    let places: [f64; HALF] = std::array::from_fn(|g| place(GRID / 2 + g));
    Weights {
        even: std::array::from_fn(|i| places.map(|x| lagrange(x, &nodes, i))),
        odd: std::array::from_fn(|i| {
            places.map(|x| lagrange(x, &nodes[1..], i) * x / nodes[i + 1])
        }),
    }
});

pub(super) fn on_grid(nodes: &[f64; NODES]) -> [f64; GRID] {
    let Weights { even: [w0, w1, w2, w3], odd: [v1, v2, v3] } = &*WEIGHTS;
    let [a3, a2, a1, middle, b1, b2, b3] = *nodes;
    let [even1, even2, even3] = [0.5 * (b1 + a1), 0.5 * (b2 + a2), 0.5 * (b3 + a3)];
    let [odd1, odd2, odd3] = [0.5 * (b1 - a1), 0.5 * (b2 - a2), 0.5 * (b3 - a3)];
    let (mut even, mut odd) = ([0.0; HALF], [0.0; HALF]);
    for g in 0..HALF {
        even[g] = (w0[g] * middle + w1[g] * even1) + (w2[g] * even2 + w3[g] * even3);
        odd[g] = v1[g] * odd1 + v2[g] * odd2 + v3[g] * odd3;
    }
    let mut values = [0.0; GRID];
    for g in 0..HALF {
        values[GRID / 2 + g] = even[g] + odd[g];
        values[GRID / 2 - g] = even[g] - odd[g];
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
            *value += hermite(place(g));
        }
        values
    })
});

/// The deviation of a cubic from a piece, whose values and slopes at the ends may be other than zero.
pub(super) fn deviation_on_grid(piece: &Piece, nodes: &[f64; NODES]) -> [f64; GRID] {
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
pub(super) fn worst_lobe(values: &[f64; GRID], ends: [f64; 2]) -> usize {
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
    let (mut worst, mut most) = (first, -1.0);
    for (i, value) in values[first..last + 1].iter().enumerate() {
        if value.abs() > most {
            (worst, most) = (first + i, value.abs());
        }
    }
    worst
}

/// The largest lobe, between points of the grid by a parabola.
pub(super) fn largest(values: &[f64; GRID], ends: [f64; 2]) -> f64 {
    let top = worst_lobe(values, ends);
    let (offset, _) = vertex(values, top);
    parabola(values, top, offset).abs().max(values[top].abs())
}

/// Where the parabola through three neighbours has its extremum, in steps from the middle one.
pub(super) fn vertex(values: &[f64; GRID], at: usize) -> (f64, f64) {
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

pub(super) fn parabola(values: &[f64; GRID], at: usize, offset: f64) -> f64 {
    if at == 0 || at == GRID - 1 {
        return values[at];
    }
    let (slope, bend) = slopes(values, at);
    values[at] + offset * (slope + offset * bend / 2.0)
}
