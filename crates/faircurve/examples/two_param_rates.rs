//! How often each two-parameter spline of the catalogue solves random knots, and how far it has to
//! go for it.
//!
//! ```sh
//! cargo run --release -p faircurve --example two_param_rates -- [CASES] [SPLINE…] [KEY=VALUE…] [--by-class]
//! ```
//!
//! Classes: a circle with jitter, a walk that turns by less than 60° a knot, and uniform in a square;
//! open and closed; 4, 8, 16, 32, 64, 128 and 256 knots. By default 6,006 contours, 143 of each.

use std::f64::consts::{PI, TAU};
use std::io::Write;
use std::time::Instant;

use faircurve::catalog::{self, Claim, ENTRIES, Params};
use faircurve::kurbo::{Point, Vec2};
use faircurve::{Contour, Solution, Spline, Stage, Status, solve};

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        low + (high - low) * ((z >> 11) as f64 / (1u64 << 53) as f64)
    }
}

const SHAPES: [&str; 3] = ["circle", "walk", "uniform"];
const SIZES: [usize; 7] = [4, 8, 16, 32, 64, 128, 256];

fn points(shape: &str, n: usize, random: &mut Random) -> Vec<Point> {
    match shape {
        "circle" => (0..n)
            .map(|i| {
                let angle = TAU * i as f64 / n as f64;
                let mut jitter = || random.between(-0.1, 0.1);
                let spacing = TAU / n as f64;
                let radius = 1.0 + jitter() * spacing;
                Point::ORIGIN + Vec2::from_angle(angle + jitter() * spacing) * radius * 500.0
            })
            .collect(),
        "walk" => {
            let (mut at, mut heading) = (Point::ORIGIN, random.between(0.0, TAU));
            (0..n)
                .map(|_| {
                    let here = at;
                    heading += random.between(-PI / 3.0, PI / 3.0);
                    at += Vec2::from_angle(heading) * random.between(50.0, 150.0);
                    here
                })
                .collect()
        }
        _ => (0..n)
            .map(|_| Point::new(random.between(0.0, 1000.0), random.between(0.0, 1000.0)))
            .collect(),
    }
}

/// What came of some contours.
#[derive(Default)]
struct Tally {
    cases: usize,
    solved: usize,
    stages: [usize; Stage::ALL.len()],
    relaxed_knots: usize,
    residual: f64,
    /// Knots called smooth at which the curve turns round.
    reversals: usize,
    seconds: f64,
    longest: f64,
}

impl Tally {
    fn add(&mut self, solution: &Solution, seconds: f64) {
        self.cases += 1;
        self.seconds += seconds;
        self.longest = self.longest.max(seconds);
        self.relaxed_knots += solution.report.relaxed.len();
        self.reversals += reversals(solution);
        if solution.report.status() == Status::Solved {
            self.solved += 1;
            self.stages[solution.report.stage as usize] += 1;
            self.residual = self.residual.max(solution.report.residual);
        }
    }

    fn print(&self, out: &mut impl Write, name: &str) -> std::io::Result<()> {
        let share = |count: usize| 100.0 * count as f64 / self.cases.max(1) as f64;
        let stages: Vec<String> =
            self.stages.iter().map(|&count| format!("{:7.2}", share(count))).collect();
        writeln!(
            out,
            "{name:28} {:6} {:7.2} {} {:7} {:9.1e} {:5} {:9.0} {:9.0}",
            self.cases,
            share(self.solved),
            stages.join(" "),
            self.relaxed_knots,
            self.residual,
            self.reversals,
            1e6 * self.seconds / self.cases.max(1) as f64,
            1e6 * self.longest,
        )
    }
}

/// Knots called smooth where the direction of travel jumps.
fn reversals(solution: &Solution) -> usize {
    let is_kink = |knot: &&faircurve::SolvedKnot| match (knot.direction_in, knot.direction_out) {
        (Some(a), Some(b)) => knot.join != faircurve::Join::Corner && (a - b).cos() < 0.5,
        _ => false,
    };
    solution.knots.iter().filter(is_kink).count()
}

fn main() -> std::io::Result<()> {
    let mut cases = 143;
    let (mut names, mut params, mut by_class) = (Vec::new(), Params::new(), false);
    for arg in std::env::args().skip(1) {
        match arg.parse() {
            Ok(count) => cases = count,
            Err(_) if arg == "--by-class" => by_class = true,
            Err(_) => match arg.split_once('=') {
                Some((key, value)) => params.set(key, value),
                None => names.push(arg),
            },
        }
    }
    let out = &mut std::io::stdout().lock();
    writeln!(
        out,
        "{:28} {:>6} {:>7} {} {:>7} {:>9} {:>5} {:>9} {:>9}",
        "spline and class",
        "cases",
        "solved%",
        Stage::ALL.map(|stage| format!("{:>7}", stage.name())).join(" "),
        "relaxed",
        "residual",
        "kinks",
        "mean µs",
        "most µs"
    )?;
    for info in ENTRIES {
        let two = info.claims.contains(&Claim::Parameters(2));
        if !two || !(names.is_empty() || names.iter().any(|name| name == info.name)) {
            continue;
        }
        let Ok(spline) = catalog::build(info.name, &params) else { continue };
        let mut whole = Tally::default();
        for (s, shape) in SHAPES.into_iter().enumerate() {
            for closed in [false, true] {
                for n in SIZES {
                    let mut tally = Tally::default();
                    for case in 0..cases {
                        let seed = ((case * 1000 + n) * 10 + s) * 2 + usize::from(closed);
                        measure(&*spline, shape, n, closed, seed as u64, [&mut tally, &mut whole]);
                    }
                    if by_class {
                        let how = if closed { "closed" } else { "open" };
                        tally.print(out, &format!("{} {shape} {how} {n}", info.name))?;
                    }
                }
            }
        }
        whole.print(out, info.name)?;
    }
    Ok(())
}

fn measure(
    spline: &dyn Spline,
    shape: &str,
    n: usize,
    closed: bool,
    seed: u64,
    tallies: [&mut Tally; 2],
) {
    let contour = Contour { closed, ..Contour::open(points(shape, n, &mut Random(seed << 20))) };
    let start = Instant::now();
    let solution = solve(&contour, spline).expect("ordinary numbers");
    let seconds = start.elapsed().as_secs_f64();
    tallies.into_iter().for_each(|tally| tally.add(&solution, seconds));
}
