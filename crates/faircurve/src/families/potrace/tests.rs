use std::f64::consts::PI;

use super::*;

#[test]
fn arms_are_the_same_part_of_the_way_to_where_the_tangents_meet() {
    for (theta0, theta1) in [(0.3f64, 0.5f64), (0.9, 0.4), (1.2, 1.6), (-0.7, -0.8)] {
        let [a, b] = potrace_arms(ChordAngles::new(theta0, theta1));
        let turning: f64 = theta0 + theta1;
        let alpha = 4.0 / 3.0 * (turning / 4.0).tan() / (turning / 2.0).tan();
        let distances = [theta1, theta0].map(|theta| theta.sin() / turning.sin());
        assert!((a - alpha * distances[0]).abs() < 1e-14, "{theta0} {theta1}");
        assert!((b - alpha * distances[1]).abs() < 1e-14, "{theta0} {theta1}");
        assert!(alpha > 0.0 && alpha < 2.0 / 3.0);
    }
}

#[test]
fn symmetric_segments_have_their_middle_on_the_arc() {
    for theta in [1e-9, 0.3, PI / 4.0, 1.5, PI / 2.0, 2.0, 2.5] {
        let ends = SegmentEnds {
            angles: ChordAngles::new(theta, theta),
            curvatures: None,
            context: crate::two_param::curvature_map::SegmentContext::UNIT,
        };
        let segment = PotraceCubics.place(Point::ORIGIN, Point::new(2.0, 0.0), &ends);
        let middle = segment.point(segment.length() / 2.0);
        // Half the chord times the tangent of half the angle.
        assert!((middle - Point::new(1.0, -(theta / 2.0).tan())).hypot() < 1e-12, "{theta}");
    }
}

#[test]
fn arms_are_finite_and_never_vanish() {
    let mut angles: Vec<f64> = (-16..=16).map(|i| f64::from(i) * PI / 16.0).collect();
    angles.extend([1e-300, -1e-16, PI - 1e-15, 7.0]);
    for &theta0 in &angles {
        for &theta1 in &angles {
            let arms = potrace_arms(ChordAngles::new(theta0, theta1));
            assert!(arms.iter().all(|arm| (0.1..=4.0).contains(arm)), "{theta0} {theta1} {arms:?}");
        }
    }
}
