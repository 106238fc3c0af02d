//! A contour solved, and drawn as the calls that a caller of libspiro gets.

use std::ffi::c_int;

use faircurve::kurbo::Point;
use faircurve::{Contour, Segment, Solution, catalog, solve};

use crate::abi::INCLUDE_LAST_KNOT;
use crate::pieces::{Kind, Piece};

/// Solves with the spline `spiro`; `None` for contours in which a number has no meaning.
pub(crate) fn solved(contour: &Contour) -> Option<Solution> {
    let spiro = catalog::spline("spiro").ok()?;
    solve(contour, &*spiro).ok()
}

/// One call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Call {
    /// Starts the contour, and says whether it is open.
    Move(Point, bool),
    /// The knot of that number is here.
    Knot(usize),
    /// A piece.
    Piece(Piece),
}

/// The calls for a curve that starts at a point, of which each segment is the span from one knot to the
/// next: the start, then for each span its knot and its pieces. At the end of an open contour the last
/// knot, if the flags ask for it.
pub(crate) fn calls(start: Point, segments: &[Segment], open: bool, ncq: c_int) -> Vec<Call> {
    let kind = Kind::of(ncq);
    let mut calls = vec![Call::Move(start, open)];
    for (knot, segment) in segments.iter().enumerate() {
        calls.push(Call::Knot(knot));
        calls.extend(kind.pieces(segment).into_iter().map(Call::Piece));
    }
    if open && ncq & INCLUDE_LAST_KNOT != 0 {
        calls.push(Call::Knot(segments.len()));
    }
    calls
}

/// A contour solved and drawn; `None` for contours in which a number has no meaning.
pub(crate) fn draw(contour: &Contour, ncq: c_int) -> Option<Vec<Call>> {
    let solution = solved(contour)?;
    let start = contour.knots.first()?.point;
    Some(calls(start, solution.curve.segments(), !contour.closed, ncq))
}
