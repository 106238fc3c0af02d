//! The npm package, built into target/npm.
//!
//! Needs the target wasm32-unknown-unknown, and Node with npm. Where rustup can't add the target,
//! `crates/faircurve-wasm/debian-toolchain.sh` says which compiler and flags to take instead.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use faircurve::catalog::ENTRIES;
use faircurve_format::catalogue_json;
use wasm_bindgen_cli_support::Bindgen;

use crate::{at, copies, root};

const TARGET: &str = "wasm32-unknown-unknown";

/// How a module is built.
struct Module {
    /// That of the crate's feature, too.
    name: &'static str,
    /// The compiler's level of optimisation.
    level: &'static str,
    /// Up to which cost the compiler puts a function into its callers, where that isn't for the level to say: at 2
    /// and 3 it is 225.
    most_inlined: Option<usize>,
    /// wasm-opt's level.
    wasm_level: &'static str,
    /// Bytes up to which copies are spelled out.
    most_copied: usize,
}

/// The modules. The solvers are hot: copies spelled out make them 3 to 10 % quicker and 2 % larger, the compiler's
/// level 3 some more quicker and 5 % larger, all that it would inline 2 % quicker and 4 % larger; for the last two the
/// first module has no room.
const MODULES: [Module; 3] = [
    Module {
        name: "solver",
        level: "2",
        most_inlined: Some(175),
        wasm_level: "-O3",
        most_copied: 112,
    },
    Module { name: "splines", level: "3", most_inlined: None, wasm_level: "-O3", most_copied: 128 },
    Module { name: "formats", level: "z", most_inlined: None, wasm_level: "-Oz", most_copied: 0 },
];

/// What every browser since March 2023 and Node 18 have of WebAssembly; Rust's compiler uses no more.
/// With `simd128` the integrals take some two thirds of the time.
const FEATURES: [&str; 8] = [
    "simd",
    "bulk-memory",
    "bulk-memory-opt",
    "nontrapping-float-to-int",
    "sign-ext",
    "mutable-globals",
    "reference-types",
    "multivalue",
];

/// wasm-opt's option for how large a function may be that is put into its only caller. Without a limit what is
/// rarely run ends up in what always is, and an engine, which compiles function by function as they are called,
/// has more to compile before the first curve; the module is 1 % larger, too.
const ONE_CALLER: &str = "--one-caller-inline-max-function-size";

/// Builds the package; its folder.
pub(crate) fn build() -> Result<PathBuf, String> {
    let source = source();
    let package = target_folder().join("npm");
    for folder in [&package, &source.join("js/wasm")] {
        match fs::remove_dir_all(folder) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                return Err(at(folder, &error));
            }
            _ => {}
        }
        fs::create_dir_all(folder).map_err(|error| at(folder, &error))?;
    }
    run(Command::new("npm").current_dir(&source).args(["ci", "--no-audit", "--no-fund"]))?;
    for module in &MODULES {
        module.build()?;
    }
    let rows = source.join("js/wasm/catalogue.ts");
    let catalogue = catalogue().map_err(|error| error.to_string())?;
    fs::write(&rows, catalogue).map_err(|error| at(&rows, &error))?;
    scripts(&package)?;
    let wasm = package.join("wasm");
    fs::create_dir_all(&wasm).map_err(|error| at(&wasm, &error))?;
    for Module { name, .. } in &MODULES {
        for file in [format!("{name}.d.ts"), format!("{name}_bg.wasm")] {
            copy(&source.join("js/wasm").join(&file), &wasm.join(&file))?;
        }
    }
    copy(&source.join("js/package.json"), &package.join("package.json"))?;
    copy(&source.join("README.md"), &package.join("README.md"))?;
    for file in ["LICENSE-APACHE", "LICENSE-MIT"] {
        copy(&root().join(file), &package.join(file))?;
    }
    println!("built {}", package.display());
    Ok(package)
}

/// The catalogue for scripts, known without any module: what `list --json` prints, with the order of
/// continuity.
fn catalogue() -> Result<String, serde_json::Error> {
    let list: serde_json::Value = serde_json::from_str(&catalogue_json::write()?)?;
    let mut rows = list["splines"].clone();
    for (row, info) in rows.as_array_mut().into_iter().flatten().zip(ENTRIES) {
        row["continuity"] = info.continuity().into();
    }
    Ok(format!(
        "import type {{ SplineInfo }} from \"../catalogue.js\";\n\n\
         export const rows: readonly SplineInfo[] = {rows};\n"
    ))
}

fn source() -> PathBuf {
    root().join("crates/faircurve-wasm")
}

/// The package's scripts, each in one file, since a browser asks for what a file imports only once it
/// has read it; and their types.
fn scripts(package: &Path) -> Result<(), String> {
    run(npx("tsc").arg("--outDir").arg(package))?;
    let bundle = |entries: &[&str]| {
        let mut esbuild = npx("esbuild");
        esbuild.args(entries.iter().map(|entry| format!("js/{entry}.ts")));
        esbuild.args(["--bundle", "--minify", "--format=esm", "--target=es2022"]);
        esbuild.args(["--external:node:*", "--external:./index.js", "--log-level=warning"]);
        run(esbuild.arg(format!("--outdir={}", package.display())))
    };
    bundle(&["index", "formats"])?;
    bundle(&["d3", "spiro", "splines"])
}

/// Runs one of the package's npm scripts on the package as npm packs it.
pub(crate) fn script(package: &Path, script: &str) -> Result<(), String> {
    let mut command = Command::new("npm");
    command.current_dir(source()).args(["run", "--silent", script]);
    run(command.env("FAIRCURVE_PACKAGE", package))
}

impl Module {
    /// Compiles it, binds it, optimises it.
    fn build(&self) -> Result<(), String> {
        let Module { name, level, most_inlined, wasm_level, most_copied } = *self;
        let inlined = most_inlined
            .map_or_else(String::new, |most| format!(" -Cllvm-args=-inline-threshold={most}"));
        let compiled_with = format!("-Ctarget-feature=+simd128{inlined}");
        let flags = std::env::var("WASM_CARGO_FLAGS").unwrap_or_default();
        let mut cargo = Command::new("cargo");
        cargo
            .current_dir(root())
            .args(["build", "--profile", "wasm", "--target", TARGET, "-p", "faircurve-wasm"])
            .args(["--no-default-features", "--features", name])
            .args(flags.split_whitespace())
            .env("CARGO_PROFILE_WASM_OPT_LEVEL", level)
            .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS", compiled_with);
        if let Some(compiler) = std::env::var_os("FAIRCURVE_WASM_RUSTC") {
            cargo.env("RUSTC", compiler).env("RUSTC_BOOTSTRAP", "1");
        }
        run(&mut cargo)?;
        let built = target_folder().join(TARGET).join("wasm/faircurve_wasm.wasm");
        let mut bindgen = Bindgen::new();
        bindgen.input_path(&built).out_name(name).typescript(true);
        bindgen.web(true).map_err(|error| error.to_string())?;
        bindgen
            .omit_default_module_path(true)
            .remove_name_section(true)
            .remove_producers_section(true);
        let folder = source().join("js/wasm");
        bindgen.generate(&folder).map_err(|error| format!("wasm-bindgen: {error:#}"))?;
        let file = folder.join(format!("{name}_bg.wasm"));
        if most_copied > 0 {
            copies::spell_out(&file, most_copied)?;
        }
        let features = FEATURES.map(|feature| format!("--enable-{feature}"));
        run(npx("wasm-opt")
            .arg(&file)
            .args(features)
            .args([wasm_level, ONE_CALLER, "200", "-o"])
            .arg(&file))
    }
}

/// A program of the package's npm dependencies.
fn npx(program: &str) -> Command {
    let mut command = Command::new("npx");
    command.current_dir(source()).arg(program);
    command
}

fn run(command: &mut Command) -> Result<(), String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let status = command.status().map_err(|error| match name.as_str() {
        "npm" | "npx" => {
            format!("can't run {name}: {error}\nhint: install Node, https://nodejs.org")
        }
        _ => format!("can't run {name}: {error}"),
    })?;
    if status.success() {
        return Ok(());
    }
    let arguments: Vec<_> = command.get_args().map(|a| a.to_string_lossy()).collect();
    let hint = match name.as_str() {
        "cargo" => "\nhint: if the target is missing, `rustup target add wasm32-unknown-unknown`",
        _ => "",
    };
    Err(format!("`{name} {}` failed{hint}", arguments.join(" ")))
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    fs::copy(from, to).map(drop).map_err(|error| at(from, &error))
}

fn target_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}
