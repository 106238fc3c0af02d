//! κ-curves (Yan, Schiller, Wilensky, Carr and Schaefer 2017): quadratic Béziers whose greatest
//! curvature lies at the knots; as a two-parameter spline, bi-parabolas (Bespoke section 2.2).

mod bi_parabola;
mod parabolas;

use super::bespoke::parabola_end;
use super::catalog::{Claim, ParamKind, ParamSpec, Params, SplineInfo};
use super::shapes;
use crate::outline::Join;
use crate::plan::Run;
use crate::spline::{Effort, Place, Relaxation, RunSolution, Spline, Stage};
use crate::tolerance::SOLVED;
use crate::two_param::continuity::{Continuity, NaturalEnd};
use crate::two_param::shape::SegmentShape;
use crate::two_param::spline::TwoParamSpline;
use crate::two_param::tangents::{TangentRule, Tangents};

pub use bi_parabola::BiParabolas;
use parabolas::Parabolas;

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "kappa",
    summary: "κ-curves: parabolas with their greatest curvature at the knots",
    source: "Yan et al. 2017; Bespoke 2.2",
    params: &[
        ParamSpec {
            name: "method",
            summary: "how the parabolas are found: by the iteration of the paper, or as the \
                      two-parameter spline of bi-parabolas, for comparison",
            kind: ParamKind::Choice { options: &["parabolas", "bi-parabola"] },
        },
        shapes::SHAPE,
    ],
    default_join: Join::G2,
    joins: &[Join::Corner, Join::G1, Join::G2],
    ends: &["parabola"],
    claims: &[
        Claim::Parameters(2),
        Claim::Continuity(1),
        Claim::SimilarityInvariant,
        Claim::Symmetric,
    ],
    build: |params| {
        Ok(match params.choice("method", "parabolas") {
            "bi-parabola" => {
                let rule = Continuity { map: BiParabolas, end: NaturalEnd::Angle(parabola_end) };
                Box::new(TwoParamSpline::new(&INFO, rule, shapes::chosen(params, BiParabolas)))
            }
            _ => Box::new(Kappa::from_params(params)),
        })
    },
};

/// The spline of κ-curves, by the iteration of their paper.
#[derive(Debug)]
struct Kappa {
    spline: TwoParamSpline<KappaTangents, Box<dyn SegmentShape>>,
    /// Whether segments are the parabolas found, or another shape between their tangents.
    draws_parabolas: bool,
}

impl Kappa {
    fn from_params(params: &Params) -> Self {
        Kappa {
            spline: TwoParamSpline::new(&INFO, KappaTangents, shapes::chosen(params, BiParabolas)),
            draws_parabolas: params.choice(shapes::SHAPE.name, "own") == "own",
        }
    }

    fn draw(&self, run: &Run, parabolas: &Parabolas) -> RunSolution {
        let tangents = parabolas.tangents(run);
        let mut solved = if self.draws_parabolas {
            self.spline.assess(run, tangents, parabolas.segments(run))
        } else {
            self.spline.draw(run, tangents)
        };
        let off = (0..run.knots.len()).filter(|&i| !(parabolas.mismatch[i] <= SOLVED));
        solved.relaxed.extend(off.map(|i| Relaxation {
            place: Place::Knot(i),
            asked: "vertex",
            got: "free",
            reason: "the curve's greatest curvature lies beside this knot; so it does where knots lie \
                     close together and the curve hardly turns between them"
                .to_owned(),
        }));
        solved
    }
}

impl Spline for Kappa {
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
        let parabolas = Parabolas::settle(run, PLAIN)?;
        let solved = self.draw(run, &parabolas);
        solved.relaxed.is_empty().then_some(solved)
    }

    fn solve_run(&self, run: &Run, effort: Effort) -> RunSolution {
        let most = effort.evaluations(run.knots.len()) / (COST * run.segment_count());
        let parabolas = Parabolas::search(run, most.clamp(FEWEST, MOST));
        RunSolution { stage: Stage::Mended, ..self.draw(run, &parabolas) }
    }
}

/// Steps of the iteration before a run counts as hard: the reference values settle within 220.
const PLAIN: usize = 250;

/// The most steps of a search: what hasn't settled by then rarely does.
const MOST: usize = 1000;

/// The fewest, where hardly any effort is left.
const FEWEST: usize = 40;

/// A step for one knot takes as long as evaluating so many segments does elsewhere.
const COST: usize = 3;

/// The tangents at the vertices of the parabolas.
#[derive(Clone, Copy, Debug)]
struct KappaTangents;

impl TangentRule for KappaTangents {
    fn tangents(&self, run: &Run) -> Tangents {
        Parabolas::search(run, MOST).tangents(run)
    }
}

#[cfg(test)]
mod tests;
