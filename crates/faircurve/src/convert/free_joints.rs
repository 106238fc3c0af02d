//! Greedy cuts with joints beside the curve: fewer cubics, each as near.
//!
//! To leading order the deviation of a cubic is a polynomial −E₆x⁶ + … of x ∈ [−1, 1] along its piece, and where and how
//! it joins its neighbours sets the lower terms. Ends and end tangents on the curve, the least largest deviation is 0.1059|E₆|.
//! A joint that is moved along the normal by just that deviation, to the side to which E₆ bends the cubics, makes
//! it Chebyshev's T₆(√¾·x), whose size is |E₆|/13.5 = 0.0741|E₆|: 0.70 times as large, 5.8 % fewer cubics. Where E₆ changes
//! its sign, the cubics on both sides of a joint want it on different sides of the curve; there it stays on the curve, and the common
//! tangent is turned, so that the deviation crosses zero as T₆ does beyond its last extremum. Neighbours
//! always share point and tangent: the path is smooth.

use super::cuts::{farthest, greedy, predict, shortest};
use super::fitter::{Cubic, Fitter};
use super::piece::Shift;
use super::tuning::{BEHIND, LARGEST_OFFSET, MOST_TURN, SLOPE};
use crate::numeric::order::sort_by;

/// How a joint may stand to the curve.
#[derive(Clone, Copy, Debug)]
struct Stand {
    /// To the left of it, as a part of [`LARGEST_OFFSET`].
    offset: f64,
    /// Turn of the tangent, in [`LARGEST_OFFSET`]s for half the length of a cubic.
    slope: f64,
}

/// How many are tried.
const STANDS: usize = 5;

/// Those that are tried; the first is what the ends of the curve have. Offsets and slopes between save no more.
const ALL: [Stand; STANDS] = [
    Stand { offset: 0.0, slope: 0.0 },
    Stand { offset: 1.0, slope: 0.0 },
    Stand { offset: -1.0, slope: 0.0 },
    Stand { offset: 0.0, slope: SLOPE },
    Stand { offset: 0.0, slope: -SLOPE },
];

/// How a joint is reached.
#[derive(Clone, Copy, Debug)]
struct Reached {
    /// The last cubic on the way.
    cubic: Cubic,
    /// The stand at which that starts.
    before: usize,
}

/// The joints that are reached with so many cubics, by stand.
type Step = [Option<Reached>; STANDS];

/// The cubics for what lies between two places.
///
/// Of all ways to reach a joint with k cubics, only the farthest is kept for each stand: a dynamic programme, exact
/// where the error is monotone.
#[inline(never)] // rare: not for engines of the web to compile with the rest
pub(super) fn cut(fitter: &Fitter<'_>, from: f64, to: f64) -> Vec<Cubic> {
    let plain = greedy(fitter, from, to);
    let mut steps: Vec<Step> = Vec::new();
    while steps.len() + 1 < plain.len() {
        let starts = match steps.last() {
            None => vec![Start { stand: 0, place: from, shift: Shift::NONE }],
            Some(step) => starts(step, &plain),
        };
        if starts.is_empty() {
            break;
        }
        let step = step_from(fitter, [from, to], &starts, &plain);
        steps.push(step);
        if step[0].is_some_and(|reached| reached.cubic.to == to) {
            return traced_back(&steps);
        }
    }
    plain
}

/// Where the next cubic may start.
#[derive(Clone, Copy, Debug)]
struct Start {
    stand: usize,
    place: f64,
    shift: Shift,
}

/// The joints of a step, the farthest first.
fn starts(step: &Step, plain: &[Cubic]) -> Vec<Start> {
    let mut starts: Vec<Start> = step
        .iter()
        .enumerate()
        .filter_map(|(stand, reached)| {
            let cubic = (*reached)?.cubic;
            Some(Start { stand, place: cubic.to, shift: cubic.shifts[1] })
        })
        .collect();
    sort_by(&mut starts, |a, b| b.place.total_cmp(&a.place));
    if let Some(first) = starts.first().copied() {
        let behind = BEHIND * length_near(plain, first.place);
        starts.retain(|start| start.place >= first.place - behind);
    }
    starts
}

/// One cubic on from all starts.
fn step_from(fitter: &Fitter<'_>, [from, to]: [f64; 2], starts: &[Start], plain: &[Cubic]) -> Step {
    let mut step: Step = [None; STANDS];
    let mut farthest_place = from;
    for start in starts {
        let shortest = shortest(fitter, start.place, [from, to]);
        let length = length_near(plain, start.place);
        for (after, stand) in ALL.iter().enumerate() {
            let offset = LARGEST_OFFSET * fitter.accuracy;
            let end = Shift {
                offset: stand.offset * offset,
                turn: stand.slope * offset / (length / 2.0),
            };
            // The end of the curve is on the curve.
            let limit = if after == 0 { to } else { to - shortest };
            let known = step[after].map_or(from, |reached| reached.cubic.to);
            if !(start.place < limit) || known >= limit || end.turn.abs() > MOST_TURN {
                continue;
            }
            let fitter = Fitter { shifts: [start.shift, end], ..*fitter };
            // One fit tells whether this way is worth a search.
            let least = known.max(farthest_place - BEHIND * length).min(limit);
            if least > start.place && fitter.try_piece(start.place, least).error > fitter.accuracy {
                continue;
            }
            let guess = predict(&fitter, start.place, limit, length);
            let cubic = farthest(&fitter, start.place, limit, guess, shortest);
            if cubic.error <= fitter.accuracy && cubic.to > known {
                step[after] = Some(Reached { cubic, before: start.stand });
                farthest_place = farthest_place.max(cubic.to);
            }
        }
    }
    step
}

/// The longer of the cubic at a place and its successor.
fn length_near(cubics: &[Cubic], place: f64) -> f64 {
    let at = cubics.partition_point(|cubic| cubic.to <= place).min(cubics.len() - 1);
    let near = &cubics[at..(at + 2).min(cubics.len())];
    near.iter().map(|cubic| cubic.to - cubic.from).fold(0.0, f64::max)
}

/// The way to the end, on the curve.
fn traced_back(steps: &[Step]) -> Vec<Cubic> {
    let mut cubics = Vec::with_capacity(steps.len());
    let mut stand = 0;
    for step in steps.iter().rev() {
        let Some(Reached { cubic, before }) = step[stand] else { break };
        cubics.push(cubic);
        stand = before;
    }
    cubics.reverse();
    cubics
}
