//! Splines whose segments have two parameters, the tangents at their ends (thesis chapter 4).
//!
//! "Any given two-parameter spline can be characterized by two properties: the family of curves
//! parametrized by the endpoint tangent angles, and the algorithm used to determine the tangent
//! angles." So a [spline] is a [rule](tangents) for tangents and a [shape] for segments. The rule of
//! most is [continuity] of curvature, as a [curvature map](curvature_map) has it; the map and the
//! shape need not belong together (Bespoke section 2).

pub mod continuity;
pub mod curvature_map;
pub mod extract;
pub mod generating;
pub mod lookup_table;
pub mod shape;
pub mod spline;
pub mod tangents;
