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

/// The real roots of c₀ + c₁x + c₂x² + c₃x³ and their number, each to rounding times what moves it when coefficients
/// are rounded, however far the others are; a twofold root may be left out. Where c₃ is nothing beside the others, as
/// many as the rest has.
///
/// With x = t − b the cubic is t³ + 3pt + q: by Cardano's formula without its cancellation where one root is real,
/// by Viète's where three are. Then t is near b for roots that are small beside the others, of which little would be
/// left: one is corrected by Newton's method, two are those of the quadratic that remains without the largest.
///
/// kurbo's `solve_cubic` leaves what is small as it is, and brings the library's trigonometry, cube root and emulated
/// fused product into the web's first module, 4 kB.
pub(crate) fn cubic_roots(cubic: [f64; 4]) -> ([f64; 3], usize) {
    let size = cubic.iter().fold(0.0, |size: f64, c| size.max(c.abs()));
    let cubic = cubic.map(|c| c / size);
    let [c0, c1, c2, c3] = cubic;
    let mut roots = [0.0; 3];
    let [b, c, d] = [c2 / (3.0 * c3), c1 / (3.0 * c3), c0 / c3];
    let p = c - b * b;
    let half = (d - b * c) / 2.0 - b * p;
    // By the Hessian, which keeps the discriminant of the quadratic as c₃ vanishes.
    let [h0, h1, h2] =
        [c3 * c1 / 3.0 - c2 * c2 / 9.0, c3 * c0 - c2 * c1 / 9.0, c2 * c0 / 3.0 - c1 * c1 / 9.0];
    let discriminant = 4.0 * h0 * h2 - h1 * h1;
    let root = discriminant.abs().sqrt() / c3 / c3 / 2.0;
    if !(half.is_finite() && root.is_finite()) {
        let quadratic = solve_quadratic(c0, c1, c2);
        roots.iter_mut().zip(&quadratic).for_each(|(root, known)| *root = *known);
        return (roots, quadratic.len());
    }
    let corrected = |mut x: f64| {
        for _ in 0..3 {
            let step = horner(&cubic, x) / horner(&[c1, 2.0 * c2, 3.0 * c3], x);
            x -= if step.is_finite() { step } else { 0.0 };
        }
        x
    };
    if discriminant < 0.0 {
        let u = (half.abs() + root).powf(1.0 / 3.0);
        let v = p / u;
        // u − v, as the quotient of u³ − v³ where both have the same sign.
        let t = if v > 0.0 { 2.0 * half.abs() / (u * u + p + v * v) } else { u - v };
        roots[0] = corrected(-t.copysign(half) - b);
        return (roots, 1);
    }
    let radius = (-p).max(0.0).sqrt();
    let (sin, cos) = sin_cos(argument(Complex64::new(-half, root)) / 3.0);
    let across = sin * 3f64.sqrt();
    let all = [2.0 * cos, across - cos, -across - cos].map(|part| radius * part - b);
    let largest = all.into_iter().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
    if largest == 0.0 {
        return (roots, 1);
    }
    let largest = corrected(largest);
    let q0 = -c0 / largest;
    let q1 = (q0 - c1) / largest;
    let others = solve_quadratic(q0, q1, (q1 - c2) / largest);
    roots[0] = largest;
    roots[1..].iter_mut().zip(&others).for_each(|(root, other)| *root = *other);
    (roots, 1 + others.len().min(2))
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
        for x in places.into_iter().chain([1e9, -1e14, 1e30]) {
            // One root, and two that are real or y ± 0.1i.
            for (y, square) in places.into_iter().flat_map(|y| [(y, -0.01), (y, 0.01)]) {
                for leading in [1e-8, -3.0, 1e8] {
                    // (x − r)((x − y)² + square)
                    let [q0, q1] = [y * y + square, -2.0 * y];
                    let cubic = [-x * q0, q0 - x * q1, q1 - x, 1.0].map(|c| leading * c);
                    let (roots, found) = cubic_roots(cubic);
                    let known = [x, y - 0.1, y + 0.1];
                    let known = if square < 0.0 { &known[..] } else { &known[..1] };
                    // Twofold roots are known to the root of the rounding.
                    let is_twofold =
                        square < 0.0 && [x - y + 0.1, x - y - 0.1].iter().any(|d| d.abs() < 1e-3);
                    assert!(is_twofold || found == known.len(), "{x} {y} {square}: {found}");
                    for &known in known {
                        let off = roots[..found].iter().map(|r| (r - known).abs());
                        let off = off.fold(f64::INFINITY, f64::min);
                        // What rounding of the coefficients makes of the value, and that of the root.
                        let sizes = cubic.map(f64::abs);
                        let slope = horner(&[cubic[1], 2.0 * cubic[2], 3.0 * cubic[3]], known);
                        let moved = 8e-16 * horner(&sizes, known.abs()) / slope.abs();
                        let most = if is_twofold { 1e-6 } else { moved + 4e-16 * known.abs() };
                        assert!(off <= most, "{x} {y} {square}: {off:e} {most:e}");
                    }
                }
            }
        }
    }

    /// The real root of 2a²x³ + 3abx² + 9b²x + c, as a curve's curvature in the middle, 2a, goes through zero.
    #[test]
    fn a_root_beside_two_that_go_far_away_is_kept() {
        let (b, c) = (0.3, -0.2);
        for decade in 0..=300 {
            let a = 10f64.powi(-decade);
            let (roots, count) = cubic_roots([c, 9.0 * b * b, 3.0 * a * b, 2.0 * a * a]);
            let value = |x: f64| horner(&[c, 9.0 * b * b, 3.0 * a * b, 2.0 * a * a], x);
            let found = roots[..count].iter().find(|x| value(**x).abs() < 1e-15);
            assert!(found.is_some(), "{a:e}: {roots:?}");
        }
    }

    #[test]
    fn what_is_no_cubic_has_the_roots_of_what_it_is() {
        let (roots, count) = cubic_roots([6.0, -5.0, 1.0, 0.0]);
        assert!((roots[0] - 2.0).abs() < 1e-15 && (roots[1] - 3.0).abs() < 1e-15 && count == 2);
        assert_eq!(cubic_roots([1.0, 2.0, 0.0, 0.0]), ([-0.5, 0.0, 0.0], 1));
        assert_eq!(cubic_roots([1.0, 0.0, 0.0, 0.0]).1, 0);
        assert_eq!(cubic_roots([0.0, 0.0, 0.0, 2.0]), ([0.0; 3], 1));
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
