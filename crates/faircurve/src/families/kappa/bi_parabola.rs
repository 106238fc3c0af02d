//! The bi-parabola (Bespoke section 2.2): two parabolas, each with its vertex at an end of the
//! segment, that meet with the same tangent and, up to sign, the same curvature.

use kurbo::{Point, Vec2};
use num_complex::Complex64;

use super::parabolas::parabola;
use crate::frame::{ChordAngles, EndCurvature, direction};
use crate::numeric::roots::monotone_root;
use crate::numeric::trig::{sin_cos, unit_vector};
use crate::segment::Segment;
use crate::two_param::curvature_map::{CurvatureMap, EndCurvatures, SegmentContext};
use crate::two_param::shape::{SegmentEnds, SegmentShape};

/// The family: with φ the direction at the joint, α = φ + θ₀ and β = θ₁ − φ what each parabola turns,
/// and L the length of the leg through the joint, which divides it as μ : 1 − μ,
///
/// μ = |sin 2α| / (|sin 2α| + |sin 2β|),   L (3 + μ e^(−2iα) + (1 − μ) e^(2iβ)) = 2 e^(−iφ).
///
/// The first is equal curvature, ½ |sin α cos α|/(μL) = ½ |sin β cos β|/((1 − μ)L); the second that the
/// legs μL cos α, L, (1 − μ)L cos β lead along the unit chord. Everything but the directions of
/// the outer legs has period π in both angles.
#[derive(Clone, Copy, Debug)]
pub struct BiParabolas;

/// One bi-parabola on the unit chord.
#[derive(Clone, Copy, Debug)]
struct BiParabola {
    alpha: f64,
    beta: f64,
    phi: f64,
    mu: f64,
    leg: f64,
    /// |sin 2α| + |sin 2β|.
    bend: f64,
}

impl BiParabola {
    fn new(ChordAngles { theta0, theta1 }: ChordAngles) -> BiParabola {
        // |sin φ| ≤ 1/3, and the equation's sign changes between.
        let most = (1.0f64 / 3.0).asin();
        let sin = |angle: f64| unit_vector(angle).im;
        let across = |phi: f64| {
            let (mu, _) = share(phi + theta0, theta1 - phi);
            3.0 * sin(phi) - mu * sin(phi + 2.0 * theta0) + (1.0 - mu) * sin(2.0 * theta1 - phi)
        };
        let phi = monotone_root(across, -most, most).unwrap_or(0.0);
        let (alpha, beta) = (phi + theta0, theta1 - phi);
        let (mu, bend) = share(alpha, beta);
        let cos = |angle: f64| unit_vector(angle).re;
        let along =
            3.0 * cos(phi) + mu * cos(phi + 2.0 * theta0) + (1.0 - mu) * cos(2.0 * theta1 - phi);
        BiParabola { alpha, beta, phi, mu, leg: 2.0 / along, bend }
    }

    /// κ = sign(sin α)·(|sin 2α| + |sin 2β|)/(4 L cos³ α) at the start, and likewise at the end; with
    /// derivatives from those of the equation for φ.
    fn curvatures(&self) -> EndCurvatures {
        let BiParabola { alpha, beta, phi, mu, leg, bend } = *self;
        let (sin_p, cos_p) = sin_cos(2.0 * alpha);
        let (sin_q, cos_q) = sin_cos(2.0 * beta);
        let (p, q) = (sin_p.abs(), sin_q.abs());
        let (p_by_alpha, q_by_beta) = (2.0 * cos_p * sign(sin_p), 2.0 * cos_q * sign(sin_q));
        let square = (bend * bend).max(f64::MIN_POSITIVE);
        let (mu_by_alpha, mu_by_beta) = (p_by_alpha * q / square, -p * q_by_beta / square);
        // φ + 2θ₀ = 2α − φ and 2θ₁ − φ = 2β + φ.
        let (sin_0, cos_0) = sin_cos(2.0 * alpha - phi);
        let (sin_1, cos_1) = sin_cos(2.0 * beta + phi);
        let (sin_phi, cos_phi) = sin_cos(phi);
        let sum = sin_0 + sin_1;
        let by_phi =
            3.0 * cos_phi - mu * cos_0 - (1.0 - mu) * cos_1 - (mu_by_alpha - mu_by_beta) * sum;
        let by_angle =
            [-2.0 * mu * cos_0 - mu_by_alpha * sum, 2.0 * (1.0 - mu) * cos_1 - mu_by_beta * sum];
        let slopes = [0, 1].map(|angle| {
            let is = |wanted: usize| if angle == wanted { 1.0 } else { 0.0 };
            let phi_by = finite(-by_angle[angle] / by_phi);
            let (alpha_by, beta_by) = (phi_by + is(0), is(1) - phi_by);
            let mu_by = mu_by_alpha * alpha_by + mu_by_beta * beta_by;
            let along_by = -3.0 * sin_phi * phi_by + mu_by * (cos_0 - cos_1)
                - mu * sin_0 * (phi_by + 2.0 * is(0))
                - (1.0 - mu) * sin_1 * (2.0 * is(1) - phi_by);
            let leg_by = -0.5 * leg * leg * along_by;
            let bend_by = p_by_alpha * alpha_by + q_by_beta * beta_by;
            [(alpha, alpha_by), (beta, beta_by)].map(|(angle, by)| {
                let (sin, cos) = sin_cos(angle);
                let den = 4.0 * cos * cos * (leg_by * cos - 3.0 * leg * sin * by);
                EndCurvature { num: finite(bend_by * sign(sin)), den: finite(den) }
            })
        });
        EndCurvatures {
            value: [alpha, beta].map(|angle| {
                let (sin, cos) = sin_cos(angle);
                EndCurvature { num: bend * sign(sin), den: 4.0 * leg * cos * cos * cos }
            }),
            by_angle: [0, 1].map(|end| [slopes[0][end], slopes[1][end]]),
        }
    }
}

fn sign(x: f64) -> f64 {
    1.0f64.copysign(x)
}

/// At its kinks the map has no derivative: none, or a steep one.
fn finite(slope: f64) -> f64 {
    if slope.is_nan() { 0.0 } else { slope.clamp(-1e6, 1e6) }
}

/// μ, and the sum that it divides.
fn share(alpha: f64, beta: f64) -> (f64, f64) {
    let [p, q] = [alpha, beta].map(|angle| unit_vector(2.0 * angle).im.abs());
    (if p + q > 0.0 { p / (p + q) } else { 0.5 }, p + q)
}

impl CurvatureMap for BiParabolas {
    /// The map has kinks wherever a parabola vanishes (where the bi-parabola is a single one), at which
    /// the curvature at the vanishing one's end changes its sign.
    fn curvatures(&self, angles: ChordAngles, _context: &SegmentContext) -> EndCurvatures {
        BiParabola::new(angles).curvatures()
    }

    fn limit(&self) -> f64 {
        f64::INFINITY
    }

    fn is_periodic(&self) -> bool {
        true
    }
}

impl SegmentShape for BiParabolas {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        let found = BiParabola::new(ends.angles);
        let chord = end - start;
        let (length, towards) = (chord.hypot(), direction(chord));
        let leg = |direction: f64, part: f64| {
            let Complex64 { re, im } = unit_vector(towards + direction);
            Vec2::new(re, im) * length * part
        };
        let (before, after) = (found.mu * found.leg, (1.0 - found.mu) * found.leg);
        let first = [
            leg(-ends.angles.theta0, before * unit_vector(found.alpha).re),
            leg(found.phi, before),
        ];
        let second =
            [leg(found.phi, after), leg(ends.angles.theta1, after * unit_vector(found.beta).re)];
        let joint = start + first[0] + first[1];
        if !joint.is_finite() {
            // Tangents that no two parabolas have; the report names the knots that this breaks.
            Segment::line(start, end)
        } else if joint == start {
            parabola(start, end, second)
        } else if joint == end {
            parabola(start, end, first)
        } else {
            Segment::chain([parabola(start, joint, first), parabola(joint, end, second)])
        }
    }

    fn keeps_curvature(&self) -> bool {
        true
    }
}
