//! Links the system's libspiro where pkg-config finds it, and says so with `cfg(libspiro)`.

fn main() {
    let cargo = |line: &str| std::io::Write::write_all(&mut std::io::stdout(), line.as_bytes());
    let told = cargo("cargo::rustc-check-cfg=cfg(libspiro)\ncargo::rerun-if-changed=build.rs\n")
        .and_then(|()| match pkg_config::probe_library("libspiro") {
            Ok(_) => cargo("cargo::rustc-cfg=libspiro\n"),
            Err(_) => cargo("cargo::warning=libspiro not found: install libspiro-dev\n"),
        });
    assert!(told.is_ok(), "cargo listens to the build script's output");
}
