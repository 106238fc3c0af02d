//! The faircurve document: JSON that holds everything a [`Document`] does.
//!
//! ```json
//! { "faircurve": 1, "spline": "spiro", "params": {},
//!   "glyphs": [ { "name": "a", "layer": "Fore", "contours": [ { "closed": true, "knots": [
//!       {"x": 0, "y": 0, "join": "g4"},
//!       {"x": 90, "y": 10, "join": "corner", "tangent_out": [1, 0]} ] } ] } ] }
//! ```
//!
//! - `faircurve` is the format's version and required.
//! - `spline` is `spiro` and `closed` is `false` where they are left out; `params` is empty. A
//!   contour may have its own `spline`, `params`, or both; `params` alone go to the document's
//!   spline, in place of the document's `params`.
//! - `contours` in place of `glyphs` is one unnamed glyph.
//! - `x` and `y` are required, every other key of a knot is optional: `join` (a
//!   [`Join`]'s name; left out, the spline's own), the vectors `tangent` (both sides),
//!   `tangent_in`, `tangent_out`, and the numbers `curvature_in`, `curvature_out`, `tension_in`,
//!   `tension_out`, `curl`.
//! - An unknown key, a key given twice, a number that isn't finite, a contour without knots and
//!   a direction without length are errors.

use std::borrow::Cow;
use std::fmt::{self, Write as _};
use std::ops::Range;

use faircurve::catalog::{self, CatalogError, ParamValue, Params, suggest};
use faircurve::kurbo::{Point, Vec2};
use faircurve::{Contour, Join, Knot};
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

use crate::document::{Document, DocumentContour, Glyph, SplineChoice};
use crate::error::FormatError;
use crate::number;
use crate::text::text_of;

/// The version that this module reads and writes.
const VERSION: &str = "1";

type Result<T> = std::result::Result<T, FormatError>;

/// Reads a document.
///
/// # Errors
/// [`FormatError`] at the offending token, with the glyph, contour and knot (counted from 0) that
/// it is in.
pub fn read(bytes: &[u8]) -> Result<Document> {
    let source = Source { text: text_of(bytes)?, bytes };
    let root = source.parse()?;
    let [version, spline, params, glyphs, contours] =
        source.object(root, "", ["faircurve", "spline", "params", "glyphs", "contours"])?;

    let version = version.ok_or_else(|| {
        FormatError::new("this is not a faircurve document: it has no key `faircurve`")
            .at(bytes, first_byte(source.span(root)))
            .hint(format!("start it with `{{ \"faircurve\": {VERSION}, …`"))
    })?;
    if version.get() != VERSION {
        let message = format!("version {} is unknown", number::excerpt(version.get()));
        let hint = format!("this program reads version {VERSION}");
        return Err(source.error(version, message).hint(hint));
    }

    let default = SplineChoice::default();
    let spline = source.spline_choice(spline, params, &default, "")?.unwrap_or(default);
    let glyphs = match (glyphs, contours) {
        (Some(glyphs), None) => source
            .array(glyphs, "`glyphs`")?
            .into_iter()
            .enumerate()
            .map(|(index, glyph)| source.glyph(glyph, index, &spline))
            .collect::<Result<Vec<_>>>()?,
        (None, Some(contours)) => {
            vec![Glyph { contours: source.contours(contours, "", &spline)?, ..Glyph::default() }]
        }
        (Some(_), Some(contours)) => {
            return Err(source
                .error(contours, "the document has both `glyphs` and `contours`")
                .hint("move these contours into a glyph"));
        }
        (None, None) => {
            return Err(FormatError::new("the document has neither `glyphs` nor `contours`")
                .at(bytes, first_byte(source.span(root)))
                .hint("add `\"contours\": […]`"));
        }
    };
    Ok(Document { spline, glyphs })
}

/// A JSON text. Its values are slices of it ([`RawValue`]), so that every one knows its place.
struct Source<'a> {
    text: &'a str,
    /// The file, of which the text is all but a byte order mark.
    bytes: &'a [u8],
}

type Value<'a> = &'a RawValue;

impl<'a> Source<'a> {
    /// Checks that the whole text is JSON.
    fn parse(&self) -> Result<Value<'a>> {
        serde_json::from_str(self.text).map_err(|error| self.syntax_error(&error))
    }

    /// The bytes of the file that `value` is.
    fn span(&self, value: Value<'a>) -> Range<usize> {
        // Both are slices of the file; their addresses differ by the offset.
        let start = value.get().as_ptr().addr().wrapping_sub(self.bytes.as_ptr().addr());
        start..start.saturating_add(value.get().len())
    }

    /// An error at a value; only at the first byte of an object or list.
    fn error(&self, value: Value<'a>, message: impl Into<String>) -> FormatError {
        let span = match value.get().as_bytes() {
            [b'{' | b'[', ..] => first_byte(self.span(value)),
            _ => self.span(value),
        };
        FormatError::new(message).at(self.bytes, span)
    }

    fn wrong_type(&self, value: Value<'a>, what: &str, expected: &str) -> FormatError {
        self.error(value, format!("{what} must be {expected}, not {}", describe(value)))
    }

    /// An object's values by key. `place` says whose keys they are and ends messages' prefix.
    fn object<const N: usize>(
        &self,
        value: Value<'a>,
        place: &str,
        keys: [&'static str; N],
    ) -> Result<[Option<Value<'a>>; N]> {
        let mut values = [None; N];
        for (key, key_token, value) in self.entries(value, place)? {
            let Some(index) = keys.iter().position(|known| *known == key) else {
                let message = format!("{place}there is no key `{}` here", number::excerpt(&key));
                return Err(self.error(key_token, message).hint(suggest(&key, keys)));
            };
            if values[index].replace(value).is_some() {
                return Err(self.duplicate(key_token, &key, place));
            }
        }
        Ok(values)
    }

    /// An object's keys and values in order, each key with its token.
    fn entries(
        &self,
        value: Value<'a>,
        place: &str,
    ) -> Result<Vec<(Cow<'a, str>, Value<'a>, Value<'a>)>> {
        if !value.get().starts_with('{') {
            return Err(self.wrong_type(value, owner(place), "an object"));
        }
        let Entries(entries) = self.reparse(value)?;
        entries.into_iter().map(|(key, value)| Ok((self.unquote(key)?, key, value))).collect()
    }

    fn duplicate(&self, key_token: Value<'a>, key: &str, place: &str) -> FormatError {
        self.error(key_token, format!("{place}the key `{}` is given twice", number::excerpt(key)))
            .hint("leave one of them out")
    }

    fn array(&self, value: Value<'a>, what: &str) -> Result<Vec<Value<'a>>> {
        if !value.get().starts_with('[') {
            return Err(self.wrong_type(value, what, "a list"));
        }
        self.reparse(value)
    }

    fn string(&self, value: Value<'a>, what: &str) -> Result<Cow<'a, str>> {
        if !value.get().starts_with('"') {
            return Err(self.wrong_type(value, what, "a string"));
        }
        self.unquote(value)
    }

    fn unquote(&self, token: Value<'a>) -> Result<Cow<'a, str>> {
        let inside = &token.get()[1..token.get().len() - 1];
        if inside.contains('\\') { self.reparse(token).map(Cow::Owned) } else { Ok(inside.into()) }
    }

    fn boolean(&self, value: Value<'a>, what: &str) -> Result<bool> {
        match value.get() {
            "true" => Ok(true),
            "false" => Ok(false),
            _ => Err(self.wrong_type(value, what, "`true` or `false`")),
        }
    }

    fn number(
        &self,
        value: Value<'a>,
        place: &str,
        key: &str,
        parse: fn(&str) -> std::result::Result<f64, String>,
    ) -> Result<f64> {
        if !value.get().starts_with(|first: char| first == '-' || first.is_ascii_digit()) {
            return Err(self.wrong_type(value, &format!("{place}`{key}`"), "a number"));
        }
        parse(value.get()).map_err(|wrong| self.error(value, format!("{place}`{key}`: {wrong}")))
    }

    fn direction(&self, value: Value<'a>, place: &str, key: &str) -> Result<Vec2> {
        let what = format!("{place}`{key}`");
        let parts = match value.get().as_bytes() {
            [b'[', ..] => self.array(value, &what)?,
            _ => return Err(self.wrong_type(value, &what, "a vector such as [1, 0]")),
        };
        let [x, y] = parts[..] else {
            let message = format!("{what} must have 2 numbers, not {}", parts.len());
            return Err(self.error(value, message).hint("give a vector such as [1, 0]"));
        };
        let vector = Vec2::new(
            self.number(x, place, &format!("{key}[0]"), number::parse)?,
            self.number(y, place, &format!("{key}[1]"), number::parse)?,
        );
        if vector == Vec2::ZERO {
            return Err(self
                .error(value, format!("{what} has no length, so no direction"))
                .hint("give a vector such as [1, 0], or leave it out"));
        }
        Ok(vector)
    }

    /// Reads a part of the text that is known to be JSON; what can still fail is an escape.
    fn reparse<T: Deserialize<'a>>(&self, value: Value<'a>) -> Result<T> {
        serde_json::from_str(value.get())
            .map_err(|error| self.error(value, format!("malformed JSON: {}", reason(&error))))
    }

    fn glyph(&self, value: Value<'a>, index: usize, default: &SplineChoice) -> Result<Glyph> {
        let unnamed = format!("glyph {index}: ");
        let [name, layer, contours] =
            self.object(value, &unnamed, ["name", "layer", "contours"])?;
        let text = |value: Option<Value<'a>>, key: &str| match value {
            Some(value) => self.string(value, &format!("{unnamed}`{key}`")).map(Cow::into_owned),
            None => Ok(String::new()),
        };
        let (name, layer) = (text(name, "name")?, text(layer, "layer")?);
        let place = match name.as_str() {
            "" => unnamed,
            name => format!("glyph `{}`: ", number::excerpt(name)),
        };
        let contours = contours.ok_or_else(|| self.missing(value, &place, "contours"))?;
        let contours = self.contours(contours, &place, default)?;
        Ok(Glyph { name, layer, contours })
    }

    fn contours(
        &self,
        value: Value<'a>,
        place: &str,
        default: &SplineChoice,
    ) -> Result<Vec<DocumentContour>> {
        self.array(value, &format!("{place}`contours`"))?
            .into_iter()
            .enumerate()
            .map(|(index, contour)| self.contour(contour, &inner(place, "contour", index), default))
            .collect()
    }

    fn contour(
        &self,
        value: Value<'a>,
        place: &str,
        default: &SplineChoice,
    ) -> Result<DocumentContour> {
        let [closed, knots, spline, params] =
            self.object(value, place, ["closed", "knots", "spline", "params"])?;
        let closed = match closed {
            Some(closed) => self.boolean(closed, &format!("{place}`closed`"))?,
            None => false,
        };
        let knots_list = knots.ok_or_else(|| self.missing(value, place, "knots"))?;
        let knots = self
            .array(knots_list, &format!("{place}`knots`"))?
            .into_iter()
            .enumerate()
            .map(|(index, knot)| self.knot(knot, &inner(place, "knot", index)))
            .collect::<Result<Vec<_>>>()?;
        if knots.is_empty() {
            return Err(self
                .error(knots_list, format!("{} has no knots", owner(place)))
                .hint("give it at least one knot, or leave the contour out"));
        }
        let spline = self.spline_choice(spline, params, default, place)?;
        Ok(DocumentContour { contour: Contour { knots, closed }, spline })
    }

    fn knot(&self, value: Value<'a>, place: &str) -> Result<Knot> {
        let [x, y, join, tangent, tangent_in, tangent_out, numbers @ ..] =
            self.object(value, place, KNOT_KEYS)?;
        let coordinate = |coordinate: Option<Value<'a>>, key: &str| match coordinate {
            Some(value) => self.number(value, place, key, number::parse_coordinate),
            None => Err(self.missing(value, place, key)),
        };
        let point = Point::new(coordinate(x, "x")?, coordinate(y, "y")?);

        let direction = |value: Option<Value<'a>>, key: &str| {
            value.map(|value| self.direction(value, place, key)).transpose()
        };
        let both = direction(tangent, "tangent")?;
        if let (Some(_), Some(side)) = (both, tangent_in.or(tangent_out)) {
            let message = format!("{place}`tangent` gives both sides, so no other may be given");
            let hint = "give `tangent`, or `tangent_in` and `tangent_out`";
            return Err(self.error(side, message).hint(hint));
        }

        let mut optional = [None; 5];
        for ((number, key), value) in optional.iter_mut().zip(&KNOT_KEYS[6..]).zip(numbers) {
            *number =
                value.map(|value| self.number(value, place, key, number::parse)).transpose()?;
        }
        let [curvature_in, curvature_out, tension_in, tension_out, curl] = optional;
        Ok(Knot {
            point,
            join: join.map(|join| self.join(join, place)).transpose()?,
            tangent_in: both.or(direction(tangent_in, "tangent_in")?),
            tangent_out: both.or(direction(tangent_out, "tangent_out")?),
            curvature_in,
            curvature_out,
            tension_in,
            tension_out,
            curl,
        })
    }

    fn join(&self, value: Value<'a>, place: &str) -> Result<Join> {
        let name = self.string(value, &format!("{place}`join`"))?;
        Join::from_name(&name).ok_or_else(|| {
            self.error(value, format!("{place}there is no join `{}`", number::excerpt(&name)))
                .hint(suggest(&name, Join::ALL.map(Join::name)))
        })
    }

    /// The spline that an object names, if it has either key; the catalogue must know it.
    fn spline_choice(
        &self,
        spline: Option<Value<'a>>,
        params: Option<Value<'a>>,
        default: &SplineChoice,
        place: &str,
    ) -> Result<Option<SplineChoice>> {
        let Some(whole) = spline.or(params) else {
            return Ok(None);
        };
        let mut choice = SplineChoice::new(match spline {
            Some(spline) => self.string(spline, &format!("{place}`spline`"))?.into_owned(),
            None => default.name.clone(),
        });
        let refused = |token: Value<'a>, error: CatalogError| {
            self.error(token, format!("{place}{error}")).hint(error.hint())
        };
        catalog::find(&choice.name).map_err(|error| refused(whole, error))?;
        let Some(params) = params else {
            return Ok(Some(choice));
        };
        let mut seen: Vec<Cow<'a, str>> = Vec::new();
        for (name, name_token, value) in self.entries(params, &format!("{place}`params`: "))? {
            let given = if value.get().starts_with('"') {
                ParamValue::Text(self.unquote(value)?.into_owned())
            } else if value.get().starts_with(|c: char| c == '-' || c.is_ascii_digit()) {
                ParamValue::Number(self.number(value, place, &name, number::parse)?)
            } else {
                let what = format!("{place}parameter `{}`", number::excerpt(&name));
                return Err(self.wrong_type(value, &what, "a number or a string"));
            };
            // Alone, so that an error is this parameter's.
            catalog::build(&choice.name, &Params::new().with(&name, given.clone())).map_err(
                |error| match error {
                    CatalogError::BadValue { .. } | CatalogError::BadText { .. } => {
                        refused(value, error)
                    }
                    _ => refused(name_token, error),
                },
            )?;
            if seen.contains(&name) {
                return Err(self.duplicate(name_token, &name, place));
            }
            choice.params.set(&name, given);
            seen.push(name);
        }
        catalog::build(&choice.name, &choice.params).map_err(|error| refused(whole, error))?;
        Ok(Some(choice))
    }

    fn missing(&self, value: Value<'a>, place: &str, key: &str) -> FormatError {
        self.error(value, format!("{place}the key `{key}` is missing"))
    }

    /// What serde_json found wrong with the text as a whole.
    fn syntax_error(&self, error: &serde_json::Error) -> FormatError {
        let line_start = match error.line() {
            0 | 1 => 0,
            line => self.text.match_indices('\n').nth(line - 2).map_or(0, |(at, _)| at + 1),
        };
        let at = (line_start + error.column().saturating_sub(1)).min(self.text.len());
        let start = self.bytes.len() - self.text.len();
        if error.is_eof() {
            let message = match self.text.trim_ascii() {
                "" => "the file is empty".to_owned(),
                _ => format!("the file ends too early, {}", unfinished(&reason(error))),
            };
            let end = self.bytes.len();
            return FormatError::new(message)
                .at(self.bytes, end..end)
                .hint("complete the file; it may have been cut off");
        }
        let token = token_around(self.text, at);
        let found = &self.text[token.clone()];
        let message = match found {
            "" => format!("malformed JSON: {}", reason(error)),
            found => {
                format!("malformed JSON: {}, found `{}`", reason(error), number::excerpt(found))
            }
        };
        let span = token.start + start..token.end + start;
        let error = FormatError::new(message).at(self.bytes, span);
        match SYNTAX_HINTS.iter().find(|(starts, _)| starts.iter().any(|s| found.starts_with(s))) {
            Some((_, hint)) => error.hint(*hint),
            None => error,
        }
    }
}

/// The keys of a knot; numbers without more to them come last.
const KNOT_KEYS: [&str; 11] = [
    "x",
    "y",
    "join",
    "tangent",
    "tangent_in",
    "tangent_out",
    "curvature_in",
    "curvature_out",
    "tension_in",
    "tension_out",
    "curl",
];

/// What people write that isn't JSON, and what to write instead.
const SYNTAX_HINTS: &[(&[&str], &str)] = &[
    (
        &["NaN", "nan", "Inf", "inf", "-Inf", "-inf", "-NaN", "-nan"],
        "only finite numbers have a place in a drawing",
    ),
    (&["'"], "strings stand in double quotes"),
    (&["/", "#"], "JSON has no comments"),
    (&["+", "."], "write numbers such as 0.5 or -12"),
    (&["}", "]"], "a comma before it may be one too many"),
    (&["True", "False", "None"], "write `true`, `false`, or leave the key out"),
];

/// An object's keys and values as they stand, in order.
struct Entries<'a>(Vec<(Value<'a>, Value<'a>)>);

impl<'de> Deserialize<'de> for Entries<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct InOrder;
        impl<'de> Visitor<'de> for InOrder {
            type Value = Entries<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(
                self,
                mut map: A,
            ) -> std::result::Result<Entries<'de>, A::Error> {
                let mut entries = Vec::with_capacity(4);
                while let Some(entry) = map.next_entry()? {
                    entries.push(entry);
                }
                Ok(Entries(entries))
            }
        }
        deserializer.deserialize_map(InOrder)
    }
}

/// Whose place it is.
fn owner(place: &str) -> &str {
    place.strip_suffix(": ").unwrap_or("the document")
}

/// The place of the `index`th `what` inside `place`.
fn inner(place: &str, what: &str, index: usize) -> String {
    match place.strip_suffix(": ") {
        Some(outer) => format!("{outer}, {what} {index}: "),
        None => format!("{what} {index}: "),
    }
}

fn first_byte(span: Range<usize>) -> Range<usize> {
    span.start..span.start + 1
}

fn describe(value: Value<'_>) -> String {
    match value.get().as_bytes() {
        [b'{', ..] => "an object".to_owned(),
        [b'[', ..] => "a list".to_owned(),
        [b'"', ..] => format!("the string {}", number::excerpt(value.get())),
        _ => format!("`{}`", number::excerpt(value.get())),
    }
}

/// serde_json's words without the place that they end with.
fn reason(error: &serde_json::Error) -> String {
    let words = error.to_string();
    match words.rfind(" at line ") {
        Some(place) => words[..place].to_owned(),
        None => words,
    }
}

/// "EOF while parsing a list" in the words of a message.
fn unfinished(reason: &str) -> String {
    match reason.strip_prefix("EOF while parsing ") {
        Some(what @ ("a value" | "a list" | "a string" | "an object")) => format!("inside {what}"),
        Some(what) => format!("inside a {what}").replace("a an ", "an ").replace("a a ", "a "),
        None => reason.to_owned(),
    }
}

/// The word, number or sign at (or, if only blanks stand there, nowhere near) byte `at`.
fn token_around(text: &str, at: usize) -> Range<usize> {
    let at = (0..=at).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
    let is_word = |c: char| c.is_alphanumeric() || "+-._".contains(c);
    let word_before: usize =
        text[..at].chars().rev().take_while(|&c| is_word(c)).map(char::len_utf8).sum();
    let word_after: usize =
        text[at..].chars().take_while(|&c| is_word(c)).map(char::len_utf8).sum();
    match text[at..].chars().next() {
        Some(c) if is_word(c) => at - word_before..at + word_after,
        Some(c) if !c.is_whitespace() => at..at + c.len_utf8(),
        _ => at..at,
    }
}

/// Writes a document: one knot a line; [`read`] gives the same document back, every bit of its
/// numbers included.
///
/// # Errors
/// [`FormatError`] if a number isn't finite.
pub fn write(document: &Document) -> Result<String> {
    let mut out = String::new();
    let choice = |choice: &SplineChoice| -> Result<String> {
        let mut text = format!("\"spline\": {}", quote(&choice.name));
        if !choice.params.is_empty() {
            let params = choice
                .params
                .iter()
                .map(|(name, value)| {
                    let value = match value {
                        ParamValue::Number(number) => finite(*number, name)?,
                        ParamValue::Text(text) => quote(text),
                    };
                    Ok(format!("{}: {value}", quote(name)))
                })
                .collect::<Result<Vec<_>>>()?;
            let _ = write!(text, ", \"params\": {{{}}}", params.join(", "));
        }
        Ok(text)
    };
    let _ = write!(out, "{{\n  \"faircurve\": {VERSION},\n  {},\n", choice(&document.spline)?);
    out.push_str("  \"glyphs\": [");
    for (index, glyph) in document.glyphs.iter().enumerate() {
        out.push_str(if index == 0 { "\n    {" } else { ",\n    {" });
        for (key, text) in [("name", &glyph.name), ("layer", &glyph.layer)] {
            if !text.is_empty() {
                let _ = write!(out, "\"{key}\": {}, ", quote(text));
            }
        }
        out.push_str("\"contours\": [");
        for (index, contour) in glyph.contours.iter().enumerate() {
            out.push_str(if index == 0 { "\n      {" } else { ",\n      {" });
            if let Some(own) = &contour.spline {
                let _ = write!(out, "{}, ", choice(own)?);
            }
            let _ = write!(out, "\"closed\": {}, \"knots\": [", contour.contour.closed);
            for (index, knot) in contour.contour.knots.iter().enumerate() {
                out.push_str(if index == 0 { "\n        " } else { ",\n        " });
                write_knot(&mut out, knot)?;
            }
            out.push_str("\n      ]}");
        }
        out.push_str(if glyph.contours.is_empty() { "]}" } else { "\n    ]}" });
    }
    out.push_str(if document.glyphs.is_empty() { "]\n}\n" } else { "\n  ]\n}\n" });
    Ok(out)
}

fn write_knot(out: &mut String, knot: &Knot) -> Result<()> {
    let (x, y) = (finite(knot.point.x, "x")?, finite(knot.point.y, "y")?);
    let _ = write!(out, "{{\"x\": {x}, \"y\": {y}");
    if let Some(join) = knot.join {
        let _ = write!(out, ", \"join\": \"{join}\"");
    }
    // Bits, because 0 and -0 are equal and yet not the same.
    let bits = |v: Option<Vec2>| v.map(|v| (v.x.to_bits(), v.y.to_bits()));
    let tangents = if bits(knot.tangent_in) == bits(knot.tangent_out) {
        [("tangent", knot.tangent_in), ("tangent", None)]
    } else {
        [("tangent_in", knot.tangent_in), ("tangent_out", knot.tangent_out)]
    };
    for (key, tangent) in tangents {
        if let Some(Vec2 { x, y }) = tangent {
            let _ = write!(out, ", \"{key}\": [{}, {}]", finite(x, key)?, finite(y, key)?);
        }
    }
    let numbers =
        [knot.curvature_in, knot.curvature_out, knot.tension_in, knot.tension_out, knot.curl];
    for (key, number) in KNOT_KEYS[6..].iter().zip(numbers) {
        if let Some(number) = number {
            let _ = write!(out, ", \"{key}\": {}", finite(number, key)?);
        }
    }
    out.push('}');
    Ok(())
}

fn finite(number: f64, what: &str) -> Result<String> {
    if number.is_finite() {
        Ok(number::write(number))
    } else {
        Err(FormatError::new(format!("JSON can't hold `{what}`: {number}")))
    }
}

fn quote(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
