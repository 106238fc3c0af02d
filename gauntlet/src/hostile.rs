//! Very many inputs that nobody would draw, through faircurve alone: what must never happen, doesn't.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use faircurve::{InputError, Spline, catalog};
use faircurve_format::{Document, SplineChoice};
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::Failure;
use crate::clock::Clock;
use crate::hostile_inputs::{DISTRIBUTIONS, FEW_KNOTS, Input, Inputs, SPLINES};
use crate::progress::Progress;
use crate::report::{Report, percent, table, tiny};
use crate::rivals::Ours;

/// What a solve may take, in seconds: 50 ms beyond the plain solve, which takes microseconds with few
/// knots.
const LIMIT: f64 = 0.05;

/// What it may take for each further knot: each round of relaxing makes a plain solve, whatever has been
/// spent.
const LIMIT_A_KNOT: f64 = 2e-4;

/// Times the limit, in wall time, from which a solve is timed again, alone: a busy machine may have
/// interrupted it.
const SUSPICIOUS: f64 = 5.0;

/// The limit for so many knots.
fn limit(knots: usize) -> f64 {
    LIMIT + LIMIT_A_KNOT * knots.saturating_sub(FEW_KNOTS) as f64
}

/// Cases that a thread takes at a time.
const CHUNK: usize = 256;

/// The most offenders of one kind that are kept and named, the first ones.
const MOST_NAMED: usize = 20;

/// What must never happen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Offence {
    Panic,
    NotFinite,
    /// Called solved, and isn't.
    False,
    /// Relaxed, and what is said to hold instead doesn't.
    Misreported,
    OverTime,
}

impl Offence {
    fn name(self) -> &'static str {
        match self {
            Offence::Panic => "panic",
            Offence::NotFinite => "not finite",
            Offence::False => "false",
            Offence::Misreported => "misreported",
            Offence::OverTime => "over time",
        }
    }
}

/// The counts of one distribution.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Tally {
    cases: usize,
    solved: usize,
    relaxed: usize,
    /// By the kind of the error.
    refused: BTreeMap<String, usize>,
    /// Called solved, and isn't.
    falsehoods: usize,
    /// Relaxed, and what is said to hold instead doesn't.
    misreported: usize,
    not_finite: usize,
    panics: usize,
    over_time: usize,
    /// Recomputed, over what is called solved and is.
    largest_residual: f64,
    /// Wall time beside other work, of all solves and of the slowest.
    seconds: f64,
    slowest_seconds: f64,
    slowest_case: usize,
}

impl Tally {
    fn add(&mut self, other: &Tally) {
        self.cases += other.cases;
        self.solved += other.solved;
        self.relaxed += other.relaxed;
        for (kind, count) in &other.refused {
            *self.refused.entry(kind.clone()).or_default() += count;
        }
        self.falsehoods += other.falsehoods;
        self.misreported += other.misreported;
        self.not_finite += other.not_finite;
        self.panics += other.panics;
        self.over_time += other.over_time;
        self.largest_residual = self.largest_residual.max(other.largest_residual);
        self.seconds += other.seconds;
        if other.slowest_seconds > self.slowest_seconds {
            self.slowest_seconds = other.slowest_seconds;
            self.slowest_case = other.slowest_case;
        }
    }

    fn refused_in_all(&self) -> usize {
        self.refused.values().sum()
    }
}

/// What some cases came to.
#[derive(Debug, Default)]
struct Outcome {
    /// One for each distribution.
    tallies: Vec<Tally>,
    /// Of each kind, the case and what happened.
    offences: Vec<(Offence, usize, String)>,
    /// Cases to be timed again.
    suspicious: Vec<usize>,
}

/// The splines of the catalogue, by name.
type Splines = BTreeMap<&'static str, Box<dyn Spline>>;

/// What a run over a range of cases came to: a line of the file that [`append`] writes and [`sum`]
/// reads.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Chunk {
    seed: u64,
    #[serde(default = "few_knots")]
    most_knots: usize,
    cases: Range<usize>,
    /// By the distribution's name.
    distributions: BTreeMap<String, Tally>,
    alarms: Vec<String>,
}

/// What lines without it have.
fn few_knots() -> usize {
    FEW_KNOTS
}

/// Runs a range of inputs on all cores. The counts depend on the range and the inputs alone; times on
/// the machine.
pub(crate) fn run(cases: Range<usize>, inputs: Inputs) -> Result<(Chunk, Report), Failure> {
    let splines: Splines = SPLINES
        .iter()
        .map(|name| Ok((*name, catalog::spline(name)?)))
        .collect::<Result<_, catalog::CatalogError>>()
        .map_err(|error| Failure { message: error.to_string(), hint: error.hint() })?;
    let mut outcome = without_panic_messages(|| on_all_cores(cases.clone(), inputs, &splines));
    for case in std::mem::take(&mut outcome.suspicious) {
        let input = input(inputs, case).0;
        let seconds = timed_alone(&input, &splines);
        if seconds > limit(input.contour.knots.len()) {
            outcome.tallies[case % DISTRIBUTIONS.len()].over_time += 1;
            outcome.offences.push((Offence::OverTime, case, format!("{:.0} ms", 1e3 * seconds)));
        }
    }
    outcome.offences.sort();
    let (alarms, notable) = named(inputs, &outcome);
    let names = DISTRIBUTIONS.iter().map(|distribution| distribution.name.to_owned());
    let distributions = names.zip(outcome.tallies).collect();
    let Inputs { seed, most_knots } = inputs;
    let chunk = Chunk { seed, most_knots, cases, distributions, alarms };
    let report = Report { notable, ..report(&[&chunk]) };
    Ok((chunk, report))
}

/// Appends a line to a file.
///
/// # Errors
/// If it can't be written.
pub(crate) fn append(chunk: &Chunk, file: &Path) -> Result<(), Failure> {
    let write = || {
        let line = format!("{}\n", serde_json::to_string(chunk)?);
        let mut file = std::fs::OpenOptions::new().create(true).append(true).open(file)?;
        file.write_all(line.as_bytes())
    };
    write().map_err(|error: std::io::Error| Failure {
        message: format!("can't write {}: {error}", file.display()),
        hint: "name a file that can be written".to_owned(),
    })
}

/// Adds up what [`append`] has written: ranges of one seed that don't overlap.
///
/// # Errors
/// If the file can't be read, or the ranges can't be added up.
pub(crate) fn sum(file: &Path) -> Result<Report, Failure> {
    let failure = |what: String| Failure {
        message: format!("{}: {what}", file.display()),
        hint: "name a file that `gauntlet hostile --append` has written".to_owned(),
    };
    let text = std::fs::read_to_string(file).map_err(|error| failure(error.to_string()))?;
    let chunks = chunks(&text).map_err(failure)?;
    Ok(report(&chunks.iter().collect::<Vec<_>>()))
}

/// The lines of a file, in the order of their cases; or why they can't be added up.
fn chunks(text: &str) -> Result<Vec<Chunk>, String> {
    let chunk =
        |(i, line)| serde_json::from_str(line).map_err(|error| format!("line {}: {error}", i + 1));
    let mut chunks: Vec<Chunk> = text.lines().enumerate().map(chunk).collect::<Result<_, _>>()?;
    chunks.sort_by_key(|chunk| chunk.cases.start);
    for pair in chunks.windows(2) {
        if pair[0].seed != pair[1].seed {
            return Err(format!("seeds {} and {} are mixed", pair[0].seed, pair[1].seed));
        }
        if pair[0].most_knots != pair[1].most_knots {
            return Err("runs with other numbers of knots are mixed".to_owned());
        }
        if pair[1].cases.start < pair[0].cases.end {
            return Err(format!("case {} is there twice", pair[1].cases.start));
        }
    }
    if chunks.is_empty() { Err("nothing in it".to_owned()) } else { Ok(chunks) }
}

/// The input of a case and its distribution's name.
fn input(inputs: Inputs, case: usize) -> (Input, &'static str) {
    let distribution = &DISTRIBUTIONS[case % DISTRIBUTIONS.len()];
    (distribution.input(inputs, case), distribution.name)
}

/// Panics are counted, not printed.
fn without_panic_messages<T>(work: impl FnOnce() -> T) -> T {
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let result = work();
    std::panic::set_hook(hook);
    result
}

fn on_all_cores(cases: Range<usize>, inputs: Inputs, splines: &Splines) -> Outcome {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let next = AtomicUsize::new(0);
    let chunks = cases.len().div_ceil(CHUNK);
    let progress = Mutex::new(Progress::new(chunks));
    let work = || {
        let mut outcome =
            Outcome { tallies: vec![Tally::default(); DISTRIBUTIONS.len()], ..Outcome::default() };
        loop {
            let chunk = next.fetch_add(1, Ordering::Relaxed);
            if chunk >= chunks {
                return outcome;
            }
            let start = cases.start + chunk * CHUNK;
            for case in start..(start + CHUNK).min(cases.end) {
                try_case(inputs, case, splines, &mut outcome);
            }
            if let Ok(mut progress) = progress.lock() {
                progress.step("chunks");
            }
        }
    };
    let outcomes: Vec<Outcome> = std::thread::scope(|scope| {
        let handles: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        handles.into_iter().filter_map(|handle| handle.join().ok()).collect()
    });
    if let Ok(progress) = progress.lock() {
        progress.done();
    }
    let mut whole =
        Outcome { tallies: vec![Tally::default(); DISTRIBUTIONS.len()], ..Outcome::default() };
    for outcome in outcomes {
        for (tally, part) in whole.tallies.iter_mut().zip(&outcome.tallies) {
            tally.add(part);
        }
        whole.offences.extend(outcome.offences);
        whole.suspicious.extend(outcome.suspicious);
    }
    whole.suspicious.sort_unstable();
    whole
}

/// Solves and judges one case.
fn try_case(inputs: Inputs, case: usize, splines: &Splines, outcome: &mut Outcome) {
    let Input { contour, spline } = input(inputs, case).0;
    let spline = &*splines[spline];
    let tally = &mut outcome.tallies[case % DISTRIBUTIONS.len()];
    let mut offend = |offence, what| outcome.offences.push((offence, case, what));
    tally.cases += 1;
    let clock = Instant::now();
    let solved = catch_unwind(AssertUnwindSafe(|| faircurve::solve(&contour, spline)));
    let seconds = clock.elapsed().as_secs_f64();
    tally.seconds += seconds;
    if seconds > tally.slowest_seconds {
        (tally.slowest_seconds, tally.slowest_case) = (seconds, case);
    }
    if seconds > SUSPICIOUS * limit(contour.knots.len()) {
        outcome.suspicious.push(case);
    }
    let solution = match solved {
        Ok(Ok(solution)) => solution,
        Ok(Err(error)) => {
            *tally.refused.entry(kind(&error).to_owned()).or_default() += 1;
            return;
        }
        Err(_) => {
            tally.panics += 1;
            return offend(Offence::Panic, "solve panics".to_owned());
        }
    };
    let judged = catch_unwind(AssertUnwindSafe(|| {
        let ours = Ours::judge(&contour, spline, solution);
        let (is_finite, falsehood) = (ours.is_finite(), ours.falsehood(&contour));
        (ours, is_finite, falsehood)
    }));
    let Ok((ours, is_finite, falsehood)) = judged else {
        tally.panics += 1;
        return offend(Offence::Panic, "a query of the curve panics".to_owned());
    };
    if ours.is_solved() {
        tally.solved += 1;
    } else {
        tally.relaxed += 1;
    }
    if !is_finite {
        tally.not_finite += 1;
        offend(Offence::NotFinite, "a number isn't finite".to_owned());
    }
    match falsehood {
        Some(falsehood) if ours.is_solved() => {
            tally.falsehoods += 1;
            offend(Offence::False, falsehood);
        }
        Some(falsehood) => {
            tally.misreported += 1;
            offend(Offence::Misreported, falsehood);
        }
        None if ours.is_solved() => {
            tally.largest_residual = tally.largest_residual.max(ours.as_asked.value);
        }
        None => {}
    }
}

/// The best of some solves, in seconds without what other programs took.
fn timed_alone(input: &Input, splines: &Splines) -> f64 {
    const TIMES: usize = 3;
    let solve = |_| {
        let clock = Clock::start();
        let _ = std::hint::black_box(faircurve::solve(&input.contour, &*splines[input.spline]));
        clock.seconds()
    };
    (0..TIMES).map(solve).fold(f64::INFINITY, f64::min)
}

/// The kind of an error, in words.
fn kind(error: &InputError) -> &'static str {
    match error {
        InputError::Empty => "empty",
        InputError::NotFinite { .. } => "not finite",
        InputError::TooLarge { .. } => "too large",
        InputError::TooSmall => "too small",
        InputError::ZeroTangent { .. } => "zero tangent",
        InputError::CurvatureTooLarge { .. } => "curvature too large",
        InputError::TangentsDiffer { .. } => "tangents differ",
        InputError::CurvaturesDiffer { .. } => "curvatures differ",
    }
}

/// What went wrong, by name, and the inputs that it went wrong on; and the slowest of each
/// distribution.
fn named(inputs: Inputs, outcome: &Outcome) -> (Vec<String>, Vec<(String, Document)>) {
    let mut named: BTreeMap<Offence, usize> = BTreeMap::new();
    let (mut alarms, mut notable) = (Vec::new(), Vec::new());
    for (offence, case, what) in &outcome.offences {
        let count = named.entry(*offence).or_default();
        *count += 1;
        if *count > MOST_NAMED {
            continue;
        }
        let (input, distribution) = input(inputs, *case);
        let name = format!("{} {distribution} case {case} {}", offence.name(), input.spline);
        alarms.push(format!("{name}: {what}"));
        notable.push((name, document(input)));
    }
    for (offence, count) in named {
        if count > MOST_NAMED {
            alarms.push(format!("{}: {} more", offence.name(), count - MOST_NAMED));
        }
    }
    for (distribution, tally) in DISTRIBUTIONS.iter().zip(&outcome.tallies) {
        let case = tally.slowest_case;
        let name = format!("slowest {} case {case}", distribution.name);
        notable.push((name, document(distribution.input(inputs, case))));
    }
    (alarms, notable)
}

/// The sum of some chunks of one seed.
fn report(chunks: &[&Chunk]) -> Report {
    let mut by_name: BTreeMap<&str, Tally> = BTreeMap::new();
    let mut all = Tally::default();
    for (name, tally) in chunks.iter().flat_map(|chunk| &chunk.distributions) {
        by_name.entry(name).or_default().add(tally);
        all.add(tally);
    }
    let rows = by_name.iter().map(|(name, tally)| (*name, tally)).chain([("all", &all)]).map(row);
    let header = [
        "distribution",
        "cases",
        "solved",
        "relaxed",
        "refused",
        "false",
        "misreported",
        "not finite",
        "panics",
        "over time",
        "residual",
        "mean ms",
        "slowest ms",
        "case",
    ];
    let (seed, most_knots) =
        chunks.first().map_or((0, FEW_KNOTS), |chunk| (chunk.seed, chunk.most_knots));
    let refusals = all.refused.iter().map(|(kind, count)| [kind.clone(), count.to_string()]);
    let text = [
        table(header, rows.collect()),
        format!(
            "\nPer cent of the cases. false: called solved, and isn't; misreported: relaxed, and what is said \
             to hold instead doesn't. ms:\nwall time of the solve beside the other threads; over time: \
             above {} ms and {} ms for every knot above {FEW_KNOTS}, alone, and {SUSPICIOUS} times that \
             beside other work.\nUp to {most_knots} knots; seed {seed}.\n\n",
            1e3 * LIMIT,
            1e3 * LIMIT_A_KNOT,
        ),
        table(["refused as", "cases"], refusals.collect()),
    ]
    .concat();
    let alarms: Vec<String> = chunks.iter().flat_map(|chunk| chunk.alarms.clone()).collect();
    let json = json!({
        "cases": all.cases, "seed": seed, "most_knots": most_knots, "distributions": by_name, "alarms": alarms,
    });
    Report { text, json, notable: Vec::new(), alarms }
}

fn row((name, t): (&str, &Tally)) -> [String; 14] {
    [
        name.to_owned(),
        t.cases.to_string(),
        percent(t.solved, t.cases),
        percent(t.relaxed, t.cases),
        percent(t.refused_in_all(), t.cases),
        t.falsehoods.to_string(),
        t.misreported.to_string(),
        t.not_finite.to_string(),
        t.panics.to_string(),
        t.over_time.to_string(),
        tiny(t.largest_residual),
        format!("{:.3}", 1e3 * t.seconds / t.cases as f64),
        format!("{:.1}", 1e3 * t.slowest_seconds),
        t.slowest_case.to_string(),
    ]
}

/// The input as a document that names its spline.
fn document(input: Input) -> Document {
    let spline = SplineChoice::new(input.spline);
    Document { spline, ..Document::unnamed([input.contour]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn splines() -> Splines {
        SPLINES.iter().map(|name| (*name, catalog::spline(name).unwrap())).collect()
    }

    #[test]
    fn nothing_panics_and_all_is_finite() {
        let outcome = on_all_cores(0..1100, Inputs::few(0), &splines());
        let worst = outcome.offences.iter().map(|(offence, ..)| *offence).min();
        assert!(worst.is_none_or(|offence| offence >= Offence::False), "{:?}", outcome.offences);
    }

    #[test]
    fn nothing_happens_that_must_never() {
        let (_, report) =
            run(0..2000, Inputs::few(0)).unwrap_or_else(|failure| panic!("{}", failure.message));
        assert_eq!(report.alarms, [""; 0]);
    }

    #[test]
    fn chunks_add_up_and_none_counts_twice() {
        let chunk = |cases: Range<usize>| {
            let run =
                run(cases, Inputs::few(3)).unwrap_or_else(|failure| panic!("{}", failure.message));
            serde_json::to_string(&run.0).unwrap()
        };
        let counts = |text: &str| {
            let chunks = chunks(text)?;
            let json = report(&chunks.iter().collect::<Vec<_>>()).json;
            let of = |tally: &serde_json::Value| {
                ["cases", "solved", "relaxed", "refused"].map(|count| tally[count].clone())
            };
            let names = json["distributions"].as_object().unwrap().iter();
            Ok::<_, String>(
                names.map(|(name, tally)| (name.clone(), of(tally))).collect::<Vec<_>>(),
            )
        };
        let (first, second, whole) = (chunk(0..150), chunk(150..400), chunk(0..400));
        assert_eq!(counts(&format!("{second}\n{first}\n")), counts(&whole));
        assert_eq!(counts(&format!("{first}\n{whole}")), Err("case 0 is there twice".to_owned()));
        assert_eq!(counts(""), Err("nothing in it".to_owned()));
    }

    #[test]
    fn counts_do_not_depend_on_the_order_of_work() {
        let whole = on_all_cores(0..1100, Inputs::few(5), &splines());
        let mut parts =
            Outcome { tallies: vec![Tally::default(); DISTRIBUTIONS.len()], ..Outcome::default() };
        let splines = splines();
        for case in (0..1100).rev() {
            try_case(Inputs::few(5), case, &splines, &mut parts);
        }
        for (a, b) in whole.tallies.iter().zip(&parts.tallies) {
            assert_eq!((a.cases, a.solved, a.relaxed), (b.cases, b.solved, b.relaxed));
            assert_eq!((&a.refused, a.largest_residual), (&b.refused, b.largest_residual));
        }
    }
}
