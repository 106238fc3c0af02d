use kurbo::Point;

use super::*;
use crate::frame::ChordAngles;
use crate::segment::UnitCurve;

const SAMPLES: [[f64; 4]; 7] = [
    [0.0; 4],
    [2.0, 0.0, 0.0, 0.0],
    [0.3, -0.5, 2.0, 5.0],
    [-1.5, 4.0, 10.0, -60.0],
    [1e-7, 1e-8, 0.0, 1e-6],
    [3.0, 20.0, -80.0, 300.0],
    [6.0, 5.0, 0.0, -900.0],
];

#[test]
fn responses_agree_with_differences() {
    for k in SAMPLES {
        let response = MinimumVariation.respond(k);
        let h = 1e-5;
        for i in 0..4 {
            let moved = |sign: f64| {
                let mut moved = k;
                moved[i] += sign * h;
                MinimumVariation.respond(moved)
            };
            let (up, down) = (moved(1.0), moved(-1.0));
            // Through the jets, as the solver goes.
            let jets: [f64; 4] =
                std::array::from_fn(|j| (up.ends.jets[j] - down.ends.jets[j]) / (2.0 * h));
            for row in 0..4 {
                let own: f64 = (0..4).map(|j| response.parameters_by_jets[row][j] * jets[j]).sum();
                assert!((own - f64::from(row == i)).abs() < 1e-6, "{k:?} {i} {row} {own}");
                let slope = (up.ends.derivatives[row] - down.ends.derivatives[row]) / (2.0 * h);
                let own: f64 = (0..4).map(|j| response.derivatives_by_jets[row][j] * jets[j]).sum();
                assert!((own - slope).abs() < 1e-6 * (1.0 + slope.abs()), "{k:?} {i} {row}");
            }
        }
    }
}

#[test]
fn rough_responses_are_good_to_seven_digits() {
    for k in SAMPLES {
        let (fine, rough) = (MinimumVariation.respond(k), MinimumVariation.respond_roughly(k));
        for (a, b) in fine
            .ends
            .jets
            .into_iter()
            .chain(fine.ends.derivatives)
            .zip(rough.ends.jets.into_iter().chain(rough.ends.derivatives))
        {
            assert!((a - b).abs() < 1e-7 * (1.0 + a.abs()), "{k:?} {a} {b}");
        }
    }
}

/// Eq. 7.20, the equation in curvature alone, by differences of κ‴; and with C, eq. 7.19.
#[test]
fn curves_obey_their_equation() {
    for (k, constant) in SAMPLES.into_iter().flat_map(|k| [(k, 0.0), (k, 3.0)]) {
        let Some(curve) = MvcCurve::new(k, constant) else { panic!("{k:?}") };
        // C for unit chord.
        let constant = constant / curve.length().powi(4);
        let h = 1e-4;
        for i in 1..40 {
            let s = curve.length() * f64::from(i) / 40.0;
            let [k0, k1, k2, _] = curve.curvature_jet(s);
            let fourth =
                (curve.curvature_jet(s + h)[3] - curve.curvature_jet(s - h)[3]) / (2.0 * h);
            let terms = [fourth, k2 * k0 * k0, -0.5 * k0 * k1 * k1, constant * k0];
            let size: f64 = terms.iter().map(|term| term.abs()).sum();
            assert!(terms.iter().sum::<f64>().abs() < 1e-5 * (1.0 + size), "{k:?} {s} {terms:?}");
        }
    }
}

/// κ″ = λy (eq. 7.22): κ″ grows evenly across some line.
#[test]
fn second_derivative_is_linear_in_place() {
    let curve = MvcCurve::new([0.3, -0.5, 2.0, 5.0], 0.0).unwrap();
    let at = |i: i32| {
        let s = curve.length() * f64::from(i) / 20.0;
        (curve.point(s), curve.curvature_jet(s)[2])
    };
    // Through three places, then at all others.
    let [(p, a), (q, b), (r, c)] = [at(0), at(9), at(20)];
    let (u, v) = (q - p, r - p);
    let determinant = u.re * v.im - u.im * v.re;
    let gx = ((b - a) * v.im - (c - a) * u.im) / determinant;
    let gy = ((c - a) * u.re - (b - a) * v.re) / determinant;
    for i in 0..=20 {
        let (z, second) = at(i);
        let expected = a + gx * (z.re - p.re) + gy * (z.im - p.im);
        assert!((second - expected).abs() < 1e-11, "{i} {}", second - expected);
    }
}

#[test]
fn points_directions_and_curvatures_belong_together() {
    for k in SAMPLES {
        let curve = MvcCurve::new(k, 0.0).unwrap();
        let h = 1e-5;
        for i in 1..60 {
            let s = curve.length() * f64::from(i) / 60.0;
            let tangent = (curve.point(s + h) - curve.point(s - h)) / (2.0 * h);
            assert!((tangent - num_complex::Complex64::cis(curve.direction(s))).norm() < 1e-7);
            let jets = [s - h, s, s + h].map(|s| curve.curvature_jet(s));
            let turn = (curve.direction(s + h) - curve.direction(s - h)) / (2.0 * h);
            assert!((turn - jets[1][0]).abs() < 1e-7 * (1.0 + turn.abs()), "{k:?} {s}");
            for order in 0..3 {
                let slope = (jets[2][order] - jets[0][order]) / (2.0 * h);
                assert!((slope - jets[1][order + 1]).abs() < 1e-5 * (1.0 + slope.abs()));
            }
            for (from, to) in [(s, s + 0.1), (s - 0.05, s + 0.01)] {
                let bounds = curve.curvature_bounds(from, to);
                for order in 0..3 {
                    let rounding = 1.0 - 1e-12;
                    assert!(
                        bounds[order] >= rounding * jets[1][order].abs(),
                        "{bounds:?} {jets:?}"
                    );
                }
            }
        }
    }
}

/// With its own length given, C is 0; with another one, the variation is more.
#[test]
fn a_free_length_is_the_best() {
    let angles = ChordAngles::new(-0.3, 0.6);
    let free = fit_mvc(angles, [-1.0, 1.5]).unwrap();
    let same = fit_mvc_of_length(angles, [-1.0, 1.5], free.length).unwrap();
    assert!(same.constant.abs() < 1e-9, "{}", same.constant);
    let variation = |segment: &MvcSegment| {
        let curve = MvcCurve::new(segment.k, segment.constant).unwrap();
        Segment::unit_curve(Point::ZERO, Point::new(1.0, 0.0), Arc::new(curve)).variation_energy()
    };
    for factor in [0.998, 0.9995, 1.0005, 1.002] {
        let other = fit_mvc_of_length(angles, [-1.0, 1.5], free.length * factor).unwrap();
        assert!((other.length - free.length * factor).abs() < 1e-12);
        assert!(other.constant.abs() > 1e-3);
        assert!(variation(&other) > variation(&free) * (1.0 + 1e-7), "{factor}");
    }
}

#[test]
fn what_is_too_wild_is_none() {
    for k in [[1e9; 4], [f64::NAN, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, f64::INFINITY], [1e300; 4]] {
        assert!(MvcCurve::new(k, 0.0).is_none());
        assert!(MinimumVariation.respond(k).ends.jets[0].is_nan());
        assert!(MinimumVariation.shape(Point::ZERO, Point::new(1.0, 0.0), k).is_line());
    }
    assert!(fit_mvc(ChordAngles::new(f64::NAN, 0.0), [0.0; 2]).is_none());
    assert!(fit_mvc_of_length(ChordAngles::new(0.1, 0.1), [0.0; 2], 0.5).is_none());
}
