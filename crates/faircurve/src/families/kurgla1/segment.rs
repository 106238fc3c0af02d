//! The segment: an elastica whose line of action is perpendicular to its chord, so that curvature
//! is linear in the distance along the chord (thesis sections 3.11, 4.9).

use std::f64::consts::PI;

use super::along::Along;
use crate::families::euler::FitError;
use crate::frame::{ChordAngles, EndCurvature};
use crate::numeric::elastica::Elastica;
use crate::two_param::curvature_map::EndCurvatures;

/// The angle-constrained SI-MEC on the unit chord: at x along the chord,
/// κ = mean + slope·(x − ½).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SiMec {
    /// The end tangents.
    pub angles: ChordAngles,
    /// Mean of the two end curvatures, sin `theta0` + sin `theta1`.
    pub mean: f64,
    /// Curvature at the end less that at the start.
    pub slope: f64,
    /// Arc length, at least 1.
    pub length: f64,
}

/// The segment with these end tangents (thesis section 3.11).
///
/// Of several it is the one that continues the straight line. Curvatures are accurate to about
/// 1e-14 of the largest, the length to 1e-14 of itself.
///
/// # Errors
/// [`FitError`] in the two corners (π, π) and (−π, −π) and within about 1e-6 of them, where the
/// segment is a circle of a million chords; outside the square |θ| ≤ π, and for NaN.
///
/// ```
/// use faircurve::{families::kurgla1::fit_si_mec, frame::ChordAngles};
/// let arc = fit_si_mec(ChordAngles::new(0.5, 0.5))?;
/// assert!(arc.slope.abs() < 1e-14 && (arc.length - 0.5 / 0.5f64.sin()).abs() < 1e-14);
/// # Ok::<(), faircurve::families::euler::FitError>(())
/// ```
pub fn fit_si_mec(angles: ChordAngles) -> Result<SiMec, FitError> {
    fit(angles).map(|(fit, _)| fit)
}

/// The fit, with the integrals along it.
pub(super) fn fit(angles: ChordAngles) -> Result<(SiMec, Along), FitError> {
    /// Of the way from the straight line, where the direct way fails.
    const FIRST_STEP: f64 = 0.25;
    const LEAST_STEP: f64 = 1e-3;
    /// Half of the sum of angles is further than this from π, or the segment is out of reach.
    const OPEN: f64 = 1e-6;
    let ChordAngles { theta0, theta1 } = angles;
    if !(theta0.abs() <= PI && theta1.abs() <= PI) {
        return Err(FitError::OutOfRange);
    }
    if (theta0 + theta1).abs() / 2.0 > PI - OPEN {
        return Err(FitError::ClosedCircle);
    }
    if let Some(found) = SiMec::newton(angles, guess(angles)) {
        return Ok(found);
    }
    let at = |t: f64| ChordAngles::new(t * theta0, t * theta1);
    let (mut t, mut step, mut slope) = (0.0, FIRST_STEP, 0.0);
    loop {
        let next: f64 = 1f64.min(t + step);
        match SiMec::newton(at(next), slope) {
            Some(found) if next == 1.0 => return Ok(found),
            Some((fit, _)) => (slope, t, step) = (fit.slope, next, 2.0 * step),
            None if step > LEAST_STEP => step /= 2.0,
            None => return Err(FitError::ClosedCircle),
        }
    }
}

/// A guess of the slope: 6(θ₁ − θ₀) is right for small angles, the rest was fitted by eye to a dozen
/// segments. Where it is too far off, following the segment from the straight line costs more time.
fn guess(angles: ChordAngles) -> f64 {
    let ChordAngles { theta0, theta1 } = angles;
    let bend = 0.103 * (theta0 * theta0 + theta1 * theta1) + 0.068 * theta0 * theta1;
    6.0 * (theta1 - theta0) * (-bend).exp()
}

impl SiMec {
    /// Newton's method for the slope, from a guess: y must be 0 at the end.
    ///
    /// The rest holds by itself. For curvature linear in x, sin φ is quadratic in x, and with the mean
    /// curvature above it has its right values at both ends.
    pub(super) fn newton(angles: ChordAngles, slope: f64) -> Option<(SiMec, Along)> {
        const MOST_STEPS: usize = 24;
        /// The end may miss by this much of the length.
        const CLOSE: f64 = 1e-13;
        let mean = angles.theta0.sin() + angles.theta1.sin();
        let mut fit = SiMec { angles, mean, slope, length: 1.0 };
        /// After a step this small, as a part of curvature, the next one is rounding.
        const LAST: f64 = 1e-8;
        let mut is_last = false;
        for _ in 0..MOST_STEPS {
            let along = Along::of(&fit)?;
            fit.length = along.length;
            if is_last {
                return (along.y.abs() <= CLOSE * along.length).then_some((fit, along));
            }
            let step = -along.y / along.y_by(&fit)[0];
            let size = fit.slope.abs() + mean.abs();
            is_last = step.abs() <= LAST * size;
            let most = 1.0 + fit.slope.abs() / 2.0;
            fit.slope += step.clamp(-most, most);
        }
        None
    }

    /// The elastica for arc length 1, with its place of reference in the middle.
    pub fn elastica(&self) -> Elastica {
        self.at_start().moved(self.length / 2.0).scaled(self.length)
    }

    /// The elastica, with its place of reference at the segment's start.
    pub(super) fn at_start(&self) -> Elastica {
        let ([curvature, _], (sine, cosine)) = (self.curvatures(), self.angles.theta0.sin_cos());
        // κ′ = b cos φ says that the force is b along +y, from the start's direction, −theta0.
        let constant = -self.slope * sine - curvature * curvature / 2.0;
        Elastica::new(curvature, self.slope * cosine, constant)
    }

    /// Curvatures at the start and the end.
    pub fn curvatures(&self) -> [f64; 2] {
        [self.mean - self.slope / 2.0, self.mean + self.slope / 2.0]
    }

    /// End curvatures with their derivatives by the end tangents, by the implicit function theorem.
    pub(super) fn response(&self, along: &Along) -> EndCurvatures {
        let [y_by_slope, y_by_angles @ ..] = along.y_by(self);
        let slopes = y_by_angles.map(|y| -y / y_by_slope);
        let means = [self.angles.theta0.cos(), self.angles.theta1.cos()];
        let by_angle = [-0.5, 0.5].map(|end| {
            [0, 1].map(|angle| EndCurvature { num: means[angle] + end * slopes[angle], den: 0.0 })
        });
        EndCurvatures { value: self.curvatures().map(EndCurvature::finite), by_angle }
    }
}

/// Chord angles up to this are what the curvature map deals with.
pub(super) const LIMIT: f64 = PI - 0.01;
