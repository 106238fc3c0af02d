//! faircurve for C: `faircurve.h`, which cbindgen makes of this file.
//!
//! What is written here for functions and structs is written for readers of that header. This file alone
//! touches the caller's memory; everything else is safe Rust. No state outlives a call but what handles hold,
//! and a panic ends in `FC_BUG`.
//!
//! What all functions require of their caller: pointers are NULL, or point to what their types say, for as
//! long as the call lasts; handles and strings are from this library and not freed yet; and a handle that is
//! being changed is used by one thread only.
#![expect(unsafe_code, reason = "this is the boundary to C")]
#![expect(non_camel_case_types, reason = "the names are C's")]
#![expect(clippy::missing_safety_doc, reason = "the contract of all functions is above")]

mod failure;
mod solved;
mod status;

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::mem::size_of;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::null;

use faircurve::{Contour, Join, Knot, Place, catalog};
use faircurve_format::{Document, DocumentContour, SplineChoice, json};

use failure::Failure;
use solved::Solved;

/// What became of a call. fc_status_message says it in words.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum fc_status {
    /// Done.
    FC_OK,
    /// An argument is NULL that must not be.
    FC_NULL_ARGUMENT,
    /// The options have a size or a value that means nothing.
    FC_BAD_OPTIONS,
    /// The text is not a faircurve document.
    FC_BAD_DOCUMENT,
    /// A contour can't be solved at all: a number in it has no meaning.
    FC_BAD_CONTOUR,
    /// There is no spline of that name, or it lacks that parameter.
    FC_UNKNOWN_NAME,
    /// A number is beyond what there is: of a contour, a knot, a relaxation, a join.
    FC_OUT_OF_RANGE,
    /// The contour has no segment: it is a point.
    FC_NO_CURVE,
    /// The array is too small.
    FC_TOO_SMALL,
    /// faircurve has failed inside. Please report it.
    FC_BUG,
}

/// A drawing: contours of knots, and the spline that is to pass through them.
#[derive(Debug)]
pub struct fc_document(Document);

/// A drawing solved. Nothing of the document is used any more.
#[derive(Debug)]
pub struct fc_solution(Solved);

/// Whatever the spline takes where nothing is said.
pub const FC_JOIN_DEFAULT: c_int = 0;
/// The curve may turn abruptly.
pub const FC_JOIN_CORNER: c_int = 1;
/// The direction is continuous.
pub const FC_JOIN_G1: c_int = 2;
/// Curvature is continuous, too.
pub const FC_JOIN_G2: c_int = 3;
/// Its first two derivatives are continuous, too.
pub const FC_JOIN_G4: c_int = 4;
/// A curve comes in; what leaves behaves as from an end, such as a straight line.
pub const FC_JOIN_CURVE_TO_TERMINAL: c_int = 5;
/// What comes in behaves as toward an end; a curve leaves.
pub const FC_JOIN_TERMINAL_TO_CURVE: c_int = 6;

/// A knot: a point that the curve passes through.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fc_knot {
    /// Where it is, y up.
    pub x: f64,
    /// Where it is, y up.
    pub y: f64,
    /// How the curve joins there: one of FC_JOIN_…; at the ends of an open contour it means nothing.
    pub join: c_int,
}

/// How to solve, and what Béziers to make. Filled by fc_options_default, then changed where need be.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fc_options {
    /// The size of this struct in the caller's eyes; later versions may have more members.
    pub size: usize,
    /// The largest distance of the Béziers from the curve, in the drawing's units; 0, the default, is a
    /// ten-thousandth of the larger side of each glyph.
    pub accuracy: f64,
    /// How far to search where a contour is hard, as a multiple of the default, 1, which is about 50 ms a
    /// contour at most. 0 is no search.
    pub effort: f64,
    /// Not 0: a Bézier may run through knots at which the curve is smooth. Default 0.
    pub span_knots: c_int,
    /// Not 0: Béziers end where the curve is horizontal or vertical. Default 0.
    pub at_extrema: c_int,
    /// Not 0: Béziers end where the curve changes from bending to one side to bending to the other. Default 0.
    pub at_inflections: c_int,
    /// Not 0: ends of Béziers that aren't knots may lie off the curve, within the accuracy, so that there
    /// are fewer. Default 0.
    pub free_joints: c_int,
    /// Not 0: where every curve as asked that was found loops (a segment is longer than four chords), one knot
    /// or two are relaxed instead if that gives a curve without. Default 0.
    pub no_loops: c_int,
}

/// The kinds of pieces that a contour is made of.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum fc_element_kind {
    /// The contour starts at (x, y).
    FC_MOVE_TO,
    /// A straight line to (x, y).
    FC_LINE_TO,
    /// A quadratic Bézier with the control point (x1, y1), to (x, y).
    FC_QUAD_TO,
    /// A cubic Bézier with the control points (x1, y1) and (x2, y2), to (x, y).
    FC_CUBIC_TO,
    /// The contour is closed, and has come back to its start.
    FC_CLOSE,
}

/// A piece of a contour. Members that its kind doesn't use are 0.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct fc_element {
    /// What it is.
    pub kind: fc_element_kind,
    /// The first control point.
    pub x1: f64,
    /// The first control point.
    pub y1: f64,
    /// The second control point.
    pub x2: f64,
    /// The second control point.
    pub y2: f64,
    /// Where it ends.
    pub x: f64,
    /// Where it ends.
    pub y: f64,
}

/// Takes one piece after the other. The data is what was passed with the function.
pub type fc_element_function =
    Option<unsafe extern "C" fn(element: *const fc_element, data: *mut c_void)>;

/// A point of a curve.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct fc_point {
    /// Where it is.
    pub x: f64,
    /// Where it is.
    pub y: f64,
    /// The direction of travel, in radians, counterclockwise from the x axis.
    pub direction: f64,
    /// The curvature, in 1/units, positive where the curve bends to the left.
    pub curvature: f64,
}

/// Something that could not be met. The strings live as long as the solution.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fc_relaxation {
    /// Not 0: index is that of a segment; 0: of a knot. Both count from 0.
    pub is_segment: c_int,
    /// Where it is.
    pub index: usize,
    /// What was asked, such as "g4".
    pub asked: *const c_char,
    /// What holds instead, such as "g2".
    pub got: *const c_char,
    /// Why.
    pub reason: *const c_char,
}

/// Handles may be shared by threads: what the header promises, checked by the compiler.
const _: () = {
    const fn is_shared<T: Send + Sync>() {}
    is_shared::<fc_document>();
    is_shared::<fc_solution>();
};

/// What `work` does as a status; `FC_BUG` if it panics.
fn guarded(work: impl FnOnce() -> Result<(), fc_status>) -> fc_status {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => fc_status::FC_OK,
        Ok(Err(status)) => status,
        Err(_) => fc_status::FC_BUG,
    }
}

/// The same for work that can say more, which goes to `message`, unless that is NULL.
///
/// # Safety
/// `message` is NULL or points to a pointer.
unsafe fn explained(
    message: *mut *mut c_char,
    work: impl FnOnce() -> Result<(), Failure>,
) -> fc_status {
    guarded(|| {
        // SAFETY: by contract.
        let message = unsafe { message.as_mut() };
        let done = work();
        if let Some(message) = message {
            *message = match &done {
                Err(failure) if !failure.text.is_empty() => give_string(&failure.text),
                Err(failure) => give_string(&format!(
                    "error: {}",
                    status::message(failure.status as c_int).to_string_lossy()
                )),
                Ok(()) => std::ptr::null_mut(),
            };
        }
        done.map_err(|failure| failure.status)
    })
}

/// A string that the caller frees.
fn give_string(text: &str) -> *mut c_char {
    CString::new(text.replace('\0', "\u{fffd}")).unwrap_or_default().into_raw()
}

/// What a pointer points to.
///
/// # Safety
/// The pointer is NULL or points to a value that lives for `'a` and isn't changed meanwhile.
unsafe fn given<'a, T>(pointer: *const T) -> Result<&'a T, fc_status> {
    // SAFETY: by contract.
    unsafe { pointer.as_ref() }.ok_or(fc_status::FC_NULL_ARGUMENT)
}

/// Where a result goes, or what is to be changed.
///
/// # Safety
/// The pointer is NULL or points to a value that lives for `'a` and that nobody else uses meanwhile.
unsafe fn place<'a, T>(pointer: *mut T) -> Result<&'a mut T, fc_status> {
    // SAFETY: by contract.
    unsafe { pointer.as_mut() }.ok_or(fc_status::FC_NULL_ARGUMENT)
}

/// An array; one of no length may be NULL.
///
/// # Safety
/// The pointer is NULL or points to so many values that live for `'a` and aren't changed meanwhile.
unsafe fn array<'a, T>(first: *const T, count: usize) -> Result<&'a [T], fc_status> {
    if count == 0 {
        return Ok(&[]);
    }
    if first.is_null() {
        return Err(fc_status::FC_NULL_ARGUMENT);
    }
    if count > isize::MAX as usize / size_of::<T>().max(1) {
        return Err(fc_status::FC_OUT_OF_RANGE);
    }
    // SAFETY: by contract.
    Ok(unsafe { std::slice::from_raw_parts(first, count) })
}

/// faircurve's version, such as "0.1.0".
#[unsafe(no_mangle)]
pub extern "C" fn fc_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// What a status says, in English. Never NULL, never to be freed.
#[unsafe(no_mangle)]
pub extern "C" fn fc_status_message(status: c_int) -> *const c_char {
    status::message(status).as_ptr()
}

/// Frees a string that a function here has returned through a char **. NULL is nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_string_free(string: *mut c_char) {
    if !string.is_null() {
        // SAFETY: by contract, from `into_raw`.
        drop(unsafe { CString::from_raw(string) });
    }
}

/// Fills options with the defaults. The size is sizeof(fc_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_options_default(options: *mut fc_options, size: usize) -> fc_status {
    guarded(|| {
        // SAFETY: by contract.
        unsafe { place(options) }?;
        if size < size_of::<usize>() {
            return Err(fc_status::FC_BAD_OPTIONS);
        }
        let known = size.min(size_of::<fc_options>());
        let defaults = fc_options { size, ..fc_options::DEFAULT };
        // SAFETY: the caller's struct has `size` bytes; those that aren't known here are 0.
        unsafe {
            options.cast::<u8>().write_bytes(0, size);
            let from = (&raw const defaults).cast::<u8>();
            options.cast::<u8>().copy_from_nonoverlapping(from, known);
        }
        Ok(())
    })
}

impl fc_options {
    const DEFAULT: fc_options = fc_options {
        size: size_of::<fc_options>(),
        accuracy: 0.0,
        effort: 1.0,
        span_knots: 0,
        at_extrema: 0,
        at_inflections: 0,
        free_joints: 0,
        no_loops: 0,
    };

    /// The caller's options: of an older caller the members that it knows, of a newer one those known here.
    ///
    /// # Safety
    /// The pointer is NULL, which is the defaults, or points to a struct that starts with its size.
    unsafe fn read(options: *const fc_options) -> Result<fc_options, Failure> {
        let mut known = fc_options::DEFAULT;
        if options.is_null() {
            return Ok(known);
        }
        // SAFETY: by contract; as many bytes are read as both structs have.
        unsafe {
            let size = options.cast::<usize>().read();
            if size < size_of::<usize>() {
                let message = format!("the size of the options can't be {size}");
                return Err(Failure::option(&message, "fill them with fc_options_default first"));
            }
            let bytes = size.min(size_of::<fc_options>());
            let to = (&raw mut known).cast::<u8>();
            to.copy_from_nonoverlapping(options.cast::<u8>(), bytes);
        }
        Ok(known)
    }
}

/// A document without contours, to be solved with the spline "spiro". Never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fc_document_new() -> *mut fc_document {
    Box::into_raw(Box::new(fc_document(Document::unnamed([]))))
}

/// Reads a document: JSON of so many bytes, which need not end in a NUL. On FC_OK *document is new; else it
/// is NULL, and *message, unless message is NULL, a string that says what is wrong, where, and what to do.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_document_read_json(
    text: *const c_char,
    length: usize,
    document: *mut *mut fc_document,
    message: *mut *mut c_char,
) -> fc_status {
    // SAFETY: by contract.
    unsafe {
        explained(message, || {
            let document = place(document)?;
            *document = std::ptr::null_mut();
            let read = json::read(array(text.cast::<u8>(), length)?)?;
            *document = Box::into_raw(Box::new(fc_document(read)));
            Ok(())
        })
    }
}

/// Sets the spline of contours that don't name their own: a name such as "euler", of those that `faircurve
/// list` shows.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_document_set_spline(
    document: *mut fc_document,
    name: *const c_char,
    message: *mut *mut c_char,
) -> fc_status {
    // SAFETY: by contract.
    unsafe {
        explained(message, || {
            let document = place(document)?;
            given(name)?;
            let choice = SplineChoice::new(CStr::from_ptr(name).to_string_lossy());
            catalog::build(&choice.name, &choice.params)?;
            document.0.spline = choice;
            Ok(())
        })
    }
}

/// Appends a contour to the last glyph, or to a new one without a name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_document_add_contour(
    document: *mut fc_document,
    knots: *const fc_knot,
    count: usize,
    is_closed: c_int,
) -> fc_status {
    // SAFETY: by contract.
    let (document, knots) = match unsafe { (place(document), array(knots, count)) } {
        (Ok(document), Ok(knots)) => (document, knots),
        (Err(status), _) | (_, Err(status)) => return status,
    };
    guarded(|| {
        let knots: Result<Vec<Knot>, fc_status> = knots.iter().map(knot).collect();
        let contour = DocumentContour::from(Contour { knots: knots?, closed: is_closed != 0 });
        let glyphs = &mut document.0.glyphs;
        if glyphs.is_empty() {
            glyphs.push(faircurve_format::Glyph::default());
        }
        if let Some(last) = glyphs.last_mut() {
            last.contours.push(contour);
        }
        Ok(())
    })
}

fn knot(knot: &fc_knot) -> Result<Knot, fc_status> {
    let join = match knot.join {
        FC_JOIN_DEFAULT => None,
        FC_JOIN_CORNER => Some(Join::Corner),
        FC_JOIN_G1 => Some(Join::G1),
        FC_JOIN_G2 => Some(Join::G2),
        FC_JOIN_G4 => Some(Join::G4),
        FC_JOIN_CURVE_TO_TERMINAL => Some(Join::CurveToTerminal),
        FC_JOIN_TERMINAL_TO_CURVE => Some(Join::TerminalToCurve),
        _ => return Err(fc_status::FC_OUT_OF_RANGE),
    };
    Ok(Knot { join, ..Knot::new((knot.x, knot.y)) })
}

/// Writes a document as JSON: *json is a new string. Numbers that aren't finite are FC_BAD_DOCUMENT, with a
/// *message as in fc_document_read_json.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_document_write_json(
    document: *const fc_document,
    json: *mut *mut c_char,
    message: *mut *mut c_char,
) -> fc_status {
    // SAFETY: by contract.
    unsafe {
        explained(message, || {
            let json = place(json)?;
            *json = std::ptr::null_mut();
            *json = give_string(&json::write(&given(document)?.0)?);
            Ok(())
        })
    }
}

/// Frees a document. NULL is nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_document_free(document: *mut fc_document) {
    if !document.is_null() {
        // SAFETY: by contract, from `into_raw`.
        drop(unsafe { Box::from_raw(document) });
    }
}

/// Solves every contour. NULL options are the defaults. On FC_OK *solution is new; else it is NULL, and *message,
/// unless message is NULL, a string that says what is wrong, where, and what to do. What can't be solved as asked is
/// relaxed, not an error: see fc_relaxation_count.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_solve(
    document: *const fc_document,
    options: *const fc_options,
    solution: *mut *mut fc_solution,
    message: *mut *mut c_char,
) -> fc_status {
    // SAFETY: by contract.
    unsafe {
        explained(message, || {
            let solution = place(solution)?;
            *solution = std::ptr::null_mut();
            let solved = Solved::new(&given(document)?.0, &fc_options::read(options)?)?;
            *solution = Box::into_raw(Box::new(fc_solution(solved)));
            Ok(())
        })
    }
}

/// Writes a solution as JSON: *json is a new string. With samples above 0 every segment has that many equal
/// parts of arc length, and points, directions and curvatures at their ends.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_solution_write_json(
    solution: *const fc_solution,
    samples: usize,
    json: *mut *mut c_char,
) -> fc_status {
    /// More would be gigabytes for any contour.
    const MOST_SAMPLES: usize = 1_000_000;
    guarded(|| {
        // SAFETY: by contract.
        let (solution, json) = unsafe { (given(solution)?, place(json)?) };
        *json = std::ptr::null_mut();
        if samples > MOST_SAMPLES {
            return Err(fc_status::FC_OUT_OF_RANGE);
        }
        *json = solution.0.to_json(samples).into_raw();
        Ok(())
    })
}

/// Frees a solution. NULL is nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_solution_free(solution: *mut fc_solution) {
    if !solution.is_null() {
        // SAFETY: by contract, from `into_raw`.
        drop(unsafe { Box::from_raw(solution) });
    }
}

/// How many contours a solution has: those of all glyphs, in the document's order, counted from 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_contour_count(solution: *const fc_solution) -> usize {
    // SAFETY: by contract.
    unsafe { given(solution) }.map_or(0, |solution| solution.0.contour_count())
}

/// The name of the glyph that a contour belongs to, empty if it has none. NULL if there is no such contour.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_glyph_name(
    solution: *const fc_solution,
    contour: usize,
) -> *const c_char {
    // SAFETY: by contract.
    let names = unsafe { given(solution) }.ok().and_then(|solution| solution.0.names(contour));
    names.map_or(null(), |[glyph, _]| glyph.as_ptr())
}

/// The name of its layer, empty if it has none. NULL if there is no such contour.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_layer_name(
    solution: *const fc_solution,
    contour: usize,
) -> *const c_char {
    // SAFETY: by contract.
    let names = unsafe { given(solution) }.ok().and_then(|solution| solution.0.names(contour));
    names.map_or(null(), |[_, layer]| layer.as_ptr())
}

/// The arc length of a contour, in the drawing's units.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_length(
    solution: *const fc_solution,
    contour: usize,
    length: *mut f64,
) -> fc_status {
    guarded(|| {
        // SAFETY: by contract.
        let (solution, length) = unsafe { (given(solution)?, place(length)?) };
        *length = solution.0.curve(contour)?.length();
        Ok(())
    })
}

/// The arc length from the start of a contour to a knot. A closed contour of n knots has an n-th: its
/// start, reached again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_knot_position(
    solution: *const fc_solution,
    contour: usize,
    knot: usize,
    s: *mut f64,
) -> fc_status {
    guarded(|| {
        // SAFETY: by contract.
        let (solution, s) = unsafe { (given(solution)?, place(s)?) };
        *s = solution.0.knot_position(contour, knot)?;
        Ok(())
    })
}

/// Point, direction and curvature at an arc length from the start of a contour, clamped to its ends. Where
/// two segments meet, those of the later one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_at(
    solution: *const fc_solution,
    contour: usize,
    s: f64,
    point: *mut fc_point,
) -> fc_status {
    guarded(|| {
        // SAFETY: by contract.
        let (solution, point) = unsafe { (given(solution)?, place(point)?) };
        let at = solution.0.at(contour, s)?;
        *point = fc_point {
            x: at.point.x,
            y: at.point.y,
            direction: at.direction,
            curvature: at.curvature,
        };
        Ok(())
    })
}

/// Hands the pieces of a contour to a function, in order, with that data.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_beziers(
    solution: *const fc_solution,
    contour: usize,
    function: fc_element_function,
    data: *mut c_void,
) -> fc_status {
    guarded(|| {
        // SAFETY: by contract.
        let solution = unsafe { given(solution)? };
        let function = function.ok_or(fc_status::FC_NULL_ARGUMENT)?;
        for element in solution.0.elements(contour)? {
            // SAFETY: by contract, the function takes this and that data.
            unsafe { function(&element, data) };
        }
        Ok(())
    })
}

/// Copies the pieces of a contour into an array that has room for so many. *count is how many pieces there are, on
/// FC_TOO_SMALL, too; then nothing is copied. With a capacity of 0 the array may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_beziers_into(
    solution: *const fc_solution,
    contour: usize,
    elements: *mut fc_element,
    capacity: usize,
    count: *mut usize,
) -> fc_status {
    guarded(|| {
        // SAFETY: by contract.
        let (solution, count) = unsafe { (given(solution)?, place(count)?) };
        let pieces = solution.0.elements(contour)?;
        *count = pieces.len();
        if *count > capacity {
            return Err(fc_status::FC_TOO_SMALL);
        }
        // SAFETY: by contract.
        let elements = unsafe { place(elements)? as *mut fc_element };
        for (i, piece) in pieces.enumerate() {
            // SAFETY: i < count ≤ capacity.
            unsafe { elements.add(i).write(piece) };
        }
        Ok(())
    })
}

/// In how many places a contour could not be solved as asked; 0 if there is no such contour.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_relaxation_count(
    solution: *const fc_solution,
    contour: usize,
) -> usize {
    // SAFETY: by contract.
    let solution = unsafe { given(solution) };
    solution.and_then(|solution| Ok(solution.0.relaxed(contour)?.len())).unwrap_or(0)
}

/// One of these: where, what was asked, what holds instead, and why.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fc_relaxation_at(
    solution: *const fc_solution,
    contour: usize,
    index: usize,
    relaxation: *mut fc_relaxation,
) -> fc_status {
    guarded(|| {
        // SAFETY: by contract.
        let (solution, relaxation) = unsafe { (given(solution)?, place(relaxation)?) };
        let relaxed = solution.0.relaxed(contour)?.get(index).ok_or(fc_status::FC_OUT_OF_RANGE)?;
        let (is_segment, index) = match relaxed.place {
            Place::Knot(index) => (0, index),
            Place::Segment(index) => (1, index),
        };
        *relaxation = fc_relaxation {
            is_segment,
            index,
            asked: relaxed.asked.as_ptr(),
            got: relaxed.got.as_ptr(),
            reason: relaxed.reason.as_ptr(),
        };
        Ok(())
    })
}
