//! The cases that every way into faircurve must agree on, through a C program: `conformance/README.md`.

#[path = "../../../conformance/agreement.rs"]
#[allow(unreachable_pub, reason = "shared by tests")]
mod agreement;
mod common;

use std::path::Path;
use std::process::Command;

use agreement::{cases, disagreement};
use common::{Linked, compile, has_compiler, output, prefix};
use serde_json::Value;

#[test]
fn c_gives_the_numbers_of_every_case() {
    if !has_compiler() {
        return;
    }
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/c/solve.c");
    let program = compile(&source, "faircurve", Linked::Shared);
    let cases = cases();
    assert!(cases.len() >= 20);
    for path in cases {
        let case: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let document = prefix().join("case.json");
        std::fs::write(&document, case["document"].to_string()).unwrap();
        let samples = case["samples"].to_string();
        let solution = output(Command::new(&program).arg(&document).arg(samples));
        let solution: Value = serde_json::from_str(&solution).unwrap();
        assert_eq!(disagreement(&solution, &case["solution"]), None, "{}", path.display());
    }
}
