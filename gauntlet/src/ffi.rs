//! The system's libspiro, called through its C interface (written from its public headers
//! `spiro.h`, `spiroentrypoints.h` and `bezctx.h`) and wrapped so that no `unsafe` leaves this file.
//!
//! What the headers leave open was found by experiment with version 1:20221101:
//! - `ks` are k₀ … k₃ of thesis eq. 8.1, for arc length 1; `seg_ch` and `seg_th` are length and
//!   direction of the chord. `l` is not set.
//! - `get_knot_th(s, i)` is the direction at the *end* of segment i − 1; for i = 0 that at the start
//!   of segment 0. At corners it therefore reports the incoming side.
//! - `run_spiro0` fills `dm` with scale and centre (3 numbers; the first is −1 after a failure)
//!   and `x`, `y` of the segments are scaled by them. `SPIRO_RETRO_VER1` switches that off.
//! - The count `n` includes the closing `z` or `}`. Two points in all, or all in one place, come
//!   back as a success full of NaN.

#![cfg(libspiro)]
#![allow(unsafe_code)]

use std::ffi::{CStr, c_char, c_double, c_int};

use faircurve::kurbo::BezPath;

/// `spiro_cp`: a point and its letter.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SpiroCp {
    pub(crate) x: c_double,
    pub(crate) y: c_double,
    pub(crate) ty: c_char,
}

impl SpiroCp {
    /// A point with one of libspiro's letters, which are all ASCII.
    pub(crate) fn new(x: f64, y: f64, letter: u8) -> Self {
        SpiroCp { x, y, ty: letter as c_char }
    }
}

/// `spiro_seg`: a segment's parameters and its chord.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpiroSeg {
    pub(crate) x: c_double,
    pub(crate) y: c_double,
    pub(crate) ty: c_char,
    pub(crate) bend_th: c_double,
    pub(crate) ks: [c_double; 4],
    pub(crate) seg_ch: c_double,
    pub(crate) seg_th: c_double,
    pub(crate) l: c_double,
}

/// `bezctx`: what receives the Béziers. Debian's libspiro needs every callback to be set.
#[repr(C)]
struct BezCtx {
    moveto: extern "C" fn(*mut BezCtx, c_double, c_double, c_int),
    lineto: extern "C" fn(*mut BezCtx, c_double, c_double),
    quadto: extern "C" fn(*mut BezCtx, c_double, c_double, c_double, c_double),
    curveto: extern "C" fn(*mut BezCtx, c_double, c_double, c_double, c_double, c_double, c_double),
    mark_knot: extern "C" fn(*mut BezCtx, c_int),
}

unsafe extern "C" {
    fn run_spiro0(src: *const SpiroCp, dm: *mut c_double, ncq: c_int, n: c_int) -> *mut SpiroSeg;
    fn free_spiro(s: *mut SpiroSeg);
    fn get_knot_th(s: *const SpiroSeg, i: c_int) -> c_double;
    fn TaggedSpiroCPsToBezier0(spiros: *mut SpiroCp, bc: *mut BezCtx) -> c_int;
    fn LibSpiroVersion() -> *const c_char;
}

/// The library's version.
pub(crate) fn version() -> String {
    // SAFETY: returns a pointer to a static string.
    unsafe { CStr::from_ptr(LibSpiroVersion()) }.to_string_lossy().into_owned()
}

/// Solved segments, owned by libspiro and freed when dropped.
#[derive(Debug)]
pub(crate) struct SolvedSegments {
    first: *mut SpiroSeg,
    count: usize,
}

/// Whether libspiro's list is one that it may be given: marked at its end, with the three distinct
/// entries (including a closing `z`) below which it reads uninitialised memory.
pub(crate) fn is_well_formed(points: &[SpiroCp]) -> bool {
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return false;
    };
    let is = |point: &SpiroCp, letter: u8| point.ty == letter as c_char;
    let marked = if is(first, b'{') { is(last, b'}') } else { is(last, b'z') };
    marked && points.len() >= 3 && c_int::try_from(points.len()).is_ok()
}

impl SolvedSegments {
    /// Solves a list of points that starts with `{` and ends with `}`, or ends with `z`. `None` if
    /// libspiro refuses it, and for lists of fewer than three entries, which it doesn't check.
    pub(crate) fn solve(points: &[SpiroCp]) -> Option<Self> {
        if !is_well_formed(points) {
            return None;
        }
        // Three numbers are written; the fourth is caution.
        let mut scale_and_centre = [0.0; 4];
        // SAFETY: `points` holds the count of entries that is passed and is only read; the list is
        // marked at its end as the library expects.
        let first = unsafe {
            run_spiro0(points.as_ptr(), scale_and_centre.as_mut_ptr(), 0, points.len() as c_int)
        };
        // An open list of n points has n − 1 segments; so has a closed one with its `z`.
        let count = points.len() - 1;
        (!first.is_null()).then_some(SolvedSegments { first, count })
    }

    /// The segments in order.
    pub(crate) fn segments(&self) -> &[SpiroSeg] {
        // SAFETY: the library returned an array of at least `count` initialised segments, which
        // lives until `drop`.
        unsafe { std::slice::from_raw_parts(self.first, self.count) }
    }

    /// The direction at the end of segment `knot` − 1, or for 0 at the start of segment 0. `None`
    /// beyond the last segment's end.
    pub(crate) fn knot_direction(&self, knot: usize) -> Option<f64> {
        // SAFETY: the library reads segment `knot` − 1 (or 0), which exists.
        (knot <= self.count).then(|| unsafe { get_knot_th(self.first, knot as c_int) })
    }
}

impl Drop for SolvedSegments {
    fn drop(&mut self) {
        // SAFETY: `first` came from the library and is freed once.
        unsafe { free_spiro(self.first) }
    }
}

/// Whether `TaggedSpiroCPsToBezier0`, the entry point that FontForge uses, returns 1, with callbacks
/// that do nothing. False for lists that [`SolvedSegments::solve`] doesn't pass on.
pub(crate) fn returns_one(points: &[SpiroCp]) -> bool {
    extern "C" fn moveto(_: *mut BezCtx, _: f64, _: f64, _: c_int) {}
    extern "C" fn lineto(_: *mut BezCtx, _: f64, _: f64) {}
    extern "C" fn quadto(_: *mut BezCtx, _: f64, _: f64, _: f64, _: f64) {}
    extern "C" fn curveto(_: *mut BezCtx, _: f64, _: f64, _: f64, _: f64, _: f64, _: f64) {}
    extern "C" fn mark_knot(_: *mut BezCtx, _: c_int) {}
    if !is_well_formed(points) {
        return false;
    }
    let mut points = points.to_vec();
    let mut context = BezCtx { moveto, lineto, quadto, curveto, mark_knot };
    // SAFETY: the list is marked at its end and ours to change; the context outlives the call.
    unsafe { TaggedSpiroCPsToBezier0(points.as_mut_ptr(), &mut context) == 1 }
}

/// A context that keeps what it receives: libspiro passes back the pointer to its first field.
#[repr(C)]
struct PathContext {
    callbacks: BezCtx,
    path: BezPath,
}

/// The Béziers of `TaggedSpiroCPsToBezier0`; `None` if it returns 0, and for lists that
/// [`SolvedSegments::solve`] doesn't pass on.
pub(crate) fn beziers(points: &[SpiroCp]) -> Option<BezPath> {
    /// # Safety
    /// `context` must be the first field of a [`PathContext`].
    unsafe fn path<'a>(context: *mut BezCtx) -> &'a mut BezPath {
        // SAFETY: by contract; the struct is `repr(C)`, so that its first field shares its address.
        unsafe { &mut (*context.cast::<PathContext>()).path }
    }
    extern "C" fn moveto(context: *mut BezCtx, x: f64, y: f64, _: c_int) {
        // SAFETY: the pointer that was passed in below.
        unsafe { path(context) }.move_to((x, y));
    }
    extern "C" fn lineto(context: *mut BezCtx, x: f64, y: f64) {
        // SAFETY: as above.
        unsafe { path(context) }.line_to((x, y));
    }
    extern "C" fn quadto(context: *mut BezCtx, x1: f64, y1: f64, x: f64, y: f64) {
        // SAFETY: as above.
        unsafe { path(context) }.quad_to((x1, y1), (x, y));
    }
    extern "C" fn curveto(
        context: *mut BezCtx,
        x1: f64,
        y1: f64,
        x2: f64,
        y2: f64,
        x: f64,
        y: f64,
    ) {
        // SAFETY: as above.
        unsafe { path(context) }.curve_to((x1, y1), (x2, y2), (x, y));
    }
    extern "C" fn mark_knot(_: *mut BezCtx, _: c_int) {}
    if !is_well_formed(points) {
        return None;
    }
    let mut points = points.to_vec();
    let callbacks = BezCtx { moveto, lineto, quadto, curveto, mark_knot };
    let mut context = PathContext { callbacks, path: BezPath::new() };
    // SAFETY: the list is marked at its end and ours to change; the context outlives the call, and the
    // pointer is to the whole of it.
    let done = unsafe {
        TaggedSpiroCPsToBezier0(points.as_mut_ptr(), (&raw mut context).cast::<BezCtx>())
    };
    (done == 1).then_some(context.path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_structs_have_the_sizes_of_the_c_ones() {
        assert_eq!((size_of::<SpiroCp>(), size_of::<SpiroSeg>()), (24, 88));
    }

    #[test]
    fn a_circle_comes_back_as_four_quarter_arcs() {
        let circle = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)]
            .map(|(x, y)| SpiroCp::new(500.0 * x, 500.0 * y, b'o'));
        let mut points = circle.to_vec();
        points.push(SpiroCp::new(0.0, 0.0, b'z'));
        assert!(returns_one(&points));
        let solved = SolvedSegments::solve(&points).unwrap();
        assert_eq!(solved.segments().len(), 4);
        for segment in solved.segments() {
            assert!((segment.ks[0] - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
        }
        let up = solved.knot_direction(0).unwrap();
        assert!((up - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
        assert_eq!(solved.knot_direction(5), None);
    }

    #[test]
    fn lists_that_it_would_misread_are_kept_from_it() {
        let end = SpiroCp::new(1.0, 0.0, b'}');
        assert!(SolvedSegments::solve(&[]).is_none());
        assert!(SolvedSegments::solve(&[SpiroCp::new(0.0, 0.0, b'{'), end]).is_none());
        assert!(!returns_one(&[SpiroCp::new(0.0, 0.0, b'o'); 5]));
    }
}
