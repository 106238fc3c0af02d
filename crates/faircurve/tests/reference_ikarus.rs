//! The tangents of Lagrange and Ikarus against values computed independently
//! (`tests/reference/README.md`).

use std::path::Path;

use faircurve::frame::wrap_angle;
use faircurve::kurbo::Point;
use faircurve::{Contour, Solution, catalog, solve};
use serde_json::Value;

fn sets() -> Vec<(String, Contour, Vec<[f64; 2]>)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/ikarus.json");
    let text = std::fs::read_to_string(&path).expect("the reference file is in the repository");
    let file: Value = serde_json::from_str(&text).expect("the reference file is JSON");
    let number = |value: &Value| value.as_f64().expect("a number");
    let sets = file["sets"].as_object().expect("sets by name");
    assert_eq!(sets.len(), 7);
    sets.iter()
        .map(|(name, set)| {
            let points = set["points"].as_array().expect("points").iter();
            let points = points.map(|p| Point::new(number(&p[0]), number(&p[1])));
            let contour = Contour { closed: set["closed"] == true, ..Contour::open(points) };
            let tangents = set["tangents"].as_array().expect("tangents").iter();
            let tangents = tangents.map(|t| [number(&t["incoming"]), number(&t["outgoing"])]);
            (name.clone(), contour, tangents.collect())
        })
        .collect()
}

fn solved(spline: &str, contour: &Contour) -> Solution {
    let solution = solve(contour, &*catalog::spline(spline).unwrap()).unwrap();
    assert!(solution.report.relaxed.is_empty() && solution.report.residual <= 1e-12);
    solution
}

#[test]
fn one_sided_tangents_are_those_of_the_lagrange_spline() {
    for (name, contour, tangents) in sets() {
        let solution = solved("lagrange", &contour);
        for (i, (knot, [incoming, outgoing])) in solution.knots.iter().zip(tangents).enumerate() {
            for (ours, expected) in [(knot.direction_in, incoming), (knot.direction_out, outgoing)]
            {
                let off = ours.map_or(0.0, |ours| wrap_angle(ours - expected).abs());
                assert!(off <= 1e-12, "{name}, knot {i}: {ours:?}, off by {off:e}");
            }
        }
    }
}

#[test]
fn ikarus_halves_the_angle_between_them() {
    for (name, contour, tangents) in sets() {
        let solution = solved("ikarus", &contour);
        for (i, (knot, [incoming, outgoing])) in solution.knots.iter().zip(tangents).enumerate() {
            let middle = incoming + wrap_angle(outgoing - incoming) / 2.0;
            for ours in [knot.direction_in, knot.direction_out].into_iter().flatten() {
                let off = wrap_angle(ours - middle).abs();
                assert!(off <= 1e-12, "{name}, knot {i}: {ours}, off by {off:e}");
            }
        }
    }
}
