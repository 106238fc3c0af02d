//! `faircurve list`.

use std::fmt::Write;
use std::process::ExitCode;

use faircurve::catalog::{ENTRIES, ParamKind, ParamSpec, SplineInfo, suggest};
use faircurve_format::catalogue_json;

use crate::args::ListArgs;
use crate::failure::Failure;
use crate::laws;
use crate::output::to_stdout;

pub(crate) fn run(args: &ListArgs) -> Result<ExitCode, Failure> {
    let text = match (args.format.as_str(), args.laws) {
        ("text", false) => as_text(),
        ("json", false) => catalogue_json::write().map_err(|e| Failure::new(e.to_string()))?,
        ("text", true) => laws::as_text()?,
        ("json", true) => laws::as_json()?,
        (other, _) => {
            return Err(Failure::new(format!("lists have no format `{other}`"))
                .hint(suggest(other, ["text", "json"])));
        }
    };
    to_stdout(text.as_bytes())?;
    Ok(ExitCode::SUCCESS)
}

fn as_text() -> String {
    let mut text = String::new();
    for info in ENTRIES {
        if !text.is_empty() {
            text.push('\n');
        }
        let _ = writeln!(text, "{}: {}", info.name, info.summary);
        let others = join_names(info).into_iter().filter(|name| *name != info.default_join.name());
        row(&mut text, "joins", &with_default(info.default_join.name(), others));
        row(&mut text, "ends", &with_default(first(info.ends), info.ends.iter().skip(1).copied()));
        for param in info.params {
            row(
                &mut text,
                "param",
                &format!("{}, {}; {}", param.name, values(param), param.summary),
            );
        }
        row(&mut text, "claims", &claim_names(info).join(", "));
        row(&mut text, "source", info.source);
    }
    text
}

fn row(text: &mut String, label: &str, value: &str) {
    if !value.is_empty() {
        let _ = writeln!(text, "  {label:<7} {value}");
    }
}

fn first(words: &[&'static str]) -> &'static str {
    words.first().copied().unwrap_or_default()
}

fn with_default<'a>(default: &str, others: impl Iterator<Item = &'a str>) -> String {
    let mut words = vec![format!("{default} (default)")];
    words.extend(others.map(str::to_owned));
    if default.is_empty() { String::new() } else { words.join(", ") }
}

fn values(param: &ParamSpec) -> String {
    match &param.kind {
        ParamKind::Number { default, min, max } => format!("{min} to {max}, default {default}"),
        ParamKind::Choice { options } => {
            with_default(first(options), options.iter().skip(1).copied())
        }
        ParamKind::Text { default } => format!("text, default {default}"),
    }
}

fn join_names(info: &SplineInfo) -> Vec<&'static str> {
    info.joins.iter().map(|join| join.name()).collect()
}

fn claim_names(info: &SplineInfo) -> Vec<String> {
    info.claims.iter().map(ToString::to_string).collect()
}
