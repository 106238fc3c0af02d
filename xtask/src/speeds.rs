//! The table of times in docs/speeds.md.

use std::f64::consts::TAU;
use std::fs;
use std::hint::black_box;
use std::time::{Duration, Instant};

use faircurve::Contour;
use faircurve::catalog::{self, ENTRIES};
use faircurve::frame::ChordAngles;
use faircurve::kurbo::Point;
use faircurve::two_param::curvature_map::SegmentContext;
use faircurve::two_param::shape::SegmentEnds;

use crate::family::Family;
use crate::{at, root};

const BEGIN: &str = "<!-- measured by cargo xtask speeds -->\n";
const END: &str = "<!-- end -->\n";

/// Measures, and puts the table between its markers.
pub(crate) fn write() -> Result<(), String> {
    let path = root().join("docs/speeds.md");
    let text = fs::read_to_string(&path).map_err(|error| at(&path, &error))?;
    let begin = text.find(BEGIN).map(|at| at + BEGIN.len());
    let (begin, end) =
        begin.zip(text.find(END)).ok_or_else(|| format!("{}: no markers", path.display()))?;
    let table = table();
    print!("{table}");
    let text = format!("{}{table}{}", &text[..begin], &text[end..]);
    fs::write(&path, text).map_err(|error| at(&path, &error))
}

fn table() -> String {
    let mut table =
        "| spline | curvature map, ns | segment, ns | 64 knots, µs |\n|---|--:|--:|--:|\n"
            .to_owned();
    let families: Vec<Family> = Family::all().collect();
    let angles = angles();
    let contour = jittered_circle(64);
    for info in ENTRIES {
        let family = families.iter().find(|family| family.info.name == info.name);
        let map = family.and_then(|family| family.parts.as_ref()).map(|parts| {
            per_item(&angles, |angles| {
                black_box(parts.map.curvatures(*angles, &SegmentContext::UNIT));
            })
        });
        let segment = family.map(|family| match &family.parts {
            Some(parts) => {
                let ends = |angles: &ChordAngles| SegmentEnds {
                    angles: *angles,
                    curvatures: Some(parts.map.curvatures(*angles, &SegmentContext::UNIT).value),
                    context: SegmentContext::UNIT,
                };
                let ends: Vec<SegmentEnds> = angles.iter().map(ends).collect();
                let (start, end) = (Point::ORIGIN, Point::new(1.0, 0.0));
                per_item(&ends, |ends| {
                    black_box(parts.shape.place(start, end, black_box(ends)));
                })
            }
            None => per_item(&angles, |angles| {
                black_box(family.segment(*angles));
            }),
        });
        let solve = catalog::spline(info.name).ok().map(|spline| {
            per_item(&[()], |()| {
                let _ = black_box(faircurve::solve(black_box(&contour), &*spline));
            })
        });
        // Without parts, a segment is a contour of two knots, all that goes with it included.
        let note = match family {
            Some(family) if family.parts.is_none() => " *",
            _ => "",
        };
        let (map, segment) = (shown(map, 1.0), shown(segment, 1.0));
        let solve = shown(solve, 1e-3);
        table.push_str(&format!("| `{}` | {map} | {segment}{note} | {solve} |\n", info.name));
    }
    table
}

/// Nanoseconds times a factor, to two digits, or a dash.
fn shown(nanoseconds: Option<f64>, factor: f64) -> String {
    nanoseconds.map_or("–".to_owned(), |time| {
        let time = time * factor;
        let unit = 10f64.powf(time.log10().floor() - 1.0);
        let digits = (-unit.log10().round()).max(0.0) as usize;
        format!("{:.digits$}", (time / unit).round() * unit)
    })
}

/// Nanoseconds an item: the least of several rounds of a twentieth of a second or more.
fn per_item<T>(items: &[T], mut work: impl FnMut(&T)) -> f64 {
    const ROUNDS: usize = 7;
    const ROUND: Duration = Duration::from_millis(50);
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        let mut count = 0;
        while start.elapsed() < ROUND {
            items.iter().for_each(&mut work);
            count += items.len();
        }
        best = best.min(start.elapsed().as_nanos() as f64 / count as f64);
    }
    best
}

/// Numbers in [−1, 1), the same in every run.
fn random() -> impl FnMut() -> f64 {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Pairs of end angles up to 60 degrees.
fn angles() -> Vec<ChordAngles> {
    let mut next = random();
    (0..256).map(|_| ChordAngles::new(TAU / 6.0 * next(), TAU / 6.0 * next())).collect()
}

/// Closed, each knot moved along and across the circle by up to a tenth of their spacing; the
/// benchmark of the library has the same.
fn jittered_circle(count: usize) -> Contour {
    let mut next = random();
    let spacing = TAU / count as f64;
    let knots: Vec<Point> = (0..count)
        .map(|i| {
            let angle = spacing * (i as f64 + 0.1 * next());
            let radius = 500.0 * (1.0 + 0.1 * spacing * next());
            Point::new(radius * angle.cos(), radius * angle.sin())
        })
        .collect();
    Contour::closed(knots)
}
