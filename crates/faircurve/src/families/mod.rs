//! The splines, one folder each, and the catalogue that names them.

pub mod akima;
pub mod bespoke;
pub mod catalog;
pub mod circle;
pub mod ends;
pub mod euler;
pub mod generated;
pub mod hobby;
pub mod ikarus;
pub mod kappa;
pub mod kurgla1;
pub mod lagrange;
pub mod log_aesthetic;
pub mod mec;
pub mod mvc;
pub mod polygon;
pub mod potrace;
pub mod shapes;
pub mod simec;
pub mod spiro;
