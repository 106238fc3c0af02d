//! Any bytes read as CSV are an error, or a document that can be written, solved and drawn.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| faircurve_fuzz::document::check(bytes, "csv"));
