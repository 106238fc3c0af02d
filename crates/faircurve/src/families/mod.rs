//! The splines, one folder each, and the catalogue that names them.

pub mod catalog;
pub mod euler;
pub mod generated;
pub mod log_aesthetic;
pub mod shapes;
pub mod spiro;
