//! The curve: κ⁗ + κ²κ″ − ½κκ′² + Cκ = 0 (thesis eq. 7.19, 7.20), by power series in arc length.
//!
//! With θ the direction, that is θ⁗ = α cos θ + β sin θ (eq. 7.13): in the frame of the direction in the
//! middle, α = κ‴ and β = ½κ′² − κκ″ − C there. Series are written for numbers of any kind, so that
//! they also say how everything answers changes of the parameters.

use kurbo::PathSeg;
use num_complex::Complex64;

use crate::numeric::dual::Real;
use crate::numeric::order::sort_by;
use crate::segment::UnitCurve;

/// Panels on either side of the middle; more than any curve takes that is worth drawing.
const MOST_PANELS: usize = 24;

/// α and β: the force, in the frame of the middle.
#[derive(Clone, Copy, Debug)]
struct Force<T> {
    alpha: T,
    beta: T,
}

/// A place on a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<T> {
    /// The point, with the middle of the curve as the origin and its direction that of +x.
    pub(super) x: T,
    pub(super) y: T,
    /// The direction, and its cosine and sine.
    pub(super) theta: T,
    cosine: T,
    sine: T,
    /// κ, κ′, κ″.
    pub(super) curvature: [T; 3],
}

/// The series of cos θ, sin θ and κ about a place, cut after N terms.
#[derive(Clone, Copy, Debug)]
struct Panel<T, const N: usize> {
    start: Place<T>,
    cosine: [T; N],
    sine: [T; N],
    curvature: [T; N],
}

impl<T: Real, const N: usize> Panel<T, N> {
    fn new(start: Place<T>, force: Force<T>) -> Self {
        let zero = T::from(0.0);
        let (mut cosine, mut sine, mut curvature) = ([zero; N], [zero; N], [zero; N]);
        (cosine[0], sine[0]) = (start.cosine, start.sine);
        let [k, k1, k2] = start.curvature;
        (curvature[0], curvature[1], curvature[2]) = (k, k1, k2 * 0.5);
        for n in 0..N {
            if n > 0 {
                // (cos θ)′ = −κ sin θ, (sin θ)′ = κ cos θ.
                let (mut c, mut s) = (zero, zero);
                for j in 0..n {
                    c = c - curvature[j] * sine[n - 1 - j];
                    s = s + curvature[j] * cosine[n - 1 - j];
                }
                let over = 1.0 / n as f64;
                (cosine[n], sine[n]) = (c * over, s * over);
            }
            if n + 3 < N {
                let third = force.alpha * cosine[n] + force.beta * sine[n];
                curvature[n + 3] = third * (1.0 / ((n + 1) * (n + 2) * (n + 3)) as f64);
            }
        }
        Panel { start, cosine, sine, curvature }
    }

    /// How far from its start the series hold, for an error of this part.
    fn reach(&self, negligible: f64) -> f64 {
        let reach = |n: usize| {
            let size = self.cosine[n].value().abs() + self.sine[n].value().abs();
            ((negligible / size).ln() / n as f64).exp()
        };
        reach(N - 1).min(reach(N - 2))
    }

    /// The place at a distance.
    fn at(&self, h: f64) -> Place<T> {
        let zero = T::from(0.0);
        let (mut x, mut y, mut cosine, mut sine) = (zero, zero, zero, zero);
        let (mut theta, mut k, mut k1, mut k2) = (zero, zero, zero, zero);
        for n in (0..N).rev() {
            let over = 1.0 / (n + 1) as f64;
            cosine = cosine * h + self.cosine[n];
            sine = sine * h + self.sine[n];
            x = x * h + self.cosine[n] * over;
            y = y * h + self.sine[n] * over;
            theta = theta * h + self.curvature[n] * over;
            k = k * h + self.curvature[n];
            if n > 0 {
                k1 = k1 * h + self.curvature[n] * n as f64;
            }
            if n > 1 {
                k2 = k2 * h + self.curvature[n] * (n * (n - 1)) as f64;
            }
        }
        Place {
            x: self.start.x + x * h,
            y: self.start.y + y * h,
            theta: self.start.theta + theta * h,
            cosine,
            sine,
            curvature: [k, k1, k2],
        }
    }
}

fn middle<T: Real>(k: [T; 4], constant: T) -> (Place<T>, Force<T>) {
    let zero = T::from(0.0);
    let start = Place {
        x: zero,
        y: zero,
        theta: zero,
        cosine: T::from(1.0),
        sine: zero,
        curvature: [k[0], k[1], k[2]],
    };
    (start, Force { alpha: k[3], beta: k[1] * k[1] * 0.5 - k[0] * k[2] - constant })
}

/// Both ends of the curve of arc length 1 with these κ … κ‴ in the middle and this C; accurate to
/// about `negligible`. `None` if it is too wild.
pub(super) fn ends<T: Real, const N: usize>(
    k: [T; 4],
    constant: T,
    negligible: f64,
) -> Option<[Place<T>; 2]> {
    let (start, force) = middle(k, constant);
    let first = Panel::<T, N>::new(start, force);
    let reach = first.reach(negligible);
    let end = |sign: f64| {
        let (mut panel, mut reach, mut s) = (first, reach, 0.0);
        for _ in 0..MOST_PANELS {
            let rest = 0.5 - s;
            if !(reach > 0.0) {
                return None;
            }
            if reach >= rest {
                return Some(panel.at(sign * rest));
            }
            s += reach;
            panel = Panel::new(panel.at(sign * reach), force);
            reach = panel.reach(negligible);
        }
        None
    };
    Some([end(-1.0)?, end(1.0)?])
}

/// Terms and negligible parts of series: to rounding, and for searching.
pub(super) const TERMS: usize = 20;
pub(super) const NEGLIGIBLE: f64 = 1e-17;
pub(super) const ROUGH_TERMS: usize = 12;
pub(super) const ROUGHLY: f64 = 1e-9;

/// A curve of minimum variation on the unit chord, by arc length.
#[derive(Clone, Debug)]
pub struct MvcCurve {
    /// Panels by the arc length of the unit curve at which they start, ascending, with the arc length
    /// about which their series are.
    panels: Vec<(f64, Panel<f64, TERMS>)>,
    force: Force<f64>,
    start: Complex64,
    chord: Complex64,
}

impl MvcCurve {
    /// The curve with these κ … κ‴ in the middle for arc length 1 and this C, on its chord; `None` if it
    /// is too wild to be drawn, or has no chord.
    pub fn new(k: [f64; 4], constant: f64) -> Option<MvcCurve> {
        /// Chords shorter than this part of the arc are mostly rounding.
        const SHORTEST: f64 = 1e-9;
        let (at, force) = middle(k, constant);
        let mut panels = Vec::new();
        for sign in [-1.0, 1.0] {
            let mut panel = Panel::<f64, TERMS>::new(at, force);
            let mut s = 0.0;
            while s < 0.5 {
                let reach = panel.reach(NEGLIGIBLE);
                if !(reach > 0.0) || panels.len() > 2 * MOST_PANELS {
                    return None;
                }
                panels.push((sign * s, panel));
                s += reach.min(0.5 - s).max(f64::EPSILON);
                panel = Panel::new(panel.at(sign * reach), force);
            }
        }
        sort_by(&mut panels, |a, b| a.0.total_cmp(&b.0));
        let mut curve = MvcCurve { panels, force, start: Complex64::ZERO, chord: Complex64::ONE };
        let [start, end] = [-0.5, 0.5].map(|s| {
            let place = curve.place(s);
            Complex64::new(place.x, place.y)
        });
        curve.start = start;
        curve.chord = end - start;
        (curve.chord.is_finite() && curve.chord.norm() > SHORTEST).then_some(curve)
    }

    /// The place at s from −½ to ½.
    fn place(&self, s: f64) -> Place<f64> {
        // Series go from the middle outwards.
        let index = if s >= 0.0 {
            self.panels.partition_point(|(start, _)| *start <= s) - 1
        } else {
            self.panels.partition_point(|(start, _)| *start < s)
        };
        let (start, panel) = &self.panels[index];
        panel.at(s - start)
    }

    fn at(&self, s: f64) -> Place<f64> {
        self.place((s * self.chord.norm() - 0.5).clamp(-0.5, 0.5))
    }
}

impl UnitCurve for MvcCurve {
    fn length(&self) -> f64 {
        (1.0 / self.chord.norm()).max(1.0)
    }

    fn point(&self, s: f64) -> Complex64 {
        if s <= 0.0 {
            return Complex64::ZERO;
        } else if s >= self.length() {
            return Complex64::ONE;
        }
        let place = self.at(s);
        (Complex64::new(place.x, place.y) - self.start) / self.chord
    }

    fn direction(&self, s: f64) -> f64 {
        self.at(s).theta - self.chord.arg()
    }

    fn curvature_jet(&self, s: f64) -> [f64; 4] {
        let Place { curvature: [k, k1, k2], cosine, sine, .. } = self.at(s);
        let third = self.force.alpha * cosine + self.force.beta * sine;
        let c = self.chord.norm();
        [k * c, k1 * c * c, k2 * c * c * c, third * c * c * c * c]
    }

    fn breaks(&self) -> &[f64] {
        &[]
    }

    /// By Taylor's theorem from the middle of the interval, with κ‴ bounded by the force:
    /// |κ‴| ≤ |(α, β)|.
    fn curvature_bounds(&self, from: f64, to: f64) -> [f64; 3] {
        let middle = self.curvature_jet((from + to) / 2.0);
        let (h, c) = ((to - from).abs() / 2.0, self.chord.norm());
        let third = self.force.alpha.hypot(self.force.beta) * c.powi(4);
        let second = middle[2].abs() + h * third;
        [
            middle[0].abs() + h * (middle[1].abs() + h / 2.0 * (middle[2].abs() + h / 3.0 * third)),
            middle[1].abs() + h * second,
            second,
        ]
    }

    fn bezier(&self, _from: f64, _to: f64) -> Option<PathSeg> {
        None
    }
}
