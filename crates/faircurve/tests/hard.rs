//! Contours that plain Newton iteration doesn't solve.

use std::f64::consts::TAU;

use faircurve::kurbo::{Affine, Point, Vec2};
use faircurve::{Contour, Effort, Join, Knot, Solution, Stage, Status, catalog, solve, solve_with};

fn spiro(contour: &Contour) -> Solution {
    solve(contour, &*catalog::spline("spiro").unwrap()).unwrap()
}

/// Length over chord of the longest segment.
fn longest(solution: &Solution) -> f64 {
    let segments = solution.curve.segments().iter();
    segments.map(|segment| segment.length() / segment.chord_length()).fold(0.0, f64::max)
}

/// Several turns of a spiral, closed by one long chord from its outer end to its inner one.
fn closed_spiral(knots: usize) -> Contour {
    Contour::closed((0..knots).map(|i| {
        let angle = TAU / 8.0 * i as f64;
        let radius = 20.0 + 3.0 * angle;
        Knot::new((radius * angle.cos(), radius * angle.sin())).join(Join::G4)
    }))
}

/// The closing chord hangs on the spiral's two ends.
#[test]
fn a_long_chord_is_bridged() {
    for knots in [90, 160] {
        let solution = spiro(&closed_spiral(knots));
        assert_eq!(solution.report.status(), Status::Solved, "{knots}: {:?}", solution.report);
        assert_eq!(solution.report.stage, Stage::Bridged, "{knots}");
        assert!(longest(&solution) < 4.0, "{knots}: {}", longest(&solution));
    }
}

/// The same knots without any search are relaxed; every knot is still met, every reason given.
#[test]
fn without_a_search_the_spiral_is_relaxed() {
    let knots = 90;
    let spline = catalog::spline("spiro").unwrap();
    let solution = solve_with(&closed_spiral(knots), &*spline, Effort::NONE).unwrap();
    assert_eq!(solution.report.status(), Status::Relaxed);
    assert_eq!(solution.report.stage, Stage::Plain);
    for relaxed in &solution.report.relaxed {
        assert!(!relaxed.reason.is_empty());
    }
    for (knot, solved) in closed_spiral(knots).knots.iter().zip(&solution.knots) {
        assert_eq!(knot.point, solved.point);
    }
}

/// More effort never makes a solved contour a relaxed one, and the default solves these.
#[test]
fn effort_helps() {
    let knots = [(79, 32), (94, 45), (88, 94), (83, 67), (3, 59), (99, 31)];
    let contour = Contour::closed(knots.map(|(x, y)| Point::new(f64::from(x), f64::from(y))));
    let spline = catalog::spline("spiro").unwrap();
    let status = |effort| solve_with(&contour, &*spline, effort).unwrap().report.status();
    assert_eq!(status(Effort::NONE), Status::Relaxed);
    assert_eq!(status(Effort::default()), Status::Solved);
    assert_eq!(status(Effort::times(4.0)), Status::Solved);
    assert_eq!(status(Effort::times(f64::NAN)), Status::Relaxed);
}

/// What asks for smoothness everywhere along these has to come back in a balloon: out on a line, and
/// back. Where loops are to be avoided, the fewest and weakest places that do are relaxed, no more
/// than two, and named; without loops nothing changes.
#[test]
fn loops_are_avoided_at_the_cost_of_joins_only_when_asked() {
    let spline = catalog::spline("spiro").unwrap();
    let avoiding = Effort::default().avoiding_loops();
    let line = [(0.0, 0.0), (-36.051, 76.462), (-50.669, 214.735), (-37.313, 336.366)];
    let line = Contour::closed(line.map(|point| Knot::new(point).join(Join::G4)));
    let asked = spiro(&line);
    assert_eq!(asked.report.status(), Status::Solved);
    assert!(longest(&asked) > 4.0, "{}", longest(&asked));
    let unlooped = solve_with(&line, &*spline, avoiding).unwrap();
    assert_eq!(unlooped.report.status(), Status::Relaxed);
    assert!(longest(&unlooped) <= 4.0, "{}", longest(&unlooped));
    assert!(unlooped.report.relaxed.len() <= 2, "{:?}", unlooped.report.relaxed);
    for relaxed in &unlooped.report.relaxed {
        assert!(relaxed.reason.contains("loops"), "{relaxed:?}");
    }
    let without = closed_spiral(90);
    let avoided = solve_with(&without, &*spline, avoiding).unwrap();
    assert_eq!(format!("{:?}", spiro(&without)), format!("{avoided:?}"));
}

/// Two knots 1e-9 of their neighbours' distance apart: cases 12 and 44 of `near-coincident closed g4 8` of
/// the gauntlet, which no search solved that took them for ordinary knots.
#[test]
fn knots_all_but_in_one_place_are_joined_as_asked() {
    let case_12 = [
        (0.0, 0.0),
        (-88.26779594369702, -24.208502294887275),
        (-161.9659209932279, -25.446170741153722),
        (-161.96592108612035, -25.446170789250377),
        (-177.75374048559382, -155.10205292343855),
        (-104.75390628518741, -253.26240555247625),
        (-114.92234302170964, -308.2608207649614),
        (-54.1695927765488, -367.7618079060013),
    ];
    let case_44 = [
        (0.0, 0.0),
        (119.3832913767365, -40.95709507224426),
        (191.25164359041355, 11.544479290433337),
        (191.25164375205202, 11.54447931165578),
        (300.54161027379894, 4.264372395034292),
        (378.57740754247675, 27.143090001483323),
        (488.0681572855462, 9.370920294728602),
        (587.9514797804252, 91.45513861473701),
    ];
    for (name, knots) in [("12", case_12), ("44", case_44)] {
        let solution = spiro(&Contour::closed(knots.map(|point| Knot::new(point).join(Join::G4))));
        assert_eq!(solution.report.status(), Status::Solved, "{name}: {:?}", solution.report);
        assert_eq!(solution.report.stage, Stage::Fused, "{name}");
        assert!(longest(&solution) < 4.0, "{name}: {}", longest(&solution));
    }
}

/// A walk of 32 places, each of two knots a thousandth of a step apart. All pairs are fused at once: one after
/// the other, each with a share of what the one before had to spend, most would be left.
#[test]
fn many_short_segments_are_fused_at_once() {
    let (mut at, mut heading) = (Point::ORIGIN, 0.0);
    let knots = (0..64).map(|i| {
        let here = at;
        heading += (f64::from(i) * f64::from(i) * 0.7).sin();
        at += Vec2::from_angle(heading) * if i % 2 == 0 { 100.0 } else { 0.1 };
        Knot::new(here).join(Join::G4)
    });
    let solution = spiro(&Contour::closed(knots));
    assert_eq!(solution.report.status(), Status::Solved, "{:?}", solution.report);
    assert_eq!(solution.report.stage, Stage::Fused);
}

/// Chords in ratio 1e6 may need curves that no step of the search makes alone: chains are bridged within
/// bridges (case 2 of `ratio-1e6 open g4 8` of the gauntlet).
#[test]
fn chains_of_very_different_scales_are_joined_as_asked() {
    let knots = [
        (0.0, 0.0),
        (-0.008941990077806166, -0.0010801200486553898),
        (-0.15953913567798533, -0.21341566909482934),
        (-11.01708167993687, -7.719435291725701),
        (-11.032181972339378, -7.781266387563812),
        (-10.292370618156207, -28.925617731478358),
        (-10.052178514818701, -29.575036867806453),
        (-10.054835580218406, -29.578578218455284),
    ];
    let solution = spiro(&Contour::open(knots.map(|point| Knot::new(point).join(Join::G4))));
    assert_eq!(solution.report.status(), Status::Solved, "{:?}", solution.report);
    assert!(longest(&solution) < 4.0, "{}", longest(&solution));
}

/// Three more of the gauntlet with chords in ratio 1e6, for which an offline search knows curves.
#[test]
#[ignore = "known failure: relaxed; the known curves have balloons of 129 to 869 chords, which the search doesn't come upon"]
fn chords_in_ratio_1e6_are_joined_as_asked() {
    let closed_case_9 = [
        (0.0, 0.0),
        (-0.007626771556604798, 0.006461091472655655),
        (-0.14298329445199445, 0.398526617975441),
        (-0.1202430351229979, 0.45188614702641994),
        (2.8992213706879797, 1.005860646587799),
        (3.1329707312432777, 0.8818864424364916),
        (3.1343517106354803, 0.8803801971792901),
        (3.134188197568332, 0.8634281589350055),
    ];
    let open_case_0 = [
        (0.0, 0.0),
        (-0.7734376192313696, -1.0193585348147793),
        (-0.7752654504666594, -1.0200124150280054),
        (-0.9616645237014689, -0.9340703849152363),
        (-2.834401320759463, 0.2347051878724229),
        (-26.00352941146788, -2.371016501416245),
        (-26.00578048884462, -2.371020155977078),
        (-26.08933834227663, -2.395924568436445),
    ];
    let open_case_10 = [
        (0.0, 0.0),
        (-0.0028039600011086833, -0.018770918093538442),
        (7.531257466717282, -10.595597803574961),
        (13.372884400796496, -17.230795589282867),
        (13.530899342490395, -17.455854215213368),
        (13.694962220113815, -17.465605024041903),
        (305.57320546031207, 172.87442596054657),
        (497.2506625994436, 279.37459924784594),
    ];
    let joined = |points: [(f64, f64); 8]| points.map(|point| Knot::new(point).join(Join::G4));
    for contour in [
        Contour::closed(joined(closed_case_9)),
        Contour::open(joined(open_case_0)),
        Contour::open(joined(open_case_10)),
    ] {
        let solution = spiro(&contour);
        assert_eq!(solution.report.status(), Status::Solved, "{:?}", solution.report);
    }
}

/// Figure 2.7: several curves may satisfy the same equations. The one given is the natural one, and
/// the same from every start and in both directions.
#[test]
fn of_several_curves_the_natural_one_is_given() {
    let knots = [(0.0, 0.0), (100.0, 0.0), (10.0, 60.0), (90.0, 70.0), (20.0, 140.0)];
    let length = |contour: &Contour| spiro(contour).curve.length();
    let forward = Contour::open(knots.map(|p| Knot::new(p).join(Join::G2)));
    let backward = Contour::open(knots.into_iter().rev().map(|p| Knot::new(p).join(Join::G2)));
    assert!((length(&forward) - length(&backward)).abs() < 1e-9 * length(&forward));
    assert!(longest(&spiro(&forward)) < 4.0);
}

/// Three turns round one circle, nearly: plain iteration creeps, and its jump of curvature was once measured as if the
/// knots were cusps. What is called solved is so as the residual is defined.
#[test]
fn bends_are_not_excused_as_cusps() {
    let contour = Contour::open([
        (1340.632134522616, 0.0),
        (-1340.6321240864638, 1.641800839596605e-13),
        (1340.632128824576, -3.2836016907982385e-13),
        (-1340.6321153826882, 4.925402486812662e-13),
    ]);
    let solution = solve(&contour, &*catalog::spline("euler").unwrap()).unwrap();
    assert_eq!(solution.report.status(), Status::Solved, "{:?}", solution.report);
    let chord = 2.0 * 1340.6;
    for knot in &solution.knots[1..3] {
        let jump = knot.curvature_out.unwrap() - knot.curvature_in.unwrap();
        assert!((jump * chord).abs() <= 1.1e-9, "{jump:e}");
    }
}

/// Which way a knot turns that is passed straight on is nothing but rounding, and decided once which winding the
/// search tried first: similar copies had other curves.
#[test]
fn a_knot_passed_straight_on_has_no_say() {
    let knots = [
        (100.0, -200.0, Join::Corner),
        (211.59151344438789, -165.48069974285121, Join::G2),
        (206.71937168044113, -28.48445791437598, Join::G4),
        (88.53097152493964, -46.793918626099874, Join::CurveToTerminal),
        (65.85515908633268, -2.231518216683895, Join::G2),
        (-1.659371127699501, 130.44772037716564, Join::G2),
        (-60.61334796711728, 209.41789298571916, Join::Corner),
    ];
    for spline in ["spiro", "mvc"] {
        let spline = catalog::spline(spline).unwrap();
        let length = |map: Affine| {
            let knots = knots.map(|(x, y, join)| Knot::new(map * Point::new(x, y)).join(join));
            solve(&Contour::open(knots), &*spline).unwrap().curve.length()
        };
        let first = length(Affine::IDENTITY);
        for i in 0..40 {
            let map = Affine::rotate(0.17 * f64::from(i))
                * Affine::scale_non_uniform(1.0, if i % 2 == 0 { 1.0 } else { -1.0 });
            assert!((length(map) - first).abs() < 1e-6 * first, "{map:?}");
        }
    }
}

/// Found by the law of mirror images: on the way, a segment becomes an arc that turns more than once, whose
/// chord is half a turn from its middle, to the left and to the right.
#[test]
fn mirror_images_take_the_same_course() {
    use Join::{Corner, G2, G4, TerminalToCurve};
    let knots = [
        (147.7668244562803, -185.22398966693302, Corner),
        (223.50718717368852, -161.79474991985742, G2),
        (295.86090916315726, -190.03167098839145, G2),
        (299.0798480803349, -117.6846167543702, G4),
        (387.40252994613144, -10.636687764589112, G4),
        (522.5871002617646, 27.871204813539215, G2),
        (502.02301145521255, 135.74790420015228, TerminalToCurve),
        (468.94921506118135, 173.24622405699614, Corner),
    ];
    let mvc = catalog::spline("mvc").unwrap();
    let [image, mirrored] = [1.0, -1.0].map(|sign| {
        let knot = |(x, y, join)| Knot::new((x, sign * y)).join(join);
        solve(&Contour::open(knots.map(knot)), &*mvc).unwrap()
    });
    assert_eq!(image.report.iterations, mirrored.report.iterations);
    assert_eq!(image.curve.length(), mirrored.curve.length());
}
