//! Table 7.1 as data: what must hold at each kind of knot.

use crate::outline::Join;

/// The side of a knot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Of the segment that arrives (subscript l in the thesis).
    Left,
    /// Of the segment that leaves (subscript r).
    Right,
}

/// What a condition is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The tangent direction θ.
    Direction,
    /// Curvature κ.
    Curvature,
    /// κ′ by arc length.
    FirstDerivative,
    /// κ″ by arc length.
    SecondDerivative,
}

/// One row of the table: a linear condition at a knot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// The quantity is the same on both sides.
    Continuous(Quantity),
    /// The quantity is zero on that side.
    Zero(Side, Quantity),
}

use Condition::{Continuous, Zero};
use Quantity::{Curvature, Direction, FirstDerivative, SecondDerivative};
use Side::{Left, Right};

/// What holds at a left endpoint (nothing arrives).
pub const START: [Condition; 2] = [Zero(Right, FirstDerivative), Zero(Right, SecondDerivative)];

/// What holds at a right endpoint (nothing leaves).
pub const END: [Condition; 2] = [Zero(Left, FirstDerivative), Zero(Left, SecondDerivative)];

/// The four conditions at an interior knot (thesis Table 7.1).
///
/// A corner is an endpoint for both sides. G1 isn't in the thesis: its tangent is given (or that of
/// the circle through its neighbours), which leaves each side one condition, κ″ = 0, so that a G1
/// knot among G2 knots is joined by Euler spirals. `Continuous(Direction)` stands for both sides
/// having the given tangent.
pub const fn conditions(join: Join) -> [Condition; 4] {
    match join {
        Join::Corner => [START[0], START[1], END[0], END[1]],
        Join::G1 => [
            Continuous(Direction),
            Continuous(Direction),
            Zero(Left, SecondDerivative),
            Zero(Right, SecondDerivative),
        ],
        Join::G2 => [
            Continuous(Direction),
            Continuous(Curvature),
            Zero(Left, SecondDerivative),
            Zero(Right, SecondDerivative),
        ],
        Join::G4 => [
            Continuous(Direction),
            Continuous(Curvature),
            Continuous(FirstDerivative),
            Continuous(SecondDerivative),
        ],
        Join::CurveToTerminal => [
            Continuous(Direction),
            Continuous(Curvature),
            Zero(Right, FirstDerivative),
            Zero(Right, SecondDerivative),
        ],
        Join::TerminalToCurve => [
            Continuous(Direction),
            Continuous(Curvature),
            Zero(Left, FirstDerivative),
            Zero(Left, SecondDerivative),
        ],
    }
}

/// The zero conditions on a cubic segment's own k₀ … k₃, solved for as many of them as there are
/// independent conditions. What a segment still needs to be found, its *unknowns*, follows: 4 minus
/// the rank.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentConstraints {
    /// Independent conditions in echelon form: the k of that index is this combination of the
    /// others.
    solved: Vec<(usize, [f64; 4])>,
    dependent: bool,
}

impl SegmentConstraints {
    /// The constraints on a segment that lies between two knots with these conditions: those of
    /// `start` about its right side and of `end` about its left side.
    pub fn between(
        start: impl IntoIterator<Item = Condition>,
        end: impl IntoIterator<Item = Condition>,
    ) -> Self {
        let at_start = start.into_iter().filter_map(|condition| match condition {
            Zero(Right, quantity) => Some(derivative_row(quantity, -0.5)),
            _ => None,
        });
        let at_end = end.into_iter().filter_map(|condition| match condition {
            Zero(Left, quantity) => Some(derivative_row(quantity, 0.5)),
            _ => None,
        });
        let mut constraints = SegmentConstraints { solved: Vec::new(), dependent: false };
        at_start.chain(at_end).for_each(|row| constraints.add(row));
        constraints
    }

    /// Number of parameters still free: 4 between G4 knots, 3 from G2 to G4, 2 between G2 knots, 1
    /// from an end to a G2 knot.
    pub fn unknowns(&self) -> usize {
        4 - self.solved.len()
    }

    /// Whether some condition repeats what others say. Then curvature itself lacks a condition
    /// (between two ends, say), and the segment is a straight line by definition.
    pub fn is_singular(&self) -> bool {
        self.dependent
    }

    /// Removes from `k` what rounding has left of quantities that are zero.
    pub fn enforce(&self, k: &mut [f64; 4]) {
        for (index, combination) in &self.solved {
            k[*index] = (0..4).filter(|i| i != index).map(|i| combination[i] * k[i]).sum();
        }
    }

    /// Adds the condition Σ rowᵢ kᵢ = 0 by Gauss–Jordan elimination.
    fn add(&mut self, mut row: [f64; 4]) {
        const NEGLIGIBLE: f64 = 1e-12;
        for (index, combination) in &self.solved {
            let factor = row[*index];
            (0..4).for_each(|i| row[i] += factor * combination[i]);
            row[*index] = 0.0;
        }
        let Some(pivot) = (0..4).find(|&i| row[i].abs() > NEGLIGIBLE) else {
            self.dependent = true;
            return;
        };
        let scale = -1.0 / row[pivot];
        let mut combination = row.map(|entry| entry * scale);
        combination[pivot] = 0.0;
        for (_, earlier) in &mut self.solved {
            let factor = earlier[pivot];
            (0..4).for_each(|i| earlier[i] += factor * combination[i]);
            earlier[pivot] = 0.0;
        }
        self.solved.push((pivot, combination));
    }
}

/// κ, κ′ or κ″ at s = ±½ as a combination of k₀ … k₃.
fn derivative_row(quantity: Quantity, s: f64) -> [f64; 4] {
    match quantity {
        Direction | Curvature => [1.0, s, s * s / 2.0, s * s * s / 6.0],
        FirstDerivative => [0.0, 1.0, s, s * s / 2.0],
        SecondDerivative => [0.0, 0.0, 1.0, s],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unknowns(start: &[Condition], end: &[Condition]) -> (usize, bool) {
        let constraints = SegmentConstraints::between(start.iter().copied(), end.iter().copied());
        (constraints.unknowns(), constraints.is_singular())
    }

    #[test]
    fn every_interior_knot_has_four_conditions_and_ends_have_two() {
        // The count comes out even (thesis section 7.4): 4 a segment, 2 an end, 4 a knot.
        for join in Join::ALL {
            assert_eq!(conditions(join).len(), 4);
        }
        assert_eq!(START.len() + END.len(), 4);
    }

    #[test]
    fn unknowns_follow_from_the_rank() {
        let (g2, g4) = (conditions(Join::G2), conditions(Join::G4));
        let (leaves, arrives) =
            (conditions(Join::CurveToTerminal), conditions(Join::TerminalToCurve));
        assert_eq!(unknowns(&g4, &g4), (4, false));
        assert_eq!(unknowns(&g2, &g4), (3, false));
        assert_eq!(unknowns(&g4, &g2), (3, false));
        assert_eq!(unknowns(&g2, &g2), (2, false));
        assert_eq!(unknowns(&START, &g4), (2, false));
        assert_eq!(unknowns(&g4, &END), (2, false));
        assert_eq!(unknowns(&START, &g2), (1, false));
        assert_eq!(unknowns(&leaves, &g2), (1, false));
        // The curved sides of one-way joins are as free as G4.
        assert_eq!(unknowns(&arrives, &leaves), (4, false));
        // Four conditions on three derivatives, none on curvature: a line by definition.
        assert_eq!(unknowns(&START, &END), (1, true));
        assert_eq!(unknowns(&leaves, &arrives), (1, true));
        assert_eq!(unknowns(&conditions(Join::Corner), &arrives), (1, true));
    }

    #[test]
    fn enforcing_leaves_only_what_is_free() {
        let mut k = [0.5, 0.25, 1e-17, -1e-16];
        SegmentConstraints::between(conditions(Join::G2), conditions(Join::G2)).enforce(&mut k);
        assert_eq!(k, [0.5, 0.25, 0.0, 0.0]);
        SegmentConstraints::between(START, conditions(Join::G2)).enforce(&mut k);
        assert_eq!(k, [0.5, 0.0, 0.0, 0.0]);
    }
}
