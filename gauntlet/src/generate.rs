//! Synthetic contours, deterministic: the same class and case give the same contour on every
//! machine and in every later version (seeds come from the class's name, not from its place).

use std::f64::consts::{PI, TAU};

use faircurve::kurbo::{Point, Vec2};
use faircurve::{Contour, Join, Knot};

/// SplitMix64 (Steele, Lea and Flood 2014): a tiny generator whose every seed is a good one.
#[derive(Clone, Debug)]
pub(crate) struct Random(u64);

impl Random {
    /// The generator for one case of a class.
    pub(crate) fn for_case(class: &str, case: usize) -> Random {
        // FNV-1a of the name.
        let hash = class.bytes().fold(0xcbf2_9ce4_8422_2325u64, |h, byte| {
            (h ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
        });
        Random(hash ^ (case as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15))
    }

    /// 64 random bits.
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [low, high).
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// Uniform in 0 .. count.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.bits() % count.max(1) as u64) as usize
    }
}

/// Which joins a class's knots have.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Joins {
    /// All the same.
    All(Join),
    /// Every word over G4, G2 and both one-way joins, counted through by case.
    EveryArrangement,
    /// Drawn from all joins of Table 7.1, corners included.
    Drawn,
}

/// A family of synthetic contours.
#[derive(Clone, Debug)]
pub(crate) struct Class {
    /// A unique name, such as `walk closed g4 64`; also the seed.
    pub(crate) name: String,
    /// Whether ANCHORS has figures for it; the others are hard on purpose.
    pub(crate) is_anchor: bool,
    points: fn(&mut Random, usize) -> Vec<Point>,
    size: usize,
    closed: bool,
    joins: Joins,
}

impl Class {
    /// The contour of that number.
    pub(crate) fn contour(&self, case: usize) -> Contour {
        let mut random = Random::for_case(&self.name, case);
        let points = (self.points)(&mut random, self.size);
        let mut word = case;
        let knots = points.into_iter().map(|point| {
            const LETTERS: [Join; 4] =
                [Join::G4, Join::G2, Join::CurveToTerminal, Join::TerminalToCurve];
            let join = match self.joins {
                Joins::All(join) => join,
                Joins::EveryArrangement => {
                    let join = LETTERS[word % 4];
                    word /= 4;
                    join
                }
                Joins::Drawn => match random.below(5) {
                    4 => Join::Corner,
                    letter => LETTERS[letter],
                },
            };
            Knot::new(point).join(join)
        });
        if self.closed { Contour::closed(knots) } else { Contour::open(knots) }
    }
}

/// All classes, those with published figures first.
pub(crate) fn classes() -> Vec<Class> {
    type Points = fn(&mut Random, usize) -> Vec<Point>;
    let mut classes = Vec::new();
    let mut add = |what: &str, points: Points, size: usize, closed: bool, joins: Joins, anchor| {
        let how = if closed { "closed" } else { "open" };
        let joins_name = match joins {
            Joins::All(join) => join.name(),
            Joins::EveryArrangement => "one-way",
            Joins::Drawn => "mixed",
        };
        let name = format!("{what} {how} {joins_name} {size}");
        classes.push(Class { name, is_anchor: anchor, points, size, closed, joins });
    };
    let smooth = [Joins::All(Join::G2), Joins::All(Join::G4)];
    let anchors: [(&str, Points); 3] =
        [("circle", jittered_circle), ("walk", walk), ("uniform", uniform)];
    for (what, points) in anchors {
        for closed in [false, true] {
            for joins in smooth {
                for size in [4, 16, 64, 256] {
                    add(what, points, size, closed, joins, true);
                }
            }
        }
    }
    let hard: [(&str, Points, usize, [bool; 2]); 10] = [
        ("near-coincident", near_coincident, 8, [true, true]),
        ("collinear", collinear, 10, [true, true]),
        ("hairpin", hairpin, 7, [true, true]),
        ("half-turn", half_turn, 6, [true, true]),
        ("spiral", spiral, 160, [true, false]),
        ("ratio-1e6", wild_ratios, 8, [true, true]),
        ("zigzag", zigzag, 12, [true, false]),
        ("star", star, 7, [false, true]),
        ("ragged-star", ragged_star, 14, [false, true]),
        ("crossing", crossing, 16, [false, true]),
    ];
    for (what, points, size, [open, closed]) in hard {
        for joins in smooth {
            if open {
                add(what, points, size, false, joins, false);
            }
            if closed {
                add(what, points, size, true, joins, false);
            }
        }
    }
    let later: [(&str, Points, usize, [bool; 2]); 7] = [
        ("tiny-corner", tiny_corner, 8, [false, true]),
        ("alternating-1e6", alternating, 10, [true, true]),
        ("spiral", spiral, 160, [false, true]),
        ("zigzag", zigzag, 12, [false, true]),
        ("five", five, 5, [true, true]),
        ("alternating-1e6", alternating, 64, [true, true]),
        ("alternating-1e6", alternating, 512, [true, true]),
    ];
    for (what, points, size, [open, closed]) in later {
        for joins in smooth {
            if open {
                add(what, points, size, false, joins, false);
            }
            if closed {
                add(what, points, size, true, joins, false);
            }
        }
    }
    let round: Points = loose_circle;
    add("round", round, 4, true, Joins::EveryArrangement, false);
    add("round", round, 6, false, Joins::EveryArrangement, false);
    add("bend", bend, 4, false, Joins::EveryArrangement, false);
    add("round", round, 12, true, Joins::Drawn, false);
    add("walk", walk, 16, false, Joins::Drawn, false);
    add("walk", walk, 16, true, Joins::Drawn, false);
    classes
}

fn circle_with(random: &mut Random, n: usize, jitter: f64) -> Vec<Point> {
    let spacing = TAU / n as f64;
    (0..n)
        .map(|i| {
            let angle = spacing * (i as f64 + jitter * random.between(-1.0, 1.0));
            let radius = 500.0 * (1.0 + jitter * spacing * random.between(-1.0, 1.0));
            Point::new(500.0 + radius * angle.cos(), 500.0 + radius * angle.sin())
        })
        .collect()
}

/// n points around a circle, each moved along and across it by up to a tenth of their spacing.
fn jittered_circle(random: &mut Random, n: usize) -> Vec<Point> {
    circle_with(random, n, 0.1)
}

/// The same, moved by up to a quarter.
fn loose_circle(random: &mut Random, n: usize) -> Vec<Point> {
    circle_with(random, n, 0.25)
}

fn walk_with(
    random: &mut Random,
    n: usize,
    mut step: impl FnMut(&mut Random, usize) -> f64,
    mut turn: impl FnMut(&mut Random, usize) -> f64,
) -> Vec<Point> {
    let mut at = Point::ORIGIN;
    let mut heading = random.between(0.0, TAU);
    (0..n)
        .map(|i| {
            let here = at;
            heading += turn(random, i);
            at += Vec2::from_angle(heading) * step(random, i);
            here
        })
        .collect()
}

fn ordinary_step(random: &mut Random) -> f64 {
    random.between(50.0, 150.0)
}

fn gentle_turn(random: &mut Random) -> f64 {
    random.between(-PI / 3.0, PI / 3.0)
}

/// Steps of 50 to 150 units, each turning by less than 60° (but for the closing chord).
fn walk(random: &mut Random, n: usize) -> Vec<Point> {
    walk_with(random, n, |r, _| ordinary_step(r), |r, _| gentle_turn(r))
}

/// Anywhere in a square of 1000 units.
fn uniform(random: &mut Random, n: usize) -> Vec<Point> {
    (0..n).map(|_| Point::new(random.between(0.0, 1000.0), random.between(0.0, 1000.0))).collect()
}

/// A walk with one step of 10⁻⁹ to 1 of the others.
fn near_coincident(random: &mut Random, n: usize) -> Vec<Point> {
    let (short, decades) = (1 + random.below(n - 3), random.between(-9.0, 0.0));
    let step = |r: &mut Random, i| {
        if i == short { 100.0 * 10f64.powf(decades) } else { ordinary_step(r) }
    };
    walk_with(random, n, step, |r, _| gentle_turn(r))
}

/// A walk with three to six knots on one line, and one sharp bend after it.
fn collinear(random: &mut Random, n: usize) -> Vec<Point> {
    let first = 1 + random.below(2);
    let last = first + 1 + random.below(4);
    let bend = random.between(-2.5, 2.5);
    walk_with(
        random,
        n,
        |r, _| ordinary_step(r),
        |r, i| match i {
            _ if i > first && i <= last => 0.0,
            _ if i == last + 1 => bend,
            _ => gentle_turn(r),
        },
    )
}

/// A walk with one turn of 170° to just under 180°.
fn hairpin(random: &mut Random, n: usize) -> Vec<Point> {
    let at = 1 + random.below(n - 2);
    let off = 10f64.powf(random.between(-6.0, -0.76));
    let sense = if random.below(2) == 0 { 1.0 } else { -1.0 };
    let turn = |r: &mut Random, i| {
        if i == at { sense * (PI - off) } else { gentle_turn(r) }
    };
    walk_with(random, n, |r, _| ordinary_step(r), turn)
}

/// Points on an integer grid with one exact reversal of direction.
fn half_turn(random: &mut Random, n: usize) -> Vec<Point> {
    let at = 1 + random.below(n - 2);
    let mut points: Vec<Point> = Vec::with_capacity(n);
    while points.len() < n {
        let i = points.len();
        let point = if i == at + 1 {
            // Back over the last chord, by another length.
            let back = points[i - 2] - points[i - 1];
            points[i - 1] + back * [0.5, 1.5, 2.0][random.below(3)]
        } else {
            Point::new(random.below(11) as f64 * 100.0, random.below(11) as f64 * 100.0)
        };
        if points.last() != Some(&point) {
            points.push(point);
        }
    }
    points
}

/// Twenty turns outward, eight knots each, slightly jittered.
fn spiral(random: &mut Random, n: usize) -> Vec<Point> {
    (0..n)
        .map(|i| {
            let angle = TAU / 8.0 * (i as f64 + random.between(-0.05, 0.05));
            let radius = 20.0 + 3.0 * angle * random.between(0.99, 1.01);
            Point::new(radius * angle.cos(), radius * angle.sin())
        })
        .collect()
}

/// A walk whose steps range over six decades.
fn wild_ratios(random: &mut Random, n: usize) -> Vec<Point> {
    let step = |r: &mut Random, _| 10f64.powf(r.between(-3.0, 3.0));
    walk_with(random, n, step, |r, _| gentle_turn(r))
}

/// Up and down by 30 to 300 units at steps of about 50.
fn zigzag(random: &mut Random, n: usize) -> Vec<Point> {
    let height = random.between(30.0, 300.0);
    (0..n)
        .map(|i| {
            let side = if i % 2 == 0 { height } else { -height };
            Point::new(
                50.0 * (i as f64 + random.between(-0.1, 0.1)),
                side * random.between(0.9, 1.1),
            )
        })
        .collect()
}

/// The star {n/k} with k drawn, each corner a knot, slightly jittered. n is odd.
fn star(random: &mut Random, n: usize) -> Vec<Point> {
    let skip = 2 + random.below(n / 2 - 1);
    (0..n)
        .map(|i| {
            let angle = TAU * (i * skip) as f64 / n as f64 + random.between(-0.02, 0.02);
            Point::new(500.0 * angle.cos(), 500.0 * angle.sin())
        })
        .collect()
}

/// Around a centre with radii that alternate, the inner one 0.1 to 0.7 of the outer.
fn ragged_star(random: &mut Random, n: usize) -> Vec<Point> {
    let inner = random.between(0.1, 0.7);
    (0..n)
        .map(|i| {
            let radius =
                if i % 2 == 0 { 500.0 } else { 500.0 * inner } * random.between(0.95, 1.05);
            let angle = TAU * i as f64 / n as f64;
            Point::new(radius * angle.cos(), radius * angle.sin())
        })
        .collect()
}

/// A Lissajous figure of small frequencies, sampled: closed, crossing itself.
fn crossing(random: &mut Random, n: usize) -> Vec<Point> {
    let (a, b) = [(1.0, 2.0), (2.0, 3.0), (3.0, 2.0), (1.0, 3.0)][random.below(4)];
    let phase = random.between(0.2, 1.3);
    (0..n)
        .map(|i| {
            let t = TAU * (i as f64 + random.between(-0.1, 0.1)) / n as f64;
            Point::new(500.0 * (a * t + phase).sin(), 500.0 * (b * t).sin())
        })
        .collect()
}

/// A box of 100 to 1000 units of which one corner is rounded by two knots a few thousandths apart.
fn tiny_corner(random: &mut Random, n: usize) -> Vec<Point> {
    let (width, height) = (random.between(100.0, 1000.0), random.between(100.0, 1000.0));
    let (a, b) = (random.between(0.001, 0.01), random.between(0.001, 0.01));
    let mut points = vec![Point::new(width - a, 0.0), Point::new(width, b)];
    // The rest of the way round, counterclockwise: a side, a side, and back.
    let corners = [(width, height), (0.0, height), (0.0, 0.0)];
    for i in 0..n - 2 {
        let along = 3.0 * (i as f64 + random.between(0.2, 0.8)) / (n - 2) as f64;
        let side = (along as usize).min(2);
        let from = [(width, 0.0), corners[0], corners[1]][side];
        points.push(Point::from(from).lerp(Point::from(corners[side]), along - side as f64));
    }
    points
}

/// A walk whose steps are a millionth to a thousandth and 1 in turns.
fn alternating(random: &mut Random, n: usize) -> Vec<Point> {
    let decades = random.between(-6.0, -3.0);
    let step = |r: &mut Random, i| {
        if i % 2 == 0 { ordinary_step(r) } else { 10f64.powf(decades) * ordinary_step(r) }
    };
    walk_with(random, n, step, |r, _| gentle_turn(r))
}

/// A row of three points between two, turning back on itself twice: where thesis figure 2.7 has two
/// curves.
fn five(random: &mut Random, n: usize) -> Vec<Point> {
    let turn = |r: &mut Random, i| match i {
        1 | 3 => r.between(1.8, 3.0),
        2 => r.between(-3.0, -1.8),
        _ => gentle_turn(r),
    };
    walk_with(random, n, |r, _| ordinary_step(r), turn)
}

/// Two knots between ends, at which the way turns by up to 120°, with chords of 10 to 1000 units:
/// more than a one-way knot can always do with its one free parameter.
fn bend(random: &mut Random, n: usize) -> Vec<Point> {
    let step = |r: &mut Random, _| 10f64.powf(r.between(1.0, 3.0));
    walk_with(random, n, step, |r, _| r.between(-2.1, 2.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::residual::PlacedCurve;
    use std::collections::BTreeSet;

    #[test]
    fn splitmix_gives_its_published_numbers() {
        let mut random = Random(1234567);
        assert_eq!(random.bits(), 6457827717110365317);
        assert_eq!(random.bits(), 3203168211198807973);
    }

    #[test]
    fn every_class_is_deterministic_finite_and_named_once() {
        let classes = classes();
        let names: BTreeSet<&str> = classes.iter().map(|class| class.name.as_str()).collect();
        assert_eq!(names.len(), classes.len());
        for class in &classes {
            for case in 0..20 {
                let contour = class.contour(case);
                assert_eq!(contour, class.contour(case), "{}", class.name);
                assert_eq!(contour.knots.len(), class.size, "{}", class.name);
                assert!(contour.knots.iter().all(|knot| knot.point.is_finite()));
            }
            assert_ne!(class.contour(0), class.contour(1), "{}", class.name);
        }
    }

    #[test]
    fn a_case_stays_what_it_was() {
        // Moves only if a generator changes, and with it every figure ever published from it.
        let walk = classes().into_iter().find(|class| class.name == "walk open g4 4").unwrap();
        let last = walk.contour(7).knots[3].point;
        assert_eq!((last.x.round(), last.y.round()), (264.0, 52.0));
    }

    #[test]
    fn classes_are_what_they_say() {
        for class in classes() {
            for case in 0..20 {
                let turn = PlacedCurve::new(&class.contour(case), &[]).largest_turn();
                match class.name.split(' ').next() {
                    Some("walk") if !class.closed => assert!(turn < PI / 3.0 + 1e-9),
                    Some("circle") => assert!(turn < 2.2, "{} {turn}", class.name),
                    Some("hairpin") => assert!(turn > 2.9, "{} {turn}", class.name),
                    Some("half-turn") => assert!(turn > PI - 1e-12, "{} {turn}", class.name),
                    _ => {}
                }
            }
        }
    }

    #[test]
    fn arrangements_are_all_different() {
        let class = classes().into_iter().find(|c| c.name == "round closed one-way 4").unwrap();
        let words: BTreeSet<Vec<Option<Join>>> = (0..256)
            .map(|case| class.contour(case).knots.iter().map(|knot| knot.join).collect())
            .collect();
        assert_eq!(words.len(), 256);
    }
}
