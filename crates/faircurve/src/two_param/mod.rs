//! Splines whose segments have two parameters, the tangents at their ends (thesis chapter 4).
//!
//! A [family] of segments is a curvature map, from end tangents to end curvatures, and a shape that
//! fills the segment; the [spline] solves for the tangents that make curvature
//! continuous.

pub mod family;
pub mod spline;
