//! What keeps the documentation current.
//!
//! ```sh
//! cargo xtask pictures            # draw docs/figures/NAME-space.svg and NAME-map.svg of every family
//! cargo xtask pictures --check    # fail if a committed one isn't what the code draws
//! cargo xtask pictures --png DIR  # the same as PNG, to look at
//! cargo xtask speeds              # measure the table in docs/speeds.md
//! ```
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "this is a program")]

mod family;
mod pictures;
mod speeds;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["pictures"] => pictures::draw(),
        ["pictures", "--check"] => pictures::check(),
        ["pictures", "--png", folder] => pictures::draw_png(Path::new(folder)),
        ["speeds"] => speeds::write(),
        _ => Err("usage: cargo xtask pictures [--check | --png DIR], or cargo xtask speeds".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
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
