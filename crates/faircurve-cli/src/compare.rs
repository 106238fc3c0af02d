//! `faircurve compare`.

use std::process::ExitCode;

use faircurve::Spline;
use faircurve::catalog::{self, ENTRIES, Params};
use faircurve::measure::Fairness;
use faircurve::measure::fairness::jumps;
use faircurve_format::{Panel, Picture, SolvedGlyph, SplineChoice, png, svg};
use rayon::prelude::*;

use crate::args::{self, CompareArgs};
use crate::failure::Failure;
use crate::input;
use crate::measure::significant;
use crate::output::{Target, format_among, png_width};
use crate::progress::Progress;
use crate::report;
use crate::select::{self, Job, Selection};

/// Read, select, solve with each spline, draw one sheet, write, report.
pub(crate) fn run(args: &CompareArgs) -> Result<ExitCode, Failure> {
    let drawing = &args.drawing;
    let format = format_among(&["svg", "png"], args.format.as_deref(), &args.output)?;
    let width = png_width(args.width.as_deref())?;
    if width.is_some() && format != "png" {
        return Err(Failure::new(format!("--width has no use for {format}"))
            .hint("write --format png, or drop --width"));
    }
    let effort = args::effort(drawing.effort.as_deref(), drawing.no_loops)?;
    let splines = match &args.splines {
        Some(text) => splines(text)?,
        None => ENTRIES.iter().map(|info| Choice::new(info.name)).collect::<Result<_, _>>()?,
    };
    let target = Target::new(&args.output, &drawing.inputs)?;
    if format == "png" {
        target.check_png()?;
    }
    let mut panels = Vec::new();
    let (mut jobs, mut solved): (Vec<Job>, Vec<SolvedGlyph>) = Default::default();
    let progress = Progress::of("solving", splines.len(), "splines");
    let sources = input::read(&drawing.inputs, drawing.from.as_deref())?;
    for choice in &splines {
        let selection = Selection { spline: Some(&choice.choice), ..Selection::of(drawing) };
        let own = select::choose(sources.clone(), &selection)?;
        let glyphs: Result<Vec<SolvedGlyph>, Failure> = own
            .par_iter()
            .map(|job| Ok(SolvedGlyph::new(&job.name, &job.layer, job.solve(effort)?, None)))
            .collect();
        let glyphs: Vec<SolvedGlyph> = glyphs?;
        panels.push(panel(choice, &glyphs));
        for mut job in own {
            job.file = format!("{}: {}", choice.title, job.file);
            jobs.push(job);
        }
        solved.extend(glyphs);
        progress.step();
    }
    drop(progress);
    let picture = Picture::sheet(&panels);
    let bytes = match format {
        "png" => {
            let width = width.unwrap_or_else(|| png::default_width(&picture));
            png::write(&picture, width).map_err(|error| {
                Failure::new(error.to_string()).hint("give a smaller --width, or write SVG")
            })?
        }
        _ => svg::write(&picture).into_bytes(),
    };
    target.write(&bytes)?;
    Ok(report::report(&jobs, &solved, args.allow_relaxed))
}

/// A spline of --splines.
struct Choice {
    /// As given.
    title: String,
    choice: SplineChoice,
}

impl Choice {
    /// `NAME`, or `NAME:K=V:K=V`.
    fn new(text: &str) -> Result<Self, Failure> {
        let mut parts = text.split(':').map(str::trim);
        let name = parts.next().unwrap_or_default();
        let mut params = Params::new();
        catalog::find(name)?;
        for part in parts {
            let (key, value) = part.split_once('=').ok_or_else(|| {
                Failure::new(format!("--splines can't have `{text}`"))
                    .hint("write parameters as NAME:KEY=VALUE")
            })?;
            params.set(key.trim(), value.trim());
        }
        // Wrong even where there is no contour.
        let _: Box<dyn Spline> = catalog::build(name, &params)?;
        let title = text.trim().to_owned();
        Ok(Choice { title, choice: SplineChoice { name: name.to_owned(), params } })
    }
}

/// What --splines names: separated by commas outside of parentheses.
fn splines(text: &str) -> Result<Vec<Choice>, Failure> {
    let mut depth = 0i32;
    let outside = |c: char| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        c == ',' && depth <= 0
    };
    let names = text.split(outside).filter(|name| !name.trim().is_empty());
    let splines: Vec<Choice> = names.map(Choice::new).collect::<Result<_, _>>()?;
    if splines.is_empty() {
        return Err(Failure::new("--splines names none").hint("`faircurve list` has the names"));
    }
    Ok(splines)
}

/// A spline's curves and numbers.
fn panel(choice: &Choice, glyphs: &[SolvedGlyph]) -> Panel {
    let contours = || glyphs.iter().flat_map(|glyph| &glyph.contours);
    let fairness = contours()
        .map(|contour| Fairness::of(&contour.solution.curve))
        .fold(Fairness::default(), Fairness::and);
    let jump = contours()
        .flat_map(|contour| jumps(&contour.solution.curve))
        .flatten()
        .map(|jump| jump.dimensionless())
        // At corners curvature has nothing to be continuous with.
        .filter(|jump| jump[0].abs() < 1e-6)
        .fold(0.0f64, |most, jump| most.max(jump[1].abs()));
    let number = |x: f64| significant(x, 4).replace('-', "−");
    let row = |name: &str, value: String| (name.to_owned(), value);
    let relaxed = contours().map(|c| c.solution.report.relaxed.len()).sum::<usize>();
    Panel {
        title: choice.title.clone(),
        warning: match relaxed {
            0 => String::new(),
            1 => "relaxed in 1 place".to_owned(),
            places => format!("relaxed in {places} places"),
        },
        glyphs: glyphs.to_vec(),
        numbers: vec![
            row("length", number(fairness.length)),
            row("length · ∫κ²", number(fairness.scale_free_energy())),
            row("∫κ′²", number(fairness.variation_energy)),
            row("largest |κ|", number(fairness.largest_curvature)),
            row("largest |κ′|", number(fairness.largest_variation)),
            row("∫|κ|", number(fairness.turning)),
            row("extrema", fairness.extrema.to_string()),
            row("inflections", fairness.inflections.to_string()),
            row("κ jumps by", if jump < 1e-9 { "0".to_owned() } else { number(jump) }),
        ],
    }
}
