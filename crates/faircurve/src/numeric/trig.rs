//! Sine and cosine together, without branches, so that loops over nodes vectorise and every
//! platform computes the same bits.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, PI as HALF_TURN};

use num_complex::Complex64;

/// π in two parts, the first with so few bits (33) that its product with a number of half turns
/// below 2²⁰ is exact (Cody and Waite).
const PI: [f64; 2] = [3.141_592_653_468_251_2, 1.215_420_101_301_238_4e-10];

/// Adding this rounds a number below 2⁵¹ to an integer, which then stands in the low bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// (sin r / r − 1) / r² by powers of r²: the polynomial that agrees with it at the eight Chebyshev
/// nodes of 0 ≤ r² ≤ (π/2)²; with these rounded coefficients sin r is off by at most 4e-17.
const SINE: [f64; 8] = [
    -0.166_666_666_666_666_66,
    0.008_333_333_333_333_316,
    -0.000_198_412_698_412_549_74,
    2.755_731_921_916_323_4e-6,
    -2.505_210_761_699_618_2e-8,
    1.605_897_731_246_408_7e-10,
    -7.643_970_296_798_572e-13,
    2.731_444_766_986_399_5e-15,
];

/// (cos r − 1) / r² likewise; cos r is off by at most 2e-17.
const COSINE: [f64; 8] = [
    -0.5,
    0.041_666_666_666_666_34,
    -0.001_388_888_888_886_070_9,
    2.480_158_729_244_621_3e-5,
    -2.755_731_776_732_053e-7,
    2.087_663_086_742_299_4e-9,
    -1.146_468_988_572_002_9e-11,
    4.627_675_985_018_171_6e-14,
];

/// `(sin x, cos x)` to 3e-16 absolute for |x| ≤ 3·10⁶ and to x · 3e-16 up to 10¹⁵. Beyond that,
/// the result has no meaning and need not be finite.
#[inline(always)]
pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
    // x = half_turns · π + r, |r| ≤ π/2.
    let shifted = x * FRAC_1_PI + ROUNDER;
    let half_turns = shifted - ROUNDER;
    let r = (x - half_turns * PI[0]) - half_turns * PI[1];
    let q = r * r;
    let q2 = q * q;
    let q4 = q2 * q2;
    // Estrin's order of operations: a shorter chain of dependent ones than Horner's.
    let [c0, c1, c2, c3, c4, c5, c6, c7] = SINE;
    let sine = ((c0 + c1 * q) + (c2 + c3 * q) * q2) + ((c4 + c5 * q) + (c6 + c7 * q) * q2) * q4;
    let sine = r + r * (q * sine);
    let [c0, c1, c2, c3, c4, c5, c6, c7] = COSINE;
    let rest = ((c1 + c2 * q) + (c3 + c4 * q) * q2) + ((c5 + c6 * q) + c7 * q2) * q4;
    let cosine = (1.0 + c0 * q) + rest * q2;
    // An odd number of half turns negates both.
    let sign = shifted.to_bits() << 63;
    (f64::from_bits(sine.to_bits() ^ sign), f64::from_bits(cosine.to_bits() ^ sign))
}

/// The same for |x| ≤ 0.4, to 2e-16, by two thirds of the operations: Taylor's series, whose next terms are
/// below 3e-17.
#[inline(always)]
pub(crate) fn sin_cos_of_small(x: f64) -> (f64, f64) {
    const SINE: [f64; 6] = [
        -1.0 / 6.0,
        1.0 / 120.0,
        -1.0 / 5040.0,
        1.0 / 362_880.0,
        -1.0 / 39_916_800.0,
        1.0 / 6_227_020_800.0,
    ];
    const COSINE: [f64; 6] =
        [-0.5, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0, -1.0 / 3_628_800.0, 1.0 / 479_001_600.0];
    let q = x * x;
    let q2 = q * q;
    let series = |[c0, c1, c2, c3, c4, c5]: [f64; 6]| {
        (c0 + c1 * q) + ((c2 + c3 * q) + (c4 + c5 * q) * q2) * q2
    };
    (x + x * (q * series(SINE)), 1.0 + q * series(COSINE))
}

/// e^{i·angle}, with the errors of [`sin_cos`].
#[inline(always)]
pub(crate) fn cis(angle: f64) -> Complex64 {
    let (sin, cos) = sin_cos(angle);
    Complex64::new(cos, sin)
}

/// The same for any finite angle. Beyond 10¹⁵, where numbers are an eighth of a radian apart and more, that of 10¹⁵.
#[inline(never)] // for the size of the web's module
pub(crate) fn unit_vector(angle: f64) -> Complex64 {
    cis(angle.clamp(-1e15, 1e15))
}

/// arctan(i/4) for i from 0 to 4.
const ARCTAN_OF_QUARTERS: [f64; 5] =
    [0.0, 0.244_978_663_126_864_15, 0.463_647_609_000_806_1, 0.643_501_108_793_284_4, FRAC_PI_4];

/// The argument of `z`, in [−π, π], to 4e-16 and to three last places of itself; sooner where it is small.
#[inline]
pub(crate) fn argument(z: Complex64) -> f64 {
    if z.im.abs() < 0.125 * z.re { small_arctan(z.im / z.re) } else { large_argument(z) }
}

/// Of tangents up to 1/8, for which these terms are enough.
#[inline(always)]
fn small_arctan(tangent: f64) -> f64 {
    let [c0, c1, c2, c3, c4, c5, c6, c7, c8] =
        [1.0, 3.0, 5.0, 7.0, 9.0, 11.0, 13.0, 15.0, 17.0].map(|n| 1.0 / n);
    let q = -tangent * tangent;
    let (q2, q4) = (q * q, q * q * (q * q));
    let low = (c1 + c2 * q) + (c3 + c4 * q) * q2;
    let high = (c5 + c6 * q) + (c7 + c8 * q) * q2;
    tangent * (c0 + q * (low + high * q4))
}

#[inline(never)] // for the size of the web's module
fn large_argument(z: Complex64) -> f64 {
    let (x, y) = (z.re.abs(), z.im.abs());
    let (small, large) = if y > x { (x, y) } else { (y, x) };
    if !(1e-290..1e290).contains(&large) && large > 0.0 {
        let scale = (if large < 1.0 { 600f64 } else { -600.0 }).exp2();
        let near = |part: f64| part.clamp(f64::MIN, f64::MAX) * scale;
        return large_argument(Complex64::new(near(z.re), near(z.im)));
    }
    // Turned back by the nearest of those: a tangent of at most 1/8.
    let above = |middle: f64| usize::from(small > middle * large);
    let nearest = above(0.125) + above(0.375) + above(0.625) + above(0.875);
    let quarter = 0.25 * nearest as f64;
    let tangent =
        if large == 0.0 { 0.0 } else { (small - quarter * large) / (large + quarter * small) };
    let angle = ARCTAN_OF_QUARTERS[nearest] + small_arctan(tangent);
    let angle = if y > x { FRAC_PI_2 - angle } else { angle };
    let angle = if z.re.is_sign_negative() { HALF_TURN - angle } else { angle };
    angle.copysign(z.im)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The library's own value is rounded to half a last place.
    #[test]
    fn the_argument_is_that_of_the_standard_library() {
        for i in -4000..=4000 {
            let angle = f64::from(i) / 4000.0;
            for angle in [angle * 1e-9, angle * 0.14, angle * 0.8, angle * 3.1] {
                for size in [1e-280, 2.5, 1e280] {
                    let z = Complex64::from_polar(size, angle);
                    let off = (argument(z) - z.arg()).abs();
                    assert!(off <= 4.5e-16 && off <= 7e-16 * angle.abs(), "{angle} {off:e}");
                }
            }
        }
        assert!(argument(Complex64::new(f64::NAN, 0.0)).is_nan());
    }

    #[test]
    fn arguments_of_axes_and_diagonals_are_exact_and_odd() {
        let values = [0.0, -0.0, 1.0, -1.0, 5e-324, 1e-300, f64::MAX];
        for (x, y) in values.into_iter().flat_map(|x| values.map(|y| (x, y))) {
            let z = Complex64::new(x, y);
            assert_eq!(argument(z).to_bits(), z.arg().to_bits(), "{z}");
            assert_eq!(argument(z.conj()), -argument(z), "{z}");
        }
        assert!(argument(Complex64::new(f64::INFINITY, 1.0)).is_finite());
    }

    #[test]
    fn sines_of_small_numbers_are_those_of_all() {
        for i in -4000..=4000 {
            let x = 1e-4 * f64::from(i);
            let ((sin, cos), known) = (sin_cos_of_small(x), x.sin_cos());
            assert!(
                (sin - known.0).abs() <= 2e-16 * x.abs() && (cos - known.1).abs() <= 2e-16,
                "{x}"
            );
        }
    }

    #[test]
    fn large_angles_keep_what_rounding_leaves_of_them() {
        for decade in 0..=308 {
            for digits in [1.0, -2.3, 7.77, 9.999_999] {
                let angle = digits * 10f64.powi(decade);
                let vector = unit_vector(angle);
                let off = (vector - Complex64::cis(angle)).norm();
                assert!(off <= 4e-16 + 3e-16 * angle.abs() || angle.abs() > 1e15, "{angle}: {off}");
                assert!((vector.norm() - 1.0).abs() < 1e-3, "{angle}: {vector}");
            }
        }
    }

    #[test]
    fn agrees_with_the_standard_library_over_decades() {
        // The library's own value is rounded to half a last place of 1.
        const BOUND: f64 = 3e-16 + 0.56e-16;
        for decade in -12..=6 {
            for i in 0..4000 {
                let x = 10f64.powi(decade) * (f64::from(i) / 2000.0 - 1.0);
                let (sin, cos) = sin_cos(x);
                assert!((sin - x.sin()).abs() <= BOUND, "sin {x}: {sin} {}", x.sin());
                assert!((cos - x.cos()).abs() <= BOUND, "cos {x}: {cos} {}", x.cos());
            }
        }
    }
}
