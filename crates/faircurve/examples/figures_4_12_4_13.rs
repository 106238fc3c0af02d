//! Figures 4.12 and 4.13 of the thesis, redrawn: a zigzag through the same knots by log-aesthetic
//! splines of several exponents, with the bending energy of each; and how much a ripple shrinks from
//! knot to knot, by exponent.
//!
//! ```sh
//! cargo run --release -p faircurve --example figures_4_12_4_13
//! ```
//!
//! writes `docs/figures/figure-4-12.svg` and `docs/figures/figure-4-13.svg`.

use std::fmt::Write as _;
use std::io::Write as _;

use faircurve::catalog::Params;
use faircurve::families::log_aesthetic::LogAesthetic;
use faircurve::kurbo::{Affine, BezPath, Point, Vec2};
use faircurve::{Contour, Curve, catalog, solve};

/// The exponents drawn; 0.899 has the least energy, 1.78 was preferred by people.
const ALPHAS: [f64; 6] = [0.5, 0.899, 1.0, 1.78, 3.0, 6.0];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/figures");
    std::fs::write(format!("{folder}/figure-4-12.svg"), zigzags()?)?;
    std::fs::write(format!("{folder}/figure-4-13.svg"), ripples())?;
    writeln!(std::io::stdout(), "wrote docs/figures/figure-4-12.svg and figure-4-13.svg")?;
    Ok(())
}

fn head(width: u32, height: u32) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    )
}

/// A period of the zigzag of 45°, from the middle of a long one, for each exponent.
fn zigzags() -> Result<String, Box<dyn std::error::Error>> {
    const ROW: f64 = 80.0;
    const SCALE: f64 = 44.0;
    let mut svg = head(560, ALPHAS.len() as u32 * ROW as u32 + 20);
    let knots = || (0..33).map(|i| (f64::from(i), f64::from(i % 2)));
    let middle = |alpha: f64| -> Result<_, Box<dyn std::error::Error>> {
        let spline = catalog::build("log-aesthetic", &Params::new().with("alpha", alpha))?;
        let curve = solve(&Contour::open(knots()), &*spline)?.curve;
        Ok(Curve::new(curve.segments()[12..20].to_vec(), false))
    };
    let energy = |alpha: f64| -> Result<f64, Box<dyn std::error::Error>> {
        Ok(middle(alpha)?.segments()[4].bending_energy())
    };
    let euler = energy(1.0)?;
    for (i, alpha) in ALPHAS.into_iter().enumerate() {
        let base = ROW * (i as f64 + 1.0) - 10.0;
        let map = Affine::new([SCALE, 0.0, 0.0, -SCALE, 20.0 - 12.0 * SCALE, base]);
        let path = map * path(&middle(alpha)?);
        writeln!(
            svg,
            "<path d=\"{}\" fill=\"none\" stroke=\"#000\" stroke-width=\"1.5\"/>",
            rounded(&path)
        )?;
        for x in 12..=20 {
            let p = map * Point::new(f64::from(x), f64::from(x % 2));
            writeln!(svg, "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"2.5\" fill=\"#c33\"/>", p.x, p.y)?;
        }
        let ratio = energy(alpha)? / euler;
        writeln!(
            svg,
            "<text x=\"395\" y=\"{:.0}\">α = {alpha}</text>\
             <text x=\"395\" y=\"{:.0}\" fill=\"#555\">energy {ratio:.4}</text>",
            base - 30.0,
            base - 12.0
        )?;
    }
    svg.push_str("</svg>\n");
    Ok(svg)
}

/// Six cubics a segment, with arms of a third of their arc: as good as exact at this size.
fn path(curve: &Curve) -> BezPath {
    const PIECES: usize = 6;
    let mut path = BezPath::new();
    path.move_to(curve.start().unwrap_or(Point::ORIGIN));
    for segment in curve.segments() {
        let arc = segment.length() / PIECES as f64;
        for i in 0..PIECES {
            let [from, to] = [i, i + 1].map(|i| segment.at(i as f64 * arc));
            let arm = |direction: f64| Vec2::from_angle(direction) * (arc / 3.0);
            path.curve_to(from.point + arm(from.direction), to.point - arm(to.direction), to.point);
        }
    }
    path
}

/// A path with one decimal.
fn rounded(path: &BezPath) -> String {
    use faircurve::kurbo::PathEl;
    let p = |p: &Point| format!("{:.1},{:.1}", p.x, p.y);
    path.elements()
        .iter()
        .map(|element| match element {
            PathEl::MoveTo(a) => format!("M{}", p(a)),
            PathEl::LineTo(a) => format!("L{}", p(a)),
            PathEl::QuadTo(a, b) => format!("Q{} {}", p(a), p(b)),
            PathEl::CurveTo(a, b, c) => format!("C{} {} {}", p(a), p(b), p(c)),
            PathEl::ClosePath => "Z".to_owned(),
        })
        .collect()
}

/// The falloff factor by exponent, with the Euler spiral and the preferred exponent marked.
fn ripples() -> String {
    let (left, top, width, height) = (60.0, 20.0, 460.0, 260.0);
    let at =
        |alpha: f64, ripple: f64| (left + width * alpha / 5.0, top + height * (1.0 - 2.0 * ripple));
    let mut svg = head(560, 330);
    let mut line = |text: String| svg.push_str(&(text + "\n"));
    for i in 0..=5 {
        let ((x, y), (_, y1)) = (at(f64::from(i), 0.0), at(0.0, 0.5));
        line(format!("<path d=\"M{x:.1},{y:.1}V{y1:.1}\" stroke=\"#ddd\"/>"));
        line(format!("<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{i}</text>", y + 18.0));
        let ripple = 0.1 * f64::from(i);
        let (x, y) = at(0.0, ripple);
        line(format!("<path d=\"M{x:.1},{y:.1}H{:.1}\" stroke=\"#ddd\"/>", x + width));
        line(format!(
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{ripple:.1}</text>",
            x - 8.0,
            y + 4.0
        ));
    }
    let points: Vec<String> = (5..=250)
        .map(|i| f64::from(i) / 50.0)
        .map(|alpha| at(alpha, LogAesthetic::new(alpha).ripple()))
        .filter(|(_, y)| *y >= top)
        .map(|(x, y)| format!("{x:.1},{y:.1}"))
        .collect();
    line(format!(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"#000\" stroke-width=\"1.5\"/>",
        points.join(" ")
    ));
    for alpha in [1.0, 1.78] {
        let ripple = LogAesthetic::new(alpha).ripple();
        let (x, y) = at(alpha, ripple);
        line(format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"#c33\"/>"));
        line(format!(
            "<text x=\"{:.1}\" y=\"{:.1}\">α = {alpha}: {ripple:.6}</text>",
            x + 8.0,
            y - 8.0
        ));
    }
    line(format!(
        "<text x=\"{:.1}\" y=\"322\" text-anchor=\"middle\">exponent α</text>",
        left + width / 2.0
    ));
    svg.push_str("</svg>\n");
    svg
}
