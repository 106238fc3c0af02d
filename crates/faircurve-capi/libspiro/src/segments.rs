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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{self, Call};
    use crate::points::{Form, tests::list};

    /// Open and closed, with anchors, corners, one-way points, lines, and points in one place.
    const LISTS: [&str; 6] = [
        "0,0,{ 100,100,o 200,0,c 300,60,}",
        "500,250,o 250,500,o 0,250,[ 250,0,v 0,0,z",
        "0,0,{ 100,100,a 200,100,h 200,0,c 300,50,}",
        "100,100,a 200,100,h 200,0,o 0,0,v 0,0,z",
        "0,0,v 100,0,[ 200,100,o 100,200,v 100,200,v 0,0,z",
        "0,0,] 400,0,[ 500,150,o 400,300,] 0,300,[ -100,150,o 0,0,z",
    ];

    fn is_near(a: &Call, b: &Call) -> bool {
        use crate::pieces::Piece::{Cubic, Line, Quad};
        let near = |a: Point, b: Point| (a - b).hypot() < 1e-7;
        match (*a, *b) {
            (Call::Move(p, open), Call::Move(q, also)) => near(p, q) && open == also,
            (Call::Knot(i), Call::Knot(j)) => i == j,
            (Call::Piece(Line(p)), Call::Piece(Line(q))) => near(p, q),
            (Call::Piece(Quad(p1, p)), Call::Piece(Quad(q1, q))) => near(p1, q1) && near(p, q),
            (Call::Piece(Cubic(p1, p2, p)), Call::Piece(Cubic(q1, q2, q))) => {
                near(p1, q1) && near(p2, q2) && near(p, q)
            }
            _ => false,
        }
    }

    #[test]
    fn an_array_draws_what_its_contour_draws() {
        for text in LISTS {
            let list = list(text);
            let points = Points::read(&list, Form::Tagged).unwrap();
            let solution = drawing::solved(&points.contour).unwrap();
            for ncq in [0, 0x3000, 0x4000, RETRO_VER1] {
                let direct = drawing::draw(&points.contour, ncq).unwrap();
                let scale = Scale::of(&points, ncq);
                assert_eq!(scale == Scale::ONE, ncq == RETRO_VER1);
                let array = array(&list, &points, &solution, scale);
                assert_eq!(array.len(), list.len());
                for source in [None, Some(&list[..])] {
                    let placed = placed(&array, source, scale).unwrap();
                    let calls = drawing::calls(placed.start, &placed.segments, placed.open, ncq);
                    assert_eq!(calls.len(), direct.len(), "{text} {ncq:x} {calls:?}\n{direct:?}");
                    let near = calls.iter().zip(&direct).all(|(a, b)| is_near(a, b));
                    assert!(near, "{text} {ncq:x}\n{calls:?}\n{direct:?}");
                }
            }
        }
    }

    #[test]
    fn a_closed_array_may_come_without_its_mark() {
        let list = list(LISTS[1]);
        let points = Points::read(&list, Form::Tagged).unwrap();
        let solution = drawing::solved(&points.contour).unwrap();
        let array = array(&list, &points, &solution, Scale::ONE);
        let (marked, bare) =
            (placed(&array, None, Scale::ONE), placed(&array[..4], None, Scale::ONE));
        assert_eq!(marked.unwrap().segments, bare.unwrap().segments);
    }

    #[test]
    fn directions_are_those_of_the_curve() {
        for text in LISTS {
            let list = list(text);
            let points = Points::read(&list, Form::Tagged).unwrap();
            let solution = drawing::solved(&points.contour).unwrap();
            let array = array(&list, &points, &solution, Scale::of(&points, 0));
            for (i, &place) in points.places.iter().enumerate() {
                let knot = &solution.knots[i];
                let place = handle_of(&list, place).unwrap_or(place);
                let Some(out) = knot.direction_out else { continue };
                if array[place].seg_ch > 0.0 {
                    let error = wrap_angle(directions(&array[place])[0] - out);
                    assert!(error.abs() < 1e-9, "{text}: {error}");
                }
            }
        }
    }

    #[test]
    fn arrays_that_mean_nothing_draw_nothing() {
        let entry = SpiroSeg { ty: b'o' as _, ..SpiroSeg::default() };
        assert!(placed(&[], None, Scale::ONE).is_none());
        let wild = SpiroSeg { ks: [f64::NAN; 4], x: 1.0, ..entry };
        assert!(placed(&[entry, wild, entry], None, Scale::ONE).is_none());
        let far = SpiroSeg { x: f64::MAX, ..entry };
        assert!(placed(&[entry, far, entry], None, Scale { scale: 10.0, ..Scale::ONE }).is_none());
    }
}
