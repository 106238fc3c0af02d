//! Knots as rows.

mod common;

use common::{complaint, parse};
use faircurve::{Contour, Join, Knot};
use faircurve_format::{Document, Glyph, SplineChoice, csv};
use insta::assert_snapshot;
use proptest::prelude::*;

#[test]
fn rows_are_read() {
    let text = "# closed\n0,0,corner\n 300 , 100 \n# a remark\n200,400,\n\n\n-5e2,0.5,g2\n600,100";
    let expected = Document::unnamed([
        Contour::closed([
            Knot::new((0.0, 0.0)).join(Join::Corner),
            Knot::new((300.0, 100.0)),
            Knot::new((200.0, 400.0)),
        ]),
        Contour::open([Knot::new((-500.0, 0.5)).join(Join::G2), Knot::new((600.0, 100.0))]),
    ]);
    assert_eq!(parse("csv", text).unwrap(), expected);
    assert_eq!(parse("csv", text.replace('\n', "\r\n")).unwrap(), expected);
    assert_eq!(parse("csv", format!("\u{feff}{text}")).unwrap(), expected);
    // A spreadsheet's way to leave a row blank.
    assert_eq!(parse("csv", text.replace("\n\n\n", "\n,,\n")).unwrap(), expected);
}

#[test]
fn closing_waits_for_the_next_contour() {
    let document = parse("csv", "0,0\n1,1\n\n# closed\n\n# remark\n2,2\n").unwrap();
    let closed: Vec<bool> =
        document.glyphs[0].contours.iter().map(|contour| contour.contour.closed).collect();
    assert_eq!(closed, [false, true]);
}

#[test]
fn mistakes_are_explained() {
    assert_snapshot!(complaint("csv", ""), @r#"
    1:1: there are no knots in the file
      at: 
      hint: write one a line, as `x,y` or `x,y,join`
    "#);
    assert_snapshot!(complaint("csv", "# nothing\n\n"), @r#"
    3:1: there are no knots in the file
      at: 
      hint: write one a line, as `x,y` or `x,y,join`
    "#);
    assert_snapshot!(complaint("csv", "x,y\n0,0\n"), @r#"
    1:1: contour 0, knot 0: `x` is not a number
      at: x
      hint: start headings and remarks with `#`
    "#);
    assert_snapshot!(complaint("csv", "0,0\n\n1,1\n10, 1o\n"), @r#"
    4:5: contour 1, knot 1: `1o` is not a number
      at: 1o
    "#);
    assert_snapshot!(complaint("csv", "0,0\n1;2\n"), @r#"
    2:1: contour 0, knot 1: `1;2` is not a row
      at: 1;2
      hint: write `x,y` or `x,y,join`, with commas between
    "#);
    assert_snapshot!(complaint("csv", "0,0\n1\n"), @r#"
    2:1: contour 0, knot 1: `1` is not a row
      at: 1
      hint: write `x,y` or `x,y,join`, with commas between
    "#);
    assert_snapshot!(complaint("csv", "0,0\n1,\n"), @r#"
    2:3: contour 0, knot 1: a number is missing
      at:
    "#);
    assert_snapshot!(complaint("csv", "0,0\n1,2,corner,5\n"), @r#"
    2:12: contour 0, knot 1: a row has at most three fields
      at: 5
      hint: write `x,y` or `x,y,join`, with points in numbers: `0.5`
    "#);
    assert_snapshot!(complaint("csv", "0,0\n1,2,cornr\n"), @r#"
    2:5: contour 0, knot 1: there is no join `cornr`
      at: cornr
      hint: did you mean `corner`?
    "#);
    assert_snapshot!(complaint("csv", "0,0\n1,2,v\n"), @r#"
    2:5: contour 0, knot 1: there is no join `v`
      at: v
      hint: use one of `corner`, `g1`, `g2`, `g4`, `curve-to-terminal`, `terminal-to-curve`
    "#);
    assert_snapshot!(complaint("csv", "0,0\nNaN,1\n"), @r#"
    2:1: contour 0, knot 1: `NaN` is not a finite number
      at: NaN
    "#);
    assert_snapshot!(complaint("csv", "0,0\n1,inf\n"), @r#"
    2:3: contour 0, knot 1: `inf` is not a finite number
      at: inf
    "#);
    assert_snapshot!(complaint("csv", "0,0\n1e999,1\n"), @r#"
    2:1: contour 0, knot 1: `1e999` is beyond the largest number
      at: 1e999
    "#);
    assert_snapshot!(complaint("csv", "0,0\n1e300,1\n"), @r#"
    2:1: contour 0, knot 1: `1e300` lies beyond 1e55 units
      at: 1e300
    "#);
    assert_snapshot!(complaint("csv", "0,0\n# closed\n1,1\n"), @r#"
    2:1: `# closed` stands inside a contour
      at: # closed
      hint: put it before the contour's first row, after a blank line
    "#);
    assert_snapshot!(complaint("csv", "0,0\n\n# closed\n"), @r#"
    3:1: `# closed` has no contour after it
      at: # closed
    "#);
    assert_snapshot!(complaint("csv", b"0,0\n1,\xb2\n"), @r#"
    2:3: the byte 0xb2 is not UTF-8 text
      at: �
      hint: save the file as UTF-8
    "#);
    let long = parse("csv", "0,0\n".to_owned() + &"z".repeat(100_000)).unwrap_err();
    assert_snapshot!(long, @"2:1: contour 0, knot 1: `zzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzz…` is not a row");
}

#[test]
fn a_million_knots_are_read() {
    let document = parse("csv", "0.125,-350,g2\n".repeat(1_000_000)).unwrap();
    assert_eq!(document.glyphs[0].contours[0].contour.knots.len(), 1_000_000);
}

#[test]
fn what_rows_cannot_hold_is_not_written() {
    let refusal = |document: &Document| csv::write(document).unwrap_err().to_string();
    let plain = Document::unnamed([Contour::open([(0.0, 0.0)])]);
    assert!(csv::write(&plain).is_ok());

    let mut named = plain.clone();
    named.glyphs[0].name = "a".to_owned();
    assert_snapshot!(refusal(&named), @"CSV can't hold the names of glyphs and layers");
    let mut two = plain.clone();
    two.glyphs.push(Glyph::default());
    assert_snapshot!(refusal(&two), @"CSV can't hold 2 glyphs, only one");
    let mut euler = plain.clone();
    euler.spline = SplineChoice::new("euler");
    assert_snapshot!(refusal(&euler), @"CSV can't hold the choice of a spline");
    let mut own = plain.clone();
    own.glyphs[0].contours[0].spline = Some(SplineChoice::new("euler"));
    assert_snapshot!(refusal(&own), @"CSV can't hold the choice of a spline");
    let tangent = Document::unnamed([Contour::open([Knot::new((0.0, 0.0)).tangent((1.0, 0.0))])]);
    assert_snapshot!(refusal(&tangent), @"CSV can't hold what is given at contour 0, knot 0");
    let infinite = Document::unnamed([Contour::open([(0.0, f64::INFINITY)])]);
    assert_snapshot!(refusal(&infinite), @"CSV can't hold numbers that aren't finite: contour 0, knot 0");
    assert_snapshot!(refusal(&Document::unnamed([Contour::default()])), @"CSV can't hold contour 0, which has no knots");
    assert_snapshot!(refusal(&Document::unnamed([])), @"CSV can't hold a drawing without contours");
}

fn document() -> impl Strategy<Value = Document> {
    let number = prop_oneof![
        (-2000..2000i32).prop_map(f64::from),
        proptest::num::f64::NORMAL.prop_filter("a coordinate", |n| n.abs() <= 1e55),
        Just(-0.0),
    ];
    let knot = (
        (number.clone(), number),
        proptest::option::of(proptest::sample::select(Join::ALL.to_vec())),
    )
        .prop_map(|(point, join)| Knot { point: point.into(), join, ..Knot::default() });
    let contour = (proptest::collection::vec(knot, 1..5), any::<bool>())
        .prop_map(|(knots, closed)| Contour { knots, closed });
    proptest::collection::vec(contour, 1..4).prop_map(Document::unnamed)
}

proptest! {
    #[test]
    fn a_written_document_reads_back(document in document()) {
        let text = csv::write(&document).unwrap();
        let back = parse("csv", &text).unwrap();
        prop_assert_eq!(&back, &document);
        prop_assert_eq!(csv::write(&back).unwrap(), text);
    }

    #[test]
    fn any_prefix_is_an_error_or_a_document(document in document(), cut: prop::sample::Index) {
        let text = csv::write(&document).unwrap();
        let _ = parse("csv", &text[..cut.index(text.len())]);
    }

    #[test]
    fn any_bytes_are_an_error_or_a_document(bytes: Vec<u8>, text in "[-0-9.,e#closed \r\n]*") {
        let _ = parse("csv", &bytes);
        let _ = parse("csv", &text);
    }
}
