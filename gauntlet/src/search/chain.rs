//! The equations of one run, set up afresh: four unknowns a segment, the conditions of thesis Table
//! 7.1 and of decision 5 in plain form, and Newton's method for them.

use std::f64::consts::TAU;

use faircurve::Join;
use faircurve::frame::{direction, wrap_angle};
use faircurve::numeric::spiro_integral::spiro_moments;
use faircurve::plan::Run;

use super::banded::Banded;
use crate::residual::turning_of;

/// How far k₀ … k₃ bend a segment to either side of its middle: the units of steps.
const BENDS: [f64; 4] = [2.0, 8.0, 48.0, 384.0];

/// Segments longer than this many chords are no solution.
const LONGEST: f64 = 1000.0;

/// A condition at a knot: what leaves, less what arrives, less a target is zero. A side that isn't
/// named counts as nothing.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// 0 is the direction against the chord, 1 … 3 are κ, κ′, κ″ at the knot's scale.
    order: usize,
    arrives: bool,
    leaves: bool,
    target: f64,
    /// Whether whole turns may be added to the target.
    winds: bool,
}

impl Row {
    fn equal(order: usize) -> Row {
        Row { order, arrives: true, leaves: true, target: 0.0, winds: false }
    }

    fn before(order: usize, target: f64) -> Row {
        Row { order, arrives: true, leaves: false, target: -target, winds: false }
    }

    fn after(order: usize, target: f64) -> Row {
        Row { order, arrives: false, leaves: true, target, winds: false }
    }
}

/// A segment's ends for chord 1, and how they respond to k₀ … k₃.
#[derive(Clone, Debug)]
struct Ends {
    /// At the start and at the end: direction against the chord, κ, κ′, κ″.
    values: [[f64; 4]; 2],
    by_k: [[[f64; 4]; 4]; 2],
    /// Chord over arc length.
    straightness: f64,
}

impl Ends {
    fn of(k: [f64; 4]) -> Ends {
        /// sⁿ/n! at s = ½.
        const POWERS: [f64; 5] = [1.0, 0.5, 1.0 / 8.0, 1.0 / 48.0, 1.0 / 384.0];
        let moments = spiro_moments(k);
        let chord = moments.integral();
        let (c, psi) = (chord.norm_sqr().sqrt(), chord.arg());
        let g: [_; 4] = std::array::from_fn(|j| moments.derivative(j) / chord);
        let (mut values, mut by_k) = ([[0.0; 4]; 2], [[[0.0; 4]; 4]; 2]);
        for (end, sign) in [-1.0f64, 1.0].into_iter().enumerate() {
            let power = |n: usize| POWERS[n] * sign.powi(n as i32);
            values[end][0] = (0..4).map(|j| k[j] * power(j + 1)).sum::<f64>() - psi;
            by_k[end][0] = std::array::from_fn(|j| power(j + 1) - g[j].im);
            for order in 1..4 {
                let derivative: f64 = (order - 1..4).map(|j| k[j] * power(j + 1 - order)).sum();
                let scale = c.powi(order as i32);
                values[end][order] = scale * derivative;
                by_k[end][order] = std::array::from_fn(|j| {
                    let own = if j + 1 >= order { power(j + 1 - order) } else { 0.0 };
                    scale * (own + order as f64 * derivative * g[j].re)
                });
            }
        }
        Ends { values, by_k, straightness: c }
    }
}

/// k₀ … k₃ of every segment, and how many whole turns each knot takes beside its natural one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct State {
    pub(super) k: Vec<[f64; 4]>,
    pub(super) windings: Vec<i32>,
}

impl State {
    /// ∫|κ| ds, radians.
    pub(super) fn turning(&self) -> f64 {
        self.k.iter().map(|k| turning_of(*k)).sum()
    }
}

/// The equations of a run.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) chords: Vec<f64>,
    /// Turning from the chord before to the chord after each knot.
    pub(super) turns: Vec<f64>,
    rows: Vec<Vec<Row>>,
    pub(super) closed: bool,
}

impl Chain {
    /// The equations of a run as asked.
    pub(super) fn new(run: &Run) -> Chain {
        let n = run.knots.len();
        let rows = (0..n).map(|i| rows(run, i)).collect();
        Chain {
            chords: (0..run.segment_count()).map(|i| run.chord(i).hypot()).collect(),
            turns: run.knots.iter().map(|knot| knot.turn).collect(),
            rows,
            closed: run.closed,
        }
    }

    /// Straight segments in the natural windings.
    pub(super) fn straight(&self) -> State {
        State { k: vec![[0.0; 4]; self.chords.len()], windings: vec![0; self.rows.len()] }
    }

    pub(super) fn segments(&self) -> usize {
        self.chords.len()
    }

    pub(super) fn knots(&self) -> usize {
        self.rows.len()
    }

    /// The segments before and after a knot.
    pub(super) fn around(&self, knot: usize) -> (Option<usize>, Option<usize>) {
        let before = match knot {
            0 => self.closed.then(|| self.segments() - 1),
            _ => Some(knot - 1),
        };
        (before, (knot < self.segments()).then_some(knot))
    }

    /// The same equations with other chords, turns and targets: at 1 as they are, at 0 easy.
    pub(super) fn eased(&self, t: f64, by: Ease) -> Chain {
        let mut eased = self.clone();
        match by {
            Ease::Chords => {
                let logs = self.chords.iter().map(|chord| chord.ln());
                let mean = (logs.sum::<f64>() / self.chords.len() as f64).exp();
                eased.chords.iter_mut().for_each(|c| *c = c.powf(t) * mean.powf(1.0 - t));
            }
            Ease::Turns => {
                eased.turns.iter_mut().for_each(|turn| *turn *= t);
                eased.rows.iter_mut().flatten().for_each(|row| row.target *= t);
            }
        }
        eased
    }

    /// The segments `from .. from + count` alone, around the end of a closed run. An end where it is
    /// cut is free, or held as the `state` beyond has it now.
    pub(super) fn part(&self, from: usize, count: usize, held: Option<&State>) -> Chain {
        let (n, m) = (self.knots(), self.segments());
        let knot = |i: usize| (from + i) % n;
        let mut rows: Vec<Vec<Row>> = (0..=count).map(|i| self.rows[knot(i)].clone()).collect();
        let free = |side: fn(usize, f64) -> Row| vec![side(2, 0.0), side(3, 0.0)];
        let one_sided = |rows: &[Row], leaves: bool| -> Vec<Row> {
            let own = rows.iter().filter(|row| row.leaves == leaves && row.arrives != leaves);
            own.copied().collect()
        };
        if let (Some(before), _) = self.around(from) {
            let own = one_sided(&rows[0], true);
            rows[0] = match held {
                None => free(Row::after),
                Some(state) => {
                    let ends = Ends::of(state.k[before]).values[1];
                    let turn = self.turns[from] + TAU * f64::from(state.windings[from]);
                    let curvature = ends[1] * self.chords[from % m] / self.chords[before];
                    let held = [Row::after(0, ends[0] - turn), Row::after(1, curvature)];
                    own.into_iter().chain(held).take(2).collect()
                }
            };
        }
        let last = knot(count);
        if let (_, Some(after)) = self.around(last) {
            let own = one_sided(&rows[count], false);
            rows[count] = match held {
                None => free(Row::before),
                Some(state) => {
                    let ends = Ends::of(state.k[after]).values[0];
                    let turn = self.turns[last] + TAU * f64::from(state.windings[last]);
                    let inside = (from + count - 1) % m;
                    let curvature = ends[1] * self.chords[inside] / self.chords[after];
                    let held = [Row::before(0, ends[0] + turn), Row::before(1, curvature)];
                    own.into_iter().chain(held).take(2).collect()
                }
            };
        }
        Chain {
            chords: (0..count).map(|i| self.chords[(from + i) % m]).collect(),
            turns: (0..=count).map(|i| self.turns[knot(i)]).collect(),
            rows,
            closed: false,
        }
    }

    /// What a segment with these parameters has at its ends for chord 1, at the start and at the
    /// end: direction against the chord, and curvature.
    pub(super) fn end_jets(k: [f64; 4]) -> [[f64; 2]; 2] {
        Ends::of(k).values.map(|[direction, curvature, ..]| [direction, curvature])
    }

    /// Sets the windings to those nearest to what the segments do.
    pub(super) fn wind(&self, state: &mut State) {
        for knot in 0..self.knots() {
            if let (Some(before), Some(after)) = self.around(knot) {
                let arrive = Chain::end_jets(state.k[before])[1][0];
                let leave = Chain::end_jets(state.k[after])[0][0];
                let off = arrive - leave - self.turns[knot];
                state.windings[knot] = (off / TAU).round() as i32;
            }
        }
    }

    /// The length that makes a knot's equations dimensionless.
    fn scale(&self, knot: usize) -> f64 {
        match self.around(knot) {
            (Some(l), Some(r)) => 2.0 / (self.chords[l].recip() + self.chords[r].recip()),
            (Some(only), None) | (None, Some(only)) => self.chords[only],
            (None, None) => 1.0,
        }
    }

    fn value(&self, state: &State, ends: &[Ends], knot: usize, row: &Row) -> f64 {
        let (before, after) = self.around(knot);
        let scale = self.scale(knot);
        let side = |segment: Option<usize>, end: usize, counts: bool| match segment {
            Some(segment) if counts => {
                let weight = (scale / self.chords[segment]).powi(row.order as i32);
                ends[segment].values[end][row.order] * weight
            }
            _ => 0.0,
        };
        let mut target = row.target;
        if row.order == 0 && row.arrives && row.leaves {
            target -= self.turns[knot];
        }
        if row.winds {
            target -= TAU * f64::from(state.windings[knot]);
        }
        side(after, 0, row.leaves) - side(before, 1, row.arrives) - target
    }

    /// The largest violation at each knot, infinite beside segments that are too long.
    pub(super) fn violations(&self, state: &State) -> Vec<f64> {
        let ends: Vec<Ends> = state.k.iter().map(|k| Ends::of(*k)).collect();
        (0..self.knots())
            .map(|knot| {
                let (before, after) = self.around(knot);
                let is_short = |segment: usize| ends[segment].straightness * LONGEST >= 1.0;
                if !before.into_iter().chain(after).all(is_short) {
                    return f64::INFINITY;
                }
                self.rows[knot]
                    .iter()
                    .map(|row| self.value(state, &ends, knot, row).abs())
                    .fold(0.0, |a, b| if b.is_finite() { f64::max(a, b) } else { f64::INFINITY })
            })
            .collect()
    }

    /// The largest violation.
    pub(super) fn residual(&self, state: &State) -> f64 {
        self.violations(state).into_iter().fold(0.0, f64::max)
    }

    /// Violations of all equations in a state, and the changes of k₀ … k₃ in units of [`BENDS`] that
    /// would undo them and each of some other violations.
    fn linear_solve(&self, state: &State, others: &[Vec<f64>]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let ends: Vec<Ends> = state.k.iter().map(|k| Ends::of(*k)).collect();
        let m = self.segments();
        // A closed run is folded, so that its two halves lie side by side and all is near the diagonal.
        let place = |segment: usize| match self.closed {
            false => segment,
            true if segment < m.div_ceil(2) => 2 * segment,
            true => 2 * (m - 1 - segment) + 1,
        };
        let mut knots: Vec<usize> = (0..self.knots()).collect();
        knots.sort_by_key(|&knot| {
            let (before, after) = self.around(knot);
            let (a, b) = (before.map(place), after.map(place));
            (a.unwrap_or(0).min(b.unwrap_or(m)), a.unwrap_or(0).max(b.unwrap_or(0)))
        });
        let equations: Vec<(usize, &Row)> = knots
            .iter()
            .flat_map(|&knot| self.rows[knot].iter().map(move |row| (knot, row)))
            .collect();
        let (mut below, mut above) = (0, 0);
        for (row, (knot, _)) in equations.iter().enumerate() {
            let (before, after) = self.around(*knot);
            for segment in before.into_iter().chain(after) {
                below = below.max(row.saturating_sub(4 * place(segment)));
                above = above.max((4 * place(segment) + 3).saturating_sub(row));
            }
        }
        let mut matrix = Banded::new(4 * m, below, above);
        let mut values = Vec::with_capacity(4 * m);
        for (i, (knot, row)) in equations.iter().enumerate() {
            let (before, after) = self.around(*knot);
            let scale = self.scale(*knot);
            values.push(self.value(state, &ends, *knot, row));
            for (segment, end, sign, counts) in
                [(after, 0, 1.0, row.leaves), (before, 1, -1.0, row.arrives)]
            {
                if let (Some(segment), true) = (segment, counts) {
                    let weight = sign * (scale / self.chords[segment]).powi(row.order as i32);
                    for j in 0..4 {
                        let by = ends[segment].by_k[end][row.order][j] * BENDS[j];
                        matrix.add(i, 4 * place(segment) + j, weight * by);
                    }
                }
            }
        }
        let mut sides = vec![values.clone()];
        sides.extend(others.iter().cloned());
        matrix.solve(&mut sides);
        let unfolded = |side: &Vec<f64>| -> Vec<f64> {
            (0..4 * m).map(|i| side[4 * place(i / 4) + i % 4]).collect()
        };
        let steps = sides.iter().map(unfolded).collect();
        (values, steps)
    }

    /// Newton's method with each segment's step limited to `clamp` radians of bend. Returns the
    /// residual reached.
    pub(super) fn newton(&self, state: &mut State, clamp: f64, steps: usize) -> f64 {
        /// Beyond this bend nothing comes back.
        const LOST: f64 = 1e4;
        /// Two more steps than quadratic convergence needs from here.
        const NEAR: f64 = 1e-6;
        let mut near = 0;
        for _ in 0..steps {
            let (values, step) = self.linear_solve(state, &[]);
            let largest = values.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            if !values.iter().all(|value| value.is_finite()) {
                return f64::INFINITY;
            }
            near += usize::from(largest < NEAR);
            if near > 2 || largest < 1e-13 {
                break;
            }
            self.advance(state, &step[0], clamp);
            if state.k.iter().any(|k| bend(*k) > LOST) {
                return f64::INFINITY;
            }
        }
        self.residual(state)
    }

    fn advance(&self, state: &mut State, step: &[f64], clamp: f64) {
        for (k, step) in state.k.iter_mut().zip(step.chunks_exact(4)) {
            let size: f64 = step.iter().map(|change| change.abs()).sum();
            let factor = if size > clamp { clamp / size } else { 1.0 };
            if size.is_finite() {
                (0..4).for_each(|j| k[j] -= factor * step[j] * BENDS[j]);
            }
        }
    }

    /// Follows the curve of solutions (state, t) of the eased equations from t = 0 through folds, and
    /// calls `found` wherever it passes t = 1, until that says to stop, the curve is lost, or after
    /// `steps` steps.
    pub(super) fn follow(
        &self,
        by: Ease,
        start: State,
        steps: usize,
        mut found: impl FnMut(State) -> bool,
    ) {
        const LONGEST_STEP: f64 = 0.5;
        const SHORTEST_STEP: f64 = 1e-5;
        let (mut state, mut t) = (start, 0.0);
        if !(self.eased(0.0, by).newton(&mut state, 1.0, 30) < 1e-9) {
            return;
        }
        let (mut length, mut last): (f64, Option<(Vec<f64>, f64)>) = (0.02, None);
        for _ in 0..steps {
            // The tangent: (−J⁻¹ F_t, 1), in the sense of the last one.
            let Some(by_t) = self.by_t(by, &state, t) else { return };
            let (_, solved) = self.eased(t, by).linear_solve(&state, &[by_t]);
            let mut tangent: Vec<f64> = solved[1].iter().map(|x| -x).collect();
            let norm = (tangent.iter().map(|x| x * x).sum::<f64>() + 1.0).sqrt();
            let mut along = 1.0 / norm;
            tangent.iter_mut().for_each(|x| *x /= norm);
            if let Some((before, t_before)) = &last {
                let dot = before.iter().zip(&tangent).map(|(a, b)| a * b).sum::<f64>();
                if dot + t_before * along < 0.0 {
                    tangent.iter_mut().for_each(|x| *x = -*x);
                    along = -along;
                }
            }
            // Predict, then correct at right angles to the tangent.
            let corrected = loop {
                if length < SHORTEST_STEP {
                    return;
                }
                match self.correct(by, &state, t, &tangent, along, length) {
                    Some(corrected) => break corrected,
                    None => length /= 2.0,
                }
            };
            let (next, next_t, corrections) = corrected;
            if (t < 1.0) != (next_t < 1.0) {
                let mut root = next.clone();
                let part = (1.0 - t) / (next_t - t);
                for (k, before) in root.k.iter_mut().zip(&state.k) {
                    (0..4).for_each(|j| k[j] = before[j] + part * (k[j] - before[j]));
                }
                if found(root) {
                    return;
                }
            }
            if !(-0.2..=3.0).contains(&next_t) {
                return;
            }
            if corrections <= 3 {
                length = (1.5 * length).min(LONGEST_STEP);
            }
            (state, t) = (next, next_t);
            last = Some((tangent, along));
        }
    }

    /// How the equations change with t, by difference.
    fn by_t(&self, by: Ease, state: &State, t: f64) -> Option<Vec<f64>> {
        const STEP: f64 = 1e-6;
        let at = |t: f64| self.eased(t, by).linear_values(state);
        let (low, high) = (at(t - STEP), at(t + STEP));
        let slope: Vec<f64> = low.iter().zip(&high).map(|(a, b)| (b - a) / (2.0 * STEP)).collect();
        slope.iter().all(|x| x.is_finite()).then_some(slope)
    }

    /// All violations in the order of [`linear_solve`](Self::linear_solve).
    fn linear_values(&self, state: &State) -> Vec<f64> {
        self.linear_solve(state, &[]).0
    }

    /// A step of that length along the tangent, and Newton's method at right angles to it. Returns
    /// the point and the number of corrections; `None` if it doesn't settle nearby.
    fn correct(
        &self,
        by: Ease,
        state: &State,
        t: f64,
        tangent: &[f64],
        along: f64,
        length: f64,
    ) -> Option<(State, f64, usize)> {
        const MOST: usize = 8;
        let mut at = state.clone();
        let move_by = |at: &mut State, change: &[f64], factor: f64| {
            for (k, change) in at.k.iter_mut().zip(change.chunks_exact(4)) {
                (0..4).for_each(|j| k[j] += factor * change[j] * BENDS[j]);
            }
        };
        move_by(&mut at, tangent, length);
        let mut t = t + length * along;
        for corrections in 0..MOST {
            let by_t = self.by_t(by, &at, t)?;
            let (values, steps) = self.eased(t, by).linear_solve(&at, &[by_t]);
            let largest = values.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            if !largest.is_finite() {
                return None;
            }
            if largest < 1e-9 {
                return Some((at, t, corrections));
            }
            // x = −(a + b τ) with tangent · x + along τ = 0.
            let dot = |v: &[f64]| v.iter().zip(tangent).map(|(a, b)| a * b).sum::<f64>();
            let tau = dot(&steps[0]) / (along - dot(&steps[1]));
            let change: Vec<f64> =
                steps[0].iter().zip(&steps[1]).map(|(a, b)| -(a + b * tau)).collect();
            let size = change.iter().fold(tau.abs(), |a, b| a.max(b.abs()));
            if !(size < 2.0 * length.max(0.05)) {
                return None;
            }
            move_by(&mut at, &change, 1.0);
            t += tau;
        }
        None
    }
}

/// What is eased.
#[derive(Clone, Copy, Debug)]
pub(super) enum Ease {
    /// Chords toward their geometric mean.
    Chords,
    /// Turns and what is given toward zero.
    Turns,
}

/// The largest change of direction that such parameters make on a segment, a bound.
fn bend(k: [f64; 4]) -> f64 {
    (0..4).map(|j| k[j].abs() / BENDS[j]).sum()
}

/// Chord over arc length.
pub(super) fn straightness(k: [f64; 4]) -> f64 {
    spiro_moments(k).integral().norm_sqr().sqrt()
}

/// The conditions at a knot of a run, by Table 7.1; what is given takes the place of some, by
/// decision 5.
fn rows(run: &Run, i: usize) -> Vec<Row> {
    let n = run.knots.len();
    let knot = &run.knots[i];
    let before = if i > 0 { Some(i - 1) } else { run.closed.then(|| n - 1) };
    let after = (i < run.segment_count()).then_some(i);
    let off = |segment: usize, tangent: f64| wrap_angle(tangent - direction(run.chord(segment)));
    let scale = |segment: usize| run.chord(segment).hypot();
    match (before, after) {
        (Some(l), Some(r)) => {
            let mut first = Row { winds: true, ..Row::equal(0) };
            let (mut third, mut fourth) = match knot.join {
                Join::G4 => (Row::equal(2), Row::equal(3)),
                Join::CurveToTerminal => (Row::after(2, 0.0), Row::after(3, 0.0)),
                Join::TerminalToCurve => (Row::before(2, 0.0), Row::before(3, 0.0)),
                _ => (Row::before(3, 0.0), Row::after(3, 0.0)),
            };
            let given_direction = knot.tangent.map(|tangent| {
                // The target of the sum takes the turn off again.
                first.target = knot.turn + off(r, tangent) - off(l, tangent);
                Row::after(0, off(r, tangent))
            });
            let h = 2.0 / (scale(l).recip() + scale(r).recip());
            let given_curvature = knot.curvature.map(|curvature| Row::after(1, curvature * h));
            match (given_direction, given_curvature, knot.join) {
                (None, None, _) => {}
                (Some(a), Some(b), _) => (third, fourth) = (a, b),
                (None, Some(b), Join::G2) => (third, fourth) = (Row::equal(3), b),
                (Some(a), None, Join::G4) => fourth = a,
                (Some(given), None, _) | (None, Some(given), _) => third = given,
            }
            vec![first, Row::equal(1), third, fourth]
        }
        (before, after) => {
            let side: fn(usize, f64) -> Row =
                if after.is_some() { Row::after } else { Row::before };
            let segment = after.or(before).unwrap_or(0);
            let direction =
                knot.tangent.map(|tangent| Row { winds: true, ..side(0, off(segment, tangent)) });
            let curvature = knot.curvature.map(|curvature| side(1, curvature * scale(segment)));
            let given = [direction, curvature].into_iter().flatten();
            // κ′ = 0 goes first.
            let rest = [side(3, 0.0), side(2, 0.0)];
            given.chain(rest).take(2).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Random;
    use faircurve::plan::Plan;
    use faircurve::{Contour, Knot, catalog};

    fn chain_of(contour: &Contour) -> Chain {
        let spiro = catalog::spline("spiro").unwrap();
        Chain::new(&Plan::new(contour, &*spiro).unwrap().runs()[0])
    }

    fn blob(closed: bool) -> Contour {
        let points = [(0.0, 0.0), (100.0, 10.0), (180.0, 90.0), (150.0, 200.0), (20.0, 180.0)];
        let knots = points.map(|point| Knot::new(point).join(Join::G4));
        if closed { Contour::closed(knots) } else { Contour::open(knots) }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let mut random = Random::for_case("chain", 0);
        for scale in [0.1, 3.0, 40.0] {
            let k: [f64; 4] = std::array::from_fn(|_| scale * random.between(-1.0, 1.0));
            let ends = Ends::of(k);
            for j in 0..4 {
                const H: f64 = 1e-5;
                let moved = |h: f64| {
                    let mut k = k;
                    k[j] += h;
                    Ends::of(k).values
                };
                let (low, high) = (moved(-H), moved(H));
                for end in 0..2 {
                    for order in 0..4 {
                        let slope = (high[end][order] - low[end][order]) / (2.0 * H);
                        let by = ends.by_k[end][order][j];
                        assert!((slope - by).abs() < 1e-6 * (1.0 + scale * scale), "{slope} {by}");
                    }
                }
            }
        }
    }

    #[test]
    fn easy_contours_are_solved_from_straight_lines() {
        for closed in [false, true] {
            let chain = chain_of(&blob(closed));
            let mut state = chain.straight();
            assert!(chain.newton(&mut state, 1.0, 20) < 1e-11, "{closed}");
        }
    }

    #[test]
    fn following_from_easy_equations_ends_at_the_same_curve() {
        let chain = chain_of(&blob(true));
        let mut direct = chain.straight();
        chain.newton(&mut direct, 1.0, 20);
        for by in [Ease::Chords, Ease::Turns] {
            let mut reached = None;
            chain.follow(by, chain.straight(), 500, |mut root| {
                chain.newton(&mut root, 1.0, 20);
                reached = Some(root.turning());
                true
            });
            let off = reached.map(|turning| (turning - direct.turning()).abs());
            assert!(off.is_some_and(|off| off < 1e-9), "{by:?} {off:?}");
        }
    }

    #[test]
    fn a_part_held_as_it_is_stays_as_it_is() {
        let chain = chain_of(&blob(true));
        let mut whole = chain.straight();
        chain.newton(&mut whole, 1.0, 20);
        for from in 0..5 {
            let part = chain.part(from, 3, Some(&whole));
            let windings = (0..=3).map(|i| whole.windings[(from + i) % 5]).collect();
            let k = (0..3).map(|i| whole.k[(from + i) % 5]).collect();
            assert!(part.residual(&State { k, windings }) < 1e-11, "{from}");
        }
    }
}
