//! A curve through hostile knots becomes Béziers of any accuracy, by every kind of conversion.
#![no_main]

use faircurve_fuzz::{BezierOptions, Problem, check};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: (Problem, BezierOptions)| {
    let (problem, BezierOptions(options)) = input;
    if let Some(solution) = problem.solve() {
        check::beziers(&problem.contour, &solution.curve, &options);
    }
});
