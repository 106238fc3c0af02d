//! Hobby's spline against values computed independently, and against MetaPost
//! (`tests/reference/README.md`).

#![expect(clippy::print_stdout, reason = "says how close it comes, and what it skips and why")]

use std::path::Path;
use std::process::Command;

use faircurve::catalog::{self, Params};
use faircurve::families::hobby::hobby_arms;
use faircurve::frame::{ChordAngles, wrap_angle};
use faircurve::kurbo::{PathSeg, Point, Vec2};
use faircurve::{Contour, Join, Knot, Segment, Solution, solve};
use serde_json::Value;

fn load(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name);
    let text = std::fs::read_to_string(&path).expect("the reference file is in the repository");
    serde_json::from_str(&text).expect("the reference file is JSON")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn point(value: &Value) -> Point {
    Point::new(number(&value[0]), number(&value[1]))
}

/// The control points of a segment; where it is a line, those that METAFONT gives lines, for the
/// tensions at its ends.
fn controls(segment: &Segment, tensions: [f64; 2]) -> [Point; 2] {
    match segment.beziers().expect("a cubic or a line")[..] {
        [PathSeg::Cubic(cubic)] => [cubic.p1, cubic.p2],
        [PathSeg::Line(line)] => {
            let arms = hobby_arms(ChordAngles::default(), tensions);
            [line.p0.lerp(line.p1, arms[0]), line.p1.lerp(line.p0, arms[1])]
        }
        ref other => panic!("{other:?}"),
    }
}

/// The largest distance between the control points of a solution and those expected, over the size
/// of the knots.
fn off(contour: &Contour, solution: &Solution, expected: &[[Point; 2]], tension: f64) -> f64 {
    let knots = &contour.knots;
    let segments = solution.curve.segments();
    assert_eq!(segments.len(), expected.len());
    let first = knots[0].point;
    let size = knots.iter().map(|knot| (knot.point - first).hypot()).fold(0.0, f64::max);
    let distances = segments.iter().zip(expected).enumerate().map(|(i, (segment, expected))| {
        let next = &knots[(i + 1) % knots.len()];
        let tensions = [knots[i].tension_out, next.tension_in].map(|t| t.unwrap_or(tension));
        let [a, b] = controls(segment, tensions);
        (a - expected[0]).hypot().max((b - expected[1]).hypot())
    });
    distances.fold(0.0, f64::max) / size
}

/// Knots without anything given, as the file of splines has them.
fn plain_contour(set: &Value) -> Contour {
    let points = list(&set["points"]).iter().map(point);
    Contour { closed: set["closed"] == true, ..Contour::open(points) }
}

#[test]
fn splines_of_the_reference_file() {
    let file = load("hobby.json");
    let uncertainty = number(&file["uncertainty"]);
    let spline = catalog::spline("hobby").unwrap();
    let sets = file["sets"].as_object().expect("sets by name");
    assert_eq!(sets.len(), 9);
    for (name, set) in sets {
        let contour = plain_contour(set);
        let solution = solve(&contour, &*spline).unwrap();
        assert!(solution.report.relaxed.is_empty() && solution.report.residual < 1e-12, "{name}");
        for (knot, tangent) in solution.knots.iter().zip(list(&set["tangents"])) {
            for ours in [knot.direction_in, knot.direction_out].into_iter().flatten() {
                let error = wrap_angle(ours - number(tangent)).abs();
                assert!(error <= uncertainty, "{name}: {ours}, off by {error:e}");
            }
        }
        let expected: Vec<[Point; 2]> =
            list(&set["controls"]).iter().map(|c| [point(&c[0]), point(&c[1])]).collect();
        let off = off(&contour, &solution, &expected, 1.0);
        assert!(off <= uncertainty, "{name}: {off:e}");
        for (side, at) in [("kappa_start", 0.0), ("kappa_end", 1.0)] {
            for (segment, kappa) in solution.curve.segments().iter().zip(list(&set[side])) {
                let error = (segment.curvature(at * segment.length()) - number(kappa)).abs();
                assert!(error <= 1e-11 * (1.0 + number(kappa).abs()), "{name} {side}: {error:e}");
            }
        }
    }
}

/// The largest distance of a closed curve through n points of the unit circle from it.
fn radial_error(n: u32) -> f64 {
    let on_circle = |i: u32| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        Point::new(angle.cos(), angle.sin())
    };
    let solution =
        solve(&Contour::closed((0..n).map(on_circle)), &*catalog::spline("hobby").unwrap());
    let curve = solution.unwrap().curve;
    let segment = &curve.segments()[0];
    let error = |i: i32| {
        let point = segment.point(segment.length() * f64::from(i) / 4000.0);
        (point.to_vec2().hypot() - 1.0).abs()
    };
    (0..=4000).map(error).fold(0.0, f64::max)
}

#[test]
fn roundness_is_of_order_six() {
    for row in list(&load("hobby.json")["roundness"]) {
        let n = row["n"].as_u64().unwrap() as u32;
        let (ours, expected) = (radial_error(n), number(&row["max_radial_error"]));
        // The sampling finds the maximum to a millionth of itself.
        assert!((ours - expected).abs() <= 1e-6 * expected + 1e-15, "{n}: {ours:e} {expected:e}");
    }
    // Thesis section 4.7 prints n⁶ for n⁻⁶.
    for (n, slack) in [(8, 0.05), (16, 0.02), (32, 0.01)] {
        let order = (radial_error(n) / radial_error(2 * n)).log2();
        assert!((order - 6.0).abs() < slack, "{n}: {order}");
    }
}

/// A knot of `mpost.json`.
fn knot(value: &Value) -> Knot {
    let number = |name: &str| value.get(name).map(number);
    let vector = |name: &str| value.get(name).map(|v| point(v).to_vec2());
    Knot {
        point: Point::new(number("x").unwrap(), number("y").unwrap()),
        join: (value.get("join").is_some_and(|join| join == "corner")).then_some(Join::Corner),
        tension_in: number("tension_in"),
        tension_out: number("tension_out"),
        tangent_in: vector("tangent_in"),
        tangent_out: vector("tangent_out"),
        curl: number("curl"),
        ..Knot::default()
    }
}

#[test]
fn control_points_equal_those_stored_from_metapost() {
    let file = load("mpost.json");
    let spline = catalog::spline("hobby").unwrap();
    let mut worst = 0.0f64;
    for (index, path) in list(&file["paths"]).iter().enumerate() {
        let knots = list(&path["knots"]).iter().map(knot);
        let contour = Contour { closed: path["closed"] == true, ..Contour::open(knots) };
        let expected: Vec<[Point; 2]> =
            list(&path["controls"]).iter().map(|c| [point(&c[0]), point(&c[1])]).collect();
        let solution = solve(&contour, &*spline).unwrap();
        assert!(solution.report.relaxed.is_empty() && solution.report.adapted.is_empty());
        let off = off(&contour, &solution, &expected, 1.0);
        assert!(off <= 1e-9, "path {index}: {off:e} {contour:?}");
        worst = worst.max(off);
    }
    println!("largest difference: {worst:e} of the size");
}

/// A stream of numbers in [0, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn chance(&mut self, of: f64) -> bool {
        self.next() < of
    }

    fn direction(&mut self) -> Vec2 {
        Vec2::from_angle(self.between(-3.0, 3.0))
    }

    fn tension(&mut self) -> f64 {
        let most = if self.chance(0.1) { 4096.0 } else { 3.0 };
        let size = if self.chance(0.2) { 0.75 } else { self.between(0.75, most) };
        if self.chance(0.4) { -size } else { size }
    }

    fn knot(&mut self, point: Point) -> Knot {
        let mut knot = Knot::new(point);
        knot.tension_in = self.chance(0.3).then(|| self.tension());
        knot.tension_out = self.chance(0.3).then(|| self.tension());
        knot.curl = self.chance(0.3).then(|| self.between(0.0, 10.0).powi(3));
        if self.chance(0.15) {
            knot = knot.tangent(self.direction());
        } else if self.chance(0.2) {
            knot.join = Some(Join::Corner);
            knot.tangent_in = self.chance(0.4).then(|| self.direction());
            knot.tangent_out = self.chance(0.4).then(|| self.direction());
        }
        knot
    }

    /// Points anywhere, a walk with gentle turns, or chords over many decades.
    fn contour(&mut self, kind: usize) -> Contour {
        let count = 2 + (self.next() * 12.0) as usize;
        let scale = 10f64.powf(self.between(-4.0, 5.0));
        let (mut at, mut heading) = (Point::ZERO, Vec2::new(1.0, 0.0));
        let knots: Vec<Knot> = (0..count)
            .map(|_| {
                let length = if kind % 3 == 2 { 10f64.powf(self.between(-4.0, 0.0)) } else { 1.0 };
                let turn = if kind % 3 == 1 { 0.8 } else { 3.1 };
                let turn = Vec2::from_angle(self.between(-turn, turn));
                heading =
                    Vec2::new(heading.dot(Vec2::new(turn.x, -turn.y)), heading.cross(turn).abs());
                at += heading * length;
                self.knot((at.to_vec2() * scale).to_point())
            })
            .collect();
        let closed = count > 2 && self.chance(0.5);
        Contour { knots, closed }
    }
}

/// The path as MetaPost reads it.
fn metapost(contour: &Contour, tension: f64, curl: f64) -> String {
    let knots = &contour.knots;
    let last = knots.len() - 1;
    let side = |knot: &Knot, tangent: Option<Vec2>, is_end: bool| match tangent {
        Some(tangent) => format!("{{({},{})}}", tangent.x, tangent.y),
        None if is_end || knot.join == Some(Join::Corner) => {
            format!("{{curl {}}}", knot.curl.unwrap_or(curl))
        }
        None => String::new(),
    };
    let at_least = |given: Option<f64>| {
        let tension = given.unwrap_or(tension);
        format!("{}{}", if tension < 0.0 { "atleast " } else { "" }, tension.abs())
    };
    let mut text = String::new();
    for (i, knot) in knots.iter().enumerate() {
        let ends = (!contour.closed && i == 0, !contour.closed && i == last);
        if i > 0 {
            text += &side(knot, knot.tangent_in, ends.1);
        }
        text += &format!("({},{})", knot.point.x, knot.point.y);
        if i < last || contour.closed {
            text += &side(knot, knot.tangent_out, ends.0);
            let next = &knots[(i + 1) % knots.len()];
            let tensions = (at_least(knot.tension_out), at_least(next.tension_in));
            text += &format!("\n  ..tension {} and {}..", tensions.0, tensions.1);
        }
    }
    if contour.closed {
        text += &side(&knots[0], knots[0].tangent_in, false);
        text += "cycle";
    }
    text
}

/// The control points that MetaPost gives each path; `None`, with the reason printed, where it isn't
/// installed.
fn run_metapost(name: &str, numbers: &str, paths: &[String]) -> Option<Vec<Vec<[Point; 2]>>> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).unwrap();
    let mut text = "path p;\n".to_owned();
    for path in paths {
        text += &format!("p := {path};\n");
        text += "for i=0 upto length p - 1: message \"@ \" & decimal xpart postcontrol i of p & \" \" \
                 & decimal ypart postcontrol i of p & \" \" & decimal xpart precontrol i+1 of p & \" \" \
                 & decimal ypart precontrol i+1 of p; endfor message \"=\";\n";
    }
    text += "end\n";
    std::fs::write(folder.join("paths.mp"), text).unwrap();
    let output = Command::new("mpost")
        .args([&format!("-numbersystem={numbers}"), "-interaction=nonstopmode", "paths.mp"])
        .current_dir(&folder)
        .env("max_print_line", "1000")
        .output();
    let text = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
    // A bare `mpost` comes with other packages; its macros don't.
    let Some(text) = text.ok().filter(|text| !text.contains("can't find the 'plain' preload file"))
    else {
        println!("skipped: `mpost` can't be run here (Debian's texlive-metapost has it)");
        return None;
    };
    assert!(!text.contains("\n! "), "{text}");
    let mut found = vec![Vec::new()];
    for line in text.lines() {
        if let Some(numbers) = line.strip_prefix("@ ") {
            let numbers: Vec<f64> =
                numbers.split_whitespace().take(4).map(|n| n.parse().expect("a number")).collect();
            let [x0, y0, x1, y1] = numbers[..] else { panic!("{line}") };
            let here = found.last_mut().expect("never empty");
            here.push([Point::new(x0, y0), Point::new(x1, y1)]);
        } else if line.starts_with('=') {
            found.push(Vec::new());
        }
    }
    found.pop();
    assert_eq!(found.len(), paths.len(), "{text}");
    Some(found)
}

/// The contour with another tension at free ends, from their own and that at the segment's other end.
///
/// In MetaPost 2.02 arithmetics other than `scaled` lose a factor of 4096 in the curl of ends whose
/// tension is less than the other, and draw those ends straight.
fn change_curled_ends(
    mut contour: Contour,
    change: impl Fn(Option<f64>, Option<f64>) -> Option<f64>,
) -> Contour {
    let n = contour.knots.len();
    for i in 0..n {
        let knot = &contour.knots[i];
        let is_end = |end: usize| !contour.closed && i == end;
        let is_free = |tangent: Option<Vec2>, end: usize| {
            tangent.is_none() && (is_end(end) || knot.join == Some(Join::Corner))
        };
        let (starts, ends) = (is_free(knot.tangent_out, 0), is_free(knot.tangent_in, n - 1));
        if starts && !is_end(n - 1) {
            let other = contour.knots[(i + 1) % n].tension_in;
            contour.knots[i].tension_out = change(contour.knots[i].tension_out, other);
        }
        if ends && !is_end(0) {
            let other = contour.knots[(i + n - 1) % n].tension_out;
            contour.knots[i].tension_in = change(contour.knots[i].tension_in, other);
        }
    }
    contour
}

/// What MetaPost's double arithmetic has wrong, by its scaled one, to that one's accuracy.
#[test]
fn curls_of_ends_with_less_tension_are_those_of_metapost_in_scaled_arithmetic() {
    let mut random = Random(62);
    let cases: Vec<Contour> = (0..200)
        .map(|i| {
            let count = 3 + i % 4;
            let knots = (0..count).map(|j| {
                let point = (100.0 * j as f64, random.between(-80.0, 80.0));
                Knot { curl: Some(random.between(0.0, 4.0)), ..Knot::new(point) }
            });
            let mut contour = Contour::open(knots.collect::<Vec<_>>());
            contour.knots[1].tension_in = Some(random.between(1.0, 5.0));
            contour.knots[0].tension_out = Some(random.between(0.75, 1.0));
            contour
        })
        .collect();
    let paths: Vec<String> = cases.iter().map(|contour| metapost(contour, 1.0, 1.0)).collect();
    let Some(found) = run_metapost("scaled", "scaled", &paths) else { return };
    let spline = catalog::spline("hobby").unwrap();
    let mut worst = 0.0f64;
    for (contour, expected) in cases.iter().zip(&found) {
        let off = off(contour, &solve(contour, &*spline).unwrap(), expected, 1.0);
        // It knows tensions and coordinates to 1/65536, which near half turns is seen at arms’ ends.
        assert!(off <= 1e-3, "{off:e} {contour:?} {expected:?}");
        worst = worst.max(off);
    }
    println!("{} paths, largest difference: {worst:e} of the size", cases.len());
}

#[test]
fn control_points_equal_metaposts() {
    let mut random = Random(4);
    let cases: Vec<(Contour, f64, f64)> = (0..900)
        .map(|kind| {
            let contour = random.contour(kind);
            let plain = random.chance(0.6);
            let tension = if plain { 1.0 } else { random.tension() };
            let curl = if plain { 1.0 } else { random.between(0.0, 5.0) };
            let contour = change_curled_ends(contour, |own, other| {
                if own.unwrap_or(tension).abs() < other.unwrap_or(tension).abs() {
                    other
                } else {
                    own
                }
            });
            (contour, tension, curl)
        })
        .collect();
    let paths: Vec<String> =
        cases.iter().map(|(contour, tension, curl)| metapost(contour, *tension, *curl)).collect();
    let Some(found) = run_metapost("random", "double", &paths) else { return };
    let mut worst = 0.0f64;
    for ((contour, tension, curl), expected) in cases.iter().zip(&found) {
        let params = Params::new().with("tension", *tension).with("curl", *curl);
        let spline = catalog::build("hobby", &params).unwrap();
        let solution = solve(contour, &*spline).unwrap();
        assert!(solution.report.relaxed.is_empty(), "{:?}", solution.report);
        assert!(solution.report.adapted.is_empty(), "{:?}", solution.report);
        let off = off(contour, &solution, expected, *tension);
        assert!(off <= 1e-9, "{off:e} {tension} {curl} {contour:?} {expected:?}");
        worst = worst.max(off);
    }
    println!("{} paths, largest difference: {worst:e} of the size", cases.len());
}

/// At a reversal the turn may be taken for half a turn either way: the curve is one of MetaPost's two
/// for knots that turn a little less than that.
#[test]
fn reversals_turn_one_way_or_the_other_as_metaposts() {
    const NUDGE: f64 = 1e-11;
    let mut random = Random(180);
    let cases: Vec<(Contour, usize)> = (0..100)
        .map(|i| {
            let at = |x: f64| if i % 2 == 0 { Point::new(x, 0.0) } else { Point::new(0.0, x) };
            let x = (random.between(1.0, 9.0).round(), random.between(-9.0, -1.0).round());
            let mut points = vec![at(0.0), at(x.0), at(x.1)];
            for _ in 0..i % 4 {
                points.push(Point::new(random.between(-9.0, 9.0), random.between(-9.0, 9.0)));
            }
            (Contour { closed: i % 4 > 1, ..Contour::open(points) }, 1)
        })
        .collect();
    let nudged = |(contour, which): &(Contour, usize), by: f64| {
        let mut contour = contour.clone();
        contour.knots[*which].point += Vec2::new(by, by);
        metapost(&contour, 1.0, 1.0)
    };
    let paths: Vec<String> =
        cases.iter().flat_map(|case| [nudged(case, NUDGE), nudged(case, -NUDGE)]).collect();
    let Some(found) = run_metapost("reversals", "double", &paths) else { return };
    let spline = catalog::spline("hobby").unwrap();
    for ((contour, _), expected) in cases.iter().zip(found.chunks(2)) {
        let solution = solve(contour, &*spline).unwrap();
        let off = off(contour, &solution, &expected[0], 1.0).min(off(
            contour,
            &solution,
            &expected[1],
            1.0,
        ));
        assert!(off <= 1e-9, "{off:e} {contour:?}");
    }
}

/// Two knots, open with given tangents and closed: out and back round either side.
#[test]
fn two_knots_as_metaposts() {
    let mut random = Random(2);
    let mut cases: Vec<Contour> = (0..60)
        .map(|_| {
            let (a, b) = (random.direction().to_point(), random.direction().to_point());
            let start = Knot::new(a).tangent(random.direction());
            let end = Knot::new(b);
            let end = if random.chance(0.5) { end.tangent(random.direction()) } else { end };
            Contour::open([start, end])
        })
        .collect();
    // Where a coordinate doesn't change, MetaPost's zeros have signs, and it draws an eight.
    cases.push(Contour::closed([(0.0, 0.0), (1.0, 2.0)]));
    let paths: Vec<String> = cases.iter().map(|contour| metapost(contour, 1.0, 1.0)).collect();
    let Some(found) = run_metapost("two", "double", &paths) else { return };
    let spline = catalog::spline("hobby").unwrap();
    for (contour, expected) in cases.iter().zip(&found) {
        let solution = solve(contour, &*spline).unwrap();
        let mut off_here = off(contour, &solution, expected, 1.0);
        if contour.closed {
            // In the chord.
            let mirror = |p: Point| {
                let (x, y) = (p.x, p.y);
                Point::new((-3.0 * x + 4.0 * y) / 5.0, (4.0 * x + 3.0 * y) / 5.0)
            };
            let mirrored: Vec<[Point; 2]> = expected.iter().map(|c| c.map(mirror)).collect();
            off_here = off_here.min(off(contour, &solution, &mirrored, 1.0));
        }
        assert!(off_here <= 1e-9, "{off_here:e} {contour:?} {expected:?}");
    }
}
