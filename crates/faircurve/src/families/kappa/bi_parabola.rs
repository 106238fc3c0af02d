//! The bi-parabola (Bespoke section 2.2): two parabolas, each with its vertex at an end of the
//! segment, that meet with the same tangent and, up to sign, the same curvature.

use kurbo::{Point, Vec2};

use super::parabolas::parabola;
use crate::frame::{ChordAngles, EndCurvature, direction};
use crate::numeric::roots::monotone_root;
use crate::numeric::trig::sin_cos;
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
        let across = |phi: f64| {
            let (mu, _) = share(phi + theta0, theta1 - phi);
            3.0 * phi.sin() - mu * (phi + 2.0 * theta0).sin()
                + (1.0 - mu) * (2.0 * theta1 - phi).sin()
        };
        let phi = monotone_root(across, -most, most).unwrap_or(0.0);
        let (alpha, beta) = (phi + theta0, theta1 - phi);
        let (mu, bend) = share(alpha, beta);
        let along = 3.0 * phi.cos()
            + mu * (phi + 2.0 * theta0).cos()
            + (1.0 - mu) * (2.0 * theta1 - phi).cos();
        BiParabola { alpha, beta, phi, mu, leg: 2.0 / along, bend }
    }

    /// κ = sign(sin α)·(|sin 2α| + |sin 2β|)/(4 L cos³ α) at the start, and likewise at the end.
    fn curvatures(&self) -> [EndCurvature; 2] {
        [self.alpha, self.beta].map(|angle| {
            let (sin, cos) = sin_cos(angle);
            EndCurvature { num: self.bend.copysign(sin), den: 4.0 * self.leg * cos * cos * cos }
        })
    }
}

/// μ, and the sum that it divides.
fn share(alpha: f64, beta: f64) -> (f64, f64) {
    let (p, q) = ((2.0 * alpha).sin().abs(), (2.0 * beta).sin().abs());
    (if p + q > 0.0 { p / (p + q) } else { 0.5 }, p + q)
}

impl CurvatureMap for BiParabolas {
    /// Derivatives are differences: the map has kinks wherever a parabola vanishes (where the bi-parabola
    /// is a single one), at which the curvature at the vanishing one's end changes its sign.
    fn curvatures(&self, angles: ChordAngles, _context: &SegmentContext) -> EndCurvatures {
        const STEP: f64 = 1e-7;
        let ChordAngles { theta0, theta1 } = angles;
        let at = |a: f64, b: f64| {
            BiParabola::new(ChordAngles::new(theta0 + a, theta1 + b)).curvatures()
        };
        let value = at(0.0, 0.0);
        let slopes = [(STEP, 0.0), (0.0, STEP)].map(|(a, b)| {
            let (up, down) = (at(a, b), at(-a, -b));
            [0, 1].map(|end| EndCurvature {
                num: (up[end].num - down[end].num) / (2.0 * STEP),
                den: (up[end].den - down[end].den) / (2.0 * STEP),
            })
        });
        EndCurvatures {
            value,
            by_angle: [0, 1].map(|end| [slopes[0][end], slopes[1][end]]),
        }
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
        let leg = |direction: f64, part: f64| Vec2::from_angle(towards + direction) * length * part;
        let (before, after) = (found.mu * found.leg, (1.0 - found.mu) * found.leg);
        let first = [
            leg(-ends.angles.theta0, before * found.alpha.cos()),
            leg(found.phi, before),
        ];
        let second =
            [leg(found.phi, after), leg(ends.angles.theta1, after * found.beta.cos())];
        let joint = start + first[0] + first[1];
        if joint == start {
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
