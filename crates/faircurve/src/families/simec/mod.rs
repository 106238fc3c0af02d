//! The scale-invariant minimum energy curve: a spline with the little tension that makes length
//! times energy least (thesis sections 3.11, 4.3).

use super::catalog::{Claim, Params, SplineInfo};
use super::euler::EulerSpirals;
use super::mec::{ByWayOfPenalties, Elasticas, euler_instead, in_degrees, mean_square_curvature};
use super::shapes::{self, SHAPE};
use crate::frame::ChordAngles;
use crate::outline::Join;
use crate::plan::Run;
use crate::spline::{Effort, RunSolution, Spline};
use crate::tolerance::SOLVED;
use crate::two_param::continuity::{Continuity, NaturalEnd};
use crate::two_param::shape::SegmentShape;
use crate::two_param::spline::TwoParamSpline;
use crate::two_param::tangents::{TangentRule, Tangents};

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "simec",
    summary: "least energy times length: an elastic strip under the tension that makes it scale-invariant",
    source: "thesis 3.11, 4.3",
    params: &[SHAPE],
    default_join: Join::G2,
    joins: &[Join::Corner, Join::G1, Join::G2],
    ends: &["zero-curvature"],
    claims: &[
        Claim::Parameters(3),
        Claim::Continuity(2),
        Claim::Extensional,
        Claim::SimilarityInvariant,
        Claim::Symmetric,
        Claim::Ripple(0.267_949_192_431_122_7),
    ],
    build: |params| Ok(Box::new(Simec { params: params.clone() })),
};

/// The scale-invariant minimum energy curve; the parameter chooses the shape of its segments.
#[derive(Clone, Debug)]
struct Simec {
    params: Params,
}

impl Simec {
    /// The two-parameter spline of elastica with this constant.
    fn with(&self, constant: f64) -> TwoParamSpline<ByWayOfPenalties, Box<dyn SegmentShape>> {
        let elasticas = Elasticas { constant };
        let shape = shapes::chosen(&self.params, elasticas);
        TwoParamSpline::new(&INFO, ByWayOfPenalties { elasticas }, shape)
    }

    fn draw(&self, run: &Run, found: Tensioned) -> RunSolution {
        let drawn = self.with(found.constant()).draw(run, found.tangents.clone());
        RunSolution { residual: drawn.residual.max(found.off().abs()), ..drawn }
    }
}

impl Spline for Simec {
    fn name(&self) -> &'static str {
        INFO.name
    }

    fn default_join(&self) -> Join {
        self.with(0.0).default_join()
    }

    fn adapt(&self, join: Join) -> Join {
        self.with(0.0).adapt(join)
    }

    fn solve_plainly(&self, run: &Run) -> Option<RunSolution> {
        let start = euler_tangents(run);
        let first = Tensioned::new(run, mean_square_curvature(&start), &start)?;
        let drawn = self.draw(run, first.balanced(run)?);
        drawn.relaxed.is_empty().then_some(drawn)
    }

    /// From curves under more tension, which exist for wider angles; where none is found, the whole
    /// run is drawn as an Euler spiral spline.
    fn solve_run(&self, run: &Run, effort: Effort) -> RunSolution {
        /// Times the tension that Euler spirals suggest.
        const MORE: [f64; 6] = [1.5, 3.0, 6.0, 12.0, 25.0, 50.0];
        let start = euler_tangents(run);
        let guess = mean_square_curvature(&start);
        let found = MORE.iter().find_map(|more| {
            let first = Tensioned::new(run, more * guess, &start)?;
            let drawn = self.draw(run, first.balanced(run)?);
            drawn.relaxed.is_empty().then_some(drawn)
        });
        found.unwrap_or_else(|| {
            let adapted = self.with(0.0).rule().tangents(run).adapted;
            RunSolution { adapted, ..euler_instead(run, effort, why_none(&start)) }
        })
    }
}

fn euler_tangents(run: &Run) -> Tangents {
    Continuity { map: EulerSpirals, end: NaturalEnd::ZeroCurvature }.tangents(run)
}

/// The segment that turns most, and what can be said of it.
fn why_none(tangents: &Tangents) -> (&'static str, usize, String) {
    let size = |angles: ChordAngles| angles.theta0.abs().max(angles.theta1.abs());
    let sizes: Vec<f64> = tangents.ends.iter().map(|ends| size(ends.angles)).collect();
    let worst = (0..sizes.len()).max_by(|&i, &j| sizes[i].total_cmp(&sizes[j])).unwrap_or(0);
    let angles = tangents.ends.get(worst).map_or(ChordAngles::default(), |ends| ends.angles);
    let reason = format!(
        "no curve of least energy times length was found; as an Euler spiral this segment, which turns \
         most, meets its chord at {}. Add a knot where the curve turns most",
        in_degrees(angles)
    );
    (INFO.name, worst, reason)
}

/// The curve of least ∫ κ² + c ds for one penalty c: for the right one, its energy over its length is
/// c itself, which is when energy · length is least (thesis eq. 4.3).
#[derive(Clone, Debug)]
struct Tensioned {
    penalty: f64,
    tangents: Tangents,
    /// Energy over length.
    mean: f64,
}

impl Tensioned {
    fn new(run: &Run, penalty: f64, start: &Tangents) -> Option<Tensioned> {
        let elasticas = Elasticas { constant: -penalty / 2.0 };
        let rule = Continuity { map: elasticas, end: NaturalEnd::ZeroCurvature };
        let tangents = rule.tangents_from(run, Some(&start.angles()));
        if !(tangents.residual() <= SOLVED) {
            return None;
        }
        let (mut energy, mut length) = (0.0, 0.0);
        for ends in &tangents.ends {
            let [e, l] = elasticas.energy_and_length(ends)?;
            energy += e;
            length += l;
        }
        Some(Tensioned { penalty, tangents, mean: energy / length })
    }

    fn constant(&self) -> f64 {
        -self.penalty / 2.0
    }

    /// How far the penalty is from being the right one, as a part of it.
    fn off(&self) -> f64 {
        self.mean / self.penalty - 1.0
    }

    /// The curve whose penalty is its energy over its length, by the secant method.
    fn balanced(self, run: &Run) -> Option<Tensioned> {
        const MOST_STEPS: usize = 30;
        /// A part of the penalty; further steps would only move rounding.
        const DONE: f64 = 1e-15;
        /// Where steps have stopped helping.
        const CLOSE: f64 = 1e-10;
        let mut here = self;
        // d(mean)/d(penalty); 0 is the fixed-point iteration.
        let mut slope = 0.0;
        for _ in 0..MOST_STEPS {
            if here.off().abs() <= DONE {
                break;
            }
            let mut step = (here.mean - here.penalty) / (1.0 - slope);
            let next = loop {
                // No more than to a half or to the double.
                let bounded = step.clamp(-0.5 * here.penalty, here.penalty);
                match Tensioned::new(run, here.penalty + bounded, &here.tangents) {
                    Some(next) => break next,
                    None if step.abs() > 1e-3 * here.penalty => step = bounded / 4.0,
                    None => return None,
                }
            };
            if here.off().abs() < CLOSE && next.off().abs() >= here.off().abs() {
                break;
            }
            let measured = (next.mean - here.mean) / (next.penalty - here.penalty);
            slope = if measured.is_finite() { measured.clamp(-2.0, 0.9) } else { 0.0 };
            here = next;
        }
        (here.off().abs() <= SOLVED).then_some(here)
    }
}

#[cfg(test)]
mod tests;
