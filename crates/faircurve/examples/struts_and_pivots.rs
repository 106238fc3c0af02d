//! The chain of struts and pivots (thesis 3.6): rigid struts, at each pivot a spring whose torque is its
//! turning angle over the length of a strut. With its ends held and its length given it comes to rest as
//! an elastica, the more exactly the more struts there are.
//!
//! ```sh
//! cargo run --release -p faircurve --example struts_and_pivots
//! ```
//!
//! finds where the forces balance, by Newton's method, and says how far the pivots are from the
//! elastica of the same ends and length, and how far the force in the struts is from its force.

use std::io::Write as _;

use faircurve::Segment;
use faircurve::families::mec::{fit_of_length, force_in};
use faircurve::frame::ChordAngles;
use faircurve::kurbo::{Point, Vec2};

const ANGLES: ChordAngles = ChordAngles::new(0.9, 1.4);
const LENGTH: f64 = 1.4;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut out = std::io::stdout().lock();
    let fit = fit_of_length(ANGLES, LENGTH).ok_or("no elastica")?;
    let elastica = Segment::elastica(Point::ZERO, Point::new(1.0, 0.0), fit.elastica);
    let force = force_in(&elastica).ok_or("no force")?;
    let lambda = fit.elastica.lambda();
    writeln!(out, "elastica: λ = {lambda:.6}, force ({:.6}, {:.6})", force.x, force.y)?;
    for struts in [10, 20, 40, 80] {
        let (directions, own_force) = at_rest(&elastica, struts);
        let strut = LENGTH / struts as f64;
        let (mut at, mut off) = (Point::ZERO, 0.0f64);
        for (i, direction) in directions.iter().enumerate() {
            at += Vec2::from_angle(*direction) * strut;
            off = off.max((at - elastica.point((i + 1) as f64 * strut)).hypot());
        }
        let error = (own_force - force).hypot();
        writeln!(out, "{struts:3} struts: pivots off by {off:.2e}, force by {error:.2e}")?;
    }
    Ok(())
}

/// The directions of the struts of a chain at rest, and the force in it, found from a chain along a
/// curve.
///
/// The torque that a strut feels from the springs at both its ends balances that of the force:
/// M₁ − M₀ + strut × force = 0. The unknowns are the directions and the force; what is left to hold is
/// that the struts reach from end to end.
fn at_rest(along: &Segment, struts: usize) -> (Vec<f64>, Vec2) {
    let strut = LENGTH / struts as f64;
    let middle = |i: usize| along.direction((i as f64 + 0.5) * strut);
    let mut directions: Vec<f64> = (0..struts).map(middle).collect();
    let mut force = Vec2::ZERO;
    let [start, end] = [-ANGLES.theta0, ANGLES.theta1];
    for _ in 0..30 {
        // Tridiagonal in the directions, by elimination with three right-hand sides: what is off, and
        // the two parts of the force.
        let mut upper = vec![0.0; struts];
        let mut right = vec![[0.0; 3]; struts];
        for i in 0..struts {
            let (direction, unit) = (directions[i], Vec2::from_angle(directions[i]) * strut);
            // The springs at the ends turn half a strut.
            let before = if i == 0 {
                2.0 * (direction - start) / strut
            } else {
                (direction - directions[i - 1]) / strut
            };
            let after = if i + 1 == struts {
                2.0 * (end - direction) / strut
            } else {
                (directions[i + 1] - direction) / strut
            };
            let off = after - before + unit.cross(force);
            let [left_spring, right_spring] =
                [i == 0, i + 1 == struts].map(|is_end| if is_end { 2.0 } else { 1.0 } / strut);
            let mut pivot = -left_spring - right_spring - unit.dot(force);
            right[i] = [-off, unit.y, -unit.x];
            if i > 0 {
                pivot -= upper[i - 1] / strut;
                for j in 0..3 {
                    right[i][j] -= right[i - 1][j] / strut;
                }
            }
            upper[i] = if i + 1 < struts { 1.0 / strut / pivot } else { 0.0 };
            right[i] = right[i].map(|value| value / pivot);
        }
        for i in (0..struts - 1).rev() {
            for j in 0..3 {
                right[i][j] -= upper[i] * right[i + 1][j];
            }
        }
        // The end must not miss: 2 × 2 equations for the change of the force.
        let mut miss = Vec2::new(-1.0, 0.0);
        let mut by = [Vec2::ZERO; 3];
        for (direction, right) in directions.iter().zip(&right) {
            let unit = Vec2::from_angle(*direction) * strut;
            miss += unit;
            for j in 0..3 {
                by[j] += Vec2::new(-unit.y, unit.x) * right[j];
            }
        }
        let wanted = -miss - by[0];
        let determinant = by[1].cross(by[2]);
        let change = Vec2::new(wanted.cross(by[2]), by[1].cross(wanted)) / determinant;
        for (direction, right) in directions.iter_mut().zip(&right) {
            *direction += right[0] + change.x * right[1] + change.y * right[2];
        }
        force += change;
    }
    (directions, force)
}
