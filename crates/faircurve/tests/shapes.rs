//! Any tangents drawn by any shape, and hostile input: nothing leaves the range of numbers.

use faircurve::catalog::{self, ENTRIES, ParamKind, Params};
use faircurve::convert::{Options, convert};
use faircurve::kurbo::{ParamCurve, Point, Vec2};
use faircurve::{Contour, Effort, Join, Knot, Solution, Spline, Status, solve, solve_with};
use proptest::prelude::*;

/// Every entry with every choice of every parameter.
fn each_choice(law: impl Fn(&str, &dyn Spline)) {
    for info in ENTRIES {
        law(info.name, &*catalog::spline(info.name).unwrap());
        for spec in info.params {
            let ParamKind::Choice { options } = spec.kind else { continue };
            for option in options {
                let params = Params::new().with(spec.name, *option);
                let name = format!("{} {}={option}", info.name, spec.name);
                law(&name, &*catalog::build(info.name, &params).unwrap());
            }
        }
    }
}

fn assert_sound(name: &str, contour: &Contour, solution: &Solution) {
    for (i, segment) in solution.curve.segments().iter().enumerate() {
        let knots = &contour.knots;
        assert_eq!(segment.start(), knots[i].point, "{name}");
        assert_eq!(segment.end(), knots[(i + 1) % knots.len()].point, "{name}");
        let numbers = [segment.length(), segment.bending_energy(), segment.variation_energy()];
        assert!(numbers.into_iter().all(f64::is_finite), "{name}: {numbers:?} {contour:?}");
        for along in [0.0, 0.3, 1.0] {
            let at = segment.at(along * segment.length());
            assert!(at.point.is_finite() && at.direction.is_finite(), "{name}: {contour:?}");
            let jet = segment.curvature_jet(along * segment.length());
            assert!(jet.into_iter().all(f64::is_finite), "{name}: {jet:?} {contour:?}");
        }
        let bounds = segment.bounding_box();
        assert!([bounds.x0, bounds.x1, bounds.y0, bounds.y1].into_iter().all(f64::is_finite));
    }
    let report = &solution.report;
    assert!(report.residual.is_finite());
    if report.status() == Status::Solved {
        assert!(report.residual <= 1e-9, "{name}: {:e} {contour:?}", report.residual);
    }
}

/// Directions along the axes and diagonals, so that angles of exactly 0, π/2 and π appear.
fn direction() -> impl Strategy<Value = Option<Vec2>> {
    let step = |(x, y): (i32, i32)| Vec2::new(f64::from(x), f64::from(y));
    let vector = (-1..=1i32, -1..=1i32).prop_map(step);
    proptest::option::weighted(0.3, vector.prop_filter("a direction", |v| *v != Vec2::ZERO))
}

fn hostile_knots() -> impl Strategy<Value = Knot> {
    let scale = prop_oneof![Just(1.0), Just(1.0), Just(1e-17), Just(1e9), Just(1e-6)];
    let number = prop_oneof![
        Just(None),
        Just(None),
        (-3.0..3.0f64).prop_map(Some),
        Just(Some(-0.75)),
        Just(Some(4096.0)),
        Just(Some(1e300)),
        Just(Some(0.0)),
    ];
    let given = (direction(), direction(), number.clone(), number.clone(), number);
    ((-2..3i32, -2..3i32), scale, 0..9usize, given).prop_map(|((x, y), scale, join, given)| {
        let (tangent_in, tangent_out, tension_in, tension_out, curl) = given;
        let join = Join::ALL.get(join).copied();
        let smooth = join.is_some_and(Join::is_smooth) || join.is_none();
        Knot {
            point: Point::new(f64::from(x) * scale, f64::from(y) * scale),
            join,
            tangent_in: if smooth { tangent_out } else { tangent_in },
            tangent_out,
            tension_in,
            tension_out,
            curl,
            ..Knot::default()
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn nothing_leaves_the_range_of_numbers(
        knots in proptest::collection::vec(hostile_knots(), 1..7),
        closed in any::<bool>(),
    ) {
        let contour = Contour { knots, closed };
        each_choice(|name, spline| {
            // Coincident knots may be given two directions.
            if let Ok(solution) = solve_with(&contour, spline, Effort::NONE) {
                assert_sound(name, &contour, &solution);
            }
        });
    }
}

#[test]
fn shapes_keep_the_tangents_of_the_rule() {
    let contour = Contour::closed([(0.0, 0.0), (90.0, 10.0), (70.0, 80.0), (30.0, 50.0)]);
    for info in ENTRIES {
        let Some(spec) = info.params.iter().find(|spec| spec.name == "shape") else { continue };
        let ParamKind::Choice { options } = spec.kind else { panic!("{}", info.name) };
        let own = solve(&contour, &*catalog::spline(info.name).unwrap()).unwrap();
        for option in options {
            let params = Params::new().with("shape", *option);
            let spline = catalog::build(info.name, &params).unwrap();
            let solution = solve(&contour, &*spline).unwrap();
            let relaxed = &solution.report.relaxed;
            // Another shape needn't have what the rule made of curvatures.
            let is_smooth = relaxed.iter().all(|r| r.got != "corner");
            // Periodic shapes turn back where angles are large, and the report says so.
            let may_turn_back = ["bespoke", "bi-parabola"].contains(option);
            assert!(is_smooth || may_turn_back, "{} {option}: {relaxed:?}", info.name);
            if !is_smooth {
                continue;
            }
            for (a, b) in own.knots.iter().zip(&solution.knots) {
                let off = a.direction_out.unwrap() - b.direction_out.unwrap();
                assert!(off.sin().abs() < 1e-9 && off.cos() > 0.0, "{} {option}", info.name);
            }
        }
    }
}

/// What segments say of the largest curvature, and of its derivatives', holds everywhere between two places: proofs rest on
/// it.
#[test]
fn curvature_bounds_hold() {
    const PLACES: u32 = 64;
    let contours = [
        Contour::closed([(0.0, 0.0), (100.0, 20.0), (150.0, 120.0), (60.0, 170.0), (-30.0, 90.0)]),
        Contour::open([(0.0, 0.0), (80.0, 90.0), (160.0, 10.0), (170.0, 120.0), (20.0, 150.0)]),
        Contour::closed([(0.0, 0.0), (10.0, 1.0), (90.0, -60.0), (80.0, 70.0)]),
    ];
    let mut known = 0;
    each_choice(|name, spline| {
        for contour in &contours {
            for segment in solve(contour, spline).unwrap().curve.segments() {
                let length = segment.length();
                for (from, to) in [(0.0, 1.0), (0.0, 0.5), (0.3, 0.4), (0.9, 1.0), (0.62, 0.622)] {
                    let bounds = segment.curvature_bounds(from * length, to * length);
                    assert!(bounds.into_iter().all(f64::is_finite), "{name}: {bounds:?}");
                    for i in 0..=PLACES {
                        let along = from + (to - from) * f64::from(i) / f64::from(PLACES);
                        let jet = segment.curvature_jet(along * length);
                        for order in 0..3 {
                            let rounding = 1e-9 * bounds[order].min(1e9) + 1e-12;
                            let (size, bound) = (jet[order].abs(), bounds[order]);
                            assert!(size <= bound + rounding, "{name} {order}: {size} {bound}");
                        }
                    }
                }
            }
        }
    });
    for name in ["spiro", "euler", "mvc", "mec", "kurgla1", "simec"] {
        let curve = solve(&contours[0], &*catalog::spline(name).unwrap()).unwrap().curve;
        let bounds = curve.segments().iter().map(|s| s.curvature_bounds(0.0, s.length()));
        known += bounds.filter(|bounds| bounds.iter().all(|bound| *bound < f64::MAX)).count();
    }
    assert_eq!(known, 6 * contours[0].knots.len(), "bounds that are no bounds");
}

/// The bound of a conversion isn't below what is measured, on every spline.
#[test]
fn bounds_of_conversions_hold() {
    let contour =
        Contour::closed([(0.0, 0.0), (100.0, 20.0), (150.0, 120.0), (60.0, 170.0), (-30.0, 90.0)]);
    for info in ENTRIES {
        let curve = solve(&contour, &*catalog::spline(info.name).unwrap()).unwrap().curve;
        for accuracy in [1.0, 1e-2, 1e-4] {
            let result = convert(&curve, &Options::new(accuracy));
            assert!(result.bound <= accuracy, "{}: {:e}", info.name, result.bound);
            for cubic in result.path.segments() {
                for t in [0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9] {
                    let near = 0.01 * result.bound + 1e-7;
                    let (_, _, off) = curve.nearest(cubic.eval(t), near).unwrap();
                    assert!(off <= result.bound + near, "{}: {off:e}", info.name);
                }
            }
        }
    }
}
