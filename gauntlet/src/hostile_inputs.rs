//! Contours nobody would draw: what a file may hold, not what a designer means. Deterministic like
//! those of `generate.rs`: distribution, seed and case give the same contour everywhere.

use std::f64::consts::{PI, TAU};

use faircurve::kurbo::{Point, Vec2};
use faircurve::tolerance::{COINCIDENT, INVISIBLE, LARGEST_COORDINATE, SMALLEST_SIZE};
use faircurve::{Contour, Join, Knot};

use crate::generate::Random;

/// The splines that inputs are for: those that search, and whose residual is recomputed here. Every entry
/// of the catalogue meets hostile input in the library's tests `laws` and `shapes`.
pub(crate) const SPLINES: [&str; 2] = ["spiro", "euler"];

/// The most knots of a contour where nothing else is said.
pub(crate) const FEW_KNOTS: usize = 8;

/// Which inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Inputs {
    /// Other ones for every number.
    pub(crate) seed: u64,
    /// The most knots of a contour. Up to [`FEW_KNOTS`] all numbers of knots are as likely, beyond all
    /// decades.
    pub(crate) most_knots: usize,
}

impl Inputs {
    /// Those of a seed, with few knots.
    pub(crate) fn few(seed: u64) -> Inputs {
        Inputs { seed, most_knots: FEW_KNOTS }
    }

    fn count(self, random: &mut Random) -> usize {
        if self.most_knots <= FEW_KNOTS {
            1 + random.below(self.most_knots)
        } else {
            decades(random, 0.0, (self.most_knots as f64).log10()).round() as usize
        }
    }
}

/// A way to draw points.
#[derive(Debug)]
pub(crate) struct Distribution {
    /// A unique name; also the seed.
    pub(crate) name: &'static str,
    points: fn(&mut Random, usize) -> Vec<Point>,
}

/// All distributions; cases go through them in turn.
pub(crate) const DISTRIBUTIONS: &[Distribution] = &[
    Distribution { name: "grid", points: grid },
    Distribution { name: "near-coincident", points: near_coincident },
    Distribution { name: "chord ratios", points: chord_ratios },
    Distribution { name: "hairpins", points: hairpins },
    Distribution { name: "collinear", points: collinear },
    Distribution { name: "circles", points: circles },
    Distribution { name: "far away", points: far_away },
    Distribution { name: "any scale", points: any_scale },
    Distribution { name: "any bits", points: any_bits },
    Distribution { name: "special numbers", points: special_numbers },
    Distribution { name: "mixture", points: mixture },
];

/// A contour, and the spline to solve it with.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Input {
    pub(crate) contour: Contour,
    /// Its name in the catalogue.
    pub(crate) spline: &'static str,
}

impl Distribution {
    /// The input of that number: open or closed, either spline, joins all the same or each drawn, and
    /// in a third of the cases some tangents and curvatures given.
    pub(crate) fn input(&self, inputs: Inputs, case: usize) -> Input {
        let seed = (inputs.seed as usize).rotate_left(32);
        let mut random = Random::for_case(self.name, case ^ seed);
        let count = inputs.count(&mut random);
        let points = (self.points)(&mut random, count);
        let spline = SPLINES[random.below(SPLINES.len())];
        let common = (random.below(2) == 0).then(|| join(&mut random));
        let has_given = random.below(3) == 0;
        let size = points.iter().fold(0.0f64, |size, p| size.max((*p - points[0]).hypot()));
        let knots: Vec<Knot> = points
            .into_iter()
            .map(|point| {
                let join = common.unwrap_or_else(|| join(&mut random));
                let knot = Knot { join, ..Knot::new(point) };
                if has_given { give(&mut random, knot, size) } else { knot }
            })
            .collect();
        let contour =
            if random.below(2) == 0 { Contour::closed(knots) } else { Contour::open(knots) };
        Input { contour, spline }
    }
}

/// Any join, or none.
fn join(random: &mut Random) -> Option<Join> {
    Join::ALL.get(random.below(Join::ALL.len() + 1)).copied()
}

/// 10 to the power of a number between the two.
fn decades(random: &mut Random, low: f64, high: f64) -> f64 {
    10f64.powf(random.between(low, high))
}

/// 1 or −1.
fn sign(random: &mut Random) -> f64 {
    if random.below(2) == 0 { 1.0 } else { -1.0 }
}

/// Any double, NaN and infinities among them.
fn any_double(random: &mut Random) -> f64 {
    f64::from_bits(random.bits())
}

/// Gives a knot a tangent, a curvature, or something that it can't have.
fn give(random: &mut Random, mut knot: Knot, size: f64) -> Knot {
    let tangent = match random.below(16) {
        0 => Vec2::new(any_double(random), any_double(random)),
        1..8 => Vec2::new(random.below(5) as f64 - 2.0, random.below(5) as f64 - 2.0),
        _ => Vec2::from_angle(random.between(-PI, PI)) * decades(random, -3.0, 3.0),
    };
    match random.below(6) {
        0 => knot = knot.tangent(tangent),
        1 => knot.tangent_in = Some(tangent),
        2 => knot.tangent_out = Some(tangent),
        _ => {}
    }
    let curvature = match random.below(16) {
        0 => any_double(random),
        1..5 => 0.0,
        _ => sign(random) * decades(random, -4.0, 4.0) / size.max(f64::MIN_POSITIVE),
    };
    match random.below(8) {
        0 => (knot.curvature_in, knot.curvature_out) = (Some(curvature), Some(curvature)),
        1 => knot.curvature_in = Some(curvature),
        2 => knot.curvature_out = Some(curvature),
        _ => {}
    }
    if random.below(64) == 0 {
        knot.tension_in = Some(any_double(random));
        knot.curl = Some(any_double(random));
    }
    knot
}

/// Steps from a start near the origin.
fn path(
    random: &mut Random,
    count: usize,
    mut step: impl FnMut(&mut Random, usize) -> Vec2,
) -> Vec<Point> {
    let mut at = Point::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
    (0..count)
        .map(|i| {
            let here = at;
            at += step(random, i);
            here
        })
        .collect()
}

/// Whole numbers from 0 to at most 5.
fn grid(random: &mut Random, count: usize) -> Vec<Point> {
    let side = 2 + random.below(5);
    (0..count).map(|_| Point::new(random.below(side) as f64, random.below(side) as f64)).collect()
}

/// Steps of size 1, some of them of 10⁻¹⁷ to 1, around and below what counts as one place.
fn near_coincident(random: &mut Random, count: usize) -> Vec<Point> {
    path(random, count, |random, _| {
        let length = match random.below(4) {
            0 => decades(random, -17.0, 0.0),
            1 => COINCIDENT * random.between(0.0, 3.0),
            _ => random.between(0.3, 3.0),
        };
        Vec2::from_angle(random.between(-PI, PI)) * length
    })
}

/// Chords of 10⁻¹² to 10¹², turning gently or anyhow.
fn chord_ratios(random: &mut Random, count: usize) -> Vec<Point> {
    let range = random.between(0.0, 12.0);
    let most_turn = [PI / 3.0, PI][random.below(2)];
    let mut heading = random.between(-PI, PI);
    path(random, count, |random, _| {
        heading += random.between(-most_turn, most_turn);
        Vec2::from_angle(heading) * decades(random, -range, range)
    })
}

/// Turns of half a turn, exactly or but for 10⁻¹⁷ to 1 radian.
fn hairpins(random: &mut Random, count: usize) -> Vec<Point> {
    if random.below(2) == 0 {
        // Exactly: back and forth by whole numbers along one vector, mostly.
        let along = Vec2::new(random.below(4) as f64, random.below(4) as f64 - 1.0);
        let mut sense = 1.0;
        return path(random, count, |random, _| {
            sense = -sense;
            match random.below(5) {
                0 => Vec2::new(random.below(4) as f64, random.below(4) as f64),
                _ => along * (sense * (1 + random.below(3)) as f64),
            }
        });
    }
    let mut heading = random.between(-PI, PI);
    path(random, count, |random, _| {
        let off = decades(random, -17.0, 0.0);
        heading += PI - (sign(random) * off);
        Vec2::from_angle(heading) * random.between(0.3, 3.0)
    })
}

/// On a line, exactly or to rounding, with a kink of 10⁻¹⁷ to 10⁻⁶ here and there.
fn collinear(random: &mut Random, count: usize) -> Vec<Point> {
    let along = match random.below(3) {
        0 => Vec2::new(1.0, 0.0),
        1 => Vec2::new(random.below(5) as f64, 1.0 + random.below(5) as f64),
        _ => Vec2::from_angle(random.between(-PI, PI)),
    };
    let forwards = random.below(4) > 0;
    path(random, count, |random, _| {
        let kink = if random.below(4) == 0 { decades(random, -17.0, -6.0) } else { 0.0 };
        let length = random.between(0.5, 4.0).round();
        let along = along * if forwards { length } else { sign(random) * length };
        along + Vec2::new(-along.y, along.x) * (sign(random) * kink)
    })
}

/// On one circle, evenly or not, to rounding or but for 10⁻¹⁶ to 1 of the radius.
fn circles(random: &mut Random, count: usize) -> Vec<Point> {
    let even = random.below(2) == 0;
    let off = if random.below(2) == 0 { 0.0 } else { decades(random, -16.0, 0.0) };
    let (radius, skip) = (decades(random, -6.0, 6.0), 1 + random.below(count));
    (0..count)
        .map(|i| {
            let angle =
                if even { TAU * (i * skip) as f64 / count as f64 } else { random.between(-PI, PI) };
            let radius = radius * (1.0 + off * random.between(-1.0, 1.0));
            (Vec2::from_angle(angle) * radius).to_point()
        })
        .collect()
}

/// A small drawing at up to 10¹⁸ times its size from the origin, where its coordinates are rounded.
fn far_away(random: &mut Random, count: usize) -> Vec<Point> {
    let distance = decades(random, 0.0, 18.0);
    let offset = Vec2::new(random.between(-distance, distance), distance);
    gentle(random, count).into_iter().map(|point| point + offset).collect()
}

/// A drawing of 10⁻³⁰⁰ to 10³⁰⁰ units, mostly within the range that isn't refused.
fn any_scale(random: &mut Random, count: usize) -> Vec<Point> {
    let range = if random.below(4) == 0 { 300.0 } else { LARGEST_COORDINATE.log10() };
    let scale = decades(random, -range, range);
    gentle(random, count).into_iter().map(|point| (point.to_vec2() * scale).to_point()).collect()
}

/// An ordinary drawing.
fn gentle(random: &mut Random, count: usize) -> Vec<Point> {
    let most_turn = [PI / 3.0, PI][random.below(2)];
    let mut heading = random.between(-PI, PI);
    path(random, count, |random, _| {
        heading += random.between(-most_turn, most_turn);
        Vec2::from_angle(heading) * random.between(0.5, 1.5)
    })
}

/// Random bits: every double alike, or those whose exponent lies in some range.
fn any_bits(random: &mut Random, count: usize) -> Vec<Point> {
    /// Exponents of LARGEST_COORDINATE, to either side of 1.
    const LARGEST: usize = 182;
    let any = random.below(8) == 0;
    let (spread, middle) = (1 + random.below(2 * LARGEST), random.below(LARGEST) as f64);
    let middle = sign(random) * middle / 4.0;
    let mut coordinate = || {
        let mut number = any_double(random);
        if !any {
            let exponent = (middle + random.below(spread) as f64 - spread as f64 / 2.0)
                .clamp(-(LARGEST as f64), LARGEST as f64) as i64;
            let bits = number.to_bits() & !(0x7ff << 52) | ((exponent + 1023) as u64) << 52;
            number = f64::from_bits(bits);
        }
        if random.below(16) == 0 { 0.0 } else { number }
    };
    (0..count).map(|_| Point::new(coordinate(), coordinate())).collect()
}

/// Zeros of both signs, subnormals, the limits of the solver and of the format, and their
/// neighbours.
fn special_numbers(random: &mut Random, count: usize) -> Vec<Point> {
    let ordinary = random.below(3) > 0;
    let mut coordinate = || {
        let number = match random.below(if ordinary { 11 } else { 15 }) {
            0 => 0.0,
            1 => f64::from_bits(1 + random.bits() % 8),
            2 => f64::from_bits(random.bits() >> 12),
            3 => f64::MIN_POSITIVE,
            4 => f64::EPSILON,
            5 => 1.0,
            6 => 1.0 + f64::EPSILON * random.below(200) as f64,
            7 => COINCIDENT,
            8 => INVISIBLE,
            9 => random.below(3) as f64,
            10 => SMALLEST_SIZE * [0.5, 1.0, 2.0][random.below(3)],
            11 => LARGEST_COORDINATE,
            12 => f64::MAX,
            13 => 1e300,
            _ => [f64::INFINITY, f64::NAN][random.below(2)],
        };
        sign(random) * number
    };
    (0..count).map(|_| Point::new(coordinate(), coordinate())).collect()
}

/// Each knot from another distribution, added to the last or not.
fn mixture(random: &mut Random, count: usize) -> Vec<Point> {
    const KINDS: [fn(&mut Random, usize) -> Vec<Point>; 7] =
        [grid, near_coincident, chord_ratios, hairpins, collinear, circles, special_numbers];
    let mut last = Vec2::ZERO;
    (0..count)
        .map(|_| {
            let kind = KINDS[random.below(KINDS.len())];
            let point = kind(random, 2)[1].to_vec2();
            last = if random.below(2) == 0 { point } else { last + point };
            last.to_point()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn inputs_are_deterministic_and_differ_by_seed_and_case() {
        for distribution in DISTRIBUTIONS {
            let text = |seed, case| format!("{:?}", distribution.input(Inputs::few(seed), case));
            assert_eq!(text(1, 7), text(1, 7));
            assert_ne!(text(1, 7), text(2, 7), "{}", distribution.name);
            assert_ne!(text(1, 7), text(1, 8), "{}", distribution.name);
        }
        let names: BTreeSet<&str> = DISTRIBUTIONS.iter().map(|d| d.name).collect();
        assert_eq!(names.len(), DISTRIBUTIONS.len());
    }

    #[test]
    fn every_size_join_and_spline_occurs() {
        let (mut sizes, mut joins, mut splines) =
            (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
        for case in 0..400 {
            let Input { contour, spline } =
                DISTRIBUTIONS[case % DISTRIBUTIONS.len()].input(Inputs::few(0), case);
            sizes.insert(contour.knots.len());
            splines.insert(spline);
            joins.extend(contour.knots.iter().map(|knot| knot.join));
        }
        assert_eq!(sizes, (1..=FEW_KNOTS).collect());
        assert_eq!(joins.len(), Join::ALL.len() + 1);
        assert_eq!(splines.len(), SPLINES.len());
    }
}
