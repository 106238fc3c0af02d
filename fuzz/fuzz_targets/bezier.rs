//! A curve through hostile knots becomes Béziers of any accuracy.
#![no_main]

use faircurve_fuzz::{Accuracy, Problem, check};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: (Problem, Accuracy)| {
    let (problem, Accuracy(accuracy)) = input;
    if let Some(solution) = problem.solve() {
        check::beziers(&problem.contour, &solution.curve, accuracy);
    }
});
