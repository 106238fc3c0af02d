use std::f64::consts::TAU;

use super::*;
use crate::families::euler::EulerSpirals;
use crate::frame::{ChordAngles, EndCurvature};
use crate::outline::Contour;
use crate::spline::{Status, solve};
use crate::two_param::continuity::{Continuity, NaturalEnd};
use crate::two_param::curvature_map::{CurvatureMap, EndCurvatures, SegmentContext};
use crate::two_param::shape::{SegmentEnds, SegmentShape};
use crate::two_param::spline::TwoParamSpline;

/// The response of the segment agrees with what the segment itself says, and with differences.
#[test]
fn response_agrees_with_the_segment_and_with_differences() {
    let family = PolynomialSpirals;
    for k in [
        [0.0; 4],
        [1.0, 0.0, 0.0, 0.0],
        [1.2, -3.0, 9.0, 40.0],
        [-2.0, 5.0, -30.0, 100.0],
        [0.3, 8.0, 20.0, -300.0],
    ] {
        let response = family.respond(k);
        let spiral = PolynomialSpiral::new(k);
        let ChordAngles { theta0, theta1 } = spiral.chord_angles();
        assert!((response.ends.jets[0] - theta0).abs() < 1e-14);
        assert!((response.ends.jets[1] - theta1).abs() < 1e-14);
        // Moving the parameters by what a change of one jet asks moves just that jet.
        let h = 1e-6;
        for jet in 0..4 {
            let moved = |sign: f64| {
                let step = |row: usize| sign * h * response.parameters_by_jets[row][jet];
                family.respond(std::array::from_fn(|row| k[row] + step(row)))
            };
            let (up, down) = (moved(1.0), moved(-1.0));
            for other in 0..4 {
                let slope = (up.ends.jets[other] - down.ends.jets[other]) / (2.0 * h);
                let expected = if other == jet { 1.0 } else { 0.0 };
                assert!((slope - expected).abs() < 1e-6, "{k:?} {jet} {other}: {slope}");
                let slope = (up.ends.derivatives[other] - down.ends.derivatives[other]) / (2.0 * h);
                let claimed = response.derivatives_by_jets[other][jet];
                assert!((slope - claimed).abs() < 1e-5 * (1.0 + claimed.abs()), "{k:?} {slope}");
            }
        }
    }
}

/// What comes out has the ends that went in, straightest first; and a segment with a flat middle is
/// found from its own ends, whatever full turns are added to its angles.
#[test]
fn segments_are_found_between_their_ends() {
    let family = PolynomialSpirals;
    for k in [
        [0.0; 4],
        [0.5, -2.0, 30.0, 100.0],
        [-1.0, 3.0, -150.0, 900.0],
        [2.0, 10.0, 300.0, -1500.0],
        [-2.5, -8.0, 420.0, 400.0],
    ] {
        let [theta0, theta1, kappa0, kappa1] = family.respond(k).ends.jets;
        let found = family.between_ends([theta0 + TAU, theta1 - 3.0 * TAU, kappa0, kappa1]);
        let same =
            |other: &[f64; 4]| (0..4).all(|j| (other[j] - k[j]).abs() < 1e-5 * (1.0 + k[j].abs()));
        assert!(found.iter().any(same), "{k:?}: {found:?}");
        let mut straightness = 1.0;
        for found in found {
            let response = family.respond(found);
            let turns = |angle: f64| (angle / TAU - (angle / TAU).round()).abs() * TAU;
            assert!(turns(response.ends.jets[0] - theta0) < 1e-5, "{k:?}: {found:?}");
            assert!(turns(response.ends.jets[1] - theta1) < 1e-5, "{k:?}: {found:?}");
            assert!((response.ends.jets[2] - kappa0).abs() < 1e-4, "{k:?}: {found:?}");
            assert!((response.ends.jets[3] - kappa1).abs() < 1e-4, "{k:?}: {found:?}");
            assert!(response.ends.straightness <= straightness + 1e-9);
            straightness = response.ends.straightness;
        }
    }
}

/// A map of its own: curvatures are so many times the sum of the angles, less or more so many
/// times their difference; (1, 3) is Euler's to first order.
#[derive(Clone, Copy, Debug)]
struct Linear(f64, f64);

impl CurvatureMap for Linear {
    fn curvatures(&self, angles: ChordAngles, _context: &SegmentContext) -> EndCurvatures {
        let (sum, difference) = (angles.theta0 + angles.theta1, angles.theta1 - angles.theta0);
        let at = |sign: f64| EndCurvature::finite(self.0 * sum + sign * self.1 * difference);
        let by = |sign: f64| {
            [self.0 - sign * self.1, self.0 + sign * self.1]
                .map(|num| EndCurvature { num, den: 0.0 })
        };
        EndCurvatures { value: [at(-1.0), at(1.0)], by_angle: [by(-1.0), by(1.0)] }
    }

    fn limit(&self) -> f64 {
        std::f64::consts::PI
    }

    fn is_linear(&self) -> bool {
        true
    }
}

fn contour() -> Contour {
    Contour::open([(0.0, 0.0), (1.0, 1.0), (2.0, 0.3), (3.0, 1.0), (2.5, 2.2), (1.0, 2.0)])
}

#[test]
fn as_a_shape_it_keeps_the_curvatures_of_any_map() {
    for map in [Linear(1.0, 1.0), Linear(1.0, 3.0), Linear(0.8, 3.6)] {
        let rule = Continuity { map, end: NaturalEnd::Arc };
        let shape = SpiroSegments { own: EulerSpirals };
        let spline = TwoParamSpline::new(&crate::families::euler::INFO, rule, shape);
        let solution = solve(&contour(), &spline).unwrap();
        assert_eq!(solution.report.status(), Status::Solved, "{:?}", solution.report);
        assert!(solution.report.residual < 1e-11);
        for (i, segment) in solution.curve.segments().iter().enumerate() {
            let (length, chord) = (segment.length(), segment.chord_length());
            let angles = ChordAngles::from_directions(
                segment.direction(0.0),
                crate::frame::direction(segment.end() - segment.start()),
                segment.direction(length),
            );
            let expected = map.curvatures(angles, &SegmentContext::UNIT).value;
            for (s, expected) in [0.0, length].into_iter().zip(expected) {
                let off = segment.curvature(s) * chord - expected.num;
                assert!(off.abs() < 1e-11, "{map:?}, segment {i}: {off:e}");
            }
        }
    }
}

#[test]
fn as_a_shape_for_the_euler_map_it_is_the_euler_spiral() {
    let rule = Continuity { map: EulerSpirals, end: NaturalEnd::Arc };
    let shape = SpiroSegments { own: EulerSpirals };
    let spline = TwoParamSpline::new(&crate::families::euler::INFO, rule, shape);
    let solution = solve(&contour(), &spline).unwrap();
    let euler = solve(&contour(), &*crate::catalog::spline("euler").unwrap()).unwrap();
    for (a, b) in solution.curve.segments().iter().zip(euler.curve.segments()) {
        let (a, b) = (a.kappa().unwrap(), b.kappa().unwrap());
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-11), "{a:?} {b:?}");
    }
}

#[test]
fn what_it_cannot_fill_the_own_shape_fills_and_the_report_says_so() {
    // Curvatures of hundreds at the ends of a unit chord.
    let rule = Continuity { map: Linear(500.0, 1500.0), end: NaturalEnd::Arc };
    for own in [Wild(true), Wild(false)] {
        let spline =
            TwoParamSpline::new(&crate::families::euler::INFO, rule, SpiroSegments { own });
        let report = solve(&contour(), &spline).unwrap().report;
        assert_eq!(report.status(), Status::Relaxed);
        let of = |is_segment: bool| {
            let fits = move |relaxed: &&crate::Relaxation| {
                matches!(relaxed.place, crate::Place::Segment(_)) == is_segment
            };
            report.relaxed.iter().filter(fits)
        };
        assert_eq!(of(true).count(), 5);
        assert!(of(true).all(|relaxed| (relaxed.asked, relaxed.got) == ("spiro", "own")));
        // `Wild` has Euler's curvatures in truth, whatever it claims: the knots are relaxed to G1.
        assert_eq!(of(false).count(), 4);
        assert!(of(false).all(|relaxed| (relaxed.asked, relaxed.got) == ("g2", "g1")));
        assert!(report.residual <= 1e-9, "{report:?}");
    }
}

#[test]
fn cusps_and_reversals_are_left_to_the_own_shape() {
    for den in [0.0, -1.0, 1e-300] {
        let cusp = EndCurvature { num: 1.0, den };
        for curvatures in [[cusp, EndCurvature::finite(0.5)], [EndCurvature::finite(0.5), cusp]] {
            let ends = SegmentEnds {
                angles: ChordAngles::new(0.3, 0.4),
                curvatures: Some(curvatures),
                context: SegmentContext::UNIT,
            };
            let shape = SpiroSegments { own: EulerSpirals };
            let (start, end) = (Point::ZERO, Point::new(1.0, 0.0));
            let (segment, stand_in) = shape.place_or_stand_in(start, end, &ends);
            assert_eq!(stand_in.unwrap().got, "own");
            assert_eq!(segment, EulerSpirals.place(start, end, &ends));
        }
    }
}

/// Without curvatures, Euler's are as good as any.
#[test]
fn for_rules_that_know_no_curvature_it_is_the_euler_spiral() {
    let ends = SegmentEnds {
        angles: ChordAngles::new(0.3, 0.9),
        curvatures: None,
        context: SegmentContext::UNIT,
    };
    let (start, end) = (Point::ZERO, Point::new(1.0, 0.0));
    let (segment, stand_in) =
        SpiroSegments { own: Wild(true) }.place_or_stand_in(start, end, &ends);
    assert_eq!((segment, stand_in), (EulerSpirals.place(start, end, &ends), None));
}

/// A shape that says of itself whether it keeps curvatures.
#[derive(Clone, Copy, Debug)]
struct Wild(bool);

impl SegmentShape for Wild {
    fn place(&self, start: Point, end: Point, ends: &SegmentEnds) -> Segment {
        EulerSpirals.place(start, end, ends)
    }

    fn keeps_curvature(&self) -> bool {
        self.0
    }
}

/// Ends all over, from every corner of what can be asked: nothing but a good answer or none.
#[test]
fn fits_meet_their_ends() {
    let mut state = 7u64;
    let mut random = move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let mut found = [0; 4];
    for n in 0..4000 {
        let most = [2.0, 8.0, 30.0, 1e6][n % 4];
        let angles = ChordAngles::new(3.1 * random(), 3.1 * random());
        let curvatures = [most * random(), most * random()];
        let Some(spiral) = fit_spiral(angles, curvatures) else { continue };
        found[n % 4] += 1;
        let response = PolynomialSpirals.respond(spiral.k);
        let size = 1.0 + curvatures[0].abs().max(curvatures[1].abs());
        let off = [
            crate::frame::wrap_angle(response.ends.jets[0] - angles.theta0),
            crate::frame::wrap_angle(response.ends.jets[1] - angles.theta1),
            (response.ends.jets[2] - curvatures[0]) / size,
            (response.ends.jets[3] - curvatures[1]) / size,
        ];
        assert!(off.iter().all(|off| off.abs() < 1e-12), "{angles:?} {curvatures:?} {off:?}");
    }
    // Newton's method finds nearly all that are wanted; none are of curvatures in the millions.
    assert!(found[..3].iter().all(|found| *found > 950) && found[3] < 10, "{found:?}");
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        assert_eq!(fit_spiral(ChordAngles::new(0.1, 0.2), [bad, 0.0]), None);
        assert_eq!(fit_spiral(ChordAngles::new(bad, 0.2), [0.0, 0.0]), None);
    }
}

/// The tangents and the curvatures of KURGLA 1 and of the circle spline, drawn by spirals.
#[test]
fn as_a_shape_it_draws_other_splines_of_the_catalogue() {
    for name in ["kurgla1", "circle"] {
        let params = crate::catalog::Params::new();
        let own = solve(&contour(), &*crate::catalog::build(name, &params).unwrap()).unwrap();
        let drawn = crate::catalog::build(name, &params.with("shape", "spiro")).unwrap();
        let drawn = solve(&contour(), &*drawn).unwrap();
        assert_eq!(drawn.report.status(), Status::Solved, "{name} {:?}", drawn.report);
        assert!(drawn.curve.segments().iter().all(|segment| segment.kappa().is_some()));
        for (a, b) in own.knots.iter().zip(&drawn.knots) {
            let numbers = |knot: &crate::SolvedKnot| {
                [knot.direction_in, knot.direction_out, knot.curvature_in, knot.curvature_out]
            };
            for (a, b) in numbers(a).into_iter().zip(numbers(b)) {
                let off = a.unwrap_or(0.0) - b.unwrap_or(0.0);
                assert!(off.abs() < 1e-11, "{name} {off:e}");
            }
        }
    }
}
