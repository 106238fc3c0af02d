//! The WebAssembly modules inside the npm package `faircurve`.
//!
//! What crosses between JavaScript and Rust is flat: rows of numbers, and words. The package's own
//! modules (`js/`) make objects of them and document them; nothing else calls this.
//!
//! The crate is built once for each module: with the feature `solver`, with `splines`, with `formats`.

#[cfg(feature = "formats")]
pub mod formats;
#[cfg(any(feature = "solver", feature = "splines"))]
pub mod solver;
