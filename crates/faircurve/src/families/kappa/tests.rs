use super::bi_parabola::BiParabolas;
use crate::frame::ChordAngles;
use crate::two_param::curvature_map::{CurvatureMap, EndCurvatures, SegmentContext};
use kurbo::Point;

use crate::two_param::shape::{SegmentEnds, SegmentShape};
use std::f64::consts::PI;

const ANGLES: [f64; 8] = [-2.9, -1.7, -0.93, -0.31, 0.43, 1.12, 1.83, 2.6];

fn map(theta0: f64, theta1: f64) -> EndCurvatures {
    BiParabolas.curvatures(ChordAngles::new(theta0, theta1), &SegmentContext::UNIT)
}

#[test]
fn derivatives_agree_with_differences() {
    let h = 1e-6;
    for theta0 in ANGLES {
        for theta1 in ANGLES {
            let exact = map(theta0, theta1);
            for angle in 0..2 {
                let (a, b) = if angle == 0 { (h, 0.0) } else { (0.0, h) };
                let (up, down) = (map(theta0 + a, theta1 + b), map(theta0 - a, theta1 - b));
                for end in 0..2 {
                    let num = (up.value[end].num - down.value[end].num) / (2.0 * h);
                    let den = (up.value[end].den - down.value[end].den) / (2.0 * h);
                    let claimed = exact.by_angle[end][angle];
                    let off = (num - claimed.num).abs().max((den - claimed.den).abs());
                    let size = 1.0 + claimed.num.abs() + claimed.den.abs();
                    assert!(off < 1e-6 * size, "{theta0} {theta1} {end} {angle}: {off:e}");
                }
            }
        }
    }
}

/// Bespoke 2.2.
#[test]
fn the_map_is_periodic() {
    for theta0 in ANGLES {
        for theta1 in ANGLES {
            let (here, there) = (map(theta0, theta1), map(theta0 + PI, theta1));
            for (end, sign) in [(0, -1.0), (1, 1.0)] {
                let (a, b) = (here.value[end], there.value[end]);
                assert!((a.num - sign * b.num).abs() < 1e-12, "{theta0} {theta1}");
                assert!((a.den - sign * b.den).abs() < 1e-12, "{theta0} {theta1}");
            }
        }
    }
}

/// An oracle: the placed parabolas, measured.
#[test]
fn the_segment_has_the_curvatures_of_the_map_and_vertices_at_its_ends() {
    for theta0 in ANGLES {
        for theta1 in ANGLES {
            let angles = ChordAngles::new(theta0, theta1);
            let ends = SegmentEnds { angles, curvatures: None, context: SegmentContext::UNIT };
            let segment = BiParabolas.place(Point::ORIGIN, Point::new(1.0, 0.0), &ends);
            let map = map(theta0, theta1);
            for (end, s) in [(0, 0.0), (1, segment.length())] {
                let jet = segment.curvature_jet(s);
                let expected = map.value[end].num / map.value[end].den;
                // Backwards where the denominator is negative: den has the sign of the travel.
                let off = (jet[0] - expected).abs();
                assert!(off < 1e-11 * (1.0 + expected.abs()), "{angles:?} {off:e}");
                assert!(jet[1].abs() < 1e-9 * (1.0 + expected * expected), "{angles:?}");
            }
        }
    }
}
