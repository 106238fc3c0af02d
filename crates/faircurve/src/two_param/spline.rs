//! The spline of a rule for tangents and a shape for segments.

use super::shape::{SegmentShape, StandIn};
use super::tangents::{TangentRule, Tangents, curvature_of_tangents_only};
use crate::catalog::SplineInfo;
use crate::frame::{ChordAngles, wrap_angle};
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::{CurveEnd, Segment};
use crate::spline::{Adaptation, Effort, Place, Relaxation, RunSolution, Spline};
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

    /// The rule that gives tangents.
    pub(crate) fn rule(&self) -> &R {
        &self.rule
    }

    /// The curve through the knots of a run with these tangents.
    pub(crate) fn draw(&self, run: &Run, tangents: Tangents) -> RunSolution {
        self.drawing().draw(run, tangents)
    }

    /// What holds of a drawn run: knots whose equation isn't met, and those where the segments turn out
    /// not to fit together, are relaxed.
    pub(crate) fn assess(
        &self,
        run: &Run,
        tangents: Tangents,
        segments: Vec<Segment>,
    ) -> RunSolution {
        self.drawing().assess(run, tangents, segments)
    }

    fn drawing(&self) -> Drawing<'_> {
        Drawing { info: self.info, shape: &self.shape }
    }
}

/// The part of a spline that doesn't depend on the rule that its tangents are of.
struct Drawing<'a> {
    info: &'static SplineInfo,
    shape: &'a dyn SegmentShape,
}

impl Drawing<'_> {
    fn draw(&self, run: &Run, tangents: Tangents) -> RunSolution {
        let n = run.knots.len();
        let mut segments = Vec::with_capacity(tangents.ends.len());
        let mut stand_ins = Vec::new();
        for (i, ends) in tangents.ends.iter().enumerate() {
            let end = if i + 1 == n { 0 } else { i + 1 };
            let (start, end) = (run.knots[i].point, run.knots[end].point);
            let (segment, stand_in) = self.shape.place_or_stand_in(start, end, ends);
            segments.push(segment);
            stand_ins.extend(stand_in.map(|StandIn { asked, got, reason }| Relaxation {
                place: Place::Segment(i),
                asked,
                got,
                reason: reason.to_owned(),
            }));
        }
        let mut solution = self.assess(run, tangents, segments);
        solution.relaxed.append(&mut stand_ins);
        solution
    }

    fn assess(&self, run: &Run, tangents: Tangents, segments: Vec<Segment>) -> RunSolution {
        let n = run.knots.len();
        let Tangents { ends, mut adapted, iterations, stage, mismatch } = tangents;
        let mut relaxed = Vec::new();
        let mut residual = 0.0f64;
        let (is_smooth, keeps_curvature) = (self.info.continuity() > 0, self.keeps_curvature());
        let drawn: Vec<[CurveEnd; 2]> = segments.iter().map(Segment::ends).collect();
        for (i, mismatch) in mismatch.into_iter().enumerate() {
            let mut off = if mismatch.is_nan() { f64::MAX } else { mismatch };
            let mut turns = 0.0f64;
            if run.closed || (i > 0 && i + 1 < n) {
                let previous = if i == 0 { n - 1 } else { i - 1 };
                let (before, after) = (&drawn[previous][1], &drawn[i][0]);
                if is_smooth {
                    turns = off_direction(before.direction, after.direction);
                }
                if keeps_curvature {
                    let chords = [previous, i].map(|segment| ends[segment].context.chord);
                    off = off.max(jump_of_curvature(before.curvature, after.curvature, chords));
                }
            } else if let Some(tangent) = run.knots[i].tangent {
                let end = if i == 0 { drawn[0][0] } else { drawn[segments.len() - 1][1] };
                turns = off_direction(tangent, end.direction);
            }
            if turns <= SOLVED && off <= SOLVED {
                residual = residual.max(turns).max(off);
            } else {
                relaxed.push(self.unmet(run, i, turns <= SOLVED));
            }
        }
        if !self.shape.keeps_curvature() {
            let said = |adapted: &[Adaptation], knot| {
                adapted.iter().any(|a| a.place == Place::Knot(knot) && a.asked == "curvature")
            };
            for (i, _) in run.knots.iter().enumerate().filter(|(_, knot)| knot.curvature.is_some())
            {
                if !said(&adapted, i) {
                    adapted.push(curvature_of_tangents_only(i));
                }
            }
        }
        RunSolution { segments, relaxed, adapted, iterations, residual, stage }
    }

    fn keeps_curvature(&self) -> bool {
        self.info.continuity() >= 2 && self.shape.keeps_curvature()
    }

    fn default_join(&self) -> Join {
        match self.info.default_join {
            Join::G2 if !self.keeps_curvature() => Join::G1,
            join => join,
        }
    }

    /// A knot whose equation isn't met, or where the curve even turns round.
    fn unmet(&self, run: &Run, knot: usize, is_smooth: bool) -> Relaxation {
        let is_end = !run.closed && (knot == 0 || knot + 1 == run.knots.len());
        let own = self.default_join().name();
        let (asked, got, reason) = match (is_end, is_smooth) {
            // Drawn with a shape that promises no more than a tangent.
            (false, true) if own == Join::G1.name() => (
                self.info.name,
                Join::G1.name(),
                "no tangent was found here that this spline's equations hold for; move the knot or \
                 a neighbour, or add a knot where the curve turns most",
            ),
            (false, true) => (
                own,
                Join::G1.name(),
                "the curve can't have the same curvature on both sides of this knot; move it or a \
                 neighbour, or add a knot where the curve turns most",
            ),
            (false, false) => (
                own,
                Join::Corner.name(),
                "the curve turns back here, in a cusp; move the knot or a neighbour, or add a knot \
                 where it turns most",
            ),
            (true, false) if run.knots[knot].join == Join::Corner => (
                "tangent",
                "free",
                "the direction given here is too far from that to the next knot; add a knot where \
                 the curve turns most",
            ),
            (true, false) => (
                run.knots[knot].join.name(),
                Join::Corner.name(),
                "the direction here is too far from that to the next knot; add a knot where the \
                 curve turns most",
            ),
            (true, true) => (
                "end",
                "free",
                "no curve was found that ends as this spline's curves do; move the end or the knot \
                 next to it",
            ),
        };
        Relaxation { place: Place::Knot(knot), asked, got, reason: reason.to_owned() }
    }
}

/// Radians between two directions.
fn off_direction(a: f64, b: f64) -> f64 {
    wrap_angle(b - a).abs()
}

/// Of curvature times the harmonic mean of the chords, which are given; at what is all but a cusp, where
/// that product is large, less by the square of it.
fn jump_of_curvature(before: f64, after: f64, [a, b]: [f64; 2]) -> f64 {
    /// Curvature times chord from which on a bend is as good as a cusp.
    const CUSP: f64 = 32.0;
    let h = 2.0 * a * b / (a + b);
    let (arriving, leaving) = (before * h, after * h);
    let least = (arriving.abs().min(leaving.abs()) / CUSP).max(1.0);
    ((leaving - arriving) / least / least).abs()
}

impl<R: TangentRule, S: SegmentShape> Spline for TwoParamSpline<R, S> {
    fn name(&self) -> &'static str {
        self.info.name
    }

    fn default_join(&self) -> Join {
        self.drawing().default_join()
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
        solved.relaxed.is_empty().then_some(solved)
    }

    fn follow(&self, run: &Run, near: &[Segment]) -> Option<RunSolution> {
        let angles: Vec<ChordAngles> = near.iter().map(Segment::chord_angles).collect();
        let solved = self.draw(run, self.rule.tangents_near(run, &angles));
        solved.relaxed.is_empty().then_some(solved)
    }

    fn solve_run(&self, run: &Run, effort: Effort) -> RunSolution {
        self.draw(run, self.rule.search(run, effort))
    }
}
