//! `faircurve list --laws`: what measuring says of every spline, and of what each claims.

use std::fmt::Write;

use faircurve::catalog::{self, Claim, ENTRIES, SplineInfo};
use faircurve::measure::verdict::PROPERTIES;
use faircurve::measure::{Laws, Verdict};
use rayon::prelude::*;
use serde::Serialize;

use crate::failure::Failure;
use crate::measure::significant;
use crate::progress::Progress;

/// A spline and its numbers.
struct Row {
    info: &'static SplineInfo,
    laws: Laws,
}

/// Measures every entry of the catalogue, over all cores.
fn measured() -> Result<Vec<Row>, Failure> {
    let progress = Progress::of("measuring", ENTRIES.len(), "splines");
    let measure = |info: &&'static SplineInfo| {
        let laws = Laws::measure(&*catalog::spline(info.name)?);
        progress.step();
        Ok(Row { info, laws })
    };
    // One by one: they differ a hundredfold in time.
    ENTRIES.par_iter().with_max_len(1).map(measure).collect()
}

pub(crate) fn as_text() -> Result<String, Failure> {
    let rows = measured()?;
    let mut text = String::new();
    text.push_str("grades, as in thesis Table 4.1\n\n");
    table(&mut text, &rows, &GRADES);
    text.push_str(
        "\nnumbers: distances as fractions of the drawing, 0 below 1e-12; off the circle through four points,\n\
         through uneven ones, and how the former falls with their number\n\n",
    );
    table(&mut text, &rows, &NUMBERS);
    text.push_str(
        "\nmore numbers: largest jumps, without units; the factor of a ripple from knot to knot, and how many \
         segments\na knot moves; how much faster than a knot the curve moves; how far segments are from being \
         cut from one curve\n\n",
    );
    table(&mut text, &rows, &MORE_NUMBERS);
    text.push_str(
        "\nshares, in percent: drawings solved as asked (jittered circles of 16 knots; walks that turn by up to \
         60°;\nuniform in a square), paths of a knot on which the curve jumps, segments with monotone \
         curvature\n\n",
    );
    table(&mut text, &rows, &SHARES);
    text.push_str("\nclaims\n\n");
    claims(&mut text, &rows);
    Ok(text)
}

/// A column of a table: its head, and what stands in it.
type Column = (&'static str, fn(&Row) -> String);

const GRADES: [Column; 7] = [
    ("spline", |row| row.info.name.to_owned()),
    ("tangents", |row| row.laws.tangents().to_owned()),
    ("continuity", |row| {
        row.laws.continuity().map_or("unknown".to_owned(), |order| format!("G{order}"))
    }),
    ("extensionality", |row| row.laws.extensionality_grade().to_string()),
    ("roundness", |row| row.laws.roundness_grade().to_string()),
    ("robustness", |row| row.laws.robustness_grade().to_string()),
    ("locality", |row| row.laws.locality_grade().to_string()),
];

const NUMBERS: [Column; 11] = [
    ("spline", |row| row.info.name.to_owned()),
    ("misses", |row| small(row.laws.misses)),
    ("similar", |row| small(row.laws.invariance.similarity)),
    ("mirror", |row| small(row.laws.invariance.mirror)),
    ("reverse", |row| small(row.laws.invariance.direction)),
    ("affine", |row| small(row.laws.invariance.affine)),
    ("extension", |row| small(row.laws.extensionality.inside)),
    ("at ends", |row| small(row.laws.extensionality.at_ends)),
    ("off circle", |row| {
        small(row.laws.roundness.even.iter().find(|(n, _)| *n == 4).map_or(0.0, |even| even.1))
    }),
    ("uneven", |row| small(row.laws.roundness.uneven)),
    ("as n^", |row| match row.laws.roundness.order {
        Some(order) if !row.laws.is_round() => format!("{:.2}", -order),
        _ => "exact".to_owned(),
    }),
];

const MORE_NUMBERS: [Column; 10] = [
    ("spline", |row| row.info.name.to_owned()),
    ("jump θ", |row| jump(row, 0)),
    ("κ", |row| jump(row, 1)),
    ("κ′", |row| jump(row, 2)),
    ("κ″", |row| jump(row, 3)),
    ("ripple", |row| match row.laws.locality.support {
        Some(_) => "none".to_owned(),
        None => format!("{:.4}", row.laws.locality.ripple),
    }),
    ("support", |row| row.laws.locality.support.map_or("all".to_owned(), |s| format!("±{s}"))),
    ("moves", |row| row.laws.moves.ratio.map_or("unknown".to_owned(), short)),
    ("parameters", |row| row.laws.parameters.to_string()),
    ("one curve", |row| row.laws.spread.map_or("unknown".to_owned(), small)),
];

const SHARES: [Column; 6] = [
    ("spline", |row| row.info.name.to_owned()),
    ("circle", |row| solved(row, "jittered")),
    ("walk", |row| solved(row, "walk")),
    ("square", |row| solved(row, "uniform")),
    ("jumps", |row| percent(row.laws.moves.jumps)),
    ("monotone", |row| percent(row.laws.monotone)),
];

/// The largest jump of that derivative at a knot.
fn jump(row: &Row, order: usize) -> String {
    row.laws.jumps.map_or("unknown".to_owned(), |jumps| small(jumps[order]))
}

/// The share solved in the classes whose name starts so.
fn solved(row: &Row, start: &str) -> String {
    let classes = || row.laws.existence.iter().filter(|e| e.class.starts_with(start));
    let solved: usize = classes().map(|e| e.solved).sum();
    let of: usize = classes().map(|e| e.of).sum();
    percent(solved as f64 / of.max(1) as f64)
}

fn percent(share: f64) -> String {
    format!("{:.1}", 100.0 * share)
}

/// Three digits at most; what is rounding is 0.
fn small(x: f64) -> String {
    /// Exact laws are met to 1e-15 or so, and rounding differs from machine to machine.
    const ROUNDING: f64 = 1e-12;
    if x.abs() < ROUNDING { "0".to_owned() } else { short(x) }
}

fn short(x: f64) -> String {
    if x >= f64::MAX { "huge".to_owned() } else { significant(x, 3) }
}

fn table(text: &mut String, rows: &[Row], columns: &[Column]) {
    let cells: Vec<Vec<String>> =
        rows.iter().map(|row| columns.iter().map(|(_, cell)| cell(row)).collect()).collect();
    let heads: Vec<String> = columns.iter().map(|(head, _)| (*head).to_owned()).collect();
    let width = |column: usize| {
        let there = cells.iter().chain([&heads]).map(|row| row[column].chars().count());
        there.max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns.len()).map(width).collect();
    for row in [&heads].into_iter().chain(&cells) {
        let mut line = String::new();
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let gap = if column == 0 { "  " } else { "   " };
            let _ = match column {
                0 => write!(line, "{gap}{cell:<width$}"),
                _ => write!(line, "{gap}{cell:>width$}"),
            };
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
}

/// What each spline claims and whether it holds; then the properties that it doesn't claim, with the
/// number that is the witness against them.
fn claims(text: &mut String, rows: &[Row]) {
    let name = rows.iter().map(|row| row.info.name.len()).max().unwrap_or(0);
    for row in rows {
        let claimed = row.info.claims.iter().map(|claim| (claim, Verdict::on(claim, &row.laws)));
        let claimed =
            claimed.map(|(claim, verdict)| (claim.to_string(), claim, verdict, verdict.name()));
        let lacking = lacking(row).map(|(claim, verdict)| {
            let word = if verdict.holds() { "no witness" } else { "witness" };
            (format!("not {claim}"), claim, verdict, word)
        });
        for (i, (words, claim, verdict, judgement)) in claimed.chain(lacking).enumerate() {
            let spline = if i == 0 { row.info.name } else { "" };
            let number = match (verdict.number(), claim) {
                (Some(number), Claim::Ripple(_)) => format!("{number:.4}"),
                (Some(number), Claim::RoundToOrder(_)) => format!("{number:.2}"),
                (Some(number), Claim::Continuity(_) | Claim::Parameters(_)) => number.to_string(),
                (Some(number), _) => small(number),
                (None, _) => String::new(),
            };
            let judgement = if verdict == Verdict::Unknown { "unknown" } else { judgement };
            let line = format!("  {spline:<name$}   {words:<24} {judgement:<13} {number}");
            text.push_str(line.trim_end());
            text.push('\n');
        }
    }
}

/// The properties that a spline doesn't claim.
fn lacking(row: &Row) -> impl Iterator<Item = (&'static Claim, Verdict)> + '_ {
    let lacks = |claim: &&Claim| !row.info.claims.contains(claim);
    PROPERTIES.iter().filter(lacks).map(|claim| (claim, Verdict::on(claim, &row.laws)))
}

#[derive(Serialize)]
struct LawsFile {
    faircurve: u32,
    splines: Vec<LawsEntry>,
}

#[derive(Serialize)]
struct LawsEntry {
    name: &'static str,
    grades: GradesEntry,
    misses: f64,
    similarity: f64,
    mirror: f64,
    direction: f64,
    affine: f64,
    /// `null` if nothing was solved, and so is `continuity`.
    jumps: Option<[f64; 4]>,
    continuity: Option<u8>,
    roundness: RoundnessEntry,
    extensionality: ExtensionalityEntry,
    ripple: f64,
    /// `null`: all segments.
    support: Option<usize>,
    monotone: f64,
    existence: Vec<ExistenceEntry>,
    moves: MovesEntry,
    parameters: usize,
    spread_about_one_curve: Option<f64>,
    claims: Vec<ClaimEntry>,
    /// Properties not claimed; `contradicted` means that the number is the witness.
    lacks: Vec<ClaimEntry>,
}

#[derive(Serialize)]
struct GradesEntry {
    tangents: &'static str,
    extensionality: &'static str,
    roundness: &'static str,
    robustness: &'static str,
    locality: &'static str,
}

#[derive(Serialize)]
struct RoundnessEntry {
    /// Rows of n and the distance over the radius.
    even: Vec<(usize, f64)>,
    uneven: f64,
    /// `null` where it is exact.
    order: Option<f64>,
}

#[derive(Serialize)]
struct ExtensionalityEntry {
    inside: f64,
    at_ends: f64,
}

#[derive(Serialize)]
struct ExistenceEntry {
    class: &'static str,
    solved: usize,
    of: usize,
}

#[derive(Serialize)]
struct MovesEntry {
    /// `null` if every path has a jump.
    ratio: Option<f64>,
    jumps: f64,
}

#[derive(Serialize)]
struct ClaimEntry {
    claim: String,
    verdict: &'static str,
    /// `null` where it is unknown.
    number: Option<f64>,
}

pub(crate) fn as_json() -> Result<String, Failure> {
    let splines = measured()?.iter().map(entry).collect();
    let file = LawsFile { faircurve: 1, splines };
    let text = serde_json::to_string_pretty(&file).map_err(|e| Failure::new(e.to_string()))?;
    Ok(text + "\n")
}

fn entry(row: &Row) -> LawsEntry {
    let laws = &row.laws;
    let judged = |claim: &Claim, verdict: Verdict| ClaimEntry {
        claim: claim.to_string(),
        verdict: verdict.name(),
        number: verdict.number(),
    };
    let claim = |claim: &Claim| judged(claim, Verdict::on(claim, laws));
    let existence = |e: &faircurve::measure::laws::Existence| ExistenceEntry {
        class: e.class,
        solved: e.solved,
        of: e.of,
    };
    LawsEntry {
        name: row.info.name,
        grades: GradesEntry {
            tangents: laws.tangents(),
            extensionality: laws.extensionality_grade().name(),
            roundness: laws.roundness_grade().name(),
            robustness: laws.robustness_grade().name(),
            locality: laws.locality_grade().name(),
        },
        misses: laws.misses,
        similarity: laws.invariance.similarity,
        mirror: laws.invariance.mirror,
        direction: laws.invariance.direction,
        affine: laws.invariance.affine,
        jumps: laws.jumps,
        continuity: laws.continuity(),
        roundness: RoundnessEntry {
            even: laws.roundness.even.clone(),
            uneven: laws.roundness.uneven,
            order: laws.roundness.order,
        },
        extensionality: ExtensionalityEntry {
            inside: laws.extensionality.inside,
            at_ends: laws.extensionality.at_ends,
        },
        ripple: laws.locality.ripple,
        support: laws.locality.support,
        monotone: laws.monotone,
        existence: laws.existence.iter().map(existence).collect(),
        moves: MovesEntry { ratio: laws.moves.ratio, jumps: laws.moves.jumps },
        parameters: laws.parameters,
        spread_about_one_curve: laws.spread,
        claims: row.info.claims.iter().map(claim).collect(),
        lacks: lacking(row).map(|(claim, verdict)| judged(claim, verdict)).collect(),
    }
}
