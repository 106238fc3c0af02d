//! The elastica φ″ = b cos φ, whose curvature grows by b for each unit travelled in x (thesis
//! sections 3.2, 3.11), by power series in arc length.
//!
//! Elliptic functions would say the same in closed form, but each of their forms loses its digits
//! somewhere: at inflections, at vertical tangents, or where b is small and the curve nearly a circle.
//! The series knows none of these places. Its steps follow the curve's own scale.

use num_complex::Complex64;

/// Terms of a series. The work for a stretch is least from 16 to 24.
const ORDER: usize = 20;
/// The first terms left out add no more than this, in radians and in parts of a step.
const NEGLIGIBLE: f64 = 1e-17;
/// Far more than any elastica worth drawing takes.
const MOST_STEPS: usize = 400;

/// A place on an elastica.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ElasticaState {
    pub(crate) point: Complex64,
    /// Direction of travel φ, not wrapped.
    pub(crate) angle: f64,
    /// dφ/ds.
    pub(crate) curvature: f64,
}

/// A piece of an elastica along which its series hold.
#[derive(Clone, Debug)]
pub(crate) struct Stretch {
    /// Where it starts.
    pub(crate) start: f64,
    /// How long it is.
    pub(crate) length: f64,
    /// The direction, by powers of the arc length from its start.
    angle: [f64; ORDER],
    /// The point.
    point: [Complex64; ORDER],
}

impl Stretch {
    /// As long a piece from `start` as the series hold for, at most `longest`.
    fn new(slope: f64, from: &ElasticaState, start: f64, longest: f64) -> Stretch {
        let mut curvature = [0.0; ORDER];
        let (sine, cosine) = from.angle.sin_cos();
        let mut unit = [Complex64::ZERO; ORDER];
        unit[0] = Complex64::new(cosine, sine);
        curvature[0] = from.curvature;
        for n in 1..ORDER {
            curvature[n] = slope * unit[n - 1].re / n as f64;
            // (e^{iφ})′ = iκ e^{iφ}.
            let (mut re, mut im) = (0.0, 0.0);
            for (curvature, unit) in curvature[..n].iter().zip(unit[..n].iter().rev()) {
                re += curvature * unit.re;
                im += curvature * unit.im;
            }
            unit[n] = Complex64::new(-im, re) / n as f64;
        }
        let mut angle = [from.angle; ORDER];
        let mut point = [from.point; ORDER];
        for n in 1..ORDER {
            angle[n] = curvature[n - 1] / n as f64;
            point[n] = unit[n - 1] / n as f64;
        }
        let holds_for = |n: usize| {
            let size = unit[n].re.abs() + unit[n].im.abs();
            ((NEGLIGIBLE / size).ln() / n as f64).exp()
        };
        let length = holds_for(ORDER - 1).min(holds_for(ORDER - 2)).min(longest);
        Stretch { start, length, angle, point }
    }

    /// The direction at a distance from its start.
    pub(crate) fn angle(&self, s: f64) -> f64 {
        horner(&self.angle, s)
    }

    /// The point at a distance from its start.
    pub(crate) fn point(&self, s: f64) -> Complex64 {
        self.point.iter().rev().fold(Complex64::ZERO, |sum, c| sum * s + c)
    }

    /// The place at its end. `slope` is b.
    pub(crate) fn end(&self, slope: f64) -> ElasticaState {
        let s = self.length;
        // κ = κ₀ + b·(x − x₀), which is the integral of its series.
        let point = self.point(s);
        let curvature = self.angle[1] + slope * (point.re - self.point[0].re);
        ElasticaState { point, angle: self.angle(s), curvature }
    }
}

fn horner(coefficients: &[f64], s: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

/// The stretches of an elastica of slope b from a start to arc length `length`, accurate to about
/// 1e-15 of the length. `None` if something isn't finite or there would be too many.
pub(crate) fn stretches(slope: f64, start: ElasticaState, length: f64) -> Option<Vec<Stretch>> {
    let (mut at, mut s) = (start, 0.0);
    let mut all = Vec::new();
    for _ in 0..MOST_STEPS {
        let stretch = Stretch::new(slope, &at, s, length - s);
        if !(stretch.length >= 0.0) {
            return None;
        }
        let is_last = stretch.length >= length - s;
        at = stretch.end(slope);
        s += stretch.length;
        all.push(stretch);
        if is_last {
            return (at.point.is_finite() && at.angle.is_finite()).then_some(all);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    const START: ElasticaState =
        ElasticaState { point: Complex64::ZERO, angle: -0.7, curvature: 1.3 };

    #[test]
    fn circles_and_lines_are_elastica_too() {
        for (curvature, length) in [(0.0, 7.0), (1.0, 6.0), (-0.02, 300.0), (1e-9, 1.0)] {
            let all = stretches(0.0, ElasticaState { curvature, ..START }, length).unwrap();
            let end = all.last().unwrap().end(0.0);
            let turn = curvature * length / 2.0;
            let sinc = if turn == 0.0 { 1.0 } else { turn.sin() / turn };
            let chord = Complex64::from_polar(length * sinc, START.angle + turn);
            assert!((end.point - chord).norm() < 1e-15 * length.max(4.0), "{curvature}");
            assert!((end.angle - START.angle - 2.0 * turn).abs() < 4e-15);
        }
    }

    /// κ² − 2b sin φ is the same everywhere, and κ − bx.
    #[test]
    fn both_first_integrals_hold() {
        for slope in [0.0, 1e-8, 0.3, -2.0, 13.0, -40.0] {
            for stretch in stretches(slope, START, 3.0).unwrap() {
                for i in 0..=4 {
                    let s = stretch.length * f64::from(i) / 4.0;
                    let (x, angle) = (stretch.point(s).re, stretch.angle(s));
                    let curvature = 1.3 + slope * x;
                    let kept = curvature.powi(2) - 1.3f64.powi(2)
                        + 2.0 * slope * ((-0.7f64).sin() - angle.sin());
                    assert!(kept.abs() < 1e-14 * (4.0 + 4.0 * slope.abs()), "{slope} {kept:e}");
                }
            }
        }
    }

    #[test]
    fn what_has_no_end_is_none() {
        assert!(stretches(f64::NAN, START, 1.0).is_none());
        assert!(stretches(1e9, START, 1e9).is_none());
        assert!(stretches(1.0, START, f64::INFINITY).is_none());
    }
}
