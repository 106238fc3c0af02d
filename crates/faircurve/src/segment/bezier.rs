//! Béziers as shapes of segments.

use std::f64::consts::FRAC_PI_2;

use kurbo::common::solve_quadratic;
use kurbo::{CubicBez, ParamCurve, PathSeg, Point, Rect};
use num_complex::Complex64;

use super::ParametricCurve;
use super::measured::LONGEST_UNMEASURED;
use crate::numeric::gauss_legendre::GAUSS_16;
use crate::numeric::trig::{argument, cis};

/// A line, quadratic or cubic Bézier from (0, 0) to (1, 0).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitBezier {
    exact: PathSeg,
    /// Its velocity, as a quadratic Bézier: short arms are known to their own rounding here.
    velocity: [Complex64; 3],
    /// Directions of both arms, where given; of arms that point backwards, the opposite ones.
    directions: Option<[f64; 2]>,
}

impl UnitBezier {
    /// From a Bézier that starts at (0, 0) and ends at (1, 0).
    pub fn new(bezier: PathSeg) -> Self {
        let CubicBez { p0, p1, p2, p3 } = bezier.to_cubic();
        let velocity = [p1 - p0, p2 - p1, p3 - p2].map(|leg| Complex64::new(leg.x, leg.y) * 3.0);
        UnitBezier { exact: bezier, velocity, directions: None }
    }

    /// The cubic whose arms, along the end tangents, have these lengths; negative ones point
    /// backwards. `start` and `end` are the directions of the tangents.
    pub fn from_arms(start: f64, end: f64, arms: [f64; 2]) -> Self {
        UnitBezier::from_legs([cis(start) * arms[0], cis(end) * arms[1]], [start, end])
    }

    /// The cubic whose first and last leg, from control point to control point, are these, along lines in
    /// these directions.
    pub(crate) fn from_legs([first, last]: [Complex64; 2], directions: [f64; 2]) -> Self {
        let (p1, p2) = (point(first), point(1.0 - last));
        let cubic = CubicBez::new(Point::ORIGIN, p1, p2, Point::new(1.0, 0.0));
        let velocity = [first, 1.0 - first - last, last].map(|leg| leg * 3.0);
        UnitBezier { exact: PathSeg::Cubic(cubic), velocity, directions: Some(directions) }
    }
}

/// The smallest box that holds a Bézier: its ends, and where a coordinate stands still.
///
/// kurbo's `bounding_box` sorts the places first, which costs the module for the web 6 kB.
pub(super) fn bounds(bezier: PathSeg) -> Rect {
    let CubicBez { p0, p1, p2, p3 } = bezier.to_cubic();
    let legs = [p1 - p0, p2 - p1, p3 - p2];
    [legs.map(|leg| leg.x), legs.map(|leg| leg.y)]
        .into_iter()
        .flat_map(|[a, b, c]| solve_quadratic(a, 2.0 * (b - a), a - 2.0 * b + c))
        .filter(|t| (0.0..=1.0).contains(t))
        .fold(Rect::from_points(p0, p3), |bounds, t| bounds.union_pt(bezier.eval(t)))
}

pub(super) fn complex(p: Point) -> Complex64 {
    Complex64::new(p.x, p.y)
}

pub(super) fn point(z: Complex64) -> Point {
    Point::new(z.re, z.im)
}

impl ParametricCurve for UnitBezier {
    fn point(&self, u: f64) -> Complex64 {
        let CubicBez { p0, p1, p2, p3 } = self.exact.to_cubic();
        let [p0, p1, p2, p3] = [p0, p1, p2, p3].map(complex);
        let v = 1.0 - u;
        // Ends are exact: every other term is then 0.
        p0 * (v * v * v) + p1 * (3.0 * v * v * u) + p2 * (3.0 * v * u * u) + p3 * (u * u * u)
    }

    fn velocity_series(&self, u: f64) -> [Complex64; 5] {
        let [a, b, c] = self.velocity;
        let v = 1.0 - u;
        let (d0, d1) = (b - a, c - b);
        [
            a * (v * v) + b * (2.0 * v * u) + c * (u * u),
            (d0 * v + d1 * u) * 2.0,
            d1 - d0,
            Complex64::ZERO,
            Complex64::ZERO,
        ]
    }

    fn velocity(&self, u: f64) -> Complex64 {
        let [a, b, c] = self.velocity;
        let v = 1.0 - u;
        a * (v * v) + b * (2.0 * v * u) + c * (u * u)
    }

    fn bezier(&self, from: f64, to: f64) -> Option<PathSeg> {
        let is_whole = from == 0.0 && to == 1.0;
        Some(if is_whole { self.exact } else { self.exact.subsegment(from..to) })
    }

    /// Let the control points of a stretch's velocity keep within r of their mean, over which it is 1. In the
    /// ellipse about [0, 1] in the plane of complex u on which |u| + |1 − u| = S the Bernstein polynomials'
    /// absolute values add up to at most S², so that the velocity isn't 0 there, and the speed is analytic, as
    /// long as rS² < 1. With r = 0.3, the error of sixteen nodes is below 2e-16 of the length (Bernstein's ellipse
    /// has ρ = S + √(S² − 1) = 3.35).
    fn gentle_length(&self, from: f64, to: f64) -> Option<f64> {
        const NEAR: f64 = 0.3;
        let [a, b, c] = self.velocity;
        let blossom = |u: f64, v: f64| {
            a * ((1.0 - u) * (1.0 - v)) + b * (u * (1.0 - v) + v * (1.0 - u)) + c * (u * v)
        };
        let stretch = if (from, to) == (0.0, 1.0) {
            self.velocity
        } else {
            [blossom(from, from), blossom(from, to), blossom(to, to)]
        };
        let mean = (stretch[0] + stretch[1] + stretch[2]) / 3.0;
        let most = NEAR * NEAR * mean.norm_sqr();
        let is_gentle = stretch.iter().all(|v| (v - mean).norm_sqr() <= most);
        (is_gentle && most.is_normal()).then(|| (to - from) * length_by_sixteen_nodes(stretch))
    }

    /// Where no leg points backwards, the direction stays within a quarter turn of the chord's.
    fn directions(&self) -> Option<[f64; 2]> {
        let is_ordinary =
            |v: &Complex64| v.re > 0.0 && v.re.max(v.im.abs()) < LONGEST_UNMEASURED / 2.0;
        if !self.velocity.iter().all(is_ordinary) {
            return None;
        }
        let [first, _, last] = self.velocity;
        match self.directions {
            // Of arms that point forwards.
            Some(known) if known.iter().all(|direction| direction.abs() < FRAC_PI_2) => Some(known),
            _ => Some([argument(first), argument(last)]),
        }
    }
}

/// The length of a curve of that velocity, a quadratic Bézier.
#[inline(never)] // by itself it vectorises
fn length_by_sixteen_nodes([a, b, c]: [Complex64; 3]) -> f64 {
    // By powers of t = u − ½: what both nodes of a pair share, and what differs in its sign.
    let (middle, slope, bend) = ((a + c + b * 2.0) * 0.25, c - a, a + c - b * 2.0);
    let pairs = GAUSS_16.nodes.map(|t| {
        let (even, odd) = (middle + bend * (t * t), slope * t);
        (even + odd).norm_sqr().sqrt() + (even - odd).norm_sqr().sqrt()
    });
    let weighed = pairs.iter().zip(GAUSS_16.pair_weights);
    weighed.map(|(speeds, weight)| 0.5 * weight * speeds).sum()
}
