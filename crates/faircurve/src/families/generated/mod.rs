//! The spline of a generating curve given by the caller (thesis section 4.8), as a function κ(s) or
//! as a formula.

mod curve;
mod formula;

pub use curve::{Generated, GeneratedCut, NotGenerating};
pub use formula::{FUNCTIONS, Formula, FormulaError};

use super::catalog::{CatalogError, Claim, ParamKind, ParamSpec, Params, SplineInfo};
use super::ends;
use super::euler::EulerSpirals;
use super::shapes::{self, SHAPE};
use crate::frame::{ChordAngles, EndCurvature, direction};
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::{Segment, Shape};
use crate::spline::{Effort, Place, Relaxation, RunSolution, Spline};
use crate::tolerance::SOLVED;
use crate::two_param::continuity::{Continuity, NaturalEnd};
use crate::two_param::curvature_map::{CurvatureMap, EndCurvatures, SegmentContext};
use crate::two_param::generating::Cuts;
use crate::two_param::shape::SegmentShape;
use crate::two_param::spline::TwoParamSpline;
use crate::two_param::tangents::{TangentRule, Tangents};

/// The formula when none is given: curvature that rises like the Euler spiral's from an inflection,
/// then to a limit.
const DEFAULT: &str = "tanh(s)";

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "generated",
    summary: "cuts of the curve κ(s) of your own formula, with continuous curvature",
    source: "thesis 4.8",
    params: &[
        ParamSpec {
            name: "kappa",
            summary: "curvature as a formula in arc length s, odd or of one sign",
            kind: ParamKind::Text { default: DEFAULT },
        },
        ParamSpec {
            summary: "what holds at free ends: equal end tangents, or zero curvature",
            ..ends::END
        },
        SHAPE,
    ],
    default_join: Join::G2,
    joins: &[Join::Corner, Join::G1, Join::G2],
    ends: ends::NAMES,
    claims: &[
        Claim::Parameters(2),
        Claim::Continuity(2),
        Claim::Round,
        Claim::Extensional,
        Claim::GeneratingCurve,
        Claim::MonotoneCurvature,
        Claim::SimilarityInvariant,
        Claim::Symmetric,
    ],
    build: |params| Ok(Box::new(GeneratedSpline::from_params(params)?)),
};

/// The spline of a generating curve.
#[derive(Debug)]
pub struct GeneratedSpline {
    curve: Generated,
    spline: TwoParamSpline<ByWayOfEuler, Box<dyn SegmentShape>>,
}

impl GeneratedSpline {
    /// The spline whose segments are cut from `curve`, with arcs at free ends.
    pub fn new(curve: Generated) -> Self {
        let shape = Box::new(Cuts { curve: curve.clone() });
        GeneratedSpline::with(curve, NaturalEnd::Arc, shape)
    }

    fn with(curve: Generated, end: NaturalEnd, shape: Box<dyn SegmentShape>) -> Self {
        let rule = ByWayOfEuler { curve: curve.clone(), end };
        GeneratedSpline { curve, spline: TwoParamSpline::new(&INFO, rule, shape) }
    }

    fn from_params(params: &Params) -> Result<Self, CatalogError> {
        let text = params.text("kappa", DEFAULT);
        let error = |reason: String, expected: String| CatalogError::BadText {
            spline: INFO.name,
            param: "kappa",
            value: text.clone(),
            reason,
            expected,
        };
        let formula: Formula =
            text.parse().map_err(|e: FormulaError| error(e.to_string(), FormulaError::hint()))?;
        let curve = Generated::from_formula(formula).map_err(|e| {
            error(e.to_string(), "curvature that is odd in `s`, or of one sign".to_owned())
        })?;
        let end = ends::chosen(params);
        let shape = shapes::chosen(params, Cuts { curve: curve.clone() });
        Ok(GeneratedSpline::with(curve, end, shape))
    }

    /// Whether the curve has a cut with the end tangents of this segment.
    fn has_cut(&self, segment: &Segment) -> bool {
        match segment.shape() {
            Shape::Line | Shape::Unit(_) => true,
            _ => {
                let chord = direction(segment.end() - segment.start());
                let (start, end) = (segment.direction(0.0), segment.direction(segment.length()));
                let map = Cuts { curve: self.curve.clone() };
                map.unit(ChordAngles::from_directions(start, chord, end)).is_some()
            }
        }
    }
}

impl Spline for GeneratedSpline {
    fn name(&self) -> &'static str {
        self.spline.name()
    }

    fn default_join(&self) -> Join {
        self.spline.default_join()
    }

    fn adapt(&self, join: Join) -> Join {
        self.spline.adapt(join)
    }

    fn solve_plainly(&self, run: &Run) -> Option<RunSolution> {
        let solved = self.spline.solve_plainly(run);
        solved.filter(|solved| solved.segments.iter().all(|segment| self.has_cut(segment)))
    }

    fn follow(&self, run: &Run, near: &[Segment]) -> Option<RunSolution> {
        let solved = self.spline.follow(run, near);
        solved.filter(|solved| solved.segments.iter().all(|segment| self.has_cut(segment)))
    }

    fn solve_run(&self, run: &Run, effort: Effort) -> RunSolution {
        let mut solved = self.spline.solve_run(run, effort);
        for (i, segment) in solved.segments.iter().enumerate() {
            if !self.has_cut(segment) {
                solved.relaxed.push(Relaxation {
                    place: Place::Segment(i),
                    asked: INFO.name,
                    got: "euler",
                    reason:
                        "the generating curve has no piece with the tangents at this segment's \
                             ends; add a knot where it turns most, or choose another `kappa`"
                            .to_owned(),
                });
            }
        }
        solved
    }
}

/// Continuity of curvature; where Newton's method doesn't settle, by way of maps between the Euler
/// spiral's and the curve's own.
#[derive(Clone, Debug)]
struct ByWayOfEuler {
    curve: Generated,
    end: NaturalEnd,
}

impl TangentRule for ByWayOfEuler {
    fn tangents(&self, run: &Run) -> Tangents {
        Continuity { map: Cuts { curve: self.curve.clone() }, end: self.end }.tangents(run)
    }

    fn tangents_near(&self, run: &Run, near: &[ChordAngles]) -> Tangents {
        let map = Cuts { curve: self.curve.clone() };
        Continuity { map, end: self.end }.tangents_near(run, near)
    }

    fn search(&self, run: &Run, effort: Effort) -> Tangents {
        let direct = self.tangents(run);
        if direct.residual() <= SOLVED {
            return direct;
        }
        let own = Cuts { curve: self.curve.clone() };
        let mut tangents = Continuity { map: EulerSpirals, end: self.end }.tangents(run);
        for part in [0.25, 0.5, 0.75, 0.9] {
            let map = Blend { own: own.clone(), part };
            tangents =
                Continuity { map, end: self.end }.tangents_from(run, Some(&tangents.angles()));
        }
        let rule = Continuity { map: own, end: self.end };
        let found = rule.tangents_from(run, Some(&tangents.angles()));
        if found.residual() <= SOLVED { found } else { rule.search(run, effort) }
    }
}

/// A map between the Euler spiral's and another.
#[derive(Clone, Debug)]
struct Blend {
    own: Cuts<Generated>,
    part: f64,
}

impl CurvatureMap for Blend {
    fn curvatures(&self, angles: ChordAngles, context: &SegmentContext) -> EndCurvatures {
        let (a, b) =
            (EulerSpirals.curvatures(angles, context), self.own.curvatures(angles, context));
        let mix = |a: EndCurvature, b: EndCurvature| EndCurvature {
            num: a.num + self.part * (b.num - a.num),
            den: b.den,
        };
        EndCurvatures {
            value: [0, 1].map(|end| mix(a.value[end], b.value[end])),
            by_angle: [0, 1]
                .map(|end| [0, 1].map(|angle| mix(a.by_angle[end][angle], b.by_angle[end][angle]))),
        }
    }

    fn limit(&self) -> f64 {
        self.own.limit()
    }
}

#[cfg(test)]
mod tests;
