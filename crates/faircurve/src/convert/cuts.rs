//! Where a stretch is cut (thesis section 9.6).

use kurbo::common::solve_itp;

use crate::numeric::roots::monotone_root;

use super::fitter::{Candidate, Cubic, Fitter};
use super::options::Cuts;
use super::tuning::{AIM, CLOSE, FITS, LAW_IS_CLOSE, NO_ZERO_NEAR};

/// The cubics for what lies between two places.
pub(super) fn cut(fitter: &Fitter<'_>, cuts: Cuts, from: f64, to: f64) -> Vec<Cubic> {
    match cuts {
        Cuts::Greedy => greedy(fitter, from, to),
        Cuts::EqualErrors => equal_errors(fitter, from, to),
        Cuts::Balanced => balanced(fitter, from, to),
        Cuts::Halving => halving(fitter, from, to, |from, to| (from + to) / 2.0),
        Cuts::HalvingBend => {
            halving(fitter, from, to, |from, to| fitter.stretch.half_of_bend(from, to))
        }
    }
}

/// In two until the accuracy is met (section 9.6.2).
#[inline(never)] // rare: not for engines of the web to compile with the rest
fn halving(
    fitter: &Fitter<'_>,
    from: f64,
    to: f64,
    middle: impl Fn(f64, f64) -> f64,
) -> Vec<Cubic> {
    let range = [from, to];
    let mut cubics = Vec::new();
    let mut stack = vec![(from, to)];
    while let Some((from, to)) = stack.pop() {
        let shortest = shortest(fitter, from, range);
        let candidate = fitter.try_piece(from, to);
        // What is far off needs no certificate.
        let is_near = candidate.error <= 1.1 * fitter.accuracy || to - from <= shortest;
        let cubic = is_near.then(|| fitter.certify(&candidate));
        match cubic {
            Some(cubic) if cubic.error <= fitter.accuracy || to - from <= shortest => {
                cubics.push(cubic);
            }
            _ => {
                let middle = middle(from, to);
                // A middle at the very end would never get anywhere.
                let margin = 0.01 * (to - from);
                let middle = middle.clamp(from + margin, to - margin);
                stack.push((middle, to));
                stack.push((from, middle));
            }
        }
    }
    cubics
}

/// With as many as greedy, all with the same error: the greedy cut to a smaller target, at which the last
/// cubic just fits, too (section 9.6.4).
#[inline(never)] // rare: not for engines of the web to compile with the rest
fn equal_errors(fitter: &Fitter<'_>, from: f64, to: f64) -> Vec<Cubic> {
    /// The target is found to this, relatively.
    const RESOLUTION: f64 = 1e-9;
    const MOST_ROUNDS: usize = 60;
    let cubics = greedy(fitter, from, to);
    if cubics.len() < 2 {
        return cubics;
    }
    let mut lengths: Vec<f64> = cubics.iter().map(|cubic| cubic.to - cubic.from).collect();
    let (mut low, mut high) = (0.0f64, fitter.accuracy);
    let whole: f64 = cubics.len() as f64 - 1.0;
    let part = (cubics[cubics.len() - 1].error / fitter.accuracy).powf(1.0 / fitter.order());
    let mut target = fitter.accuracy * ((whole + part) / (whole + 1.0)).powf(fitter.order());
    let (mut best, mut best_excess): (Option<Vec<Candidate>>, f64) = (None, f64::INFINITY);
    for _ in 0..MOST_ROUNDS {
        let Some((pieces, excess)) = reach_equally(fitter, from, to, target, &lengths) else {
            // Fewer pieces would reach the end.
            high = target;
            target = 0.5 * (low.max(0.5 * target) + high);
            continue;
        };
        // The target lies between this one and the last piece's error.
        if excess > 0.0 {
            low = target;
        } else {
            high = target;
        }
        if excess.abs() < best_excess {
            // The error isn't monotone: other lengths may have it, too. The next are to be near these.
            lengths = pieces.iter().map(|piece| piece.piece.to - piece.piece.from).collect();
            (best_excess, best) = (excess.abs(), Some(pieces));
        }
        if excess.abs() < RESOLUTION || high - low <= RESOLUTION * high {
            break;
        }
        // A shift of the target is shared by all of the pieces, the last one's error moves the other way.
        let next = target * (excess / (whole + 1.0)).exp();
        target = if next > low && next < high { next } else { (low + high) / 2.0 };
    }
    let certified: Option<Vec<Cubic>> =
        best.map(|pieces| pieces.iter().map(|candidate| fitter.certify(candidate)).collect());
    // Where the error isn't monotone, or the bound too far from the estimate, greedy stays.
    certified.filter(|c| c.iter().all(|c| c.error <= fitter.accuracy)).unwrap_or(cubics)
}

/// Pieces whose error is the target but for the last, and how much that one's is larger (as a logarithm).
fn reach_equally(
    fitter: &Fitter<'_>,
    from: f64,
    to: f64,
    target: f64,
    lengths: &[f64],
) -> Option<(Vec<Candidate>, f64)> {
    let mut pieces = Vec::with_capacity(lengths.len());
    let mut here = from;
    let mut scale = 1.0;
    for length in &lengths[..lengths.len() - 1] {
        let candidate = reach(fitter, here, to, target, scale * length)?;
        scale = (candidate.piece.to - here) / length;
        here = candidate.piece.to;
        pieces.push(candidate);
    }
    if here >= to {
        return None;
    }
    let last = fitter.try_piece(here, to);
    let excess = (last.error / target).ln();
    pieces.push(last);
    excess.is_finite().then_some((pieces, excess))
}

/// The piece from `from` whose error is the target, near a guess of its length.
fn reach(fitter: &Fitter<'_>, from: f64, to: f64, target: f64, guess: f64) -> Option<Candidate> {
    const MOST_STEPS: usize = 40;
    let rest = to - from;
    let excess = |length: f64| {
        (fitter.try_piece(from, from + length).error.max(f64::MIN_POSITIVE) / target)
            .min(1e100)
            .ln()
    };
    // A bracket by steps towards the root.
    let mut low = guess.min(rest * (1.0 - 1e-9));
    let mut value = excess(low);
    let mut high = low;
    for _ in 0..MOST_STEPS {
        let factor = (-value / fitter.order()).exp().clamp(0.5, 2.0);
        let factor = if value > 0.0 { factor * 0.999 } else { factor * 1.001 };
        let next = (high * factor).min(rest);
        let next_value = excess(next);
        (low, high) = (high, next);
        if (next_value > 0.0) != (value > 0.0) {
            // Both ends' values are known, in the order of the ends.
            let (a, b) = (low.min(high), low.max(high));
            let (fa, fb) = if low < high { (value, next_value) } else { (next_value, value) };
            if !(fa < 0.0 && fb > 0.0) {
                // The error falls with the length: of no use here.
                return None;
            }
            let resolution = 1e-11 * b;
            let length = solve_itp(excess, a, b, resolution, 1, 0.2 / (b - a), fa, fb);
            return Some(fitter.try_piece(from, from + length));
        }
        if next >= rest {
            return None;
        }
        value = next_value;
    }
    None
}

/// With as many as greedy, neighbours getting the same error two at a time (section 9.6.3).
#[inline(never)] // rare: not for engines of the web to compile with the rest
fn balanced(fitter: &Fitter<'_>, from: f64, to: f64) -> Vec<Cubic> {
    /// Sweeps over all of the cuts; each evens out neighbours, and in n sweeps the ends of n pieces have heard of each
    /// other.
    const MOST_SWEEPS: usize = 60;
    /// Errors within this factor of each other are the same.
    const EVEN: f64 = 1.01;
    let greedy = greedy(fitter, from, to);
    let mut places: Vec<f64> = greedy.iter().map(|cubic| cubic.from).collect();
    places.push(to);
    for _ in 0..MOST_SWEEPS {
        let mut moved = false;
        for i in 1..places.len() - 1 {
            let (before, after) = (places[i - 1], places[i + 1]);
            let ratio = |place: f64| {
                let left = fitter.try_piece(before, place).error.max(f64::MIN_POSITIVE);
                let right = fitter.try_piece(place, after).error.max(f64::MIN_POSITIVE);
                (left / right).ln().clamp(-1e3, 1e3)
            };
            if ratio(places[i]).abs() <= EVEN.ln() {
                continue;
            }
            let margin = 0.02 * (after - before);
            if let Some(place) = monotone_root(ratio, before + margin, after - margin) {
                moved |= (place - places[i]).abs() > 1e-3 * (after - before);
                places[i] = place;
            }
        }
        if !moved {
            break;
        }
    }
    let even: Vec<Cubic> =
        places.windows(2).map(|pair| fitter.certify(&fitter.try_piece(pair[0], pair[1]))).collect();
    if even.iter().all(|cubic| cubic.error <= fitter.accuracy) { even } else { greedy }
}

/// Cubics that each reach as far as the accuracy allows (section 9.6.4).
pub(super) fn greedy(fitter: &Fitter<'_>, from: f64, to: f64) -> Vec<Cubic> {
    let mut cubics: Vec<Cubic> = Vec::new();
    let mut here = from;
    let mut guess = first_guess(fitter, from, to);
    while here < to {
        let shortest = shortest(fitter, here, [from, to]);
        let predicted = predict(fitter, here, to, guess);
        let cubic = farthest(fitter, here, to, predicted, shortest);
        cubics.push(cubic);
        if cubic.to < to {
            // What the next would reach if the curve went on like this.
            let factor = (AIM * fitter.accuracy / cubic.error).powf(1.0 / fitter.order());
            let factor = if factor.is_finite() { factor.clamp(0.5, 2.0) } else { 2.0 };
            guess = (cubic.to - here) * factor;
        }
        here = cubic.to;
    }
    cubics
}

/// What starts at `here` in a range is never cut shorter than this, so that the work is bounded: by 4097
/// pieces a segment, and as many for each break, about which a curve may have a cusp. No more than the rest
/// of the segment, as the next one may be much shorter; and never so short that arc lengths of the whole
/// stretch don't tell one end from the other.
pub(super) fn shortest(fitter: &Fitter<'_>, here: f64, range: [f64; 2]) -> f64 {
    const MOST_PIECES: f64 = 4096.0;
    /// A rest below this part of the segment is rounding.
    const LEAST_REST: f64 = 1e-9;
    /// As a part of the stretch: some hundred units in the last place.
    const TELLS_ENDS: f64 = 1e-13;
    let (segment, local) = fitter.stretch.locate(here);
    let length = segment.length().min(range[1] - range[0]);
    let mut shortest = length / MOST_PIECES;
    if segment.breaks().into_iter().any(|s| s > local && s < local + shortest) {
        shortest /= MOST_PIECES;
    }
    let rest = (segment.length() - local).max(LEAST_REST * length);
    shortest.min(rest).max(TELLS_ENDS * fitter.stretch.length())
}

fn first_guess(fitter: &Fitter<'_>, from: f64, to: f64) -> f64 {
    /// Radians.
    const BEND: f64 = 1.5;
    let bend = fitter.stretch.bend(from, to);
    if bend > BEND { (to - from) * BEND / bend } else { to - from }
}

/// The longest cubic from `from` within the accuracy, or one of the shortest length without it.
pub(super) fn farthest(
    fitter: &Fitter<'_>,
    from: f64,
    to: f64,
    guess: f64,
    shortest: f64,
) -> Cubic {
    /// Of certificates that are refused; each shortens the piece.
    const MOST_REFUSALS: usize = 4;
    let rest = to - from;
    let mut search = Search::new();
    let mut length = guess;
    for _ in 0..MOST_REFUSALS {
        let candidate = longest_estimate(fitter, from, to, length, shortest, &mut search);
        let cubic = fitter.certify(&candidate);
        if cubic.error <= fitter.accuracy || cubic.to - from <= shortest {
            return beyond(fitter, &cubic, to, shortest).unwrap_or(cubic);
        }
        search.fails = cubic.to - from;
        search.fails_by = cubic.error;
        search.fits = None;
        let factor = (AIM * fitter.accuracy / cubic.error).powf(1.0 / fitter.order());
        length = (search.fails * factor.clamp(0.25, 0.999)).max(shortest);
    }
    let length = (search.fails / 2.0).min(rest).max(shortest.min(rest));
    // Something that certificates can't cope with; halve on.
    let mut length = length;
    loop {
        let cubic = fitter.certify(&fitter.try_piece(from, end(from, length, to)));
        if cubic.error <= fitter.accuracy || length <= shortest {
            return cubic;
        }
        length = (length / 2.0).max(shortest);
    }
}

/// The place `length` on, or the very end if what is left would be nothing.
fn end(from: f64, length: f64, to: f64) -> f64 {
    let end = from + length;
    if to - end <= 1e-9 * length { to } else { end }
}

/// What is known of lengths from one place.
struct Search {
    /// The longest candidate that seems to do.
    fits: Option<Candidate>,
    /// The shortest length that is known not to, and its error.
    fails: f64,
    fails_by: f64,
}

impl Search {
    fn new() -> Self {
        Search { fits: None, fails: f64::INFINITY, fails_by: f64::INFINITY }
    }
}

/// A longer cubic than the longest of a stretch of lengths: the error isn't monotone. It falls again
/// where E₆, a function of the piece's middle, changes its sign.
fn beyond(fitter: &Fitter<'_>, cubic: &Cubic, to: f64, shortest: f64) -> Option<Cubic> {
    /// Where it is looked for: steps of 5 % up to twice the length.
    const STEP: f64 = 1.05;
    const MOST_STEPS: usize = 14;
    if cubic.to >= to {
        return None;
    }
    let (from, length) = (cubic.from, cubic.to - cubic.from);
    let mut before = fitter.law(from, cubic.to)?;
    let mut longer = length;
    for step in 0..MOST_STEPS {
        longer *= STEP;
        if from + longer > to {
            return None;
        }
        let error = fitter.law(from, from + longer)?;
        if step == 0 && error > before * STEP.powf(NO_ZERO_NEAR) {
            return None;
        }
        if error < before && error < fitter.accuracy {
            let candidate = fitter.try_piece(from, from + longer);
            if candidate.error < fitter.accuracy {
                let mut search = Search::new();
                let next = longest_estimate(fitter, from, to, longer * STEP, shortest, &mut search);
                let best = if next.piece.to > candidate.piece.to { next } else { candidate };
                let cubic = fitter.certify(&best);
                return (cubic.error <= fitter.accuracy).then_some(cubic);
            }
        }
        before = error;
    }
    None
}

/// The longest candidate whose estimated error is within the accuracy, by secants in the logarithms.
fn longest_estimate(
    fitter: &Fitter<'_>,
    from: f64,
    to: f64,
    guess: f64,
    shortest: f64,
    search: &mut Search,
) -> Candidate {
    /// On smooth stretches two or three are enough; the rest is for those where the error jumps.
    const MOST_TRIALS: usize = 16;
    /// How far the ends of what is known may be apart.
    const RESOLUTION: f64 = 1.003;
    let rest = to - from;
    let target = AIM * fitter.accuracy;
    let mut length = guess.max(shortest).min(rest);
    // The trial before: length and error.
    let mut last: Option<(f64, f64)> = None;
    for _ in 0..MOST_TRIALS {
        let candidate = fitter.try_piece(from, end(from, length, to));
        let (tried, error) = (candidate.piece.to - from, candidate.error);
        if error <= FITS * fitter.accuracy {
            search.fits = Some(candidate);
            if error >= CLOSE * fitter.accuracy || candidate.piece.to >= to {
                return candidate;
            }
        } else {
            (search.fails, search.fails_by) = (tried, error);
            if tried <= shortest {
                return candidate;
            }
        }
        length = match &search.fits {
            Some(low) if search.fails.is_finite() => {
                let (low_length, low_error) = (low.piece.to - from, low.error);
                if search.fails <= low_length * RESOLUTION {
                    return *low;
                }
                // Between the two, by the slope that they show, but not too near to either.
                let span = (search.fails / low_length).ln();
                let along = (target / low_error).ln() / (search.fails_by / low_error).ln();
                let along = if along.is_finite() { along.clamp(0.1, 0.9) } else { 0.5 };
                low_length * (along * span).exp()
            }
            fits => {
                // The sixth order, until two trials show the slope.
                let slope = last.map_or(fitter.order(), |(length, before)| {
                    let slope = (error / before).ln() / (tried / length).ln();
                    if slope.is_nan() { fitter.order() } else { slope.clamp(3.0, 12.0) }
                });
                let factor = (target / error).powf(1.0 / slope);
                if fits.is_some() {
                    (tried * factor.clamp(1.02, 3.0)).min(rest)
                } else {
                    let factor = if factor.is_nan() { 0.5 } else { factor.clamp(0.3, 0.98) };
                    (tried * factor).max(shortest)
                }
            }
        };
        last = Some((tried, error));
    }
    search.fits.unwrap_or_else(|| fitter.try_piece(from, end(from, shortest.min(rest), to)))
}

/// The length that the sixth-order theory gives a cubic from `from`; `guess` where it has nothing
/// to say.
pub(super) fn predict(fitter: &Fitter<'_>, from: f64, to: f64, guess: f64) -> f64 {
    let mut length = guess.min(to - from);
    for _ in 0..4 {
        let Some(error) = fitter.law(from, from + length) else { return length };
        let ratio = AIM * fitter.accuracy / error;
        // All of what is left will do.
        if length == to - from && ratio >= 1.0 {
            return length;
        }
        let factor = ratio.powf(1.0 / 6.5);
        if !factor.is_finite() {
            return length;
        }
        let next = (length * factor.clamp(0.4, 2.5)).min(to - from);
        if (ratio - 1.0).abs() < LAW_IS_CLOSE || next == length {
            return next;
        }
        length = next;
    }
    length
}
