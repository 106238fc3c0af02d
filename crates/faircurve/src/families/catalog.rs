//! The catalogue: every spline by name, with its parameters, joins and claims.
//!
//! Adding a family touches its own folder and one line of [`ENTRIES`].

use std::fmt;

use crate::numeric::order::sort_by;
use crate::outline::Join;
use crate::spline::Spline;

use super::{
    akima, bespoke, circle, euler, generated, hobby, ikarus, kappa, kurgla1, lagrange,
    log_aesthetic, mec, mvc, polygon, simec, spiro,
};

/// Every spline, in the order in which lists show them.
#[rustfmt::skip]
pub const ENTRIES: &[&SplineInfo] = &[
    &spiro::INFO,
    &mvc::INFO,
    &euler::INFO,
    &log_aesthetic::INFO,
    &generated::INFO,
    &mec::INFO,
    &simec::INFO,
    &kurgla1::INFO,
    &hobby::INFO,
    &bespoke::INFO,
    &kappa::INFO,
    &circle::INFO,
    &ikarus::INFO,
    &akima::INFO,
    &lagrange::INFO,
    &polygon::INFO,
];

/// A catalogue row: what a spline is called, what it takes and what it claims.
#[derive(Debug)]
pub struct SplineInfo {
    /// The name used in documents and on the command line.
    pub name: &'static str,
    /// One line for lists.
    pub summary: &'static str,
    /// Where it is defined.
    pub source: &'static str,
    /// The parameters that it takes.
    pub params: &'static [ParamSpec],
    /// The join of a knot that names none.
    pub default_join: Join,
    /// The joins that it has; others are adapted.
    pub joins: &'static [Join],
    /// What holds at free ends, the default first.
    pub ends: &'static [&'static str],
    /// Properties of thesis chapter 2 that it claims (the laws test them).
    pub claims: &'static [Claim],
    /// Makes the spline from checked parameters.
    pub build: fn(&Params) -> Result<Box<dyn Spline>, CatalogError>,
}

impl SplineInfo {
    /// The order of geometric continuity that it claims; 0 where it claims none.
    pub fn continuity(&self) -> u8 {
        let order = |claim: &Claim| match claim {
            Claim::Continuity(order) => Some(*order),
            _ => None,
        };
        self.claims.iter().find_map(order).unwrap_or(0)
    }
}

/// A property in the sense of thesis chapter 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Claim {
    /// Points on a circle give the circle (2.3).
    Round,
    /// The closed curve through n points evenly on a circle leaves it by O(n⁻ᵏ) (2.3).
    RoundToOrder(u8),
    /// A knot added on the curve doesn't change it (2.4).
    Extensional,
    /// Every segment is cut from one curve, up to similarity and mirror (4.1, Theorem 1).
    GeneratingCurve,
    /// Curvature is monotone between knots (2.9).
    MonotoneCurvature,
    /// Similarities carry the curve with them (2.7).
    SimilarityInvariant,
    /// Mirroring and travelling backwards carry the curve with them (2.7).
    Symmetric,
    /// Affine maps carry the curve with them (2.7).
    AffineInvariant,
    /// Geometric continuity of this order at its default smooth join (2.2).
    Continuity(u8),
    /// Number of parameters of a segment (2.8).
    Parameters(u8),
    /// A small push of one knot makes a ripple that shrinks by this factor from knot to knot on
    /// straight, evenly spaced knots (2.6).
    Ripple(f64),
    /// Moving a knot changes this many segments on either side, and no others (2.6).
    FiniteSupport(u8),
    /// There is a curve for any knots (2.5).
    Exists,
    /// Small moves of the knots move the curve little, whatever the knots (2.5).
    Continuous,
}

impl fmt::Display for Claim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Claim::Round => f.write_str("round"),
            Claim::RoundToOrder(order) => write!(f, "round-to-order-{order}"),
            Claim::Extensional => f.write_str("extensional"),
            Claim::GeneratingCurve => f.write_str("generating-curve"),
            Claim::MonotoneCurvature => f.write_str("monotone-curvature"),
            Claim::SimilarityInvariant => f.write_str("similarity-invariant"),
            Claim::Symmetric => f.write_str("symmetric"),
            Claim::AffineInvariant => f.write_str("affine-invariant"),
            Claim::Ripple(factor) => write!(f, "ripple-{factor:.3}"),
            Claim::FiniteSupport(segments) => write!(f, "support-{segments}"),
            Claim::Exists => f.write_str("exists"),
            Claim::Continuous => f.write_str("continuous"),
            Claim::Continuity(order) => write!(f, "g{order}"),
            Claim::Parameters(count) => write!(f, "{count}-parameter"),
        }
    }
}

/// A parameter that a spline takes.
#[derive(Debug)]
pub struct ParamSpec {
    /// The name used in documents and on the command line.
    pub name: &'static str,
    /// One line for lists.
    pub summary: &'static str,
    /// What values it takes.
    pub kind: ParamKind,
}

/// The values that a parameter takes, with the default.
#[derive(Debug)]
pub enum ParamKind {
    /// A number in `min ..= max`.
    Number {
        /// The value when none is given.
        default: f64,
        /// The smallest value allowed.
        min: f64,
        /// The largest value allowed.
        max: f64,
    },
    /// One of some words.
    Choice {
        /// The words; the first is the default.
        options: &'static [&'static str],
    },
    /// Any text that the spline can read.
    Text {
        /// The text when none is given.
        default: &'static str,
    },
}

/// A parameter's value as given.
#[derive(Clone, Debug, PartialEq)]
pub enum ParamValue {
    /// A number.
    Number(f64),
    /// A word.
    Text(String),
}

impl fmt::Display for ParamValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ParamValue::Number(number) => write!(f, "{number}"),
            ParamValue::Text(text) => f.write_str(text),
        }
    }
}

impl From<&str> for ParamValue {
    /// Reads a number where the text is one, as on a command line.
    fn from(text: &str) -> Self {
        match text.parse::<f64>() {
            Ok(number) => ParamValue::Number(number),
            Err(_) => ParamValue::Text(text.to_owned()),
        }
    }
}

/// Parameters by name.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Params(Vec<(String, ParamValue)>); // In order of their names: a handful needs no map.

impl Params {
    /// No parameters: every default.
    pub fn new() -> Self {
        Params::default()
    }

    /// The same with one more set.
    pub fn with(mut self, name: &str, value: impl Into<ParamValue>) -> Self {
        self.set(name, value);
        self
    }

    /// Sets one.
    pub fn set(&mut self, name: &str, value: impl Into<ParamValue>) {
        let value = value.into();
        match self.place(name) {
            Ok(i) => self.0[i].1 = value,
            Err(i) => self.0.insert(i, (name.to_owned(), value)),
        }
    }

    /// What is set, by name.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &ParamValue)> {
        self.0.iter().map(|(name, value)| (name.as_str(), value))
    }

    /// Where a parameter is, or belongs.
    fn place(&self, name: &str) -> Result<usize, usize> {
        self.0.binary_search_by(|(other, _)| other.as_str().cmp(name))
    }

    fn get(&self, name: &str) -> Option<&ParamValue> {
        self.place(name).ok().map(|i| &self.0[i].1)
    }

    /// Whether every parameter has its default.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The word chosen for `name`, or `default`. For use in [`SplineInfo::build`], after checking.
    pub fn choice<'a>(&'a self, name: &str, default: &'a str) -> &'a str {
        match self.get(name) {
            Some(ParamValue::Text(text)) => text,
            _ => default,
        }
    }

    /// The text given for `name`, or `default`: a number is text too. For use in
    /// [`SplineInfo::build`].
    pub fn text(&self, name: &str, default: &str) -> String {
        self.get(name).map_or_else(|| default.to_owned(), ParamValue::to_string)
    }

    /// The number given for `name`, or `default`. For use in [`SplineInfo::build`], after checking.
    pub fn number(&self, name: &str, default: f64) -> f64 {
        match self.get(name) {
            Some(ParamValue::Number(number)) => *number,
            _ => default,
        }
    }
}

impl From<f64> for ParamValue {
    fn from(number: f64) -> Self {
        ParamValue::Number(number)
    }
}

/// Why the catalogue can't make a spline.
#[derive(Clone, Debug, PartialEq)]
pub enum CatalogError {
    /// No spline of that name.
    UnknownSpline {
        /// The name asked for.
        asked: String,
        /// The names that there are.
        known: Vec<&'static str>,
    },
    /// The spline has no parameter of that name.
    UnknownParam {
        /// The spline.
        spline: &'static str,
        /// The name asked for.
        asked: String,
        /// The names of those that it takes.
        known: Vec<&'static str>,
    },
    /// The parameter doesn't take that value.
    BadValue {
        /// The spline.
        spline: &'static str,
        /// The parameter.
        param: &'static str,
        /// The value given.
        value: String,
        /// What it takes instead.
        expected: String,
    },
    /// The parameter takes text, but can't make sense of this one.
    BadText {
        /// The spline.
        spline: &'static str,
        /// The parameter.
        param: &'static str,
        /// The text given.
        value: String,
        /// What is wrong with it.
        reason: String,
        /// What it takes instead.
        expected: String,
    },
}

impl fmt::Display for CatalogError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CatalogError::UnknownSpline { asked, .. } => write!(f, "there is no spline `{asked}`"),
            CatalogError::UnknownParam { spline, asked, .. } => {
                write!(f, "spline `{spline}` has no parameter `{asked}`")
            }
            CatalogError::BadValue { spline, param, value, .. } => {
                write!(f, "parameter `{param}` of spline `{spline}` can't be `{value}`")
            }
            CatalogError::BadText { spline, param, value, reason, .. } => {
                write!(f, "parameter `{param}` of spline `{spline}` can't be `{value}`: {reason}")
            }
        }
    }
}

impl std::error::Error for CatalogError {}

impl CatalogError {
    /// What to do about it.
    pub fn hint(&self) -> String {
        match self {
            CatalogError::UnknownParam { spline, known, .. } if known.is_empty() => {
                format!("`{spline}` takes no parameters; leave it out")
            }
            CatalogError::UnknownSpline { asked, known }
            | CatalogError::UnknownParam { asked, known, .. } => {
                suggest(asked, known.iter().copied())
            }
            CatalogError::BadValue { expected, .. } | CatalogError::BadText { expected, .. } => {
                format!("it takes {expected}")
            }
        }
    }
}

/// The row of that name.
///
/// # Errors
/// [`CatalogError::UnknownSpline`].
pub fn find(name: &str) -> Result<&'static SplineInfo, CatalogError> {
    find_among(ENTRIES, name)
}

/// The spline of that name with every default.
///
/// # Errors
/// [`CatalogError::UnknownSpline`].
pub fn spline(name: &str) -> Result<Box<dyn Spline>, CatalogError> {
    build(name, &Params::new())
}

/// The spline of that name with the given parameters.
///
/// # Errors
/// [`CatalogError`] if the name, a parameter's name or its value isn't one that the catalogue has.
pub fn build(name: &str, params: &Params) -> Result<Box<dyn Spline>, CatalogError> {
    build_among(ENTRIES, name, params)
}

/// The same from some rows alone: a program that never names [`ENTRIES`] holds no other splines.
///
/// # Errors
/// As for [`build`].
pub fn build_among(
    rows: &[&'static SplineInfo],
    name: &str,
    params: &Params,
) -> Result<Box<dyn Spline>, CatalogError> {
    let info = find_among(rows, name)?;
    for (asked, value) in params.iter() {
        let spec = info.params.iter().find(|spec| spec.name == asked).ok_or_else(|| {
            CatalogError::UnknownParam {
                spline: info.name,
                asked: asked.to_owned(),
                known: info.params.iter().map(|spec| spec.name).collect(),
            }
        })?;
        spec.check(value).map_err(|expected| CatalogError::BadValue {
            spline: info.name,
            param: spec.name,
            value: value.to_string(),
            expected,
        })?;
    }
    (info.build)(params)
}

fn find_among(
    rows: &[&'static SplineInfo],
    name: &str,
) -> Result<&'static SplineInfo, CatalogError> {
    rows.iter().copied().find(|info| info.name == name).ok_or_else(|| {
        let known = rows.iter().map(|info| info.name).collect();
        CatalogError::UnknownSpline { asked: name.to_owned(), known }
    })
}

impl ParamSpec {
    /// Whether it takes this value; if not, the words for what it takes.
    fn check(&self, value: &ParamValue) -> Result<(), String> {
        match (&self.kind, value) {
            (ParamKind::Number { min, max, .. }, ParamValue::Number(number))
                if (min..=max).contains(&number) =>
            {
                Ok(())
            }
            (ParamKind::Number { min, max, .. }, _) => Err(format!("a number from {min} to {max}")),
            (ParamKind::Choice { options }, ParamValue::Text(text))
                if options.contains(&text.as_str()) =>
            {
                Ok(())
            }
            (ParamKind::Choice { options }, _) => Err(one_of(options.iter().copied())),
            // The spline itself says what it makes of it.
            (ParamKind::Text { .. }, _) => Ok(()),
        }
    }
}

/// Words that name the candidates nearest to what was asked, or all of them.
///
/// ```
/// use faircurve::catalog::suggest;
/// assert_eq!(suggest("spirro", ["spiro", "euler"]), "did you mean `spiro`?");
/// assert_eq!(suggest("xyz", ["spiro", "euler"]), "use one of `spiro`, `euler`");
/// ```
pub fn suggest<'a>(asked: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    suggest_among(asked, &candidates.into_iter().collect::<Vec<_>>())
}

fn suggest_among(asked: &str, candidates: &[&str]) -> String {
    // Below 0.7 Jaro–Winkler calls unrelated words alike.
    const ALIKE: f64 = 0.75;
    let asked_lower = asked.to_ascii_lowercase();
    let likeness =
        |candidate: &str| strsim::jaro_winkler(&asked_lower, &candidate.to_ascii_lowercase());
    let mut near: Vec<(f64, &str)> = candidates
        .iter()
        .map(|candidate| (likeness(candidate), *candidate))
        .filter(|(likeness, _)| *likeness > ALIKE)
        .collect();
    sort_by(&mut near, |a, b| b.0.total_cmp(&a.0));
    near.truncate(3);
    match near.as_slice() {
        [] if candidates.is_empty() => "leave it out".to_owned(),
        [] => format!("use {}", one_of(candidates.iter().copied())),
        [only] => format!("did you mean `{}`?", only.1),
        several => format!("did you mean {}?", one_of(several.iter().map(|(_, name)| *name))),
    }
}

fn one_of<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = words.into_iter().map(|word| format!("`{word}`")).collect();
    match quoted.as_slice() {
        [only] => only.clone(),
        several => format!("one of {}", several.join(", ")),
    }
}
