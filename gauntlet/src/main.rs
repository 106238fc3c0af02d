//! faircurve and libspiro side by side: see the README.

mod against_search;
mod all;
mod bezier;
mod bezier_fonts;
mod classes;
mod clock;
#[cfg(libspiro)]
mod ffi;
mod fonts;
mod fonts_input;
mod generate;
mod hostile;
mod hostile_inputs;
mod pictures;
mod progress;
mod report;
mod residual;
mod rivals;
mod search;
mod tangents;
mod time;
mod worse;
mod yardstick;

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use hostile_inputs::{FEW_KNOTS, Inputs};
use report::Report;

/// Runs faircurve and libspiro on the same contours.
#[derive(Debug, Parser)]
#[command(version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Also write the result as JSON
    #[arg(long, global = true, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Also write every contour named in the result into this folder, as documents
    #[arg(long, global = true, value_name = "FOLDER")]
    dump: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Everything, at modest size
    All {
        /// SFD files [default: those next to the repository, if they are there]
        files: Vec<PathBuf>,
    },
    /// How many contours of real fonts are solved
    Fonts {
        /// SFD files [default: those next to the repository]
        files: Vec<PathBuf>,
    },
    /// Directions at the knots against those of libspiro
    Tangents {
        /// SFD files [default: those next to the repository]
        files: Vec<PathBuf>,
    },
    /// Solve times, measured in turns in one process
    Time {
        /// SFD files [default: those next to the repository]
        files: Vec<PathBuf>,
        /// Rounds; the median counts
        #[arg(long, default_value_t = 21, value_parser = clap::value_parser!(u32).range(1..))]
        rounds: u32,
        /// Only the fonts, not the synthetic classes
        #[arg(long)]
        fonts_only: bool,
    },
    /// Synthetic classes, ordinary and hard
    Classes {
        /// Only classes whose name contains this
        #[arg(default_value = "")]
        filter: String,
        /// Contours in each class
        #[arg(long, default_value_t = 200)]
        cases: usize,
        /// The first of them
        #[arg(long, default_value_t = 0, value_name = "CASE")]
        from: usize,
    },
    /// Béziers against kurbo's fitters on six curves
    Bezier {
        /// Rounds of the times; the fastest counts
        #[arg(long, default_value_t = 40)]
        rounds: usize,
        /// Instead, this many random pairs of spirals, whose bounds must hold
        #[arg(long, value_name = "CASES")]
        random: Option<usize>,
        /// Other spirals for every number
        #[arg(long, default_value_t = 0)]
        seed: u64,
    },
    /// Béziers of whole fonts against libspiro's and kurbo's
    BezierFonts {
        /// SFD files [default: those next to the repository]
        files: Vec<PathBuf>,
        /// Also kurbo's slow fitter
        #[arg(long)]
        opt: bool,
    },
    /// Very many inputs that nobody would draw, through faircurve alone
    Hostile {
        /// Inputs in all
        #[arg(long, default_value_t = 1_000_000)]
        cases: usize,
        /// The first of them
        #[arg(long, default_value_t = 0, value_name = "CASE")]
        from: usize,
        /// Append the result to this file, a line of JSON, for `hostile-sum`
        #[arg(long, value_name = "FILE")]
        append: Option<PathBuf>,
        /// Other inputs for every number
        #[arg(long, default_value_t = 0)]
        seed: u64,
        /// The most knots of a contour; beyond 8, as many contours have 10 to 100 knots as 100 to 1000
        #[arg(long, default_value_t = FEW_KNOTS as u32, value_parser = clap::value_parser!(u32).range(1..=10_000))]
        knots: u32,
    },
    /// Adds up what runs of `hostile` have appended to a file
    HostileSum {
        /// The file
        file: PathBuf,
    },
    /// The best curves that exist, by minutes of search
    Search {
        /// SFD files or documents
        files: Vec<PathBuf>,
        /// The class of that name instead
        #[arg(long, conflicts_with = "files", required_unless_present = "files")]
        class: Option<String>,
        /// Of a class, so many contours
        #[arg(long, default_value_t = 20)]
        cases: usize,
        /// The first of them
        #[arg(long, default_value_t = 0, value_name = "CASE")]
        from: usize,
        /// Time for each contour
        #[arg(long, default_value_t = 60.0)]
        seconds: f64,
        /// Other random starts for every number
        #[arg(long, default_value_t = 0)]
        seed: u64,
        /// Where the best roots are kept [default: the repository's]
        #[arg(long, value_name = "FOLDER")]
        yardstick: Option<PathBuf>,
    },
    /// Draws hard contours, with captions
    Pictures {
        /// Where the pictures go
        folder: PathBuf,
        /// Contours of each class, of which the worst are drawn
        #[arg(long, default_value_t = 20)]
        cases: usize,
    },
    /// faircurve against the best curves that the search has found
    AgainstSearch {
        /// Only contours whose place contains this
        #[arg(default_value = "")]
        filter: String,
        /// Where the best roots are kept [default: the repository's]
        #[arg(long, value_name = "FOLDER")]
        yardstick: Option<PathBuf>,
    },
}

impl Command {
    /// Whether it says nothing about libspiro.
    fn is_alone(&self) -> bool {
        matches!(
            self,
            Command::Bezier { .. }
                | Command::Hostile { .. }
                | Command::HostileSum { .. }
                | Command::Pictures { .. }
                | Command::Search { .. }
                | Command::AgainstSearch { .. }
        )
    }
}

/// Why nothing came of it, and what to do.
#[derive(Debug)]
struct Failure {
    message: String,
    hint: String,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(&arguments).and_then(|report| deliver(&report, &arguments)) {
        Ok(code) => code,
        Err(Failure { message, hint }) => {
            let _ = writeln!(io::stderr(), "error: {message}\nhint: {hint}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &Arguments) -> Result<Report, Failure> {
    if !rivals::HAS_LIBSPIRO && !arguments.command.is_alone() {
        return Err(Failure {
            message: "this gauntlet was built without libspiro".to_owned(),
            hint: "install libspiro-dev and pkg-config, then build it again".to_owned(),
        });
    }
    match &arguments.command {
        Command::All { files } if files.is_empty() => {
            all::run(&fonts_input::read(&[]).unwrap_or_default())
        }
        Command::All { files } => all::run(&fonts_input::read(files)?),
        Command::Fonts { files } => fonts::run(&fonts_input::read(files)?),
        Command::Tangents { files } => tangents::run(&fonts_input::read(files)?),
        Command::Time { files, rounds, fonts_only } => {
            time::run(&fonts_input::read(files)?, *rounds as usize, !fonts_only)
        }
        Command::Classes { filter, cases, from } => {
            classes::run(filter, *from..from.saturating_add(*cases))
        }
        Command::Search { files, class, cases, from, seconds, seed, yardstick } => {
            let contours = match class {
                Some(class) => classes::contours(class, *from..from.saturating_add(*cases))?,
                None => {
                    fonts_input::read(files)?.into_iter().map(|c| (c.name(), c.contour)).collect()
                }
            };
            let folder = yardstick.clone().unwrap_or_else(yardstick::default_folder);
            search::run(&contours, *seconds, *seed, &folder)
        }
        Command::AgainstSearch { filter, yardstick } => {
            let folder = yardstick.clone().unwrap_or_else(yardstick::default_folder);
            against_search::run(&folder, filter, &fonts_input::read(&[]).unwrap_or_default())
        }
        Command::Bezier { random: Some(cases), seed, .. } => Ok(bezier::random(*cases, *seed)),
        Command::Bezier { rounds, .. } => Ok(bezier::run(*rounds)),
        Command::BezierFonts { files, opt } => bezier_fonts::run(&fonts_input::read(files)?, *opt),
        Command::Hostile { cases, from, append, seed, knots } => {
            let inputs = Inputs { seed: *seed, most_knots: *knots as usize };
            let (chunk, report) = hostile::run(*from..from.saturating_add(*cases), inputs)?;
            if let Some(file) = append {
                hostile::append(&chunk, file)?;
            }
            Ok(report)
        }
        Command::Pictures { folder, cases } => pictures::run(folder, *cases),
        Command::HostileSum { file } => hostile::sum(file),
    }
}

/// Prints the report and writes its files. Exit code 1: something happened that never must.
fn deliver(report: &Report, arguments: &Arguments) -> Result<ExitCode, Failure> {
    let version = rivals::libspiro_version().unwrap_or_default();
    let head = format!("faircurve {} against libspiro {version}\n\n", env!("CARGO_PKG_VERSION"));
    let alarms = report::list("ALARM", &report.alarms);
    // A closed pipe is the reader's choice, not a failure.
    let _ = io::stdout().write_all([head.as_str(), &report.text, &alarms].concat().as_bytes());
    if let Some(file) = &arguments.json {
        let text = format!("{:#}\n", report.json);
        std::fs::write(file, text).map_err(|error| Failure {
            message: format!("can't write {}: {error}", file.display()),
            hint: "name a file that can be written".to_owned(),
        })?;
    }
    if let Some(folder) = &arguments.dump {
        report.dump(folder)?;
    }
    Ok(if report.alarms.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The spline under test.
fn spiro() -> Result<Box<dyn faircurve::Spline>, Failure> {
    faircurve::catalog::spline("spiro")
        .map_err(|error| Failure { message: error.to_string(), hint: error.hint() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        Arguments::command().debug_assert();
    }
}
