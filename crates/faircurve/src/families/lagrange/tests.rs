use super::*;
use crate::catalog::{self, Params};
use crate::{Contour, Knot, solve};

fn spline(parameter: &str) -> Box<dyn Spline> {
    catalog::build("lagrange", &Params::new().with("parameter", parameter)).unwrap()
}

/// Aitken and Neville's scheme: the polynomial's value at `t`, by another way than divided
/// differences.
fn neville(t: f64, nodes: &[(f64, Point)]) -> Point {
    let mut values: Vec<Vec2> = nodes.iter().map(|(_, p)| p.to_vec2()).collect();
    for step in 1..nodes.len() {
        for i in 0..nodes.len() - step {
            let (a, b) = (nodes[i].0, nodes[i + step].0);
            values[i] = (values[i] * (b - t) + values[i + 1] * (t - a)) / (b - a);
        }
    }
    values[0].to_point()
}

const POINTS: [(f64, f64); 7] =
    [(0.0, 0.0), (4.0, 1.0), (5.0, 3.0), (4.0, 5.0), (1.0, 5.5), (0.0, 3.5), (1.0, 1.0)];

/// The nodes of interpolation of each segment, by definition (eq. 4.4).
fn nodes(points: &[Point], closed: bool, uniform: bool, segment: usize) -> Vec<(f64, Point)> {
    let n = points.len();
    let first = segment as i64 - 1;
    let first = if closed { first } else { first.clamp(0, (n as i64 - 4).max(0)) };
    let count = if closed { 4 } else { n.min(4) };
    let at = |i: i64| points[i.rem_euclid(n as i64) as usize];
    let mut t = 0.0;
    (0..count as i64)
        .map(|j| {
            if j > 0 {
                let chord = at(first + j) - at(first + j - 1);
                t += if uniform { 1.0 } else { chord.hypot() };
            }
            (t, at(first + j))
        })
        .collect()
}

#[test]
fn segments_are_the_polynomials_through_their_neighbours() {
    for closed in [false, true] {
        for uniform in [false, true] {
            for count in 3..=7 {
                let points = POINTS[..count].iter().map(|p| Point::from(*p)).collect::<Vec<_>>();
                let contour = Contour { closed, ..Contour::open(points.iter().copied()) };
                let spline = spline(if uniform { "uniform" } else { "chord-length" });
                let solution = solve(&contour, &*spline).unwrap();
                assert!(solution.report.relaxed.is_empty());
                for (i, segment) in solution.curve.segments().iter().enumerate() {
                    let nodes = nodes(&points, closed, uniform, i);
                    let from = nodes.iter().position(|(_, p)| *p == segment.start()).unwrap();
                    let from = if closed { 1 } else { from };
                    let (t0, t1) = (nodes[from].0, nodes[from + 1].0);
                    let bezier = segment.beziers().unwrap()[0];
                    for u in [0.0, 0.2, 0.5, 0.9, 1.0] {
                        let expected = neville(t0 + (t1 - t0) * u, &nodes);
                        let ours = kurbo::ParamCurve::eval(&bezier, u);
                        let off = (ours - expected).hypot();
                        assert!(off < 1e-13, "{closed} {uniform} {count} {i} {u}: {off:e}");
                    }
                }
            }
        }
    }
}

#[test]
fn few_knots_have_polynomials_of_lower_degree() {
    let degree = |contour: &Contour| {
        let solution = solve(contour, &*spline("chord-length")).unwrap();
        let beziers = solution.curve.segments()[0].beziers().unwrap();
        match beziers[0] {
            PathSeg::Line(_) => 1,
            PathSeg::Quad(_) => 2,
            PathSeg::Cubic(_) => 3,
        }
    };
    let knot = |i: usize| Knot::new(POINTS[i]);
    assert_eq!(degree(&Contour::open([knot(0), knot(1)])), 1);
    assert_eq!(degree(&Contour::open([knot(0), knot(1), knot(2)])), 2);
    assert_eq!(degree(&Contour::open([knot(0), knot(1), knot(2), knot(3)])), 3);
    let given = knot(0).tangent_out((0.0, 1.0));
    assert_eq!(degree(&Contour::open([given.clone(), knot(1)])), 2);
    assert_eq!(degree(&Contour::open([given.clone(), knot(1), knot(2)])), 3);
    assert_eq!(degree(&Contour::open([given, knot(1).tangent_in((1.0, 0.0))])), 3);
    assert_eq!(degree(&Contour::closed([knot(0), knot(1), knot(2)])), 3);
}

#[test]
fn given_tangents_are_kept_and_their_cubics_pass_on() {
    for name in ["chord-length", "uniform"] {
        let mut contour = Contour::open(POINTS);
        contour.knots[0].tangent_out = Some(Vec2::new(-1.0, 1.0));
        contour.knots[3] = Knot::new(POINTS[3]).tangent((-2.0, 1.0));
        let solution = solve(&contour, &*spline(name)).unwrap();
        assert!(solution.report.residual < 1e-14);
        let direction = |x: f64, y: f64| f64::atan2(y, x);
        let knots = &solution.knots;
        assert!((knots[0].direction_out.unwrap() - direction(-1.0, 1.0)).abs() < 1e-14);
        assert!((knots[3].direction_in.unwrap() - direction(-2.0, 1.0)).abs() < 1e-14);
        assert!((knots[3].direction_out.unwrap() - direction(-2.0, 1.0)).abs() < 1e-14);
        assert_eq!(knots[3].join, Join::G1);
    }
}

#[test]
fn the_first_two_segments_are_one_cubic_as_are_the_last() {
    let solution = solve(&Contour::open(POINTS), &*spline("chord-length")).unwrap();
    for knot in [1, 5] {
        let [a, b] = [knot - 1, knot].map(|i| &solution.curve.segments()[i]);
        let (arriving, leaving) = (a.at(a.length()), b.at(0.0));
        assert!((arriving.direction - leaving.direction).abs() < 1e-14);
        assert!((arriving.curvature - leaving.curvature).abs() < 1e-13);
    }
    let knot = &solution.knots[3];
    assert!((knot.direction_in.unwrap() - knot.direction_out.unwrap()).abs() > 0.01);
}

/// Moving a knot changes two segments on either side and no others, three where it is the last of
/// the cubic at an open end.
#[test]
fn support_is_finite() {
    let points: Vec<Point> =
        (0..12).map(|i| Point::new(f64::from(i), f64::from(i * i % 7))).collect();
    for closed in [false, true] {
        for moved in 0..12 {
            let before = Contour { closed, ..Contour::open(points.iter().copied()) };
            let mut after = before.clone();
            after.knots[moved].point.y += 0.125;
            let [before, after] =
                [before, after].map(|c| solve(&c, &*spline("chord-length")).unwrap().curve);
            for (i, (a, b)) in before.segments().iter().zip(after.segments()).enumerate() {
                let changed = (a.length() - b.length()).abs() > 1e-9;
                let steps = if closed {
                    let ahead = (i + 12 - moved) % 12;
                    ahead.min(11 - ahead)
                } else if i >= moved {
                    i - moved
                } else {
                    moved - 1 - i
                };
                let at_end = !closed && (i == 0 || i == 10);
                let allowed = if at_end { steps < 3 } else { steps < 2 };
                assert_eq!(changed, allowed, "{closed}: knot {moved}, segment {i}");
            }
        }
    }
}

#[test]
fn roundness_is_of_order_four() {
    let error = |n: u32| {
        let on_circle = |i: u32| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
            Point::new(angle.cos(), angle.sin())
        };
        let contour = Contour::closed((0..n).map(on_circle));
        let curve = solve(&contour, &*spline("chord-length")).unwrap().curve;
        let segment = &curve.segments()[0];
        let at = |i: i32| segment.point(segment.length() * f64::from(i) / 64.0).to_vec2();
        (0..=64).map(|i| (at(i).hypot() - 1.0).abs()).fold(0.0, f64::max)
    };
    let order = (error(32) / error(64)).log2();
    assert!((order - 4.0).abs() < 0.05, "{order}");
}

/// "Prone to wild excursions when the control points are not spaced evenly" (thesis section 4.4).
#[test]
fn evenly_spaced_parameters_make_wild_excursions() {
    let contour = Contour::open([(0.0, 0.0), (10.0, 0.0), (10.0, 0.1), (20.0, 0.0)]);
    let [tame, wild] = ["chord-length", "uniform"].map(|name| {
        let curve = solve(&contour, &*spline(name)).unwrap().curve;
        curve.segments()[1].length() / curve.segments()[1].chord_length()
    });
    assert!(tame < 1.2 && wild > 3.0, "{tame} {wild}");
}
