//! Real fonts drawn with Spiro. They are not part of the repository; without them these tests say
//! so and pass.

mod common;

use common::parse;
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
