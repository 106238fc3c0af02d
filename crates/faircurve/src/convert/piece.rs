//! Smooth stretches of a curve, and pieces of them to be matched by one cubic.

use kurbo::{Point, Vec2};
use num_complex::Complex64;

use crate::numeric::roots::monotone_root;
use crate::numeric::trig::{cis, unit_vector};
use crate::segment::{Segment, Shape};

use super::series::Series;

/// Places x ∈ [−1, 1] along a piece at which cubics are compared with it, by their distance from the middle;
/// 0.6355 is where the deviation (x² − 1)²(x² − q) of the best cubic has its outer extrema, 0 its
/// inner one. With the ends they are nodes at which a polynomial of degree 8 interpolates about as well
/// as at Chebyshev's.
pub(super) const PAIRS: [f64; 3] = [0.9, 0.6355, 0.34];

/// How many places inside.
pub(super) const NODES: usize = 7;

/// The places, ascending.
pub(super) const PLACES: [f64; NODES] =
    [-PAIRS[0], -PAIRS[1], -PAIRS[2], 0.0, PAIRS[2], PAIRS[1], PAIRS[0]];

/// Segments joined without corners.
///
/// Arc length runs from 0 to [`length`](Self::length); lines are never part of it.
#[derive(Clone, Debug)]
pub(super) struct Stretch<'a> {
    segments: &'a [Segment],
    /// Arc length at which each segment ends.
    ends: Vec<f64>,
}

impl<'a> Stretch<'a> {
    /// Of at least one segment.
    pub(super) fn new(segments: &'a [Segment]) -> Self {
        let mut sum = 0.0;
        let ends = segments
            .iter()
            .map(|segment| {
                sum += segment.length();
                sum
            })
            .collect();
        Stretch { segments, ends }
    }

    pub(super) fn length(&self) -> f64 {
        self.ends.last().copied().unwrap_or(0.0)
    }

    pub(super) fn segments(&self) -> &'a [Segment] {
        self.segments
    }

    /// Where a segment starts.
    pub(super) fn start_of(&self, index: usize) -> f64 {
        if index == 0 { 0.0 } else { self.ends[index - 1] }
    }

    /// The segment at arc length `s`, the later one at a knot.
    fn after(&self, s: f64) -> usize {
        self.ends.partition_point(|end| *end <= s).min(self.segments.len() - 1)
    }

    /// The segment at arc length `s`, the earlier one at a knot.
    fn before(&self, s: f64) -> usize {
        self.ends.partition_point(|end| *end < s).min(self.segments.len() - 1)
    }

    /// The segments that a piece lies on.
    pub(super) fn span(&self, from: f64, to: f64) -> std::ops::RangeInclusive<usize> {
        let first = self.after(from);
        first..=self.before(to).max(first)
    }

    /// The segment at `s` and the arc length on it; at a knot the later one.
    pub(super) fn locate(&self, s: f64) -> (&'a Segment, f64) {
        let index = self.after(s);
        (&self.segments[index], s - self.start_of(index))
    }

    /// Point and unit tangent at `s`.
    pub(super) fn joint(&self, s: f64) -> Joint {
        if s <= 0.0 {
            let first = &self.segments[0];
            return Joint { point: first.start(), tangent: unit(first.direction(0.0)) };
        }
        let last = self.segments.len() - 1;
        if s >= self.length() {
            let last = &self.segments[last];
            return Joint { point: last.end(), tangent: unit(last.direction(last.length())) };
        }
        let (segment, local) = self.locate(s);
        Joint { point: segment.point(local), tangent: unit(segment.direction(local)) }
    }

    /// The piece between two places, `from` < `to`.
    pub(super) fn piece(&self, from: f64, to: f64) -> Piece {
        let span = self.span(from, to);
        if span.start() == span.end() {
            let segment = &self.segments[*span.start()];
            if let Shape::Spiral(spiral) = segment.shape() {
                let start = self.start_of(*span.start());
                let middle = ((from + to) / 2.0 - start) / segment.length() - 0.5;
                let series = Series::new(spiral.k, middle, (to - from) / segment.length());
                return Piece::of_series(from, to, series);
            }
        }
        self.sampled(from, to)
    }

    /// Curvature by powers of x, half the arc length the unit, for a piece of one spiral.
    pub(super) fn curvature_about_middle(&self, from: f64, to: f64) -> Option<[f64; 4]> {
        let span = self.span(from, to);
        let (segment, start) = (&self.segments[*span.start()], self.start_of(*span.start()));
        let Shape::Spiral(spiral) = segment.shape() else { return None };
        if span.start() != span.end() {
            return None;
        }
        let middle = ((from + to) / 2.0 - start) / segment.length() - 0.5;
        Some(Series::curvature_of(spiral.k, middle, (to - from) / segment.length()))
    }

    /// A piece known by what its segments answer.
    pub(super) fn sampled(&self, from: f64, to: f64) -> Piece {
        let half = (to - from) / 2.0;
        let origin = self.joint(from).point;
        let at = |s: f64| {
            let joint = self.joint(s);
            let off = (joint.point - origin) / half;
            (Complex64::new(off.x, off.y), Complex64::new(joint.tangent.x, joint.tangent.y))
        };
        let mut piece = Piece {
            from,
            to,
            half,
            ends: [Complex64::ZERO; 2],
            offsets: [0.0; 2],
            slopes: [0.0; 2],
            end_tangents: [Complex64::ZERO; 2],
            end_curvature: [0.0; 2],
            places: [Complex64::ZERO; NODES],
            tangents: [Complex64::ZERO; NODES],
            series: None,
        };
        for (end, s) in [from, to].into_iter().enumerate() {
            (piece.ends[end], piece.end_tangents[end]) = at(s);
        }
        let (first, last) = (self.after(from), self.before(to));
        piece.end_curvature = [
            self.segments[first].curvature(from - self.start_of(first)) * half,
            self.segments[last].curvature(to - self.start_of(last)) * half,
        ];
        for (i, x) in PLACES.into_iter().enumerate() {
            (piece.places[i], piece.tangents[i]) = at(from + half * (1.0 + x));
        }
        piece
    }

    /// How far the direction has turned since the start of a piece, at a fraction of its arc length.
    pub(super) fn turn(&self, piece: &Piece, along: f64) -> f64 {
        if let Some(series) = &piece.series {
            return series.angle(2.0 * along - 1.0) - series.angle(-1.0);
        }
        let s = piece.from + along * (piece.to - piece.from);
        let mut turned = 0.0;
        for index in self.span(piece.from, piece.to) {
            let (segment, start) = (&self.segments[index], self.start_of(index));
            let from = (piece.from - start).max(0.0);
            let to = (s - start).min(segment.length());
            if to > from {
                turned += segment.direction(to) - segment.direction(from);
            }
        }
        turned
    }

    /// The place at which ∫|κ| ds from `from` is half of that to `to`.
    pub(super) fn half_of_bend(&self, from: f64, to: f64) -> f64 {
        // Between inflections |κ| integrates to a difference of directions.
        let mut parts: Vec<(f64, f64, f64)> = Vec::new();
        for index in self.span(from, to) {
            let (segment, start) = (&self.segments[index], self.start_of(index));
            let (a, b) = ((from - start).max(0.0), (to - start).min(segment.length()));
            let mut places = vec![a];
            places.extend(segment.inflections().into_iter().filter(|s| *s > a && *s < b));
            places.push(b);
            for pair in places.windows(2) {
                let turn = segment.direction(pair[1]) - segment.direction(pair[0]);
                parts.push((start + pair[0], start + pair[1], turn.abs()));
            }
        }
        let half: f64 = parts.iter().map(|part| part.2).sum::<f64>() / 2.0;
        let mut before = 0.0;
        for (a, b, turn) in parts {
            if before + turn >= half {
                let (segment, local) = self.locate(a);
                let wanted = half - before;
                let missing = |s: f64| {
                    (segment.direction(local + (s - a)) - segment.direction(local)).abs() - wanted
                };
                return monotone_root(missing, a, b).unwrap_or((from + to) / 2.0);
            }
            before += turn;
        }
        (from + to) / 2.0
    }

    /// The largest turn from end to end of what a piece passes through, at least that of its ends.
    pub(super) fn bend(&self, from: f64, to: f64) -> f64 {
        /// Where curvature has no bound: more than most segments have.
        const UNKNOWN: f64 = 2.0 * std::f64::consts::PI;
        let mut bend = 0.0;
        for index in self.span(from, to) {
            let (segment, start) = (&self.segments[index], self.start_of(index));
            let a = (from - start).clamp(0.0, segment.length());
            let b = (to - start).clamp(0.0, segment.length());
            let curvature = segment.largest_curvature(a, b);
            bend += if curvature < f64::MAX { curvature * (b - a) } else { UNKNOWN };
        }
        bend
    }
}

/// A point of the curve with its tangent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint {
    pub(super) point: Point,
    pub(super) tangent: Vec2,
}

pub(super) fn unit(direction: f64) -> Vec2 {
    let Complex64 { re, im } = unit_vector(direction);
    Vec2::new(re, im)
}

/// How the end of a cubic stands to the curve beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shift {
    /// How far to the left of it, in user units.
    pub(super) offset: f64,
    /// By how much its tangent is turned to the left, in radians.
    pub(super) turn: f64,
}

impl Shift {
    /// On the curve, with its tangent.
    pub(super) const NONE: Shift = Shift { offset: 0.0, turn: 0.0 };
}

/// A piece in a frame of its own, half the arc length the unit: what a cubic is fitted to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// Where it lies on the stretch.
    pub(super) from: f64,
    pub(super) to: f64,
    /// Half the arc length, in user units.
    pub(super) half: f64,
    /// Where a cubic starts and ends: the curve's own ends, or beside them.
    pub(super) ends: [Complex64; 2],
    /// Directions in which it does.
    pub(super) end_tangents: [Complex64; 2],
    /// Deviation from the curve at the ends, to the left, and its derivative by x.
    pub(super) offsets: [f64; 2],
    pub(super) slopes: [f64; 2],
    pub(super) end_curvature: [f64; 2],
    /// Points at [`PLACES`].
    pub(super) places: [Complex64; NODES],
    /// Unit tangents there.
    pub(super) tangents: [Complex64; NODES],
    /// The whole piece, if it lies on one spiral; the frame is then that of its middle.
    pub(super) series: Option<Series>,
}

impl Piece {
    /// With the ends of the cubic beside the curve.
    pub(super) fn shifted(mut self, shifts: [Shift; 2]) -> Self {
        for (end, Shift { offset, turn }) in shifts.into_iter().enumerate() {
            let offset = offset / self.half;
            self.offsets[end] = offset;
            self.ends[end] += self.end_tangents[end] * Complex64::new(0.0, offset);
            // With n(x) the deviation along the normal the cubic's direction is that of 1 − κn + i n′.
            let turned = cis(turn);
            self.slopes[end] = turned.im / turned.re * (1.0 - self.end_curvature[end] * offset);
            self.end_tangents[end] *= turned;
        }
        self
    }

    pub(super) fn of_series(from: f64, to: f64, series: Series) -> Self {
        let [p0, p1, p2, end] = series.z.pairs(&[PAIRS[0], PAIRS[1], PAIRS[2], 1.0]);
        let mut tangents = [Complex64::ZERO; NODES];
        for (tangent, x) in tangents.iter_mut().zip(PLACES) {
            *tangent = cis(series.angle(x));
        }
        let end_tangents = [-1.0, 1.0].map(|x| cis(series.angle(x)));
        Piece {
            from,
            to,
            half: (to - from) / 2.0,
            ends: [end[1], end[0]],
            offsets: [0.0; 2],
            slopes: [0.0; 2],
            end_tangents,
            end_curvature: [series.curvature(-1.0), series.curvature(1.0)],
            places: [p0[1], p1[1], p2[1], Complex64::ZERO, p2[0], p1[0], p0[0]],
            tangents,
            series: Some(series),
        }
    }
}
