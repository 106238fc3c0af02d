//! Contours that once broke a promise, found by the targets in `fuzz/`; each test says which.

use faircurve::catalog::{self, Params};
use faircurve::convert::{Cuts, Options, convert, to_bezpath};
use faircurve::frame::wrap_angle;
use faircurve::kurbo::{PathEl, Point, Vec2};
use faircurve::{Contour, Curve, InputError, Join, Knot, Place, Segment, Solution, solve};

fn solved(spline: &str, contour: &Contour) -> Solution {
    solve(contour, &*catalog::spline(spline).unwrap()).unwrap()
}

fn built(spline: &str, params: &[(&str, &str)], contour: &Contour) -> Solution {
    let params = params.iter().fold(Params::new(), |all, (name, value)| all.with(name, *value));
    solve(contour, &*catalog::build(spline, &params).unwrap()).unwrap()
}

/// How far the curve comes out of its box, in lengths of the curve.
fn beyond_box(curve: &Curve) -> f64 {
    const PLACES: u32 = 1000;
    let bounds = curve.bounding_box().unwrap();
    let out = |i: u32| {
        let at = curve.at(curve.length() * f64::from(i) / f64::from(PLACES)).unwrap();
        (bounds.union_pt(at.point).size() - bounds.size()).max_side()
    };
    (0..=PLACES).map(out).fold(0.0, f64::max) / curve.length()
}

/// How far apart the two halves of a segment are in its middle, where they meet: points are
/// measured from the nearer end.
fn tear(segment: &Segment) -> f64 {
    let middle = segment.length() / 2.0;
    (segment.point(middle) - segment.point(middle * (1.0 - 1e-12))).hypot()
}

/// The length of a chord of 1e-321 is rounded to 0.
#[test]
fn beziers_meet_knots_at_a_distance_too_small_to_measure() {
    let knots = [(0.0, -1.0), (1e-321, 0.0), (0.0, 0.0)];
    let contour = Contour::closed(knots.map(|point| Knot::new(point).join(Join::Corner)));
    let path = to_bezpath(&solved("spiro", &contour).curve, 1e-3);
    for (x, y) in knots {
        let meets = |element: &PathEl| element.end_point() == Some(Point::new(x, y));
        assert!(path.elements().iter().any(meets), "{path:?}");
    }
}

/// In a drawing of 1e19 units, knots some units apart are one; the segment that leaves them starts
/// at the last of them, though it was solved from the first.
#[test]
fn segments_beside_merged_knots_are_whole() {
    let contour = Contour::closed([
        (107.0, 0.5),
        (0.0, 9e18),
        (-3337.0, -23807.0),
        (45.0, 41.0),
        (3.0, 0.0),
        (0.0, 0.0),
    ]);
    for spline in ["spiro", "euler"] {
        for segment in solved(spline, &contour).curve.segments() {
            assert!(tear(segment) <= 1e-9 * segment.length(), "{spline}: {segment:?}");
        }
    }
}

/// Each of these knots is within rounding of the one before, but together they come back to where
/// they started.
#[test]
fn a_chain_of_near_knots_leaves_no_chord_of_length_zero() {
    let near = |steps: u32| 1.0 + f64::from(steps) * f64::EPSILON;
    let xs = [near(0), near(60), near(120), near(0)];
    let knots = xs.map(|x| (x, 0.0)).into_iter().chain([(3.0, 1.0), (2.0, 4.0)]);
    let contour = Contour::closed(knots);
    for spline in ["spiro", "euler"] {
        let solution = solved(spline, &contour);
        assert!(solution.report.relaxed.is_empty(), "{spline}: {:?}", solution.report);
        for segment in solution.curve.segments() {
            assert!(segment.length().is_finite() && segment.length() < 30.0, "{segment:?}");
        }
    }
}

/// Two straight segments that turn back at a smooth knot: there is no such curve.
#[test]
fn a_knot_at_which_the_curve_turns_back_is_not_called_smooth() {
    let contour = Contour::open([
        Knot::new((0.0, 0.0)),
        Knot::new((10.0, 0.0)).join(Join::CurveToTerminal),
        Knot::new((5.0, 0.0)).join(Join::Corner),
    ]);
    let solution = solved("spiro", &contour);
    assert_eq!(solution.knots[1].join, Join::Corner, "{:?}", solution.report);
}

/// What can't be met here is a curvature at a knot that is g1 already.
#[test]
fn nothing_is_relaxed_to_itself() {
    let contour = Contour::closed([
        Knot::new((0.0, 0.0)).join(Join::Corner),
        Knot::new((10.0, -1.5)).join(Join::G4),
        Knot::new((20.25, 100.0)).join(Join::G2),
        Knot::new((30.0, 5.0)).join(Join::CurveToTerminal),
        Knot::new((40.0, 5.0)).join(Join::TerminalToCurve),
        Knot::new((50.0, 5.0))
            .join(Join::G1)
            .tangent((3.0, -4.0))
            .curvature_in(0.0)
            .curvature_out(0.0),
    ]);
    for relaxed in solved("spiro", &contour).report.relaxed {
        assert_ne!(relaxed.asked, relaxed.got, "{relaxed:?}");
    }
}

/// Drawn with a shape that promises a tangent only, a knot whose equation isn't met is smooth all the
/// same: what it lacks is the spline's own condition.
#[test]
fn a_tangent_that_the_rule_did_not_give_is_not_relaxed_to_itself() {
    let contour = Contour::open([
        Knot::new((1.221_015_077_810_775_5e26, 114.0)).tangent_out((1e-18, 1e-18)),
        Knot::new((0.0, 0.0)),
        Knot::new((2.289_403_270_895_204e26, 213.75)),
        Knot::new((30.0, -13670.0)),
    ]);
    let spline = catalog::build("circle", &Params::new().with("shape", "hobby")).unwrap();
    let relaxed = solve(&contour, &*spline).unwrap().report.relaxed;
    assert!(!relaxed.is_empty());
    for relaxed in relaxed {
        assert_ne!(relaxed.asked, relaxed.got, "{relaxed:?}");
    }
}

/// A lone Euler spiral whose curvature at a corner can't be met.
#[test]
fn corners_stay_corners() {
    let contour = Contour::closed([
        Knot::new((119.0, -546.0))
            .join(Join::Corner)
            .tangent_out((117.0, 91.0))
            .curvature_in(0.063)
            .curvature_out(0.063),
        Knot::new((0.0, 0.0)).join(Join::Corner),
    ]);
    let solution = solved("euler", &contour);
    assert_eq!(solution.knots[0].join, Join::Corner, "{:?}", solution.report);
}

/// An Euler spiral has no room for a curvature beside a tangent.
#[test]
fn a_curvature_of_zero_is_met_or_listed() {
    let knot = Knot::new((0.0, 90.0)).tangent_out((-60.0, 0.0)).curvature_out(0.0);
    let solution = solved("euler", &Contour::open([knot, Knot::new((0.0, 0.0))]));
    let is_met = solution.knots[0].curvature_out.is_some_and(|k| k.abs() < 1e-9);
    let is_listed = solution.report.adapted.iter().any(|a| a.place == Place::Knot(0));
    assert!(is_met || is_listed, "{solution:?}");
}

/// The product of this curvature with the chord is beyond the range of numbers; it was called met.
#[test]
fn curvatures_beyond_all_numbers_are_refused() {
    for curvature in [2.9e306, -9e290, 1e70] {
        let knot = Knot::new((-397309.7, 0.0)).curvature_out(curvature);
        let contour = Contour::open([knot, Knot::new((0.0, -7.5e24))]);
        for spline in ["spiro", "euler"] {
            let error = solve(&contour, &*catalog::spline(spline).unwrap()).unwrap_err();
            assert_eq!(error, InputError::CurvatureTooLarge { knot: 0, what: "curvature_out" });
        }
    }
}

/// The top of a half circle lies in its very middle, one of the places at which signs are compared.
#[test]
fn the_box_holds_what_is_symmetric() {
    let half_turns = Contour::closed([(0.0, 2.0), (2.0, 2.0)].map(|p| Knot::new(p).join(Join::G2)));
    for spline in ["kurgla1", "mvc", "log-aesthetic", "generated"] {
        let solution =
            built(spline, if spline == "mvc" { &[] } else { &[("end", "arc")] }, &half_turns);
        let curve = solution.curve;
        assert!(beyond_box(&curve) <= 1e-9, "{spline}: {:?}", curve.bounding_box());
        for segment in curve.segments() {
            let middle = segment.length() / 2.0;
            let has_top = segment.axis_extrema().iter().any(|s| (s - middle).abs() < 1e-9 * middle);
            assert!(has_top, "{spline}: {:?}", segment.axis_extrema());
        }
    }
}

/// The top lies where the arcs of a biarc meet, on neither of them by their rounded directions.
#[test]
fn the_top_of_a_biarc_is_found_once() {
    let contour = Contour::closed([
        Knot::new((-58.0, -0.4)).join(Join::Corner),
        Knot::new((2.2e-16, 1e45)),
        Knot::new((1e45, 1e45)),
        Knot::new((-56.0, -58.0)),
        Knot::new((46.0, -58.0)),
    ]);
    let curve = built("circle", &[("shape", "biarc")], &contour).curve;
    assert!(beyond_box(&curve) <= 1e-9, "{:?}", curve.bounding_box());
    for segment in curve.segments() {
        let extrema = segment.axis_extrema();
        let apart = |pair: &[f64]| pair[1] - pair[0] > 1e-9 * segment.length();
        assert!(extrema.windows(2).all(apart), "{extrema:?}");
    }
}

/// A shape that promises tangents only has a curvature of its own, and straight lines have none.
#[test]
fn a_curvature_that_the_shape_does_not_have_is_listed() {
    let contour = Contour::open([
        Knot::new((-24.0, -39.0)).curvature_out(0.006),
        Knot::new((0.0, 0.0)),
        Knot::new((30.0, -5.0)),
    ]);
    let is_listed = |solution: &Solution| {
        let adapted = &solution.report.adapted;
        adapted.iter().any(|a| a.place == Place::Knot(0) && a.asked == "curvature")
    };
    for spline in ["euler", "bespoke", "generated", "kurgla1", "log-aesthetic", "mec", "simec"] {
        let solution = built(spline, &[("shape", "hobby")], &contour);
        assert!(is_listed(&solution), "{spline}: {:?}", solution.report);
    }
    assert!(is_listed(&solved("polygon", &contour)));
}

/// The joint of two parabolas lies on a knot but for rounding: the direction of what is between is no direction.
#[test]
fn a_kappa_curve_does_not_turn_back_at_a_knot_that_is_called_smooth() {
    let contour =
        Contour::closed([Knot::new((5323.0, 1.0)), Knot::new((23.0, 90.0)).tangent((-1.0, 3.0))]);
    let solution = solved("kappa", &contour);
    let [arriving, leaving] =
        [solution.knots[0].direction_in, solution.knots[0].direction_out].map(Option::unwrap);
    let turns = wrap_angle(leaving - arriving).abs();
    assert!(
        turns < 1e-9 || solution.knots[0].join == Join::Corner,
        "{turns} {:?}",
        solution.report
    );
}

/// Knots that lie 1e15 times nearer to each other than to the rest: legs found for the whole don't know
/// the way from one to the other.
#[test]
fn a_kappa_curve_is_whole_and_no_shorter_than_its_chords() {
    let far = Contour::open([
        (72.0, 72.0),
        (72.0, -48.0),
        (72.0, -1.351_079_888_211_149_3e17),
        (2565.0, 2570.0),
        (2570.0, 2570.0),
        (1.0, 0.0),
        (-39.0, 0.0),
    ]);
    let near = Contour::open([
        (0.188_235_294_073_820_11, 0.188_235_294_073_820_11),
        (0.188_235_295_936_465_26, 0.188_235_294_073_820_11),
        (1550.5, 34.0),
        (546.125, 0.188_235_294_073_820_11),
        (1550.5, 34.0),
        (546.125, 110.0),
        (-2467.0, 338.0),
    ]);
    for contour in [far, near] {
        for segment in solved("kappa", &contour).curve.segments() {
            assert!(tear(segment) <= 1e-9 * segment.length(), "{segment:?}");
            assert!(segment.length() >= segment.chord_length() * (1.0 - 1e-12), "{segment:?}");
        }
    }
}

/// Beside segments of 1e19 units, places on one of 100 aren't told apart by the length so far: the search went on
/// from where it was for ever.
#[test]
fn beziers_across_knots_get_on_where_segments_are_tiny() {
    let contour = Contour::closed([
        Knot::new((0.0, 55.0)),
        Knot::new((45.25, 0.5)),
        Knot::new((0.0, 55.0)).tangent_in(Vec2::new(-127.0, -127.0)),
        Knot::new((3152.75, 1.4e19)),
        Knot::new((55.0, 0.5)),
        Knot::new((-0.8, 0.04)),
        Knot::new((3469.5, 3469.5)),
    ]);
    let curve = solved("spiro", &contour).curve;
    for cuts in [Cuts::Greedy, Cuts::Halving, Cuts::HalvingBend, Cuts::EqualErrors, Cuts::Balanced]
    {
        for free_joints in [false, true] {
            let options = Options { span_knots: true, cuts, free_joints, ..Options::new(0.0) };
            let result = convert(&curve, &options);
            assert!(result.path.is_finite() && result.cubics < 10_000, "{}", result.cubics);
        }
    }
}

/// The tangent at a cusp is that of the curve's end, not of the place a rounding before it.
#[test]
fn directions_agree_at_a_knot_with_a_tiny_radius() {
    let knots = [
        (116.0, 7.0),
        (0.6745098140090704, 0.6745098037645221),
        (0.3776348037645221, 0.6745098037645221),
        (0.6745098037645221, 0.674521564040333),
    ];
    let contour = Contour::closed(knots.map(|point| Knot::new(point).join(Join::G2)));
    let solution = built("kappa", &[("method", "parabolas"), ("shape", "spiro")], &contour);
    for knot in &solution.knots {
        let turn = wrap_angle(knot.direction_out.unwrap() - knot.direction_in.unwrap());
        assert!(turn.abs() <= 1e-9, "{turn}");
    }
}
