//! The spline of a rule for tangents and a shape for segments.

use super::shape::SegmentShape;
use super::tangents::{TangentRule, Tangents};
use crate::catalog::SplineInfo;
use crate::frame::wrap_angle;
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::Segment;
use crate::spline::{Effort, Place, Relaxation, RunSolution, Spline};
use crate::tolerance::SOLVED;

/// A two-parameter spline: tangents by a rule, segments of a shape.
#[derive(Clone, Copy, Debug)]
pub struct TwoParamSpline<R, S> {
    info: &'static SplineInfo,
    rule: R,
    shape: S,
}

impl<R: TangentRule, S: SegmentShape> TwoParamSpline<R, S> {
    /// The catalogue's spline of that row.
    pub fn new(info: &'static SplineInfo, rule: R, shape: S) -> Self {
        TwoParamSpline { info, rule, shape }
    }

    fn draw(&self, run: &Run, tangents: Tangents) -> RunSolution {
        let n = run.knots.len();
        let segments: Vec<Segment> = tangents
            .ends
            .iter()
            .enumerate()
            .map(|(i, ends)| {
                let (start, end) = (run.knots[i].point, run.knots[(i + 1) % n].point);
                self.shape.place(start, end, ends)
            })
            .collect();
        let off = directions_off(run, &segments);
        let mut residual = off.iter().copied().fold(tangents.residual(), f64::max);
        if self.keeps_curvature() {
            residual = residual.max(largest_jump(run, &segments, jump_of_curvature));
        }
        let unmet = |i: &usize| !(tangents.mismatch[*i] <= SOLVED);
        let broken = (0..n).filter(|&i| off[i] > SOLVED).map(|i| broken(run, i));
        let relaxed = broken.chain((0..n).filter(unmet).map(|i| self.unmet(i))).collect();
        let (adapted, iterations) = (tangents.adapted, tangents.iterations);
        RunSolution { segments, relaxed, adapted, iterations, residual, ..RunSolution::default() }
    }

    fn keeps_curvature(&self) -> bool {
        self.info.continuity() >= 2 && self.shape.keeps_curvature()
    }

    /// A knot whose equation isn't met; its tangent is continuous all the same.
    fn unmet(&self, knot: usize) -> Relaxation {
        Relaxation {
            place: Place::Knot(knot),
            asked: self.default_join().name(),
            got: Join::G1.name(),
            reason: "the curve can't have the same curvature on both sides of this knot; \
                     move it or a neighbour, or add a knot where the curve turns most"
                .to_owned(),
        }
    }
}

/// A knot at which the shape has no segment with the tangent found, or given.
fn broken(run: &Run, knot: usize) -> Relaxation {
    let (asked, got) = match run.knots[knot].join {
        Join::Corner => ("tangent", "free"),
        join => (join.name(), Join::Corner.name()),
    };
    let reason = "no segment of this shape leaves and arrives in such directions; \
                  add a knot, or give another tangent";
    Relaxation { place: Place::Knot(knot), asked, got, reason: reason.to_owned() }
}

/// How far the directions of the segments at each knot differ, or at the ends of an open run that
/// of the segment from the one given, in radians.
fn directions_off(run: &Run, segments: &[Segment]) -> Vec<f64> {
    let n = run.knots.len();
    let given = |i: usize, direction: f64| {
        run.knots[i].tangent.map_or(0.0, |tangent| wrap_angle(direction - tangent).abs())
    };
    (0..n)
        .map(|i| match (run.closed, i) {
            (false, 0) => given(0, segments[0].direction(0.0)),
            (false, i) if i == n - 1 => {
                given(i, segments[i - 1].direction(segments[i - 1].length()))
            }
            _ => jump_of_direction(&segments[(i + n - 1) % n], &segments[i]),
        })
        .collect()
}

/// The largest jump of something at a knot where two segments meet.
fn largest_jump(run: &Run, segments: &[Segment], jump: fn(&Segment, &Segment) -> f64) -> f64 {
    let n = run.knots.len();
    let interior = if run.closed { 0..n } else { 1..n - 1 };
    interior.map(|i| jump(&segments[(i + n - 1) % n], &segments[i])).fold(0.0, f64::max)
}

/// Of the direction of travel, in radians.
fn jump_of_direction(before: &Segment, after: &Segment) -> f64 {
    wrap_angle(after.direction(0.0) - before.direction(before.length())).abs()
}

/// Of curvature times the harmonic mean of the chords; near a cusp, where that product is large, of
/// its arctangent.
fn jump_of_curvature(before: &Segment, after: &Segment) -> f64 {
    let (a, b) = (before.chord_length(), after.chord_length());
    let h = 2.0 * a * b / (a + b);
    let (arriving, leaving) = (before.curvature(before.length()) * h, after.curvature(0.0) * h);
    let least = arriving.abs().min(leaving.abs()).max(1.0);
    ((leaving - arriving) / least / least).abs()
}

impl<R: TangentRule, S: SegmentShape> Spline for TwoParamSpline<R, S> {
    fn name(&self) -> &'static str {
        self.info.name
    }

    fn default_join(&self) -> Join {
        match self.info.default_join {
            Join::G2 if !self.keeps_curvature() => Join::G1,
            join => join,
        }
    }

    fn adapt(&self, join: Join) -> Join {
        match join {
            Join::Corner | Join::G1 => join,
            Join::G2 | Join::G4 | Join::CurveToTerminal | Join::TerminalToCurve => {
                self.default_join()
            }
        }
    }

    fn solve_plainly(&self, run: &Run) -> Option<RunSolution> {
        let solved = self.draw(run, self.rule.tangents(run));
        (solved.residual <= SOLVED).then_some(solved)
    }

    fn solve_run(&self, run: &Run, effort: Effort) -> RunSolution {
        self.draw(run, self.rule.search(run, effort))
    }
}
