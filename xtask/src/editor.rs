//! The editor's site, built into target/editor from editor/ and the npm package; what serves and tests it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::{at, root};

/// What the site has of editor/.
const PARTS: [&str; 4] = ["index.html", "style.css", "icon.svg", "src"];

/// Builds the site, and what `then` says: `--test` runs the editor's tests, `--build` nothing, and without
/// either it is served.
pub(crate) fn run(then: &[&str]) -> Result<(), String> {
    let package = match std::env::var_os("FAIRCURVE_PACKAGE") {
        Some(built) => PathBuf::from(built),
        None => {
            cargo(&["run", "--release", "-p", "xtask", "--", "npm"])?;
            target_folder().join("npm")
        }
    };
    let site = build(&package)?;
    match then {
        ["--build"] => Ok(()),
        ["--test"] => test(&package, &site),
        [] => {
            let site = site.display().to_string();
            cargo(&["run", "--release", "-p", "faircurve-cli", "--", "edit", "--site", &site])
        }
        _ => Err("usage: cargo xtask editor [--build | --test]".into()),
    }
}

/// The site's folder: the editor's own modules beside those of the package, without anything to compile.
fn build(package: &Path) -> Result<PathBuf, String> {
    let site = target_folder().join("editor");
    empty(&site)?;
    for part in PARTS {
        copy(&root().join("editor").join(part), &site.join(part), &|_| true)?;
    }
    let is_run =
        |name: &str| !name.ends_with(".ts") && name != "README.md" && name != "node_modules";
    copy(package, &site.join("faircurve"), &is_run)?;
    preload(&site)?;
    Ok(site)
}

/// Lets the page name all that it needs at the start, so that a browser fetches modules at once instead of one
/// after the other as they import each other.
fn preload(site: &Path) -> Result<(), String> {
    const MARK: &str = "<link rel=\"modulepreload\" href=\"src/main.js\">";
    let mut links = Vec::new();
    for folder in ["src", "faircurve"] {
        modules(site, folder, &mut links)?;
    }
    links.sort();
    for module in ["solver", "splines"] {
        links.push(format!(
            "<link rel=\"preload\" href=\"faircurve/wasm/{module}_bg.wasm\" as=\"fetch\" crossorigin>"
        ));
    }
    let index = site.join("index.html");
    let page = fs::read_to_string(&index).map_err(|error| at(&index, &error))?;
    let whole = page.replace(MARK, &links.join("\n    "));
    fs::write(&index, whole).map_err(|error| at(&index, &error))
}

/// Links to the modules in a folder of the site that the start needs: all but what reads and writes files, and
/// the package's other ways in.
fn modules(site: &Path, folder: &str, links: &mut Vec<String>) -> Result<(), String> {
    const LATER: [&str; 3] = ["formats.js", "d3.js", "spiro.js"];
    let path = site.join(folder);
    for entry in fs::read_dir(&path).map_err(|error| at(&path, &error))? {
        let name = entry.map_err(|error| at(&path, &error))?.file_name();
        let name = name.to_string_lossy();
        let address = format!("{folder}/{name}");
        if path.join(&*name).is_dir() {
            modules(site, &address, links)?;
        } else if name.ends_with(".js") && !LATER.contains(&&*name) {
            links.push(format!("<link rel=\"modulepreload\" href=\"{address}\">"));
        }
    }
    Ok(())
}

/// Checks the types and runs the tests in Node and in a browser.
fn test(package: &Path, site: &Path) -> Result<(), String> {
    let editor = root().join("editor");
    let npm = |arguments: &[&str]| {
        let mut command = Command::new("npm");
        command.current_dir(&editor).args(arguments).env("FAIRCURVE_SITE", site);
        command.env("FAIRCURVE_PROGRAM", target_folder().join("release/faircurve"));
        finish(&mut command)
    };
    npm(&["ci", "--no-audit", "--no-fund"])?;
    let installed = editor.join("node_modules/faircurve");
    empty(&installed)?;
    copy(package, &installed, &|_| true)?;
    cargo(&["build", "--release", "-p", "faircurve-cli"])?;
    npm(&["run", "--silent", "check"])?;
    npm(&["run", "--silent", "test"])?;
    let chromium = std::env::var_os("CHROMIUM").unwrap_or_else(|| "/usr/bin/chromium".into());
    if !Path::new(&chromium).exists() {
        println!("there is no {}: no tests in a browser", chromium.display());
        return Ok(());
    }
    npm(&["run", "--silent", "browser"])
}

fn cargo(arguments: &[&str]) -> Result<(), String> {
    finish(Command::new("cargo").current_dir(root()).args(arguments))
}

fn finish(command: &mut Command) -> Result<(), String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let status = command.status().map_err(|error| format!("can't run {name}: {error}"))?;
    let arguments: Vec<_> = command.get_args().map(|a| a.to_string_lossy()).collect();
    status.success().then_some(()).ok_or(format!("`{name} {}` failed", arguments.join(" ")))
}

fn empty(folder: &Path) -> Result<(), String> {
    match fs::remove_dir_all(folder) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(at(folder, &error)),
        _ => fs::create_dir_all(folder).map_err(|error| at(folder, &error)),
    }
}

/// Copies a file, or a folder with what is in it and has a wanted name.
fn copy(from: &Path, to: &Path, is_wanted: &dyn Fn(&str) -> bool) -> Result<(), String> {
    if !from.is_dir() {
        return fs::copy(from, to).map(drop).map_err(|error| at(from, &error));
    }
    fs::create_dir_all(to).map_err(|error| at(to, &error))?;
    for entry in fs::read_dir(from).map_err(|error| at(from, &error))? {
        let name = entry.map_err(|error| at(from, &error))?.file_name();
        if is_wanted(&name.to_string_lossy()) {
            copy(&from.join(&name), &to.join(&name), is_wanted)?;
        }
    }
    Ok(())
}

fn target_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}
