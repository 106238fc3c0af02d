//! Hands calls to a caller's context, or keeps them in one of our own.

use std::ffi::{c_char, c_int};

use faircurve::kurbo::Point;

use crate::abi::{BezCtx, CurveData, INTERNAL_BEZCTX, LsBezCtx};
use crate::drawing::Call;
use crate::pieces::Piece;

/// Makes the calls; those whose callback is NULL are left out.
///
/// # Safety
/// `context` points to a [`BezCtx`] whose callbacks may be called with it; or, if the flags have
/// [`INTERNAL_BEZCTX`], to a [`LsBezCtx`] from [`create`].
pub(crate) unsafe fn hand_over(calls: &[Call], ncq: c_int, context: *mut BezCtx) {
    if ncq & INTERNAL_BEZCTX != 0 {
        // SAFETY: by contract.
        unsafe { keep(calls, context.cast()) }
    } else {
        // SAFETY: by contract.
        unsafe { call(calls, context) }
    }
}

/// # Safety
/// As for [`hand_over`], without the flag.
unsafe fn call(calls: &[Call], context: *mut BezCtx) {
    for call in calls {
        // Read anew each time: a callback may change them.
        // SAFETY (of all calls here): by contract.
        match *call {
            Call::Move(at, open) => {
                if let Some(moveto) = unsafe { (*context).moveto } {
                    unsafe { moveto(context, at.x, at.y, c_int::from(open)) }
                }
            }
            Call::Knot(knot) => {
                if let Some(mark_knot) = unsafe { (*context).mark_knot } {
                    unsafe { mark_knot(context, knot as c_int) }
                }
            }
            Call::Piece(Piece::Line(end)) => {
                if let Some(lineto) = unsafe { (*context).lineto } {
                    unsafe { lineto(context, end.x, end.y) }
                }
            }
            Call::Piece(Piece::Quad(p1, end)) => {
                if let Some(quadto) = unsafe { (*context).quadto } {
                    unsafe { quadto(context, p1.x, p1.y, end.x, end.y) }
                }
            }
            Call::Piece(Piece::Cubic(p1, p2, end)) => {
                if let Some(curveto) = unsafe { (*context).curveto } {
                    unsafe { curveto(context, p1.x, p1.y, p2.x, p2.y, end.x, end.y) }
                }
            }
        }
    }
}

/// # Safety
/// As for [`hand_over`], with the flag.
unsafe fn keep(calls: &[Call], context: *mut LsBezCtx) {
    // SAFETY: by contract.
    let context = unsafe { &mut *context };
    let mut pen = match usize::try_from(context.l) {
        // SAFETY: entries below `l` are initialised, and `l` is at most `max`.
        Ok(count) if count > 0 => unsafe { (*context.cd.add(count - 1)).end() },
        _ => Point::ZERO,
    };
    for call in calls {
        let (letter, points) = match *call {
            Call::Move(at, open) => {
                context.is_open = c_int::from(open);
                (b'm', vec![pen, at])
            }
            Call::Knot(_) => (b'k', vec![pen]),
            Call::Piece(Piece::Line(end)) => (b'l', vec![pen, end]),
            Call::Piece(Piece::Quad(p1, end)) => (b'q', vec![pen, p1, end]),
            Call::Piece(Piece::Cubic(p1, p2, end)) => (b'c', vec![pen, p1, p2, end]),
        };
        pen = points.last().copied().unwrap_or(pen);
        if context.l < 0 || context.l >= context.max {
            context.l = -1;
            continue;
        }
        let mut entry = CurveData { ty: letter as c_char, ..CurveData::default() };
        for (kept, point) in entry.points.iter_mut().zip(points) {
            *kept = [point.x, point.y];
        }
        // SAFETY: 0 ≤ l < max, and the array holds `max` entries.
        unsafe { context.cd.add(context.l as usize).write(entry) };
        context.l += 1;
    }
}

impl CurveData {
    /// Where the pen is after it.
    fn end(&self) -> Point {
        let last = match self.ty as u8 {
            b'k' => 0,
            b'm' | b'l' => 1,
            b'q' => 2,
            _ => 3,
        };
        Point::new(self.points[last][0], self.points[last][1])
    }
}

/// A context that keeps at most `max` calls, to be freed with [`free`]; NULL without the flag
/// [`INTERNAL_BEZCTX`], without room, or without memory.
pub(crate) fn create(max: c_int, ncq: c_int) -> *mut LsBezCtx {
    let Some(count) = usize::try_from(max).ok().filter(|count| *count > 0) else {
        return std::ptr::null_mut();
    };
    if ncq & INTERNAL_BEZCTX == 0 {
        return std::ptr::null_mut();
    }
    // SAFETY: zeros are valid for both structs: NULL callbacks, numbers 0. What one `calloc` gave and the
    // other didn't is freed.
    unsafe {
        let context: *mut LsBezCtx = libc::calloc(1, size_of::<LsBezCtx>()).cast();
        let data: *mut CurveData = libc::calloc(count, size_of::<CurveData>()).cast();
        if context.is_null() || data.is_null() {
            libc::free(context.cast());
            libc::free(data.cast());
            return std::ptr::null_mut();
        }
        ((*context).cd, (*context).max) = (data, max);
        context
    }
}

/// Frees it; NULL is nothing.
///
/// # Safety
/// `context` is NULL or from [`create`], and not freed yet.
pub(crate) unsafe fn free(context: *mut LsBezCtx) {
    if !context.is_null() {
        // SAFETY: by contract.
        unsafe {
            libc::free((*context).cd.cast());
            libc::free(context.cast());
        }
    }
}
