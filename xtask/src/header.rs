//! `cargo xtask header`: the C header that the functions of `faircurve-capi` have.

use std::fs;
use std::path::PathBuf;

use crate::{at, root};

fn package() -> PathBuf {
    root().join("crates/faircurve-capi")
}

fn file() -> PathBuf {
    package().join("include/faircurve.h")
}

/// What cbindgen makes of the source.
fn made() -> Result<String, String> {
    let config = cbindgen::Config::from_file(package().join("cbindgen.toml"))?;
    let source = package().join("src/lib.rs");
    let bindings = cbindgen::Builder::new()
        .with_config(config)
        .with_src(source)
        .generate()
        .map_err(|error| format!("cbindgen can't read the source: {error}"))?;
    let mut text = Vec::new();
    bindings.write(&mut text);
    String::from_utf8(text).map_err(|error| error.to_string())
}

/// Writes the header.
pub(crate) fn write() -> Result<(), String> {
    fs::write(file(), made()?).map_err(|error| at(&file(), &error))
}

/// Fails if the committed header isn't what the source says.
pub(crate) fn check() -> Result<(), String> {
    let committed = fs::read_to_string(file()).map_err(|error| at(&file(), &error))?;
    if committed == made()? {
        println!("faircurve.h is what the source says");
        return Ok(());
    }
    Err("include/faircurve.h isn't what crates/faircurve-capi/src/lib.rs says\n\
         hint: cargo xtask header"
        .into())
}
