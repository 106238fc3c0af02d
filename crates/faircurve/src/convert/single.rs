//! One cubic for one piece, other than by the largest distance (thesis sections 9.3 to 9.5).

use super::contact::{Start, contact_starts, expansions, meet_end_curvatures};
use super::metric::{angle_error, arc_length};
use super::minimax::{Fit, LocalCubic, first_params, measure};
use super::options::Metric;
use super::piece::{Piece, Stretch};
use super::tuning::{LONG, WORTH_TRYING};

/// Arms of a third of the arc length (section 9.3), in units of the half length.
pub(super) const ARC_THIRD: [f64; 2] = [2.0 / 3.0; 2];

/// Equal arms at which the arc lengths agree (section 9.4).
pub(super) fn equal_arms(piece: &Piece) -> [f64; 2] {
    arms_of_ratio(piece, 0.5)
}

/// Arms a : b = r : (1 − r) at which the cubic is as long as the piece.
///
/// Length grows with the arms in all ordinary cases. Where no arms below twice the arc length do, the longest
/// tried.
pub(super) fn arms_of_ratio(piece: &Piece, ratio: f64) -> [f64; 2] {
    let arms = |total: f64| [ratio * total, (1.0 - ratio) * total];
    let excess = |total: f64| arc_length(&LocalCubic::with_arms(piece, arms(total))) - 2.0;
    let (mut low, mut high) = (0.0, 4.0);
    let mut total = 4.0 / 3.0;
    let (mut last, mut last_excess) = (1.0, excess(1.0));
    // Secants, kept within a bracket; never more than 60 steps.
    for _ in 0..60 {
        let value = excess(total);
        if value > 0.0 {
            high = total
        } else if value < 0.0 {
            low = total
        } else {
            break;
        }
        let secant = total - value * (total - last) / (value - last_excess);
        (last, last_excess) = (total, value);
        let next = if secant > low && secant < high { secant } else { (low + high) / 2.0 };
        let is_done = (next - total).abs() <= 1e-14;
        total = next;
        if is_done {
            break;
        }
    }
    arms(total)
}

/// A local minimum of the error among cubics as long as the piece (section 9.5).
#[derive(Clone, Copy, Debug)]
pub(super) struct Minimum {
    pub(super) arms: [f64; 2],
    pub(super) error: f64,
}

/// All local minima by the ratio of the arms, ascending: as many as a scan in steps of 1/64 tells apart.
pub(super) fn all_minima(stretch: &Stretch<'_>, piece: &Piece, metric: Metric) -> Vec<Minimum> {
    const STEPS: usize = 64;
    let error = |ratio: f64| error_of_ratio(stretch, piece, metric, ratio);
    let ratio = |i: usize| i as f64 / STEPS as f64;
    let errors: Vec<f64> = (0..=STEPS).map(|i| error(ratio(i))).collect();
    (1..STEPS)
        .filter(|&i| errors[i] < errors[i - 1] && errors[i] <= errors[i + 1])
        .map(|i| minimum_near(stretch, piece, metric, [ratio(i - 1), ratio(i), ratio(i + 1)]))
        .collect()
}

/// The least of the local minima. Those near cubics in contact are tried first; without any, all are.
pub(super) fn least_angle_error(stretch: &Stretch<'_>, piece: &Piece, metric: Metric) -> [f64; 2] {
    /// Half the width in which the minimum near a contact is looked for.
    const NEAR: f64 = 0.02;
    let mut best: Option<Minimum> = None;
    if let Some(series) = &piece.series
        && (series.angle(1.0) - series.angle(-1.0)).abs() < LONG
    {
        let starts = expansions(series.kappa);
        let least = starts.least().unwrap_or(0.0);
        for Start { arms: [a, b], e6 } in starts.as_slice() {
            if e6.abs() <= WORTH_TRYING * least {
                let ratio = a / (a + b);
                let bracket = downhill(stretch, piece, metric, ratio, NEAR);
                let minimum = minimum_near(stretch, piece, metric, bracket);
                if best.is_none_or(|best| minimum.error < best.error) {
                    best = Some(minimum);
                }
            }
        }
    }
    let all = if best.is_none() { all_minima(stretch, piece, metric) } else { Vec::new() };
    let least = best.into_iter().chain(all).min_by(|a, b| a.error.total_cmp(&b.error));
    least.map_or_else(|| equal_arms(piece), |minimum| minimum.arms)
}

/// Three ratios with the least error in the middle, going downhill from one.
fn downhill(
    stretch: &Stretch<'_>,
    piece: &Piece,
    metric: Metric,
    ratio: f64,
    width: f64,
) -> [f64; 3] {
    let error = |ratio: f64| error_of_ratio(stretch, piece, metric, ratio);
    let inside = |ratio: f64| ratio.clamp(1e-3, 1.0 - 1e-3);
    let mut middle = (inside(ratio), error(inside(ratio)));
    let side = |by: f64| (inside(ratio + by), error(inside(ratio + by)));
    let (mut low, mut high) = (side(-width), side(width));
    for _ in 0..24 {
        if low.1 < middle.1 && low.1 <= high.1 && low.0 < middle.0 {
            let next = inside(low.0 - 1.5 * (middle.0 - low.0));
            (high, middle, low) = (middle, low, (next, error(next)));
        } else if high.1 < middle.1 && high.0 > middle.0 {
            let next = inside(high.0 + 1.5 * (high.0 - middle.0));
            (low, middle, high) = (middle, high, (next, error(next)));
        } else {
            break;
        }
    }
    [low.0, middle.0, high.0]
}

fn error_of_ratio(stretch: &Stretch<'_>, piece: &Piece, metric: Metric, ratio: f64) -> f64 {
    let cubic = LocalCubic::with_arms(piece, arms_of_ratio(piece, ratio));
    angle_error(stretch, piece, &cubic, metric).unwrap_or(f64::INFINITY)
}

/// The minimum between three ratios, by golden sections and parabolas, to 1e-7 in the ratio; the error feels
/// that only squared.
fn minimum_near(
    stretch: &Stretch<'_>,
    piece: &Piece,
    metric: Metric,
    [mut low, mut middle, mut high]: [f64; 3],
) -> Minimum {
    const GOLDEN: f64 = 0.381_966_011_250_105;
    const NEAR: f64 = 1e-7;
    let error = |ratio: f64| error_of_ratio(stretch, piece, metric, ratio);
    let mut least = error(middle);
    let (mut low_error, mut high_error) = (error(low), error(high));
    for step in 0..60 {
        // Squares of smooth errors are nearly parabolas.
        let [fl, fm, fh] = [low_error, least, high_error].map(|e| e * e);
        let (left, right) = (middle - low, high - middle);
        let top = right * right * (fl - fm) - left * left * (fh - fm);
        let bottom = right * (fl - fm) + left * (fh - fm);
        let by_parabola = middle - 0.5 * top / bottom;
        let wider = if left > right { middle - GOLDEN * left } else { middle + GOLDEN * right };
        let is_usable = by_parabola > low && by_parabola < high && step % 3 < 2;
        let mut next = if is_usable { by_parabola } else { wider };
        if (next - middle).abs() < NEAR / 4.0 {
            next = middle + if left > right { -NEAR / 4.0 } else { NEAR / 4.0 };
        }
        let value = error(next);
        if value < least {
            if next < middle {
                (high, high_error) = (middle, least)
            } else {
                (low, low_error) = (middle, least)
            }
            (middle, least) = (next, value);
        } else if next < middle {
            (low, low_error) = (next, value);
        } else {
            (high, high_error) = (next, value);
        }
        if high - low < NEAR {
            break;
        }
    }
    Minimum { arms: arms_of_ratio(piece, middle), error: least }
}

/// Arms at which the end curvatures are the curve's, the best of those found.
pub(super) fn with_end_curvatures(piece: &Piece) -> Option<Fit> {
    let mut starts = vec![ARC_THIRD];
    if let Some(series) = &piece.series {
        starts.extend(contact_starts(series.kappa, piece, 1.0).as_slice().iter().map(|s| s.arms));
    }
    starts
        .into_iter()
        .map(|start| {
            let mut arms = start;
            // Three Newton steps at a time.
            for _ in 0..4 {
                arms = meet_end_curvatures(piece, piece.end_curvature, arms);
            }
            arms
        })
        .filter(|arms| has_end_curvatures(piece, *arms))
        .map(|arms| measure(piece, arms, first_params(arms)))
        .filter(|fit| fit.error.is_finite())
        .min_by(|a, b| a.error.total_cmp(&b.error))
}

fn has_end_curvatures(piece: &Piece, arms: [f64; 2]) -> bool {
    let cubic = LocalCubic::with_arms(piece, arms);
    [0.0, 1.0].into_iter().zip(piece.end_curvature).all(|(t, wanted)| {
        let (velocity, acceleration) = (cubic.velocity(t), cubic.acceleration(t));
        let curvature = super::contact::cross(velocity, acceleration) / velocity.norm().powi(3);
        (curvature - wanted).abs() <= 1e-9 * (1.0 + wanted.abs())
    })
}
