//! The log-aesthetic spline: segments cut from κ = sign(s)·|s|^α, joined with continuous curvature
//! (thesis section 4.8.1).

mod curve;

pub use curve::{LogAesthetic, LogAestheticCut};

use super::catalog::{Claim, ParamKind, ParamSpec, SplineInfo};
use super::ends;
use super::shapes::{self, SHAPE};
use crate::frame::ChordAngles;
use crate::outline::Join;
use crate::plan::Run;
use crate::spline::Effort;
use crate::tolerance::SOLVED;
use crate::two_param::continuity::{Continuity, NaturalEnd};
use crate::two_param::generating::Cuts;
use crate::two_param::spline::TwoParamSpline;
use crate::two_param::tangents::{TangentRule, Tangents};

/// The exponent that people liked best (thesis section 2.1.1).
pub const PREFERRED: f64 = 1.78;

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "log-aesthetic",
    summary: "cuts of κ = sign(s)·|s|^α with continuous curvature; α = 1 is euler",
    source: "thesis 4.8.1",
    params: &[
        ParamSpec {
            name: "alpha",
            summary: "the power with which curvature rises: higher is more local, and less fair",
            kind: ParamKind::Number {
                default: PREFERRED,
                min: LogAesthetic::LEAST,
                max: LogAesthetic::MOST,
            },
        },
        ends::END,
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
        Claim::Ripple(0.168_966_183_775_840_7),
    ],
    build: |params| {
        let end = ends::chosen(params);
        let curve = LogAesthetic::new(params.number("alpha", PREFERRED));
        let rule = AlongAlpha { curve, end };
        let shape = shapes::chosen(params, Cuts { curve });
        Ok(Box::new(TwoParamSpline::new(&INFO, rule, shape)))
    },
};

/// Continuity of curvature; where Newton's method doesn't settle, by way of the curves between the
/// Euler spiral and this one.
#[derive(Clone, Copy, Debug)]
struct AlongAlpha {
    curve: LogAesthetic,
    end: NaturalEnd,
}

impl AlongAlpha {
    fn continuity(&self, alpha: f64) -> Continuity<Cuts<LogAesthetic>> {
        Continuity { map: Cuts { curve: LogAesthetic::new(alpha) }, end: self.end }
    }
}

impl TangentRule for AlongAlpha {
    fn tangents(&self, run: &Run) -> Tangents {
        self.continuity(self.curve.alpha()).tangents(run)
    }

    fn tangents_near(&self, run: &Run, near: &[ChordAngles]) -> Tangents {
        self.continuity(self.curve.alpha()).tangents_near(run, near)
    }

    fn search(&self, run: &Run, effort: Effort) -> Tangents {
        /// How much log α may change in one step.
        const STRIDE: f64 = 0.2;
        let wanted = self.curve.alpha().ln();
        let steps = (wanted.abs() / STRIDE).ceil();
        let mut tangents = self.continuity(1.0).tangents(run);
        let mut i = 0.0;
        while i < steps {
            i += 1.0;
            let alpha = if i == steps { self.curve.alpha() } else { (wanted * i / steps).exp() };
            tangents = self.continuity(alpha).tangents_from(run, Some(&tangents.angles()));
        }
        if tangents.residual() <= SOLVED {
            return tangents;
        }
        self.continuity(self.curve.alpha()).search(run, effort)
    }
}

#[cfg(test)]
mod tests;
