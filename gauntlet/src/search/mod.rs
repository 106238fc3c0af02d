//! The offline search for what exists: minutes a case, and the best root kept in a file.
//!
//! It shares with the library the plan (which runs a contour falls into) and the integral; equations,
//! Newton's method, starts and all else are its own, so that what the library can't find isn't out of
//! reach here for the same reason.

mod banded;
mod bridge;
mod chain;
mod hunt;

use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use faircurve::plan::{Plan, Run};
use faircurve::spline::RunSolution;
use faircurve::{Contour, PolynomialSpiral, Segment, Spline};
use serde_json::json;

use crate::generate::Random;
use crate::progress::Progress;
use crate::report::{Report, percent, table};
use crate::rivals::Ours;
use crate::yardstick::{Entry, Yardstick};
use crate::{Failure, spiro};
use chain::Chain;

/// Searches each of the named contours for `seconds`, and keeps what is better than before in the
/// yardstick's folder. Another `seed` takes other random starts.
pub(crate) fn run(
    contours: &[(String, Contour)],
    seconds: f64,
    seed: u64,
    folder: &Path,
) -> Result<Report, Failure> {
    let spline = spiro()?;
    let limit = Duration::from_secs_f64(seconds);
    let next = AtomicUsize::new(0);
    let state = Mutex::new((Yardstick::read(folder)?, Progress::new(contours.len()), Vec::new()));
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let work = || -> Result<(), Failure> {
        while let Some((name, contour)) = contours.get(next.fetch_add(1, Ordering::Relaxed)) {
            let found = search(contour, &*spline, limit, seed);
            let Ok(mut state) = state.lock() else { break };
            let (yardstick, progress, rows) = &mut *state;
            progress.step(name);
            let before = yardstick.get(name).cloned();
            let entry = match found {
                Some((ours, fewest_loops, how)) => Entry::new(name, &ours, fewest_loops, how),
                None => Entry::unsolved(name),
            };
            rows.push((entry.clone(), before));
            yardstick.improve(entry);
            yardstick.write_group_of(name, folder)?;
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let handles: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        handles.into_iter().filter_map(|handle| handle.join().ok()).collect::<Result<(), _>>()
    })?;
    let (_, progress, mut rows) =
        state.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    progress.done();
    rows.sort_by(|a, b| a.0.place.cmp(&b.0.place));
    Ok(report(&rows))
}

/// The best curve found as asked, judged; the fewest loops of any; and how its hardest run was found.
fn search(
    contour: &Contour,
    spline: &dyn Spline,
    limit: Duration,
    seed: u64,
) -> Option<(Ours, usize, &'static str)> {
    let plan = Plan::new(contour, spline).ok()?;
    let all: usize = plan.runs().iter().map(|run| run.segment_count()).sum();
    let (mut how, mut fewest_loops) = ("nothing to search", 0);
    let mut solutions = Vec::new();
    for run in plan.runs() {
        let share = limit.mul_f64(run.segment_count() as f64 / all as f64);
        let root = hunt::hunt(&Chain::new(run), share, seed)?;
        if how != "local search" {
            how = root.how;
        }
        fewest_loops += root.fewest_loops;
        let segments = segments(run, &root.state.k);
        solutions.push(RunSolution { segments, ..RunSolution::default() });
    }
    let ours = Ours::judge(contour, spline, plan.assemble(solutions));
    (ours.as_asked.value <= 1e-8).then_some((ours, fewest_loops, how))
}

/// Curves as asked of a contour that is one run, all different, by how much they turn: those that
/// Newton's method finds from a few hundred seeded starts.
pub(crate) fn roots(contour: &Contour, spline: &dyn Spline) -> Vec<Ours> {
    const STARTS: usize = 300;
    /// Of k₀ … k₃.
    const SIZES: [f64; 4] = [3.0, 20.0, 40.0, 200.0];
    let Ok(plan) = Plan::new(contour, spline) else { return Vec::new() };
    let [run] = plan.runs() else { return Vec::new() };
    let chain = Chain::new(run);
    let mut random = Random::for_case("roots", 0);
    let mut roots: Vec<Ours> = Vec::new();
    for _ in 0..STARTS {
        let mut state = chain.straight();
        for k in &mut state.k {
            *k = SIZES.map(|size| size * random.between(-1.0, 1.0));
        }
        chain.wind(&mut state);
        chain.newton(&mut state, 1.0, 60);
        let solution = RunSolution { segments: segments(run, &state.k), ..RunSolution::default() };
        let root = Ours::judge(contour, spline, plan.assemble(vec![solution]));
        let is_new = roots.iter().all(|known| (known.turning - root.turning).abs() > 1e-6);
        if root.as_asked.value <= 1e-8 && is_new {
            roots.push(root);
        }
    }
    roots.sort_by(|a, b| a.turning.total_cmp(&b.turning));
    roots
}

/// The segments of a run with these parameters.
fn segments(run: &Run, k: &[[f64; 4]]) -> Vec<Segment> {
    let point = |i: usize| run.knots[i % run.knots.len()].point;
    let segment = |(i, k): (usize, &[f64; 4])| {
        Segment::spiral(point(i), point(i + 1), PolynomialSpiral::new(*k))
    };
    k.iter().enumerate().map(segment).collect()
}

fn report(rows: &[(Entry, Option<Entry>)]) -> Report {
    let better = |(new, old): &&(Entry, Option<Entry>)| {
        new.turning.is_some() && old.as_ref().is_none_or(|old| new.is_better_than(old))
    };
    let lines = rows
        .iter()
        .map(|row @ (new, old)| {
            let turning = |entry: &Entry| {
                entry.turning.map_or("none".to_owned(), |turning| format!("{turning:.4}"))
            };
            [
                new.place.clone(),
                turning(new),
                format!("{} {}", new.loops, new.fewest_loops),
                new.how.clone(),
                old.as_ref().map_or("–".to_owned(), turning),
                if better(&row) { "better" } else { "" }.to_owned(),
            ]
        })
        .collect();
    let found = rows.iter().filter(|(new, _)| new.turning.is_some()).count();
    let gained = rows.iter().filter(better).count();
    let header = ["contour", "∫|κ| ds", "loops, fewest", "found by", "before", ""];
    let text = format!(
        "{}\nroots found: {found} of {} ({} %); better than before: {gained}\n",
        table(header, lines),
        rows.len(),
        percent(found, rows.len()),
    );
    let entries: Vec<&Entry> = rows.iter().map(|(new, _)| new).collect();
    let json =
        json!({ "searched": rows.len(), "found": found, "better": gained, "roots": entries });
    Report { text, json, notable: Vec::new(), alarms: Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::classes;

    #[test]
    fn it_finds_what_the_library_finds() {
        let spline = spiro().unwrap_or_else(|failure| panic!("{}", failure.message));
        for name in ["walk open g4 16", "walk closed g2 16", "circle closed g4 16"] {
            let class = classes().into_iter().find(|class| class.name == name).unwrap();
            let contour = class.contour(1);
            let ours = Ours::solve(&contour, &*spline).unwrap();
            let found = search(&contour, &*spline, Duration::from_millis(50), 0);
            let (found, ..) = found.unwrap_or_else(|| panic!("{name}"));
            assert!(found.turning <= ours.turning + 1e-6, "{name}");
        }
    }
}
