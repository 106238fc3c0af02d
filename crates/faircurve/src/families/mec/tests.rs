use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use kurbo::Vec2;

use super::*;
use crate::outline::{Contour, Knot};
use crate::spline::{Solution, Status, solve};

fn angles(theta0: f64, theta1: f64) -> ChordAngles {
    ChordAngles::new(theta0, theta1)
}

fn mec(contour: &Contour, penalty: f64) -> Solution {
    let params = Params::new().with(PENALTY, penalty);
    solve(contour, &*crate::catalog::build("mec", &params).unwrap()).unwrap()
}

fn energy(solution: &Solution, penalty: f64) -> f64 {
    solution.curve.bending_energy() + penalty * solution.curve.length()
}

#[test]
fn curvatures_answer_changes_of_angles() {
    for constant in [0.0, -3.0, -40.0, 1.5] {
        let map = Elasticas { constant };
        for (theta0, theta1) in [(0.0, 0.0), (0.3, 0.3), (1e-9, 0.0), (1.1, -0.7), (-1.2, 0.2)] {
            let exact = map.curvatures(angles(theta0, theta1), &SegmentContext::UNIT);
            for angle in 0..2 {
                let h = 1e-5;
                let at = |sign: f64| {
                    let mut moved = [theta0, theta1];
                    moved[angle] += sign * h;
                    map.curvatures(angles(moved[0], moved[1]), &SegmentContext::UNIT)
                };
                let (up, down) = (at(1.0), at(-1.0));
                for end in 0..2 {
                    let slope = (up.value[end].num - down.value[end].num) / (2.0 * h);
                    let off = (slope - exact.by_angle[end][angle].num).abs();
                    assert!(
                        off < 1e-7 * (1.0 + slope.abs()),
                        "{constant} {theta0} {theta1} {off:e}"
                    );
                }
            }
        }
    }
}

/// The fit from the straight line is the one that continues it, found by following it in small steps;
/// and where following ends there is none.
#[test]
fn the_fit_continues_the_straight_line() {
    use segment::{Asked, Last, newton};
    for constant in [0.0, -2.0, 2.0, -30.0] {
        for i in -8..=8 {
            for j in -8..=8 {
                let end = [f64::from(i), f64::from(j)].map(|n| n * 0.27 + 0.013);
                let mut followed = Some([0.0, 0.0, constant]);
                for step in 1..=40 {
                    let t = f64::from(step) / 40.0;
                    let here = angles(t * end[0], t * end[1]);
                    // Only while it is still on the sheet of the straight line.
                    let is_there = segment::fit(here, constant).is_ok();
                    followed = followed
                        .filter(|_| is_there)
                        .and_then(|state| {
                            newton(&Asked::new(here, Last::Constant(constant)), state)
                        })
                        .map(|fit| fit.state);
                }
                let direct = segment::fit(angles(end[0], end[1]), constant).ok();
                assert_eq!(direct.is_some(), followed.is_some(), "{constant} {end:?}");
                if let (Some(direct), Some(followed)) = (direct, followed) {
                    for (a, b) in direct.state.into_iter().zip(followed) {
                        assert!((a - b).abs() < 1e-8 * (1.0 + b.abs()), "{constant} {end:?}");
                    }
                }
            }
        }
    }
}

/// A segment alone has least energy among the elastica of its end tangents near it.
#[test]
fn a_segment_has_least_energy_of_all_lengths() {
    for (theta0, theta1) in [(0.5, 0.9), (-0.8, 1.0), (1.3, 1.2)] {
        let least = fit_mec(angles(theta0, theta1), 0.0).unwrap();
        let of = |s: &MecSegment| s.elastica.arc_energy() * s.length.recip();
        for factor in [0.97, 0.99, 1.01, 1.03] {
            let length = 1.0 + (least.length - 1.0) * factor;
            let other = fit_of_length(angles(theta0, theta1), length).unwrap();
            assert!((other.length - length).abs() < 1e-11);
            assert!(of(&other) > of(&least) * (1.0 + 1e-8), "{theta0} {theta1} {factor}");
        }
    }
}

/// Of any penalty the curve found costs less than those of other penalties do.
#[test]
fn a_penalty_is_what_it_says() {
    let contour = Contour::open([(0.0, 0.0), (4.0, 1.0), (5.0, 3.0), (4.0, 5.0), (1.0, 5.5)]);
    let penalties = [0.0, 0.05, 0.3, 2.0, 20.0];
    for own in penalties {
        let least = mec(&contour, own);
        assert_eq!(least.report.status(), Status::Solved, "{own}: {:?}", least.report.relaxed);
        for other in penalties.into_iter().filter(|other| *other != own) {
            let more = energy(&mec(&contour, other), own) - energy(&least, own);
            assert!(more > 1e-9, "{own} {other} {more:e}");
        }
    }
    // It is in the drawing's units: twice as large, a fourth as much.
    let twice = Contour::open(
        contour.knots.iter().map(|knot| knot.point.to_vec2() * 2.0).map(|v| (v.x, v.y)),
    );
    let (small, large) = (mec(&contour, 2.0), mec(&twice, 0.5));
    assert!((2.0 * small.curve.length() - large.curve.length()).abs() < 1e-12);
}

#[test]
fn where_there_is_none_the_euler_spiral_stands_in_and_says_why() {
    // Figure 2.6: more than a right angle at both ends.
    let [start, end] = [-1.8, 1.8].map(Vec2::from_angle);
    let knots = [Knot::new((0.0, 0.0)).tangent(start), Knot::new((1.0, 0.0)).tangent(end)];
    let contour = Contour::open(knots);
    let solution = mec(&contour, 0.0);
    let [relaxed] = solution.report.relaxed.as_slice() else {
        panic!("{:?}", solution.report.relaxed)
    };
    assert_eq!((relaxed.place, relaxed.asked, relaxed.got), (Place::Segment(0), "mec", "euler"));
    assert!(relaxed.reason.contains("grow without end"), "{}", relaxed.reason);
    assert!(relaxed.reason.contains("90° and 90°"), "{}", relaxed.reason);
    let params = Params::new().with("end", "zero-curvature");
    let euler = crate::catalog::build("euler", &params).unwrap();
    let euler = solve(&contour, &*euler).unwrap();
    assert_eq!(euler.curve.length(), solution.curve.length());
    // With a penalty there is one.
    assert_eq!(mec(&contour, 3.0).report.status(), Status::Solved);
    let far_too_much = mec(&contour, 1e9);
    assert!(far_too_much.report.relaxed[0].reason.contains("lower `penalty`"));
}

/// Thesis 3.8: a knot pushes across the strip only, by the jump of κ′; all forces sum to zero.
#[test]
fn forces_are_in_equilibrium() {
    let contour = Contour::open([(0.0, 0.0), (4.0, 1.0), (5.0, 3.0), (4.0, 5.0), (1.0, 5.5)]);
    for penalty in [0.0, 0.4] {
        let solution = mec(&contour, penalty);
        let forces: Vec<Vec2> = forces_at_knots(&solution.curve).into_iter().flatten().collect();
        assert_eq!(forces.len(), 5);
        let sum = forces.iter().fold(Vec2::ZERO, |sum, force| sum + *force);
        assert!(sum.hypot() < 1e-13);
        for i in 1..4 {
            let tangent = Vec2::from_angle(solution.knots[i].direction_out.unwrap());
            let [before, after] = [i - 1, i].map(|i| &solution.curve.segments()[i]);
            let jump = after.curvature_jet(0.0)[1] - before.curvature_jet(before.length())[1];
            assert!(forces[i].dot(tangent).abs() < 1e-12, "{penalty} {i}");
            assert!((tangent.cross(forces[i]) - jump).abs() < 1e-12, "{penalty} {i}");
        }
    }
    let euler = solve(&contour, &*crate::catalog::spline("euler").unwrap()).unwrap();
    assert!(forces_at_knots(&euler.curve).iter().all(Option::is_none));
}

/// Figure 3.10: λ from 0.342 where the ends meet, to ½, to the half circle, to ¼.
#[test]
fn lambda_by_chord_length() {
    let lambda = |chord: f64| {
        fit_of_length(angles(FRAC_PI_2, FRAC_PI_2), 1.0 / chord).unwrap().elastica.lambda()
    };
    assert!((lambda(1e-4) - 0.341_911_657_134_859).abs() < 1e-4, "{}", lambda(1e-4));
    assert!(lambda(2.0 / PI) < 1e-7);
    assert!((lambda(0.95) - 0.25).abs() < 1e-6);
    // The rectangular elastica between its inflections.
    let quarter = crate::numeric::elastica::Elastica::with_lambda(0.5).quarter_period();
    let chord = crate::numeric::elastica::Elastica::with_lambda(0.5).at(quarter).point.re / quarter;
    assert!((lambda(chord) - 0.5).abs() < 1e-9, "{}", lambda(chord));
}

#[test]
fn every_solution_is_one_and_the_principal_one_is_among_them() {
    for (theta0, theta1, length) in [(FRAC_PI_4, FRAC_PI_4, 1.3), (0.9, -0.4, 1.6), (0.2, 1.4, 2.5)]
    {
        let ends = angles(theta0, theta1);
        let all = all_of_length(ends, length, 3);
        let principal = fit_of_length(ends, length).unwrap();
        let is_principal = |s: &MecSegment| {
            (s.elastica.curvature() - principal.elastica.curvature()).abs() < 1e-8
                && (s.elastica.slope() - principal.elastica.slope()).abs() < 1e-7
        };
        assert!(all.iter().any(is_principal), "{theta0} {theta1}");
        assert!(all.len() >= 6, "{}", all.len());
        for solution in &all {
            let segment = Segment::elastica(Point::ZERO, Point::new(1.0, 0.0), solution.elastica);
            let bound = 1e-11 * (1.0 + solution.elastica.constant().abs());
            assert!((segment.length() - length).abs() < bound);
            let off = |angle: f64| crate::frame::wrap_angle(angle).abs();
            assert!(off(segment.direction(0.0) + theta0) < bound);
            assert!(off(segment.direction(segment.length()) - theta1) < bound);
        }
    }
    // Figure 3.11: some lack the symmetry that the ends have.
    let all = all_rectangular(angles(FRAC_PI_4, FRAC_PI_4), 4);
    assert!(all.iter().any(|s| s.elastica.slope().abs() > 1e-3));
    assert!(all.iter().filter(|s| s.elastica.slope().abs() < 1e-8).count() >= 3);
    assert!(all.iter().all(|s| (s.elastica.lambda() - 0.5).abs() < 1e-10));
}

#[test]
fn given_ends_are_met() {
    let tangent = Vec2::from_angle(0.4);
    let knots =
        [Knot::new((0.0, 0.0)).tangent(tangent), Knot::new((2.0, 1.0)), Knot::new((4.0, 0.0))];
    let solution = mec(&Contour::open(knots), 0.0);
    assert_eq!(solution.report.status(), Status::Solved);
    assert!((solution.knots[0].direction_out.unwrap() - 0.4).abs() < 1e-13);
    assert!(solution.knots[2].curvature_in.unwrap().abs() < 1e-13);
}
