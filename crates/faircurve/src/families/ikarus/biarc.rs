//! Biarcs: two circular arcs with a common tangent where they meet.

use std::f64::consts::{FRAC_PI_2, PI};

use kurbo::{Point, Vec2};
use num_complex::Complex64;

use crate::frame::ChordAngles;
use crate::numeric::trig::{argument, unit_vector};
use crate::segment::{PolynomialSpiral, Segment};
use crate::two_param::shape::{SegmentEnds, SegmentShape};

/// Biarcs with equal arms.
#[derive(Clone, Copy, Debug)]
pub struct Biarcs;

/// A biarc on the unit chord.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Biarc {
    /// Where the arcs meet.
    pub joint: Complex64,
    /// What each arc turns, in radians.
    pub turning: [f64; 2],
}

/// The biarc with these end tangents.
///
/// All biarcs with the same end tangents but for one parameter, the direction ψ of the joint's
/// tangent. In the control polygon (start, end of its arm, joint, end of the other arm, end), both
/// arms are equal where sin ψ = (sin θ₀ − sin θ₁)/2. Ikarus's own choice isn't published.
///
/// That is for |θ₁ − θ₀| ≤ π/2. Further on, one of the arcs with equal arms would shrink to a cusp
/// (at |θ₁ − θ₀| = π), so that from there ψ goes over, linearly, to (θ₀ − θ₁)/2, which it reaches at π:
/// both arcs then have equal chords, and exist for all angles within half a turn. `None` where both angles
/// are π, or both −π, or one is π and the other −π: such a segment has no biarc.
///
/// ```
/// use faircurve::{families::ikarus::biarc, frame::ChordAngles};
/// // Two halves of one arc.
/// let arc = biarc(ChordAngles::new(0.5, 0.5)).unwrap();
/// assert_eq!(arc.turning, [0.5, 0.5]);
/// ```
pub fn biarc(angles: ChordAngles) -> Option<Biarc> {
    /// Less of a turn from a whole circle isn't told from one.
    const CLOSED: f64 = 1e-8;
    let ChordAngles { theta0, theta1 } = angles;
    let (turning, difference) = (theta0 + theta1, theta1 - theta0);
    // ψ = −difference/2 + off. With c, s for half the turning and C, S for half the difference,
    // sin ψ = −cS and tan off = S·(√(1 − c²S²) − cC)/(C·√(1 − c²S²) + cS²), here without
    // cancellation.
    let Complex64 { re: c, im: s } = unit_vector(turning / 2.0);
    let Complex64 { re: big_c, im: big_s } = unit_vector(difference / 2.0);
    let cos_psi = big_c.hypot(big_s * s);
    let share = (2.0 - difference.abs() / FRAC_PI_2).clamp(0.0, 1.0);
    let sum = cos_psi + c * big_c;
    let rest = if c * big_c > 0.0 { s * s / sum } else { cos_psi - c * big_c };
    let off = share * argument(Complex64::new(big_c * cos_psi + c * big_s * big_s, big_s * rest));
    let arcs = [(3.0 * theta0 - theta1) / 2.0 + off, (3.0 * theta1 - theta0) / 2.0 - off];
    let closes = |arc: f64| !(arc.abs() < 2.0 * PI - CLOSED);
    if closes(turning) || arcs.into_iter().any(closes) {
        return None;
    }
    // The law of sines in the triangle of the three chords.
    let chord = if turning == 0.0 { 0.5 } else { unit_vector(turning / 4.0 + off / 2.0).im / s };
    let joint = unit_vector(arcs[0] / 2.0 - theta0) * chord;
    Some(Biarc { joint, turning: arcs })
}

impl SegmentShape for Biarcs {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        let Some(Biarc { joint, turning }) = biarc(ends.angles) else {
            return Segment::line(start, end);
        };
        let chord = end - start;
        let along = |z: Complex64| {
            start + Vec2::new(z.re * chord.x - z.im * chord.y, z.re * chord.y + z.im * chord.x)
        };
        let joint = along(joint);
        let arc = |from, to, turning| {
            Segment::spiral(from, to, PolynomialSpiral::new([turning, 0.0, 0.0, 0.0]))
        };
        if joint == start || joint == end {
            return Segment::line(start, end);
        }
        Segment::chain([arc(start, joint, turning[0]), arc(joint, end, turning[1])])
    }

    fn keeps_curvature(&self) -> bool {
        false
    }
}
