//! The integral under everything (thesis section 8.1, eq. 8.1), with its first derivatives.
//!
//! With θ(s) = k₀s + k₁s²/2 + k₂s³/6 + k₃s⁴/24, the moments M_j = ∫_{−½}^{½} sʲ e^{iθ(s)} ds hold the
//! integral itself, M₀, and all its derivatives, ∂M₀/∂k_j = i·M_{j+1}/(j+1)!.
//!
//! Method: Gauss–Legendre quadrature on pairs of nodes ±s. Split θ into its even part E and odd
//! part O; then e^{iθ(s)} ± e^{iθ(−s)} = 2e^{iE}·(cos O, i sin O), so that even moments take the
//! cosine and odd ones the sine, and one pair of sine–cosine evaluations serves all five moments.
//! The integrand is entire, hence convergence is faster than geometric and the number of nodes
//! needed follows from one measure of the arguments ([`wildness`]). Beyond the largest rule the
//! interval is split into panels (eq. 8.3).

use num_complex::Complex64;

use super::gauss_legendre::{GAUSS_8, GAUSS_12, GAUSS_16, GAUSS_24, GAUSS_32, PairedRule};
use super::trig::{cis, sin_cos};

/// The moments M₀ … M₄ of e^{iθ(s)} over s ∈ [−½, ½].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpiroMoments(pub [Complex64; 5]);

impl SpiroMoments {
    /// The integral itself: the chord of a segment of arc length 1 in the frame of its middle.
    #[inline]
    pub fn integral(&self) -> Complex64 {
        self.0[0]
    }

    /// ∂/∂k_j of the integral, j = 0 … 3.
    #[inline]
    pub fn derivative(&self, j: usize) -> Complex64 {
        const FACTORIAL: [f64; 4] = [1.0, 2.0, 6.0, 24.0];
        Complex64::i() * self.0[j + 1] / FACTORIAL[j]
    }

    /// The moments after a small change of k₁, by Taylor's formula: ∂M_j/∂k₁ = i·M_{j+2}/2. The error of
    /// M₀ is of the third order in it, that of M₁ and M₂ of the second; M₃ and M₄ are left as they are.
    pub(crate) fn after_k1(self, change: f64) -> Self {
        let SpiroMoments([m0, m1, m2, m3, m4]) = self;
        let by = Complex64::new(0.0, change / 2.0);
        SpiroMoments([m0 + by * (m2 + by * m4 / 2.0), m1 + by * m3, m2 + by * m4, m3, m4])
    }
}

/// The spiro integral of eq. 8.1: curvature k₀ and its derivatives k₁, k₂, k₃ are those at the
/// middle of a segment of arc length 1.
///
/// Absolute error at most 1e-15 + 2e-16·[wildness]`(k)`, up to a wildness of 10⁶. Beyond that the
/// curve is too wound up to be worth integrating, and the result is 0. Arguments that aren't
/// finite give NaN.
///
/// ```
/// use faircurve::numeric::spiro_integral::spiro_integral;
/// let arc = spiro_integral([std::f64::consts::PI, 0.0, 0.0, 0.0]); // half a circle of length 1
/// assert!((arc.re - 2.0 / std::f64::consts::PI).abs() < 1e-15);
/// ```
pub fn spiro_integral(k: [f64; 4]) -> Complex64 {
    // Inlined, so that the moments beyond the first cost nothing.
    moments(k).integral()
}

/// A bound of the curvature over the segment: |k₀| + |k₁|/2 + |k₂|/8 + |k₃|/48.
#[inline]
pub fn wildness(k: [f64; 4]) -> f64 {
    k[0].abs() + k[1].abs() / 2.0 + k[2].abs() / 8.0 + k[3].abs() / 48.0
}

/// How fast the integrand can grow off the real axis, which decides how well a polynomial (hence
/// a quadrature rule) matches it: the bound of |θ(s)/s| over the complex circle |s| = 3/2. That
/// radius is the one at which k₀, k₁, k₂ and k₃, each alone, are equally hard for the small rules.
#[inline]
fn growth(k: [f64; 4]) -> f64 {
    k[0].abs() + 0.75 * k[1].abs() + 0.375 * k[2].abs() + 9.0 / 64.0 * k[3].abs()
}

// How far each rule reaches: the largest growth (for the small rules) or wildness (for the large
// ones, which err most near the ends, where the integrand turns fastest) up to which the
// truncation error of M₀ stays below 2e-16. Measured in 80-bit arithmetic against rules of twice
// to four times the size on 30 000 random directions of k, a third of the components zero; at
// these limits M₁ … M₃ err by less than 1e-15 and M₄ by less than 2e-14. The error rises like a
// high power of the argument (5e-16 is met 2 % to 25 % above), so that too large a limit shows in
// `error_stays_below_its_bound`.
const GROWTH_8: f64 = 0.2;
const GROWTH_12: f64 = 5.6;
const GROWTH_16: f64 = 16.0;
const WILDNESS_24: f64 = 24.0;
const WILDNESS_32: f64 = 58.0;

/// The largest wildness that is integrated: 17 242 panels.
const WILDEST: f64 = 1e6;

/// All five moments of eq. 8.1's integrand. M₀ has the error stated at [`spiro_integral`]; the
/// others, which serve as derivatives, are good to 2e-14 + 2e-16·[wildness]`(k)`.
pub fn spiro_moments(k: [f64; 4]) -> SpiroMoments {
    moments(k)
}

/// The largest wildness up to which each rule of 8, 12, 16, 24 and 32 nodes errs by at most 1e-7 in
/// every moment. Measured on 3000 random directions of k; k₃ alone is the hardest for the small
/// rules, k₀ alone for the large ones.
const ROUGH: [f64; 5] = [4.2, 18.0, 32.4, 58.2, 85.4];

/// The same to about 1e-7, up to three times as fast: for a search, which asks only where to look.
///
/// The moments are exact derivatives of M₀ as it is computed, but where the rule changes.
pub fn rough_spiro_moments(k: [f64; 4]) -> SpiroMoments {
    let wildness = wildness(k);
    if wildness <= ROUGH[0] {
        single_panel(&GAUSS_8, k)
    } else if wildness <= ROUGH[1] {
        single_panel(&GAUSS_12, k)
    } else if wildness <= ROUGH[2] {
        large_panel(&GAUSS_16, k)
    } else if wildness <= ROUGH[3] {
        large_panel(&GAUSS_24, k)
    } else if wildness <= ROUGH[4] {
        large_panel(&GAUSS_32, k)
    } else {
        wild_moments(k)
    }
}

#[inline(always)]
fn moments(k: [f64; 4]) -> SpiroMoments {
    let growth = growth(k);
    if growth <= GROWTH_8 {
        single_panel(&GAUSS_8, k)
    } else if growth <= GROWTH_12 {
        single_panel(&GAUSS_12, k)
    } else if growth <= GROWTH_16 {
        single_panel(&GAUSS_16, k)
    } else {
        wild_moments(k)
    }
}

/// The rest of [`moments`], apart so that the common case stays small.
#[inline(never)]
fn wild_moments(k: [f64; 4]) -> SpiroMoments {
    let wildness = wildness(k);
    if wildness <= WILDNESS_24 {
        large_panel(&GAUSS_24, k)
    } else if wildness <= WILDNESS_32 {
        large_panel(&GAUSS_32, k)
    } else if wildness <= WILDEST {
        panels(k, (wildness / WILDNESS_32).ceil() as usize)
    } else if k.iter().all(|k| k.is_finite()) {
        SpiroMoments([Complex64::ZERO; 5])
    } else {
        SpiroMoments([Complex64::new(f64::NAN, f64::NAN); 5])
    }
}

/// Quadrature over the whole interval with one rule.
#[inline(always)]
fn single_panel<const N: usize>(rule: &PairedRule<N>, k: [f64; 4]) -> SpiroMoments {
    let mut sum = SpiroMoments([Complex64::ZERO; 5]);
    add_nodes(&mut sum, &rule.nodes, &rule.pair_weights, k);
    sum
}

/// The same bits, for rules that are needed seldom: they share the program's code, four pairs at a time.
fn large_panel<const N: usize>(rule: &PairedRule<N>, k: [f64; 4]) -> SpiroMoments {
    const { assert!(N.is_multiple_of(4)) }
    sum_by_fours(rule.nodes.as_chunks().0, rule.pair_weights.as_chunks().0, k)
}

#[inline(never)]
fn sum_by_fours(nodes: &[[f64; 4]], pair_weights: &[[f64; 4]], k: [f64; 4]) -> SpiroMoments {
    let mut sum = SpiroMoments([Complex64::ZERO; 5]);
    nodes.iter().zip(pair_weights).for_each(|(s, weights)| add_nodes(&mut sum, s, weights, k));
    sum
}

/// Adds what some pairs of nodes contribute.
#[inline(always)]
fn add_nodes<const N: usize>(
    SpiroMoments(m): &mut SpiroMoments,
    nodes: &[f64; N],
    pair_weights: &[f64; N],
    k: [f64; 4],
) {
    // Written as passes over arrays, each of which vectorises.
    let [k0, k1, k2, k3] = [k[0], k[1] / 2.0, k[2] / 6.0, k[3] / 24.0];
    let mut even_cos = [0.0; N];
    let mut even_sin = [0.0; N];
    let mut odd_cos = [0.0; N];
    let mut odd_sin = [0.0; N];
    for i in 0..N {
        let s = nodes[i];
        let s2 = s * s;
        let (sin_e, cos_e) = sin_cos(s2 * (k1 + k3 * s2));
        let (sin_o, cos_o) = sin_cos(s * (k0 + k2 * s2));
        let (even, odd) = (pair_weights[i] * cos_o, pair_weights[i] * sin_o * s);
        even_cos[i] = even * cos_e;
        even_sin[i] = even * sin_e;
        odd_cos[i] = odd * cos_e;
        odd_sin[i] = odd * sin_e;
    }
    for i in 0..N {
        let s2 = nodes[i] * nodes[i];
        m[0] += Complex64::new(even_cos[i], even_sin[i]);
        m[1] += Complex64::new(-odd_sin[i], odd_cos[i]);
        m[2] += Complex64::new(even_cos[i], even_sin[i]) * s2;
        m[3] += Complex64::new(-odd_sin[i], odd_cos[i]) * s2;
        m[4] += Complex64::new(even_cos[i], even_sin[i]) * (s2 * s2);
    }
}

/// The integral by one quadrature rule over the whole interval.
pub type Rule = fn([f64; 4]) -> Complex64;

/// The rules among which [`spiro_moments`] chooses, by their number of nodes, to be used without
/// choosing: for comparisons such as figure 8.1.
pub const RULES: [(usize, Rule); 5] = [
    (8, |k| single_panel(&GAUSS_8, k).integral()),
    (12, |k| single_panel(&GAUSS_12, k).integral()),
    (16, |k| single_panel(&GAUSS_16, k).integral()),
    (24, |k| single_panel(&GAUSS_24, k).integral()),
    (32, |k| single_panel(&GAUSS_32, k).integral()),
];

/// Sum over `count` equal panels, each reduced to the same integral by eq. 8.3.
fn panels(k: [f64; 4], count: usize) -> SpiroMoments {
    let width = 1.0 / count as f64;
    let mut sum = [Complex64::ZERO; 5];
    for panel in 0..count {
        let middle = (panel as f64 + 0.5) * width - 0.5;
        let local = large_panel(&GAUSS_32, sub_parameters(k, middle, width));
        let turn = cis(angle(k, middle)) * width;
        // s = middle + width·u: the binomial expansion of sʲ, by repeated multiplication.
        let mut shifted = local.0;
        for j in 0..5 {
            sum[j] += turn * shifted[0];
            for l in 0..4 - j {
                shifted[l] = shifted[l] * middle + shifted[l + 1] * width;
            }
        }
    }
    SpiroMoments(sum)
}

/// θ(s) of eq. 8.7.
#[inline]
pub fn angle(k: [f64; 4], s: f64) -> f64 {
    s * (k[0] + s * (k[1] / 2.0 + s * (k[2] / 6.0 + s * k[3] / 24.0)))
}

/// κ(s) = θ′(s) and its first three derivatives.
#[inline]
pub fn curvature_jet(k: [f64; 4], s: f64) -> [f64; 4] {
    [
        k[0] + s * (k[1] + s * (k[2] / 2.0 + s * k[3] / 6.0)),
        k[1] + s * (k[2] + s * k[3] / 2.0),
        k[2] + s * k[3],
        k[3],
    ]
}

/// The parameters of the piece of length `width` about `middle`, itself scaled to arc length 1
/// (the arguments of `spiro` in eq. 8.3).
#[inline]
pub fn sub_parameters(k: [f64; 4], middle: f64, width: f64) -> [f64; 4] {
    let jet = curvature_jet(k, middle);
    let w2 = width * width;
    [jet[0] * width, jet[1] * w2, jet[2] * w2 * width, jet[3] * w2 * w2]
}

/// ∫ e^{iθ(s)} ds from `from` to `to` (eq. 8.3).
///
/// Absolute error as at [`spiro_integral`] times |`to` − `from`|.
#[inline]
pub fn spiro_integral_between(k: [f64; 4], from: f64, to: f64) -> Complex64 {
    let (middle, width) = ((from + to) / 2.0, to - from);
    spiro_integral(sub_parameters(k, middle, width)) * cis(angle(k, middle)) * width
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rough_moments_are_right_to_seven_digits() {
        for direction in directions(wildness) {
            for size in ROUGH.iter().flat_map(|limit| [0.5 * limit, 0.999 * limit]) {
                let k = direction.map(|k| k * size);
                let (rough, exact) = (rough_spiro_moments(k), spiro_moments(k));
                for (rough, exact) in rough.0.iter().zip(exact.0) {
                    assert!((rough - exact).norm() < 1.1e-7, "{k:?}: {rough} {exact}");
                }
            }
        }
    }

    /// Directions of k spread over shapes, some components zero, scaled so that `measure` is 1;
    /// without a generator's dependency.
    fn directions(measure: fn([f64; 4]) -> f64) -> impl Iterator<Item = [f64; 4]> {
        let mut state = 0x9E37_79B9_7F4A_7C15_u64;
        let mut next = move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        (0..2000).map(move |i| {
            let mut k = [next(), 2.0 * next(), 8.0 * next(), 48.0 * next()];
            for j in 0..4 {
                // The first fifteen leave out every set of components.
                if i < 15 && (i >> j) & 1 == 1 || i >= 15 && next() > 0.4 {
                    k[j] = 0.0;
                }
            }
            let scale = 1.0 / measure(k).max(f64::MIN_POSITIVE);
            k.map(|k| k * scale)
        })
    }

    fn arguments(wild: f64) -> impl Iterator<Item = [f64; 4]> {
        directions(wildness).enumerate().map(move |(i, k)| {
            let fraction = f64::from(i as u32 % 100 + 1) / 100.0;
            k.map(|k| k * wild * fraction)
        })
    }

    /// The same sum over many narrow panels.
    fn fine(k: [f64; 4]) -> SpiroMoments {
        panels(k, 8 + (wildness(k) / 8.0) as usize)
    }

    fn error(m: &SpiroMoments, exact: &SpiroMoments, j: usize) -> f64 {
        (m.0[j] - exact.0[j]).norm()
    }

    #[test]
    fn error_stays_below_its_bound() {
        for wild in [1e-6, 1e-3, 0.1, 1.0, 2.5, 5.0, 10.0, 16.0, 24.0, 58.0, 200.0, 5000.0] {
            for k in arguments(wild) {
                let (m, exact) = (spiro_moments(k), fine(k));
                for j in 0..5 {
                    let truncation = if j == 0 { 1e-15 } else { 2e-14 };
                    let bound = truncation + 2e-16 * wildness(k);
                    let error = error(&m, &exact, j);
                    assert!(error <= bound, "{k:?} of wildness {wild}, M{j}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn each_rule_reaches_to_its_limit() {
        fn check(measure: fn([f64; 4]) -> f64, limit: f64, rule: fn([f64; 4]) -> SpiroMoments) {
            for direction in directions(measure) {
                let k = direction.map(|k| k * limit);
                let error = error(&rule(k), &fine(k), 0);
                // 2e-16 of truncation and the rounding errors of both sums.
                let bound = 6e-16 + 1e-16 * wildness(k);
                assert!(error <= bound, "{limit}: {k:?}: {error:e}");
            }
        }
        check(growth, GROWTH_8, |k| single_panel(&GAUSS_8, k));
        check(growth, GROWTH_12, |k| single_panel(&GAUSS_12, k));
        check(growth, GROWTH_16, |k| single_panel(&GAUSS_16, k));
        check(wildness, WILDNESS_24, |k| single_panel(&GAUSS_24, k));
        check(wildness, WILDNESS_32, |k| single_panel(&GAUSS_32, k));
    }

    #[test]
    fn derivatives_agree_with_differences() {
        for k in arguments(30.0) {
            let m = spiro_moments(k);
            for j in 0..4 {
                let step = 1e-4;
                let (mut up, mut down) = (k, k);
                up[j] += step;
                down[j] -= step;
                let slope = (spiro_integral(up) - spiro_integral(down)) / (2.0 * step);
                assert!((slope - m.derivative(j)).norm() < 1e-9, "{k:?} {j}");
            }
        }
    }

    #[test]
    fn arcs_have_their_closed_form() {
        for i in 0..2000 {
            let turn = f64::from(i) * 0.37;
            let exact = if turn == 0.0 { 1.0 } else { (turn / 2.0).sin() / (turn / 2.0) };
            let arc = spiro_integral([turn, 0.0, 0.0, 0.0]);
            assert!((arc - exact).norm() < 1e-15 + 2e-16 * turn, "{turn}: {arc} {exact}");
        }
    }

    #[test]
    fn hopeless_arguments_end_in_bounded_time_and_numbers() {
        for k in [[1e300, 0.0, 0.0, 0.0], [0.0, 1e9, -1e12, 1e15], [f64::MAX; 4]] {
            assert_eq!(spiro_integral(k), Complex64::ZERO, "{k:?}");
        }
        assert!(spiro_integral([2e6, 0.0, 0.0, 0.0]).norm() < 1e-6);
        assert!(spiro_integral([f64::NAN, 0.0, 0.0, 0.0]).is_nan());
        assert!(spiro_integral([0.0, f64::INFINITY, 0.0, 0.0]).is_nan());
    }
}
