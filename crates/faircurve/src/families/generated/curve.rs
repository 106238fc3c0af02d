//! Cuts of a generating curve that is only known as a function κ(s).

use std::cell::Cell;
use std::f64::consts::PI;
use std::fmt;
use std::sync::{Arc, LazyLock};

use num_complex::Complex64;

use super::formula::Formula;
use crate::families::euler::fit_euler;
use crate::families::log_aesthetic::LogAesthetic;
use crate::frame::ChordAngles;
use crate::numeric::order::sort_by;
use crate::numeric::quadrature::nodes_16;
use crate::numeric::roots::monotone_root;
use crate::numeric::spiro_integral::spiro_integral_between;
use crate::two_param::generating::{Cut, GeneratingCurve};

/// A generating curve given by a function κ(s) or a [`Formula`].
///
/// κ must be either odd, κ(−s) = −κ(s), finite at 0, or of one sign wherever it is a number; and
/// smooth, but for the inflection at 0. Whatever it is, curvature rises along a cut; a κ that falls
/// throughout is taken backwards. Cuts don't cross places where κ isn't a number.
///
/// Of each cut, the place of its middle and its length are found. Where curvature hardly changes
/// along a cut (end tangents equal to a part in 10⁸) it is an Euler spiral to rounding, and is
/// taken from there, since arcs may lie at infinity; if the curve tends to arcs at all. Which end tangents have cuts depends on κ: all,
/// where |κ| grows without bound or to a limit on both sides of an inflection; only convex ones,
/// without an inflection; only small ones, where κ oscillates.
#[derive(Clone)]
pub struct Generated {
    kappa: Arc<Kappa>,
}

/// Why a function can't generate segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotGenerating {
    /// It changes sign and isn't odd: its mirror image and reversal would be other curves.
    NeitherOddNorOfOneSign,
    /// It is constant, nowhere a number, or changes at other scales than s from 1e-8 to 1e16.
    Constant,
}

impl fmt::Display for NotGenerating {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NotGenerating::NeitherOddNorOfOneSign => "it changes sign and isn't odd",
            NotGenerating::Constant => "it hardly changes with `s` from 1e-8 to 1e16",
        })
    }
}

impl std::error::Error for NotGenerating {}

/// The function, turned so that curvature rises, and what was found out about it.
struct Kappa {
    source: Source,
    /// Signs of curvature and of arc length.
    flips: [f64; 2],
    is_odd: bool,
    /// Near an inflection, κ ≈ `slope`·s^`order`.
    order: f64,
    slope: f64,
    /// The stretch along which curvature rises: what is cut from.
    stretch: [f64; 2],
    /// Whether it tends to circles, κ′/κ² → 0, where the stretch ends.
    has_arcs: bool,
    /// Middles, ascending, with κ′/κ² there, for first guesses.
    places: Vec<(f64, f64)>,
}

enum Source {
    Formula(Formula),
    Function(Box<dyn Fn(f64) -> f64 + Send + Sync>),
}

impl fmt::Debug for Generated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let source = match &self.kappa.source {
            Source::Formula(formula) => format!("{formula:?}"),
            Source::Function(_) => "a function".to_owned(),
        };
        f.debug_struct("Generated")
            .field("kappa", &source)
            .field("is_odd", &self.kappa.is_odd)
            .field("order", &self.kappa.order)
            .finish()
    }
}

impl Source {
    fn value(&self, s: f64) -> f64 {
        match self {
            Source::Formula(formula) => formula.value(s),
            Source::Function(function) => function(s),
        }
    }

    /// Derivatives of a function are differences: to about 1e-12, 1e-10 and 1e-8 of its size over
    /// powers of the distance from 0 (at most 1).
    fn jet(&self, s: f64) -> [f64; 4] {
        match self {
            Source::Formula(formula) => formula.jet(s),
            Source::Function(function) => {
                // Central differences of eighth order, within what a singularity at 0 allows.
                let h = (s.abs() / 8.0).clamp(1e-6, 0.03);
                let at = |i: f64| function(s + i * h);
                let pair = |i: f64, sign: f64| at(i) + sign * at(-i);
                let odd: [f64; 4] = [1.0, 2.0, 3.0, 4.0].map(|i| pair(i, -1.0));
                let even: [f64; 4] = [1.0, 2.0, 3.0, 4.0].map(|i| pair(i, 1.0));
                let sum = |weights: [f64; 4], values: [f64; 4]| -> f64 {
                    weights.iter().zip(values).map(|(w, v)| w * v).sum()
                };
                let here = function(s);
                [
                    here,
                    sum([4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0], odd) / h,
                    (sum([8.0 / 5.0, -1.0 / 5.0, 8.0 / 315.0, -1.0 / 560.0], even)
                        - here * 205.0 / 72.0)
                        / (h * h),
                    sum([-61.0 / 30.0, 169.0 / 120.0, -3.0 / 10.0, 7.0 / 240.0], odd) / (h * h * h),
                ]
            }
        }
    }
}

impl Kappa {
    fn value(&self, s: f64) -> f64 {
        self.flips[0] * self.source.value(self.flips[1] * s)
    }

    fn jet(&self, s: f64) -> [f64; 4] {
        let [curvature, turn] = self.flips;
        let [k0, k1, k2, k3] = self.source.jet(turn * s).map(|k| curvature * k);
        [k0, turn * k1, k2, turn * k3]
    }
}

impl Kappa {
    /// The stretch of samples along which curvature rises: the first from an inflection on, or the
    /// longest.
    fn find_stretch(&mut self, samples: &[(f64, f64)]) {
        let is_rising = |i: usize| samples[i + 1].1 >= samples[i].1;
        let (mut best, mut start) = (0..0, 0);
        for i in 0..samples.len() {
            let goes_on = i + 1 < samples.len() && is_rising(i) && samples[i + 1].1.is_finite();
            if !goes_on {
                let is_first = start == 0 && self.is_odd;
                if is_first || (!self.is_odd && i - start > best.len()) {
                    best = start..i;
                }
                start = i + 1;
            }
        }
        // Between two samples, where curvature turns.
        let turn = |inside: usize, outside: Option<usize>| {
            let inside = samples[inside].0;
            let outside = outside.and_then(|i| samples.get(i)).map(|(s, _)| *s);
            outside.and_then(|s| monotone_root(|s| self.jet(s)[1], inside, s)).unwrap_or(inside)
        };
        let falls_after = |i: usize| samples.get(i + 1).is_some_and(|(_, k)| *k < samples[i].1);
        let low = turn(best.start, best.start.checked_sub(1));
        let high = turn(best.end, Some(best.end + 1));
        self.stretch = if self.is_odd { [-high, high] } else { [low, high] };
        self.has_arcs = !falls_after(best.end);
    }

    /// How curvature leaves an inflection.
    fn find_order(&mut self) {
        let near = f64::exp2(-20.0);
        let [here, further] = [near, 2.0 * near].map(|s| self.value(s));
        let order = (further / here).log2();
        if order > 0.0 && order.is_finite() {
            let whole = order.round();
            self.order = if (order - whole).abs() < 1e-9 { whole } else { order };
            self.slope = here / near.powf(self.order);
        }
    }
}

impl Generated {
    /// The curve of a function.
    ///
    /// # Errors
    /// [`NotGenerating`], as far as samples tell.
    ///
    /// ```
    /// use faircurve::families::generated::Generated;
    /// assert!(Generated::new(|s| s + s.powi(3)).is_ok());
    /// assert!(Generated::new(|s| s + s * s).is_err());
    /// ```
    pub fn new(kappa: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Result<Self, NotGenerating> {
        Generated::from_source(Source::Function(Box::new(kappa)))
    }

    /// The curve of a formula.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn from_formula(formula: Formula) -> Result<Self, NotGenerating> {
        Generated::from_source(Source::Formula(formula))
    }

    fn from_source(source: Source) -> Result<Self, NotGenerating> {
        /// Like a part in so many: odd, as far as rounding tells.
        const ALIKE: f64 = 1e-12;
        // From 2⁻²⁶ to 2⁵³, where a step of 1 is the least that numbers have.
        let sizes: Vec<f64> = (-416..=848).map(|i| f64::exp2(f64::from(i) / 16.0)).collect();
        let right: Vec<(f64, f64)> = sizes.iter().map(|s| (*s, source.value(*s))).collect();
        let left: Vec<(f64, f64)> = sizes.iter().map(|s| (-*s, source.value(-*s))).collect();
        let middle = (0.0, source.value(0.0));
        let is_odd = middle.1 == 0.0
            && right.iter().zip(&left).all(|((_, right), (_, left))| {
                let is_like = (right + left).abs() <= ALIKE * right.abs();
                is_like || !(right.is_finite() && left.is_finite())
            });
        let before = left.into_iter().rev().filter(|_| !is_odd);
        let mut samples: Vec<(f64, f64)> = before.chain([middle]).chain(right).collect();
        let numbers: Vec<f64> = samples.iter().map(|(_, k)| *k).filter(|k| k.is_finite()).collect();
        let Some(sign) = numbers.iter().find(|k| **k != 0.0).map(|k| k.signum()) else {
            return Err(NotGenerating::Constant);
        };
        if numbers.iter().all(|k| *k == numbers[0]) {
            return Err(NotGenerating::Constant);
        }
        if !is_odd && numbers.iter().any(|k| k * sign < 0.0) {
            return Err(NotGenerating::NeitherOddNorOfOneSign);
        }
        // Backwards where curvature, made positive, falls more often than it rises.
        let changes: f64 = samples
            .windows(2)
            .map(|pair| (pair[1].1 - pair[0].1) * sign)
            .filter(|rise| *rise != 0.0 && !rise.is_nan())
            .map(f64::signum)
            .sum();
        let is_backwards = !is_odd && changes < 0.0;
        let flips = [sign, if is_backwards { -1.0 } else { 1.0 }];
        for (s, curvature) in &mut samples {
            *s *= flips[1];
            *curvature *= sign;
        }
        sort_by(&mut samples, |a, b| a.0.total_cmp(&b.0));
        let mut kappa = Kappa {
            source,
            flips,
            is_odd,
            order: 1.0,
            slope: 1.0,
            stretch: [0.0; 2],
            has_arcs: false,
            places: Vec::new(),
        };
        kappa.find_stretch(&samples);
        if is_odd {
            kappa.find_order();
        }
        /// Flatter places are arcs to rounding.
        const FLAT: f64 = 1e-12;
        for (s, _) in samples.into_iter().step_by(8) {
            let [curvature, slope, ..] = kappa.jet(s);
            let sharpness = slope / (curvature * curvature);
            let is_inside = s > kappa.stretch[0] && s < kappa.stretch[1];
            if is_inside && curvature > 0.0 && sharpness > FLAT && sharpness.is_finite() {
                kappa.places.push((s, sharpness));
            }
        }
        /// So flat that what follows may be taken for circles.
        const NEARLY_FLAT: f64 = 1e-6;
        kappa.has_arcs &= kappa.places.last().is_some_and(|(_, last)| *last < NEARLY_FLAT);
        if kappa.places.len() < 2 {
            return Err(NotGenerating::Constant);
        }
        Ok(Generated { kappa: Arc::new(kappa) })
    }

    /// The cut between two places of the curve, scaled to arc length 1. Where κ isn't a number on
    /// the way, neither is the cut.
    pub fn between(&self, from: f64, to: f64) -> GeneratedCut {
        let mut cut = GeneratedCut {
            shape: CutShape::Piece { kappa: self.clone(), from, to },
            panels: Vec::new(),
            turning: 0.0,
            chord: Complex64::ZERO,
        };
        cut.measure(&self.kappa, from, to);
        cut
    }
}

/// A cut of a [`Generated`] curve.
#[derive(Clone, Debug)]
pub struct GeneratedCut {
    shape: CutShape,
    panels: Vec<Panel>,
    turning: f64,
    chord: Complex64,
}

#[derive(Clone, Debug)]
enum CutShape {
    /// Nearly an arc: k₀ and k₁ of an Euler spiral.
    Spiral([f64; 2]),
    /// From one place of the curve to another.
    Piece { kappa: Generated, from: f64, to: f64 },
}

/// A stretch of the curve that sixteen nodes see well.
#[derive(Clone, Copy, Debug)]
struct Panel {
    s: f64,
    turning: f64,
    point: Complex64,
}

/// Sixteen nodes in [0, 1], ascending, with what integrates from 0 to each and what tells whether
/// they are enough.
struct Collocation {
    nodes: [f64; 16],
    weights: [f64; 16],
    /// ∫₀^node f ≈ Σ integral[node][j]·f(node j).
    integral: [[f64; 16]; 16],
    /// The two last Legendre coefficients.
    tail: [[f64; 16]; 2],
}

static COLLOCATION: LazyLock<Collocation> = LazyLock::new(|| {
    let mut rule: Vec<(f64, f64)> = nodes_16().collect();
    sort_by(&mut rule, |a, b| a.0.total_cmp(&b.0));
    let nodes: [f64; 16] = std::array::from_fn(|i| rule[i].0 + 0.5);
    let weights: [f64; 16] = std::array::from_fn(|i| rule[i].1);
    let legendre = |x: f64| {
        let mut p = [1.0; 18];
        p[1] = x;
        for n in 1..17 {
            let m = n as f64;
            p[n + 1] = ((2.0 * m + 1.0) * x * p[n] - m * p[n - 1]) / (m + 1.0);
        }
        p
    };
    let values: Vec<[f64; 18]> = rule.iter().map(|(x, _)| legendre(2.0 * x)).collect();
    // Coefficient n of f: (2n + 1) Σ wⱼ Pₙ(xⱼ) f(xⱼ), on an interval of length 1.
    let coefficient = |n: usize, j: usize| (2 * n + 1) as f64 * weights[j] * values[j][n];
    let integral = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let of_constant = coefficient(0, j) * nodes[i];
            // ∫ Pₙ = (Pₙ₊₁ − Pₙ₋₁)/(2n + 1), which is 0 at −1; halved on an interval of length 1.
            let rest: f64 = (1..16)
                .map(|n| {
                    let whole = values[i][n + 1] - values[i][n - 1];
                    coefficient(n, j) * whole / (2.0 * (2 * n + 1) as f64)
                })
                .sum();
            of_constant + rest
        })
    });
    let tail = [14, 15].map(|n| std::array::from_fn(|j| coefficient(n, j)));
    Collocation { nodes, weights, integral, tail }
});

/// Turning and displacement along a stretch, from direction 0, and how well they are known.
struct Stretch {
    turning: f64,
    along: Complex64,
    largest: f64,
    doubt: f64,
}

fn stretch(kappa: &Kappa, from: f64, to: f64) -> Stretch {
    let rule = &*COLLOCATION;
    let width = to - from;
    let values = rule.nodes.map(|node| kappa.value(from + node * width));
    let dot = |weights: &[f64; 16]| -> f64 {
        weights.iter().zip(values).map(|(w, v)| w * v).sum::<f64>() * width
    };
    let mut along = Complex64::ZERO;
    for (weight, row) in rule.weights.iter().zip(&rule.integral) {
        along += Complex64::from_polar(weight * width, dot(row));
    }
    Stretch {
        turning: dot(&rule.weights),
        along,
        largest: values.iter().fold(0.0, |most, v| v.abs().max(most)) * width,
        doubt: rule.tail.iter().map(|row| dot(row).abs()).sum(),
    }
}

impl GeneratedCut {
    fn spiral(angles: ChordAngles) -> Option<Self> {
        let spiral = fit_euler(angles).ok()?;
        let [k0, k1, ..] = spiral.k;
        let mut cut = GeneratedCut {
            shape: CutShape::Spiral([k0, k1]),
            panels: Vec::new(),
            turning: k0,
            chord: Complex64::ZERO,
        };
        cut.chord = cut.point(1.0);
        Some(cut)
    }

    /// Divides the piece into panels.
    fn measure(&mut self, kappa: &Kappa, from: f64, to: f64) {
        /// Radians that a panel may turn.
        const MOST_TURN: f64 = 2.0;
        /// Of the cut's turning, what the last coefficients seen may be; what isn't seen is less.
        const DOUBT: f64 = 1e-14;
        /// Halvings towards a singularity.
        const DEEPEST: usize = 30;
        /// For functions that no number of panels can resolve.
        const MOST_PANELS: usize = 40;
        let scale = stretch(kappa, from, to).largest;
        let mut waiting = if from < 0.0 && to > 0.0 {
            vec![(0.0, to, 0), (from, 0.0, 0)]
        } else {
            vec![(from, to, 0)]
        };
        while let Some((from, to, depth)) = waiting.pop() {
            let stretch = stretch(kappa, from, to);
            let is_good = stretch.doubt <= DOUBT * scale && stretch.largest <= MOST_TURN;
            if is_good || depth >= DEEPEST || self.panels.len() >= MOST_PANELS {
                self.panels.push(Panel { s: from, turning: self.turning, point: self.chord });
                self.chord += stretch.along * Complex64::from_polar(1.0, self.turning);
                self.turning += stretch.turning;
                continue;
            }
            let middle = from + (to - from) / 2.0;
            waiting.push((middle, to, depth + 1));
            waiting.push((from, middle, depth + 1));
        }
    }

    fn angles(&self) -> ChordAngles {
        let theta0 = self.chord.arg();
        ChordAngles { theta0, theta1: self.turning - theta0 }
    }

    /// The panel that `v` lies in, and the way from its start.
    fn panel(&self, v: f64) -> Option<(Panel, Stretch)> {
        let CutShape::Piece { kappa, from, to } = &self.shape else { return None };
        let s = from + (to - from) * v;
        let index = self.panels.partition_point(|panel| panel.s <= s).max(1) - 1;
        let panel = *self.panels.get(index)?;
        Some((panel, stretch(&kappa.kappa, panel.s, s)))
    }
}

impl Cut for GeneratedCut {
    fn curvature_jet(&self, v: f64) -> [f64; 4] {
        /// Larger derivatives are written as this.
        const LARGEST: f64 = 1e100;
        match &self.shape {
            CutShape::Spiral([k0, k1]) => [k0 + k1 * (v - 0.5), *k1, 0.0, 0.0],
            CutShape::Piece { kappa, from, to } => {
                let length = to - from;
                let mut jet = kappa.kappa.jet(from + length * v);
                let mut scale = 1.0;
                for value in &mut jet {
                    scale *= length;
                    *value *= scale;
                    *value = if value.is_nan() { 0.0 } else { value.clamp(-LARGEST, LARGEST) };
                }
                jet
            }
        }
    }

    fn curvature_bounds(&self, from: f64, to: f64) -> [f64; 3] {
        let [a, b] = [from, to].map(|v| self.curvature_jet(v)[0].abs());
        let derivatives = match self.shape {
            CutShape::Spiral([_, k1]) => [k1.abs(), 0.0],
            CutShape::Piece { .. } => [f64::MAX; 2],
        };
        [a.max(b), derivatives[0], derivatives[1]]
    }

    fn turning(&self, v: f64) -> f64 {
        if let CutShape::Spiral([k0, k1]) = self.shape {
            return v * (k0 + k1 * (v - 1.0) / 2.0);
        }
        self.panel(v).map_or(0.0, |(panel, rest)| panel.turning + rest.turning)
    }

    fn point(&self, v: f64) -> Complex64 {
        match &self.shape {
            CutShape::Spiral([k0, k1]) => {
                let start = k1 / 8.0 - k0 / 2.0;
                let along = spiro_integral_between([*k0, *k1, 0.0, 0.0], -0.5, v - 0.5);
                let along = Complex64::new(along.re, along.im);
                along * Complex64::from_polar(1.0, -start)
            }
            CutShape::Piece { from, to, .. } => {
                let length = to - from;
                if v == 1.0 {
                    return self.chord / length;
                }
                self.panel(v).map_or(Complex64::ZERO, |(panel, rest)| {
                    let along = rest.along * Complex64::from_polar(1.0, panel.turning);
                    (panel.point + along) / length
                })
            }
        }
    }

    fn inflection(&self) -> Option<f64> {
        match self.shape {
            CutShape::Piece { from, to, .. } => {
                (from < 0.0 && to > 0.0).then(|| -from / (to - from))
            }
            CutShape::Spiral(_) => None,
        }
    }
}

impl GeneratingCurve for Generated {
    type Cut = GeneratedCut;

    fn cut(&self, angles: ChordAngles) -> Option<GeneratedCut> {
        /// Differences of angles over their sum below which curvature is linear to rounding: the
        /// square of this is what is neglected.
        const NEARLY_AN_ARC: f64 = 1e-8;
        /// Smaller angles are none.
        const NO_ANGLE: f64 = 1e-100;
        let ChordAngles { theta0, theta1 } = angles;
        if !(theta1 >= theta0.abs() && theta1 < PI) {
            return None;
        }
        let is_arc = theta1 - theta0 <= NEARLY_AN_ARC * (theta0 + theta1);
        if (is_arc && self.kappa.has_arcs) || theta1 < NO_ANGLE {
            return GeneratedCut::spiral(angles);
        }
        if theta0 < 0.0 && !self.kappa.is_odd {
            return None;
        }
        let (middle, length) = self.guess(angles);
        self.refined(angles, middle, length).or_else(|| self.by_bisection(angles))
    }

    fn order(&self) -> f64 {
        self.kappa.order
    }
}

impl Generated {
    /// Middle and length of about the right cut.
    fn guess(&self, angles: ChordAngles) -> (f64, f64) {
        let turning = angles.turning();
        if self.kappa.is_odd {
            // Near the inflection the curve is log-aesthetic.
            let model = LogAesthetic::new(self.kappa.order);
            if let Some([from, to]) = model.cut(angles).and_then(|cut| cut.places()) {
                let unit = self.kappa.slope.powf(-1.0 / (self.kappa.order + 1.0));
                let (middle, length) = ((from + to) / 2.0 * unit, (to - from) * unit);
                if from < 0.3 * to {
                    return (middle, length);
                }
            }
        }
        // By the limit for small segments, κ′/κ² = 6(θ₁ − θ₀)/(θ₀ + θ₁)² (thesis 4.1).
        let wanted = 6.0 * (angles.theta1 - angles.theta0) / (turning * turning);
        let places = &self.kappa.places;
        let after = places.iter().position(|(_, sharpness)| *sharpness < wanted);
        let index = after.unwrap_or(places.len() - 1).max(1).min(places.len() - 1);
        let [(a, sharp_a), (b, sharp_b)] = [places[index - 1], places[index]];
        let part = ((wanted / sharp_a).ln() / (sharp_b / sharp_a).ln()).clamp(0.0, 1.0);
        let part = if part.is_nan() { 0.5 } else { part };
        let middle = if a > 0.0 { a * (b / a).powf(part) } else { a + part * (b - a) };
        (middle, turning / self.kappa.value(middle))
    }

    /// Newton's method for the places of both ends.
    fn refined(&self, angles: ChordAngles, middle: f64, length: f64) -> Option<GeneratedCut> {
        const MOST_STEPS: usize = 25;
        /// What is left is rounding.
        const ENOUGH: f64 = 1e-12;
        let (mut middle, mut length) = (middle, length);
        let mut best: Option<(f64, GeneratedCut)> = None;
        for _ in 0..MOST_STEPS {
            let (from, to) = (middle - length / 2.0, middle + length / 2.0);
            let cut = self.between(from, to);
            let found = cut.angles();
            let (off0, off1) = (found.theta0 - angles.theta0, found.theta1 - angles.theta1);
            let error = off0.abs().max(off1.abs()) / angles.theta1;
            if error.is_nan() {
                break;
            }
            let chord = cut.chord.norm();
            let is_better = best.as_ref().is_none_or(|(least, _)| error < *least);
            if is_better {
                best = Some((error, cut));
            }
            if error <= f64::EPSILON || (error < ENOUGH && !is_better) {
                break;
            }
            // As in two_param::generating, in units of the curve.
            let [k0, k1] = [from, to].map(|s| self.kappa.value(s));
            let [sin0, sin1] = [found.theta0, found.theta1].map(|angle| angle.sin() / chord);
            let by_from = [sin0 - k0, -sin0];
            let by_to = [sin1, k1 - sin1];
            let by_middle = [by_from[0] + by_to[0], by_from[1] + by_to[1]];
            let by_length = [(by_to[0] - by_from[0]) / 2.0, (by_to[1] - by_from[1]) / 2.0];
            let determinant = by_middle[0] * by_length[1] - by_middle[1] * by_length[0];
            let step_middle = -(off0 * by_length[1] - off1 * by_length[0]) / determinant;
            let step_length = -(off1 * by_middle[0] - off0 * by_middle[1]) / determinant;
            if !(step_middle.is_finite() && step_length.is_finite()) {
                break;
            }
            let most = 0.5 * (middle.abs() + length);
            middle += step_middle.clamp(-most, most);
            if self.kappa.is_odd {
                middle = middle.max(0.0);
            }
            length = (length + step_length).clamp(0.5 * length, 2.0 * length);
            let [low, high] = self.kappa.stretch;
            if !(middle > low && middle < high) {
                break;
            }
            length = length.min(2.0 * (high - middle).min(middle - low));
        }
        best.filter(|(error, _)| *error < ENOUGH).map(|(_, cut)| cut)
    }

    /// The same slowly: for every middle the shortest length that gives `theta1`, and the middle for
    /// which `theta0` is right too.
    fn by_bisection(&self, angles: ChordAngles) -> Option<GeneratedCut> {
        /// Cuts measured at most; where there is one, about 100 are enough.
        const MOST_CUTS: usize = 400;
        let [least, most] = self.kappa.stretch;
        let left = Cell::new(MOST_CUTS);
        let angles_of = |middle: f64, length: f64| {
            if left.get() == 0 {
                return ChordAngles::new(f64::NAN, f64::NAN);
            }
            left.set(left.get() - 1);
            self.between(middle - length / 2.0, middle + length / 2.0).angles()
        };
        let length = |middle: f64| {
            let off = |length: f64| angles_of(middle, length).theta1 - angles.theta1;
            let longest = 2.0 * (most - middle).min(middle - least);
            // Short enough to begin with, where curvature is small in the middle.
            let start = 0.5 * angles.theta1 / self.kappa.value(middle);
            let (mut low, mut high) = (0.0, start.min(0.1 * (1.0 + middle.abs())).min(longest));
            while high > low {
                let value = off(high);
                if value >= 0.0 {
                    return monotone_root(off, low, high);
                } else if value.is_nan() {
                    return None;
                }
                (low, high) = (high, (1.4 * high).min(longest));
            }
            None
        };
        let off = |middle: f64| match length(middle) {
            Some(length) => angles_of(middle, length).theta0 - angles.theta0,
            None => f64::NAN,
        };
        let inflection = self.kappa.is_odd.then_some(0.0);
        let places = self.kappa.places.iter().map(|(s, _)| *s);
        let middles: Vec<f64> = inflection.into_iter().chain(places).collect();
        if !(off(middles[0]) <= 0.0) {
            return None;
        }
        let (mut low, mut high) = (0, middles.len());
        let mut is_bracket = false;
        while high - low > 1 {
            let between = (low + high) / 2;
            let value = off(middles[between]);
            if value < 0.0 {
                low = between;
            } else {
                high = between;
                is_bracket = value >= 0.0;
            }
        }
        if !is_bracket {
            return None;
        }
        // Newton's method may do the rest from either side.
        let refined = [low, high].into_iter().find_map(|i| {
            length(middles[i]).and_then(|length| self.refined(angles, middles[i], length))
        });
        refined.or_else(|| {
            let middle = monotone_root(off, middles[low], middles[high])?;
            self.refined(angles, middle, length(middle)?)
        })
    }
}
