//! Formatting and writing, whole or not at all.

use std::fs::{self, File};
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

use faircurve::catalog::suggest;
use faircurve_format::{Picture, Show, SolvedGlyph, path, png, solution_json, svg};

use crate::args::{self, SolveArgs};
use crate::failure::Failure;
use crate::input::is_stdio;

/// A format that solutions are written in: one row of the [table](FORMATS).
#[derive(Debug)]
struct Format {
    /// The name used on the command line, and the extension of such files.
    name: &'static str,
    /// Whether it is a picture, which --show is for.
    is_picture: bool,
    write: fn(&[SolvedGlyph], &Options) -> Result<Vec<u8>, Failure>,
}

const FORMATS: &[Format] = &[
    Format {
        name: "json",
        is_picture: false,
        write: |glyphs, options| Ok(solution_json::write(glyphs, options.samples).into_bytes()),
    },
    Format {
        name: "svg",
        is_picture: true,
        write: |glyphs, options| Ok(svg::write(&Picture::new(glyphs, options.show)).into_bytes()),
    },
    Format {
        name: "png",
        is_picture: true,
        write: |glyphs, options| {
            let picture = Picture::new(glyphs, options.show);
            let width = options.width.unwrap_or_else(|| png::default_width(&picture));
            png::write(&picture, width).map_err(|error| {
                Failure::new(error.to_string())
                    .hint("give a smaller --width, pick some glyphs with --glyph, or write SVG")
            })
        },
    },
    Format {
        name: "path",
        is_picture: false,
        write: |glyphs, _| Ok(path::write(glyphs).into_bytes()),
    },
];

/// What the formats need to know.
#[derive(Debug)]
struct Options {
    show: Show,
    samples: Option<usize>,
    width: Option<u32>,
}

/// Where to write.
#[derive(Debug)]
pub(crate) struct Target(Option<PathBuf>);

impl Target {
    /// The file, or stdout for `-`; refuses what could not be written before any work is done.
    pub(crate) fn new(output: &Path, inputs: &[PathBuf]) -> Result<Self, Failure> {
        if is_stdio(output) {
            return Ok(Target(None));
        }
        check_target(output, inputs)?;
        Ok(Target(Some(output.to_owned())))
    }

    /// Refuses binary data on a terminal.
    pub(crate) fn check_png(&self) -> Result<(), Failure> {
        if self.0.is_none() && io::stdout().is_terminal() {
            return Err(Failure::new("a terminal can't show PNG")
                .hint("write it to a file: -o drawing.png"));
        }
        Ok(())
    }

    /// Puts the whole file where it belongs.
    pub(crate) fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        match &self.0 {
            None => to_stdout(bytes),
            Some(path) => to_file(path, bytes).map_err(|error| {
                Failure::new(unwritable(&error)).within(&path.display().to_string())
            }),
        }
    }
}

/// The width given for a PNG, in pixels.
pub(crate) fn png_width(text: Option<&str>) -> Result<Option<u32>, Failure> {
    let expected = format!("a whole number from 1 to {}", png::LARGEST_SIDE);
    let read = |text: &str| {
        args::number("width", text, &expected, |n| (1..=png::LARGEST_SIDE).contains(n))
    };
    text.map(read).transpose()
}

/// The format that is asked for, or that the name of the output ends in, or else the first of those
/// that there are.
pub(crate) fn format_among(
    names: &[&'static str],
    asked: Option<&str>,
    output: &Path,
) -> Result<&'static str, Failure> {
    let find = |name: &str| names.iter().find(|known| **known == name).copied();
    if let Some(asked) = asked {
        return find(asked).ok_or_else(|| {
            Failure::new(format!("there is no output format `{asked}`"))
                .hint(suggest(asked, names.iter().copied()))
        });
    }
    let extension = output.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    find(&extension).or(is_stdio(output).then_some(names[0])).ok_or_else(|| {
        let endings: Vec<String> = names.iter().map(|name| format!(".{name}")).collect();
        Failure::new("the name doesn't tell the format to write")
            .hint(format!("end it in {}, or add --format", endings.join(" or ")))
            .within(&output.display().to_string())
    })
}

/// Where to write what.
#[derive(Debug)]
pub(crate) struct Output {
    format: &'static Format,
    options: Options,
    target: Target,
}

impl Output {
    /// What the command line asks for; refuses what could not be written before any work is done.
    pub(crate) fn new(args: &SolveArgs) -> Result<Self, Failure> {
        let file = (!is_stdio(&args.output)).then_some(&*args.output);
        let format = format_of(args, file)?;
        let options = options(args, format)?;
        let target = Target::new(&args.output, &args.inputs)?;
        if format.name == "png" {
            target.check_png()?;
        }
        Ok(Output { format, options, target })
    }

    /// The whole file.
    pub(crate) fn format(&self, glyphs: &[SolvedGlyph]) -> Result<Vec<u8>, Failure> {
        (self.format.write)(glyphs, &self.options)
    }

    /// Puts the whole file where it belongs.
    pub(crate) fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        self.target.write(bytes)
    }
}

fn format_of(args: &SolveArgs, target: Option<&Path>) -> Result<&'static Format, Failure> {
    let names = || FORMATS.iter().map(|format| format.name);
    let find = |name: &str| FORMATS.iter().find(|format| format.name == name);
    if let Some(asked) = &args.format {
        return find(asked).ok_or_else(|| {
            Failure::new(format!("there is no output format `{asked}`"))
                .hint(suggest(asked, names()))
        });
    }
    let Some(path) = target else {
        return Ok(&FORMATS[0]);
    };
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    find(&extension).ok_or_else(|| {
        Failure::new("the name doesn't tell the format to write")
            .hint("end it in .json, .svg, .png or .path, or add --format".to_owned())
            .within(&path.display().to_string())
    })
}

fn options(args: &SolveArgs, format: &Format) -> Result<Options, Failure> {
    let mut show = Show::default();
    for what in &args.show {
        match what.as_str() {
            "knots" => show.knots = true,
            "comb" => show.comb = true,
            other => {
                return Err(Failure::new(format!("--show has no `{other}`"))
                    .hint(suggest(other, ["knots", "comb"])));
            }
        }
    }
    let unused = |option: &str, wanted: &str| {
        Failure::new(format!("--{option} has no use for {}", format.name))
            .hint(format!("write {wanted}, or drop --{option}"))
    };
    if show.any() && !format.is_picture {
        return Err(unused("show", "a picture (--format svg or png)"));
    }
    if args.samples.is_some() && format.name != "json" {
        return Err(unused("samples", "--format json"));
    }
    if args.width.is_some() && format.name != "png" {
        return Err(unused("width", "--format png"));
    }
    let samples = |text: &str| {
        args::number("samples", text, "a whole number from 1 to 100000", |n| {
            (1..=100_000).contains(n)
        })
    };
    Ok(Options {
        show,
        samples: args.samples.as_deref().map(samples).transpose()?,
        width: png_width(args.width.as_deref())?,
    })
}

fn check_target(path: &Path, inputs: &[PathBuf]) -> Result<(), Failure> {
    let failure = |message: &str, hint: &str| {
        Err(Failure::new(message).hint(hint).within(&path.display().to_string()))
    };
    if path.is_dir() {
        return failure("this is a folder, not a file", "name a file in it");
    }
    if !folder_of(path).is_dir() {
        return failure("there is no such folder to write to", "make it first, or check the name");
    }
    let same = |input: &PathBuf| match (fs::canonicalize(input), fs::canonicalize(path)) {
        (Ok(input), Ok(output)) => input == output,
        _ => false,
    };
    if inputs.iter().any(same) {
        return failure("the result would overwrite its own input", "write to another file");
    }
    Ok(())
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// Writes everything to stdout. A reader that has seen enough and gone away is no failure.
pub(crate) fn to_stdout(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = anstream::AutoStream::auto(io::stdout().lock());
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::new(unwritable(&error)).within("stdout"))
        }
        _ => Ok(()),
    }
}

/// Writes beside the target and renames, so that the file is there whole or as it was.
pub(crate) fn to_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // A link stays a link: what it points to is written.
    let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let existing = fs::metadata(&path).ok();
    if existing.as_ref().is_some_and(|found| !found.is_file()) {
        // A device or a pipe can't be replaced.
        return File::options().write(true).open(&path)?.write_all(bytes);
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".faircurve-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As any program would create it: the umask takes its part.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder_of(&path))?;
    if let Some(existing) = existing {
        file.as_file().set_permissions(existing.permissions())?;
    }
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(&path)?;
    Ok(())
}

fn unwritable(error: &io::Error) -> String {
    format!("the result can't be written: {error}")
}
