//! The one place where measured numbers become judgements: the + and − of thesis Table 4.1, and whether a
//! claim holds. Every threshold stands here with its reason.

use std::fmt;

use super::laws::Laws;
use crate::catalog::Claim;

/// Distances, as fractions of the drawing, that count as none: solutions are exact to
/// [`SOLVED`](crate::tolerance::SOLVED) = 1e-9 of an equation, which some splines' geometry amplifies tenfold. What
/// fails a law fails it by 1e-5 or more on these drawings; wrong, and exact laws would seem
/// to fail or approximate ones to hold.
pub const NONE: f64 = 1e-8;

/// Jumps at knots, without units, that count as none for direction, κ, κ′ and κ″. Derivatives amplify
/// rounding; a jump that is there is 1e-3 or more.
pub const NO_JUMP: [f64; 4] = [1e-8, 1e-6, 1e-5, 1e-4];

/// How near to a whole number an order of roundness must come: the last two of its points are far
/// enough out for a tenth.
pub const ORDER: f64 = 0.25;

/// How near a ripple must come to the one claimed: claims are rounded to three digits or more.
pub const RIPPLE: f64 = 2e-3;

/// How well one generating curve must predict nine places in ten: interpolation between a thousand
/// places is good to 1e-4, and splines without one are off by 1e-2 or more.
pub const SPREAD: f64 = 1e-3;

/// The share of segments that may seem not monotone by rounding: none.
pub const MONOTONE: f64 = 1.0;

/// A grade of thesis Table 4.1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Grade {
    /// The property is missing.
    Minus,
    /// It is there to a degree.
    Plus,
    /// It is there.
    PlusPlus,
    /// As good as can be.
    PlusPlusPlus,
}

impl Grade {
    /// `-`, `+`, `++` or `+++`.
    pub const fn name(self) -> &'static str {
        match self {
            Grade::Minus => "-",
            Grade::Plus => "+",
            Grade::PlusPlus => "++",
            Grade::PlusPlusPlus => "+++",
        }
    }
}

impl fmt::Display for Grade {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// For each grade from the best down, the largest number that still earns it.
type Steps = [f64; 3];

fn grade(number: f64, steps: Steps) -> Grade {
    match steps.iter().position(|most| number <= *most) {
        Some(0) => Grade::PlusPlusPlus,
        Some(1) => Grade::PlusPlus,
        Some(_) => Grade::Plus,
        None => Grade::Minus,
    }
}

/// How far a knot added on the curve may move it, as a fraction of the drawing. The thesis knows exact and
/// not: KURGLA 1, at 6e-4, is "−" there; a ten-thousandth is less than anyone sees.
const EXTENSIONALITY: Steps = [NONE, 1e-5, 1e-4];

/// How far the closed curve through four points may be from the circle, over its radius. Exact is +++;
/// Hobby's 2.7e-4 is "−" in the thesis, so + ends just below.
const ROUNDNESS: Steps = [NONE, 1e-5, 1e-4];

/// The ripple's factor from knot to knot: +++ is finite support; Euler's 0.268 is + and log-aesthetic's 0.169 (α =
/// 1.78) is ++ in the thesis.
const LOCALITY: Steps = [0.0, 0.2, 0.35];

/// Drawings not solved plus paths with jumps, as shares, tuned to divide splines as the thesis does: Hobby
/// (0.17) +++, Ikarus (0.25) and Euler (0.33) ++. Where the thesis judges solvers of its day, as at
/// log-aesthetic's "−", these numbers are kinder.
const ROBUSTNESS: Steps = [0.2, 0.4, 0.5];

impl Laws {
    /// The order of geometric continuity that holds: 4 if even κ″ is continuous, 0 if not even the
    /// tangent is; `None` if nothing was solved.
    pub fn continuity(&self) -> Option<u8> {
        let jumps = self.jumps?;
        Some((0..4).take_while(|order| jumps[*order] <= NO_JUMP[*order]).count() as u8)
    }

    /// Whether every circle through knots comes out as that circle.
    pub fn is_round(&self) -> bool {
        self.roundness.uneven <= NONE && self.roundness.even.iter().all(|(_, off)| *off <= NONE)
    }

    /// Column "Roundness" of Table 4.1.
    pub fn roundness_grade(&self) -> Grade {
        let at_four = self.roundness.even.iter().find(|(n, _)| *n == 4).map_or(1.0, |even| even.1);
        let exact = if self.is_round() { 0.0 } else { at_four.max(2.0 * NONE) };
        grade(exact, ROUNDNESS)
    }

    /// Column "Extensionality" of Table 4.1.
    pub fn extensionality_grade(&self) -> Grade {
        grade(self.extensionality.inside, EXTENSIONALITY)
    }

    /// Column "Locality" of Table 4.1.
    pub fn locality_grade(&self) -> Grade {
        match self.locality.support {
            Some(_) => Grade::PlusPlusPlus,
            None => grade(self.locality.ripple.max(f64::MIN_POSITIVE), LOCALITY),
        }
    }

    /// Column "Robustness" of Table 4.1.
    pub fn robustness_grade(&self) -> Grade {
        grade(1.0 - self.share_solved() + self.moves.jumps, ROBUSTNESS)
    }

    /// Column "Tangents" of Table 4.1: what determines them, as far as locality shows.
    pub fn tangents(&self) -> &'static str {
        match (self.locality.support, self.continuity()) {
            (Some(_), _) => "local",
            (None, Some(2 | 3)) => "G2",
            (None, Some(4)) => "G4",
            (None, _) => "global",
        }
    }
}

/// The properties that a spline has or lacks: what it doesn't claim of them should have a witness.
pub const PROPERTIES: [Claim; 9] = [
    Claim::Round,
    Claim::Extensional,
    Claim::GeneratingCurve,
    Claim::MonotoneCurvature,
    Claim::SimilarityInvariant,
    Claim::Symmetric,
    Claim::AffineInvariant,
    Claim::Exists,
    Claim::Continuous,
];

/// What measuring says about a claim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The number agrees.
    Holds(f64),
    /// The number contradicts it.
    Contradicted(f64),
    /// There is no number.
    Unknown,
}

impl Verdict {
    /// `holds`, `contradicted` or `unknown`.
    pub const fn name(self) -> &'static str {
        match self {
            Verdict::Holds(_) => "holds",
            Verdict::Contradicted(_) => "contradicted",
            Verdict::Unknown => "unknown",
        }
    }

    /// The number measured.
    pub const fn number(self) -> Option<f64> {
        match self {
            Verdict::Holds(number) | Verdict::Contradicted(number) => Some(number),
            Verdict::Unknown => None,
        }
    }

    /// Whether it holds.
    pub const fn holds(self) -> bool {
        matches!(self, Verdict::Holds(_))
    }

    fn of(number: f64, holds: bool) -> Verdict {
        if holds { Verdict::Holds(number) } else { Verdict::Contradicted(number) }
    }

    /// Judges a claim by the numbers of the spline that makes it.
    pub fn on(claim: &Claim, laws: &Laws) -> Verdict {
        let at_most = |number: f64, most: f64| Verdict::of(number, number <= most);
        match *claim {
            Claim::Round => {
                let off = laws.roundness.even.iter().map(|even| even.1);
                let worst = off.fold(laws.roundness.uneven, f64::max);
                Verdict::of(worst, laws.is_round())
            }
            Claim::RoundToOrder(claimed) => match laws.roundness.order {
                Some(order) => Verdict::of(order, order >= f64::from(claimed) - ORDER),
                None => Verdict::Unknown,
            },
            Claim::Extensional => at_most(laws.extensionality.inside, NONE),
            Claim::GeneratingCurve => match laws.spread {
                Some(spread) => at_most(spread, SPREAD),
                None => Verdict::Unknown,
            },
            Claim::MonotoneCurvature => Verdict::of(laws.monotone, laws.monotone >= MONOTONE),
            Claim::SimilarityInvariant => at_most(laws.invariance.similarity, NONE),
            Claim::Symmetric => {
                at_most(laws.invariance.mirror.max(laws.invariance.direction), NONE)
            }
            Claim::AffineInvariant => at_most(laws.invariance.affine, NONE),
            Claim::Continuity(order) => match laws.continuity() {
                Some(holds) => Verdict::of(f64::from(holds), holds >= order),
                None => Verdict::Unknown,
            },
            Claim::Parameters(count) => {
                Verdict::of(laws.parameters as f64, laws.parameters == usize::from(count))
            }
            Claim::Ripple(factor) => {
                let ripple = laws.locality.ripple;
                Verdict::of(ripple, (ripple - factor).abs() <= RIPPLE)
            }
            Claim::FiniteSupport(segments) => match laws.locality.support {
                Some(support) => Verdict::of(support as f64, support <= usize::from(segments)),
                None => Verdict::Contradicted(f64::MAX),
            },
            Claim::Exists => Verdict::of(laws.share_solved(), laws.share_solved() >= 1.0),
            Claim::Continuous => at_most(laws.moves.jumps, 0.0),
        }
    }
}
