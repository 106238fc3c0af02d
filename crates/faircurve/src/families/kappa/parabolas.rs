//! Yan et al.'s formulation: one parabola a knot, with its vertex there; neighbours meet with the same
//! tangent and, up to sign, the same curvature.

use std::sync::Arc;

use kurbo::{PathSeg, Point, QuadBez, Vec2};

use crate::frame::{ChordAngles, EndCurvature, direction, wrap_angle};
use crate::numeric::block_tridiagonal::{BlockRow, BlockTridiagonal};
use crate::numeric::order::sort_by;
use crate::numeric::roots::horner;
use crate::plan::Run;
use crate::segment::{Measured, Segment, UnitBezier};
use crate::spline::Stage;
use crate::two_param::shape::SegmentEnds;
use crate::two_param::tangents::{Tangents, context, ignored_curvature};

/// The parabolas of a run: that of knot i has the control points J(i−1), c(i), J(i), where
/// J(i) = (1 − λ(i)) c(i) + λ(i) c(i+1) is its joint with the next one.
///
/// At a free end there is no parabola: c is the end, and so is the joint (λ = 0 at the start, 1 at the
/// end). At an end with a given tangent there is half of one: it starts at the knot, its vertex, in
/// that direction.
#[derive(Debug)]
pub(super) struct Parabolas {
    middle: Vec<Vec2>,
    /// Where on the line from one middle control point to the next the joint lies.
    lambda: Vec<f64>,
    /// The parameter of the vertex, where the knot is.
    vertex: Vec<f64>,
    /// How far each knot is from being a vertex, and the joint after it from equal curvatures.
    pub(super) mismatch: Vec<f64>,
    /// Knots that aren't at a vertex.
    given_up: Vec<bool>,
    /// Whether joints stay where they are.
    fixed_joints: bool,
    iterations: usize,
}

impl Parabolas {
    /// Finds them by the iteration of the paper's section 4: joints of equal curvature from the
    /// control points, vertices from the joints, and control points from both, by a linear system.
    /// `None` if they haven't settled after so many steps.
    ///
    /// The iteration sees rounded numbers, so that copies which are moved, turned or scaled take the
    /// same course; it ends with the exact ones. Parabolas always pass through their knots.
    pub(super) fn settle(run: &Run, most: usize) -> Option<Parabolas> {
        let rounded = rounded(run);
        let mut matrix = BlockTridiagonal::new(run.knots.len(), run.closed);
        let mut parabolas = Parabolas::new(&rounded);
        let moved = parabolas.iterate(&rounded, &mut matrix, most, NEAR);
        if moved > NEAR || parabolas.give_up_those_at_joints(&rounded) {
            return None;
        }
        parabolas.finish(run, &mut matrix, most);
        Some(parabolas)
    }

    /// The same in at most so many steps, whether they settle or not: knots whose parabolas don't are
    /// given up, the worst first. They lie where their chords divide the parameter, not at the vertex.
    pub(super) fn search(run: &Run, most: usize) -> Parabolas {
        /// Shares of the steps: before any knot is given up, after some have been, and at the end.
        const SHARES: [usize; 3] = [2, 16, 6];
        let n = run.knots.len();
        let rounded = rounded(run);
        let mut parabolas = Parabolas::new(&rounded);
        let mut matrix = BlockTridiagonal::new(n, run.closed);
        let mut moved = parabolas.iterate(&rounded, &mut matrix, most / SHARES[0], NEAR);
        let mut count = 1;
        while moved > NEAR || parabolas.has_vertex_at_joint(&rounded) {
            if parabolas.iterations + most / SHARES[1] + most / SHARES[2] > most {
                // Then joints stay in the middle and knots where they are: that has a solution always.
                let iterations = parabolas.iterations;
                parabolas =
                    Parabolas { fixed_joints: true, iterations, ..Parabolas::new(&rounded) };
                parabolas.give_up(&rounded, n);
                break;
            }
            if !parabolas.give_up_those_at_joints(&rounded) {
                parabolas.measure(&rounded);
                parabolas.give_up(&rounded, count);
                count *= 4;
            }
            moved = parabolas.iterate(&rounded, &mut matrix, most / SHARES[1], NEAR);
        }
        parabolas.finish(run, &mut matrix, most / SHARES[2]);
        parabolas
    }

    /// Goes on with the exact numbers.
    fn finish(&mut self, run: &Run, matrix: &mut BlockTridiagonal<2>, most: usize) {
        self.find_middles(run, matrix);
        let size = (0..run.segment_count()).map(|i| run.chord(i).hypot()).fold(0.0, f64::max);
        self.iterate(run, matrix, most, 1e-15 * size);
        self.measure(run);
    }

    /// Gives up the vertices of so many knots, those furthest from them.
    fn give_up(&mut self, run: &Run, count: usize) {
        let n = self.middle.len();
        let mut worst: Vec<usize> =
            (0..n).filter(|&i| !is_end(run, i) && !self.given_up[i]).collect();
        sort_by(&mut worst, |&i, &j| self.mismatch[j].total_cmp(&self.mismatch[i]));
        for i in worst.into_iter().take(count) {
            (self.given_up[i], self.vertex[i]) = (true, between_chords(run, i));
        }
    }

    /// Whether the vertex of a knot has come so close to a joint that curvature would jump there within
    /// a thousandth of the parabola, and the control points hardly be determined.
    fn is_at_joint(&self, run: &Run, knot: usize) -> bool {
        const CLOSE: f64 = 1e-3;
        !is_end(run, knot) && !(CLOSE..=1.0 - CLOSE).contains(&self.vertex[knot])
    }

    fn has_vertex_at_joint(&self, run: &Run) -> bool {
        (0..self.middle.len()).any(|i| self.is_at_joint(run, i))
    }

    /// Gives up those knots; whether there are any.
    fn give_up_those_at_joints(&mut self, run: &Run) -> bool {
        let any = self.has_vertex_at_joint(run);
        for i in 0..self.middle.len() {
            if self.is_at_joint(run, i) {
                (self.given_up[i], self.vertex[i]) = (true, between_chords(run, i));
            }
        }
        any
    }

    fn new(run: &Run) -> Parabolas {
        let n = run.knots.len();
        let mut lambda = vec![0.5; run.segment_count()];
        if Self::is_free(run, 0) {
            lambda[0] = 0.0;
        }
        if Self::is_free(run, n - 1) {
            lambda[n - 2] = 1.0;
        }
        Parabolas {
            middle: run.knots.iter().map(|knot| knot.point.to_vec2()).collect(),
            lambda,
            vertex: vec![0.5; n],
            mismatch: vec![0.0; n],
            given_up: vec![false; n],
            fixed_joints: false,
            iterations: 0,
        }
    }

    /// Steps of the iteration until control points move by at most `settled`; returns how far the last
    /// one moved them.
    fn iterate(
        &mut self,
        run: &Run,
        matrix: &mut BlockTridiagonal<2>,
        most: usize,
        settled: f64,
    ) -> f64 {
        let mut moved = f64::INFINITY;
        let last = self.iterations + most;
        while self.iterations < last && moved > settled {
            self.find_joints(run);
            self.find_vertices(run);
            moved = self.find_middles(run, matrix);
            self.iterations += 1;
        }
        moved
    }

    fn is_free(run: &Run, knot: usize) -> bool {
        is_end(run, knot) && run.knots[knot].tangent.is_none()
    }

    /// From one middle control point to the next.
    fn leg(&self, segment: usize) -> Vec2 {
        self.middle[(segment + 1) % self.middle.len()] - self.middle[segment]
    }

    /// The legs of the parabola of knot i: from its start to its middle control point, and from there
    /// to its end.
    fn legs(&self, run: &Run, knot: usize) -> [Vec2; 2] {
        let n = self.middle.len();
        let beyond = self.middle[knot] - run.knots[knot].point.to_vec2();
        let before = if run.closed || knot > 0 {
            let segment = (knot + n - 1) % n;
            self.leg(segment) * (1.0 - self.lambda[segment])
        } else {
            beyond
        };
        let after =
            if run.closed || knot + 1 < n { self.leg(knot) * self.lambda[knot] } else { -beyond };
        [before, after]
    }

    /// λ from equal curvature at the joints.
    fn find_joints(&mut self, run: &Run) {
        if self.fixed_joints {
            return;
        }
        let n = self.middle.len();
        let old = self.lambda.clone();
        for (i, lambda) in old.into_iter().enumerate() {
            let next = (i + 1) % n;
            if Self::is_free(run, i) || Self::is_free(run, next) {
                continue;
            }
            let leg = self.leg(i);
            let (before, after) = (self.legs(run, i)[0], self.legs(run, next)[1]);
            let (a, b) = (before.cross(leg).abs().sqrt(), leg.cross(after).abs().sqrt());
            let found = a / (a + b);
            self.lambda[i] = if found.is_finite() { found } else { lambda };
        }
    }

    /// The parameters of the vertices, from the ends of the parabolas.
    fn find_vertices(&mut self, run: &Run) {
        for i in (0..self.middle.len()).filter(|&i| !is_end(run, i) && !self.given_up[i]) {
            let [before, after] = self.legs(run, i);
            let knot = run.knots[i].point.to_vec2();
            let c0 = self.middle[i] - before - knot;
            let c2 = self.middle[i] + after - knot;
            let chord = c2 - c0;
            // |c₂ − c₀|² t³ + 3 (c₂ − c₀)·(c₀ − p) t² + (3c₀ − 2p − c₂)·(c₀ − p) t − |c₀ − p|² = 0
            let cubic =
                [-c0.hypot2(), (c0 * 3.0 - c2).dot(c0), 3.0 * chord.dot(c0), chord.hypot2()];
            self.vertex[i] = vertex(&cubic, self.vertex[i]);
        }
    }

    /// The control points for which every parabola passes through its knot; returns how far they
    /// move.
    fn find_middles(&mut self, run: &Run, matrix: &mut BlockTridiagonal<2>) -> f64 {
        let n = self.middle.len();
        let scaled = |factor: f64| [[factor, 0.0], [0.0, factor]];
        for i in 0..n {
            let knot = run.knots[i].point.to_vec2();
            let (mut lower, mut diagonal, mut upper) = (0.0, 1.0, 0.0);
            matrix.right[i] = [knot.x, knot.y];
            if !is_end(run, i) {
                let t = self.vertex[i];
                let (before, after) = (self.lambda[(i + n - 1) % n], self.lambda[i]);
                lower = (1.0 - t) * (1.0 - t) * (1.0 - before);
                upper = t * t * after;
                diagonal = 1.0 - lower - upper;
            }
            matrix.rows[i] = BlockRow::new(scaled(lower), scaled(diagonal), scaled(upper));
            if let (true, Some(tangent)) = (is_end(run, i), run.knots[i].tangent) {
                // On the tangent, and the vertex at the knot: a = λ/(1 + λ) of what the next control
                // point is along it.
                let share = if i == 0 { self.lambda[0] } else { 1.0 - self.lambda[i - 1] };
                let share = share / (1.0 + share);
                let along = Vec2::from_angle(tangent);
                let onto = [
                    [-share * along.x * along.x, -share * along.x * along.y],
                    [-share * along.x * along.y, -share * along.y * along.y],
                ];
                let rest = knot - along * (share * along.dot(knot));
                matrix.right[i] = [rest.x, rest.y];
                if i == 0 {
                    matrix.rows[i].upper = onto;
                } else {
                    matrix.rows[i].lower = onto;
                }
            }
        }
        matrix.solve();
        let mut moved = 0.0f64;
        for (middle, &[x, y]) in self.middle.iter_mut().zip(&matrix.right) {
            let found = Vec2::new(x, y);
            if found.is_finite() {
                moved = moved.max((found - *middle).hypot());
                *middle = found;
            }
        }
        moved
    }

    /// The velocity at the vertex, halved.
    fn at_vertex(&self, run: &Run, knot: usize) -> Vec2 {
        let [before, after] = self.legs(run, knot);
        if is_end(run, knot) {
            return if knot == 0 { before } else { after };
        }
        let t = self.vertex[knot];
        before * (1.0 - t) + after * t
    }

    /// What doesn't hold: greatest curvature at the knots, equal curvature at the joints.
    fn measure(&mut self, run: &Run) {
        let n = self.middle.len();
        for i in 0..n {
            let mut off = 0.0f64;
            if !is_end(run, i) {
                let [before, after] = self.legs(run, i);
                let (velocity, bend) = (self.at_vertex(run, i), after - before);
                let cos = velocity.dot(bend) / (velocity.hypot() * bend.hypot());
                if cos.is_finite() {
                    off = cos.abs();
                }
            }
            let next = (i + 1) % n;
            let joins = i < self.lambda.len();
            if joins && !Self::is_free(run, i) && !Self::is_free(run, next) {
                let leg = self.leg(i);
                let (before, after) = (self.legs(run, i)[0], self.legs(run, next)[1]);
                let (a, b) = (before.cross(leg).abs().sqrt(), leg.cross(after).abs().sqrt());
                // The share of the leg that the joint should have.
                let lambda = self.lambda[i];
                off = off.max((a * (1.0 - lambda) - b * lambda).abs() / (a + b).max(1e-300));
            }
            self.mismatch[i] = off;
        }
    }

    /// The tangents at the knots, with the curvatures there.
    pub(super) fn tangents(&self, run: &Run) -> Tangents {
        let n = run.knots.len();
        let ends = (0..run.segment_count())
            .map(|i| {
                let next = (i + 1) % n;
                let chord = run.chord(i);
                let angle = |knot: usize| {
                    let along = if Self::is_free(run, knot) {
                        self.leg(i)
                    } else {
                        self.at_vertex(run, knot)
                    };
                    direction(along) - direction(chord)
                };
                let curvature = |knot: usize| {
                    let [before, after] = self.legs(run, knot);
                    let velocity = self.at_vertex(run, knot);
                    let speed = velocity.hypot();
                    if Self::is_free(run, knot) || speed == 0.0 {
                        return EndCurvature::finite(0.0);
                    }
                    let num = 0.5 * velocity.cross(after - before) / speed * chord.hypot();
                    EndCurvature { num, den: speed * speed }
                };
                SegmentEnds {
                    angles: ChordAngles::new(wrap_angle(-angle(i)), wrap_angle(angle(next))),
                    curvatures: Some([curvature(i), curvature(next)]),
                    context: context(run, i),
                }
            })
            .collect();
        Tangents {
            ends,
            mismatch: vec![0.0; n],
            adapted: (0..n)
                .filter(|&i| run.knots[i].curvature.is_some())
                .map(ignored_curvature)
                .collect(),
            iterations: self.iterations,
            stage: Stage::Plain,
        }
    }

    /// Between two knots: what follows the vertex of the first parabola, then what precedes that of
    /// the second.
    pub(super) fn segments(&self, run: &Run) -> Vec<Segment> {
        /// A part of the chord this short is nothing but rounding, and has its direction.
        const ROUNDING: f64 = 1e-12;
        let n = run.knots.len();
        (0..run.segment_count())
            .map(|i| {
                let next = (i + 1) % n;
                let (start, end) = (run.knots[i].point, run.knots[next].point);
                let joint = (self.middle[i] + self.leg(i) * self.lambda[i]).to_point();
                let is_at = |knot: Point| (joint - knot).hypot() <= ROUNDING * run.chord(i).hypot();
                let half = |knot: usize, leg: usize| {
                    let t = self.vertex[knot];
                    let part = match (is_end(run, knot), leg) {
                        (true, _) => 1.0,
                        (false, 0) => t,
                        (false, _) => 1.0 - t,
                    };
                    let legs = [self.at_vertex(run, knot) * part, self.legs(run, knot)[leg] * part];
                    if leg == 1 { legs } else { [legs[1], legs[0]] }
                };
                let mut members = Vec::with_capacity(2);
                match (Self::is_free(run, i), Self::is_free(run, next)) {
                    (true, _) => members.push(parabola(start, end, half(next, 0))),
                    (_, true) => members.push(parabola(start, end, half(i, 1))),
                    _ if is_at(start) => members.push(parabola(start, end, half(next, 0))),
                    _ if is_at(end) => members.push(parabola(start, end, half(i, 1))),
                    _ => {
                        members.push(parabola(start, joint, half(i, 1)));
                        members.push(parabola(joint, end, half(next, 0)));
                    }
                }
                Segment::chain(members)
            })
            .collect()
    }
}

/// The root of the cubic between 0 and 1, where it rises from below zero to above, by Newton's method
/// from a guess, halving where that leaves the bracket.
fn vertex(cubic: &[f64; 4], guess: f64) -> f64 {
    /// Far more than needed.
    const MOST_STEPS: usize = 80;
    let (mut low, mut high, mut t) = (0.0, 1.0, guess);
    for _ in 0..MOST_STEPS {
        let value = horner(cubic, t);
        if value == 0.0 {
            break;
        } else if value < 0.0 {
            low = t;
        } else {
            high = t;
        }
        let slope = cubic[1] + t * (2.0 * cubic[2] + t * 3.0 * cubic[3]);
        let newton = t - value / slope;
        let next = if newton > low && newton < high { newton } else { (low + high) / 2.0 };
        if (next - t).abs() <= f64::EPSILON * t {
            return next;
        }
        t = next;
    }
    t
}

/// The parameter of a knot that is given up: as the chords on both sides divide their sum.
fn between_chords(run: &Run, knot: usize) -> f64 {
    /// Nearer to a joint the control points would hardly be determined.
    const NEAREST: f64 = 0.01;
    let n = run.knots.len();
    let (before, after) = (run.chord((knot + n - 1) % n).hypot(), run.chord(knot).hypot());
    (before / (before + after)).clamp(NEAREST, 1.0 - NEAREST)
}

/// Control points that move by less, in units of the longest chord, have settled as far as rounded
/// numbers tell.
const NEAR: f64 = 1e-7;

/// The same run with its first chord along +x and its longest 1 long, its numbers rounded.
fn rounded(run: &Run) -> Run {
    const FINENESS: f64 = 1.0 / (1u64 << 26) as f64;
    let fixed = |number: f64| (number / FINENESS).round() * FINENESS;
    let first = run.chord(0);
    let longest = (0..run.segment_count()).map(|i| run.chord(i).hypot()).fold(0.0, f64::max);
    let unit = first * (longest / first.hypot());
    let (start, squared) = (run.knots[0].point, unit.hypot2());
    let mut rounded = run.clone();
    for knot in &mut rounded.knots {
        let along = knot.point - start;
        knot.point =
            Point::new(fixed(unit.dot(along) / squared), fixed(unit.cross(along) / squared));
        knot.tangent = knot.tangent.map(|tangent| fixed(wrap_angle(tangent - direction(first))));
    }
    rounded
}

fn is_end(run: &Run, knot: usize) -> bool {
    !run.closed && (knot == 0 || knot + 1 == run.knots.len())
}

/// A quadratic Bézier from `start` to `end` by its two legs, whose sum is the way between them; they
/// know the directions better than the points do where it is short.
pub(super) fn parabola(start: Point, end: Point, [first, second]: [Vec2; 2]) -> Segment {
    let chord = first + second;
    let onto = chord / chord.hypot2();
    let control = Point::new(first.dot(onto), onto.cross(first));
    if !control.is_finite() || !chord.is_finite() {
        return Segment::line(start, end);
    }
    let quad = QuadBez::new(Point::ORIGIN, control, Point::new(1.0, 0.0));
    let curve = Arc::new(Measured::new(UnitBezier::new(PathSeg::Quad(quad))));
    Segment::unit_curve_along(start, end, curve, chord)
}
