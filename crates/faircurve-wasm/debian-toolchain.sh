#!/bin/sh
# For machines whose rustup can't add wasm32-unknown-unknown: a compiler that has it, from Debian 12's packages. Prints what to
# set; `cargo xtask npm` heeds it.
#
#   eval "$(crates/faircurve-wasm/debian-toolchain.sh)"
#
# Unpacks about 120 MB into ~/.cache/faircurve-wasm-toolchain the first time. The standard library is compiled from its source.
set -eu
cache=${XDG_CACHE_HOME:-$HOME/.cache}/faircurve-wasm-toolchain
if [ ! -x "$cache/rustc" ]; then
    {
        mkdir -p "$cache/deb" "$cache/root"
        apt-get update -q
        apt-get install -y -q --no-install-recommends libllvm22 lld-22
        cd "$cache/deb"
        std=$(apt-cache depends libstd-rust-web-dev | sed -n 's/ *Depends: \(libstd-rust-web-[0-9.]*\)$/\1/p' | head -1)
        apt-get download rustc-web rust-web-src libstd-rust-web-dev "$std"
        for package in *.deb; do dpkg -x "$package" "$cache/root"; done
        rm -f ./*.deb
        printf '#!/bin/sh\nLD_LIBRARY_PATH=%s exec %s "$@"\n' \
            "$cache/root/usr/lib/x86_64-linux-gnu" "$cache/root/usr/bin/rustc" >"$cache/rustc"
        chmod +x "$cache/rustc"
    } >&2
fi
cat <<SETTINGS
export FAIRCURVE_WASM_RUSTC=$cache/rustc
export CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=/usr/bin/wasm-ld-22
export WASM_CARGO_FLAGS=-Zbuild-std=std,panic_abort
SETTINGS
