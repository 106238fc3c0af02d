//! SVG of a [`Picture`].
//!
//! Each glyph is a group `<g class="glyph" data-name="…" data-layer="…">`; each of its marks is one
//! `<path>` whose class says what it is (`outline`, `line`, `relaxed`, `comb-teeth`, …). The curves
//! keep every digit (y negated, since SVG's y is down); combs and symbols are rounded to what can
//! be seen.

use std::fmt::Write;

use faircurve::kurbo::{BezPath, PathEl, Point, Vec2};

use crate::path::path_data;
use crate::picture::{Cell, Mark, Paint, Picture, Stroke};

/// The picture as an SVG file, without a size of its own: it fills what it is put into.
pub fn write(picture: &Picture) -> String {
    let number = |x: f64| rounded(x, picture.decimals);
    let view = picture.view;
    let (x, y) = (number(view.origin.x), number(view.origin.y));
    let (width, height) = (number(view.width), number(view.height));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{x} {y} {width} {height}\">\n"
    );
    if picture.ground {
        let ground = format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"");
        svg.push_str(&format!("<rect class=\"ground\" {ground} fill=\"#ffffff\"/>\n"));
    }
    for cell in &picture.cells {
        write_cell(&mut svg, cell, picture.decimals);
    }
    svg.push_str("</svg>\n");
    svg
}

fn write_cell(svg: &mut String, cell: &Cell, decimals: usize) {
    svg.push_str("<g class=\"glyph\"");
    for (key, value) in [("data-name", &cell.name), ("data-layer", &cell.layer)] {
        if !value.is_empty() {
            svg.push_str(&format!(" {key}=\"{}\"", escaped(value)));
        }
    }
    if cell.offset != Vec2::ZERO {
        let (x, y) = (rounded(cell.offset.x, decimals), rounded(cell.offset.y, decimals));
        svg.push_str(&format!(" transform=\"translate({x} {y})\""));
    }
    svg.push_str(">\n");
    for mark in &cell.marks {
        write_mark(svg, mark, decimals);
    }
    svg.push_str("</g>\n");
}

fn write_mark(svg: &mut String, mark: &Mark, decimals: usize) {
    let data = if mark.exact { path_data(&mark.path) } else { rounded_data(&mark.path, decimals) };
    let fill = mark.fill.map_or("fill=\"none\"".to_owned(), |paint| attributes("fill", paint));
    let stroke = mark.stroke.map_or(String::new(), |stroke| stroke_attributes(stroke, decimals));
    svg.push_str(&format!("<path class=\"{}\" {fill}{stroke} d=\"{data}\"/>\n", mark.class));
}

fn attributes(kind: &str, paint: Paint) -> String {
    let [r, g, b] = paint.rgb;
    let opacity = match paint.opacity {
        1.0 => String::new(),
        opacity => format!(" {kind}-opacity=\"{opacity}\""),
    };
    format!("{kind}=\"#{r:02x}{g:02x}{b:02x}\"{opacity}")
}

fn stroke_attributes(stroke: Stroke, decimals: usize) -> String {
    let mut text = format!(
        " {} stroke-width=\"{}\" stroke-linejoin=\"round\"",
        attributes("stroke", stroke.paint),
        rounded(stroke.width, decimals + 1),
    );
    if let Some([dash, gap]) = stroke.dashes() {
        let (dash, gap) = (rounded(dash, decimals), rounded(gap, decimals));
        text.push_str(&format!(" stroke-dasharray=\"{dash} {gap}\""));
    }
    text
}

fn rounded_data(path: &BezPath, decimals: usize) -> String {
    let mut data = String::new();
    let mut command = |letter: char, points: &[Point]| {
        data.push(letter);
        for (index, point) in points.iter().enumerate() {
            let space = if index == 0 { "" } else { " " };
            let (x, y) = (rounded(point.x, decimals), rounded(point.y, decimals));
            let _ = write!(data, "{space}{x},{y}");
        }
    };
    for element in path.elements() {
        match *element {
            PathEl::MoveTo(p) => command('M', &[p]),
            PathEl::LineTo(p) => command('L', &[p]),
            PathEl::QuadTo(p1, p2) => command('Q', &[p1, p2]),
            PathEl::CurveTo(p1, p2, p3) => command('C', &[p1, p2, p3]),
            PathEl::ClosePath => command('Z', &[]),
        }
    }
    data
}

/// A number with at most that many decimals, without needless zeros.
fn rounded(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text.as_str()
    };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Text for an attribute's value. Characters that XML can't hold become U+FFFD.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\t' | '\n' | '\r' => escaped.push_str(&format!("&#{};", u32::from(c))),
            '\0'..'\x20' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            _ => escaped.push(c),
        }
    }
    escaped
}
