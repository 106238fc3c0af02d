//! The curve κ = sign(s)·|s|^α and its cuts.

use std::f64::consts::PI;

use num_complex::Complex64;

use crate::frame::ChordAngles;
use crate::numeric::gauss_legendre::GAUSS_24;
use crate::numeric::quadrature::nodes_16;
use crate::numeric::roots::monotone_root;
use crate::two_param::generating::{Cut, GeneratingCurve};

/// κ = sign(s)·|s|^α (thesis section 4.8.1); the Euler spiral for α = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogAesthetic {
    alpha: f64,
}

impl LogAesthetic {
    /// The smallest α: below, the curve is nearly two circles.
    pub const LEAST: f64 = 0.1;
    /// The largest α: beyond, it is nearly a straight line that ends in curls.
    pub const MOST: f64 = 10.0;

    /// The curve for an exponent, brought within [`LEAST`](Self::LEAST) and [`MOST`](Self::MOST);
    /// 1 for NaN.
    pub fn new(alpha: f64) -> Self {
        let alpha = if alpha.is_nan() { 1.0 } else { alpha };
        LogAesthetic { alpha: alpha.clamp(Self::LEAST, Self::MOST) }
    }

    /// The exponent.
    pub fn alpha(&self) -> f64 {
        self.alpha
    }

    /// How much the ripple of a small push shrinks from knot to knot on straight, evenly spaced
    /// knots (thesis section 4.8.1): for small angles, κ₀θ₁ = −κ₁θ₀ on each segment.
    pub fn ripple(&self) -> f64 {
        // Where the small end lies at ξ = −r^(1/α), so that κ₀ = −r κ₁; and θ₀ = r θ₁.
        let off = |r: f64| {
            let (theta0, theta1) = linear_angles(self.alpha + 1.0, -r.powf(1.0 / self.alpha));
            theta0 - r * theta1
        };
        monotone_root(off, 1e-6, 0.999).unwrap_or(f64::NAN)
    }
}

/// A cut, by the ratio of its ends' places on the curve: κ(v) = K·sign(x)·|x|^α with
/// x = ξ + (1 − ξ)v. |ξ| ≤ 1, K ≥ 0: from ξ = −1 (antisymmetric) through 0 (it starts at the
/// inflection) to 1 (an arc); K = 0 is the line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogAestheticCut {
    alpha: f64,
    /// ξ.
    small_end: f64,
    /// 1 − ξ.
    drop: f64,
    /// K.
    curvature: f64,
    /// Whether it is so far from the inflection that integrals start from its own start.
    is_far: bool,
}

/// How the turnings from the inflection to the two ends of a far cut compare, at least. Closer to 1,
/// closed forms suffer from cancellation; closer to 0, quadrature from the singularity.
const FAR: f64 = 0.3;

impl GeneratingCurve for LogAesthetic {
    type Cut = LogAestheticCut;

    fn cut(&self, angles: ChordAngles) -> Option<LogAestheticCut> {
        let ChordAngles { theta0, theta1 } = angles;
        if !(theta1 >= theta0.abs() && theta1 < PI) {
            return None;
        }
        /// Smaller angles are none: their squares leave the range of numbers.
        const NO_ANGLE: f64 = 1e-150;
        if theta1 < NO_ANGLE {
            return Some(self.straight());
        }
        self.far_cut(angles).or_else(|| self.near_cut(angles))
    }

    fn order(&self) -> f64 {
        self.alpha
    }
}

impl LogAesthetic {
    fn straight(&self) -> LogAestheticCut {
        self.far(0.0, 0.0)
    }

    /// ξ beyond which cuts are far.
    fn far_end(&self) -> f64 {
        FAR.powf(1.0 / (self.alpha + 1.0))
    }

    fn far(&self, drop: f64, curvature: f64) -> LogAestheticCut {
        LogAestheticCut { alpha: self.alpha, small_end: 1.0 - drop, drop, curvature, is_far: true }
    }

    /// The far cut of that drop with that turning.
    fn far_of_turning(&self, drop: f64, turning: f64) -> LogAestheticCut {
        let unit = self.far(drop, 1.0);
        self.far(drop, turning / unit.turning(1.0))
    }

    /// The cut, if it is a far one: curvature follows from the turning, and one equation for the
    /// drop is left.
    fn far_cut(&self, angles: ChordAngles) -> Option<LogAestheticCut> {
        const MOST_STEPS: usize = 12;
        let turning = angles.turning();
        let wanted = angles.theta1 - angles.theta0;
        let most = 1.0 - self.far_end();
        if !(turning > 0.0) {
            return None;
        }
        // θ₁ − θ₀ = T − 2ψ.
        let difference =
            |drop: f64| turning - 2.0 * self.far_of_turning(drop, turning).point(1.0).arg();
        let off = |drop: f64| difference(drop) - wanted;
        let at_most = off(most);
        if at_most < 0.0 {
            return None;
        }
        if wanted == 0.0 {
            return Some(self.far(0.0, turning));
        }
        // The secant method: θ₁ − θ₀ is nearly proportional to the drop.
        let (mut last, mut off_last) = (most, at_most);
        let mut drop = most * wanted / (wanted + at_most);
        for _ in 0..MOST_STEPS {
            let off_here = off(drop);
            let step = -off_here * (drop - last) / (off_here - off_last);
            if off_here.abs() <= f64::EPSILON * turning || !step.is_finite() {
                return Some(self.far_of_turning(drop, turning));
            }
            (last, off_last) = (drop, off_here);
            drop = (drop + step).clamp(0.0, most);
        }
        monotone_root(off, 0.0, most).map(|drop| self.far_of_turning(drop, turning))
    }

    /// The cut, if it isn't far: two equations, for ξ and the turning from the inflection to the
    /// large end. Wide angles are approached through smaller ones, so that of several solutions the
    /// one is found that continues the straight line.
    fn near_cut(&self, angles: ChordAngles) -> Option<LogAestheticCut> {
        /// Angles up to this are found from the answer for small ones.
        const FIRST: f64 = 1.2;
        /// How far the next angles may be; less near π, where loops close.
        const STRIDE: f64 = 0.4;
        let ChordAngles { theta0, theta1 } = angles;
        let order = self.alpha + 1.0;
        // For small angles only their ratio decides.
        let ratio = theta0 / theta1;
        let off = |small_end: f64| {
            let (linear0, linear1) = linear_angles(order, small_end);
            linear0 - ratio * linear1
        };
        let small_end = rough_root(off, -1.0, self.far_end());
        let mut reached = theta1.min(FIRST);
        let mut state = [small_end, reached / linear_angles(order, small_end).1];
        while reached < theta1 {
            state = self.refined(ChordAngles::new(ratio * reached, reached), state, 4).1;
            let next = theta1.min(reached + STRIDE.min((PI - reached) / 2.0));
            state[1] *= next / reached;
            reached = next;
        }
        /// What is left is rounding.
        const ENOUGH: f64 = 1e-11;
        let (error, [small_end, turning]) = self.refined(angles, state, 30);
        if error < ENOUGH {
            return Some(Near::new(order, small_end, turning).cut());
        }
        self.near_cut_by_bisection(angles)
    }

    /// Newton's method for ξ and the turning: the best state of all, and its error relative to the
    /// larger angle.
    fn refined(&self, angles: ChordAngles, start: [f64; 2], most_steps: usize) -> (f64, [f64; 2]) {
        let ChordAngles { theta0, theta1 } = angles;
        let [mut small_end, mut turning] = start;
        let mut best = (f64::INFINITY, start);
        for _ in 0..most_steps {
            let near = Near::new(self.alpha + 1.0, small_end, turning);
            let (off0, off1) = (near.theta0 - theta0, near.theta1 - theta1);
            let error = off0.abs().max(off1.abs()) / theta1;
            let is_better = error < best.0;
            if is_better {
                best = (error, [small_end, turning]);
            }
            if error <= f64::EPSILON || (error < 1e-12 && !is_better) {
                break;
            }
            let [[a, b], [c, d]] = near.by;
            let determinant = a * d - b * c;
            let by_end = -(off0 * d - off1 * b) / determinant;
            let by_turning = -(off1 * a - off0 * c) / determinant;
            if !(by_end.is_finite() && by_turning.is_finite()) {
                break;
            }
            small_end = (small_end + by_end.clamp(-0.3, 0.3)).clamp(-1.0, self.far_end());
            turning = (turning + by_turning.clamp(-0.5, 0.5)).clamp(0.3 * turning, 3.0 * turning);
        }
        best
    }

    /// The same slowly, for whatever Newton's method can't do: for every ξ the turning that gives
    /// `theta1`, and the ξ for which `theta0` is right too.
    fn near_cut_by_bisection(&self, angles: ChordAngles) -> Option<LogAestheticCut> {
        let order = self.alpha + 1.0;
        let turning = |small_end: f64| {
            let mut high = angles.theta1;
            let off = |turning: f64| Near::new(order, small_end, turning).theta1 - angles.theta1;
            while off(high) < 0.0 && high < 100.0 {
                high *= 1.2;
            }
            monotone_root(off, 0.0, high)
        };
        let off = |small_end: f64| match turning(small_end) {
            Some(turning) => Near::new(order, small_end, turning).theta0 - angles.theta0,
            None => f64::NAN,
        };
        let small_end = monotone_root(off, -1.0, self.far_end())?;
        Some(Near::new(order, small_end, turning(small_end)?).cut())
    }
}

/// For small angles: both angles of a cut from ξ to 1, over the turning from the inflection to 1.
fn linear_angles(order: f64, small_end: f64) -> (f64, f64) {
    let from = small_end.abs().powf(order);
    let chord = (1.0 - small_end * from) / ((order + 1.0) * (1.0 - small_end));
    (chord - from, 1.0 - chord)
}

/// A zero to a thousandth or so, for a start; an end where there is none.
fn rough_root(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let (mut low, mut high) = (from, to);
    let (mut f_low, mut f_high) = (f(low), f(high));
    if f_low >= 0.0 {
        return low;
    } else if f_high <= 0.0 {
        return high;
    }
    for _ in 0..12 {
        let x = low - f_low * (high - low) / (f_high - f_low);
        let f_x = f(x);
        if f_x.abs() < 1e-3 * (f_high - f_low) || !(low < x && x < high) {
            return x;
        }
        // Halving the other end's value keeps regula falsi moving.
        if f_x < 0.0 {
            (low, f_low, f_high) = (x, f_x, f_high / 2.0);
        } else {
            (high, f_high, f_low) = (x, f_x, f_low / 2.0);
        }
    }
    (low + high) / 2.0
}

/// A cut of which the inflection isn't far, in the frame of the inflection's tangent: the large end
/// at x = 1, where θ = `turning`·|x|^order.
struct Near {
    order: f64,
    small_end: f64,
    turning: f64,
    theta0: f64,
    theta1: f64,
    /// Derivatives of (theta0, theta1) by ξ and by the turning.
    by: [[f64; 2]; 2],
}

impl Near {
    fn new(order: f64, small_end: f64, turning: f64) -> Near {
        let power = small_end.abs().powf(order);
        let from = turning * power;
        let chord = fraction(order, turning) - fraction(order, from) * small_end;
        let (at_start, at_end) =
            (Complex64::from_polar(1.0, from), Complex64::from_polar(1.0, turning));
        // From the start's tangent, since from the inflection's it may turn more than once.
        let theta0 = (chord * at_start.conj()).arg();
        let over = chord.inv();
        // A change of the turning is one of scale: both ends slide in proportion to x.
        let direction_by_turning = ((at_end - at_start * small_end) * over).im / (order * turning);
        let direction_by_end = -(at_start * over).im;
        let turning_by_end = if small_end == 0.0 { 0.0 } else { from * order / small_end };
        Near {
            order,
            small_end,
            turning,
            theta0,
            theta1: turning - from - theta0,
            by: [
                [direction_by_end - turning_by_end, direction_by_turning - power],
                [-direction_by_end, 1.0 - direction_by_turning],
            ],
        }
    }

    fn cut(&self) -> LogAestheticCut {
        let drop = 1.0 - self.small_end;
        LogAestheticCut {
            alpha: self.order - 1.0,
            small_end: self.small_end,
            drop,
            curvature: self.turning * self.order * drop,
            is_far: false,
        }
    }
}

/// ∫₀¹ exp(iφ yᵒ) dy with o the order: Σ (iφ)ⁿ/(n!(on + 1)), which is ₁F₁(1/o; 1 + 1/o; iφ); to
/// about 1e-15.
fn fraction(order: f64, phi: f64) -> Complex64 {
    /// Beyond, cancellation among the terms costs more than a digit.
    const SERIES: f64 = 5.0;
    /// What a panel of sixteen nodes may turn.
    const PANEL: f64 = 2.0;
    if phi <= SERIES {
        let (mut even, mut odd) = (0.0, 0.0);
        let mut power = 1.0;
        let mut n = 0.0;
        loop {
            even += power / (order * n + 1.0);
            power *= phi / (n + 1.0);
            odd += power / (order * (n + 1.0) + 1.0);
            power *= -phi / (n + 2.0);
            n += 2.0;
            if power.abs() < 1e-18 * n.min(2.0) {
                return Complex64::new(even, odd);
            }
        }
    }
    let panels = ((phi - SERIES) / PANEL).ceil().min(1000.0);
    let place = |i: f64| ((SERIES + (phi - SERIES) * i / panels) / phi).powf(1.0 / order);
    let mut y = place(0.0);
    let mut sum = fraction(order, SERIES) * y;
    let mut i = 0.0;
    while i < panels {
        i += 1.0;
        let next = if i == panels { 1.0 } else { place(i) };
        let (middle, width) = ((y + next) / 2.0, next - y);
        for (s, weight) in nodes_16() {
            let direction = phi * (middle + s * width).powf(order);
            sum += Complex64::from_polar(weight * width, direction);
        }
        y = next;
    }
    sum
}

impl LogAestheticCut {
    /// Where its ends lie on the curve κ = sign(s)·|s|^α; `None` for arcs and lines, which lie at
    /// infinity.
    pub fn places(&self) -> Option<[f64; 2]> {
        // ds = s₁ (1 − ξ) dv, so that K = s₁^α · s₁ (1 − ξ).
        let end = (self.curvature / self.drop).powf(1.0 / self.order());
        (end.is_finite() && end > 0.0).then_some([self.small_end * end, end])
    }

    fn x(&self, v: f64) -> f64 {
        // The large end is 1 to the bit.
        if v >= 1.0 { 1.0 } else { self.small_end + self.drop * v }
    }

    fn order(&self) -> f64 {
        self.alpha + 1.0
    }

    /// The turning from the inflection to the large end.
    fn whole_turning(&self) -> f64 {
        self.curvature / (self.order() * self.drop)
    }

    /// For near cuts: the integral from the inflection to `x`, in units of x.
    fn since_inflection(&self, x: f64) -> Complex64 {
        let turning = self.whole_turning() * x.abs().powf(self.order());
        fraction(self.order(), turning) * x
    }
}

impl Cut for LogAestheticCut {
    fn curvature_jet(&self, v: f64) -> [f64; 4] {
        /// Nearer to the inflection, derivatives are as here.
        const NEAREST: f64 = 1e-20;
        let (x, alpha) = (self.x(v), self.alpha);
        let size = x.abs().max(NEAREST);
        let curvature = self.curvature * x.abs().powf(alpha).copysign(x);
        let slope = self.curvature * alpha * self.drop * size.powf(alpha - 1.0);
        let second = slope * (alpha - 1.0) * self.drop / size;
        let third = second * (alpha - 2.0) * self.drop / size;
        [if x == 0.0 { 0.0 } else { curvature }, slope, second.copysign(second * x), third]
    }

    /// Powers are largest at an end, on one side of the inflection.
    fn curvature_bounds(&self, from: f64, to: f64) -> [f64; 3] {
        let [a, b] = [from, to].map(|v| self.curvature_jet(v).map(f64::abs));
        let is_on_one_side = self.x(from) * self.x(to) > 0.0;
        let derivative =
            |order: usize| if is_on_one_side { a[order].max(b[order]) } else { f64::MAX };
        [a[0].max(b[0]), derivative(1), derivative(2)]
    }

    fn turning(&self, v: f64) -> f64 {
        let order = self.order();
        if !self.is_far {
            let power = |x: f64| x.abs().powf(order);
            return self.whole_turning() * (power(self.x(v)) - power(self.small_end));
        }
        // (xᵒ − ξᵒ)/(1 − ξ) without cancellation.
        let t = self.drop * v / self.small_end;
        let growth = if t == 0.0 { 1.0 } else { (order * t.ln_1p()).exp_m1() / (order * t) };
        self.curvature * self.small_end.powf(self.alpha) * v * growth
    }

    fn point(&self, v: f64) -> Complex64 {
        if self.is_far {
            let pairs = GAUSS_24.nodes.iter().zip(GAUSS_24.pair_weights);
            let at = |place: f64| Complex64::from_polar(1.0, self.turning(place));
            let sum: Complex64 = pairs
                .map(|(s, weight)| (at(v * (0.5 - s)) + at(v * (0.5 + s))) * (weight / 2.0))
                .sum();
            return sum * v;
        }
        let along = self.since_inflection(self.x(v)) - self.since_inflection(self.small_end);
        let start = self.whole_turning() * self.small_end.abs().powf(self.order());
        along * Complex64::from_polar(1.0 / self.drop, -start)
    }

    fn inflection(&self) -> Option<f64> {
        (self.small_end < 0.0).then(|| -self.small_end / self.drop)
    }
}
