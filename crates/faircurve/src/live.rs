//! A contour under the hand of a designer: knots move, come and go, and the curve follows.
//!
//! [`solve`](crate::solve) gives the canonical curve of a contour, whatever was there before. While a
//! knot is being dragged, that may jump from one curve to another where a contour has several. A
//! [`LiveContour`] stays on the branch on which it is for as long as there is one, each solution
//! starting from the last ([`solve_near`]); [`settle`](LiveContour::settle) gives the canonical one.

use std::ops::Range;
use std::sync::Arc;

use kurbo::{BezPath, PathEl, Point};

use crate::convert::{self, Options};
use crate::families::euler::fit_euler;
use crate::families::spiro::PolynomialSpirals;
use crate::four_param::family::FourParamFamily;
use crate::frame::{ChordAngles, direction, wrap_angle};
use crate::outline::{Contour, Knot};
use crate::plan::InputError;
use crate::segment::Segment;
use crate::spline::{Effort, Solution, Spline, solve_near, solve_with};

/// A contour, its spline, and the curve that follows its edits.
///
/// Edits change the contour; [`solve`](Self::solve) brings the curve up to date, so that several
/// edits cost one solution. A clone is a snapshot: it shares everything with the original until
/// one of them changes.
///
/// ```
/// use std::sync::Arc;
/// use faircurve::{Contour, Knot, LiveContour, catalog};
///
/// let contour = Contour::closed([(0.0, 0.0), (100.0, 0.0), (100.0, 80.0), (0.0, 90.0)]);
/// let mut live = LiveContour::new(contour, Arc::from(catalog::spline("spiro")?))?;
/// let before = live.clone();
/// live.set_knot(2, Knot::new((120.0, 85.0)));
/// live.solve()?;
/// assert!(live.solution().curve.length() > before.solution().curve.length());
/// live = before; // undone
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct LiveContour {
    contour: Arc<Contour>,
    spline: Arc<dyn Spline>,
    solution: Arc<Solution>,
    /// A segment for each of the contour's: those of the solution, with what edits have added.
    near: Arc<Vec<Segment>>,
    beziers: Option<Arc<Beziers>>,
}

impl LiveContour {
    /// The contour with its canonical curve.
    ///
    /// # Errors
    /// As for [`solve`](crate::solve).
    pub fn new(contour: Contour, spline: Arc<dyn Spline>) -> Result<Self, InputError> {
        let solution = solve_with(&contour, &*spline, Effort::default())?;
        let near = Arc::new(solution.curve.segments().to_vec());
        let (contour, solution) = (Arc::new(contour), Arc::new(solution));
        Ok(LiveContour { contour, spline, solution, near, beziers: None })
    }

    /// The contour with every edit.
    pub fn contour(&self) -> &Contour {
        &self.contour
    }

    /// The spline.
    pub fn spline(&self) -> &dyn Spline {
        &*self.spline
    }

    /// The curve, of when it was last solved.
    pub fn solution(&self) -> &Arc<Solution> {
        &self.solution
    }

    /// Changes a knot: its place, its join, what is given there. Nothing happens where there is no
    /// such knot.
    pub fn set_knot(&mut self, index: usize, knot: Knot) {
        if let Some(old) = Arc::make_mut(&mut self.contour).knots.get_mut(index) {
            *old = knot;
        }
    }

    /// Changes every knot at once, such as in a rotation. Where their number changes, the next curve
    /// is the canonical one.
    pub fn set_knots(&mut self, knots: Vec<Knot>) {
        if knots.len() != self.contour.knots.len() {
            self.near = Arc::default();
        }
        Arc::make_mut(&mut self.contour).knots = knots;
    }

    /// Makes a knot the one of that index (at most the number of knots: the end), so that the one that
    /// was there follows it.
    pub fn insert(&mut self, index: usize, knot: Knot) {
        let count = self.contour.knots.len();
        let index = index.min(count);
        let is_known = self.is_known();
        let near = Arc::make_mut(&mut self.near);
        if is_known && count > 0 {
            let is_inner = self.contour.closed || (index > 0 && index < count);
            if is_inner {
                let divided = (index + count - 1) % count;
                let [before, after] = divide(&near[divided], knot.point);
                near[divided] = before;
                near.insert(divided + 1, after);
                if index == 0 {
                    // The piece behind the new first knot leaves it.
                    near.rotate_right(1);
                }
            } else if index == 0 {
                let next = near.first().map(|segment| segment.direction(0.0));
                near.insert(0, between(knot.point, self.contour.knots[0].point, None, next));
            } else {
                let last = near.last().map(|segment| segment.direction(segment.length()));
                near.push(between(self.contour.knots[count - 1].point, knot.point, last, None));
            }
        }
        Arc::make_mut(&mut self.contour).knots.insert(index, knot);
    }

    /// Takes a knot out. Nothing happens where there is no such knot.
    pub fn remove(&mut self, index: usize) {
        let count = self.contour.knots.len();
        if index >= count {
            return;
        }
        let is_known = self.is_known();
        let near = Arc::make_mut(&mut self.near);
        if is_known && count > 1 {
            if self.contour.closed || (index > 0 && index + 1 < count) {
                let before = (index + count - 1) % count;
                let [arriving, leaving] = [&near[before], &near[index]];
                let start = arriving.direction(0.0);
                let end = leaving.direction(leaving.length());
                let whole = between(arriving.start(), leaving.end(), Some(start), Some(end));
                near[before] = whole;
                near.remove(index);
            } else {
                near.remove(if index == 0 { 0 } else { index - 1 });
            }
        }
        Arc::make_mut(&mut self.contour).knots.remove(index);
    }

    /// Closes the contour, or opens it between its last knot and its first.
    pub fn set_closed(&mut self, closed: bool) {
        let is_known = self.is_known();
        if closed == self.contour.closed {
            return;
        }
        let near = Arc::make_mut(&mut self.near);
        if let (true, Some(first), Some(last)) = (is_known, near.first(), near.last()) {
            if closed {
                let (start, end) = (last.direction(last.length()), first.direction(0.0));
                near.push(between(last.end(), first.start(), Some(start), Some(end)));
            } else {
                near.pop();
            }
        }
        Arc::make_mut(&mut self.contour).closed = closed;
    }

    /// Changes the spline; the next curve is its canonical one.
    pub fn set_spline(&mut self, spline: Arc<dyn Spline>) {
        self.spline = spline;
        self.near = Arc::default();
    }

    /// Brings the curve up to date: near the one before it, where that is possible with `effort`.
    ///
    /// Where no such curve is found and none is quickly found from anew, it is searched for with
    /// `effort`; a small one keeps hard contours from holding up the hand.
    ///
    /// # Errors
    /// As for [`solve`](crate::solve). The curve stays what it was, and is near to the next.
    pub fn solve_with(&mut self, effort: Effort) -> Result<&Solution, InputError> {
        let solution = solve_near(&self.contour, &*self.spline, effort, &self.near)?;
        Ok(self.keep(solution))
    }

    /// The same with the [effort](Self::in_hand) that is meant for a curve that follows a hand.
    ///
    /// # Errors
    /// As for [`solve_with`](Self::solve_with).
    pub fn solve(&mut self) -> Result<&Solution, InputError> {
        self.solve_with(Self::in_hand())
    }

    /// A search of about a millisecond, where the curve can't be followed.
    pub fn in_hand() -> Effort {
        Effort::times(0.02)
    }

    /// Gives up the branch for the canonical curve, which the same contour has when it is opened anew.
    ///
    /// # Errors
    /// As for [`solve`](crate::solve).
    pub fn settle(&mut self) -> Result<&Solution, InputError> {
        let solution = solve_with(&self.contour, &*self.spline, Effort::default())?;
        Ok(self.keep(solution))
    }

    /// The curve as [`convert::to_bezpath`] has it, within `accuracy`; segments that are where they
    /// were when last asked, but for a hundredth of `accuracy`, keep their Béziers, so that the
    /// cost is that of what has moved.
    pub fn beziers(&mut self, accuracy: f64) -> &BezPath {
        let curve = &self.solution.curve;
        let kept = self.beziers.take().filter(|known| known.accuracy == accuracy);
        let kept = kept.map(Arc::unwrap_or_clone).unwrap_or_default();
        let beziers = kept.updated(curve.segments(), curve.start(), curve.is_closed(), accuracy);
        &self.beziers.insert(Arc::new(beziers)).path
    }

    /// Whether there is a segment to start from for each of the contour's.
    fn is_known(&self) -> bool {
        !self.near.is_empty() && self.near.len() == self.contour.segment_count()
    }

    fn keep(&mut self, solution: Solution) -> &Solution {
        self.near = Arc::new(solution.curve.segments().to_vec());
        self.solution = Arc::new(solution);
        &self.solution
    }
}

/// A segment in two, for a new knot: where the curve passes it most closely.
fn divide(segment: &Segment, knot: Point) -> [Segment; 2] {
    let length = segment.length();
    let (s, _) = segment.nearest(knot, 1e-6 * length);
    [segment.subsegment(0.0, s), segment.subsegment(s, length)]
}

/// A segment to start from: the Euler spiral with these directions at its ends, symmetric where only
/// one is known.
fn between(start: Point, end: Point, leaving: Option<f64>, arriving: Option<f64>) -> Segment {
    if start == end {
        return Segment::line(start, end);
    }
    let chord = direction(end - start);
    let theta0 = leaving.map(|leaving| wrap_angle(chord - leaving));
    let theta1 = arriving.map(|arriving| wrap_angle(arriving - chord));
    let angles = ChordAngles::new(
        theta0.or(theta1).unwrap_or_default(),
        theta1.or(theta0).unwrap_or_default(),
    );
    match fit_euler(angles) {
        Ok(spiral) => Segment::spiral(start, end, spiral),
        Err(_) => Segment::line(start, end),
    }
}

/// A path, and which of its elements each segment is.
#[derive(Clone, Debug, Default)]
struct Beziers {
    path: BezPath,
    accuracy: f64,
    /// The segments as they were when their Béziers were fitted, with the places of those.
    fitted: Vec<(Segment, Range<usize>)>,
}

impl Beziers {
    /// The path of a curve within `accuracy`, with what still serves of this one.
    fn updated(
        self,
        segments: &[Segment],
        start: Option<Point>,
        closed: bool,
        accuracy: f64,
    ) -> Beziers {
        /// How far a curve may move away from its Béziers, as a part of the accuracy; the fit leaves
        /// room for it.
        const SLACK: f64 = 0.01;
        let options = Options::new(accuracy * (1.0 - SLACK));
        let mut next = Beziers { accuracy, ..Beziers::default() };
        let Some(start) = start else { return next };
        next.path.push(PathEl::MoveTo(start));
        for (i, segment) in segments.iter().enumerate() {
            let from = next.path.elements().len();
            let as_before = self
                .fitted
                .get(i)
                .filter(|(before, _)| distance_bound(before, segment) <= SLACK * accuracy);
            let fitted = match as_before {
                Some((before, place)) => {
                    next.path.extend(self.path.elements()[place.clone()].iter().copied());
                    before.clone()
                }
                None => {
                    let alone = crate::Curve::new(vec![segment.clone()], false);
                    let path = convert::convert(&alone, &options).path;
                    next.path.extend(path.elements().iter().copied().skip(1));
                    segment.clone()
                }
            };
            next.fitted.push((fitted, from..next.path.elements().len()));
        }
        if closed {
            next.path.push(PathEl::ClosePath);
        }
        next
    }
}

/// How far two segments can be from each other, at most; infinite where that isn't known.
fn distance_bound(a: &Segment, b: &Segment) -> f64 {
    if (a.start(), a.end()) != (b.start(), b.end()) {
        return f64::INFINITY;
    }
    if a == b {
        return 0.0;
    }
    match (a.kappa(), b.kappa()) {
        (Some(a_k), Some(b_k)) => {
            // For arc length 1, directions from the middle differ by at most this …
            let turn = PolynomialSpirals.bend(std::array::from_fn(|j| a_k[j] - b_k[j]));
            // … points from the middle by at most half of it, and the whole is scaled and turned
            // so that both its ends are where they were, which moves nothing by more than its ends.
            2.0 * turn * a.length().max(b.length()) / chord_over_arc(a).min(chord_over_arc(b))
        }
        _ => f64::INFINITY,
    }
}

fn chord_over_arc(segment: &Segment) -> f64 {
    segment.chord_length() / segment.length()
}
