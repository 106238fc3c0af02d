//! Newton's method on block tridiagonal systems: the one nonlinear solver of the library (thesis
//! section 8.3).
//!
//! A spline says what its unknowns and equations are ([`System`]); how to iterate, when to stop and
//! what to report is decided here for all.

use super::block_tridiagonal::BlockTridiagonal;

/// Equations that couple each unknown (a block of B numbers) with its neighbours.
pub trait System<const B: usize> {
    /// Evaluates the equations at the present state and returns the residual: the largest violated
    /// one, dimensionless.
    fn residual(&mut self) -> f64;

    /// Writes the equations, linearised at the state that was evaluated last, into `matrix`, whose every
    /// entry it must set.
    fn linearize(&self, matrix: &mut BlockTridiagonal<B>);

    /// Takes the step, shortened where the system knows better, and returns its size: the most that
    /// a direction changes by, in radians.
    fn advance(&mut self, step: &[[f64; B]]) -> f64;
}

/// When Newton's method stops.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Most steps taken.
    pub iterations: usize,
    /// Gives up early when the residual hasn't fallen below its least value so far for this many
    /// steps.
    pub patience: usize,
}

/// How Newton's method ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Steps taken.
    pub iterations: usize,
    /// The residual of the final state.
    pub residual: f64,
}

/// Iterates until rounding stops the residual from falling, or a limit is reached.
///
/// The state left behind is the last, not always the best; its residual is the one returned.
pub fn newton<const B: usize>(
    system: &mut impl System<B>,
    matrix: &mut BlockTridiagonal<B>,
    limits: Limits,
) -> Outcome {
    newton_while(system, matrix, limits, |_| true)
}

/// The same, as long as the state reached is also worth going on from.
///
/// One copy of the code serves all reasons to go on: the module for the web has to be small.
#[inline(never)]
pub fn newton_while<const B: usize>(
    system: &mut impl System<B>,
    matrix: &mut BlockTridiagonal<B>,
    limits: Limits,
    goes_on: fn(Outcome) -> bool,
) -> Outcome {
    /// Below this, quadratic convergence has arrived: another step can't help.
    const DONE: f64 = 4e-15;
    /// Below this, it has where the last step was short: what is left of it is rounding.
    const NEARLY_DONE: f64 = 1e-13;
    /// Radians.
    const SHORT: f64 = 1e-7;
    /// From here on a residual that stops falling has met its rounding errors.
    const CLOSE: f64 = 1e-10;
    let mut least = f64::INFINITY;
    let mut waited = 0;
    let mut iterations = 0;
    let mut step = f64::INFINITY;
    loop {
        let residual = system.residual();
        let outcome = Outcome { iterations, residual };
        let is_done = residual <= if step <= SHORT { NEARLY_DONE } else { DONE };
        let ends = is_done || iterations >= limits.iterations || !residual.is_finite();
        if ends || !goes_on(outcome) {
            return outcome;
        }
        if residual < 0.5 * least {
            waited = 0;
        } else {
            waited += 1;
            if residual < CLOSE || waited > limits.patience {
                return outcome;
            }
        }
        least = least.min(residual);
        system.linearize(matrix);
        matrix.solve();
        step = system.advance(&matrix.right);
        iterations += 1;
    }
}

/// The larger number, as residuals add up; not a number if either isn't.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::block_tridiagonal::BlockRow;

    /// x² = i + 1, coupled weakly: xᵢ² + (xᵢ₋₁ + xᵢ₊₁)/100 = known.
    struct Squares {
        x: Vec<f64>,
        right: Vec<f64>,
    }

    impl Squares {
        fn error(&self, i: usize) -> f64 {
            let n = self.x.len();
            let (before, after) = (self.x[(i + n - 1) % n], self.x[(i + 1) % n]);
            self.right[i] - self.x[i] * self.x[i] - (before + after) / 100.0
        }
    }

    impl System<1> for Squares {
        fn residual(&mut self) -> f64 {
            (0..self.x.len()).fold(0.0f64, |largest, i| largest.max(self.error(i).abs()))
        }

        fn linearize(&self, matrix: &mut BlockTridiagonal<1>) {
            for i in 0..self.x.len() {
                matrix.rows[i] = BlockRow::new([[0.01]], [[2.0 * self.x[i]]], [[0.01]]);
                matrix.right[i] = [self.error(i)];
            }
        }

        fn advance(&mut self, step: &[[f64; 1]]) -> f64 {
            self.x.iter_mut().zip(step).for_each(|(x, step)| *x += step[0]);
            step.iter().fold(0.0f64, |size, step| size.max(step[0].abs()))
        }
    }

    #[test]
    fn converges_quadratically() {
        let n = 9;
        let exact: Vec<f64> = (1..=n).map(|i| f64::from(i).sqrt()).collect();
        let around = |i: usize| exact[(i + 8) % 9] + exact[(i + 1) % 9];
        let right = (0..9).map(|i| exact[i] * exact[i] + around(i) / 100.0).collect();
        let mut system = Squares { x: vec![1.0; 9], right };
        let mut matrix = BlockTridiagonal::new(9, true);
        let outcome = newton(&mut system, &mut matrix, Limits { iterations: 20, patience: 5 });
        assert!(outcome.residual < 1e-14 && outcome.iterations <= 8, "{outcome:?}");
        for (x, exact) in system.x.iter().zip(&exact) {
            assert!((x - exact).abs() < 1e-14);
        }
    }
}
