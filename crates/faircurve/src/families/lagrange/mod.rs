//! The cubic Lagrange spline: each segment is the middle of the cubic through four knots (thesis
//! section 4.4).

use std::sync::Arc;

use kurbo::{CubicBez, PathSeg, Point, QuadBez, Vec2};

use super::catalog::{Claim, ParamKind, ParamSpec, SplineInfo};
use crate::frame::wrap_angle;
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::{Measured, Segment, UnitBezier};
use crate::spline::{Effort, Place, Relaxation, RunSolution, Spline};
use crate::tolerance::SOLVED;
use crate::two_param::tangents::ignored_curvature;

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "lagrange",
    summary: "cubics through four knots each, which meet in corners",
    source: "thesis 4.4",
    params: &[ParamSpec {
        name: "parameter",
        summary: "how far apart the knots are in the cubics' parameter: by their distance, or evenly",
        kind: ParamKind::Choice { options: &["chord-length", "uniform"] },
    }],
    default_join: Join::Corner,
    joins: &[Join::Corner, Join::G1],
    ends: &["cubic"],
    claims: &[
        Claim::Parameters(4),
        Claim::Continuity(0),
        Claim::RoundToOrder(4),
        Claim::SimilarityInvariant,
        Claim::Symmetric,
        Claim::FiniteSupport(2),
        Claim::Exists,
    ],
    build: |params| {
        Ok(Box::new(Lagrange {
            parameter: match params.choice("parameter", "chord-length") {
                "uniform" => Parameter::Uniform,
                _ => Parameter::ChordLength,
            },
        }))
    },
};

/// The values of the cubics' parameter at the knots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// As far apart as the knots.
    ChordLength,
    /// 0, 1, 2, …
    Uniform,
}

/// The cubic Lagrange spline.
#[derive(Clone, Copy, Debug)]
pub struct Lagrange {
    /// The parameter at the knots.
    pub parameter: Parameter,
}

impl Spline for Lagrange {
    fn name(&self) -> &'static str {
        INFO.name
    }

    fn default_join(&self) -> Join {
        INFO.default_join
    }

    fn adapt(&self, join: Join) -> Join {
        match join {
            Join::Corner | Join::G1 => join,
            _ => Join::Corner,
        }
    }

    fn solve_plainly(&self, run: &Run) -> Option<RunSolution> {
        Some(self.solve_run(run, Effort::NONE))
    }

    fn solve_run(&self, run: &Run, _effort: Effort) -> RunSolution {
        let n = run.knots.len();
        let pieces = pieces(run, self.parameter);
        let points = |i: usize| (run.knots[i].point, run.knots[(i + 1) % n].point);
        let segments: Vec<Segment> =
            pieces.iter().enumerate().map(|(i, piece)| piece.place(points(i))).collect();
        let (first, last) = (&segments[0], &segments[segments.len() - 1]);
        let ends = [(0, first.direction(0.0)), (n - 1, last.direction(last.length()))];
        let mut residual = 0.0f64;
        let mut relaxed = Vec::new();
        for (knot, direction) in ends {
            let off = |tangent: f64| wrap_angle(direction - tangent).abs();
            let off = run.knots[knot].tangent.map_or(0.0, off);
            if off <= SOLVED {
                residual = residual.max(off);
            } else {
                relaxed.push(free_end(knot));
            }
        }
        let adapted =
            (0..n).filter(|&i| run.knots[i].curvature.is_some()).map(ignored_curvature).collect();
        RunSolution { segments, relaxed, adapted, residual, ..RunSolution::default() }
    }
}

/// An end whose given direction is lost in rounding, beside chords in absurd ratios.
fn free_end(knot: usize) -> Relaxation {
    Relaxation {
        place: Place::Knot(knot),
        asked: "tangent",
        got: "free",
        reason: "the cubic here is so much longer than the segment that rounding turns its end; \
                 move a knot, or leave the direction out"
            .to_owned(),
    }
}

/// One segment of the spline: a polynomial by a parameter from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// Velocities at start and end.
    pub velocity: [Vec2; 2],
    /// 3, or less where there are fewer than four knots and given tangents.
    pub degree: usize,
}

impl Piece {
    /// The piece between its end points, as a Bézier.
    fn place(&self, (start, end): (Point, Point)) -> Segment {
        let chord = end - start;
        // Division by the chord, as complex numbers: onto the unit chord.
        let onto = chord / chord.hypot2();
        let unit = |v: Vec2| Vec2::new(v.dot(onto), onto.cross(v));
        let [start_velocity, end_velocity] = self.velocity.map(unit);
        let (from, to) = (Point::ORIGIN, Point::new(1.0, 0.0));
        let bezier = match self.degree {
            0 | 1 => return Segment::line(start, end),
            2 => PathSeg::Quad(QuadBez::new(from, from + start_velocity / 2.0, to)),
            _ => {
                let (p1, p2) = (from + start_velocity / 3.0, to - end_velocity / 3.0);
                PathSeg::Cubic(CubicBez::new(from, p1, p2, to))
            }
        };
        Segment::unit_curve(start, end, Arc::new(Measured::new(UnitBezier::new(bezier))))
    }
}

/// The segments of a run (eq. 4.4). At an end with a given tangent the cubic passes in that
/// direction, by the parameter's unit of length, as if through one more knot infinitely near.
pub(super) fn pieces(run: &Run, parameter: Parameter) -> Vec<Piece> {
    let nodes = Nodes::of(run, parameter);
    let count = nodes.gaps.len();
    if run.closed {
        return (0..count)
            .map(|i| {
                let around = [(i + count - 1) % count, i, (i + 1) % count];
                piece(&around.map(|j| nodes.gaps[j]), &around.map(|j| nodes.slopes[j]), 1)
            })
            .collect();
    }
    let first = usize::from(run.knots[0].tangent.is_some());
    (first..first + run.segment_count())
        .map(|i| {
            // The three gaps around, as far as there are so many.
            let from = i.saturating_sub(1).min(count.saturating_sub(3));
            let to = (from + 3).min(count);
            piece(&nodes.gaps[from..to], &nodes.slopes[from..to], i - from)
        })
        .collect()
}

/// The knots of a run as nodes of interpolation.
struct Nodes {
    /// How far the parameter goes from each node to the next; 0 between a knot and a given tangent.
    gaps: Vec<f64>,
    /// Divided differences: chords over gaps, or given velocities.
    slopes: Vec<Vec2>,
}

impl Nodes {
    fn of(run: &Run, parameter: Parameter) -> Nodes {
        let chords: Vec<Vec2> = (0..run.segment_count()).map(|i| run.chord(i)).collect();
        let gap = |chord: &Vec2| match parameter {
            Parameter::ChordLength => chord.hypot(),
            Parameter::Uniform => 1.0,
        };
        let mut gaps: Vec<f64> = chords.iter().map(gap).collect();
        let mut slopes: Vec<Vec2> = chords.iter().map(|chord| *chord / gap(chord)).collect();
        if !run.closed {
            let last = run.knots.len() - 1;
            if let Some(tangent) = run.knots[last].tangent {
                slopes.push(Vec2::from_angle(tangent) * slopes[last - 1].hypot());
                gaps.push(0.0);
            }
            if let Some(tangent) = run.knots[0].tangent {
                slopes.insert(0, Vec2::from_angle(tangent) * slopes[0].hypot());
                gaps.insert(0, 0.0);
            }
        }
        Nodes { gaps, slopes }
    }
}

/// The piece between nodes `m` and `m + 1` of the polynomial through two, three or four nodes, by
/// Newton's divided differences.
fn piece(gaps: &[f64], slopes: &[Vec2], m: usize) -> Piece {
    let degree = gaps.len();
    let (h, slope) = (gaps[m], slopes[m]);
    let second = |j: usize| (slopes[j + 1] - slopes[j]) / (gaps[j] + gaps[j + 1]);
    // With the nodes in the order m, m + 1, k, the polynomial's velocity at the first two is
    // slope ∓ h·(second difference) ∓ h·(node − node k)·(third difference).
    let (quadratic, from_k) = match (degree, m) {
        (1, _) => (Vec2::ZERO, [0.0; 2]),
        (_, 0) => (second(0), [-(h + gaps[1]), -gaps[1]]),
        (_, m) => (second(m - 1), [gaps[m - 1], h + gaps[m - 1]]),
    };
    let cubic = match degree {
        3 => (second(1) - second(0)) / (gaps[0] + gaps[1] + gaps[2]),
        _ => Vec2::ZERO,
    };
    let velocity =
        |sign: f64, from_k: f64| (slope + (quadratic * h + cubic * (h * from_k)) * sign) * h;
    // A given velocity is kept to the bit.
    let given = |j: Option<usize>| j.filter(|&j| gaps.get(j) == Some(&0.0)).map(|j| slopes[j] * h);
    let start = given(m.checked_sub(1)).unwrap_or_else(|| velocity(-1.0, from_k[0]));
    let end = given(Some(m + 1)).unwrap_or_else(|| velocity(1.0, from_k[1]));
    Piece { velocity: [start, end], degree }
}

#[cfg(test)]
mod tests;
