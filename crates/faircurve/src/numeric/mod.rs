//! The numerical toolbox (thesis chapter 8): integrals, roots, linear systems, Newton's method.
//!
//! Nothing here knows of knots or splines.

pub mod block_tridiagonal;
pub(crate) mod dual;
pub mod elastica;
#[cfg(test)]
pub(crate) mod elastica_series;
pub mod elliptic;
pub mod fresnel;
pub(crate) mod gauss_legendre;
pub mod newton;
pub(crate) mod order;
pub(crate) mod quadrature;
pub mod roots;
pub(crate) mod rounding;
pub(crate) mod series;
pub mod spiro_integral;
pub mod spiro_series;
pub(crate) mod trig;
