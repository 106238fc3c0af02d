//! Splines whose segments have four parameters, tangents and curvatures at their ends (thesis
//! chapter 7).
//!
//! A [family] of segments answers tangents and curvatures at the ends with curvature derivatives;
//! the [constraint table](constraint_table) says what must hold at each kind of join; and the
//! [spline] solves for the tangents and curvatures that make it so.

mod budget;
pub mod constraint_table;
pub mod family;
mod relax;
pub mod spline;
mod strategy;
mod system;
