//! Times of the integral, the segment fit and the two splines.
//!
//! ```sh
//! cargo bench -p faircurve                # everything
//! cargo bench -p faircurve -- splines     # one group
//! ```

use std::f64::consts::TAU;

use divan::Bencher;
use divan::counter::ItemsCount;

fn main() {
    divan::main();
}

/// Numbers in [−1, 1), the same in every run.
fn random() -> impl FnMut() -> f64 {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// How many arguments one iteration goes through: the times shown are of so many, in µs per
/// thousand, which is ns each.
const BATCH: usize = 1000;

mod integral {
    use super::*;
    use faircurve::numeric::fresnel::fresnel;
    use faircurve::numeric::spiro_integral::{spiro_integral, spiro_moments, wildness};
    use faircurve::numeric::spiro_series::spiro_series_subdivided;

    /// Segments of a calm glyph, of a lively one, and what Newton's method may pass on its way.
    const WILDNESS: [f64; 5] = [0.1, 2.0, 10.0, 50.0, 1000.0];

    fn arguments(wild: f64) -> Vec<[f64; 4]> {
        let mut next = random();
        let direction = |_| [next(), 2.0 * next(), 8.0 * next(), 48.0 * next()];
        let scaled = |k: [f64; 4]| k.map(|k_j| k_j * wild / wildness(k));
        (0..BATCH).map(direction).map(scaled).collect()
    }

    #[divan::bench(args = WILDNESS)]
    fn alone(bencher: Bencher<'_, '_>, wild: f64) {
        over(bencher, &arguments(wild), |k| spiro_integral(*k));
    }

    #[divan::bench(args = WILDNESS)]
    fn with_all_moments(bencher: Bencher<'_, '_>, wild: f64) {
        over(bencher, &arguments(wild), |k| spiro_moments(*k));
    }

    #[divan::bench(args = [1, 2, 4])]
    fn order_12_series(bencher: Bencher<'_, '_>, pieces: usize) {
        over(bencher, &arguments(2.0), |k| spiro_series_subdivided::<12>(*k, pieces));
    }

    #[divan::bench(args = [1.0, 10.0, 1e6])]
    fn fresnel_up_to(bencher: Bencher<'_, '_>, largest: f64) {
        let mut next = random();
        let places: Vec<f64> = (0..BATCH).map(|_| next() * largest).collect();
        over(bencher, &places, |x| fresnel(*x));
    }
}

mod segment {
    use super::*;
    use faircurve::families::euler::fit_euler;
    use faircurve::frame::ChordAngles;
    use faircurve::kurbo::Point;
    use faircurve::{PolynomialSpiral, Segment};

    /// The Euler spiral from chord angles up to a largest one: nearly straight, as in glyphs, the
    /// whole square.
    #[divan::bench(args = [0.01, 1.0, 3.1])]
    fn fit_euler_up_to(bencher: Bencher<'_, '_>, largest: f64) {
        let mut next = random();
        let angles: Vec<ChordAngles> =
            (0..BATCH).map(|_| ChordAngles::new(largest * next(), largest * next())).collect();
        over(bencher, &angles, |angles| fit_euler(*angles));
    }

    /// A point on a polynomial spiral.
    #[divan::bench]
    fn point(bencher: Bencher<'_, '_>) {
        let spiral = PolynomialSpiral::new([1.2, -3.0, 9.0, 40.0]);
        let segment = Segment::spiral(Point::new(3.0, -2.0), Point::new(40.0, 25.0), spiral);
        let mut next = random();
        let places: Vec<f64> =
            (0..BATCH).map(|_| segment.length() * (0.5 + 0.5 * next())).collect();
        over(bencher, &places, |s| segment.point(*s));
    }
}

mod splines {
    use super::*;
    use faircurve::{Contour, Join, Knot, catalog, solve};

    const KNOTS: [usize; 6] = [4, 16, 64, 256, 1024, 4096];

    /// Knots around a circle, each moved along and across it by up to a tenth of their spacing.
    fn jittered_circle(count: usize, closed: bool, join: Join) -> Contour {
        let mut next = random();
        let spacing = TAU / count as f64;
        let knot = |i: usize| {
            let angle = spacing * (i as f64 + 0.1 * next());
            let radius = 500.0 * (1.0 + 0.1 * spacing * next());
            Knot::new((radius * angle.cos(), radius * angle.sin())).join(join)
        };
        let knots: Vec<Knot> = (0..count).map(knot).collect();
        Contour { knots, closed }
    }

    fn bench(bencher: Bencher<'_, '_>, name: &str, contour: &Contour) {
        let Ok(spline) = catalog::spline(name) else { return };
        bencher
            .counter(ItemsCount::new(contour.knots.len()))
            .bench(|| solve(divan::black_box(contour), &*spline));
    }

    #[divan::bench(args = KNOTS)]
    fn euler_open(bencher: Bencher<'_, '_>, count: usize) {
        bench(bencher, "euler", &jittered_circle(count, false, Join::G2));
    }

    #[divan::bench(args = KNOTS)]
    fn euler_closed(bencher: Bencher<'_, '_>, count: usize) {
        bench(bencher, "euler", &jittered_circle(count, true, Join::G2));
    }

    #[divan::bench(args = KNOTS)]
    fn mec_closed(bencher: Bencher<'_, '_>, count: usize) {
        bench(bencher, "mec", &jittered_circle(count, true, Join::G2));
    }

    #[divan::bench(args = KNOTS)]
    fn simec_closed(bencher: Bencher<'_, '_>, count: usize) {
        bench(bencher, "simec", &jittered_circle(count, true, Join::G2));
    }

    #[divan::bench(args = KNOTS)]
    fn mvc_closed_g4(bencher: Bencher<'_, '_>, count: usize) {
        bench(bencher, "mvc", &jittered_circle(count, true, Join::G4));
    }

    #[divan::bench(args = KNOTS)]
    fn spiro_open_g2(bencher: Bencher<'_, '_>, count: usize) {
        bench(bencher, "spiro", &jittered_circle(count, false, Join::G2));
    }

    #[divan::bench(args = KNOTS)]
    fn spiro_closed_g2(bencher: Bencher<'_, '_>, count: usize) {
        bench(bencher, "spiro", &jittered_circle(count, true, Join::G2));
    }

    #[divan::bench(args = KNOTS)]
    fn spiro_open_g4(bencher: Bencher<'_, '_>, count: usize) {
        bench(bencher, "spiro", &jittered_circle(count, false, Join::G4));
    }

    #[divan::bench(args = KNOTS)]
    fn spiro_closed_g4(bencher: Bencher<'_, '_>, count: usize) {
        bench(bencher, "spiro", &jittered_circle(count, true, Join::G4));
    }
}

/// Evaluates over a whole batch, so that the clock's grain doesn't matter.
fn over<T, R>(bencher: Bencher<'_, '_>, arguments: &[T], evaluate: impl Fn(&T) -> R + Sync)
where
    T: Sync,
{
    bencher.counter(ItemsCount::new(arguments.len())).bench(|| {
        for argument in arguments {
            divan::black_box(evaluate(divan::black_box(argument)));
        }
    });
}
