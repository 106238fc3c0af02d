//! The minimum variation curve: ∫ κ′² ds is least (thesis section 7.2), joined as Table 7.1 says.

mod curve;
mod hermite;

use std::sync::Arc;

use kurbo::Point;

use super::catalog::{Claim, SplineInfo};
use super::spiro::{PolynomialSpirals, Spiro};
use crate::four_param::family::{Ends, FourParamFamily, Response};
use crate::four_param::spline::ConstraintSpline;
use crate::frame::chord_direction;
use crate::numeric::block_tridiagonal::invert;
use crate::numeric::dual::{Dual, Real};
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::Segment;
use crate::spline::{Effort, Place, Relaxation, RunSolution, Spline};
use crate::tolerance::LOOP;

pub use curve::MvcCurve;
pub use hermite::{MvcSegment, fit_mvc, fit_mvc_of_length};

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "mvc",
    summary: "minimum variation of curvature, with every join of thesis Table 7.1",
    source: "thesis 7.2",
    params: &[],
    default_join: Join::G4,
    joins: &Join::ALL,
    ends: &["natural"],
    claims: &[
        Claim::Parameters(4),
        Claim::Continuity(4),
        Claim::Round,
        Claim::Extensional,
        Claim::SimilarityInvariant,
        Claim::Symmetric,
    ],
    build: |_| Ok(Box::new(Mvc)),
};

/// The minimum variation curve. It takes no parameters.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mvc;

/// How much longer a segment takes than a polynomial spiral.
const COST: f64 = 10.0;

impl Spline for Mvc {
    fn name(&self) -> &'static str {
        INFO.name
    }

    fn default_join(&self) -> Join {
        INFO.default_join
    }

    fn adapt(&self, join: Join) -> Join {
        join
    }

    fn solve_plainly(&self, run: &Run) -> Option<RunSolution> {
        ConstraintSpline::new(&MinimumVariation).solve_plainly(run)
    }

    /// Newton's method on this family strays further than on polynomial spirals: what takes many steps
    /// isn't the curve nearby.
    fn follow(&self, run: &Run, near: &[Segment]) -> Option<RunSolution> {
        const MOST_STEPS: usize = 8;
        let own = ConstraintSpline::new(&MinimumVariation).follow(run, near)?;
        (own.iterations <= MOST_STEPS && longest(&own).0 <= LOOP).then_some(own)
    }

    /// Where the curve found winds or is relaxed, and that of polynomial spirals, which is nearly the
    /// same curve, less so, the whole run is drawn as the latter.
    fn solve_run(&self, run: &Run, effort: Effort) -> RunSolution {
        let own = ConstraintSpline::new(&MinimumVariation).solve_run(run, effort.of_costlier(COST));
        let (longest, segment) = longest(&own);
        if own.relaxed.is_empty() && longest <= LOOP {
            return own;
        }
        let spirals = Spiro.solve_lone_run(run, effort);
        let reason = if spirals.relaxed.len() < own.relaxed.len() {
            "no curve of minimum variation was found that joins as asked; this segment is the longest \
             of those found. Add a knot where the curve turns most"
                .to_owned()
        } else if spirals.relaxed.len() == own.relaxed.len()
            && self::longest(&spirals).0 < longest / 2.0
        {
            format!(
                "the curve of minimum variation found would wind: this segment would be {longest:.0} \
                 chords long. Add a knot where the curve turns most"
            )
        } else {
            return own;
        };
        let place = Place::Segment(segment);
        let instead = Relaxation { place, asked: INFO.name, got: "spiro", reason };
        let relaxed = std::iter::once(instead).chain(spirals.relaxed).collect();
        RunSolution { relaxed, iterations: own.iterations + spirals.iterations, ..spirals }
    }

    fn solve_lone_run(&self, run: &Run, effort: Effort) -> RunSolution {
        self.solve_run(run, effort)
    }
}

/// The largest ratio of arc length to chord, and the segment that has it.
fn longest(solved: &RunSolution) -> (f64, usize) {
    let ratios = solved.segments.iter().map(|segment| segment.length() / segment.chord_length());
    ratios.zip(0..).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((1.0, 0))
}

/// The family of segments that obey κ⁗ + κ²κ″ − ½κκ′² = 0 (thesis eq. 7.20), which is κ″ = λy with a
/// free length; its parameters are κ and its first three derivatives in the middle, for arc length 1.
///
/// To first order they are polynomial spirals, whose parameters these are.
#[derive(Clone, Copy, Debug, Default)]
pub struct MinimumVariation;

impl FourParamFamily for MinimumVariation {
    fn respond(&self, k: [f64; 4]) -> Response {
        respond::<{ curve::TERMS }>(k, curve::NEGLIGIBLE)
    }

    fn respond_roughly(&self, k: [f64; 4]) -> Response {
        respond::<{ curve::ROUGH_TERMS }>(k, curve::ROUGHLY)
    }

    fn ends(&self, k: [f64; 4]) -> Ends {
        let ends = unit_ends::<_, { curve::TERMS }>(k, 0.0, curve::NEGLIGIBLE);
        ends.map_or(NO_ENDS, |(jets, derivatives, straightness)| Ends {
            jets,
            derivatives,
            straightness,
        })
    }

    fn between_tangents(&self, theta0: f64, theta1: f64) -> [f64; 4] {
        hermite::between_tangents(theta0, theta1)
    }

    fn between_ends(&self, ends: [f64; 4]) -> Vec<[f64; 4]> {
        PolynomialSpirals.between_ends(ends)
    }

    fn shape(&self, start: Point, end: Point, k: [f64; 4]) -> Segment {
        match MvcCurve::new(k, 0.0) {
            Some(_) if k == [0.0; 4] => Segment::line(start, end),
            Some(curve) => Segment::unit_curve(start, end, Arc::new(curve)),
            None => Segment::line(start, end),
        }
    }

    /// Any segment has a curvature and its derivatives in its middle; of curves of this family they
    /// are the parameters.
    fn parameters(&self, segment: &Segment) -> Option<[f64; 4]> {
        let length = segment.length();
        let jet = segment.curvature_jet(length / 2.0);
        let mut unit = 1.0;
        Some(jet.map(|derivative| {
            unit *= length;
            derivative * unit
        }))
    }

    /// As for polynomial spirals.
    fn bend(&self, change: [f64; 4]) -> f64 {
        PolynomialSpirals.bend(change)
    }
}

/// What [`Ends`] says of a segment: jets, derivatives, straightness. `None` where the curve is too wild.
fn unit_ends<T: Real, const N: usize>(
    k: [T; 4],
    constant: T,
    negligible: f64,
) -> Option<([T; 4], [T; 4], T)> {
    let [start, end] = curve::ends::<T, N>(k, constant, negligible)?;
    let (x, y) = (end.x - start.x, end.y - start.y);
    let c = (x * x + y * y).sqrt();
    let psi = y.atan2(x);
    let psi = psi + (chord_direction(psi.value(), k[0].value()) - psi.value());
    let ([k0, first0, second0], [k1, first1, second1]) = (start.curvature, end.curvature);
    let (c2, c3) = (c * c, c * c * c);
    let jets = [psi - start.theta, end.theta - psi, k0 * c, k1 * c];
    Some((jets, [first0 * c2, second0 * c3, first1 * c2, second1 * c3], c))
}

/// Those of a segment that is too wild.
const NO_ENDS: Ends = Ends { jets: [f64::NAN; 4], derivatives: [f64::NAN; 4], straightness: 0.0 };

/// The response of the segment with these parameters; NaN where it is too wild.
fn respond<const N: usize>(k: [f64; 4], negligible: f64) -> Response {
    let k = std::array::from_fn(|i| Dual::<4>::variable(k[i], i));
    let Some((jets, derivatives, c)) = unit_ends::<_, N>(k, Dual::from(0.0), negligible) else {
        let none = [[f64::NAN; 4]; 4];
        return Response { ends: NO_ENDS, derivatives_by_jets: none, parameters_by_jets: none };
    };
    let parameters_by_jets = invert(&jets.map(|jet| jet.by));
    let derivatives_by_jets = derivatives.map(|derivative| {
        std::array::from_fn(|jet| {
            (0..4).map(|i| derivative.by[i] * parameters_by_jets[i][jet]).sum()
        })
    });
    let ends = Ends {
        jets: jets.map(|jet| jet.value),
        derivatives: derivatives.map(|derivative| derivative.value),
        straightness: c.value,
    };
    Response { ends, derivatives_by_jets, parameters_by_jets }
}

#[cfg(test)]
mod tests;
