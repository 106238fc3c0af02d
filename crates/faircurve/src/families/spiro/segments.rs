//! Polynomial spirals as a shape for any curvature map: "with such a family, any curvature map can
//! be accommodated" (Bespoke section 2).

use kurbo::Point;

use super::PolynomialSpirals;
use super::hermite::between_ends;
use crate::families::euler::{EulerSpirals, fit_euler};
use crate::four_param::family::FourParamFamily;
use crate::frame::{ChordAngles, EndCurvature, wrap_angle};
use crate::segment::{PolynomialSpiral, Segment};
use crate::tolerance::LOOP;
use crate::two_param::shape::{SegmentEnds, SegmentShape, StandIn};

/// Segments with the tangents *and* the curvatures that a curvature map assigns to their ends; Euler
/// spirals where the rule for tangents knows nothing of curvature.
///
/// Where no polynomial spiral worth drawing has such ends, the spline's own shape stands in.
#[derive(Clone, Copy, Debug)]
pub struct SpiroSegments<S> {
    /// The shape that belongs to the spline.
    pub own: S,
}

impl<S: SegmentShape> SegmentShape for SpiroSegments<S> {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        self.place_or_stand_in(start, end, ends).0
    }

    fn place_or_stand_in(
        &self,
        start: Point,
        end: Point,
        ends: &SegmentEnds,
    ) -> (Segment, Option<StandIn>) {
        let Some(curvatures) = ends.curvatures else {
            return EulerSpirals.place_or_stand_in(start, end, ends);
        };
        let is_forward = |end: EndCurvature| end.den > 0.0;
        let fit = match curvatures {
            [a, b] if is_forward(a) && is_forward(b) => {
                fit_spiral(ends.angles, [a.num / a.den, b.num / b.den])
            }
            _ => None,
        };
        if let Some(spiral) = fit {
            return (Segment::spiral(start, end, spiral), None);
        }
        let (segment, further) = self.own.place_or_stand_in(start, end, ends);
        let stand_in = StandIn {
            asked: "spiro",
            got: further.map_or("own", |further| further.got),
            reason: "no polynomial spiral has the tangents and the curvatures that the segment has \
                     at its ends; move a knot, or add one where the curve turns most",
        };
        (segment, Some(stand_in))
    }

    fn keeps_curvature(&self) -> bool {
        true
    }
}

/// The polynomial spiral with these end tangents and end curvatures, for unit chord: that to
/// which Newton's method leads from the Euler spiral with the tangents, or else the straightest.
///
/// The ends are met to about 1e-13 and to 1e-13 of the curvatures. `None` where none was found that
/// is shorter than [`LOOP`] times that Euler spiral; for curvatures beyond some ten, there seldom is.
///
/// ```
/// use faircurve::{families::spiro::fit_spiral, frame::ChordAngles};
/// let arc = fit_spiral(ChordAngles::new(0.5, 0.5), [2.0 * 0.5f64.sin(); 2]).unwrap();
/// assert!((arc.k[0] - 1.0).abs() < 1e-14 && arc.k[1..].iter().all(|k| k.abs() < 1e-12));
/// ```
pub fn fit_spiral(angles: ChordAngles, curvatures: [f64; 2]) -> Option<PolynomialSpiral> {
    let ends = [angles.theta0, angles.theta1, curvatures[0], curvatures[1]];
    if !ends.iter().all(|number| number.is_finite()) {
        return None;
    }
    let euler = fit_euler(angles).ok()?;
    let least = euler.chord().length / LOOP;
    let close_by = refined(euler.k, ends, least);
    let k = close_by
        .or_else(|| between_ends(ends).into_iter().find_map(|k| refined(k, ends, least)))?;
    Some(PolynomialSpiral::new(k))
}

/// Newton's method for k₀ … k₃, with the response of the four-parameter solver. `None` where it
/// doesn't converge, or chord over arc ends below `least`.
fn refined(mut k: [f64; 4], ends: [f64; 4], least: f64) -> Option<[f64; 4]> {
    const MOST_STEPS: usize = 24;
    /// Radians that a step may bend the segment.
    const MOST_BEND: f64 = 1.0;
    /// The ends are met to this, times 1 + |curvature|.
    const CLOSE: f64 = 1e-12;
    let scale = 1.0 + ends[2].abs().max(ends[3].abs());
    let mut best: Option<(f64, [f64; 4], f64)> = None;
    let mut waited = 0;
    for _ in 0..MOST_STEPS {
        let response = PolynomialSpirals.respond(k);
        let mut off: [f64; 4] = std::array::from_fn(|i| ends[i] - response.ends.jets[i]);
        (off[0], off[1]) = (wrap_angle(off[0]), wrap_angle(off[1]));
        let missed = off[0].abs().max(off[1].abs()).max(off[2].abs().max(off[3].abs()) / scale);
        if missed.is_nan() {
            break;
        }
        waited = if best.is_none_or(|(least, ..)| missed < 0.5 * least) { 0 } else { waited + 1 };
        if best.is_none_or(|(least, ..)| missed < least) {
            best = Some((missed, k, response.ends.straightness));
        }
        // What stops falling close to the end has met its rounding.
        if missed <= f64::EPSILON || waited > if missed < CLOSE { 0 } else { 6 } {
            break;
        }
        let step: [f64; 4] = std::array::from_fn(|row| {
            (0..4).map(|jet| response.parameters_by_jets[row][jet] * off[jet]).sum()
        });
        let share = (MOST_BEND / PolynomialSpirals.bend(step)).min(1.0);
        k = std::array::from_fn(|i| k[i] + share * step[i]);
    }
    let (missed, k, straightness) = best?;
    (missed <= CLOSE && straightness >= least).then_some(k)
}
