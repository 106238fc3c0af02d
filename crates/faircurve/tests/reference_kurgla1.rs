//! KURGLA 1 and its segments against values computed independently (`tests/reference/README.md`).

use std::path::Path;

use faircurve::catalog::{self, Params};
use faircurve::families::kurgla1::fit_si_mec;
use faircurve::frame::{ChordAngles, wrap_angle};
use faircurve::{Contour, Solution, Status, solve};
use serde_json::Value;

fn load(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name);
    let text = std::fs::read_to_string(&path).expect("the reference file is in the repository");
    serde_json::from_str(&text).expect("the reference file is JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

#[test]
fn segments_up_to_three_radians() {
    let file = load("simec.json");
    let uncertainty = number(&file["uncertainty"]);
    let rows: Vec<&Value> =
        list(&file["rows"]).iter().chain(list(&file["large_angle_rows"])).collect();
    assert_eq!(rows.len(), 26);
    for row in rows {
        let angles = ChordAngles::new(number(&row["theta0"]), number(&row["theta1"]));
        let [start, end] = [number(&row["kappa_start"]), number(&row["kappa_end"])];
        let (length, energy) = (number(&row["length"]), number(&row["energy"]));
        for (angles, start, end) in [
            (angles, start, end),
            (ChordAngles::new(angles.theta1, angles.theta0), end, start),
            (angles.mirrored(), -start, -end),
            (angles.reversed(), -end, -start),
        ] {
            let fit = fit_si_mec(angles).unwrap();
            let [ours_start, ours_end] = fit.curvatures();
            let bound = uncertainty * (1.0 + start.abs().max(end.abs()));
            assert!((ours_start - start).abs() <= bound, "{angles:?}: {ours_start} {start}");
            assert!((ours_end - end).abs() <= bound, "{angles:?}: {ours_end} {end}");
            assert!((fit.length - length).abs() <= uncertainty * length, "{angles:?}: {fit:?}");
        }
        // The energy, for unit chord, of the segment as drawn.
        let contour = segment(angles);
        let solution = solve(&contour, &*catalog::spline("kurgla1").unwrap()).unwrap();
        let ours = solution.curve.segments()[0].bending_energy();
        assert!((ours - energy).abs() <= 1e-12 * energy, "{angles:?}: energy {ours} {energy}");
    }
}

/// Two knots a unit apart with both tangents given.
fn segment(angles: ChordAngles) -> Contour {
    let tangent = |direction: f64| faircurve::kurbo::Vec2::from_angle(direction);
    let knot = |x: f64, direction: f64| faircurve::Knot::from((x, 0.0)).tangent(tangent(direction));
    Contour::open([knot(0.0, -angles.theta0), knot(1.0, angles.theta1)])
}

#[test]
fn splines_with_both_ends() {
    let file = load("kurgla1.json");
    let uncertainty = number(&file["uncertainty"]);
    let sets = file["sets"].as_object().expect("sets by name");
    assert_eq!(sets.len(), 9);
    for (name, set) in sets {
        let points =
            list(&set["points"]).iter().map(|point| (number(&point[0]), number(&point[1])));
        let contour = Contour { closed: set["closed"] == true, ..Contour::open(points) };
        for (key, end) in [("arc", "arc"), ("natural", "zero-curvature"), ("periodic", "arc")] {
            let expected = &set[key];
            let spline = catalog::build("kurgla1", &Params::new().with("end", end)).unwrap();
            match expected {
                Value::Null => continue,
                Value::String(straight) => {
                    assert_eq!(straight, "straight");
                    assert!(solve(&contour, &*spline).unwrap().curve.segments()[0].is_line());
                }
                expected => {
                    let solution = solve(&contour, &*spline).unwrap();
                    assert_knots(&format!("{name} {key}"), &solution, expected, uncertainty);
                }
            }
        }
    }
}

fn assert_knots(name: &str, solution: &Solution, expected: &Value, uncertainty: f64) {
    assert_eq!(solution.report.status(), Status::Solved, "{name}");
    let numbers = |key: &str| -> Vec<f64> { list(&expected[key]).iter().map(number).collect() };
    let (tangents, curvatures) = (numbers("tangent"), numbers("curvature"));
    assert_eq!(tangents.len(), solution.knots.len());
    for (i, knot) in solution.knots.iter().enumerate() {
        for ours in [knot.direction_in, knot.direction_out].into_iter().flatten() {
            let error = wrap_angle(ours - tangents[i]).abs();
            assert!(error <= uncertainty, "{name}, knot {i}: {ours}, off by {error:e}");
        }
        for ours in [knot.curvature_in, knot.curvature_out].into_iter().flatten() {
            let error = (ours - curvatures[i]).abs();
            let bound = uncertainty * (1.0 + curvatures[i].abs());
            assert!(error <= bound, "{name}, knot {i}: curvature {ours}, off by {error:e}");
        }
    }
}
