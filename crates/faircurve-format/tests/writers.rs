//! The writers: what other programs rely on, and what they must never do.

use faircurve::kurbo::{BezPath, PathEl, Point};
use faircurve::{Contour, Join, Knot, Place, Relaxation, Solution, catalog, solve};
use faircurve_format::{Picture, Show, SolvedGlyph, path, solution_json, svg};
use serde_json::Value;

const EVERYTHING: Show = Show { knots: true, comb: true };

fn solved(contour: &Contour) -> (String, Solution) {
    let spiro = catalog::spline("spiro").unwrap();
    ("spiro".to_owned(), solve(contour, &*spiro).unwrap())
}

fn glyph(contours: &[Contour]) -> SolvedGlyph {
    SolvedGlyph::new("a", "Fore", contours.iter().map(solved), Some(1e-3))
}

fn drop_shape(scale: f64) -> Contour {
    let knot = |x: f64, y: f64| Knot::new((x * scale, y * scale));
    Contour::closed([
        knot(0.1, 0.3).join(Join::Corner),
        knot(30.0, 60.0).join(Join::G2),
        knot(70.7, 30.0),
        knot(40.0, -10.0).join(Join::CurveToTerminal),
        knot(20.0, -12.0).join(Join::G1),
    ])
}

fn wave() -> Contour {
    Contour::open([(0.0, 0.0), (10.0, 5.0), (20.0, 0.0), (20.0, 0.0), (30.0, 3.0)])
}

/// A glyph of which something is marked as relaxed.
fn relaxed_glyph() -> SolvedGlyph {
    let (spline, mut solution) = solved(&drop_shape(1.0));
    solution.report.relaxed = vec![
        Relaxation { place: Place::Knot(2), asked: "g4", got: "g2", reason: "a test".into() },
        Relaxation { place: Place::Segment(1), asked: "spiro", got: "euler", reason: "too".into() },
    ];
    SolvedGlyph::new("a", "Fore", [(spline, solution)], None)
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

/// Every number that JSON holds; panics on what isn't one where numbers belong.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Number(number) => vec![number.as_f64().unwrap()],
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        Value::Object(items) => items.values().flat_map(numbers).collect(),
        _ => vec![],
    }
}

#[test]
fn the_solution_has_the_keys_of_the_contract_in_order() {
    let text = solution_json::write(&[relaxed_glyph()], Some(2));
    let mut rest = text.as_str();
    for key in [
        "faircurve",
        "glyphs",
        "name",
        "layer",
        "contours",
        "spline",
        "closed",
        "status",
        "relaxed",
        "knot",
        "asked",
        "got",
        "reason",
        "segment",
        "adapted",
        "iterations",
        "residual",
        "knots",
        "x",
        "y",
        "join",
        "direction_in",
        "direction_out",
        "curvature_in",
        "curvature_out",
        "segments",
        "length",
        "kappa",
        "samples",
        "length",
        "bending_energy",
        "variation_energy",
        "path",
    ] {
        let quoted = format!("\"{key}\":");
        let at = rest.find(&quoted).unwrap_or_else(|| panic!("{key} is missing or out of order"));
        rest = &rest[at + quoted.len()..];
    }
    let file: Value = serde_json::from_str(&text).unwrap();
    let contour = &file["glyphs"][0]["contours"][0];
    assert_eq!(contour["status"], "relaxed");
    assert_eq!(keys(contour).len(), 13);
    assert_eq!(keys(&contour["knots"][0]).len(), 7);
    assert_eq!(contour["relaxed"][0]["knot"], 2);
    assert_eq!(contour["relaxed"][1]["segment"], 1);
    assert_eq!(keys(&contour["relaxed"][1]).len(), 4);
}

#[test]
fn open_ends_are_null_and_zero_chords_keep_their_place() {
    let text = solution_json::write(&[glyph(&[wave()])], None);
    let file: Value = serde_json::from_str(&text).unwrap();
    let contour = &file["glyphs"][0]["contours"][0];
    assert_eq!(contour["closed"], false);
    let knots = contour["knots"].as_array().unwrap();
    let segments = contour["segments"].as_array().unwrap();
    assert_eq!((knots.len(), segments.len()), (5, 4));
    assert!(knots[0]["direction_in"].is_null() && knots[0]["curvature_in"].is_null());
    assert!(knots[4]["direction_out"].is_null() && knots[4]["curvature_out"].is_null());
    assert!(knots[1..4].iter().all(|knot| knot["direction_in"].is_number()));
    assert_eq!(segments[2]["length"], 0.0);
    assert!(segments[0].get("samples").is_none());
}

#[test]
fn samples_lie_on_the_curve_at_equal_steps() {
    let glyph = glyph(&[drop_shape(1.0)]);
    let text = solution_json::write(std::slice::from_ref(&glyph), Some(7));
    let file: Value = serde_json::from_str(&text).unwrap();
    let curve = &glyph.contours[0].solution.curve;
    let segments = file["glyphs"][0]["contours"][0]["segments"].as_array().unwrap();
    for (written, segment) in segments.iter().zip(curve.segments()) {
        let rows = written["samples"].as_array().unwrap();
        assert_eq!(rows.len(), 8);
        for (i, row) in rows.iter().enumerate() {
            let row = numbers(row);
            assert!((row[0] - segment.length() * i as f64 / 7.0).abs() < 1e-12 * segment.length());
            let at = segment.at(row[0]);
            assert_eq!(row[1..], [at.point.x, at.point.y, at.direction, at.curvature]);
        }
        let last = numbers(&rows[7]);
        assert_eq!((last[1], last[2]), (segment.end().x, segment.end().y));
    }
}

#[test]
fn numbers_read_back_as_the_same_doubles() {
    let glyph = glyph(&[drop_shape(1.0 / 3.0)]);
    let text = solution_json::write(std::slice::from_ref(&glyph), None);
    let file: Value = serde_json::from_str(&text).unwrap();
    let contour = &file["glyphs"][0]["contours"][0];
    let solution = &glyph.contours[0].solution;
    for (written, knot) in contour["knots"].as_array().unwrap().iter().zip(&solution.knots) {
        assert_eq!(written["x"].as_f64(), Some(knot.point.x));
        assert_eq!(written["curvature_in"].as_f64(), knot.curvature_in);
    }
    assert_eq!(contour["length"].as_f64(), Some(solution.curve.length()));
    let read = BezPath::from_svg(contour["path"].as_str().unwrap()).unwrap();
    assert_eq!(read, glyph.contours[0].path);
}

#[test]
fn paths_pass_through_every_knot_to_the_bit_and_close() {
    let contour = drop_shape(1.0 / 7.0);
    let text = path::write(&[glyph(&[contour.clone(), wave()]), SolvedGlyph::default()]);
    let lines: Vec<&str> = text.split('\n').collect();
    assert_eq!(lines.len(), 3);
    assert_eq!((lines[1], lines[2]), ("", ""));
    let read = BezPath::from_svg(lines[0]).unwrap();
    let ends: Vec<Point> = read.elements().iter().filter_map(PathEl::end_point).collect();
    for knot in contour.knots.iter().chain(&wave().knots) {
        assert!(ends.contains(&knot.point));
    }
    assert_eq!(lines[0].matches('M').count(), 2);
    assert_eq!(lines[0].matches('Z').count(), 1);
}

#[test]
fn a_bare_outline_is_one_filled_path_in_the_glyphs_own_coordinates() {
    let text = svg::write(&Picture::new(&[glyph(&[drop_shape(1.0)])], Show::default()));
    assert_eq!(text.matches("<path").count(), 1);
    assert!(text.contains("fill=\"#000000\"") && !text.contains("transform"));
    // y is flipped, and nothing else: knot 1 at (30, 60) is at (30, -60).
    assert!(text.contains("30,-60"));
}

#[test]
fn names_are_escaped() {
    let mut glyph = glyph(&[wave()]);
    glyph.name = "<\"&\u{1}>".to_owned();
    let text = svg::write(&Picture::new(&[glyph], EVERYTHING));
    assert!(text.contains("data-name=\"&lt;&quot;&amp;\u{fffd}&gt;\""));
}

#[test]
fn relaxed_contours_and_knots_are_red() {
    let glyphs = [glyph(&[drop_shape(1.0)]), relaxed_glyph()];
    for (show, marks) in [(Show::default(), 1), (EVERYTHING, 2)] {
        let text = svg::write(&Picture::new(&glyphs, show));
        assert_eq!(text.matches("#d11f2f").count(), marks);
        assert_eq!(text.matches("stroke-dasharray").count(), 1);
    }
}

#[cfg(feature = "png")]
mod png {
    use faircurve_format::png::{self, LARGEST_SIDE};
    use resvg::{tiny_skia, usvg};

    use super::*;

    fn pixels(picture: &Picture, width: u32) -> tiny_skia::Pixmap {
        tiny_skia::Pixmap::decode_png(&png::write(picture, width).unwrap()).unwrap()
    }

    /// The SVG as another program draws it.
    fn drawn_svg(picture: &Picture, width: u32, height: u32) -> tiny_skia::Pixmap {
        let tree = usvg::Tree::from_str(&svg::write(picture), &usvg::Options::default()).unwrap();
        let mut pixels = tiny_skia::Pixmap::new(width, height).unwrap();
        pixels.fill(tiny_skia::Color::WHITE);
        let scale = width as f32 / tree.size().width();
        let place = tiny_skia::Transform::from_scale(scale, scale);
        resvg::render(&tree, place, &mut pixels.as_mut());
        pixels
    }

    #[test]
    fn both_formats_show_the_same_picture() {
        let glyphs = [glyph(&[drop_shape(1.0), wave()]), relaxed_glyph()];
        for show in [Show::default(), EVERYTHING] {
            let picture = Picture::new(&glyphs, show);
            let ours = pixels(&picture, 600);
            let theirs = drawn_svg(&picture, 600, ours.height());
            let differences = ours.data().iter().zip(theirs.data()).map(|(a, b)| a.abs_diff(*b));
            let total: f64 = differences.map(f64::from).sum();
            let mean = total / ours.data().len() as f64;
            assert!(mean < 0.2, "pixels differ by {mean} of 255 on average");
            let inked = ours.data().iter().filter(|byte| **byte < 128).count();
            assert!(inked > 1000, "the picture is blank");
        }
    }

    #[test]
    fn a_picture_is_the_same_at_every_scale() {
        let at = |scale| pixels(&Picture::new(&[glyph(&[drop_shape(scale)])], EVERYTHING), 300);
        let one = at(1.0);
        for scale in [1e-50, 1e-6, 1e6, 1e50] {
            let other = at(scale);
            assert_eq!((one.width(), one.height()), (other.width(), other.height()));
            let far = one.data().iter().zip(other.data()).filter(|(a, b)| a.abs_diff(**b) > 40);
            assert!(far.count() < one.data().len() / 500);
        }
    }

    #[test]
    fn nothing_is_too_little_to_draw() {
        let point = Contour::open([(1e30, -1e30)]);
        let line = Contour::open([(0.0, 0.0), (0.0, 1e-30)]);
        let flat = Contour::open([(1e20, 1e20), (3e20, 1e20)]);
        let twice = Contour::closed([(5.0, 5.0), (5.0, 5.0)]);
        for contours in [vec![], vec![point], vec![line], vec![flat], vec![twice]] {
            for show in [Show::default(), EVERYTHING] {
                let picture = Picture::new(&[glyph(&contours), glyph(&contours)], show);
                assert!(picture.aspect() > 0.0 && picture.aspect().is_finite());
                assert!(png::write(&picture, 100).is_ok());
                assert!(!svg::write(&picture).contains("NaN"));
                assert!(!svg::write(&picture).contains("inf"));
            }
        }
    }

    #[test]
    fn sizes_beyond_the_limits_are_errors() {
        let picture = Picture::new(&[glyph(&[wave()])], Show::default());
        assert!(png::write(&picture, 0).is_err());
        assert!(png::write(&picture, LARGEST_SIDE + 1).is_err());
        assert!(png::write(&picture, u32::MAX).is_err());
        let tall = Contour::open([(0.0, 0.0), (0.0, 1e6)]);
        let picture = Picture::new(&[glyph(&[tall])], Show::default());
        assert!(png::write(&picture, LARGEST_SIDE).is_err());
        assert!(png::write(&picture, png::default_width(&picture)).is_ok());
    }
}
