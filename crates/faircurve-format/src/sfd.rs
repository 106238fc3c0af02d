//! FontForge's SFD: the Spiro points of every glyph and layer, from a font (`.sfd`) or a glyph of
//! a font folder (`.glyph`).
//!
//! A contour that was drawn with Spiro has, after its Béziers, a block of points:
//!
//! ```text
//! SplineSet
//! 0 0 m 0 …                     the Béziers, not read
//!   Spiro
//!     0 0 {                     x y type
//!     90 10 o
//!     0 0 z                     the end; its place means nothing
//!   EndSpiro
//! EndSplineSet
//! ```
//!
//! | type | knot |
//! |---|---|
//! | `v` | corner |
//! | `c` `o` | G2, G4 |
//! | `[` `]` | curve-to-terminal, terminal-to-curve |
//! | `{` | the start of an open contour; without it the contour is closed |
//! | `}` | the end of an open contour; another type may stand there and means nothing |
//! | `a` `h` | together one knot at `a`: the tangent is a→h, and the curvature 0 on both sides |
//! | `z` | none: the block's end |
//!
//! A type's high bit says that the point was selected, and is ignored. Contours without such a
//! block have no Spiro points and are left out, and so are glyphs and layers without any. Guide
//! lines (`Grid`) are an unnamed glyph of the layer `Grid`. Whether the glyph's `InSpiro` says that
//! its Béziers follow these points makes no difference.

use std::collections::BTreeMap;
use std::ops::Range;

use faircurve::kurbo::{Point, Vec2};
use faircurve::{Contour, Join, Knot};

use crate::document::{Document, DocumentContour, Glyph, SplineChoice};
use crate::error::FormatError;
use crate::number;

type Result<T> = std::result::Result<T, FormatError>;

/// Reads every Spiro contour; a file without any is a document without glyphs. The bytes need not
/// be UTF-8.
///
/// # Errors
/// [`FormatError`] where a block breaks the rules above, and if the file doesn't end where it
/// should: a file that was cut off is never read by half.
pub fn read(bytes: &[u8]) -> Result<Document> {
    let start = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    let mut reader = Reader { bytes, next: start, layers: default_layers(), glyphs: Vec::new() };
    reader.file()?;
    Ok(Document { spline: SplineChoice::default(), glyphs: reader.glyphs })
}

/// Layer names by number.
type Layers = BTreeMap<u32, String>;

const BACK: u32 = 0;
const FORE: u32 = 1;

fn default_layers() -> Layers {
    [(BACK, "Back".to_owned()), (FORE, "Fore".to_owned())].into()
}

struct Reader<'a> {
    bytes: &'a [u8],
    /// Where the next line starts.
    next: usize,
    layers: Layers,
    glyphs: Vec<Glyph>,
}

/// A line without blanks around it.
#[derive(Clone, Copy)]
struct Line<'a> {
    text: &'a [u8],
    start: usize,
}

impl<'a> Line<'a> {
    fn span(self) -> Range<usize> {
        self.start..self.start + self.text.len()
    }

    /// What follows the keyword, if the line starts with it.
    fn after(self, keyword: &str) -> Option<&'a [u8]> {
        self.text.strip_prefix(keyword.as_bytes())
    }

    fn is(self, keyword: &str) -> bool {
        self.text == keyword.as_bytes()
    }
}

impl<'a> Reader<'a> {
    fn file(&mut self) -> Result<()> {
        const EXPECTED: &str = "expected `SplineFontDB:` (a font) or `StartChar:` (a glyph)";
        let first = self.line_of("the file is empty", EXPECTED)?;
        if first.after("SplineFontDB:").is_some() {
            self.font()
        } else if first.after("StartChar:").is_some() {
            self.next = first.start;
            self.glyph_file()
        } else {
            Err(FormatError::new(format!("this is not an SFD file; {EXPECTED}"))
                .at(self.bytes, first.span()))
        }
    }

    fn font(&mut self) -> Result<()> {
        // Parts of a font may be fonts that end so too: the last line counts.
        let mut ended = false;
        while let Some(line) = self.line() {
            ended = line.is("EndSplineFont");
            if let Some(name) = line.after("StartChar:") {
                self.glyph(name)?;
            } else if let Some(layer) = line.after("Layer:") {
                if let Some((number, name)) = declared_layer(layer) {
                    self.layers.insert(number, name);
                }
            } else if line.is("Grid") {
                let mut grid = Glyph { layer: "Grid".to_owned(), ..Glyph::default() };
                self.spline_set(&mut grid, "guide lines")?;
                self.keep(grid);
            } else {
                self.skip_data(line)?;
            }
        }
        if ended {
            Ok(())
        } else {
            Err(self.cut_off("inside the font", "expected `EndSplineFont`"))
        }
    }

    fn glyph_file(&mut self) -> Result<()> {
        while let Some(line) = self.line() {
            match line.after("StartChar:") {
                Some(name) => self.glyph(name)?,
                None => {
                    return Err(FormatError::new("expected the end of the file after `EndChar`")
                        .at(self.bytes, line.span()));
                }
            }
        }
        Ok(())
    }

    /// The rest of a glyph, of which the first line has been read.
    fn glyph(&mut self, name: &[u8]) -> Result<()> {
        let name = text(name);
        let place = format!("glyph `{}`", number::excerpt(&name));
        let inside = format!("inside {place}");
        let mut layer = FORE;
        let mut glyphs: BTreeMap<u32, Glyph> = BTreeMap::new();
        loop {
            let line = self.line_of(&inside, "expected `EndChar`")?;
            if line.is("EndChar") {
                break;
            } else if line.is("Fore") {
                layer = FORE;
            } else if line.is("Back") {
                layer = BACK;
            } else if let Some(number) = line.after("Layer:") {
                layer = number_at_start(number).ok_or_else(|| {
                    FormatError::new(format!("{place}: expected `Layer:` and a number"))
                        .at(self.bytes, line.span())
                })?;
            } else if line.is("SplineSet") {
                let layer_name = self.layers.get(&layer).cloned();
                let glyph = glyphs.entry(layer).or_insert_with(|| Glyph {
                    name: name.clone(),
                    layer: layer_name.unwrap_or_else(|| format!("Layer {layer}")),
                    contours: Vec::new(),
                });
                self.spline_set(glyph, &place)?;
            } else if is_boundary(line) {
                return Err(FormatError::new(format!("{place}: expected `EndChar` before this"))
                    .at(self.bytes, line.span()));
            } else {
                self.skip_data(line)?;
            }
        }
        glyphs.into_values().for_each(|glyph| self.keep(glyph));
        Ok(())
    }

    fn keep(&mut self, glyph: Glyph) {
        if !glyph.contours.is_empty() {
            self.glyphs.push(glyph);
        }
    }

    /// The contours up to `EndSplineSet`; those with Spiro points go to `glyph`.
    fn spline_set(&mut self, glyph: &mut Glyph, place: &str) -> Result<()> {
        loop {
            let line = self.line_of(&format!("inside {place}"), "expected `EndSplineSet`")?;
            if line.is("EndSplineSet") {
                return Ok(());
            } else if line.is("Spiro") {
                let place = format!("{place}, contour {}", glyph.contours.len());
                let points = self.spiro_points(&place)?;
                if !points.is_empty() {
                    let contour = self.contour(&points, &place)?;
                    glyph.contours.push(DocumentContour::from(contour));
                }
            } else if line.is("EndChar") || is_boundary(line) {
                let message = format!("{place}: expected `EndSplineSet` before this");
                return Err(FormatError::new(message).at(self.bytes, line.span()));
            }
        }
    }

    /// The points up to `EndSpiro`, without the last, which only marks the end.
    fn spiro_points(&mut self, place: &str) -> Result<Vec<SpiroPoint>> {
        let mut points = Vec::new();
        let mut ended = false;
        loop {
            let expected = if ended { "`EndSpiro`" } else { "a point, `x y type`" };
            let line = self.line_of(
                &format!("inside the Spiro points of {place}"),
                &format!("expected {expected}"),
            )?;
            match (line.is("EndSpiro"), ended) {
                (true, true) => return Ok(points),
                (true, false) => {
                    let message = format!("{place}: expected the last point, `0 0 z`, before this");
                    return Err(FormatError::new(message).at(self.bytes, line.span()));
                }
                (false, true) => {
                    let message = format!("{place}: expected `EndSpiro` after the point of type z");
                    return Err(FormatError::new(message).at(self.bytes, line.span()));
                }
                (false, false) => {
                    let point =
                        self.spiro_point(line, &format!("{place}, point {}", points.len()))?;
                    ended = point.letter == b'z';
                    if !ended {
                        points.push(point);
                    }
                }
            }
        }
    }

    fn spiro_point(&self, line: Line<'_>, place: &str) -> Result<SpiroPoint> {
        let mut fields = Vec::with_capacity(3);
        let mut at = 0;
        for field in line.text.split(u8::is_ascii_whitespace) {
            if !field.is_empty() {
                fields.push(line.start + at..line.start + at + field.len());
            }
            at += field.len() + 1;
        }
        let [x, y, kind] = &fields[..] else {
            let shown = String::from_utf8_lossy(line.text);
            let message =
                format!("{place}: expected a point, `x y type`, not `{}`", number::excerpt(&shown));
            return Err(FormatError::new(message).at(self.bytes, line.span()));
        };
        let coordinate = |place_of: &Range<usize>| {
            let field = String::from_utf8_lossy(&self.bytes[place_of.clone()]);
            number::parse_coordinate(&field).map_err(|wrong| {
                FormatError::new(format!("{place}: {wrong}")).at(self.bytes, place_of.clone())
            })
        };
        let point = Point::new(coordinate(x)?, coordinate(y)?);
        /// Set in the type of a point that was selected when the font was saved.
        const SELECTED: u8 = 0x80;
        match &self.bytes[kind.clone()] {
            [letter] if b"vco[]{}ahz".contains(&(letter & !SELECTED)) => {
                Ok(SpiroPoint { point, letter: letter & !SELECTED, span: line.span() })
            }
            other => {
                let other = String::from_utf8_lossy(other);
                let message =
                    format!("{place}: there is no point type `{}`", number::excerpt(&other));
                Err(FormatError::new(message)
                    .at(self.bytes, kind.clone())
                    .hint("the types are v o c [ ] { } a h, and z at the end"))
            }
        }
    }

    fn contour(&self, points: &[SpiroPoint], place: &str) -> Result<Contour> {
        let open = points.first().is_some_and(|point| point.letter == b'{');
        let mut knots = Vec::with_capacity(points.len());
        let mut rest = points.iter().enumerate();
        while let Some((index, point)) = rest.next() {
            let refuse = |why: &str| {
                FormatError::new(format!("{place}, point {index}: {why}"))
                    .at(self.bytes, point.span.clone())
            };
            let is_last = index + 1 == points.len();
            let knot = Knot::new(point.point);
            knots.push(match point.letter {
                b'v' => knot.join(Join::Corner),
                b'c' => knot.join(Join::G2),
                b'o' => knot.join(Join::G4),
                b'[' => knot.join(Join::CurveToTerminal),
                b']' => knot.join(Join::TerminalToCurve),
                b'{' if index == 0 => knot,
                b'{' => return Err(refuse("`{` opens a contour and must be its first point")),
                b'}' if open && is_last => knot,
                b'}' if open => {
                    return Err(refuse("`}` ends a contour and must be its last point"));
                }
                b'}' => return Err(refuse("`}` ends a contour, but no `{` opened it")),
                b'a' => match rest.next() {
                    Some((_, handle)) if handle.letter == b'h' => {
                        let tangent = handle.point - point.point;
                        if tangent == Vec2::ZERO {
                            return Err(refuse("`a` and `h` are at one place, so give no tangent"));
                        }
                        // Both sides as libspiro solves them: flat where they meet.
                        knot.join(Join::G1).tangent(tangent).curvature_in(0.0).curvature_out(0.0)
                    }
                    _ => return Err(refuse("after an anchor `a` comes its handle `h`")),
                },
                _ => return Err(refuse("before a handle `h` comes its anchor `a`")),
            });
        }
        if open && let Some(last) = knots.last_mut() {
            last.join = None;
        }
        Ok(Contour { knots, closed: !open })
    }

    /// The next line that isn't blank.
    fn line(&mut self) -> Option<Line<'a>> {
        while self.next < self.bytes.len() {
            let rest = &self.bytes[self.next..];
            let length = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
            let line = &rest[..length];
            let start = self.next + (length - line.trim_ascii_start().len());
            self.next += length + 1;
            if let text @ [_, ..] = line.trim_ascii() {
                return Some(Line { text, start });
            }
        }
        None
    }

    /// The next line; that there is none is an error.
    fn line_of(&mut self, inside: &str, expected: &str) -> Result<Line<'a>> {
        self.line().ok_or_else(|| self.cut_off(inside, expected))
    }

    fn cut_off(&self, inside: &str, expected: &str) -> FormatError {
        let message = match inside.strip_prefix("inside ") {
            Some(what) => format!("the file ends too early, inside {what}; {expected}"),
            None => format!("{inside}; {expected}"),
        };
        let end = self.bytes.len();
        FormatError::new(message)
            .at(self.bytes, end..end)
            .hint("the file may have been cut off; get it again or save it again")
    }

    /// Skips data of several lines that starts on this one: it may hold lines that look like
    /// something else.
    fn skip_data(&mut self, line: Line<'a>) -> Result<()> {
        for (start, end) in [("Image:", "EndImage"), ("Image2:", "EndImage2")] {
            if line.after(start).is_some() {
                while !self.line_of("inside an image", &format!("expected `{end}`"))?.is(end) {}
                return Ok(());
            }
        }
        if let Some(data) =
            line.after("PickledData:").or_else(|| line.after("PickledDataWithLists:"))
            && let Some(quote) = data.iter().position(|&b| b == b'"')
        {
            let mut at = line.span().end - data.len() + quote + 1;
            loop {
                match self.bytes.get(at) {
                    Some(b'\\') => at += 2,
                    Some(b'"') => break,
                    Some(_) => at += 1,
                    None => return Err(self.cut_off("inside PickledData", "expected `\"`")),
                }
            }
            self.next = at + 1;
            self.line_end();
        }
        Ok(())
    }

    /// Goes to the end of a line that has been read in part.
    fn line_end(&mut self) {
        let rest = &self.bytes[self.next.min(self.bytes.len())..];
        self.next += rest.iter().position(|&b| b == b'\n').map_or(rest.len(), |at| at + 1);
    }
}

/// Lines that can't stand inside a glyph.
fn is_boundary(line: Line<'_>) -> bool {
    line.after("StartChar:").is_some() || line.is("EndChars") || line.is("EndSplineFont")
}

struct SpiroPoint {
    point: Point,
    letter: u8,
    span: Range<usize>,
}

/// The number and the name in a font's `Layer: 1 0 "Fore" 0`.
fn declared_layer(text_after: &[u8]) -> Option<(u32, String)> {
    let number = number_at_start(text_after)?;
    let from = text_after.iter().position(|&b| b == b'"')?;
    let length = text_after[from + 1..].iter().position(|&b| b == b'"')?;
    Some((number, text(&text_after[from..=from + 1 + length])))
}

fn number_at_start(text: &[u8]) -> Option<u32> {
    let word = text.trim_ascii_start().split(u8::is_ascii_whitespace).next()?;
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// A name: as it stands, or quoted in UTF-7.
fn text(raw: &[u8]) -> String {
    let raw = raw.trim_ascii();
    let plain = String::from_utf8_lossy(raw);
    match plain.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')) {
        Some(quoted) => from_utf7(quoted).unwrap_or_else(|| quoted.to_owned()),
        None => plain.into_owned(),
    }
}

/// Decodes UTF-7 (RFC 2152); `None` if it isn't.
fn from_utf7(text: &str) -> Option<String> {
    const BASE64: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut decoded = String::new();
    let mut rest = text;
    while let Some((plain, after)) = rest.split_once('+') {
        decoded.push_str(plain);
        let length = after.bytes().take_while(|byte| BASE64.contains(byte)).count();
        let (coded, after) = after.split_at(length);
        rest = after.strip_prefix('-').unwrap_or(after);
        if coded.is_empty() {
            decoded.push('+');
            continue;
        }
        let mut units = Vec::new();
        let (mut bits, mut count) = (0u32, 0);
        for byte in coded.bytes() {
            let digit = BASE64.iter().position(|&known| known == byte)?;
            bits = (bits << 6 | digit as u32) & 0x3f_ffff;
            count += 6;
            if count >= 16 {
                count -= 16;
                units.push((bits >> count) as u16);
            }
        }
        decoded.push_str(&String::from_utf16(&units).ok()?);
    }
    decoded.push_str(rest);
    Some(decoded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf7_is_decoded() {
        assert_eq!(from_utf7("Back 2").unwrap(), "Back 2");
        assert_eq!(from_utf7("gr+APYA3w-e").unwrap(), "größe");
        assert_eq!(from_utf7("1 +- 1").unwrap(), "1 + 1");
        assert_eq!(from_utf7("+2D3eAA-").unwrap(), "😀");
        assert_eq!(from_utf7("+2D0-"), None);
    }

    #[test]
    fn layers_are_declared_by_number() {
        assert_eq!(declared_layer(b" 2 0 \"Back 2\" 0"), Some((2, "Back 2".to_owned())));
        assert_eq!(declared_layer(b" 2 0 \"Back"), None);
        assert_eq!(declared_layer(b""), None);
    }
}
