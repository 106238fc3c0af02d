//! Knots as rows: the simplest way to draw something.
//!
//! ```csv
//! # closed
//! 0,0,corner
//! 300,100
//! 200,400
//!
//! 500,0
//! 600,100
//! ```
//!
//! - A row is `x,y` or `x,y,join`; an empty join is the spline's own. Blanks around a field don't
//!   count.
//! - A blank line ends a contour.
//! - `# closed` before a contour's first row closes it; other lines that start with `#` are
//!   comments and may stand anywhere.
//!
//! The document is one unnamed glyph, solved with `spiro`.

use std::ops::Range;

use faircurve::catalog::suggest;
use faircurve::kurbo::Point;
use faircurve::{Contour, Join, Knot};

use crate::document::{Document, Glyph, SplineChoice};
use crate::error::FormatError;
use crate::number;
use crate::text::text_of;

/// Reads a document of one unnamed glyph.
///
/// # Errors
/// [`FormatError`] at the offending field, with its contour and knot (counted from 0); also if
/// there is no row at all.
pub fn read(bytes: &[u8]) -> Result<Document, FormatError> {
    let text = text_of(bytes)?;
    let mut contours: Vec<Contour> = Vec::new();
    // Whether the next row belongs to the last contour, and where an unused `# closed` stands.
    let mut inside = false;
    let mut closed: Option<Range<usize>> = None;

    let mut next = bytes.len() - text.len();
    for line in text.split('\n') {
        let start = next;
        next += line.len() + 1;
        if let Some(comment) = line.trim_start().strip_prefix('#') {
            if comment.trim().eq_ignore_ascii_case("closed") {
                let place = trimmed(line, start);
                if inside {
                    return Err(FormatError::new("`# closed` stands inside a contour")
                        .at(bytes, place)
                        .hint("put it before the contour's first row, after a blank line"));
                }
                closed = Some(place);
            }
        } else if line.chars().all(|c| c.is_whitespace() || c == ',') {
            // Spreadsheets write a blank row as commas.
            inside = false;
        } else {
            if !inside {
                let closed = closed.take().is_some();
                contours.push(Contour { closed, ..Contour::default() });
                inside = true;
            }
            let index = contours.len() - 1;
            let knots = &mut contours[index].knots;
            let knot = read_row(line).map_err(|wrong| {
                let message = format!("contour {index}, knot {}: {}", knots.len(), wrong.message);
                let place = start + wrong.place.start..start + wrong.place.end;
                let error = FormatError::new(message).at(bytes, place);
                match wrong.hint {
                    Some(hint) => error.hint(hint),
                    None => error,
                }
            })?;
            knots.push(knot);
        }
    }
    if let Some(place) = closed {
        return Err(FormatError::new("`# closed` has no contour after it").at(bytes, place));
    }
    if contours.is_empty() {
        return Err(FormatError::new("there are no knots in the file")
            .at(bytes, bytes.len()..bytes.len())
            .hint("write one a line, as `x,y` or `x,y,join`"));
    }
    Ok(Document::unnamed(contours))
}

/// What is wrong with a row, with the place in the line.
struct Wrong {
    message: String,
    place: Range<usize>,
    hint: Option<String>,
}

fn read_row(line: &str) -> Result<Knot, Wrong> {
    let mut start = 0;
    let fields: Vec<Range<usize>> = line
        .split(',')
        .map(|field| {
            let place = trimmed(field, start);
            start += field.len() + 1;
            place
        })
        .collect();
    let wrong =
        |message: String, place: &Range<usize>| Wrong { message, place: place.clone(), hint: None };
    let (x, y, join) = match &fields[..] {
        [x, y] => (x, y, None),
        [x, y, join] => (x, y, Some(join)),
        [_, _, _, rest, ..] => {
            let message = "a row has at most three fields".to_owned();
            let hint = Some("write `x,y` or `x,y,join`, with points in numbers: `0.5`".to_owned());
            return Err(Wrong { message, place: rest.clone(), hint });
        }
        _ => {
            let whole = trimmed(line, 0);
            let message = format!("`{}` is not a row", number::excerpt(&line[whole.clone()]));
            let hint = Some("write `x,y` or `x,y,join`, with commas between".to_owned());
            return Err(Wrong { message, place: whole, hint });
        }
    };
    let coordinate = |place: &Range<usize>| {
        let field = &line[place.clone()];
        number::parse_coordinate(field).map_err(|message| Wrong {
            hint: (place == x
                && field.starts_with(char::is_alphabetic)
                && field.parse::<f64>().is_err())
            .then(|| "start headings and remarks with `#`".to_owned()),
            ..wrong(message, place)
        })
    };
    let point = Point::new(coordinate(x)?, coordinate(y)?);
    let join = match join {
        Some(place) if !place.is_empty() => {
            let name = &line[place.clone()];
            Some(Join::from_name(name).ok_or_else(|| Wrong {
                hint: Some(suggest(name, Join::ALL.map(Join::name))),
                ..wrong(format!("there is no join `{}`", number::excerpt(name)), place)
            })?)
        }
        _ => None,
    };
    Ok(Knot { point, join, ..Knot::default() })
}

/// Where the text without blanks around it is, if `text` starts at `start`.
fn trimmed(text: &str, start: usize) -> Range<usize> {
    let start = start + (text.len() - text.trim_start().len());
    start..start + text.trim().len()
}

/// Writes a document; [`read`] gives the same document back.
///
/// # Errors
/// [`FormatError`] if the document holds what rows can't: no or several glyphs or a named one,
/// a spline other than plain `spiro`, tangents and such at a knot, a contour without knots, or a
/// number that isn't finite.
pub fn write(document: &Document) -> Result<String, FormatError> {
    let refuse = |what: String| {
        Err(FormatError::new(format!("CSV can't hold {what}")).hint("write JSON instead"))
    };
    let contours = match &document.glyphs[..] {
        [Glyph { name, layer, contours }] if name.is_empty() && layer.is_empty() => contours,
        [_] => return refuse("the names of glyphs and layers".to_owned()),
        glyphs => return refuse(format!("{} glyphs, only one", glyphs.len())),
    };
    if contours.is_empty() {
        return refuse("a drawing without contours".to_owned());
    }
    let plain = SplineChoice::default();
    if document.spline != plain || contours.iter().any(|contour| contour.spline.is_some()) {
        return refuse("the choice of a spline".to_owned());
    }
    let mut out = String::new();
    for (index, contour) in contours.iter().enumerate() {
        let Contour { knots, closed } = &contour.contour;
        if knots.is_empty() {
            return refuse(format!("contour {index}, which has no knots"));
        }
        if index > 0 {
            out.push('\n');
        }
        if *closed {
            out.push_str("# closed\n");
        }
        for (at, knot) in knots.iter().enumerate() {
            let Knot { point, join, .. } = *knot;
            if *knot != (Knot { point, join, ..Knot::default() }) {
                return refuse(format!("what is given at contour {index}, knot {at}"));
            }
            if !point.is_finite() {
                return refuse(format!("numbers that aren't finite: contour {index}, knot {at}"));
            }
            out += &format!("{},{}", number::write(point.x), number::write(point.y));
            if let Some(join) = join {
                out += &format!(",{join}");
            }
            out.push('\n');
        }
    }
    Ok(out)
}
