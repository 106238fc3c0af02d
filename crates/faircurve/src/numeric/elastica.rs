//! The elastica (thesis chapter 3): the curve κ″ + ½κ³ + Cκ = 0, exactly.
//!
//! With b the force and θ the direction of travel from the line of action, κ′ = −b sin θ and
//! ½κ² + C = b cos θ, so that sin ½θ, cos ½θ and κ are Jacobi's sn, cn and dn (thesis 5.12) with
//! squared rates p = 2(b − C), the square of the largest curvature, and w = 4b. They appear here only
//! in addition theorems, about the state (κ, κ′, C) of some place: no phase on the curve is ever
//! needed, which near a circle means nothing and near a straight line is infinite. All formulas are
//! smooth from the circle through the solitary wave to the sine wave and the straight line.

use std::f64::consts::{FRAC_PI_2, PI};

use num_complex::Complex64;

use super::dual::Real;
use super::elliptic::{Elliptic, complete_k};
use super::trig::{argument, unit_vector};

/// An elastica, by its curvature κ and its slope κ′ at a place of reference, s = 0, and the constant
/// C of κ″ + ½κ³ + Cκ = 0 (thesis eq. 3.10).
///
/// C is the thrust where κ = 0, in units of the bending stiffness: positive where the strip is
/// compressed, negative where it is pulled. It is 0 for the rectangular elastica, and −κ²/2 on a circle. Every elastica is one of the family by
/// [`lambda`](Self::lambda), scaled and turned.
///
/// ```
/// use faircurve::numeric::elastica::Elastica;
/// // The rectangular elastica turns a quarter between a vertex and the inflection beside it.
/// let rectangular = Elastica::with_lambda(0.5);
/// let inflection = rectangular.at(rectangular.quarter_period());
/// assert!((inflection.direction - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
/// assert!(inflection.curvature.abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastica {
    curvature: f64,
    slope: f64,
    constant: f64,
}

/// A place on an elastica, in the frame in which the place of reference is the origin and its
/// direction that of +x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticaPoint {
    /// The point.
    pub point: Complex64,
    /// Direction of travel in radians, not wrapped.
    pub direction: f64,
    /// Curvature κ.
    pub curvature: f64,
    /// κ′ by arc length: the shearing force.
    pub slope: f64,
}

/// An arc of length 1 around a place, seen from the direction there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitArc<T> {
    /// The chord.
    pub(crate) x: T,
    pub(crate) y: T,
    /// Half of what it turns, up to whole turns.
    pub(crate) half_turn: T,
    /// How far the mean of its end directions is from the direction in the middle.
    pub(crate) lean: T,
    /// Curvature at the start and at the end.
    pub(crate) ends: [T; 2],
}

impl Elastica {
    /// The elastica with this curvature and its derivative at s = 0, and this constant C.
    pub fn new(curvature: f64, slope: f64, constant: f64) -> Self {
        Elastica { curvature, slope, constant }
    }

    fn terms(&self) -> Terms<f64> {
        Terms::new(self.curvature, self.slope, self.constant)
    }

    /// The thesis's family (eq. 3.12): θ″ + λ sin θ = 0 with a vertex of curvature 1 at s = 0.
    ///
    /// λ = 0 is the circle, below ¼ there are no inflections, ½ is the rectangular elastica, and as λ
    /// grows the curve becomes a sine wave of slope 1/√λ.
    pub fn with_lambda(lambda: f64) -> Self {
        Elastica::new(1.0, 0.0, lambda - 0.5)
    }

    /// The λ of the family's member that this elastica is similar to: the force over the square of
    /// the largest curvature. Infinite for a straight line under compression, 0 for one without force.
    pub fn lambda(&self) -> f64 {
        let Terms { b, p, .. } = self.terms();
        if b == 0.0 { 0.0 } else { b / p }
    }

    /// Curvature at s = 0.
    pub fn curvature(&self) -> f64 {
        self.curvature
    }

    /// κ′ at s = 0.
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// The constant C.
    pub fn constant(&self) -> f64 {
        self.constant
    }

    /// The largest curvature anywhere on it, at its vertices.
    pub fn largest_curvature(&self) -> f64 {
        self.terms().p.sqrt()
    }

    /// The force that what lies beyond any place exerts there, in the frame of s = 0 and in units of the
    /// bending stiffness: the same everywhere (thesis 3.4, 3.6). Its parts are the tension −(½κ² + C)
    /// along the curve and −κ′ to its left.
    pub fn force(&self) -> Complex64 {
        -self.axis()
    }

    /// The direction from which θ is measured, as long as the force.
    fn axis(&self) -> Complex64 {
        Complex64::new(self.terms().thrust, self.slope)
    }

    /// The thrust ½κ² + C at arc length `s`, positive where the strip is compressed. (It is T of thesis
    /// eq. 3.23, which has the sign of thrust, not of tension.)
    pub fn thrust(&self, s: f64) -> f64 {
        let curvature = self.at(s).curvature;
        0.5 * curvature * curvature + self.constant
    }

    /// A point of the line of action and its direction, in the frame of s = 0: the line along the
    /// force, against it, on which curvature would be zero, from which it grows with distance (eq. 3.13). `None`
    /// for circles and straight lines without force.
    pub fn line_of_action(&self) -> Option<(Complex64, f64)> {
        let Terms { k, b, .. } = self.terms();
        let along = self.axis() / b;
        let foot = Complex64::i() * along * (k / b);
        foot.is_finite().then(|| (foot, argument(along)))
    }

    /// Arc length from a vertex to the inflection beside it, or where there are none to the place
    /// of least curvature; infinite for the solitary wave, λ = ¼, and for straight lines.
    pub fn quarter_period(&self) -> f64 {
        let Terms { p, w, excess, .. } = self.terms();
        // K(m) with m = w/p below 1, or p/w.
        2.0 * complete_k((excess.abs() / p.max(w)).sqrt()) / p.max(w).sqrt()
    }

    /// The place at arc length `s`, in constant time; accurate to about 1e-15·(1 + |s|·largest
    /// curvature), times |s| for the point.
    pub fn at(&self, s: f64) -> ElasticaPoint {
        let terms = self.terms();
        // Half of the way, where the arc's own middle is, and the arc from there.
        let half = terms.half_arc(s);
        let middle = terms.moved(&half);
        let to_middle = terms.end_direction(&half, s);
        let direction = to_middle + middle.end_direction(&half, s);
        let (x, y) = middle.chord(&half);
        let end = middle.moved(&half);
        ElasticaPoint {
            point: Complex64::new(x, y) * unit_vector(to_middle),
            direction,
            curvature: end.k,
            slope: end.k1,
        }
    }

    /// The same elastica with its place of reference at arc length `s`.
    pub fn moved(&self, s: f64) -> Elastica {
        let terms = self.terms();
        let half = terms.half_arc(s);
        let end = terms.moved(&half).moved(&half);
        Elastica::new(end.k, end.k1, self.constant)
    }

    /// The elastica `factor` times as small: curvatures are so many times as large.
    pub fn scaled(&self, factor: f64) -> Elastica {
        let square = factor * factor;
        Elastica::new(self.curvature * factor, self.slope * square, self.constant * square)
    }

    /// The same curve travelled the other way.
    pub fn reversed(&self) -> Elastica {
        Elastica { curvature: -self.curvature, ..*self }
    }

    /// The mirror image.
    pub fn mirrored(&self) -> Elastica {
        Elastica { curvature: -self.curvature, slope: -self.slope, ..*self }
    }

    /// Curvature at arc length `s` and its first three derivatives.
    pub fn curvature_jet(&self, s: f64) -> [f64; 4] {
        let ElasticaPoint { curvature: k, slope: k1, .. } = self.at(s);
        let constant = self.constant;
        // κ″ = −(½κ² + C)κ, and its derivative.
        [k, k1, -(0.5 * k * k + constant) * k, -(1.5 * k * k + constant) * k1]
    }

    /// ∫ κ² ds over the arc from −½ to ½: twice the thrust along it less C (thesis eq. 3.23).
    pub fn arc_energy(&self) -> f64 {
        let (chord, _) = self.centred_arc(1.0);
        2.0 * ((self.axis().conj() * chord).re - self.constant)
    }

    /// The arc from −s/2 to s/2: its chord, seen from the direction in the middle, and the directions
    /// at both ends.
    pub(crate) fn centred_arc(&self, s: f64) -> (Complex64, [f64; 2]) {
        let (x, y, half_turn, lean) = self.terms().centred_arc(s);
        (Complex64::new(x, y), [lean - half_turn, lean + half_turn])
    }

    /// The arc from −½ to ½ of the elastica with this (κ, κ′, C), for numbers of any kind.
    pub(crate) fn unit_arc<T: Real>([curvature, slope, constant]: [T; 3]) -> UnitArc<T> {
        Terms::new(curvature, slope, constant).unit_arc()
    }
}

/// The state of a place, with what is the same everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Terms<T> {
    /// κ.
    k: T,
    /// κ′ = −b sin θ.
    k1: T,
    /// C.
    constant: T,
    /// ½κ² + C = b cos θ.
    thrust: T,
    /// The force.
    b: T,
    /// b + thrust and b − thrust, without cancellation.
    plus: T,
    minus: T,
    /// 2(b − C), the square of the largest curvature.
    p: T,
    /// 4b.
    w: T,
    /// w − p = 2(b + C).
    excess: T,
}

impl<T: Real> Terms<T> {
    fn new(k: T, k1: T, constant: T) -> Self {
        let square = k * k;
        let thrust = square * 0.5 + constant;
        let b = (thrust * thrust + k1 * k1).sqrt();
        // b² − C², which is (b − C)(b + C).
        let q = k1 * k1 + square * (square * 0.25 + constant);
        let over = |top: T, bottom: T| top / (bottom + f64::MIN_POSITIVE);
        let (pulled, pressed) = (thrust.value() < 0.0, constant.value() > 0.0);
        let slopes = k1 * k1;
        Terms {
            k,
            k1,
            constant,
            thrust,
            b,
            plus: if pulled { over(slopes, b - thrust) } else { b + thrust },
            minus: if pulled { b - thrust } else { over(slopes, b + thrust) },
            p: if pressed { over(q, b + constant) * 2.0 } else { (b - constant) * 2.0 },
            w: b * 4.0,
            excess: if pressed { (b + constant) * 2.0 } else { over(q, b - constant) * 2.0 },
        }
    }

    /// The elliptic functions of half of an arc of length `s`: what turns its start into its middle,
    /// and its middle into both ends.
    fn half_arc(&self, s: T) -> Elliptic<T> {
        Elliptic::new(self.p, self.w, self.excess, s * 0.25)
    }

    /// 1 − M sn² sn² of the place and of half of an arc.
    fn denominator(&self, e: &Elliptic<T>) -> T {
        e.c * e.c + self.k * self.k * e.n * e.n + f64::MIN_POSITIVE
    }

    /// The state half of the arc further on.
    fn moved(&self, e: &Elliptic<T>) -> Self {
        let inverse = T::from(1.0) / self.denominator(e);
        let kn = self.k * e.n;
        let k = (self.k * e.d + self.k1 * e.n * e.c * 2.0) * inverse;
        let across = self.k1 * e.d * (e.c * e.c - kn * kn);
        let along = kn * e.c * (self.plus - self.minus * e.d * e.d);
        // Through the invariants, which keep it on the curve.
        Terms::new(k, (across - along) * inverse * inverse, self.constant)
    }

    /// The chord of an arc around the place.
    fn chord(&self, e: &Elliptic<T>) -> (T, T) {
        let over = e.n * e.c / self.denominator(e);
        let hh = e.h * e.h;
        // 1 + 8(b − T)·T·h², T the thrust; where the curve is pulled straight, all of it but (1 − d)² cancels.
        let along = if self.thrust.value() < 0.0 {
            e.d * (-e.d + 2.0) + self.plus * hh * (self.b * 3.0 - self.plus) * 8.0
        } else {
            self.minus * self.thrust * hh * 8.0 + 1.0
        };
        let x = (over * along + self.thrust * e.j * 4.0) * 4.0;
        let y = self.k1 * (e.j + self.minus * over * hh * 2.0) * 16.0;
        (x, y)
    }

    /// Half of what an arc around the place turns.
    fn half_turn(&self, e: &Elliptic<T>) -> T {
        (self.k * e.n).atan2(e.c) * 2.0
    }

    /// How far the mean of the arc's end directions is from that of the place.
    fn lean(&self, e: &Elliptic<T>) -> T {
        let along = if self.thrust.value() < 0.0 {
            e.d + self.plus * e.h * 2.0
        } else {
            -self.minus * e.h * 2.0 + 1.0
        };
        (self.k1 * e.h * 2.0).atan2(along) * 2.0
    }

    fn unit_arc(&self) -> UnitArc<T> {
        let e = self.half_arc(T::from(1.0));
        let (x, y) = self.chord(&e);
        let inverse = T::from(1.0) / self.denominator(&e);
        let (same, other) = (self.k * e.d, self.k1 * e.n * e.c * 2.0);
        let ends = [(same - other) * inverse, (same + other) * inverse];
        UnitArc { x, y, half_turn: self.half_turn(&e), lean: self.lean(&e), ends }
    }
}

impl Terms<f64> {
    fn centred_arc(&self, s: f64) -> (f64, f64, f64, f64) {
        let half = self.half_arc(s);
        let (x, y) = self.chord(&half);
        (x, y, self.unwrapped_half_turn(&half, s), self.lean(&half))
    }

    /// The direction at the end of an arc of length `s` around the place, from the place's own.
    fn end_direction(&self, e: &Elliptic<f64>, s: f64) -> f64 {
        self.unwrapped_half_turn(e, s) + self.lean(e)
    }

    /// With whole turns, which only curves without inflections have: the curve turns as on
    /// average, but for less than half a turn.
    fn unwrapped_half_turn(&self, e: &Elliptic<f64>, s: f64) -> f64 {
        let wrapped = self.half_turn(e);
        let rate = self.p.sqrt() / 4.0;
        if self.excess >= 0.0 || rate * s.abs() < FRAC_PI_2 {
            return wrapped;
        }
        let mean = PI * rate * s / complete_k((-self.excess / self.p).sqrt());
        let mean = if self.k < 0.0 { -mean } else { mean };
        let turns = ((mean - wrapped) / (4.0 * PI)).round();
        if turns.is_finite() { wrapped + 4.0 * PI * turns } else { wrapped }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::elastica_series::{ElasticaState, stretches};

    /// The end of an arc by the ODE's power series, in the frame of s = 0.
    fn by_series(elastica: &Elastica, s: f64) -> ElasticaState {
        let axis = elastica.axis();
        let (b, turn) = (axis.norm(), argument(axis));
        // κ′ = −b sin θ with θ = −turn + direction, and −sin θ = cos(θ + π/2).
        let start = ElasticaState {
            point: Complex64::ZERO,
            angle: -turn + FRAC_PI_2,
            curvature: elastica.curvature(),
        };
        let all = stretches(b, start, s).unwrap();
        let last = all.last().unwrap();
        let end = last.end(b);
        ElasticaState {
            point: end.point * Complex64::cis(-start.angle),
            angle: end.angle - start.angle,
            curvature: end.curvature,
        }
    }

    #[test]
    fn every_elastica_agrees_with_the_series_of_its_equation() {
        for k in [0.0, 1e-9, 0.3, -1.0, 4.0] {
            for k1 in [0.0, 1e-12, -1e-4, 0.5, -3.0, 20.0] {
                for constant in [0.0, -0.5 * k * k, 1e-9, -0.05, 0.4, -4.0, 9.0, -30.0] {
                    let elastica = Elastica::new(k, k1, constant);
                    for s in [1e-3, 0.4, 1.0, 3.0] {
                        let (ours, theirs) = (elastica.at(s), by_series(&elastica, s));
                        // Away from a straight line under compression or tension, which is an
                        // equilibrium that rounding leaves exponentially.
                        let growth = s * (-constant).max(0.0).sqrt();
                        let turns =
                            s * (elastica.largest_curvature() + elastica.force().norm().sqrt());
                        let bound = 1e-14 * (1.0 + turns) * growth.exp();
                        let point = (ours.point - theirs.point).norm() / s;
                        let direction = (ours.direction - theirs.angle).abs();
                        let curvature = (ours.curvature - theirs.curvature).abs() * s;
                        let off = point.max(direction).max(curvature);
                        assert!(off < bound, "{k} {k1} {constant} {s}: {off:e} {bound:e}");
                    }
                }
            }
        }
    }

    /// Through the split between curves with inflections and without, a thousand units in the last
    /// place from one to the next.
    #[test]
    fn nothing_happens_at_the_split() {
        for s in [0.5, 3.0, 10.0, 20.0] {
            let at = |i: i32| Elastica::with_lambda(0.25 * (1.0 + f64::from(i) * 1e-13)).at(s);
            // The solitary wave: κ = sech(s/2).
            let (split, wave) = (at(0), 1.0 / (s / 2.0).cosh());
            assert!((split.curvature - wave).abs() < 1e-15);
            assert!((split.direction - 4.0 * (s / 4.0).tanh().atan()).abs() < 1e-14);
            for i in -3..=3 {
                // How a change of λ grows along the tail.
                let grown = 1e-13 * (s / 2.0).exp();
                assert!((at(i).curvature - split.curvature).abs() < grown, "{s} {i}");
                assert!((at(i).point - split.point).norm() < 4.0 * s * grown, "{s} {i}");
            }
        }
    }

    #[test]
    fn the_limits_are_the_circle_and_the_sine_wave() {
        for i in -40..=40 {
            let s = f64::from(i) * 0.7;
            let circle = Elastica::with_lambda(0.0).at(s);
            let exact = Complex64::new(s.sin(), 1.0 - s.cos());
            assert!((circle.point - exact).norm() < 1e-14 * (1.0 + s.abs()), "{s}");
            assert!((circle.direction - s).abs() < 1e-14 * (1.0 + s.abs()), "{s}");
            assert!((circle.curvature - 1.0).abs() < 1e-15);
            // κ = cos √λs to about 1/λ.
            let lambda: f64 = 1e14;
            let root = lambda.sqrt();
            let wave = Elastica::with_lambda(lambda).at(s / root);
            assert!((wave.curvature - s.cos()).abs() < 1e-13 * (1.0 + s.abs()), "{s}");
            assert!((wave.direction * root - s.sin()).abs() < 1e-13 * (1.0 + s.abs()), "{s}");
            let height = wave.point.im * lambda;
            assert!((height - (1.0 - s.cos())).abs() < 1e-13 * (1.0 + s.abs()), "{s} {height}");
        }
    }

    #[test]
    fn windings_are_counted() {
        for lambda in [0.0, 0.1, 0.2, 0.249, 0.26, 0.5] {
            for curvature in [1.0, -1.0] {
                let start = Elastica::with_lambda(lambda);
                let elastica = if curvature < 0.0 { start.mirrored() } else { start };
                let mut before = 0.0;
                for i in 1..=4000 {
                    let here = elastica.at(f64::from(i) * 0.05).direction;
                    assert!((here - before).abs() < 0.0501, "{lambda} {i} {before} {here}");
                    before = here;
                }
                if lambda < 0.25 {
                    let period = 2.0 * elastica.quarter_period();
                    let turns = elastica.at(5.0 * period).direction / (2.0 * PI);
                    assert!((turns - 5.0 * curvature).abs() < 1e-12, "{lambda} {turns}");
                }
            }
        }
    }

    #[test]
    fn force_and_line_of_action_are_the_same_everywhere() {
        let elastica = Elastica::new(0.7, -1.2, 0.3);
        let (foot, along) = elastica.line_of_action().unwrap();
        for i in -20..=20 {
            let s = f64::from(i) * 0.3;
            let (here, moved) = (elastica.at(s), elastica.moved(s));
            let turned = moved.force() * Complex64::cis(here.direction);
            assert!((turned - elastica.force()).norm() < 1e-13);
            assert!((moved.lambda() - elastica.lambda()).abs() < 1e-13);
            // κ = b × (distance from the line), to its right.
            let distance = -((here.point - foot) * Complex64::cis(-along)).im;
            let expected = elastica.force().norm() * distance;
            assert!((here.curvature - expected).abs() < 1e-13, "{s} {}", here.curvature - expected);
            assert!((elastica.thrust(s) + moved.force().re).abs() < 1e-13);
        }
        assert!(Elastica::new(2.0, 0.0, -2.0).line_of_action().is_none());
    }

    #[test]
    fn scaled_mirrored_and_reversed_are_what_they_say() {
        let elastica = Elastica::new(0.7, -1.2, 0.3);
        for i in -10..=10 {
            let s = f64::from(i) * 0.4;
            let here = elastica.at(s);
            let small = elastica.scaled(3.0).at(s / 3.0);
            assert!((small.point * 3.0 - here.point).norm() < 1e-14 * 8.0);
            assert!((elastica.mirrored().at(s).point - here.point.conj()).norm() < 1e-14);
            assert!((elastica.reversed().at(-s).point + here.point).norm() < 1e-14);
        }
        let jet = elastica.curvature_jet(0.4);
        let (low, high) = (elastica.curvature_jet(0.4 - 1e-5), elastica.curvature_jet(0.4 + 1e-5));
        for order in 0..3 {
            assert!(((high[order] - low[order]) / 2e-5 - jet[order + 1]).abs() < 1e-8);
        }
    }

    #[test]
    fn arcs_answer_changes_as_their_differences_do() {
        use crate::numeric::dual::Dual;
        fn arc<T: Real>(state: [T; 3]) -> [T; 6] {
            let UnitArc { x, y, half_turn, lean, ends: [start, end] } = Elastica::unit_arc(state);
            [x, y, half_turn, lean, start, end]
        }
        let places: [[f64; 3]; 8] = [
            [1.0, 2.0, 0.3],
            [2.0, 0.0, -2.0],
            [2.0, 1e-9, -2.0],
            [0.0, 0.0, 0.0],
            [1e-7, -1e-8, 0.0],
            [0.5, 3.0, -9.0],
            [-3.0, 12.0, 20.0],
            [1.0, 0.0, -0.25],
        ];
        for place in places {
            let dual = std::array::from_fn::<_, 3, _>(|i| Dual::<3>::variable(place[i], i));
            let exact = arc(dual);
            for i in 0..3 {
                let h = 1e-5;
                let mut sides = [place; 2];
                (sides[0][i], sides[1][i]) = (place[i] - h, place[i] + h);
                let [low, high] = sides.map(arc);
                for q in 0..6 {
                    let slope = (high[q] - low[q]) / (2.0 * h);
                    let off = (exact[q].by[i] - slope).abs();
                    assert!(off < 1e-8 * (1.0 + slope.abs()), "{place:?} {i} {q} {off:e}");
                }
            }
        }
    }

    #[test]
    fn whatever_goes_in_it_ends() {
        for k in [0.0, 1e-300, 1e300, f64::NAN, f64::INFINITY] {
            for k1 in [0.0, -1e-300, 1e200, f64::NAN] {
                for constant in [0.0, -1e300, 1e8, f64::INFINITY] {
                    for s in [0.0, 1e-300, 1.0, 1e300, f64::NAN] {
                        let _ = Elastica::new(k, k1, constant).at(s);
                    }
                }
            }
        }
    }
}
