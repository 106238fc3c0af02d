//! The command line.

use std::path::PathBuf;

use clap::error::{ContextKind, ErrorKind};
use clap::{Args, Parser, Subcommand};
use faircurve::Effort;

use crate::failure::Failure;

/// Fair curves through points.
#[derive(Debug, Parser)]
#[command(name = "faircurve", version, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Solve drawings and fonts: find the curves and write them.
    ///
    /// Exit codes: 0, all solved as asked; 3, written, but something could not be met and was
    /// relaxed (each named on stderr); 2, bad input, nothing written.
    Solve(SolveArgs),
    /// List the splines: parameters, joins, ends and claims; or what measuring says of them.
    List(ListArgs),
    /// Measure curves: lengths, energies, extrema, and what jumps at each knot.
    ///
    /// Exit codes as for `solve`.
    Measure(MeasureArgs),
    /// Draw the same knots with several splines on one sheet, with curvature combs and numbers.
    ///
    /// Exit codes as for `solve`.
    Compare(CompareArgs),
    /// Draw and edit in a browser on this machine, and save back to the file.
    ///
    /// Prints the editor's address and runs until it is stopped. Nothing but this machine can reach it, and
    /// only who has the printed address can read or save the file. No other file is read or written.
    Edit(EditArgs),
    /// Help or the version, as text to show.
    #[command(skip)]
    Shown(String),
}

#[derive(Debug, Args)]
pub(crate) struct SolveArgs {
    /// Drawings to solve; `-` is stdin. Several make one result.
    #[arg(value_name = "IN", required = true)]
    pub(crate) inputs: Vec<PathBuf>,

    /// Solve every contour with this spline, whatever the documents say; `faircurve list` has the
    /// names. Default: as the documents say, or `spiro`.
    #[arg(long, value_name = "NAME", help_heading = "Solving")]
    pub(crate) spline: Option<String>,

    /// Set a parameter of the spline: that of --spline, or else every one that the documents name.
    #[arg(long = "param", value_name = "K=V", help_heading = "Solving")]
    pub(crate) params: Vec<String>,

    /// How long to search where a contour is hard, before something is relaxed: 1 is at most about
    /// 50 ms a contour, 20 a second. Counts work, so that the result doesn't depend on the machine.
    /// Default: 1.
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true, help_heading = "Solving")]
    pub(crate) effort: Option<String>,

    /// Rather relax one knot or two than let the curve loop between two knots (by more than four
    /// times their distance). Otherwise what is asked comes first.
    #[arg(long, help_heading = "Solving")]
    pub(crate) no_loops: bool,

    /// Most that Béziers may deviate from the solved curves, in the drawing's units (for --metric
    /// sq-angle in their square root). Default: 1/10000 of the glyph's larger side.
    #[arg(long, value_name = "UNITS", allow_negative_numbers = true, help_heading = "Béziers")]
    pub(crate) accuracy: Option<String>,

    /// How the deviation of one Bézier is measured: `distance` (the largest, proved), `abs-angle`,
    /// `sq-angle` (directions, integrated along the curve). Default: distance.
    #[arg(long, value_name = "METRIC", help_heading = "Béziers")]
    pub(crate) metric: Option<String>,

    /// How one Bézier is fitted: `optimal`, `end-curvature` (curvature is kept at the ends, too),
    /// `equal-arms`, `arc-third` (the fastest). Default: optimal.
    #[arg(long, value_name = "FIT", help_heading = "Béziers")]
    pub(crate) fit: Option<String>,

    /// Where Béziers begin and end between knots: `greedy` (as far as each reaches),
    /// `equal-errors`, `balanced`, `halving`, `halving-bend`, and besides at `extrema`, at
    /// `inflections`. Default: greedy.
    #[arg(long, value_name = "CUTS", value_delimiter = ',', help_heading = "Béziers")]
    pub(crate) cuts: Vec<String>,

    /// Let a Bézier run through knots at which the curve is smooth. Else every knot is an end.
    #[arg(long, help_heading = "Béziers")]
    pub(crate) span_knots: bool,

    /// Let ends of Béziers leave the curve, within the accuracy, where that needs fewer. The path stays smooth.
    #[arg(long, help_heading = "Béziers")]
    pub(crate) free_joints: bool,

    /// Say on stderr, for each contour and in all, how many Béziers and lines there are, how far they are
    /// from the curve at most (a proved bound), and how long the conversion took.
    #[arg(long, help_heading = "Béziers")]
    pub(crate) report: bool,

    /// Format of the input: json, csv or sfd. Default: by the file's extension; json for stdin.
    #[arg(long, value_name = "KIND", help_heading = "Choosing")]
    pub(crate) from: Option<String>,

    /// Solve only the glyph of this name; may be given several times, and that order is kept.
    #[arg(long = "glyph", value_name = "NAME", help_heading = "Choosing")]
    pub(crate) glyphs: Vec<String>,

    /// Solve only this layer, such as `Fore`.
    #[arg(long, value_name = "NAME", help_heading = "Choosing")]
    pub(crate) layer: Option<String>,

    /// Where to write; `-` is stdout. The file appears whole or not at all.
    #[arg(short, long, value_name = "OUT", default_value = "-", help_heading = "Writing")]
    pub(crate) output: PathBuf,

    /// What to write: `json` (the solution in numbers), `svg` or `png` (a picture), `path` (SVG
    /// path data, y up, a line a glyph). Default: by the extension of OUT; json for stdout.
    #[arg(long, value_name = "FORMAT", help_heading = "Writing")]
    pub(crate) format: Option<String>,

    /// Show these in a picture too: `knots`, `comb` (the curvature comb).
    #[arg(long, value_name = "WHAT", value_delimiter = ',', help_heading = "Writing")]
    pub(crate) show: Vec<String>,

    /// Width of a PNG in pixels. Default: as wide as two million pixels allow.
    #[arg(long, value_name = "PIXELS", allow_negative_numbers = true, help_heading = "Writing")]
    pub(crate) width: Option<String>,

    /// Add N equal steps of arc length to every segment of the JSON: rows of s, x, y, direction,
    /// curvature.
    #[arg(long, value_name = "N", allow_negative_numbers = true, help_heading = "Writing")]
    pub(crate) samples: Option<String>,

    /// Exit with 0 though something was relaxed.
    #[arg(long)]
    pub(crate) allow_relaxed: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ListArgs {
    /// `text` or `json`.
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub(crate) format: String,

    /// Measure every spline against the properties of good splines, and print the table: takes
    /// some seconds.
    #[arg(long)]
    pub(crate) laws: bool,
}

/// What to work on: the same for every command but `solve`, which has its own.
#[derive(Debug, Args)]
pub(crate) struct DrawingArgs {
    /// Drawings to read; `-` is stdin.
    #[arg(value_name = "IN", required = true)]
    pub(crate) inputs: Vec<PathBuf>,

    /// How long to search where a contour is hard, before something is relaxed; see `solve`.
    /// Default: 1.
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true, help_heading = "Solving")]
    pub(crate) effort: Option<String>,

    /// Rather relax one knot or two than let the curve loop between two knots; see `solve`.
    #[arg(long, help_heading = "Solving")]
    pub(crate) no_loops: bool,

    /// Format of the input: json, csv or sfd. Default: by the file's extension; json for stdin.
    #[arg(long, value_name = "KIND", help_heading = "Choosing")]
    pub(crate) from: Option<String>,

    /// Take only the glyph of this name; may be given several times, and that order is kept.
    #[arg(long = "glyph", value_name = "NAME", help_heading = "Choosing")]
    pub(crate) glyphs: Vec<String>,

    /// Take only this layer, such as `Fore`.
    #[arg(long, value_name = "NAME", help_heading = "Choosing")]
    pub(crate) layer: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct MeasureArgs {
    #[command(flatten)]
    pub(crate) drawing: DrawingArgs,

    /// Solve every contour with this spline, whatever the documents say; `faircurve list` has the
    /// names. Default: as the documents say, or `spiro`.
    #[arg(long, value_name = "NAME", help_heading = "Solving")]
    pub(crate) spline: Option<String>,

    /// Set a parameter of the spline: that of --spline, or else every one that the documents name.
    #[arg(long = "param", value_name = "K=V", help_heading = "Solving")]
    pub(crate) params: Vec<String>,

    /// Where to write; `-` is stdout. The file appears whole or not at all.
    #[arg(short, long, value_name = "OUT", default_value = "-", help_heading = "Writing")]
    pub(crate) output: PathBuf,

    /// `text` or `json`. Default: json if OUT ends in .json, or else text.
    #[arg(long, value_name = "FORMAT", help_heading = "Writing")]
    pub(crate) format: Option<String>,

    /// Exit with 0 though something was relaxed.
    #[arg(long)]
    pub(crate) allow_relaxed: bool,
}

#[derive(Debug, Args)]
pub(crate) struct CompareArgs {
    #[command(flatten)]
    pub(crate) drawing: DrawingArgs,

    /// The splines, a panel each: names with commas between them, each with its parameters after
    /// colons, as in `euler,log-aesthetic:alpha=1.78:end=arc`. A comma in parentheses doesn't
    /// separate. Default: all of `faircurve list`.
    #[arg(long, value_name = "NAMES", help_heading = "Solving")]
    pub(crate) splines: Option<String>,

    /// Where to write; `-` is stdout. The file appears whole or not at all.
    #[arg(short, long, value_name = "OUT", default_value = "-", help_heading = "Writing")]
    pub(crate) output: PathBuf,

    /// `svg` or `png`. Default: by the extension of OUT; svg for stdout.
    #[arg(long, value_name = "FORMAT", help_heading = "Writing")]
    pub(crate) format: Option<String>,

    /// Width of a PNG in pixels. Default: as wide as two million pixels allow.
    #[arg(long, value_name = "PIXELS", allow_negative_numbers = true, help_heading = "Writing")]
    pub(crate) width: Option<String>,

    /// Exit with 0 though something was relaxed.
    #[arg(long)]
    pub(crate) allow_relaxed: bool,
}

#[derive(Debug, Args)]
pub(crate) struct EditArgs {
    /// The drawing to open and save back to; one that isn't there yet is made by the first save. Formats
    /// that can't be written are opened, too. Default: an empty drawing, kept by the browser.
    #[arg(value_name = "FILE")]
    pub(crate) file: Option<PathBuf>,

    /// The port to listen on, on loopback. Default: any that is free.
    #[arg(long, value_name = "PORT", default_value_t = 0, hide_default_value = true)]
    pub(crate) port: u16,

    /// The folder with the editor's page, as `cargo xtask editor` builds it. Default: where it is installed.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) site: Option<PathBuf>,

    /// Only print the address; don't open a browser.
    #[arg(long)]
    pub(crate) no_browser: bool,
}

/// How far to search, as given with --effort and --no-loops.
pub(crate) fn effort(text: Option<&str>, no_loops: bool) -> Result<Effort, Failure> {
    let allowed = |factor: &f64| *factor >= 0.0 && factor.is_finite();
    let read = |text: &str| number("effort", text, "a number from 0", allowed);
    let effort = text.map(read).transpose()?.map_or_else(Effort::default, Effort::times);
    Ok(if no_loops { effort.avoiding_loops() } else { effort })
}

/// Reads the command line.
pub(crate) fn parse() -> Result<Command, Failure> {
    match Cli::try_parse() {
        Ok(cli) => Ok(cli.command),
        Err(error) => match error.kind() {
            ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
                Ok(Command::Shown(error.render().ansi().to_string()))
            }
            ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => Err(Failure::new(
                "there is no command",
            )
            .hint("try `faircurve solve drawing.json -o drawing.svg`, or `faircurve --help`")),
            _ => Err(usage(&error)),
        },
    }
}

/// clap's message in the words of our own.
fn usage(error: &clap::Error) -> Failure {
    let text = error.render().to_string();
    let paragraph = text.split("\n\n").next().unwrap_or_default();
    let message = paragraph.strip_prefix("error: ").unwrap_or(paragraph).replace('\'', "`");
    let near =
        [ContextKind::SuggestedArg, ContextKind::SuggestedSubcommand, ContextKind::SuggestedValue];
    let hint = match near.iter().find_map(|kind| error.get(*kind)) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "see `faircurve --help` and `faircurve solve --help`".to_owned(),
    };
    Failure::new(message).hint(hint)
}

/// A number given on the command line, in a range.
pub(crate) fn number<T>(
    option: &str,
    text: &str,
    expected: &str,
    allowed: impl Fn(&T) -> bool,
) -> Result<T, Failure>
where
    T: std::str::FromStr,
{
    text.parse().ok().filter(allowed).ok_or_else(|| {
        Failure::new(format!("--{option} can't be `{text}`")).hint(format!("it takes {expected}"))
    })
}
