//! Problems made of bytes: small drawings whose numbers are hard on arithmetic.

use std::fmt;

use arbitrary::{Arbitrary, Result, Unstructured};
use cpu_time::ThreadTime;
use faircurve::catalog::{self, ENTRIES, ParamKind, Params};
use faircurve::convert::{Cuts, Fit, Options};
use faircurve::kurbo::{Point, Vec2};
use faircurve::{Contour, Join, Knot, Solution, solve};

/// A contour and the spline to solve it with.
pub struct Problem {
    /// The spline's name in the catalogue.
    pub spline: &'static str,
    /// Its parameters.
    pub params: Params,
    /// What to solve.
    pub contour: Contour,
}

impl Problem {
    /// The solution; `None` where the contour is refused.
    ///
    /// # Panics
    /// If solving takes too long.
    pub fn solve(&self) -> Option<Solution> {
        /// Seconds of processor time, of which instrumented code needs a few times more than the
        /// library as it is used. No input of the corpus takes a fifth of this.
        const LONGEST: u64 = 5;
        let spline = catalog::build(self.spline, &self.params).expect("the parameters are known");
        let start = ThreadTime::now();
        let solution = solve(&self.contour, &*spline).ok();
        let seconds = start.elapsed().as_secs();
        assert!(seconds < LONGEST, "solving takes {seconds} s: {self:?}");
        solution
    }
}

impl<'a> Arbitrary<'a> for Problem {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let info = *u.choose(ENTRIES)?;
        let mut params = Params::new();
        for param in info.params {
            match param.kind {
                ParamKind::Choice { options } => params.set(param.name, *u.choose(options)?),
                ParamKind::Number { min, max, .. } => {
                    let along = f64::from(u.arbitrary::<u8>()?) / 255.0;
                    params.set(param.name, &*(min + along * (max - min)).to_string());
                }
                // Formulas have tests of their own.
                ParamKind::Text { .. } => {}
            }
        }
        Ok(Problem { spline: info.name, params, contour: contour(u)? })
    }
}

/// Prints the problem as the body of a test.
impl fmt::Debug for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let how = if self.contour.closed { "closed" } else { "open" };
        write!(f, "{} {:?}, Contour::{how}([", self.spline, self.params)?;
        for knot in &self.contour.knots {
            write!(f, "\n    Knot {{ point: Point::new({:?}, {:?})", knot.point.x, knot.point.y)?;
            if let Some(join) = knot.join {
                write!(f, ", join: Some(Join::{join:?})")?;
            }
            for (name, tangent) in
                [("tangent_in", knot.tangent_in), ("tangent_out", knot.tangent_out)]
            {
                if let Some(Vec2 { x, y }) = tangent {
                    write!(f, ", {name}: Some(Vec2::new({x:?}, {y:?}))")?;
                }
            }
            for (name, number) in [
                ("curvature_in", knot.curvature_in),
                ("curvature_out", knot.curvature_out),
                ("tension_in", knot.tension_in),
                ("tension_out", knot.tension_out),
                ("curl", knot.curl),
            ] {
                if let Some(number) = number {
                    write!(f, ", {name}: Some({number:?})")?;
                }
            }
            f.write_str(", ..Knot::default() },")?;
        }
        f.write_str("\n])")
    }
}

/// A deviation to ask for, sensible or not.
#[derive(Clone, Copy, Debug)]
pub struct Accuracy(
    /// In user units.
    pub f64,
);

impl<'a> Arbitrary<'a> for Accuracy {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        Ok(Accuracy(match u.arbitrary::<u8>()? % 4 {
            0 => number(u)?,
            _ => 10f64.powi(2 - i32::from(u.arbitrary::<u8>()? % 16)),
        }))
    }
}

/// A way to convert, with an accuracy.
#[derive(Clone, Debug)]
pub struct BezierOptions(
    /// What to ask for.
    pub Options,
);

impl<'a> Arbitrary<'a> for BezierOptions {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let Accuracy(accuracy) = u.arbitrary()?;
        let mut options = Options::new(accuracy);
        let flags = u.arbitrary::<u8>()?;
        options.span_knots = flags & 1 != 0;
        options.free_joints = flags & 2 != 0;
        options.at_extrema = flags & 4 != 0;
        options.at_inflections = flags & 8 != 0;
        // Mostly the default; the angle metrics and equal errors are slow under instrumentation.
        if flags & 0x30 == 0x30 {
            options.fit = u.choose(Fit::ALL)?.0;
            options.cuts = *u.choose(&[Cuts::Greedy, Cuts::Halving, Cuts::HalvingBend])?;
        }
        Ok(BezierOptions(options))
    }
}

fn contour(u: &mut Unstructured<'_>) -> Result<Contour> {
    /// More knots make each run slower and find nothing more.
    const MOST_KNOTS: usize = 12;
    let closed = u.arbitrary()?;
    let (scale, shift) = match u.arbitrary::<u8>()? % 16 {
        0..=11 => (1.0, Vec2::ZERO),
        12..=13 => (power_of_two(u)?, Vec2::ZERO),
        14 => (1.0, Vec2::new(number(u)?, number(u)?)),
        _ => (power_of_two(u)?, Vec2::new(number(u)?, number(u)?)),
    };
    let count = usize::from(u.arbitrary::<u8>()?) % (MOST_KNOTS + 1);
    let mut points: Vec<Point> = Vec::with_capacity(count);
    let mut knots = Vec::with_capacity(count);
    for _ in 0..count {
        let here = point(u, &points)?;
        points.push(here);
        let place = (here.to_vec2() * scale + shift).to_point();
        let mut knot = Knot::new(place).given(u)?;
        // One more than there are: none.
        knot.join = Join::ALL.get(usize::from(u.arbitrary::<u8>()?) % 7).copied();
        knots.push(knot);
    }
    Ok(Contour { knots, closed })
}

/// A new place, or one that has to do with those before it.
fn point(u: &mut Unstructured<'_>, points: &[Point]) -> Result<Point> {
    let kind = u.arbitrary::<u8>()? % 16;
    let (Some(&last), true) = (points.last(), kind >= 11) else {
        return Ok(Point::new(number(u)?, number(u)?));
    };
    let earlier = points[usize::from(u.arbitrary::<u8>()?) % points.len()];
    let step = u.arbitrary::<i8>()?;
    Ok(match kind {
        11 => earlier,
        // A few units in the last place away.
        12 => Point::new(stepped(earlier.x, step), stepped(earlier.y, step / 16)),
        13 => earlier + Vec2::new(number(u)?, number(u)?) * f64::from(step).exp2(),
        // In line with two others, to rounding.
        14 => last.lerp(earlier, f64::from(step) / 16.0),
        _ => last + (last - earlier) * f64::from(step).exp2(),
    })
}

/// The number so many units in the last place away.
fn stepped(number: f64, steps: i8) -> f64 {
    f64::from_bits(number.to_bits().wrapping_add_signed(i64::from(steps)))
}

/// Mostly numbers from drawings; some that no drawing has.
fn number(u: &mut Unstructured<'_>) -> Result<f64> {
    const SPECIAL: [f64; 16] = [
        0.0,
        -0.0,
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MAX,
        f64::MIN,
        f64::MIN_POSITIVE,
        5e-324,
        -5e-324,
        f64::EPSILON,
        1e55,
        -1e55,
        1e-55,
        1e-18,
        1e154,
    ];
    Ok(match u.arbitrary::<u8>()? % 32 {
        0..=11 => f64::from(u.arbitrary::<i8>()?),
        12..=19 => f64::from(u.arbitrary::<i16>()?) / 8.0,
        20..=25 => f64::from(u.arbitrary::<i32>()?) * (-31f64).exp2(),
        26..=28 => f64::from(u.arbitrary::<i16>()?) * power_of_two(u)?,
        29..=30 => SPECIAL[usize::from(u.arbitrary::<u8>()?) % SPECIAL.len()],
        _ => f64::from_bits(u.arbitrary()?),
    })
}

/// From beyond the smallest size that is solved to beyond the largest.
fn power_of_two(u: &mut Unstructured<'_>) -> Result<f64> {
    Ok((f64::from(u.arbitrary::<i8>()?) * 1.5).trunc().exp2())
}

trait Given: Sized {
    /// With some of what can be given at a knot.
    fn given(self, u: &mut Unstructured<'_>) -> Result<Self>;
}

impl Given for Knot {
    fn given(mut self, u: &mut Unstructured<'_>) -> Result<Self> {
        let what = u.arbitrary::<u8>()?;
        // Half of the knots, so that contours of few knots often have nothing given at all.
        if what < 128 {
            return Ok(self);
        }
        let has = |bit: u8| what >> bit & 1 == 1;
        let curvature = |u: &mut Unstructured<'_>| -> Result<f64> {
            Ok(number(u)? * (-f64::from(u.arbitrary::<u8>()? % 16)).exp2())
        };
        if has(0) {
            self.tangent_in = Some(Vec2::new(number(u)?, number(u)?));
        }
        if has(1) {
            self.curvature_in = Some(curvature(u)?);
        }
        if has(2) {
            // The same on both sides, as smooth joins need it.
            (self.tangent_out, self.curvature_out) = (self.tangent_in, self.curvature_in);
        }
        if has(3) {
            self.tangent_out = Some(Vec2::new(number(u)?, number(u)?));
        }
        if has(4) {
            self.curvature_out = Some(curvature(u)?);
        }
        if has(5) {
            self.tension_in = Some(number(u)?);
            self.tension_out = Some(number(u)?);
            self.curl = Some(number(u)?);
        }
        Ok(self)
    }
}
