//! Any JSON and any knots through faircurve.h, with any numbers asked of the solution. Run with a sanitizer.
#![no_main]

use std::ffi::{CStr, c_char, c_void};
use std::ptr::null_mut;

use arbitrary::Arbitrary;
use faircurve_capi::*;
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Debug)]
struct Input<'a> {
    knots: Vec<(f64, i16, i8)>,
    is_closed: bool,
    places: [f64; 3],
    contour: u8,
    capacity: u8,
    options: (f64, u8),
    json: &'a [u8],
}

unsafe extern "C" fn count(element: *const fc_element, data: *mut c_void) {
    // SAFETY: both are what `fc_beziers` was given.
    unsafe {
        let fc_element { x1, y1, x2, y2, x, y, .. } = *element;
        assert!([x1, y1, x2, y2, x, y].iter().all(|number| number.is_finite()));
        *data.cast::<usize>() += 1;
    }
}

/// Reads a message, if there is one, and frees it.
unsafe fn read(message: *mut c_char) {
    // SAFETY: by contract from the library.
    unsafe {
        if !message.is_null() {
            assert!(CStr::from_ptr(message).to_str().unwrap().starts_with("error: "));
        }
        fc_string_free(message);
    }
}

unsafe fn ask(document: *const fc_document, input: &Input<'_>) {
    // SAFETY: what is passed is what each function asks for, and what is freed is freed once.
    unsafe {
        let mut options = std::mem::zeroed::<fc_options>();
        assert_eq!(fc_options_default(&mut options, size_of::<fc_options>()), fc_status::FC_OK);
        let (accuracy, bits) = input.options;
        // No accuracy so fine that the fuzzer waits for a million pieces.
        options.accuracy = if accuracy > 0.0 { accuracy.max(1e-3) } else { accuracy };
        options.effort = f64::from(bits & 1) / 8.0;
        options.span_knots = (bits & 2).into();
        options.at_extrema = (bits & 4).into();
        options.at_inflections = (bits & 8).into();
        options.free_joints = (bits & 16).into();
        let (mut solution, mut message) = (null_mut(), null_mut());
        let status = fc_solve(document, &options, &mut solution, &mut message);
        assert_eq!(status == fc_status::FC_OK, !solution.is_null());
        assert_ne!(status, fc_status::FC_BUG);
        read(message);
        let contour = usize::from(input.contour) % (fc_contour_count(solution) + 2);
        let mut pieces = 0usize;
        if fc_beziers(solution, contour, Some(count), (&raw mut pieces).cast()) == fc_status::FC_OK {
            let mut element = Vec::with_capacity(input.capacity.into());
            let (room, mut needed) = (element.capacity(), 0);
            let status = fc_beziers_into(solution, contour, element.as_mut_ptr(), room, &mut needed);
            assert_eq!((needed, status == fc_status::FC_OK), (pieces, pieces <= room));
            for s in input.places {
                let mut point = fc_point { x: 0.0, y: 0.0, direction: 0.0, curvature: 0.0 };
                fc_at(solution, contour, s, &mut point);
                let fc_point { x, y, direction, curvature } = point;
                assert!([x, y, direction, curvature].iter().all(|number| number.is_finite()));
            }
        }
        let mut number = 0.0;
        fc_length(solution, contour, &mut number);
        fc_knot_position(solution, contour, input.capacity.into(), &mut number);
        assert!(number.is_finite() && number >= 0.0);
        for i in 0..=fc_relaxation_count(solution, contour) {
            let mut relaxation = std::mem::zeroed::<fc_relaxation>();
            if fc_relaxation_at(solution, contour, i, &mut relaxation) == fc_status::FC_OK {
                assert!(!CStr::from_ptr(relaxation.reason).is_empty());
            }
        }
        let mut json = null_mut();
        fc_solution_write_json(solution, (input.capacity % 4).into(), &mut json);
        fc_string_free(json);
        fc_solution_free(solution);
    }
}

fuzz_target!(|input: Input<'_>| {
    const FEW: usize = 12;
    // SAFETY: as in `ask`.
    unsafe {
        let document = fc_document_new();
        let knots: Vec<fc_knot> = input
            .knots
            .iter()
            .take(FEW)
            .map(|&(x, y, join)| fc_knot { x, y: y.into(), join: join.into() })
            .collect();
        fc_document_add_contour(document, knots.as_ptr(), knots.len(), input.is_closed.into());
        ask(document, &input);
        let (mut json, mut message) = (null_mut(), null_mut());
        fc_document_write_json(document, &mut json, &mut message);
        read(message);
        fc_string_free(json);
        fc_document_free(document);

        let (mut read_back, mut message) = (null_mut(), null_mut());
        // Larger drawings only take longer.
        let text = &input.json[..input.json.len().min(1000)];
        fc_document_read_json(text.as_ptr().cast(), text.len(), &mut read_back, &mut message);
        read(message);
        if !read_back.is_null() {
            ask(read_back, &input);
        }
        fc_document_free(read_back);
    }
});
