//! One piece of a curve: its shape and where it lies.

use std::f64::consts::FRAC_PI_2;

use kurbo::{Point, Rect, Vec2};
use num_complex::Complex64;

use crate::frame::{ChordAngles, direction, turning};
use crate::numeric::roots::{monotone_root, roots_between};
use crate::numeric::spiro_integral::{
    angle, curvature_jet, spiro_integral, spiro_integral_between, sub_parameters,
};

/// A curve whose curvature is a cubic polynomial of arc length (thesis section 7.3), scaled to arc
/// length 1: k₀ … k₃ of eq. 8.1, curvature and its derivatives at the middle. The Euler spiral is
/// the case k₂ = k₃ = 0, the circular arc k₁ = 0 too, the line k₀ = 0 too.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct PolynomialSpiral {
    /// Curvature and its first three derivatives at the middle, for arc length 1.
    pub k: [f64; 4],
}

/// Chord over arc length and direction of the chord of a [`PolynomialSpiral`], in the frame in
/// which its middle points along +x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpiralChord {
    /// Chord length for arc length 1, in [0, 1].
    pub length: f64,
    /// ψ of eq. 8.21, here as the full-range arctangent.
    pub direction: f64,
}

impl PolynomialSpiral {
    /// The spiral of these parameters.
    pub const fn new(k: [f64; 4]) -> Self {
        PolynomialSpiral { k }
    }

    /// Its chord, to the accuracy of [`spiro_integral`].
    pub fn chord(&self) -> SpiralChord {
        let chord = spiro_integral(self.k);
        SpiralChord { length: chord.norm_sqr().sqrt(), direction: chord.arg() }
    }

    /// The end tangents relative to the chord (eq. 8.19–8.20), not wrapped: their sum is the whole
    /// turning, windings included.
    pub fn chord_angles(&self) -> ChordAngles {
        let psi = self.chord().direction;
        ChordAngles { theta0: psi - angle(self.k, -0.5), theta1: angle(self.k, 0.5) - psi }
    }

    /// The piece between two places s ∈ [−½, ½], itself scaled to arc length 1 (eq. 8.3).
    pub fn piece(&self, from: f64, to: f64) -> Self {
        PolynomialSpiral { k: sub_parameters(self.k, (from + to) / 2.0, to - from) }
    }
}

/// What shape a segment has. Grows with the families; match with a wildcard.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A straight line; exact.
    Line,
    /// A polynomial spiral.
    Spiral(PolynomialSpiral),
}

/// A shape placed between two points. Arc length runs from 0 at `start` to [`length`](Self::length).
///
/// Ends are exact: the curve passes through `start` and `end` to the bit. Points between are
/// accurate to about 1e-15 of the arc length plus rounding of the coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    start: Point,
    end: Point,
    shape: Shape,
    length: f64,
    /// Direction at the middle of the arc (for a line, everywhere).
    middle_direction: f64,
}

/// Point, direction and curvature somewhere on a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// The point, in user units.
    pub point: Point,
    /// Direction of travel in radians, not wrapped.
    pub direction: f64,
    /// Curvature in 1/units, counterclockwise positive.
    pub curvature: f64,
}

impl Segment {
    /// The straight line. For a zero chord the direction is 0; see
    /// [`line_with_direction`](Self::line_with_direction).
    pub fn line(start: Point, end: Point) -> Self {
        let chord = end - start;
        let direction = if chord == Vec2::ZERO { 0.0 } else { direction(chord) };
        Segment::line_with_direction(start, end, direction)
    }

    /// A straight line that remembers a direction of its own: for a segment of length 0, which has
    /// none.
    pub fn line_with_direction(start: Point, end: Point, direction: f64) -> Self {
        Segment {
            start,
            end,
            shape: Shape::Line,
            length: (end - start).hypot(),
            middle_direction: direction,
        }
    }

    /// A spiral scaled and turned so that its chord is that from `start` to `end`.
    ///
    /// A spiral that ends where it began can't be placed on a chord: where its chord is below
    /// 1e-9 of its arc, and where the chord or a parameter isn't finite, the straight line stands
    /// in.
    pub fn spiral(start: Point, end: Point, spiral: PolynomialSpiral) -> Self {
        /// Shorter chords would be mostly rounding error.
        const SHORTEST_CHORD: f64 = 1e-9;
        let chord = end - start;
        let local = spiral.chord();
        if chord == Vec2::ZERO || !(local.length > SHORTEST_CHORD) {
            return Segment::line(start, end);
        }
        Segment {
            start,
            end,
            shape: Shape::Spiral(spiral),
            length: chord.hypot() / local.length,
            middle_direction: direction(chord) - local.direction,
        }
    }

    /// Where it starts.
    pub fn start(&self) -> Point {
        self.start
    }

    /// Where it ends.
    pub fn end(&self) -> Point {
        self.end
    }

    /// Its shape.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// k₀ … k₃ of eq. 8.1; zeros for a line.
    pub fn kappa(&self) -> [f64; 4] {
        match self.shape {
            Shape::Line => [0.0; 4],
            Shape::Spiral(spiral) => spiral.k,
        }
    }

    /// Whether it is a straight line.
    pub fn is_line(&self) -> bool {
        matches!(self.shape, Shape::Line)
    }

    /// Arc length.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Straight distance from start to end.
    pub fn chord_length(&self) -> f64 {
        (self.end - self.start).hypot()
    }

    /// Direction at arc length `s`, in radians, continuous along the segment.
    pub fn direction(&self, s: f64) -> f64 {
        self.middle_direction + angle(self.kappa(), self.local(s))
    }

    /// Curvature at arc length `s`, in 1/units.
    pub fn curvature(&self, s: f64) -> f64 {
        self.curvature_jet(s)[0]
    }

    /// Curvature at arc length `s` and its first three derivatives by arc length, the j-th in
    /// units⁻ʲ⁻¹ (eq. 8.6). Zeros on a line.
    pub fn curvature_jet(&self, s: f64) -> [f64; 4] {
        if self.is_line() {
            return [0.0; 4];
        }
        let mut jet = curvature_jet(self.kappa(), self.local(s));
        let mut scale = 1.0;
        for derivative in &mut jet {
            scale /= self.length;
            *derivative *= scale;
        }
        jet
    }

    /// Point at arc length `s`, clamped to the segment.
    pub fn point(&self, s: f64) -> Point {
        let s = s.clamp(0.0, self.length);
        if s == 0.0 {
            return self.start;
        } else if s == self.length {
            return self.end;
        }
        let local = self.local(s);
        match self.shape {
            Shape::Line => self.start.lerp(self.end, s / self.length),
            // From the nearer end, so that ends are met and errors stay small.
            Shape::Spiral(spiral) if local < 0.0 => {
                self.start + self.placed(spiro_integral_between(spiral.k, -0.5, local))
            }
            Shape::Spiral(spiral) => {
                self.end - self.placed(spiro_integral_between(spiral.k, local, 0.5))
            }
        }
    }

    /// Point, direction and curvature at arc length `s`, clamped to the segment.
    pub fn at(&self, s: f64) -> CurvePoint {
        let s = s.clamp(0.0, self.length);
        CurvePoint {
            point: self.point(s),
            direction: self.direction(s),
            curvature: self.curvature(s),
        }
    }

    /// The piece between arc lengths `from` and `to`, clamped to the segment (eq. 8.3).
    pub fn subsegment(&self, from: f64, to: f64) -> Segment {
        let (from, to) = (from.clamp(0.0, self.length), to.clamp(0.0, self.length));
        let (start, end) = (self.point(from), self.point(to));
        match self.shape {
            Shape::Line => Segment::line_with_direction(start, end, self.middle_direction),
            Shape::Spiral(spiral) => Segment {
                start,
                end,
                shape: Shape::Spiral(spiral.piece(self.local(from), self.local(to))),
                length: to - from,
                middle_direction: self.direction((from + to) / 2.0),
            },
        }
    }

    /// The same segment travelled the other way.
    pub fn reversed(&self) -> Segment {
        let k = self.kappa();
        Segment {
            start: self.end,
            end: self.start,
            shape: match self.shape {
                Shape::Line => Shape::Line,
                // θ(s) → θ(−s) + π: odd orders of curvature keep their sign, even ones lose it.
                Shape::Spiral(_) => {
                    Shape::Spiral(PolynomialSpiral::new([-k[0], k[1], -k[2], k[3]]))
                }
            },
            length: self.length,
            middle_direction: self.middle_direction + std::f64::consts::PI,
        }
    }

    /// The same segment scaled and turned onto another chord, which must not be zero: what undoing
    /// a scale by a power of two does, or giving a merged knot its own place.
    pub(crate) fn moved_to(&self, start: Point, end: Point) -> Segment {
        match self.shape {
            Shape::Line => Segment::line(start, end),
            Shape::Spiral(_) => {
                let (from, to) = (self.end - self.start, end - start);
                Segment {
                    start,
                    end,
                    length: self.length * (to.hypot() / from.hypot()),
                    // Exactly 0 where the chord has only been scaled.
                    middle_direction: self.middle_direction + turning(from, to),
                    ..*self
                }
            }
        }
    }

    /// Arc lengths at which curvature is zero (inflections), ascending; none on a line.
    pub fn inflections(&self) -> Vec<f64> {
        let k = self.kappa();
        self.places_from_local(&roots_between(&[k[0], k[1], k[2] / 2.0, k[3] / 6.0], -0.5, 0.5))
    }

    /// Arc lengths inside the segment at which |curvature| has an extremum or κ′ = 0, ascending.
    pub fn curvature_extrema(&self) -> Vec<f64> {
        let k = self.kappa();
        self.places_from_local(&roots_between(&[k[1], k[2], k[3] / 2.0], -0.5, 0.5))
    }

    /// Arc lengths at which the tangent is horizontal or vertical, ascending; none on a line.
    pub fn axis_extrema(&self) -> Vec<f64> {
        let Shape::Spiral(spiral) = self.shape else {
            return Vec::new();
        };
        let k = spiral.k;
        let direction = |s: f64| self.middle_direction + angle(k, s);
        let mut places = Vec::new();
        let mut breaks = vec![-0.5];
        breaks.extend(roots_between(&[k[0], k[1], k[2] / 2.0, k[3] / 6.0], -0.5, 0.5));
        breaks.push(0.5);
        for pair in breaks.windows(2) {
            // Direction is monotone here; visit each quarter turn that it passes.
            let (a, b) = (direction(pair[0]), direction(pair[1]));
            let quarter =
                |n: f64| monotone_root(|s| direction(s) - n * FRAC_PI_2, pair[0], pair[1]);
            let (low, high) = (a.min(b) / FRAC_PI_2, a.max(b) / FRAC_PI_2);
            let mut quarters: Vec<f64> = Vec::new();
            let mut n = low.ceil();
            while n <= high {
                quarters.extend(quarter(n));
                n += 1.0;
            }
            if a > b {
                quarters.reverse();
            }
            places.extend(quarters);
        }
        places.dedup();
        self.places_from_local(&places)
    }

    /// The smallest box that holds the segment, to rounding.
    pub fn bounding_box(&self) -> Rect {
        let mut bounds = Rect::from_points(self.start, self.end);
        for s in self.axis_extrema() {
            bounds = bounds.union_pt(self.point(s));
        }
        bounds
    }

    /// The arc length of the point nearest to `target` and its distance, which exceeds the true
    /// distance by at most `accuracy` (in user units; values below 1e-12 of the arc length count as
    /// that).
    pub fn nearest(&self, target: Point, accuracy: f64) -> (f64, f64) {
        let accuracy = accuracy.max(1e-12 * self.length).max(f64::MIN_POSITIVE);
        let distance = |s: f64| (self.point(s) - target).hypot();
        let mut best = [0.0, self.length, self.length / 2.0]
            .map(|s| (s, distance(s)))
            .into_iter()
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap_or((0.0, 0.0));
        // Branch and bound: an arc of length h lies within h/2 of its middle and, where |κ| ≤ K,
        // within K·h²/8 of its chord.
        let mut stack = vec![(0.0, self.length, self.start, self.end)];
        while let Some((from, to, start, end)) = stack.pop() {
            let h = to - from;
            let sagitta = (self.largest_curvature(from, to) * h * h / 8.0).min(h / 2.0);
            let (along, to_chord) = nearest_on_chord(target, start, end);
            // The foot on the chord is the guess for the arc.
            let guess = from + along * h;
            let candidate = distance(guess);
            if candidate < best.1 {
                best = (guess, candidate);
            }
            if to_chord - sagitta < best.1 - accuracy && sagitta > 0.25 * accuracy {
                let middle = from + h / 2.0;
                let point = self.point(middle);
                stack.push((from, middle, start, point));
                stack.push((middle, to, point, end));
            }
        }
        best
    }

    /// ∫ κ² ds, in 1/units (exact: the integrand is a polynomial).
    pub fn bending_energy(&self) -> f64 {
        if self.is_line() {
            return 0.0;
        }
        let k = self.kappa();
        mean_square(&[k[0], k[1], k[2] / 2.0, k[3] / 6.0]) / self.length
    }

    /// ∫ κ′² ds, in 1/units³ (exact: the integrand is a polynomial).
    pub fn variation_energy(&self) -> f64 {
        if self.is_line() {
            return 0.0;
        }
        let k = self.kappa();
        mean_square(&[k[1], k[2], k[3] / 2.0]) / self.length.powi(3)
    }

    /// An upper bound of |κ| between two arc lengths.
    pub fn largest_curvature(&self, from: f64, to: f64) -> f64 {
        if self.length == 0.0 {
            return 0.0;
        }
        let (a, b) = (self.local(from), self.local(to));
        let jet = curvature_jet(self.kappa(), (a + b) / 2.0);
        let half = (b - a) / 2.0;
        let bound = jet[0].abs()
            + half * (jet[1].abs() + half * (jet[2].abs() / 2.0 + half * jet[3].abs() / 6.0));
        bound / self.length
    }

    /// s ∈ [−½, ½] for an arc length.
    fn local(&self, s: f64) -> f64 {
        if self.length == 0.0 { 0.0 } else { s / self.length - 0.5 }
    }

    fn places_from_local(&self, local: &[f64]) -> Vec<f64> {
        local.iter().map(|s| ((s + 0.5) * self.length).clamp(0.0, self.length)).collect()
    }

    /// A vector of the unit-length middle frame, scaled and turned into place.
    fn placed(&self, local: Complex64) -> Vec2 {
        let turned = local * Complex64::from_polar(self.length, self.middle_direction);
        Vec2::new(turned.re, turned.im)
    }
}

/// The fraction along the chord nearest to `target`, and its distance.
fn nearest_on_chord(target: Point, start: Point, end: Point) -> (f64, f64) {
    let chord = end - start;
    let squared = chord.hypot2();
    let along =
        if squared > 0.0 { ((target - start).dot(chord) / squared).clamp(0.0, 1.0) } else { 0.5 };
    (along, (start + chord * along - target).hypot())
}

/// ∫ p(s)² ds over [−½, ½] for p = Σ cᵢ sⁱ.
fn mean_square(coefficients: &[f64]) -> f64 {
    let mut sum = 0.0;
    for (i, a) in coefficients.iter().enumerate() {
        for (j, b) in coefficients.iter().enumerate() {
            if (i + j) % 2 == 0 {
                sum += a * b * 0.5f64.powi((i + j) as i32) / (i + j + 1) as f64;
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Segment {
        let spiral = PolynomialSpiral::new([1.2, -3.0, 9.0, 40.0]);
        Segment::spiral(Point::new(3.0, -2.0), Point::new(40.0, 25.0), spiral)
    }

    #[test]
    fn point_direction_and_curvature_belong_together() {
        let segment = sample();
        let h = 1e-4 * segment.length();
        for i in 1..50 {
            let s = segment.length() * f64::from(i) / 50.0;
            let tangent = (segment.point(s + h) - segment.point(s - h)) / (2.0 * h);
            assert!((tangent - Vec2::from_angle(segment.direction(s))).hypot() < 1e-6);
            let turn = (segment.direction(s + h) - segment.direction(s - h)) / (2.0 * h);
            assert!((turn - segment.curvature(s)).abs() < 1e-6);
            let slope = (segment.curvature(s + h) - segment.curvature(s - h)) / (2.0 * h);
            assert!((slope - segment.curvature_jet(s)[1]).abs() < 1e-6);
        }
    }

    #[test]
    fn ends_are_exact_and_both_halves_meet() {
        let segment = sample();
        assert_eq!(segment.point(0.0), segment.start());
        assert_eq!(segment.point(segment.length()), segment.end());
        let middle = segment.length() / 2.0;
        let gap = segment.point(middle * (1.0 - 1e-15)) - segment.point(middle);
        assert!(gap.hypot() < 1e-13 * segment.length());
    }

    #[test]
    fn a_piece_lies_on_the_whole() {
        let segment = sample();
        let piece = segment.subsegment(7.0, 31.0);
        for i in 0..=20 {
            let s = 24.0 * f64::from(i) / 20.0;
            let (a, b) = (piece.at(s), segment.at(7.0 + s));
            assert!((a.point - b.point).hypot() < 1e-12);
            assert!((a.direction - b.direction).abs() < 1e-13);
            assert!((a.curvature - b.curvature).abs() < 1e-13);
        }
        let backwards = segment.reversed();
        let there = segment.at(10.0);
        let back = backwards.at(segment.length() - 10.0);
        assert!((there.point - back.point).hypot() < 1e-12);
        assert!((there.curvature + back.curvature).abs() < 1e-13);
    }

    #[test]
    fn the_box_is_the_smallest() {
        let segment = sample();
        let bounds = segment.bounding_box();
        let mut seen = Rect::from_points(segment.start(), segment.end());
        for i in 0..=4000 {
            let point = segment.point(segment.length() * f64::from(i) / 4000.0);
            assert!(bounds.inflate(1e-12, 1e-12).contains(point));
            seen = seen.union_pt(point);
        }
        assert!((bounds.area() - seen.area()).abs() < 1e-4 * bounds.area());
    }

    #[test]
    fn nearest_points_are_no_farther_than_any_sample() {
        let segment = sample();
        for target in [(0.0, 0.0), (20.0, 5.0), (45.0, 30.0), (18.0, 20.0), (-50.0, 90.0)] {
            let target = Point::from(target);
            let (s, distance) = segment.nearest(target, 1e-9);
            assert!(((segment.point(s) - target).hypot() - distance).abs() < 1e-12);
            for i in 0..=4000 {
                let point = segment.point(segment.length() * f64::from(i) / 4000.0);
                assert!(distance <= (point - target).hypot() + 1e-9);
            }
        }
    }

    #[test]
    fn energies_agree_with_quadrature() {
        let segment = sample();
        let (mut bending, mut variation) = (0.0, 0.0);
        let n = 20_000;
        for i in 0..n {
            let jet = segment.curvature_jet(segment.length() * (f64::from(i) + 0.5) / f64::from(n));
            bending += jet[0] * jet[0];
            variation += jet[1] * jet[1];
        }
        let ds = segment.length() / f64::from(n);
        assert!((bending * ds / segment.bending_energy() - 1.0).abs() < 1e-7);
        assert!((variation * ds / segment.variation_energy() - 1.0).abs() < 1e-7);
    }

    #[test]
    fn inflections_and_extrema_are_where_they_should_be() {
        let segment = sample();
        for s in segment.inflections() {
            assert!(segment.curvature(s).abs() < 1e-14);
        }
        for s in segment.curvature_extrema() {
            assert!(segment.curvature_jet(s)[1].abs() < 1e-15);
        }
    }
}
