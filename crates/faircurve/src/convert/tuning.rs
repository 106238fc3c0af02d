//! Constants that were chosen by trial: on the six curves of `gauntlet bezier`, random ones and fonts.
//!
//! They trade numbers of cubics for time. None touches the certificate: with others, results are as near as they say.

// One cubic (`minimax`, `contact`, `single`, `fitter`).

/// Contacts whose |E₆| is beyond the best by more than this factor aren't tried: higher terms don't change a
/// deviation by so much on the pieces that a conversion ends up with.
pub(super) const WORTH_TRYING: f64 = 4.0;

/// Radians. Pieces that turn by more are too long for the expansion to be trusted alone.
pub(super) const LONG: f64 = 1.5;

/// y² up to which complex roots p ± iy of the equation for α are tried: half a unit of α in y, half of what real
/// roots differ by where there are three good ones. Larger values try more in vain; smaller ones lose local minima of long pieces.
pub(super) const NEARLY_REAL: f64 = 0.25;

/// Rounds of the exchange for a start by contact, where one or two are enough, and for a cruder one.
pub(super) const CONTACT_ROUNDS: usize = 3;
pub(super) const CRUDE_ROUNDS: usize = 8;

/// Of one round; each raises the level. On ordinary pieces two or three are enough.
pub(super) const MOST_EXCHANGES: usize = 12;

/// A deviation within this factor of the best that the exchange promises is good enough: the cuts
/// lose a sixth of it in length.
pub(super) const GOOD_ENOUGH: f64 = 1.01;

/// Pieces shorter than this part of a stretch that have no cubic with their end curvatures get the best one without.
pub(super) const SHORT: f64 = 1e-3;

/// Cubics that are so many times farther off than allowed, which only the shortest pieces may be, get a cheap bound.
pub(super) const HOPELESS: f64 = 8.0;

/// Arms with which a cubic is within this part of the accuracy are left as they are: nobody sees what is ten times as near
/// as asked, and most segments of a drawing with many knots are one cubic with room to spare.
pub(super) const PLAIN_ARMS: f64 = 0.1;

/// But only where it is also within this part of half the piece: however coarse an accuracy is, what is drawn is to look the
/// same at every scale.
pub(super) const UNSEEN: f64 = 5e-4;

/// Likewise a bound within this part of the accuracy is left as a sum of absolute values, which is some 1.4 times the truth.
pub(super) const PLAIN_BOUND: f64 = 0.25;

// The greedy search (`cuts`); parts of the accuracy.

/// What it aims at: estimates are within this of what they estimate, in the typical case. Closer, and
/// the certificate rejects more of them; farther, and cubics get shorter by a sixth of the difference.
pub(super) const AIM: f64 = 0.99;

/// An estimate up to this is tried on the certificate.
pub(super) const FITS: f64 = 0.998;

/// One above this is good enough: at the sixth order the cubic is within half a percent of the longest.
pub(super) const CLOSE: f64 = 0.965;

/// How near the sixth-order law's prediction need be: it is itself good to a percent or two, where it is good at all.
pub(super) const LAW_IS_CLOSE: f64 = 0.03;

/// The law grows with the sixth power of the length less what E₆ loses; faster than this power, and no zero of E₆ is near.
pub(super) const NO_ZERO_NEAR: f64 = 5.0;

// Joints beside the curve (`free_joints`).

/// Their offset, as a part of the accuracy: what the deviation between may be, less what the certificate is too large by.
pub(super) const LARGEST_OFFSET: f64 = 0.985;

/// Turn of the tangent of joints on the curve, in largest offsets for half the length of a cubic. T₆ crosses zero
/// with 21; a deviation whose E₆ vanishes there, too, is flatter. From 11 to 15 the numbers differ by less than a percent.
pub(super) const SLOPE: f64 = 13.0;

/// Radians. Where cubics are hardly longer than the accuracy, turned tangents would show.
pub(super) const MOST_TURN: f64 = 0.05;

/// Joints farther behind the farthest than this part of a cubic are given up: the most that a joint's offset and turn are worth
/// is 0.06 of it. Twice this saves half a percent more for half as much time again.
pub(super) const BEHIND: f64 = 0.1;
