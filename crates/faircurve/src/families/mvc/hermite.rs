//! Segments with given ends.

use super::{curve, unit_ends};
use crate::families::euler::fit_euler;
use crate::frame::ChordAngles;
use crate::numeric::block_tridiagonal::invert;
use crate::numeric::dual::Dual;

/// A segment of minimum variation on the unit chord.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MvcSegment {
    /// κ and its first three derivatives in the middle, for arc length 1.
    pub k: [f64; 4],
    /// The constant C of thesis eq. 7.19 for arc length 1: 0 where the length is free.
    pub constant: f64,
    /// Arc length, at least 1.
    pub length: f64,
}

/// The segment of least ∫ κ′² ds with these end tangents and these end curvatures, for unit chord, of
/// free length (thesis eq. 7.20): the one to which Newton's method leads from the polynomial spiral.
///
/// The ends are met to about 1e-13 of the curvatures; `None` where none is found.
pub fn fit_mvc(angles: ChordAngles, curvatures: [f64; 2]) -> Option<MvcSegment> {
    fit(angles, curvatures, None)
}

/// The same of a given arc length, above 1: a solution of eq. 7.19 with its C.
pub fn fit_mvc_of_length(
    angles: ChordAngles,
    curvatures: [f64; 2],
    length: f64,
) -> Option<MvcSegment> {
    (length > 1.0).then(|| fit(angles, curvatures, Some(length)))?
}

fn fit(angles: ChordAngles, curvatures: [f64; 2], length: Option<f64>) -> Option<MvcSegment> {
    let ends = [angles.theta0, angles.theta1, curvatures[0], curvatures[1]];
    if !ends.iter().all(|end| end.is_finite()) {
        return None;
    }
    let scale = 1.0 + curvatures[0].abs().max(curvatures[1].abs());
    // What is off, and its size; the last unknown is C.
    let off = |u: [Dual<5>; 5]| {
        let [k @ .., constant] = u;
        let (jets, _, c) = unit_ends::<_, { curve::TERMS }>(k, constant, curve::NEGLIGIBLE)?;
        let last = match length {
            Some(length) => c * length + -1.0,
            None => constant,
        };
        let over = [1.0, 1.0, 1.0 / scale, 1.0 / scale];
        let [a, b, d, e] = std::array::from_fn(|i| (jets[i] + -ends[i]) * over[i]);
        Some([a, b, d, e, last])
    };
    let start = [angles.turning(), 6.0 * (angles.theta1 - angles.theta0), 0.0, 0.0, 0.0];
    let found = newton(start, off)?;
    let [k @ .., constant] = found;
    let (_, _, c) = unit_ends::<_, { curve::TERMS }>(k, constant, curve::NEGLIGIBLE)?;
    Some(MvcSegment { k, constant, length: 1.0 / c })
}

/// The parameters of the segment with these end tangents and κ″ = 0 at both ends; if none is found, of
/// one whose parameters are those of the Euler spiral.
pub(super) fn between_tangents(theta0: f64, theta1: f64) -> [f64; 4] {
    let euler = fit_euler(ChordAngles::new(theta0, theta1)).map_or([0.0; 4], |spiral| spiral.k);
    let off = |k: [Dual<4>; 4]| {
        let zero = Dual::from(0.0);
        let (jets, derivatives, _) = unit_ends::<_, { curve::TERMS }>(k, zero, curve::NEGLIGIBLE)?;
        let [_, second0, _, second1] = derivatives;
        Some([jets[0] + -theta0, jets[1] + -theta1, second0 * 0.01, second1 * 0.01])
    };
    newton(euler, off).unwrap_or(euler)
}

/// Newton's method for unknowns of which the first four are κ … κ‴ in the middle.
fn newton<const N: usize>(
    start: [f64; N],
    off: impl Fn([Dual<N>; N]) -> Option<[Dual<N>; N]>,
) -> Option<[f64; N]> {
    const MOST_STEPS: usize = 30;
    /// Radians that a step may bend the segment.
    const MOST_BEND: f64 = 0.7;
    /// What is off in the end, at most.
    const CLOSE: f64 = 1e-12;
    let mut here = start;
    let mut best: Option<(f64, [f64; N])> = None;
    for _ in 0..MOST_STEPS {
        let off = off(std::array::from_fn(|i| Dual::variable(here[i], i)))?;
        let missed = off.iter().fold(0.0f64, |most, off| most.max(off.value.abs()));
        let least = best.map_or(f64::INFINITY, |(least, _)| least);
        if !off.iter().all(|off| off.value.is_finite()) || (least < CLOSE && missed >= least) {
            break;
        }
        if missed < least {
            best = Some((missed, here));
        }
        let inverse = invert(&off.map(|off| off.by));
        let step: [f64; N] =
            std::array::from_fn(|row| -(0..N).map(|i| inverse[row][i] * off[i].value).sum::<f64>());
        let bend = step[0].abs() / 2.0
            + step[1].abs() / 8.0
            + step[2].abs() / 48.0
            + step[3].abs() / 384.0;
        let share = (MOST_BEND / bend).min(1.0);
        here = std::array::from_fn(|i| here[i] + share * step[i]);
    }
    best.filter(|(missed, _)| *missed <= CLOSE).map(|(_, found)| found)
}
