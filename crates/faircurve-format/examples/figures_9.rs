//! Figures 9.4 to 9.7 and 9.9 of the thesis, redrawn, and the error against the number of cubics.
//!
//! ```sh
//! cargo run --release -p faircurve-format --example figures_9
//! ```
//!
//! writes `docs/figures/figure-9-*.svg` and says how many cubics each level of figure 9.9 takes, for `examples/a.json` and the
//! documents and fonts that are named; of a font, for glyph `a`.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use faircurve::convert::{
    Conversion, Cuts, Fit, Metric, Options, convert, fit_single, local_minima,
};
use faircurve::kurbo::{
    BezPath, CubicBez, ParamCurve, ParamCurveArclen, ParamCurveDeriv, PathEl, Point, Vec2,
};
use faircurve::{Curve, PolynomialSpiral, Segment, catalog};
use faircurve_format::Kind;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/figures"));
    let write = |name: &str, text: String| std::fs::write(folder.join(name), text);
    let metric = Metric::SquaredAngle;

    let segment = euler(0.5, 1.1);
    let fits = [
        ("arms of a third of the arc length", Fit::ArcThird),
        ("equal arms, equal arc length", Fit::EqualArms),
        ("fully optimised", Fit::Optimal),
    ];
    let panels = fits.map(|(name, fit)| (name.to_owned(), fit_single(&segment, metric, fit).cubic));
    write("figure-9-4.svg", side_by_side(&segment, &panels))?;
    write("figure-9-5.svg", isolines(&euler(0.5, 1.0)))?;
    for (name, t1) in [("figure-9-6.svg", 1.0), ("figure-9-7.svg", 0.85)] {
        let segment = euler(0.5, t1);
        let panels: Vec<(String, CubicBez)> = local_minima(&segment, metric)
            .iter()
            // The thesis shows those whose arms aren't far from equal.
            .filter(|fit| (0.2..0.8).contains(&share(&fit.cubic)))
            .map(|fit| {
                (format!("E_sq {:.2e}, a/(a + b) = {:.3}", fit.error, share(&fit.cubic)), fit.cubic)
            })
            .collect();
        write(name, side_by_side(&segment, &panels))?;
    }
    write("figure-9-orders.svg", orders())?;

    let named: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let own = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/a.json"));
    let files: Vec<PathBuf> = std::iter::once(own.to_owned()).chain(named).collect();
    for (index, file) in files.iter().enumerate() {
        let curves = glyph_a(file)?;
        let levels = LEVELS.map(|(_, fit, cuts)| level(&curves, fit, cuts));
        let counts = levels.iter().map(|level| level.iter().map(|c| c.cubics).sum::<usize>());
        let counts: Vec<String> = counts.map(|count| count.to_string()).collect();
        writeln!(std::io::stdout(), "{}: {} cubics", file.display(), counts.join(", "))?;
        if index == 0 {
            write("figure-9-9.svg", four_levels(&levels))?;
        }
    }
    Ok(())
}

/// The piece t0 … t1 of the Euler spiral κ = 2t (eq. 4.6).
fn euler(t0: f64, t1: f64) -> Segment {
    let length = t1 - t0;
    let spiral = PolynomialSpiral::new([(t0 + t1) * length, 2.0 * length * length, 0.0, 0.0]);
    let end = Point::new(length * spiral.chord().length, 0.0);
    Segment::spiral(Point::ZERO, end, spiral)
}

fn share(cubic: &CubicBez) -> f64 {
    let (a, b) = ((cubic.p1 - cubic.p0).hypot(), (cubic.p3 - cubic.p2).hypot());
    a / (a + b)
}

/// Places on a cubic: share of arc length, direction, curvature.
fn along(cubic: &CubicBez, steps: usize) -> Vec<[f64; 3]> {
    let (first, second) = (cubic.deriv(), cubic.deriv().deriv());
    let mut rows = Vec::new();
    let (mut length, mut last) = (0.0, cubic.p0);
    for i in 0..=steps {
        let t = i as f64 / steps as f64;
        let (velocity, acceleration) = (first.eval(t).to_vec2(), second.eval(t).to_vec2());
        length += (cubic.eval(t) - last).hypot();
        last = cubic.eval(t);
        rows.push([
            length,
            velocity.atan2(),
            velocity.cross(acceleration) / velocity.hypot().powi(3),
        ]);
    }
    for row in &mut rows {
        row[0] /= length;
    }
    rows
}

struct Svg {
    text: String,
    size: [f64; 2],
}

const INK: &str = "#222";
const BLUE: &str = "#2b62c9";
const GREY: &str = "#bbb";

impl Svg {
    fn new(width: f64, height: f64) -> Self {
        Svg { text: String::new(), size: [width, height] }
    }

    fn line(&mut self, points: &[Point], colour: &str, width: f64) {
        let mut d = String::new();
        for (i, p) in points.iter().enumerate() {
            let _ = write!(d, "{}{:.1},{:.1}", if i == 0 { "M" } else { "L" }, p.x, p.y);
        }
        let _ = writeln!(
            self.text,
            r#"<path d="{d}" fill="none" stroke="{colour}" stroke-width="{width}"/>"#
        );
    }

    fn dot(&mut self, p: Point, colour: &str) {
        let _ = writeln!(
            self.text,
            r#"<circle cx="{:.1}" cy="{:.1}" r="2.5" fill="{colour}"/>"#,
            p.x, p.y
        );
    }

    fn words(&mut self, x: f64, y: f64, words: &str) {
        let _ = writeln!(
            self.text,
            r#"<text x="{x}" y="{y}" font-family="sans-serif" font-size="11" fill="{INK}">{words}</text>"#
        );
    }

    fn finish(self) -> String {
        let [width, height] = self.size;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
             height=\"{height}\"><rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n{}</svg>\n",
            self.text
        )
    }
}

/// Panels of a curvature plot over the curve: the spiral grey, the cubic in ink, its arms blue.
fn side_by_side(segment: &Segment, panels: &[(String, CubicBez)]) -> String {
    const WIDTH: f64 = 270.0;
    let mut svg = Svg::new(WIDTH * panels.len() as f64, 250.0);
    let length = segment.length();
    let top = segment.curvature(length).abs() * 1.25;
    for (i, (name, cubic)) in panels.iter().enumerate() {
        let left = WIDTH * i as f64 + 20.0;
        let plot = |share: f64, kappa: f64| {
            Point::new(left + 230.0 * share, 140.0 - 120.0 * (kappa / top).clamp(-0.1, 1.1))
        };
        svg.line(&[plot(0.0, 0.0), plot(1.0, 0.0)], GREY, 0.7);
        svg.line(
            &[plot(0.0, segment.curvature(0.0)), plot(1.0, segment.curvature(length))],
            GREY,
            3.0,
        );
        let rows = along(cubic, 80);
        let curve: Vec<Point> = rows.iter().map(|row| plot(row[0], row[2])).collect();
        svg.line(&curve, INK, 1.2);
        let scale = 230.0 / segment.chord_length();
        let place = |p: Point| Point::new(left + scale * p.x, 170.0 - scale * p.y);
        let spiral: Vec<Point> =
            (0..=40).map(|j| place(segment.point(length * f64::from(j) / 40.0))).collect();
        svg.line(&spiral, GREY, 3.0);
        let drawn: Vec<Point> = (0..=40).map(|j| place(cubic.eval(f64::from(j) / 40.0))).collect();
        svg.line(&drawn, INK, 1.2);
        for [from, to] in [[cubic.p0, cubic.p1], [cubic.p3, cubic.p2]] {
            svg.line(&[place(from), place(to)], BLUE, 0.8);
            svg.dot(place(to), BLUE);
        }
        svg.words(left, 14.0, name);
    }
    svg.finish()
}

/// Root mean square of the angle error over both arms (figure 9.5), sampled.
///
/// The valley along which the arc lengths agree is narrow: the grid follows it, by the left arm's share and the
/// sum of both, in steps that grow with the distance from the valley.
fn isolines(segment: &Segment) -> String {
    const SHARES: usize = 160;
    const SUMS: usize = 80;
    const SIDE: f64 = 420.0;
    let length = segment.length();
    let most = 0.75 * length;
    let t0 = Vec2::from_angle(segment.direction(0.0));
    let t1 = Vec2::from_angle(segment.direction(length));
    let cubic = |[a, b]: [f64; 2]| {
        let (p0, p3) = (segment.start(), segment.end());
        CubicBez::new(p0, p0 + t0 * a, p3 - t1 * b, p3)
    };
    let error = |arms: [f64; 2]| {
        let rows = along(&cubic(arms), 200);
        let mut sum = 0.0;
        for pair in rows.windows(2) {
            let share = (pair[0][0] + pair[1][0]) / 2.0;
            let direction = (pair[0][1] + pair[1][1]) / 2.0;
            sum +=
                (pair[1][0] - pair[0][0]) * (direction - segment.direction(share * length)).powi(2);
        }
        sum.sqrt().ln()
    };
    let arms = |share: f64, sum: f64| [share * sum, (1.0 - share) * sum];
    // The sum at which the cubic is as long as the segment.
    let valley = |share: f64| {
        let (mut low, mut high) = (0.0, 2.0 * length);
        for _ in 0..40 {
            let sum = (low + high) / 2.0;
            if cubic(arms(share, sum)).arclen(1e-9) < length { low = sum } else { high = sum }
        }
        low
    };
    let grid: Vec<Vec<([f64; 2], f64)>> = (0..=SHARES)
        .map(|i| {
            let share = 0.02 + 0.96 * i as f64 / SHARES as f64;
            let middle = valley(share);
            let row = (0..=SUMS).map(|j| {
                let away = 2.0 * j as f64 / SUMS as f64 - 1.0;
                let arms = arms(share, middle * (1.0 + 0.45 * (6.0 * away).sinh() / 6f64.sinh()));
                (arms, error(arms))
            });
            row.collect()
        })
        .collect();
    let place =
        |[a, b]: [f64; 2]| Point::new(40.0 + SIDE * a / most, 20.0 + SIDE * (1.0 - b / most));
    let is_shown = |p: &Point| p.x <= 40.0 + SIDE && p.y >= 20.0;
    let mut svg = Svg::new(SIDE + 70.0, SIDE + 65.0);
    let (origin, right, top) = (place([0.0; 2]), place([most, 0.0]), place([0.0, most]));
    svg.line(&[top, origin, right], GREY, 0.7);
    // Where the arc lengths agree.
    let line: Vec<Point> = grid.iter().map(|row| place(row[SUMS / 2].0)).collect();
    svg.line(&line, GREY, 1.5);
    for level in 0..9 {
        let value = (2e-4f64).ln() + f64::from(level) * 2f64.ln();
        let mut d = String::new();
        for i in 0..SHARES {
            for j in 0..SUMS {
                // Where the level crosses the edges of a cell.
                let corners = [grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]];
                let mut crossings = Vec::new();
                for c in 0..4 {
                    let ((from, v0), (to, v1)) = (corners[c], corners[(c + 1) % 4]);
                    let (v0, v1) = (v0 - value, v1 - value);
                    if (v0 < 0.0) != (v1 < 0.0) {
                        crossings.push(place(from).lerp(place(to), v0 / (v0 - v1)));
                    }
                }
                for pair in crossings.chunks_exact(2).filter(|pair| pair.iter().all(is_shown)) {
                    let _ = write!(
                        d,
                        "M{:.1},{:.1}L{:.1},{:.1}",
                        pair[0].x, pair[0].y, pair[1].x, pair[1].y
                    );
                }
            }
        }
        let _ =
            writeln!(svg.text, r#"<path d="{d}" stroke="{INK}" stroke-width="0.7" fill="none"/>"#);
    }
    for fit in local_minima(segment, Metric::SquaredAngle) {
        let (a, b) = ((fit.cubic.p1 - fit.cubic.p0).hypot(), (fit.cubic.p3 - fit.cubic.p2).hypot());
        svg.dot(place([a, b]), BLUE);
    }
    svg.words(
        40.0,
        SIDE + 40.0,
        "left arm →, right arm ↑; isolines of the root mean square angle,",
    );
    svg.words(40.0, SIDE + 55.0, "each twice the last; grey: equal arc length; blue: local minima");
    svg.finish()
}

/// The four levels of figure 9.9.
const LEVELS: [(&str, Fit, Cuts); 4] = [
    ("halving, equal arms", Fit::EqualArms, Cuts::Halving),
    ("halving, optimal fits", Fit::Optimal, Cuts::Halving),
    ("greedy, optimal fits", Fit::Optimal, Cuts::Greedy),
    ("equal errors, optimal fits", Fit::Optimal, Cuts::EqualErrors),
];

fn level(curves: &[Curve], fit: Fit, cuts: Cuts) -> Vec<Conversion> {
    /// Of E_sq, in √units, for a letter of 500 units: 0.001 for a size of 1, as in figure 9.3, is 0.022.
    const ACCURACY: f64 = 0.05;
    let metric = Metric::SquaredAngle;
    let options = Options { metric, fit, cuts, span_knots: true, ..Options::new(ACCURACY) };
    curves.iter().map(|curve| convert(curve, &options)).collect()
}

fn glyph_a(file: &Path) -> Result<Vec<Curve>, Box<dyn std::error::Error>> {
    let extension = file.extension().unwrap_or_default().to_string_lossy();
    let kind = Kind::from_extension(&extension)?;
    let document = faircurve_format::read(&std::fs::read(file)?, kind)?;
    let spline = catalog::spline("spiro")?;
    let is_a = |glyph: &&faircurve_format::Glyph| glyph.name == "a" || document.glyphs.len() == 1;
    let glyph = document.glyphs.iter().find(is_a).ok_or("no glyph `a`")?;
    let solve = |contour: &faircurve_format::DocumentContour| {
        Ok(faircurve::solve(&contour.contour, &*spline)?.curve)
    };
    glyph.contours.iter().map(solve).collect()
}

fn four_levels(levels: &[Vec<Conversion>; 4]) -> String {
    const CELL: f64 = 300.0;
    let mut svg = Svg::new(2.0 * CELL, 2.0 * CELL + 40.0);
    for (i, conversions) in levels.iter().enumerate() {
        let (left, bottom) = (CELL * (i % 2) as f64, (CELL + 20.0) * (i / 2 + 1) as f64 - 20.0);
        let place = |p: Point| Point::new(left + 10.0 + 0.5 * p.x, bottom - 15.0 - 0.5 * p.y);
        let mut path = BezPath::new();
        for conversion in conversions {
            path.extend(conversion.path.iter());
        }
        let mut d = String::new();
        let mut ends = Vec::new();
        for element in path.elements() {
            let shown = |p: &Point| format!("{:.1},{:.1}", place(*p).x, place(*p).y);
            let _ = match element {
                PathEl::MoveTo(p) => write!(d, "M{}", shown(p)),
                PathEl::LineTo(p) => write!(d, "L{}", shown(p)),
                PathEl::CurveTo(a, b, p) => write!(d, "C{} {} {}", shown(a), shown(b), shown(p)),
                _ => write!(d, "Z"),
            };
            ends.extend(element.end_point());
        }
        let _ = writeln!(svg.text, r#"<path d="{d}" fill="none" stroke="{INK}"/>"#);
        for end in ends {
            svg.dot(place(end), BLUE);
        }
        let cubics: usize = conversions.iter().map(|c| c.cubics).sum();
        svg.words(left + 10.0, bottom, &format!("{}: {cubics} cubics", LEVELS[i].0));
    }
    svg.finish()
}

/// Largest distance against the number of equal pieces of one Euler spiral.
fn orders() -> String {
    let mut svg = Svg::new(490.0, 355.0);
    let segment = euler(0.0, 2.5);
    let place = |n: f64, error: f64| {
        Point::new(50.0 + 340.0 * n.log2() / 6.0, 20.0 + 300.0 * -error.log10() / 13.0)
    };
    let fits = [Fit::ArcThird, Fit::EqualArms, Fit::EndCurvature, Fit::Optimal];
    for (i, fit) in fits.into_iter().enumerate() {
        let mut points = Vec::new();
        for n in [1, 2, 4, 8, 16, 32, 64] {
            let part = segment.length() / f64::from(n);
            let worst = (0..n)
                .map(|j| segment.subsegment(part * f64::from(j), part * f64::from(j + 1)))
                .map(|piece| fit_single(&piece, Metric::Distance, fit).error)
                .fold(0.0, f64::max);
            // One or two cubics for all of it are hopeless by some fits.
            if worst <= 1.0 {
                points.push(place(f64::from(n), worst));
            }
        }
        svg.line(&points, if fit == Fit::Optimal { BLUE } else { INK }, 1.2);
        for point in &points {
            svg.dot(*point, if fit == Fit::Optimal { BLUE } else { INK });
        }
        let last = points[points.len() - 1];
        let y = last.y + [4.0, 0.0, 10.0, 6.0][i];
        svg.words(last.x + 4.0, y, fit.name());
    }
    svg.line(&[place(1.0, 1.0), place(1.0, 1e-12), place(64.0, 1e-12)], GREY, 0.7);
    for decade in (0..=12).step_by(2) {
        svg.words(
            8.0,
            place(1.0, 10f64.powi(-decade)).y + 4.0,
            &if decade == 0 { "1".to_owned() } else { format!("1e-{decade}") },
        );
    }
    for n in [1, 2, 4, 8, 16, 32, 64] {
        svg.words(place(f64::from(n), 1.0).x - 4.0, 318.0, &n.to_string());
    }
    svg.words(
        50.0,
        340.0,
        "largest distance against the number of equal pieces of κ = 2s, 0 ≤ s ≤ 2.5",
    );
    svg.finish()
}
