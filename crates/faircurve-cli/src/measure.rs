//! `faircurve measure`.

use std::fmt::Write;
use std::process::ExitCode;

use faircurve::Solution;
use faircurve::kurbo::BezPath;
use faircurve::measure::fairness::jumps;
use faircurve::measure::{Fairness, Jump};
use faircurve_format::{SolvedContour, SolvedGlyph};
use rayon::prelude::*;
use serde::Serialize;

use crate::args::{self, MeasureArgs};
use crate::failure::Failure;
use crate::input;
use crate::output::{Target, format_among};
use crate::progress::Progress;
use crate::report;
use crate::select::{self, Job};

/// Read, select, solve, measure, write, report.
pub(crate) fn run(args: &MeasureArgs) -> Result<ExitCode, Failure> {
    let is_json = is_json(args)?;
    let effort = args::effort(args.drawing.effort.as_deref(), args.drawing.no_loops)?;
    let target = Target::new(&args.output, &args.drawing.inputs)?;
    let sources = input::read(&args.drawing.inputs, args.drawing.from.as_deref())?;
    let jobs = select::to_measure(sources, args)?;
    let progress = Progress::of("measuring", jobs.len(), "glyphs");
    let solve = |job: &Job| {
        let solved = job.solve(effort).map(|contours| unconverted(job, contours));
        progress.step();
        solved
    };
    let solved: Result<Vec<SolvedGlyph>, Failure> = jobs.par_iter().map(solve).collect();
    drop(progress);
    let solved = solved?;
    let measured: Vec<GlyphEntry<'_>> = solved.par_iter().map(glyph_entry).collect();
    let text = if is_json { as_json(measured)? } else { as_text(&measured) };
    target.write(text.as_bytes())?;
    Ok(report::report(&jobs, &solved, args.allow_relaxed))
}

fn is_json(args: &MeasureArgs) -> Result<bool, Failure> {
    let named = args.format.is_some();
    let json = args.output.extension().is_some_and(|e| e.eq_ignore_ascii_case("json"));
    if named {
        Ok(format_among(&["text", "json"], args.format.as_deref(), &args.output)? == "json")
    } else {
        Ok(json)
    }
}

/// Measuring needs no Béziers.
fn unconverted(job: &Job, contours: Vec<(String, Solution)>) -> SolvedGlyph {
    let contour = |(spline, solution)| SolvedContour { spline, solution, path: BezPath::new() };
    SolvedGlyph {
        name: job.name.clone(),
        layer: job.layer.clone(),
        contours: contours.into_iter().map(contour).collect(),
    }
}

#[derive(Serialize)]
struct File<'a> {
    faircurve: u32,
    glyphs: Vec<GlyphEntry<'a>>,
    /// Of all glyphs together.
    all: FairnessEntry,
}

#[derive(Serialize)]
struct GlyphEntry<'a> {
    name: &'a str,
    layer: &'a str,
    contours: Vec<ContourEntry<'a>>,
    /// Of all contours together.
    all: FairnessEntry,
    #[serde(skip)]
    fairness: Fairness,
}

#[derive(Serialize)]
struct ContourEntry<'a> {
    spline: &'a str,
    closed: bool,
    status: &'static str,
    #[serde(flatten)]
    fairness: FairnessEntry,
    knots: Vec<KnotEntry>,
}

/// The numbers of `faircurve::measure::Fairness`.
#[derive(Serialize)]
struct FairnessEntry {
    length: f64,
    bending_energy: f64,
    scale_free_energy: f64,
    variation_energy: f64,
    largest_curvature: f64,
    largest_variation: f64,
    turning: f64,
    extrema: usize,
    inflections: usize,
}

impl From<Fairness> for FairnessEntry {
    fn from(fairness: Fairness) -> Self {
        FairnessEntry {
            length: fairness.length,
            bending_energy: fairness.bending_energy,
            scale_free_energy: fairness.scale_free_energy(),
            variation_energy: fairness.variation_energy,
            largest_curvature: fairness.largest_curvature,
            largest_variation: fairness.largest_variation,
            turning: fairness.turning,
            extrema: fairness.extrema,
            inflections: fairness.inflections,
        }
    }
}

#[derive(Serialize)]
struct KnotEntry {
    x: f64,
    y: f64,
    join: &'static str,
    /// What leaves less what arrives; `null` at ends of open contours.
    jump: Option<JumpEntry>,
}

#[derive(Serialize)]
struct JumpEntry {
    direction: f64,
    curvature: f64,
    first_derivative: f64,
    second_derivative: f64,
    /// Of direction, κ, κ′, κ″, times the harmonic mean of both chords to the power of 0 to 3.
    dimensionless: [f64; 4],
}

impl From<Jump> for JumpEntry {
    fn from(jump: Jump) -> Self {
        JumpEntry {
            direction: jump.direction,
            curvature: jump.curvature,
            first_derivative: jump.first_derivative,
            second_derivative: jump.second_derivative,
            dimensionless: jump.dimensionless(),
        }
    }
}

fn glyph_entry(glyph: &SolvedGlyph) -> GlyphEntry<'_> {
    let mut fairness = Fairness::default();
    let contour = |contour: &'_ SolvedContour| {
        let own = Fairness::of(&contour.solution.curve);
        fairness = fairness.and(own);
        (own, jumps(&contour.solution.curve))
    };
    let measured: Vec<(Fairness, Vec<Option<Jump>>)> = glyph.contours.iter().map(contour).collect();
    let entry = |(contour, (own, jumps)): (&'_ SolvedContour, (Fairness, Vec<Option<Jump>>))| {
        let jumps = jumps.into_iter().chain(std::iter::repeat(None));
        let knot = |(knot, jump): (&faircurve::SolvedKnot, Option<Jump>)| KnotEntry {
            x: knot.point.x,
            y: knot.point.y,
            join: knot.join.name(),
            jump: jump.map(JumpEntry::from),
        };
        (own, contour.solution.knots.iter().zip(jumps).map(knot).collect::<Vec<_>>())
    };
    let contours = glyph
        .contours
        .iter()
        .zip(measured)
        .map(|(contour, numbers)| {
            let (own, knots) = entry((contour, numbers));
            ContourEntry {
                spline: &contour.spline,
                closed: contour.solution.curve.is_closed(),
                status: contour.solution.report.status().name(),
                fairness: own.into(),
                knots,
            }
        })
        .collect();
    GlyphEntry { name: &glyph.name, layer: &glyph.layer, contours, all: fairness.into(), fairness }
}

fn together(glyphs: &[GlyphEntry<'_>]) -> FairnessEntry {
    glyphs.iter().map(|glyph| glyph.fairness).fold(Fairness::default(), Fairness::and).into()
}

fn as_json(glyphs: Vec<GlyphEntry<'_>>) -> Result<String, Failure> {
    let all = together(&glyphs);
    let file = File { faircurve: 1, glyphs, all };
    let text = serde_json::to_string_pretty(&file).map_err(|e| Failure::new(e.to_string()))?;
    Ok(text + "\n")
}

/// A block for each contour: its numbers, then what jumps at each knot.
fn as_text(glyphs: &[GlyphEntry<'_>]) -> String {
    let mut text = String::new();
    let contours: usize = glyphs.iter().map(|glyph| glyph.contours.len()).sum();
    for glyph in glyphs {
        for (index, contour) in glyph.contours.iter().enumerate() {
            let named = |what: &str, name: &str| match name {
                "" => String::new(),
                name => format!("{what} {name}, "),
            };
            let closed = if contour.closed { "closed" } else { "open" };
            let _ = writeln!(
                text,
                "{}{}contour {index}: {}, {closed}, {} knots, {}",
                named("glyph", &printable(glyph.name)),
                named("layer", &printable(glyph.layer)),
                contour.spline,
                contour.knots.len(),
                contour.status
            );
            numbers(&mut text, &contour.fairness);
            knots(&mut text, &contour.knots);
            text.push('\n');
        }
    }
    if contours != 1 {
        let _ = writeln!(text, "in all: {contours} contours");
        numbers(&mut text, &together(glyphs));
    } else {
        text.pop();
    }
    text
}

/// Names from files without what would steer a terminal.
fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect()
}

fn numbers(text: &mut String, fairness: &FairnessEntry) {
    let mut row = |name: &str, value: String, meaning: &str| {
        let line = format!("  {name:<20}{value:>14}   {meaning}");
        text.push_str(line.trim_end());
        text.push('\n');
    };
    row("length", short(fairness.length), "units");
    row("bending energy", short(fairness.bending_energy), "∫κ² ds, 1/units");
    row("  without units", short(fairness.scale_free_energy), "length · ∫κ² ds");
    row("variation energy", short(fairness.variation_energy), "∫κ′² ds, 1/units³");
    row("largest curvature", short(fairness.largest_curvature), "|κ|, 1/units");
    row("largest variation", short(fairness.largest_variation), "|κ′|, 1/units²");
    row("turning", short(fairness.turning), "∫|κ| ds, radians");
    row("curvature extrema", fairness.extrema.to_string(), "between knots");
    row("inflections", fairness.inflections.to_string(), "");
}

fn knots(text: &mut String, knots: &[KnotEntry]) {
    if knots.iter().all(|knot| knot.jump.is_none()) {
        return;
    }
    let heads = ["direction", "κ", "κ′", "κ″"];
    let _ = write!(text, "  jumps, at knots   ");
    for head in heads {
        let _ = write!(text, "{head:>12}");
    }
    text.push('\n');
    for (index, knot) in knots.iter().enumerate() {
        let Some(jump) = &knot.jump else { continue };
        let _ = write!(text, "  {index:>5} {:<12}", knot.join);
        let all = [jump.direction, jump.curvature, jump.first_derivative, jump.second_derivative];
        for (jump, dimensionless) in all.into_iter().zip(jump.dimensionless) {
            /// What is smaller, without units, is rounding.
            const ROUNDING: f64 = 1e-10;
            let shown = if dimensionless.abs() < ROUNDING { "0".to_owned() } else { short(jump) };
            let _ = write!(text, "{shown:>12}");
        }
        text.push('\n');
    }
}

/// Six significant digits.
pub(crate) fn short(x: f64) -> String {
    significant(x, 6)
}

/// So many significant digits, with an exponent where it is shorter.
pub(crate) fn significant(x: f64, digits: usize) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    // Rounded first, so that 0.9999999 is 1.00000.
    let scientific = format!("{x:.*e}", digits - 1);
    let exponent = scientific.split_once('e').and_then(|(_, exponent)| exponent.parse().ok());
    match exponent {
        Some(exponent @ -4..=6) => {
            let decimals: i32 = digits as i32 - 1 - exponent;
            format!("{x:.*}", decimals.max(0) as usize)
        }
        _ => scientific,
    }
}
