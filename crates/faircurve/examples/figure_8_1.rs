//! Figure 8.1 of the thesis, redrawn: precision against time for spiro(1, 2, 3, 4), by polynomials
//! of every even order from 2 to 16 with the subdivisions doubled from point to point, and by the
//! quadrature that the library uses.
//!
//! ```sh
//! cargo run --release -p faircurve --example figure_8_1
//! ```
//!
//! writes `docs/figures/figure-8-1.svg`. Times are those of the machine it runs on.

use std::fmt::Write as _;
use std::hint::black_box;
use std::io::Write as _;
use std::time::{Duration, Instant};

use faircurve::numeric::spiro_integral::{RULES, spiro_integral};
use faircurve::numeric::spiro_series::ORDERS;
use num_complex::Complex64;

const ARGUMENTS: [f64; 4] = [1.0, 2.0, 3.0, 4.0];

/// spiro(1, 2, 3, 4), computed with 40 digits.
const EXACT: Complex64 = Complex64::new(0.946_627_441_183_762_4, 0.077_549_730_486_535_3);

/// Below this an error is only the rounding of the result.
const ROUNDING: f64 = 1.2e-16;

/// Errors below this are drawn here.
const LEAST_ERROR: f64 = 1e-17;

/// No point takes longer, in nanoseconds.
const LONGEST: f64 = 1e4;

fn main() -> std::io::Result<()> {
    let mut plot = Plot::new([3.0, LONGEST], [LEAST_ERROR, 1.0]);
    for (i, (order, series)) in ORDERS.into_iter().enumerate() {
        let mut points = Vec::new();
        for pieces in (0..).map(|doublings| 1usize << doublings) {
            let point = measure(|k| series(k, pieces));
            if point.nanoseconds > LONGEST {
                break;
            }
            points.push(point);
            if point.error <= ROUNDING {
                break;
            }
        }
        plot.line(&format!("order {order}"), SHADES[i], &points);
    }
    let rules: Vec<Point> = RULES[..3].iter().map(|(_, rule)| measure(*rule)).collect();
    plot.line("Gauss–Legendre, 8, 12, 16 nodes", ACCENT, &rules);
    plot.ring("spiro_integral", ACCENT, measure(spiro_integral));

    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/figures");
    std::fs::create_dir_all(folder)?;
    std::fs::write(format!("{folder}/figure-8-1.svg"), plot.finish())?;
    writeln!(std::io::stdout(), "wrote docs/figures/figure-8-1.svg")
}

/// One way to evaluate: how long it takes and how far off it is.
#[derive(Clone, Copy)]
struct Point {
    nanoseconds: f64,
    error: f64,
}

/// The least time of many batches is the one that nothing disturbed.
fn measure(evaluate: impl Fn([f64; 4]) -> Complex64) -> Point {
    let error = (evaluate(ARGUMENTS) - EXACT).norm();
    let batch = |count: u32| {
        let start = Instant::now();
        for _ in 0..count {
            black_box(evaluate(black_box(ARGUMENTS)));
        }
        start.elapsed()
    };
    let mut count = 16;
    while batch(count) < Duration::from_micros(200) {
        count *= 2;
    }
    let least = (0..100).map(|_| batch(count)).min().unwrap_or_default();
    Point { nanoseconds: least.as_secs_f64() * 1e9 / f64::from(count), error }
}

const SHADES: [&str; 8] =
    ["#a9c9e8", "#7fb2dd", "#5599d0", "#2f80bf", "#1b67a8", "#12508b", "#0c3a6b", "#06244a"];
const ACCENT: &str = "#c8371b";
const WIDTH: f64 = 940.0;
const HEIGHT: f64 = 560.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 640.0;
const TOP: f64 = 56.0;
const BOTTOM: f64 = 496.0;

/// A plot with two logarithmic axes, written as SVG.
struct Plot {
    x: [f64; 2],
    y: [f64; 2],
    svg: String,
    entries: usize,
}

impl Plot {
    fn new(x: [f64; 2], y: [f64; 2]) -> Self {
        let mut plot = Plot { x, y, svg: String::new(), entries: 0 };
        plot.push(format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
             width=\"{WIDTH}\" height=\"{HEIGHT}\" font-family=\"sans-serif\" font-size=\"14\" \
             fill=\"#222\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>"
        ));
        plot.text(
            LEFT,
            30.0,
            "start",
            "Precision against time for spiro(1, 2, 3, 4); subdivisions double from point to point",
        );
        plot.grid();
        plot
    }

    fn push(&mut self, line: std::fmt::Arguments<'_>) {
        // Writing to a string can't fail.
        let _ = writeln!(self.svg, "{line}");
    }

    fn text(&mut self, x: f64, y: f64, anchor: &str, text: &str) {
        self.push(format_args!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>"
        ));
    }

    fn grid(&mut self) {
        let rule = |[x0, y0, x1, y1]: [f64; 4]| {
            format!(
                "<line x1=\"{x0:.1}\" y1=\"{y0:.1}\" x2=\"{x1:.1}\" y2=\"{y1:.1}\" \
                 stroke=\"#ddd\"/>"
            )
        };
        for (nanoseconds, label) in
            [(10.0, "10 ns"), (100.0, "100 ns"), (1e3, "1 µs"), (1e4, "10 µs")]
        {
            let x = self.place_x(nanoseconds);
            self.push(format_args!("{}", rule([x, TOP, x, BOTTOM])));
            self.text(x, BOTTOM + 20.0, "middle", label);
        }
        for exponent in (-16..=0).step_by(2) {
            let y = self.place_y(10f64.powi(exponent));
            self.push(format_args!("{}", rule([LEFT, y, RIGHT, y])));
            let digits: String = exponent.to_string().chars().map(superscript).collect();
            let label = if exponent == 0 { "1".to_owned() } else { format!("10{digits}") };
            self.text(LEFT - 10.0, y + 5.0, "end", &label);
        }
        self.text((LEFT + RIGHT) / 2.0, BOTTOM + 46.0, "middle", "time of one evaluation");
        let middle = (TOP + BOTTOM) / 2.0;
        self.push(format_args!(
            "<text x=\"24\" y=\"{middle:.1}\" text-anchor=\"middle\" \
             transform=\"rotate(-90 24 {middle:.1})\">error</text>"
        ));
    }

    fn place_x(&self, nanoseconds: f64) -> f64 {
        LEFT + (RIGHT - LEFT) * fraction(nanoseconds, self.x)
    }

    fn place_y(&self, error: f64) -> f64 {
        BOTTOM - (BOTTOM - TOP) * fraction(error.max(LEAST_ERROR), self.y)
    }

    /// A row of the legend with the mark that it explains.
    fn entry(&mut self, mark: &str, name: &str) {
        let y = TOP + 12.0 + 26.0 * self.entries as f64;
        self.entries += 1;
        self.push(format_args!(
            "<g transform=\"translate({:.1} {y:.1})\">{mark}</g>",
            RIGHT + 34.0
        ));
        self.text(RIGHT + 58.0, y + 5.0, "start", name);
    }

    fn line(&mut self, name: &str, colour: &str, points: &[Point]) {
        let places: Vec<String> = points
            .iter()
            .map(|p| format!("{:.1},{:.1}", self.place_x(p.nanoseconds), self.place_y(p.error)))
            .collect();
        self.push(format_args!(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\"/>",
            places.join(" ")
        ));
        for place in &places {
            if let Some((x, y)) = place.split_once(',') {
                self.push(format_args!(
                    "<circle cx=\"{x}\" cy=\"{y}\" r=\"3.2\" fill=\"{colour}\"/>"
                ));
            }
        }
        let mark = format!(
            "<path d=\"M-14,0H14\" stroke=\"{colour}\" stroke-width=\"1.8\"/>\
             <circle r=\"3.2\" fill=\"{colour}\"/>"
        );
        self.entry(&mark, name);
    }

    fn ring(&mut self, name: &str, colour: &str, point: Point) {
        let ring = format!("r=\"7\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\"/>");
        let (x, y) = (self.place_x(point.nanoseconds), self.place_y(point.error));
        self.push(format_args!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" {ring}"));
        self.entry(&format!("<circle {ring}"), name);
    }

    fn finish(mut self) -> String {
        self.push(format_args!("</svg>"));
        self.svg
    }
}

/// How far a value lies between two others, by logarithm.
fn fraction(value: f64, [from, to]: [f64; 2]) -> f64 {
    (value / from).ln() / (to / from).ln()
}

fn superscript(digit: char) -> char {
    match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4'..='9' => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
        _ => '⁰',
    }
}
