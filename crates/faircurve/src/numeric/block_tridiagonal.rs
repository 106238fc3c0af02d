//! Block tridiagonal linear systems, open or cyclic.
//!
//! Splines couple a knot with its two neighbours only, so that this is the one kind of system they
//! need: blocks of 1 for two-parameter splines, of 2 for four-parameter ones.

/// A B × B matrix, by rows.
pub type Block<const B: usize> = [[f64; B]; B];

/// Row i says: `lower[i]`·x_{i−1} + `diagonal[i]`·x_i + `upper[i]`·x_{i+1} = `right[i]`.
///
/// In a cyclic system the indices wrap around; in an open one `lower[0]` and `upper[n − 1]` are
/// ignored.
#[derive(Clone, Debug)]
pub struct BlockTridiagonal<const B: usize> {
    /// Coupling with the unknown before.
    pub lower: Vec<Block<B>>,
    /// Coupling with the row's own unknown.
    pub diagonal: Vec<Block<B>>,
    /// Coupling with the unknown after.
    pub upper: Vec<Block<B>>,
    /// Right-hand side; after [`solve`](Self::solve), the solution.
    pub right: Vec<[f64; B]>,
    cyclic: bool,
    /// Coupling with the last unknown that elimination of a cyclic system fills in.
    fill: Vec<Block<B>>,
}

impl<const B: usize> BlockTridiagonal<B> {
    /// A system of `n` block rows, all zero.
    pub fn new(n: usize, cyclic: bool) -> Self {
        let zeros = || vec![[[0.0; B]; B]; n];
        BlockTridiagonal {
            lower: zeros(),
            diagonal: zeros(),
            upper: zeros(),
            right: vec![[0.0; B]; n],
            cyclic,
            fill: if cyclic { zeros() } else { Vec::new() },
        }
    }

    /// The number of block rows.
    pub fn len(&self) -> usize {
        self.right.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.right.is_empty()
    }

    /// Solves in place: `right` becomes the solution, the blocks are destroyed.
    ///
    /// Block elimination, pivoting within blocks only. A pivot that vanishes is replaced by a tiny
    /// one, so that a singular system gives a large but finite answer, which Newton's method may
    /// clamp and correct.
    pub fn solve(&mut self) {
        match (self.len(), self.cyclic) {
            (0, _) => {}
            (n, false) => self.solve_leading(n),
            (1, true) => {
                let mut whole = self.diagonal[0];
                add(&mut whole, &self.lower[0]);
                add(&mut whole, &self.upper[0]);
                self.right[0] = times_vector(&invert(&whole), &self.right[0]);
            }
            (n, true) => self.solve_cyclic(n),
        }
    }

    /// Forward elimination and back substitution over the first `n` rows as an open system;
    /// `fill`, if there is one, is treated as further right-hand sides.
    fn solve_leading(&mut self, n: usize) {
        for i in 0..n {
            if i > 0 {
                let lower = self.lower[i];
                subtract_product(&mut self.diagonal[i], &lower, &self.upper[i - 1]);
                let carried = times_vector(&lower, &self.right[i - 1]);
                (0..B).for_each(|r| self.right[i][r] -= carried[r]);
                if self.cyclic {
                    let before = self.fill[i - 1];
                    subtract_product(&mut self.fill[i], &lower, &before);
                }
            }
            let inverse = invert(&self.diagonal[i]);
            self.right[i] = times_vector(&inverse, &self.right[i]);
            self.upper[i] = product(&inverse, &self.upper[i]);
            if self.cyclic {
                self.fill[i] = product(&inverse, &self.fill[i]);
            }
        }
        for i in (0..n.saturating_sub(1)).rev() {
            let carried = times_vector(&self.upper[i], &self.right[i + 1]);
            (0..B).for_each(|r| self.right[i][r] -= carried[r]);
            if self.cyclic {
                let (upper, after) = (self.upper[i], self.fill[i + 1]);
                subtract_product(&mut self.fill[i], &upper, &after);
            }
        }
    }

    /// Borders the first n − 1 rows, an open system, with the last unknown.
    fn solve_cyclic(&mut self, n: usize) {
        let last = n - 1;
        self.fill[..last].fill([[0.0; B]; B]);
        self.fill[0] = self.lower[0];
        let coupling = self.upper[last - 1];
        add(&mut self.fill[last - 1], &coupling);
        self.upper[last - 1] = [[0.0; B]; B];
        self.solve_leading(last);
        // What remains of the last row once the others are expressed by the last unknown.
        let mut schur = self.diagonal[last];
        let mut right = self.right[last];
        for (coupling, row) in [(self.lower[last], last - 1), (self.upper[last], 0)] {
            subtract_product(&mut schur, &coupling, &self.fill[row]);
            let carried = times_vector(&coupling, &self.right[row]);
            (0..B).for_each(|r| right[r] -= carried[r]);
        }
        let x = times_vector(&invert(&schur), &right);
        self.right[last] = x;
        for i in 0..last {
            let carried = times_vector(&self.fill[i], &x);
            (0..B).for_each(|r| self.right[i][r] -= carried[r]);
        }
    }
}

#[inline(always)]
fn add<const B: usize>(a: &mut Block<B>, b: &Block<B>) {
    for r in 0..B {
        for c in 0..B {
            a[r][c] += b[r][c];
        }
    }
}

#[inline(always)]
fn product<const B: usize>(a: &Block<B>, b: &Block<B>) -> Block<B> {
    let mut result = [[0.0; B]; B];
    for r in 0..B {
        for c in 0..B {
            for i in 0..B {
                result[r][c] += a[r][i] * b[i][c];
            }
        }
    }
    result
}

#[inline(always)]
fn subtract_product<const B: usize>(target: &mut Block<B>, a: &Block<B>, b: &Block<B>) {
    let product = product(a, b);
    for r in 0..B {
        for c in 0..B {
            target[r][c] -= product[r][c];
        }
    }
}

#[inline(always)]
fn times_vector<const B: usize>(a: &Block<B>, x: &[f64; B]) -> [f64; B] {
    let mut result = [0.0; B];
    for r in 0..B {
        for c in 0..B {
            result[r] += a[r][c] * x[c];
        }
    }
    result
}

/// The inverse: of one row the reciprocal, of two by Cramer's rule, where little cancels, else by elimination.
#[inline(always)]
pub(crate) fn invert<const B: usize>(matrix: &Block<B>) -> Block<B> {
    /// A determinant as large as this leaves all but two digits.
    const LARGE: f64 = 0.01;
    if B == 1 && matrix[0][0] != 0.0 {
        return [[1.0 / matrix[0][0]; B]; B];
    }
    if B == 2 {
        let [a, b, c, d] = [matrix[0][0], matrix[0][1], matrix[1][0], matrix[1][1]];
        let (ad, bc) = (a * d, b * c);
        let determinant = ad - bc;
        if determinant.abs() > LARGE * (ad.abs() + bc.abs()) && determinant.is_normal() {
            let mut inverse = *matrix;
            let reciprocal = 1.0 / determinant;
            (inverse[0][0], inverse[0][1]) = (d * reciprocal, -b * reciprocal);
            (inverse[1][0], inverse[1][1]) = (-c * reciprocal, a * reciprocal);
            return inverse;
        }
    }
    eliminate(matrix)
}

/// The inverse by Gauss–Jordan elimination with partial pivoting.
fn eliminate<const B: usize>(matrix: &Block<B>) -> Block<B> {
    /// Stands in for a pivot of zero, relative to the block's largest entry.
    const TINY_PIVOT: f64 = 1e-30;
    let mut a = *matrix;
    let mut inverse = [[0.0; B]; B];
    let mut largest = 0.0;
    for r in 0..B {
        inverse[r][r] = 1.0;
        for c in 0..B {
            largest = f64::max(largest, a[r][c].abs());
        }
    }
    for column in 0..B {
        let mut best = column;
        for r in column + 1..B {
            if a[r][column].abs() > a[best][column].abs() {
                best = r;
            }
        }
        a.swap(column, best);
        inverse.swap(column, best);
        let mut pivot = a[column][column];
        if pivot.abs() <= TINY_PIVOT * largest {
            pivot = if largest > 0.0 { TINY_PIVOT * largest } else { 1.0 };
        }
        let reciprocal = 1.0 / pivot;
        for c in 0..B {
            a[column][c] *= reciprocal;
            inverse[column][c] *= reciprocal;
        }
        for r in 0..B {
            if r != column {
                let factor = a[r][column];
                for c in 0..B {
                    a[r][c] -= factor * a[column][c];
                    inverse[r][c] -= factor * inverse[column][c];
                }
            }
        }
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(seed: &mut u64) -> f64 {
        *seed =
            seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Multiplies out a random system and solves it back.
    fn round_trip<const B: usize>(n: usize, cyclic: bool) -> f64 {
        let mut seed = (n + 100 * B) as u64;
        let mut system = BlockTridiagonal::<B>::new(n, cyclic);
        let x: Vec<[f64; B]> = (0..n).map(|_| [(); B].map(|()| noise(&mut seed))).collect();
        let block = |seed: &mut u64| [(); B].map(|()| [(); B].map(|()| noise(seed)));
        for i in 0..n {
            system.lower[i] = block(&mut seed);
            system.upper[i] = block(&mut seed);
            system.diagonal[i] = block(&mut seed);
            (0..B).for_each(|r| system.diagonal[i][r][r] += 4.0);
            let mut row = times_vector(&system.diagonal[i], &x[i]);
            let mut couple = |block: &Block<B>, j: usize| {
                let part = times_vector(block, &x[j]);
                (0..B).for_each(|r| row[r] += part[r]);
            };
            if cyclic || i > 0 {
                couple(&system.lower[i], (i + n - 1) % n);
            }
            if cyclic || i + 1 < n {
                couple(&system.upper[i], (i + 1) % n);
            }
            system.right[i] = row;
        }
        system.solve();
        let errors =
            system.right.iter().zip(&x).flat_map(|(a, b)| (0..B).map(|r| (a[r] - b[r]).abs()));
        errors.fold(0.0, f64::max)
    }

    #[test]
    fn solves_what_it_multiplied() {
        for n in [1, 2, 3, 4, 5, 17, 100] {
            for cyclic in [false, true] {
                let (one, two) = (round_trip::<1>(n, cyclic), round_trip::<2>(n, cyclic));
                assert!(one < 1e-13 && two < 1e-13, "{n} {cyclic}: {one:e} {two:e}");
            }
        }
    }

    #[test]
    fn a_singular_system_gives_finite_numbers() {
        let mut system = BlockTridiagonal::<2>::new(3, true);
        system.right = vec![[1.0, 2.0]; 3];
        system.solve();
        assert!(system.right.iter().flatten().all(|x| !x.is_nan()));
    }
}
