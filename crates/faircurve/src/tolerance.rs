//! Every inner tolerance, by name, with why it has its value and what happens if it is wrong.
//!
//! They are multiples of the machine epsilon where rounding sets them, and dimensionless: the
//! [plan](crate::plan) brings every contour to unit size.

/// Neighbouring knots closer than this times their largest coordinate are one knot, together with
/// those after them that are as close to the first of them.
///
/// At this distance the direction between them is known to about a hundredth of a radian. Smaller,
/// and the curve follows rounding noise; larger, and details that a designer drew would vanish.
pub const COINCIDENT: f64 = 64.0 * f64::EPSILON;

/// Neighbouring knots closer than this times the drawing's size are one knot, however small their
/// coordinates.
///
/// Nothing can be drawn at such ratios; without it, lengths and energies of the smallest and the
/// largest segment would leave the range of numbers.
pub const INVISIBLE: f64 = 1e-18;

/// A run whose turning angles are all below this, plus what rounding of its coordinates adds, is a
/// straight line.
///
/// Coordinates of collinear knots are rounded, so that angles of a few epsilon appear where none
/// was meant, amplified by the ratio of coordinates to chords ([`COORDINATE_ROUNDING`]).
pub const STRAIGHT: f64 = 16.0 * f64::EPSILON;

/// Coordinates are known to this times their size: a few operations' worth of rounding.
pub const COORDINATE_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Whatever rounding may excuse, a run that turns by more than this isn't straight: the kinks would
/// count against what [`SOLVED`] promises.
pub const NEVER_STRAIGHT: f64 = 0.1 * SOLVED;

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

/// Coordinates beyond this are refused: energies and derivatives of curvature would leave the range
/// of numbers.
pub const LARGEST_COORDINATE: f64 = 1e55;

/// Drawings smaller than this are refused, for the same reason.
pub const SMALLEST_SIZE: f64 = 1e-55;

/// Given curvatures larger than this over the contour's size are refused: no curve has them, and their
/// products with lengths would leave the range of numbers.
pub const LARGEST_CURVATURE: f64 = 1e60;
