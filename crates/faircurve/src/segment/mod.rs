//! One piece of a curve: its shape and where it lies.

mod bezier;
mod measured;
mod spiral;
mod unit_curve;

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use kurbo::{Affine, ParamCurve, PathSeg, Point, Rect, Vec2};
use num_complex::Complex64;

use crate::frame::{ChordAngles, direction, turning, wrap_angle};
use crate::numeric::elastica::Elastica;
use crate::numeric::order::sort_by;
use crate::numeric::quadrature::integrate;
use crate::numeric::roots::{monotone_root, roots_between};
use crate::numeric::spiro_integral::{angle, curvature_jet, spiro_integral_between, wildness};
use crate::numeric::trig::{argument, unit_vector};

pub use bezier::UnitBezier;
pub use measured::{Measured, ParametricCurve};
pub use spiral::{PolynomialSpiral, SpiralChord};
pub use unit_curve::{CurveEnd, UnitCurve};

/// What shape a segment has. Grows with the families; match with a wildcard.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A straight line; exact.
    Line,
    /// A polynomial spiral.
    Spiral(PolynomialSpiral),
    /// A piece of an elastica, for arc length 1, whose place of reference is its middle.
    Elastica(Elastica),
    /// Another curve: a Bézier, a piece of a generating curve, a blend.
    Unit(UnitPiece),
    /// Several segments end to end, such as two arcs: at the joints curvature may jump.
    Chain(Arc<[Segment]>),
}

/// A piece of a [`UnitCurve`], travelled forwards or backwards.
#[derive(Clone, Debug)]
pub struct UnitPiece {
    curve: Arc<dyn UnitCurve>,
    /// The arc lengths of the curve at which it starts and ends; infinite where it ends with the curve, which need
    /// not be measured yet.
    from: f64,
    to: f64,
    backwards: bool,
}

impl PartialEq for UnitPiece {
    /// Whether they are the same piece of the same curve, not of an equal one.
    fn eq(&self, other: &Self) -> bool {
        let range = |piece: &UnitPiece| (piece.from, piece.to(), piece.backwards);
        Arc::ptr_eq(&self.curve, &other.curve) && range(self) == range(other)
    }
}

impl UnitPiece {
    fn is_whole(&self) -> bool {
        self.from == 0.0 && self.to == f64::INFINITY
    }

    #[inline(never)] // for the size of the web's module
    fn to(&self) -> f64 {
        if self.to == f64::INFINITY { self.curve.length() } else { self.to }
    }

    fn length(&self) -> f64 {
        self.to() - self.from
    }

    /// The curve's arc length for one of the piece's.
    fn place(&self, s: f64) -> f64 {
        let s = if self.backwards { self.to() - s } else { self.from + s };
        s.clamp(self.from, self.to())
    }
}

/// A shape placed between two points. Arc length runs from 0 at `start` to [`length`](Self::length).
///
/// Ends are exact: the curve passes through `start` and `end` to the bit. Points between are
/// accurate to about 1e-15 of the arc length, times arc length over chord, plus rounding of the
/// coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    start: Point,
    end: Point,
    shape: Shape,
    /// The drawing's units per unit of the shape's own arc length: of a spiral or an elastica, whose is 1, the
    /// length; and so of a line and of a chain.
    scale: f64,
    /// Direction of the shape's own x axis: for a spiral or an elastica, that of the middle of the arc; for a unit
    /// curve, that of the whole curve's chord; for a line, everywhere.
    heading: f64,
}

/// Chords shorter than this part of the arc would be mostly rounding error.
const SHORTEST_CHORD: f64 = 1e-9;

/// Point, direction and curvature somewhere on a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// The point, in user units.
    pub point: Point,
    /// Direction of travel in radians, not wrapped.
    pub direction: f64,
    /// Curvature in 1/units, counterclockwise positive.
    pub curvature: f64,
}

impl Segment {
    /// The straight line. For a zero chord the direction is 0; see
    /// [`line_with_direction`](Self::line_with_direction).
    pub fn line(start: Point, end: Point) -> Self {
        let chord = end - start;
        let direction = if chord == Vec2::ZERO { 0.0 } else { direction(chord) };
        Segment::line_with_direction(start, end, direction)
    }

    /// A straight line that remembers a direction of its own: for a segment of length 0, which has
    /// none.
    pub fn line_with_direction(start: Point, end: Point, direction: f64) -> Self {
        let scale = (end - start).hypot();
        Segment { start, end, shape: Shape::Line, scale, heading: direction }
    }

    /// A spiral scaled and turned so that its chord is that from `start` to `end`.
    ///
    /// A spiral that ends where it began can't be placed on a chord: where its chord is below
    /// 1e-9 of its arc, and where the chord or a parameter isn't finite, the straight line stands
    /// in.
    pub fn spiral(start: Point, end: Point, spiral: PolynomialSpiral) -> Self {
        Segment::spiral_along(start, end, spiral, spiral.chord())
    }

    /// The same where the spiral's own chord is known.
    pub(crate) fn spiral_along(
        start: Point,
        end: Point,
        spiral: PolynomialSpiral,
        local: SpiralChord,
    ) -> Self {
        let chord = end - start;
        if chord == Vec2::ZERO || !(local.length > SHORTEST_CHORD) {
            return Segment::line(start, end);
        }
        let scale = chord.hypot() / local.length;
        let heading = direction(chord) - local.direction;
        Segment { start, end, shape: Shape::Spiral(spiral), scale, heading }
    }

    /// The piece of an elastica from s = −½ to ½, scaled and turned so that its chord is that from
    /// `start` to `end`; the straight line where its chord is below 1e-9 of its arc, and where the
    /// chord or a number isn't finite.
    pub fn elastica(start: Point, end: Point, elastica: Elastica) -> Self {
        let chord = end - start;
        let (local, _) = elastica.centred_arc(1.0);
        if chord == Vec2::ZERO || !(local.norm() > SHORTEST_CHORD) || !local.is_finite() {
            return Segment::line(start, end);
        }
        let scale = chord.hypot() / local.norm();
        let heading = direction(chord) - argument(local);
        Segment { start, end, shape: Shape::Elastica(elastica), scale, heading }
    }

    /// A unit curve scaled and turned so that its chord is that from `start` to `end`; the straight
    /// line if they coincide, or if the curve's length isn't finite.
    pub fn unit_curve(start: Point, end: Point, curve: Arc<dyn UnitCurve>) -> Self {
        let chord = end - start;
        let scale = chord.hypot();
        if chord == Vec2::ZERO || !(scale * curve.length_bound()).is_finite() {
            return Segment::line(start, end);
        }
        let shape =
            Shape::Unit(UnitPiece { curve, from: 0.0, to: f64::INFINITY, backwards: false });
        Segment { start, end, shape, scale, heading: direction(chord) }
    }

    /// The same, with the direction from `start` to `end` given: where it is short, better known than
    /// the points know it. What differs by more than the rounding of the points isn't believed.
    pub(crate) fn unit_curve_along(
        start: Point,
        end: Point,
        curve: Arc<dyn UnitCurve>,
        way: Vec2,
    ) -> Self {
        const ROUNDING: f64 = 1e-10;
        let placed = Segment::unit_curve(start, end, curve);
        let chord = end - start;
        let astray = turning(chord, way).abs() * chord.hypot();
        let size = start.to_vec2().hypot().max(end.to_vec2().hypot());
        if placed.is_line() || !(astray <= ROUNDING * (chord.hypot() + size)) {
            return placed;
        }
        Segment { heading: direction(way), ..placed }
    }

    /// A Bézier, exactly; a straight line if it is one or ends where it starts.
    pub fn bezier(bezier: PathSeg) -> Self {
        let (start, end) = (bezier.start(), bezier.end());
        let chord = end - start;
        if matches!(bezier, PathSeg::Line(_)) || chord == Vec2::ZERO {
            return Segment::line(start, end);
        }
        // Division by the chord, as complex numbers: onto the unit chord.
        let onto = chord / chord.hypot2();
        let unit = |p: Point| Point::new((p - start).dot(onto), onto.cross(p - start));
        let unit = match bezier {
            PathSeg::Line(line) => PathSeg::Line(line),
            PathSeg::Quad(q) => {
                PathSeg::Quad(kurbo::QuadBez::new(Point::ORIGIN, unit(q.p1), Point::new(1.0, 0.0)))
            }
            PathSeg::Cubic(c) => {
                let (p1, p2) = (unit(c.p1), unit(c.p2));
                PathSeg::Cubic(kurbo::CubicBez::new(Point::ORIGIN, p1, p2, Point::new(1.0, 0.0)))
            }
        };
        Segment::unit_curve(start, end, Arc::new(Measured::new(UnitBezier::new(unit))))
    }

    /// Segments end to end as one; each must start where the one before ends.
    ///
    /// # Panics
    /// If there is none.
    pub fn chain(members: impl IntoIterator<Item = Segment>) -> Self {
        let mut members: Vec<Segment> = members.into_iter().collect();
        for i in 1..members.len() {
            // Direction is continuous through the joints, not only up to whole turns.
            let arriving = members[i - 1].direction(members[i - 1].length());
            let off = members[i].direction(0.0) - arriving;
            members[i].heading += wrap_angle(off) - off;
        }
        if members.len() == 1 {
            return members.remove(0);
        }
        Segment {
            start: members[0].start,
            end: members[members.len() - 1].end,
            scale: members.iter().map(Segment::length).sum(),
            heading: 0.0,
            shape: Shape::Chain(members.into()),
        }
    }

    /// Where it starts.
    pub fn start(&self) -> Point {
        self.start
    }

    /// Where it ends.
    pub fn end(&self) -> Point {
        self.end
    }

    /// Its shape.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Directions at both ends relative to the chord, each within half a turn of it; 0 where there is
    /// no chord.
    pub fn chord_angles(&self) -> ChordAngles {
        let chord = self.end - self.start;
        if chord == Vec2::ZERO {
            return ChordAngles::default();
        }
        let [start, end] = self.ends();
        ChordAngles::from_directions(start.direction, direction(chord), end.direction)
    }

    /// k₀ … k₃ of eq. 8.1 for a polynomial spiral, zeros for a line; `None` for other shapes.
    pub fn kappa(&self) -> Option<[f64; 4]> {
        match &self.shape {
            Shape::Line => Some([0.0; 4]),
            Shape::Spiral(spiral) => Some(spiral.k),
            Shape::Elastica(_) | Shape::Unit(_) | Shape::Chain(_) => None,
        }
    }

    /// The segment as Béziers, if it is made of them; otherwise they must be
    /// [fitted](crate::convert).
    pub fn beziers(&self) -> Option<Vec<PathSeg>> {
        match &self.shape {
            Shape::Line => Some(vec![PathSeg::Line(kurbo::Line::new(self.start, self.end))]),
            Shape::Spiral(_) | Shape::Elastica(_) => None,
            Shape::Unit(piece) => {
                let unit = piece.curve.bezier(piece.from, piece.to)?;
                let unit = if piece.backwards { unit.reverse() } else { unit };
                let Complex64 { re, im } = unit_vector(self.heading);
                let turned = Affine::new([re, im, -im, re, 0.0, 0.0]);
                let map = Affine::translate(self.start.to_vec2())
                    * turned
                    * Affine::scale(self.scale)
                    * Affine::translate(-unit.start().to_vec2());
                Some(vec![with_ends(map * unit, self.start, self.end)])
            }
            Shape::Chain(members) => {
                let beziers: Option<Vec<_>> = members.iter().map(Segment::beziers).collect();
                Some(beziers?.concat())
            }
        }
    }

    /// Whether it is a straight line.
    pub fn is_line(&self) -> bool {
        matches!(self.shape, Shape::Line)
    }

    /// Arc length.
    #[inline(never)] // for the size of the web's module
    pub fn length(&self) -> f64 {
        match &self.shape {
            Shape::Unit(piece) => self.scale * piece.length(),
            _ => self.scale,
        }
    }

    /// Straight distance from start to end.
    pub fn chord_length(&self) -> f64 {
        (self.end - self.start).hypot()
    }

    /// Direction of travel at arc length `s`, in radians, continuous along the segment except at
    /// cusps, where it jumps by half a turn.
    pub fn direction(&self, s: f64) -> f64 {
        match &self.shape {
            Shape::Line => self.heading,
            Shape::Spiral(spiral) => self.heading + angle(spiral.k, self.local(s)),
            Shape::Elastica(elastica) => self.heading + elastica.at(self.local(s)).direction,
            Shape::Unit(piece) => {
                let turned = if piece.backwards { PI } else { 0.0 };
                let place = self.place_on(piece, s);
                self.heading + piece.curve.direction(place) + turned
            }
            Shape::Chain(members) => {
                let (member, s) = self.member(members, s);
                member.direction(s)
            }
        }
    }

    /// What holds at the start and at the end: [`direction`](Self::direction) and
    /// [`curvature`](Self::curvature) there.
    pub fn ends(&self) -> [CurveEnd; 2] {
        match &self.shape {
            Shape::Line => [CurveEnd { direction: self.heading, curvature: 0.0 }; 2],
            Shape::Unit(piece) if piece.is_whole() => {
                let [start, end] = piece.curve.ends();
                let per_unit = 1.0 / self.scale;
                let place = |end: CurveEnd, turned: f64, sign: f64| CurveEnd {
                    direction: self.heading + end.direction + turned,
                    curvature: (sign * end.curvature * per_unit).clamp(f64::MIN, f64::MAX),
                };
                if piece.backwards {
                    [place(end, PI, -1.0), place(start, PI, -1.0)]
                } else {
                    [place(start, 0.0, 1.0), place(end, 0.0, 1.0)]
                }
            }
            Shape::Spiral(spiral) if self.scale > 0.0 => [-0.5, 0.5].map(|local| CurveEnd {
                direction: self.heading + angle(spiral.k, local),
                curvature: (curvature_jet(spiral.k, local)[0] * (1.0 / self.scale))
                    .clamp(f64::MIN, f64::MAX),
            }),
            _ => [0.0, self.length()]
                .map(|s| CurveEnd { direction: self.direction(s), curvature: self.curvature(s) }),
        }
    }

    /// Curvature at arc length `s`, in 1/units.
    pub fn curvature(&self, s: f64) -> f64 {
        let curvature = match &self.shape {
            Shape::Line => return 0.0,
            Shape::Spiral(spiral) => curvature_jet(spiral.k, self.local(s))[0],
            Shape::Unit(piece) => {
                let curvature = piece.curve.curvature(self.place_on(piece, s));
                if piece.backwards { -curvature } else { curvature }
            }
            Shape::Elastica(_) | Shape::Chain(_) => return self.curvature_jet(s)[0],
        };
        (curvature * (1.0 / self.scale)).clamp(f64::MIN, f64::MAX)
    }

    /// Curvature at arc length `s` and its first three derivatives by arc length, the j-th in
    /// units⁻ʲ⁻¹ (eq. 8.6). Zeros on a line; huge but finite at a cusp.
    pub fn curvature_jet(&self, s: f64) -> [f64; 4] {
        let (mut jet, flips) = match &self.shape {
            Shape::Line => return [0.0; 4],
            Shape::Spiral(spiral) => (curvature_jet(spiral.k, self.local(s)), false),
            Shape::Elastica(elastica) => (elastica.curvature_jet(self.local(s)), false),
            Shape::Unit(piece) => {
                (piece.curve.curvature_jet(self.place_on(piece, s)), piece.backwards)
            }
            Shape::Chain(members) => {
                let (member, s) = self.member(members, s);
                return member.curvature_jet(s);
            }
        };
        let mut scale = 1.0;
        for (order, derivative) in jet.iter_mut().enumerate() {
            scale /= self.scale;
            *derivative = (*derivative * scale).clamp(f64::MIN, f64::MAX);
            if flips && order % 2 == 0 {
                *derivative = -*derivative;
            }
        }
        jet
    }

    /// Point at arc length `s`, clamped to the segment.
    pub fn point(&self, s: f64) -> Point {
        let s = s.clamp(0.0, self.length());
        if s == 0.0 {
            return self.start;
        } else if s == self.length() {
            return self.end;
        }
        match &self.shape {
            Shape::Line => self.start.lerp(self.end, s / self.length()),
            // From the nearer end, so that ends are met and errors stay small.
            Shape::Spiral(spiral) => {
                let local = self.local(s);
                if local < 0.0 {
                    let along = spiro_integral_between(spiral.k, -0.5, local);
                    self.start + self.turned(along * self.scale)
                } else {
                    let along = spiro_integral_between(spiral.k, local, 0.5);
                    self.end - self.turned(along * self.scale)
                }
            }
            Shape::Elastica(elastica) => {
                let local = self.local(s);
                let along = |from: f64, to: f64| {
                    let middle = (from + to) / 2.0;
                    let (chord, _) = elastica.moved(middle).centred_arc(to - from);
                    let turn = unit_vector(elastica.at(middle).direction);
                    self.turned(chord * turn * self.scale)
                };
                if local < 0.0 {
                    self.start + along(-0.5, local)
                } else {
                    self.end - along(local, 0.5)
                }
            }
            Shape::Unit(piece) => {
                let at = |s: f64| piece.curve.point(piece.place(s));
                let (here, end) = (at(s / self.scale), piece.length());
                if 2.0 * s < self.length() {
                    self.start + self.turned((here - at(0.0)) * self.scale)
                } else {
                    self.end + self.turned((here - at(end)) * self.scale)
                }
            }
            Shape::Chain(members) => {
                let (member, s) = self.member(members, s);
                member.point(s)
            }
        }
    }

    /// A bound of what rounding moves [`point`](Self::point) by, in user units.
    ///
    /// A spiral is placed by its integral I, of arc length 1, whose size is c = chord/length. With I
    /// known to δ = ε(1 + w/10), w for its winding and the turns of its heading, scale and heading are
    /// known to δ/c, so that a point of the arc, no farther from the nearer end than half its length, is
    /// off by δ·length·(1 + 1/(2c)), and by the rounding of its coordinates. Eight times that is
    /// allowed, and twice that of the length. A piece of a unit curve has the rounding of the whole.
    pub(crate) fn rounding(&self) -> f64 {
        /// No spiral is [placed](Self::spiral) on a shorter chord; a piece of one can have it.
        const LONGEST_LEVER: f64 = 1e9;
        let (length, winding) = match &self.shape {
            Shape::Line => (0.0, 0.0),
            Shape::Spiral(spiral) => (self.scale, wildness(spiral.k)),
            Shape::Elastica(elastica) => (self.scale, elastica.largest_curvature()),
            Shape::Unit(piece) => (piece.curve.length() * self.scale, 0.0),
            Shape::Chain(members) => {
                return members.iter().map(Segment::rounding).fold(0.0, f64::max);
            }
        };
        let wound = 1.0 + 0.1 * (winding + self.heading.abs());
        let lever = (self.length() / self.chord_length()).clamp(1.0, LONGEST_LEVER);
        let [start, end] = [self.start, self.end];
        let coordinate = start.x.abs().max(start.y.abs()).max(end.x.abs()).max(end.y.abs());
        8.0 * f64::EPSILON * (coordinate + 2.0 * length * wound * lever)
    }

    /// Point, direction and curvature at arc length `s`, clamped to the segment.
    pub fn at(&self, s: f64) -> CurvePoint {
        let s = s.clamp(0.0, self.length());
        CurvePoint {
            point: self.point(s),
            direction: self.direction(s),
            curvature: self.curvature(s),
        }
    }

    /// The piece between arc lengths `from` and `to`, clamped to the segment (eq. 8.3).
    pub fn subsegment(&self, from: f64, to: f64) -> Segment {
        let (from, to) = (from.clamp(0.0, self.length()), to.clamp(0.0, self.length()));
        let (start, end) = (self.point(from), self.point(to));
        let scale = to - from;
        match &self.shape {
            Shape::Line => Segment::line_with_direction(start, end, self.heading),
            Shape::Spiral(spiral) => {
                let shape = Shape::Spiral(spiral.piece(self.local(from), self.local(to)));
                let heading = self.direction((from + to) / 2.0);
                Segment { start, end, shape, scale, heading }
            }
            Shape::Elastica(elastica) => {
                let (a, b) = (self.local(from), self.local(to));
                let shape = Shape::Elastica(elastica.moved((a + b) / 2.0).scaled(b - a));
                let heading = self.direction((from + to) / 2.0);
                Segment { start, end, shape, scale, heading }
            }
            Shape::Unit(piece) => {
                let (a, b) = (self.place_on(piece, from), self.place_on(piece, to));
                let (from, to) = (a.min(b), a.max(b));
                let shape = Shape::Unit(UnitPiece { from, to, ..piece.clone() });
                Segment { start, end, shape, ..*self }
            }
            Shape::Chain(members) => {
                let mut before = 0.0;
                let mut pieces = Vec::new();
                for member in members.iter() {
                    let after = before + member.length();
                    if after > from && before < to {
                        pieces.push(member.subsegment(from - before, to - before));
                    }
                    before = after;
                }
                if pieces.is_empty() {
                    let (member, s) = self.member(members, from);
                    return member.subsegment(s, s);
                }
                Segment::chain(pieces)
            }
        }
    }

    /// The same segment travelled the other way.
    pub fn reversed(&self) -> Segment {
        let (start, end) = (self.end, self.start);
        let (shape, heading) = match &self.shape {
            Shape::Line => (Shape::Line, self.heading + PI),
            // θ(s) → θ(−s) + π: odd orders of curvature keep their sign, even ones lose it.
            Shape::Spiral(spiral) => {
                let [k0, k1, k2, k3] = spiral.k;
                let shape = Shape::Spiral(PolynomialSpiral::new([-k0, k1, -k2, k3]));
                (shape, self.heading + PI)
            }
            Shape::Elastica(elastica) => (Shape::Elastica(elastica.reversed()), self.heading + PI),
            Shape::Unit(piece) => {
                let piece = UnitPiece { backwards: !piece.backwards, ..piece.clone() };
                (Shape::Unit(piece), self.heading)
            }
            Shape::Chain(members) => {
                return Segment::chain(members.iter().rev().map(Segment::reversed));
            }
        };
        Segment { start, end, shape, scale: self.scale, heading }
    }

    /// Scales and turns it onto another chord, which must not be zero: what undoing a scale by a power of two
    /// does (by `unit`, in most cases), or giving a merged knot its own place.
    pub(crate) fn move_to(&mut self, start: Point, end: Point, unit: f64) {
        if self.is_line() {
            *self = Segment::line(start, end);
            return;
        }
        let (from, to, old_start) = (self.end - self.start, end - start, self.start);
        // The same as is computed otherwise, sooner.
        let is_scaled = to == from * unit;
        let (scale, turn) =
            if is_scaled { (unit, 0.0) } else { (to.hypot() / from.hypot(), turning(from, to)) };
        let moved = |p: Point| {
            // Multiplication by the ratio of the chords, as complex numbers.
            let ratio = Vec2::new(from.dot(to), from.cross(to)) / from.hypot2();
            let v = p - old_start;
            start + Vec2::new(v.x * ratio.x - v.y * ratio.y, v.x * ratio.y + v.y * ratio.x)
        };
        self.move_with(start, end, scale, turn, &moved);
    }

    /// Moves it between other points, scaled and turned with the whole that it is part of: where it is short, its
    /// own points don't know its direction well.
    fn move_with(
        &mut self,
        start: Point,
        end: Point,
        scale: f64,
        turn: f64,
        moved: &dyn Fn(Point) -> Point,
    ) {
        match &mut self.shape {
            Shape::Line => {
                *self = Segment::line(start, end);
                return;
            }
            Shape::Spiral(_) | Shape::Elastica(_) | Shape::Unit(_) => {}
            Shape::Chain(members) => {
                let last = members.len() - 1;
                let mut next = start;
                let place = |(i, member): (usize, &Segment)| {
                    let (from, mut member) = (next, member.clone());
                    next = if i == last { end } else { moved(member.end) };
                    member.move_with(from, next, scale, turn, moved);
                    member
                };
                *self = Segment::chain(members.iter().enumerate().map(place));
                return;
            }
        }
        (self.start, self.end) = (start, end);
        self.scale *= scale;
        self.heading += turn;
    }

    /// Arc lengths at which curvature is zero (inflections), ascending; none on a line. On shapes
    /// other than lines and spirals they are found by a change of sign between 16 places in each
    /// smooth stretch, so that two that are close together may be missed. Where two pieces of a
    /// chain meet that bend opposite ways is an inflection, too.
    pub fn inflections(&self) -> Vec<f64> {
        match &self.shape {
            Shape::Line => Vec::new(),
            Shape::Spiral(PolynomialSpiral { k }) => self.places_from_local(&roots_between(
                &[k[0], k[1], k[2] / 2.0, k[3] / 6.0],
                -0.5,
                0.5,
            )),
            Shape::Elastica(_) | Shape::Unit(_) => self.sign_changes(|s| self.curvature(s)),
            Shape::Chain(members) => {
                let mut places = places_in(members, Segment::inflections);
                let mut before = 0.0;
                for pair in members.windows(2) {
                    before += pair[0].length();
                    if pair[0].curvature(pair[0].length()) * pair[1].curvature(0.0) < 0.0 {
                        places.push(before);
                    }
                }
                sort_by(&mut places, f64::total_cmp);
                places
            }
        }
    }

    /// Arc lengths inside the segment at which |curvature| has an extremum or κ′ = 0, ascending;
    /// with the limits of [`inflections`](Self::inflections).
    pub fn curvature_extrema(&self) -> Vec<f64> {
        match &self.shape {
            Shape::Line => Vec::new(),
            Shape::Spiral(PolynomialSpiral { k }) => {
                self.places_from_local(&roots_between(&[k[1], k[2], k[3] / 2.0], -0.5, 0.5))
            }
            Shape::Elastica(_) | Shape::Unit(_) => self.sign_changes(|s| self.curvature_jet(s)[1]),
            Shape::Chain(members) => places_in(members, Segment::curvature_extrema),
        }
    }

    /// Arc lengths at which the tangent is horizontal or vertical, ascending; none on a line; with
    /// the limits of [`inflections`](Self::inflections).
    pub fn axis_extrema(&self) -> Vec<f64> {
        match &self.shape {
            Shape::Line => Vec::new(),
            Shape::Spiral(spiral) => self.axis_extrema_of_spiral(*spiral),
            Shape::Elastica(_) | Shape::Unit(_) => {
                self.sign_changes(|s| unit_vector(2.0 * self.direction(s)).im)
            }
            Shape::Chain(members) => {
                let mut places = places_in(members, Segment::axis_extrema);
                // At a joint, rounding may put it beyond either side, or have it twice.
                let mut before = 0.0;
                for member in &members[..members.len() - 1] {
                    before += member.length();
                    let direction = member.direction(member.length());
                    let rounding = 8.0 * f64::EPSILON * (1.0 + direction.abs());
                    if unit_vector(2.0 * direction).im.abs() <= rounding {
                        places.push(before);
                    }
                }
                sort_by(&mut places, f64::total_cmp);
                places.dedup_by(|after, before| *after - *before <= 1e-12 * self.length());
                places
            }
        }
    }

    fn axis_extrema_of_spiral(&self, spiral: PolynomialSpiral) -> Vec<f64> {
        let k = spiral.k;
        let direction = |s: f64| self.heading + angle(k, s);
        let mut places = Vec::new();
        let mut breaks = vec![-0.5];
        breaks.extend(roots_between(&[k[0], k[1], k[2] / 2.0, k[3] / 6.0], -0.5, 0.5));
        breaks.push(0.5);
        for pair in breaks.windows(2) {
            // Direction is monotone here; visit each quarter turn that it passes.
            let (a, b) = (direction(pair[0]), direction(pair[1]));
            let quarter =
                |n: f64| monotone_root(|s| direction(s) - n * FRAC_PI_2, pair[0], pair[1]);
            let (low, high) = (a.min(b) / FRAC_PI_2, a.max(b) / FRAC_PI_2);
            let mut quarters: Vec<f64> = Vec::new();
            let mut n = low.ceil();
            while n <= high {
                quarters.extend(quarter(n));
                n += 1.0;
            }
            if a > b {
                quarters.reverse();
            }
            places.extend(quarters);
        }
        places.dedup();
        self.places_from_local(&places)
    }

    /// Arc lengths inside the segment at which it isn't smooth or nearly so, ascending: joints,
    /// cusps, sharp bends. None on lines and spirals.
    pub fn breaks(&self) -> Vec<f64> {
        match &self.shape {
            Shape::Line | Shape::Spiral(_) | Shape::Elastica(_) => Vec::new(),
            Shape::Unit(_) => {
                let stops = self.stops();
                stops[1..stops.len() - 1].to_vec()
            }
            Shape::Chain(members) => {
                let mut before = 0.0;
                let mut places = Vec::new();
                for (i, member) in members.iter().enumerate() {
                    if i > 0 {
                        places.push(before);
                    }
                    places.extend(member.breaks().into_iter().map(|s| before + s));
                    before += member.length();
                }
                places
            }
        }
    }

    /// The smallest box that holds the segment, to rounding.
    pub fn bounding_box(&self) -> Rect {
        let mut bounds = Rect::from_points(self.start, self.end);
        if let Shape::Chain(members) = &self.shape {
            return members.iter().fold(bounds, |bounds, m| bounds.union(m.bounding_box()));
        }
        if let Some(beziers) = self.beziers() {
            return beziers.iter().fold(bounds, |bounds, b| bounds.union(bezier::bounds(*b)));
        }
        for s in self.axis_extrema() {
            bounds = bounds.union_pt(self.point(s));
        }
        bounds
    }

    /// The arc length of the point nearest to `target` and its distance, which exceeds the true
    /// distance by at most `accuracy` (in user units; values below 1e-12 of the arc length count as
    /// that).
    pub fn nearest(&self, target: Point, accuracy: f64) -> (f64, f64) {
        let accuracy = accuracy.max(1e-12 * self.length()).max(f64::MIN_POSITIVE);
        let distance = |s: f64| (self.point(s) - target).hypot();
        let mut best = [0.0, self.length(), self.length() / 2.0]
            .map(|s| (s, distance(s)))
            .into_iter()
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap_or((0.0, 0.0));
        // Branch and bound: an arc of length h over a chord of length d lies within the ellipse
        // around the chord's ends, ½√(h² − d²) to the side, and, where |κ| ≤ K, within K·h²/8.
        let mut stack = vec![(0.0, self.length(), self.start, self.end)];
        while let Some((from, to, start, end)) = stack.pop() {
            let h = to - from;
            let d = (end - start).hypot().min(h);
            let in_ellipse = ((h - d) * (h + d) + 4.0 * f64::EPSILON * h * h).sqrt() / 2.0;
            let sagitta = (self.largest_curvature(from, to) * h * h / 8.0).min(in_ellipse);
            let (along, to_chord) = nearest_on_chord(target, start, end);
            // The foot on the chord is the guess for the arc.
            let guess = from + along * h;
            let candidate = distance(guess);
            if candidate < best.1 {
                best = (guess, candidate);
            }
            if to_chord - sagitta < best.1 - accuracy && sagitta > 0.25 * accuracy {
                let middle = from + h / 2.0;
                let point = self.point(middle);
                stack.push((from, middle, start, point));
                stack.push((middle, to, point, end));
            }
        }
        best
    }

    /// ∫ κ² ds, in 1/units: exact for spirals, where the integrand is a polynomial, to about 1e-13
    /// for others. It is infinite where the curve has a cusp; some large number stands for that.
    pub fn bending_energy(&self) -> f64 {
        match &self.shape {
            Shape::Line => 0.0,
            Shape::Spiral(PolynomialSpiral { k }) => {
                mean_square(&[k[0], k[1], k[2] / 2.0, k[3] / 6.0]) / self.scale
            }
            Shape::Elastica(elastica) => {
                let square = |s: f64| elastica.curvature_jet(s)[0].powi(2);
                integrate(&square, &[-0.5, 0.5]) / self.scale
            }
            Shape::Unit(piece) => {
                let unit = piece.curve.integral(piece.from, piece.to(), &|jet| jet[0] * jet[0]);
                (unit / self.scale).min(f64::MAX)
            }
            Shape::Chain(members) => members.iter().map(Segment::bending_energy).sum(),
        }
    }

    /// ∫ κ′² ds, in 1/units³ (jumps at joints of a chain are not counted), with the accuracy of
    /// [`bending_energy`](Self::bending_energy).
    pub fn variation_energy(&self) -> f64 {
        match &self.shape {
            Shape::Line => 0.0,
            Shape::Spiral(PolynomialSpiral { k }) => {
                mean_square(&[k[1], k[2], k[3] / 2.0]) / self.scale.powi(3)
            }
            Shape::Elastica(elastica) => {
                let square = |s: f64| elastica.curvature_jet(s)[1].powi(2);
                integrate(&square, &[-0.5, 0.5]) / self.scale.powi(3)
            }
            Shape::Unit(piece) => {
                let unit = piece.curve.integral(piece.from, piece.to(), &|jet| jet[1] * jet[1]);
                (unit / self.scale.powi(3)).min(f64::MAX)
            }
            Shape::Chain(members) => members.iter().map(Segment::variation_energy).sum(),
        }
    }

    /// An upper bound of |κ| between two arc lengths; [`f64::MAX`] where none is known.
    pub fn largest_curvature(&self, from: f64, to: f64) -> f64 {
        self.curvature_bounds(from, to)[0]
    }

    /// Upper bounds of |κ|, |κ′| and |κ″| between two arc lengths, by arc length and in units of the
    /// drawing; each is [`f64::MAX`] where none is known.
    pub fn curvature_bounds(&self, from: f64, to: f64) -> [f64; 3] {
        if self.length() == 0.0 {
            return [0.0; 3];
        }
        let bounds = match &self.shape {
            Shape::Line => return [0.0; 3],
            Shape::Spiral(spiral) => {
                let (a, b) = (self.local(from), self.local(to));
                let [k, first, second, third] =
                    curvature_jet(spiral.k, (a + b) / 2.0).map(f64::abs);
                let half = (b - a) / 2.0;
                [
                    k + half * (first + half * (second / 2.0 + half * third / 6.0)),
                    first + half * (second + half * third / 2.0),
                    second + half * third,
                ]
            }
            Shape::Elastica(elastica) => {
                // κ′ = −b sin θ, κ″ = −b κ cos θ.
                let (a, b) = (self.local(from), self.local(to));
                let force = elastica.force().norm();
                let ends = elastica.at(a).curvature.abs().max(elastica.at(b).curvature.abs());
                let between = ends + force * (b - a).abs() / 2.0;
                let k = between.min(elastica.largest_curvature()).max(ends);
                [k, force, force * k]
            }
            Shape::Unit(piece) => {
                let (a, b) = (self.place_on(piece, from), self.place_on(piece, to));
                piece.curve.curvature_bounds(a.min(b), a.max(b))
            }
            Shape::Chain(members) => {
                let mut before = 0.0;
                let mut largest = [0.0f64; 3];
                for member in members.iter() {
                    let after = before + member.length();
                    if after >= from && before <= to {
                        let (a, b) = ((from - before).max(0.0), (to - before).min(member.length()));
                        let bounds = member.curvature_bounds(a, b);
                        largest = std::array::from_fn(|j| largest[j].max(bounds[j]));
                    }
                    before = after;
                }
                return largest;
            }
        };
        let mut scale = 1.0;
        bounds.map(|bound| {
            scale /= self.scale;
            if bound == f64::MAX { bound } else { (bound * scale).min(f64::MAX) }
        })
    }

    /// s ∈ [−½, ½] for an arc length of a spiral or an elastica.
    fn local(&self, s: f64) -> f64 {
        if self.scale == 0.0 { 0.0 } else { s / self.scale - 0.5 }
    }

    fn places_from_local(&self, local: &[f64]) -> Vec<f64> {
        local.iter().map(|s| ((s + 0.5) * self.length()).clamp(0.0, self.length())).collect()
    }

    /// The unit curve's arc length at arc length `s`: at the ends its own to the bit, since next to a cusp
    /// the last bit turns the curve.
    fn place_on(&self, piece: &UnitPiece, s: f64) -> f64 {
        if s > 0.0 && s < self.length() {
            piece.place(s / self.scale)
        } else if (s >= self.length()) == piece.backwards {
            piece.from
        } else {
            piece.to()
        }
    }

    /// A vector of the shape's own frame, turned into place.
    fn turned(&self, local: Complex64) -> Vec2 {
        let turned = local * unit_vector(self.heading);
        Vec2::new(turned.re, turned.im)
    }

    /// The member of a chain at arc length `s`, and the arc length within it. Where two meet, the
    /// later one; the end is the last one's to the bit.
    fn member<'a>(&self, members: &'a [Segment], s: f64) -> (&'a Segment, f64) {
        let mut rest = s;
        for member in &members[..members.len() - 1] {
            if rest < member.length() {
                return (member, rest);
            }
            rest -= member.length();
        }
        let last = &members[members.len() - 1];
        (last, if s < self.length() { rest } else { last.length() })
    }

    /// Both ends and the breaks between them, as arc lengths of the segment, ascending.
    fn stops(&self) -> Vec<f64> {
        let Shape::Unit(piece) = &self.shape else { return vec![0.0, self.length()] };
        let mut stops: Vec<f64> = piece
            .curve
            .stops(piece.from, piece.to())
            .into_iter()
            .map(|s| if piece.backwards { piece.to() - s } else { s - piece.from } * self.scale)
            .collect();
        sort_by(&mut stops, f64::total_cmp);
        stops
    }

    /// Arc lengths at which `f` changes its sign, found between 16 places in each smooth stretch, and
    /// at the breaks between them.
    fn sign_changes(&self, f: impl Fn(f64) -> f64) -> Vec<f64> {
        const PLACES: usize = 16;
        let mut changes = Vec::new();
        // The last place at which the function has a sign, and that sign.
        let mut signed: Option<(f64, f64)> = None;
        for ends in self.stops().windows(2) {
            for i in 0..=PLACES {
                // Just inside, since at a joint or a cusp the function is that of the other side.
                let along = (i as f64 / PLACES as f64).clamp(1e-9, 1.0 - 1e-9);
                let here = ends[0] + (ends[1] - ends[0]) * along;
                let value = f(here);
                if value == 0.0 || value.is_nan() {
                    continue;
                }
                if let Some((before, sign)) = signed
                    && sign != value.signum()
                {
                    let is_across_break = before < ends[0];
                    let change = if is_across_break {
                        Some(ends[0])
                    } else {
                        monotone_root(&f, before, here)
                    };
                    changes.extend(change);
                }
                signed = Some((here, value.signum()));
            }
        }
        changes
    }
}

/// What `find` finds in each member of a chain, as arc lengths of the chain.
fn places_in(members: &[Segment], find: impl Fn(&Segment) -> Vec<f64>) -> Vec<f64> {
    let mut before = 0.0;
    let mut places = Vec::new();
    for member in members {
        places.extend(find(member).into_iter().map(|s| before + s));
        before += member.length();
    }
    places
}

/// The same Bézier with exact ends.
fn with_ends(bezier: PathSeg, start: Point, end: Point) -> PathSeg {
    match bezier {
        PathSeg::Line(_) => PathSeg::Line(kurbo::Line::new(start, end)),
        PathSeg::Quad(q) => PathSeg::Quad(kurbo::QuadBez::new(start, q.p1, end)),
        PathSeg::Cubic(c) => PathSeg::Cubic(kurbo::CubicBez::new(start, c.p1, c.p2, end)),
    }
}

/// The fraction along the chord nearest to `target`, and its distance.
fn nearest_on_chord(target: Point, start: Point, end: Point) -> (f64, f64) {
    let chord = end - start;
    let squared = chord.hypot2();
    let along =
        if squared > 0.0 { ((target - start).dot(chord) / squared).clamp(0.0, 1.0) } else { 0.5 };
    (along, (start + chord * along - target).hypot())
}

/// ∫ p(s)² ds over [−½, ½] for p = Σ cᵢ sⁱ.
fn mean_square(coefficients: &[f64]) -> f64 {
    let mut sum = 0.0;
    for (i, a) in coefficients.iter().enumerate() {
        for (j, b) in coefficients.iter().enumerate() {
            if (i + j) % 2 == 0 {
                sum += a * b * 0.5f64.powi((i + j) as i32) / (i + j + 1) as f64;
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples() -> [Segment; 2] {
        let (start, end) = (Point::new(3.0, -2.0), Point::new(40.0, 25.0));
        let spiral = PolynomialSpiral::new([1.2, -3.0, 9.0, 40.0]);
        let elastica = Elastica::new(1.2, -13.0, 0.7);
        [Segment::spiral(start, end, spiral), Segment::elastica(start, end, elastica)]
    }

    #[test]
    fn point_direction_and_curvature_belong_together() {
        for segment in samples() {
            let h = 1e-4 * segment.length();
            for i in 1..50 {
                let s = segment.length() * f64::from(i) / 50.0;
                let tangent = (segment.point(s + h) - segment.point(s - h)) / (2.0 * h);
                assert!((tangent - Vec2::from_angle(segment.direction(s))).hypot() < 1e-6);
                let turn = (segment.direction(s + h) - segment.direction(s - h)) / (2.0 * h);
                assert!((turn - segment.curvature(s)).abs() < 1e-6);
                let slope = (segment.curvature(s + h) - segment.curvature(s - h)) / (2.0 * h);
                assert!((slope - segment.curvature_jet(s)[1]).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn ends_are_exact_and_both_halves_meet() {
        for segment in samples() {
            assert_eq!(segment.point(0.0), segment.start());
            assert_eq!(segment.point(segment.length()), segment.end());
            let middle = segment.length() / 2.0;
            let gap = segment.point(middle * (1.0 - 1e-15)) - segment.point(middle);
            assert!(gap.hypot() < 1e-13 * segment.length());
        }
    }

    #[test]
    fn a_piece_lies_on_the_whole() {
        for segment in samples() {
            let piece = segment.subsegment(7.0, 31.0);
            for i in 0..=20 {
                let s = 24.0 * f64::from(i) / 20.0;
                let (a, b) = (piece.at(s), segment.at(7.0 + s));
                assert!((a.point - b.point).hypot() < 1e-12);
                assert!((a.direction - b.direction).abs() < 1e-13);
                assert!((a.curvature - b.curvature).abs() < 1e-13);
            }
            let backwards = segment.reversed();
            let there = segment.at(10.0);
            let back = backwards.at(segment.length() - 10.0);
            assert!((there.point - back.point).hypot() < 1e-12);
            assert!((there.curvature + back.curvature).abs() < 1e-13);
        }
    }

    #[test]
    fn the_box_is_the_smallest() {
        for segment in samples() {
            let bounds = segment.bounding_box();
            let mut seen = Rect::from_points(segment.start(), segment.end());
            for i in 0..=4000 {
                let point = segment.point(segment.length() * f64::from(i) / 4000.0);
                assert!(bounds.inflate(1e-12, 1e-12).contains(point));
                seen = seen.union_pt(point);
            }
            assert!((bounds.area() - seen.area()).abs() < 1e-4 * bounds.area());
        }
    }

    #[test]
    fn nearest_points_are_no_farther_than_any_sample() {
        for segment in samples() {
            for target in [(0.0, 0.0), (20.0, 5.0), (45.0, 30.0), (18.0, 20.0), (-50.0, 90.0)] {
                let target = Point::from(target);
                let (s, distance) = segment.nearest(target, 1e-9);
                assert!(((segment.point(s) - target).hypot() - distance).abs() < 1e-12);
                for i in 0..=4000 {
                    let point = segment.point(segment.length() * f64::from(i) / 4000.0);
                    assert!(distance <= (point - target).hypot() + 1e-9);
                }
            }
        }
    }

    #[test]
    fn energies_agree_with_quadrature() {
        for segment in samples() {
            let (mut bending, mut variation) = (0.0, 0.0);
            let n = 20_000;
            for i in 0..n {
                let jet =
                    segment.curvature_jet(segment.length() * (f64::from(i) + 0.5) / f64::from(n));
                bending += jet[0] * jet[0];
                variation += jet[1] * jet[1];
            }
            let ds = segment.length() / f64::from(n);
            assert!((bending * ds / segment.bending_energy() - 1.0).abs() < 1e-7);
            assert!((variation * ds / segment.variation_energy() - 1.0).abs() < 1e-7);
        }
    }

    #[test]
    fn inflections_and_extrema_are_where_they_should_be() {
        for segment in samples() {
            for s in segment.inflections() {
                assert!(segment.curvature(s).abs() < 1e-14);
            }
            for s in segment.curvature_extrema() {
                assert!(segment.curvature_jet(s)[1].abs() < 1e-15);
            }
        }
    }
}
