//! Solved contours as libspiro's arrays of segments, and back.

use std::ffi::c_int;

use faircurve::frame::{direction, turning, wrap_angle};
use faircurve::kurbo::{Point, Vec2};
use faircurve::{Join, PolynomialSpiral, Segment, Solution};

use crate::abi::{RETRO_VER1, SpiroCp, SpiroSeg};
use crate::points::{Points, is_end_mark};

/// How the array's places and lengths are those of the caller: x·scale + centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    pub(crate) scale: f64,
    pub(crate) centre: Vec2,
}

impl Scale {
    /// The caller's own units.
    pub(crate) const ONE: Scale = Scale { scale: 1.0, centre: Vec2::ZERO };

    /// The larger side of the drawing becomes 500 units long, as in libspiro; with [`RETRO_VER1`], or
    /// where it has no size, nothing changes.
    pub(crate) fn of(points: &Points, ncq: c_int) -> Scale {
        const SIDE: f64 = 500.0;
        let knots = &points.contour.knots;
        let (mut low, mut high) = (knots[0].point, knots[0].point);
        for knot in knots {
            low = Point::new(low.x.min(knot.point.x), low.y.min(knot.point.y));
            high = Point::new(high.x.max(knot.point.x), high.y.max(knot.point.y));
        }
        let scale = (high.x - low.x).max(high.y - low.y) / SIDE;
        if ncq & RETRO_VER1 != 0 || !(scale > 0.0) {
            return Scale::ONE;
        }
        Scale { scale, centre: low.midpoint(high).to_vec2() }
    }

    fn inward(self, point: Point) -> Point {
        ((point.to_vec2() - self.centre) / self.scale).to_point()
    }

    fn outward(self, point: Point) -> Point {
        (point.to_vec2() * self.scale + self.centre).to_point()
    }
}

/// The array: an entry for each point of the list, its end mark included. That of an anchor leads to its
/// handle, which is in the same place, and is straight; that of the end has only a place and a letter.
pub(crate) fn array(
    list: &[SpiroCp],
    points: &Points,
    solution: &Solution,
    scale: Scale,
) -> Vec<SpiroSeg> {
    let mut array: Vec<SpiroSeg> =
        list.iter().map(|cp| SpiroSeg { ty: cp.ty, ..SpiroSeg::default() }).collect();
    let segments = solution.curve.segments();
    let count = points.contour.knots.len();
    let chord =
        |i: usize| points.contour.knots[(i + 1) % count].point - points.contour.knots[i].point;
    for (i, &place) in points.places.iter().enumerate() {
        let at = scale.inward(points.contour.knots[i].point);
        (array[place].x, array[place].y) = (at.x, at.y);
        let arrives = i > 0 || points.contour.closed;
        let turns = arrives && i < segments.len() && solution.knots[i].join != Join::Corner;
        let bend_th = if turns { turning(chord((i + count - 1) % count), chord(i)) } else { 0.0 };
        array[place].bend_th = bend_th;
        let mut place = place;
        if let Some(handle) = handle_of(list, place) {
            let toward = points.contour.knots[i].tangent_out.unwrap_or_default();
            array[place].seg_ch = toward.hypot() / scale.scale;
            array[place].seg_th = direction(toward);
            array[place].l = array[place].seg_ch;
            place = handle;
            (array[place].x, array[place].y, array[place].bend_th) = (at.x, at.y, bend_th);
        }
        if let Some(segment) = segments.get(i) {
            let entry = &mut array[place];
            entry.ks = segment.kappa().unwrap_or_default();
            entry.seg_ch = segment.chord_length() / scale.scale;
            entry.seg_th = if segment.length() > 0.0 { direction(chord(i)) } else { 0.0 };
            entry.l = segment.length() / scale.scale;
        }
    }
    if points.contour.closed && points.places.last().is_some_and(|last| last + 1 < list.len()) {
        // The closing mark is where the contour started.
        let last = array.len() - 1;
        (array[last].x, array[last].y) = (array[points.places[0]].x, array[points.places[0]].y);
    }
    array
}

/// The place of the handle of the anchor at a place of the list.
fn handle_of(list: &[SpiroCp], place: usize) -> Option<usize> {
    let is_pair = |pair: &[SpiroCp]| pair[0].letter() == b'a' && pair[1].letter() == b'h';
    let pair = list.get(place..place + 2)?;
    is_pair(pair).then_some(place + 1)
}

/// The contour of an array.
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    pub(crate) start: Point,
    pub(crate) open: bool,
    /// The spans from knot to knot.
    pub(crate) segments: Vec<Segment>,
}

/// What an array says, of which the first `n` entries are given: an end mark or none. `source` are
/// the points that it was made of, if the caller has them, so that ends are met to the bit. `None` if a number isn't
/// finite or nothing is drawn.
pub(crate) fn placed(
    array: &[SpiroSeg],
    source: Option<&[SpiroCp]>,
    scale: Scale,
) -> Option<Placed> {
    let (first, last) = (array.first()?, array.last()?);
    let open = first.ty as u8 == b'{' || last.ty as u8 == b'}';
    let is_marked = is_end_mark(last.ty as u8);
    let count = if open || is_marked { array.len() - 1 } else { array.len() };
    let place = |i: usize| {
        let returns = !open && i >= count;
        point_of(array, source, scale, if returns { 0 } else { i })
    };
    let spans = (0..count).filter(|&i| !leads_to_handle(array, i));
    let segments: Option<Vec<Segment>> = spans
        .map(|i| {
            let entry = &array[i];
            // A handle's own place isn't on the curve; its anchor's is.
            let from = if i > 0 && leads_to_handle(array, i - 1) { i - 1 } else { i };
            let (start, end) = (place(from), place(i + 1));
            let finite =
                start.is_finite() && end.is_finite() && entry.ks.iter().all(|k| k.is_finite());
            finite.then(|| match entry.ks == [0.0; 4] {
                true => Segment::line(start, end),
                false => Segment::spiral(start, end, PolynomialSpiral::new(entry.ks)),
            })
        })
        .collect();
    let segments = segments.filter(|all| all.iter().all(|s| s.length().is_finite()))?;
    Some(Placed { start: place(0), open, segments })
}

fn point_of(array: &[SpiroSeg], source: Option<&[SpiroCp]>, scale: Scale, i: usize) -> Point {
    match source {
        Some(list) => Point::new(list[i].x, list[i].y),
        None => scale.outward(Point::new(array[i].x, array[i].y)),
    }
}

fn leads_to_handle(array: &[SpiroSeg], i: usize) -> bool {
    let letter = |i: usize| array.get(i).map(|entry| entry.ty as u8);
    letter(i) == Some(b'a') && letter(i + 1) == Some(b'h')
}

/// The direction in which a segment starts, and in which it ends, in radians, in (−π, π].
pub(crate) fn directions(entry: &SpiroSeg) -> [f64; 2] {
    if entry.ks == [0.0; 4] {
        return [entry.seg_th; 2];
    }
    let angles = PolynomialSpiral::new(entry.ks).chord_angles();
    [angles.start_direction(entry.seg_th), angles.end_direction(entry.seg_th)].map(wrap_angle)
}
