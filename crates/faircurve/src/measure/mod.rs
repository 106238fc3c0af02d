//! Numbers for what curves and splines are worth (thesis chapter 2).
//!
//! [`fairness`] measures a curve, [`laws`] a spline; [`verdict`] is the one place where the laws'
//! numbers become the + and − of thesis Table 4.1, and claims hold or don't.

pub mod fairness;
pub mod laws;
pub mod verdict;

pub use fairness::{Fairness, Jump};
pub use laws::Laws;
pub use verdict::{Grade, Verdict};
