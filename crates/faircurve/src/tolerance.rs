//! Every inner tolerance, by name, with why it has its value and what happens if it is wrong.
//!
//! They are multiples of the machine epsilon where rounding sets them, and dimensionless: the
//! [plan](crate::plan) brings every contour to unit size.

/// Neighbouring knots closer than this times the largest coordinate are one knot.
///
/// At this distance the direction between them is known to about a hundredth of a radian. Smaller,
/// and the curve follows rounding noise; larger, and details that a designer drew would vanish.
pub const COINCIDENT: f64 = 64.0 * f64::EPSILON;

/// A run whose turning angles are all below this is a straight line.
///
/// Coordinates of collinear knots are rounded, so that angles of a few epsilon appear where none
/// was meant, amplified by the ratio of the drawing's size to the chord (which the plan takes into
/// account).
pub const STRAIGHT: f64 = 16.0 * f64::EPSILON;

/// A solution counts as solved when its residual (see
/// [`SolveReport::residual`](crate::SolveReport::residual)) is at most this.
///
/// Newton's method ends near 1e-14; the room above it is for extreme chord ratios. At 1e-9 a jump
/// of direction moves no point of a font by more than a millionth of a unit.
pub const SOLVED: f64 = 1e-9;

/// A segment longer than this times its chord is a loop: worth avoiding where another solution
/// does.
///
/// Half a circle is 1.57 chords long, three quarters of one 3.33: designers draw those on purpose.
pub const LOOP: f64 = 4.0;

/// Coordinates beyond this are refused: energies of the result would leave the range of numbers.
pub const LARGEST_COORDINATE: f64 = 1e90;

/// Drawings smaller than this are refused, for the same reason.
pub const SMALLEST_SIZE: f64 = 1e-90;
