//! How far a curve is from solving its contour, recomputed from the points, the joins and k₀ … k₃ of
//! each segment alone.
//!
//! This is the judge of both programs, hence independent of both: its own table of equations (thesis
//! Table 7.1), its own quadrature. It shares with faircurve only the definition: dimensionless,
//! the largest over all required equations of |Δκ⁽ʲ⁾|·hʲ⁺¹ (j = 0, 1, 2) with h the harmonic mean of the
//! two chords (at an end, of its one chord), of |Δθ|, and of (end-point error)/chord.
//!
//! Its own rounding stays near 1e-15 where k₀ … k₃ are in the thousands and chords are of any size, so
//! that what it finds is the curve's: angles are kept in two numbers until whole turns are taken
//! off, and nothing is summed that cancels.

use std::f64::consts::TAU;

use faircurve::frame::{direction, turning, wrap_angle};
use faircurve::kurbo::{Point, Vec2};
use faircurve::numeric::roots::roots_between;
use faircurve::tolerance::{COINCIDENT, INVISIBLE};
use faircurve::{Contour, Join};
use serde::Serialize;

/// A segment longer than this many chords is a loop that no designer wants.
pub(crate) const LOOP: f64 = 4.0;

/// A segment as either program reports it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    /// k₀ … k₃ of eq. 8.1: for arc length 1, at the middle.
    pub(crate) k: [f64; 4],
    /// Arc length in user units, if the program states one.
    pub(crate) length: Option<f64>,
}

/// The most violated equation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Residual {
    /// How much it is violated by; infinite if a number isn't finite.
    pub(crate) value: f64,
    /// The knot at which it is required (for an equation of a segment, where that starts).
    pub(crate) knot: usize,
    /// The equation, in words.
    pub(crate) equation: &'static str,
}

/// A condition on the two sides of a knot. The number is the order: 0 is θ, 1 is κ, 2 is κ′, 3 is κ″.
#[derive(Clone, Copy, Debug)]
enum Condition {
    /// Both sides agree.
    Equal(usize),
    /// The incoming side vanishes.
    ZeroBefore(usize),
    /// The outgoing side vanishes.
    ZeroAfter(usize),
}

/// Table 7.1, each knot of the plane once. An open end and a corner's side have their half of the
/// corner's row.
fn conditions(join: Join) -> &'static [Condition] {
    use Condition::{Equal, ZeroAfter, ZeroBefore};
    match join {
        Join::Corner => &[ZeroBefore(2), ZeroBefore(3), ZeroAfter(2), ZeroAfter(3)],
        // The tangent is given (or the circle's) on both sides and nothing else is shared.
        Join::G1 => &[Equal(0), ZeroBefore(3), ZeroAfter(3)],
        Join::G2 => &[Equal(0), Equal(1), ZeroBefore(3), ZeroAfter(3)],
        Join::G4 => &[Equal(0), Equal(1), Equal(2), Equal(3)],
        Join::CurveToTerminal => &[Equal(0), Equal(1), ZeroAfter(2), ZeroAfter(3)],
        Join::TerminalToCurve => &[Equal(0), Equal(1), ZeroBefore(2), ZeroBefore(3)],
    }
}

const EQUAL: [&str; 4] = ["θ continuous", "κ continuous", "κ′ continuous", "κ″ continuous"];
const ZERO: [&str; 4] = ["θ = 0", "κ = 0", "κ′ = 0", "κ″ = 0"];

/// What is given at a place, by its incoming and outgoing side. NaN is something that isn't known.
#[derive(Clone, Copy, Debug)]
struct Given {
    tangent: [Option<f64>; 2],
    curvature: [Option<f64>; 2],
}

impl Given {
    /// Whether a condition gives way to what is given (decision 5).
    fn replaces(&self, join: Join, condition: Condition) -> bool {
        let tangent = self.tangent.map(|given| given.is_some());
        let curvature = self.curvature.map(|given| given.is_some());
        match (condition, join) {
            (Condition::Equal(2), _) => curvature[0],
            (Condition::Equal(3), Join::G4) => tangent[0],
            (Condition::Equal(_), _) => false,
            (Condition::ZeroBefore(order) | Condition::ZeroAfter(order), _) => {
                let side = usize::from(matches!(condition, Condition::ZeroAfter(_)));
                match (join, order) {
                    (Join::G1, _) => curvature[side],
                    (Join::G2, _) => curvature[side],
                    (_, 2) => tangent[side] || curvature[side],
                    _ => tangent[side] && curvature[side],
                }
            }
        }
    }
}

/// A place of the contour: the knots there, as one.
#[derive(Clone, Debug)]
struct Node {
    /// First and last of the knots in this place, which follow each other (around the end, if closed).
    first: usize,
    last: usize,
    point: Point,
}

/// The places of a contour, by the rule of `faircurve::tolerance`: neighbours within [`COINCIDENT`]
/// times their largest coordinate, or within [`INVISIBLE`] times the drawing's size (that is, the
/// power of two next above it), are one, at the place of the one that the contour lists first; so is
/// what comes back to the first of them.
fn nodes(contour: &Contour) -> Vec<Node> {
    let points: Vec<Point> = contour.knots.iter().map(|knot| knot.point).collect();
    let extent = |coordinate: fn(&Point) -> f64| {
        let values = || points.iter().map(coordinate);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    let size = extent(|p| p.x).max(extent(|p| p.y));
    let invisible = INVISIBLE * size.log2().ceil().exp2();
    let coincide = |i: usize, j: usize| {
        let (a, b) = (points[i], points[j]);
        let largest = a.x.abs().max(a.y.abs()).max(b.x.abs()).max(b.y.abs());
        (a - b).hypot() <= (COINCIDENT * largest).max(invisible)
    };
    let mut nodes: Vec<Node> = Vec::with_capacity(points.len());
    for (i, &point) in points.iter().enumerate() {
        match nodes.last_mut() {
            Some(node) if coincide(i - 1, i) || coincide(node.first, i) => node.last = i,
            _ => nodes.push(Node { first: i, last: i, point }),
        }
    }
    while contour.closed
        && let [_, .., tail] = &nodes[..]
        && (coincide(tail.last, 0) || coincide(tail.first, 0))
    {
        nodes[0].first = tail.first;
        nodes.pop();
    }
    nodes
}

/// A segment between two places.
#[derive(Clone, Debug)]
struct Placed {
    chord: Vec2,
    length: f64,
    k: [f64; 4],
    /// End directions against the chord, counterclockwise positive, without whole turns.
    start_angle: f64,
    end_angle: f64,
    /// (stated length − length between the knots' own places)/chord, if a length is stated.
    length_error: Option<f64>,
}

impl Placed {
    /// A piece between two places, which in truth joins two knots at `own_chord` from each other.
    fn new(chord: Vec2, own_chord: f64, piece: &Piece) -> Placed {
        let (x, y) = integral(piece.k);
        let chord_per_length = x.hypot(y);
        let middle = -y.atan2(x);
        Placed {
            chord,
            length: chord.hypot() / chord_per_length,
            k: piece.k,
            start_angle: wrap_angle(middle + theta(piece.k, -0.5).wrapped()),
            end_angle: wrap_angle(middle + theta(piece.k, 0.5).wrapped()),
            length_error: piece
                .length
                .map(|length| (length * chord_per_length - own_chord) / own_chord),
        }
    }

    /// κ, κ′ or κ″ (order 1, 2, 3) at s = ±½, times h to the power of the order.
    fn derivative(&self, order: usize, s: f64, h: f64) -> f64 {
        let [k0, k1, k2, k3] = self.k;
        let local = match order {
            1 => k0 + s * (k1 + s * (k2 / 2.0 + s * k3 / 6.0)),
            2 => k1 + s * (k2 + s * k3 / 2.0),
            _ => k2 + s * k3,
        };
        local * (h / self.length).powi(order as i32)
    }
}

/// The segments of a program's curve, placed between the places of its contour.
#[derive(Clone, Debug)]
pub(crate) struct PlacedCurve {
    nodes: Vec<Node>,
    /// Segment i leaves node i.
    segments: Vec<Placed>,
    closed: bool,
}

impl PlacedCurve {
    /// Places `pieces`, one for each segment of `contour`.
    pub(crate) fn new(contour: &Contour, pieces: &[Piece]) -> PlacedCurve {
        let nodes = nodes(contour);
        let count = match (nodes.len(), contour.closed) {
            (0 | 1, _) => 0,
            (n, true) => n,
            (n, false) => n - 1,
        };
        let segments = (0..count)
            .map(|i| {
                let (from, to) = (&nodes[i], &nodes[(i + 1) % nodes.len()]);
                let own = contour.knots[to.first].point - contour.knots[from.last].point;
                let missing = Piece { k: [f64::NAN; 4], length: None };
                let piece = pieces.get(from.last).unwrap_or(&missing);
                Placed::new(to.point - from.point, own.hypot(), piece)
            })
            .collect();
        PlacedCurve { nodes, segments, closed: contour.closed }
    }

    /// The residual with `joins` at the knots, and with what `contour` says is given there. Both may
    /// differ from what was asked: after relaxing, less holds. Knots in one place count as one, with
    /// the weakest of their joins.
    pub(crate) fn residual(&self, contour: &Contour, joins: &[Join]) -> Residual {
        let mut worst = Residual { value: 0.0, knot: 0, equation: "none" };
        let mut require = |knot: usize, equation: &'static str, violation: f64| {
            let value = if violation.is_finite() { violation.abs() } else { f64::INFINITY };
            if value > worst.value {
                worst = Residual { value, knot, equation };
            }
        };
        if self.segments.is_empty() {
            return worst;
        }
        let at: Vec<(Join, Given)> =
            (0..self.nodes.len()).map(|i| self.required(contour, i, joins)).collect();
        for (i, (join, given)) in at.iter().enumerate() {
            self.check_node(i, *join, given, &mut require);
        }
        for (i, segment) in self.segments.iter().enumerate() {
            let knot = self.nodes[i].last;
            if let Some(error) = segment.length_error {
                require(knot, "ends at its knot", error);
            }
            // Between two terminal sides it is straight by definition.
            let (start, end) = (&at[i], &at[(i + 1) % at.len()]);
            if is_terminal(start, 1) && is_terminal(end, 0) {
                require(knot, "straight", segment.k[0]);
            }
        }
        worst
    }

    /// Length over chord of the longest segment; 1 for a contour without any, infinite where a number
    /// isn't finite.
    pub(crate) fn longest_in_chords(&self) -> f64 {
        self.lengths_in_chords()
            .fold(1.0, |a, b| if b.is_finite() { a.max(b) } else { f64::INFINITY })
    }

    /// Length over chord of each segment that has a chord.
    pub(crate) fn lengths_in_chords(&self) -> impl Iterator<Item = f64> {
        self.segments.iter().map(|segment| segment.length / segment.chord.hypot())
    }

    /// ∫|κ| ds in radians: how much the curve turns in all, to either side.
    pub(crate) fn total_turning(&self) -> f64 {
        self.segments.iter().map(|segment| turning_of(segment.k)).sum()
    }

    /// The largest turn between neighbouring chords, in radians.
    pub(crate) fn largest_turn(&self) -> f64 {
        let turn = |i: usize| match self.around(i) {
            (Some(before), Some(after)) => turning(before.chord, after.chord).abs(),
            _ => 0.0,
        };
        (0..self.nodes.len()).map(turn).fold(0.0, f64::max)
    }

    /// The shortest and longest chord; `None` if there is none.
    pub(crate) fn chord_range(&self) -> Option<(f64, f64)> {
        self.segments
            .iter()
            .map(|segment| segment.chord.hypot())
            .map(|chord| (chord, chord))
            .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }

    /// Directions at the start and end of each segment of `contour` in radians, to whole turns;
    /// `None` for a segment without a chord.
    #[cfg(libspiro)]
    pub(crate) fn end_directions(&self, contour: &Contour) -> Vec<Option<(f64, f64)>> {
        let mut directions = vec![None; contour.segment_count()];
        for (node, segment) in self.nodes.iter().zip(&self.segments) {
            let chord = direction(segment.chord);
            directions[node.last] = Some((chord + segment.start_angle, chord + segment.end_angle));
        }
        directions
    }

    /// The knots, of `count` in all, that lie in one place with the one that comes first there.
    pub(crate) fn knots_in_place_of(
        &self,
        first: usize,
        count: usize,
    ) -> impl Iterator<Item = usize> + use<> {
        let last = self.nodes.iter().find(|node| node.first == first).map_or(first, |n| n.last);
        (0..=(last + count - first) % count).map(move |i| (first + i) % count)
    }

    /// The segments that arrive at and leave a place.
    fn around(&self, node: usize) -> (Option<&Placed>, Option<&Placed>) {
        let before = match node {
            0 if self.closed => self.segments.len().checked_sub(1),
            _ => node.checked_sub(1),
        };
        (before.and_then(|i| self.segments.get(i)), self.segments.get(node))
    }

    /// The join of a place: the same if its knots agree, else the weakest.
    fn join(&self, node: usize, joins: &[Join]) -> Join {
        let Node { first, last, .. } = self.nodes[node];
        let others = (last + joins.len() - first) % joins.len();
        match self.around(node) {
            (Some(_), Some(_)) => {
                (1..=others).map(|i| joins[(first + i) % joins.len()]).fold(joins[first], weakest)
            }
            // An end is half a corner.
            _ => Join::Corner,
        }
    }

    /// The join of a place, and what is given there: by the first of its knots for what arrives, by
    /// the last for what leaves; at smooth ones the one side's for both. A G2 knot with a tangent is
    /// a G1 knot (decision 5).
    fn required(&self, contour: &Contour, node: usize, joins: &[Join]) -> (Join, Given) {
        let Node { first, last, .. } = self.nodes[node];
        let (arrival, departure) = (&contour.knots[first], &contour.knots[last]);
        let shared = |sides: [Option<f64>; 2]| [sides[0].or(sides[1]), sides[1].or(sides[0])];
        let mut join = self.join(node, joins);
        let mut tangent = [arrival.tangent_in, departure.tangent_out].map(|t| t.map(direction));
        let mut curvature = [arrival.curvature_in, departure.curvature_out];
        if join.is_smooth() {
            tangent = shared(tangent);
        }
        if join == Join::G2 && tangent[0].is_some() {
            join = Join::G1;
        }
        if !matches!(join, Join::Corner | Join::G1) {
            curvature = shared(curvature);
        }
        (join, Given { tangent, curvature })
    }

    /// Requires what holds at one place.
    fn check_node(
        &self,
        node: usize,
        join: Join,
        given: &Given,
        require: &mut impl FnMut(usize, &'static str, f64),
    ) {
        /// What holds beside the curvature at a G2 knot that is given one.
        const G2_CURVED: &[Condition] =
            &[Condition::Equal(0), Condition::Equal(1), Condition::Equal(3)];
        let (before, after) = self.around(node);
        let mut require =
            |equation, violation| require(self.nodes[node].first, equation, violation);
        // The scale of lengths: at corners and ends each side has its own.
        let shared = match (before, after) {
            (Some(a), Some(b)) if join != Join::Corner => {
                Some(2.0 / (a.chord.hypot().recip() + b.chord.hypot().recip()))
            }
            _ => None,
        };
        let scale = |segment: &Placed| shared.unwrap_or(segment.chord.hypot());
        let derivative = |segment: &Placed, order, s| segment.derivative(order, s, scale(segment));
        for (side, segment) in [before, after].into_iter().enumerate() {
            let Some(segment) = segment else { continue };
            let (s, angle) = [(0.5, segment.end_angle), (-0.5, segment.start_angle)][side];
            if let Some(tangent) = given.tangent[side].filter(|given| !given.is_nan()) {
                let off = direction(segment.chord) + angle - tangent;
                require("the tangent given", wrap_angle(off));
            }
            if let Some(curvature) = given.curvature[side].filter(|given| !given.is_nan()) {
                let off = derivative(segment, 1, s) - curvature * scale(segment);
                require("the curvature given", off);
            }
        }
        let is_curved =
            join == Join::G2 && given.curvature[0].is_some() && given.tangent[0].is_none();
        for condition in if is_curved { G2_CURVED } else { conditions(join) } {
            match (*condition, before, after) {
                _ if given.replaces(join, *condition) => {}
                (Condition::Equal(0), Some(a), Some(b)) => {
                    let off = turning(a.chord, b.chord) + b.start_angle - a.end_angle;
                    require(EQUAL[0], wrap_angle(off));
                }
                (Condition::Equal(order), Some(a), Some(b)) => {
                    require(EQUAL[order], derivative(b, order, -0.5) - derivative(a, order, 0.5));
                }
                (Condition::ZeroBefore(order), Some(a), _) => {
                    require(ZERO[order], derivative(a, order, 0.5));
                }
                (Condition::ZeroAfter(order), _, Some(b)) => {
                    require(ZERO[order], derivative(b, order, -0.5));
                }
                _ => {}
            }
        }
    }
}

/// Whether nothing is given on that side of a place (0 arrives, 1 leaves) and κ′ = κ″ = 0 there.
fn is_terminal((join, given): &(Join, Given), side: usize) -> bool {
    let one_way = [Join::TerminalToCurve, Join::CurveToTerminal][side];
    let is_free = given.tangent[side].is_none() && given.curvature[side].is_none();
    is_free && (*join == Join::Corner || *join == one_way)
}

/// The join of two knots in one place.
fn weakest(a: Join, b: Join) -> Join {
    match (a, b) {
        (a, b) if a == b => a,
        (Join::Corner, _) | (_, Join::Corner) => Join::Corner,
        (Join::G1, _) | (_, Join::G1) => Join::G1,
        _ => Join::G2,
    }
}

/// An angle in two numbers, of which the second is the first one's rounding error.
#[derive(Clone, Copy, Debug)]
struct ExactAngle(f64, f64);

impl ExactAngle {
    /// s·self + k. Rounding errors (Dekker 1971, Knuth's two-sum) are carried along.
    fn times_plus(self, s: f64, k: f64) -> ExactAngle {
        let product = self.0 * s;
        let product_error = self.0.mul_add(s, -product) + self.1 * s;
        let sum = product + k;
        let virtual_k = sum - product;
        let sum_error = (product - (sum - virtual_k)) + (k - virtual_k);
        ExactAngle(sum, sum_error + product_error)
    }

    /// Without whole turns, in [−π, π].
    fn wrapped(self) -> f64 {
        /// 2π − TAU.
        const TAU_ERROR: f64 = 2.449_293_598_294_706_4e-16;
        let turns = (self.0 / TAU).round();
        (-turns).mul_add(TAU, self.0) + (self.1 - turns * TAU_ERROR)
    }
}

/// θ(s) = k₀s + k₁s²/2 + k₂s³/6 + k₃s⁴/24 (eq. 8.7) for s whose products with 24 are exact.
fn theta(k: [f64; 4], s: f64) -> ExactAngle {
    // By Horner's rule in s/4, s/3, s/2, s, of which only s/3 would be rounded: 3θ in its place.
    let [k0, k1, k2, k3] = k;
    let inner = ExactAngle(k3, 0.0).times_plus(s / 4.0, k2);
    // 3k₁ and 3k₀, each as a number and its error.
    let tripled = |k: f64| (3.0 * k, k.mul_add(3.0, -(3.0 * k)));
    let (k1, k1_error) = tripled(k1);
    let (k0, k0_error) = tripled(k0);
    let middle = inner.times_plus(s, k1);
    let outer = ExactAngle(middle.0, middle.1 + k1_error).times_plus(s / 2.0, k0);
    let ExactAngle(high, low) = ExactAngle(outer.0, outer.1 + k0_error).times_plus(s, 0.0);
    let third = high / 3.0;
    ExactAngle(third, ((-third).mul_add(3.0, high) + low) / 3.0)
}

/// ∫ e^{iθ(s)} ds over [−½, ½] (eq. 8.1), real and imaginary part: 8-point Gauss–Legendre on panels
/// short enough that θ changes by at most about two radians in each, relative to the direction at
/// each one's middle. NaN beyond a million panels.
fn integral(k: [f64; 4]) -> (f64, f64) {
    /// Positive nodes of the 8-point rule on [−1, 1] with their weights.
    const RULE: [(f64, f64); 4] = [
        (0.183_434_642_495_649_8, 0.362_683_783_378_362),
        (0.525_532_409_916_329, 0.313_706_645_877_887_3),
        (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
        (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
    ];
    const MOST_PANELS: f64 = (1u32 << 20) as f64;
    let [k0, k1, k2, k3] = k;
    let fastest = k0.abs() + k1.abs() / 2.0 + k2.abs() / 8.0 + k3.abs() / 48.0;
    // A power of two, so that the panels' middles and widths are exact.
    let panels = (fastest / 2.0 + 1.0).log2().ceil().exp2();
    if panels.is_nan() || panels > MOST_PANELS {
        return (f64::NAN, f64::NAN);
    }
    let half = 0.5 / panels;
    let (mut x, mut y) = (0.0, 0.0);
    for panel in 0..panels as usize {
        let m = (2 * panel + 1) as f64 * half - 0.5;
        // Derivatives of θ at the middle, for the half panel as unit.
        let d1 = half * (k0 + m * (k1 + m * (k2 / 2.0 + m * k3 / 6.0)));
        let d2 = half * half / 2.0 * (k1 + m * (k2 + m * k3 / 2.0));
        let d3 = half * half * half / 6.0 * (k2 + m * k3);
        let d4 = half * half * half * half / 24.0 * k3;
        let (mut along, mut across) = (0.0, 0.0);
        for (node, weight) in RULE {
            for s in [-node, node] {
                let (sin, cos) = (s * (d1 + s * (d2 + s * (d3 + s * d4)))).sin_cos();
                along += weight * cos;
                across += weight * sin;
            }
        }
        let (sin, cos) = theta(k, m).wrapped().sin_cos();
        x += half * (along * cos - across * sin);
        y += half * (along * sin + across * cos);
    }
    (x, y)
}

/// ∫|κ| ds over a segment, radians.
pub(crate) fn turning_of(k: [f64; 4]) -> f64 {
    let [k0, k1, k2, k3] = k;
    let mut breaks = vec![-0.5];
    breaks.extend(roots_between(&[k0, k1, k2 / 2.0, k3 / 6.0], -0.5, 0.5));
    breaks.push(0.5);
    let theta = |s: f64| s * (k0 + s * (k1 / 2.0 + s * (k2 / 6.0 + s * k3 / 24.0)));
    breaks.windows(2).map(|pair| (theta(pair[1]) - theta(pair[0])).abs()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use faircurve::{Knot, PolynomialSpiral};
    use std::f64::consts::{FRAC_PI_2, PI};

    fn circle(n: usize, join: Join) -> (Contour, Vec<Piece>) {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
        let knots =
            (0..n).map(|i| Knot::new((100.0 * angle(i).cos(), 100.0 * angle(i).sin())).join(join));
        let arc = angle(1);
        let piece = Piece { k: [arc, 0.0, 0.0, 0.0], length: Some(100.0 * arc) };
        (Contour::closed(knots), vec![piece; n])
    }

    fn judge(contour: &Contour, pieces: &[Piece]) -> Residual {
        let joins: Vec<Join> = contour.knots.iter().filter_map(|knot| knot.join).collect();
        PlacedCurve::new(contour, pieces).residual(contour, &joins)
    }

    #[test]
    fn the_circle_solves_every_smooth_join() {
        for join in [Join::G1, Join::G2, Join::G4, Join::CurveToTerminal, Join::TerminalToCurve] {
            for n in [2, 3, 5, 40] {
                let (contour, pieces) = circle(n, join);
                let found = judge(&contour, &pieces);
                assert!(found.value < 1e-12, "{join} {n}: {found:?}");
            }
        }
    }

    #[test]
    fn each_violated_equation_is_found_and_measured() {
        let (contour, mut pieces) = circle(6, Join::G4);
        // Curvature off by ε on one segment; the tangent errors are of the same size.
        pieces[2].k[0] += 1e-3;
        let found = judge(&contour, &pieces);
        assert!(found.value > 4e-4 && found.value < 2e-3, "{found:?}");
        assert!([2, 3].contains(&found.knot));
        // κ″ on one side only: h/length is 3/π here.
        let (contour, mut pieces) = circle(6, Join::G4);
        pieces[2].k[2] = 1e-3;
        let found = judge(&contour, &pieces);
        assert_eq!(found.equation, "κ″ continuous");
        assert!((found.value - 1e-3 * (3.0 / PI).powi(3)).abs() < 1e-6, "{found:?}");
        // A stated length that doesn't fit the chord.
        let (contour, mut pieces) = circle(6, Join::G4);
        pieces[4].length = pieces[4].length.map(|length| length * 1.01);
        let found = judge(&contour, &pieces);
        assert_eq!((found.knot, found.equation), (4, "ends at its knot"));
        assert!((found.value - 0.01).abs() < 1e-12);
        // What isn't a number.
        pieces[1].k[3] = f64::NAN;
        assert_eq!(judge(&contour, &pieces).value, f64::INFINITY);
        assert_eq!(PlacedCurve::new(&contour, &pieces).longest_in_chords(), f64::INFINITY);
    }

    #[test]
    fn ends_and_corners_want_arcs_and_straight_lines() {
        let line = Piece { k: [0.0; 4], length: None };
        let arc = Piece { k: [0.5, 0.0, 0.0, 0.0], length: None };
        let square = |join| {
            let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
            Contour::closed(corners.map(|point| Knot::new(point).join(join)))
        };
        assert_eq!(judge(&square(Join::Corner), &[line; 4]).value, 0.0);
        assert_eq!(judge(&square(Join::Corner), &[arc; 4]).equation, "straight");
        let found = judge(&square(Join::G2), &[line; 4]);
        assert_eq!(found.equation, "θ continuous");
        assert!((found.value - FRAC_PI_2).abs() < 1e-15);
        // An open arch over three points, from two quarter circles.
        let arch = Contour::open([(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]);
        let quarter = Piece { k: [-FRAC_PI_2, 0.0, 0.0, 0.0], length: Some(FRAC_PI_2) };
        let judge =
            |pieces: [Piece; 2]| PlacedCurve::new(&arch, &pieces).residual(&arch, &[Join::G4; 3]);
        let found = judge([quarter; 2]);
        assert!(found.value < 1e-15, "{found:?}");
        let bent = Piece { k: [-FRAC_PI_2, 0.1, 0.0, 0.0], length: None };
        assert!(judge([bent, quarter]).value > 0.05);
    }

    #[test]
    fn knots_in_one_place_count_as_one() {
        let (circle, pieces) = circle(5, Join::G4);
        let mut knots = circle.knots.clone();
        knots.insert(2, knots[2].clone());
        knots.push(knots[0].clone());
        let mut doubled = pieces.clone();
        let nothing = Piece { k: [0.0; 4], length: Some(0.0) };
        doubled.insert(2, nothing);
        doubled.push(nothing);
        let contour = Contour::closed(knots);
        assert!(judge(&contour, &doubled).value < 1e-12);
        assert_eq!(judge(&Contour::open([(1.0, 1.0); 3]), &[nothing; 2]).value, 0.0);
    }

    #[test]
    fn one_place_is_what_the_rule_says() {
        let places = |points: &[(f64, f64)], closed: bool| {
            let contour = Contour { closed, ..Contour::open(points.iter().copied()) };
            nodes(&contour).iter().map(|node| (node.first, node.last)).collect::<Vec<_>>()
        };
        // 64 ε of the larger coordinate, from neighbour to neighbour.
        let near = |n: f64| (1.0 + n * f64::EPSILON, 0.0);
        assert_eq!(
            places(&[near(0.0), near(60.0), near(120.0), (2.0, 0.0)], false),
            [(0, 2), (3, 3)]
        );
        assert_eq!(places(&[near(0.0), near(70.0), (2.0, 0.0)], false), [(0, 0), (1, 1), (2, 2)]);
        // 10⁻¹⁸ of the size, however small the coordinates.
        let tiny = [(0.0, 0.0), (1e-19, 0.0), (1e-17, 0.0), (1.0, 0.0)];
        assert_eq!(places(&tiny, false), [(0, 1), (2, 2), (3, 3)]);
        // Around the end of a closed contour.
        assert_eq!(places(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.0, 0.0)], true)[0], (3, 0));
        assert_eq!(places(&[(5e-324, 0.0); 3], true), [(0, 2)]);
    }

    #[test]
    fn what_is_given_is_checked() {
        let arch = |tangent: (f64, f64)| {
            Contour::open([Knot::new((0.0, 0.0)).tangent_out(tangent), Knot::new((2.0, 0.0))])
        };
        let half = Piece { k: [-PI, 0.0, 0.0, 0.0], length: Some(PI) };
        let judge = |tangent| {
            let contour = arch(tangent);
            PlacedCurve::new(&contour, &[half]).residual(&contour, &[Join::G4; 2])
        };
        assert!(judge((0.0, 3.0)).value < 1e-15);
        let found = judge((3.0, 0.0));
        assert_eq!(found.equation, "the tangent given");
        assert!((found.value - FRAC_PI_2).abs() < 1e-15);
    }

    #[test]
    fn the_quadrature_agrees_with_faircurve() {
        for k in [
            [0.0; 4],
            [1.0, -2.0, 3.0, -4.0],
            [6.0, 30.0, -100.0, 500.0],
            [0.1, -300.0, 20.0, 1e4],
            [400.0, 0.0, 3000.0, 0.0],
        ] {
            let (x, y) = integral(k);
            let chord = PolynomialSpiral::new(k).chord();
            let (sin, cos) = chord.direction.sin_cos();
            let off = (x - chord.length * cos).hypot(y - chord.length * sin);
            assert!(off < 2e-13, "{k:?}: {off:e}");
        }
    }

    #[test]
    fn rounding_stays_small_where_angles_are_large() {
        // Half a million radians, and a chord of a thousandth of the arc: 2/k₀ at the most.
        let arc = |k: f64| 2.0 / k * (k / 2.0).sin();
        for k in [1e3, 54_321.0, 1e6] {
            let (x, y) = integral([k, 0.0, 0.0, 0.0]);
            assert!((x - arc(k)).abs() < 1e-16 && y.abs() < 1e-16, "{k} {x} {y}");
        }
        // 24θ(½) = 12k₀ + 3k₁ + k₂/2 + k₃/16 exactly, in whole numbers.
        let found = theta([1e6, -2e6, 3e6, 4e6], 0.5).wrapped();
        let exact = (12e6 - 6e6 + 1.5e6 + 0.25e6) / 24.0; // 322916.666…
        assert!(wrap_angle(found - exact).abs() < 1e-10);
        let third = theta([1.0, 0.0, 8.0, 0.0], 0.5);
        assert_eq!(third.0 + third.1, 0.5 + 1.0 / 6.0);
    }

    #[test]
    fn turning_counts_both_sides() {
        assert_eq!(turning_of([2.0, 0.0, 0.0, 0.0]), 2.0);
        assert!((turning_of([0.0, 8.0, 0.0, 0.0]) - 2.0).abs() < 1e-15);
    }

    #[test]
    fn contours_are_described() {
        let shape = |contour: &Contour| PlacedCurve::new(contour, &[]);
        let (contour, _) = circle(4, Join::G4);
        assert!((shape(&contour).largest_turn() - FRAC_PI_2).abs() < 1e-12);
        let (short, long) = shape(&contour).chord_range().unwrap();
        assert!((short - long).abs() < 1e-9 && (long - 100.0 * 2f64.sqrt()).abs() < 1e-9);
        let open = Contour::open([(0.0, 0.0), (1.0, 0.0), (1.0, 3.0)]);
        assert!((shape(&open).largest_turn() - FRAC_PI_2).abs() < 1e-12);
        assert_eq!(shape(&open).chord_range(), Some((1.0, 3.0)));
        assert_eq!(shape(&Contour::open([(0.0, 0.0)])).chord_range(), None);
    }
}
