//! The minimum energy curve, the elastic spline: pieces of the rectangular elastica joined with
//! continuous curvature (thesis sections 3.10, 4.1, 4.2).

mod forces;
mod segment;
mod solutions;

use kurbo::Point;

use super::catalog::{Claim, ParamKind, ParamSpec, Params, SplineInfo};
use super::euler::{Euler, EulerSpirals};
use super::shapes::{self, SHAPE};
use crate::frame::ChordAngles;
use crate::numeric::order::sort_by;
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::Segment;
use crate::spline::{Effort, Place, Relaxation, RunSolution, Spline};
use crate::tolerance::SOLVED;
use crate::two_param::continuity::{Continuity, NaturalEnd};
use crate::two_param::curvature_map::{CurvatureMap, EndCurvatures, SegmentContext};
use crate::two_param::shape::{SegmentEnds, SegmentShape, StandIn};
use crate::two_param::spline::TwoParamSpline;
use crate::two_param::tangents::{TangentRule, Tangents};

pub use forces::{force_in, forces_at_knots};
use segment::Fit;
pub use segment::{MecSegment, NoMec, envelope, fit_mec};
pub use solutions::{all_of_length, all_rectangular, fit_of_length};

/// The name of the parameter c.
const PENALTY: &str = "penalty";

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "mec",
    summary: "minimum energy: a thin elastic strip that slides freely through the knots",
    source: "thesis 3.10, 4.1, 4.2",
    params: &[
        ParamSpec {
            name: PENALTY,
            summary: "the cost c of arc length, in ∫ κ² + c ds, in 1/units²",
            kind: ParamKind::Number { default: 0.0, min: 0.0, max: 1e100 },
        },
        SHAPE,
    ],
    default_join: Join::G2,
    joins: &[Join::Corner, Join::G1, Join::G2],
    ends: &["zero-curvature"],
    claims: &[
        Claim::Parameters(2),
        Claim::Continuity(2),
        Claim::RoundToOrder(4),
        Claim::Extensional,
        Claim::GeneratingCurve,
        Claim::SimilarityInvariant,
        Claim::Symmetric,
        Claim::Ripple(0.267_949_192_431_122_7),
    ],
    build: |params| Ok(Box::new(Mec::from_params(params))),
};

/// The minimum energy curve with a penalty on arc length, or none.
#[derive(Clone, Debug)]
struct Mec {
    /// c of eq. 4.2, in 1/units² of the drawing.
    penalty: f64,
    /// Which shape fills the segments.
    params: Params,
}

impl Mec {
    fn from_params(params: &Params) -> Self {
        Mec { penalty: params.number(PENALTY, 0.0), params: params.clone() }
    }

    /// The two-parameter spline of a run: what the penalty is depends on the run's unit.
    fn on(&self, run: &Run) -> TwoParamSpline<ByWayOfPenalties, Box<dyn SegmentShape>> {
        let elasticas = Elasticas { constant: -self.penalty / 2.0 * run.unit * run.unit };
        let rule = ByWayOfPenalties { elasticas };
        TwoParamSpline::new(&INFO, rule, shapes::chosen(&self.params, elasticas))
    }
}

impl Spline for Mec {
    fn name(&self) -> &'static str {
        INFO.name
    }

    fn default_join(&self) -> Join {
        self.on(&Run::EMPTY).default_join()
    }

    fn adapt(&self, join: Join) -> Join {
        self.on(&Run::EMPTY).adapt(join)
    }

    fn solve_plainly(&self, run: &Run) -> Option<RunSolution> {
        self.on(run).solve_plainly(run)
    }

    /// Where there is no minimum energy curve, or none was found, the whole run is drawn as an Euler
    /// spiral spline.
    fn solve_run(&self, run: &Run, effort: Effort) -> RunSolution {
        let spline = self.on(run);
        let tangents = spline.rule().search(run, effort);
        let solved = spline.draw(run, tangents.clone());
        if solved.relaxed.is_empty() {
            return solved;
        }
        let rule = spline.rule();
        let last = rule.walk(run).err().flatten().unwrap_or(tangents);
        let euler = euler_instead(run, effort, rule.elasticas.why_none(&last));
        RunSolution { adapted: solved.adapted, ..euler }
    }
}

/// A run drawn as an Euler spiral spline in the place of one of elastica, for this reason at this
/// segment.
pub(super) fn euler_instead(
    run: &Run,
    effort: Effort,
    (asked, segment, reason): (&'static str, usize, String),
) -> RunSolution {
    let euler = Euler::new(NaturalEnd::ZeroCurvature);
    let mut drawn = euler.solve_plainly(run).unwrap_or_else(|| euler.solve_run(run, effort));
    let instead = Relaxation { place: Place::Segment(segment), asked, got: "euler", reason };
    drawn.relaxed.insert(0, instead);
    drawn
}

/// The family: pieces of the elastica with one constant C (thesis eq. 3.10), in the run's units; of
/// the rectangular elastica for C = 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Elasticas {
    /// C.
    pub(super) constant: f64,
}

impl Elasticas {
    fn fit(&self, angles: ChordAngles, chord: f64) -> Result<Fit, NoMec> {
        segment::fit(angles, self.constant * chord * chord)
    }

    /// ∫ κ² ds and the arc length of a segment; `None` if there is none.
    pub(super) fn energy_and_length(&self, ends: &SegmentEnds) -> Option<[f64; 2]> {
        let fit = self.fit(ends.angles, ends.context.chord).ok()?;
        Some(fit.energy_and_length(ends.context.chord))
    }

    /// Whether there is a segment for each of these tangents.
    fn exist(&self, tangents: &Tangents) -> bool {
        tangents.ends.iter().all(|ends| self.fit(ends.angles, ends.context.chord).is_ok())
    }

    /// The segment that stands in the way of a curve that was nearly found, and why, in words.
    fn why_none(&self, tangents: &Tangents) -> (&'static str, usize, String) {
        /// Segments that are looked at closely.
        const CLOSELY: usize = 3;
        let size = |i: &usize| {
            let ChordAngles { theta0, theta1 } = tangents.ends[*i].angles;
            theta0.hypot(theta1)
        };
        let mut widest: Vec<usize> = (0..tangents.ends.len()).collect();
        sort_by(&mut widest, |a, b| size(b).total_cmp(&size(a)));
        let reaches =
            widest.iter().take(CLOSELY).map(|&i| (segment::reach(tangents.ends[i].angles), i));
        let worst = reaches.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(0, |(_, i)| i);
        let Some(ends) = tangents.ends.get(worst) else {
            return (INFO.name, 0, "no curve of least energy was found".to_owned());
        };
        (INFO.name, worst, self.why_none_here(ends))
    }

    /// In words for a designer.
    fn why_none_here(&self, ends: &SegmentEnds) -> String {
        let is_too_strong = |ends: &SegmentEnds| {
            self.fit(ends.angles, ends.context.chord) == Err(NoMec::OutOfRange)
        };
        if is_too_strong(ends) {
            return "the penalty is so strong that the curve would be straight but for its very \
                    knots; lower `penalty`"
                .to_owned();
        }
        let met = in_degrees(ends.angles);
        let advice = "Add a knot where the curve turns most";
        let grows = format!(
            "no curve has least energy here: set free, this segment would grow without end. Under the \
             least tension that holds it, it meets its chord at {met}"
        );
        if self.constant != 0.0 {
            return format!("{grows}. {advice}, or raise `penalty`");
        }
        let bound = in_degrees(envelope(ends.angles.theta1.atan2(ends.angles.theta0)));
        format!("{grows}; without tension the bound is {bound}. {advice}, or set `penalty`")
    }
}

/// Both end tangents from the chord, the larger first, in words that don't depend on the contour's
/// direction: what counts is whether both turn the same way.
pub(super) fn in_degrees(angles: ChordAngles) -> String {
    let (a, b) = (angles.theta0.to_degrees(), angles.theta1.to_degrees());
    let (a, b) = if a.abs() < b.abs() { (b, a) } else { (a, b) };
    format!("{:.0}° and {:.0}°", a.abs(), b * a.signum() + 0.0)
}

impl CurvatureMap for Elasticas {
    /// Where there is no segment, as for the Euler spiral.
    fn curvatures(&self, angles: ChordAngles, context: &SegmentContext) -> EndCurvatures {
        match self.fit(angles, context.chord) {
            Ok(fit) => fit.response(),
            Err(_) => EulerSpirals.curvatures(angles, context),
        }
    }

    fn limit(&self) -> f64 {
        EulerSpirals.limit()
    }
}

impl SegmentShape for Elasticas {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        self.place_or_stand_in(start, end, ends).0
    }

    fn place_or_stand_in(
        &self,
        start: Point,
        end: Point,
        ends: &SegmentEnds,
    ) -> (Segment, Option<StandIn>) {
        if ends.angles == ChordAngles::default() {
            return (Segment::line(start, end), None);
        }
        match self.fit(ends.angles, ends.context.chord) {
            Ok(fit) => (Segment::elastica(start, end, fit.elastica()), None),
            Err(_) => {
                let reason = "no curve of least energy has the tangents at this segment's ends";
                let stand_in = StandIn { asked: INFO.name, got: "euler", reason };
                (EulerSpirals.place(start, end, ends), Some(stand_in))
            }
        }
    }

    fn keeps_curvature(&self) -> bool {
        true
    }
}

/// Continuity of curvature; where Newton's method doesn't settle, by way of curves on whose length
/// there is a penalty: they exist for wider angles.
#[derive(Clone, Copy, Debug)]
pub(super) struct ByWayOfPenalties {
    /// The segments.
    pub(super) elasticas: Elasticas,
}

impl ByWayOfPenalties {
    fn continuity(constant: f64) -> Continuity<Elasticas> {
        Continuity { map: Elasticas { constant }, end: NaturalEnd::ZeroCurvature }
    }
}

impl TangentRule for ByWayOfPenalties {
    fn tangents(&self, run: &Run) -> Tangents {
        Self::continuity(self.elasticas.constant).tangents(run)
    }

    fn search(&self, run: &Run, _effort: Effort) -> Tangents {
        match self.walk(run) {
            Ok(tangents) => tangents,
            Err(_) => self.tangents(run),
        }
    }
}

impl ByWayOfPenalties {
    /// From a curve of nearly least length times energy, or under more tension if need be, to the one
    /// asked for. Where the way ends, because the last curve that exists could have less energy by
    /// being longer, that last curve; `None` if there was no first one.
    fn walk(&self, run: &Run) -> Result<Tangents, Option<Tangents>> {
        /// Times the penalty of the first curve.
        const MORE: [f64; 4] = [1.0, 4.0, 16.0, 64.0];
        /// Of the logarithm of the penalty, which is kept finite by a share of the first one's.
        const STEP: f64 = 0.6;
        const SHARE: f64 = 0.125;
        /// Where steps of this size lead nowhere, the way ends. With a tenth of it, of 400 random
        /// contours none more is solved.
        const LEAST_STEP: f64 = 0.02;
        let euler = Continuity { map: EulerSpirals, end: NaturalEnd::ZeroCurvature }.tangents(run);
        let squares = mean_square_curvature(&euler);
        let asked = -2.0 * self.elasticas.constant;
        let least = SHARE * squares;
        let at = |log: f64, from: &Tangents| {
            let penalty = if log == (asked + least).ln() { asked } else { log.exp() - least };
            let elasticas = Elasticas { constant: -penalty / 2.0 };
            let rule = Continuity { map: elasticas, end: NaturalEnd::ZeroCurvature };
            let found = rule.tangents_from(run, Some(&from.angles()));
            (found.residual() <= SOLVED && elasticas.exist(&found)).then_some(found)
        };
        let first = MORE.iter().find_map(|more| {
            let log = (more * squares + least).ln();
            at(log, &euler).map(|found| (log, found))
        });
        let Some((mut log, mut here)) = first else { return Err(None) };
        let goal = (asked + least).ln();
        let mut step = STEP;
        while log != goal {
            let next =
                if (goal - log).abs() <= step { goal } else { log + step.copysign(goal - log) };
            match at(next, &here) {
                Some(found) => (here, log) = (found, next),
                None if step > LEAST_STEP => step /= 3.0,
                None => return Err(Some(here)),
            }
        }
        Ok(here)
    }
}

/// The mean of κ² along Euler spirals with these tangents: about the c that makes c·length the
/// energy.
pub(super) fn mean_square_curvature(tangents: &Tangents) -> f64 {
    let (mut energy, mut length) = (0.0, 0.0);
    for ends in &tangents.ends {
        let end = Point::new(ends.context.chord, 0.0);
        let segment = EulerSpirals.place(Point::ZERO, end, ends);
        energy += segment.bending_energy();
        length += segment.length();
    }
    energy / length
}

#[cfg(test)]
mod tests;
