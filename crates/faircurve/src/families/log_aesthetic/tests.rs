use super::*;
use crate::families::euler::fit_euler;
use crate::frame::ChordAngles;
use crate::segment::UnitCurve;
use crate::two_param::curvature_map::{CurvatureMap, SegmentContext};
use crate::two_param::generating::{Cut, GeneratingCurve, chord_angles};

const ALPHAS: [f64; 10] = [0.1, 0.2, 0.5, 0.9, 1.0, 1.5, 1.78, 3.0, 6.0, 10.0];

/// Every cut has the angles asked for, and is near the ends of the square too.
#[test]
fn cuts_have_their_angles_over_the_whole_square() {
    let n = 40;
    let limit = Cuts { curve: LogAesthetic::new(1.0) }.limit();
    for alpha in ALPHAS {
        let curve = LogAesthetic::new(alpha);
        let mut worst = (0.0f64, 0.0, 0.0);
        for i in 0..=n {
            for j in -n..=n {
                let theta1 = limit * f64::from(i) / f64::from(n);
                let theta0 = theta1 * f64::from(j) / f64::from(n);
                let Some(cut) = curve.cut(ChordAngles::new(theta0, theta1)) else {
                    panic!("{alpha}: no cut for {theta0} {theta1}");
                };
                let found = chord_angles(&cut);
                let error = (found.theta0 - theta0).abs().max((found.theta1 - theta1).abs());
                let error = error * cut.point(1.0).norm();
                if error > worst.0 {
                    worst = (error, theta0, theta1);
                }
            }
        }
        assert!(worst.0 < 4e-15, "{alpha}: {worst:?}");
    }
}

#[test]
fn alpha_1_is_the_euler_spiral() {
    let curve = Cuts { curve: LogAesthetic::new(1.0) };
    for i in -20..=20 {
        for j in -20..=20 {
            let angles = ChordAngles::new(f64::from(i) * 0.15, f64::from(j) * 0.15);
            let spiral = fit_euler(angles).unwrap();
            let Some(unit) = curve.unit(angles) else { panic!("{angles:?}") };
            let chord = spiral.chord().length;
            let [k0, k1, ..] = spiral.k;
            let size = 1.0 + k0.abs() + k1.abs();
            for (s, at) in [(0.0, -0.5), (unit.length(), 0.5)] {
                let off = unit.curvature_jet(s)[0] - chord * (k0 + at * k1);
                assert!(off.abs() < 1e-13 * size, "{angles:?} {off:e}");
            }
        }
    }
}

#[test]
fn derivatives_agree_with_differences() {
    for alpha in ALPHAS {
        let map = Cuts { curve: LogAesthetic::new(alpha) };
        for (theta0, theta1) in [
            (0.31, 0.3),
            (0.3, -0.8),
            (1.5, 1.4),
            (-2.5, 1.0),
            (2.8, 2.0),
            (-1e-3, 2e-3),
            (0.2, 0.2),
        ] {
            let exact = map.curvatures(ChordAngles::new(theta0, theta1), &SegmentContext::UNIT);
            let h = 1e-6;
            for angle in 0..2 {
                let at = |sign: f64| {
                    let mut angles = [theta0, theta1];
                    angles[angle] += sign * h;
                    map.curvatures(ChordAngles::new(angles[0], angles[1]), &SegmentContext::UNIT)
                };
                let (up, down) = (at(1.0), at(-1.0));
                for end in 0..2 {
                    let slope = (up.value[end].num - down.value[end].num) / (2.0 * h);
                    let claimed = exact.by_angle[end][angle].num;
                    let off = (slope - claimed).abs() / (1.0 + slope.abs());
                    assert!(
                        off < 1e-6,
                        "{alpha}: {theta0} {theta1} {end} {angle}: {slope} {claimed}"
                    );
                }
            }
        }
    }
}

/// The cut is the one that continues the straight line: followed in small steps, it never jumps.
#[test]
fn cuts_continue_the_straight_line() {
    let limit = Cuts { curve: LogAesthetic::new(1.0) }.limit();
    for alpha in ALPHAS {
        let curve = LogAesthetic::new(alpha);
        for j in -16..=16 {
            let ratio = f64::from(j) / 16.0;
            let mut last: Option<[f64; 2]> = None;
            for i in 1..=300 {
                let theta1 = limit * f64::from(i) / 300.0;
                let cut = curve.cut(ChordAngles::new(ratio * theta1, theta1)).unwrap();
                // Changes that are larger than slopes allow belong to another winding.
                let end = cut.curvature_jet(1.0)[0];
                let start = cut.curvature_jet(0.0)[0] / end;
                let ends = [start.signum() * start.abs().powf(1.0 / alpha), end / (alpha + 1.0)];
                if let Some(last) = last {
                    let jump = (ends[0] - last[0]).abs().max((ends[1] - last[1]).abs());
                    assert!(jump < 0.3, "{alpha}: {ratio} {theta1}: {last:?} {ends:?}");
                }
                last = Some(ends);
            }
        }
    }
}

#[test]
fn whatever_alpha_and_the_knots_numbers_are_finite() {
    use crate::{Contour, catalog, catalog::Params, solve};
    let hard = [
        Contour::open([(0.0, 0.0), (1.0, 0.0), (1.0, 1e-9), (-3.0, 0.5), (-3.0, -1e12)]),
        Contour::open([(0.0, 0.0), (1e-9, 1e-9), (1e9, 0.0), (1e9, 1e-9), (0.0, 1e-8)]),
        Contour::closed([(0.0, 0.0), (1.0, 0.0), (0.0, 0.0), (1.0, 1.0), (1.0, 0.0)]),
        Contour::closed([(0.0, 0.0), (1.0, 0.0)]),
        Contour::open((0..8).map(|i| (f64::from(i * i % 5), f64::from(i * 3 % 7)))),
        Contour::open((0..9).map(|i| (f64::from(i), f64::from(i / 8)))),
    ];
    for alpha in ALPHAS {
        for end in ["arc", "zero-curvature"] {
            let params = Params::new().with("alpha", alpha).with("end", end);
            let spline = catalog::build("log-aesthetic", &params).unwrap();
            for contour in &hard {
                let solution = solve(contour, &*spline).unwrap();
                assert!(solution.report.residual.is_finite(), "{alpha}");
                for segment in solution.curve.segments() {
                    let numbers =
                        [segment.length(), segment.bending_energy(), segment.direction(0.0)];
                    assert!(numbers.into_iter().all(f64::is_finite), "{alpha}: {segment:?}");
                    assert!(segment.point(segment.length() / 3.0).is_finite(), "{alpha}");
                    assert!(segment.curvature_jet(0.0).into_iter().all(f64::is_finite), "{alpha}");
                }
            }
        }
    }
}

/// A knot on the curve changes nothing, whatever α.
#[test]
fn every_alpha_is_extensional_and_round() {
    /// Below, curvature beside an inflection changes faster than tangents can say.
    const STEEP: f64 = 0.2;
    use crate::{Contour, catalog, catalog::Params, solve};
    let points = [(0.0, 0.0), (1.0, 0.7), (2.0, 0.6), (2.5, -0.5), (3.7, -0.4), (4.0, 1.0)];
    for alpha in ALPHAS.into_iter().filter(|alpha| *alpha >= STEEP) {
        let spline = catalog::build("log-aesthetic", &Params::new().with("alpha", alpha)).unwrap();
        let before = solve(&Contour::open(points), &*spline).unwrap();
        assert!(before.report.relaxed.is_empty(), "{alpha}: {:?}", before.report);
        for i in 0..5 {
            let segment = &before.curve.segments()[i];
            let mut longer = Contour::open(points);
            let added = segment.point(0.3 * segment.length());
            longer.knots.insert(i + 1, crate::Knot::new(added));
            let after = solve(&longer, &*spline).unwrap();
            for segment in before.curve.segments() {
                for part in [0.0, 0.25, 0.5, 0.75] {
                    let point = segment.point(part * segment.length());
                    let (_, _, off) = after.curve.nearest(point, 1e-11).unwrap();
                    assert!(off < 1e-8, "{alpha}: {off:e}");
                }
            }
        }
        let circle = [0.0, 1.0, 2.5, 3.0].map(|t: f64| (t.cos(), t.sin()));
        let round = solve(&Contour::closed(circle), &*spline).unwrap();
        assert!((round.curve.length() - std::f64::consts::TAU).abs() < 1e-12, "{alpha}");
    }
}
