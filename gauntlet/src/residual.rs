//! How far a curve is from solving its contour, recomputed from the points, the joins and k₀ … k₃ of
//! each segment alone.
//!
//! This is the judge of both programs, hence independent of both: its own table of equations (thesis
//! Table 7.1), its own quadrature. It shares with faircurve only the definition: dimensionless,
//! the largest over all required equations of |Δκ⁽ʲ⁾|·hʲ⁺¹ (j = 0, 1, 2) with h the harmonic mean of the
//! two chords (at an end, of its one chord), of |Δθ|, and of (end-point error)/chord.

use faircurve::frame::{direction, turning, wrap_angle};
use faircurve::kurbo::{Point, Vec2};
use faircurve::tolerance::COINCIDENT;
use faircurve::{Contour, Join};
use serde::Serialize;

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
        Join::G1 => &[Equal(0)],
        Join::G2 => &[Equal(0), Equal(1), ZeroBefore(3), ZeroAfter(3)],
        Join::G4 => &[Equal(0), Equal(1), Equal(2), Equal(3)],
        Join::CurveToTerminal => &[Equal(0), Equal(1), ZeroAfter(2), ZeroAfter(3)],
        Join::TerminalToCurve => &[Equal(0), Equal(1), ZeroBefore(2), ZeroBefore(3)],
    }
}

const EQUAL: [&str; 4] = ["θ continuous", "κ continuous", "κ′ continuous", "κ″ continuous"];
const ZERO: [&str; 4] = ["θ = 0", "κ = 0", "κ′ = 0", "κ″ = 0"];

/// A segment of nonzero chord, placed.
struct Placed {
    /// Index of the knot that it leaves.
    from: usize,
    chord: Vec2,
    length: f64,
    k: [f64; 4],
    /// Chord over arc length.
    chord_per_length: f64,
    /// End directions against the chord, counterclockwise positive, not wrapped.
    start_angle: f64,
    end_angle: f64,
    stated_length: Option<f64>,
}

impl Placed {
    fn new(from: usize, chord: Vec2, piece: &Piece) -> Placed {
        let (x, y) = integral(piece.k);
        let chord_per_length = x.hypot(y);
        let middle = -y.atan2(x);
        Placed {
            from,
            chord,
            length: chord.hypot() / chord_per_length,
            k: piece.k,
            chord_per_length,
            start_angle: middle + theta(piece.k, -0.5),
            end_angle: middle + theta(piece.k, 0.5),
            stated_length: piece.length,
        }
    }

    /// κ, κ′ or κ″ (order 1, 2, 3) at s = ±½, in user units.
    fn derivative(&self, order: usize, s: f64) -> f64 {
        let [k0, k1, k2, k3] = self.k;
        let local = match order {
            1 => k0 + s * (k1 + s * (k2 / 2.0 + s * k3 / 6.0)),
            2 => k1 + s * (k2 + s * k3 / 2.0),
            _ => k2 + s * k3,
        };
        local / self.length.powi(order as i32)
    }
}

/// The residual of `pieces`, one for each segment of `contour`, with `joins` at its knots (which may
/// differ from the contour's own: those that hold after relaxing). Knots in one place count as one,
/// with the weakest of their joins.
///
/// Where a tangent or curvature is given, it and the continuity of tangent and curvature are
/// checked, and nothing more: what gives way to it is the spline's choice.
pub(crate) fn residual(contour: &Contour, joins: &[Join], pieces: &[Piece]) -> Residual {
    let mut worst = Residual { value: 0.0, knot: 0, equation: "none" };
    let mut require = |knot: usize, equation: &'static str, violation: f64| {
        let value = if violation.is_finite() { violation.abs() } else { f64::INFINITY };
        if value > worst.value {
            worst = Residual { value, knot, equation };
        }
    };
    let segments = placed_pieces(contour, pieces);
    let nodes = nodes(contour, joins, &segments);
    for node in &nodes {
        check_node(contour, node, &segments, &mut require);
    }
    for (i, segment) in segments.iter().enumerate() {
        if let Some(length) = segment.stated_length {
            let chord = segment.chord.hypot();
            let error = (length * segment.chord_per_length - chord) / chord;
            require(segment.from, "ends at its knot", error);
        }
        // Between two terminal sides it is straight by definition.
        let (start, end) = (&nodes[i], &nodes[(i + 1) % nodes.len()]);
        if start.is_terminal(contour, true) && end.is_terminal(contour, false) {
            require(segment.from, "straight", segment.k[0]);
        }
    }
    worst
}

/// A place of the contour: the knots there, as one.
struct Node {
    /// First and last of the knots in this place.
    first: usize,
    last: usize,
    join: Join,
    /// The segments that arrive and leave, by index among those with a chord.
    before: Option<usize>,
    after: Option<usize>,
}

impl Node {
    /// Whether nothing is given on the side that leaves (`outgoing`) or arrives.
    fn is_free(&self, contour: &Contour, outgoing: bool) -> bool {
        if outgoing {
            let knot = &contour.knots[self.last];
            knot.tangent_out.is_none() && knot.curvature_out.is_none()
        } else {
            let knot = &contour.knots[self.first];
            knot.tangent_in.is_none() && knot.curvature_in.is_none()
        }
    }

    /// Whether that side has κ′ = κ″ = 0.
    fn is_terminal(&self, contour: &Contour, outgoing: bool) -> bool {
        let one_way = if outgoing { Join::CurveToTerminal } else { Join::TerminalToCurve };
        self.is_free(contour, outgoing) && (self.join == Join::Corner || self.join == one_way)
    }
}

/// The places of a contour; one for each segment with a chord, and one more for an open contour.
fn nodes(contour: &Contour, joins: &[Join], segments: &[Placed]) -> Vec<Node> {
    let (knots, count) = (contour.knots.len(), segments.len());
    if count == 0 {
        return Vec::new();
    }
    let places = if contour.closed { count } else { count + 1 };
    (0..places)
        .map(|place| {
            let before = match place {
                0 if contour.closed => Some(count - 1),
                _ => place.checked_sub(1),
            };
            let after = (place < count).then_some(place);
            let first = before.map_or(0, |i| (segments[i].from + 1) % knots);
            let last = after.map_or(knots - 1, |i| segments[i].from);
            let others = (last + knots - first) % knots;
            let join = match (before, after) {
                (Some(_), Some(_)) => {
                    (1..=others).map(|i| joins[(first + i) % knots]).fold(joins[first], weakest)
                }
                // An end is half a corner.
                _ => Join::Corner,
            };
            Node { first, last, join, before, after }
        })
        .collect()
}

/// The longest segment, in chords; 1 for a contour without any, infinite where a number isn't finite.
pub(crate) fn longest_in_chords(contour: &Contour, pieces: &[Piece]) -> f64 {
    placed_pieces(contour, pieces)
        .iter()
        .map(|segment| segment.length / segment.chord.hypot())
        .fold(1.0, |a, b| if b.is_finite() { a.max(b) } else { f64::INFINITY })
}

fn placed_pieces(contour: &Contour, pieces: &[Piece]) -> Vec<Placed> {
    let points: Vec<Point> = contour.knots.iter().map(|knot| knot.point).collect();
    let largest = points.iter().fold(0.0f64, |m, p| m.max(p.x.abs()).max(p.y.abs()));
    let chord = |i: usize| points[(i + 1) % points.len()] - points[i];
    pieces
        .iter()
        .enumerate()
        .take(contour.segment_count())
        .filter(|&(i, _)| chord(i).hypot() > largest * COINCIDENT)
        .map(|(i, piece)| Placed::new(i, chord(i), piece))
        .collect()
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

/// Requires what holds at one place of the contour.
fn check_node(
    contour: &Contour,
    node: &Node,
    segments: &[Placed],
    require: &mut impl FnMut(usize, &'static str, f64),
) {
    let (before, after) = (node.before.map(|i| &segments[i]), node.after.map(|i| &segments[i]));
    let (arrival, departure) = (&contour.knots[node.first], &contour.knots[node.last]);
    let mut require = |equation, violation| require(node.first, equation, violation);
    for (segment, s, angle, tangent, curvature) in [
        before.map(|b| (b, 0.5, b.end_angle, arrival.tangent_in, arrival.curvature_in)),
        after.map(|a| (a, -0.5, a.start_angle, departure.tangent_out, departure.curvature_out)),
    ]
    .into_iter()
    .flatten()
    {
        if let Some(tangent) = tangent {
            let off = direction(segment.chord) + angle - direction(tangent);
            require("the tangent given", wrap_angle(off));
        }
        if let Some(curvature) = curvature {
            let off = segment.derivative(1, s) - curvature;
            require("the curvature given", off * segment.chord.hypot());
        }
    }
    let is_free = node.is_free(contour, false) && node.is_free(contour, true);
    // The scale of lengths: at corners and ends each side has its own.
    let shared = match (before, after) {
        (Some(a), Some(b)) if node.join != Join::Corner => {
            Some(2.0 / (a.chord.hypot().recip() + b.chord.hypot().recip()))
        }
        _ => None,
    };
    let scaled = |segment: &Placed, order: usize, violation: f64| {
        violation * shared.unwrap_or(segment.chord.hypot()).powi(order as i32)
    };
    for condition in conditions(node.join) {
        match (*condition, before, after) {
            (Condition::Equal(0), Some(a), Some(b)) => {
                let off = turning(a.chord, b.chord) + b.start_angle - a.end_angle;
                require(EQUAL[0], wrap_angle(off));
            }
            (Condition::Equal(order), Some(a), Some(b)) if order == 1 || is_free => {
                let off = b.derivative(order, -0.5) - a.derivative(order, 0.5);
                require(EQUAL[order], scaled(a, order, off));
            }
            (Condition::ZeroBefore(order), Some(a), _) if is_free => {
                require(ZERO[order], scaled(a, order, a.derivative(order, 0.5)));
            }
            (Condition::ZeroAfter(order), _, Some(b)) if is_free => {
                require(ZERO[order], scaled(b, order, b.derivative(order, -0.5)));
            }
            _ => {}
        }
    }
}

/// Directions at the start and end of each segment in radians, not wrapped; `None` for a segment
/// without a chord.
#[cfg(libspiro)]
pub(crate) fn end_directions(contour: &Contour, pieces: &[Piece]) -> Vec<Option<(f64, f64)>> {
    let mut directions = vec![None; contour.segment_count()];
    for segment in placed_pieces(contour, pieces) {
        let chord = direction(segment.chord);
        directions[segment.from] = Some((chord + segment.start_angle, chord + segment.end_angle));
    }
    directions
}

/// θ(s) = k₀s + k₁s²/2 + k₂s³/6 + k₃s⁴/24 (eq. 8.7).
fn theta(k: [f64; 4], s: f64) -> f64 {
    s * (k[0] + s * (k[1] / 2.0 + s * (k[2] / 6.0 + s * k[3] / 24.0)))
}

/// ∫ e^{iθ(s)} ds over [−½, ½] (eq. 8.1), real and imaginary part: 8-point Gauss–Legendre on panels
/// short enough that θ changes by less than about one radian in each. NaN beyond 10⁶ panels.
fn integral(k: [f64; 4]) -> (f64, f64) {
    /// Positive nodes of the 8-point rule on [−1, 1] with their weights.
    const RULE: [(f64, f64); 4] = [
        (0.183_434_642_495_649_8, 0.362_683_783_378_362),
        (0.525_532_409_916_329, 0.313_706_645_877_887_3),
        (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
        (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
    ];
    const MOST_PANELS: f64 = 1e6;
    let fastest = k[0].abs() + k[1].abs() / 2.0 + k[2].abs() / 8.0 + k[3].abs() / 48.0;
    let panels = (fastest + 2.0).ceil();
    if panels.is_nan() || panels > MOST_PANELS {
        return (f64::NAN, f64::NAN);
    }
    let half = 0.5 / panels;
    let (mut x, mut y) = (0.0, 0.0);
    for panel in 0..panels as usize {
        let middle = (2 * panel + 1) as f64 * half - 0.5;
        for (node, weight) in RULE {
            for s in [middle - node * half, middle + node * half] {
                let (sin, cos) = theta(k, s).sin_cos();
                x += weight * half * cos;
                y += weight * half * sin;
            }
        }
    }
    (x, y)
}

/// The largest turn between neighbouring chords of a contour, in radians.
pub(crate) fn largest_turn(contour: &Contour) -> f64 {
    let straight = vec![Piece { k: [0.0; 4], length: None }; contour.segment_count()];
    let placed = placed_pieces(contour, &straight);
    let wrap = if contour.closed { placed.last() } else { None };
    let befores = wrap.into_iter().chain(&placed);
    let afters = placed.iter().skip(usize::from(!contour.closed));
    befores.zip(afters).map(|(a, b)| turning(a.chord, b.chord).abs()).fold(0.0, f64::max)
}

/// The shortest and longest chord of a contour that isn't zero; `None` if all are.
pub(crate) fn chord_range(contour: &Contour) -> Option<(f64, f64)> {
    let straight = vec![Piece { k: [0.0; 4], length: None }; contour.segment_count()];
    placed_pieces(contour, &straight)
        .iter()
        .map(|segment| segment.chord.hypot())
        .map(|chord| (chord, chord))
        .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
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
        residual(contour, &joins, pieces)
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
        assert_eq!(longest_in_chords(&contour, &pieces), f64::INFINITY);
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
        let found = residual(&arch, &[Join::G4; 3], &[quarter; 2]);
        assert!(found.value < 1e-15, "{found:?}");
        let bent = Piece { k: [-FRAC_PI_2, 0.1, 0.0, 0.0], length: None };
        assert!(residual(&arch, &[Join::G4; 3], &[bent, quarter]).value > 0.05);
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
    fn what_is_given_is_checked() {
        let arch = |tangent: (f64, f64)| {
            Contour::open([Knot::new((0.0, 0.0)).tangent_out(tangent), Knot::new((2.0, 0.0))])
        };
        let half = Piece { k: [-PI, 0.0, 0.0, 0.0], length: Some(PI) };
        let joins = [Join::G4; 2];
        assert!(residual(&arch((0.0, 3.0)), &joins, &[half]).value < 1e-15);
        let found = residual(&arch((3.0, 0.0)), &joins, &[half]);
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
    fn contours_are_described() {
        let (contour, _) = circle(4, Join::G4);
        assert!((largest_turn(&contour) - FRAC_PI_2).abs() < 1e-12);
        let (short, long) = chord_range(&contour).unwrap();
        assert!((short - long).abs() < 1e-9 && (long - 100.0 * 2f64.sqrt()).abs() < 1e-9);
        let open = Contour::open([(0.0, 0.0), (1.0, 0.0), (1.0, 3.0)]);
        assert!((largest_turn(&open) - FRAC_PI_2).abs() < 1e-12);
        assert_eq!(chord_range(&open), Some((1.0, 3.0)));
        assert_eq!(chord_range(&Contour::open([(0.0, 0.0)])), None);
    }
}
