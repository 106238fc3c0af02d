//! The spline of a two-parameter family: tangents that make curvature continuous (thesis section
//! 8.3.1).

use super::family::{EndCurvatures, NaturalEnd, TwoParamFamily};
use crate::frame::{ChordAngles, EndCurvature, circle_tangent, direction, wrap_angle};
use crate::numeric::block_tridiagonal::BlockTridiagonal;
use crate::numeric::newton::{Limits, System, newton};
use crate::plan::Run;
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
        let outcome = newton(&mut system, &mut matrix, Limits { iterations: 60, patience: 30 });
        let n = run.knots.len();
        let segments = (0..run.segment_count())
            .map(|i| {
                let (start, end) = (run.knots[i].point, run.knots[(i + 1) % n].point);
                self.family.shape(start, end, system.angles(i))
            })
            .collect();
        RunSolution {
            segments,
            adapted: system.adapted,
            iterations: outcome.iterations,
            residual: outcome.residual,
            ..RunSolution::default()
        }
    }
}

/// What must hold at a knot.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Equation {
    /// Curvature is the same on both sides.
    Continuous,
    /// A free end.
    Natural(NaturalEnd),
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
                        if given.is_some_and(|curvature| curvature != 0.0) {
                            adapted.push(ignored(i));
                        }
                        Equation::Direction(if i == 0 {
                            wrap_angle(direction(run.chord(0)) - tangent)
                        } else {
                            wrap_angle(tangent - direction(run.chord(last - 1)))
                        })
                    }
                    (true, None, Some(curvature)) => Equation::Curvature(curvature),
                    (true, None, None) => Equation::Natural(family.natural_end()),
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
            let left = if i > 0 { Some(i - 1) } else { self.closed.then_some(n - 1) };
            let right = if i + 1 < n || self.closed { Some(i) } else { None };
            // Signed effect of the unknowns: it is theta0 to the right, turn − theta1 to the left
            // (theta1 itself at an open end).
            let (mut lower, mut diagonal, mut upper, value);
            (lower, diagonal, upper) = (0.0, 0.0, 0.0);
            let after_is_end = !self.closed && i + 2 == n;
            match (self.equations[i], left, right) {
                (Equation::Continuous, Some(l), Some(r)) => {
                    let (cl, cr) = (self.chords[l].sqrt(), self.chords[r].sqrt());
                    let v = Turned::new(self.responses[l].value[1], cl, cr);
                    let w = Turned::new(self.responses[r].value[0], cr, cl);
                    value = (v.den * w.num - v.num * w.den).atan2(v.den * w.den + v.num * w.num);
                    let by = |end: EndCurvature, at: &Turned, a: f64, b: f64| {
                        at.angle_by(&Turned::new(end, a, b))
                    };
                    let left_by = self.responses[l].by_angle[1].map(|e| by(e, &v, cl, cr));
                    let right_by = self.responses[r].by_angle[0].map(|e| by(e, &w, cr, cl));
                    lower -= left_by[0];
                    diagonal += left_by[1] + right_by[0];
                    upper += right_by[1] * if after_is_end { 1.0 } else { -1.0 };
                }
                (Equation::Direction(angle), _, _) => {
                    diagonal = 1.0;
                    value = self.tangents[i] - angle;
                }
                (Equation::Natural(NaturalEnd::Arc), _, Some(r)) => {
                    let angles = self.angles(r);
                    value = angles.theta0 - angles.theta1;
                    diagonal = 1.0;
                    upper = if after_is_end { -1.0 } else { 1.0 };
                }
                (Equation::Natural(NaturalEnd::Arc), Some(l), None) => {
                    let angles = self.angles(l);
                    value = angles.theta1 - angles.theta0;
                    diagonal = 1.0;
                    lower = -1.0;
                }
                (equation, l, r) => {
                    let target = match equation {
                        Equation::Curvature(curvature) => curvature,
                        _ => 0.0,
                    };
                    let (segment, end) = match (l, r) {
                        (_, Some(r)) => (r, 0),
                        (Some(l), None) => (l, 1),
                        (None, None) => (0, 0),
                    };
                    let chord = self.chords[segment];
                    let own = Turned::new(self.responses[segment].value[end], 1.0, 1.0);
                    let wanted = Turned { num: target * chord, den: 1.0 };
                    value = (wanted.den * own.num - wanted.num * own.den)
                        .atan2(wanted.den * own.den + wanted.num * own.num);
                    let by = self.responses[segment].by_angle[end]
                        .map(|e| own.angle_by(&Turned::new(e, 1.0, 1.0)));
                    if end == 0 {
                        diagonal = by[0];
                        upper = by[1] * if after_is_end { 1.0 } else { -1.0 };
                    } else {
                        diagonal = by[1];
                        lower = by[0];
                    }
                }
            }
            residual = if value.is_nan() { f64::NAN } else { residual.max(value.abs()) };
            matrix.lower[i] = [[lower]];
            matrix.diagonal[i] = [[diagonal]];
            matrix.upper[i] = [[upper]];
            matrix.right[i] = [-value];
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

/// Curvature times √(product of the two chords), as the direction of a vector: DESIGN's residual.
struct Turned {
    num: f64,
    den: f64,
}

impl Turned {
    fn new(end: EndCurvature, own: f64, other: f64) -> Self {
        Turned { num: end.num * other, den: end.den * own }
    }

    /// Derivative of the vector's angle.
    fn angle_by(&self, change: &Turned) -> f64 {
        (self.den * change.num - self.num * change.den)
            / (self.den * self.den + self.num * self.num)
    }
}
