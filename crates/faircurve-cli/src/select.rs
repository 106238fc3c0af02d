//! Choosing what to solve, and with which spline.

use std::collections::BTreeSet;

use faircurve::catalog::{self, Params, suggest};
use faircurve::{Contour, Effort, Solution, Spline};
use faircurve_format::SplineChoice;

use crate::args::{DrawingArgs, MeasureArgs, SolveArgs};
use crate::failure::Failure;
use crate::input::Source;

/// One layer of one glyph, to be solved.
#[derive(Debug)]
pub(crate) struct Job {
    /// The name of the file that it is from.
    pub(crate) file: String,
    pub(crate) name: String,
    pub(crate) layer: String,
    pub(crate) contours: Vec<(Contour, Box<dyn Spline>)>,
}

impl Job {
    /// Words that name one of its contours in messages.
    pub(crate) fn place(&self, contour: usize) -> String {
        let named = |what: &str, name: &str| match name {
            "" => String::new(),
            name => format!("{what} `{name}`, "),
        };
        let (glyph, layer) = (named("glyph", &self.name), named("layer", &self.layer));
        format!("{}: {glyph}{layer}contour {contour}", self.file)
    }
}

impl Job {
    /// Solves every contour, each with its spline's name. The first that is at fault fails the whole.
    pub(crate) fn solve(&self, effort: Effort) -> Result<Vec<(String, Solution)>, Failure> {
        let solve = |(index, (contour, spline)): (usize, &(Contour, Box<dyn Spline>))| {
            let solution = faircurve::solve_with(contour, &**spline, effort).map_err(|error| {
                Failure::new(error.to_string()).hint(error.hint()).within(&self.place(index))
            })?;
            Ok((spline.name().to_owned(), solution))
        };
        self.contours.iter().enumerate().map(solve).collect()
    }
}

/// What a command line says about what to solve, and how.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Selection<'a> {
    pub(crate) glyphs: &'a [String],
    pub(crate) layer: Option<&'a str>,
    /// The spline for every contour, whatever the documents say.
    pub(crate) spline: Option<&'a SplineChoice>,
    pub(crate) params: &'a [String],
}

/// The glyphs and layers that the command line picks, in its order, or else the documents'; each
/// contour with its spline.
pub(crate) fn select(sources: Vec<Source>, args: &SolveArgs) -> Result<Vec<Job>, Failure> {
    let spline = args.spline.clone().map(SplineChoice::new);
    let (glyphs, layer) = (&args.glyphs, args.layer.as_deref());
    choose(sources, &Selection { glyphs, layer, spline: spline.as_ref(), params: &args.params })
}

/// The same for `faircurve measure`.
pub(crate) fn to_measure(sources: Vec<Source>, args: &MeasureArgs) -> Result<Vec<Job>, Failure> {
    let spline = args.spline.clone().map(SplineChoice::new);
    let params = &args.params;
    choose(sources, &Selection { spline: spline.as_ref(), params, ..Selection::of(&args.drawing) })
}

impl<'a> Selection<'a> {
    pub(crate) fn of(args: &'a DrawingArgs) -> Self {
        let (glyphs, layer) = (&args.glyphs, args.layer.as_deref());
        Selection { glyphs, layer, spline: None, params: &[] }
    }
}

/// What a selection picks.
pub(crate) fn choose(sources: Vec<Source>, args: &Selection<'_>) -> Result<Vec<Job>, Failure> {
    let overrides = Overrides::new(args)?;
    check_names(&sources, args)?;
    let mut jobs = Vec::new();
    for Source { name: file, document } in sources {
        let default = document.spline;
        for glyph in document.glyphs {
            if !picked(args, &glyph.name, &glyph.layer) {
                continue;
            }
            let mut job = Job {
                file: file.clone(),
                name: glyph.name,
                layer: glyph.layer,
                contours: Vec::with_capacity(glyph.contours.len()),
            };
            for contour in glyph.contours {
                let spline = overrides.build(contour.spline.as_ref().unwrap_or(&default))?;
                job.contours.push((contour.contour, spline));
            }
            jobs.push(job);
        }
    }
    jobs.sort_by_key(|job| args.glyphs.iter().position(|name| *name == job.name));
    Ok(jobs)
}

fn picked(args: &Selection<'_>, glyph: &str, layer: &str) -> bool {
    (args.glyphs.is_empty() || args.glyphs.iter().any(|name| name == glyph))
        && args.layer.is_none_or(|name| name == layer)
}

/// Every glyph asked for must be there, and so must the layer; and some glyph must have it.
fn check_names(sources: &[Source], args: &Selection<'_>) -> Result<(), Failure> {
    let glyphs = || sources.iter().flat_map(|source| &source.document.glyphs);
    let names: BTreeSet<&str> = glyphs().map(|glyph| glyph.name.as_str()).collect();
    if let Some(asked) = args.glyphs.iter().find(|name| !names.contains(name.as_str())) {
        return Err(unknown("glyph", asked, &names));
    }
    let Some(asked) = args.layer else {
        return Ok(());
    };
    let layers: BTreeSet<&str> = glyphs().map(|glyph| glyph.layer.as_str()).collect();
    if !layers.contains(asked) {
        return Err(unknown("layer", asked, &layers));
    }
    for glyph in args.glyphs {
        let own: BTreeSet<&str> =
            glyphs().filter(|g| g.name == *glyph).map(|g| g.layer.as_str()).collect();
        if !own.contains(asked) {
            return Err(unknown(&format!("contour of glyph `{glyph}` in layer"), asked, &own));
        }
    }
    Ok(())
}

fn unknown(what: &str, asked: &str, known: &BTreeSet<&str>) -> Failure {
    /// More names than this would hide the message.
    const MOST: usize = 12;
    let message = format!("there is no {what} `{asked}`");
    let named: Vec<&str> = known.iter().copied().filter(|name| !name.is_empty()).collect();
    if named.is_empty() {
        let option = if what == "glyph" { "--glyph" } else { "--layer" };
        return Failure::new(message).hint(format!("nothing here has such a name: drop {option}"));
    }
    let hint = suggest(asked, named.iter().copied());
    let hint = match hint.starts_with("use") && named.len() > MOST {
        true => {
            format!("there are {} names, such as `{}`", named.len(), named[..MOST].join("`, `"))
        }
        false => hint,
    };
    Failure::new(message).hint(hint)
}

/// What the command line says about splines.
#[derive(Debug)]
struct Overrides {
    spline: Option<SplineChoice>,
    params: Params,
}

impl Overrides {
    fn new(args: &Selection<'_>) -> Result<Self, Failure> {
        let mut params = Params::new();
        for text in args.params {
            let (name, value) = text.split_once('=').ok_or_else(|| {
                Failure::new(format!("--param can't be `{text}`")).hint("write it as NAME=VALUE")
            })?;
            params.set(name.trim(), value.trim());
        }
        let overrides = Overrides { spline: args.spline.cloned(), params };
        if let Some(choice) = &overrides.spline {
            // Wrong even where there is no contour.
            overrides.build(choice)?;
        }
        Ok(overrides)
    }

    fn build(&self, given: &SplineChoice) -> Result<Box<dyn Spline>, Failure> {
        let chosen = self.spline.as_ref().unwrap_or(given);
        let mut params = chosen.params.clone();
        for (name, value) in self.params.iter() {
            params.set(name, value.clone());
        }
        Ok(catalog::build(&chosen.name, &params)?)
    }
}
