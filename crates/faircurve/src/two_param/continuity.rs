//! Tangents that make curvature continuous, by Newton's method (thesis section 8.3.1).

use std::f64::consts::PI;

use num_complex::Complex64;

use super::curvature_map::{CurvatureMap, EndCurvatures, MappedSegment, SegmentContext};
use super::shape::SegmentEnds;
use super::tangents::{TangentRule, Tangents, context, ignored_curvature};
use crate::frame::{ChordAngles, EndCurvature, along_circle, direction, turning, wrap_angle};
use crate::numeric::block_tridiagonal::{BlockRow, BlockTridiagonal};
use crate::numeric::newton::{Limits, System, larger, newton};
use crate::numeric::rounding::{fixed, floating};
use crate::numeric::trig::argument;
use crate::plan::Run;
use crate::spline::{Adaptation, Effort, Stage};
use crate::tolerance::SOLVED;

/// What holds at a free end of an open run.
#[derive(Clone, Copy, Debug)]
pub enum NaturalEnd {
    /// The last segment is symmetric, `theta0` = `theta1`: an arc, for round families.
    Arc,
    /// The curvature is zero.
    ZeroCurvature,
    /// The end's angle is this function of the angle at the segment's other end, given with its
    /// derivative; it must be odd.
    Angle(fn(f64) -> (f64, f64)),
    /// The curvature is this, at least 0, times that at the segment's other end (METAFONT's curl),
    /// unless the knot has a curl of its own; but the end's angle is at most 4 times the other, as
    /// in METAFONT. For linear maps.
    Curl(f64),
}

/// The rule that curvature is continuous at every knot.
#[derive(Clone, Copy, Debug)]
pub struct Continuity<M> {
    /// The curvatures that must agree.
    pub map: M,
    /// What holds at free ends.
    pub end: NaturalEnd,
}

impl<M: CurvatureMap> TangentRule for Continuity<M> {
    fn tangents(&self, run: &Run) -> Tangents {
        self.tangents_from(run, None)
    }

    fn tangents_near(&self, run: &Run, near: &[ChordAngles]) -> Tangents {
        self.tangents_from(run, Some(near))
    }

    /// Shifted Newton steps from the same start (`TangentSystem::approach`), on rounded numbers, so
    /// that copies which are moved, turned or scaled take the same course; the last word is Newton's,
    /// on the exact ones. Where that fails, knots are given up one after the other: they keep the
    /// tangent of the circle.
    fn search(&self, run: &Run, effort: Effort) -> Tangents {
        let n = run.knots.len();
        let mut steps = effort.evaluations(n) / run.segment_count();
        if steps == 0 || self.map.is_linear() {
            return self.tangents(run);
        }
        let mut exact = TangentSystem::new(&self.map, self.end, run);
        exact.start_from_circles(run);
        let mut matrix = BlockTridiagonal::new(n, run.closed);
        let mut rounded = exact.rounded();
        let start: Vec<f64> = rounded.knots.iter().map(|knot| knot.tangent).collect();
        let mut taken = 0;
        for attempt in 0.. {
            let most = steps.min(STEPS[attempt.min(STEPS.len() - 1)]);
            let mut count = rounded.approach(&mut matrix, SHIFTS[attempt % SHIFTS.len()], most);
            let is_last = count >= steps;
            if is_last {
                // Nothing is left to find out which: all that don't hold.
                rounded.give_up_unmet();
            }
            let worst = rounded.worst();
            if worst.is_none_or(|i| rounded.knots[i].mismatch <= CLOSE) {
                for (exact, rounded) in exact.knots.iter_mut().zip(&rounded.knots) {
                    (exact.tangent, exact.given_up) = (rounded.tangent, rounded.given_up);
                }
                count += newton(&mut exact, &mut matrix, PLAIN).iterations;
            }
            taken += count;
            steps = steps.saturating_sub(count);
            let is_solved = |i: usize| exact.knots[i].mismatch <= SOLVED && exact.has_run;
            match worst {
                Some(worst) if !is_last && !exact.worst().is_some_and(is_solved) => {
                    if attempt + 1 >= SHIFTS.len() {
                        rounded.give_up(worst, &start);
                    }
                }
                _ => break,
            }
        }
        Tangents { stage: Stage::Mended, ..exact.finish(taken) }
    }
}

impl<M: CurvatureMap> Continuity<M> {
    /// The tangents found from those of another map for the same run, or from the linearised equations or
    /// circles.
    pub fn tangents_from(&self, run: &Run, start: Option<&[ChordAngles]>) -> Tangents {
        let mut system = TangentSystem::new(&self.map, self.end, run);
        let mut matrix = BlockTridiagonal::new(run.knots.len(), run.closed);
        match start {
            Some(start) => system.start_from(start),
            None => {
                if !system.start_from_linear(&mut matrix) {
                    system.start_from_circles(run);
                }
            }
        }
        let outcome = newton(&mut system, &mut matrix, PLAIN);
        system.finish(outcome.iterations)
    }
}

/// How plain Newton iteration is limited. Runs that converge take 3 to 10 steps.
const PLAIN: Limits = Limits { iterations: 16, patience: 8 };

/// The shifts of the first attempts; see [`TangentSystem::approach`]. Measured on 6,006 random
/// contours with the map of `bespoke` (`examples/two_param_rates.rs`): of the 12 % that plain Newton
/// iteration leaves, 0 solves a twentieth, 1 five sixths, 3 all but two contours, 6 and 10 all.
/// Larger ones take more steps.
const SHIFTS: [f64; 2] = [6.0, 30.0];

/// The most steps of each attempt. Contours that settle take up to 60.
const STEPS: [usize; 3] = [100, 200, 60];

/// Near enough for plain Newton iteration, in radians.
const CLOSE: f64 = 1e-6;

/// What must hold at a knot.
#[derive(Clone, Copy, Debug)]
enum Equation {
    /// Curvature is the same on both sides.
    Continuous,
    /// A free end.
    End(NaturalEnd),
    /// The angle from the knot's own side is given.
    Direction(f64),
    /// The curvature at an end is given, in the run's units.
    Curvature(f64),
}

/// What a map says of itself, asked once: the equations want it at every knot.
#[derive(Clone, Copy, Debug)]
struct Nature {
    is_linear: bool,
    order: f64,
    limit: f64,
}

impl Nature {
    fn of(map: &dyn CurvatureMap) -> Nature {
        Nature { is_linear: map.is_linear(), order: map.order(), limit: map.limit() }
    }

    /// The equation that curvature is continuous where two segments, with these responses, meet.
    #[inline(always)]
    fn continuity(&self, [before, after]: [&EndCurvatures; 2], scales: [f64; 2], next: f64) -> Row {
        // Both sides take the same steps side by side: two lanes of one register.
        let scaled = |sides: [EndCurvature; 2]| [0, 1].map(|i| Turned::new(sides[i], scales[i]));
        let sides = scaled([before.value[1], after.value[0]]);
        let reciprocals = [0, 1].map(|i| 1.0 / sides[i].squared());
        let angles_by = |changes: [EndCurvature; 2]| {
            let changes = scaled(changes);
            [0, 1].map(|i| sides[i].cross(&changes[i]) * reciprocals[i])
        };
        let own = angles_by([before.by_angle[1][1], after.by_angle[0][0]]);
        let others = angles_by([before.by_angle[1][0], after.by_angle[0][1]]);
        let (value, [dv, dw]) = match self.order_at(before, after) {
            1.0 => (sides[0].angle_to(&sides[1]), [1.0; 2]),
            order => sides[0].straightened_angle_to(&sides[1], order),
        };
        Row {
            value,
            lower: -others[0] * dv,
            diagonal: own[0] * dv + own[1] * dw,
            upper: others[1] * dw * next,
        }
    }

    /// The order of the roots to compare where these segments meet. Roots of an order above 1 would be
    /// steep where a whole segment is nearly straight, so that they are for knots that are near an
    /// inflection of both segments.
    fn order_at(&self, before: &EndCurvatures, after: &EndCurvatures) -> f64 {
        /// An end's curvature over that of the other end, below which it is near an inflection.
        const NEAR: f64 = 0.3;
        let is_near = |response: &EndCurvatures, end: usize| {
            response.value[end].num.abs() < NEAR * response.value[1 - end].num.abs()
        };
        let is_useful = self.order <= 1.0 || (is_near(before, 1) && is_near(after, 0));
        if is_useful { self.order } else { 1.0 }
    }
}

/// A knot of the system.
#[derive(Clone, Copy, Debug)]
struct SystemKnot {
    turn: f64,
    /// √(chord after / chord before), 1 at an end, and its reciprocal: by these, curvatures before and after for
    /// unit chord become curvatures times √(product of the two chords).
    scales: [f64; 2],
    equation: Equation,
    /// `theta0` of the segment that leaves the knot; at the end of an open run, `theta1` of the one that
    /// arrives.
    tangent: f64,
    /// The equation at the state that was evaluated last.
    row: Row,
    /// How far it is from being met.
    mismatch: f64,
    /// Whether it is no longer asked for; the knot keeps its tangent.
    given_up: bool,
}

/// The tangents of a run and the equations for them.
struct TangentSystem<'a> {
    map: &'a dyn CurvatureMap,
    nature: Nature,
    closed: bool,
    knots: Vec<SystemKnot>,
    segments: Vec<MappedSegment>,
    /// Whether the equations have been evaluated.
    has_run: bool,
    adapted: Vec<Adaptation>,
}

impl<'a> TangentSystem<'a> {
    fn new(map: &'a dyn CurvatureMap, end: NaturalEnd, run: &Run) -> Self {
        let n = run.knots.len();
        let segments = run.segment_count();
        let mut adapted = Vec::new();
        let last = n - 1;
        let knots = (0..n)
            .map(|i| {
                let knot = &run.knots[i];
                let is_end = !run.closed && (i == 0 || i == last);
                let equation = match (is_end, knot.tangent, knot.curvature) {
                    (true, Some(tangent), given) => {
                        if given.is_some() {
                            adapted.push(ignored_curvature(i));
                        }
                        Equation::Direction(if i == 0 {
                            wrap_angle(direction(run.chord(0)) - tangent)
                        } else {
                            wrap_angle(tangent - direction(run.chord(last - 1)))
                        })
                    }
                    (true, None, Some(curvature)) => Equation::Curvature(curvature),
                    (true, None, None) => Equation::End(match (end, knot.curl) {
                        (NaturalEnd::Curl(_), Some(curl)) => NaturalEnd::Curl(curl),
                        (end, _) => end,
                    }),
                    (false, _, given) => {
                        if given.is_some() {
                            adapted.push(ignored_curvature(i));
                        }
                        Equation::Continuous
                    }
                };
                SystemKnot {
                    turn: knot.turn,
                    scales: [1.0; 2],
                    equation,
                    tangent: 0.0,
                    row: Row::UNASKED,
                    mismatch: 0.0,
                    given_up: false,
                }
            })
            .collect();
        let mut system = TangentSystem {
            map,
            nature: Nature::of(map),
            closed: run.closed,
            knots,
            segments: (0..segments).map(|i| MappedSegment::new(context(run, i))).collect(),
            has_run: false,
            adapted,
        };
        system.scale();
        system
    }

    /// Fills in the knots' scales.
    fn scale(&mut self) {
        let root = |segment: &MappedSegment| segment.context.chord.sqrt();
        let mut before = if self.closed { self.segments.last().map(root) } else { None };
        for (i, knot) in self.knots.iter_mut().enumerate() {
            let after = self.segments.get(i).map(root);
            if let (Some(before), Some(after)) = (before, after) {
                knot.scales = [after / before, before / after];
            }
            before = after;
        }
    }

    /// The tangents of the circle spline (thesis 4.10), arcs at the ends.
    fn start_from_circles(&mut self, run: &Run) {
        let n = run.knots.len();
        let interior = |i: usize| run.closed || (i > 0 && i + 1 < n);
        for i in (0..n).filter(|&i| interior(i)) {
            let (before, after) = ((i + n - 1) % n, (i + 1) % n);
            let (a, b, c) = (run.knots[before].point, run.knots[i].point, run.knots[after].point);
            self.knots[i].tangent = turning(along_circle(a, b, c), run.chord(i));
        }
        if !run.closed {
            self.knots[0].tangent =
                if n > 2 { self.knots[1].turn - self.knots[1].tangent } else { 0.0 };
            self.knots[n - 1].tangent = if n > 2 { self.knots[n - 2].tangent } else { 0.0 };
            for i in [0, n - 1] {
                if let Equation::Direction(angle) = self.knots[i].equation {
                    self.knots[i].tangent = angle;
                }
            }
        }
        self.keep_in_range();
    }

    /// The same with rounded numbers, in units of the longest chord.
    fn rounded(&self) -> Self {
        let chords = self.segments.iter().map(|segment| segment.context.chord);
        let longest = chords.fold(0.0, f64::max);
        let segment = |segment: &MappedSegment| {
            let chord = floating(segment.context.chord / longest);
            MappedSegment::new(SegmentContext { chord, ..segment.context })
        };
        let knot = |knot: &SystemKnot| SystemKnot {
            turn: fixed(knot.turn),
            tangent: fixed(knot.tangent),
            equation: match knot.equation {
                Equation::Direction(angle) => Equation::Direction(fixed(angle)),
                Equation::Curvature(curvature) => {
                    Equation::Curvature(floating(curvature * longest))
                }
                equation @ (Equation::Continuous | Equation::End(_)) => equation,
            },
            ..*knot
        };
        let mut rounded = TangentSystem {
            map: self.map,
            nature: self.nature,
            closed: self.closed,
            knots: self.knots.iter().map(knot).collect(),
            segments: self.segments.iter().map(segment).collect(),
            has_run: false,
            adapted: Vec::new(),
        };
        rounded.scale();
        rounded
    }

    /// Newton steps on equations whose diagonal is enlarged by `shift` times what is unmet there:
    /// implicit Euler steps along the flow dτ/dt = −residual, each knot with a time step of its own
    /// that grows as its equation comes to hold (pseudo-transient continuation, Kelley and Keyes 1998).
    ///
    /// For periodic maps a knot's residual turns once as its tangent goes through its period, so that
    /// the flow always has somewhere to go. Returns the number of steps taken, at most `most`.
    fn approach(&mut self, matrix: &mut BlockTridiagonal<1>, shift: f64, most: usize) -> usize {
        for taken in 0..=most {
            let residual = self.residual();
            if residual <= CLOSE || taken == most {
                return taken;
            }
            self.linearize(matrix);
            for (row, knot) in matrix.rows.iter_mut().zip(&self.knots) {
                if !knot.given_up {
                    row.diagonal[0][0] += shift * knot.mismatch;
                }
            }
            matrix.solve();
            self.advance(&matrix.right);
        }
        most
    }

    /// The knot whose equation is furthest from being met, of those still asked for.
    fn worst(&self) -> Option<usize> {
        let asked = (0..self.knots.len()).filter(|&i| !self.knots[i].given_up);
        asked.max_by(|&i, &j| self.knots[i].mismatch.total_cmp(&self.knots[j].mismatch))
    }

    /// Asks nothing more of the knots whose equation isn't nearly met; they keep the tangents they have.
    fn give_up_unmet(&mut self) {
        for knot in &mut self.knots {
            knot.given_up |= !(knot.mismatch <= CLOSE);
        }
    }

    /// Asks nothing more of a knot: it has the tangent that it started with.
    fn give_up(&mut self, knot: usize, start: &[f64]) {
        self.knots[knot].given_up = true;
        self.knots[knot].tangent = start[knot];
    }

    /// From tangents of 0: those that solve the equations of the map linearised at the straight line, which are
    /// near enough to spare one evaluation of four. Returns whether they are a start: not where the curve bends
    /// so much that they lead astray. Maps that are linear anyway need no other.
    fn start_from_linear(&mut self, matrix: &mut BlockTridiagonal<1>) -> bool {
        /// Radians that all tangents keep within of the chords. Chosen: up to here, no contour of thousands is
        /// led to another curve, and one in a hundred is spared a search; at 2.2 rad some are led astray.
        const LITTLE: f64 = 1.3;
        /// Up to so many knots lie on a circle, whose tangents solve the run at once where arcs are segments.
        const ON_A_CIRCLE: usize = 3;
        let Nature { is_linear, order, .. } = self.nature;
        if is_linear || order != 1.0 || self.knots.len() <= ON_A_CIRCLE {
            return is_linear;
        }
        let straight = self.map.curvatures(ChordAngles::default(), &SegmentContext::UNIT);
        for i in 0..self.segments.len() {
            let ChordAngles { theta0, theta1 } = self.angles(i);
            let response = &mut self.segments[i].response;
            *response = straight;
            response.turn([theta0, theta1]);
        }
        self.write_rows(true);
        self.linearize(matrix);
        matrix.solve();
        let last = self.knots.len() - 1;
        let bends_little = |(i, (knot, [tangent])): (usize, (&SystemKnot, &[f64; 1]))| {
            let is_end = !self.closed && (i == 0 || i == last);
            tangent.abs() <= LITTLE && (is_end || (knot.turn - tangent).abs() <= LITTLE)
        };
        let is_start = self.knots.iter().zip(&matrix.right).enumerate().all(bends_little);
        if is_start {
            for (knot, [tangent]) in self.knots.iter_mut().zip(&matrix.right) {
                knot.tangent = *tangent;
            }
            for (end, segment) in [(0, 0), (last, self.segments.len() - 1)] {
                if let Equation::End(NaturalEnd::Angle(function)) = self.knots[end].equation {
                    let ChordAngles { theta0, theta1 } = self.angles(segment);
                    self.knots[end].tangent = function(if end == 0 { theta1 } else { theta0 }).0;
                }
            }
            self.keep_in_range();
        }
        is_start
    }

    /// Tangents that are known roughly.
    fn start_from(&mut self, known: &[ChordAngles]) {
        let n = self.knots.len();
        for (knot, angles) in self.knots.iter_mut().zip(known) {
            knot.tangent = angles.theta0;
        }
        if let (false, Some(last)) = (self.closed, known.last()) {
            self.knots[n - 1].tangent = last.theta1;
        }
        self.keep_in_range();
    }

    /// The end tangents of a segment.
    fn angles(&self, segment: usize) -> ChordAngles {
        let end = &self.knots[if segment + 1 == self.knots.len() { 0 } else { segment + 1 }];
        let is_last = !self.closed && segment + 1 == self.segments.len();
        let theta1 = if is_last { end.tangent } else { end.turn - end.tangent };
        ChordAngles::new(self.knots[segment].tangent, theta1)
    }

    /// The end curvatures of every segment. Where angles have hardly changed since they were last computed,
    /// the derivatives tell what they are now.
    fn evaluate(&mut self) {
        /// Radians over which smooth maps differ from linear ones by less than rounding.
        const NEAR: f64 = 1e-10;
        let most = if self.nature.order == 1.0 { NEAR } else { 0.0 };
        for index in 0..self.segments.len() {
            let angles = self.angles(index);
            let segment = &mut self.segments[index];
            let known = segment.angles;
            let change = [angles.theta0 - known.theta0, angles.theta1 - known.theta1];
            segment.is_asked = !change.iter().all(|change| change.abs() <= most);
            if !segment.is_asked {
                segment.response.turn(change);
            }
            segment.angles = angles;
        }
        self.map.answer(&mut self.segments);
        self.has_run = true;
    }

    /// Brings both angles at every knot within the family's limit.
    fn keep_in_range(&mut self) {
        let limit = self.nature.limit;
        if limit == f64::INFINITY {
            return;
        }
        let n = self.knots.len();
        for (i, knot) in self.knots.iter_mut().enumerate() {
            let (mut low, mut high) = (-limit, limit);
            if self.closed || (i > 0 && i + 1 < n) {
                low = low.max(knot.turn - limit);
                high = high.min(knot.turn + limit);
            }
            knot.tangent =
                if low < high { knot.tangent.clamp(low, high) } else { (low + high) / 2.0 };
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

impl Row {
    /// The knot keeps its tangent.
    const UNASKED: Row = Row { value: 0.0, lower: 0.0, diagonal: 1.0, upper: 0.0 };
}

impl TangentSystem<'_> {
    /// Fills in the knots' equations. A knot's unknown is `theta0` of the segment after it, which is the turn
    /// less `theta1` of the one before; at the end of an open run, `theta1` itself.
    fn write_rows(&mut self, is_linear: bool) {
        let n = self.knots.len();
        let mut before = if self.closed { self.segments.last() } else { None };
        for (i, knot) in self.knots.iter_mut().enumerate() {
            let after = self.segments.get(i);
            if let (Equation::Continuous, Some(before), Some(after)) =
                (knot.equation, before, after)
            {
                // How theta1 of the segment after responds to the unknown of the next knot.
                let next = if !self.closed && i + 2 == n { 1.0 } else { -1.0 };
                knot.row = if is_linear {
                    linear_continuity(before, after, next)
                } else {
                    self.nature.continuity([&before.response, &after.response], knot.scales, next)
                };
            }
            before = after;
        }
        if !self.closed {
            (self.knots[0].row, self.knots[n - 1].row) = (self.end_row(0), self.end_row(1));
        }
    }

    /// The equation of the first knot (0) or the last one (1) of an open run.
    fn end_row(&self, end: usize) -> Row {
        let (knot, segment) = [(0, 0), (self.knots.len() - 1, self.segments.len() - 1)][end];
        let (value, [by0, by1]) = match self.knots[knot].equation {
            Equation::Continuous => return Row::UNASKED,
            Equation::Direction(angle) => {
                return Row { value: self.knots[knot].tangent - angle, ..Row::UNASKED };
            }
            Equation::End(natural) => self.natural_end(natural, segment, end),
            Equation::Curvature(curvature) => self.end_curvature(segment, end, curvature),
        };
        if end == 0 {
            let next = if self.segments.len() == 1 { 1.0 } else { -1.0 };
            Row { value, diagonal: by0, upper: by1 * next, lower: 0.0 }
        } else {
            Row { value, diagonal: by1, lower: by0, upper: 0.0 }
        }
    }

    /// How far a free end at the start (0) or end (1) of a segment is from what must hold there, and
    /// how that responds to the segment's angles.
    fn natural_end(&self, natural: NaturalEnd, segment: usize, end: usize) -> (f64, [f64; 2]) {
        let ChordAngles { theta0, theta1 } = self.angles(segment);
        let [own, other] = if end == 0 { [theta0, theta1] } else { [theta1, theta0] };
        let (value, [by_own, by_other]) = match natural {
            NaturalEnd::Arc => (own - other, [1.0, -1.0]),
            NaturalEnd::Angle(function) => {
                let (angle, slope) = function(other);
                (own - angle, [1.0, -slope])
            }
            NaturalEnd::ZeroCurvature => return self.end_curvature(segment, end, 0.0),
            NaturalEnd::Curl(curl) => {
                /// METAFONT's bound.
                const LARGEST_RATIO: f64 = 4.0;
                let response = &self.segments[segment].response;
                // Between equal weights for small and large curls.
                let (here, there) = (1.0 / (1.0 + curl), curl / (1.0 + curl));
                let by = |angle: usize| {
                    here * response.by_angle[end][angle].num
                        - there * response.by_angle[1 - end][angle].num
                };
                let ratio = (-by(1 - end) / by(end)).min(LARGEST_RATIO);
                (own - ratio * other, [1.0, -ratio])
            }
        };
        (value, if end == 0 { [by_own, by_other] } else { [by_other, by_own] })
    }

    /// The tangents reached.
    fn finish(mut self, iterations: usize) -> Tangents {
        let ends = (self.segments.iter().enumerate())
            .map(|(i, segment)| {
                let curvatures = self.has_run.then_some(segment.response.value);
                let (angles, curvatures) = self.forwards(self.angles(i), curvatures);
                SegmentEnds { angles, curvatures, context: segment.context }
            })
            .collect();
        let mismatch = self.knots.iter().map(|knot| knot.mismatch).collect();
        let adapted = std::mem::take(&mut self.adapted);
        Tangents { ends, mismatch, adapted, iterations, stage: Stage::Plain }
    }

    /// The tangents along which a segment of a periodic map is travelled: what shapes without reversals
    /// can draw, too.
    fn forwards(
        &self,
        angles: ChordAngles,
        curvatures: Option<[EndCurvature; 2]>,
    ) -> (ChordAngles, Option<[EndCurvature; 2]>) {
        let (true, Some(curvatures)) = (self.map.is_periodic(), curvatures) else {
            return (angles, curvatures);
        };
        let travelled = |angle: f64, EndCurvature { num, den }: EndCurvature| {
            if den < 0.0 {
                (wrap_angle(angle + PI), EndCurvature { num: -num, den: -den })
            } else {
                (wrap_angle(angle), EndCurvature { num, den })
            }
        };
        let (theta0, first) = travelled(angles.theta0, curvatures[0]);
        let (theta1, last) = travelled(angles.theta1, curvatures[1]);
        (ChordAngles::new(theta0, theta1), Some([first, last]))
    }

    /// How far the curvature at the start (0) or end (1) of a segment is from the one wanted, in the
    /// run's units, and how that responds to the segment's angles.
    fn end_curvature(&self, segment: usize, end: usize, wanted: f64) -> (f64, [f64; 2]) {
        let MappedSegment { context, response, .. } = &self.segments[segment];
        let own = Turned::new(response.value[end], 1.0);
        let wanted = Turned { num: wanted * context.chord, den: 1.0 };
        (wanted.angle_to(&own), own.angles_by(response.by_angle[end]))
    }
}

/// The equation that curvature is continuous where two segments of a linear map meet: κ/c on both sides,
/// over the sum's response to the knot's own angle, so that the equation is in radians; the chords first over
/// the longer one, which keeps their products in the range of numbers.
fn linear_continuity(before: &MappedSegment, after: &MappedSegment, next: f64) -> Row {
    let (cl, cr) = (before.context.chord, after.context.chord);
    let (left, right) = (&before.response, &after.response);
    let (wl, wr) = (cr / cl.max(cr), cl / cl.max(cr));
    let own = left.by_angle[1][1].num * wl + right.by_angle[0][0].num * wr;
    let (wl, wr) = (wl / own, wr / own);
    Row {
        value: right.value[0].num * wr - left.value[1].num * wl,
        lower: -left.by_angle[1][0].num * wl,
        diagonal: 1.0,
        upper: right.by_angle[0][1].num * wr * next,
    }
}

impl System<1> for TangentSystem<'_> {
    fn residual(&mut self) -> f64 {
        self.evaluate();
        self.write_rows(self.nature.is_linear);
        let mut residual = 0.0f64;
        for knot in &mut self.knots {
            knot.mismatch = knot.row.value.abs();
            if knot.given_up {
                knot.row = Row::UNASKED;
            }
            residual = larger(residual, knot.row.value.abs());
        }
        residual
    }

    fn linearize(&self, matrix: &mut BlockTridiagonal<1>) {
        for (i, SystemKnot { row, .. }) in self.knots.iter().enumerate() {
            matrix.rows[i] = BlockRow::new([[row.lower]], [[row.diagonal]], [[row.upper]]);
            matrix.right[i] = [-row.value];
        }
    }

    fn advance(&mut self, step: &[[f64; 1]]) -> f64 {
        /// Radians a knot may turn in one step.
        const CLAMP: f64 = 0.7;
        let most = if self.nature.is_linear { f64::INFINITY } else { CLAMP };
        let mut size = 0.0f64;
        for (knot, [step]) in self.knots.iter_mut().zip(step) {
            if step.is_finite() {
                knot.tangent += step.clamp(-most, most);
            }
            size = size.max(step.abs());
        }
        self.keep_in_range();
        size
    }
}

/// Curvature times √(product of the two chords), as the direction of a vector: see
/// `docs/decisions/0002-unknowns-and-residual.md`.
struct Turned {
    num: f64,
    den: f64,
}

impl Turned {
    fn new(end: EndCurvature, scale: f64) -> Self {
        Turned { num: end.num * scale, den: end.den }
    }

    /// The angle to turn by to come to the other vector: zero where curvatures agree, whatever
    /// their size, and half a turn off where a curve would arrive forwards and leave backwards.
    fn angle_to(&self, other: &Turned) -> f64 {
        argument(Complex64::new(self.den * other.den + self.num * other.num, self.cross(other)))
    }

    /// The same for curvatures that leave zero with some power: the angle between their roots of
    /// that order, and by how much more than [`angle_to`](Self::angle_to) it changes with the
    /// angle of either vector.
    ///
    /// Roots are taken of curvature over a common size, which is held while differentiating: where
    /// curvatures agree, it doesn't matter.
    #[inline(never)] // rare
    fn straightened_angle_to(&self, other: &Turned, order: f64) -> (f64, [f64; 2]) {
        /// Curvatures over their common size count as no smaller in derivatives.
        const SMALLEST: f64 = 1e-200;
        let curvatures = [self.num / self.den, other.num / other.den];
        let size = curvatures[0].abs().max(curvatures[1].abs());
        if !(size > 0.0 && size.is_finite()) {
            return (self.angle_to(other), [1.0; 2]);
        }
        let roots = curvatures.map(|k| size * (k.abs() / size).powf(1.0 / order).copysign(k));
        let more = [0, 1].map(|i| {
            let (k, root) = (curvatures[i], roots[i]);
            let slope = (k.abs() / size).max(SMALLEST).powf(1.0 / order - 1.0) / order;
            slope * (1.0 + k * k) / (1.0 + root * root)
        });
        let [from, to] = roots.map(|root| argument(Complex64::new(1.0, root)));
        (to - from, more)
    }

    /// How the vector's angle changes when the curvature it stands for changes by either of these.
    fn angles_by(&self, changes: [EndCurvature; 2]) -> [f64; 2] {
        let reciprocal = 1.0 / self.squared();
        changes.map(|change| self.cross(&Turned::new(change, 1.0)) * reciprocal)
    }

    /// The square of the vector's length, above 0.
    fn squared(&self) -> f64 {
        (self.den * self.den + self.num * self.num).max(f64::MIN_POSITIVE)
    }

    fn cross(&self, other: &Turned) -> f64 {
        self.den * other.num - self.num * other.den
    }
}
