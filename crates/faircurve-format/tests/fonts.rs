//! Real fonts drawn with Spiro. They are not part of the repository; without them these tests say
//! so and pass.

mod common;

use common::parse;
use faircurve::kurbo::{Affine, Line, ParamCurve, PathSeg, Point, Vec2};
use faircurve::{Contour, Solution};
use faircurve_format::{Document, json};

const FONTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data");

/// The font's bytes, if it is there.
#[expect(clippy::print_stdout, reason = "tests say why they are skipped")]
fn font(name: &str) -> Option<Vec<u8>> {
    let bytes = std::fs::read(format!("{FONTS}/{name}"));
    if let Err(error) = &bytes {
        println!("skipped: {name}: {error}");
    }
    bytes.ok()
}

fn counts(document: &Document) -> (usize, usize) {
    let contours = document.glyphs.iter().flat_map(|glyph| &glyph.contours);
    contours
        .fold((0, 0), |(count, knots), contour| (count + 1, knots + contour.contour.knots.len()))
}

/// Contours and points as the fonts' README counts them.
const COUNTS: [(&str, usize, usize); 3] = [
    ("Cantarell-Regular-Spiro.sfd", 180, 1906),
    ("Chomsky.sfd", 760, 10513),
    ("KJV1611.sfd", 93, 1198),
];

#[test]
fn every_contour_and_point_is_read() {
    for (name, contours, points) in COUNTS {
        let Some(bytes) = font(name) else { continue };
        let document = parse("sfd", bytes).unwrap();
        assert_eq!(counts(&document), (contours, points), "{name}");
    }
}

#[test]
fn glyphs_and_layers_have_their_names() {
    let Some(bytes) = font("Chomsky.sfd") else {
        return;
    };
    let document = parse("sfd", bytes).unwrap();
    let layers_of = |name: &str| -> Vec<(&str, usize)> {
        let glyphs = document.glyphs.iter().filter(|glyph| glyph.name == name);
        glyphs.map(|glyph| (glyph.layer.as_str(), glyph.contours.len())).collect()
    };
    assert_eq!(layers_of("v"), [("Back", 3), ("Fore", 2), ("Back 2", 3)]);
    assert_eq!(layers_of(""), [("Grid", 3)]);
}

#[test]
fn fonts_survive_the_way_through_json() {
    for (name, ..) in COUNTS {
        let Some(bytes) = font(name) else { continue };
        let document = parse("sfd", bytes).unwrap();
        assert_eq!(parse("json", json::write(&document).unwrap()).unwrap(), document, "{name}");
    }
}

#[test]
fn a_cut_off_font_is_an_error() {
    for (name, ..) in COUNTS {
        let Some(bytes) = font(name) else { continue };
        let end = bytes.trim_ascii_end().len();
        for part in 0..64 {
            let cut = end * part / 64;
            assert!(parse("sfd", &bytes[..cut]).is_err(), "{name} after {cut} bytes");
        }
        assert!(parse("sfd", &bytes[..end - 1]).is_err());
        assert!(parse("sfd", &bytes[..end]).is_ok());
    }
}

/// Every contour of every font, solved as asked; every curved closed one the same from another start,
/// backwards, and turned, mirrored and scaled, to 1e-9 of its size.
#[test]
fn every_contour_is_solved_and_the_same_however_it_is_written() {
    let spiro = faircurve::catalog::spline("spiro").unwrap();
    let solve = |contour: &Contour| faircurve::solve(contour, &*spiro).unwrap();
    for (name, ..) in COUNTS {
        let Some(bytes) = font(name) else { continue };
        let document = parse("sfd", bytes).unwrap();
        let contours = document.glyphs.iter().flat_map(|glyph| &glyph.contours);
        for contour in contours.map(|contour| &contour.contour) {
            let solution = solve(contour);
            assert!(solution.report.relaxed.is_empty(), "{name}: {contour:?}");
            assert!(solution.report.residual <= 1e-9, "{name}: {contour:?}");
            let n = contour.knots.len();
            if !contour.closed || n < 2 {
                continue;
            }
            let before = middles(&solution);
            let size = solution.curve.bounding_box().unwrap().size().max_side();
            let compare = |what: &str, after: Vec<Point>, map: Affine, scale: f64| {
                for (before, after) in before.iter().zip(after) {
                    let off = (map * *before - after).hypot();
                    assert!(off <= 1e-9 * scale * size, "{name}, {what}: {off:e} {contour:?}");
                }
            };
            let mut shifted = contour.clone();
            shifted.knots.rotate_left(n / 3);
            let mut after = middles(&solve(&shifted));
            after.rotate_right(n / 3);
            compare("another start", after, Affine::IDENTITY, 1.0);
            let mut after = middles(&solve(&contour.reversed()));
            after[..n - 1].reverse();
            compare("backwards", after, Affine::IDENTITY, 1.0);
            for (angle, scale, mirror) in [(0.7, 1e-6, 1.0), (2.0, 1e6, -1.0), (-1.1, 0.3, 1.0)] {
                let map = Affine::rotate(angle) * Affine::scale_non_uniform(scale, mirror * scale);
                let mut moved = contour.clone();
                moved.knots.iter_mut().for_each(|knot| {
                    let turned = |v: Vec2| (map * v.to_point()).to_vec2();
                    knot.point = map * knot.point;
                    knot.tangent_in = knot.tangent_in.map(turned);
                    knot.tangent_out = knot.tangent_out.map(turned);
                    knot.curvature_in = knot.curvature_in.map(|k| k * mirror / scale);
                    knot.curvature_out = knot.curvature_out.map(|k| k * mirror / scale);
                });
                compare("moved", middles(&solve(&moved)), map, scale);
            }
        }
    }
}

/// The middle of each segment.
fn middles(solution: &Solution) -> Vec<Point> {
    let segments = solution.curve.segments().iter();
    segments.map(|segment| segment.point(segment.length() / 2.0)).collect()
}

/// Béziers of real glyphs keep the accuracy asked for, over decades; corners, straight pieces and
/// knots stay where they are, and closed contours close exactly.
#[test]
fn beziers_keep_their_accuracy() {
    let spiro = faircurve::catalog::spline("spiro").unwrap();
    let Some(bytes) = font("Cantarell-Regular-Spiro.sfd") else { return };
    let document = parse("sfd", bytes).unwrap();
    let contours = document.glyphs.iter().flat_map(|glyph| &glyph.contours);
    for contour in contours.step_by(12).map(|contour| &contour.contour) {
        let solution = faircurve::solve(contour, &*spiro).unwrap();
        for accuracy in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            let path = faircurve::convert::to_bezpath(&solution.curve, accuracy);
            let pieces: Vec<PathSeg> = path.segments().collect();
            for piece in &pieces {
                for i in 0..=24 {
                    let point = piece.eval(f64::from(i) / 24.0);
                    let (.., off) = solution.curve.nearest(point, 1e-2 * accuracy).unwrap();
                    assert!(off <= accuracy, "{off:e} at {accuracy:e}: {contour:?}");
                }
            }
            let ends: Vec<Point> = pieces.iter().map(PathSeg::start).collect();
            for (knot, segment) in contour.knots.iter().zip(solution.curve.segments()) {
                assert!(ends.contains(&knot.point), "{accuracy:e}: {knot:?}");
                let line = PathSeg::Line(Line::new(segment.start(), segment.end()));
                assert!(!segment.is_line() || pieces.contains(&line));
            }
            assert_eq!(pieces.first().map(PathSeg::start), pieces.last().map(PathSeg::end));
        }
    }
}
