//! Numbers that carry their derivatives: formulas written once, for numbers of either kind, say
//! how they answer changes.

use std::ops::{Add, Div, Mul, Neg, Sub};

use num_complex::Complex64;

use super::trig::argument;

/// What formulas are written for: an `f64`, or one with derivatives.
pub(crate) trait Real:
    Copy
    + From<f64>
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// The number itself.
    fn value(self) -> f64;

    /// The square root of a number that isn't negative; at 0, derivatives are 0.
    fn sqrt(self) -> Self;

    /// The angle of the vector (`x`, self); at the origin, derivatives are 0.
    fn atan2(self, x: Self) -> Self;
}

impl Real for f64 {
    #[inline(always)]
    fn value(self) -> f64 {
        self
    }

    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }

    #[inline(never)] // for the size of the web's module
    fn atan2(self, x: f64) -> f64 {
        argument(Complex64::new(x, self))
    }
}

/// A number with its derivatives by N others (automatic differentiation, forwards).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dual<const N: usize> {
    pub(crate) value: f64,
    pub(crate) by: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// The variable of that index.
    #[inline(always)]
    pub(crate) fn variable(value: f64, index: usize) -> Self {
        let mut by = [0.0; N];
        by[index] = 1.0;
        Dual { value, by }
    }

    #[inline(always)]
    fn with(self, value: f64, slope: f64) -> Self {
        Dual { value, by: self.by.map(|by| by * slope) }
    }
}

impl<const N: usize> From<f64> for Dual<N> {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Dual { value, by: [0.0; N] }
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with(-self.value, -1.0)
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let by = std::array::from_fn(|i| self.by[i] + other.by[i]);
        Dual { value: self.value + other.value, by }
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let by = std::array::from_fn(|i| self.by[i] - other.by[i]);
        Dual { value: self.value - other.value, by }
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;

    /// By the product rule, which is a sum.
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the product rule is a sum")]
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let by = std::array::from_fn(|i| self.by[i] * other.value + self.value * other.by[i]);
        Dual { value: self.value * other.value, by }
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let inverse = 1.0 / other.value;
        let value = self.value * inverse;
        let by = std::array::from_fn(|i| (self.by[i] - value * other.by[i]) * inverse);
        Dual { value, by }
    }
}

impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Dual { value: self.value + other, ..self }
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self.with(self.value * other, other)
    }
}

impl<const N: usize> Real for Dual<N> {
    #[inline(always)]
    fn value(self) -> f64 {
        self.value
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.with(root, if root > 0.0 { 0.5 / root } else { 0.0 })
    }

    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        let squared = self.value * self.value + x.value * x.value;
        let inverse = if squared > 0.0 { 1.0 / squared } else { 0.0 };
        let by = std::array::from_fn(|i| (x.value * self.by[i] - self.value * x.by[i]) * inverse);
        Dual { value: Real::atan2(self.value, x.value), by }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_agree_with_differences() {
        fn formula<T: Real>(x: T, y: T) -> T {
            ((x * y + 2.0) / (y - x * 3.0)).sqrt() * 1.5 - x.atan2(-y * y)
        }
        let (x, y, h) = (0.3, 1.7, 1e-6);
        let exact = formula(Dual::<2>::variable(x, 0), Dual::variable(y, 1));
        assert_eq!(exact.value, formula(x, y));
        let by_x = (formula(x + h, y) - formula(x - h, y)) / (2.0 * h);
        let by_y = (formula(x, y + h) - formula(x, y - h)) / (2.0 * h);
        assert!((exact.by[0] - by_x).abs() < 1e-8 && (exact.by[1] - by_y).abs() < 1e-8);
    }

    #[test]
    fn roots_and_angles_of_nothing_have_no_slope() {
        let zero = Dual::<1>::variable(0.0, 0);
        assert_eq!(zero.sqrt(), Dual::from(0.0));
        assert_eq!(zero.atan2(zero), Dual::from(0.0));
    }
}
