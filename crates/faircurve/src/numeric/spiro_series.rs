//! Polynomial approximations of the spiro integral (thesis sections 8.1.1–8.1.3): Taylor's series
//! of e^{iθ(s)} about the middle, kept through s², s⁴, … or s¹⁶ and integrated term by term, with
//! subdivision where one polynomial isn't enough.
//!
//! The thesis synthesises one program for each order, from the powers of θ as vectors of
//! coefficients. Here one function serves every order and computes the same polynomials: y =
//! e^{iθ} satisfies y′ = iκy, so that Leibniz's rule gives each derivative at the middle from the
//! four before it,
//!
//! y⁽ⁿ⁺¹⁾ = i·(k₀y⁽ⁿ⁾ + n·k₁y⁽ⁿ⁻¹⁾ + n(n−1)/2·k₂y⁽ⁿ⁻²⁾ + n(n−1)(n−2)/6·k₃y⁽ⁿ⁻³⁾),
//!
//! and of s²ʲ y⁽²ʲ⁾/(2j)! over [−½, ½] remains y⁽²ʲ⁾/(4ʲ(2j+1)!), of odd powers nothing. The order is
//! a constant of the type, the loops unroll.
//!
//! The rest of the library integrates by [`spiro_integral`](super::spiro_integral), which needs
//! less time for the same precision (figure 8.1, `examples/figure_8_1.rs`); this module is its
//! independent check.

use num_complex::Complex64;

use super::spiro_integral::{angle, sub_parameters};
use super::trig::cis;

/// The spiro integral of eq. 8.1 by the polynomial that keeps the terms of e^{iθ} through
/// s^`ORDER`; `ORDER` is even, from 2 to 16 (checked when compiled).
///
/// Order 2 is eq. 8.11, order 4 eq. 8.12, order 8 the worked example of section 8.1.2. The error is
/// about the first term left out, |y⁽ⁿ⁾| / (2ⁿ(n + 1)!) for n = `ORDER` + 2; eq. 8.14 estimates it
/// for order 10. Large arguments give large nonsense, and overflow.
///
/// ```
/// use faircurve::numeric::spiro_series::spiro_series;
/// let [k0, k1] = [0.1, 0.2];
/// let z = spiro_series::<2>([k0, k1, 0.3, 0.4]);
/// assert!((z.re - (1.0 - k0 * k0 / 24.0)).abs() < 1e-16 && (z.im - k1 / 24.0).abs() < 1e-16);
/// ```
#[inline(always)]
pub fn spiro_series<const ORDER: usize>(k: [f64; 4]) -> Complex64 {
    const { assert!(ORDER >= 2 && ORDER <= 16 && ORDER.is_multiple_of(2), "an even order from 2 to 16") };
    // The last four derivatives, the latest first; zeros ahead of y⁽⁰⁾ = 1.
    let mut y = [Complex64::ONE, Complex64::ZERO, Complex64::ZERO, Complex64::ZERO];
    let mut sum = Complex64::ONE;
    for n in 0..ORDER {
        let [c1, c2, c3] = BINOMIALS[n];
        let next = y[0] * k[0] + (y[1] * (c1 * k[1]) + (y[2] * (c2 * k[2]) + y[3] * (c3 * k[3])));
        y = [Complex64::new(-next.im, next.re), y[0], y[1], y[2]];
        if n % 2 == 1 {
            sum += y[0] * WEIGHTS[n / 2];
        }
    }
    sum
}

/// n, n(n−1)/2, n(n−1)(n−2)/6 for n = 0 … 15.
const BINOMIALS: [[f64; 3]; 16] = {
    let mut binomials = [[0.0; 3]; 16];
    let mut n = 1;
    while n < 16 {
        let [c1, c2, c3] = binomials[n - 1];
        binomials[n] = [c1 + 1.0, c2 + c1, c3 + c2];
        n += 1;
    }
    binomials
};

/// 1/(4ʲ(2j + 1)!) for j = 1 … 8.
const WEIGHTS: [f64; 8] = {
    let mut weights = [0.0; 8];
    let mut denominator = 1.0;
    let mut j = 1;
    while j <= 8 {
        denominator *= 4.0 * (2 * j * (2 * j + 1)) as f64;
        weights[j - 1] = 1.0 / denominator;
        j += 1;
    }
    weights
};

/// The hybrid of section 8.1.3: the sum of [`spiro_series`] over `pieces` equal pieces, each
/// reduced to the same integral by eq. 8.3. No pieces count as one.
///
/// The error falls like `pieces`^−(ORDER+2) until only rounding is left: a few 1e-16, more for
/// thousands of pieces.
///
/// ```
/// use faircurve::numeric::spiro_integral::spiro_integral;
/// use faircurve::numeric::spiro_series::spiro_series_subdivided;
/// let k = [1.0, 2.0, 3.0, 4.0];
/// assert!((spiro_series_subdivided::<12>(k, 8) - spiro_integral(k)).norm() < 1e-15);
/// ```
pub fn spiro_series_subdivided<const ORDER: usize>(k: [f64; 4], pieces: usize) -> Complex64 {
    if pieces <= 1 {
        return spiro_series::<ORDER>(k);
    }
    let width = 1.0 / pieces as f64;
    let mut sum = Complex64::ZERO;
    for piece in 0..pieces {
        let middle = (piece as f64 + 0.5) * width - 0.5;
        sum += cis(angle(k, middle)) * spiro_series::<ORDER>(sub_parameters(k, middle, width));
    }
    sum * width
}

/// [`spiro_series_subdivided`] of one order.
pub type SubdividedSeries = fn([f64; 4], usize) -> Complex64;

/// Every order with its function, for a choice at run time.
pub const ORDERS: [(usize, SubdividedSeries); 8] = [
    (2, spiro_series_subdivided::<2>),
    (4, spiro_series_subdivided::<4>),
    (6, spiro_series_subdivided::<6>),
    (8, spiro_series_subdivided::<8>),
    (10, spiro_series_subdivided::<10>),
    (12, spiro_series_subdivided::<12>),
    (14, spiro_series_subdivided::<14>),
    (16, spiro_series_subdivided::<16>),
];

#[cfg(test)]
mod tests {
    use super::super::spiro_integral::spiro_integral;
    use super::*;

    const ARGUMENTS: [[f64; 4]; 5] = [
        [1.0, 2.0, 3.0, 4.0],
        [-0.7, 1.1, 5.0, -8.0],
        [2.3, 0.0, 0.0, 0.0],
        [0.0, -3.0, 0.0, 9.0],
        [0.4, 1.0, -6.0, 20.0],
    ];

    #[test]
    fn orders_2_and_4_are_the_printed_formulas() {
        for k @ [k0, k1, k2, k3] in ARGUMENTS {
            // Eq. 8.11.
            let order_2 = Complex64::new(1.0 - k0 * k0 / 24.0, k1 / 24.0);
            assert!((spiro_series::<2>(k) - order_2).norm() < 1e-15);
            // Eq. 8.12.
            let order_4 = order_2
                + Complex64::new(
                    k0.powi(4) - 4.0 * k0 * k2 - 3.0 * k1 * k1,
                    k3 - 6.0 * k0 * k0 * k1,
                ) / 1920.0;
            assert!((spiro_series::<4>(k) - order_4).norm() < 1e-15);
        }
    }

    /// The worked example of section 8.1.2, derived anew (the printed one is garbled): t_mn is the
    /// coefficient of sⁿ in θᵐ; sⁿ integrates to 1/(2ⁿ(n + 1)), and θᵐ has the factor iᵐ/m!.
    fn worked_example(k: [f64; 4]) -> Complex64 {
        let [t11, t12, t13, t14] = [k[0], k[1] / 2.0, k[2] / 6.0, k[3] / 24.0];
        let t22 = t11 * t11;
        let t23 = 2.0 * t11 * t12;
        let t24 = 2.0 * t11 * t13 + t12 * t12;
        let t25 = 2.0 * (t11 * t14 + t12 * t13);
        let t26 = 2.0 * t12 * t14 + t13 * t13;
        let t27 = 2.0 * t13 * t14;
        let t28 = t14 * t14;
        let t34 = t22 * t12 + t23 * t11;
        let t36 = t22 * t14 + t23 * t13 + t24 * t12 + t25 * t11;
        let t38 = t24 * t14 + t25 * t13 + t26 * t12 + t27 * t11;
        let t44 = t22 * t22;
        let t45 = 2.0 * t22 * t23;
        let t46 = 2.0 * t22 * t24 + t23 * t23;
        let t47 = 2.0 * (t22 * t25 + t23 * t24);
        let t48 = 2.0 * (t22 * t26 + t23 * t25) + t24 * t24;
        let t56 = t44 * t12 + t45 * t11;
        let t58 = t44 * t14 + t45 * t13 + t46 * t12 + t47 * t11;
        let t66 = t44 * t22;
        let t67 = t44 * t23 + t45 * t22;
        let t68 = t44 * t24 + t45 * t23 + t46 * t22;
        let t78 = t66 * t12 + t67 * t11;
        let t88 = t66 * t22;
        let u = 1.0 - t22 / 24.0 - t24 / 160.0 - t26 / 896.0 - t28 / 4608.0
            + t44 / 1920.0
            + t46 / 10752.0
            + t48 / 55296.0
            - t66 / 322_560.0
            - t68 / 1_658_880.0
            + t88 / 92_897_280.0;
        let v = t12 / 12.0 + t14 / 80.0 - t34 / 480.0 - t36 / 2688.0 - t38 / 13824.0
            + t56 / 53760.0
            + t58 / 276_480.0
            - t78 / 11_612_160.0;
        Complex64::new(u, v)
    }

    #[test]
    fn order_8_is_the_worked_example() {
        for k in ARGUMENTS {
            let difference = spiro_series::<8>(k) - worked_example(k);
            assert!(difference.norm() < 1e-15, "{k:?}: {difference}");
        }
    }

    #[test]
    fn small_cases_are_exact() {
        for (order, series) in ORDERS {
            assert_eq!(series([0.0; 4], 1), Complex64::ONE, "order {order}");
            assert_eq!(series([0.0; 4], 0), Complex64::ONE, "order {order}");
        }
        // An arc is sin(k₀/2)/(k₀/2): the series of the sine, term by term.
        let mut term = 1.0;
        let mut sine = 1.0;
        for (order, series) in ORDERS {
            term *= -0.25 / (order * (order + 1)) as f64;
            sine += term;
            assert!((series([1.0, 0.0, 0.0, 0.0], 1) - sine).norm() < 1e-16, "order {order}");
        }
    }

    #[test]
    fn doubling_the_pieces_divides_the_error_by_two_to_the_order_plus_two() {
        for k in ARGUMENTS {
            let exact = spiro_integral(k);
            for (order, series) in ORDERS {
                // From where the error follows its law to where rounding takes over.
                let error = |pieces: usize| (series(k, pieces) - exact).norm();
                let mut measured = 0;
                for pieces in [4, 8, 16, 32, 64, 128, 256] {
                    let (coarse, fine) = (error(pieces), error(2 * pieces));
                    if fine < 3e-14 {
                        break;
                    }
                    let rate = (coarse / fine).log2();
                    let expected = (order + 2) as f64;
                    assert!((rate - expected).abs() < 0.6, "{k:?} {order} {pieces}: {rate}");
                    measured += 1;
                }
                assert!(measured > 0 || order >= 8, "{k:?}: order {order} was not measured");
            }
        }
    }

    #[test]
    fn every_order_converges_to_the_integral() {
        for k in ARGUMENTS {
            for (order, series) in ORDERS {
                let pieces = match order {
                    2 => 1 << 13,
                    4 => 1 << 9,
                    _ => 64,
                };
                let error = (series(k, pieces) - spiro_integral(k)).norm();
                assert!(error < 5e-15, "{k:?}, order {order}: {error:e}");
            }
        }
    }

    #[test]
    fn eq_8_14_estimates_the_error_of_order_10() {
        let estimate = |k: [f64; 4]| {
            (0.006 * k[0] * k[0]
                + 0.03 * k[1].abs()
                + 0.03 * k[2].abs().powf(2.0 / 3.0)
                + 0.025 * k[3].abs().sqrt())
            .powi(6)
        };
        for k in ARGUMENTS {
            let k = k.map(|k| 2.0 * k);
            let error = (spiro_series::<10>(k) - spiro_integral(k)).norm();
            let ratio = error / estimate(k);
            // A rough estimate, mostly on the safe side.
            assert!((0.001..3.0).contains(&ratio), "{k:?}: {error:e} {ratio}");
        }
    }
}
