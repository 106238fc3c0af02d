//! Starts for a segment much longer than its neighbours: these hardly notice it, so that what they do
//! alone, with free ends, says what it must join.

use faircurve::numeric::spiro_integral::spiro_moments;
use std::f64::consts::TAU;

use super::chain::{Chain, State};
use crate::residual::turning_of;

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
        if !(part.newton(&mut alone, 1.0, 30) < 1e-9) {
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
            let theta0 = chain.turns[segment] - left[0];
            let theta1 = chain.turns[next] + right[0];
            let curvature =
                [left[1] * chord / chain.chords[before], right[1] * chord / chain.chords[after]];
            let mut ways = Vec::new();
            for a in -MOST_TURNS..=MOST_TURNS {
                for b in -MOST_TURNS..=MOST_TURNS {
                    let angles = [theta0 + TAU * f64::from(a), theta1 + TAU * f64::from(b)];
                    lay(angles, curvature, &mut ways);
                }
            }
            ways.sort_by(|a, b| turning_of(*a).total_cmp(&turning_of(*b)));
            Some(Bridge { segment, ways })
        })
        .collect();
    Some((state, bridges))
}

/// Adds the segments of chord 1 with these end angles and curvatures. By decision 2, k₀ … k₃ follow
/// from log c and ψ, which Newton's method finds from the points of a grid.
fn lay(theta: [f64; 2], curvature: [f64; 2], ways: &mut Vec<[f64; 4]>) {
    const STRAIGHTNESSES: [f64; 9] = [0.95, 0.8, 0.6, 0.4, 0.25, 0.12, 0.06, 0.02, 0.005];
    const DIRECTIONS: usize = 12;
    const STEPS: usize = 20;
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
