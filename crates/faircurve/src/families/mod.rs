//! The splines, one folder each, and the catalogue that names them.

pub mod catalog;
pub mod circle;
pub mod euler;
pub mod kurgla1;
pub mod shapes;
pub mod spiro;
