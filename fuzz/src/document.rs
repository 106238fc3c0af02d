//! Files: whatever bytes are read as a document can be written, solved and drawn.

use faircurve::kurbo::BezPath;
use faircurve::{catalog, solve};
use faircurve_format::{
    Document, Kind, Picture, Show, SolvedGlyph, csv, json, path, read, solution_json, svg,
};
use serde_json::Value;

use crate::check;

/// Reads bytes as a file of that kind. An error has its place inside the file; a document is
/// written and read again, and a few of its contours are solved and drawn.
pub fn check(bytes: &[u8], kind: &str) {
    match read(bytes, Kind::from_name(kind).expect("the kind is known")) {
        Ok(document) => {
            reads_back(&document);
            draw(&document);
        }
        Err(error) => {
            let location = error.location.as_ref().expect("errors in a file have a place");
            assert!(location.offset + location.length <= bytes.len(), "{error}");
        }
    }
}

/// JSON holds every document; CSV holds it or refuses.
fn reads_back(document: &Document) {
    let text = json::write(document).expect("JSON holds every document that was read");
    assert_eq!(json::read(text.as_bytes()).as_ref(), Ok(document), "{text}");
    if let Ok(text) = csv::write(document) {
        assert_eq!(csv::read(text.as_bytes()).as_ref(), Ok(document), "{text}");
    }
}

/// Solves the small contours, up to a few, and writes them in every format.
fn draw(document: &Document) {
    const MOST_CONTOURS: usize = 4;
    const MOST_KNOTS: usize = 8;
    let mut left = MOST_CONTOURS;
    let mut glyphs = Vec::new();
    for glyph in document.glyphs.iter().take(MOST_CONTOURS) {
        let mut solved = Vec::new();
        for contour in &glyph.contours {
            if left == 0 || contour.contour.knots.len() > MOST_KNOTS {
                continue;
            }
            left -= 1;
            let choice = document.spline_of(contour);
            let spline = catalog::build(&choice.name, &choice.params)
                .expect("documents name splines that the catalogue builds");
            if let Ok(solution) = solve(&contour.contour, &*spline) {
                check::solution(&contour.contour, &solution);
                solved.push((choice.name.clone(), solution));
            }
        }
        glyphs.push(SolvedGlyph::new(&glyph.name, &glyph.layer, solved, None));
    }
    for contour in glyphs.iter().flat_map(|glyph| &glyph.contours) {
        check::finite_path(&contour.path);
    }
    check_json(&solution_json::write(&glyphs, Some(3)));
    for show in [Show::default(), Show { knots: true, comb: true }] {
        check_svg(&svg::write(&Picture::new(&glyphs, show)));
    }
    for line in path::write(&glyphs).lines() {
        check_path(line);
    }
}

/// It is JSON, and no number was written as null: that happens to what isn't finite.
fn check_json(text: &str) {
    fn no_null(value: &Value) {
        match value {
            Value::Null => panic!("a number is null"),
            Value::Array(values) => values.iter().for_each(no_null),
            Value::Object(entries) => {
                for (key, value) in entries {
                    // Null where nothing arrives or leaves; checked in the solution.
                    let may_miss =
                        ["direction_in", "direction_out", "curvature_in", "curvature_out"];
                    if !(value.is_null() && may_miss.contains(&key.as_str())) {
                        no_null(value);
                    }
                }
            }
            _ => {}
        }
    }
    no_null(&serde_json::from_str(text).expect("the solution is JSON"));
}

/// It is XML, its view has a size, and every path is one.
fn check_svg(text: &str) {
    let svg = roxmltree::Document::parse(text).expect("the picture is XML");
    let view = svg.root_element().attribute("viewBox").expect("the picture has a view");
    let view: Vec<f64> = view.split(' ').map(|n| n.parse().expect("a number")).collect();
    assert!(view.len() == 4 && view.iter().all(|n| n.is_finite()), "{view:?}");
    assert!(view[2] > 0.0 && view[3] > 0.0, "{view:?}");
    for node in svg.descendants() {
        for attribute in node.attributes() {
            match attribute.name() {
                "d" => check_path(attribute.value()),
                "data-name" | "data-layer" => {}
                _ => {
                    let words = attribute.value().split(|c: char| !c.is_ascii_alphanumeric());
                    for word in words {
                        assert!(!["NaN", "inf"].contains(&word), "{attribute:?}");
                    }
                }
            }
        }
    }
}

fn check_path(data: &str) {
    check::finite_path(&BezPath::from_svg(data).expect("the path can be read"));
}
