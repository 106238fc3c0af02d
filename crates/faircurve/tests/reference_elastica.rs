//! The elastica, its segments and splines against values computed independently
//! (`tests/reference/README.md`).

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};
use std::path::Path;
use std::sync::Arc;

use faircurve::families::mec::{NoMec, envelope, fit_mec};
use faircurve::families::mvc::{MvcCurve, fit_mvc};
use faircurve::frame::{ChordAngles, wrap_angle};
use faircurve::kurbo::{Point, Vec2};
use faircurve::numeric::elastica::Elastica;
use faircurve::{Contour, Segment, Solution, Status, UnitCurve, catalog, solve};
use serde_json::Value;

fn load(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name);
    let text = std::fs::read_to_string(&path).expect("the reference file is in the repository");
    serde_json::from_str(&text).expect("the reference file is JSON")
}

/// A number, or a text that is one to more digits.
fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| value.as_str().expect("a number").parse().expect("a number"))
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

fn numbers(value: &Value) -> Vec<f64> {
    list(value).iter().map(number).collect()
}

#[test]
fn the_family_by_lambda() {
    let file = load("mec_segment.json");
    let samples = list(&file["elastica"]["samples"]);
    assert!(samples.len() > 60);
    for sample in samples {
        let [lambda, s, x, y, theta, kappa] =
            ["lam", "s", "x", "y", "theta", "kappa"].map(|name| number(&sample[name]));
        let here = Elastica::with_lambda(lambda).at(s);
        let off =
            [here.point.re - x, here.point.im - y, here.direction - theta, here.curvature - kappa];
        for off in off {
            assert!(off.abs() < 1e-13, "λ = {lambda}, s = {s}: {off:e}");
        }
    }
}

/// Lengths, heights and angles that have names of their own (thesis 3.3, 3.7).
#[test]
fn constants_of_the_rectangular_elastica_and_the_lemnoid() {
    let file = load("mec_segment.json");
    let constant = |name: &str| number(&file["constants"][name]);
    let rectangular = Elastica::with_lambda(0.5);
    let quarter = rectangular.at(rectangular.quarter_period());
    // With κ = 1 at a vertex the excursion is 2; x there is along the line of action.
    let length = constant("rect_elastica_quarter_length int 1/sqrt(1-x^4)");
    let height = constant("rect_elastica_half_height_unit_excursion int x^2/sqrt(1-x^4)");
    assert!((rectangular.quarter_period() - 2.0 * length).abs() < 1e-15);
    assert!((quarter.point.im - 2.0).abs() < 1e-15);
    assert!((quarter.point.re - 2.0 * height).abs() < 1e-15);
    // The lemnoid's period brings it back to where it was.
    let lemnoid = Elastica::with_lambda(constant("lemnoid lambda=1/(4m)"));
    let period = lemnoid.at(4.0 * lemnoid.quarter_period());
    assert!(period.point.norm() < 1e-13, "{:e}", period.point.norm());
    let inflection = lemnoid.at(lemnoid.quarter_period()).direction;
    assert!((inflection - constant("lemnoid theta_max at inflection")).abs() < 4e-15);
    assert!((inflection - FRAC_PI_2 - constant("lemnoid angle theta_max-pi/2")).abs() < 4e-15);
}

/// A segment and its images under mirroring and reversal.
fn images(row: &Value) -> [(ChordAngles, f64, f64); 4] {
    let angles = ChordAngles::new(number(&row["theta0"]), number(&row["theta1"]));
    let [start, end] = [number(&row["kappa_start"]), number(&row["kappa_end"])];
    [
        (angles, start, end),
        (ChordAngles::new(angles.theta1, angles.theta0), end, start),
        (angles.mirrored(), -start, -end),
        (angles.reversed(), -end, -start),
    ]
}

#[test]
fn minimum_energy_segments() {
    let file = load("mec_segment.json");
    let rows = list(&file["rows"]);
    assert_eq!(rows.len(), 48);
    for row in rows {
        let (length, energy) = (number(&row["arclength"]), number(&row["energy"]));
        for (angles, start, end) in images(row) {
            let fit = fit_mec(angles, 0.0).unwrap();
            let bound = 1e-13 * (1.0 + start.abs().max(end.abs()));
            let off = (fit.curvatures[0] - start).abs().max((fit.curvatures[1] - end).abs());
            assert!(off < bound, "{angles:?}: {off:e}");
            assert!((fit.length - length).abs() < 1e-13 * length, "{angles:?}");
            let segment = Segment::elastica(Point::ZERO, Point::new(1.0, 0.0), fit.elastica);
            assert!((segment.bending_energy() - energy).abs() < 2e-13 * energy, "{angles:?}");
            assert!((segment.direction(0.0) + angles.theta0).abs() < 1e-13);
            assert!((segment.direction(segment.length()) - angles.theta1).abs() < 1e-13);
        }
    }
    for pair in list(&file["no_principal_solution"]) {
        let angles = ChordAngles::new(number(&pair[0]), number(&pair[1]));
        assert_eq!(fit_mec(angles, 0.0), Err(NoMec::BeyondEnvelope), "{angles:?}");
    }
}

#[test]
fn the_envelope() {
    let file = load("mec_segment.json");
    for point in list(&file["envelope"]["points"]) {
        let ray = number(&point["ray_deg"]).to_radians();
        let fold = number(&point["t_fold"]);
        // There the angle is that from +theta1.
        let bound = envelope(FRAC_PI_2 - ray);
        let off =
            (bound.theta0 - fold * ray.sin()).abs().max((bound.theta1 - fold * ray.cos()).abs());
        assert!(off < 1e-11, "{ray}: {off:e}");
        let at = |t: f64| ChordAngles::new(t * bound.theta0, t * bound.theta1);
        assert!(fit_mec(at(1.0 - 1e-6), 0.0).is_ok() && fit_mec(at(1.0 + 1e-6), 0.0).is_err());
    }
    let symmetric = envelope(FRAC_PI_4);
    assert!((symmetric.theta0 - FRAC_PI_2).abs() < 1e-12);
    let opposite = envelope(3.0 * FRAC_PI_4);
    assert!(
        (opposite.theta1 - number(&file["constants"]["MEC antisymmetric max angle"])).abs() < 1e-11
    );
    let most = (0..2000).map(|i| envelope(TAU * f64::from(i) / 2000.0).theta1).fold(0.0, f64::max);
    assert!((2.16677..2.16679).contains(&most), "{most}");
}

fn contour(set: &Value) -> Contour {
    let points = list(&set["points"]).iter().map(|p| Point::new(number(&p[0]), number(&p[1])));
    Contour { closed: set["closed"].as_bool().unwrap(), ..Contour::open(points) }
}

fn solved(contour: &Contour, name: &str) -> Solution {
    let solution = solve(contour, &*catalog::spline(name).unwrap()).unwrap();
    assert_eq!(solution.report.status(), Status::Solved, "{name}: {:?}", solution.report.relaxed);
    solution
}

#[test]
fn minimum_energy_splines() {
    let file = load("mec_spline.json");
    let mut checked = 0;
    for (name, set) in file["sets"].as_object().unwrap() {
        let Some(tangents) = set.get("tangent") else { continue };
        let contour = contour(set);
        let solution = solved(&contour, "mec");
        let curvatures = numbers(&set["curvature"]);
        let size = curvatures.iter().fold(0.0f64, |most, k| most.max(k.abs()));
        for (i, tangent) in numbers(tangents).into_iter().enumerate() {
            let knot = &solution.knots[i];
            let ours = knot.direction_out.or(knot.direction_in).unwrap();
            assert!(wrap_angle(ours - tangent).abs() < 2e-14, "{name} {i}: {:e}", ours - tangent);
            let ours = knot.curvature_out.or(knot.curvature_in).unwrap();
            assert!((ours - curvatures[i]).abs() < 4e-14 * size, "{name} {i}: {ours}");
        }
        let energy: f64 = solution.curve.segments().iter().map(Segment::bending_energy).sum();
        assert!((energy / number(&set["energy"]) - 1.0).abs() < 1e-13, "{name}");
        assert!((solution.curve.length() / number(&set["length"]) - 1.0).abs() < 1e-14, "{name}");
        checked += 1;
    }
    assert_eq!(checked, 8);
}

/// The largest distance from the centre of the closed curve through n points of the unit circle.
fn radius(n: usize, name: &str) -> f64 {
    let point = |i: usize| Point::ZERO + Vec2::from_angle(TAU * i as f64 / n as f64);
    let solution = solved(&Contour::closed((0..n).map(point)), name);
    let segment = &solution.curve.segments()[0];
    segment.point(segment.length() / 2.0).to_vec2().hypot()
}

/// Thesis 4.2 and figure 4.2; the order n⁻⁴.
#[test]
fn how_far_the_minimum_energy_curve_is_from_the_circle() {
    for (n, known) in [(3, 1.035_118_551_983_3), (4, 1.009_411_653_339_9)] {
        let off = radius(n, "mec") - known;
        assert!(off.abs() < 1e-13, "{n}: {off:e}");
    }
    let file = load("properties.json");
    for row in list(&file["mec_roundness"]["rows"]) {
        let n = row["n"].as_u64().unwrap() as usize;
        let off = radius(n, "mec") - 1.0 - number(&row["max_radius_minus_1"]);
        // The file's own error grows with n, to 2.3e-13 at 48, as 40 digits say.
        assert!(off.abs() < 3e-13, "{n}: {off:e}");
    }
    let off = radius(48, "mec") - 1.0 - 3.827_002_220_056_439_4e-7;
    assert!(off.abs() < 2e-15, "{off:e}");
    let order = ((radius(32, "mec") - 1.0) / (radius(48, "mec") - 1.0)).ln() / 1.5f64.ln();
    assert!((order - 4.0).abs() < 0.01, "{order}");
    // Half turns are the bound: there the two segments have the inflections at their ends.
    assert!(fit_mec(ChordAngles::new(FRAC_PI_2, FRAC_PI_2), 0.0).is_ok());
}

#[test]
fn minimum_variation_segments() {
    let file = load("mvc.json");
    for row in list(&file["segments"]) {
        for (angles, start, end) in images(row) {
            let fit = fit_mvc(angles, [start, end]).unwrap();
            let length = number(&row["length"]);
            assert!(
                (fit.length - length).abs() < 1e-11 * length,
                "{angles:?}: {}",
                fit.length - length
            );
            let curve = MvcCurve::new(fit.k, 0.0).unwrap();
            let segment = Segment::unit_curve(Point::ZERO, Point::new(1.0, 0.0), Arc::new(curve));
            let energy = number(&row["energy"]);
            let off = segment.variation_energy() / energy - 1.0;
            assert!(off.abs() < 1e-10, "{angles:?}: {off:e}");
        }
        // Its derivatives at the start.
        let (angles, start, end) = images(row)[0];
        let fit = fit_mvc(angles, [start, end]).unwrap();
        let curve = MvcCurve::new(fit.k, 0.0).unwrap();
        let jet = curve.curvature_jet(0.0);
        let size = number(&row["d3kappa_start"]).abs().max(1.0);
        for (order, name) in ["kappa_start", "dkappa_start", "d2kappa_start", "d3kappa_start"]
            .into_iter()
            .enumerate()
        {
            assert!((jet[order] - number(&row[name])).abs() < 1e-10 * size, "{name}");
        }
    }
}

#[test]
fn minimum_variation_splines() {
    let file = load("mvc.json");
    for (name, set) in file["splines"].as_object().unwrap() {
        let solution = solved(&contour(set), "mvc");
        assert!(solution.report.residual < 1e-12, "{name}");
        let curvatures = numbers(&set["curvature"]);
        let slopes = numbers(&set["dcurvature"]);
        let size = curvatures.iter().fold(0.0f64, |most, k| most.max(k.abs()));
        for (i, tangent) in numbers(&set["tangent"]).into_iter().enumerate() {
            let knot = &solution.knots[i];
            let ours = knot.direction_out.or(knot.direction_in).unwrap();
            assert!(wrap_angle(ours - tangent).abs() < 1e-11, "{name} {i}: {:e}", ours - tangent);
            let ours = knot.curvature_out.or(knot.curvature_in).unwrap();
            assert!((ours - curvatures[i]).abs() < 1e-11 * size, "{name} {i}: {ours}");
            let Some(segment) = solution.curve.segments().get(i) else { continue };
            let slope = segment.curvature_jet(0.0)[1];
            assert!((slope - slopes[i]).abs() < 1e-10 * size, "{name} {i}: {slope}");
        }
        let energy: f64 = solution.curve.segments().iter().map(Segment::variation_energy).sum();
        let expected = number(&set["energy"]);
        assert!((energy - expected).abs() < 1e-10 * expected.max(1e-10), "{name}: {energy:e}");
        assert!((solution.curve.length() / number(&set["length"]) - 1.0).abs() < 1e-11, "{name}");
    }
}
