//! `faircurve compare`: several splines on one sheet.

use crate::folder::Folder;

const DRAWING: &str = "0,0\n80,60\n150,0\n260,30\n";

#[test]
fn one_sheet_has_a_panel_for_each_spline() {
    let folder = Folder::new().with("d.csv", DRAWING);
    folder.run("compare d.csv --splines spiro,euler:end=zero-curvature -o sheet.svg").solved();
    let svg = std::fs::read_to_string(folder.path("sheet.svg")).unwrap();
    for name in ["spiro", "euler:end=zero-curvature"] {
        assert!(svg.contains(&format!("data-name=\"{name}\"")), "{name}");
    }
    for class in ["comb-teeth", "knots-solid", "title", "names", "values"] {
        assert!(svg.matches(&format!("class=\"{class}\"")).count() >= 2, "{class}");
    }
    assert!(!svg.contains("warning"));
}

#[test]
fn every_spline_is_compared_by_default_and_png_is_written() {
    let folder = Folder::new().with("d.csv", DRAWING);
    let run = folder.run("compare d.csv --allow-relaxed");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let panels = run.stdout.matches("class=\"title\"").count();
    assert_eq!(panels, faircurve::catalog::ENTRIES.len());
    let png = "compare d.csv --splines euler -o sheet.png --width 400";
    folder.run(png).solved();
    let bytes = std::fs::read(folder.path("sheet.png")).unwrap();
    assert!(bytes.starts_with(b"\x89PNG\r\n"));
}

#[test]
fn what_is_relaxed_is_named_with_its_spline() {
    let impossible = r#"{"faircurve": 1, "contours": [{"knots": [{"x": 0, "y": 0, "tangent": [1, 1]},
        {"x": 10, "y": 0, "curvature_in": 1000, "curvature_out": 1000}, {"x": 10, "y": 30}]}]}"#;
    let run = Folder::new().with("d.json", impossible).run("compare d.json --splines spiro");
    assert_eq!(run.code, 3);
    assert!(
        run.stderr.starts_with("relaxed: spiro: d.json: contour 0, knot 1: "),
        "{}",
        run.stderr
    );
    assert!(run.stdout.contains("class=\"warning\""));
}

#[test]
fn refusals() {
    let folder = Folder::new().with("d.csv", DRAWING);
    let refusal = |options: &str| folder.run(&format!("compare d.csv {options}")).refused();
    insta::assert_snapshot!(refusal("--splines euler,spirro"), @r"
    error: there is no spline `spirro`
    hint: did you mean `spiro`?
    ");
    insta::assert_snapshot!(refusal("--splines euler:end"), @r"
    error: --splines can't have `euler:end`
    hint: write parameters as NAME:KEY=VALUE
    ");
    insta::assert_snapshot!(refusal("--splines euler:end=ark"), @r"
    error: parameter `end` of spline `euler` can't be `ark`
    hint: it takes one of `arc`, `zero-curvature`
    ");
    insta::assert_snapshot!(refusal("--splines ,"), @r"
    error: --splines names none
    hint: `faircurve list` has the names
    ");
    insta::assert_snapshot!(refusal("-o sheet.pdf"), @r"
    error: sheet.pdf: the name doesn't tell the format to write
    hint: end it in .svg or .png, or add --format
    ");
    insta::assert_snapshot!(refusal("--width 300"), @r"
    error: --width has no use for svg
    hint: write --format png, or drop --width
    ");
}
