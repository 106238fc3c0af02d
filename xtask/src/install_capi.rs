//! `cargo xtask install-capi`: the C libraries with headers, pkg-config files and manual pages, as C
//! programs expect them below a prefix.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::{at, root};

/// A C library: a package of ours, and what is installed of it.
struct Library {
    package: &'static str,
    /// The package's folder.
    folder: &'static str,
    /// As cargo names its files: libNAME.so, libNAME.a.
    built_as: &'static str,
    /// As C programs know it: `-lNAME`.
    name: &'static str,
    /// What programs that are linked to it look for, after `libNAME.so.`.
    major: u32,
    /// The name of its pkg-config file, without `.pc`.
    described_as: &'static str,
    headers: &'static [&'static str],
    pages: &'static [&'static str],
}

const LIBRARIES: [Library; 2] = [
    Library {
        package: "faircurve-capi-libspiro",
        folder: "crates/faircurve-capi/libspiro",
        built_as: "spiro",
        name: "spiro",
        major: 1,
        described_as: "libspiro",
        headers: &["bezctx.h", "spiro.h", "spiroentrypoints.h"],
        pages: &["libspiro.3"],
    },
    Library {
        package: "faircurve-capi",
        folder: "crates/faircurve-capi",
        built_as: "faircurve_capi",
        name: "faircurve",
        major: 0,
        described_as: "faircurve",
        headers: &["faircurve.h"],
        pages: &["faircurve.3"],
    },
];

/// Builds and installs both. Says where.
pub(crate) fn install(prefix: &Path) -> Result<(), String> {
    if !cfg!(all(unix, not(target_vendor = "apple"))) {
        return Err("install-capi knows where things go on Linux and its like only\n\
                    hint: cargo build --release -p faircurve-capi builds the libraries anywhere"
            .into());
    }
    fs::create_dir_all(prefix).map_err(|error| at(prefix, &error))?;
    // Absolute, since pkg-config is asked from anywhere.
    let prefix = prefix.canonicalize().map_err(|error| at(prefix, &error))?;
    build()?;
    let built = target_folder()?.join("release");
    for library in &LIBRARIES {
        library.install(&built, &prefix)?;
    }
    println!("installed below {}", prefix.display());
    Ok(())
}

fn cargo() -> Command {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(root());
    cargo
}

fn build() -> Result<(), String> {
    let mut cargo = cargo();
    cargo.args(["build", "--release", "--lib"]);
    for library in &LIBRARIES {
        cargo.args(["--package", library.package]);
    }
    let status = cargo.status().map_err(|error| format!("can't run cargo: {error}"))?;
    if status.success() { Ok(()) } else { Err("the libraries can't be built".into()) }
}

fn target_folder() -> Result<PathBuf, String> {
    let output = cargo()
        .args(["metadata", "--no-deps", "--format-version", "1"])
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| format!("can't run cargo: {error}"))?;
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout)
        .map_err(|error| format!("can't read what cargo metadata says: {error}"))?;
    metadata["target_directory"]
        .as_str()
        .map(PathBuf::from)
        .ok_or_else(|| "cargo metadata doesn't say where things are built".into())
}

impl Library {
    fn install(&self, built: &Path, prefix: &Path) -> Result<(), String> {
        let Library { name, built_as, major, .. } = self;
        let source = root().join(self.folder);
        let place = |below: &str| prefix.join(below);
        let copy = |from: PathBuf, to: PathBuf| copy(&from, &to);
        let soname = format!("lib{name}.so.{major}");
        copy(built.join(format!("lib{built_as}.so")), place("lib").join(&soname))?;
        link(&soname, &place("lib").join(format!("lib{name}.so")))?;
        copy(built.join(format!("lib{built_as}.a")), place("lib").join(format!("lib{name}.a")))?;
        for header in self.headers {
            copy(source.join("include").join(header), place("include").join(header))?;
        }
        for page in self.pages {
            copy(source.join("man").join(page), place("share/man/man3").join(page))?;
        }
        let description = source.join(format!("{}.pc.in", self.described_as));
        let text = fs::read_to_string(&description).map_err(|error| at(&description, &error))?;
        let text = text
            .replace("@prefix@", &prefix.display().to_string())
            .replace("@version@", env!("CARGO_PKG_VERSION"));
        let file = format!("{}.pc", self.described_as);
        write(&place("lib/pkgconfig").join(file), text.as_bytes())
    }
}

/// Writes a file anew, so that programs that run with the old one keep it.
fn write(to: &Path, bytes: &[u8]) -> Result<(), String> {
    let folder = to.parent().unwrap_or(to);
    fs::create_dir_all(folder).map_err(|error| at(folder, &error))?;
    remove(to)?;
    fs::write(to, bytes).map_err(|error| at(to, &error))
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    write(to, &fs::read(from).map_err(|error| at(from, &error))?)
}

#[cfg(unix)]
fn link(target: &str, link: &Path) -> Result<(), String> {
    remove(link)?;
    std::os::unix::fs::symlink(target, link).map_err(|error| at(link, &error))
}

#[cfg(not(unix))]
fn link(_: &str, link: &Path) -> Result<(), String> {
    Err(format!("{}: there are no links here", link.display()))
}

fn remove(file: &Path) -> Result<(), String> {
    match fs::remove_file(file) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(at(file, &error)),
        _ => Ok(()),
    }
}
