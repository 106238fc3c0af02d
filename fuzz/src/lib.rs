//! What the fuzz targets share: hostile problems, and what must hold of every answer.
//!
//! A broken promise is a panic, whose message says which. See `README.md` in this folder.

pub mod check;
pub mod document;
pub mod judge;
mod problem;

pub use problem::{Accuracy, BezierOptions, Problem};
