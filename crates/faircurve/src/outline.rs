//! What a designer gives: knots, how they join, contours, outlines.

use kurbo::{Point, Vec2};

use std::fmt;

/// What holds where two segments meet at a knot (thesis Table 7.1).
///
/// The four-parameter splines have all of these; a spline that lacks one puts its own smooth join
/// in its place and says so ([`Adaptation`](crate::Adaptation)).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Join {
    /// The curve may turn abruptly; each side is an end of its own.
    Corner,
    /// Continuous tangent. Without a given tangent the knot takes that of the circle through
    /// itself and its two neighbours; each side then knows nothing of the other.
    G1,
    /// Continuous tangent and curvature.
    G2,
    /// Continuous tangent, curvature, and first and second derivative of curvature.
    G4,
    /// One-way: the curve comes in and adapts to what leaves, which behaves as from an end
    /// (κ′ = κ″ = 0 on the outgoing side): typically a straight line.
    CurveToTerminal,
    /// One-way: what comes in behaves as toward an end (κ′ = κ″ = 0 on the incoming side), and
    /// the curve that leaves adapts to it.
    TerminalToCurve,
}

impl Join {
    /// Every join, weakest first.
    pub const ALL: [Join; 6] =
        [Join::Corner, Join::G1, Join::G2, Join::G4, Join::CurveToTerminal, Join::TerminalToCurve];

    /// The name used in documents and messages, such as `curve-to-terminal`.
    pub const fn name(self) -> &'static str {
        match self {
            Join::Corner => "corner",
            Join::G1 => "g1",
            Join::G2 => "g2",
            Join::G4 => "g4",
            Join::CurveToTerminal => "curve-to-terminal",
            Join::TerminalToCurve => "terminal-to-curve",
        }
    }

    /// The join of that name, if there is one.
    pub fn from_name(name: &str) -> Option<Join> {
        Join::ALL.into_iter().find(|join| join.name() == name)
    }

    /// The same join seen by someone who travels the contour the other way.
    pub const fn reversed(self) -> Join {
        match self {
            Join::CurveToTerminal => Join::TerminalToCurve,
            Join::TerminalToCurve => Join::CurveToTerminal,
            other => other,
        }
    }

    /// Whether the tangent is continuous through a knot of this kind: all but [`Join::Corner`].
    pub const fn is_smooth(self) -> bool {
        !matches!(self, Join::Corner)
    }
}

impl fmt::Display for Join {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A point that the curve passes through, with how it joins there and what else is given.
///
/// ```
/// use faircurve::{Join, Knot};
/// let knot = Knot::new((90.0, 10.0)).join(Join::Corner).tangent_out((1.0, 0.0));
/// assert_eq!(knot.join, Some(Join::Corner));
/// ```
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Knot {
    /// Where the curve passes, in user units, y up.
    pub point: Point,
    /// How the two segments meet here; `None` is the spline's own default. Ignored at the ends of
    /// an open contour.
    pub join: Option<Join>,
    /// Direction in which the curve must arrive (any length but zero).
    pub tangent_in: Option<Vec2>,
    /// Direction in which the curve must leave (any length but zero).
    pub tangent_out: Option<Vec2>,
    /// Curvature just before the knot, in 1/units, counterclockwise positive.
    pub curvature_in: Option<f64>,
    /// Curvature just after the knot, in 1/units, counterclockwise positive.
    pub curvature_out: Option<f64>,
    /// Tension just before the knot, for splines that have it.
    pub tension_in: Option<f64>,
    /// Tension just after the knot, for splines that have it.
    pub tension_out: Option<f64>,
    /// Curl at an end knot, for splines that have it.
    pub curl: Option<f64>,
}

impl Knot {
    /// A knot of which only the place is given.
    pub fn new(point: impl Into<Point>) -> Self {
        Knot { point: point.into(), ..Knot::default() }
    }

    /// Sets how the segments meet here.
    pub fn join(mut self, join: Join) -> Self {
        self.join = Some(join);
        self
    }

    /// Sets the direction of the curve on both sides.
    pub fn tangent(self, direction: impl Into<Vec2>) -> Self {
        let direction = direction.into();
        self.tangent_in(direction).tangent_out(direction)
    }

    /// Sets the direction in which the curve arrives.
    pub fn tangent_in(mut self, direction: impl Into<Vec2>) -> Self {
        self.tangent_in = Some(direction.into());
        self
    }

    /// Sets the direction in which the curve leaves.
    pub fn tangent_out(mut self, direction: impl Into<Vec2>) -> Self {
        self.tangent_out = Some(direction.into());
        self
    }

    /// Sets the curvature just before the knot, in 1/units.
    pub fn curvature_in(mut self, curvature: f64) -> Self {
        self.curvature_in = Some(curvature);
        self
    }

    /// Sets the curvature just after the knot, in 1/units.
    pub fn curvature_out(mut self, curvature: f64) -> Self {
        self.curvature_out = Some(curvature);
        self
    }

    /// The same knot for someone who travels the contour the other way: sides exchanged,
    /// directions turned round, curvatures negated.
    pub fn reversed(&self) -> Self {
        Knot {
            point: self.point,
            join: self.join.map(Join::reversed),
            tangent_in: self.tangent_out.map(|t| -t),
            tangent_out: self.tangent_in.map(|t| -t),
            curvature_in: self.curvature_out.map(|k| -k),
            curvature_out: self.curvature_in.map(|k| -k),
            tension_in: self.tension_out,
            tension_out: self.tension_in,
            curl: self.curl,
        }
    }
}

impl<P: Into<Point>> From<P> for Knot {
    fn from(point: P) -> Self {
        Knot::new(point)
    }
}

/// Knots in order, open or closed.
///
/// A closed contour of n knots has n segments, the last of which returns to the first knot (which
/// need not be repeated; if it is, the repeated one costs nothing). An open one has n − 1.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Contour {
    /// The knots in the order of travel.
    pub knots: Vec<Knot>,
    /// Whether the curve returns from the last knot to the first.
    pub closed: bool,
}

impl Contour {
    /// An open contour through the given knots.
    pub fn open(knots: impl IntoIterator<Item = impl Into<Knot>>) -> Self {
        Contour { knots: knots.into_iter().map(Into::into).collect(), closed: false }
    }

    /// A closed contour through the given knots.
    pub fn closed(knots: impl IntoIterator<Item = impl Into<Knot>>) -> Self {
        Contour { knots: knots.into_iter().map(Into::into).collect(), closed: true }
    }

    /// The number of segments that a curve through this contour has.
    pub fn segment_count(&self) -> usize {
        if self.closed { self.knots.len() } else { self.knots.len().saturating_sub(1) }
    }

    /// The same contour travelled the other way, starting from the last knot.
    pub fn reversed(&self) -> Self {
        Contour {
            knots: self.knots.iter().rev().map(Knot::reversed).collect(),
            closed: self.closed,
        }
    }
}

/// The contours of one drawing, such as a glyph.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Outline {
    /// The contours, in drawing order.
    pub contours: Vec<Contour>,
}
