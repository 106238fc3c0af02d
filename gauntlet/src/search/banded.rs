//! Linear systems whose entries lie near the diagonal.

/// A square matrix with entries only within `below` and `above` the diagonal, solved by elimination
/// with row exchanges.
#[derive(Clone, Debug)]
pub(super) struct Banded {
    below: usize,
    above: usize,
    /// Row by row, each from `below` left of the diagonal to `below + above` right of it: exchanges
    /// of rows widen the band.
    rows: Vec<f64>,
    size: usize,
}

impl Banded {
    /// All zero.
    pub(super) fn new(size: usize, below: usize, above: usize) -> Self {
        Banded { below, above, rows: vec![0.0; size * (2 * below + above + 1)], size }
    }

    fn place(&self, row: usize, column: usize) -> usize {
        row * (2 * self.below + self.above + 1) + (column + self.below - row)
    }

    /// Adds to an entry within the band.
    pub(super) fn add(&mut self, row: usize, column: usize, value: f64) {
        let place = self.place(row, column);
        self.rows[place] += value;
    }

    /// Solves for each of the right sides in place, and uses the matrix up. Where it is singular,
    /// the result isn't finite.
    pub(super) fn solve(mut self, right: &mut [Vec<f64>]) {
        let n = self.size;
        for pivot in 0..n {
            let last = (pivot + self.below).min(n - 1);
            let last_column = (pivot + self.below + self.above).min(n - 1);
            let size = |row: usize| self.rows[self.place(row, pivot)].abs();
            let best = (pivot..=last).fold(pivot, |a, b| if size(b) > size(a) { b } else { a });
            if best != pivot {
                for column in pivot..=last_column {
                    let (a, b) = (self.place(pivot, column), self.place(best, column));
                    self.rows.swap(a, b);
                }
                right.iter_mut().for_each(|side| side.swap(pivot, best));
            }
            let inverse = self.rows[self.place(pivot, pivot)].recip();
            for row in pivot + 1..=last {
                let factor = self.rows[self.place(row, pivot)] * inverse;
                if factor == 0.0 {
                    continue;
                }
                let (to, from) = (self.place(row, pivot), self.place(pivot, pivot));
                for i in 1..=last_column - pivot {
                    self.rows[to + i] -= factor * self.rows[from + i];
                }
                right.iter_mut().for_each(|side| side[row] -= factor * side[pivot]);
            }
        }
        for row in (0..n).rev() {
            let last_column = (row + self.below + self.above).min(n - 1);
            let from = self.place(row, row);
            for side in right.iter_mut() {
                let known: f64 = (row + 1..=last_column)
                    .map(|column| self.rows[from + column - row] * side[column])
                    .sum();
                side[row] = (side[row] - known) / self.rows[from];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Random;

    #[test]
    fn what_is_multiplied_comes_back() {
        let (n, below, above) = (40, 3, 2);
        let mut random = Random::for_case("banded", 0);
        let (mut matrix, mut dense) = (Banded::new(n, below, above), vec![vec![0.0; n]; n]);
        for row in 0..n {
            for column in row.saturating_sub(below)..(row + above + 1).min(n) {
                // Zeros on the diagonal call for exchanges.
                let value = if row == column { 0.0 } else { random.between(-1.0, 1.0) };
                matrix.add(row, column, value);
                dense[row][column] = value;
            }
        }
        let known: Vec<f64> = (0..n).map(|_| random.between(-1.0, 1.0)).collect();
        let times = |row: &Vec<f64>| row.iter().zip(&known).map(|(a, b)| a * b).sum();
        let mut right = [dense.iter().map(times).collect()];
        matrix.solve(&mut right);
        for (a, b) in right[0].iter().zip(&known) {
            assert!((a - b).abs() < 1e-10, "{a} {b}");
        }
    }
}
