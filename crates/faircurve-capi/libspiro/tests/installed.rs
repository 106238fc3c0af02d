//! The drop-in as C programs meet it: installed, compiled against, linked, run.

#[path = "../../tests/common/mod.rs"]
mod common;

use std::path::{Path, PathBuf};
use std::process::Command;

use common::{
    Linked, compile, exported, has_compiler, output, pkg_config, prefix, soname, succeed, valgrind,
};

const SYMBOLS: [&str; 18] = [
    "LibSpiroVersion",
    "SpiroCPsToBezier",
    "SpiroCPsToBezier0",
    "SpiroCPsToBezier1",
    "SpiroCPsToBezier2",
    "TaggedSpiroCPsToBezier",
    "TaggedSpiroCPsToBezier0",
    "TaggedSpiroCPsToBezier1",
    "TaggedSpiroCPsToBezier2",
    "free_ls_bezctx",
    "free_spiro",
    "get_knot_th",
    "new_ls_bezctx",
    "run_spiro",
    "run_spiro0",
    "spiro_to_bpath",
    "spiro_to_bpath0",
    "spiroreverse",
];

fn source(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/c").join(name)
}

#[test]
fn the_library_exports_the_18_names_and_no_other() {
    if !has_compiler() {
        return;
    }
    assert_eq!(exported("libspiro.so.1"), SYMBOLS);
    assert_eq!(soname("libspiro.so.1").as_deref(), Some("libspiro.so.1"));
}

#[test]
fn everything_that_a_program_needs_is_installed() {
    if !has_compiler() {
        return;
    }
    for file in [
        "lib/libspiro.so.1",
        "lib/libspiro.so",
        "lib/libspiro.a",
        "lib/pkgconfig/libspiro.pc",
        "include/bezctx.h",
        "include/spiro.h",
        "include/spiroentrypoints.h",
        "share/man/man3/libspiro.3",
    ] {
        assert!(prefix().join(file).exists(), "{file}");
    }
    // FontForge asks for at least this.
    pkg_config("libspiro", &["--atleast-version=20190731"]);
}

#[test]
fn a_program_calls_everything_through_the_headers() {
    if !has_compiler() {
        return;
    }
    for linked in [Linked::Shared, Linked::Static] {
        let program = compile(&source("exercise.c"), "libspiro", linked);
        assert_eq!(output(&mut Command::new(&program)), "0 failures\n");
        valgrind(&program, &[]);
    }
}

#[test]
fn forty_threads_lose_nothing() {
    if !has_compiler() {
        return;
    }
    let program = compile(&source("threads.c"), "libspiro", Linked::Shared);
    succeed(Command::new(&program).args(["40", "100"]));
    valgrind(&program, &["40", "2"]);
}

#[test]
fn the_headers_are_strict_c_and_cxx() {
    if !has_compiler() {
        return;
    }
    common::compile_header("spiroentrypoints.h", "libspiro");
}

#[test]
fn the_program_of_the_manual_page_runs() {
    if !has_compiler() {
        return;
    }
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("man/libspiro.3");
    let page = std::fs::read_to_string(page).unwrap();
    let (_, example) = page.split_once(".EX\n").unwrap();
    let (example, _) = example.split_once(".EE").unwrap();
    let file = prefix().join("manual.c");
    std::fs::write(&file, example.replace("\\\\", "\\")).unwrap();
    let program = compile(&file, "libspiro", Linked::Shared);
    let drawn = output(&mut Command::new(program));
    assert!(drawn.starts_with("M 100 0\nC 100 "), "{drawn}");
    assert_eq!(drawn.lines().count(), 5);
}
