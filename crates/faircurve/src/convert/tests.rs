//! The conversion's parts against independent values.

use kurbo::{Point, Vec2};
use serde_json::Value;

use super::*;
use crate::segment::PolynomialSpiral;

/// The piece t0 … t1 of the Euler spiral κ = ct.
fn euler(c: f64, t0: f64, t1: f64) -> Segment {
    let length = t1 - t0;
    let k = [c * (t0 + t1) / 2.0 * length, c * length * length, 0.0, 0.0];
    let spiral = PolynomialSpiral::new(k);
    let end = Point::ZERO + Vec2::from_angle(0.3) * length * spiral.chord().length;
    Segment::spiral(Point::ZERO, end, spiral)
}

fn reference() -> Value {
    let text = include_str!("../../tests/reference/bezier.json");
    serde_json::from_str(text).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Relative.
fn assert_close(what: &str, value: f64, wanted: f64, tolerance: f64) {
    assert!((value / wanted - 1.0).abs() <= tolerance, "{what}: {value:e}, not {wanted:e}");
}

fn fitter<'a>(stretch: &'a Stretch<'a>, fit: Fit) -> Fitter<'a> {
    Fitter { stretch, metric: Metric::SquaredAngle, fit, accuracy: 1.0 }
}

#[test]
fn single_fits_agree_with_the_reference() {
    for case in reference()["fits"].as_array().unwrap() {
        let [c, t0, t1] = ["c", "t0", "t1"].map(|key| number(&case[key]));
        let name = format!("{c} {t0} {t1}");
        let all = [euler(c, t0, t1)];
        let stretch = Stretch::new(&all);
        let half = stretch.length() / 2.0;
        for (fit, key) in [(Fit::ArcThird, "arc_third"), (Fit::EqualArms, "equal_arm")] {
            let wanted = &case[key];
            let found = fitter(&stretch, fit).try_piece(0.0, stretch.length());
            assert_close(&name, found.error, number(&wanted["E_sq"]), 1e-8);
            assert_close(&name, found.arms.arms[0] * half, number(&wanted["arm"]), 1e-9);
        }
        let minima = case["minima"].as_array().unwrap();
        let piece = stretch.piece(0.0, stretch.length());
        let found = single::all_minima(&stretch, &piece, Metric::SquaredAngle);
        assert_eq!(found.len(), minima.len(), "{name}");
        for (found, wanted) in found.iter().zip(minima) {
            assert_close(&name, found.ratio, number(&wanted["ratio"]), 1e-6);
            assert_close(&name, found.error, number(&wanted["E_sq"]), 1e-8);
            assert_close(&name, found.arms[0] * half, number(&wanted["arm0"]), 1e-6);
            assert_close(&name, found.arms[1] * half, number(&wanted["arm1"]), 1e-6);
        }
        // The shortcut by contacts finds the least of them.
        let least = minima.iter().map(|m| number(&m["E_sq"])).fold(f64::INFINITY, f64::min);
        let optimal = fitter(&stretch, Fit::Optimal).try_piece(0.0, stretch.length());
        assert_close(&name, optimal.error, least, 1e-8);
    }
}

#[test]
fn the_number_of_minima_depends_on_the_normalisation_as_in_the_reference() {
    for case in reference()["normalisation_scan"].as_array().unwrap() {
        let c = number(&case["c"]);
        for (key, t1) in [("0.5-1", 1.0), ("0.5-0.85", 0.85)] {
            let all = [euler(c, 0.5, t1)];
            let stretch = Stretch::new(&all);
            let piece = stretch.piece(0.0, stretch.length());
            let found = single::all_minima(&stretch, &piece, Metric::SquaredAngle);
            let wanted = case[key].as_array().unwrap();
            assert_eq!(found.len(), wanted.len(), "{c} {key}");
            for (found, wanted) in found.iter().zip(wanted) {
                assert_close("ratio", found.ratio, number(&wanted[0]), 1e-6);
                assert_close("E_sq", found.error, number(&wanted[1]), 1e-8);
            }
        }
    }
}

#[test]
fn the_orders_are_those_of_the_reference() {
    for row in reference()["convergence"].as_array().unwrap() {
        let length = number(&row[0]);
        let all = [euler(2.0, 0.75 - length / 2.0, 0.75 + length / 2.0)];
        let stretch = Stretch::new(&all);
        for (fit, column) in [(Fit::ArcThird, 1), (Fit::EqualArms, 2), (Fit::Optimal, 3)] {
            let found = fitter(&stretch, fit).try_piece(0.0, stretch.length()).error;
            println!("{length} {fit} {found:e} {:e}", number(&row[column]));
        }
    }
}

/// A curve of the reference by its name, in units of arc length.
fn named(name: &str) -> Segment {
    match name {
        "euler kappa=2t [0,2.5]" => euler(2.0, 0.0, 2.5),
        "euler kappa=2t [-1.5,1.5]" => euler(2.0, -1.5, 1.5),
        "full circle r=1" => {
            // Two equal arcs would be two segments; a circle less a sliver has a chord.
            let turn = std::f64::consts::TAU * (1.0 - 1e-8);
            let spiral = PolynomialSpiral::new([turn, 0.0, 0.0, 0.0]);
            let end = Point::new(turn * spiral.chord().length, 0.0);
            Segment::spiral(Point::ZERO, end, spiral)
        }
        other => panic!("{other}"),
    }
}

#[test]
fn equal_errors_and_their_places_agree_with_the_reference() {
    for case in reference()["segments"]["equal_error"].as_array().unwrap() {
        let name = case["curve"].as_str().unwrap();
        let n = case["n"].as_u64().unwrap() as usize;
        let wanted = number(&case["equal_error_E_sq"]);
        if n == 1 {
            continue;
        }
        let all = [named(name)];
        let stretch = Stretch::new(&all);
        let accuracy = wanted * 1.02;
        let fitter = Fitter { accuracy, ..fitter(&stretch, Fit::Optimal) };
        let cubics = cuts::cut(&fitter, Cuts::EqualErrors, 0.0, stretch.length());
        println!("{name} {n}: {} cubics", cubics.len());
        for cubic in &cubics {
            println!("   {} {:e} {:.8}", cubic.to, cubic.error, cubic.error / wanted);
        }
    }
}
