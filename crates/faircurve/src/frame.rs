//! Signs and frames: the only file that decides them.
//!
//! Everything is y-up; directions are radians counterclockwise from +x; curvature is dθ/ds, so
//! that a counterclockwise circle has positive curvature. A segment's *chord frame* has its start
//! at the origin and its end on the positive x axis.
//!
//! The thesis measures end tangents from the chord so that both are positive for the same arc
//! (eq. 8.19–8.20): `theta0 = chord − start direction`, `theta1 = end direction − chord`. An arc that turns
//! counterclockwise lies below its chord, leaves it clockwise by `theta0` and arrives
//! counterclockwise by `theta1`; their sum is the turning. At a knot with turning angle t between
//! the chords, both sides have the same tangent when `theta1` of the left plus `theta0` of the right is t.

use std::f64::consts::{PI, TAU};

use kurbo::{Point, Vec2};
use num_complex::Complex64;

use crate::numeric::trig::argument;

/// End tangents of a segment relative to its chord, in radians (eq. 8.19–8.20).
///
/// Both are positive for an arc that turns counterclockwise. Hobby's convention (eq. 4.11) is
/// the mirror image.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ChordAngles {
    /// Chord direction minus start direction: clockwise positive.
    pub theta0: f64,
    /// End direction minus chord direction: counterclockwise positive.
    pub theta1: f64,
}

impl ChordAngles {
    /// The pair (`theta0`, `theta1`).
    pub const fn new(theta0: f64, theta1: f64) -> Self {
        ChordAngles { theta0, theta1 }
    }

    /// The angles of a segment that starts and ends in these directions, unwrapped as given.
    pub fn from_directions(start: f64, chord: f64, end: f64) -> Self {
        ChordAngles { theta0: wrap_angle(chord - start), theta1: wrap_angle(end - chord) }
    }

    /// The turning from start to end.
    pub fn turning(self) -> f64 {
        self.theta0 + self.theta1
    }

    /// Direction of the start, given the chord's.
    pub fn start_direction(self, chord: f64) -> f64 {
        chord - self.theta0
    }

    /// Direction of the end, given the chord's.
    pub fn end_direction(self, chord: f64) -> f64 {
        chord + self.theta1
    }

    /// The angles of the same segment travelled backwards.
    pub fn reversed(self) -> Self {
        ChordAngles { theta0: -self.theta1, theta1: -self.theta0 }
    }

    /// The angles of the mirror image.
    pub fn mirrored(self) -> Self {
        ChordAngles { theta0: -self.theta0, theta1: -self.theta1 }
    }
}

/// Curvature at a segment's end for unit chord, as a fraction, so that a cusp (den = 0) is finite
/// (Bespoke section 2).
///
/// `den` is d·|d| with d the signed speed along the tangent, so that it is negative where the
/// segment travels backwards; families without cusps have `den` = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndCurvature {
    /// Numerator.
    pub num: f64,
    /// Denominator, with the sign of the direction of travel.
    pub den: f64,
}

impl EndCurvature {
    /// A finite curvature of a segment that travels forwards.
    pub const fn finite(curvature: f64) -> Self {
        EndCurvature { num: curvature, den: 1.0 }
    }
}

/// The angle in (−π, π] that differs by whole turns.
///
/// Exact for angles already there; NaN and infinities give NaN.
pub fn wrap_angle(angle: f64) -> f64 {
    if angle > -PI && angle <= PI {
        return angle;
    }
    let wrapped = angle - TAU * (angle / TAU).round();
    // Beside odd multiples of π, rounding decides to which side of them.
    if wrapped <= -PI {
        wrapped + TAU
    } else if wrapped > PI {
        wrapped - TAU
    } else {
        wrapped
    }
}

/// The direction of a vector in radians, in (−π, π].
#[inline(never)] // for the size of the web's module
pub fn direction(vector: Vec2) -> f64 {
    one_half_turn(argument(Complex64::new(vector.x, vector.y)))
}

/// −π from a negative zero is the same direction as π; one of them must be the answer.
fn one_half_turn(angle: f64) -> f64 {
    if angle == -PI { PI } else { angle }
}

/// The turning angle from one vector to another, in (−π, π], without the cancellation of
/// subtracting two directions.
#[inline(never)] // for the size of the web's module
pub fn turning(from: Vec2, to: Vec2) -> f64 {
    one_half_turn(argument(Complex64::new(from.dot(to), from.cross(to))))
}

/// The direction of a chord from that of the middle of its arc, made odd: half a turn, as of an arc of a circle
/// that turns more than once, is on the side to which the middle bends.
pub(crate) fn chord_direction(direction: f64, curvature: f64) -> f64 {
    if direction.abs() == PI { PI.copysign(curvature) } else { direction }
}

/// The tangent direction at `middle` of the circle through three points (of the straight line, if
/// they are collinear); thesis section 4.10.
pub fn circle_tangent(before: Point, middle: Point, after: Point) -> f64 {
    direction(along_circle(before, middle, after))
}

/// A vector in that direction.
pub(crate) fn along_circle(before: Point, middle: Point, after: Point) -> Vec2 {
    let (incoming, outgoing) = (middle - before, after - middle);
    // The inscribed-angle theorem: theta1 of the incoming chord is half the arc over it, and the
    // half arcs of both chords sum to the turning angle. In complex numbers, with both chords
    // inverted at the knot, the tangent is a sum free of cases.
    let tangent = incoming / incoming.hypot2() + outgoing / outgoing.hypot2();
    if tangent.hypot2() > 0.0 && tangent.is_finite() {
        tangent
    } else {
        // A hairpin that returns to where it came from: any perpendicular will do.
        Vec2::new(-incoming.y, incoming.x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_has_positive_angles_and_lies_below_its_chord() {
        // Counterclockwise from (0, 0) over (1, −1) to (2, 0): starts down, ends up.
        let angles = ChordAngles::from_directions(-PI / 2.0, 0.0, PI / 2.0);
        assert_eq!(angles, ChordAngles::new(PI / 2.0, PI / 2.0));
        assert_eq!(angles.turning(), PI);
        assert_eq!(angles.reversed(), angles.mirrored());
    }

    #[test]
    fn circle_tangents_are_perpendicular_to_the_radius() {
        for (a, b, c) in [(0.1, 0.9, 2.0), (-1.0, 0.3, 0.4), (0.0, 3.0, 6.0), (5.0, 4.0, 1.0)] {
            let on_circle = |t: f64| Point::new(3.0 + t.cos(), 1.0 + t.sin());
            let tangent = circle_tangent(on_circle(a), on_circle(b), on_circle(c));
            let sense = if b > a { 1.0 } else { -1.0 };
            let expected = b + sense * PI / 2.0;
            assert!(wrap_angle(tangent - expected).abs() < 1e-14, "{tangent} {expected}");
        }
    }

    #[test]
    fn wrapping_keeps_the_upper_end() {
        assert_eq!(wrap_angle(PI), PI);
        assert_eq!(wrap_angle(-PI), PI);
        assert!((wrap_angle(7.0) - (7.0 - TAU)).abs() < 1e-15);
        assert!(wrap_angle(f64::INFINITY).is_nan());
        // Found by fuzzing: 8 last places beyond π.
        for odd in (1..20_001).step_by(2) {
            let mut angle = f64::from(odd) * PI * (1.0 - 1e-15);
            for _ in 0..20 {
                for angle in [angle, -angle] {
                    let wrapped = wrap_angle(angle);
                    assert!(wrapped > -PI && wrapped <= PI, "{angle}: {wrapped}");
                }
                angle = angle.next_up();
            }
        }
    }
}
