//! Akima's curve: each knot takes its direction from the four chords around it (H. Akima, *A new
//! method of interpolation and smooth curve fitting based on local procedures*, J. ACM 17, 1970).

use std::sync::Arc;

use kurbo::{Point, Vec2};

use super::catalog::{Claim, SplineInfo};
use super::shapes;
use crate::frame::{circle_tangent, direction};
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::{Measured, Segment, UnitBezier};
use crate::two_param::shape::{SegmentEnds, SegmentShape};
use crate::two_param::spline::TwoParamSpline;
use crate::two_param::tangents::{TangentRule, Tangents};

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "akima",
    summary: "cubics with arms of a third of the chord; tangents from the four chords around a knot",
    source: "Akima 1970",
    params: &[shapes::SHAPE],
    default_join: Join::G1,
    joins: &[Join::Corner, Join::G1],
    ends: &["parabola"],
    claims: &[
        Claim::Parameters(2),
        Claim::Continuity(1),
        Claim::SimilarityInvariant,
        Claim::Symmetric,
        Claim::FiniteSupport(3),
    ],
    build: |params| {
        let shape = shapes::chosen(params, ChordCubics);
        Ok(Box::new(TwoParamSpline::new(&INFO, AkimaTangents, shape)))
    },
};

/// The rule that a knot's tangent lies between its two chords, nearer to the one whose own
/// neighbours line up with it.
#[derive(Clone, Copy, Debug)]
pub struct AkimaTangents;

impl TangentRule for AkimaTangents {
    fn tangents(&self, run: &Run) -> Tangents {
        let n = run.knots.len();
        let directions = (0..n).map(|i| tangent(run, i)).collect();
        Tangents::from_directions(run, directions)
    }
}

/// With chords a, b before a knot and c, d after it: |c × d|·b + |a × b|·c. Beyond a free end chords go
/// on as along a parabola: each differs from the one before as that did from its own.
fn tangent(run: &Run, i: usize) -> f64 {
    let count = run.segment_count() as isize;
    let chord = |j: isize| -> Vec2 {
        if run.closed {
            run.chord(j.rem_euclid(count) as usize)
        } else if j < 0 {
            let (first, second) = (run.chord(0), run.chord(1.min(count as usize - 1)));
            first + (first - second) * -(j as f64)
        } else if j >= count {
            let last = count as usize - 1;
            let (last, before) = (run.chord(last), run.chord(last.saturating_sub(1)));
            last + (last - before) * (j - count + 1) as f64
        } else {
            run.chord(j as usize)
        }
    };
    let at = i as isize;
    let [a, b, c, d] = [at - 2, at - 1, at, at + 1].map(chord);
    let (before, after) = (c.cross(d).abs(), a.cross(b).abs());
    let sum = before + after;
    // Where both sides are straight, either chord is as good (Akima takes the mean).
    let (before, after) = if sum > 0.0 { (before / sum, after / sum) } else { (0.5, 0.5) };
    let tangent = b * before + c * after;
    if tangent.hypot2() > 1e-30 * (b.hypot2() + c.hypot2()) {
        direction(tangent)
    } else {
        // The curve turns back: any perpendicular will do.
        circle_tangent(Point::ZERO - b, Point::ZERO, c.to_point())
    }
}

/// Cubics whose arms are a third of the chord.
#[derive(Clone, Copy, Debug)]
pub struct ChordCubics;

impl SegmentShape for ChordCubics {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        let (from, to) = (-ends.angles.theta0, ends.angles.theta1);
        let cubic = UnitBezier::from_arms(from, to, [1.0 / 3.0; 2]);
        Segment::unit_curve(start, end, Arc::new(Measured::new(cubic)))
    }

    fn keeps_curvature(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests;
