//! Lookup tables of two-parameter families (thesis section 8.4): end curvatures and midpoints on a
//! grid of end tangents, with bicubic interpolation.

use std::fmt;

use kurbo::{Point, Vec2};

use super::curvature_map::{CurvatureMap, EndCurvatures, SegmentContext};
use super::extract::segment_with;
use super::shape::{SegmentEnds, SegmentShape};
use crate::frame::{ChordAngles, EndCurvature, direction};
use crate::segment::Segment;
use crate::spline::Spline;

/// What is known of a segment with given end tangents, on the unit chord.
///
/// Numerators and denominators of both end curvatures, the point halfway along, and the direction
/// there.
type Entry = [f64; ENTRY];
const ENTRY: usize = 7;

/// A table over the square |θ| ≤ range.
///
/// It is a [`CurvatureMap`], so that a spline's tangents may be solved from it, and it
/// [draws](Self::points) by subdivision, from the table alone. Between the nodes entries are
/// bicubic, with slopes from five nodes: the error falls with the fourth power of the number of
/// nodes a side. For the Euler spiral and |θ| ≤ 3 end curvatures are off by at most 3.5e-5 with
/// 32 × 32 nodes and 1.1e-6 with 64 × 64 (the thesis says 1e-4 and 6e-6); for |θ| ≤ 2, by 4e-6 and
/// 2e-7. Families that aren't smooth gain less: the map of log-aesthetic curves with α ≠ 1 has a kink
/// at the line, where the error is a part of the spacing (0.09 with 32 × 32 nodes for α = 1.78, half
/// of that with 64 × 64).
///
/// ```
/// use faircurve::families::euler::EulerSpirals;
/// use faircurve::frame::ChordAngles;
/// use faircurve::two_param::lookup_table::LookupTable;
/// let table = LookupTable::new(&EulerSpirals, &EulerSpirals, 2.0, 32);
/// let [start, _] = table.end_curvatures(ChordAngles::new(0.5, 0.5));
/// assert!((start - 2.0 * 0.5f64.sin()).abs() < 1e-5);
/// ```
#[derive(Clone)]
pub struct LookupTable {
    range: f64,
    side: usize,
    /// By `theta0`, then `theta1`: entries, their slopes by either node number, and by both.
    nodes: Vec<[Entry; 4]>,
}

impl fmt::Debug for LookupTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LookupTable")
            .field("range", &self.range)
            .field("side", &self.side)
            .finish_non_exhaustive()
    }
}

impl LookupTable {
    /// The table of a curvature map and a shape for |θ| ≤ `range` (at most the map's limit), with
    /// `side` nodes each way (at least 5).
    pub fn new(
        map: &dyn CurvatureMap,
        shape: &dyn SegmentShape,
        range: f64,
        side: usize,
    ) -> LookupTable {
        let context = SegmentContext::UNIT;
        LookupTable::from_segments(range.min(map.limit()), side, |angles| {
            let curvatures = map.curvatures(angles, &context).value;
            let ends = SegmentEnds { angles, curvatures: Some(curvatures), context };
            (curvatures, shape.place(Point::ORIGIN, Point::new(1.0, 0.0), &ends))
        })
    }

    /// The table of any two-parameter spline, from the segments that it draws between two knots with
    /// tangents given. Their own curvatures are tabulated; a spline that compares others (Hobby's)
    /// would find other tangents. Where the spline has no segment, the entry is that of the line.
    pub fn of_spline(spline: &dyn Spline, range: f64, side: usize) -> LookupTable {
        LookupTable::from_segments(range, side, |angles| {
            let segment = segment_with(spline, angles)
                .unwrap_or_else(|| Segment::line(Point::ORIGIN, Point::new(1.0, 0.0)));
            let ends = [0.0, segment.length()].map(|s| EndCurvature::finite(segment.curvature(s)));
            (ends, segment)
        })
    }

    fn from_segments(
        range: f64,
        side: usize,
        segment: impl Fn(ChordAngles) -> ([EndCurvature; 2], Segment),
    ) -> LookupTable {
        let side = side.max(5);
        let angle = |i: usize| range * (2.0 * i as f64 / (side - 1) as f64 - 1.0);
        let entry = |n: usize| -> Entry {
            let angles = ChordAngles::new(angle(n / side), angle(n % side));
            let ([start, end], segment) = segment(angles);
            let halfway = segment.at(segment.length() / 2.0);
            let direction = halfway.direction - segment.direction(0.0) - angles.theta0;
            let point = halfway.point;
            [start.num, start.den, end.num, end.den, point.x, point.y, direction]
        };
        let values: Vec<Entry> = (0..side * side).map(entry).collect();
        let by0 = slopes(&values, side, side, 1);
        let by1 = slopes(&values, side, 1, side);
        let by_both = slopes(&by0, side, 1, side);
        let nodes = (0..side * side).map(|n| [values[n], by0[n], by1[n], by_both[n]]).collect();
        LookupTable { range, side, nodes }
    }

    /// The largest magnitude of an angle.
    pub fn range(&self) -> f64 {
        self.range
    }

    /// The entry at these angles (brought within the range), and its derivatives by them.
    fn look_up(&self, angles: ChordAngles) -> [Entry; 3] {
        let per_angle = (self.side - 1) as f64 / (2.0 * self.range);
        let place = |theta: f64| {
            let place = (theta.clamp(-self.range, self.range) + self.range) * per_angle;
            let index = (place as usize).min(self.side - 2);
            (index, Hermite::new(place - index as f64))
        };
        let ((i, across), (j, along)) = (place(angles.theta0), place(angles.theta1));
        let mut result = [[0.0; ENTRY]; 3];
        for (di, dj) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let node = &self.nodes[(i + di) * self.side + j + dj];
            // Weights of value and slope in either direction.
            let ([v0, s0], [dv0, ds0]) = (across.value[di], across.slope[di]);
            let ([v1, s1], [dv1, ds1]) = (along.value[dj], along.slope[dj]);
            let weights = [
                [v0 * v1, s0 * v1, v0 * s1, s0 * s1],
                [dv0 * v1, ds0 * v1, dv0 * s1, ds0 * s1].map(|w| w * per_angle),
                [v0 * dv1, s0 * dv1, v0 * ds1, s0 * ds1].map(|w| w * per_angle),
            ];
            for (sum, weights) in result.iter_mut().zip(weights) {
                for (entry, weight) in node.iter().zip(weights) {
                    for (total, value) in sum.iter_mut().zip(entry) {
                        *total += weight * value;
                    }
                }
            }
        }
        result
    }

    /// Curvatures at the start and at the end for unit chord.
    pub fn end_curvatures(&self, angles: ChordAngles) -> [f64; 2] {
        let [[num0, den0, num1, den1, ..], ..] = self.look_up(angles);
        [num0 / den0, num1 / den1]
    }

    /// The point halfway along the segment on the unit chord, and the direction there.
    pub fn midpoint(&self, angles: ChordAngles) -> (Point, f64) {
        let [[.., x, y, direction], ..] = self.look_up(angles);
        (Point::new(x, y), direction)
    }

    /// Points along the segment from `start` to `end`, both included: 2ⁿ pieces, halved `halvings`
    /// times (at most 16), each by the table's midpoint for its own end tangents.
    ///
    /// Exact for extensional families, but for the table's error; other families have other curves
    /// between a knot and a midpoint.
    pub fn points(
        &self,
        start: Point,
        end: Point,
        angles: ChordAngles,
        halvings: u32,
    ) -> Vec<Point> {
        let mut points = vec![start];
        self.subdivide(start, end, angles, halvings.min(16), &mut points);
        points
    }

    fn subdivide(
        &self,
        start: Point,
        end: Point,
        angles: ChordAngles,
        halvings: u32,
        points: &mut Vec<Point>,
    ) {
        if halvings == 0 {
            points.push(end);
            return;
        }
        let (middle, way) = self.midpoint(angles);
        let (before, after) = (middle.to_vec2(), Vec2::new(1.0 - middle.x, -middle.y));
        let (left, right) = (direction(before), direction(after));
        let first = ChordAngles::new(left + angles.theta0, way - left);
        let second = ChordAngles::new(right - way, angles.theta1 - right);
        let chord = end - start;
        let turned = Vec2::new(
            chord.x * middle.x - chord.y * middle.y,
            chord.y * middle.x + chord.x * middle.y,
        );
        let middle = start + turned;
        self.subdivide(start, middle, first, halvings - 1, points);
        self.subdivide(middle, end, second, halvings - 1, points);
    }
}

/// Derivatives by node number along one of the two directions, from five nodes: to fourth order.
fn slopes(values: &[Entry], side: usize, stride: usize, other: usize) -> Vec<Entry> {
    // At the first, the second, and any other node, of the nodes from the first, or around it.
    const FIRST: [f64; 5] = [-25.0, 48.0, -36.0, 16.0, -3.0];
    const SECOND: [f64; 5] = [-3.0, -10.0, 18.0, -6.0, 1.0];
    const INNER: [f64; 5] = [1.0, -8.0, 0.0, 8.0, -1.0];
    let mut slopes = vec![[0.0; ENTRY]; values.len()];
    for line in 0..side {
        for i in 0..side {
            let from_end = side - 1 - i;
            let (weights, start, sign) = match (i, from_end) {
                (0, _) => (FIRST, 0, 1.0),
                (1, _) => (SECOND, 0, 1.0),
                (_, 0) => (FIRST, side - 1, -1.0),
                (_, 1) => (SECOND, side - 1, -1.0),
                _ => (INNER, i - 2, 1.0),
            };
            for (k, weight) in weights.into_iter().enumerate() {
                let node = if sign > 0.0 { start + k } else { start - k };
                let value = &values[node * stride + line * other];
                let slope = &mut slopes[i * stride + line * other];
                for (slope, value) in slope.iter_mut().zip(value) {
                    *slope += sign * weight / 12.0 * value;
                }
            }
        }
    }
    slopes
}

/// Cubic Hermite weights between two nodes, by node: of value and slope there.
struct Hermite {
    value: [[f64; 2]; 2],
    slope: [[f64; 2]; 2],
}

impl Hermite {
    fn new(t: f64) -> Self {
        let u = 1.0 - t;
        Hermite {
            value: [[u * u * (1.0 + 2.0 * t), u * u * t], [t * t * (1.0 + 2.0 * u), -t * t * u]],
            slope: [[-6.0 * t * u, u * (u - 2.0 * t)], [6.0 * t * u, t * (t - 2.0 * u)]],
        }
    }
}

impl CurvatureMap for LookupTable {
    fn curvatures(&self, angles: ChordAngles, _context: &SegmentContext) -> EndCurvatures {
        let [value, by0, by1] = self.look_up(angles);
        let end = |entry: &Entry, end: usize| EndCurvature {
            num: entry[2 * end],
            den: entry[2 * end + 1],
        };
        EndCurvatures {
            value: [0, 1].map(|i| end(&value, i)),
            by_angle: [0, 1].map(|i| [end(&by0, i), end(&by1, i)]),
        }
    }

    fn limit(&self) -> f64 {
        self.range
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::{self, Params};
    use crate::families::euler::{self, EulerSpirals};
    use crate::families::log_aesthetic::LogAesthetic;
    use crate::two_param::continuity::{Continuity, NaturalEnd};
    use crate::two_param::generating::Cuts;
    use crate::two_param::spline::TwoParamSpline;
    use crate::{Contour, solve};

    fn random() -> impl FnMut() -> f64 {
        let mut state = 3u64;
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    /// The largest error of end curvatures; `examples/lookup_table.rs` has a million points.
    fn largest_error(table: &LookupTable, map: &dyn CurvatureMap) -> f64 {
        let mut random = random();
        let mut worst = 0.0f64;
        for _ in 0..20_000 {
            let range = table.range();
            let angles = ChordAngles::new(range * random(), range * random());
            let exact = map.curvatures(angles, &SegmentContext::UNIT).value;
            for (ours, exact) in table.end_curvatures(angles).into_iter().zip(exact) {
                worst = worst.max((ours - exact.num / exact.den).abs());
            }
        }
        worst
    }

    #[test]
    fn errors_are_as_the_thesis_says_or_smaller() {
        // Nearly the whole square of angles; the thesis says 1e-4 and 6e-6.
        let error = |side| {
            let table = LookupTable::new(&EulerSpirals, &EulerSpirals, 3.0, side);
            largest_error(&table, &EulerSpirals)
        };
        let (coarse, fine) = (error(32), error(64));
        assert!(coarse < 3.5e-5 && fine < 1.1e-6, "{coarse:e} {fine:e}");
    }

    #[test]
    fn derivatives_are_those_of_the_interpolation() {
        let table = LookupTable::new(&EulerSpirals, &EulerSpirals, 2.0, 16);
        let h = 1e-6;
        for (theta0, theta1) in [(0.1, 0.2), (-1.9, 1.95), (0.7, -1.3)] {
            let at = |a: f64, b: f64| {
                table.curvatures(ChordAngles::new(theta0 + a, theta1 + b), &SegmentContext::UNIT)
            };
            let exact = at(0.0, 0.0);
            for end in 0..2 {
                for (angle, (up, down)) in
                    [(at(h, 0.0), at(-h, 0.0)), (at(0.0, h), at(0.0, -h))].into_iter().enumerate()
                {
                    let slope = (up.value[end].num - down.value[end].num) / (2.0 * h);
                    let error = (slope - exact.by_angle[end][angle].num).abs();
                    assert!(error < 1e-8, "{theta0} {theta1}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn drawing_by_subdivision_follows_the_curve() {
        let curve = Cuts { curve: LogAesthetic::new(1.5) };
        let (start, end) = (Point::new(3.0, -1.0), Point::new(-2.0, 5.0));
        for (map, shape) in [
            (&EulerSpirals as &dyn CurvatureMap, &EulerSpirals as &dyn SegmentShape),
            (&curve, &curve),
        ] {
            let table = LookupTable::new(map, shape, 2.0, 64);
            for (theta0, theta1) in [(0.4, 0.9), (-0.8, 1.2), (1.5, 1.5), (0.3, -1.9)] {
                let angles = ChordAngles::new(theta0, theta1);
                let ends = SegmentEnds { angles, curvatures: None, context: SegmentContext::UNIT };
                let exact = shape.place(start, end, &ends);
                let points = table.points(start, end, angles, 5);
                assert_eq!(points.len(), 33);
                for (i, point) in points.into_iter().enumerate() {
                    let off = (point - exact.point(exact.length() * i as f64 / 32.0)).hypot();
                    assert!(off < 2e-4 * exact.chord_length(), "{map:?} {angles:?} {i}: {off:e}");
                }
            }
        }
    }

    #[test]
    fn a_spline_may_be_solved_from_a_table() {
        let table = LookupTable::new(&EulerSpirals, &EulerSpirals, 2.0, 64);
        let rule = Continuity { map: table, end: NaturalEnd::Arc };
        let spline = TwoParamSpline::new(&euler::INFO, rule, EulerSpirals);
        let exact = catalog::spline("euler").unwrap();
        let contour = Contour::closed([(0.0, 0.0), (3.0, 1.0), (4.0, 4.0), (1.0, 5.0), (0.5, 2.0)]);
        let (ours, exact) = (solve(&contour, &spline).unwrap(), solve(&contour, &*exact).unwrap());
        for (ours, exact) in ours.knots.iter().zip(&exact.knots) {
            let off = (ours.direction_out.unwrap() - exact.direction_out.unwrap()).abs();
            assert!(off < 1e-5, "{off:e}");
        }
    }

    #[test]
    fn every_spline_has_a_table() {
        let params = Params::new().with("alpha", 2.0);
        for spline in [
            catalog::build("log-aesthetic", &params).unwrap(),
            catalog::spline("euler").unwrap(),
            catalog::spline("generated").unwrap(),
        ] {
            let table = LookupTable::of_spline(&*spline, 1.5, 17);
            let [start, end] = table.end_curvatures(ChordAngles::new(0.75, 0.75));
            let arc = 2.0 * 0.75f64.sin();
            assert!((start - arc).abs() < 1e-12 && (end - arc).abs() < 1e-12, "{start} {end}");
        }
    }
}
