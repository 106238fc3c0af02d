//! `faircurve list`: every catalogue entry, for people and for programs.

use crate::folder::Folder;
use faircurve::catalog::ENTRIES;
use serde_json::Value;

#[test]
fn text_names_every_spline_join_end_parameter_and_claim() {
    let text = Folder::new().run("list").solved();
    let blocks: Vec<&str> = text.split("\n\n").collect();
    assert_eq!(blocks.len(), ENTRIES.len());
    for (block, info) in blocks.iter().zip(ENTRIES) {
        assert!(block.starts_with(&format!("{}: {}\n", info.name, info.summary)));
        assert!(block.contains(&format!("{} (default)", info.default_join)));
        assert!(info.joins.iter().all(|join| block.contains(join.name())));
        assert!(info.ends.iter().all(|end| block.contains(end)));
        assert!(info.params.iter().all(|param| block.contains(param.name)));
        assert!(info.claims.iter().all(|claim| block.contains(&claim.to_string())));
    }
}

#[test]
fn json_has_the_same() {
    let file: Value =
        serde_json::from_str(&Folder::new().run("list --format json").solved()).unwrap();
    assert_eq!(file["faircurve"], 1);
    let splines = file["splines"].as_array().unwrap();
    assert_eq!(splines.len(), ENTRIES.len());
    for (entry, info) in splines.iter().zip(ENTRIES) {
        assert_eq!(entry["name"], info.name);
        assert_eq!(entry["default_join"], info.default_join.name());
        assert_eq!(entry["params"].as_array().unwrap().len(), info.params.len());
        assert_eq!(entry["claims"].as_array().unwrap().len(), info.claims.len());
    }
    let euler = splines.iter().find(|entry| entry["name"] == "euler").unwrap();
    assert_eq!(euler["params"][0]["kind"], "choice");
    assert_eq!(euler["params"][0]["default"], "arc");
}

#[test]
fn laws_are_measured_for_every_spline() {
    let folder = Folder::new();
    let run = folder.run("list --laws --format json").solved();
    let file: Value = serde_json::from_str(&run).unwrap();
    let splines = file["splines"].as_array().unwrap();
    assert_eq!(splines.len(), ENTRIES.len());
    for (entry, info) in splines.iter().zip(ENTRIES) {
        assert_eq!(entry["name"], info.name);
        let claims = entry["claims"].as_array().unwrap();
        assert_eq!(claims.len(), info.claims.len());
        for (claim, given) in claims.iter().zip(info.claims) {
            assert_eq!(claim["claim"], given.to_string());
            let verdict = claim["verdict"].as_str().unwrap();
            assert!(["holds", "contradicted", "unknown"].contains(&verdict));
            assert_eq!(claim["number"].is_null(), verdict == "unknown");
        }
    }
    let text = folder.run("list --laws").solved();
    let head =
        "  spline   tangents   continuity   extensionality   roundness   robustness   locality";
    let words = |line: &str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    assert!(text.lines().any(|line| words(line) == words(head)), "{text}");
    let euler = text.lines().find(|line| line.trim_start().starts_with("euler")).unwrap();
    assert_eq!(words(euler), ["euler", "G2", "G2", "+++", "+++", "++", "+"]);
}
