//! The splines, one folder each, and the catalogue that names them.

pub mod bespoke;
pub mod catalog;
pub mod euler;
pub mod kappa;
pub mod shapes;
pub mod spiro;
