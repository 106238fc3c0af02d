//! The segment: a point on an arc between the chord's ends, while the arc turns from one circle to
//! the other.

use std::f64::consts::PI;

use kurbo::PathSeg;
use num_complex::Complex64;

use crate::frame::ChordAngles;
use crate::numeric::series::{Series, cis, compose, product, quotient, sinc};
use crate::segment::ParametricCurve;

/// The blend of two circles through the ends of the unit chord:
///
/// P(u) = sin(uτ)/sin τ · e^{i(1−u)τ},  τ(u) = τ₀ cos²(πu/2) + τ₁ sin²(πu/2),
///
/// where −τ₀ and −τ₁ are the end tangents of [`ChordAngles`]. For a constant τ it is an arc at
/// constant speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CircleBlend {
    /// Mean of τ₀ and τ₁.
    mean: f64,
    /// Half of τ₀ − τ₁.
    half: f64,
}

impl CircleBlend {
    /// The blend with these end tangents, of magnitude less than π.
    pub fn new(angles: ChordAngles) -> Self {
        let ChordAngles { theta0, theta1 } = angles;
        CircleBlend { mean: -(theta0 + theta1) / 2.0, half: (theta1 - theta0) / 2.0 }
    }

    /// Whether it is a circular arc, to rounding.
    pub(super) fn is_arc(&self) -> bool {
        self.half.abs() <= f64::EPSILON * (1.0 + self.mean.abs())
    }

    /// N Taylor coefficients of P about u.
    fn series<const N: usize>(&self, u: f64) -> [Complex64; N] {
        /// Smaller angles are divided by: sin x = x sinc x.
        const SMALL: f64 = 0.5;
        /// For larger ones, the sine has its digits from what is left to ±π.
        const LARGE: f64 = 2.0;
        let (sine, cosine) = (PI * u).sin_cos();
        let mut power = self.half;
        // τ less its mean.
        let swing: Series<N> = std::array::from_fn(|n| {
            if n > 0 {
                power *= PI / n as f64;
            }
            power * [cosine, -sine, -cosine, sine][n % 4]
        });
        let mut tau = swing;
        tau[0] += self.mean;
        let linear = |at: f64, slope: f64| -> Series<N> {
            std::array::from_fn(|n| [at, slope].get(n).copied().unwrap_or(0.0))
        };
        let rest = product(&linear(1.0 - u, -1.0), &tau);
        let size = if tau[0].abs() < SMALL {
            let part = product(&linear(u, 1.0), &tau);
            let (above, below) = (compose(&sinc(part[0]), &part), compose(&sinc(tau[0]), &tau));
            product(&linear(u, 1.0), &quotient(&above, &below))
        } else if tau[0].abs() < LARGE {
            quotient(&sine_of(&product(&linear(u, 1.0), &tau)), &sine_of(&tau))
        } else {
            let mut left = swing.map(|c| -c);
            left[0] += PI.copysign(tau[0]) - self.mean;
            let above = if u < 0.5 {
                product(&linear(u, 1.0), &tau)
            } else {
                std::array::from_fn(|n| left[n] + rest[n])
            };
            quotient(&sine_of(&above), &sine_of(&left))
        };
        let turn: [Complex64; N] = cis(&rest);
        std::array::from_fn(|n| (0..=n).map(|j| turn[n - j] * size[j]).sum())
    }
}

fn sine_of<const N: usize>(angle: &Series<N>) -> Series<N> {
    cis(angle).map(|e| e.im)
}

impl ParametricCurve for CircleBlend {
    fn point(&self, u: f64) -> Complex64 {
        // Both ends are exact without this but for the sign of zero.
        if u == 0.0 { Complex64::ZERO } else { self.series::<1>(u)[0] }
    }

    fn velocity_series(&self, u: f64) -> [Complex64; 5] {
        let point = self.series::<6>(u);
        std::array::from_fn(|n| point[n + 1] * (n + 1) as f64)
    }

    fn velocity(&self, u: f64) -> Complex64 {
        self.series::<2>(u)[1]
    }

    fn bezier(&self, _from: f64, _to: f64) -> Option<PathSeg> {
        None
    }
}
