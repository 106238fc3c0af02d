//! What keeps the documentation current, and what installs the C libraries.
//!
//! ```sh
//! cargo xtask pictures            # draw docs/figures/NAME-space.svg and NAME-map.svg of every family
//! cargo xtask pictures --check    # fail if a committed one isn't what the code draws
//! cargo xtask pictures --png DIR  # the same as PNG, to look at
//! cargo xtask speeds              # measure the table in docs/speeds.md
//! cargo xtask header              # write crates/faircurve-capi/include/faircurve.h
//! cargo xtask header --check      # fail if the committed one isn't what cbindgen makes
//! cargo xtask install-capi --prefix P   # build libspiro.so.1 and libfaircurve.so.0, install them with all that belongs to them
//! cargo xtask npm                 # build the npm package into target/npm
//! cargo xtask npm --test          # and test it as npm packs it, in Node and in a browser
//! cargo xtask npm --bench         # and measure it: sizes, times beside others, a drag
//! cargo xtask editor              # build the npm package and the editor's site, and serve it
//! cargo xtask editor --test       # and test it in Node and in a browser instead
//! cargo xtask editor --build      # only build it, into target/editor
//! ```
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "this is a program")]

#[cfg(feature = "npm")]
mod copies;
mod editor;
mod family;
mod header;
mod install_capi;
#[cfg(feature = "npm")]
mod npm;
mod pictures;
mod speeds;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

const USAGE: &str = "\
there is no such command
hint: cargo xtask pictures [--check | --png DIR]
      cargo xtask speeds
      cargo xtask header [--check]
      cargo xtask install-capi --prefix DIR
      cargo xtask npm [--test | --bench]
      cargo xtask editor [--build | --test]";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["pictures"] => pictures::draw(),
        ["pictures", "--check"] => pictures::check(),
        ["pictures", "--png", folder] => pictures::draw_png(Path::new(folder)),
        ["speeds"] => speeds::write(),
        ["header"] => header::write(),
        ["header", "--check"] => header::check(),
        ["install-capi", "--prefix", prefix] => install_capi::install(Path::new(prefix)),
        ["npm", rest @ ..] => npm(rest),
        ["editor", rest @ ..] => editor::run(rest),
        _ => Err(USAGE.into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(feature = "npm")]
fn npm(arguments: &[&str]) -> Result<(), String> {
    let script = match arguments {
        [] => None,
        ["--test"] => Some("test"),
        ["--bench"] => Some("bench"),
        _ => return Err(USAGE.into()),
    };
    let package = npm::build()?;
    match script {
        Some(script) => npm::script(&package, script),
        None => Ok(()),
    }
}

/// Once more with what only this needs: wasm-bindgen takes a while to compile.
#[cfg(not(feature = "npm"))]
fn npm(arguments: &[&str]) -> Result<(), String> {
    let mut again = std::process::Command::new("cargo");
    again.args(["run", "--release", "-p", "xtask", "--features", "npm", "--", "npm"]);
    let status = again.args(arguments).current_dir(root()).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err("the npm package isn't built".into()),
        Err(error) => Err(format!("can't run cargo: {error}")),
    }
}

/// The repository's root.
fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_owned()
}

/// An input or output error with the file's name.
fn at(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}
