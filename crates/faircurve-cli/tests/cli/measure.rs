//! `faircurve measure`: numbers for people and for programs.

use crate::folder::Folder;
use serde_json::Value;

/// Half a circle of radius 1 through three knots, and a square.
const DRAWING: &str = "0,0\n1,1\n2,0\n\n# closed\n0,0,corner\n3,0,corner\n3,3,corner\n0,3,corner\n";

#[test]
fn numbers_are_right_and_finite() {
    let folder = Folder::new().with("d.csv", DRAWING);
    let text = folder.run("measure d.csv --format json").solved();
    let file: Value = serde_json::from_str(&text).unwrap();
    let contours = &file["glyphs"][0]["contours"];
    let number = |value: &Value| value.as_f64().unwrap();
    let close = |value: &Value, expected: f64| {
        assert!((number(value) - expected).abs() < 1e-9, "{value} {expected}");
    };
    let pi = std::f64::consts::PI;
    let arc = &contours[0];
    close(&arc["length"], pi);
    close(&arc["bending_energy"], pi);
    close(&arc["scale_free_energy"], pi * pi);
    close(&arc["variation_energy"], 0.0);
    close(&arc["largest_curvature"], 1.0);
    close(&arc["turning"], pi);
    assert_eq!((&arc["extrema"], &arc["inflections"]), (&0.into(), &0.into()));
    assert!(arc["knots"][0]["jump"].is_null() && arc["knots"][2]["jump"].is_null());
    close(&arc["knots"][1]["jump"]["curvature"], 0.0);
    let square = &contours[1];
    close(&square["length"], 12.0);
    assert_eq!(square["knots"].as_array().unwrap().len(), 4);
    close(&square["knots"][0]["jump"]["direction"], pi / 2.0);
    close(&file["all"]["length"], 12.0 + pi);
    assert_eq!(file["glyphs"][0]["all"], file["all"]);
}

#[test]
fn text_is_to_be_read() {
    let folder = Folder::new().with("d.csv", "0,0\n1,1\n2,0\n");
    insta::assert_snapshot!(folder.run("measure d.csv --spline euler").solved(), @r"
    contour 0: euler, open, 3 knots, solved
      length                     3.14159   units
      bending energy             3.14159   ∫κ² ds, 1/units
        without units            9.86960   length · ∫κ² ds
      variation energy                 0   ∫κ′² ds, 1/units³
      largest curvature          1.00000   |κ|, 1/units
      largest variation                0   |κ′|, 1/units²
      turning                    3.14159   ∫|κ| ds, radians
      curvature extrema                0   between knots
      inflections                      0
      jumps, at knots      direction           κ          κ′          κ″
          1 g2                     0           0           0           0
    ");
    let all = Folder::new().with("d.csv", DRAWING).run("measure d.csv").solved();
    assert!(all.contains("\nin all: 2 contours\n"));
}

#[test]
fn the_output_and_the_spline_are_chosen_as_for_solve() {
    let folder = Folder::new().with("d.csv", DRAWING);
    folder.run("measure d.csv -o d.json --spline euler --param end=zero-curvature").solved();
    let file: Value =
        serde_json::from_slice(&std::fs::read(folder.path("d.json")).unwrap()).unwrap();
    assert_eq!(file["glyphs"][0]["contours"][0]["spline"], "euler");
    folder.run("measure d.csv -o d.txt").solved();
    assert_eq!(folder.files(), ["d.csv", "d.json", "d.txt"]);
    assert!(
        folder.run_with("measure - --from csv", "0,0\n1,1\n").solved().starts_with("contour 0")
    );
}

#[test]
fn what_is_relaxed_has_its_exit_code() {
    let impossible = r#"{"faircurve": 1, "contours": [{"knots": [{"x": 0, "y": 0, "tangent": [1, 1]},
        {"x": 10, "y": 0, "curvature_in": 1000, "curvature_out": 1000}, {"x": 10, "y": 30}]}]}"#;
    let folder = Folder::new().with("d.json", impossible);
    let run = folder.run("measure d.json");
    assert_eq!(run.code, 3);
    assert!(run.stdout.contains("relaxed") && run.stderr.starts_with("relaxed: "));
    assert_eq!(folder.run("measure d.json --allow-relaxed").code, 0);
}

#[test]
fn refusals() {
    let folder = Folder::new().with("d.csv", DRAWING);
    insta::assert_snapshot!(folder.run("measure d.csv --format xml").refused(), @r"
    error: there is no output format `xml`
    hint: use one of `text`, `json`
    ");
    insta::assert_snapshot!(folder.run("measure d.csv --spline eular").refused(), @r"
    error: there is no spline `eular`
    hint: did you mean `euler`?
    ");
    insta::assert_snapshot!(folder.run("measure missing.csv").refused(), @r"
    error: missing.csv: there is no such file
    hint: check the name, and the folder you are in
    ");
}
