//! The Euler spiral spline: segments whose curvature is linear in arc length, joined with
//! continuous curvature (thesis sections 4.6, 8.2, 8.3.1).

use std::f64::consts::{PI, TAU};
use std::fmt;

use kurbo::Point;

use super::catalog::{Claim, Params, SplineInfo};
use super::ends;
use super::shapes;
use super::spiro::PolynomialSpirals;
use crate::four_param::spline::ConstraintSpline;
use crate::frame::{ChordAngles, EndCurvature};
use crate::numeric::roots::horner;
use crate::numeric::spiro_integral::{SpiroMoments, spiro_moments};
use crate::numeric::trig::argument;
use crate::outline::Join;
use crate::plan::Run;
use crate::segment::{PolynomialSpiral, Segment, SpiralChord};
use crate::spline::{Effort, RunSolution, Spline};
use crate::tolerance::LOOP;
use crate::two_param::continuity::{Continuity, NaturalEnd};
use crate::two_param::curvature_map::{CurvatureMap, EndCurvatures, SegmentContext};
use crate::two_param::shape::{SegmentEnds, SegmentShape};
use crate::two_param::spline::TwoParamSpline;

/// The catalogue's row.
pub const INFO: SplineInfo = SplineInfo {
    name: "euler",
    summary: "Euler spirals with continuous curvature",
    source: "thesis 4.6, 8.2, 8.3.1",
    params: &[ends::END, shapes::SHAPE],
    default_join: Join::G2,
    joins: &[Join::Corner, Join::G1, Join::G2],
    ends: ends::NAMES,
    claims: &[
        Claim::Parameters(2),
        Claim::Continuity(2),
        Claim::Round,
        Claim::Extensional,
        Claim::GeneratingCurve,
        Claim::MonotoneCurvature,
        Claim::SimilarityInvariant,
        Claim::Symmetric,
        Claim::Ripple(0.267_949_192),
    ],
    build: |params| Ok(build(params)),
};

fn build(params: &Params) -> Box<dyn Spline> {
    let end = ends::chosen(params);
    if params.choice(shapes::SHAPE.name, "own") == "own" {
        return Box::new(Euler::new(end));
    }
    let rule = Continuity { map: EulerSpirals, end };
    Box::new(TwoParamSpline::new(&INFO, rule, shapes::chosen(params, EulerSpirals)))
}

/// The Euler spiral spline.
#[derive(Clone, Copy, Debug)]
pub struct Euler {
    spline: TwoParamSpline<Continuity<EulerSpirals>, EulerSpirals>,
    end: NaturalEnd,
}

impl Default for Euler {
    fn default() -> Self {
        Euler::new(NaturalEnd::Arc)
    }
}

impl Euler {
    /// The spline with that end.
    pub(crate) fn new(end: NaturalEnd) -> Self {
        let rule = Continuity { map: EulerSpirals, end };
        Euler { spline: TwoParamSpline::new(&INFO, rule, EulerSpirals), end }
    }

    /// The same run for a four-parameter spline whose G2 segments are Euler spirals.
    fn as_g2(&self, run: &Run) -> Run {
        let mut run = run.clone();
        let last = run.knots.len() - 1;
        for (i, knot) in run.knots.iter_mut().enumerate() {
            let is_end = !run.closed && (i == 0 || i == last);
            if !is_end {
                knot.join = Join::G2;
            }
            knot.curvature = match (is_end, knot.tangent, self.end) {
                (true, None, NaturalEnd::ZeroCurvature) => knot.curvature.or(Some(0.0)),
                (true, None, _) => knot.curvature,
                _ => None,
            };
        }
        run
    }
}

impl Spline for Euler {
    fn name(&self) -> &'static str {
        self.spline.name()
    }

    fn default_join(&self) -> Join {
        self.spline.default_join()
    }

    fn adapt(&self, join: Join) -> Join {
        self.spline.adapt(join)
    }

    fn solve_plainly(&self, run: &Run) -> Option<RunSolution> {
        self.spline.solve_plainly(run).filter(|solved| !has_loops(solved))
    }

    /// Where no segment winds further than tangents tell, on this rung; else on that of the polynomial
    /// spirals.
    fn follow(&self, run: &Run, near: &[Segment]) -> Option<RunSolution> {
        let winds = |segment: &Segment| {
            let turning = segment.direction(segment.length()) - segment.direction(0.0);
            (segment.chord_angles().turning() - turning).abs() > PI
        };
        if !near.iter().any(winds) {
            return self.spline.follow(run, near).filter(|solved| !has_loops(solved));
        }
        let wider = ConstraintSpline::new(&PolynomialSpirals).follow(&self.as_g2(run), near)?;
        let adapted = self.spline.solve_run(run, Effort::NONE).adapted;
        Some(RunSolution { adapted, ..wider })
    }

    /// Tangents alone can't leave the principal square of chord angles; the wider search over
    /// windings is that of the polynomial spirals, of which all-G2 runs are Euler spirals.
    fn solve_run(&self, run: &Run, effort: Effort) -> RunSolution {
        let solved = self.spline.solve_run(run, Effort::NONE);
        let wider = ConstraintSpline::new(&PolynomialSpirals).solve_run(&self.as_g2(run), effort);
        RunSolution {
            adapted: solved.adapted,
            iterations: solved.iterations + wider.iterations,
            ..wider
        }
    }
}

fn has_loops(solved: &RunSolution) -> bool {
    solved.segments.iter().any(|segment| segment.length() > LOOP * segment.chord_length())
}

/// The family: cut from the one Euler spiral.
#[derive(Clone, Copy, Debug)]
pub struct EulerSpirals;

impl CurvatureMap for EulerSpirals {
    fn curvatures(&self, angles: ChordAngles, _context: &SegmentContext) -> EndCurvatures {
        match fit(angles) {
            Ok(fit) => fit.curvatures(),
            // Only in corners, which `limit` excludes: no curvature, whatever the angles.
            Err(_) => EndCurvatures {
                value: [EndCurvature::finite(0.0); 2],
                by_angle: [[EndCurvature { num: 1.0, den: 0.0 }; 2]; 2],
            },
        }
    }

    fn limit(&self) -> f64 {
        // Beyond, segments close into whole circles whose chord is lost in rounding.
        PI - 0.01
    }
}

impl SegmentShape for EulerSpirals {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        match fit(ends.angles) {
            Ok(fit) => {
                let chord = SpiralChord::new(fit.moments.integral(), fit.spiral().k[0]);
                Segment::spiral_along(start, end, fit.spiral(), chord)
            }
            Err(_) => Segment::line(start, end),
        }
    }

    fn keeps_curvature(&self) -> bool {
        true
    }
}

/// Why no Euler spiral has the end tangents asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FitError {
    /// Both angles are π, or both −π: the spiral closes into a circle, which has no chord.
    ClosedCircle,
    /// An angle lies beyond ±π, or isn't a number.
    OutOfRange,
}

impl fmt::Display for FitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            FitError::ClosedCircle => "a segment that leaves and arrives backwards has no chord",
            FitError::OutOfRange => "an end tangent lies beyond half a turn from the chord",
        })
    }
}

impl std::error::Error for FitError {}

/// The Euler spiral with these end tangents relative to its chord (thesis section 8.2): k₀ and k₁
/// of eq. 8.16, for arc length 1.
///
/// Of the many windings it is the one that continues the straight line. k₁ is accurate to
/// 1e-13·(1 + |k₁|) over the whole square |θ| ≤ π, up to its corners.
///
/// # Errors
/// [`FitError`] in the two corners (π, π) and (−π, −π), outside the square, and for NaN.
///
/// ```
/// use std::f64::consts::PI;
/// use faircurve::{families::euler::{FitError, fit_euler}, frame::ChordAngles};
/// let arc = fit_euler(ChordAngles::new(0.5, 0.5))?;
/// assert_eq!(arc.k, [1.0, 0.0, 0.0, 0.0]);
/// assert_eq!(fit_euler(ChordAngles::new(PI, PI)), Err(FitError::ClosedCircle));
/// # Ok::<(), FitError>(())
/// ```
pub fn fit_euler(angles: ChordAngles) -> Result<PolynomialSpiral, FitError> {
    fit(angles).map(|fit| fit.spiral())
}

/// A fitted spiral with the moments M₀, M₁, M₂ at the solution; the others may be those nearby.
struct Fit {
    k0: f64,
    k1: f64,
    moments: SpiroMoments,
}

/// Solves D + 2ψ(k₁) = k₁/4 (the difference of eq. 8.22 and 8.23) for k₁; k₀ = θ₀ + θ₁ is exact
/// (eq. 8.24).
///
/// The thesis uses the secant method; with ∂ψ/∂k₁ = ½ Re(M₂/M₀) and the next derivative at hand,
/// Halley's takes one evaluation from [`estimate`], up to three elsewhere.
fn fit(angles: ChordAngles) -> Result<Fit, FitError> {
    /// Far more than ever needed.
    const MOST_STEPS: usize = 60;
    /// What Halley's step leaves of a step this small is some 1e-16, and a Taylor polynomial carries the
    /// moments over it, M₀ as well and the others to 1e-12 …
    const LAST: f64 = 3e-5;
    /// … where the chord isn't a smaller part of the arc.
    const LONG_CHORD: f64 = 0.3;
    let ChordAngles { theta0, theta1 } = angles;
    if !(theta0.abs() <= PI && theta1.abs() <= PI) {
        return Err(FitError::OutOfRange);
    }
    if theta0 == theta1 && theta0.abs() == PI {
        return Err(FitError::ClosedCircle);
    }
    let (k0, difference) = (theta0 + theta1, theta1 - theta0);
    let mut k1 = estimate(angles);
    let mut best: Option<(f64, Fit)> = None;
    for _ in 0..MOST_STEPS {
        let moments = spiro_moments([k0, k1, 0.0, 0.0]);
        let chord = moments.integral();
        let inverse = chord.inv();
        let (r2, r4) = (moments.0[2] * inverse, moments.0[4] * inverse);
        let error = difference + 2.0 * argument(chord) - k1 / 4.0;
        let slope = r2.re - 0.25;
        let bend = -(r4 - r2 * r2).im / 2.0;
        let newton = -error / slope;
        let halley = newton / (1.0 + 0.5 * newton * bend / slope);
        if halley.abs() <= LAST && chord.norm_sqr() >= LONG_CHORD * LONG_CHORD {
            return Ok(Fit { k0, k1: k1 + halley, moments: moments.after_k1(halley) });
        }
        let magnitude = error.abs();
        if best.as_ref().is_none_or(|(least, _)| magnitude < *least) {
            best = Some((magnitude, Fit { k0, k1, moments }));
        } else if magnitude < 1e-9 {
            break;
        }
        let step = if (halley / newton - 1.0).abs() < 0.5 { halley } else { newton };
        if !(step.abs() > 1e-15 * (1.0 + k1.abs())) {
            break;
        }
        k1 += step.clamp(-4.0, 4.0);
    }
    best.map(|(_, fit)| fit).ok_or(FitError::ClosedCircle)
}

/// k₁ as far as it is known without solving, T = θ₀ + θ₁ and D = θ₁ − θ₀: up to angles of 2.2 the
/// polynomial D·P(T², D²), P of degree 4, that is nearest to 20,000 solutions (least squares, reweighted
/// by Lawson's rule until the largest errors were alike), off by 1.5e-5 at most; beyond, thesis figure
/// 8.3 (the text above it has a slip): 6D(1 − x³), x = |T|/2π.
fn estimate(angles: ChordAngles) -> f64 {
    /// The coefficients of powers of T², for each power of D².
    const P: [&[f64]; 5] = [
        &[5.9999833330, -9.9966091913e-2, -7.2546719225e-4, -6.4056200389e-6, -1.7785921964e-7],
        &[-1.4281149281e-2, 2.3090395371e-4, 7.0205490652e-5, 5.6973576458e-7],
        &[-9.3475807398e-5, 1.8588070320e-5, -5.4108409208e-7],
        &[3.2139626380e-7, 4.5167689709e-8],
        &[1.4752269555e-8],
    ];
    let ChordAngles { theta0, theta1 } = angles;
    let (sum, difference) = (theta0 + theta1, theta1 - theta0);
    if theta0.abs().max(theta1.abs()) > 2.2 {
        let x = sum.abs() / TAU;
        return 6.0 * difference * (1.0 - x * x * x);
    }
    let rows = P.map(|row| horner(row, sum * sum));
    difference * horner(&rows, difference * difference)
}

impl Fit {
    fn spiral(&self) -> PolynomialSpiral {
        PolynomialSpiral::new([self.k0, self.k1, 0.0, 0.0])
    }

    /// End curvatures for unit chord, c·(k₀ ∓ k₁/2), and their derivatives by the end tangents.
    fn curvatures(&self) -> EndCurvatures {
        let m0 = self.moments.integral();
        let c = m0.norm_sqr().sqrt();
        let inverse = m0.inv();
        // d(log c + iψ) by k₀ and k₁.
        let by_k0 = self.moments.derivative(0) * inverse;
        let by_k1 = self.moments.derivative(1) * inverse;
        // k₁/4 = D + 2ψ(k₀, k₁): dk₁ by T and D.
        let slope = 0.25 - 2.0 * by_k1.im;
        let (k1_by_t, k1_by_d) = (2.0 * by_k0.im / slope, 1.0 / slope);
        // By theta0 (dT = 1, dD = −1) and theta1 (dT = 1, dD = 1).
        let k1_by = [k1_by_t - k1_by_d, k1_by_t + k1_by_d];
        let at_end = |s: f64| {
            let curvature = self.k0 + s * self.k1;
            let by_angle = k1_by.map(|k1_by| {
                let log_c = by_k0.re + by_k1.re * k1_by;
                EndCurvature { num: c * (1.0 + s * k1_by + curvature * log_c), den: 0.0 }
            });
            (EndCurvature::finite(c * curvature), by_angle)
        };
        let (start, end) = (at_end(-0.5), at_end(0.5));
        EndCurvatures { value: [start.0, end.0], by_angle: [start.1, end.1] }
    }
}

#[cfg(test)]
mod tests;
