//! The forces at the knots of an elastic spline (thesis sections 3.4, 3.6, 3.8).

use kurbo::Vec2;
use num_complex::Complex64;

use crate::curve::Curve;
use crate::segment::{Segment, Shape};

/// The force that what lies beyond any place of a segment exerts there, in units of the bending
/// stiffness over units²: the same everywhere on an elastica, nothing on a line. `None` for other
/// shapes.
pub fn force_in(segment: &Segment) -> Option<Vec2> {
    match segment.shape() {
        Shape::Line => Some(Vec2::ZERO),
        Shape::Elastica(elastica) => {
            let middle = segment.direction(segment.length() / 2.0);
            let force = elastica.force() * Complex64::cis(middle) / segment.length().powi(2);
            Some(Vec2::new(force.re, force.im))
        }
        _ => None,
    }
}

/// The force that the knot before each segment of a curve exerts on it, and at last that of the open
/// end; of an elastic spline. `None` beside a segment of another shape.
///
/// A knot through which the strip slides freely pushes only across it (thesis 3.8, result 1): its
/// force is the jump of κ′. All forces on an open strip sum to zero.
pub fn forces_at_knots(curve: &Curve) -> Vec<Option<Vec2>> {
    let inner: Vec<Option<Vec2>> = curve.segments().iter().map(force_in).collect();
    let n = inner.len();
    let knots = if curve.is_closed() { n } else { n + 1 };
    (0..knots)
        .map(|i| {
            let beyond = |segment: usize| inner.get(segment).copied().unwrap_or(Some(Vec2::ZERO));
            let before = match i {
                0 if curve.is_closed() => beyond(n - 1),
                0 => Some(Vec2::ZERO),
                i => beyond(i - 1),
            };
            Some(before? - beyond(i)?)
        })
        .collect()
}
