//! The log-aesthetic spline: segments cut from κ = sign(s)·|s|^α, joined with continuous curvature
//! (thesis section 4.8.1).

mod curve;

pub use curve::{LogAesthetic, LogAestheticCut};

use super::catalog::{Claim, ParamKind, ParamSpec, SplineInfo};
use super::shapes::{self, SHAPE};
use crate::outline::Join;
use crate::two_param::continuity::{Continuity, NaturalEnd};
use crate::two_param::generating::Cuts;
use crate::two_param::spline::TwoParamSpline;

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
        ParamSpec {
            name: "end",
            summary: "what holds at free ends: a circular arc, or zero curvature",
            kind: ParamKind::Choice { options: &["arc", "zero-curvature"] },
        },
        SHAPE,
    ],
    default_join: Join::G2,
    joins: &[Join::Corner, Join::G1, Join::G2],
    ends: &["arc", "zero-curvature"],
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
        let end = match params.choice("end", "arc") {
            "zero-curvature" => NaturalEnd::ZeroCurvature,
            _ => NaturalEnd::Arc,
        };
        let curve = LogAesthetic::new(params.number("alpha", PREFERRED));
        let rule = Continuity { map: Cuts { curve }, end };
        let shape = shapes::chosen(params, Cuts { curve });
        Ok(Box::new(TwoParamSpline::new(&INFO, rule, shape)))
    },
};

#[cfg(test)]
mod tests;
