//! The formats module: files to documents and back, and what is written of solutions. Documents cross
//! as their own JSON.

use faircurve::catalog;
use faircurve::{Effort, solve_with};
use faircurve_format::{
    Document, FormatError, Glyph, KINDS, Kind, Picture, Show, SolvedGlyph, json, path as path_data,
    solution_json, svg as svg_text,
};
use js_sys::{Array, Error, Object, Reflect};
use wasm_bindgen::prelude::*;

type Result<T> = std::result::Result<T, JsValue>;

fn set(object: &JsValue, key: &str, value: JsValue) {
    // Setting a property of a plain object of our own can't fail.
    let _ = Reflect::set(object, &key.into(), &value);
}

/// An error with its hint and its place, as the package's `FaircurveError` has them.
fn error(message: &str, hint: &str) -> JsValue {
    let error = Error::new(message);
    set(&error, "hint", hint.into());
    error.into()
}

fn format_error(wrong: &FormatError) -> JsValue {
    let error = error(&wrong.to_string(), wrong.hint.as_deref().unwrap_or_default());
    if let Some(at) = wrong.location {
        let location: JsValue = Object::new().into();
        set(&location, "line", (at.line as f64).into());
        set(&location, "column", (at.column as f64).into());
        set(&location, "offset", (at.offset as f64).into());
        set(&location, "length", (at.length as f64).into());
        set(&error, "location", location);
    }
    error
}

/// Every format: its row as an object.
#[wasm_bindgen]
pub fn formats() -> JsValue {
    let words = |words: &[&str]| words.iter().map(|word| JsValue::from(*word)).collect::<Array>();
    let row = |kind: &Kind| {
        let row: JsValue = Object::new().into();
        set(&row, "name", kind.name.into());
        set(&row, "summary", kind.summary.into());
        set(&row, "extensions", words(kind.extensions).into());
        set(&row, "writes", kind.write.is_some().into());
        row
    };
    KINDS.iter().map(row).collect::<Array>().into()
}

/// The format of that name, or of a file of that name.
fn kind_of(name: &str) -> Result<&'static Kind> {
    let kind = match name.rsplit_once('.') {
        Some((_, extension)) => Kind::from_extension(extension),
        None => Kind::from_name(name),
    };
    kind.map_err(|e| format_error(&e))
}

/// Reads a file; the document as JSON.
#[wasm_bindgen]
pub fn read(bytes: &[u8], name: &str) -> Result<String> {
    let kind = kind_of(name)?;
    let document = faircurve_format::read(bytes, kind)
        .map_err(|e| format_error(&if name.contains('.') { e.in_file(name) } else { e }))?;
    json::write(&document).map_err(|e| format_error(&e))
}

fn document_of(text: &str) -> Result<Document> {
    json::read(text.as_bytes()).map_err(|e| format_error(&FormatError { location: None, ..e }))
}

/// Writes a document.
#[wasm_bindgen]
pub fn write(document: &str, format: &str) -> Result<String> {
    let kind = kind_of(format)?;
    let Some(write) = kind.write else {
        let hint = catalog::suggest("", KINDS.iter().filter(|k| k.write.is_some()).map(|k| k.name));
        return Err(error(&format!("format `{}` is read, but not written", kind.name), &hint));
    };
    write(&document_of(document)?).map_err(|e| format_error(&e))
}

/// Solves every contour. An accuracy that is no number is the default.
fn solved(text: &str, accuracy: f64, effort: f64) -> Result<Vec<SolvedGlyph>> {
    let document = document_of(text)?;
    let glyph = |glyph: &Glyph| {
        let contours = glyph.contours.iter().enumerate().map(|(index, contour)| {
            let choice = document.spline_of(contour);
            let spline = catalog::build(&choice.name, &choice.params)
                .map_err(|e| error(&e.to_string(), &e.hint()))?;
            let solution = solve_with(&contour.contour, &*spline, Effort::times(effort));
            let solution =
                solution.map_err(|e| error(&format!("contour {index}: {e}"), e.hint()))?;
            Ok((choice.name.clone(), solution))
        });
        let contours = contours.collect::<Result<Vec<_>>>()?;
        let accuracy = Some(accuracy).filter(|accuracy| !accuracy.is_nan());
        Ok(SolvedGlyph::new(glyph.name.clone(), glyph.layer.clone(), contours, accuracy))
    };
    document.glyphs.iter().map(glyph).collect()
}

/// A picture.
#[wasm_bindgen]
pub fn svg(document: &str, accuracy: f64, effort: f64, knots: bool, comb: bool) -> Result<String> {
    let show = Show { knots, comb };
    Ok(svg_text::write(&Picture::new(&solved(document, accuracy, effort)?, show)))
}

/// Path data.
#[wasm_bindgen]
pub fn path(document: &str, accuracy: f64, effort: f64) -> Result<String> {
    Ok(path_data::write(&solved(document, accuracy, effort)?))
}

/// The solution in numbers.
#[wasm_bindgen]
pub fn solution(document: &str, accuracy: f64, effort: f64, samples: usize) -> Result<String> {
    let samples = Some(samples).filter(|samples| *samples > 0);
    Ok(solution_json::write(&solved(document, accuracy, effort)?, samples))
}
