//! Integrals along a segment, and how its end answers changes.
//!
//! With t = x − ½ along the unit chord, κ = a + bt and sin φ = S(t) = m + at + (b/2)(t² − ¼). So arc
//! length is the elliptic integral ∫ dt/√(1 − S²), or, by the angle, ∫ dφ/κ(φ) with
//! κ² = C + 2b sin φ. The first is smooth where the curve isn't vertical, the second where it
//! isn't straight. One of them always is: the vertical straight line is an equilibrium that no
//! segment reaches.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use num_complex::Complex64;

use super::segment::SiMec;
use crate::numeric::gauss_legendre::GAUSS_16;
use crate::numeric::trig::sin_cos;

/// Directions within ± this are integrated by x. Inflections lie within ±1.06 for all end tangents
/// in the square |θ| ≤ π, so that none lies beyond.
const FLAT: f64 = 1.12;

/// Integrals from end to end.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Along {
    /// ∫ ds.
    pub(super) length: f64,
    /// ∫ sin φ ds.
    pub(super) y: f64,
    /// ∫ sin² φ ds.
    square: f64,
}

impl Along {
    /// Along a segment of any slope (its length isn't used). `None` if there is none between these
    /// directions, or it takes another course than those that continue the straight line do.
    pub(super) fn of(fit: &SiMec) -> Option<Along> {
        /// With curvatures that differ less, the angle alone will do.
        const ROUND: f64 = 0.25;
        let mut along = Along::default();
        let (start, end) = (-fit.angles.theta0, fit.angles.theta1);
        let [k0, k1] = fit.curvatures();
        if k0 * k1 > 0.0 && k0.abs().min(k1.abs()) > ROUND * k0.abs().max(k1.abs()) {
            if (end - start) * k0 <= 0.0 {
                return None;
            }
            along.add_by_angle(fit, start, end, k0);
            return along.finite();
        }
        // How far in x from the ends the flat part begins and ends: sin φ changes by the mean of
        // curvature times the change of x.
        let (mut from, mut to) = (0.0, 0.0);
        if start.abs() > FLAT {
            let edge = FLAT.copysign(start);
            let change = edge.sin() - start.sin();
            let k = (k0 * k0 + 2.0 * fit.slope * change).sqrt().copysign(k0);
            if !(k.is_finite() && k0 * start < 0.0) {
                return None;
            }
            from = 2.0 * change / (k + k0);
            along.add_by_angle(fit, start, edge, k0);
        }
        if end.abs() > FLAT {
            let edge = FLAT.copysign(end);
            let change = end.sin() - edge.sin();
            let k = (k1 * k1 - 2.0 * fit.slope * change).sqrt().copysign(k1);
            if !(k.is_finite() && k1 * end > 0.0) {
                return None;
            }
            to = 2.0 * change / (k + k1);
            along.add_by_angle(fit, edge, end, k);
        }
        along.add_by_x(fit, from - 0.5, 0.5 - to)?;
        along.finite()
    }

    fn finite(self) -> Option<Along> {
        (self.length.is_finite() && self.y.is_finite() && self.length >= 0.5).then_some(self)
    }

    /// Adds a stretch by the direction, which must change steadily; `curvature` is that at its start.
    fn add_by_angle(&mut self, fit: &SiMec, from: f64, to: f64, curvature: f64) {
        let double = 2.0 * fit.slope;
        let reference = curvature * curvature - double * from.sin();
        // Where κ would be 0.
        let sine = -reference / double;
        let (base, off) = if sine.abs() <= 1.0 {
            (sine.asin(), 0.0)
        } else {
            (FRAC_PI_2.copysign(sine), sine.abs().acosh())
        };
        let singular = [base, PI - base, base - TAU, -PI - base, base + TAU, 3.0 * PI - base]
            .map(|angle| Complex64::new(angle, off));
        let squared = curvature * curvature;
        let start = sin_cos(from).0;
        self.add(from, to, &singular, |angle| {
            let sine = sin_cos(angle).0;
            let curvature = (squared + double * (sine - start)).sqrt().copysign(curvature);
            (1.0 / curvature, sine)
        });
    }

    /// Adds a stretch by t. `None` where it turns vertical.
    fn add_by_x(&mut self, fit: &SiMec, from: f64, to: f64) -> Option<()> {
        let (a, half) = (fit.mean, fit.slope / 2.0);
        let offset = (fit.angles.theta1.sin() - fit.angles.theta0.sin()) / 2.0 - half / 4.0;
        let sine = move |t: f64| offset + t * (a + t * half);
        // Where sin φ would be ±1: the roots of quadratics.
        let roots = |level: f64| {
            let (c, discriminant) = (offset - level, a * a - 4.0 * half * (offset - level));
            if discriminant >= 0.0 {
                let q = -(a + discriminant.sqrt().copysign(a)) / 2.0;
                [Complex64::from(q / half), Complex64::from(c / q)]
            } else {
                [Complex64::new(-a, (-discriminant).sqrt()) / (2.0 * half); 2]
            }
        };
        let [above, below] = [roots(1.0), roots(-1.0)];
        let singular = [above[0], above[1], below[0], below[1]];
        if !(from < to) || singular.iter().any(|z| z.im == 0.0 && (from..=to).contains(&z.re)) {
            return None;
        }
        self.add(from, to, &singular, |t| {
            let sine = sine(t);
            (1.0 / ((1.0 - sine) * (1.0 + sine)).sqrt(), sine)
        });
        Some(())
    }

    /// Adds the integrals over a variable from which `f` gives ds/d(variable) and sin φ; `singular`
    /// are places, up to conjugates, where f isn't analytic.
    ///
    /// Sixteen nodes are good to 3⁻³² where the ellipse with foci at the ends and half axes of sum 3
    /// (for a half length of 1) is free of them; until then, intervals are halved.
    fn add(
        &mut self,
        from: f64,
        to: f64,
        singular: &[Complex64],
        f: impl Fn(f64) -> (f64, f64) + Copy,
    ) {
        const AXIS: f64 = (3.0 + 1.0 / 3.0) / 2.0;
        /// Closer to a singular place than this part of the whole there is none.
        const LEAST: f64 = 1e-6;
        let mut left = from;
        let mut right = to;
        loop {
            let width = (right - left).abs();
            let is_near = |z: &Complex64| (z - left).norm() + (z - right).norm() < AXIS * width;
            if singular.iter().any(is_near) && width > LEAST * (to - from).abs() {
                right = (left + right) / 2.0;
                continue;
            }
            let (middle, width) = ((left + right) / 2.0, right - left);
            for (node, weight) in GAUSS_16.nodes.iter().zip(GAUSS_16.pair_weights) {
                for u in [middle - node * width, middle + node * width] {
                    let (speed, sine) = f(u);
                    let part = weight / 2.0 * speed * width;
                    self.length += part;
                    self.y += part * sine;
                    self.square += part * sine * sine;
                }
            }
            if right == to {
                return;
            }
            // The next one may be twice as long.
            (left, right) = (right, right + 2.0 * width);
            if (to - right) * (to - from) <= 0.0 {
                right = to;
            }
        }
    }

    /// How y at the end of the chord, x = 1, answers a change of the slope, `theta0` and `theta1`.
    ///
    /// Every change of an elastica φ″ = b cos φ is made of three, each in closed form, with changes of
    /// (φ, κ) at the start and of b:
    /// moving along it, δφ = κ; scaling it, δφ = sκ and δb = 2b; and δφ = κy + 2 cos φ with δb = −C.
    /// (The last is what is left of the elliptic integrals' own derivatives.)
    pub(super) fn y_by(&self, fit: &SiMec) -> [f64; 3] {
        /// Where the three are that close to dependent, for curves that end in a straight line, or
        /// don't bend at all, a curve close by must do. It slows Newton's method a little.
        const DEPENDENT: f64 = 1e-7;
        const CLOSE_BY: f64 = 1e-4;
        let [k0, k1] = fit.curvatures();
        let (b, a) = (fit.slope, fit.mean);
        let ((s0, c0), (s1, c1)) = ((-fit.angles.theta0).sin_cos(), fit.angles.theta1.sin_cos());
        let constant = k0 * k0 - 2.0 * b * s0;
        let determinant = 4.0 * b * b - constant * constant;
        if !(determinant.abs() > DEPENDENT * (4.0 * b * b + constant * constant)) {
            if k0.abs().max(k1.abs()) < 1e-12 {
                // The straight line: y = −b/12 + (θ₁ − θ₀)/2.
                return [-1.0 / 12.0, -0.5, 0.5];
            }
            let moved = SiMec { slope: b + CLOSE_BY * (b.abs() + a.abs()), ..*fit };
            if let Some(along) = Along::of(&moved)
                && moved.slope != b
            {
                return along.y_by(&moved);
            }
        }
        // At the end: change of φ, x and y of each.
        let end = [
            [k1, c1 - c0, s1 - s0],
            [self.length * k1, self.length * c1 - 1.0, self.length * s1 - self.y],
            [
                k1 * self.y + 2.0 * c1,
                // −3∫ sin φ dx.
                c1 * self.y - 1.5 * (s1 + s0) + b / 4.0,
                s1 * self.y + 2.0 * self.length - 3.0 * self.square,
            ],
        ];
        // What they are made of, by Cramer's rule, from the changes of φ and κ at the start and of b.
        let made_of = |angle: f64, curvature: f64, slope: f64| {
            let along = angle * (2.0 * b * k0 * s0 - k0 * constant)
                - 2.0 * c0 * (k0 * slope - 2.0 * b * curvature);
            let third = k0 * (k0 * slope - 2.0 * b * curvature) + 2.0 * b * b * c0 * angle;
            let scaled = k0 * (s0 * k0 * slope - constant * curvature)
                + b * c0 * (2.0 * c0 * slope + constant * angle);
            [along, scaled, third].map(|part| part / determinant)
        };
        // The length changes so that φ is what is asked and x is 1, which is one condition: see above.
        let weight = k1 * k1 + c1 * c1;
        let answer = |parts: [f64; 3], asked: f64| {
            let total = |i: usize| (0..3).map(|j| parts[j] * end[j][i]).sum::<f64>();
            let longer = (k1 * (asked - total(0)) - c1 * total(1)) / weight;
            total(2) + s1 * longer
        };
        [
            answer(made_of(0.0, -0.5, 1.0), 0.0),
            answer(made_of(-1.0, c0, 0.0), 0.0),
            answer(made_of(0.0, c1, 0.0), 1.0),
        ]
    }
}
