use super::*;
use crate::catalog::{self, Params};
use crate::families::log_aesthetic::LogAesthetic;
use crate::segment::UnitCurve;
use crate::two_param::generating::{Cut, GeneratingCurve, chord_angles};
use crate::{Contour, solve};

fn generated(text: &str) -> Generated {
    Generated::from_formula(text.parse().unwrap()).unwrap()
}

#[test]
fn formulas_mean_what_mathematics_means() {
    for (text, at, value) in [
        ("s", 2.0, 2.0),
        ("-s^2", 3.0, -9.0),
        ("2^3^2", 0.0, 512.0),
        ("2^-1", 0.0, 0.5),
        ("1e-3 + 2.5E2*s", 1.0, 250.001),
        ("2 - 3 - 4", 0.0, -5.0),
        ("8/4/2", 0.0, 1.0),
        ("2*-3", 0.0, -6.0),
        (" ( s + 1 ) * ( s - 1 ) ", 3.0, 8.0),
        ("sign(s)*abs(s)^1.5", -4.0, -8.0),
        ("exp(log(s)) + ln(e) + cos(pi)", 5.0, 5.0),
        ("sqrt(s)+tanh(0)+sinh(0)+cosh(0)+atan(0)+tan(0)+sin(0)", 4.0, 3.0),
    ] {
        let formula: Formula = text.parse().unwrap();
        assert!((formula.value(at) - value).abs() < 1e-12, "{text}: {}", formula.value(at));
    }
}

#[test]
fn derivatives_of_formulas_agree_with_differences() {
    for text in [
        "s^3 - 2/s",
        "abs(s)^1.7*sign(s)",
        "sqrt(s)*exp(-s)",
        "log(1+s*s)",
        "sin(s)*cos(2*s)",
        "tan(s/3)",
        "tanh(s)",
        "sinh(s)-cosh(s/2)",
        "atan(2*s)",
        "s^s",
        "(1+s)^0",
        "2^s",
    ] {
        let formula: Formula = text.parse().unwrap();
        for at in [0.3, 1.1, 2.4] {
            let jet = formula.jet(at);
            assert!((jet[0] - formula.value(at)).abs() < 1e-13 * (1.0 + jet[0].abs()));
            let h = 1e-4;
            let (up, down) = (formula.jet(at + h), formula.jet(at - h));
            for order in 0..3 {
                let slope = (up[order] - down[order]) / (2.0 * h);
                let error = (slope - jet[order + 1]).abs() / (1.0 + slope.abs());
                assert!(error < 2e-6, "{text} at {at}, {order}: {slope} {}", jet[order + 1]);
            }
        }
    }
}

#[test]
fn errors_say_which_character_is_wrong() {
    for (text, message) in [
        ("", "it ends where a number, `s`, a function or `(` should stand"),
        ("s+@", "`@` at character 3 stands where a number, `s`, a function or `(` should"),
        ("3s", "`s` at character 2 stands where an operator should"),
        ("foo(s)", "`foo` at character 1 isn't known"),
        ("s + x", "`x` at character 5 isn't known"),
        ("sin s", "`s` at character 5 stands where `(` should"),
        ("(s", "it ends where `)` or an operator should stand"),
        ("s)", "`)` at character 2 was never opened"),
        ("1.2.3", "`.` at character 4 stands where an operator should"),
        ("2*1e999", "`1e999` at character 3 isn't a number"),
        ("2 - (s + 3s)", "`s` at character 11 stands where `)` or an operator should"),
        ("é + s", "`é` at character 1 isn't known"),
    ] {
        let error = text.parse::<Formula>().unwrap_err();
        assert_eq!(error.to_string(), message, "{text}");
    }
    for part in ["(", "-", "1^", "1^-(", "sin(", "s+(", "\u{1d4b}+"] {
        // As deep as the length allows, and deeper.
        for length in [480, 501, 5000] {
            assert!(part.repeat(length / part.chars().count()).parse::<Formula>().is_err());
        }
    }
    let deep = ("1^".repeat(249) + "s").parse::<Formula>().unwrap();
    assert_eq!(deep.jet(3.0), [1.0, 0.0, 0.0, 0.0]);
}

#[test]
fn what_cant_generate_is_refused() {
    for (text, reason) in [
        ("s + s^2", NotGenerating::NeitherOddNorOfOneSign),
        ("sin(s) + 1/2", NotGenerating::NeitherOddNorOfOneSign),
        ("3", NotGenerating::Constant),
        ("0*s", NotGenerating::Constant),
        ("log(-1 - s*s)", NotGenerating::Constant),
    ] {
        let formula: Formula = text.parse().unwrap();
        assert_eq!(Generated::from_formula(formula).unwrap_err(), reason, "{text}");
    }
    let error = catalog::build("generated", &Params::new().with("kappa", "s + s^2")).unwrap_err();
    assert!(error.to_string().contains("changes sign and isn't odd"), "{error}");
}

/// Angles in the half quadrant of cuts.
fn angles() -> impl Iterator<Item = ChordAngles> {
    (1..=15).flat_map(|i| {
        (-10..=10).map(move |j| {
            let theta1 = 0.2 * f64::from(i);
            ChordAngles::new(theta1 * f64::from(j) / 10.0, theta1)
        })
    })
}

#[test]
fn cuts_have_their_angles_wherever_there_is_one() {
    for (text, share) in [
        ("s", 1.0),
        ("sign(s)*abs(s)^1.5", 1.0),
        ("sign(s)*abs(s)^0.4", 1.0),
        ("s+s^3", 1.0),
        ("tanh(s)", 1.0),
        ("atan(10*s)", 1.0),
        ("sinh(s)", 1.0),
        ("exp(s)", 0.47),
        ("sin(s)", 0.17),
        ("1e6*s", 1.0),
        ("-s/1e9", 1.0),
    ] {
        let curve = generated(text);
        let (mut found, mut all) = (0, 0);
        for angles in angles() {
            all += 1;
            if let Some(cut) = curve.cut(angles) {
                found += 1;
                let ours = chord_angles(&cut);
                let error =
                    (ours.theta0 - angles.theta0).abs().max((ours.theta1 - angles.theta1).abs());
                assert!(error < 2e-11, "{text} {angles:?}: {error:e}");
                for i in 0..10 {
                    let v = f64::from(i) / 10.0;
                    let (a, b) = (cut.curvature_jet(v)[0], cut.curvature_jet(v + 0.1)[0]);
                    assert!(text.contains("sin(") || a <= b + 1e-9 * b.abs(), "{text} {angles:?}");
                }
            }
        }
        assert!(found as f64 >= share * f64::from(all), "{text}: {found} of {all}");
    }
}

#[test]
fn the_formula_of_log_aesthetic_is_log_aesthetic() {
    for (alpha, text) in [(0.4, "sign(s)*abs(s)^0.4"), (1.0, "s"), (1.5, "sign(s)*abs(s)^1.5")] {
        let (special, general) =
            (Cuts { curve: LogAesthetic::new(alpha) }, Cuts { curve: generated(text) });
        for angles in angles() {
            let (a, b) = (special.unit(angles).unwrap(), general.unit(angles).unwrap());
            assert!((a.length() - b.length()).abs() < 1e-11 * a.length(), "{alpha} {angles:?}");
            for i in 0..=8 {
                let part = f64::from(i) / 8.0;
                let off = (a.point(a.length() * part) - b.point(b.length() * part)).norm();
                assert!(off < 1e-11, "{alpha} {angles:?} {part}: {off:e}");
            }
        }
    }
}

#[test]
fn functions_and_formulas_agree() {
    let formula = generated("s + s^3/10");
    let function = Generated::new(|s| s + s.powi(3) / 10.0).unwrap();
    for angles in angles() {
        let (a, b) = (formula.cut(angles).unwrap(), function.cut(angles).unwrap());
        for v in [0.0, 0.3, 1.0] {
            let (a, b) = (a.curvature_jet(v), b.curvature_jet(v));
            let size = 1.0 + a.iter().fold(0.0f64, |most, k| most.max(k.abs()));
            for order in 0..4 {
                let error = (a[order] - b[order]).abs() / size;
                assert!(error < 1e-7, "{angles:?} {v} {order}: {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn segments_without_a_cut_are_relaxed_and_say_so() {
    let params = Params::new().with("kappa", "exp(s)");
    let spline = catalog::build("generated", &params).unwrap();
    let zigzag = Contour::open((0..6).map(|i| (f64::from(i), f64::from(i % 2))));
    let solution = solve(&zigzag, &*spline).unwrap();
    assert!(!solution.report.relaxed.is_empty());
    assert!(solution.report.relaxed.iter().any(|relaxed| relaxed.got == "euler"));
    // Convex ones are fine.
    let spiral = (0..8).map(|i| {
        let (t, r) = (0.7 * f64::from(i), 1.3f64.powi(i));
        (r * t.cos(), r * t.sin())
    });
    let solution = solve(&Contour::open(spiral), &*spline).unwrap();
    assert!(solution.report.relaxed.is_empty(), "{:?}", solution.report);
}

/// Nothing finite, solvable or sensible is asked; nothing but finite numbers may come out.
#[test]
fn whatever_the_formula_and_the_knots_numbers_are_finite() {
    let hard = [
        Contour::open([(0.0, 0.0), (1.0, 0.0), (1.0, 1e-9), (-3.0, 0.5), (-3.0, -1e12)]),
        Contour::closed([(0.0, 0.0), (1.0, 0.0), (0.0, 0.0), (1.0, 1.0), (1.0, 0.0)]),
        Contour::closed([(0.0, 0.0), (1.0, 0.0)]),
        Contour::open((0..8).map(|i| (f64::from(i * i % 5), f64::from(i * 3 % 7)))),
    ];
    for kappa in [
        "s",
        "1/s",
        "exp(s)",
        "exp(-s*s)",
        "sin(s)",
        "tan(s)",
        "s^9",
        "sign(s)",
        "abs(s)",
        "log(s)",
        "sin(1e9*s)",
        "1+sin(s)",
        "sqrt(s)",
        "exp(exp(s))",
        "sign(s)*abs(s)^0.01",
        "1e300*s",
        "1e-300*s",
        "s^3-s",
        "sign(s)*log(1+abs(s))",
        "tanh(s)^3",
        "s^s",
        "-exp(s)",
    ] {
        let Ok(spline) = catalog::build("generated", &Params::new().with("kappa", kappa)) else {
            continue;
        };
        for contour in &hard {
            let solution = solve(contour, &*spline).unwrap();
            assert!(solution.report.residual.is_finite(), "{kappa}");
            for segment in solution.curve.segments() {
                let numbers = [segment.length(), segment.bending_energy(), segment.direction(0.0)];
                assert!(numbers.into_iter().all(f64::is_finite), "{kappa}: {segment:?}");
                assert!(segment.point(segment.length() / 3.0).is_finite(), "{kappa}");
                assert!(segment.curvature_jet(0.0).into_iter().all(f64::is_finite), "{kappa}");
            }
        }
    }
}
