//! A curve given by any parameter, measured by arc length.

use std::fmt;
use std::sync::OnceLock;

use kurbo::PathSeg;
use num_complex::Complex64;

use super::{CurveEnd, UnitCurve};
use crate::numeric::quadrature::{gauss_16, integrate};
use crate::numeric::trig::argument;

/// A curve from 0 to 1 in the complex plane by a parameter u from 0 to 1; smooth within.
pub trait ParametricCurve: fmt::Debug + Send + Sync {
    /// The point at `u`: exactly 0 and 1 at the ends.
    fn point(&self, u: f64) -> Complex64;

    /// Taylor coefficients of the velocity about `u`: v₀ + v₁t + … + v₄t⁴.
    fn velocity_series(&self, u: f64) -> [Complex64; 5];

    /// The velocity at `u`.
    fn velocity(&self, u: f64) -> Complex64 {
        self.velocity_series(u)[0]
    }

    /// The piece between two parameters as a Bézier, if it is one exactly.
    fn bezier(&self, from: f64, to: f64) -> Option<PathSeg>;

    /// The length of a gentle stretch between two parameters: one of which it is known without a try that it
    /// turns by less than a radian and that sixteen nodes measure it, or any part of it, to rounding. `None` for
    /// others.
    fn gentle_length(&self, _from: f64, _to: f64) -> Option<f64> {
        None
    }

    /// The directions at both ends, in radians and continuous along the curve, where they are known before it is
    /// measured, and that it is no longer than 1000. `None` for others.
    fn directions(&self) -> Option<[f64; 2]> {
        None
    }
}

/// A [`ParametricCurve`] with its arc length, to about 1e-15: measured when it is first asked for, where no more
/// than the ends matter before.
#[derive(Clone, Debug)]
pub struct Measured<C> {
    curve: C,
    ends: [CurveEnd; 2],
    arcs: OnceLock<Arcs>,
}

/// How arc length and direction go along a curve.
#[derive(Clone, Debug)]
struct Arcs {
    length: f64,
    /// Those after the first; mostly none.
    later: Vec<Panel>,
    breaks: Vec<f64>,
    /// The direction at the end.
    direction: f64,
}

/// A stretch of the parameter along which the curve turns little, and sixteen nodes suffice. Its end
/// is where the next one starts.
#[derive(Clone, Copy, Debug)]
struct Panel {
    u: f64,
    s: f64,
    direction: f64,
}

/// About radians: what the sines of turns within a panel may add up to.
const MOST_TURN: f64 = 1.0;
/// Arc lengths below this part of what lengths are known to are none: a panel at a cusp ends there.
const NEGLIGIBLE: f64 = 0.01;
/// More panels than any curve needs that is worth drawing (some 30 at each cusp): of what is nothing but
/// rounding, there would be no end.
const MOST_PANELS: usize = 2000;
/// Larger curvatures (at cusps) are written as this.
const LARGEST: f64 = 1e100;
/// No curve with known [directions](ParametricCurve::directions) is longer.
pub(super) const LONGEST_UNMEASURED: f64 = 1e3;

impl<C: ParametricCurve> Measured<C> {
    /// A curve to be measured. That takes sixteen evaluations of the velocity for each gentle stretch that it is
    /// halved into, some 50 for one of which that isn't known but found.
    pub fn new(curve: C) -> Self {
        let arcs = OnceLock::new();
        let directions = curve.directions().unwrap_or_else(|| {
            let start = argument(tangent(&curve, 0.0, true));
            let measured = arcs.get_or_init(|| Arcs::of(&curve, start));
            [start, measured.direction]
        });
        let end = |i: usize| CurveEnd {
            direction: directions[i],
            curvature: curvature(&curve, i as f64),
        };
        let ends = [end(0), end(1)];
        Measured { curve, ends, arcs }
    }

    fn arcs(&self) -> &Arcs {
        self.arcs.get_or_init(|| Arcs::of(&self.curve, self.ends[0].direction))
    }

    /// The last panel of which `key` holds, as it does of those up to some place, and the one after it.
    fn panel_at(&self, key: impl Fn(&Panel) -> bool) -> (Panel, Option<&Panel>) {
        let later = &self.arcs().later;
        let after = later.partition_point(key);
        let first = Panel { u: 0.0, s: 0.0, direction: self.ends[0].direction };
        (after.checked_sub(1).map_or(first, |index| later[index]), later.get(after))
    }

    /// The parameter at arc length `s`.
    fn parameter(&self, s: f64) -> f64 {
        /// Newton's method, and halving where it fails.
        const MOST_STEPS: usize = 60;
        if s <= 0.0 {
            return 0.0;
        } else if s == f64::INFINITY || s >= self.length() {
            return 1.0;
        }
        let (panel, next) = self.panel_at(|panel| panel.s <= s);
        let end = next.map_or(1.0, |next| next.u);
        let wanted = s - panel.s;
        let whole = next.map_or(self.length(), |next| next.s) - panel.s;
        let (mut low, mut high) = (panel.u, end);
        let mut u = panel.u + (end - panel.u) * if whole > 0.0 { wanted / whole } else { 0.5 };
        for _ in 0..MOST_STEPS {
            let over = arc(&self.curve, panel.u, u) - wanted;
            if over == 0.0 {
                return u;
            } else if over > 0.0 {
                high = u;
            } else {
                low = u;
            }
            let step = over / size(self.curve.velocity(u));
            let next =
                if (low..=high).contains(&(u - step)) { u - step } else { (low + high) / 2.0 };
            if (next - u).abs() <= f64::EPSILON * (end - panel.u) {
                return next;
            }
            u = next;
        }
        u
    }

    /// The arc length at a parameter.
    pub fn arc_length(&self, u: f64) -> f64 {
        let u = u.clamp(0.0, 1.0);
        let (panel, _) = self.panel_at(|panel| panel.u <= u);
        (panel.s + arc(&self.curve, panel.u, u)).min(self.length())
    }
}

impl Arcs {
    #[inline(never)] // for the size of the web's module
    fn of(curve: &impl ParametricCurve, start: f64) -> Arcs {
        let mut arcs =
            Arcs { length: 0.0, later: Vec::new(), breaks: Vec::new(), direction: start };
        if let Some(length) = curve.gentle_length(0.0, 1.0) {
            // A single panel.
            arcs.push(curve, [0.0, 1.0], length);
        } else {
            // What lengths are known to. Where a long curve nearly stands still, its velocity is a small
            // difference of large numbers: less would be noise, and panels without end.
            let speed = |u: f64| size(curve.velocity(u));
            let roughly = [0.0, 0.25, 0.5, 0.75, 1.0].map(speed).iter().sum::<f64>() / 5.0;
            let noise = 4.0 * f64::EPSILON * (1.0 + roughly);
            arcs.measure(curve, [0.0, 1.0], None, noise, 50);
        }
        // What isn't a number stays so: the segment will be a straight line.
        if arcs.length < 1.0 {
            arcs.length = 1.0;
        }
        arcs.breaks = arcs.later.iter().map(|panel| panel.s).collect();
        arcs
    }

    /// Appends the panel from `u` to `to`, of that length.
    fn push(&mut self, curve: &impl ParametricCurve, [u, to]: [f64; 2], length: f64) {
        if u > 0.0 {
            self.later.push(Panel { u, s: self.length, direction: self.direction });
        }
        self.length += length;
        let (a, b) = (tangent(curve, u, true), tangent(curve, to, false));
        self.direction += argument(b * a.conj());
        if to < 1.0 {
            // Through a cusp just at the joint.
            self.direction += argument(tangent(curve, to, true) * b.conj());
        }
    }

    /// Appends the panels from `u` to `to`, which isn't gentle; sixteen nodes may have measured the whole.
    fn measure(
        &mut self,
        curve: &impl ParametricCurve,
        [u, to]: [f64; 2],
        whole: Option<f64>,
        noise: f64,
        depth: usize,
    ) {
        let middle = (u + to) / 2.0;
        let halves = [[u, middle], [middle, to]];
        let gentle = halves.map(|[from, to]| curve.gentle_length(from, to));
        if depth > 0 && gentle.iter().any(Option::is_some) {
            for (half, gentle) in halves.into_iter().zip(gentle) {
                match gentle {
                    Some(length) => self.push(curve, half, length),
                    None => self.measure(curve, half, None, noise, depth - 1),
                }
            }
            return;
        }
        let whole = whole.unwrap_or_else(|| arc(curve, u, to));
        let (left, right) = (arc(curve, u, middle), arc(curve, middle, to));
        let is_short = whole < NEGLIGIBLE * noise;
        let is_even = (left + right - whole).abs() <= noise;
        let is_enough = depth == 0 || self.later.len() + 1 >= MOST_PANELS || !whole.is_finite();
        if is_enough || is_short || (is_even && turn(curve, u, to) < MOST_TURN) {
            self.push(curve, [u, to], left + right);
            return;
        }
        self.measure(curve, halves[0], Some(left), noise, depth - 1);
        self.measure(curve, halves[1], Some(right), noise, depth - 1);
    }
}

/// The length between two parameters, by sixteen nodes.
fn arc(curve: &impl ParametricCurve, from: f64, to: f64) -> f64 {
    gauss_16(&|u| size(curve.velocity(u)), from, to)
}

/// The sum of the sines of what the curve turns between five places; infinite where it turns by more
/// than a right angle between two.
fn turn(curve: &impl ParametricCurve, from: f64, to: f64) -> f64 {
    let at = [0.0, 1.0, 2.0, 3.0, 4.0].map(|i| {
        let u = from + (to - from) * i / 4.0;
        tangent(curve, u, i < 4.0)
    });
    let sine = |pair: &[Complex64]| {
        let turn = pair[1] * pair[0].conj();
        if turn.re > 0.0 { turn.im.abs() } else { f64::INFINITY }
    };
    at.windows(2).map(sine).sum()
}

/// The absolute value, without the care that `norm` takes where it isn't needed.
fn size(z: Complex64) -> f64 {
    let squared = z.norm_sqr();
    if (1e-280..1e280).contains(&squared) { squared.sqrt() } else { z.norm() }
}

/// The unit vector in the direction of travel just after (or before) a parameter.
fn tangent(curve: &impl ParametricCurve, u: f64, after: bool) -> Complex64 {
    let velocity = curve.velocity(u);
    if velocity.norm_sqr() > 0.0 {
        return velocity / size(velocity);
    }
    let series = curve.velocity_series(u);
    let Some(order) = series.iter().position(|v| v.norm_sqr() > 0.0) else {
        return Complex64::ONE;
    };
    let leading = series[order] / size(series[order]);
    // Before a place where it stands still, an odd power goes the other way.
    if after || order % 2 == 0 { leading } else { -leading }
}

/// The curvature at a parameter.
fn curvature(curve: &impl ParametricCurve, u: f64) -> f64 {
    let [v0, v1, ..] = curve.velocity_series(u);
    let squared = v0.norm_sqr();
    written(if (1e-180..1e180).contains(&squared) {
        (v0.conj() * v1).im / (squared * squared.sqrt())
    } else {
        (v1 * v0.inv()).im / size(v0)
    })
}

/// What isn't a number, or too large for one, as a number.
fn written(value: f64) -> f64 {
    if value.is_nan() { 0.0 } else { value.clamp(-LARGEST, LARGEST) }
}

/// Curvature and three derivatives by arc length from the velocity's Taylor coefficients.
///
/// With v = σ·exp(iθ): v′/v = (log σ)′ + iθ′, so that κ = Im(v′/v)/σ, and d/ds = (1/σ) d/du.
fn curvature_jet(v: [Complex64; 5]) -> [f64; 4] {
    // The logarithmic derivative.
    let inverse = v[0].inv();
    let mut w = [Complex64::ZERO; 4];
    for j in 0..4 {
        let mut rest = v[j + 1] * (j + 1) as f64;
        for i in 1..=j {
            rest -= v[i] * w[j - i];
        }
        w[j] = rest * inverse;
    }
    // Speed: σ′ = σ·Re w.
    let mut speed = [size(v[0]), 0.0, 0.0, 0.0];
    for j in 0..3 {
        let sum: f64 = (0..=j).map(|i| speed[i] * w[j - i].re).sum();
        speed[j + 1] = sum / (j + 1) as f64;
    }
    let over_speed = |f: [f64; 4]| {
        let mut quotient = [0.0; 4];
        for j in 0..4 {
            let known: f64 = (1..=j).map(|i| speed[i] * quotient[j - i]).sum();
            quotient[j] = (f[j] - known) / speed[0];
        }
        quotient
    };
    let mut series = over_speed(w.map(|w| w.im));
    let mut jet = [0.0; 4];
    for value in &mut jet {
        *value = series[0];
        series = over_speed([series[1], 2.0 * series[2], 3.0 * series[3], 0.0]);
    }
    jet.map(written)
}

impl<C: ParametricCurve> UnitCurve for Measured<C> {
    fn length(&self) -> f64 {
        self.arcs().length
    }

    fn length_bound(&self) -> f64 {
        self.arcs.get().map_or(LONGEST_UNMEASURED, |arcs| arcs.length)
    }

    fn point(&self, s: f64) -> Complex64 {
        self.curve.point(self.parameter(s))
    }

    fn direction(&self, s: f64) -> f64 {
        if s <= 0.0 {
            return self.ends[0].direction;
        } else if s >= self.length() {
            return self.ends[1].direction;
        }
        let (panel, _) = self.panel_at(|panel| panel.s <= s);
        let start = tangent(&self.curve, panel.u, true);
        let here = tangent(&self.curve, self.parameter(s), true);
        panel.direction + argument(here * start.conj())
    }

    fn curvature_jet(&self, s: f64) -> [f64; 4] {
        curvature_jet(self.curve.velocity_series(self.parameter(s)))
    }

    fn curvature(&self, s: f64) -> f64 {
        if s <= 0.0 {
            return self.ends[0].curvature;
        } else if s >= self.length() {
            return self.ends[1].curvature;
        }
        curvature(&self.curve, self.parameter(s))
    }

    fn ends(&self) -> [CurveEnd; 2] {
        self.ends
    }

    fn breaks(&self) -> &[f64] {
        &self.arcs().breaks
    }

    fn curvature_bounds(&self, _from: f64, _to: f64) -> [f64; 3] {
        [f64::MAX; 3]
    }

    fn bezier(&self, from: f64, to: f64) -> Option<PathSeg> {
        self.curve.bezier(self.parameter(from), self.parameter(to))
    }

    fn integral(&self, from: f64, to: f64, f: &dyn Fn([f64; 4]) -> f64) -> f64 {
        let integrand = |u: f64| {
            let series = self.curve.velocity_series(u);
            f(curvature_jet(series)) * size(series[0])
        };
        let stops: Vec<f64> = self.stops(from, to).into_iter().map(|s| self.parameter(s)).collect();
        integrate(&integrand, &stops).min(f64::MAX)
    }
}

#[cfg(test)]
mod tests;
