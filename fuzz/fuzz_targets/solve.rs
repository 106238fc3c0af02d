//! A contour of hostile numbers is refused, or solved with a curve that keeps every promise.
#![no_main]

use faircurve_fuzz::{Problem, check};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|problem: Problem| {
    if let Some(solution) = problem.solve() {
        check::solution(&problem.contour, &solution);
    }
});
