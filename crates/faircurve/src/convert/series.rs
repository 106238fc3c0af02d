//! A short piece of a polynomial spiral as a power series about its middle.
//!
//! The frame: origin at the middle, the tangent there along +x, half the arc length as the unit. With
//! w = z′ = e^{iθ(x)} the curve's equation z″ = iκz′ is a recurrence for the coefficients of w,
//! (n + 1)·wₙ₊₁ = i Σⱼ κⱼ wₙ₋ⱼ, κⱼ those of the curvature by powers of x, x ∈ [−1, 1].

use num_complex::Complex64;

use crate::numeric::spiro_integral::sub_parameters;

/// Coefficients of a series: degree 24 is that of a cubic after a substitution of degree 8, with
/// which the [certificate](super::certificate) compares it. A piece that turns by 3 radians needs
/// about 20 for full precision.
pub(super) const TERMS: usize = 25;

/// 1/n.
const RECIPROCAL: [f64; TERMS + 1] = {
    let mut table = [0.0; TERMS + 1];
    let mut n = 1;
    while n <= TERMS {
        table[n] = 1.0 / n as f64;
        n += 1;
    }
    table
};

/// A complex polynomial Σ cₙ xⁿ, real and imaginary parts apart so that loops vectorise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polynomial {
    pub(super) re: [f64; TERMS],
    pub(super) im: [f64; TERMS],
}

impl Polynomial {
    pub(super) const ZERO: Polynomial = Polynomial { re: [0.0; TERMS], im: [0.0; TERMS] };

    /// The values at ±`x`.
    pub(super) fn pair(&self, x: f64) -> [Complex64; 2] {
        let q = x * x;
        let (mut even_re, mut even_im, mut odd_re, mut odd_im) =
            (self.re[TERMS - 1], self.im[TERMS - 1], 0.0, 0.0);
        for n in (0..TERMS / 2).rev() {
            odd_re = odd_re * q + self.re[2 * n + 1];
            odd_im = odd_im * q + self.im[2 * n + 1];
            even_re = even_re * q + self.re[2 * n];
            even_im = even_im * q + self.im[2 * n];
        }
        let (even, odd) = (Complex64::new(even_re, even_im), Complex64::new(odd_re, odd_im) * x);
        [even + odd, even - odd]
    }

    /// The values at several ±x at once.
    pub(super) fn pairs<const N: usize>(&self, x: &[f64; N]) -> [[Complex64; 2]; N] {
        let mut sums = [[0.0; 4]; N];
        let top = TERMS - 1;
        for i in 0..N {
            sums[i] = [self.re[top], self.im[top], 0.0, 0.0];
        }
        for n in (0..TERMS / 2).rev() {
            let next = [self.re[2 * n], self.im[2 * n], self.re[2 * n + 1], self.im[2 * n + 1]];
            for i in 0..N {
                let q = x[i] * x[i];
                for part in 0..4 {
                    sums[i][part] = sums[i][part] * q + next[part];
                }
            }
        }
        let mut values = [[Complex64::ZERO; 2]; N];
        for i in 0..N {
            let [even_re, even_im, odd_re, odd_im] = sums[i];
            let even = Complex64::new(even_re, even_im);
            let odd = Complex64::new(odd_re, odd_im) * x[i];
            values[i] = [even + odd, even - odd];
        }
        values
    }
}

/// A piece of a spiral: its points z(x), x ∈ [−1, 1], in the frame of its middle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Series {
    /// z(x).
    pub(super) z: Polynomial,
    /// Curvature by powers of x.
    pub(super) kappa: [f64; 4],
    /// A bound of what the dropped terms of z add up to, anywhere on the piece.
    pub(super) tail: f64,
}

impl Series {
    /// The piece of the spiral `k` (eq. 8.1) of the given middle and width, both for arc length 1.
    pub(super) fn new(k: [f64; 4], middle: f64, width: f64) -> Self {
        Series::of_curvature(Series::curvature_of(k, middle, width))
    }

    /// Curvature of the same piece by powers of x.
    pub(super) fn curvature_of(k: [f64; 4], middle: f64, width: f64) -> [f64; 4] {
        let local = sub_parameters(k, middle, width);
        // From arc length 1 to half length 1, and from derivatives to coefficients.
        [local[0] / 2.0, local[1] / 4.0, local[2] / 16.0, local[3] / 96.0]
    }

    /// The piece whose curvature has these coefficients, in units of its half length.
    pub(super) fn of_curvature(kappa: [f64; 4]) -> Self {
        let [c0, c1, c2, c3] = kappa;
        let mut z = Polynomial::ZERO;
        // The last four coefficients of w, the latest first.
        let (mut re, mut im) = ([1.0, 0.0, 0.0, 0.0], [0.0; 4]);
        z.re[1] = 1.0;
        for n in 0..TERMS - 2 {
            let scale = RECIPROCAL[n + 1];
            // The latest coefficient last: it is the one that the sum waits for.
            let next_re = -((c3 * im[3] + c2 * im[2] + c1 * im[1]) + c0 * im[0]) * scale;
            let next_im = ((c3 * re[3] + c2 * re[2] + c1 * re[1]) + c0 * re[0]) * scale;
            re = [next_re, re[0], re[1], re[2]];
            im = [next_im, im[0], im[1], im[2]];
            z.re[n + 2] = next_re * RECIPROCAL[n + 2];
            z.im[n + 2] = next_im * RECIPROCAL[n + 2];
        }
        Series { z, kappa, tail: tail(kappa, re, im) }
    }

    /// The direction at x relative to that of the middle.
    pub(super) fn angle(&self, x: f64) -> f64 {
        let [c0, c1, c2, c3] = self.kappa;
        x * (c0 + x * (c1 / 2.0 + x * (c2 / 3.0 + x * c3 / 4.0)))
    }

    /// Curvature at x.
    pub(super) fn curvature(&self, x: f64) -> f64 {
        let [c0, c1, c2, c3] = self.kappa;
        c0 + x * (c1 + x * (c2 + x * c3))
    }
}

/// Let m be the largest of the last four coefficients of w (to degree N − 2, N = [`TERMS`]) and K = Σ|κⱼ|. By the
/// recurrence each of the next four is at most q·m with q = K/(N − 1), each of the four after them at most q²·m, and so
/// on: if q < 1 they add up to at most 4m·q/(1 − q), and in z, where each is divided by its degree, to a part of N
/// of that.
fn tail(kappa: [f64; 4], re: [f64; 4], im: [f64; 4]) -> f64 {
    let largest = re.iter().chain(&im).fold(0.0f64, |m, c| m.max(c.abs())) * 2.0;
    let q = kappa.iter().map(|c| c.abs()).sum::<f64>() / (TERMS - 1) as f64;
    if q < 1.0 { 4.0 * largest * q / (1.0 - q) / TERMS as f64 } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::spiro_integral::{angle, spiro_integral_between};

    #[test]
    fn agrees_with_the_integral_within_the_tail() {
        let shapes = [
            [1.5, 0.0, 0.0, 0.0],
            [3.0, 0.0, 0.0, 0.0],
            [0.0, 2.4, 0.0, 0.0],
            [-3.0, 6.0, 9.0, -20.0],
            [0.1, 3.0, -60.0, 300.0],
            [20.0, 0.0, 0.0, 0.0],
        ];
        for k in shapes {
            for (middle, width) in [(0.0, 1.0), (0.2, 0.3), (-0.4, 0.2)] {
                let series = Series::new(k, middle, width);
                let turn = Complex64::from_polar(2.0 / width, -angle(k, middle));
                for x in [0.0, 0.3, 0.7, 1.0] {
                    let far = middle + x * width / 2.0;
                    let near = middle - x * width / 2.0;
                    let exact = [far, near].map(|s| spiro_integral_between(k, middle, s) * turn);
                    for (value, exact) in series.z.pair(x).into_iter().zip(exact) {
                        let error = (value - exact).norm();
                        assert!(error <= series.tail + 4e-15, "{k:?} {x}: {error:e}");
                    }
                    let both = series.z.pairs(&[x])[0];
                    assert!((both[0] - exact[0]).norm() <= series.tail + 4e-15);
                }
            }
        }
        assert!(Series::new(shapes[1], 0.0, 1.0).tail < 1e-15);
    }
}
