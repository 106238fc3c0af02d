//! A solved curve: placed segments, end to end.

use kurbo::{Point, Rect};

use crate::segment::{CurvePoint, Segment};

/// Segments end to end. Arc length runs from 0 to [`length`](Self::length) through all of them.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Curve {
    segments: Vec<Segment>,
    closed: bool,
    /// The contour's single knot, when there is no segment to hold it.
    lone_point: Option<Point>,
}

impl Curve {
    /// A curve of these segments, each starting where the one before ends.
    pub fn new(segments: Vec<Segment>, closed: bool) -> Self {
        Curve { segments, closed, lone_point: None }
    }

    /// The curve of an open contour with one knot: a point.
    pub fn from_point(point: Point) -> Self {
        Curve { segments: Vec::new(), closed: false, lone_point: Some(point) }
    }

    /// The segments in order.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Whether the last segment returns to the first.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Where the curve starts.
    pub fn start(&self) -> Option<Point> {
        self.segments.first().map(Segment::start).or(self.lone_point)
    }

    /// Arc length in user units.
    pub fn length(&self) -> f64 {
        self.segments.iter().map(Segment::length).sum()
    }

    /// Point, direction and curvature at arc length `s`, clamped to the curve; where two segments
    /// meet, those of the later one. `None` for a curve without segments.
    pub fn at(&self, s: f64) -> Option<CurvePoint> {
        let mut rest = s;
        let last = self.segments.last()?;
        for segment in &self.segments {
            if rest < segment.length() {
                return Some(segment.at(rest));
            }
            rest -= segment.length();
        }
        Some(last.at(last.length()))
    }

    /// The smallest box that holds the curve; `None` if it has no point.
    pub fn bounding_box(&self) -> Option<Rect> {
        let start = self.start()?;
        let bounds = Rect::from_points(start, start);
        Some(self.segments.iter().fold(bounds, |bounds, s| bounds.union(s.bounding_box())))
    }

    /// The segment and arc length within it of the point nearest to `target`, and the distance,
    /// which exceeds the true one by at most `accuracy`. `None` for a curve without segments.
    pub fn nearest(&self, target: Point, accuracy: f64) -> Option<(usize, f64, f64)> {
        self.segments
            .iter()
            .enumerate()
            .map(|(index, segment)| {
                let (s, distance) = segment.nearest(target, accuracy);
                (index, s, distance)
            })
            .min_by(|a, b| a.2.total_cmp(&b.2))
    }

    /// ∫ κ² ds, in 1/units.
    pub fn bending_energy(&self) -> f64 {
        self.segments.iter().map(Segment::bending_energy).sum()
    }

    /// ∫ κ′² ds within segments, in 1/units³ (jumps at knots are not counted).
    pub fn variation_energy(&self) -> f64 {
        self.segments.iter().map(Segment::variation_energy).sum()
    }
}
