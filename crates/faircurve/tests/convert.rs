//! Every spline of the catalogue as Béziers, measured independently of the bounds.

use std::sync::Arc;

use faircurve::catalog::{self, ENTRIES, ParamKind, Params};
use faircurve::convert::{Conversion, Fit, Metric, Options, convert, fit_single};
use faircurve::kurbo::{ParamCurve, ParamCurveNearest, PathSeg, Point};
use faircurve::segment::{Measured, ParametricCurve};
use faircurve::{Contour, Curve, Join, Knot, Segment, Spline, solve};
use num_complex::Complex64;

/// Drawings of about 1000 units: (name, knots, closed).
fn drawings() -> Vec<(&'static str, Contour)> {
    let open = |points: &[(f64, f64)]| Contour::open(points.iter().copied());
    let corners = Contour::closed([
        Knot::new((0.0, 0.0)).join(Join::Corner),
        Knot::new((400.0, 150.0)),
        Knot::new((800.0, -100.0)).join(Join::G1),
        Knot::new((1000.0, 500.0)),
        Knot::new((300.0, 900.0)).join(Join::Corner),
    ]);
    vec![
        ("arch", open(&[(0.0, 0.0), (250.0, 400.0), (600.0, 550.0), (1000.0, 100.0)])),
        (
            "zigzag",
            open(&[(0.0, 0.0), (200.0, 600.0), (400.0, 0.0), (600.0, 600.0), (1000.0, 0.0)]),
        ),
        // Turns that loops and cusps come of.
        ("hairpins", open(&[(0.0, 0.0), (1000.0, 0.0), (20.0, 30.0), (980.0, 70.0), (0.0, 80.0)])),
        ("corners", corners),
        (
            "round",
            Contour::closed([
                (0.0, 0.0),
                (500.0, -120.0),
                (1000.0, 80.0),
                (900.0, 700.0),
                (100.0, 560.0),
            ]),
        ),
    ]
}

/// Every entry, with every choice of every parameter, and log-aesthetic curves of several powers.
fn splines() -> Vec<(String, Box<dyn Spline>)> {
    let mut all = Vec::new();
    for info in ENTRIES {
        all.push((info.name.to_owned(), catalog::spline(info.name).unwrap()));
        for spec in info.params {
            let ParamKind::Choice { options } = spec.kind else { continue };
            for option in &options[1..] {
                let params = Params::new().with(spec.name, *option);
                let name = format!("{} {}={option}", info.name, spec.name);
                all.push((name, catalog::build(info.name, &params).unwrap()));
            }
        }
    }
    for alpha in [0.5, 0.9, 1.3, 3.0] {
        let params = Params::new().with("alpha", alpha);
        let name = format!("log-aesthetic alpha={alpha}");
        all.push((name, catalog::build("log-aesthetic", &params).unwrap()));
    }
    all
}

/// Each segment with the Béziers that stand for it: knots are joints, to the bit.
fn side_by_side<'a>(
    curve: &'a Curve,
    result: &Conversion,
) -> Result<Vec<(&'a Segment, Vec<PathSeg>)>, String> {
    let mut beziers = result.path.segments();
    let mut pairs = Vec::new();
    for segment in curve.segments() {
        if segment.start() == segment.end() && segment.is_line() {
            continue;
        }
        let mut own = Vec::new();
        let mut at = None;
        while at != Some(segment.end()) {
            let next = beziers.next().ok_or("a knot is no joint")?;
            at = Some(next.end());
            own.push(next);
        }
        pairs.push((segment, own));
    }
    match beziers.next() {
        Some(_) => Err("more Béziers than curve".to_owned()),
        None => Ok(pairs),
    }
}

/// The larger of the two one-sided distances of samples.
fn deviation(segment: &Segment, beziers: &[PathSeg], resolution: f64) -> f64 {
    const PLACES: u32 = 9;
    let mut worst = 0.0f64;
    for bezier in beziers {
        for i in 0..PLACES {
            let point = bezier.eval((f64::from(i) + 0.5) / f64::from(PLACES));
            worst = worst.max(segment.nearest(point, resolution).1);
        }
    }
    let places = PLACES * beziers.len() as u32;
    for i in 0..places {
        let point = segment.point(segment.length() * (f64::from(i) + 0.5) / f64::from(places));
        let nearest = |bezier: &PathSeg| bezier.nearest(point, resolution).distance_sq;
        let distance = beziers.iter().map(nearest).fold(f64::INFINITY, f64::min).sqrt();
        worst = worst.max(distance);
    }
    worst
}

/// `most`: Béziers to a segment.
fn check(curve: &Curve, accuracy: f64, most: usize) -> Result<(), String> {
    let result = convert(curve, &Options::new(accuracy));
    if !(result.bound <= accuracy) {
        return Err(format!("bound {:e}", result.bound));
    }
    let resolution = 1e-3 * accuracy;
    for (i, (segment, beziers)) in side_by_side(curve, &result)?.into_iter().enumerate() {
        if beziers.len() > most {
            return Err(format!("segment {i}: {} Béziers", beziers.len()));
        }
        if let Some(exact) = segment.beziers() {
            if beziers != exact {
                return Err(format!("segment {i} isn't as it was"));
            }
            continue;
        }
        let error = deviation(segment, &beziers, resolution);
        if !(error <= result.bound + resolution) {
            return Err(format!("segment {i}: {error:e} over {:e}", result.bound));
        }
    }
    Ok(())
}

#[test]
fn every_spline_converts_within_its_accuracy() {
    // The most cubics a segment: those of arcs that wind twice, and a little room.
    const MOST: [(f64, usize); 3] = [(1.0, 12), (0.1, 12), (1e-3, 24)];
    let mut failures = Vec::new();
    for (spline_name, spline) in splines() {
        for (drawing, contour) in drawings() {
            let solution = solve(&contour, &*spline).unwrap();
            for (accuracy, most) in MOST {
                if let Err(what) = check(&solution.curve, accuracy, most) {
                    failures.push(format!("{spline_name}, {drawing} at {accuracy}: {what}"));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}:\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn curves_of_beziers_pass_through() {
    for (spline, [lines, quadratics, cubics]) in
        [("polygon", [1, 0, 0]), ("kappa", [0, 2, 0]), ("hobby", [0, 0, 1]), ("bespoke", [0, 0, 1])]
    {
        let spline = catalog::spline(spline).unwrap();
        for (name, contour) in drawings() {
            let curve = solve(&contour, &*spline).unwrap().curve;
            let result = convert(&curve, &Options::new(1e-300));
            let segments = curve.segments().len();
            assert_eq!(result.bound, 0.0, "{name}");
            assert!(result.lines >= lines * segments, "{name}");
            // Straight ones are lines.
            assert!(result.quadratics <= quadratics * segments, "{name}");
            assert!(result.cubics <= cubics * segments, "{name}");
            if cubics == 1 {
                for segment in curve.segments() {
                    let own = segment.beziers().unwrap()[0].to_cubic();
                    let single = fit_single(segment, Metric::AbsoluteAngle, Fit::Optimal);
                    assert!(segment.is_line() || (single.cubic, single.error) == (own, 0.0));
                }
            }
        }
    }
}

/// A cubic that doesn't say that it is one.
#[derive(Debug)]
struct Disguised([Complex64; 4]);

impl ParametricCurve for Disguised {
    fn point(&self, u: f64) -> Complex64 {
        let [p0, p1, p2, p3] = self.0;
        let v = 1.0 - u;
        p0 * (v * v * v) + p1 * (3.0 * v * v * u) + p2 * (3.0 * v * u * u) + p3 * (u * u * u)
    }

    fn velocity_series(&self, u: f64) -> [Complex64; 5] {
        let [p0, p1, p2, p3] = self.0;
        let [a, b, c] = [p1 - p0, p2 - p1, p3 - p2].map(|arm| arm * 3.0);
        let v = 1.0 - u;
        let (first, second) = (b - a, c - b);
        let here = a * (v * v) + b * (2.0 * u * v) + c * (u * u);
        [here, (first * v + second * u) * 2.0, second - first, Complex64::ZERO, Complex64::ZERO]
    }

    fn bezier(&self, _from: f64, _to: f64) -> Option<PathSeg> {
        None
    }
}

#[test]
fn cusps_of_curves_that_are_no_beziers_are_kept_within_the_accuracy() {
    let point = Complex64::new;
    // Arms that cross: a cusp, and ever sharper bends and loops about it; then cusps at the ends.
    let crossing = [0.0, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, -1e-3, 0.1, -0.1]
        .map(|off| [point(0.0, 0.0), point(1.0 + off, 0.7), point(-off, 0.7), point(1.0, 0.0)]);
    let at_ends = [
        [point(0.0, 0.0), point(0.0, 0.0), point(0.3, 0.7), point(1.0, 0.0)],
        [point(0.0, 0.0), point(0.3, 0.7), point(1.0, 0.0), point(1.0, 0.0)],
    ];
    for points in crossing.into_iter().chain(at_ends) {
        let unit = Arc::new(Measured::new(Disguised(points)));
        let (start, end) = (Point::new(100.0, 20.0), Point::new(900.0, 600.0));
        let curve = Curve::new(vec![Segment::unit_curve(start, end, unit)], false);
        for (accuracy, most) in [(1.0, 8), (0.1, 12), (1e-3, 24)] {
            let checked = check(&curve, accuracy, most);
            assert_eq!(checked, Ok(()), "{points:?} at {accuracy}");
        }
    }
}
