//! The small documents that newcomers run.

mod common;

use std::path::Path;

use common::parse;
use faircurve::Join;
use faircurve_format::{Document, Kind, read};

const EXAMPLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");

fn example(name: &str) -> Document {
    let extension = Path::new(name).extension().unwrap().to_str().unwrap();
    let bytes = std::fs::read(Path::new(EXAMPLES).join(name)).unwrap();
    read(&bytes, Kind::from_extension(extension).unwrap()).unwrap()
}

#[test]
fn the_joins_are_all_shown() {
    let document = example("joins.json");
    let knots = document
        .glyphs
        .iter()
        .flat_map(|glyph| &glyph.contours)
        .flat_map(|contour| &contour.contour.knots);
    let shown: Vec<Join> = knots.filter_map(|knot| knot.join).collect();
    for join in Join::ALL {
        assert!(shown.contains(&join), "{join}");
    }
}

#[test]
fn the_circle_is_one() {
    let document = example("circle.csv");
    let [contour] = &document.glyphs[0].contours[..] else { panic!("one contour") };
    assert!(contour.contour.closed);
    let centre = (300.0, 300.0).into();
    for knot in &contour.contour.knots {
        assert_eq!(knot.point.distance(centre), 250.0);
    }
}

#[test]
fn the_comma_is_drawn_with_spiro() {
    let document = example("comma.sfd");
    let [glyph] = &document.glyphs[..] else { panic!("one glyph") };
    assert_eq!((glyph.name.as_str(), glyph.layer.as_str()), ("comma", "Fore"));
    assert!(glyph.contours[0].contour.closed);
}

#[test]
fn every_example_is_read() {
    for entry in std::fs::read_dir(EXAMPLES).unwrap() {
        let path = entry.unwrap().path();
        let extension = path.extension().and_then(|extension| extension.to_str());
        if let Some(Ok(kind)) = extension.map(Kind::from_extension) {
            let read = parse(kind.name, std::fs::read(&path).unwrap());
            assert!(read.is_ok(), "{}: {}", path.display(), read.unwrap_err());
        }
    }
}
