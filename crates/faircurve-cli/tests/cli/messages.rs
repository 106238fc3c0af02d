//! What the program says when something is wrong: what, where, and what to do.

use crate::folder::Folder;

const DRAWING: &str = "0,0\n90,10\n50,80\n";

/// What `faircurve …` prints when it refuses, in a folder with a few files.
#[track_caller]
fn refusal(line: &str) -> String {
    let folder = Folder::new()
        .with("drawing.csv", DRAWING)
        .with("empty.json", "")
        .with("drawing.txt", DRAWING)
        .with("font.json", r#"{"faircurve": 1, "glyphs": [
  {"name": "alpha", "layer": "Fore", "contours": [{"knots": [{"x": 0, "y": 0}, {"x": 9, "y": 1}]}]},
  {"name": "beta", "layer": "Back", "contours": [{"knots": [{"x": 0, "y": 0}, {"x": 9, "y": 1}]}]}]}"#);
    std::fs::create_dir(folder.path("folder.json")).unwrap();
    folder.run(line).refused()
}

#[test]
fn usage() {
    insta::assert_snapshot!(refusal(""), @r"
    error: there is no command
    hint: try `faircurve solve drawing.json -o drawing.svg`, or `faircurve --help`
    ");
    insta::assert_snapshot!(refusal("solve"), @r"
    error: the following required arguments were not provided:
      <IN>...
    hint: see `faircurve --help` and `faircurve solve --help`
    ");
    insta::assert_snapshot!(refusal("sovle drawing.csv"), @r"
    error: unrecognized subcommand `sovle`
    hint: did you mean `solve`?
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --splin euler"), @r"
    error: unexpected argument `--splin` found
    hint: did you mean `--spline`?
    ");
}

#[test]
fn files() {
    insta::assert_snapshot!(refusal("solve missing.json"), @r"
    error: missing.json: there is no such file
    hint: check the name, and the folder you are in
    ");
    insta::assert_snapshot!(refusal("solve missing"), @r"
    error: missing: there is no such file
    hint: check the name, and the folder you are in
    ");
    insta::assert_snapshot!(refusal("solve folder.json"), @r"
    error: folder.json: this is a folder, not a file
    hint: name the file in it
    ");
    insta::assert_snapshot!(refusal("solve empty.json"), @r"
    error: empty.json: the file is empty
    hint: a json file holds contours with their knots
    ");
    insta::assert_snapshot!(refusal("solve drawing.txt"), @r"
    error: drawing.txt: no input format has the extension `txt`
    hint: use one of `json`, `csv`, `sfd`, `glyph`, or name the format with --from
    ");
    insta::assert_snapshot!(refusal("solve - -"), @r"
    error: stdin (`-`) can be read only once
    ");
    insta::assert_snapshot!(refusal("solve -"), @r"
    error: stdin: the file is empty
    hint: a json file holds contours with their knots
    ");
}

#[test]
fn names() {
    insta::assert_snapshot!(refusal("solve drawing.csv --spline spirro"), @r"
    error: there is no spline `spirro`
    hint: did you mean `spiro`?
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --param foo=1"), @r"
    error: spline `spiro` has no parameter `foo`
    hint: `spiro` takes no parameters; leave it out
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --spline euler --param end=ark"), @r"
    error: parameter `end` of spline `euler` can't be `ark`
    hint: it takes one of `arc`, `zero-curvature`
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --param foo"), @r"
    error: --param can't be `foo`
    hint: write it as NAME=VALUE
    ");
    insta::assert_snapshot!(refusal("solve font.json --glyph alfa"), @r"
    error: there is no glyph `alfa`
    hint: did you mean `alpha`?
    ");
    insta::assert_snapshot!(refusal("solve font.json --layer fore"), @r"
    error: there is no layer `fore`
    hint: did you mean `Fore`?
    ");
    insta::assert_snapshot!(refusal("solve font.json --glyph alpha --layer Back"), @r"
    error: there is no contour of glyph `alpha` in layer `Back`
    hint: use `Fore`
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --glyph alpha"), @r"
    error: there is no glyph `alpha`
    hint: nothing here has such a name: drop --glyph
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --from jason"), @r"
    error: there is no input format `jason`
    hint: did you mean `json`?
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --format svgz"), @r"
    error: there is no output format `svgz`
    hint: did you mean `svg`?
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --format svg --show combs"), @r"
    error: --show has no `combs`
    hint: did you mean `comb`?
    ");
    insta::assert_snapshot!(refusal("list --format yaml"), @r"
    error: lists have no format `yaml`
    hint: use one of `text`, `json`
    ");
}

#[test]
fn options_that_make_no_sense() {
    insta::assert_snapshot!(refusal("solve drawing.csv --effort lots"), @r"
    error: --effort can't be `lots`
    hint: it takes a number from 0
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --accuracy -1"), @r"
    error: --accuracy can't be `-1`
    hint: it takes a number of units above 0
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --samples 0"), @r"
    error: --samples can't be `0`
    hint: it takes a whole number from 1 to 100000
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --samples 3 --format svg"), @r"
    error: --samples has no use for svg
    hint: write --format json, or drop --samples
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --show knots"), @r"
    error: --show has no use for json
    hint: write a picture (--format svg or png), or drop --show
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv --format png --width 99999"), @r"
    error: --width can't be `99999`
    hint: it takes a whole number from 1 to 16384
    ");
}

#[test]
fn targets() {
    insta::assert_snapshot!(refusal("solve drawing.csv -o picture"), @r"
    error: picture: the name doesn't tell the format to write
    hint: end it in .json, .svg, .png or .path, or add --format
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv -o folder.json"), @r"
    error: folder.json: this is a folder, not a file
    hint: name a file in it
    ");
    insta::assert_snapshot!(refusal("solve drawing.csv -o missing/a.svg"), @r"
    error: missing/a.svg: there is no such folder to write to
    hint: make it first, or check the name
    ");
    insta::assert_snapshot!(refusal("solve font.json -o font.json"), @r"
    error: font.json: the result would overwrite its own input
    hint: write to another file
    ");
}

#[test]
fn places_in_files() {
    let folder = Folder::new()
        .with("bad.csv", "# a comment\n0,0\n10,1o,g2\n")
        .with("bad.json", "{\"faircurve\": 1, \"contours\": [{\"knots\": [{\"x\": 0, \"y\": 0, \"jion\": \"g2\"}]}]}")
        .with("control.csv", b"0,0\n1\x1b[31m,\xff\n");
    insta::assert_snapshot!(folder.run("solve bad.csv").refused(), @r"
    error: bad.csv:3:4: contour 0, knot 1: `1o` is not a number
       |
     3 | 10,1o,g2
       |    ^^
    ");
    insta::assert_snapshot!(folder.run("solve bad.json").refused(), @r#"
    error: bad.json:1:59: contour 0, knot 0: there is no key `jion` here
       |
     1 | …contours": [{"knots": [{"x": 0, "y": 0, "jion": "g2"}]}]}
       |                                          ^^^^^^
    hint: did you mean `join`?
    "#);
    insta::assert_snapshot!(folder.run("solve control.csv").refused(), @r"
    error: control.csv:2:8: the byte 0xff is not UTF-8 text
       |
     2 | 1 [31m,�
       |        ^
    hint: save the file as UTF-8
    ");
    let long = format!("{}{}", "0,0\n", " ".repeat(500) + "1,x" + &" ".repeat(500));
    let folder = folder.with("long.csv", long);
    insta::assert_snapshot!(folder.run("solve long.csv").refused(), @r"
    error: long.csv:2:503: contour 0, knot 1: `x` is not a number
       |
     2 | …                                      1,x                                   …
       |                                          ^
    ");
}

#[test]
fn what_no_file_format_notices_has_a_place_too() {
    let folder = Folder::new().with(
        "a.json",
        r#"{"faircurve": 1, "glyphs": [{"name": "a", "layer": "Fore", "contours": [
            {"knots": [{"x": 0, "y": 0}, {"x": 1, "y": 1, "join": "g2", "tangent_in": [1, 0],
             "tangent_out": [0, 1]}, {"x": 2, "y": 0}]}]}]}"#,
    );
    insta::assert_snapshot!(folder.run("solve a.json").refused(), @r"
    error: a.json: glyph `a`, layer `Fore`, contour 0: knot 1 joins g2, yet its tangent_in and tangent_out differ
    hint: make the join `corner`, or give one direction
    ");
}

#[test]
fn colour_is_for_terminals_that_want_it() {
    let folder = Folder::new();
    assert!(!folder.run("solve missing.json").stderr.contains('\x1b'));
    let run = |name: &str, value: &str| {
        let mut command = assert_cmd::Command::cargo_bin("faircurve").unwrap();
        let output = command.env(name, value).args(["solve", "missing.json"]).output().unwrap();
        String::from_utf8(output.stderr).unwrap()
    };
    assert!(run("CLICOLOR_FORCE", "1").contains("\x1b["));
    assert!(!run("NO_COLOR", "1").contains('\x1b'));
}
