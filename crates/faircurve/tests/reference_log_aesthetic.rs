//! The log-aesthetic spline against values computed independently of it, and the thesis's figures
//! 4.12 and 4.13.

use std::f64::consts::FRAC_PI_4;
use std::path::Path;

use faircurve::catalog::Params;
use faircurve::families::log_aesthetic::LogAesthetic;
use faircurve::frame::ChordAngles;
use faircurve::segment::UnitCurve;
use faircurve::two_param::generating::Cuts;
use faircurve::{Contour, catalog, solve};
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

#[test]
fn segments_for_six_alphas() {
    let file = load("log_aesthetic.json");
    let rows = file["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 51);
    for row in rows {
        let curve = Cuts { curve: LogAesthetic::new(number(&row["alpha"])) };
        let angles = ChordAngles::new(number(&row["theta0"]), number(&row["theta1"]));
        let [start, end, length] =
            ["kappa_start", "kappa_end", "arc_over_chord"].map(|key| number(&row[key]));
        for (angles, start, end) in [
            (angles, start, end),
            (angles.mirrored(), -start, -end),
            (angles.reversed(), -end, -start),
            (angles.reversed().mirrored(), end, start),
        ] {
            let unit = curve.unit(angles).expect("a cut");
            let ours = [unit.curvature_jet(0.0)[0], unit.curvature_jet(unit.length())[0]];
            for (ours, exact) in ours.into_iter().zip([start, end]) {
                let error = (ours - exact).abs();
                assert!(error <= 1e-13 * (1.0 + exact.abs()), "{row}: {ours}, off by {error:e}");
            }
            assert!((unit.length() - length).abs() <= 1e-14 * length, "{row}: {}", unit.length());
        }
    }
}

#[test]
fn ripples_shrink_as_computed() {
    let file = load("log_aesthetic.json");
    let values = file["falloff"]["values"].as_object().expect("values by alpha");
    assert_eq!(values.len(), 12);
    for (alpha, value) in values {
        let curve = LogAesthetic::new(alpha.parse().expect("a number"));
        let error = (curve.ripple() - number(&value[0])).abs();
        assert!(error < 1e-14, "{alpha}: {}, off by {error:e}", curve.ripple());
    }
    assert!((LogAesthetic::new(1.0).ripple() - (2.0 - 3f64.sqrt())).abs() < 1e-15);
}

/// Figure 4.13, from curves instead of the formula: one knot of a straight row pushed aside.
#[test]
fn a_push_ripples_as_claimed() {
    for alpha in [0.5, 0.75, 1.0, 1.5, 1.78, 2.0, 3.0, 5.0] {
        let spline = catalog::build("log-aesthetic", &Params::new().with("alpha", alpha)).unwrap();
        let push = 1e-3;
        let row = (-12..=12).map(|x| (f64::from(x), if x == 0 { push } else { 0.0 }));
        let solution = solve(&Contour::open(row), &*spline).unwrap();
        assert!(solution.report.relaxed.is_empty(), "{alpha}: {:?}", solution.report);
        let direction = |i: usize| solution.knots[12 + i].direction_out.unwrap();
        let expected = LogAesthetic::new(alpha).ripple();
        for i in 2..5 {
            let ratio = -direction(i + 1) / direction(i);
            // Angles as small as the push, or a power of the ripple, are neglected.
            assert!((ratio - expected).abs() < 2e-4, "{alpha}: {ratio}, {expected}");
        }
    }
}

/// The energy for unit chord of a segment of the zigzag with this slope (figure 4.12).
fn zigzag_energy(alpha: f64, slope: f64) -> f64 {
    let unit = Cuts { curve: LogAesthetic::new(alpha) }
        .unit(ChordAngles::new(-slope, slope))
        .expect("a cut");
    unit.integral(0.0, unit.length(), &|[curvature, ..]| curvature * curvature)
}

/// The minimum by golden section.
fn least(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut a, mut b) = (from, to);
    while b - a > 1e-7 {
        let (c, d) = (b - golden * (b - a), a + golden * (b - a));
        if f(c) < f(d) { b = d } else { a = c }
    }
    (a + b) / 2.0
}

#[test]
fn energy_on_the_zigzag() {
    let file = load("properties.json");
    let rows = file["zigzag_energy"]["rows"].as_array().expect("rows");
    for row in rows {
        let [slope, alpha_min, ratio, euler] =
            ["beta", "alpha_min", "E178_over_E1", "E1"].map(|key| number(&row[key]));
        let energy = |alpha| zigzag_energy(alpha, slope);
        assert!((energy(1.0) / euler - 1.0).abs() < 1e-12, "{slope}: {}", energy(1.0));
        assert!((energy(1.78) / energy(1.0) - ratio).abs() < 1e-11, "{slope}");
        // Near a minimum the energy is flat: half its digits.
        let found = least(energy, 0.5, 1.5);
        assert!((found - alpha_min).abs() < 1e-6, "{slope}: {found}, {alpha_min}");
    }
    // What the thesis shows is the zigzag of 45°.
    let energy = |alpha| zigzag_energy(alpha, FRAC_PI_4);
    assert!((least(energy, 0.5, 1.5) - 0.8987).abs() < 5e-5);
    assert!((energy(1.78) / energy(1.0) - 1.0601).abs() < 5e-5);
}

/// The same from whole curves: segments in the middle of a long zigzag.
#[test]
fn energy_on_a_zigzag_of_knots() {
    let middle = |alpha: f64| {
        let spline = catalog::build("log-aesthetic", &Params::new().with("alpha", alpha)).unwrap();
        let knots = (0..40).map(|i| (f64::from(i), f64::from(i % 2)));
        let solution = solve(&Contour::open(knots), &*spline).unwrap();
        assert!(solution.report.relaxed.is_empty());
        solution.curve.segments()[19].bending_energy()
    };
    assert!((middle(1.78) / middle(1.0) - 1.0601).abs() < 5e-5);
    assert!((least(middle, 0.8, 1.0) - 0.8987).abs() < 5e-5);
}
