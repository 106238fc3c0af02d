//! Gives the shared library the name that programs linked to libspiro look for.

fn main() {
    let cargo = |line: &str| std::io::Write::write_all(&mut std::io::stdout(), line.as_bytes());
    let elf =
        std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "linux" || os.ends_with("bsd"));
    let told = cargo("cargo::rerun-if-changed=build.rs\n").and_then(|()| match elf {
        true => cargo("cargo::rustc-cdylib-link-arg=-Wl,-soname,libspiro.so.1\n"),
        false => Ok(()),
    });
    assert!(told.is_ok(), "cargo listens to the build script's output");
}
