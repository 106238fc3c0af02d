//! A solved segment as lines, cubics, quadratics or arcs, as the caller asks.
//!
//! How near they are: libspiro halves a segment until no piece bends by more than a radian, and draws each half
//! in the simplest way (its cubics are those of thesis section 9.3). How far *that* is from the curve is worked out
//! here for every segment ([`Kind::coarse_error`]), and the fewest pieces are taken that come nearer. So accuracy needs no
//! units, and curves that libspiro's callers are used to never get worse.

use std::f64::consts::FRAC_PI_2;
use std::ffi::c_int;

use faircurve::convert::{self, Cuts, Fit, Metric, Options};
use faircurve::kurbo::{ParamCurveNearest, PathEl, Point, QuadBez, Vec2};
use faircurve::{Curve, Segment};

/// A piece, without its start, which is where the pen is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Piece {
    /// A straight line to the point.
    Line(Point),
    /// A quadratic Bézier, or an arc through the first point to the second.
    Quad(Point, Point),
    /// A cubic Bézier.
    Cubic(Point, Point, Point),
}

/// The form of curved pieces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Cubic,
    Arc,
    Quadratic,
}

/// How much nearer cubics and quadratics are at least. Smaller, and there are more of them: at a half, a tenth fewer cubics
/// than libspiro's in real fonts. Arcs are libspiro's own, as few of them as are as near.
const NEARER: f64 = 0.5;

/// What kind of pieces is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Kind {
    form: Form,
    /// The bend in radians above which libspiro halves a piece.
    bend: f64,
}

impl Kind {
    /// The kind that the caller's flags ask for.
    pub(crate) fn of(ncq: c_int) -> Kind {
        let (form, few) = match (ncq & crate::abi::OUTPUT_MASK) >> 12 {
            0 => (Form::Cubic, false),
            1 => (Form::Cubic, true),
            2 => (Form::Arc, false),
            3 => (Form::Arc, true),
            _ => (Form::Quadratic, false),
        };
        Kind { form, bend: if few { FRAC_PI_2 } else { 1.0 } }
    }

    /// A solved segment in this kind of pieces; none if it has no length. The last ends where the segment
    /// does, to the bit.
    pub(crate) fn pieces(self, segment: &Segment) -> Vec<Piece> {
        if !(segment.length() > 0.0) {
            return Vec::new();
        }
        if segment.is_line() {
            return vec![Piece::Line(segment.end())];
        }
        match self.form {
            Form::Cubic => self.cubics(segment),
            Form::Arc => {
                let accuracy = self.coarse_error(segment, &arc_error);
                few_pieces(segment, accuracy, &arc_error).iter().map(arc).collect()
            }
            Form::Quadratic => {
                let accuracy = NEARER * self.coarse_error(segment, &quadratics_error);
                let stretches = between_inflections(segment);
                let pieces =
                    stretches.iter().flat_map(|s| few_pieces(s, accuracy, &quadratics_error));
                pieces.map(|piece| quadratic_or_line(&piece)).collect()
            }
        }
    }

    /// The fewest cubics that are near enough.
    fn cubics(self, segment: &Segment) -> Vec<Piece> {
        let theirs =
            |piece: &Segment| convert::fit_single(piece, Metric::Distance, Fit::ArcThird).error;
        let accuracy = NEARER * self.coarse_error(segment, &theirs);
        let options = Options { cuts: Cuts::EqualErrors, ..Options::new(accuracy) };
        let curve = Curve::new(vec![segment.clone()], false);
        let elements = convert::convert(&curve, &options).path;
        elements
            .elements()
            .iter()
            .filter_map(|element| match *element {
                PathEl::LineTo(end) => Some(Piece::Line(end)),
                PathEl::QuadTo(p1, end) => Some(Piece::Quad(p1, end)),
                PathEl::CurveTo(p1, p2, end) => Some(Piece::Cubic(p1, p2, end)),
                PathEl::MoveTo(_) | PathEl::ClosePath => None,
            })
            .collect()
    }

    /// The largest error of the pieces that halving leads to.
    fn coarse_error(self, segment: &Segment, error: &dyn Fn(&Segment) -> f64) -> f64 {
        /// A piece of a curve that nobody would draw may still bend by more than a radian then.
        const MOST_HALVINGS: u32 = 8;
        self.error_of_halves(segment, MOST_HALVINGS, error)
    }

    fn error_of_halves(
        self,
        piece: &Segment,
        halvings: u32,
        error: &dyn Fn(&Segment) -> f64,
    ) -> f64 {
        let length = piece.length();
        if halvings == 0 || piece.largest_curvature(0.0, length) * length <= self.bend {
            return error(piece);
        }
        let of = |from: f64, to: f64| {
            self.error_of_halves(&piece.subsegment(from, to), halvings - 1, error)
        };
        of(0.0, length / 2.0).max(of(length / 2.0, length))
    }
}

/// As few pieces as have at most that error, or what rounding makes of none: of the same length where that does it, else each as long as it
/// can be.
fn few_pieces(segment: &Segment, accuracy: f64, error: &dyn Fn(&Segment) -> f64) -> Vec<Segment> {
    /// As a part of the length: arcs of a circle are exact, but for this.
    const ROUNDING: f64 = 1e-9;
    /// Halves have the error that is asked for: rounding mustn't decide whether they do.
    const SLACK: f64 = 1.0 + 1e-6;
    let accuracy = (SLACK * accuracy).max(ROUNDING * segment.length());
    let greedy = long_pieces(segment, accuracy, error);
    let part = segment.length() / greedy.len() as f64;
    let place = |i: usize| if i == greedy.len() { segment.length() } else { part * i as f64 };
    let even: Vec<Segment> =
        (0..greedy.len()).map(|i| segment.subsegment(place(i), place(i + 1))).collect();
    if even.iter().all(|piece| error(piece) <= accuracy) { even } else { greedy }
}

fn long_pieces(segment: &Segment, accuracy: f64, error: &dyn Fn(&Segment) -> f64) -> Vec<Segment> {
    /// As a part of the whole: reached only where rounding is the error.
    const SHORTEST: f64 = 1.0 / 512.0;
    /// Ends are found to this part of a piece.
    const STEPS: i32 = 12;
    let length = segment.length();
    let shortest = SHORTEST * length;
    let mut pieces = Vec::new();
    let mut from = 0.0;
    loop {
        let rest = segment.subsegment(from, length);
        if length - from <= shortest || error(&rest) <= accuracy {
            pieces.push(rest);
            return pieces;
        }
        let (mut near, mut far) = (from + shortest, length);
        for _ in 0..STEPS {
            let middle = (near + far) / 2.0;
            if error(&segment.subsegment(from, middle)) <= accuracy {
                near = middle;
            } else {
                far = middle;
            }
        }
        pieces.push(segment.subsegment(from, near));
        from = near;
    }
}

/// Cut where it bends to neither side: a quadratic bends to one.
fn between_inflections(segment: &Segment) -> Vec<Segment> {
    let mut places = vec![0.0];
    places.extend(segment.inflections());
    places.push(segment.length());
    places.dedup();
    places.windows(2).map(|pair| segment.subsegment(pair[0], pair[1])).collect()
}

/// Places along a piece, ends left out, at which its distance is measured.
fn samples(piece: &Segment) -> impl Iterator<Item = Point> + '_ {
    /// An arc's deviation has two humps, a quadratic's one or two.
    const SAMPLES: usize = 32;
    (1..SAMPLES).map(|i| piece.point(piece.length() * (i as f64 / SAMPLES as f64)))
}

/// The arc through the ends and the middle; a line where they are on one.
fn arc(piece: &Segment) -> Piece {
    let middle = piece.point(piece.length() / 2.0);
    match circle(piece.start(), middle, piece.end()) {
        Some(_) => Piece::Quad(middle, piece.end()),
        None => Piece::Line(piece.end()),
    }
}

fn arc_error(piece: &Segment) -> f64 {
    let (start, end) = (piece.start(), piece.end());
    let Some((centre, radius)) = circle(start, piece.point(piece.length() / 2.0), end) else {
        return samples(piece).map(|p| distance_to_line(p, start, end)).fold(0.0, f64::max);
    };
    samples(piece).map(|p| ((p - centre).hypot() - radius).abs()).fold(0.0, f64::max)
}

/// Centre and radius of the circle through three points; `None` if it can't be told from a line.
fn circle(start: Point, middle: Point, end: Point) -> Option<(Point, f64)> {
    /// The height of an arc over its chord below which rounding decides what circle it is of.
    const FLAT: f64 = 1e-9;
    let (a, b) = (middle - start, end - start);
    let cross = a.cross(b);
    if cross.abs() <= FLAT * a.hypot() * b.hypot() {
        return None;
    }
    let toward =
        (a.hypot2() * Vec2::new(b.y, -b.x) - b.hypot2() * Vec2::new(a.y, -a.x)) / (2.0 * cross);
    Some((start + toward, toward.hypot()))
}

fn distance_to_line(p: Point, start: Point, end: Point) -> f64 {
    let along = end - start;
    let across = (p - start).cross(along).abs() / along.hypot();
    if across.is_finite() { across } else { (p - start).hypot() }
}

/// The quadratic with the piece's ends and end tangents, if there is one.
fn quadratic(piece: &Segment) -> Option<QuadBez> {
    let (start, end) = (piece.start(), piece.end());
    let from = Vec2::from_angle(piece.direction(0.0));
    let to = Vec2::from_angle(piece.direction(piece.length()));
    let (chord, cross) = (end - start, from.cross(to));
    let (a, b) = (chord.cross(to) / cross, from.cross(chord) / cross);
    (a > 0.0 && b > 0.0 && a.is_finite() && b.is_finite())
        .then(|| QuadBez::new(start, start + from * a, end))
}

fn quadratic_or_line(piece: &Segment) -> Piece {
    match quadratic(piece) {
        Some(quadratic) => Piece::Quad(quadratic.p1, quadratic.p2),
        None => Piece::Line(piece.end()),
    }
}

/// The error of one quadratic for each side that the piece bends to.
fn quadratics_error(piece: &Segment) -> f64 {
    /// Distances are found to this part of the length.
    const NEAR: f64 = 1e-9;
    let of_one = |piece: &Segment| {
        let accuracy = NEAR * piece.length();
        let distance = |p: Point| match quadratic(piece) {
            Some(quadratic) => quadratic.nearest(p, accuracy).distance_sq.sqrt(),
            None => distance_to_line(p, piece.start(), piece.end()),
        };
        samples(piece).map(distance).fold(0.0, f64::max)
    };
    between_inflections(piece).iter().map(of_one).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use faircurve::PolynomialSpiral;

    fn spiral(k: [f64; 4]) -> Segment {
        Segment::spiral(Point::new(10.0, 20.0), Point::new(400.0, -30.0), PolynomialSpiral::new(k))
    }

    /// From gentle to a full turn and a half, with inflections, and with curvature that the bound overrates.
    fn spirals() -> Vec<Segment> {
        let mut all = Vec::new();
        for k0 in [0.0, 0.01, 0.4, 1.5, -3.0, 5.0] {
            for rest in [[0.0; 3], [2.0, 0.0, 0.0], [-6.0, 8.0, 0.0], [3.0, -20.0, 60.0]] {
                all.push(spiral([k0, rest[0], rest[1], rest[2]]));
            }
        }
        all.retain(|segment| segment.kappa() != Some([0.0; 4]));
        all
    }

    fn end(piece: Piece) -> Point {
        match piece {
            Piece::Line(end) | Piece::Quad(_, end) | Piece::Cubic(_, _, end) => end,
        }
    }

    fn halves(kind: Kind, piece: &Segment) -> usize {
        let length = piece.length();
        if piece.largest_curvature(0.0, length) * length <= kind.bend {
            return 1;
        }
        let middle = length / 2.0;
        halves(kind, &piece.subsegment(0.0, middle))
            + halves(kind, &piece.subsegment(middle, length))
    }

    #[test]
    fn every_kind_ends_on_the_segments_end_with_no_more_pieces_than_halving() {
        for segment in spirals() {
            for (ncq, most) in [(0, 1), (0x1000, 1), (0x2000, 1), (0x3000, 1), (0x4000, 2)] {
                let kind = Kind::of(ncq);
                let pieces = kind.pieces(&segment);
                assert_eq!(end(*pieces.last().unwrap()), segment.end());
                // More quadratics where the curve changes sides.
                let sides = if most > 1 { segment.inflections().len() } else { 0 };
                let limit = most * (halves(kind, &segment) + sides);
                assert!(pieces.len() <= limit, "{:?} {ncq:x}: {}", segment.kappa(), pieces.len());
            }
        }
    }

    #[test]
    fn lines_are_lines_in_every_kind_and_nothing_is_nothing() {
        let (a, b) = (Point::new(1.0, 2.0), Point::new(5.0, 7.0));
        for ncq in 0..8 {
            let kind = Kind::of(ncq << 12);
            assert_eq!(kind.pieces(&Segment::line(a, b)), [Piece::Line(b)]);
            assert_eq!(kind.pieces(&Segment::line(a, a)), []);
        }
    }

    /// A circle through three points is found, and not where there is none.
    #[test]
    fn circles_are_found() {
        let at = |angle: f64| Point::new(3.0, 4.0) + 5.0 * Vec2::from_angle(angle);
        let (centre, radius) = circle(at(0.1), at(1.0), at(2.5)).unwrap();
        assert!((centre - Point::new(3.0, 4.0)).hypot() < 1e-12 && (radius - 5.0).abs() < 1e-12);
        assert_eq!(circle(Point::ZERO, Point::new(1.0, 1.0), Point::new(3.0, 3.0)), None);
        assert_eq!(circle(Point::ZERO, Point::ZERO, Point::ZERO), None);
    }
}
