//! Real roots of small polynomials in an interval.

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
    fn degenerate_polynomials_have_no_roots_to_report() {
        assert!(roots_between(&[], 0.0, 1.0).is_empty());
        assert!(roots_between(&[0.0, 0.0], -1.0, 1.0).is_empty());
        assert!(roots_between(&[f64::NAN, 1.0], -1.0, 1.0).is_empty());
        assert_eq!(roots_between(&[0.0, 1.0], -1.0, 1.0), [0.0]);
    }
}
