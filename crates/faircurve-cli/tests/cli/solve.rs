//! `faircurve solve`: exit codes, formats, choices, and files whole or not at all.

use crate::folder::Folder;
use serde_json::Value;

const DRAWING: &str = r#"{"faircurve": 1, "contours": [{"closed": true, "knots": [
  {"x": 0, "y": 0, "join": "corner"}, {"x": 90, "y": 10}, {"x": 50, "y": 80}]}]}"#;

/// Glyph `a` in two layers, glyph `b` in one; the contours of `b` name a spline of their own.
const FONT: &str = r#"{"faircurve": 1, "glyphs": [
  {"name": "a", "layer": "Fore", "contours": [{"closed": true, "knots": [
    {"x": 0, "y": 0}, {"x": 90, "y": 10}, {"x": 50, "y": 80}]}]},
  {"name": "a", "layer": "Back", "contours": [{"knots": [{"x": 0, "y": 0}, {"x": 90, "y": 10}]}]},
  {"name": "b", "layer": "Fore", "contours": [{"spline": "euler", "knots": [
    {"x": 0, "y": 0}, {"x": 90, "y": 10}, {"x": 50, "y": 80, "join": "g4"}, {"x": 9, "y": 80}]}]}]}"#;

/// Plain iteration doesn't settle on these.
const HARD: &str = "# closed\n79,32\n94,45\n88,94\n83,67\n3,59\n99,31\n";

/// No curve has this curvature, so sharp a bend and chords so long.
const IMPOSSIBLE: &str = r#"{"faircurve": 1, "glyphs": [{"name": "a", "layer": "Fore", "contours": [
  {"closed": true, "knots": [{"x": 0, "y": 0}, {"x": 9, "y": 1}, {"x": 5, "y": 8}]},
  {"knots": [{"x": 0, "y": 0, "tangent": [1, 1]}, {"x": 10, "y": 0, "curvature_in": 1000,
    "curvature_out": 1000}, {"x": 10, "y": 30}]}]}]}"#;

fn glyph_names(solution: &str) -> Vec<(String, String)> {
    let file: Value = serde_json::from_str(solution).unwrap();
    let text = |value: &Value| value.as_str().unwrap().to_owned();
    let glyphs = file["glyphs"].as_array().unwrap();
    glyphs.iter().map(|glyph| (text(&glyph["name"]), text(&glyph["layer"]))).collect()
}

fn splines(solution: &str) -> Vec<String> {
    let file: Value = serde_json::from_str(solution).unwrap();
    let glyphs = file["glyphs"].as_array().unwrap();
    let contours = glyphs.iter().flat_map(|glyph| glyph["contours"].as_array().unwrap());
    contours.map(|contour| contour["spline"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn json_on_stdout_is_the_default() {
    let folder = Folder::new().with("drawing.json", DRAWING);
    let file: Value = serde_json::from_str(&folder.run("solve drawing.json").solved()).unwrap();
    let contour = &file["glyphs"][0]["contours"][0];
    assert_eq!(contour["status"], "solved");
    assert_eq!(contour["spline"], "spiro");
    assert_eq!(contour["segments"].as_array().unwrap().len(), 3);
}

#[test]
fn stdin_is_json_or_what_from_says() {
    let folder = Folder::new();
    let from_json = folder.run_with("solve - --format path", DRAWING).solved();
    assert!(from_json.starts_with("M0,0 C"));
    let rows = "# closed\n0,0,corner\n90,10\n50,80\n";
    assert_eq!(folder.run_with("solve --from csv --format path -", rows).solved(), from_json);
}

#[test]
fn the_extension_tells_the_format() {
    let folder = Folder::new().with("drawing.json", DRAWING);
    for (name, start) in [
        ("a.svg", &b"<svg "[..]),
        ("a.PNG", b"\x89PNG\r\n"),
        ("a.path", b"M0,0 C"),
        ("a.out.json", b"{\n \"faircurve\": 1"),
    ] {
        folder.run(&format!("solve drawing.json -o {name}")).solved();
        assert!(std::fs::read(folder.path(name)).unwrap().starts_with(start), "{name}");
    }
    folder.run("solve drawing.json -o odd.txt --format svg --show knots,comb").solved();
    let svg = std::fs::read_to_string(folder.path("odd.txt")).unwrap();
    assert!(svg.contains("class=\"comb-teeth\"") && svg.contains("class=\"knots-solid\""));
}

#[test]
fn several_files_make_one_result() {
    let folder = Folder::new().with("one.json", FONT).with("two.csv", "0,0\n1,1\n");
    let names = glyph_names(&folder.run("solve one.json two.csv").stdout);
    assert_eq!(names.len(), 4);
    assert_eq!(names[3], (String::new(), String::new()));
}

#[test]
fn glyphs_and_layers_are_picked() {
    let folder = Folder::new().with("font.json", FONT);
    let names = |options: &str| {
        let run = folder.run(&format!("solve font.json {options}"));
        let names = glyph_names(&run.stdout);
        names.into_iter().map(|(name, layer)| name + "/" + &layer).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(names(""), "a/Fore a/Back b/Fore");
    assert_eq!(names("--glyph a"), "a/Fore a/Back");
    assert_eq!(names("--layer Fore"), "a/Fore b/Fore");
    assert_eq!(names("--glyph a --glyph b --layer Fore"), "a/Fore b/Fore");
    assert_eq!(names("--glyph a --layer Back"), "a/Back");
    assert_eq!(names("--glyph b --glyph a"), "b/Fore a/Fore a/Back");
}

#[test]
fn the_command_lines_spline_overrides_the_documents() {
    let folder = Folder::new().with("font.json", FONT);
    let used = |options: &str| splines(&folder.run(&format!("solve font.json {options}")).stdout);
    assert_eq!(used(""), ["spiro", "spiro", "euler"]);
    assert_eq!(used("--spline spiro"), ["spiro", "spiro", "spiro"]);
    assert_eq!(used("--spline euler"), ["euler", "euler", "euler"]);
}

#[test]
fn parameters_reach_the_spline() {
    let folder = Folder::new().with("arc.csv", "0,0\n10,5\n30,0\n");
    let default = folder.run("solve arc.csv --spline euler").solved();
    assert_eq!(folder.run("solve arc.csv --spline euler --param end=arc").solved(), default);
    let other = folder.run("solve arc.csv --spline euler --param end=zero-curvature").solved();
    assert_ne!(other, default);
}

#[test]
fn accuracy_and_samples_are_as_asked() {
    let folder = Folder::new().with("drawing.json", DRAWING);
    let cubics = |options: &str| {
        folder
            .run(&format!("solve drawing.json --format path {options}"))
            .solved()
            .matches('C')
            .count()
    };
    assert!(cubics("--accuracy 1e-6") > cubics("--accuracy 1"));
    let text = folder.run("solve drawing.json --samples 4").solved();
    let file: Value = serde_json::from_str(&text).unwrap();
    for segment in file["glyphs"][0]["contours"][0]["segments"].as_array().unwrap() {
        assert_eq!(segment["samples"].as_array().unwrap().len(), 5);
    }
}

#[test]
fn what_a_spline_lacks_is_noted_and_no_error() {
    let folder = Folder::new().with("font.json", FONT);
    let run = folder.run("solve font.json --glyph b");
    assert_eq!(run.code, 0);
    insta::assert_snapshot!(run.stderr, @r"
    note: spline `euler` has no g4: g2 instead, in 1 place
    ");
}

#[test]
fn relaxed_is_written_named_and_exits_with_3() {
    let folder = Folder::new().with("hard.json", IMPOSSIBLE);
    let run = folder.run("solve hard.json -o hard.svg");
    assert_eq!(run.code, 3);
    let (relaxed, hint) = run.stderr.split_once('\n').unwrap();
    // The reason is the solver's to word.
    let place = "relaxed: hard.json: glyph `a`, layer `Fore`, contour 1, knot 1: asked curvature, got free: ";
    assert!(relaxed.starts_with(place) && relaxed.len() > place.len(), "{relaxed}");
    insta::assert_snapshot!(hint, @r"
    hint: 1 of 2 contours could not be solved as asked: move knots or ask for less there, or accept the nearest curve with --allow-relaxed
    ");
    assert!(std::fs::read_to_string(folder.path("hard.svg")).unwrap().contains("relaxed"));
    let allowed = folder.run("solve hard.json -o hard.svg --allow-relaxed");
    assert_eq!(allowed.code, 0);
    assert_eq!(allowed.stderr.lines().next(), run.stderr.lines().next());
    let text = folder.run("solve hard.json").stdout;
    let file: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(file["glyphs"][0]["contours"][1]["status"], "relaxed");
}

#[test]
fn effort_decides_how_far_to_search() {
    let folder = Folder::new().with("hard.csv", HARD);
    assert_eq!(folder.run("solve hard.csv --format path").code, 0);
    assert_eq!(folder.run("solve hard.csv --format path --effort 0").code, 3);
}

#[test]
fn loops_are_relaxed_away_when_asked() {
    let line = r#"{"faircurve": 1, "spline": "spiro", "glyphs": [{"name": "line", "contours": [{"closed": true, "knots": [
        {"x": 0, "y": 0, "join": "g4"}, {"x": -36, "y": 76, "join": "g4"},
        {"x": -51, "y": 215, "join": "g4"}, {"x": -37, "y": 336, "join": "g4"}]}]}]}"#;
    let folder = Folder::new().with("line.json", line);
    assert_eq!(folder.run("solve line.json --format path").code, 0);
    let run = folder.run("solve line.json --format path --no-loops");
    assert_eq!(run.code, 3);
    assert!(run.stderr.contains("loops between two knots"), "{}", run.stderr);
}

#[test]
fn bad_input_leaves_an_older_file_as_it_was() {
    let folder = Folder::new().with("bad.csv", "0,0\n10,1o\n").with("out.svg", "precious");
    folder.run("solve bad.csv -o out.svg").refused();
    assert_eq!(std::fs::read(folder.path("out.svg")).unwrap(), b"precious");
    assert_eq!(folder.files(), ["bad.csv", "out.svg"]);
}

#[test]
fn a_good_file_replaces_an_older_one_and_leaves_nothing_beside_it() {
    let folder = Folder::new().with("drawing.json", DRAWING).with("out.svg", "old");
    folder.run("solve drawing.json -o out.svg").solved();
    assert!(std::fs::read(folder.path("out.svg")).unwrap().starts_with(b"<svg"));
    assert_eq!(folder.files(), ["drawing.json", "out.svg"]);
}

#[cfg(unix)]
#[test]
fn what_cannot_be_written_is_refused_whole() {
    let folder = Folder::new().with("drawing.json", DRAWING);
    std::fs::create_dir(folder.path("there")).unwrap();
    for target in ["there", "missing/out.svg", "drawing.json", "out.gif", "out"] {
        folder.run(&format!("solve drawing.json -o {target}")).refused();
    }
    assert_eq!(folder.files(), ["drawing.json", "there"]);
    assert_eq!(std::fs::read_to_string(folder.path("drawing.json")).unwrap(), DRAWING);
}

#[cfg(unix)]
#[test]
fn files_are_as_readable_as_any_and_links_stay_links() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = Folder::new().with("drawing.json", DRAWING).with("plain", "");
    symlink("real.svg", folder.path("link.svg")).unwrap();
    std::fs::write(folder.path("real.svg"), "old").unwrap();
    folder.run("solve drawing.json -o link.svg").solved();
    assert!(folder.path("link.svg").symlink_metadata().unwrap().is_symlink());
    assert!(std::fs::read(folder.path("real.svg")).unwrap().starts_with(b"<svg"));
    folder.run("solve drawing.json -o new.svg").solved();
    let mode = |name: &str| folder.path(name).metadata().unwrap().permissions().mode();
    assert_eq!(mode("new.svg"), mode("plain"));
}

#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_is_no_failure() {
    use std::process::{Command, Stdio};
    let folder = Folder::new().with("drawing.json", DRAWING);
    let mut child = Command::new(assert_cmd::cargo::cargo_bin("faircurve"))
        .current_dir(folder.path("."))
        .args(["solve", "drawing.json", "--samples", "20000"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}

#[test]
#[expect(clippy::print_stdout, reason = "tests say why they are skipped")]
fn a_real_font_is_solved_whole() {
    let font =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data/Cantarell-Regular-Spiro.sfd");
    if !std::path::Path::new(font).exists() {
        println!("skipped: ../shared/data/Cantarell-Regular-Spiro.sfd is not there");
        return;
    }
    let folder = Folder::new();
    let run = folder.run(&format!("solve {font} -o font.json"));
    assert_eq!(run.code, 0, "{}", run.stderr);
    let text = std::fs::read_to_string(folder.path("font.json")).unwrap();
    assert_eq!(splines(&text).len(), 180);
}
