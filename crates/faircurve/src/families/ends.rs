//! Natural ends by name: the choice that the families of round curves share, as the parameter `end`.

use super::catalog::{ParamKind, ParamSpec, Params};
use crate::two_param::continuity::NaturalEnd;

/// The ends, the default first.
pub const NAMES: &[&str] = &["arc", "zero-curvature"];

/// The parameter.
pub const END: ParamSpec = ParamSpec {
    name: "end",
    summary: "what holds at free ends: a circular arc, or zero curvature",
    kind: ParamKind::Choice { options: NAMES },
};

/// The end chosen.
pub fn chosen(params: &Params) -> NaturalEnd {
    match params.choice(END.name, NAMES[0]) {
        "zero-curvature" => NaturalEnd::ZeroCurvature,
        _ => NaturalEnd::Arc,
    }
}
