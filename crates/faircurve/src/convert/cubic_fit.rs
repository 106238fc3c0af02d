//! Cubics along one spiral segment: sixth-order contact for the arms, equal pieces for the cuts.
//!
//! Source of the formulas: an expansion of the curve about the middle of a piece to sixth order.
//! With x ∈ [−1, 1] along a piece of length h, and
//! A = k₀/2, B = k₁/6, C = (3k₀³ + k₂)/24, D = (19k₀²k₁ + k₃)/120, E = k₀(45k₀⁴ + 34k₀k₂ + 48k₁²)/720,
//! the cubics in sixth-order contact belong to the real roots α of
//! 2A²α³ + 3ABα² + (9B² − 6AC)α + 3BC − 2AD = 0 (the several local minima of thesis section 9.5);
//! each deviates by −E₆(h/2)⁶(x² − 1)²(x² − q) to leading order.

use kurbo::{CubicBez, ParamCurve, ParamCurveDeriv, Point, Vec2};

use crate::numeric::roots::roots_between;
use crate::numeric::spiro_integral::wildness;
use crate::segment::Segment;

/// q of the cubic that minimises the largest distance: the root of 4(1 − q)³ = 27q.
const MINIMAX_Q: f64 = 0.105_892_543;

/// Cubics that deviate from the segment by at most `accuracy`, from its start to its end.
pub(super) fn cubics(segment: &Segment, accuracy: f64) -> Vec<CubicBez> {
    /// Finer is rounding.
    const FINEST: f64 = 1e-12;
    /// A piece that bends more than this (in radians) isn't worth trying.
    const MOST_BEND: f64 = 2.2;
    /// Guards against endless division; at sixth order 4096 pieces gain 21 digits over one.
    const MOST_PIECES: f64 = 4096.0;
    let length = segment.length();
    let accuracy = if accuracy > FINEST * length { accuracy } else { FINEST * length };
    let bend = wildness(parameters(segment));
    let mut count = (bend / MOST_BEND).ceil().clamp(1.0, MOST_PIECES);
    loop {
        let cut = |i: f64| {
            if i == count { length } else { length * i / count }
        };
        let mut worst = 0.0f64;
        let mut result = Vec::with_capacity(count as usize);
        for i in 0..count as usize {
            let (from, to) = (cut(i as f64), cut(i as f64 + 1.0));
            let (cubic, error) = best_cubic(&segment.subsegment(from, to));
            worst = worst.max(error);
            result.push(cubic);
        }
        if worst <= accuracy || count >= MOST_PIECES {
            return joined(result);
        }
        // The error falls as the sixth power of the number of pieces.
        let factor = (worst / accuracy).powf(1.0 / 6.0);
        count = if factor.is_finite() { (count * factor).ceil() } else { 2.0 * count }
            .clamp(count + 1.0, MOST_PIECES.min(4.0 * count));
    }
}

/// Curvature and its derivatives at the middle, for arc length 1: of a spiral, its parameters.
fn parameters(piece: &Segment) -> [f64; 4] {
    let length = piece.length();
    let mut scale = 1.0;
    piece.kappa().unwrap_or_else(|| {
        piece.curvature_jet(length / 2.0).map(|derivative| {
            scale *= length;
            derivative * scale
        })
    })
}

/// Each piece starts exactly where the one before ends.
fn joined(mut cubics: Vec<CubicBez>) -> Vec<CubicBez> {
    for i in 1..cubics.len() {
        cubics[i].p0 = cubics[i - 1].p3;
    }
    cubics
}

/// The best of the candidates for one piece, with its deviation (sampled, with a margin).
fn best_cubic(piece: &Segment) -> (CubicBez, f64) {
    let tangent = |s: f64| Vec2::from_angle(piece.direction(s));
    let (t0, t1) = (tangent(0.0), tangent(piece.length()));
    let mut arms = contact_arms(piece, t0, t1);
    arms.push([piece.length() / 3.0; 2]);
    let samples = Samples::of(piece);
    arms.into_iter()
        .map(|[a, b]| {
            let (start, end) = (piece.start(), piece.end());
            let cubic = CubicBez::new(start, start + t0 * a, end - t1 * b, end);
            (cubic, samples.deviation(&cubic))
        })
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or_else(|| {
            let chord = CubicBez::new(piece.start(), piece.start(), piece.end(), piece.end());
            (chord, f64::INFINITY)
        })
}

/// Arm lengths of the cubics in sixth-order contact, moved to those with exact ends.
fn contact_arms(piece: &Segment, t0: Vec2, t1: Vec2) -> Vec<[f64; 2]> {
    let h = piece.length();
    let [k0, k1, k2, k3] = parameters(piece);
    // All in units of the half length, in which the k of arc length 1 shrink by powers of 2.
    let (k0, k1, k2, k3) = (k0 / 2.0, k1 / 4.0, k2 / 8.0, k3 / 16.0);
    let a = k0 / 2.0;
    let b = k1 / 6.0;
    let c = (3.0 * k0.powi(3) + k2) / 24.0;
    let d = (19.0 * k0 * k0 * k1 + k3) / 120.0;
    let e = k0 * (45.0 * k0.powi(4) + 34.0 * k0 * k2 + 48.0 * k1 * k1) / 720.0;
    let contact = [3.0 * b * c - 2.0 * a * d, 9.0 * b * b - 6.0 * a * c, 3.0 * a * b, 2.0 * a * a];
    let mut candidates: Vec<(f64, [f64; 2])> = Vec::new();
    for alpha in roots_between(&contact, -2.0, 2.0) {
        // Two forms of the same; the better conditioned one.
        let (first, second) = (2.0 * a, 2.0 * a * alpha + 3.0 * b);
        let beta = if first.abs() >= second.abs() {
            -(a * alpha * alpha + 3.0 * b * alpha + c) / first
        } else {
            -(3.0 * b * alpha * alpha + 4.0 * c * alpha + d) / second
        };
        let e6 = a * beta * beta
            + b * (alpha.powi(3) + 6.0 * alpha * beta)
            + c * (6.0 * alpha * alpha + 4.0 * beta)
            + 5.0 * d * alpha
            + e;
        // From the expansion to arms, in units of the half length.
        let quadratic = beta + k0 * k0 / 6.0;
        let cubic = 2.0 * alpha * alpha - quadratic;
        let (from, to) = (-1.0 - alpha - cubic, 1.0 - alpha + cubic);
        let width = (to - from) / 3.0;
        let arm = |t: f64| width * (1.0 + 2.0 * alpha * t + 3.0 * quadratic * t * t);
        candidates.push((e6, [arm(from), arm(to)]));
    }
    candidates.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    candidates
        .into_iter()
        .take(2)
        .filter_map(|(e6, arms)| meet_ends(piece, t0, t1, arms.map(|arm| arm * h / 2.0), e6))
        .collect()
}

/// Newton's method for the arms at which the cubic's end curvatures are the curve's, but for the
/// shift that spreads the deviation evenly: ³⁄₂(κ + δ)a² + bS = T₀×d and its mirror.
fn meet_ends(piece: &Segment, t0: Vec2, t1: Vec2, start: [f64; 2], e6: f64) -> Option<[f64; 2]> {
    let h = piece.length();
    let chord = piece.end() - piece.start();
    // E₆ is in units of the half length: (h/2)⁴ of the formula leaves one 1/(h/2).
    let shift = -8.0 * (1.0 - MINIMAX_Q) * e6 / (h / 2.0);
    let (ka, kb) = (piece.curvature(0.0) + shift, piece.curvature(h) + shift);
    let s = t0.cross(t1);
    let (right_a, right_b) = (t0.cross(chord), chord.cross(t1));
    let [mut a, mut b] = start;
    for _ in 0..4 {
        let f = 1.5 * ka * a * a + b * s - right_a;
        let g = 1.5 * kb * b * b + a * s - right_b;
        let (fa, gb) = (3.0 * ka * a, 3.0 * kb * b);
        let determinant = fa * gb - s * s;
        if determinant.abs() < 1e-12 * (s * s).max((fa * gb).abs()).max(f64::MIN_POSITIVE) {
            break;
        }
        a -= (f * gb - g * s) / determinant;
        b -= (g * fa - f * s) / determinant;
    }
    let sane = |arm: f64| arm > 0.0 && arm < h;
    if sane(a) && sane(b) { Some([a, b]) } else { start.into_iter().all(sane).then_some(start) }
}

/// Places along a piece at which cubics are compared with it.
struct Samples {
    points: Vec<(f64, Point, Vec2)>,
}

impl Samples {
    /// Sixteen, denser toward the ends, where the deviation's outer lobes lie.
    fn of(piece: &Segment) -> Self {
        const COUNT: usize = 16;
        let points = (0..COUNT)
            .map(|i| {
                let angle = std::f64::consts::PI * (i as f64 + 0.75) / (COUNT as f64 + 0.5);
                let along = 0.5 - 0.5 * angle.cos();
                let s = along * piece.length();
                (along, piece.point(s), Vec2::from_angle(piece.direction(s)))
            })
            .collect();
        Samples { points }
    }

    /// The largest distance along a normal of the piece, with a margin for what lies between the
    /// samples; infinite where the normal misses the cubic.
    fn deviation(&self, cubic: &CubicBez) -> f64 {
        const MARGIN: f64 = 1.06;
        let velocity = cubic.deriv();
        let mut worst = 0.0f64;
        for &(along, point, tangent) in &self.points {
            let mut t = along;
            for _ in 0..4 {
                let ahead = (cubic.eval(t) - point).dot(tangent);
                let speed = velocity.eval(t).to_vec2().dot(tangent);
                t = (t - ahead / speed).clamp(0.0, 1.0);
            }
            let off = cubic.eval(t) - point;
            worst = worst.max(off.hypot() + off.dot(tangent).abs());
            if off.x.is_nan() {
                return f64::INFINITY;
            }
        }
        worst * MARGIN
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::segment::PolynomialSpiral;

    fn segment(k: [f64; 4], size: f64) -> Segment {
        let end = Point::new(size * 0.8, size * 0.6);
        Segment::spiral(Point::ZERO, end, PolynomialSpiral::new(k))
    }

    /// The true deviation of the cubics, by brute force in both directions.
    fn true_deviation(segment: &Segment, cubics: &[CubicBez]) -> f64 {
        let mut worst = 0.0f64;
        for cubic in cubics {
            for i in 0..=400 {
                let point = cubic.eval(f64::from(i) / 400.0);
                worst = worst.max(segment.nearest(point, 1e-3 * worst.max(1e-12)).1);
            }
        }
        worst
    }

    const SHAPES: [[f64; 4]; 9] = [
        [1.5, 0.0, 0.0, 0.0],
        [0.0, 2.4, 0.0, 0.0],
        [0.0, 12.0, 0.0, 0.0],
        [-3.0, 6.0, 0.0, 0.0],
        [1.2, -3.0, 9.0, 40.0],
        [0.5, 3.0, -60.0, 300.0],
        [6.0, 0.0, 0.0, 0.0],
        [1e-7, 1e-9, 0.0, 0.0],
        [0.0, 0.0, 0.0, 80.0],
    ];

    #[test]
    fn keeps_the_accuracy_over_decades() {
        for k in SHAPES {
            let segment = segment(k, 1000.0);
            for decade in -1..=6 {
                let accuracy = 10f64.powi(-decade);
                let cubics = cubics(&segment, accuracy);
                let error = true_deviation(&segment, &cubics);
                assert!(error <= accuracy, "{k:?} {accuracy:e}: {error:e}, {}", cubics.len());
            }
        }
    }

    #[test]
    fn converges_with_the_sixth_power() {
        let segment = segment([1.2, -3.0, 9.0, 40.0], 1000.0);
        let coarse = cubics(&segment, 1e-2).len() as f64;
        let fine = cubics(&segment, 1e-8).len() as f64;
        // Six decades cost a factor of 10.
        assert!(fine / coarse < 14.0, "{coarse} {fine}");
    }

    #[test]
    fn ends_are_exact_and_pieces_meet() {
        let segment = segment([0.5, 3.0, -60.0, 300.0], 1000.0);
        let cubics = cubics(&segment, 1e-4);
        assert_eq!(cubics[0].p0, segment.start());
        assert_eq!(cubics[cubics.len() - 1].p3, segment.end());
        assert!(cubics.windows(2).all(|pair| pair[0].p3 == pair[1].p0));
    }

    #[test]
    fn hopeless_accuracies_end() {
        let segment = segment([40.0, -300.0, 900.0, 9000.0], 1e-3);
        for accuracy in [0.0, -1.0, f64::NAN, 1e-300, f64::INFINITY] {
            assert!(!cubics(&segment, accuracy).is_empty());
        }
    }
}
