use std::f64::consts::{FRAC_PI_2, PI};

use kurbo::{CubicBez, ParamCurveArclen, PathSeg};

use super::*;
use crate::segment::UnitBezier;

fn measured(p1: (f64, f64), p2: (f64, f64)) -> Measured<UnitBezier> {
    let cubic = CubicBez::new((0.0, 0.0), p1, p2, (1.0, 0.0));
    Measured::new(UnitBezier::new(PathSeg::Cubic(cubic)))
}

/// Gentle, an S, a loop, nearly a cusp, a cusp inside, cusps at the ends.
fn samples() -> Vec<Measured<UnitBezier>> {
    vec![
        measured((0.3, 0.2), (0.7, 0.3)),
        measured((0.3, 0.6), (0.7, -0.5)),
        measured((1.6, 1.2), (-0.6, 1.2)),
        measured((1.0 + 1e-6, 1.0), (0.0, 1.0)),
        measured((1.0, 1.0), (0.0, 1.0)),
        measured((0.0, 0.0), (0.5, 0.5)),
        measured((0.2, 0.5), (1.0, 0.0)),
        measured((-0.1, 0.1), (1.1, 0.3)),
    ]
}

#[test]
fn lengths_are_those_of_another_program() {
    for curve in samples() {
        let Some(PathSeg::Cubic(cubic)) = curve.bezier(0.0, curve.length()) else {
            panic!("a cubic is a Bézier");
        };
        assert!((curve.length() - cubic.arclen(1e-12)).abs() < 1e-10, "{curve:?}");
    }
}

/// First and last legs within a right angle of the chord, short ones and long ones.
#[test]
fn what_is_known_before_a_curve_is_measured_is_what_measuring_tells() {
    let legs = [0.05, 0.5, 0.9, 2.0].into_iter().flat_map(|size| {
        (-6..=6).map(move |turn| Complex64::from_polar(size, f64::from(turn) * PI / 13.0))
    });
    let legs: Vec<Complex64> = legs.collect();
    let mut unmeasured = 0;
    for (first, last) in legs.iter().flat_map(|first| legs.iter().map(move |last| (first, last))) {
        let curve = measured((first.re, first.im), (1.0 - last.re, -last.im));
        let bound = curve.length_bound();
        unmeasured += i32::from(curve.arcs.get().is_none());
        let [start, end] = curve.ends();
        assert!((start.direction - first.arg()).abs() < 1e-15, "{first} {last}");
        let told = Arcs::of(&curve.curve, start.direction);
        assert!((end.direction - told.direction).abs() < 1e-14, "{first} {last}");
        assert!(curve.length() == told.length && curve.length() <= bound, "{first} {last}");
    }
    // Those whose middle leg points forwards, too: of 52 · 52.
    assert!(unmeasured > 1000, "{unmeasured}");
}

#[test]
fn what_has_no_finite_length_is_known_at_once() {
    let huge = measured((1e308, 1e308), (1e308, -1e308));
    assert!(!huge.length_bound().is_finite(), "{}", huge.length_bound());
    assert!(measured((f64::NAN, 0.0), (0.5, 0.1)).length_bound().is_nan());
}

/// Stretches of all sizes, of curves with loops and cusps: those near a cusp are never gentle.
#[test]
fn gentle_stretches_are_as_long_as_their_parts() {
    let mut gentle = 0;
    for curve in samples() {
        for pieces in [1, 2, 4, 8, 32, 1024] {
            for i in 0..pieces {
                let [from, to] = [i, i + 1].map(|i| f64::from(i) / f64::from(pieces));
                if let Some(length) = curve.curve.gentle_length(from, to) {
                    let at = |part: i32| from + (to - from) * f64::from(part) / 8.0;
                    let fine: f64 =
                        (0..8).map(|part| arc(&curve.curve, at(part), at(part + 1))).sum();
                    assert!((length - fine).abs() <= 1e-15 * fine, "{curve:?} {from} {to}");
                    gentle += 1;
                }
            }
        }
    }
    // Of 8 · 1071.
    assert!(gentle > 8000, "{gentle}");
}

/// Velocities all around the limit, so that the worst lies among them, and whole arcs as parts of them.
#[test]
fn sixteen_nodes_measure_what_is_gentle() {
    let at = |turn: i32| Complex64::from_polar(0.3 - 1e-9, f64::from(turn) * PI / 6.0);
    for (i, j) in (0..12).flat_map(|i| (0..12).map(move |j| (i, j))) {
        // The three add up to three times the chord.
        let mut legs = [at(i), at(j), -at(i) - at(j)];
        for _ in 0..3 {
            legs.rotate_left(1);
            let size = legs.iter().fold(0.3, |size: f64, leg| size.max(leg.norm()));
            let [first, _, last] = legs.map(|leg| (1.0 + leg * (0.3 - 1e-9) / size) / 3.0);
            let curve = measured((first.re, first.im), (1.0 - last.re, -last.im));
            assert!(curve.arcs().later.is_empty());
            assert!(
                (curve.curve.gentle_length(0.0, 1.0).unwrap() - arc(&curve.curve, 0.0, 1.0)).abs()
                    < 5e-16
            );
            for to in [1.0, 0.7, 0.31] {
                let stops: Vec<f64> = (0..=32).map(|i| to * f64::from(i) / 32.0).collect();
                let fine: f64 =
                    stops.windows(2).map(|ends| arc(&curve.curve, ends[0], ends[1])).sum();
                assert!((arc(&curve.curve, 0.0, to) - fine).abs() < 5e-16, "{first} {last} {to}");
            }
        }
    }
}

#[test]
fn arc_length_and_parameter_are_inverse() {
    for curve in samples() {
        for i in 0..=200 {
            let u = f64::from(i) / 200.0;
            let s = curve.arc_length(u);
            let back = curve.arc_length(curve.parameter(s));
            assert!((back - s).abs() < 1e-14, "{u}: {s} {back}");
        }
    }
}

#[test]
fn direction_is_continuous_and_belongs_to_the_points() {
    for (which, curve) in samples().into_iter().enumerate() {
        let (n, h) = (2000, 1e-6);
        let mut last = curve.direction(0.0);
        for i in 1..n {
            let s = curve.length() * f64::from(i) / f64::from(n);
            let step = curve.point(s + h) - curve.point(s - h);
            let direction = curve.direction(s);
            // Within a step of the cusp or the sharp bend (samples 3 and 4) all may happen.
            if (step.norm() / (2.0 * h) - 1.0).abs() < 1e-5 {
                assert!((step.arg() - direction).sin().abs() < 2e-3, "{which} {s}");
                assert!((step.arg() - direction).cos() > 0.0, "{which} {s}");
            }
            let turn = (direction - last).abs();
            let at_cusp = matches!(which, 3 | 4) && (s / curve.length() - 0.5).abs() < 5e-3;
            assert!(turn < 0.1 || (at_cusp && (turn - PI).abs() < 0.6), "{which} {s}: {turn}");
            last = direction;
        }
    }
}

#[test]
fn curvature_and_derivatives_agree_with_differences() {
    for curve in samples().iter().take(3) {
        let h = 1e-5;
        for i in 1..40 {
            let s = curve.length() * f64::from(i) / 40.0;
            let jet = curve.curvature_jet(s);
            let slope = (curve.direction(s + h) - curve.direction(s - h)) / (2.0 * h);
            assert!((slope - jet[0]).abs() < 1e-6 * (1.0 + jet[0].abs()), "{s}");
            let (after, before) = (curve.curvature_jet(s + h), curve.curvature_jet(s - h));
            for order in 0..3 {
                let slope = (after[order] - before[order]) / (2.0 * h);
                let exact = jet[order + 1];
                assert!((slope - exact).abs() < 1e-5 * (1.0 + exact.abs()), "{s} {order}");
            }
        }
    }
}

#[test]
fn a_cusp_is_finite() {
    for curve in samples() {
        for s in [0.0, curve.length() / 2.0, curve.length()] {
            assert!(curve.curvature_jet(s).iter().all(|k| k.is_finite()));
            assert!(curve.direction(s).is_finite());
        }
        let energy = curve.integral(0.0, curve.length(), &|jet| jet[0] * jet[0]);
        assert!(energy.is_finite() && energy > 0.0);
    }
    // The velocity of the last but two is 0 at its start, and it leaves toward its other arm.
    let leaving = samples()[5].direction(0.0);
    assert!((leaving - FRAC_PI_2 / 2.0).abs() < 1e-15);
}
