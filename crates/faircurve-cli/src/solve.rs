//! `faircurve solve`.

use std::process::ExitCode;

use faircurve::Effort;
use faircurve_format::SolvedGlyph;
use rayon::prelude::*;

use crate::args::{self, SolveArgs};
use crate::beziers::{self, BezierOptions, Converted};
use crate::failure::Failure;
use crate::input;
use crate::output::Output;
use crate::progress::Progress;
use crate::report;
use crate::select::{self, Job};

/// Read, select, solve, format, write, report.
pub(crate) fn run(args: &SolveArgs) -> Result<ExitCode, Failure> {
    let output = Output::new(args)?;
    let (beziers, effort) =
        (BezierOptions::new(args)?, args::effort(args.effort.as_deref(), args.no_loops)?);
    let sources = input::read(&args.inputs, args.from.as_deref())?;
    let jobs = select::select(sources, args)?;
    let (solved, converted) = solve(&jobs, &beziers, effort)?;
    let bytes = output.format(&solved)?;
    output.write(&bytes)?;
    if args.report {
        beziers::report(&jobs, &converted);
    }
    Ok(report::report(&jobs, &solved, args.allow_relaxed))
}

/// Solves every glyph, over all cores. The first input that is at fault fails the whole.
fn solve(
    jobs: &[Job],
    beziers: &BezierOptions,
    effort: Effort,
) -> Result<(Vec<SolvedGlyph>, Vec<Vec<Converted>>), Failure> {
    let progress = Progress::new(jobs.len());
    let solve = |job: &Job| {
        let glyph = solve_glyph(job, beziers, effort);
        progress.step();
        glyph
    };
    let solved: Vec<Result<_, Failure>> = jobs.par_iter().map(solve).collect();
    solved.into_iter().collect()
}

fn solve_glyph(
    job: &Job,
    beziers: &BezierOptions,
    effort: Effort,
) -> Result<(SolvedGlyph, Vec<Converted>), Failure> {
    let mut glyph = SolvedGlyph::unconverted(&job.name, &job.layer, job.solve(effort)?);
    let converted = beziers.convert(&mut glyph);
    Ok((glyph, converted))
}
