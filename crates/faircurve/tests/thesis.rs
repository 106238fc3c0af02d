//! What the thesis shows in figures, as tests.

use faircurve::kurbo::Point;
use faircurve::{Contour, Join, Knot, Solution, Status, catalog, solve};

fn spiro(contour: &Contour) -> Solution {
    let solution = solve(contour, &*catalog::spline("spiro").unwrap()).unwrap();
    assert_eq!(solution.report.status(), Status::Solved, "{:?}", solution.report);
    assert!(solution.report.residual < 1e-12, "{:e}", solution.report.residual);
    solution
}

fn knot(x: f64, y: f64, join: Join) -> Knot {
    Knot::new((x, y)).join(join)
}

/// An arc that flows into a curve through a one-way knot.
fn arc_then_curve(last: Point) -> Contour {
    Contour::open([
        knot(0.0, 0.0, Join::Corner),
        knot(50.0, 40.0, Join::G2),
        knot(110.0, 50.0, Join::TerminalToCurve),
        knot(170.0, 20.0, Join::G4),
        Knot::new(last).join(Join::G4),
    ])
}

/// Figure 7.6: a one-way knot matches the nonzero curvature of its terminal side, on which the
/// other side has no effect.
#[test]
fn one_way_knots_match_nonzero_curvature_and_depend_one_way() {
    let (a, b) = (
        spiro(&arc_then_curve(Point::new(180.0, -60.0))),
        spiro(&arc_then_curve(Point::new(260.0, 0.0))),
    );
    let at = |solution: &Solution| solution.knots[2];
    assert!(at(&a).curvature_in.unwrap().abs() > 1e-3);
    assert!((at(&a).curvature_in.unwrap() - at(&a).curvature_out.unwrap()).abs() < 1e-12);
    for i in 0..2 {
        let (first, second) = (&a.curve.segments()[i], &b.curve.segments()[i]);
        assert!((first.length() - second.length()).abs() < 1e-10, "segment {i} moved");
        // From an end over G2 knots to the straight side: a circular arc.
        assert_eq!(first.kappa().unwrap()[1..], [0.0; 3]);
    }
    let end = |solution: &Solution| solution.curve.segments()[2].length();
    assert!((end(&a) - end(&b)).abs() > 1e-3, "the curved side should have moved");
}

/// Figure 7.7: round a closed contour, a one-way knot waits for itself.
#[test]
fn cyclic_dependencies_have_a_solution() {
    for joins in [
        [Join::CurveToTerminal, Join::G4, Join::G4, Join::G4],
        [Join::TerminalToCurve, Join::G2, Join::G4, Join::G2],
        [Join::TerminalToCurve, Join::G2, Join::TerminalToCurve, Join::G2],
        [Join::CurveToTerminal; 4],
    ] {
        let places = [(0.0, 0.0), (100.0, -20.0), (120.0, 90.0), (-10.0, 110.0)];
        let knots = places.iter().zip(joins).map(|(place, join)| Knot::new(*place).join(join));
        spiro(&Contour::closed(knots));
    }
}

/// Figure 7.3: straight sides meet curves with continuous, zero curvature, and stay straight.
#[test]
fn straight_sides_stay_straight() {
    let solution = spiro(&Contour::closed([
        knot(0.0, 0.0, Join::TerminalToCurve),
        knot(100.0, -60.0, Join::G4),
        knot(200.0, 0.0, Join::CurveToTerminal),
        knot(200.0, 300.0, Join::TerminalToCurve),
        knot(100.0, 360.0, Join::G4),
        knot(0.0, 300.0, Join::CurveToTerminal),
    ]));
    for side in [2, 5] {
        assert!(solution.curve.segments()[side].is_line());
    }
    for i in [0, 2, 3, 5] {
        let knot = solution.knots[i];
        for (direction, curvature) in
            [(knot.direction_in, knot.curvature_in), (knot.direction_out, knot.curvature_out)]
        {
            assert!((direction.unwrap().sin().abs() - 1.0).abs() < 1e-12, "{knot:?}");
            assert!(curvature.unwrap().abs() < 1e-12, "{knot:?}");
        }
    }
}

/// Section 7.3: tangent and curvature may be set at the ends.
#[test]
fn given_end_tangents_and_curvatures_are_met() {
    let mut contour = arc_then_curve(Point::new(260.0, 0.0));
    contour.knots[0].tangent_out = Some((0.0, 1.0).into());
    contour.knots[0].curvature_out = Some(-0.02);
    contour.knots[4].tangent_in = Some((1.0, -1.0).into());
    let solution = spiro(&contour);
    let (start, end) = (solution.knots[0], solution.knots[4]);
    assert!((start.direction_out.unwrap() - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    assert!((start.curvature_out.unwrap() + 0.02).abs() < 1e-12);
    assert!((end.direction_in.unwrap() + std::f64::consts::FRAC_PI_4).abs() < 1e-12);
}

/// A tangent given inside a contour holds on both sides; at a G4 knot curvature stays continuous.
#[test]
fn given_tangents_hold_inside() {
    for (join, curvature_continuous) in [(Join::G4, true), (Join::G2, false), (Join::G1, false)] {
        let solution = spiro(&Contour::open([
            knot(0.0, 0.0, Join::G4),
            knot(100.0, 60.0, join).tangent((1.0, 0.3)),
            knot(220.0, 30.0, Join::G4),
            knot(300.0, 90.0, Join::G4),
        ]));
        let knot = solution.knots[1];
        for direction in [knot.direction_in, knot.direction_out] {
            assert!((direction.unwrap() - 0.3f64.atan()).abs() < 1e-12, "{join}");
        }
        let jump = (knot.curvature_in.unwrap() - knot.curvature_out.unwrap()).abs();
        assert_eq!(jump < 1e-12, curvature_continuous, "{join}: {jump:e}");
    }
}

/// A curvature given inside a contour is met, and the curve stays smooth there.
#[test]
fn given_curvatures_hold_inside() {
    for join in [Join::G2, Join::G4] {
        let mut contour = Contour::open([(0.0, 0.0), (100.0, 60.0), (220.0, 30.0), (300.0, 90.0)]);
        contour.knots[1].join = Some(join);
        contour.knots[1].curvature_in = Some(-0.012);
        let knot = spiro(&contour).knots[1];
        for curvature in [knot.curvature_in, knot.curvature_out] {
            assert!((curvature.unwrap() + 0.012).abs() < 1e-12, "{join}");
        }
        assert!((knot.direction_in.unwrap() - knot.direction_out.unwrap()).abs() < 1e-12);
    }
}

/// Table 7.1 is singular where a terminal side faces a lone segment to an end: the line.
#[test]
fn a_lone_segment_from_an_end_to_a_terminal_side_is_a_line() {
    let solution = spiro(&Contour::open([
        knot(0.0, 0.0, Join::Corner),
        knot(100.0, 20.0, Join::TerminalToCurve),
        knot(180.0, -40.0, Join::G4),
        knot(150.0, -120.0, Join::Corner),
    ]));
    assert!(solution.curve.segments()[0].is_line());
    assert!((solution.knots[1].direction_out.unwrap() - 0.2f64.atan()).abs() < 1e-12);
}
