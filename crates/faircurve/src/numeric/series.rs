//! Arithmetic with power series, cut after N terms: from the coefficients of functions of u to
//! those of what is made of them.

use num_complex::Complex64;

use super::trig::unit_vector;

/// Coefficients of the powers of u − u₀.
pub(crate) type Series<const N: usize> = [f64; N];

/// a·b.
pub(crate) fn product<const N: usize>(a: &Series<N>, b: &Series<N>) -> Series<N> {
    std::array::from_fn(|n| (0..=n).map(|j| a[j] * b[n - j]).sum())
}

/// a/b; b must not start with 0.
pub(crate) fn quotient<const N: usize>(a: &Series<N>, b: &Series<N>) -> Series<N> {
    let mut q = [0.0; N];
    for n in 0..N {
        let known: f64 = (1..=n).map(|j| b[j] * q[n - j]).sum();
        q[n] = (a[n] - known) / b[0];
    }
    q
}

/// e^{ia}: from its derivative, ia′e^{ia}.
pub(crate) fn cis<const N: usize>(a: &Series<N>) -> [Complex64; N] {
    let mut e = [unit_vector(a[0]); N];
    for n in 1..N {
        let sum: Complex64 = (1..=n).map(|j| e[n - j] * (a[j] * j as f64)).sum();
        e[n] = Complex64::new(-sum.im, sum.re) / n as f64;
    }
    e
}

/// f(a), where f is given by its own series about a's first coefficient.
pub(crate) fn compose<const N: usize>(f: &Series<N>, a: &Series<N>) -> Series<N> {
    let mut step = *a;
    step[0] = 0.0;
    let mut sum = [0.0; N];
    for coefficient in f.iter().rev() {
        sum = product(&sum, &step);
        sum[0] += coefficient;
    }
    sum
}

/// The series of sin x / x about x, for |x| ≤ 1, to about 1e-16.
pub(crate) fn sinc<const N: usize>(x: f64) -> Series<N> {
    /// The first power left out adds less than 1/19! = 8e-18.
    const POWERS: i32 = 9;
    let square: Series<N> = std::array::from_fn(|n| match n {
        0 => x * x,
        1 => 2.0 * x,
        2 => 1.0,
        _ => 0.0,
    });
    // Σ (−1)ᵏ x²ᵏ/(2k+1)! by Horner's rule.
    let mut series = [0.0; N];
    for k in (0..POWERS).rev() {
        let fraction = 1.0 / f64::from((2 * k + 2) * (2 * k + 3));
        series = product(&series, &square).map(|c| -c * fraction);
        series[0] += 1.0;
    }
    series
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(series: &[f64], t: f64) -> f64 {
        series.iter().rev().fold(0.0, |sum, c| sum * t + c)
    }

    /// Every function against itself nearby, where the terms left out are below rounding.
    #[test]
    fn series_are_those_of_the_functions() {
        let t = 1e-3;
        let (a, b) = ([0.7, 1.0, -0.5, 0.2, 0.1, -0.3], [1.3, -0.4, 2.0, 0.0, 0.6, 0.1]);
        let (at_a, at_b) = (at(&a, t), at(&b, t));
        assert!((at(&product(&a, &b), t) - at_a * at_b).abs() < 1e-15);
        assert!((at(&quotient(&a, &b), t) - at_a / at_b).abs() < 1e-15);
        let e = cis(&a);
        assert!((at(&e.map(|e| e.re), t) - at_a.cos()).abs() < 1e-15);
        assert!((at(&e.map(|e| e.im), t) - at_a.sin()).abs() < 1e-15);
        let squared = [0.49, 1.4, 1.0, 0.0, 0.0, 0.0];
        assert!((at(&compose(&squared, &a), t) - at_a * at_a).abs() < 1e-15);
    }

    #[test]
    fn sinc_is_exact_at_zero_and_close_elsewhere() {
        assert_eq!(sinc::<3>(0.0), [1.0, 0.0, -1.0 / 6.0]);
        for i in -20..=20 {
            let x = f64::from(i) * 0.05;
            let series = sinc::<6>(x);
            for t in [-1e-3, 0.0, 1e-3] {
                let y: f64 = x + t;
                let exact = if y == 0.0 { 1.0 } else { y.sin() / y };
                assert!((at(&series, t) - exact).abs() < 4e-16, "{x} {t}");
            }
        }
    }
}
