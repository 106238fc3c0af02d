//! `libspiro.so.1` on faircurve's solver.
//!
//! The 18 functions of libspiro's interface, for FontForge, Ipe, GEGL and whatever else calls it. What
//! each promises is in the headers (`include/`) and the manual page (`man/libspiro.3`); where it
//! differs from libspiro, in `docs/c-api.md`.
//!
//! This file and `pen.rs` alone touch the caller's memory: they make slices of pointers and hand results
//! back. No state outlives a call, and a panic ends in the answer "failed". The functions that C sees don't call each
//! other: where another libspiro is loaded too, such calls could end there.
#![expect(unsafe_code, reason = "this is the boundary to C")]

pub mod abi;
mod drawing;
mod pen;
mod pieces;
mod points;
mod segments;

use std::ffi::{c_char, c_double, c_int};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::null_mut;

use abi::{BezCtx, LsBezCtx, RETRO_VER1, REVERSE_SRC, SpiroCp, SpiroSeg};
use drawing::Call;
use points::{Form, Points};
use segments::Scale;

/// The version of libspiro whose interface this is, and our own.
const VERSION: &str = concat!("1.5 (faircurve ", env!("CARGO_PKG_VERSION"), ")\0");

const DONE: c_int = 1;
const FAILED: c_int = 0;

/// What `work` returns; `failed` if it panics.
fn guarded<T>(failed: T, work: impl FnOnce() -> T) -> T {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or(failed)
}

/// The list up to its end mark.
///
/// # Safety
/// `first` points to a list with an end mark, or is NULL.
unsafe fn tagged_length(first: *const SpiroCp) -> Option<usize> {
    if first.is_null() {
        return None;
    }
    let mut length = 0;
    loop {
        // SAFETY: no entry before this one was an end mark, so that it is in the list.
        let letter = unsafe { (*first.add(length)).letter() };
        length += 1;
        if points::is_end_mark(letter) {
            return Some(length);
        }
    }
}

/// A count that says something.
fn counted(n: c_int) -> Option<usize> {
    usize::try_from(n).ok().filter(|n| *n > 0)
}

/// Solves and draws.
///
/// # Safety
/// `first` points to `length` points, which nobody else uses meanwhile; `bc` to a context as the flags
/// say. Either may be NULL.
unsafe fn draw(
    first: *mut SpiroCp,
    length: Option<usize>,
    form: Form,
    ncq: c_int,
    bc: *mut BezCtx,
) -> c_int {
    let Some(length) = length.filter(|_| !first.is_null() && !bc.is_null()) else {
        return FAILED;
    };
    let calls = || {
        if ncq & REVERSE_SRC != 0 {
            // SAFETY: by contract; the slice ends here.
            points::reverse(unsafe { std::slice::from_raw_parts_mut(first, length) });
        }
        // SAFETY: by contract.
        let list = unsafe { std::slice::from_raw_parts(first, length) };
        let points = Points::read(list, form).filter(|_| points::is_finite(list))?;
        drawing::draw(&points.contour, ncq)
    };
    // SAFETY: by contract.
    unsafe { hand_over(calls, ncq, bc) }
}

/// Hands what `calls` comes to to the caller's context; nothing where that is nothing, or it panics.
///
/// # Safety
/// As for [`pen::hand_over`].
unsafe fn hand_over(
    calls: impl FnOnce() -> Option<Vec<Call>>,
    ncq: c_int,
    bc: *mut BezCtx,
) -> c_int {
    let Some(calls) = guarded(None, calls) else { return FAILED };
    // SAFETY: by contract.
    guarded(FAILED, || unsafe {
        pen::hand_over(&calls, ncq, bc);
        DONE
    })
}

/// Solves and draws a list with an end mark.
///
/// # Safety
/// As for [`TaggedSpiroCPsToBezier2`].
unsafe fn draw_tagged(spiros: *mut SpiroCp, ncq: c_int, bc: *mut BezCtx) -> c_int {
    // SAFETY: by contract.
    unsafe { draw(spiros, tagged_length(spiros), Form::Tagged, ncq, bc) }
}

/// Solves and draws a list of `n` points.
///
/// # Safety
/// As for [`SpiroCPsToBezier2`].
unsafe fn draw_counted(
    spiros: *mut SpiroCp,
    n: c_int,
    ncq: c_int,
    isclosed: c_int,
    bc: *mut BezCtx,
) -> c_int {
    let form = if isclosed != 0 { Form::Closed } else { Form::Open };
    // SAFETY: by contract.
    unsafe { draw(spiros, counted(n), form, ncq, bc) }
}

/// Solves a list with an end mark and draws the curve: 1, or 0 and nothing is drawn.
///
/// # Safety
/// `spiros` is NULL or points to a list with an end mark; `bc` is NULL or points to a context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn TaggedSpiroCPsToBezier2(
    spiros: *mut SpiroCp,
    ncq: c_int,
    bc: *mut BezCtx,
) -> c_int {
    // SAFETY: by contract.
    unsafe { draw_tagged(spiros, ncq, bc) }
}

/// Solves a list of `n` points and draws the curve: 1, or 0 and nothing is drawn.
///
/// # Safety
/// `spiros` is NULL or points to `n` points; `bc` is NULL or points to a context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn SpiroCPsToBezier2(
    spiros: *mut SpiroCp,
    n: c_int,
    ncq: c_int,
    isclosed: c_int,
    bc: *mut BezCtx,
) -> c_int {
    // SAFETY: by contract.
    unsafe { draw_counted(spiros, n, ncq, isclosed, bc) }
}

/// [`TaggedSpiroCPsToBezier2`] without flags.
///
/// # Safety
/// As there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn TaggedSpiroCPsToBezier0(spiros: *mut SpiroCp, bc: *mut BezCtx) -> c_int {
    // SAFETY: by contract.
    unsafe { draw_tagged(spiros, 0, bc) }
}

/// [`SpiroCPsToBezier2`] without flags.
///
/// # Safety
/// As there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn SpiroCPsToBezier0(
    spiros: *mut SpiroCp,
    n: c_int,
    isclosed: c_int,
    bc: *mut BezCtx,
) -> c_int {
    // SAFETY: by contract.
    unsafe { draw_counted(spiros, n, 0, isclosed, bc) }
}

/// [`TaggedSpiroCPsToBezier0`] with its answer in `done`.
///
/// # Safety
/// As there; `done` is NULL or points to an `int`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn TaggedSpiroCPsToBezier1(
    spiros: *mut SpiroCp,
    bc: *mut BezCtx,
    done: *mut c_int,
) {
    // SAFETY: by contract.
    unsafe {
        let answer = draw_tagged(spiros, 0, bc);
        if let Some(done) = done.as_mut() {
            *done = answer;
        }
    }
}

/// [`SpiroCPsToBezier0`] with its answer in `done`.
///
/// # Safety
/// As there; `done` is NULL or points to an `int`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn SpiroCPsToBezier1(
    spiros: *mut SpiroCp,
    n: c_int,
    isclosed: c_int,
    bc: *mut BezCtx,
    done: *mut c_int,
) {
    // SAFETY: by contract.
    unsafe {
        let answer = draw_counted(spiros, n, 0, isclosed, bc);
        if let Some(done) = done.as_mut() {
            *done = answer;
        }
    }
}

/// [`TaggedSpiroCPsToBezier0`] without an answer.
///
/// # Safety
/// As there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn TaggedSpiroCPsToBezier(spiros: *mut SpiroCp, bc: *mut BezCtx) {
    // SAFETY: by contract.
    unsafe { draw_tagged(spiros, 0, bc) };
}

/// [`SpiroCPsToBezier0`] without an answer.
///
/// # Safety
/// As there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn SpiroCPsToBezier(
    spiros: *mut SpiroCp,
    n: c_int,
    isclosed: c_int,
    bc: *mut BezCtx,
) {
    // SAFETY: by contract.
    unsafe { draw_counted(spiros, n, 0, isclosed, bc) };
}

/// Solves a list as [`run_spiro0`] says.
///
/// # Safety
/// As there.
unsafe fn solve_array(
    src: *const SpiroCp,
    dm: *mut c_double,
    ncq: c_int,
    n: c_int,
) -> *mut SpiroSeg {
    let solved = guarded(None, || {
        let length = counted(n).filter(|_| !src.is_null())?;
        // SAFETY: by contract.
        let list = unsafe { std::slice::from_raw_parts(src, length) };
        let points = Points::read(list, Form::Tagged).filter(|_| points::is_finite(list))?;
        let solution = drawing::solved(&points.contour)?;
        let scale = Scale::of(&points, ncq);
        Some((segments::array(list, &points, &solution, scale), scale))
    });
    let place = |numbers: [f64; 3]| {
        if !dm.is_null() {
            // SAFETY: by contract.
            unsafe { dm.cast::<[f64; 3]>().write(numbers) }
        }
    };
    let Some((array, scale)) = solved else {
        place([-1.0, 0.0, 0.0]);
        return null_mut();
    };
    // SAFETY: enough room for the entries, which are copied if there is any.
    unsafe {
        let first: *mut SpiroSeg = libc::calloc(array.len(), size_of::<SpiroSeg>()).cast();
        if first.is_null() {
            place([-1.0, 0.0, 0.0]);
            return first;
        }
        first.copy_from_nonoverlapping(array.as_ptr(), array.len());
        place([scale.scale, scale.centre.x, scale.centre.y]);
        first
    }
}

/// Solves a list of `n` points, its end mark included: an array of `n` segments, to be freed with
/// [`free_spiro`], or NULL. `dm` gets the scale and the centre: a place of the array times the scale plus
/// the centre is one of the caller's; after a failure the scale is −1.
///
/// # Safety
/// `src` is NULL or points to `n` points; `dm` is NULL or points to 3 numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn run_spiro0(
    src: *const SpiroCp,
    dm: *mut c_double,
    ncq: c_int,
    n: c_int,
) -> *mut SpiroSeg {
    // SAFETY: by contract.
    unsafe { solve_array(src, dm, ncq, n) }
}

/// [`run_spiro0`] in the caller's units.
///
/// # Safety
/// As there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn run_spiro(src: *const SpiroCp, n: c_int) -> *mut SpiroSeg {
    // SAFETY: by contract.
    unsafe { solve_array(src, null_mut(), RETRO_VER1, n) }
}

/// Frees an array; NULL is nothing.
///
/// # Safety
/// `s` is NULL or from [`run_spiro0`] or [`run_spiro`], and not freed yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn free_spiro(s: *mut SpiroSeg) {
    // SAFETY: by contract.
    unsafe { libc::free(s.cast()) }
}

/// Draws an array as [`spiro_to_bpath0`] says.
///
/// # Safety
/// As there.
unsafe fn draw_array(
    src: *const SpiroCp,
    s: *const SpiroSeg,
    dm: *mut c_double,
    ncq: c_int,
    n: c_int,
    bc: *mut BezCtx,
) -> c_int {
    let Some(length) = counted(n).filter(|_| !s.is_null() && !bc.is_null()) else {
        return FAILED;
    };
    let calls = || {
        // SAFETY: by contract.
        let (array, source) = unsafe {
            let source = (!src.is_null()).then(|| std::slice::from_raw_parts(src, length));
            (std::slice::from_raw_parts(s, length), source)
        };
        // SAFETY: by contract.
        let scale = match unsafe { dm.cast::<[f64; 3]>().as_ref() } {
            Some(&[scale, x, y]) => Scale { scale, centre: (x, y).into() },
            None => Scale::ONE,
        };
        let placed = segments::placed(array, source, scale)?;
        Some(drawing::calls(placed.start, &placed.segments, placed.open, ncq))
    };
    // SAFETY: by contract.
    unsafe { hand_over(calls, ncq, bc) }
}

/// Draws an array: 1, or 0 and nothing is drawn. With `src`, the points that it was made of, curves end
/// on them to the bit; else `dm` says where they are.
///
/// # Safety
/// `s` is NULL or points to `n` segments of such an array, its end mark included or not; `src` is NULL
/// or points to as many points; `dm` is NULL or points to 3 numbers; `bc` is NULL or points to a context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiro_to_bpath0(
    src: *const SpiroCp,
    s: *const SpiroSeg,
    dm: *mut c_double,
    ncq: c_int,
    n: c_int,
    bc: *mut BezCtx,
) -> c_int {
    // SAFETY: by contract.
    unsafe { draw_array(src, s, dm, ncq, n, bc) }
}

/// [`spiro_to_bpath0`] for an array in the caller's units.
///
/// # Safety
/// As there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiro_to_bpath(s: *const SpiroSeg, n: c_int, bc: *mut BezCtx) {
    // SAFETY: by contract.
    unsafe { draw_array(std::ptr::null(), s, null_mut(), 0, n, bc) };
}

/// The direction at the end of segment `i` − 1 of an array, or for 0 at the start of segment 0, in radians.
///
/// # Safety
/// `s` is NULL or points to at least `i` segments, and at least one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn get_knot_th(s: *const SpiroSeg, i: c_int) -> c_double {
    let Some(i) = usize::try_from(i).ok().filter(|_| !s.is_null()) else { return 0.0 };
    // SAFETY: by contract.
    let entry = unsafe { *s.add(i.saturating_sub(1)) };
    let [start, end] = guarded([0.0; 2], || segments::directions(&entry));
    if i == 0 { start } else { end }
}

/// Turns a list of `n` points round, in place: 0, or −1 if there is none.
///
/// # Safety
/// `src` is NULL or points to `n` points, which nobody else uses meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiroreverse(src: *mut SpiroCp, n: c_int) -> c_int {
    let Some(length) = counted(n).filter(|_| !src.is_null()) else { return -1 };
    // SAFETY: by contract.
    guarded(-1, || {
        points::reverse(unsafe { std::slice::from_raw_parts_mut(src, length) });
        0
    })
}

/// A context that keeps at most `max` calls, to be freed with [`free_ls_bezctx`]; NULL without the flag
/// `SPIRO_INTERNAL_BEZCTX`, without room, or without memory.
#[unsafe(no_mangle)]
pub extern "C" fn new_ls_bezctx(max: c_int, ncq: c_int) -> *mut LsBezCtx {
    guarded(null_mut(), || pen::create(max, ncq))
}

/// Frees a context; NULL is nothing.
///
/// # Safety
/// `bd` is NULL or from [`new_ls_bezctx`], and not freed yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn free_ls_bezctx(bd: *mut LsBezCtx) {
    // SAFETY: by contract.
    unsafe { pen::free(bd) }
}

/// `1.5`, the libspiro whose interface this is, and what it is in truth.
#[unsafe(no_mangle)]
pub extern "C" fn LibSpiroVersion() -> *const c_char {
    VERSION.as_ptr().cast()
}
