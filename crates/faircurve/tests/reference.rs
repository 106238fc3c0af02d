//! The library against values computed independently of it (`tests/reference/README.md`).

use std::path::Path;

use faircurve::families::euler::fit_euler;
use faircurve::frame::{ChordAngles, wrap_angle};
use faircurve::numeric::spiro_integral::{spiro_integral, wildness};
use faircurve::{Contour, Join, Knot, PolynomialSpiral, Solution, catalog, solve};
use serde_json::Value;

fn load(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name);
    let text = std::fs::read_to_string(&path).expect("the reference file is in the repository");
    serde_json::from_str(&text).expect("the reference file is JSON")
}

/// A number, or a number written out with more digits than one holds.
fn number(value: &Value) -> f64 {
    match value {
        Value::String(digits) => digits.parse().expect("digits"),
        value => value.as_f64().expect("a number"),
    }
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    let list: Vec<f64> = list(value).iter().map(number).collect();
    list.try_into().expect("as many numbers as wanted")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

#[test]
fn spiro_integral_over_the_whole_table() {
    let file = load("spiro_integral.json");
    let rows = list(&file["rows"]);
    assert_eq!(rows.len(), 100);
    for row in rows {
        let k = numbers::<4>(&row["k"]);
        let ours = spiro_integral(k);
        // 2e-15, far inside the 1e-15 + 2e-16·wildness that is promised for the wild rows.
        assert!(wildness(k) < 120.0);
        for (name, ours, exact) in [("re", ours.re, &row["re"]), ("im", ours.im, &row["im"])] {
            let error = (ours - number(exact)).abs();
            assert!(error <= 2e-15, "{k:?} {name}: {ours}, off by {error:e}");
        }
    }
}

#[test]
fn euler_fit_over_the_whole_square() {
    let file = load("euler_fit.json");
    let rows = list(&file["rows"]);
    assert_eq!(rows.len(), 99);
    for row in rows {
        let angles = ChordAngles::new(number(&row["theta0"]), number(&row["theta1"]));
        let [k0, k1] = [number(&row["k0"]), number(&row["k1"])];
        let chord_over_arc = number(&row["chord_over_arc"]);
        // The table has one of each pair of reversed, mirrored and both.
        for (angles, k0, k1) in [
            (angles, k0, k1),
            (ChordAngles::new(angles.theta1, angles.theta0), k0, -k1),
            (angles.mirrored(), -k0, -k1),
            (angles.reversed(), -k0, k1),
        ] {
            let spiral = fit_euler(angles).unwrap();
            let [ours_0, ours_1, ..] = spiral.k;
            assert!((ours_0 - k0).abs() <= 1e-15 * (1.0 + k0.abs()), "{angles:?}: k0 {ours_0}");
            let error = (ours_1 - k1).abs();
            assert!(error <= 1e-13 * (1.0 + k1.abs()), "{angles:?}: k1 {ours_1} off by {error:e}");
            assert!((spiral.chord().length - chord_over_arc).abs() <= 1e-14, "{angles:?}");
        }
    }
}

fn contour(set: &Value, joins: impl Iterator<Item = Join>) -> Contour {
    let knots: Vec<Knot> = list(&set["points"])
        .iter()
        .map(|point| Knot::from((number(&point[0]), number(&point[1]))))
        .zip(joins)
        .map(|(knot, join)| knot.join(join))
        .collect();
    if set["closed"] == true { Contour::closed(knots) } else { Contour::open(knots) }
}

/// Solved as asked, in the directions of the file.
fn assert_tangents(name: &str, solution: &Solution, set: &Value, uncertainty: f64) {
    assert!(solution.report.relaxed.is_empty(), "{name}: {:?}", solution.report.relaxed);
    assert!(solution.report.residual < 1e-9, "{name}: {:e}", solution.report.residual);
    let tangents = list(&set["tangent"]);
    assert_eq!(tangents.len(), solution.knots.len());
    for (i, (knot, tangent)) in solution.knots.iter().zip(tangents).enumerate() {
        for ours in [knot.direction_in, knot.direction_out].into_iter().flatten() {
            let error = wrap_angle(ours - number(tangent)).abs();
            assert!(error <= uncertainty, "{name}, knot {i}: {ours}, off by {error:e}");
        }
    }
}

/// Each segment has the parameters given, relative to their size.
fn assert_parameters(name: &str, solution: &Solution, expected: &[[f64; 4]], uncertainty: f64) {
    let segments = solution.curve.segments();
    assert_eq!(segments.len(), expected.len());
    for (i, (segment, expected)) in segments.iter().zip(expected).enumerate() {
        let ours = PolynomialSpiral::new(segment.kappa().unwrap());
        let size = 1.0 + expected.iter().fold(0.0, |size: f64, k| size.max(k.abs()));
        for j in 0..4 {
            let error = (ours.k[j] - expected[j]).abs();
            let k = ours.k[j];
            assert!(
                error <= uncertainty * size,
                "{name}, segment {i}: k{j} = {k}, off by {error:e}"
            );
        }
    }
}

#[test]
fn euler_splines() {
    let file = load("euler_spline.json");
    // "max over sets of mp_dev fields (<= 1e-12)".
    let uncertainty = 1e-12;
    let spline = catalog::spline("euler").unwrap();
    let sets = file["sets"].as_object().expect("sets by name");
    assert_eq!(sets.len(), 9);
    for (name, set) in sets {
        let contour = contour(set, std::iter::repeat(Join::G2));
        let solution = solve(&contour, &*spline).unwrap();
        assert_tangents(name, &solution, set, uncertainty);
        for (i, (knot, curvature)) in solution.knots.iter().zip(list(&set["curvature"])).enumerate()
        {
            let curvature = number(curvature);
            for ours in [knot.curvature_in, knot.curvature_out].into_iter().flatten() {
                let error = (ours - curvature).abs();
                let bound = uncertainty * (1.0 + curvature.abs());
                assert!(error <= bound, "{name}, knot {i}: curvature {ours}, off by {error:e}");
            }
        }
        if let Some(segments) = set["segments_unit_arclength"].as_array() {
            let expected: Vec<[f64; 4]> = segments
                .iter()
                .map(|segment| {
                    let [k0, k1] = numbers::<2>(segment);
                    [k0, k1, 0.0, 0.0]
                })
                .collect();
            assert_parameters(name, &solution, &expected, uncertainty);
        }
    }
}

#[test]
fn spiro_splines() {
    let file = load("poly_spiral.json");
    let uncertainty = number(&file["uncertainty"]);
    let spline = catalog::spline("spiro").unwrap();
    let sets = file["sets"].as_object().expect("sets by name");
    let mut solved = 0;
    for (name, set) in sets {
        let Some(types) = set["types"].as_str() else {
            assert!(set["failed"].is_string(), "{name} has neither a solution nor a reason");
            continue;
        };
        let joins = types.chars().map(|letter| match letter {
            '4' => Join::G4,
            '2' => Join::G2,
            'L' => Join::TerminalToCurve,
            'R' => Join::CurveToTerminal,
            other => panic!("{name}: type {other}"),
        });
        let solution = solve(&contour(set, joins), &*spline).unwrap();
        assert_tangents(name, &solution, set, uncertainty);
        let expected: Vec<[f64; 4]> = list(&set["k"]).iter().map(numbers::<4>).collect();
        assert_parameters(name, &solution, &expected, uncertainty);
        for (i, (segment, chord_over_arc)) in
            solution.curve.segments().iter().zip(list(&set["chord_over_arc"])).enumerate()
        {
            let ours = segment.chord_length() / segment.length();
            assert!((ours - number(chord_over_arc)).abs() <= uncertainty, "{name}, segment {i}");
        }
        solved += 1;
    }
    assert_eq!(solved, 15);
}
