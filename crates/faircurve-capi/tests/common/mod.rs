//! The libraries as `cargo xtask install-capi` installs them, and a C compiler to use them with.
#![allow(dead_code, unreachable_pub, reason = "not every test needs all of it")]

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

/// Where both libraries are installed, once for each test program.
pub fn prefix() -> &'static Path {
    static PREFIX: OnceLock<PathBuf> = OnceLock::new();
    PREFIX.get_or_init(|| {
        let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap();
        let prefix = target.join("tmp/capi");
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut install = Command::new(cargo);
        install
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .env("CARGO_TARGET_DIR", target)
            .args(["xtask", "install-capi", "--prefix"])
            .arg(&prefix);
        succeed(&mut install);
        prefix
    })
}

/// Runs a command that must succeed.
pub fn succeed(command: &mut Command) -> Output {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(
        output.status.success(),
        "{command:?}: {}\n{}\n{}",
        output.status,
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr),
    );
    output
}

/// What it prints.
pub fn output(command: &mut Command) -> String {
    String::from_utf8(succeed(command).stdout).unwrap()
}

/// Whether a program can be run at all; says so if it can't.
#[expect(clippy::print_stdout, reason = "tests say why they are skipped")]
pub fn has(program: &str) -> bool {
    let found = Command::new(program).arg("--version").output().is_ok();
    if !found {
        println!("skipped: there is no {program}");
    }
    found
}

/// Whether there is what C programs are made with.
pub fn has_compiler() -> bool {
    ["cc", "pkg-config", "nm", "objdump"].into_iter().all(has)
}

/// What pkg-config says about an installed library.
pub fn pkg_config(name: &str, arguments: &[&str]) -> Vec<String> {
    let mut command = Command::new("pkg-config");
    command
        .env("PKG_CONFIG_PATH", prefix().join("lib/pkgconfig"))
        .args(arguments)
        .args(name.split(' '));
    output(&mut command).split_whitespace().map(str::to_owned).collect()
}

/// How a program finds the library.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Linked {
    Shared,
    Static,
}

/// Compiles a C program against an installed library, or several, without warnings.
pub fn compile(source: &Path, library: &str, linked: Linked) -> PathBuf {
    let name = format!(
        "{}-{}-{}",
        library.replace(' ', "-"),
        source.file_stem().and_then(OsStr::to_str).unwrap(),
        if linked == Linked::Static { "static" } else { "shared" }
    );
    let program = prefix().join(name);
    let mut cc = Command::new("cc");
    cc.args(["-std=gnu11", "-O1", "-g", "-Wall", "-Wextra"])
        .args(["-Wno-unused-parameter", "-Werror", "-o"])
        .arg(&program)
        .arg(source)
        .args(pkg_config(library, &["--cflags"]));
    match linked {
        Linked::Shared => {
            let rpath = format!("-Wl,-rpath,{}", prefix().join("lib").display());
            cc.args(pkg_config(library, &["--libs"])).arg(rpath);
        }
        Linked::Static => {
            let flags = pkg_config(library, &["--static", "--libs"]);
            // The archive itself in place of `-lNAME`, which would take the shared library.
            let archive = |flag: String| match flag.strip_prefix("-l") {
                Some(name) if prefix().join(format!("lib/lib{name}.a")).exists() => {
                    prefix().join(format!("lib/lib{name}.a")).display().to_string()
                }
                _ => flag,
            };
            cc.args(flags.into_iter().map(archive));
        }
    }
    succeed(cc.arg("-lpthread").arg("-lm"));
    program
}

/// Runs a program under valgrind, if that is there: no errors, nothing left allocated that was lost.
pub fn valgrind(program: &Path, arguments: &[&str]) {
    if !has("valgrind") {
        return;
    }
    let mut valgrind = Command::new("valgrind");
    valgrind
        .args(["-q", "--error-exitcode=99", "--leak-check=full", "--show-leak-kinds=all"])
        .args(["--errors-for-leak-kinds=all"])
        .arg(program)
        .args(arguments);
    succeed(&mut valgrind);
}

/// Compiles a header alone as strict C and, where there is a compiler for it, as C++.
pub fn compile_header(header: &str, library: &str) {
    for (compiler, standard, extension) in [("cc", "-std=c99", "c"), ("c++", "-std=c++11", "cc")] {
        if !has(compiler) {
            continue;
        }
        let source = prefix().join(format!("{library}-header.{extension}"));
        let program = format!("#include <{header}>\nint main(void) {{ return 0; }}\n");
        std::fs::write(&source, program).unwrap();
        let mut check = Command::new(compiler);
        check.args([standard, "-pedantic", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"]);
        succeed(check.args(pkg_config(library, &["--cflags"])).arg(&source));
    }
}

/// The names that a shared library exports.
pub fn exported(library: &str) -> Vec<String> {
    let file = prefix().join("lib").join(library);
    let listed = output(Command::new("nm").args(["-D", "--defined-only"]).arg(file));
    let names = listed.lines().filter_map(|line| line.split_whitespace().last());
    let mut names: Vec<String> = names.map(str::to_owned).collect();
    names.sort();
    names
}

/// The name that programs linked to a shared library look for.
pub fn soname(library: &str) -> Option<String> {
    let file = prefix().join("lib").join(library);
    let listed = output(Command::new("objdump").arg("-p").arg(file));
    let line = listed.lines().find(|line| line.trim_start().starts_with("SONAME"))?;
    line.split_whitespace().last().map(str::to_owned)
}
