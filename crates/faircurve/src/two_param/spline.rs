//! The spline of a rule for tangents and a shape for segments.

use super::shape::{SegmentShape, StandIn};
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
        let (segments, stand_ins): (Vec<Segment>, Vec<Option<StandIn>>) = tangents
            .ends
            .iter()
            .enumerate()
            .map(|(i, ends)| {
                let (start, end) = (run.knots[i].point, run.knots[(i + 1) % n].point);
                self.shape.place_or_stand_in(start, end, ends)
            })
            .unzip();
        // Knots at which a stand-in has another curvature than it should.
        let mut is_loose = vec![false; n];
        for (i, stand_in) in stand_ins.iter().enumerate() {
            if self.keeps_curvature() && stand_in.is_some_and(|stand_in| !stand_in.keeps_curvature)
            {
                (is_loose[i], is_loose[(i + 1) % n]) = (true, true);
            }
        }
        let mut residual = tangents.residual();
        let interior = || if run.closed { 0..n } else { 1..n - 1 };
        if self.info.continuity() > 0 {
            residual = residual.max(largest_jump(interior(), &segments, jump_of_direction));
        }
        if self.keeps_curvature() {
            let firm = interior().filter(|&i| !is_loose[i]);
            residual = residual.max(largest_jump(firm, &segments, jump_of_curvature));
        }
        let unmet = |i: &usize| !(tangents.mismatch[*i] <= SOLVED);
        let mut relaxed: Vec<_> = (0..n).filter(unmet).map(|i| self.unmet(i)).collect();
        for (i, stand_in) in stand_ins.iter().enumerate() {
            relaxed.extend(stand_in.map(|stand_in| Relaxation {
                place: Place::Segment(i),
                asked: stand_in.asked,
                got: stand_in.got,
                reason: stand_in.reason.to_owned(),
            }));
        }
        let loose = interior().filter(|&i| is_loose[i] && !unmet(&i));
        relaxed.extend(loose.map(|i| self.loosened(i)));
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

    /// A knot at which a segment's stand-in has another curvature than its neighbour.
    fn loosened(&self, knot: usize) -> Relaxation {
        Relaxation {
            reason: "a segment beside this knot has another shape, with another curvature"
                .to_owned(),
            ..self.unmet(knot)
        }
    }
}

/// The largest jump of something at knots where two segments meet.
fn largest_jump(
    knots: impl Iterator<Item = usize>,
    segments: &[Segment],
    jump: fn(&Segment, &Segment) -> f64,
) -> f64 {
    let n = segments.len();
    knots.map(|i| jump(&segments[(i + n - 1) % n], &segments[i])).fold(0.0, f64::max)
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
