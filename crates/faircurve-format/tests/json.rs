//! The faircurve document: what it holds, and what it says about mistakes.

mod common;

use common::{complaint, parse};
use faircurve::catalog::{self, CatalogError, ParamKind, ParamValue, Params};
use faircurve::kurbo::{Point, Vec2};
use faircurve::{Contour, Join, Knot};
use faircurve_format::{Document, DocumentContour, Glyph, SplineChoice, json};
use insta::assert_snapshot;
use proptest::option;
use proptest::prelude::*;

const DOCUMENT: &str = r#"{ "faircurve": 1, "spline": "spiro", "params": {},
  "glyphs": [ { "name": "a", "layer": "Fore", "contours": [ { "closed": true, "knots": [
      {"x": 0, "y": 0, "join": "g4"}, {"x": 90, "y": 10, "join": "corner", "tangent_out": [1, 0]} ] } ] } ] }
"#;

/// One contour with these knots.
fn with_knots(knots: &str) -> String {
    format!(
        "{{\"faircurve\": 1, \"contours\": [\n  {{\"closed\": true, \"knots\": [{knots}]}}\n]}}"
    )
}

#[test]
fn a_document_is_read() {
    let contour = Contour::closed([
        Knot::new((0.0, 0.0)).join(Join::G4),
        Knot::new((90.0, 10.0)).join(Join::Corner).tangent_out((1.0, 0.0)),
    ]);
    let glyph = Glyph {
        name: "a".to_owned(),
        layer: "Fore".to_owned(),
        contours: vec![DocumentContour::from(contour)],
    };
    let expected = Document { spline: SplineChoice::new("spiro"), glyphs: vec![glyph] };
    assert_eq!(parse("json", DOCUMENT).unwrap(), expected);
    // An editor's byte order mark changes nothing.
    assert_eq!(parse("json", format!("\u{feff}{DOCUMENT}")).unwrap(), expected);
}

#[test]
fn everything_at_a_knot_is_read() {
    let text = with_knots(
        r#"{"curl": 1, "tension_out": 2.5, "tension_in": 2, "curvature_out": -0.1,
            "curvature_in": 1e-2, "tangent": [0, -2], "join": "curve-to-terminal", "y": 2, "x": -1},
           {"x": 3, "y": 4, "tangent_in": [1, 0], "tangent_out": [0, 1]}"#,
    );
    let document = parse("json", text).unwrap();
    let knots = &document.glyphs[0].contours[0].contour.knots;
    let expected = Knot {
        point: Point::new(-1.0, 2.0),
        join: Some(Join::CurveToTerminal),
        tangent_in: Some(Vec2::new(0.0, -2.0)),
        tangent_out: Some(Vec2::new(0.0, -2.0)),
        curvature_in: Some(0.01),
        curvature_out: Some(-0.1),
        tension_in: Some(2.0),
        tension_out: Some(2.5),
        curl: Some(1.0),
    };
    assert_eq!(knots[0], expected);
    assert_eq!(knots[1], Knot::new((3.0, 4.0)).tangent_in((1.0, 0.0)).tangent_out((0.0, 1.0)));
}

#[test]
fn every_join_is_read_by_its_name() {
    for join in Join::ALL {
        let text = with_knots(&format!(r#"{{"x": 0, "y": 0, "join": "{join}"}}"#));
        let document = parse("json", text).unwrap();
        assert_eq!(document.glyphs[0].contours[0].contour.knots[0].join, Some(join));
    }
}

#[test]
fn a_contour_may_have_its_own_spline() {
    // The document's spline comes last, and still counts.
    let text = r#"{"faircurve": 1, "contours": [
        {"knots": [{"x": 0, "y": 0}]},
        {"knots": [{"x": 0, "y": 0}], "spline": "spiro"},
        {"knots": [{"x": 0, "y": 0}], "params": {}}
    ], "spline": "euler"}"#;
    let document = parse("json", text).unwrap();
    let [plain, own, params] = &document.glyphs[0].contours[..] else { panic!("three contours") };
    assert_eq!(document.spline_of(plain), &SplineChoice::new("euler"));
    assert_eq!(document.spline_of(own), &SplineChoice::new("spiro"));
    assert_eq!(document.spline_of(params), &SplineChoice::new("euler"));
    let no_spline = parse("json", r#"{"faircurve": 1, "glyphs": []}"#).unwrap();
    assert_eq!(no_spline, Document::default());
    assert_eq!(no_spline.spline.name, "spiro");
}

#[test]
fn mistakes_in_the_document_are_explained() {
    assert_snapshot!(complaint("json", ""), @r#"
    1:1: the file is empty
      at: 
      hint: complete the file; it may have been cut off
    "#);
    assert_snapshot!(complaint("json", "[1, 2]"), @r#"
    1:1: the document must be an object, not a list
      at: [
    "#);
    assert_snapshot!(complaint("json", "{\n  \"glyphs\": []}"), @r#"
    1:1: this is not a faircurve document: it has no key `faircurve`
      at: {
      hint: start it with `{ "faircurve": 1, …`
    "#);
    assert_snapshot!(complaint("json", r#"{"faircurve": 2, "glyphs": []}"#), @r#"
    1:15: version 2 is unknown
      at: 2
      hint: this program reads version 1
    "#);
    assert_snapshot!(complaint("json", r#"{"faircurve": "1", "glyphs": []}"#), @r#"
    1:15: version "1" is unknown
      at: "1"
      hint: this program reads version 1
    "#);
    assert_snapshot!(complaint("json", r#"{"faircurve": 1}"#), @r#"
    1:1: the document has neither `glyphs` nor `contours`
      at: {
      hint: add `"contours": […]`
    "#);
    assert_snapshot!(complaint("json", r#"{"faircurve": 1, "glyphs": [], "contours": []}"#), @r#"
    1:44: the document has both `glyphs` and `contours`
      at: [
      hint: move these contours into a glyph
    "#);
    assert_snapshot!(complaint("json", r#"{"faircurve": 1, "glyfs": []}"#), @r#"
    1:18: there is no key `glyfs` here
      at: "glyfs"
      hint: did you mean `glyphs`?
    "#);
    assert_snapshot!(complaint("json", r#"{"faircurve": 1, "glyphs": {}}"#), @r#"
    1:28: `glyphs` must be a list, not an object
      at: {
    "#);
    assert_snapshot!(complaint("json", r#"{"faircurve": 1, "glyphs": [5]}"#), @r#"
    1:29: glyph 0 must be an object, not `5`
      at: 5
    "#);
    assert_snapshot!(
        complaint("json", r#"{"faircurve": 1, "glyphs": [{"name": "a", "contour": []}]}"#), @r#"
    1:43: glyph 0: there is no key `contour` here
      at: "contour"
      hint: did you mean `contours`?
    "#);
    assert_snapshot!(complaint("json", r#"{"faircurve": 1, "glyphs": [{"name": "a"}]}"#), @r#"
    1:29: glyph `a`: the key `contours` is missing
      at: {
    "#);
    assert_snapshot!(
        complaint("json", r#"{"faircurve": 1, "glyphs": [{"name": 7, "contours": []}]}"#), @r#"
    1:38: glyph 0: `name` must be a string, not `7`
      at: 7
    "#);
    assert_snapshot!(complaint("json", r#"{"faircurve": 1, "glyphs": []} extra"#), @r#"
    1:32: malformed JSON: trailing characters, found `extra`
      at: extra
    "#);
    assert_snapshot!(complaint("json", r#"{"faircurve": 1, "glyphs": [], "glyphs": []}"#), @r#"
    1:32: the key `glyphs` is given twice
      at: "glyphs"
      hint: leave one of them out
    "#);
    assert_snapshot!(complaint("json", b"{\"faircurve\": 1,\n \"spline\": \"\xff\"}"), @r#"
    2:13: the byte 0xff is not UTF-8 text
      at: �
      hint: save the file as UTF-8
    "#);
}

#[test]
fn mistakes_in_the_choice_of_a_spline_are_explained() {
    let with = |keys: &str| format!(r#"{{"faircurve": 1, "glyphs": [], {keys}}}"#);
    assert_snapshot!(complaint("json", with(r#""spline": 5"#)), @r#"
    1:42: `spline` must be a string, not `5`
      at: 5
    "#);
    assert_snapshot!(complaint("json", with(r#""params": {"a": [1]}"#)), @r#"
    1:48: parameter `a` must be a number or a string, not a list
      at: [
    "#);
    assert_snapshot!(complaint("json", with(r#""params": 3"#)), @r#"
    1:42: `params` must be an object, not `3`
      at: 3
    "#);

    // The catalogue grows, so that its hints change: they are asked of itself.
    let check = |text: &str, token: &str, place: &str, wrong: CatalogError| {
        let error = parse("json", text).unwrap_err();
        let location = error.location.unwrap();
        assert_eq!(&text[location.offset..][..location.length], token);
        assert_eq!(error.message, format!("{place}{wrong}"));
        assert_eq!(error.hint, Some(wrong.hint()));
    };
    let unknown = |name: &str| catalog::build(name, &Params::new()).unwrap_err();
    check(&with(r#""spline": "spirro""#), "\"spirro\"", "", unknown("spirro"));
    let contour = r#"{"faircurve": 1, "glyphs": [{"name": "a", "contours": [
        {"spline": "oiler", "knots": [{"x": 0, "y": 0}]}]}]}"#;
    check(contour, "\"oiler\"", "glyph `a`, contour 0: ", unknown("oiler"));
    for info in catalog::ENTRIES {
        let with =
            |params: &str| with(&format!(r#""params": {params}, "spline": "{}""#, info.name));
        let wrong = |name: &str, value: &str| {
            let params = Params::new().with(name, ParamValue::Text(value.to_owned()));
            catalog::build(info.name, &params).unwrap_err()
        };
        check(&with(r#"{"tenshun": "?"}"#), "\"tenshun\"", "", wrong("tenshun", "?"));
        for param in info.params {
            let params = format!(r#"{{"{}": "?"}}"#, param.name);
            check(&with(&params), "\"?\"", "", wrong(param.name, "?"));
        }
    }
}

#[test]
fn mistakes_in_contours_and_knots_are_explained() {
    let knot = |keys: &str| {
        complaint("json", with_knots(&format!("\n    {{\"x\": 0, \"y\": 0}},\n    {{{keys}}}\n  ")))
    };
    assert_snapshot!(complaint("json", with_knots("")), @r#"
    2:29: contour 0 has no knots
      at: [
      hint: give it at least one knot, or leave the contour out
    "#);
    assert_snapshot!(complaint("json", r#"{"faircurve": 1, "contours": [{"closed": 1}]}"#), @r#"
    1:42: contour 0: `closed` must be `true` or `false`, not `1`
      at: 1
    "#);
    assert_snapshot!(complaint("json", r#"{"faircurve": 1, "contours": [{"closed": true}]}"#), @r#"
    1:31: contour 0: the key `knots` is missing
      at: {
    "#);
    assert_snapshot!(complaint("json", with_knots("[0, 0]")), @r#"
    2:30: contour 0, knot 0 must be an object, not a list
      at: [
    "#);
    assert_snapshot!(knot(r#""x": 1"#), @r#"
    4:5: contour 0, knot 1: the key `y` is missing
      at: {
    "#);
    assert_snapshot!(knot(r#""x": "1", "y": 0"#), @r#"
    4:11: contour 0, knot 1: `x` must be a number, not the string "1"
      at: "1"
    "#);
    assert_snapshot!(knot(r#""x": null, "y": 0"#), @r#"
    4:11: contour 0, knot 1: `x` must be a number, not `null`
      at: null
    "#);
    assert_snapshot!(knot(r#""x": 1e999, "y": 0"#), @r#"
    4:11: contour 0, knot 1: `x`: `1e999` is beyond the largest number
      at: 1e999
    "#);
    assert_snapshot!(knot(r#""x": 1e300, "y": 0"#), @r#"
    4:11: contour 0, knot 1: `x`: `1e300` lies beyond 1e55 units
      at: 1e300
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "tangnt": [1, 0]"#), @r#"
    4:22: contour 0, knot 1: there is no key `tangnt` here
      at: "tangnt"
      hint: did you mean one of `tangent`, `tangent_in`, `tangent_out`?
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "z": 0"#), @r#"
    4:22: contour 0, knot 1: there is no key `z` here
      at: "z"
      hint: use one of `x`, `y`, `join`, `tangent`, `tangent_in`, `tangent_out`, `curvature_in`, `curvature_out`, `tension_in`, `tension_out`, `curl`
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "x": 2"#), @r#"
    4:22: contour 0, knot 1: the key `x` is given twice
      at: "x"
      hint: leave one of them out
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "\u0078": 2"#), @r#"
    4:22: contour 0, knot 1: the key `x` is given twice
      at: "\u0078"
      hint: leave one of them out
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "join": "cornr""#), @r#"
    4:30: contour 0, knot 1: there is no join `cornr`
      at: "cornr"
      hint: did you mean `corner`?
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "join": "v""#), @r#"
    4:30: contour 0, knot 1: there is no join `v`
      at: "v"
      hint: use one of `corner`, `g1`, `g2`, `g4`, `curve-to-terminal`, `terminal-to-curve`
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "join": 4"#), @r#"
    4:30: contour 0, knot 1: `join` must be a string, not `4`
      at: 4
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "join": "\ud800""#), @r#"
    4:30: malformed JSON: unexpected end of hex escape
      at: "\ud800"
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "tangent": [0, 0]"#), @r#"
    4:33: contour 0, knot 1: `tangent` has no length, so no direction
      at: [
      hint: give a vector such as [1, 0], or leave it out
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "tangent": [1]"#), @r#"
    4:33: contour 0, knot 1: `tangent` must have 2 numbers, not 1
      at: [
      hint: give a vector such as [1, 0]
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "tangent": 90"#), @r#"
    4:33: contour 0, knot 1: `tangent` must be a vector such as [1, 0], not `90`
      at: 90
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "tangent": [1, "0"]"#), @r#"
    4:37: contour 0, knot 1: `tangent[1]` must be a number, not the string "0"
      at: "0"
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "tangent": [1, 0], "tangent_in": [1, 0]"#), @r#"
    4:55: contour 0, knot 1: `tangent` gives both sides, so no other may be given
      at: [
      hint: give `tangent`, or `tangent_in` and `tangent_out`
    "#);
    assert_snapshot!(knot(r#""x": 1, "y": 0, "curl": true"#), @r#"
    4:30: contour 0, knot 1: `curl` must be a number, not `true`
      at: true
    "#);
}

#[test]
fn what_is_not_json_is_explained() {
    assert_snapshot!(complaint("json", with_knots(r#"{"x": NaN, "y": 0}"#)), @r#"
    2:36: malformed JSON: expected value, found `NaN`
      at: NaN
      hint: only finite numbers have a place in a drawing
    "#);
    assert_snapshot!(complaint("json", with_knots(r#"{"x": -Infinity, "y": 0}"#)), @r#"
    2:36: malformed JSON: invalid number, found `-Infinity`
      at: -Infinity
      hint: only finite numbers have a place in a drawing
    "#);
    assert_snapshot!(complaint("json", with_knots(r#"{"x": .5, "y": 0}"#)), @r#"
    2:36: malformed JSON: expected value, found `.5`
      at: .5
      hint: write numbers such as 0.5 or -12
    "#);
    assert_snapshot!(complaint("json", with_knots(r#"{"x": 1, "y": 0,}"#)), @r#"
    2:46: malformed JSON: key must be a string, found `}`
      at: }
      hint: a comma before it may be one too many
    "#);
    assert_snapshot!(complaint("json", with_knots(r#"{"x": 1 "y": 0}"#)), @r#"
    2:38: malformed JSON: expected `,` or `}`, found `"`
      at: "
    "#);
    assert_snapshot!(complaint("json", with_knots(r#"{'x': 1, "y": 0}"#)), @r#"
    2:31: malformed JSON: key must be a string, found `'`
      at: '
      hint: strings stand in double quotes
    "#);
    assert_snapshot!(complaint("json", "{\n  // comment\n}"), @r#"
    2:3: malformed JSON: key must be a string, found `/`
      at: /
      hint: JSON has no comments
    "#);
    assert_snapshot!(complaint("json", "{\"faircurve\": 1,\n\"a\nb\": 2}"), @r#"
    2:2: malformed JSON: control character (\u0000-\u001F) found while parsing a string, found `a`
      at: a
    "#);
    assert_snapshot!(complaint("json", &DOCUMENT[..100]), @r#"
    2:50: the file ends too early, inside a string
      at: 
      hint: complete the file; it may have been cut off
    "#);
    assert_snapshot!(complaint("json", &DOCUMENT[..40]), @r#"
    1:41: the file ends too early, inside a string
      at: 
      hint: complete the file; it may have been cut off
    "#);
    assert_snapshot!(complaint("json", "\0\u{1}ELF é"), @r#"
    1:1: malformed JSON: expected value, found `\0`
      at: �
    "#);
    // Deep nesting must not exhaust the stack.
    assert_snapshot!(complaint("json", "[".repeat(1_000_000)), @r#"
    1:1000001: the file ends too early, inside a list
      at: 
      hint: complete the file; it may have been cut off
    "#);
    let deep = format!("{{\"faircurve\": {}{}}}", "[".repeat(1_000_000), "]".repeat(1_000_000));
    assert_snapshot!(complaint("json", deep), @r#"
    1:15: version [[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[… is unknown
      at: [
      hint: this program reads version 1
    "#);
}

#[test]
fn columns_count_characters() {
    let text = "{\"faircurve\": 1, \"contours\": [], \"größe\": 1}";
    let location = parse("json", text).unwrap_err().location.unwrap();
    assert_eq!((location.line, location.column), (1, 34));
    assert_eq!(&text[location.offset..][..location.length], "\"größe\"");
    let text = "{\"faircurve\": 1, \"spline\": \"größe\"}";
    assert_eq!(parse("json", text).unwrap_err().location.unwrap().column, 28);
    let text = "{\"faircurve\": 1,\n \"glyphs\": [{\"name\": \"größe\", \"contours\": 5}]}";
    assert_eq!(parse("json", text).unwrap_err().location.unwrap().column, 43);
}

#[test]
fn a_cut_off_document_is_an_error() {
    let whole = parse("json", DOCUMENT).unwrap();
    let end = DOCUMENT.trim_end().len();
    for cut in 0..DOCUMENT.len() {
        match parse("json", &DOCUMENT[..cut]) {
            Ok(document) => {
                assert!(cut >= end, "read after {cut} bytes");
                assert_eq!(document, whole);
            }
            Err(error) => assert!(error.location.is_some()),
        }
    }
}

#[test]
fn a_million_knots_are_read() {
    let knots = vec![r#"{"x": 0.125, "y": -3.5e2, "join": "g2"}"#; 1_000_000].join(",\n");
    let document = parse("json", with_knots(&knots)).unwrap();
    assert_eq!(document.glyphs[0].contours[0].contour.knots.len(), 1_000_000);
}

#[test]
fn what_json_cannot_hold_is_not_written() {
    let document = Document::unnamed([Contour::open([(0.0, f64::NAN)])]);
    let error = json::write(&document).unwrap_err();
    assert_snapshot!(error, @"JSON can't hold `y`: NaN");
}

#[test]
fn a_written_document_is_legible() {
    assert_snapshot!(json::write(&parse("json", DOCUMENT).unwrap()).unwrap(), @r#"
    {
      "faircurve": 1,
      "spline": "spiro",
      "glyphs": [
        {"name": "a", "layer": "Fore", "contours": [
          {"closed": true, "knots": [
            {"x": 0, "y": 0, "join": "g4"},
            {"x": 90, "y": 10, "join": "corner", "tangent_out": [1, 0]}
          ]}
        ]}
      ]
    }
    "#);
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        (-2000..2000i32).prop_map(f64::from),
        proptest::num::f64::NORMAL.prop_filter("a coordinate", |n| n.abs() <= 1e55),
        Just(-0.0),
        Just(5e-324),
    ]
}

fn direction() -> impl Strategy<Value = Vec2> {
    (number(), number()).prop_map(Vec2::from).prop_filter("a length", |&v| v != Vec2::ZERO)
}

fn knot() -> impl Strategy<Value = Knot> {
    (
        (number(), number()),
        option::of(proptest::sample::select(Join::ALL.to_vec())),
        prop_oneof![
            direction().prop_map(|both| (Some(both), Some(both))),
            (option::of(direction()), option::of(direction())),
        ],
        (
            option::of(number()),
            option::of(number()),
            option::of(number()),
            option::of(number()),
            option::of(number()),
        ),
    )
        .prop_map(|(point, join, (tangent_in, tangent_out), numbers)| Knot {
            point: point.into(),
            join,
            tangent_in,
            tangent_out,
            curvature_in: numbers.0,
            curvature_out: numbers.1,
            tension_in: numbers.2,
            tension_out: numbers.3,
            curl: numbers.4,
        })
}

/// Any spline of the catalogue, with any of its parameters set.
fn choice() -> impl Strategy<Value = SplineChoice> {
    (proptest::sample::select(catalog::ENTRIES), any::<(u8, f64)>()).prop_map(
        |(info, (which, between))| {
            let mut choice = SplineChoice::new(info.name);
            let part = (between.abs() % 1.0).max(0.0);
            for (index, spec) in info.params.iter().enumerate() {
                if which >> (index % 8) & 1 == 1 {
                    let value = match &spec.kind {
                        ParamKind::Number { min, max, .. } => (min + part * (max - min)).into(),
                        ParamKind::Choice { options } => {
                            ParamValue::Text(options[which as usize % options.len()].to_owned())
                        }
                        ParamKind::Text { default } => ParamValue::Text((*default).to_owned()),
                    };
                    choice.params.set(spec.name, value);
                }
            }
            choice
        },
    )
}

fn document() -> impl Strategy<Value = Document> {
    let contour = (proptest::collection::vec(knot(), 1..5), any::<bool>(), option::of(choice()))
        .prop_map(|(knots, closed, spline)| DocumentContour {
            contour: Contour { knots, closed },
            spline,
        });
    let glyph = (any::<String>(), any::<String>(), proptest::collection::vec(contour, 0..3))
        .prop_map(|(name, layer, contours)| Glyph { name, layer, contours });
    (choice(), proptest::collection::vec(glyph, 0..3))
        .prop_map(|(spline, glyphs)| Document { spline, glyphs })
}

proptest! {
    #[test]
    fn a_written_document_reads_back(document in document()) {
        let text = json::write(&document).unwrap();
        let back = parse("json", &text).unwrap();
        prop_assert_eq!(&back, &document);
        // Equality calls 0 and -0 the same; the text doesn't.
        prop_assert_eq!(json::write(&back).unwrap(), text);
    }

    #[test]
    fn any_damage_is_an_error_or_a_document(at in 0..DOCUMENT.len(), byte: u8, drop in 0..9usize) {
        let mut bytes = DOCUMENT.as_bytes().to_vec();
        bytes.splice(at..(at + drop).min(DOCUMENT.len()), [byte]);
        if let Err(error) = parse("json", &bytes) {
            let location = error.location.unwrap();
            prop_assert!(location.line >= 1 && location.column >= 1);
            prop_assert!(location.offset + location.length <= bytes.len());
        }
    }

    #[test]
    fn any_bytes_are_an_error_or_a_document(bytes: Vec<u8>) {
        let _ = parse("json", &bytes);
    }
}
