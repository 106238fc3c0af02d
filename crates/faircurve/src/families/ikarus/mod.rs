//! Karow's Ikarus spline: the tangents of cubic Lagrange polynomials, drawn by biarcs (thesis section
//! 4.5).

mod biarc;

use kurbo::Vec2;

use super::catalog::{Claim, ParamKind, ParamSpec, Params, SplineInfo};
use super::lagrange::{Parameter, Piece, pieces};
use super::shapes;
use crate::frame::{circle_tangent, direction};
use crate::outline::Join;
use crate::plan::Run;
use crate::spline::Spline;
use crate::two_param::spline::TwoParamSpline;
use crate::two_param::tangents::{TangentRule, Tangents};

pub use biarc::{Biarc, Biarcs, biarc};

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "ikarus",
    summary: "two arcs a segment, with the tangents of cubics through four knots",
    source: "thesis 4.5",
    params: &[
        ParamSpec {
            name: "end",
            summary: "what holds at free ends: the cubic's tangent, or a last segment that is an arc",
            kind: ParamKind::Choice { options: &["cubic", "arc"] },
        },
        shapes::SHAPE,
    ],
    default_join: Join::G1,
    joins: &[Join::Corner, Join::G1],
    ends: &["cubic", "arc"],
    claims: &[
        Claim::Parameters(2),
        Claim::Continuity(1),
        Claim::MonotoneCurvature,
        Claim::SimilarityInvariant,
        Claim::Symmetric,
        Claim::FiniteSupport(3),
    ],
    build: |params| Ok(build(params)),
};

fn build(params: &Params) -> Box<dyn Spline> {
    let arc_ends = params.choice("end", "cubic") == "arc";
    let shape = shapes::chosen(params, Biarcs);
    Box::new(TwoParamSpline::new(&INFO, IkarusTangents { arc_ends }, shape))
}

/// The rule that a tangent halves the angle between those of the two Lagrange polynomials (by chord
/// length) that meet at its knot.
#[derive(Clone, Copy, Debug)]
pub struct IkarusTangents {
    /// Whether a free end's segment is symmetric; if not, it has the polynomial's tangent.
    pub arc_ends: bool,
}

impl TangentRule for IkarusTangents {
    fn tangents(&self, run: &Run) -> Tangents {
        let n = run.knots.len();
        let pieces = pieces(run, Parameter::ChordLength);
        let directions = (0..n).map(|i| tangent(run, &pieces, i)).collect();
        let mut tangents = Tangents::from_directions(run, directions);
        if self.arc_ends && !run.closed {
            let last = n - 2;
            if run.knots[0].tangent.is_none() {
                let angles = &mut tangents.ends[0].angles;
                angles.theta0 = angles.theta1;
            }
            if run.knots[n - 1].tangent.is_none() {
                let angles = &mut tangents.ends[last].angles;
                angles.theta1 = angles.theta0;
            }
        }
        tangents
    }
}

/// The direction at a knot: between those of the pieces on both sides.
fn tangent(run: &Run, pieces: &[Piece], i: usize) -> f64 {
    /// The sum of two unit vectors that are opposite but for rounding.
    const OPPOSITE: f64 = 1e-12;
    let n = run.knots.len();
    let before = if run.closed { Some((i + n - 1) % n) } else { i.checked_sub(1) };
    let arriving = before.map(|segment| unit(pieces[segment].velocity[1]));
    let leaving = pieces.get(i).map(|piece| unit(piece.velocity[0]));
    let sum = arriving.unwrap_or_default() + leaving.unwrap_or_default();
    if sum.hypot() > OPPOSITE {
        return direction(sum);
    }
    // At a reversal no direction is between: that of the circle through the knot and its
    // neighbours.
    match before {
        Some(before) if i < pieces.len() => {
            let after = run.knots[(i + 1) % n].point;
            circle_tangent(run.knots[before].point, run.knots[i].point, after)
        }
        _ => direction(run.chord(i.min(pieces.len() - 1))),
    }
}

/// The vector of length 1, or 0 where there is no direction.
fn unit(v: Vec2) -> Vec2 {
    let length = v.hypot();
    if length > 0.0 { v / length } else { Vec2::ZERO }
}

#[cfg(test)]
mod tests;
