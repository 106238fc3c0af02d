//! The properties of thesis chapter 2, measured on any spline: numbers, no judgements (those are
//! [`verdict`](super::verdict)'s).
//!
//! Knots are random with a fixed seed, or chosen; every knot has the spline's default join. Distances are
//! fractions of the drawing's size. What is measured on samples is a witness *against* a law when it
//! is large, never a proof of one when it is small.

use std::f64::consts::TAU;

use kurbo::{Affine, Point, Vec2};

use super::fairness::{jumps, jumps_within};
use crate::frame::{direction, wrap_angle};
use crate::numeric::order::sort_by;
use crate::outline::{Contour, Knot};
use crate::segment::{Segment, Shape};
use crate::spline::{Solution, Spline, Status, solve};

/// Everything measured of one spline.
#[derive(Clone, Debug, PartialEq)]
pub struct Laws {
    /// How far the curve is from its knots, at most.
    pub misses: f64,
    /// How the curve follows maps of the plane and the other direction of travel (2.7).
    pub invariance: Invariance,
    /// The largest jumps, at knots and at joints between them, of direction, κ, κ′, κ″, without units
    /// ([`Jump::dimensionless`](super::Jump::dimensionless)), on gentle drawings solved as asked
    /// (2.2); `None` if there are none.
    pub jumps: Option<[f64; 4]>,
    /// Knots on a circle (2.3).
    pub roundness: Roundness,
    /// A knot added on the curve (2.4).
    pub extensionality: Extensionality,
    /// How far a change reaches (2.6).
    pub locality: Locality,
    /// The share of segments on which curvature is monotone, on gentle drawings (2.9).
    pub monotone: f64,
    /// Which drawings are solved as asked (2.5).
    pub existence: Vec<Existence>,
    /// Whether small moves of a knot move the curve little (2.5), on random knots.
    pub moves: Moves,
    /// Number of parameters of a segment: the rank of how its shape, on the unit chord, answers to
    /// moves of the knots (2.8).
    pub parameters: usize,
    /// How far the segments are from being cut from one curve, up to similarity and mirror (4.1,
    /// Theorem 1): see [`spread_about_one_curve`]. `None` where nothing is curved.
    pub spread: Option<f64>,
}

/// The largest distance of the curve through mapped knots from the mapped curve.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Invariance {
    /// Under scaling, turning, moving.
    pub similarity: f64,
    /// Under mirroring.
    pub mirror: f64,
    /// Under the other direction of travel.
    pub direction: f64,
    /// Under a shear.
    pub affine: f64,
}

/// The largest distance from the circle, over its radius.
#[derive(Clone, Debug, PartialEq)]
pub struct Roundness {
    /// Of the closed curve through n points evenly on the circle: (n, distance).
    pub even: Vec<(usize, f64)>,
    /// Of curves, open and closed, through points that are not even.
    pub uneven: f64,
    /// k, if the distance falls as n⁻ᵏ: from the two largest n for which rounding doesn't hide it;
    /// `None` where it is rounding from the start.
    pub order: Option<f64>,
}

/// How far the curve moves when a knot is added on it.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Extensionality {
    /// On closed curves, and two segments or more from an open one's ends.
    pub inside: f64,
    /// On the first and last segment of open curves, where the spline's end rule takes part.
    pub at_ends: f64,
}

/// How far a change reaches.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Locality {
    /// By what factor the ripple of a small push shrinks from knot to knot, on straight evenly
    /// spaced knots; 0 where there is none two segments on.
    pub ripple: f64,
    /// How many segments on either side of a moved knot change at all; `None` if they don't end
    /// within [`FARTHEST`].
    pub support: Option<usize>,
}

/// Segments on either side up to which support counts as finite.
pub const FARTHEST: usize = 7;

/// How many drawings of a class were solved as asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Existence {
    /// The class.
    pub class: &'static str,
    /// Drawings solved as asked.
    pub solved: usize,
    /// Drawings tried.
    pub of: usize,
}

/// What becomes of the curve while one of five random knots moves along a line.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Moves {
    /// How far the curve moves for each unit that the knot does: the median, over paths without
    /// jumps, of the largest ratio of each; `None` if all have jumps.
    pub ratio: Option<f64>,
    /// The share of paths on which the curve jumps: it moves by more than [`Moves::JUMP`] while the
    /// knot moves by less than 10⁻⁵.
    pub jumps: f64,
}

impl Moves {
    /// As a fraction of the drawing's size.
    pub const JUMP: f64 = 0.03;
}

impl Laws {
    /// Measures a spline; a fraction of a second for most, some seconds for those that search long.
    pub fn measure(spline: &dyn Spline) -> Laws {
        let gentle = Gentle::new(spline);
        Laws {
            misses: misses(&gentle),
            invariance: invariance(spline, &gentle),
            jumps: largest_jumps(&gentle),
            roundness: roundness(spline),
            extensionality: extensionality(spline, &gentle),
            locality: Locality { ripple: ripple(spline), support: support(spline) },
            monotone: share_of_monotone(&gentle),
            existence: existence(spline),
            moves: moves(spline),
            parameters: parameters(spline),
            spread: spread_about_one_curve(&gentle.solutions),
        }
    }

    /// The share of all drawings solved as asked.
    pub fn share_solved(&self) -> f64 {
        let sum = |of: fn(&Existence) -> usize| self.existence.iter().map(of).sum::<usize>() as f64;
        sum(|e| e.solved) / sum(|e| e.of)
    }
}

/// Uniform numbers, the same in every run.
struct Random(u64);

impl Random {
    fn new(seed: u64) -> Self {
        let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15));
        random.next();
        random
    }

    /// In [−1, 1).
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A walk whose turns are at most `turn` and whose steps differ up to 2.3-fold.
    fn walk(&mut self, count: usize, turn: f64) -> Contour {
        let (mut point, mut heading) = (Point::ORIGIN, 3.0 * self.next());
        let knots: Vec<Point> = (0..count)
            .map(|_| {
                let here = point;
                heading += turn * self.next();
                point += Vec2::from_angle(heading) * (1.0 + 0.4 * self.next());
                here
            })
            .collect();
        Contour::open(knots)
    }

    /// Knots round a centre, each moved by up to that part of their spacing along, and across, the
    /// circle.
    fn ring(&mut self, count: usize, jitter: f64) -> Contour {
        let spacing = TAU / count as f64;
        let knots: Vec<Point> = (0..count)
            .map(|i| {
                let angle = spacing * (i as f64 + jitter * self.next());
                on_circle(angle, 1.0 + jitter * spacing * self.next())
            })
            .collect();
        Contour::closed(knots)
    }

    fn uniform(&mut self, count: usize, closed: bool) -> Contour {
        let knots: Vec<Point> = (0..count).map(|_| Point::new(self.next(), self.next())).collect();
        Contour { closed, ..Contour::open(knots) }
    }
}

fn on_circle(angle: f64, radius: f64) -> Point {
    (Vec2::from_angle(angle) * radius).to_point()
}

/// The curve through a contour, unless it is refused.
fn curve_of(contour: &Contour, spline: &dyn Spline) -> Option<Solution> {
    solve(contour, spline).ok()
}

/// Drawings such as people make: turns of up to 0.8 rad, chords that differ up to 2.3-fold.
struct Gentle {
    contours: Vec<Contour>,
    solutions: Vec<Solution>,
}

impl Gentle {
    fn new(spline: &dyn Spline) -> Self {
        let mut random = Random::new(1);
        let all = (0..24).map(|i| {
            let knots = 5 + i % 5;
            if i % 2 == 0 { random.walk(knots, 0.8) } else { random.ring(knots + 2, 0.2) }
        });
        let solved = |contour: Contour| Some((curve_of(&contour, spline)?, contour));
        let (solutions, contours) = all.filter_map(solved).unzip();
        Gentle { contours, solutions }
    }

    fn pairs(&self) -> impl Iterator<Item = (&Contour, &Solution)> {
        self.contours.iter().zip(&self.solutions)
    }

    /// The segments of those solved as asked.
    fn segments(&self) -> impl Iterator<Item = &Segment> {
        let solved = self.solutions.iter().filter(|s| s.report.status() == Status::Solved);
        solved.flat_map(|solution| solution.curve.segments())
    }
}

/// The largest side of the box of the knots.
fn size(contour: &Contour) -> f64 {
    let first = contour.knots[0].point;
    contour.knots.iter().map(|knot| (knot.point - first).hypot()).fold(f64::MIN_POSITIVE, f64::max)
}

/// Points at equal fractions of a segment's arc length, both ends included.
const PLACES: usize = 8;

fn trace_segment(segment: &Segment) -> impl Iterator<Item = Point> + '_ {
    (0..=PLACES).map(|i| segment.point(segment.length() * (i as f64 / PLACES as f64)))
}

fn trace(solution: &Solution) -> Vec<Point> {
    solution.curve.segments().iter().flat_map(trace_segment).collect()
}

/// The largest distance of corresponding points.
fn distance(a: &[Point], b: &[Point]) -> f64 {
    let apart = a.iter().zip(b).map(|(a, b)| (*a - *b).hypot());
    apart.fold(0.0, f64::max)
}

fn misses(gentle: &Gentle) -> f64 {
    /// A little off the ends, which are stored.
    const OFF: f64 = 1e-7;
    let mut most = 0.0f64;
    for (contour, solution) in gentle.pairs() {
        let n = contour.knots.len();
        for (i, segment) in solution.curve.segments().iter().enumerate() {
            let (start, end) = (contour.knots[i].point, contour.knots[(i + 1) % n].point);
            let off = OFF * segment.length();
            for (s, knot) in [(off, start), (segment.length() - off, end)] {
                most = most.max(((segment.point(s) - knot).hypot() - off) / size(contour));
            }
        }
    }
    most
}

fn invariance(spline: &dyn Spline, gentle: &Gentle) -> Invariance {
    let similarity = Affine::translate((37.0, -11.0)) * Affine::rotate(2.0) * Affine::scale(73.0);
    let shear = Affine::new([1.0, 0.0, 0.5, 1.0, 0.0, 0.0]);
    let mut most = Invariance::default();
    for (contour, solution) in gentle.pairs() {
        let off = |map: Affine| {
            let knots = contour.knots.iter().map(|knot| Knot::new(map * knot.point));
            let mapped = Contour { knots: knots.collect(), closed: contour.closed };
            let there: Vec<Point> = trace(solution).into_iter().map(|p| map * p).collect();
            curve_of(&mapped, spline)
                .map_or(f64::MAX, |curve| distance(&there, &trace(&curve)) / size(&mapped))
        };
        most.similarity = most.similarity.max(off(similarity));
        most.mirror = most.mirror.max(off(Affine::FLIP_Y));
        most.affine = most.affine.max(off(shear));
        most.direction = most.direction.max(off_backwards(spline, contour, solution));
    }
    most
}

fn off_backwards(spline: &dyn Spline, contour: &Contour, solution: &Solution) -> f64 {
    let Some(backwards) = curve_of(&contour.reversed(), spline) else { return f64::MAX };
    let (there, back) = (solution.curve.segments(), backwards.curve.segments());
    let n = there.len();
    let mut most = 0.0f64;
    for (i, segment) in there.iter().enumerate() {
        // The last segment of a closed contour stays last.
        let other = if contour.closed { (2 * n - 2 - i) % n } else { n - 1 - i };
        let backwards: Vec<Point> = trace_segment(&back[other].reversed()).collect();
        most = most.max(distance(&trace_segment(segment).collect::<Vec<_>>(), &backwards));
    }
    most / size(contour)
}

fn largest_jumps(gentle: &Gentle) -> Option<[f64; 4]> {
    let solved = gentle.solutions.iter().filter(|s| s.report.status() == Status::Solved);
    let all = solved.flat_map(|solution| {
        let at_knots = jumps(&solution.curve).into_iter().flatten();
        at_knots.chain(jumps_within(&solution.curve))
    });
    let sizes = all.map(|jump| jump.dimensionless().map(f64::abs));
    sizes.reduce(|most, here| std::array::from_fn(|order| most[order].max(here[order])))
}

fn roundness(spline: &dyn Spline) -> Roundness {
    /// Radial distances below this are rounding.
    const ROUNDING: f64 = 1e-13;
    let off_circle = |contour: &Contour| {
        let Some(solution) = curve_of(contour, spline) else { return f64::MAX };
        let radial = |p: Point| (p.to_vec2().hypot() - 1.0).abs();
        trace(&solution).into_iter().map(radial).fold(0.0, f64::max)
    };
    let even: Vec<(usize, f64)> = [3, 4, 6, 8, 12, 16, 24, 32]
        .into_iter()
        .map(|n| {
            let knots = (0..n).map(|i| on_circle(TAU * i as f64 / n as f64, 1.0));
            (n, off_circle(&Contour::closed(knots)))
        })
        .collect();
    let uneven = [&[0.0, 1.0, 2.5][..], &[-2.0, -1.0, 0.5, 0.9, 2.0], &[0.0, 0.3, 0.6, 2.1]];
    let uneven = uneven
        .into_iter()
        .flat_map(|places| [false, true].map(|closed| (places, closed)))
        .map(|(places, closed)| {
            let knots = places.iter().map(|angle| on_circle(*angle, 1.0));
            off_circle(&Contour { closed, ..Contour::open(knots) })
        })
        .fold(0.0, f64::max);
    let seen: Vec<_> = even.iter().filter(|(_, off)| *off > ROUNDING).collect();
    let order = match seen.as_slice() {
        [.., (n, off), (more, less)] => Some((off / less).ln() / (*more as f64 / *n as f64).ln()),
        _ => None,
    };
    Roundness { even, uneven, order }
}

fn extensionality(spline: &dyn Spline, gentle: &Gentle) -> Extensionality {
    let mut most = Extensionality::default();
    for (contour, solution) in gentle.pairs() {
        let segments = solution.curve.segments();
        let last = segments.len() - 1;
        for (segment, at) in [(0, 0.37), (last / 2, 0.61), (last, 0.44)] {
            let whole = &segments[segment];
            let s = at * whole.length();
            let mut longer = contour.clone();
            longer.knots.insert(segment + 1, Knot::new(whole.point(s)));
            let mut before: Vec<Segment> = segments.to_vec();
            let halves = [whole.subsegment(0.0, s), whole.subsegment(s, whole.length())];
            before.splice(segment..=segment, halves);
            let there: Vec<Point> = before.iter().flat_map(trace_segment).collect();
            let off = curve_of(&longer, spline).map_or(f64::MAX, |s| distance(&there, &trace(&s)));
            let at_end = !contour.closed && (segment == 0 || segment == last);
            let most = if at_end { &mut most.at_ends } else { &mut most.inside };
            *most = most.max(off / size(contour));
        }
    }
    most
}

fn ripple(spline: &dyn Spline) -> f64 {
    /// Fractions of a chord: small enough for the linear theory, and far above rounding.
    const PUSH: f64 = 1e-4;
    const ROUNDING: f64 = 1e-15;
    const MIDDLE: usize = 20;
    let knots = (0..=2 * MIDDLE).map(|i| (i as f64, if i == MIDDLE { PUSH } else { 0.0 }));
    let Some(solution) = curve_of(&Contour::open(knots), spline) else { return 1.0 };
    let height = |k: usize| {
        let segment = &solution.curve.segments()[MIDDLE + k];
        trace_segment(segment).map(|p| p.y.abs()).fold(0.0, f64::max)
    };
    const FIRST: usize = 2;
    let seen = (FIRST..10).take_while(|k| height(*k) > ROUNDING).last();
    match seen {
        Some(last) if last > FIRST => {
            (height(last) / height(FIRST)).powf(1.0 / (last - FIRST) as f64)
        }
        _ => 0.0,
    }
}

fn support(spline: &dyn Spline) -> Option<usize> {
    /// Less is rounding.
    const CHANGED: f64 = 1e-12;
    const COUNT: usize = 2 * FARTHEST + 8;
    let mut most = 0;
    let mut random = Random::new(2);
    for _ in 0..4 {
        let contour = random.walk(COUNT, 0.8);
        let moved = COUNT / 2;
        let mut other = contour.clone();
        other.knots[moved].point += Vec2::new(random.next(), random.next()) * 0.1;
        let (Some(a), Some(b)) = (curve_of(&contour, spline), curve_of(&other, spline)) else {
            return None;
        };
        for (i, (a, b)) in a.curve.segments().iter().zip(b.curve.segments()).enumerate() {
            let (a, b): (Vec<_>, Vec<_>) = (trace_segment(a).collect(), trace_segment(b).collect());
            if distance(&a, &b) > CHANGED * size(&contour) {
                most = most.max(if i >= moved { i - moved + 1 } else { moved - i });
            }
        }
    }
    (most <= FARTHEST).then_some(most)
}

fn share_of_monotone(gentle: &Gentle) -> f64 {
    let (mut monotone, mut all) = (0, 0);
    for segment in gentle.segments() {
        all += 1;
        monotone += usize::from(is_monotone(segment));
    }
    f64::from(monotone as u32) / f64::from((all as u32).max(1))
}

/// Whether curvature never turns back, as far as 48 places show.
fn is_monotone(segment: &Segment) -> bool {
    const PLACES: usize = 48;
    // Just inside the ends, where shapes of several parts have their own side's curvature.
    let at = |i: usize| (i as f64 / PLACES as f64).clamp(1e-9, 1.0 - 1e-9) * segment.length();
    let curvatures: Vec<f64> = (0..=PLACES).map(|i| segment.curvature(at(i))).collect();
    let largest = curvatures.iter().fold(0.0f64, |most, k| most.max(k.abs()));
    let rounding = 1e-7 * largest + 1e-9 / segment.length();
    let steps = || curvatures.windows(2).map(|pair| pair[1] - pair[0]);
    steps().all(|step| step > -rounding) || steps().all(|step| step < rounding)
}

fn existence(spline: &dyn Spline) -> Vec<Existence> {
    type Draw = fn(&mut Random) -> Contour;
    /// Up to 60 degrees.
    const TURN: f64 = TAU / 6.0;
    let classes: [(&str, usize, Draw); 8] = [
        ("jittered circle, closed, 16 knots", 25, |random| random.ring(16, 0.3)),
        ("jittered circle, open, 16 knots", 25, |random| Contour {
            closed: false,
            ..random.ring(16, 0.3)
        }),
        ("walk, open, 4 knots", 50, |random| random.walk(4, TURN)),
        ("walk, open, 16 knots", 25, |random| random.walk(16, TURN)),
        ("walk, closed, 8 knots", 25, |random| Contour { closed: true, ..random.walk(8, TURN) }),
        ("uniform in a square, open, 4 knots", 50, |random| random.uniform(4, false)),
        ("uniform in a square, open, 8 knots", 25, |random| random.uniform(8, false)),
        ("uniform in a square, closed, 8 knots", 25, |random| random.uniform(8, true)),
    ];
    let mut random = Random::new(3);
    let measure = |(class, of, draw): (&'static str, usize, Draw)| {
        let is_solved = |contour: &Contour| {
            curve_of(contour, spline).is_some_and(|s| s.report.status() == Status::Solved)
        };
        let solved = (0..of).filter(|_| is_solved(&draw(&mut random))).count();
        Existence { class, solved, of }
    };
    classes.into_iter().map(measure).collect()
}

fn moves(spline: &dyn Spline) -> Moves {
    const PATHS: usize = 24;
    const STEPS: usize = 8;
    /// A step of 0.6/8 halved so often is 1e-5 of the drawing.
    const HALVINGS: usize = 13;
    let mut random = Random::new(4);
    let (mut ratios, mut jumps) = (Vec::new(), 0);
    for path in 0..PATHS {
        let contour = random.uniform(5, path % 2 == 1);
        let knot = path % 5;
        let way = Vec2::from_angle(TAU * random.next()) * 0.6;
        let scale = size(&contour);
        let at = |t: f64| {
            let mut moved = contour.clone();
            moved.knots[knot].point += way * t;
            curve_of(&moved, spline).map(|solution| trace(&solution)).unwrap_or_default()
        };
        let traces: Vec<Vec<Point>> = (0..=STEPS).map(|i| at(i as f64 / STEPS as f64)).collect();
        let steps: Vec<f64> = traces.windows(2).map(|pair| distance(&pair[0], &pair[1])).collect();
        let worst = (0..STEPS).max_by(|a, b| steps[*a].total_cmp(&steps[*b])).unwrap_or(0);
        // Into the half that moves more, as long as it moves far.
        let (mut from, mut to) = (worst as f64 / STEPS as f64, (worst + 1) as f64 / STEPS as f64);
        let (mut low, mut high) = (traces[worst].clone(), traces[worst + 1].clone());
        let mut apart = steps[worst];
        for _ in 0..HALVINGS {
            if apart <= Moves::JUMP * scale {
                break;
            }
            let middle = (from + to) / 2.0;
            let here = at(middle);
            let (before, after) = (distance(&low, &here), distance(&here, &high));
            if before > after {
                (to, high, apart) = (middle, here, before);
            } else {
                (from, low, apart) = (middle, here, after);
            }
        }
        if apart > Moves::JUMP * scale {
            jumps += 1;
        } else {
            ratios.push(apart / ((to - from) * way.hypot()));
        }
    }
    sort_by(&mut ratios, f64::total_cmp);
    let ratio = ratios.get(ratios.len() / 2).copied();
    Moves { ratio, jumps: f64::from(jumps) / PATHS as f64 }
}

fn parameters(spline: &dyn Spline) -> usize {
    /// How far knots are pushed. Differences are central: what isn't linear is about the square of
    /// this.
    const PUSH: f64 = 1e-4;
    /// Responses below this part of the largest are neither rounding (1e-9) nor curvature of the
    /// response (1e-6); the fourth of polynomial spirals is about 1e-2.
    const NOTHING: f64 = 1e-4;
    const COUNT: usize = 10;
    /// Drawings that are solved as asked, of so many tried; sharper ones where gentle ones aren't.
    const DRAWINGS: usize = 3;
    const MOST_TRIED: usize = 24;
    let mut random = Random::new(5);
    let (mut most, mut drawn) = (0, 0);
    for tried in 0..MOST_TRIED {
        let contour = random.walk(COUNT, 0.8 + 0.2 * (tried / DRAWINGS) as f64);
        let shape = |contour: &Contour| {
            let solution = curve_of(contour, spline).filter(|s| s.report.relaxed.is_empty())?;
            let segment = &solution.curve.segments()[COUNT / 2 - 1];
            let chord = direction(segment.end() - segment.start());
            let at = |i: usize| segment.length() * (0.02 + 0.96 * i as f64 / 11.0);
            Some((0..12).map(|i| wrap_angle(segment.direction(at(i)) - chord)).collect::<Vec<_>>())
        };
        let responses: Vec<Vec<f64>> = (0..COUNT)
            .filter_map(|_| {
                let pushes: Vec<Vec2> =
                    (0..COUNT).map(|_| Vec2::new(random.next(), random.next()) * PUSH).collect();
                let pushed = |sign: f64| {
                    let mut contour = contour.clone();
                    for (knot, push) in contour.knots.iter_mut().zip(&pushes) {
                        knot.point += *push * sign;
                    }
                    shape(&contour)
                };
                let (up, down) = (pushed(1.0)?, pushed(-1.0)?);
                let by = |(up, down): (&f64, &f64)| wrap_angle(up - down) / (2.0 * PUSH);
                Some(up.iter().zip(&down).map(by).collect())
            })
            .collect();
        if responses.len() < COUNT {
            continue;
        }
        most = most.max(rank(responses, NOTHING));
        drawn += 1;
        if drawn == DRAWINGS {
            break;
        }
    }
    most
}

/// The number of independent directions in these vectors; what is smaller than that part of the largest
/// counts as nothing, and so does all that is smaller than it absolutely.
fn rank(mut vectors: Vec<Vec<f64>>, nothing: f64) -> usize {
    let norm = |v: &Vec<f64>| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut first = 1.0;
    let mut rank = 0;
    while let Some(largest) =
        (0..vectors.len()).max_by(|a, b| norm(&vectors[*a]).total_cmp(&norm(&vectors[*b])))
    {
        let pivot = vectors.swap_remove(largest);
        let length = norm(&pivot);
        if rank == 0 {
            first = length.max(1.0);
        }
        if !(length > nothing * first) {
            break;
        }
        rank += 1;
        for vector in &mut vectors {
            let along =
                vector.iter().zip(&pivot).map(|(a, b)| a * b).sum::<f64>() / (length * length);
            for (x, p) in vector.iter_mut().zip(&pivot) {
                *x -= along * p;
            }
        }
    }
    rank
}

/// How far segments are from being cut from one curve (thesis 4.1, Theorem 1).
///
/// Similarities leave κ′/κ² and κ″/κ³ alone (a mirror negates the first). If every segment is cut from one
/// curve, the second is a function of the first: the curve's own equation. The result is how badly that
/// function, interpolated between places of other segments, predicts it, over the range of about 1 that
/// it is brought to: nine places in ten do better. Segments in several parts count as 1; `None`
/// if nothing is curved.
pub fn spread_about_one_curve(solutions: &[Solution]) -> Option<f64> {
    let mut places: Vec<(f64, f64, usize)> = Vec::new();
    let segments = solutions.iter().flat_map(|solution| solution.curve.segments());
    for (index, segment) in segments.enumerate() {
        if matches!(segment.shape(), Shape::Chain(_)) {
            return Some(1.0);
        }
        for i in 0..8 {
            let [k, k1, k2, _] =
                segment.curvature_jet(segment.length() * (0.06 + 0.125 * f64::from(i)));
            let (a, b) = (k1 / (k * k), k2 / (k * k * k));
            // Near inflections and on straight lines both are ratios of rounding errors.
            if k.abs() * segment.length() > 1e-3 && a.is_finite() && b.is_finite() {
                places.push((a.abs().atan(), (b / (1.0 + a * a)).atan(), index));
            }
        }
    }
    sort_by(&mut places, |a, b| a.0.total_cmp(&b.0));
    let mut errors: Vec<f64> = (0..places.len())
        .filter_map(|i| {
            let (u, v, own) = places[i];
            let other = |place: &&(f64, f64, usize)| place.2 != own;
            let before = places[..i].iter().rev().find(other)?;
            let after = places[i + 1..].iter().find(other)?;
            let gap = after.0 - before.0;
            let along = if gap > 1e-12 { (u - before.0) / gap } else { 0.5 };
            Some((before.1 + (after.1 - before.1) * along - v).abs())
        })
        .collect();
    sort_by(&mut errors, f64::total_cmp);
    errors.get(errors.len() * 9 / 10).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rank_counts_independent_directions() {
        let vectors = |n: usize| -> Vec<Vec<f64>> {
            let mut random = Random::new(9);
            let base: Vec<Vec<f64>> =
                (0..n).map(|_| (0..12).map(|_| random.next()).collect()).collect();
            let mix = |random: &mut Random| {
                let weights: Vec<f64> = (0..n).map(|_| random.next()).collect();
                (0..12).map(|i| (0..n).map(|j| weights[j] * base[j][i]).sum()).collect()
            };
            (0..10).map(|_| mix(&mut random)).collect()
        };
        for n in 0..6 {
            assert_eq!(rank(vectors(n), 1e-6), n);
        }
    }

    #[test]
    fn walks_and_rings_are_the_same_every_time() {
        let draw = || Random::new(7).walk(5, 0.8);
        assert_eq!(draw(), draw());
        assert!(Random::new(7).ring(9, 0.2).closed);
    }
}
