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
        let euler = euler_instead(run, effort, spline.rule().elasticas.why_none(&tangents));
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

    /// The segment that stands most in the way of tangents that weren't found, and why, in words.
    fn why_none(&self, tangents: &Tangents) -> (&'static str, usize, String) {
        let reach = |ends: &SegmentEnds| match self.fit(ends.angles, ends.context.chord) {
            Err(_) if self.constant != 0.0 => f64::INFINITY,
            _ => segment::reach(ends.angles),
        };
        let reaches: Vec<f64> = tangents.ends.iter().map(reach).collect();
        let worst = (0..reaches.len()).max_by(|&i, &j| reaches[i].total_cmp(&reaches[j]));
        let worst = worst.unwrap_or(0);
        let angles = tangents.ends.get(worst).map_or(ChordAngles::default(), |ends| ends.angles);
        (INFO.name, worst, why_none(angles, reaches.get(worst).copied().unwrap_or(0.0), self))
    }
}

/// Both end tangents from the chord, the larger first, in words that don't depend on the contour's
/// direction: what counts is whether both turn the same way.
pub(super) fn in_degrees(angles: ChordAngles) -> String {
    let (a, b) = (angles.theta0.to_degrees(), angles.theta1.to_degrees());
    let (a, b) = if a.abs() < b.abs() { (b, a) } else { (a, b) };
    format!("{:.0}° and {:.0}°", a.abs(), b * a.signum() + 0.0)
}

/// In words for a designer.
fn why_none(angles: ChordAngles, reach: f64, elasticas: &Elasticas) -> String {
    let angles_of = in_degrees(angles);
    if elasticas.constant != 0.0 {
        return format!(
            "no curve of least energy was found; this segment would have to meet its chord at \
             {angles_of}. Add a knot where the curve turns most, or raise `penalty`"
        );
    }
    let bound = in_degrees(envelope(angles.theta1.atan2(angles.theta0)));
    if reach > 1.0 {
        format!(
            "this segment would have to meet its chord at {angles_of}, but beyond {bound} a longer \
             curve always has less energy, so that there is no least. Add a knot where the curve \
             turns most, or set `penalty`"
        )
    } else {
        format!(
            "no curve of least energy was found; the segment nearest to the bound is this, which \
             would meet its chord at {angles_of}, the bound being {bound}. Add a knot where the curve \
             turns most, or set `penalty`"
        )
    }
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

    fn search(&self, run: &Run, effort: Effort) -> Tangents {
        /// Parts of the penalty with which the curve is nearly of least length · energy.
        const PARTS: [f64; 8] = [1.0, 0.7, 0.5, 0.35, 0.2, 0.1, 0.03, 0.0];
        let euler = Continuity { map: EulerSpirals, end: NaturalEnd::ZeroCurvature };
        let mut tangents = euler.tangents(run);
        let squares = mean_square_curvature(&tangents);
        for part in PARTS {
            let constant = self.elasticas.constant - part * squares / 2.0;
            tangents = Self::continuity(constant).tangents_from(run, Some(&tangents));
        }
        if tangents.residual() <= SOLVED {
            return tangents;
        }
        Self::continuity(self.elasticas.constant).search(run, effort)
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
