//! Potrace's cubics as a shape: both arms are the same part of the way to where the tangents meet
//! (end of thesis section 4.7).

use std::sync::Arc;

use kurbo::Point;
use num_complex::Complex64;

use crate::frame::ChordAngles;
use crate::numeric::trig::unit_vector;
use crate::segment::{Measured, Segment, UnitBezier};
use crate::two_param::shape::{SegmentEnds, SegmentShape};

/// Potrace's cubics.
#[derive(Clone, Copy, Debug)]
pub struct PotraceCubics;

impl SegmentShape for PotraceCubics {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        let ChordAngles { theta0, theta1 } = ends.angles;
        let cubic = UnitBezier::from_arms(-theta0, theta1, potrace_arms(ends.angles));
        Segment::unit_curve(start, end, Arc::new(Measured::new(cubic)))
    }

    fn keeps_curvature(&self) -> bool {
        false
    }
}

/// Lengths of the arms for unit chord: α times the distances from the ends to where the tangents
/// meet.
///
/// Potrace leaves α, which is the same for both arms, to what it traces. Here it is that of the best
/// known cubic for a circular arc of the same turning T, whose middle lies on the arc:
/// α = (4/3)·tan(T/4)/tan(T/2). In the products with the distances the poles at T = π, where the
/// tangents are parallel, cancel: the arms are (1 + t²)²/(6t) times the sines of the other ends'
/// angles, t = tan(T/4).
///
/// Where the tangents meet behind an end, the family has no segment. Beyond half a turn the same
/// formula goes on; a segment that bends both ways has the arms of the one that bends once by the
/// same angles. Arms are at least 0.1, since an arm of length 0 would lose its tangent, and at most 4,
/// as METAFONT's are, since at two whole half turns they are infinite. 0.1 is a choice: smaller, and
/// unequal angles make a sharper bend at the end; larger, and more segments aren't Potrace's.
pub fn potrace_arms(angles: ChordAngles) -> [f64; 2] {
    const SHORTEST: f64 = 0.1;
    const LONGEST: f64 = 4.0;
    let ChordAngles { theta0, theta1 } = angles;
    let Complex64 { re: cos, im: sin } = unit_vector((theta0.abs() + theta1.abs()) / 4.0);
    // (1 + t²)²/t = 1/(sin cos³).
    let six = 6.0 * sin * (cos * cos * cos).max(f64::MIN_POSITIVE);
    [theta1, theta0].map(|opposite| {
        // Of straight segments, any arm will do.
        let arm = if sin == 0.0 { 1.0 / 3.0 } else { unit_vector(opposite.abs()).im / six };
        arm.clamp(SHORTEST, LONGEST)
    })
}

#[cfg(test)]
mod tests;
