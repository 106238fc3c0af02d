//! Block tridiagonal linear systems, open or cyclic.
//!
//! Splines couple a knot with its two neighbours only, so that this is the one kind of system they
//! need: blocks of 1 for two-parameter splines, of 2 for four-parameter ones.

/// A B × B matrix, by rows.
pub type Block<const B: usize> = [[f64; B]; B];

/// The blocks of a row, which says: `lower`·x_{i−1} + `diagonal`·x_i + `upper`·x_{i+1} = `right[i]`.
#[derive(Clone, Copy, Debug)]
pub struct BlockRow<const B: usize> {
    /// Coupling with the unknown before.
    pub lower: Block<B>,
    /// Coupling with the row's own unknown.
    pub diagonal: Block<B>,
    /// Coupling with the unknown after.
    pub upper: Block<B>,
    /// Coupling with the last unknown that elimination of a cyclic system fills in.
    fill: Block<B>,
}

impl<const B: usize> BlockRow<B> {
    /// A row of these blocks.
    #[inline(always)]
    pub fn new(lower: Block<B>, diagonal: Block<B>, upper: Block<B>) -> Self {
        BlockRow { lower, diagonal, upper, fill: [[0.0; B]; B] }
    }

    /// The row of a system whose unknowns come in the opposite order.
    #[inline(always)]
    fn turn_round(&mut self) {
        std::mem::swap(&mut self.lower, &mut self.upper);
    }

    /// Puts in the unknown before, which a row with its right-hand side expresses by this one.
    #[inline(always)]
    fn subtract_outer(
        &mut self,
        right: &mut [f64; B],
        (outer, right_outer): &(BlockRow<B>, [f64; B]),
        cyclic: bool,
    ) {
        subtract_product(&mut self.diagonal, &self.lower, &outer.upper);
        subtract(right, &times_vector(&self.lower, right_outer));
        if cyclic {
            subtract_product(&mut self.fill, &self.lower, &outer.fill);
        }
    }

    /// Divides by the diagonal: the row then expresses its own unknown by the one after.
    #[inline(always)]
    fn normalize(&mut self, right: &mut [f64; B], cyclic: bool) {
        let inverse = invert(&self.diagonal);
        *right = times_vector(&inverse, right);
        self.upper = product(&inverse, &self.upper);
        if cyclic {
            self.fill = product(&inverse, &self.fill);
        }
    }

    /// Puts in the unknown after: its fill and its right-hand side, in place of which come those of this one.
    #[inline(always)]
    fn subtract_inner(
        &mut self,
        right: &mut [f64; B],
        (fill_inner, right_inner): &mut (Block<B>, [f64; B]),
        cyclic: bool,
    ) {
        subtract(right, &times_vector(&self.upper, right_inner));
        if cyclic {
            subtract_product(&mut self.fill, &self.upper, fill_inner);
        }
        (*fill_inner, *right_inner) = (self.fill, *right);
    }
}

/// A system of rows. In a cyclic one the indices wrap around; in an open one the first row's `lower` and the
/// last one's `upper` are ignored.
#[derive(Clone, Debug)]
pub struct BlockTridiagonal<const B: usize> {
    /// The rows' blocks.
    pub rows: Vec<BlockRow<B>>,
    /// Right-hand side; after [`solve`](Self::solve), the solution.
    pub right: Vec<[f64; B]>,
    cyclic: bool,
}

impl<const B: usize> BlockTridiagonal<B> {
    /// A system of `n` block rows, all zero.
    pub fn new(n: usize, cyclic: bool) -> Self {
        let zero = [[0.0; B]; B];
        let rows = vec![BlockRow::new(zero, zero, zero); n];
        BlockTridiagonal { rows, right: vec![[0.0; B]; n], cyclic }
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
                let BlockRow { lower, diagonal: mut whole, upper, .. } = self.rows[0];
                add(&mut whole, &lower);
                add(&mut whole, &upper);
                self.right[0] = times_vector(&invert(&whole), &self.right[0]);
            }
            (n, true) => self.solve_cyclic(n),
        }
    }

    /// Elimination and substitution over the first `n` rows as an open system; their `fill` is treated as further
    /// right-hand sides, if there is one.
    ///
    /// From both ends to the middle and back: each step waits for the one before, so that two chains of them side
    /// by side take little more time than one of half the length.
    fn solve_leading(&mut self, n: usize) {
        let cyclic = self.cyclic;
        let (rows, rights) = (&mut self.rows[..n], &mut self.right[..n]);
        let zero = [[0.0; B]; B];
        (rows[0].lower, rows[n - 1].upper) = (zero, zero);
        let middle = n / 2;
        let (head, tail) = rows.split_at_mut(middle + 1);
        let (right_head, right_tail) = rights.split_at_mut(middle + 1);
        let nothing = (BlockRow::new(zero, zero, zero), [0.0; B]);
        let (mut before, mut after) = (nothing, nothing);
        let mut from_end = tail.iter_mut().zip(right_tail.iter_mut()).rev();
        for (i, (row, right)) in head.iter_mut().zip(right_head.iter_mut()).enumerate() {
            if let Some((row, right)) = from_end.next() {
                row.turn_round();
                row.subtract_outer(right, &after, cyclic);
                row.normalize(right, cyclic);
                after = (*row, *right);
            }
            row.subtract_outer(right, &before, cyclic);
            if i == middle {
                row.turn_round();
                row.subtract_outer(right, &after, cyclic);
            }
            row.normalize(right, cyclic);
            before = (*row, *right);
        }
        let (row, right) = before;
        let (mut before, mut after) = ((row.fill, right), (row.fill, right));
        let mut to_end = tail.iter_mut().zip(right_tail.iter_mut());
        let towards_start = head.iter_mut().zip(right_head.iter_mut()).rev().skip(1);
        for (row, right) in towards_start {
            row.subtract_inner(right, &mut after, cyclic);
            if let Some((row, right)) = to_end.next() {
                row.subtract_inner(right, &mut before, cyclic);
            }
        }
    }

    /// Borders the first n − 1 rows, an open system, with the last unknown.
    fn solve_cyclic(&mut self, n: usize) {
        let last = n - 1;
        self.rows.iter_mut().for_each(|row| row.fill = [[0.0; B]; B]);
        self.rows[0].fill = self.rows[0].lower;
        let coupling = std::mem::replace(&mut self.rows[last - 1].upper, [[0.0; B]; B]);
        add(&mut self.rows[last - 1].fill, &coupling);
        self.solve_leading(last);
        // What remains of the last row once the others are expressed by the last unknown.
        let BlockRow { lower, diagonal: mut schur, upper, .. } = self.rows[last];
        let mut right = self.right[last];
        for (coupling, row) in [(lower, last - 1), (upper, 0)] {
            subtract_product(&mut schur, &coupling, &self.rows[row].fill);
            subtract(&mut right, &times_vector(&coupling, &self.right[row]));
        }
        let x = times_vector(&invert(&schur), &right);
        self.right[last] = x;
        for (row, right) in self.rows[..last].iter().zip(&mut self.right) {
            subtract(right, &times_vector(&row.fill, &x));
        }
    }
}

#[inline(always)]
fn subtract<const B: usize>(target: &mut [f64; B], x: &[f64; B]) {
    for r in 0..B {
        target[r] -= x[r];
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
#[inline(never)] // rare
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
            let (lower, upper) = (block(&mut seed), block(&mut seed));
            let mut diagonal = block(&mut seed);
            (0..B).for_each(|r| diagonal[r][r] += 4.0);
            system.rows[i] = BlockRow::new(lower, diagonal, upper);
            let mut row = times_vector(&diagonal, &x[i]);
            let mut couple = |block: &Block<B>, j: usize| {
                let part = times_vector(block, &x[j]);
                (0..B).for_each(|r| row[r] += part[r]);
            };
            if cyclic || i > 0 {
                couple(&lower, (i + n - 1) % n);
            }
            if cyclic || i + 1 < n {
                couple(&upper, (i + 1) % n);
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
