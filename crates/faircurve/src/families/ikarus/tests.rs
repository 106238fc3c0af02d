use std::f64::consts::PI;

use super::*;
use crate::catalog;
use crate::frame::{ChordAngles, wrap_angle};
use crate::segment::Shape;
use crate::two_param::curvature_map::SegmentContext;
use crate::two_param::shape::{SegmentEnds, SegmentShape};
use crate::{Contour, Segment, Status, solve};
use kurbo::Point;

fn drawn(theta0: f64, theta1: f64) -> Segment {
    let angles = ChordAngles::new(theta0, theta1);
    let ends = SegmentEnds { angles, curvatures: None, context: SegmentContext::UNIT };
    Biarcs.place(Point::ORIGIN, Point::new(1.0, 0.0), &ends)
}

fn members(segment: &Segment) -> &[Segment] {
    match segment.shape() {
        Shape::Chain(members) => members,
        shape => panic!("{shape:?}"),
    }
}

fn grid(limit: f64) -> impl Iterator<Item = (f64, f64)> {
    let at = move |i: i32| limit * f64::from(i) / 24.0;
    (-24..=24).flat_map(move |i| (-24..=24).map(move |j| (at(i), at(j))))
}

#[test]
fn biarcs_have_the_tangents_asked_for_and_none_at_the_joint_but_one() {
    for (theta0, theta1) in grid(PI - 1e-3) {
        let segment = drawn(theta0, theta1);
        let [a, b] = members(&segment) else { panic!("two arcs") };
        let directions = [
            wrap_angle(segment.direction(0.0) + theta0),
            wrap_angle(segment.direction(segment.length()) - theta1),
            wrap_angle(a.direction(a.length()) - b.direction(0.0)),
        ];
        for off in directions {
            assert!(off.abs() < 1e-10, "{theta0} {theta1}: {directions:?}");
        }
        assert_eq!(a.end(), b.start());
        // Arcs: the same curvature from end to end.
        assert_eq!(a.curvature(0.0), a.curvature(a.length()));
    }
}

#[test]
fn arms_are_equal_while_the_angles_differ_by_a_quarter_turn_at_most() {
    let arm = |arc: &Segment| {
        let turning = arc.direction(arc.length()) - arc.direction(0.0);
        arc.chord_length() / 2.0 / (turning / 2.0).cos()
    };
    for (theta0, theta1) in grid(PI - 1e-3).filter(|(a, b)| (a - b).abs() <= PI / 2.0) {
        let segment = drawn(theta0, theta1);
        let [a, b] = members(&segment) else { panic!("two arcs") };
        assert!((arm(a) - arm(b)).abs() < 1e-11 * arm(a), "{theta0} {theta1}");
    }
}

#[test]
fn biarcs_change_little_with_their_angles() {
    // Everywhere but where they close: no jump where one rule for the joint goes over to the other.
    let step = 1e-6;
    for (theta0, theta1) in grid(2.9) {
        let here = biarc(ChordAngles::new(theta0, theta1)).unwrap().joint;
        for (by0, by1) in [(step, 0.0), (0.0, step), (-step, step), (step, step)] {
            let there = biarc(ChordAngles::new(theta0 + by0, theta1 + by1)).unwrap().joint;
            assert!((here - there).norm() < 30.0 * step, "{theta0} {theta1}: {here} {there}");
        }
    }
}

#[test]
fn biarcs_mirror_and_reverse() {
    for (theta0, theta1) in grid(3.0) {
        let at = |theta0, theta1| biarc(ChordAngles::new(theta0, theta1)).unwrap();
        let (here, mirrored, reversed) =
            (at(theta0, theta1), at(-theta0, -theta1), at(-theta1, -theta0));
        assert!((here.joint - mirrored.joint.conj()).norm() < 1e-13);
        // Backwards, seen from the other end.
        assert!((here.joint + reversed.joint - 1.0).norm() < 1e-13, "{theta0} {theta1}");
    }
}

#[test]
fn what_closes_into_a_circle_has_no_biarc() {
    for (theta0, theta1) in [(PI, PI), (-PI, -PI), (PI, -PI), (-PI, PI)] {
        assert_eq!(biarc(ChordAngles::new(theta0, theta1)), None);
    }
    assert!(biarc(ChordAngles::new(PI, 0.0)).is_some());
    assert!(biarc(ChordAngles::new(0.0, -PI)).is_some());
}

/// "The biarc primitive cannot" incorporate inflections, so that they "must be explicitly marked"
/// (thesis section 4.5). Ours inflects by itself, at the joint: where the tangents lean to the same
/// side, and nowhere in between, since arcs have none.
#[test]
fn s_shaped_segments_inflect_at_the_joint() {
    for (theta0, theta1) in [(0.5, -0.3), (-0.2, 0.2), (1.2, -0.1), (-0.8, 1.0)] {
        let segment = drawn(theta0, theta1);
        let joint = members(&segment)[0].length();
        assert_eq!(segment.inflections(), [joint], "{theta0} {theta1}");
    }
    for (theta0, theta1) in [(0.5, 0.3), (0.2, 0.2), (-1.0, -0.5)] {
        assert!(drawn(theta0, theta1).inflections().is_empty(), "{theta0} {theta1}");
    }
    // It also does where both lean in, if one does so thrice as much: sin θ₁ > 3 sin θ₀.
    assert_eq!(drawn(0.1, 0.4).inflections().len(), 1);
    // No knot marks the inflection of this zigzag: the middle segments have it.
    let contour = Contour::open([(0.0, 0.0), (1.0, 1.0), (2.0, 0.0), (3.0, 1.0), (4.0, 0.0)]);
    let solution = solve(&contour, &*catalog::spline("ikarus").unwrap()).unwrap();
    let inflections = solution.curve.segments().iter().map(|s| s.inflections().len());
    assert_eq!(inflections.collect::<Vec<_>>()[1..3], [1, 1]);
}

#[test]
fn even_points_of_a_circle_give_the_circle() {
    for n in 3..20 {
        let on_circle = |i: i32| {
            let angle = 2.0 * PI * f64::from(i) / f64::from(n);
            Point::new(7.0 * angle.cos(), 7.0 * angle.sin())
        };
        let contour = Contour::closed((0..n).map(on_circle));
        let solution = solve(&contour, &*catalog::spline("ikarus").unwrap()).unwrap();
        for segment in solution.curve.segments() {
            for i in 0..=8 {
                let point = segment.point(segment.length() * f64::from(i) / 8.0);
                assert!((point.to_vec2().hypot() - 7.0).abs() < 1e-13 * 7.0, "{n}");
            }
        }
    }
}

#[test]
fn free_ends_may_be_arcs() {
    let points = [(0.0, 0.0), (4.0, 1.0), (5.0, 3.0), (4.0, 5.0)];
    let spline = catalog::build("ikarus", &Params::new().with("end", "arc")).unwrap();
    let solution = solve(&Contour::open(points), &*spline).unwrap();
    for i in [0, 2] {
        let segment = &solution.curve.segments()[i];
        let (start, end) = (segment.curvature(0.0), segment.curvature(segment.length()));
        assert!((start - end).abs() < 1e-13, "{start} {end}");
    }
    assert_eq!(solution.report.status(), Status::Solved);
}

#[test]
fn a_tangent_that_no_biarc_keeps_is_said() {
    let mut contour = Contour::open([(0.0, 0.0), (1.0, 0.0)]);
    contour.knots[0].tangent_out = Some(Vec2::new(-1.0, 0.0));
    contour.knots[1].tangent_in = Some(Vec2::new(-1.0, 0.0));
    let solution = solve(&contour, &*catalog::spline("ikarus").unwrap()).unwrap();
    assert_eq!(solution.report.relaxed.len(), 2);
    assert!(solution.report.relaxed.iter().all(|r| r.asked == "tangent" && r.got == "free"));
    assert!(solution.curve.segments()[0].is_line());
}
