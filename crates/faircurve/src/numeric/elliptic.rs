//! Jacobi's elliptic functions (thesis section 5.12) and elliptic integrals.
//!
//! The functions are computed with *two* squared rates in the place of a parameter m: with
//! p and w = m·p,
//!
//! ```text
//! N′ = C·D    C′ = −p·N·D    D′ = −w·N·C    N(0) = 0, C(0) = D(0) = 1
//! N = sn(√p t | m)/√p    C = cn    D = dn
//! ```
//!
//! which are entire in t, p and w and symmetric between (p, C) and (w, D). So nothing happens where m
//! is 0, passes 1 or grows without bound, and none of the usual transformations between these
//! cases is needed: for small t a power series, then as many doublings of the argument as it takes.
//! Whatever is a small difference, such as 1 − D, has a doubling formula of its own.

use super::dual::Real;

/// Jacobi's functions at one argument, for squared rates p and w.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Elliptic<T> {
    /// sn(√p t | w/p)/√p.
    pub(crate) n: T,
    /// cn.
    pub(crate) c: T,
    /// dn.
    pub(crate) d: T,
    /// (1 − dn)/w.
    pub(crate) h: T,
    /// ∫ (1 − 2pN²)·(1 − dn)/w dt, which is (t − 2p∫N² dt − N·C)/w.
    pub(crate) j: T,
}

impl<T: Real> Elliptic<T> {
    /// The functions at `t`; p and w are at least 0, and `excess` is w − p, which may be known better
    /// than they are. NaN where p·t² or w·t² leaves the range of numbers.
    pub(crate) fn new(p: T, w: T, excess: T, t: T) -> Self {
        /// The series' first terms left out are 0.009·SMALL⁵ of the first.
        const SMALL: f64 = 1.2e-3;
        let square = t.value() * t.value();
        let most = p.value().max(w.value()) * square;
        let mut doublings = 0;
        let mut scale = 1.0;
        if most.is_finite() {
            while most * scale * scale > SMALL {
                scale *= 0.5;
                doublings += 1;
            }
        }
        let mut small = Small::series(p, w, t * scale);
        while doublings > 0 && small.is_small(p, w) {
            small = small.doubled(p, w);
            doublings -= 1;
        }
        let mut all = small.all(p, w);
        for _ in 0..doublings {
            all = all.doubled(p, w, excess);
        }
        all
    }

    /// The functions at twice the argument, where C and D are no longer nearly 1.
    fn doubled(self, p: T, w: T, excess: T) -> Self {
        let Elliptic { n, c, d, h, j } = self;
        let nn = n * n;
        let (a, b, cc, dd) = (p * nn, w * nn, c * c, d * d);
        // 1 − p·w·N⁴, which the tails of the solitary wave make small.
        let denominator = cc + a * dd;
        let inverse = T::from(1.0) / (denominator + f64::MIN_POSITIVE);
        let ncd = n * c * d;
        // Where p = w, C and D keep their relative accuracy.
        let (both, apart) = (cc * dd, excess * nn);
        let further =
            h * (a * b + T::from(1.0) - a * a * b * 2.0) + a * nn * (a * 2.0 + a * b + -3.0);
        Elliptic {
            n: ncd * inverse * 2.0,
            c: (both + apart) * inverse,
            d: (both - apart) * inverse,
            h: nn * cc * inverse * 2.0,
            j: j * 2.0 + n * c * further * inverse * inverse * 2.0,
        }
    }
}

/// The same at a small argument: C and D by what they lack of 1, (1 − C)/p and (1 − D)/w.
#[derive(Clone, Copy, Debug)]
struct Small<T> {
    n: T,
    lack_c: T,
    lack_d: T,
    j: T,
}

impl<T: Real> Small<T> {
    fn series(p: T, w: T, t: T) -> Self {
        let x = t * t;
        let (sum, product) = (p + w, p * w);
        let squares = sum * sum - product * 2.0;
        let n1 = sum * (-1.0 / 6.0);
        let n2 = (squares + product * 14.0) * (1.0 / 120.0);
        let n3 = sum * (squares + product * 134.0) * (-1.0 / 5040.0);
        let n4 = (squares * squares + product * squares * 1228.0 + product * product * 5476.0)
            * (1.0 / 362_880.0);
        let n = t * (x * (n1 + x * (n2 + x * (n3 + x * n4))) + 1.0);
        let (pp, ww) = (p * p, w * w);
        let j1 = p * (-7.0 / 30.0) + w * (-1.0 / 120.0);
        let j2 = pp * (31.0 / 315.0) + product * (43.0 / 630.0) + ww * (1.0 / 5040.0);
        let j3 = p * pp * (-127.0 / 5670.0)
            + p * product * (-481.0 / 7560.0)
            + w * product * (-143.0 / 15120.0)
            + w * ww * (-1.0 / 362_880.0);
        let j = t * x * (x * (j1 + x * (j2 + x * j3)) + 1.0 / 6.0);
        let nn = n * n;
        let lack = |rate: T| nn / ((T::from(1.0) - rate * nn).sqrt() + 1.0);
        Small { n, lack_c: lack(p), lack_d: lack(w), j }
    }

    /// Whether C and D are still near 1.
    fn is_small(&self, p: T, w: T) -> bool {
        p.value() * self.lack_c.value() < 0.06 && w.value() * self.lack_d.value() < 0.06
    }

    fn all(self, p: T, w: T) -> Elliptic<T> {
        let (c, d) = (-p * self.lack_c + 1.0, -w * self.lack_d + 1.0);
        Elliptic { n: self.n, c, d, h: self.lack_d, j: self.j }
    }

    fn doubled(self, p: T, w: T) -> Self {
        let Elliptic { n, c, d, h, j } = self.all(p, w);
        let nn = n * n;
        let (a, b) = (p * nn, w * nn);
        let inverse = T::from(1.0) / (-a * b + 1.0);
        let further = h * (a * b + 1.0 - a * a * b * 2.0) + a * nn * (a * 2.0 + a * b + -3.0);
        let twice = nn * inverse * 2.0;
        Small {
            n: n * c * d * inverse * 2.0,
            lack_c: twice * (-b + 1.0),
            lack_d: twice * (-a + 1.0),
            j: j * 2.0 + n * c * further * inverse * inverse * 2.0,
        }
    }
}

/// Legendre's complete integral K(m), by the complementary modulus √(1 − m) ≥ 0; infinite for 0.
pub(crate) fn complete_k(complementary: f64) -> f64 {
    /// Gauss's mean of numbers within the range of `f64` takes 14 steps at most.
    const MOST_STEPS: usize = 20;
    let (mut a, mut b) = (1.0f64, complementary);
    if b == 0.0 {
        return f64::INFINITY;
    }
    for _ in 0..MOST_STEPS {
        if (a - b).abs() <= f64::EPSILON * a {
            break;
        }
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    std::f64::consts::PI / (a + b)
}

/// Jacobi's sn, cn and dn for a parameter m ≥ 0, which may exceed 1 (thesis eq. 5.25–5.27); accurate
/// to about 1e-15·(1 + |u|) for moderate m. NaN for m below 0.
///
/// ```
/// let [sn, cn, dn] = faircurve::numeric::elliptic::jacobi(1.0, 1.0);
/// assert!((sn - 1f64.tanh()).abs() < 1e-15);
/// assert!((cn - 1.0 / 1f64.cosh()).abs() < 1e-15 && (dn - cn).abs() < 1e-15);
/// ```
pub fn jacobi(u: f64, m: f64) -> [f64; 3] {
    let Elliptic { n, c, d, .. } = Elliptic::new(1.0, m, m - 1.0, u);
    if m >= 0.0 { [n, c, d] } else { [f64::NAN; 3] }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;
    use crate::numeric::dual::Dual;
    use crate::numeric::quadrature::integrate;

    /// u of an amplitude below a quarter turn, by the integral that defines it (thesis eq. 5.24).
    fn argument(amplitude: f64, m: f64) -> f64 {
        integrate(&|t: f64| 1.0 / (1.0 - m * t.sin().powi(2)).sqrt(), &[0.0, amplitude])
    }

    #[test]
    fn the_amplitude_inverts_the_integral() {
        for m in [0.0, 1e-9, 0.3, 0.5, 0.99, 1.0 - 1e-12, 1.0, 1.0 + 1e-9, 1.5, 40.0] {
            let most: f64 = if m < 1.0 { 1.5 } else { 0.95 * (1.0 / f64::sqrt(m)).asin() };
            for i in 1..=10 {
                let amplitude = most.min(1.4) * f64::from(i) / 10.0;
                let [sn, cn, dn] = jacobi(argument(amplitude, m), m);
                let (sine, cosine) = amplitude.sin_cos();
                let error = (sn - sine).abs().max((cn - cosine).abs());
                assert!(error < 2e-14, "{m} {amplitude} {error:e}");
                assert!((dn - (1.0 - m * sine * sine).sqrt()).abs() < 1e-13 * (1.0 + m), "{m}");
            }
        }
    }

    #[test]
    fn limits_are_circles_and_hyperbolas() {
        for i in -60..=60 {
            let u = f64::from(i) * 0.5;
            let [sn, cn, dn] = jacobi(u, 0.0);
            assert!((sn - u.sin()).abs() < 4e-15 * (1.0 + u.abs()), "{u}");
            assert!((cn - u.cos()).abs() < 4e-15 * (1.0 + u.abs()), "{u}");
            assert_eq!(dn, 1.0);
            let [sn, cn, dn] = jacobi(u, 1.0);
            assert!((sn - u.tanh()).abs() < 2e-15, "{u}");
            // Relative, down the tails.
            assert!((cn * u.cosh() - 1.0).abs() < 1e-14 * (1.0 + u.abs()), "{u} {cn:e}");
            assert_eq!(cn, dn);
        }
    }

    #[test]
    fn periods_are_those_of_the_complete_integral() {
        for m in [0.0, 0.1f64, 0.5, 0.9, 0.999_999] {
            let k = complete_k((1.0 - m).sqrt());
            let [sn, cn, dn] = jacobi(k, m);
            assert!((sn - 1.0).abs() < 1e-14 && cn.abs() < 1e-14, "{m} {sn} {cn:e}");
            assert!((dn - (1.0 - m).sqrt()).abs() < 1e-14);
            let [sn, cn, _] = jacobi(4.0 * k, m);
            assert!(sn.abs() < 4e-14 && (cn - 1.0).abs() < 4e-14, "{m} {sn:e}");
        }
        assert!((complete_k(1.0) - FRAC_PI_2).abs() < 1e-15);
        // The lemniscate constant: K(½) = Γ(¼)²/(4√π).
        let gamma = 3.625_609_908_221_908_3f64;
        assert!((complete_k(0.5f64.sqrt()) - gamma * gamma / (4.0 * PI.sqrt())).abs() < 1e-15);
        assert_eq!(complete_k(0.0), f64::INFINITY);
    }

    /// h and j by their definitions, where these don't cancel.
    #[test]
    fn integrals_agree_with_quadrature() {
        for (p, w) in [(1.0, 0.0), (2.0, 1.0), (1.0, 1.0), (0.5, 3.0), (0.0, 2.0), (30.0, 20.0)] {
            for t in [0.01, 0.3, -0.8, 2.0, 5.0] {
                let at = |t: f64| Elliptic::new(p, w, w - p, t);
                let j = |t: f64| {
                    let e = at(t);
                    (1.0 - 2.0 * p * e.n * e.n) * e.h
                };
                let whole = integrate(&j, &[0.0f64.min(t), 0.0f64.max(t)]) * t.signum();
                let size = t.abs().powi(3).min(10.0);
                assert!((at(t).j - whole).abs() < 1e-13 * size, "{p} {w} {t}");
                if w > 0.0 {
                    let e = at(t);
                    assert!((e.h * w - 1.0 + e.d).abs() < 1e-14, "{p} {w} {t}");
                }
            }
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let at = |[p, w, t]: [f64; 3]| {
            let e = Elliptic::new(p, w, w - p, t);
            [e.n, e.c, e.d, e.h, e.j]
        };
        for place in [[1.3, 0.4, 0.9], [0.6, 2.0, 1.7], [1e-3, 1e-3, 1.0], [1.0, 1.0, 4.0]] {
            let dual = std::array::from_fn::<_, 3, _>(|i| Dual::<3>::variable(place[i], i));
            let e = Elliptic::new(dual[0], dual[1], dual[1] - dual[0], dual[2]);
            let exact = [e.n, e.c, e.d, e.h, e.j];
            for i in 0..3 {
                let h = 1e-6;
                let mut sides = [place; 2];
                (sides[0][i], sides[1][i]) = (place[i] - h, place[i] + h);
                let (low, high) = (at(sides[0]), at(sides[1]));
                for q in 0..5 {
                    let slope = (high[q] - low[q]) / (2.0 * h);
                    let off = (exact[q].by[i] - slope).abs();
                    assert!(off < 1e-7 * (1.0 + slope.abs()), "{place:?} {i} {q} {off:e}");
                }
            }
        }
    }
}
