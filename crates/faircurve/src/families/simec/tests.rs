use std::f64::consts::TAU;

use kurbo::{Point, Vec2};

use super::*;
use crate::outline::Contour;
use crate::segment::Segment;
use crate::spline::{Solution, Status, solve};

fn solved(contour: &Contour) -> Solution {
    let solution = solve(contour, &*crate::catalog::spline("simec").unwrap()).unwrap();
    assert_eq!(solution.report.status(), Status::Solved, "{:?}", solution.report.relaxed);
    solution
}

fn energy(solution: &Solution) -> f64 {
    solution.curve.segments().iter().map(Segment::bending_energy).sum()
}

#[test]
fn knots_on_a_circle_give_the_circle() {
    for n in 3..20 {
        let knot = |i: usize| {
            Point::ZERO + Vec2::from_angle(TAU * (i as f64 + 0.2 * (i as f64).sin()) / n as f64)
        };
        let solution = solved(&Contour::closed((0..n).map(knot)));
        for i in 0..100 {
            let s = solution.curve.length() * f64::from(i) / 100.0;
            let off = solution.curve.at(s).unwrap().point.to_vec2().hypot() - 1.0;
            assert!(off.abs() < 1e-12, "{n}: {off:e}");
        }
    }
}

/// Of all penalties, energy times length is least at the right one.
#[test]
fn energy_times_length_is_least() {
    let knots = [(0.0, 0.0), (4.0, 1.0), (5.0, 3.0), (4.0, 5.0), (1.0, 5.5), (0.0, 3.5)];
    let contour = Contour::open(knots);
    let ours = solved(&contour);
    let product = |solution: &Solution| energy(solution) * solution.curve.length();
    let penalty = energy(&ours) / ours.curve.length();
    for factor in [0.0, 0.5, 0.9, 1.0, 1.1, 2.0] {
        let params = Params::new().with("penalty", factor * penalty);
        let mec = solve(&contour, &*crate::catalog::build("mec", &params).unwrap()).unwrap();
        let more = product(&mec) - product(&ours);
        assert!(if factor == 1.0 { more.abs() < 1e-12 } else { more > 1e-6 }, "{factor} {more:e}");
    }
}
