//! The segment: the elastica with given end tangents and a given constant C, whose length is free
//! (thesis sections 3.9, 4.1).

use std::fmt;

use num_complex::Complex64;

use crate::frame::{ChordAngles, EndCurvature, wrap_angle};
use crate::numeric::dual::{Dual, Real};
use crate::numeric::elastica::{Elastica, UnitArc};
use crate::numeric::roots::monotone_root;
use crate::two_param::curvature_map::EndCurvatures;

/// A segment on the unit chord that minimises ∫ κ² + c ds between given end tangents: a piece of an
/// elastica with C = −c/2 (thesis eq. 4.2), of the rectangular one for c = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MecSegment {
    /// The end tangents.
    pub angles: ChordAngles,
    /// The elastica for arc length 1, with its place of reference in the middle.
    pub elastica: Elastica,
    /// Arc length, at least 1.
    pub length: f64,
    /// Curvature at the start and at the end.
    pub curvatures: [f64; 2],
}

/// Why there is no segment with the end tangents asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoMec {
    /// The end tangents lie beyond the [envelope]: whatever the curve, a longer one has less energy.
    BeyondEnvelope,
    /// Something isn't a finite number, or the penalty is too strong for a chord of this length.
    OutOfRange,
}

impl fmt::Display for NoMec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NoMec::BeyondEnvelope => "a longer curve always has less energy",
            NoMec::OutOfRange => "the angles or the penalty are out of range",
        })
    }
}

impl std::error::Error for NoMec {}

/// The segment with these end tangents, and with this constant C for unit chord: 0 for the minimum
/// energy curve, −c/2 with an arc-length penalty c (thesis eq. 4.2).
///
/// Of several it is the one that continues the straight line, found by Newton's method from there.
/// Curvatures are accurate to about 1e-13, but for end tangents close to the envelope, where they
/// change infinitely fast.
///
/// # Errors
/// [`NoMec`] beyond the envelope of end tangents (figure 3.13), for numbers that aren't finite, and
/// for C beyond ±4000.
///
/// ```
/// use faircurve::{families::mec::{fit_mec, NoMec}, frame::ChordAngles};
/// let segment = fit_mec(ChordAngles::new(0.2, 0.2), 0.0)?;
/// // Nearly an arc, and a little longer.
/// assert!(segment.length > 0.2 / 0.2f64.sin() && segment.length < 1.00672);
/// assert_eq!(fit_mec(ChordAngles::new(1.6, 1.6), 0.0), Err(NoMec::BeyondEnvelope));
/// # Ok::<(), NoMec>(())
/// ```
pub fn fit_mec(angles: ChordAngles, constant: f64) -> Result<MecSegment, NoMec> {
    fit(angles, constant).map(|fit| fit.segment(angles))
}

/// The same, with all that the spline wants to know.
pub(super) fn fit(angles: ChordAngles, constant: f64) -> Result<Fit, NoMec> {
    /// At the very end of the sheet the determinant is only known to the root of what angles are known
    /// to; straight, it is 1/6.
    const AT_THE_END: f64 = 1e-5;
    /// Beyond, the segment is straight but for its very ends, and its middle knows nothing of them.
    const STRONGEST: f64 = 4000.0;
    if !(constant.abs() <= STRONGEST && angles.theta0.is_finite() && angles.theta1.is_finite()) {
        return Err(NoMec::OutOfRange);
    }
    let asked = Asked::new(angles, Last::Constant(constant));
    let found = newton(&asked, [0.0, 0.0, constant]).ok_or(NoMec::BeyondEnvelope)?;
    // The sheet of the straight line ends where the determinant is 0.
    let is_on_sheet = determinant(&found.by(&asked)) > -AT_THE_END;
    is_on_sheet.then_some(found).ok_or(NoMec::BeyondEnvelope)
}

/// What is asked of a segment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked {
    /// Turning, and difference of the end angles.
    ends: [f64; 2],
    last: Last,
    /// Whether whole turns don't count at either end.
    wraps: bool,
}

/// What is asked beside end tangents.
#[derive(Clone, Copy, Debug)]
pub(super) enum Last {
    /// C, for unit chord.
    Constant(f64),
    /// Chord over arc length.
    Straightness(f64),
}

impl Asked {
    pub(super) fn new(angles: ChordAngles, last: Last) -> Asked {
        let ends = [angles.theta0 + angles.theta1, angles.theta1 - angles.theta0];
        Asked { ends, last, wraps: false }
    }

    /// The same, with any whole turns at both ends.
    pub(super) fn up_to_turns(self) -> Asked {
        Asked { wraps: true, ..self }
    }
}

/// A place in the space of elastica, and how what is asked for answers changes there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fit {
    /// κ, κ′ and C in the middle, for arc length 1.
    pub(super) state: [f64; 3],
    /// Turning and difference of the end angles.
    ends: [Dual<3>; 2],
    /// C for unit chord.
    constant: Dual<3>,
    /// Chord over arc length.
    straightness: Dual<3>,
    /// Curvatures at the ends, for unit chord.
    curvatures: [Dual<3>; 2],
}

impl Fit {
    pub(super) fn new(state: [f64; 3]) -> Fit {
        let state_with = std::array::from_fn(|i| Dual::variable(state[i], i));
        let UnitArc { x, y, half_turn, lean, ends } = Elastica::unit_arc::<Dual<3>>(state_with);
        let square = x * x + y * y;
        let straightness = square.sqrt();
        let constant = state_with[2] * square;
        Fit {
            state,
            ends: [half_turn * 2.0, (lean - y.atan2(x)) * 2.0],
            constant,
            straightness,
            curvatures: ends.map(|curvature| curvature * straightness),
        }
    }

    fn last(&self, asked: &Asked) -> (Dual<3>, f64) {
        match asked.last {
            Last::Constant(constant) => (self.constant, constant),
            Last::Straightness(straightness) => (self.straightness, straightness),
        }
    }

    /// What is left to reach.
    fn off(&self, asked: &Asked) -> [f64; 3] {
        let [mut turning, mut difference] = [0, 1].map(|i| asked.ends[i] - self.ends[i].value);
        if asked.wraps {
            let theta0 = wrap_angle((turning - difference) / 2.0);
            let theta1 = wrap_angle((turning + difference) / 2.0);
            (turning, difference) = (theta0 + theta1, theta1 - theta0);
        }
        let (last, wanted) = self.last(asked);
        [turning, difference, wanted - last.value]
    }

    /// How what is asked responds to the state, by rows.
    fn by(&self, asked: &Asked) -> [[f64; 3]; 3] {
        [self.ends[0].by, self.ends[1].by, self.last(asked).0.by]
    }

    /// The elastica for arc length 1.
    pub(super) fn elastica(&self) -> Elastica {
        let [curvature, slope, constant] = self.state;
        Elastica::new(curvature, slope, constant)
    }

    pub(super) fn segment(&self, angles: ChordAngles) -> MecSegment {
        MecSegment {
            angles,
            elastica: self.elastica(),
            length: 1.0 / self.straightness.value,
            curvatures: self.curvatures.map(|curvature| curvature.value),
        }
    }

    /// ∫ κ² ds and the arc length on a chord of this length.
    pub(super) fn energy_and_length(&self, chord: f64) -> [f64; 2] {
        let length = chord / self.straightness.value;
        [self.elastica().arc_energy() / length, length]
    }

    /// How the curvatures at both ends answer changes of turning, difference of angles, and C.
    fn by_asked(&self) -> [[f64; 3]; 2] {
        let rows = [self.ends[0].by, self.ends[1].by, self.constant.by];
        let states = [0, 1, 2].map(|i| {
            let mut unit = [0.0; 3];
            unit[i] = 1.0;
            solve(&rows, unit)
        });
        self.curvatures.map(|curvature| {
            states.map(|state| (0..3).map(|i| curvature.by[i] * state[i]).sum::<f64>())
        })
    }

    /// End curvatures with their derivatives by the end tangents.
    pub(super) fn response(&self) -> EndCurvatures {
        let value = self.curvatures.map(|curvature| EndCurvature::finite(curvature.value));
        let by_angle = self.by_asked().map(|[by_turning, by_difference, _]| {
            [by_turning - by_difference, by_turning + by_difference]
                .map(|num| EndCurvature { num, den: 0.0 })
        });
        EndCurvatures { value, by_angle }
    }
}

fn determinant([a, b, c]: &[[f64; 3]; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// The solution of three linear equations, by Cramer's rule.
fn solve(rows: &[[f64; 3]; 3], right: [f64; 3]) -> [f64; 3] {
    let whole = determinant(rows);
    std::array::from_fn(|i| {
        let mut replaced = *rows;
        (0..3).for_each(|row| replaced[row][i] = right[row]);
        determinant(&replaced) / whole
    })
}

/// Newton's method. `None` where it doesn't arrive.
pub(super) fn newton(asked: &Asked, start: [f64; 3]) -> Option<Fit> {
    /// At the end of the sheet a step only halves what is left.
    const MOST_STEPS: usize = 32;
    /// Radians that a step may bend the segment.
    const MOST_BEND: f64 = 0.7;
    /// What is off in the end, at most, where tension or compression isn't large.
    const CLOSE: f64 = 1e-12;
    let close = |fit: &Fit| CLOSE * (1.0 + 0.1 * fit.state[2].abs());
    let scale = match asked.last {
        Last::Constant(constant) => 1.0 + constant.abs(),
        Last::Straightness(_) => 1.0,
    };
    let mut here = Fit::new(start);
    let mut best: Option<(f64, Fit)> = None;
    for _ in 0..MOST_STEPS {
        let off = here.off(asked);
        let missed = off[0].abs().max(off[1].abs()).max(off[2].abs() / scale);
        let least = best.map_or(f64::INFINITY, |(least, _)| least);
        if !off.iter().all(|off| off.is_finite()) || (least < close(&here) && missed >= least) {
            break;
        }
        if missed < least {
            best = Some((missed, here));
        }
        if missed < 2.0 * f64::EPSILON {
            break;
        }
        let step = solve(&here.by(asked), off);
        let bend = step[0].abs() / 2.0 + step[1].abs() / 8.0;
        let pull = step[2].abs() / (4.0 + here.state[2].abs());
        let share = (MOST_BEND / bend.max(pull)).min(1.0);
        here = Fit::new(std::array::from_fn(|i| here.state[i] + share * step[i]));
    }
    best.filter(|(missed, found)| *missed <= close(found)).map(|(_, found)| found)
}

/// The outermost end tangents of minimum energy curves in a direction of the (theta0, theta1)
/// plane, in radians from +theta0 (thesis figure 3.13): what lies beyond is no minimum energy curve's.
///
/// π/2 for `theta0` = `theta1`, 1.7378 where they are opposite; nowhere does an angle exceed 2.1668.
/// Accurate to about 1e-12.
///
/// ```
/// use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
/// let symmetric = faircurve::families::mec::envelope(FRAC_PI_4);
/// assert!((symmetric.theta0 - FRAC_PI_2).abs() < 1e-10);
/// ```
pub fn envelope(direction: f64) -> ChordAngles {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};
    let direction = if direction.is_finite() { direction } else { FRAC_PI_4 };
    let family = Elastica::with_lambda(0.5);
    let quarter = family.quarter_period();
    // Angles are equal where the middle is a vertex, opposite where it is an inflection.
    let quarters = ((FRAC_PI_4 - direction) / FRAC_PI_2).rem_euclid(4.0);
    let at = |phase: f64| outermost(&family.moved(phase * quarter));
    let off = |phase: f64| {
        let angles = at(phase);
        let off = FRAC_PI_4 - angles.theta1.atan2(angles.theta0) - quarters * FRAC_PI_2;
        off - TAU * (off / TAU).round()
    };
    let (low, high) = (quarters.floor(), quarters.floor() + 1.0);
    let phase = monotone_root(off, low, high).unwrap_or(quarters);
    at(phase)
}

/// The end tangents of the longest piece around a place of the rectangular elastica that still has
/// least energy among those with its end tangents: one that can't slide along the curve without
/// changing them.
fn outermost(middle: &Elastica) -> ChordAngles {
    const STEP: f64 = 0.25;
    const LONGEST: f64 = 12.0;
    let piece = |length: f64| {
        let state = middle.scaled(length);
        Fit::new([state.curvature(), state.slope(), 0.0])
    };
    let slides = |length: f64| {
        let [turning, difference] = piece(length).ends;
        turning.by[0] * difference.by[1] - turning.by[1] * difference.by[0]
    };
    let mut length = STEP;
    while length < LONGEST && slides(length + STEP) > 0.0 {
        length += STEP;
    }
    let length = monotone_root(slides, length, length + STEP).unwrap_or(length);
    let [turning, difference] = piece(length).ends.map(|end| end.value);
    ChordAngles::new((turning - difference) / 2.0, (turning + difference) / 2.0)
}

/// How many times as far out as the envelope these end tangents lie.
pub(super) fn reach(angles: ChordAngles) -> f64 {
    let point = Complex64::new(angles.theta0, angles.theta1);
    let bound = envelope(point.arg());
    point.norm() / Complex64::new(bound.theta0, bound.theta1).norm()
}
