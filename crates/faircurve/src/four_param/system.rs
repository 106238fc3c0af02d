//! The equations of a four-parameter spline over one run (thesis section 8.3.2, reorganised).
//!
//! Each segment carries its own parameters as the state, so that it always meets its end *points*;
//! what doesn't hold yet shows at the knots, as a mismatch of direction, curvature and so on. The
//! unknowns of a Newton step are one direction and one curvature a knot: each segment's
//! four parameters follow from those at its two ends, and each knot's other two conditions are the
//! equations. Whatever the joins, that is the same block tridiagonal system with blocks of 2.

use std::f64::consts::{PI, TAU};

use super::constraint_table::{self as table, Condition, Quantity, SegmentConstraints, Side};
use super::family::{Ends, FourParamFamily, Response};
use crate::frame::{direction, wrap_angle};
use crate::numeric::block_tridiagonal::{BlockRow, BlockTridiagonal};
use crate::numeric::newton::{System, larger};
use crate::numeric::rounding::{fixed, floating};
use crate::outline::Join;
use crate::plan::Run;
use crate::tolerance::LOOP;

/// An equation at a knot, beside continuity of direction and curvature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Equation {
    /// A condition of the table, about κ′ or κ″.
    Condition(Condition),
    /// The direction is given: this angle from the knot's own side (`theta0` on the right side,
    /// `theta1` at the end of an open run).
    Direction(f64),
    /// The curvature is given, in the run's units.
    Curvature(f64),
}

/// A knot of the run.
#[derive(Clone, Copy, Debug)]
pub(super) struct SystemKnot {
    /// The two equations.
    pub equations: [Equation; 2],
    /// Turning from the chord before to the chord after. Not wrapped: another winding is another
    /// curve.
    pub turn: f64,
    /// Harmonic mean of the two chords: the length that makes equations dimensionless.
    h: f64,
    /// h over the chord before and over the chord after, where there are any.
    scale: [f64; 2],
    /// Their reciprocals.
    unscale: [f64; 2],
}

impl SystemKnot {
    fn new(equations: [Equation; 2], turn: f64, left: Option<f64>, right: Option<f64>) -> Self {
        let mut knot = SystemKnot { equations, turn, h: 1.0, scale: [1.0; 2], unscale: [1.0; 2] };
        knot.set_chords(left, right);
        knot
    }

    /// The knot between chords of these lengths.
    fn set_chords(&mut self, left: Option<f64>, right: Option<f64>) {
        self.h = match (left, right) {
            (Some(l), Some(r)) => 2.0 * l * r / (l + r),
            (Some(only), None) | (None, Some(only)) => only,
            (None, None) => 1.0,
        };
        self.scale = [left, right].map(|chord| chord.map_or(1.0, |chord| self.h / chord));
        self.unscale = [left, right].map(|chord| chord.map_or(1.0, |chord| chord / self.h));
    }

    /// [`scale`](Self::scale) to the power of a curvature's derivative of this order.
    fn weight(&self, side: usize, order: usize) -> f64 {
        let scale = self.scale[side];
        if order == 1 { scale * scale } else { scale * scale * scale }
    }
}

/// By how much what is asked of a knot doesn't hold: dimensionless, right side minus left.
#[derive(Clone, Copy, Debug, Default)]
struct Mismatch {
    direction: f64,
    curvature: f64,
    /// Of the knot's own two equations.
    equations: [f64; 2],
}

impl Mismatch {
    /// The largest of them.
    fn worst(&self) -> f64 {
        let [first, second] = self.equations;
        let [direction, curvature] = [self.direction.abs(), self.curvature.abs()];
        larger(larger(direction, curvature), larger(first.abs(), second.abs()))
    }
}

/// What Newton's method changes: the parameters of every segment, and the winding at every knot.
pub(super) type State = (Vec<[f64; 4]>, Vec<f64>);

/// The equations of a run, with the state of its segments.
#[derive(Clone)]
pub(super) struct RunSystem<'a> {
    family: &'a dyn FourParamFamily,
    pub knots: Vec<SystemKnot>,
    chords: Vec<f64>,
    /// The family's parameters of each segment: the state.
    pub parameters: Vec<[f64; 4]>,
    responses: Vec<Response>,
    /// The parameters that the responses are for.
    answered: Vec<[f64; 4]>,
    /// What doesn't hold at each knot.
    mismatches: Vec<Mismatch>,
    closed: bool,
    /// Whether segments are evaluated roughly.
    rough: bool,
    /// Whether the last step was so short that how segments respond is still the same.
    is_near: bool,
}

impl<'a> RunSystem<'a> {
    /// The equations of `run`, from straight segments.
    pub(super) fn new(family: &'a dyn FourParamFamily, run: &Run) -> Self {
        let n = run.knots.len();
        let segments = run.segment_count();
        let chords: Vec<f64> = (0..segments).map(|i| run.chord(i).hypot()).collect();
        let knots = (0..n)
            .map(|i| {
                let (left, right) = neighbours(i, n, run.closed);
                let (equations, turn) = equations(run, i, left, right);
                SystemKnot::new(equations, turn, left.map(|l| chords[l]), right.map(|r| chords[r]))
            })
            .collect();
        RunSystem {
            family,
            knots,
            chords,
            parameters: vec![[0.0; 4]; segments],
            responses: Vec::with_capacity(segments),
            answered: Vec::with_capacity(segments),
            mismatches: vec![Mismatch::default(); n],
            closed: run.closed,
            rough: false,
            is_near: false,
        }
    }

    /// The same equations with every number rounded to about eight digits, in units of the longest
    /// chord, and segments evaluated to seven, from straight segments.
    ///
    /// Runs that differ by a similarity differ in their last digits; rounded, they are the same run,
    /// and so is all that a search makes of it, however sensitive.
    pub(super) fn rounded(&self) -> Self {
        let longest = self.chords.iter().copied().fold(0.0, f64::max);
        let n = self.knots.len();
        let mut rounded = RunSystem { rough: true, ..self.clone() };
        rounded.parameters.fill([0.0; 4]);
        rounded.forget();
        rounded.chords.iter_mut().for_each(|chord| *chord = floating(*chord / longest));
        for (i, knot) in rounded.knots.iter_mut().enumerate() {
            let (left, right) = neighbours(i, n, self.closed);
            knot.set_chords(left.map(|l| rounded.chords[l]), right.map(|r| rounded.chords[r]));
            knot.turn = fixed(knot.turn);
            for equation in &mut knot.equations {
                match equation {
                    Equation::Direction(angle) => *angle = fixed(*angle),
                    Equation::Curvature(curvature) => *curvature = floating(*curvature * longest),
                    Equation::Condition(_) => {}
                }
            }
        }
        // Which way a knot turns that goes straight on, or straight back, is nothing but rounding: the
        // former takes the way of the first that turns, the latter the other way (with which a few
        // more are solved), so that mirroring the run mirrors the search.
        let is_either = |turn: f64| turn == 0.0 || turn.abs() == fixed(PI);
        let first = rounded.knots.iter().map(|knot| knot.turn).find(|turn| !is_either(*turn));
        let way = first.unwrap_or(1.0);
        for knot in rounded.knots.iter_mut().filter(|knot| is_either(knot.turn)) {
            knot.turn = knot.turn.copysign(if knot.turn == 0.0 { way } else { -way });
        }
        rounded
    }

    /// Takes over segments and windings from a system that [`rounded`](Self::rounded) made.
    pub(super) fn take_from_rounded(&mut self, rounded: &Self) {
        self.parameters.clone_from(&rounded.parameters);
        for (knot, other) in self.knots.iter_mut().zip(&rounded.knots) {
            knot.turn += TAU * ((other.turn - knot.turn) / TAU).round();
        }
        self.evaluate();
    }

    /// Removes from the parameters what rounding has left of quantities that are zero by Table 7.1.
    pub(super) fn clean(&mut self) {
        /// What counts as rounding, in radians at the chord; residuals don't notice it.
        const NEGLIGIBLE: f64 = 1e-12;
        for i in 0..self.parameters.len() {
            let mut clean = self.parameters[i];
            self.constraints(i).enforce(&mut clean);
            let change = (0..4)
                .fold(0.0, |change: f64, j| change.max((clean[j] - self.parameters[i][j]).abs()));
            if change <= NEGLIGIBLE * self.straightness(i) {
                self.parameters[i] = clean;
            }
        }
    }

    /// Makes a segment's parameters obey the zero conditions on it.
    pub(super) fn enforce(&mut self, segment: usize) {
        let constraints = self.constraints(segment);
        constraints.enforce(&mut self.parameters[segment]);
    }

    /// The zero conditions on a segment.
    fn constraints(&self, segment: usize) -> SegmentConstraints {
        let n = self.knots.len();
        let conditions = |knot: usize| {
            self.knots[knot].equations.into_iter().filter_map(|equation| match equation {
                Equation::Condition(condition) => Some(condition),
                _ => None,
            })
        };
        SegmentConstraints::between(conditions(segment), conditions((segment + 1) % n))
    }

    /// Residual of one knot: the largest of its mismatches and equations; infinite beside a segment
    /// that is no solution even where its equations hold, because it wanders off.
    pub(super) fn knot_residual(&self, i: usize) -> f64 {
        /// In chords. Such segments nearly close into circles; the longer, the more the rest of the
        /// curve hangs on their rounding errors.
        const LONGEST: f64 = 1000.0;
        let (left, right) = neighbours(i, self.knots.len(), self.closed);
        let beside = [left, right].into_iter().flatten();
        if beside.into_iter().any(|segment| self.straightness(segment) * LONGEST < 1.0) {
            return f64::INFINITY;
        }
        self.mismatches[i].worst()
    }

    /// A system of its own for the knots `from ..= to`, around the end if `to` isn't greater, with
    /// directions and curvatures at its rim held as the segments beyond have them now.
    pub(super) fn window(&self, from: usize, to: usize) -> Self {
        let n = self.knots.len();
        let count = if to > from { to - from } else { to + n - from };
        let knot = |i: usize| (from + i) % n;
        let mut knots: Vec<SystemKnot> = (0..=count).map(|i| self.knots[knot(i)]).collect();
        // What the neighbours beyond the rim say holds, not what lies within.
        if self.closed || from > 0 {
            let before = if from > 0 { from - 1 } else { n - 1 };
            let jets = &self.responses[before].ends.jets;
            let direction = Equation::Direction(self.knots[from].turn - jets[1]);
            let curvature = Equation::Curvature(jets[3] / self.chords[before]);
            knots[0].equations = rim(knots[0].equations, Side::Right, [direction, curvature]);
        }
        if self.closed || to + 1 < n {
            let jets = &self.responses[to].ends.jets;
            let direction = Equation::Direction(self.knots[to].turn - jets[0]);
            let curvature = Equation::Curvature(jets[2] / self.chords[to]);
            knots[count].equations =
                rim(knots[count].equations, Side::Left, [direction, curvature]);
        }
        RunSystem {
            family: self.family,
            chords: (0..count).map(|i| self.chords[knot(i)]).collect(),
            parameters: (0..count).map(|i| self.parameters[knot(i)]).collect(),
            responses: Vec::with_capacity(count),
            answered: Vec::with_capacity(count),
            mismatches: vec![Mismatch::default(); count + 1],
            knots,
            closed: false,
            rough: self.rough,
            is_near: false,
        }
    }

    /// Takes over the state of a window that starts at knot `from`, as it was last evaluated.
    pub(super) fn adopt(&mut self, window: &Self, from: usize) {
        let n = self.knots.len();
        for i in 0..window.parameters.len() {
            self.parameters[(from + i) % n] = window.parameters[i];
            self.responses[(from + i) % n] = window.responses[i];
            self.answered[(from + i) % n] = window.answered[i];
        }
        for (i, knot) in window.knots.iter().enumerate() {
            self.knots[(from + i) % n].turn = knot.turn;
            self.mismatches[(from + i) % n] = self.mismatch_at((from + i) % n);
        }
    }

    /// Lets the run end freely at its last knot.
    pub(super) fn free_end(&mut self) {
        if let Some(last) = self.knots.last_mut() {
            last.equations = table::END.map(Equation::Condition);
        }
    }

    /// Lets the run start freely at its first knot.
    pub(super) fn free_start(&mut self) {
        if let Some(first) = self.knots.first_mut() {
            first.equations = table::START.map(Equation::Condition);
        }
    }

    /// Directions and curvatures that the neighbours of a segment leave to it, for unit chord, as
    /// [`Response::jets`]; `None` where it has no neighbour.
    pub(super) fn ends_beside(&self, segment: usize) -> Option<[f64; 4]> {
        let n = self.knots.len();
        let (start, end) = (segment, (segment + 1) % n);
        let (Some(before), Some(after)) =
            (neighbours(start, n, self.closed).0, neighbours(end, n, self.closed).1)
        else {
            return None;
        };
        let chord = self.chords[segment];
        let (arriving, leaving) =
            (&self.responses[before].ends.jets, &self.responses[after].ends.jets);
        Some([
            self.knots[start].turn - arriving[1],
            self.knots[end].turn - leaving[0],
            arriving[3] * chord / self.chords[before],
            leaving[2] * chord / self.chords[after],
        ])
    }

    /// How much longer a segment is than its neighbours: the square of its chord over the product
    /// of theirs; 0 where it has only one, or isn't joined to both of them in all of κ, κ′, κ″.
    pub(super) fn prominence(&self, segment: usize) -> f64 {
        let chord = self.chords[segment];
        self.smooth_neighbours(segment)
            .map_or(0.0, |[before, after]| chord / before * (chord / after))
    }

    /// The chords on both sides of a segment that is joined to both in all of κ, κ′, κ″.
    #[inline(never)] // for the size of the web's module
    fn smooth_neighbours(&self, segment: usize) -> Option<[f64; 2]> {
        let n = self.knots.len();
        let (start, end) = (segment, (segment + 1) % n);
        let is_joined = |knot: usize| {
            let mut equations = self.knots[knot].equations.iter();
            equations.all(|e| matches!(e, Equation::Condition(Condition::Continuous(_))))
        };
        let before = neighbours(start, n, self.closed).0?;
        let after = neighbours(end, n, self.closed).1?;
        (is_joined(start) && is_joined(end)).then(|| [self.chords[before], self.chords[after]])
    }

    /// For each knot, whether the segment that leaves it is shorter than this share of both its
    /// neighbours, and joined to them in all of κ, κ′, κ″. No two of these are next to each other.
    pub(super) fn short_segments(&self, share: f64) -> Vec<bool> {
        let is_short = |segment: usize| {
            let neighbours = self.smooth_neighbours(segment);
            neighbours.is_some_and(|[a, b]| self.chords[segment] < share * a.min(b))
        };
        (0..self.knots.len()).map(|i| i < self.chords.len() && is_short(i)).collect()
    }

    /// The same run, from straight segments, with the two knots of each [short
    /// segment](Self::short_segments) made one that has the segment's direction: joined in κ and κ′, as
    /// the two are in the limit.
    pub(super) fn fused(&self, is_short: &[bool]) -> Self {
        let n = self.knots.len();
        let mut fused = self.clone();
        for start in (0..n).filter(|&i| is_short[i]) {
            let knot = &mut fused.knots[(start + 1) % n];
            knot.equations = [
                Equation::Condition(Condition::Continuous(Quantity::FirstDerivative)),
                Equation::Direction(knot.turn),
            ];
            knot.turn += self.knots[start].turn;
            let sides = self.smooth_neighbours(start);
            knot.set_chords(sides.map(|[before, _]| before), sides.map(|[_, after]| after));
        }
        let mut of_knots = is_short.iter();
        fused.knots.retain(|_| of_knots.next() == Some(&false));
        let mut of_segments = is_short.iter();
        fused.chords.retain(|_| of_segments.next() == Some(&false));
        fused.forget();
        fused.parameters.truncate(fused.chords.len());
        fused.parameters.fill([0.0; 4]);
        fused.mismatches.truncate(fused.knots.len());
        fused
    }

    /// Takes over segments and windings from a system that [`fused`](Self::fused) made, with the
    /// segments that it lacks straight.
    pub(super) fn take_from_fused(&mut self, fused: &Self, is_short: &[bool]) {
        let n = self.knots.len();
        self.parameters.fill([0.0; 4]);
        for (other, i) in (0..n).filter(|&i| !is_short[i]).enumerate() {
            let turn = fused.knots[other].turn;
            match neighbours(i, n, self.closed).0 {
                Some(start) if is_short[start] => {
                    self.knots[start].turn = turn - self.knots[i].turn;
                }
                _ => self.knots[i].turn = turn,
            }
            if let Some(parameters) = fused.parameters.get(other) {
                self.parameters[i] = *parameters;
            }
        }
        self.evaluate();
    }

    /// Chooses the winding at each knot in which its directions differ least.
    pub(super) fn unwind(&mut self) {
        for i in 0..self.knots.len() {
            let turns = (self.mismatches[i].direction / TAU).round();
            if turns != 0.0 && turns.is_finite() {
                self.knots[i].turn -= TAU * turns;
                self.mismatches[i] = self.mismatch_at(i);
            }
        }
    }

    /// The family.
    pub(super) fn family(&self) -> &'a dyn FourParamFamily {
        self.family
    }

    /// A closed run cut at its first knot, which stands at both free ends.
    pub(super) fn opened(&self) -> Self {
        let mut open = self.window(0, 0);
        open.knots[0].equations = table::START.map(Equation::Condition);
        open.free_end();
        open
    }

    /// What Newton's method changes, to come back to.
    pub(super) fn state(&self) -> State {
        (self.parameters.clone(), self.knots.iter().map(|knot| knot.turn).collect())
    }

    /// Comes back to a state, or takes over that of the same run [`opened`](Self::opened).
    pub(super) fn set_state(&mut self, state: &State) {
        self.parameters.clone_from(&state.0);
        self.knots.iter_mut().zip(&state.1).for_each(|(knot, turn)| knot.turn = *turn);
        self.evaluate();
    }

    /// Whether the last knot joins the first.
    pub(super) fn is_closed(&self) -> bool {
        self.closed
    }

    /// Chord over arc length of each segment, as of the last evaluation.
    pub(super) fn straightness(&self, segment: usize) -> f64 {
        self.responses[segment].ends.straightness
    }

    /// The segments that loop, as of the last evaluation.
    pub(super) fn loops(&self) -> impl Iterator<Item = usize> {
        (0..self.parameters.len()).filter(|&i| !(self.straightness(i) * LOOP > 1.0))
    }

    /// That of the segment with the most winding.
    pub(super) fn least_straightness(&self) -> f64 {
        self.responses.iter().map(|response| response.ends.straightness).fold(1.0, f64::min)
    }

    /// Computes responses and mismatches of the present state. Where a single knot has moved, segments far from it don't
    /// change, and aren't asked again.
    pub(super) fn evaluate(&mut self) {
        let count = self.parameters.len();
        self.responses.resize(count, Response::NONE);
        self.answered.resize(count, NOT_IN_FULL);
        for (i, parameters) in self.parameters.iter().enumerate() {
            if self.answered[i] == *parameters {
                continue;
            }
            match i.checked_sub(1) {
                // As straight segments are, from which a solution starts.
                Some(before) if self.parameters[before] == *parameters => {
                    self.responses.copy_within(before..i, i);
                }
                _ => self.family.respond_to(*parameters, self.rough, &mut self.responses[i]),
            }
            self.answered[i] = *parameters;
        }
        self.compare();
    }

    /// The same after a step that leaves the responses as they are.
    fn evaluate_ends(&mut self) {
        for (response, parameters) in self.responses.iter_mut().zip(&self.parameters) {
            response.ends = self.family.ends(*parameters);
        }
        self.answered.fill(NOT_IN_FULL);
        self.compare();
    }

    /// Forgets all responses: segments are others, or are evaluated otherwise.
    fn forget(&mut self) {
        self.responses.clear();
        self.answered.clear();
    }

    /// Compares what the segments say of each knot.
    fn compare(&mut self) {
        for i in 0..self.knots.len() {
            self.mismatches[i] = self.mismatch_at(i);
        }
    }

    /// The sum of [`bend`](Self::bend) over all segments.
    pub(super) fn total_bend(&self) -> f64 {
        (0..self.parameters.len()).map(|segment| self.bend(segment)).sum()
    }

    /// A bound of how far a segment turns from its middle, in radians.
    pub(super) fn bend(&self, segment: usize) -> f64 {
        self.family.bend(self.parameters[segment])
    }

    fn mismatch_at(&self, i: usize) -> Mismatch {
        let knot = &self.knots[i];
        let (left, right) = neighbours(i, self.knots.len(), self.closed);
        let [before, after] = [left, right].map(|side| side.map(|j| &self.responses[j].ends));
        let [scale_before, scale_after] = knot.scale;
        let (direction, curvature) = match (before, after) {
            (Some(before), Some(after)) => (
                knot.turn - after.jets[0] - before.jets[1],
                after.jets[2] * scale_after - before.jets[3] * scale_before,
            ),
            _ => (0.0, 0.0),
        };
        let value = |equation: Equation| match equation {
            Equation::Direction(angle) => match (before, after) {
                (_, Some(after)) => after.jets[0] - angle,
                (Some(before), None) => angle - before.jets[1],
                (None, None) => 0.0,
            },
            Equation::Curvature(curvature) => match (before, after) {
                (_, Some(after)) => after.jets[2] * scale_after - curvature * knot.h,
                (Some(before), None) => before.jets[3] * scale_before - curvature * knot.h,
                (None, None) => 0.0,
            },
            Equation::Condition(condition) => {
                let (order, signs) = condition_terms(condition);
                let side = |side: usize, ends: Option<&Ends>| {
                    let derivative = |ends: &Ends| ends.derivatives[2 * (1 - side) + order - 1];
                    ends.map_or(0.0, |ends| {
                        signs[side] * derivative(ends) * knot.weight(side, order)
                    })
                };
                side(1, after) + side(0, before)
            }
        };
        let [first, second] = knot.equations;
        Mismatch { direction, curvature, equations: [value(first), value(second)] }
    }
}

impl System<2> for RunSystem<'_> {
    fn residual(&mut self) -> f64 {
        if self.is_near && !self.rough {
            self.evaluate_ends();
        } else {
            self.evaluate();
        }
        self.is_near = false;
        self.mismatches.iter().map(Mismatch::worst).fold(0.0, larger)
    }

    fn linearize(&self, matrix: &mut BlockTridiagonal<2>) {
        let n = self.knots.len();
        for (i, knot) in self.knots.iter().enumerate() {
            let (left, right) = neighbours(i, n, self.closed);
            let (mut lower, mut diagonal, mut upper) =
                ([[0.0; 2]; 2], [[0.0; 2]; 2], [[0.0; 2]; 2]);
            let mismatch = &self.mismatches[i];
            let mut values = mismatch.equations.map(|value| -value);
            for (row, equation) in knot.equations.into_iter().enumerate() {
                let condition = match equation {
                    // Unknowns are changes of the right side (of the left one at an open end).
                    Equation::Direction(_) => {
                        diagonal[row][0] = -1.0;
                        continue;
                    }
                    Equation::Curvature(_) => {
                        diagonal[row][1] = 1.0;
                        continue;
                    }
                    Equation::Condition(condition) => condition,
                };
                let (order, signs) = condition_terms(condition);
                // The left segment: its start is knot i − 1, its end this knot.
                if let (Some(l), true) = (left, signs[0] != 0.0) {
                    let weight = signs[0] * knot.weight(0, order);
                    let by_jets = &self.responses[l].derivatives_by_jets[1 + order];
                    let before = &self.knots[if i == 0 { n - 1 } else { i - 1 }];
                    let to_end = [weight * by_jets[1], weight * by_jets[3] * knot.unscale[0]];
                    lower[row] = [-weight * by_jets[0], weight * by_jets[2] * before.unscale[1]];
                    diagonal[row] = to_end;
                    values[row] -= to_end[0] * mismatch.direction + to_end[1] * mismatch.curvature;
                }
                // The right segment: its start is this knot, its end knot i + 1.
                if let (Some(r), true) = (right, signs[1] != 0.0) {
                    let weight = signs[1] * knot.weight(1, order);
                    let by_jets = &self.responses[r].derivatives_by_jets[order - 1];
                    let next = if i + 1 == n { 0 } else { i + 1 };
                    let (after, beyond) = (&self.knots[next], &self.mismatches[next]);
                    let to_end = [weight * by_jets[1], weight * by_jets[3] * after.unscale[0]];
                    diagonal[row][0] -= weight * by_jets[0];
                    diagonal[row][1] += weight * by_jets[2] * knot.unscale[1];
                    upper[row] = to_end;
                    values[row] -= to_end[0] * beyond.direction + to_end[1] * beyond.curvature;
                }
            }
            matrix.rows[i] = BlockRow::new(lower, diagonal, upper);
            matrix.right[i] = values;
        }
    }

    fn advance(&mut self, step: &[[f64; 2]]) -> f64 {
        /// Largest bend of a segment in one step, in radians. Anything from ½ to 4 does about as well.
        const CLAMP: f64 = 1.0;
        /// Bends after which the responses count as the same: what remains is of the second order in them,
        /// and by what the next step errs, of the third.
        const NEAR: f64 = 1e-5;
        let n = self.knots.len();
        let mut size = 0.0;
        for segment in 0..self.parameters.len() {
            let (start, end) = (segment, (segment + 1) % n);
            let mismatch = &self.mismatches[end];
            let jets = [
                -step[start][0],
                step[end][0] + mismatch.direction,
                step[start][1] * self.knots[start].unscale[1],
                (step[end][1] + mismatch.curvature) * self.knots[end].unscale[0],
            ];
            let by_jets = &self.responses[segment].parameters_by_jets;
            let mut change: [f64; 4] =
                std::array::from_fn(|row| (0..4).map(|jet| by_jets[row][jet] * jets[jet]).sum());
            let bend = self.family.bend(change);
            size = larger(size, bend);
            if bend > CLAMP {
                change = change.map(|change| change * CLAMP / bend);
            }
            if change.iter().all(|change| change.is_finite()) {
                (0..4).for_each(|row| self.parameters[segment][row] += change[row]);
            }
        }
        self.is_near = size <= NEAR;
        size
    }
}

/// Equal to no parameters: of responses that aren't there, or aren't whole.
const NOT_IN_FULL: [f64; 4] = [f64::NAN; 4];

/// The equations of a knot at a window's rim: its own that concern the side within alone, filled up
/// with what is held.
fn rim(own: [Equation; 2], within: Side, held: [Equation; 2]) -> [Equation; 2] {
    let kept = own.into_iter().filter(|equation| {
        matches!(equation, Equation::Condition(Condition::Zero(side, _)) if *side == within)
    });
    let mut equations = kept.chain(held);
    held.map(|held| equations.next().unwrap_or(held))
}

/// The segments before and after knot `i`.
fn neighbours(i: usize, n: usize, closed: bool) -> (Option<usize>, Option<usize>) {
    let left = if i > 0 { Some(i - 1) } else { closed.then_some(n - 1) };
    let right = if i + 1 < n || closed { Some(i) } else { None };
    (left, right)
}

/// Order of the derivative that a condition is about, and the signs of its left and right side.
fn condition_terms(condition: Condition) -> (usize, [f64; 2]) {
    let order = |quantity| {
        if quantity == Quantity::FirstDerivative { 1 } else { 2 }
    };
    match condition {
        Condition::Continuous(quantity) => (order(quantity), [-1.0, 1.0]),
        Condition::Zero(Side::Left, quantity) => (order(quantity), [1.0, 0.0]),
        Condition::Zero(Side::Right, quantity) => (order(quantity), [0.0, 1.0]),
    }
}

/// The two equations of a knot and its turning angle.
///
/// What is given takes the place of a condition. At an end and on the straight side of a one-way
/// join: first of κ′ = 0, then of κ″ = 0 (so that Euler spirals stay Euler spirals). At a G4 knot:
/// a tangent that of continuous κ″, a curvature that of continuous κ′, which is what the minimum
/// variation curve does (thesis 7.2). A G2 knot with a given curvature joins its sides by
/// continuous κ″.
fn equations(
    run: &Run,
    i: usize,
    left: Option<usize>,
    right: Option<usize>,
) -> ([Equation; 2], f64) {
    use Quantity::{FirstDerivative, SecondDerivative};
    let knot = &run.knots[i];
    let join = knot.join;
    let turn = knot.turn;
    // A given direction as an angle from each chord; together they may choose another winding.
    let from_chord = |segment: usize, tangent: f64| direction(run.chord(segment)) - tangent;
    let given_direction = |tangent: f64| match (left, right) {
        (Some(l), Some(r)) => {
            let (arrive, leave) =
                (-wrap_angle(from_chord(l, tangent)), wrap_angle(from_chord(r, tangent)));
            (Equation::Direction(leave), arrive + leave)
        }
        (None, Some(r)) => (Equation::Direction(wrap_angle(from_chord(r, tangent))), turn),
        (Some(l), None) => (Equation::Direction(wrap_angle(-from_chord(l, tangent))), turn),
        (None, None) => (Equation::Direction(0.0), turn),
    };
    let is_end = left.is_none() || right.is_none();
    let rows = match (left, right, join) {
        (None, _, _) => table::START,
        (_, None, _) => table::END,
        (_, _, Join::G2) if knot.curvature.is_some() => {
            [Condition::Continuous(SecondDerivative), Condition::Continuous(FirstDerivative)]
        }
        (_, _, join) => {
            let [_, _, first, second] = table::conditions(join);
            [first, second]
        }
    };
    let mut equations = rows.map(Equation::Condition);
    let mut turn = turn;
    // Which row gives way to a tangent; the other one is the next to go.
    let tangent_row = if is_end || join != Join::G4 { 0 } else { 1 };
    let mut taken = [false; 2];
    if let Some(tangent) = knot.tangent {
        (equations[tangent_row], turn) = given_direction(tangent);
        taken[tangent_row] = true;
    }
    if let Some(curvature) = knot.curvature {
        let row = match () {
            () if !is_end && matches!(join, Join::G2) => 1,
            () if taken[0] => 1,
            () => 0,
        };
        equations[row] = Equation::Curvature(curvature);
    }
    (equations, turn)
}
