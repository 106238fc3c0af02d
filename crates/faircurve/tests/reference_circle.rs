//! The circle spline against values computed independently (`tests/reference/README.md`).

use std::path::Path;

use faircurve::families::circle::CircleBlend;
use faircurve::frame::{ChordAngles, direction, wrap_angle};
use faircurve::segment::ParametricCurve;
use faircurve::{Contour, Status, catalog, solve};
use serde_json::Value;

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

#[test]
fn tangents_curvatures_and_points_on_the_blend() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/circle_spline.json");
    let text = std::fs::read_to_string(&path).expect("the reference file is in the repository");
    let file: Value = serde_json::from_str(&text).expect("the reference file is JSON");
    let uncertainty = number(&file["uncertainty"]);
    let spline = catalog::spline("circle").unwrap();
    let sets = file["sets"].as_object().expect("sets by name");
    assert_eq!(sets.len(), 9);
    for (name, set) in sets {
        if set == "straight" {
            assert_eq!(name, "o_two");
            continue;
        }
        let points: Vec<(f64, f64)> =
            list(&set["points"]).iter().map(|p| (number(&p[0]), number(&p[1]))).collect();
        let contour = Contour { closed: set["closed"] == true, ..Contour::open(points) };
        let solution = solve(&contour, &*spline).unwrap();
        assert_eq!(solution.report.status(), Status::Solved, "{name}");
        for (i, knot) in solution.knots.iter().enumerate() {
            let (tangent, curvature) = (number(&set["tangent"][i]), number(&set["curvature"][i]));
            for ours in [knot.direction_in, knot.direction_out].into_iter().flatten() {
                let error = wrap_angle(ours - tangent).abs();
                assert!(error <= uncertainty, "{name}, knot {i}: {ours}, off {error:e}");
            }
            for ours in [knot.curvature_in, knot.curvature_out].into_iter().flatten() {
                let error = (ours - curvature).abs();
                let bound = uncertainty * (1.0 + curvature.abs());
                assert!(error <= bound, "{name}, knot {i}: curvature {ours}, off {error:e}");
            }
        }
        let blends = list(&set["blend_points_u_quarter_half_3quarter"]);
        for (i, (segment, expected)) in solution.curve.segments().iter().zip(blends).enumerate() {
            let chord = segment.end() - segment.start();
            let angles = ChordAngles::from_directions(
                segment.direction(0.0),
                direction(chord),
                segment.direction(segment.length()),
            );
            let blend = CircleBlend::new(angles);
            for (u, point) in [0.25, 0.5, 0.75].into_iter().zip(list(expected)) {
                let unit = blend.point(u);
                let ours = (
                    segment.start().x + chord.x * unit.re - chord.y * unit.im,
                    segment.start().y + chord.y * unit.re + chord.x * unit.im,
                );
                let error = (ours.0 - number(&point[0])).hypot(ours.1 - number(&point[1]));
                // Of the larger of the chord and the numbers themselves, which are rounded.
                let size = chord.hypot().max(ours.0.abs()).max(ours.1.abs());
                let bound = uncertainty * (1.0 + size);
                assert!(error <= bound, "{name}, segment {i} at {u}: off by {error:e}");
                // And the segment itself, measured by arc length, passes through it.
                let (_, off) = segment.nearest(ours.into(), 1e-13 * chord.hypot());
                assert!(off <= bound + 1e-12 * chord.hypot(), "{name}, {i} at {u}: {off:e}");
            }
        }
    }
}
