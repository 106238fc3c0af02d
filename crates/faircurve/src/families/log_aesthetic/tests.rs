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
        for (theta0, theta1) in
            [(0.31, 0.3), (0.3, -0.8), (1.5, 1.4), (-2.5, 1.0), (2.8, 2.0), (-1e-3, 2e-3), (0.2, 0.2)]
        {
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
                    assert!(off < 1e-6, "{alpha}: {theta0} {theta1} {end} {angle}: {slope} {claimed}");
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
