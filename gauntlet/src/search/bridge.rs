//! Starts for a segment much longer than its neighbours: these hardly notice it, so that what they do
//! alone, with free ends, says what it must join.

use faircurve::numeric::spiro_integral::{spiro_moments, wildness};
use std::f64::consts::TAU;

use super::chain::{Chain, State};
use crate::generate::Random;
use crate::residual::turning_of;

/// A part is solved below this.
const SETTLED: f64 = 1e-9;

/// Whole turns that are tried at either end, to either side.
const MOST_TURNS: i32 = 2;

/// A long segment and the ways to lay it.
#[derive(Clone, Debug)]
pub(super) struct Bridge {
    pub(super) segment: usize,
    /// k₀ … k₃, the least turning first.
    pub(super) ways: Vec<[f64; 4]>,
}

/// The chains between the segments that are at least `ratio` times as long as both neighbours,
/// solved alone, and the ways to lay the long ones. `None` if there are none or a chain doesn't
/// settle.
pub(super) fn bridges(chain: &Chain, ratio: f64) -> Option<(State, Vec<Bridge>)> {
    let m = chain.segments();
    let beside = |segment: usize| {
        let next = (segment + 1) % chain.knots();
        (chain.around(segment).0, chain.around(next).1)
    };
    let is_long = |segment: usize| match beside(segment) {
        (Some(a), Some(b)) if a != segment => {
            chain.chords[segment] > ratio * chain.chords[a].max(chain.chords[b])
        }
        _ => false,
    };
    let long: Vec<usize> = (0..m).filter(|&segment| is_long(segment)).collect();
    if long.is_empty() {
        return None;
    }
    let mut state = chain.straight();
    // Each stretch that follows a long segment, and in an open run the one before the first.
    let open_start = (!chain.closed).then_some(0);
    for from in open_start.into_iter().chain(long.iter().map(|segment| (segment + 1) % m)) {
        let count = (0..m).take_while(|i| {
            let at = from + i;
            (chain.closed || at < m) && !long.contains(&(at % m))
        });
        let count = count.count();
        let part = chain.part(from, count, None);
        let mut alone = part.straight();
        if !(part.newton(&mut alone, 1.0, 30) < SETTLED) {
            return None;
        }
        for (i, k) in alone.k.into_iter().enumerate() {
            state.k[(from + i) % m] = k;
        }
    }
    let bridges = long
        .into_iter()
        .filter_map(|segment| {
            let (before, after) = beside(segment);
            let (before, after) = (before?, after?);
            let next = (segment + 1) % chain.knots();
            let (left, right) =
                (Chain::end_jets(state.k[before])[1], Chain::end_jets(state.k[after])[0]);
            let chord = chain.chords[segment];
            // θ₀ and θ₁ of decision 3.
            let theta = [chain.turns[segment] - left[0], chain.turns[next] + right[0]];
            let curvature =
                [left[1] * chord / chain.chords[before], right[1] * chord / chain.chords[after]];
            Some(Bridge { segment, ways: ways(theta, curvature) })
        })
        .collect();
    Some((state, bridges))
}

/// Solves a chain by dividing it at its longest segment: both sides alone, by the same rule, then the
/// longest between them, then all from there. Which of its ways it takes is drawn, the ones that turn
/// little before the others. `None` where something doesn't settle.
pub(super) fn divided(chain: &Chain, random: &mut Random) -> Option<State> {
    /// Ways tried.
    const TRIES: usize = 4;
    let (m, n) = (chain.segments(), chain.knots());
    let settles = |mut state: State| {
        let residual = chain.newton(&mut state, 1.0, 40);
        (residual < SETTLED).then_some(state)
    };
    if random.below(8) > 0
        && let Some(state) = settles(chain.straight())
    {
        return Some(state);
    }
    let longest = (0..m).max_by(|&a, &b| chain.chords[a].total_cmp(&chain.chords[b]))?;
    let sides = if chain.closed {
        [(longest + 1, m - 1), (0, 0)]
    } else {
        [(0, longest), (longest + 1, m - 1 - longest)]
    };
    let mut base = chain.straight();
    for (from, count) in sides.into_iter().filter(|(_, count)| *count > 0) {
        let alone = divided(&chain.part(from % n, count, None), random)?;
        (0..count).for_each(|i| base.k[(from + i) % m] = alone.k[i]);
        (1..count).for_each(|i| base.windings[(from + i) % n] = alone.windings[i]);
    }
    let next = (longest + 1) % n;
    let chord = chain.chords[longest];
    let ways = match (chain.around(longest).0, chain.around(next).1) {
        (Some(before), Some(after)) => {
            let left = Chain::end_jets(base.k[before])[1];
            let right = Chain::end_jets(base.k[after])[0];
            let theta = [chain.turns[longest] - left[0], chain.turns[next] + right[0]];
            let curvature =
                [left[1] * chord / chain.chords[before], right[1] * chord / chain.chords[after]];
            ways(theta, curvature)
        }
        _ => dangling(&chain.part(longest, 1, Some(&base)), random),
    };
    for _ in 0..TRIES.min(ways.len()) {
        // Drawn thrice, so that the first ways come most.
        let way = (0..3).fold(ways.len(), |most, _| 1 + random.below(most)) - 1;
        let mut state = base.clone();
        state.k[longest] = ways[way];
        chain.wind(&mut state);
        for clamp in [0.3, 1.0] {
            let mut polished = state.clone();
            if chain.newton(&mut polished, clamp, 60) < SETTLED {
                return Some(polished);
            }
        }
    }
    None
}

/// Ways to lay a segment of which only one end is held, from random starts.
fn dangling(alone: &Chain, random: &mut Random) -> Vec<[f64; 4]> {
    const STARTS: usize = 60;
    let mut ways: Vec<[f64; 4]> = Vec::new();
    for _ in 0..STARTS {
        let mut state = alone.straight();
        let size = 10f64.powf(random.between(-1.0, 1.5));
        state.k[0] = [1.0, 4.0, 24.0, 192.0].map(|unit| size * unit * random.between(-1.0, 1.0));
        state.windings.fill_with(|| random.below(5) as i32 - 2);
        let is_new = |k: &[f64; 4]| ways.iter().all(|way| (way[0] - k[0]).abs() > 1e-6);
        if alone.newton(&mut state, 1.0, 40) < SETTLED && is_new(&state.k[0]) {
            ways.push(state.k[0]);
        }
    }
    ways.sort_by(|a, b| turning_of(*a).total_cmp(&turning_of(*b)));
    ways
}

/// Every way found to lay a segment of chord 1 with these end angles, to whole turns, and end
/// curvatures; the least turning first.
fn ways(theta: [f64; 2], curvature: [f64; 2]) -> Vec<[f64; 4]> {
    let mut ways = Vec::new();
    for a in -MOST_TURNS..=MOST_TURNS {
        for b in -MOST_TURNS..=MOST_TURNS {
            lay(
                [theta[0] + TAU * f64::from(a), theta[1] + TAU * f64::from(b)],
                curvature,
                &mut ways,
            );
        }
    }
    ways.sort_by(|a, b| turning_of(*a).total_cmp(&turning_of(*b)));
    ways
}

/// Adds the segments of chord 1 with these end angles and curvatures. By decision 2, k₀ … k₃ follow
/// from log c and ψ, which Newton's method finds from the points of a grid.
fn lay(theta: [f64; 2], curvature: [f64; 2], ways: &mut Vec<[f64; 4]>) {
    const STRAIGHTNESSES: [f64; 9] = [0.95, 0.8, 0.6, 0.4, 0.25, 0.12, 0.06, 0.02, 0.005];
    const DIRECTIONS: usize = 12;
    const STEPS: usize = 20;
    /// Segments that curve more aren't worth integrating.
    const WILDEST: f64 = 3e3;
    let (t, d) = (theta[0] + theta[1], theta[1] - theta[0]);
    let (s, f) = (curvature[0] + curvature[1], curvature[1] - curvature[0]);
    let parameters = |log_c: f64, psi: f64| {
        let c = log_c.exp();
        let (a, b, e) = (s / (2.0 * c), f / c, d + 2.0 * psi);
        ([(3.0 * t - a) / 2.0, 8.0 * e - b, 12.0 * (a - t), 48.0 * (b - 4.0 * e)], a, b)
    };
    for c in STRAIGHTNESSES {
        for direction in 0..DIRECTIONS {
            let mut log_c = c.ln();
            let mut psi = TAU * (direction as f64 / DIRECTIONS as f64 - 0.5);
            for _ in 0..STEPS {
                let (k, a, b) = parameters(log_c, psi);
                if wildness(k) > WILDEST {
                    break;
                }
                let moments = spiro_moments(k);
                let chord = moments.integral();
                let off =
                    (chord.norm().ln() - log_c, faircurve::frame::wrap_angle(chord.arg() - psi));
                if off.0.abs().max(off.1.abs()) < 1e-12 {
                    let same = |other: &[f64; 4]| {
                        (0..4).all(|j| (other[j] - k[j]).abs() < 1e-6 * (1.0 + k[j].abs()))
                    };
                    if !ways.iter().any(same) {
                        ways.push(k);
                    }
                    break;
                }
                let g: [_; 4] = std::array::from_fn(|j| moments.derivative(j) / chord);
                let by_log_c = g[0] * (a / 2.0) + g[1] * b - g[2] * (12.0 * a) - g[3] * (48.0 * b);
                let by_psi = g[1] * 16.0 - g[3] * 384.0;
                let (m00, m01) = (by_log_c.re - 1.0, by_psi.re);
                let (m10, m11) = (by_log_c.im, by_psi.im - 1.0);
                let determinant = m00 * m11 - m01 * m10;
                let limited = |x: f64| x.clamp(-0.7, 0.7);
                log_c -= limited((off.0 * m11 - off.1 * m01) / determinant);
                psi -= limited((m00 * off.1 - m10 * off.0) / determinant);
                if !log_c.is_finite() || !psi.is_finite() || !(-7.0..0.1).contains(&log_c) {
                    break;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_are_laid_between_any_ends() {
        for k in [[1.0, -2.0, 3.0, -4.0], [4.0, 20.0, -90.0, 300.0], [-3.0, 0.0, 150.0, -900.0]] {
            let [start, end] = Chain::end_jets(k);
            let mut ways = Vec::new();
            lay([-start[0], end[0]], [start[1], end[1]], &mut ways);
            let is_known = |way: &[f64; 4]| (0..4).all(|j| (way[j] - k[j]).abs() < 1e-6);
            assert!(ways.iter().any(is_known), "{k:?}: {ways:?}");
        }
    }
}
