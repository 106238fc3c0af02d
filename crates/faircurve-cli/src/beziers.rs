//! What the command line says about Béziers, and what it reports of them.

use std::time::{Duration, Instant};

use faircurve::catalog::suggest;
use faircurve::convert::{Conversion, Cuts, Fit, Metric, Options, convert};
use faircurve_format::SolvedGlyph;

use crate::args::{self, SolveArgs};
use crate::failure::{Failure, note};
use crate::select::Job;

/// How curves become Béziers; the accuracy may depend on the glyph.
pub(crate) struct BezierOptions {
    accuracy: Option<f64>,
    /// All but the accuracy.
    options: Options,
}

impl BezierOptions {
    /// What the command line asks for.
    pub(crate) fn new(args: &SolveArgs) -> Result<Self, Failure> {
        let mut options = Options::new(0.0);
        if let Some(name) = &args.metric {
            options.metric =
                Metric::from_name(name).ok_or_else(|| unknown("metric", name, Metric::ALL))?;
        }
        if let Some(name) = &args.fit {
            options.fit = Fit::from_name(name).ok_or_else(|| unknown("fit", name, Fit::ALL))?;
        }
        for name in &args.cuts {
            match name.as_str() {
                "extrema" => options.at_extrema = true,
                "inflections" => options.at_inflections = true,
                _ => {
                    options.cuts = Cuts::from_name(name).ok_or_else(|| {
                        let names = Cuts::ALL.iter().map(|(_, known)| *known);
                        let names = names.chain(["extrema", "inflections"]);
                        Failure::new(format!("--cuts has no `{name}`")).hint(suggest(name, names))
                    })?;
                }
            }
        }
        options.span_knots = args.span_knots;
        options.free_joints = args.free_joints;
        Ok(BezierOptions { accuracy: accuracy(args)?, options })
    }

    /// Fills in the glyph's paths.
    pub(crate) fn convert(&self, glyph: &mut SolvedGlyph) -> Vec<Converted> {
        let accuracy = self.accuracy.unwrap_or(glyph.default_accuracy());
        let options = Options { accuracy, ..self.options.clone() };
        let convert = |contour: &mut faircurve_format::SolvedContour| {
            let start = Instant::now();
            let mut conversion = convert(&contour.solution.curve, &options);
            let time = start.elapsed();
            contour.path = std::mem::take(&mut conversion.path);
            Converted { conversion, time }
        };
        glyph.contours.iter_mut().map(convert).collect()
    }
}

fn unknown<T>(option: &str, name: &str, all: &'static [(T, &'static str)]) -> Failure {
    Failure::new(format!("--{option} has no `{name}`"))
        .hint(suggest(name, all.iter().map(|(_, known)| *known)))
}

fn accuracy(args: &SolveArgs) -> Result<Option<f64>, Failure> {
    let allowed = |units: &f64| *units > 0.0 && units.is_finite();
    let read = |text: &str| args::number("accuracy", text, "a number of units above 0", allowed);
    args.accuracy.as_deref().map(read).transpose()
}

/// A contour's conversion, its path moved elsewhere, and the time that it took.
pub(crate) struct Converted {
    conversion: Conversion,
    time: Duration,
}

/// `--report`: a line for each contour and one in all.
pub(crate) fn report(jobs: &[Job], converted: &[Vec<Converted>]) {
    let mut all = Converted { conversion: Conversion::default(), time: Duration::ZERO };
    let mut contours = 0;
    for (job, of_glyph) in jobs.iter().zip(converted) {
        for (index, one) in of_glyph.iter().enumerate() {
            note("beziers", &format!("{}: {}", job.place(index), one.words()));
            let sum = &mut all.conversion;
            sum.cubics += one.conversion.cubics;
            sum.lines += one.conversion.lines;
            sum.bound = sum.bound.max(one.conversion.bound);
            all.time += one.time;
            contours += 1;
        }
    }
    let noun = if contours == 1 { "contour" } else { "contours" };
    note("beziers", &format!("in all: {contours} {noun}, {}", all.words()));
}

impl Converted {
    fn words(&self) -> String {
        let Conversion { cubics, lines, bound, .. } = self.conversion;
        let counted = |n: usize, noun: &str| format!("{n} {noun}{}", if n == 1 { "" } else { "s" });
        let (cubics, lines) = (counted(cubics, "cubic"), counted(lines, "line"));
        let micros = self.time.as_secs_f64() * 1e6;
        format!("{cubics}, {lines}, off by at most {bound:.3e} units, {micros:.0} µs")
    }
}
