//! The spline of a two-parameter family: tangents that make curvature continuous (thesis section
//! 8.3.1).

use super::family::{EndCurvatures, NaturalEnd, TwoParamFamily};
use crate::frame::{ChordAngles, EndCurvature, circle_tangent, direction, wrap_angle};
use crate::numeric::block_tridiagonal::BlockTridiagonal;
use crate::numeric::newton::{Limits, System, newton};
use crate::plan::Run;
use crate::segment::Segment;
use crate::spline::{Adaptation, Place, RunSolution};

/// A two-parameter family whose tangents are found by continuity of curvature.
#[derive(Clone, Copy, Debug)]
pub struct TwoParamSpline<F> {
    family: F,
}

impl<F: TwoParamFamily> TwoParamSpline<F> {
    /// The spline of this family.
    pub fn new(family: F) -> Self {
        TwoParamSpline { family }
    }

    /// Solves one run.
    pub fn solve_run(&self, run: &Run) -> RunSolution {
        let mut system = TangentSystem::new(&self.family, run);
        let mut matrix = BlockTridiagonal::new(run.knots.len(), run.closed);
        let outcome = newton(&mut system, &mut matrix, Limits { iterations: 16, patience: 8 });
        let n = run.knots.len();
        let segments: Vec<Segment> = (0..run.segment_count())
            .map(|i| {
                let (start, end) = (run.knots[i].point, run.knots[(i + 1) % n].point);
                self.family.shape(start, end, system.angles(i))
            })
            .collect();
        RunSolution {
            residual: outcome.residual.max(jump(run, &segments)),
            segments,
            adapted: system.adapted,
            iterations: outcome.iterations,
            ..RunSolution::default()
        }
    }
}

/// The largest jump of direction, or of curvature times the harmonic mean of the chords, at a knot.
fn jump(run: &Run, segments: &[Segment]) -> f64 {
    let n = run.knots.len();
    let interior = if run.closed { 0..n } else { 1..n - 1 };
    let jumps = interior.map(|i| {
        let (before, after) = (&segments[(i + n - 1) % n], &segments[i]);
        let (a, b) = (before.chord_length(), after.chord_length());
        let (arriving, leaving) = (before.at(before.length()), after.at(0.0));
        let curvature = (leaving.curvature - arriving.curvature) * 2.0 * a * b / (a + b);
        curvature.abs().max(wrap_angle(leaving.direction - arriving.direction).abs())
    });
    jumps.fold(0.0, f64::max)
}

/// What must hold at a knot.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Equation {
    /// Curvature is the same on both sides.
    Continuous,
    /// A free end whose segment is symmetric.
    Arc,
    /// The angle from the knot's own side is given.
    Direction(f64),
    /// The curvature at an end is given, in the run's units.
    Curvature(f64),
}

/// The tangents of a run and the equations for them.
struct TangentSystem<'a, F> {
    family: &'a F,
    chords: Vec<f64>,
    turns: Vec<f64>,
    equations: Vec<Equation>,
    /// `theta0` of the segment that leaves each knot; at the end of an open run, `theta1` of the
    /// one that arrives.
    tangents: Vec<f64>,
    closed: bool,
    responses: Vec<EndCurvatures>,
    adapted: Vec<Adaptation>,
}

impl<'a, F: TwoParamFamily> TangentSystem<'a, F> {
    fn new(family: &'a F, run: &Run) -> Self {
        let n = run.knots.len();
        let segments = run.segment_count();
        let mut adapted = Vec::new();
        let last = n - 1;
        let equations: Vec<Equation> = (0..n)
            .map(|i| {
                let knot = &run.knots[i];
                let is_end = !run.closed && (i == 0 || i == last);
                match (is_end, knot.tangent, knot.curvature) {
                    (true, Some(tangent), given) => {
                        if given.is_some() {
                            adapted.push(ignored(i));
                        }
                        Equation::Direction(if i == 0 {
                            wrap_angle(direction(run.chord(0)) - tangent)
                        } else {
                            wrap_angle(tangent - direction(run.chord(last - 1)))
                        })
                    }
                    (true, None, Some(curvature)) => Equation::Curvature(curvature),
                    (true, None, None) => match family.natural_end() {
                        NaturalEnd::Arc => Equation::Arc,
                        NaturalEnd::ZeroCurvature => Equation::Curvature(0.0),
                    },
                    (false, _, given) => {
                        if given.is_some() {
                            adapted.push(ignored(i));
                        }
                        Equation::Continuous
                    }
                }
            })
            .collect();
        let mut system = TangentSystem {
            family,
            chords: (0..segments).map(|i| run.chord(i).hypot()).collect(),
            turns: run.knots.iter().map(|knot| knot.turn).collect(),
            equations,
            tangents: vec![0.0; n],
            closed: run.closed,
            responses: Vec::with_capacity(segments),
            adapted,
        };
        system.start_from_circles(run);
        system
    }

    /// The tangents of the circle spline (thesis 4.10), arcs at the ends.
    fn start_from_circles(&mut self, run: &Run) {
        let n = run.knots.len();
        let interior = |i: usize| run.closed || (i > 0 && i + 1 < n);
        for i in (0..n).filter(|&i| interior(i)) {
            let (before, after) = ((i + n - 1) % n, (i + 1) % n);
            let (a, b, c) = (run.knots[before].point, run.knots[i].point, run.knots[after].point);
            let tangent = wrap_angle(direction(run.chord(i)) - circle_tangent(a, b, c));
            self.tangents[i] = tangent;
        }
        if !run.closed {
            self.tangents[0] = if n > 2 { self.turns[1] - self.tangents[1] } else { 0.0 };
            self.tangents[n - 1] = if n > 2 { self.tangents[n - 2] } else { 0.0 };
            for i in [0, n - 1] {
                if let Equation::Direction(angle) = self.equations[i] {
                    self.tangents[i] = angle;
                }
            }
        }
        for i in 0..n {
            self.keep_in_range(i);
        }
    }

    /// The end tangents of a segment.
    fn angles(&self, segment: usize) -> ChordAngles {
        let end = (segment + 1) % self.tangents.len();
        let is_last = !self.closed && segment + 1 == self.chords.len();
        let theta1 =
            if is_last { self.tangents[end] } else { self.turns[end] - self.tangents[end] };
        ChordAngles::new(self.tangents[segment], theta1)
    }

    /// Brings both angles at a knot within the family's limit.
    fn keep_in_range(&mut self, i: usize) {
        let limit = self.family.limit();
        let n = self.tangents.len();
        let (mut low, mut high) = (-limit, limit);
        if self.closed || (i > 0 && i + 1 < n) {
            low = low.max(self.turns[i] - limit);
            high = high.min(self.turns[i] + limit);
        }
        if low < high {
            self.tangents[i] = self.tangents[i].clamp(low, high);
        } else {
            self.tangents[i] = (low + high) / 2.0;
        }
    }
}

/// One linearised equation: its value, and the derivatives by the knot's own unknown and those of its
/// neighbours.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    value: f64,
    lower: f64,
    diagonal: f64,
    upper: f64,
}

impl<F: TwoParamFamily> TangentSystem<'_, F> {
    /// The equation of knot `i`. Its unknown is `theta0` of the segment after it, which is the turn
    /// less `theta1` of the one before; at the end of an open run, `theta1` itself.
    fn row(&self, i: usize) -> Row {
        let n = self.tangents.len();
        let left = if i > 0 { Some(i - 1) } else { self.closed.then_some(n - 1) };
        let right = if i + 1 < n || self.closed { Some(i) } else { None };
        // How theta1 of the segment after responds to the unknown of the next knot.
        let next = if !self.closed && i + 2 == n { 1.0 } else { -1.0 };
        match (self.equations[i], left, right) {
            (Equation::Continuous, Some(l), Some(r)) => {
                let (cl, cr) = (self.chords[l].sqrt(), self.chords[r].sqrt());
                let v = Turned::new(self.responses[l].value[1], cl, cr);
                let w = Turned::new(self.responses[r].value[0], cr, cl);
                let [l0, l1] =
                    self.responses[l].by_angle[1].map(|by| v.angle_by(&Turned::new(by, cl, cr)));
                let [r0, r1] =
                    self.responses[r].by_angle[0].map(|by| w.angle_by(&Turned::new(by, cr, cl)));
                Row { value: v.angle_to(&w), lower: -l0, diagonal: l1 + r0, upper: r1 * next }
            }
            (Equation::Direction(angle), _, _) => {
                Row { value: self.tangents[i] - angle, diagonal: 1.0, ..Row::default() }
            }
            (Equation::Arc, _, Some(r)) => {
                let ChordAngles { theta0, theta1 } = self.angles(r);
                Row { value: theta0 - theta1, diagonal: 1.0, upper: -next, lower: 0.0 }
            }
            (Equation::Arc, Some(l), None) => {
                let ChordAngles { theta0, theta1 } = self.angles(l);
                Row { value: theta1 - theta0, diagonal: 1.0, lower: -1.0, upper: 0.0 }
            }
            (Equation::Curvature(curvature), _, Some(r)) => {
                let (value, [by0, by1]) = self.end_curvature(r, 0, curvature);
                Row { value, diagonal: by0, upper: by1 * next, lower: 0.0 }
            }
            (Equation::Curvature(curvature), Some(l), None) => {
                let (value, [by0, by1]) = self.end_curvature(l, 1, curvature);
                Row { value, diagonal: by1, lower: by0, upper: 0.0 }
            }
            // A knot without a segment, or continuity at an end: nothing to ask.
            _ => Row { diagonal: 1.0, ..Row::default() },
        }
    }

    /// How far the curvature at the start (0) or end (1) of a segment is from the one wanted, in the
    /// run's units, and how that responds to the segment's angles.
    fn end_curvature(&self, segment: usize, end: usize, wanted: f64) -> (f64, [f64; 2]) {
        let response = &self.responses[segment];
        let own = Turned::new(response.value[end], 1.0, 1.0);
        let wanted = Turned { num: wanted * self.chords[segment], den: 1.0 };
        let by = response.by_angle[end].map(|by| own.angle_by(&Turned::new(by, 1.0, 1.0)));
        (wanted.angle_to(&own), by)
    }
}

fn ignored(knot: usize) -> Adaptation {
    Adaptation { place: Place::Knot(knot), asked: "curvature", got: "ignored" }
}

impl<F: TwoParamFamily> System<1> for TangentSystem<'_, F> {
    fn linearize(&mut self, matrix: &mut BlockTridiagonal<1>) -> f64 {
        let n = self.tangents.len();
        self.responses.clear();
        for segment in 0..self.chords.len() {
            let response = self.family.curvatures(self.angles(segment));
            self.responses.push(response);
        }
        let mut residual = 0.0f64;
        for i in 0..n {
            let row = self.row(i);
            residual = if row.value.is_nan() { f64::NAN } else { residual.max(row.value.abs()) };
            matrix.lower[i] = [[row.lower]];
            matrix.diagonal[i] = [[row.diagonal]];
            matrix.upper[i] = [[row.upper]];
            matrix.right[i] = [-row.value];
        }
        residual
    }

    fn advance(&mut self, step: &[[f64; 1]]) {
        /// Radians a knot may turn in one step.
        const CLAMP: f64 = 0.7;
        for (i, [step]) in step.iter().enumerate() {
            if step.is_finite() {
                self.tangents[i] += step.clamp(-CLAMP, CLAMP);
            }
            self.keep_in_range(i);
        }
    }
}

/// Curvature times √(product of the two chords), as the direction of a vector: see
/// `docs/decisions/0002-unknowns-and-residual.md`.
struct Turned {
    num: f64,
    den: f64,
}

impl Turned {
    fn new(end: EndCurvature, own: f64, other: f64) -> Self {
        Turned { num: end.num * other, den: end.den * own }
    }

    /// The angle to turn by to come to the other vector: zero where curvatures agree, whatever
    /// their size, and half a turn off where a curve would arrive forwards and leave backwards.
    fn angle_to(&self, other: &Turned) -> f64 {
        (self.den * other.num - self.num * other.den)
            .atan2(self.den * other.den + self.num * other.num)
    }

    /// Derivative of the vector's angle.
    fn angle_by(&self, change: &Turned) -> f64 {
        (self.den * change.num - self.num * change.den)
            / (self.den * self.den + self.num * self.num)
    }
}
