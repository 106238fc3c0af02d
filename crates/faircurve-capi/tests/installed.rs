//! faircurve.h as C programs meet it: installed, compiled against, linked, run.

mod common;

use std::path::{Path, PathBuf};
use std::process::Command;

use common::{
    Linked, compile, exported, has_compiler, output, pkg_config, prefix, soname, valgrind,
};

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// The names of functions in the header.
fn declared() -> Vec<String> {
    let header = std::fs::read_to_string(file("include/faircurve.h")).unwrap();
    let code = header.lines().filter(|line| !line.starts_with("//"));
    let mut names: Vec<String> = code
        .filter_map(|line| line.split_once('('))
        .filter_map(|(before, _)| before.split([' ', '*']).next_back())
        .filter(|name| name.starts_with("fc_"))
        .map(str::to_owned)
        .collect();
    names.sort();
    names
}

#[test]
fn the_library_exports_what_the_header_declares_and_nothing_else() {
    if !has_compiler() {
        return;
    }
    let names = declared();
    assert!(names.len() > 20 && names.contains(&"fc_solve".to_owned()), "{names:?}");
    assert_eq!(exported("libfaircurve.so.0"), names);
    assert_eq!(soname("libfaircurve.so.0").as_deref(), Some("libfaircurve.so.0"));
}

#[test]
fn everything_that_a_program_needs_is_installed() {
    if !has_compiler() {
        return;
    }
    for file in [
        "lib/libfaircurve.so.0",
        "lib/libfaircurve.so",
        "lib/libfaircurve.a",
        "lib/pkgconfig/faircurve.pc",
        "include/faircurve.h",
        "share/man/man3/faircurve.3",
    ] {
        assert!(prefix().join(file).exists(), "{file}");
    }
    assert_eq!(pkg_config("faircurve", &["--modversion"]), [env!("CARGO_PKG_VERSION")]);
}

#[test]
fn a_program_calls_everything_through_the_header() {
    if !has_compiler() {
        return;
    }
    let hard = file("../../examples/hard.json").display().to_string();
    for linked in [Linked::Shared, Linked::Static] {
        let program = compile(&file("tests/c/exercise.c"), "faircurve", linked);
        assert_eq!(output(Command::new(&program).arg(&hard)), "0 failures\n");
        valgrind(&program, &[&hard]);
    }
}

/// Writes a program out of a text, compiles it and runs it under valgrind.
fn program_of(text: &str, name: &str) -> String {
    let source = prefix().join(name);
    std::fs::write(&source, text).unwrap();
    let program = compile(&source, "faircurve", Linked::Shared);
    valgrind(&program, &[]);
    output(&mut Command::new(program))
}

#[test]
fn the_program_of_the_manual_prints_what_the_manual_says() {
    if !has_compiler() {
        return;
    }
    let manual = std::fs::read_to_string(file("../../docs/c-api.md")).unwrap();
    let (_, rest) = manual.split_once("```c\n").unwrap();
    let (program, rest) = rest.split_once("```\n").unwrap();
    let (_, printed) = rest.split_once("```text\n").unwrap();
    let (printed, _) = printed.split_once("```\n").unwrap();
    assert_eq!(program_of(program, "manual.c"), printed);
}

#[test]
fn the_program_of_the_manual_page_runs() {
    if !has_compiler() {
        return;
    }
    let page = std::fs::read_to_string(file("man/faircurve.3")).unwrap();
    let (_, example) = page.split_once(".EX\n").unwrap();
    let (example, _) = example.split_once(".EE").unwrap();
    let printed = program_of(&example.replace("\\\\", "\\"), "page.c");
    assert!(printed.ends_with(" units long\n"), "{printed}");
}

#[test]
fn the_header_is_strict_c_and_cxx() {
    if !has_compiler() {
        return;
    }
    common::compile_header("faircurve.h", "faircurve");
}

/// Both libraries in one program, as a font editor would have them: neither gets in the other's way.
#[test]
fn both_libraries_live_in_one_program() {
    if !has_compiler() {
        return;
    }
    let text = "#include <faircurve.h>\n#include <spiroentrypoints.h>\n#include <stdio.h>\n\
        int main(void) { printf(\"%s, %s\\n\", fc_version(), LibSpiroVersion()); return 0; }\n";
    let source = prefix().join("both.c");
    std::fs::write(&source, text).unwrap();
    let version = env!("CARGO_PKG_VERSION");
    for linked in [Linked::Shared, Linked::Static] {
        let program = compile(&source, "faircurve libspiro", linked);
        let printed = output(&mut Command::new(program));
        assert_eq!(printed, format!("{version}, 1.5 (faircurve {version})\n"));
    }
}
