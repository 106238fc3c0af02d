//! Integrals of functions that need care here and there: adaptive Gauss–Legendre quadrature.

use super::gauss_legendre::GAUSS_16;

/// The nodes of sixteen in [−½, ½], ascending within each half, with their weights.
pub(crate) fn nodes_16() -> impl Iterator<Item = (f64, f64)> {
    let pairs = GAUSS_16.nodes.iter().zip(GAUSS_16.pair_weights);
    pairs.flat_map(|(s, weight)| [(-s, weight / 2.0), (*s, weight / 2.0)])
}

/// The integral of `f` over [`from`, `to`] by sixteen nodes: exact for polynomials up to degree 31.
pub(crate) fn gauss_16(f: &impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let (middle, width) = ((from + to) / 2.0, to - from);
    let pairs = GAUSS_16.nodes.iter().zip(GAUSS_16.pair_weights);
    let sum: f64 = pairs
        .map(|(s, weight)| weight / 2.0 * (f(middle - s * width) + f(middle + s * width)))
        .sum();
    sum * width
}

/// The integral of `f` through the ascending `stops`, to about 1e-13 of itself where it is smooth
/// between them, or has singularities that can be integrated.
///
/// Pieces are halved until the halves add nothing, or often enough: what diverges, or is nothing but
/// rounding, ends there.
pub(crate) fn integrate(f: &impl Fn(f64) -> f64, stops: &[f64]) -> f64 {
    /// Times that the stretch between two stops is halved; a singularity takes some 40.
    const MOST_HALVINGS: usize = 400;
    let pieces: Vec<Piece> = stops.windows(2).map(|ends| Piece::new(f, ends[0], ends[1])).collect();
    let rough: f64 = pieces.iter().map(|piece| piece.value.abs()).sum();
    pieces
        .into_iter()
        .map(|piece| {
            let mut halvings = MOST_HALVINGS;
            piece.refined(f, rough, &mut halvings)
        })
        .sum()
}

/// An interval and the integral over it by sixteen nodes.
struct Piece {
    from: f64,
    to: f64,
    value: f64,
}

impl Piece {
    fn new(f: &impl Fn(f64) -> f64, from: f64, to: f64) -> Piece {
        Piece { from, to, value: gauss_16(f, from, to) }
    }

    /// A better value; `rough` is about the size of the whole integral.
    fn refined(self, f: &impl Fn(f64) -> f64, rough: f64, halvings: &mut usize) -> f64 {
        /// Of the whole integral, left to chance in each piece.
        const NEGLIGIBLE: f64 = 1e-14;
        let middle = (self.from + self.to) / 2.0;
        let halves = [Piece::new(f, self.from, middle), Piece::new(f, middle, self.to)];
        let sum = halves[0].value + halves[1].value;
        let rough = rough.max(sum.abs());
        if (sum - self.value).abs() <= NEGLIGIBLE * rough || *halvings == 0 || !sum.is_finite() {
            return sum;
        }
        *halvings -= 1;
        halves.into_iter().map(|half| half.refined(f, rough, halvings)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_smooth_singular_and_steep_functions() {
        let close = |a: f64, b: f64| (a - b).abs() < 1e-12 * b.abs();
        assert!(close(integrate(&f64::exp, &[0.0, 1.0]), 1f64.exp() - 1.0));
        assert!(close(integrate(&|x: f64| x.abs().sqrt(), &[-1.0, 0.0, 1.0]), 4.0 / 3.0));
        let peak = |x: f64| 1e-3 / (x * x + 1e-6);
        assert!(close(integrate(&peak, &[-1.0, 1.0]), 2.0 * 1e3f64.atan()));
    }

    #[test]
    fn what_diverges_ends() {
        assert!(integrate(&|x: f64| (x - 0.3).powi(-2), &[0.0, 1.0]) > 1e6);
    }
}
