//! The `faircurve` program.
//!
//! Exit codes: 0, all solved as asked; 3, written, but something was relaxed; 2, bad input or
//! usage, nothing written.

mod args;
mod beziers;
mod compare;
mod edit;
mod failure;
mod input;
mod laws;
mod list;
mod measure;
mod output;
mod progress;
mod report;
mod select;
mod solve;

use std::process::ExitCode;

use args::Command;
use failure::Failure;

fn main() -> ExitCode {
    match args::parse().and_then(run) {
        Ok(code) => code,
        Err(failure) => failure.print(),
    }
}

fn run(command: Command) -> Result<ExitCode, Failure> {
    match command {
        Command::Solve(args) => solve::run(&args),
        Command::List(args) => list::run(&args),
        Command::Measure(args) => measure::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Edit(args) => edit::run(&args),
        Command::Shown(text) => output::to_stdout(text.as_bytes()).map(|()| ExitCode::SUCCESS),
    }
}
