//! The catalogue as JSON: what `faircurve list --json` prints.

use faircurve::catalog::{ENTRIES, ParamKind, SplineInfo};
use serde::Serialize;

#[derive(Serialize)]
struct List {
    faircurve: u32,
    splines: Vec<SplineEntry>,
}

#[derive(Serialize)]
struct SplineEntry {
    name: &'static str,
    summary: &'static str,
    source: &'static str,
    params: Vec<ParamEntry>,
    default_join: &'static str,
    joins: Vec<&'static str>,
    /// The default first.
    ends: &'static [&'static str],
    claims: Vec<String>,
}

#[derive(Serialize)]
struct ParamEntry {
    name: &'static str,
    summary: &'static str,
    #[serde(flatten)]
    values: ValuesEntry,
}

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum ValuesEntry {
    Number { default: f64, min: f64, max: f64 },
    Choice { default: &'static str, options: &'static [&'static str] },
    Text { default: &'static str },
}

/// Every spline with its parameters, joins, ends and claims, in the order of the catalogue:
/// `{"faircurve": 1, "splines": [...]}`, ending in a line feed.
///
/// # Errors
/// None that can happen: the catalogue has words and finite numbers only.
pub fn write() -> Result<String, serde_json::Error> {
    let list = List { faircurve: 1, splines: ENTRIES.iter().map(|info| entry(info)).collect() };
    Ok(serde_json::to_string_pretty(&list)? + "\n")
}

fn entry(info: &SplineInfo) -> SplineEntry {
    let values = |kind: &ParamKind| match *kind {
        ParamKind::Number { default, min, max } => ValuesEntry::Number { default, min, max },
        ParamKind::Choice { options } => {
            ValuesEntry::Choice { default: options.first().copied().unwrap_or_default(), options }
        }
        ParamKind::Text { default } => ValuesEntry::Text { default },
    };
    SplineEntry {
        name: info.name,
        summary: info.summary,
        source: info.source,
        params: info
            .params
            .iter()
            .map(|p| ParamEntry { name: p.name, summary: p.summary, values: values(&p.kind) })
            .collect(),
        default_join: info.default_join.name(),
        joins: info.joins.iter().map(|join| join.name()).collect(),
        ends: info.ends,
        claims: info.claims.iter().map(ToString::to_string).collect(),
    }
}
