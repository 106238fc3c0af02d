//! A contour made ready to be solved: what every spline needs settled, settled once.
//!
//! In order: numbers are checked; each knot's join is resolved (the spline's default, and its own
//! smooth join where it lacks the one asked); size is normalised; coincident neighbours become one
//! knot; straight segments are found; the rest is split at corners into [`Run`]s; and each run's
//! start and direction become canonical, so that the result can't depend on them.
//! [`Plan::assemble`] puts the solved runs back together in the input's numbering.

use std::cmp::Ordering;
use std::f64::consts::PI;
use std::fmt;

use kurbo::{Point, Vec2};

use crate::curve::Curve;
use crate::frame::{circle_tangent, direction, turning, wrap_angle};
use crate::numeric::order::sort_by;
use crate::numeric::rounding::power_of_two;
use crate::outline::{Contour, Join, Knot};
use crate::segment::{CurveEnd, Segment};
use crate::spline::{
    Adaptation, Place, Relaxation, RunSolution, Solution, SolveReport, SolvedKnot, Spline,
};
use crate::tolerance::{
    COINCIDENT, COORDINATE_ROUNDING, INVISIBLE, LARGEST_COORDINATE, LARGEST_CURVATURE,
    NEVER_STRAIGHT, SMALLEST_SIZE, STRAIGHT,
};

/// A knot as a spline sees it: in the run's frame, with its join resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunKnot {
    /// Place, in the run's frame.
    pub point: Point,
    /// Turning from the chord before to the chord after, in (−π, π]; 0 at the ends of an open run.
    pub turn: f64,
    /// How the segments meet: [`Join::G2`], [`Join::G4`] or a one-way join. At the ends of an open
    /// run, what joins it to what lies beyond; [`Join::Corner`] at the contour's own ends.
    pub join: Join,
    /// Direction given, in radians. At the ends of an open run: that of the end.
    pub tangent: Option<f64>,
    /// Curvature given, in the run's units. At the ends of an open run: that of the end.
    pub curvature: Option<f64>,
    /// Tension before and after, for splines that have it.
    pub tension: [Option<f64>; 2],
    /// Curl, for splines that have it.
    pub curl: Option<f64>,
}

/// A smooth stretch between corners: what a spline sees. Distinct neighbours, at least two knots
/// when open and two when closed; the whole contour spans at most 1 in x and y.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The knots in order.
    pub knots: Vec<RunKnot>,
    /// Whether the last knot joins the first.
    pub closed: bool,
    /// How many of the drawing's units the run's unit is: a power of two.
    pub unit: f64,
}

impl Run {
    /// The number of segments.
    pub fn segment_count(&self) -> usize {
        if self.closed { self.knots.len() } else { self.knots.len() - 1 }
    }

    /// A run without knots.
    pub(crate) const EMPTY: Run = Run { knots: Vec::new(), closed: false, unit: 1.0 };

    /// The chord vector of segment `index`.
    pub fn chord(&self, index: usize) -> Vec2 {
        let next = around(index + 1, self.knots.len());
        self.knots[next].point - self.knots[index].point
    }

    /// The knots `from ..= to` as an open run of their own.
    pub fn stretch(&self, from: usize, to: usize) -> Run {
        let n = self.knots.len();
        let count = if to > from { to - from } else { to + n - from };
        let mut knots: Vec<RunKnot> =
            (0..=count).map(|i| self.knots[around(from + i, n)]).collect();
        (knots[0].turn, knots[count].turn) = (0.0, 0.0);
        Run { knots, closed: false, unit: self.unit }
    }

    /// Fills in the turning angles.
    fn measured(mut self) -> Self {
        let segments = self.segment_count();
        let mut before = self.closed.then(|| self.chord(segments - 1));
        for i in 0..self.knots.len() {
            let after = (i < segments).then(|| self.chord(i));
            let turn = before.zip(after).map(|(before, after)| turning(before, after));
            self.knots[i].turn = turn.unwrap_or(0.0);
            before = after;
        }
        self
    }
}

/// Why a contour can't be solved at all: something in it has no meaning. Knots are numbered from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum InputError {
    /// The contour has no knots.
    Empty,
    /// A number at a knot isn't finite.
    NotFinite {
        /// The knot.
        knot: usize,
        /// Which of its numbers.
        what: &'static str,
    },
    /// A coordinate is larger than [`LARGEST_COORDINATE`].
    TooLarge {
        /// The knot.
        knot: usize,
    },
    /// The contour as a whole is smaller than [`SMALLEST_SIZE`], and not a single point.
    TooSmall,
    /// A given curvature times the size of the contour is larger than [`LARGEST_CURVATURE`].
    CurvatureTooLarge {
        /// The knot.
        knot: usize,
        /// `curvature_in` or `curvature_out`.
        what: &'static str,
    },
    /// A given direction has no length.
    ZeroTangent {
        /// The knot.
        knot: usize,
        /// `tangent_in` or `tangent_out`.
        what: &'static str,
    },
    /// A smooth knot is given two directions.
    TangentsDiffer {
        /// The knot.
        knot: usize,
        /// Its join.
        join: Join,
    },
    /// A knot whose curvature is continuous is given two curvatures.
    CurvaturesDiffer {
        /// The knot.
        knot: usize,
        /// Its join.
        join: Join,
    },
}

impl fmt::Display for InputError {
    /// The limits are spelled out: to write numbers by powers of ten costs the module for the web a kilobyte.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            InputError::Empty => f.write_str("the contour has no knots"),
            InputError::NotFinite { knot, what } => {
                write!(f, "{what} of knot {knot} is not a finite number")
            }
            InputError::TooLarge { knot } => {
                write!(f, "knot {knot} lies beyond 1e55 units")
            }
            InputError::TooSmall => f.write_str("the whole contour is smaller than 1e-55 units"),
            InputError::CurvatureTooLarge { knot, what } => {
                write!(f, "{what} of knot {knot} is that of a circle too small to be drawn here")
            }
            InputError::ZeroTangent { knot, what } => {
                write!(f, "{what} of knot {knot} has no length, so no direction")
            }
            InputError::TangentsDiffer { knot, join } => {
                write!(f, "knot {knot} joins {join}, yet its tangent_in and tangent_out differ")
            }
            InputError::CurvaturesDiffer { knot, join } => {
                write!(f, "knot {knot} joins {join}, yet its curvature_in and curvature_out differ")
            }
        }
    }
}

impl std::error::Error for InputError {}

impl InputError {
    /// What to do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            InputError::Empty => "give it at least one knot, or leave the contour out",
            InputError::NotFinite { .. } => "replace NaN and infinities by ordinary numbers",
            InputError::TooLarge { .. } | InputError::TooSmall => {
                "scale the drawing; the curve scales with it"
            }
            InputError::CurvatureTooLarge { .. } => {
                "curvature is 1 over the radius, in the drawing's units; or leave it out"
            }
            InputError::ZeroTangent { .. } => "give a vector such as [1, 0], or leave it out",
            InputError::TangentsDiffer { .. } => "make the join `corner`, or give one direction",
            InputError::CurvaturesDiffer { .. } => {
                "make the join `g1` or `corner`, or give one curvature"
            }
        }
    }
}

/// Knots that coincide, as one.
#[derive(Clone, Debug)]
struct Node {
    /// First and last of the input's knots, which follow each other (around the end, if closed).
    first: usize,
    last: usize,
    point: Point,
    join: Join,
    /// Whether it is for the spline to find what holds here; if not, the contour is cut here.
    is_inner: bool,
    tangent_in: Option<f64>,
    tangent_out: Option<f64>,
    curvature_in: Option<f64>,
    curvature_out: Option<f64>,
    tension: [Option<f64>; 2],
    curl: Option<f64>,
}

impl Node {
    /// Whether both sides are ends of their own.
    fn is_corner(&self) -> bool {
        self.join == Join::Corner && !self.is_inner
    }

    /// Takes in the join of a coincident knot: the same if they agree, a corner if either is one,
    /// else the weaker of the symmetric ones.
    fn merge_join(&mut self, other: ResolvedJoin) {
        self.is_inner &= other.is_inner;
        self.join = if self.join == other.join {
            self.join
        } else if self.join == Join::Corner || other.join == Join::Corner {
            Join::Corner
        } else if self.join == Join::G1 || other.join == Join::G1 {
            Join::G1
        } else {
            Join::G2
        };
    }
}

/// Where a run came from.
#[derive(Clone, Debug)]
struct RunPlace {
    /// Node at which it starts, in the contour's direction.
    first_node: usize,
    /// Whether the run is solved in the other direction.
    reversed: bool,
}

impl RunPlace {
    /// Which of `nodes` nodes knot `i` of the run is.
    fn node_of(&self, run: &Run, i: usize, nodes: usize) -> usize {
        let along = if self.reversed { run.knots.len() - 1 - i } else { i };
        around(self.first_node + along, nodes)
    }

    /// The node that the run's first segment in the contour's direction leaves.
    fn first_segment(&self, run: &Run, nodes: usize) -> usize {
        let last = run.segment_count() - 1;
        self.segment_of(run, if self.reversed { last } else { 0 }, nodes)
    }

    /// The node that segment `i` of the run leaves, in the contour's direction.
    fn segment_of(&self, run: &Run, i: usize, nodes: usize) -> usize {
        let count = run.segment_count();
        let along = match (self.reversed, run.closed) {
            (false, _) => i,
            (true, false) => count - 1 - i,
            // Backwards from the last knot, the closing segment comes last in both.
            (true, true) => around(2 * count - 2 - i, count),
        };
        around(self.first_node + along, nodes)
    }
}

/// A contour made ready for one spline.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The input's points, in user units.
    points: Vec<Point>,
    closed: bool,
    /// How many of the drawing's units the runs' unit is.
    unit: f64,
    nodes: Vec<Node>,
    /// For each node segment, whether it is a straight line.
    straight: Vec<bool>,
    runs: Vec<Run>,
    places: Vec<RunPlace>,
    adapted: Vec<Adaptation>,
}

impl Plan {
    /// Prepares a contour for a spline.
    ///
    /// # Errors
    /// [`InputError`] if something in the contour has no meaning.
    pub fn new(contour: &Contour, spline: &dyn Spline) -> Result<Plan, InputError> {
        check(contour)?;
        let (joins, mut adapted) = resolve_joins(contour, spline);
        let frame = NormalFrame::of(contour)?;
        frame.check_curvatures(contour)?;
        let mut nodes = merge_coincident(contour, &joins, &frame);
        if !spline.adapt(Join::G1).is_smooth() {
            ignore_given(&mut nodes, &mut adapted);
        }
        settle_given(&mut nodes, contour, &mut adapted)?;
        let mut plan = Plan {
            points: contour.knots.iter().map(|knot| knot.point).collect(),
            closed: contour.closed,
            unit: 1.0 / frame.scale,
            straight: Vec::new(),
            runs: Vec::new(),
            places: Vec::new(),
            adapted,
            nodes,
        };
        plan.find_straight_segments();
        plan.split_into_runs();
        Ok(plan)
    }

    /// The stretches to solve, each in its normal frame.
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// Number of segments between nodes.
    fn node_segments(&self) -> usize {
        match (self.nodes.len(), self.closed) {
            (1, _) => 0,
            (n, true) => n,
            (n, false) => n - 1,
        }
    }

    fn is_open_end(&self, node: usize) -> bool {
        !self.closed && (node == 0 || node + 1 == self.nodes.len())
    }

    /// Whether the side of `node` that looks along its outgoing (`outgoing`) or incoming segment
    /// carries κ′ = κ″ = 0 in full: an end or the straight side of a one-way join, nothing given.
    fn is_terminal(&self, node: usize, outgoing: bool) -> bool {
        let at = &self.nodes[node];
        let given = if outgoing {
            at.tangent_out.is_some() || at.curvature_out.is_some()
        } else {
            at.tangent_in.is_some() || at.curvature_in.is_some()
        };
        let one_way = if outgoing { Join::CurveToTerminal } else { Join::TerminalToCurve };
        !given && (self.is_open_end(node) || at.is_corner() || at.join == one_way)
    }

    /// A segment between two terminal sides has four conditions on the three derivatives of its
    /// curvature and none on the curvature itself: by definition it is the straight line (thesis
    /// section 7.4).
    fn find_straight_segments(&mut self) {
        let n = self.nodes.len();
        self.straight = (0..self.node_segments())
            .map(|i| self.is_terminal(i, true) && self.is_terminal(around(i + 1, n), false))
            .collect();
    }

    /// Splits at corners, at G1 knots and around straight segments.
    fn split_into_runs(&mut self) {
        let (n, segments) = (self.nodes.len(), self.node_segments());
        let splits = |node: usize| {
            let before = if node == 0 { segments.wrapping_sub(1) } else { node - 1 };
            self.is_open_end(node)
                || !self.nodes[node].is_inner
                || self.straight.get(node) == Some(&true)
                || self.straight.get(before) == Some(&true)
        };
        let breaks: Vec<usize> = (0..n).filter(|&node| segments > 0 && splits(node)).collect();
        let mut stretches: Vec<(usize, Run)> = Vec::new();
        if segments > 0 && breaks.is_empty() {
            let knots = (0..n).map(|node| self.interior_knot(node)).collect();
            stretches.push((0, Run { knots, closed: true, unit: self.unit }.measured()));
        }
        for (b, &from) in breaks.iter().enumerate() {
            let to = match breaks.get(b + 1) {
                Some(&next) => next,
                None if self.closed => breaks[0],
                None => break,
            };
            if self.straight[from] {
                continue;
            }
            let count = if to > from { to - from } else { to + n - from };
            let mut knots = vec![self.end_knot(from, true)];
            knots.extend((1..count).map(|i| self.interior_knot(around(from + i, n))));
            knots.push(self.end_knot(to, false));
            stretches.push((from, Run { knots, closed: false, unit: self.unit }.measured()));
        }
        for (first_node, run) in stretches {
            if is_straight(&run) {
                for i in 0..run.segment_count() {
                    self.straight[around(first_node + i, n)] = true;
                }
                continue;
            }
            let (run, first_node, reversed) = canonical(run, first_node, n);
            self.runs.push(run);
            self.places.push(RunPlace { first_node, reversed });
        }
    }

    fn interior_knot(&self, node: usize) -> RunKnot {
        let at = &self.nodes[node];
        RunKnot {
            point: at.point,
            turn: 0.0,
            join: at.join,
            tangent: at.tangent_in,
            curvature: at.curvature_in,
            tension: at.tension,
            curl: at.curl,
        }
    }

    /// A knot at which a run starts (`outgoing`) or ends. Where a straight line lies on the other
    /// side of a smooth knot, its direction and curvature are matched.
    fn end_knot(&self, node: usize, outgoing: bool) -> RunKnot {
        let at = &self.nodes[node];
        let (n, segments) = (self.nodes.len(), self.node_segments());
        let (mut tangent, mut curvature) = if outgoing {
            (at.tangent_out, at.curvature_out)
        } else {
            (at.tangent_in, at.curvature_in)
        };
        let beyond = if outgoing { around(node + segments - 1, segments) } else { node };
        if !self.is_open_end(node) && !at.is_corner() && self.straight[beyond] {
            let line = self.nodes[around(beyond + 1, n)].point - self.nodes[beyond].point;
            tangent = Some(direction(line));
            if at.join != Join::G1 {
                curvature = Some(0.0);
            }
        }
        let join = if self.is_open_end(node) { Join::Corner } else { at.join };
        RunKnot { join, tangent, curvature, ..self.interior_knot(node) }
    }

    /// The segments of a curve for such a contour, for each run those of its chords in its own
    /// direction; empty if there are more or fewer than the contour's.
    pub(crate) fn by_run(&self, segments: &[Segment]) -> Vec<Vec<Segment>> {
        let expected = if self.closed { self.points.len() } else { self.points.len() - 1 };
        if segments.len() != expected {
            return Vec::new();
        }
        let of_run = |(place, run): (&RunPlace, &Run)| {
            let segment = |i: usize| {
                let segment =
                    &segments[self.nodes[place.segment_of(run, i, self.nodes.len())].last];
                if place.reversed { segment.reversed() } else { segment.clone() }
            };
            (0..run.segment_count()).map(segment).collect()
        };
        self.places.iter().zip(&self.runs).map(of_run).collect()
    }

    /// Puts solved runs back together, in the input's numbering and units.
    ///
    /// # Panics
    /// Never, if `solved` holds one solution for each of [`runs`](Self::runs) with a segment for
    /// each chord; missing ones are drawn straight.
    pub fn assemble(&self, solved: Vec<RunSolution>) -> Solution {
        let (n, segments) = (self.nodes.len(), self.node_segments());
        let mut report = SolveReport { adapted: self.adapted.clone(), ..SolveReport::default() };
        // By the nodes that they leave, from the first run's first one on and around; lines between runs.
        let first = |(place, run): (&RunPlace, &Run)| place.first_segment(run, n);
        let start = match (self.closed, self.places.first().zip(self.runs.first())) {
            (true, Some(run)) => first(run),
            _ => 0,
        };
        let mut placed: Vec<Segment> = Vec::with_capacity(segments);
        for ((place, run), mut solution) in self.places.iter().zip(&self.runs).zip(solved) {
            let node_of = |i: usize| place.node_of(run, i, n);
            let segment_of = |i: usize| place.segment_of(run, i, n);
            self.draw_lines(&mut placed, start, around(first((place, run)) + n - start, n));
            solution.segments.truncate(run.segment_count());
            if place.reversed {
                solution.segments.reverse();
                solution.segments.iter_mut().for_each(|segment| *segment = segment.reversed());
            }
            for (i, segment) in solution.segments.iter_mut().enumerate() {
                let (from, to) = self.ends_of(around(start + placed.len() + i, n));
                segment.move_to(from, to, self.unit);
            }
            placed.append(&mut solution.segments);
            let input_place = |place: Place| match place {
                Place::Knot(i) => Place::Knot(self.nodes[node_of(i)].first),
                Place::Segment(i) => Place::Segment(self.nodes[segment_of(i)].last),
            };
            // What looks forward to the run looks backward in the contour.
            let input_join = |name: &'static str| match Join::from_name(name) {
                Some(join) if place.reversed => join.reversed().name(),
                _ => name,
            };
            report.relaxed.extend(solution.relaxed.into_iter().map(|r| Relaxation {
                place: input_place(r.place),
                asked: input_join(r.asked),
                got: input_join(r.got),
                ..r
            }));
            report.adapted.extend(
                solution
                    .adapted
                    .into_iter()
                    .map(|a| Adaptation { place: input_place(a.place), ..a }),
            );
            report.iterations = report.iterations.max(solution.iterations);
            report.residual = report.residual.max(solution.residual);
            report.stage = report.stage.max(solution.stage);
        }
        // Joins before what is given. Both runs at a knot may say the same of it.
        let order = |r: &Relaxation| {
            (r.place, Join::from_name(r.asked).is_none(), r.asked, Join::from_name(r.got))
        };
        sort_by(&mut report.relaxed, |a, b| order(a).cmp(&order(b)));
        report.relaxed.dedup_by_key(|r| (r.place, r.asked));
        sort_by(&mut report.adapted, |a, b| a.place.cmp(&b.place));
        self.draw_lines(&mut placed, start, segments);
        placed.rotate_right(start);
        let placed = self.fill_in(placed);
        let knots = self.solved_knots(&placed, &report);
        let curve = if placed.is_empty() && self.points.len() == 1 {
            Curve::from_point(self.points[0])
        } else {
            Curve::new(placed, self.closed)
        };
        Solution { curve, knots, report }
    }

    /// The input's points at both ends of the segment that leaves a node.
    fn ends_of(&self, node: usize) -> (Point, Point) {
        self.ends_from(self.nodes[node].last)
    }

    /// That point of the input and the next.
    fn ends_from(&self, point: usize) -> (Point, Point) {
        (self.points[point], self.points[around(point + 1, self.points.len())])
    }

    /// Draws lines until there are `count` segments from node `start` on.
    fn draw_lines(&self, placed: &mut Vec<Segment>, start: usize, count: usize) {
        while placed.len() < count {
            let (from, to) = self.ends_of(around(start + placed.len(), self.nodes.len()));
            placed.push(Segment::line(from, to));
        }
    }

    /// The segments of all the input's points, of those between nodes: between coincident knots segments of
    /// length 0.
    fn fill_in(&self, placed: Vec<Segment>) -> Vec<Segment> {
        let count = self.points.len();
        let total = if self.closed { count } else { count - 1 };
        if placed.len() == total {
            return placed;
        }
        // Between coincident knots: the direction of what arrives, or else of what leaves.
        let arriving = |s: &Segment| s.direction(s.length());
        let around = match (&placed[..], self.closed) {
            ([], _) => 0.0,
            ([.., last], true) => arriving(last),
            ([first, ..], false) => first.direction(0.0),
        };
        let mut whole: Vec<Segment> = Vec::with_capacity(total);
        let fill = |whole: &mut Vec<Segment>, to: usize| {
            while whole.len() < to {
                let (start, end) = self.ends_from(whole.len());
                let way = whole.last().map_or(around, arriving);
                whole.push(Segment::line_with_direction(start, end, way));
            }
        };
        for (segment, node) in placed.into_iter().zip(&self.nodes) {
            fill(&mut whole, node.last);
            whole.push(segment);
        }
        fill(&mut whole, total);
        whole
    }

    fn solved_knots(&self, segments: &[Segment], report: &SolveReport) -> Vec<SolvedKnot> {
        let count = self.points.len();
        let ends: Vec<[CurveEnd; 2]> = segments.iter().map(Segment::ends).collect();
        let mut knots = Vec::with_capacity(count);
        for node in &self.nodes {
            let before = match (node.first, self.closed) {
                (0, false) => None,
                (0, true) => ends.last(),
                (first, _) => ends.get(first - 1),
            };
            let arriving = before.map(|[_, end]| end);
            let leaving = ends.get(node.last).map(|[start, _]| start);
            let place = Place::Knot(node.first);
            let from = report.relaxed.partition_point(|r| r.place < place);
            let here = report.relaxed[from..].iter().take_while(|r| r.place == place);
            let got = here.filter_map(|r| Join::from_name(r.got)).min();
            let join = got.unwrap_or(node.join);
            let solved = SolvedKnot {
                point: self.points[node.first],
                join,
                direction_in: arriving.map(|end| wrap_angle(end.direction)),
                direction_out: leaving.map(|end| wrap_angle(end.direction)),
                curvature_in: arriving.map(|end| end.curvature),
                curvature_out: leaving.map(|end| end.curvature),
            };
            let members = around(node.last + count - node.first, count);
            knots.push(solved);
            for i in 1..=members {
                let point = self.points[around(node.first + i, count)];
                knots.push(SolvedKnot { point, ..solved });
            }
        }
        // In order but for those at the end that coincide with the first.
        knots.rotate_left(around(count - self.nodes[0].first, count));
        knots
    }
}

/// Refuses what has no meaning.
fn check(contour: &Contour) -> Result<(), InputError> {
    if contour.knots.is_empty() {
        return Err(InputError::Empty);
    }
    let fits = |coordinate: f64| coordinate.abs() <= LARGEST_COORDINATE;
    for (index, knot) in contour.knots.iter().enumerate() {
        let place_fits = fits(knot.point.x) && fits(knot.point.y);
        // Most knots have nothing else.
        let place_is_all = knot.tangent_in.is_none()
            && knot.tangent_out.is_none()
            && knot.curvature_in.is_none()
            && knot.curvature_out.is_none()
            && knot.tension_in.is_none()
            && knot.tension_out.is_none()
            && knot.curl.is_none();
        if !(place_fits && place_is_all) {
            check_knot(knot, index)?;
        }
    }
    Ok(())
}

/// Refuses a knot with something that has no meaning.
fn check_knot(knot: &Knot, index: usize) -> Result<(), InputError> {
    let numbers = [
        ("x", Some(knot.point.x)),
        ("y", Some(knot.point.y)),
        ("curvature_in", knot.curvature_in),
        ("curvature_out", knot.curvature_out),
        ("tension_in", knot.tension_in),
        ("tension_out", knot.tension_out),
        ("curl", knot.curl),
    ];
    let is_bad = |(_, number): &&(_, Option<f64>)| number.is_some_and(|x| !x.is_finite());
    if let Some((what, _)) = numbers.iter().find(is_bad) {
        return Err(InputError::NotFinite { knot: index, what });
    }
    if knot.point.x.abs().max(knot.point.y.abs()) > LARGEST_COORDINATE {
        return Err(InputError::TooLarge { knot: index });
    }
    for (what, tangent) in [("tangent_in", knot.tangent_in), ("tangent_out", knot.tangent_out)] {
        match tangent {
            Some(tangent) if !tangent.is_finite() => {
                return Err(InputError::NotFinite { knot: index, what });
            }
            Some(Vec2::ZERO) => return Err(InputError::ZeroTangent { knot: index, what }),
            _ => {}
        }
    }
    Ok(())
}

/// Each knot's join, with the spline's own where it lacks the one asked.
fn resolve_joins(contour: &Contour, spline: &dyn Spline) -> (Vec<ResolvedJoin>, Vec<Adaptation>) {
    let mut adapted = Vec::new();
    let (last, own) = (contour.knots.len() - 1, spline.default_join());
    let adapts = Join::ALL.map(|join| spline.adapt(join));
    let joins = contour
        .knots
        .iter()
        .enumerate()
        .map(|(index, knot)| {
            let asked = knot.join.unwrap_or(own);
            let got = adapts[asked as usize];
            let is_end = !contour.closed && (index == 0 || index == last);
            if got != asked && !is_end {
                let (asked, got) = (asked.name(), got.name());
                adapted.push(Adaptation { place: Place::Knot(index), asked, got });
            }
            // A knot joins as splines of that kind do, or is cut out of them by what is asked: a
            // corner asked for is one even where the spline's own joins are no better.
            let is_own = knot.join != Some(Join::Corner) && got == own;
            let is_inner = is_own || !matches!(got, Join::Corner | Join::G1);
            ResolvedJoin { join: got, is_inner }
        })
        .collect();
    (joins, adapted)
}

/// How a knot joins, and whether it is for the spline to find what holds there.
#[derive(Clone, Copy, Debug)]
struct ResolvedJoin {
    join: Join,
    is_inner: bool,
}

/// The scale that brings a contour to unit size. A power of two, so that it adds no rounding; and
/// no translation, which would round away what distinguishes close neighbours.
struct NormalFrame {
    scale: f64,
}

impl NormalFrame {
    fn of(contour: &Contour) -> Result<NormalFrame, InputError> {
        let first = contour.knots[0].point;
        let (mut low, mut high) = (first, first);
        for knot in &contour.knots {
            let p = knot.point;
            low = Point::new(low.x.min(p.x), low.y.min(p.y));
            high = Point::new(high.x.max(p.x), high.y.max(p.y));
        }
        let size = (high.x - low.x).max(high.y - low.y);
        if size > 0.0 && size < SMALLEST_SIZE {
            return Err(InputError::TooSmall);
        }
        let power = power_of_two(size);
        let scale = if size > power { 0.5 / power } else { 1.0 / power };
        let scale = if size > 0.0 { scale } else { 1.0 };
        Ok(NormalFrame { scale })
    }

    /// Refuses curvatures that would leave the range of numbers on the way.
    fn check_curvatures(&self, contour: &Contour) -> Result<(), InputError> {
        for (index, knot) in contour.knots.iter().enumerate() {
            let given =
                [("curvature_in", knot.curvature_in), ("curvature_out", knot.curvature_out)];
            for (what, curvature) in given {
                let is_large = |k: f64| !((k / self.scale).abs() <= LARGEST_CURVATURE);
                if curvature.is_some_and(is_large) {
                    return Err(InputError::CurvatureTooLarge { knot: index, what });
                }
            }
        }
        Ok(())
    }

    fn point(&self, p: Point) -> Point {
        (p.to_vec2() * self.scale).to_point()
    }
}

/// Turns knots into nodes, one for each stretch of coincident neighbours. What coincides with a
/// stretch's first knot belongs to it, too: step by step it may lead away and back again.
fn merge_coincident(contour: &Contour, joins: &[ResolvedJoin], frame: &NormalFrame) -> Vec<Node> {
    let knots = &contour.knots;
    let count = knots.len();
    let points: Vec<Point> = knots.iter().map(|knot| frame.point(knot.point)).collect();
    let largest = points.iter().fold(0.0, |largest: f64, p| largest.max(p.x.abs()).max(p.y.abs()));
    let near = (COINCIDENT * largest).max(INVISIBLE);
    let coincide = |i: usize, j: usize| {
        let apart = points[i] - points[j];
        apart.x.abs() <= near && apart.y.abs() <= near && {
            let rounding = COINCIDENT * largest_coordinate(points[i], points[j]);
            apart.hypot() <= rounding.max(INVISIBLE)
        }
    };
    let angle = |tangent: Option<Vec2>| tangent.map(direction);
    let mut nodes: Vec<Node> = Vec::with_capacity(count);
    for (i, knot) in knots.iter().enumerate() {
        let last_of = |knot: &Knot| {
            (angle(knot.tangent_out), knot.curvature_out.map(|k| k / frame.scale), knot.tension_out)
        };
        let (tangent_out, curvature_out, tension_out) = last_of(knot);
        match nodes.last_mut() {
            Some(node) if coincide(node.last, i) || coincide(node.first, i) => {
                node.merge_join(joins[i]);
                node.last = i;
                (node.tangent_out, node.curvature_out) = (tangent_out, curvature_out);
                node.tension[1] = tension_out;
            }
            _ => nodes.push(Node {
                first: i,
                last: i,
                point: points[i],
                join: joins[i].join,
                is_inner: joins[i].is_inner,
                tangent_in: angle(knot.tangent_in),
                tangent_out,
                curvature_in: knot.curvature_in.map(|k| k / frame.scale),
                curvature_out,
                tension: [knot.tension_in, tension_out],
                curl: knot.curl,
            }),
        }
    }
    // A first point repeated at the end.
    while contour.closed
        && let [_, .., tail] = &nodes[..]
        && (coincide(tail.last, 0) || coincide(tail.first, 0))
    {
        let tail = nodes.pop().unwrap_or_else(|| nodes[0].clone());
        let head = &mut nodes[0];
        head.first = tail.first;
        head.merge_join(ResolvedJoin { join: tail.join, is_inner: tail.is_inner });
        (head.tangent_in, head.curvature_in) = (tail.tangent_in, tail.curvature_in);
        head.tension[0] = tail.tension[0];
    }
    nodes
}

/// Drops the tangents and curvatures given, for splines that have corners only.
fn ignore_given(nodes: &mut [Node], adapted: &mut Vec<Adaptation>) {
    for node in nodes {
        let place = Place::Knot(node.first);
        let tangents = [node.tangent_in.take(), node.tangent_out.take()];
        let curvatures = [node.curvature_in.take(), node.curvature_out.take()];
        for (asked, given) in [("tangent", tangents), ("curvature", curvatures)] {
            if given.iter().any(Option::is_some) {
                adapted.push(Adaptation { place, asked, got: "ignored" });
            }
        }
    }
}

/// Brings what is given at smooth knots into one form: the same tangent and curvature on both
/// sides, G1 with a tangent wherever a G2 knot is given one, and every G1 knot with its tangent.
fn settle_given(
    nodes: &mut [Node],
    contour: &Contour,
    adapted: &mut Vec<Adaptation>,
) -> Result<(), InputError> {
    /// Directions given twice may differ by their rounding.
    const SAME_DIRECTION: f64 = 1e-9;
    let n = nodes.len();
    for i in 0..n {
        let is_end = !contour.closed && (i == 0 || i + 1 == n);
        let (before, after) = (nodes[around(i + n - 1, n)].point, nodes[around(i + 1, n)].point);
        let node = &mut nodes[i];
        if is_end || node.is_corner() || n == 1 {
            continue;
        }
        let join = node.join;
        if let (Some(a), Some(b)) = (node.tangent_in, node.tangent_out)
            && wrap_angle(a - b).abs() > SAME_DIRECTION
        {
            return Err(InputError::TangentsDiffer { knot: node.first, join });
        }
        node.tangent_in = node.tangent_in.or(node.tangent_out);
        node.tangent_out = node.tangent_in;
        let is_weak = matches!(join, Join::Corner | Join::G1 | Join::G2);
        if node.is_inner && is_weak && node.tangent_in.is_some() {
            (node.join, node.is_inner) = (Join::G1, false);
            if join != Join::G1 && contour.knots[node.first].join.is_some() {
                let place = Place::Knot(node.first);
                adapted.push(Adaptation { place, asked: join.name(), got: Join::G1.name() });
            }
        }
        if !node.is_inner {
            let tangent =
                node.tangent_in.unwrap_or_else(|| circle_tangent(before, node.point, after));
            (node.tangent_in, node.tangent_out) = (Some(tangent), Some(tangent));
        } else {
            if let (Some(a), Some(b)) = (node.curvature_in, node.curvature_out)
                && a != b
            {
                return Err(InputError::CurvaturesDiffer { knot: node.first, join });
            }
            node.curvature_in = node.curvature_in.or(node.curvature_out);
            node.curvature_out = node.curvature_in;
        }
    }
    Ok(())
}

/// The largest coordinate of two points, without sign.
fn largest_coordinate(a: Point, b: Point) -> f64 {
    a.x.abs().max(a.y.abs()).max(b.x.abs()).max(b.y.abs())
}

/// Whether the run is straight as far as its coordinates tell: no turning beyond their rounding,
/// nothing given that would bend it.
fn is_straight(run: &Run) -> bool {
    if run.closed {
        return false;
    }
    let chord_noise = |i: usize| {
        let coordinate = largest_coordinate(run.knots[i].point, run.knots[i + 1].point);
        let noise = STRAIGHT + COORDINATE_ROUNDING * coordinate / run.chord(i).hypot();
        noise.min(NEVER_STRAIGHT)
    };
    let count = run.segment_count();
    let aligned = |knot: &RunKnot, segment: usize| {
        let off = |tangent: f64| wrap_angle(tangent - direction(run.chord(segment))).abs();
        knot.curvature.unwrap_or(0.0) == 0.0
            && knot.tangent.is_none_or(|tangent| off(tangent) <= 2.0 * chord_noise(segment))
    };
    (1..count).all(|i| run.knots[i].turn.abs() <= chord_noise(i - 1) + chord_noise(i))
        && run.knots.iter().enumerate().all(|(i, knot)| aligned(knot, i.min(count - 1)))
}

/// The same run with a start and direction that depend neither on the input's start and direction
/// nor on how it is turned, mirrored or scaled: the least of all ways to write it down as a list of
/// [`Mark`]s. Returns the run, the node of its first knot in the contour's direction, and whether
/// it is reversed.
fn canonical(run: Run, first_node: usize, nodes: usize) -> (Run, usize, bool) {
    let n = run.knots.len();
    let marks = marks(&run);
    // Knot i of the way back is knot n − 1 − i.
    let ahead = |i: usize| around(i, n);
    let back = |i: usize| n - 1 - around(i, n);
    let place = |knot: usize| <(f64, f64)>::from(run.knots[knot].point);
    let seen_ahead = |i: usize| marks[ahead(i)].seen(0);
    let seen_back = |i: usize| marks[back(i)].seen(1);
    let (a, b) = match run.closed {
        true => (
            least_start(n, seen_ahead, |i| place(ahead(i))),
            least_start(n, seen_back, |i| place(back(i))),
        ),
        false => (0, 0),
    };
    let marked = (0..n).map(|i| seen_ahead(a + i).cmp(&seen_back(b + i)));
    let placed = (0..n)
        .map(|i| place(ahead(a + i)).partial_cmp(&place(back(b + i))).unwrap_or(Ordering::Equal));
    let order = marked.chain(placed).find(|order| order.is_ne()).unwrap_or(Ordering::Equal);
    let keep = order.is_le();
    let knots = match keep {
        true => from(&run.knots, a).copied().collect(),
        false => (0..n).map(|i| reversed_knot(run.knots[back(b + i)])).collect(),
    };
    // Knot b of the reversed list is knot n − 1 − b; the walk ends at the one after it.
    let first = if keep { a } else { around(n - b, n) };
    (Run { knots, closed: run.closed, unit: run.unit }, around(first_node + first, nodes), !keep)
}

/// Where the least rotation of a closed run of `n` knots starts, as they are seen. A symmetric run has several such
/// starts; any will do, so long as it is the same one: that of the least place.
fn least_start(
    n: usize,
    seen: impl Fn(usize) -> Seen,
    place: impl Fn(usize) -> (f64, f64),
) -> usize {
    let (mut start, mut least, mut is_alone) = (0, seen(0), true);
    for i in 1..n {
        let here = seen(i);
        match here.cmp(&least) {
            Ordering::Less => (start, least, is_alone) = (i, here, true),
            Ordering::Equal => is_alone = false,
            Ordering::Greater => {}
        }
    }
    if is_alone {
        return start;
    }
    let all: Vec<Seen> = (0..n).map(seen).collect();
    let (start, period) = least_rotation(&all);
    (0..n / period)
        .map(|i| around(start + i * period, n))
        .fold(start, |best, i| if place(i) < place(best) { i } else { best })
}

/// What a knot looks like; the numbers rounded and without sign, so that neither rounding errors nor mirrors tell
/// knots apart that are alike.
#[derive(Clone, Copy)]
struct Mark {
    /// For someone who travels the run, and for someone who travels it the other way.
    join: [Join; 2],
    turn: i64,
    /// The chord that follows, either way, over the longest one; 0 after the last of an open run.
    chord: [i64; 2],
    /// The tangent from that chord; less than any if none is given.
    tangent: [i64; 2],
    /// The curvature by the longest chord; less than any if none is given.
    curvature: i64,
}

/// The parts of a [`Mark`] that one who travels this way sees, in order of weight.
type Seen = (Join, i64, i64, i64, i64);

impl Mark {
    fn seen(&self, way: usize) -> Seen {
        (self.join[way], self.turn, self.chord[way], self.tangent[way], self.curvature)
    }
}

/// Alike to a billionth of a radian or of the run's size.
fn coarse(number: f64) -> i64 {
    (number.abs() * 1e9 + 0.5) as i64
}

/// The marks of a run's knots.
fn marks(run: &Run) -> Vec<Mark> {
    const NONE: i64 = -1;
    let last = run.segment_count() - 1;
    let lengths: Vec<f64> = (0..=last).map(|i| run.chord(i).hypot()).collect();
    let size = lengths.iter().copied().fold(0.0, f64::max);
    let off = |tangent: f64, chord: Vec2| coarse(wrap_angle(tangent - direction(chord)));
    let mut before = if run.closed { coarse(lengths[last] / size) } else { 0 };
    let mark = |(i, knot): (usize, &RunKnot)| {
        let after = lengths.get(i).map_or(0, |length| coarse(length / size));
        let chord = [after, before];
        before = after;
        let tangent = knot.tangent.map_or([NONE; 2], |tangent| {
            let behind = match i {
                0 if run.closed => last,
                0 => 0,
                _ => i - 1,
            };
            let back = wrap_angle(tangent + PI);
            [off(tangent, run.chord(i.min(last))), off(back, -run.chord(behind))]
        });
        Mark {
            join: [knot.join, knot.join.reversed()],
            turn: coarse(knot.turn),
            chord,
            tangent,
            curvature: knot.curvature.map_or(NONE, |curvature| coarse(curvature * size)),
        }
    };
    run.knots.iter().enumerate().map(mark).collect()
}

/// The place `index` of a list of `count`, counted around its end at most once.
pub(crate) fn around(index: usize, count: usize) -> usize {
    if index < count { index } else { index - count }
}

/// The list from `start` on, and around.
fn from<T>(list: &[T], start: usize) -> impl Iterator<Item = &T> {
    list[start..].iter().chain(&list[..start])
}

/// Where the lexicographically least rotation of a list starts, and after how many places the list
/// repeats, in linear time: two candidates race, and the loser skips all that it has compared.
fn least_rotation<T: Ord>(list: &[T]) -> (usize, usize) {
    let n = list.len();
    let at = |place: usize| &list[around(place, n)];
    let (mut i, mut j, mut same) = (0, 1, 0);
    while i < n && j < n && same < n {
        match at(i + same).cmp(at(j + same)) {
            Ordering::Equal => {
                same += 1;
                continue;
            }
            Ordering::Greater => i += same + 1,
            Ordering::Less => j += same + 1,
        }
        if i == j {
            j += 1;
        }
        same = 0;
    }
    let period = if same == n { i.abs_diff(j) } else { n };
    (i.min(j), period)
}

fn reversed_knot(knot: RunKnot) -> RunKnot {
    RunKnot {
        turn: if knot.turn == PI { knot.turn } else { -knot.turn },
        join: knot.join.reversed(),
        tangent: knot.tangent.map(|t| wrap_angle(t + PI)),
        curvature: knot.curvature.map(|k| -k),
        tension: [knot.tension[1], knot.tension[0]],
        ..knot
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_name_the_limits() {
        for (error, limit) in [
            (InputError::TooLarge { knot: 3 }, LARGEST_COORDINATE),
            (InputError::TooSmall, SMALLEST_SIZE),
        ] {
            assert!(error.to_string().contains(&format!(" {limit:e} units")), "{error}");
        }
    }
}
