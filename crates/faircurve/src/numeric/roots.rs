//! Real roots of small polynomials.

use kurbo::common::solve_quadratic;
use num_complex::Complex64;

use super::trig::{argument, sin_cos};

/// The real roots of Σ cᵢ xⁱ in [`from`, `to`], ascending, each once, to rounding.
///
/// Found between the roots of the derivative, where the polynomial is monotone, by bisection
/// guarded Newton steps; a root at which the polynomial only touches zero may be missed. A
/// polynomial that vanishes everywhere has no roots to report.
///
/// ```
/// use faircurve::numeric::roots::roots_between;
/// let roots = roots_between(&[6.0, -5.0, 1.0], 0.0, 10.0); // (x − 2)(x − 3)
/// assert!((roots[0] - 2.0).abs() < 1e-15 && (roots[1] - 3.0).abs() < 1e-15);
/// ```
pub fn roots_between(coefficients: &[f64], from: f64, to: f64) -> Vec<f64> {
    let degree = coefficients.iter().rposition(|&c| c != 0.0).unwrap_or(0);
    if degree == 0 {
        return Vec::new();
    }
    let coefficients = &coefficients[..=degree];
    let derivative: Vec<f64> =
        coefficients.iter().enumerate().skip(1).map(|(i, c)| c * i as f64).collect();
    let mut breaks = vec![from];
    breaks.extend(roots_between(&derivative, from, to));
    breaks.push(to);
    let mut roots: Vec<f64> = Vec::new();
    for pair in breaks.windows(2) {
        if let Some(root) = monotone_root(|x| horner(coefficients, x), pair[0], pair[1])
            && roots.last() != Some(&root)
        {
            roots.push(root);
        }
    }
    roots
}

/// The real roots of c₀ + c₁x + c₂x² + c₃x³ and their number: one or three, of which some may be the same; two
/// or fewer where c₃ is nothing. To rounding of the largest, times what moves them when coefficients are rounded.
///
/// With x = t − b the cubic is t³ + 3pt + q: by Cardano's formula without its cancellation where one root is real,
/// by Viète's where three are.
pub(crate) fn cubic_roots([c0, c1, c2, c3]: [f64; 4]) -> ([f64; 3], usize) {
    let mut roots = [0.0; 3];
    let [b, c, d] = [c2 / (3.0 * c3), c1 / (3.0 * c3), c0 / c3];
    let p = c - b * b;
    let half = (d - b * c) / 2.0 - b * p;
    let discriminant = half * half + p * p * p;
    if !discriminant.is_finite() {
        let quadratic = solve_quadratic(c0, c1, c2);
        roots.iter_mut().zip(&quadratic).for_each(|(root, known)| *root = *known);
        return (roots, quadratic.len());
    }
    if discriminant > 0.0 {
        let u = (half.abs() + discriminant.sqrt()).powf(1.0 / 3.0);
        let v = p / u;
        // u − v, as the quotient of u³ − v³ where both have the same sign.
        let t = if v > 0.0 { 2.0 * half.abs() / (u * u + p + v * v) } else { u - v };
        roots[0] = -t.copysign(half) - b;
        return (roots, 1);
    }
    let radius = 2.0 * (-p).max(0.0).sqrt();
    let (sin, cos) = sin_cos(argument(Complex64::new(-half, (-discriminant).sqrt())) / 3.0);
    let across = sin * 3f64.sqrt();
    roots = [2.0 * cos, across - cos, -across - cos].map(|part| 0.5 * radius * part - b);
    (roots, 3)
}

/// The value of Σ cᵢ xⁱ.
pub fn horner(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// The zero of a function that is monotone on [`from`, `to`], if its sign changes there, to the
/// last bit that the function resolves (by the ITP-like mixture of bisection and regula falsi:
/// never more than 200 evaluations).
pub fn monotone_root(f: impl Fn(f64) -> f64, from: f64, to: f64) -> Option<f64> {
    let (mut low, mut high) = (from, to);
    let (mut f_low, mut f_high) = (f(low), f(high));
    if f_low == 0.0 {
        return Some(low);
    }
    if f_high == 0.0 {
        return Some(high);
    }
    if !(f_low * f_high.signum() < 0.0) {
        return None;
    }
    for step in 0..200 {
        let middle = low + (high - low) / 2.0;
        let secant = low - f_low * (high - low) / (f_high - f_low);
        // Two secant steps, then one halving, so that the bracket always shrinks.
        let x = if step % 3 < 2 && secant > low.min(high) && secant < low.max(high) {
            secant
        } else {
            middle
        };
        if x == low || x == high {
            break;
        }
        let f_x = f(x);
        if f_x == 0.0 {
            return Some(x);
        }
        if (f_x < 0.0) == (f_low < 0.0) {
            (low, f_low) = (x, f_x);
        } else {
            (high, f_high) = (x, f_x);
        }
    }
    Some(if f_low.abs() < f_high.abs() { low } else { high })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_roots_it_was_built_from() {
        let wanted = [-3.0, -0.5, 0.25, 2.0];
        let mut coefficients = vec![1.0];
        for root in wanted {
            let mut next = vec![0.0; coefficients.len() + 1];
            for (i, c) in coefficients.iter().enumerate() {
                next[i] -= c * root;
                next[i + 1] += c;
            }
            coefficients = next;
        }
        let found = roots_between(&coefficients, -10.0, 10.0);
        assert_eq!(found.len(), 4);
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-14, "{found} {wanted}");
        }
        assert_eq!(roots_between(&coefficients, 0.0, 1.0).len(), 1);
    }

    #[test]
    fn cubics_have_the_roots_they_were_built_from() {
        let places = [-2.0, -0.7, -1e-3, 0.0, 1e-6, 0.3, 1.5, 40.0];
        for (i, &x) in places.iter().enumerate() {
            for (j, &y) in places.iter().enumerate().skip(i) {
                // One root, and two that are real or y ± 0.1i.
                for (square, count) in [(-0.01, 3), (0.0, 0), (0.01, 1)] {
                    for leading in [1e-8, -3.0, 1e8] {
                        // (x − r)((x − y)² + square)
                        let [q0, q1] = [y * y + square, -2.0 * y];
                        let cubic = [-x * q0, q0 - x * q1, q1 - x, 1.0].map(|c| leading * c);
                        let (roots, found) = cubic_roots(cubic);
                        assert!(count == 0 || found == count, "{x} {y} {square}: {found}");
                        let known = [x, y - 0.1, y + 0.1];
                        let known = if square < 0.0 { &known[..] } else { &known[..1] };
                        // Twofold roots are known to the root of the rounding.
                        let near = [x - y, x - y + 0.1, x - y - 0.1];
                        let apart = near.iter().fold(1.0, |least: f64, d| least.min(d.abs()));
                        let most = if square == 0.0 || apart < 1e-3 { 1e-4 } else { 1e-11 };
                        for known in known {
                            let off = roots[..found].iter().map(|r| (r - known).abs());
                            let off = off.fold(f64::INFINITY, f64::min);
                            assert!(off <= most * (1.0 + x.abs().max(y.abs())), "{i} {j} {off:e}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_no_cubic_has_the_roots_of_what_it_is() {
        let (roots, count) = cubic_roots([6.0, -5.0, 1.0, 0.0]);
        assert!((roots[0] - 2.0).abs() < 1e-15 && (roots[1] - 3.0).abs() < 1e-15 && count == 2);
        assert_eq!(cubic_roots([1.0, 2.0, 0.0, 0.0]), ([-0.5, 0.0, 0.0], 1));
        assert_eq!(cubic_roots([1.0, 0.0, 0.0, 0.0]).1, 0);
        assert_eq!(cubic_roots([0.0, 0.0, 0.0, 2.0]), ([0.0; 3], 3));
        for bad in [f64::NAN, f64::INFINITY] {
            let (roots, count) = cubic_roots([bad, 1.0, 1.0, 1.0]);
            assert!(roots[..count].iter().all(|root| !root.is_infinite()), "{roots:?}");
        }
    }

    #[test]
    fn degenerate_polynomials_have_no_roots_to_report() {
        assert!(roots_between(&[], 0.0, 1.0).is_empty());
        assert!(roots_between(&[0.0, 0.0], -1.0, 1.0).is_empty());
        assert!(roots_between(&[f64::NAN, 1.0], -1.0, 1.0).is_empty());
        assert_eq!(roots_between(&[0.0, 1.0], -1.0, 1.0), [0.0]);
    }
}
