//! Measures of a curve's fairness (thesis 2.1) and of its smoothness at the knots (2.2).

use crate::curve::Curve;
use crate::frame::wrap_angle;
use crate::numeric::order::sort_by;
use crate::segment::{PolynomialSpiral, Segment, Shape};

/// What can be measured of a curve, or of several together. All numbers are finite; where an
/// integral diverges, as ∫κ² does at a cusp, some large number stands for it.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Fairness {
    /// Arc length, in the drawing's units.
    pub length: f64,
    /// ∫κ² ds, in 1/units: twice the energy of a bent elastic strip.
    pub bending_energy: f64,
    /// ∫κ′² ds, in 1/units³; jumps of curvature at knots are not counted.
    pub variation_energy: f64,
    /// The largest |κ|, in 1/units. Exact on lines and spirals, elsewhere the largest of many
    /// places, so that it may be a little small.
    pub largest_curvature: f64,
    /// The largest |κ′|, in 1/units²; as [`largest_curvature`](Self::largest_curvature).
    pub largest_variation: f64,
    /// ∫|κ| ds in radians: how much the curve turns, to and fro; corners and cusps not counted.
    pub turning: f64,
    /// Places inside segments where |κ| is largest or least or κ′ is 0, with the limits of
    /// [`Segment::curvature_extrema`].
    pub extrema: usize,
    /// Places where curvature changes its sign: inside segments, with the limits of
    /// [`Segment::inflections`], and at smooth knots.
    pub inflections: usize,
}

impl Fairness {
    /// Of one curve.
    ///
    /// ```
    /// use std::f64::consts::TAU;
    /// use faircurve::{Contour, catalog, measure::Fairness, solve};
    /// let circle = Contour::closed([(2.0, 0.0), (0.0, 2.0), (-2.0, 0.0), (0.0, -2.0)]);
    /// let curve = solve(&circle, &*catalog::spline("euler")?)?.curve;
    /// let fairness = Fairness::of(&curve);
    /// assert!((fairness.length - 2.0 * TAU).abs() < 1e-12);
    /// assert!((fairness.scale_free_energy() - TAU * TAU).abs() < 1e-11);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(curve: &Curve) -> Self {
        let segments = curve.segments();
        let mut all = segments.iter().map(of_segment).fold(Fairness::default(), Fairness::and);
        all.inflections += inflections_at_knots(curve);
        all
    }

    /// Of several curves together, from the measures of each.
    pub fn and(self, other: Fairness) -> Fairness {
        let sum = |a: f64, b: f64| (a + b).min(f64::MAX);
        Fairness {
            length: sum(self.length, other.length),
            bending_energy: sum(self.bending_energy, other.bending_energy),
            variation_energy: sum(self.variation_energy, other.variation_energy),
            largest_curvature: self.largest_curvature.max(other.largest_curvature),
            largest_variation: self.largest_variation.max(other.largest_variation),
            turning: sum(self.turning, other.turning),
            extrema: self.extrema + other.extrema,
            inflections: self.inflections + other.inflections,
        }
    }

    /// length · ∫κ² ds, the bending energy in a form that has no unit (thesis 2.1): (2π)² for a circle, and no
    /// less for any other closed curve that turns once.
    pub fn scale_free_energy(&self) -> f64 {
        (self.length * self.bending_energy).min(f64::MAX)
    }
}

fn of_segment(segment: &Segment) -> Fairness {
    let [largest_curvature, largest_variation] = largest(segment);
    Fairness {
        length: segment.length(),
        bending_energy: finite(segment.bending_energy()),
        variation_energy: finite(segment.variation_energy()),
        largest_curvature,
        largest_variation,
        turning: turning(segment),
        extrema: segment.curvature_extrema().len(),
        inflections: segment.inflections().len(),
    }
}

/// Infinite and undefined numbers as the largest there is.
fn finite(x: f64) -> f64 {
    if x.is_finite() { x } else { f64::MAX }
}

/// The largest |κ| and |κ′|.
fn largest(segment: &Segment) -> [f64; 2] {
    match segment.shape() {
        Shape::Line => [0.0; 2],
        Shape::Spiral(PolynomialSpiral { k }) => {
            // κ′ is extreme at the ends or where κ″ = k₂ + k₃ s = 0.
            let vertex = -k[2] / k[3];
            let inner = (vertex.abs() < 0.5).then(|| (vertex + 0.5) * segment.length());
            let mut places = segment.curvature_extrema();
            places.extend([0.0, segment.length()].into_iter().chain(inner));
            largest_at(segment, &places)
        }
        _ => {
            const PLACES: usize = 64;
            let mut places = segment.curvature_extrema();
            for ends in stretches(segment).windows(2) {
                places.extend((0..=PLACES).map(|i| inside(ends, i as f64 / PLACES as f64)));
            }
            largest_at(segment, &places)
        }
    }
}

fn largest_at(segment: &Segment, places: &[f64]) -> [f64; 2] {
    let jets = places.iter().map(|s| segment.curvature_jet(*s));
    jets.fold([0.0f64; 2], |most, jet| {
        [most[0].max(finite(jet[0].abs())), most[1].max(finite(jet[1].abs()))]
    })
}

/// The ends of the smooth stretches of a segment.
fn stretches(segment: &Segment) -> Vec<f64> {
    let ends = [0.0].into_iter().chain(segment.breaks()).chain([segment.length()]);
    ends.collect()
}

/// A place in a stretch, a little off its ends: at a joint or a cusp, functions have the values of the
/// other side.
fn inside(ends: &[f64], along: f64) -> f64 {
    ends[0] + (ends[1] - ends[0]) * along.clamp(1e-9, 1.0 - 1e-9)
}

/// ∫|κ| ds: between inflections, the change of direction.
fn turning(segment: &Segment) -> f64 {
    let mut stops = stretches(segment);
    stops.extend(segment.inflections());
    sort_by(&mut stops, f64::total_cmp);
    let turn = |ends: &[f64]| {
        (segment.direction(inside(ends, 1.0)) - segment.direction(inside(ends, 0.0))).abs()
    };
    match segment.shape() {
        // To the last bit where nothing needs to be kept off.
        Shape::Line | Shape::Spiral(_) => {
            let turn = |ends: &[f64]| segment.direction(ends[1]) - segment.direction(ends[0]);
            stops.windows(2).map(|ends| turn(ends).abs()).sum()
        }
        _ => stops.windows(2).map(turn).sum(),
    }
}

/// Changes of curvature's sign from one segment to the next.
fn inflections_at_knots(curve: &Curve) -> usize {
    /// Radians; beyond, a knot is a corner, where the curve bends anyhow.
    const SMOOTH: f64 = 1e-6;
    let changes = |(before, after): &(&Segment, &Segment)| {
        let turn = after.direction(0.0) - before.direction(before.length());
        let (a, b) = (before.curvature(before.length()), after.curvature(0.0));
        // Curvature that is zero to rounding has no sign.
        let none = 1e-9 / before.length().max(after.length());
        wrap_angle(turn).abs() < SMOOTH && a.signum() != b.signum() && a.abs().min(b.abs()) > none
    };
    neighbours(curve).iter().flatten().filter(|pair| changes(pair)).count()
}

/// How much direction, curvature and its derivatives jump at a knot: what leaves less what arrives.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Jump {
    /// Of the direction of travel, radians in (−π, π].
    pub direction: f64,
    /// Of curvature, in 1/units.
    pub curvature: f64,
    /// Of dκ/ds, in 1/units².
    pub first_derivative: f64,
    /// Of d²κ/ds², in 1/units³.
    pub second_derivative: f64,
    /// The harmonic mean of the two chords, in units.
    pub size: f64,
}

impl Jump {
    /// Direction, κ, κ′, κ″ without units: times `size` to the power of 0, 1, 2, 3.
    pub fn dimensionless(&self) -> [f64; 4] {
        let h = self.size;
        [
            self.direction,
            self.curvature * h,
            self.first_derivative * h * h,
            self.second_derivative * h * h * h,
        ]
        .map(clamp)
    }

    fn between(before: &Segment, after: &Segment) -> Self {
        let (a, b) = (before.chord_length(), after.chord_length());
        let jets = (before.curvature_jet(before.length()), after.curvature_jet(0.0));
        let jump = |order: usize| clamp(jets.1[order] - jets.0[order]);
        Jump {
            direction: wrap_angle(after.direction(0.0) - before.direction(before.length())),
            curvature: jump(0),
            first_derivative: jump(1),
            second_derivative: jump(2),
            size: 2.0 / (1.0 / a + 1.0 / b),
        }
    }
}

fn clamp(x: f64) -> f64 {
    if x.is_nan() { f64::MAX } else { x.clamp(f64::MIN, f64::MAX) }
}

/// The jumps at every knot, in the input's numbering; `None` at the ends of an open curve. Segments of
/// length 0, between coincident knots, are passed over: the jump is at the first of those knots.
pub fn jumps(curve: &Curve) -> Vec<Option<Jump>> {
    let pairs = neighbours(curve);
    pairs.into_iter().map(|pair| pair.map(|(a, b)| Jump::between(a, b))).collect()
}

/// The jumps at joints inside segments of several pieces (biarcs, the two parabolas of κ-curves).
pub(super) fn jumps_within(curve: &Curve) -> Vec<Jump> {
    let pieces = curve.segments().iter().filter_map(|segment| match segment.shape() {
        Shape::Chain(members) => Some(members),
        _ => None,
    });
    pieces.flat_map(|m| m.windows(2).map(|pair| Jump::between(&pair[0], &pair[1]))).collect()
}

/// For each knot, the segment that arrives and the next one of any length that leaves.
fn neighbours(curve: &Curve) -> Vec<Option<(&Segment, &Segment)>> {
    let segments = curve.segments();
    let n = segments.len();
    let knots = if curve.is_closed() || n == 0 { n } else { n + 1 };
    let pair = |knot: usize| {
        if !curve.is_closed() && (knot == 0 || knot == n) {
            return None;
        }
        let before = &segments[(knot + n - 1) % n];
        let after = (0..n)
            .map(|step| knot + step)
            .take_while(|i| curve.is_closed() || *i < n)
            .map(|i| &segments[i % n])
            .find(|segment| segment.length() > 0.0)?;
        (before.length() > 0.0).then_some((before, after))
    };
    (0..knots).map(pair).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::catalog::ENTRIES;
    use crate::{Contour, Join, Knot, catalog, solve};

    fn solved(contour: &Contour, spline: &str) -> Curve {
        solve(contour, &*catalog::spline(spline).unwrap()).unwrap().curve
    }

    #[test]
    fn a_spiral_has_its_closed_forms() {
        // θ0 = −0.4, θ1 = 0.4 inflects in the middle; κ = k₁ s for arc length 1.
        let contour = Contour::open([
            Knot::new((0.0, 0.0)).tangent_out((0.4f64.cos(), 0.4f64.sin())),
            Knot::new((2.0, 0.0)).tangent_in((0.4f64.cos(), 0.4f64.sin())),
        ]);
        let curve = solved(&contour, "euler");
        let k1 = curve.segments()[0].kappa().unwrap()[1];
        let (length, fairness) = (curve.length(), Fairness::of(&curve));
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b.abs(), "{a} {b}");
        close(fairness.bending_energy, k1 * k1 / 12.0 / length);
        close(fairness.scale_free_energy(), k1 * k1 / 12.0);
        close(fairness.variation_energy, k1 * k1 / length.powi(3));
        close(fairness.largest_curvature, k1.abs() / 2.0 / length);
        close(fairness.largest_variation, k1.abs() / length / length);
        close(fairness.turning, k1.abs() / 4.0);
        assert_eq!((fairness.extrema, fairness.inflections), (0, 1));
    }

    #[test]
    fn turning_is_the_integral_of_abs_curvature() {
        let contour = Contour::open([(0.0, 0.0), (80.0, 60.0), (150.0, 0.0), (260.0, 30.0)]);
        for info in ENTRIES {
            let curve = solved(&contour, info.name);
            let mut sum = 0.0;
            let steps = 4000;
            for segment in curve.segments() {
                let step = segment.length() / f64::from(steps);
                let at = |i: i32| segment.curvature(step * (f64::from(i) + 0.5)).abs();
                sum += (0..steps).map(at).sum::<f64>() * step;
            }
            let turning = Fairness::of(&curve).turning;
            assert!((turning - sum).abs() < 1e-3 * (1.0 + sum), "{}: {turning} {sum}", info.name);
        }
    }

    #[test]
    fn corners_jump_by_their_angle_and_arcs_by_their_curvature() {
        let square = Contour::closed(
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
                .map(|p| Knot::new(p).join(Join::Corner)),
        );
        for jump in jumps(&solved(&square, "euler")).into_iter().flatten() {
            assert!((jump.direction - PI / 2.0).abs() < 1e-15);
            assert_eq!((jump.curvature, jump.size), (0.0, 1.0));
        }
        // A quarter of a circle of radius 1 runs into one of radius 2.
        let two = Contour::open([
            Knot::new((0.0, 0.0)).tangent_out((1.0, 0.0)),
            Knot::new((1.0, 1.0)).join(Join::G1).tangent((0.0, 1.0)),
            Knot::new((-1.0, 3.0)).tangent_in((-1.0, 0.0)),
        ]);
        let jumps = jumps(&solved(&two, "euler"));
        assert_eq!((jumps[0], jumps[2]), (None, None));
        let jump = jumps[1].unwrap();
        assert!((jump.curvature + 0.5).abs() < 1e-12 && jump.direction.abs() < 1e-12);
        let h = 2.0 / (1.0 / 2f64.sqrt() + 1.0 / 8f64.sqrt());
        assert!((jump.dimensionless()[1] + 0.5 * h).abs() < 1e-12);
    }

    #[test]
    fn everything_is_finite_whatever_the_knots() {
        let coincident = Contour::closed([(0.0, 0.0), (0.0, 0.0), (1.0, 0.0), (1.0, 0.0)]);
        let hairpin = Contour::open([(0.0, 0.0), (1e9, 1e-9), (0.0, 0.0), (1e9, 1.0)]);
        let one = Contour::open([(3.0, 4.0)]);
        for info in ENTRIES {
            for contour in [&coincident, &hairpin, &one] {
                let curve = solved(contour, info.name);
                let f = Fairness::of(&curve);
                let numbers = [
                    f.length,
                    f.bending_energy,
                    f.scale_free_energy(),
                    f.variation_energy,
                    f.largest_curvature,
                    f.largest_variation,
                    f.turning,
                ];
                assert!(numbers.into_iter().all(f64::is_finite), "{}: {f:?}", info.name);
                let jumps = jumps(&curve);
                for jump in jumps.into_iter().flatten() {
                    let numbers = jump.dimensionless();
                    assert!(numbers.into_iter().all(f64::is_finite), "{}: {jump:?}", info.name);
                }
            }
        }
    }
}
