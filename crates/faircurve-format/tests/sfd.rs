//! FontForge's SFD: what is read of it, and what it says about damage.

mod common;

use common::{complaint, parse};
use faircurve::{Contour, Join, Knot};
use faircurve_format::{Document, DocumentContour, Glyph, SplineChoice};
use insta::assert_snapshot;
use proptest::prelude::*;

/// Every point type, selected points, several layers, names in quotes, and text that only looks
/// like Spiro points.
const FONT: &[u8] = b"SplineFontDB: 3.2
FontName: Sampler
Comments: \"Spiro\"
LayerCount: 3
Layer: 0 0 \"Back\" 1
Layer: 1 0 \"Fore\" 0
Layer: 2 0 \"Entw+APw-rfe\" 0
Grid
-1000 700 m 0
 2000 700 l 1024
  Spiro
    -1000 700 {
    2000 700 o
    0 0 z
  EndSpiro
  Named: \"x-height\"
EndSplineSet
BeginChars: 256 4

StartChar: a
Encoding: 97 97 0
Comment: \"Spiro\"
PickledData: \"(dp0
S'EndChar \\\"Spiro\\\"'
SplineSet
Spiro
\\\\\"
LayerCount: 3
Back
Image: 4 4 0 4 2 1 0 0 1 1
SplineSet
EndImage
SplineSet
0 0 m 0
 10 10 l 0
EndSplineSet
Fore
SplineSet
0 0 m 0
 10 10 l 0
 0 0 l 0
  Spiro
    0 0 v
    10 -1.5 \xef
    20.25 1e2 c
    30 5 [
    40 5 \xdd
    50 5 a
    53 1 h
    751 510 z
  EndSpiro
0 0 m 0
 10 10 l 0
  Named: \"no Spiro here\"
500 0 m 1
  Spiro
    500 0 {
    0 0 z
  EndSpiro
1 1 m 1
  Spiro
    0 0 z
  EndSpiro
7 7 m 1
  Spiro
    7 7 v
    0 0 z
  EndSpiro
EndSplineSet
Validated: 1
Layer: 2
SplineSet
1 1 m 1
  Spiro
    1 1 {
    2 2 o
    3 3 ]
    0 0 z
  EndSpiro
4 4 m 1
  Spiro
    4 4 {
    5 5 a
    6 5 h
    7 7 }
    0 0 z
  EndSpiro
EndSplineSet
EndChar

StartChar: empty
Encoding: 98 98 1
Fore
Refer: 0 97 N 1 0 0 1 0 0 2
EndChar

StartChar: \"ampersand.gro+AN8A-\"
Encoding: 38 38 2
Back
SplineSet
8 8 m 1
  Spiro
    8 8 o
    9 9 o
    0 0 z
  EndSpiro
EndSplineSet
EndChar
EndChars
EndSplineFont
";

const GLYPH: &str = "StartChar: b
Encoding: 98 98 1
Layer: 2
SplineSet
0 0 m 0
  Spiro
    0 0 v
    10 10 o
    0 0 z
  EndSpiro
EndSplineSet
EndChar
";

fn glyph(name: &str, layer: &str, contours: impl IntoIterator<Item = Contour>) -> Glyph {
    Glyph {
        name: name.to_owned(),
        layer: layer.to_owned(),
        contours: contours.into_iter().map(DocumentContour::from).collect(),
    }
}

fn knot(x: f64, y: f64, join: Join) -> Knot {
    Knot::new((x, y)).join(join)
}

#[test]
fn every_spiro_block_is_read() {
    let anchor = |x: f64, y: f64, tangent: (f64, f64)| {
        knot(x, y, Join::G1).tangent(tangent).curvature_in(0.0).curvature_out(0.0)
    };
    let fore = [
        Contour::closed([
            knot(0.0, 0.0, Join::Corner),
            knot(10.0, -1.5, Join::G4),
            knot(20.25, 100.0, Join::G2),
            knot(30.0, 5.0, Join::CurveToTerminal),
            knot(40.0, 5.0, Join::TerminalToCurve),
            anchor(50.0, 5.0, (3.0, -4.0)),
        ]),
        Contour::open([(500.0, 0.0)]),
        Contour::closed([knot(7.0, 7.0, Join::Corner)]),
    ];
    let draft = [
        Contour::open([Knot::new((1.0, 1.0)), knot(2.0, 2.0, Join::G4), Knot::new((3.0, 3.0))]),
        Contour::open([Knot::new((4.0, 4.0)), anchor(5.0, 5.0, (1.0, 0.0)), Knot::new((7.0, 7.0))]),
    ];
    let back = [Contour::closed([knot(8.0, 8.0, Join::G4), knot(9.0, 9.0, Join::G4)])];
    let grid = [Contour::open([(-1000.0, 700.0), (2000.0, 700.0)])];
    let expected = Document {
        spline: SplineChoice::new("spiro"),
        glyphs: vec![
            glyph("", "Grid", grid),
            glyph("a", "Fore", fore),
            glyph("a", "Entwürfe", draft),
            glyph("ampersand.groß", "Back", back),
        ],
    };
    assert_eq!(parse("sfd", FONT).unwrap(), expected);

    let text: Vec<u8> = FONT
        .iter()
        .flat_map(|&byte| match byte {
            b'\n' => vec![b'\r', b'\n'],
            other => vec![other],
        })
        .collect();
    assert_eq!(parse("sfd", text).unwrap(), expected);
}

#[test]
fn a_glyph_of_a_font_folder_is_read() {
    let contour = Contour::closed([knot(0.0, 0.0, Join::Corner), knot(10.0, 10.0, Join::G4)]);
    let document = parse("sfd", GLYPH).unwrap();
    assert_eq!(document.glyphs, [glyph("b", "Layer 2", [contour])]);
}

#[test]
fn a_font_without_spiro_points_has_no_glyphs() {
    let document = parse("sfd", "SplineFontDB: 3.2\nEndSplineFont\n").unwrap();
    assert_eq!(document, Document::default());
}

/// The glyph with these Spiro points.
fn with_points(points: &str) -> String {
    GLYPH.replace("    0 0 v\n    10 10 o\n    0 0 z\n", points)
}

#[test]
fn wrong_points_are_explained() {
    let points = |points: &str| complaint("sfd", with_points(points));
    assert_snapshot!(points("    0 0 v\n    10 1o o\n    0 0 z\n"), @r#"
    8:8: glyph `b`, contour 0, point 1: `1o` is not a number
      at: 1o
    "#);
    assert_snapshot!(points("    0 0 v\n    nan 0 o\n    0 0 z\n"), @r#"
    8:5: glyph `b`, contour 0, point 1: `nan` is not a finite number
      at: nan
    "#);
    assert_snapshot!(points("    0 0 v\n    1e999 0 o\n    0 0 z\n"), @r#"
    8:5: glyph `b`, contour 0, point 1: `1e999` is beyond the largest number
      at: 1e999
    "#);
    assert_snapshot!(points("    0 0 v\n    1e300 0 o\n    0 0 z\n"), @r#"
    8:5: glyph `b`, contour 0, point 1: `1e300` lies beyond 1e55 units
      at: 1e300
    "#);
    assert_snapshot!(points("    0 0 v\n    10 0 x\n    0 0 z\n"), @r#"
    8:10: glyph `b`, contour 0, point 1: there is no point type `x`
      at: x
      hint: the types are v o c [ ] { } a h, and z at the end
    "#);
    assert_snapshot!(points("    0 0 v\n    10 0 oo\n    0 0 z\n"), @r#"
    8:10: glyph `b`, contour 0, point 1: there is no point type `oo`
      at: oo
      hint: the types are v o c [ ] { } a h, and z at the end
    "#);
    assert_snapshot!(points("    0 0 v\n    10,0 o\n    0 0 z\n"), @r#"
    8:5: glyph `b`, contour 0, point 1: expected a point, `x y type`, not `10,0 o`
      at: 10,0 o
    "#);
    assert_snapshot!(points("    0 0 v\n    10 0 o 5\n    0 0 z\n"), @r#"
    8:5: glyph `b`, contour 0, point 1: expected a point, `x y type`, not `10 0 o 5`
      at: 10 0 o 5
    "#);
    assert_snapshot!(points("    0 0 v\n"), @r#"
    8:3: glyph `b`, contour 0: expected the last point, `0 0 z`, before this
      at: EndSpiro
    "#);
    assert_snapshot!(points("    0 0 v\n    0 0 z\n    1 1 o\n"), @r#"
    9:5: glyph `b`, contour 0: expected `EndSpiro` after the point of type z
      at: 1 1 o
    "#);
    assert_snapshot!(points("    0 0 v\n    1 1 {\n    0 0 z\n"), @r#"
    8:5: glyph `b`, contour 0, point 1: `{` opens a contour and must be its first point
      at: 1 1 {
    "#);
    assert_snapshot!(points("    0 0 v\n    1 1 }\n    0 0 z\n"), @r#"
    8:5: glyph `b`, contour 0, point 1: `}` ends a contour, but no `{` opened it
      at: 1 1 }
    "#);
    assert_snapshot!(points("    0 0 {\n    1 1 }\n    2 2 o\n    0 0 z\n"), @r#"
    8:5: glyph `b`, contour 0, point 1: `}` ends a contour and must be its last point
      at: 1 1 }
    "#);
    assert_snapshot!(points("    0 0 v\n    1 1 a\n    2 2 o\n    0 0 z\n"), @r#"
    8:5: glyph `b`, contour 0, point 1: after an anchor `a` comes its handle `h`
      at: 1 1 a
    "#);
    assert_snapshot!(points("    0 0 v\n    1 1 a\n    0 0 z\n"), @r#"
    8:5: glyph `b`, contour 0, point 1: after an anchor `a` comes its handle `h`
      at: 1 1 a
    "#);
    assert_snapshot!(points("    0 0 v\n    1 1 h\n    0 0 z\n"), @r#"
    8:5: glyph `b`, contour 0, point 1: before a handle `h` comes its anchor `a`
      at: 1 1 h
    "#);
    assert_snapshot!(points("    0 0 v\n    1 1 a\n    1 1 h\n    0 0 z\n"), @r#"
    8:5: glyph `b`, contour 0, point 1: `a` and `h` are at one place, so give no tangent
      at: 1 1 a
    "#);
}

#[test]
fn wrong_files_are_explained() {
    assert_snapshot!(complaint("sfd", ""), @r#"
    1:1: the file is empty; expected `SplineFontDB:` (a font) or `StartChar:` (a glyph)
      at: 
      hint: the file may have been cut off; get it again or save it again
    "#);
    assert_snapshot!(complaint("sfd", "\n\n{\"faircurve\": 1}"), @r#"
    3:1: this is not an SFD file; expected `SplineFontDB:` (a font) or `StartChar:` (a glyph)
      at: {"faircurve": 1}
    "#);
    assert_snapshot!(complaint("sfd", b"\x7fELF\x02\x01\x00\n\xff\xfe"), @r#"
    1:1: this is not an SFD file; expected `SplineFontDB:` (a font) or `StartChar:` (a glyph)
      at: �ELF���
    "#);
    assert_snapshot!(complaint("sfd", GLYPH.replace("EndSplineSet\n", "")), @r#"
    11:1: glyph `b`: expected `EndSplineSet` before this
      at: EndChar
    "#);
    assert_snapshot!(complaint("sfd", GLYPH.replace("  EndSpiro\n", "")), @r#"
    10:1: glyph `b`, contour 0: expected `EndSpiro` after the point of type z
      at: EndSplineSet
    "#);
    assert_snapshot!(complaint("sfd", GLYPH.replace("EndChar\n", "StartChar: c\n")), @r#"
    12:1: glyph `b`: expected `EndChar` before this
      at: StartChar: c
    "#);
    assert_snapshot!(complaint("sfd", GLYPH.replace("Layer: 2", "Layer: two")), @r#"
    3:1: glyph `b`: expected `Layer:` and a number
      at: Layer: two
    "#);
    assert_snapshot!(complaint("sfd", format!("{GLYPH}more\n")), @r#"
    13:1: expected the end of the file after `EndChar`
      at: more
    "#);
    assert_snapshot!(complaint("sfd", format!("SplineFontDB: 3.0\n{GLYPH}")), @r#"
    14:1: the file ends too early, inside the font; expected `EndSplineFont`
      at: 
      hint: the file may have been cut off; get it again or save it again
    "#);
    let font = format!("SplineFontDB: 3.0\n{GLYPH}EndSplineFont\nmore\n");
    assert_snapshot!(complaint("sfd", font), @r#"
    16:1: the file ends too early, inside the font; expected `EndSplineFont`
      at: 
      hint: the file may have been cut off; get it again or save it again
    "#);
}

#[test]
fn cut_off_files_are_explained() {
    let cut = |after: &str| {
        let at = GLYPH.find(after).unwrap() + after.len();
        complaint("sfd", &GLYPH[..at])
    };
    assert_snapshot!(cut("StartChar: b\n"), @r#"
    2:1: the file ends too early, inside glyph `b`; expected `EndChar`
      at: 
      hint: the file may have been cut off; get it again or save it again
    "#);
    assert_snapshot!(cut("SplineSet\n0 0 m"), @r#"
    5:6: the file ends too early, inside glyph `b`; expected `EndSplineSet`
      at: 
      hint: the file may have been cut off; get it again or save it again
    "#);
    assert_snapshot!(cut("Spiro\n    0 0 v\n"), @r#"
    8:1: the file ends too early, inside the Spiro points of glyph `b`, contour 0; expected a point, `x y type`
      at: 
      hint: the file may have been cut off; get it again or save it again
    "#);
    assert_snapshot!(cut("    10 1"), @r#"
    8:5: glyph `b`, contour 0, point 1: expected a point, `x y type`, not `10 1`
      at: 10 1
    "#);
    assert_snapshot!(cut("0 0 z\n"), @r#"
    10:1: the file ends too early, inside the Spiro points of glyph `b`, contour 0; expected `EndSpiro`
      at: 
      hint: the file may have been cut off; get it again or save it again
    "#);
    assert_snapshot!(cut("EndSpiro\n"), @r#"
    11:1: the file ends too early, inside glyph `b`; expected `EndSplineSet`
      at: 
      hint: the file may have been cut off; get it again or save it again
    "#);
    assert_snapshot!(cut("EndSplineSet\n"), @r#"
    12:1: the file ends too early, inside glyph `b`; expected `EndChar`
      at: 
      hint: the file may have been cut off; get it again or save it again
    "#);
    let pickled = "StartChar: a\nPickledData: \"(dp0\nEndChar\n";
    assert_snapshot!(complaint("sfd", pickled), @r#"
    4:1: the file ends too early, inside PickledData; expected `"`
      at: 
      hint: the file may have been cut off; get it again or save it again
    "#);
    assert_snapshot!(complaint("sfd", "StartChar: a\nImage2: image/png 9 0 0 1 1\nEndChar\n"), @r#"
    4:1: the file ends too early, inside an image; expected `EndImage2`
      at: 
      hint: the file may have been cut off; get it again or save it again
    "#);
}

#[test]
fn every_cut_is_an_error() {
    for file in [FONT, GLYPH.as_bytes()] {
        let whole = parse("sfd", file).unwrap();
        let end = file.trim_ascii_end().len();
        for cut in 0..=file.len() {
            match parse("sfd", &file[..cut]) {
                Ok(document) => {
                    assert!(cut >= end, "read after {cut} bytes");
                    assert_eq!(document, whole);
                }
                Err(error) => {
                    assert!(cut < end, "refused after {cut} bytes: {error}");
                    let location = error.location.unwrap();
                    assert!(location.offset + location.length <= cut);
                }
            }
        }
    }
}

#[test]
fn huge_files_are_read() {
    let points = with_points(&("    0.125 -350 c\n".repeat(1_000_000) + "    0 0 z\n"));
    assert_eq!(parse("sfd", points).unwrap().glyphs[0].contours[0].contour.knots.len(), 1_000_000);
    // Many layers, many glyphs without an end, one endless line.
    let layers: String = (0..100_000)
        .map(|n| format!("Layer: {n}\nSplineSet\nSpiro\n0 0 v\n0 0 z\nEndSpiro\nEndSplineSet\n"))
        .collect();
    let document = parse("sfd", format!("StartChar: a\n{layers}EndChar\n")).unwrap();
    assert_eq!(document.glyphs.len(), 100_000);
    assert!(parse("sfd", "StartChar: a\n".repeat(100_000)).is_err());
    assert!(parse("sfd", "SplineFontDB: 3.0\n".to_owned() + &"x".repeat(10_000_000)).is_err());
}

proptest! {
    #[test]
    fn any_damage_is_an_error_or_a_document(
        at in 0..FONT.len(),
        bytes: Vec<u8>,
        drop in 0..40usize,
    ) {
        let mut font = FONT.to_vec();
        font.splice(at..(at + drop).min(FONT.len()), bytes);
        if let Err(error) = parse("sfd", &font) {
            let location = error.location.unwrap();
            prop_assert!(location.offset + location.length <= font.len());
        }
    }

    #[test]
    fn any_bytes_are_an_error_or_a_document(bytes: Vec<u8>, lines in "[ 0-9.voch{}z\\[\\]\n-]*") {
        let _ = parse("sfd", &bytes);
        let _ = parse("sfd", with_points(&lines));
        let _ = parse("sfd", format!("SplineFontDB: 3\nGrid\nSpiro\n{lines}"));
    }
}
