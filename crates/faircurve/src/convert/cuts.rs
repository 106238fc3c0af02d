//! Where a stretch is cut (thesis section 9.6).

use super::fitter::{Candidate, Cubic, Fitter};

/// Estimates within this of what they estimate, in the typical case; what the greedy search aims at. Closer, and
/// the certificate rejects more of them; farther, and cubics get shorter by a sixth of the difference.
const AIM: f64 = 0.99;

/// Good enough: at the sixth order the cubic is within half a percent of the longest.
const CLOSE: f64 = 0.965;

/// Cubics that each reach as far as the accuracy allows (section 9.6.4).
pub(super) fn greedy(fitter: &Fitter<'_>, from: f64, to: f64) -> Vec<Cubic> {
    let shortest = shortest(fitter, from, to);
    let mut cubics: Vec<Cubic> = Vec::new();
    let mut here = from;
    let mut guess = first_guess(fitter, from, to);
    while here < to {
        let predicted = predict(fitter, here, to, guess);
        let cubic = farthest(fitter, here, to, predicted, shortest);
        let length = cubic.to - here;
        // What the next would reach if the curve went on like this.
        let factor = (AIM * fitter.accuracy / cubic.error).powf(1.0 / 6.0);
        guess = length * if factor.is_finite() { factor.clamp(0.5, 2.0) } else { 2.0 };
        here = cubic.to;
        cubics.push(cubic);
    }
    cubics
}

/// Pieces are never shorter than this, so that the work is bounded: 4096 a segment.
pub(super) fn shortest(fitter: &Fitter<'_>, from: f64, to: f64) -> f64 {
    const MOST_PIECES: f64 = 4096.0;
    let _ = fitter;
    (to - from) / MOST_PIECES
}

fn first_guess(fitter: &Fitter<'_>, from: f64, to: f64) -> f64 {
    /// Radians.
    const BEND: f64 = 1.5;
    let bend = fitter.stretch.bend(from, to);
    if bend > BEND { (to - from) * BEND / bend } else { to - from }
}

/// The longest cubic from `from` within the accuracy, or one of the shortest length without it.
fn farthest(fitter: &Fitter<'_>, from: f64, to: f64, guess: f64, shortest: f64) -> Cubic {
    /// Of certificates that are refused; each shortens the piece.
    const MOST_REFUSALS: usize = 8;
    let rest = to - from;
    let mut search = Search { fits: None, fails: f64::INFINITY, fails_by: f64::INFINITY };
    let mut length = guess;
    for _ in 0..MOST_REFUSALS {
        let candidate = longest_estimate(fitter, from, to, length, shortest, &mut search);
        let cubic = fitter.certify(&candidate);
        if cubic.error <= fitter.accuracy || cubic.to - from <= shortest {
            return cubic;
        }
        search.fails = cubic.to - from;
        search.fails_by = cubic.error;
        search.fits = None;
        let factor = (AIM * fitter.accuracy / cubic.error).powf(1.0 / 6.0);
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
    let mut length = guess.min(rest);
    // The trial before: length and error.
    let mut last: Option<(f64, f64)> = None;
    for _ in 0..MOST_TRIALS {
        let candidate = fitter.try_piece(from, end(from, length, to));
        let (tried, error) = (candidate.piece.to - from, candidate.error);
        if error <= fitter.accuracy * 0.998 {
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
                let slope = last.map_or(6.0, |(length, before)| {
                    let slope = (error / before).ln() / (tried / length).ln();
                    if slope.is_nan() { 6.0 } else { slope.clamp(3.0, 12.0) }
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
fn predict(fitter: &Fitter<'_>, from: f64, to: f64, guess: f64) -> f64 {
    /// The theory itself is good to a percent or two, where it is good at all.
    const CLOSE: f64 = 0.03;
    let mut length = guess.min(to - from);
    for _ in 0..4 {
        let Some(error) = fitter.law(from, from + length) else { return length };
        let ratio = AIM * fitter.accuracy / error;
        let factor = ratio.powf(1.0 / 6.5);
        if !factor.is_finite() {
            return length;
        }
        let next = (length * factor.clamp(0.4, 2.5)).min(to - from);
        if (ratio - 1.0).abs() < CLOSE || next == length {
            return next;
        }
        length = next;
    }
    length
}
