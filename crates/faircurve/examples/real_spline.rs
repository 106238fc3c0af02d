//! A real spline (thesis 3.12): weights hold the strip at every knot by friction, so that between two
//! of them its arc length is pinned and only turning is free. One weight after the other is lifted, the
//! strip slides there until its tension is the same on both sides, and the weight is put back.
//!
//! ```sh
//! cargo run --release -p faircurve --example real_spline
//! ```
//!
//! The whole length never changes, so that this doesn't lead to the minimum energy curve, but to
//! the curve of least energy of that length: the `mec` whose penalty is its tension. How far it is from
//! there is said after each round.

use std::io::Write as _;

use faircurve::catalog::Params;
use faircurve::families::mec::{MecSegment, fit_of_length};
use faircurve::frame::{ChordAngles, wrap_angle};
use faircurve::kurbo::Point;
use faircurve::{Contour, catalog, solve};

const KNOTS: [(f64, f64); 5] = [(0.0, 0.0), (2.0, 1.5), (4.0, 1.0), (5.0, -1.0), (7.0, -1.5)];
const SEGMENTS: usize = KNOTS.len() - 1;

/// How the strip lies: its direction at each knot, and its length between them.
struct Strip {
    directions: [f64; KNOTS.len()],
    lengths: [f64; SEGMENTS],
}

impl Strip {
    /// Curvature at both ends of a segment and its tension where it isn't bent, C.
    fn segment(&self, i: usize) -> Option<[f64; 3]> {
        let way = Point::from(KNOTS[i + 1]) - Point::from(KNOTS[i]);
        let (chord, along) = (way.hypot(), way.atan2());
        let angles =
            ChordAngles::from_directions(self.directions[i], along, self.directions[i + 1]);
        let MecSegment { elastica, length, .. } = fit_of_length(angles, self.lengths[i] / chord)?;
        let scale = length * chord;
        let [start, end] = [-0.5, 0.5].map(|s| elastica.at(s).curvature / scale);
        Some([start, end, elastica.constant() / (scale * scale)])
    }

    /// How far a knot is from rest: the jump of curvature (or what is left of it at an end), and of
    /// tension.
    fn off(&self, knot: usize) -> Option<[f64; 2]> {
        if knot == 0 {
            return Some([self.segment(0)?[0], 0.0]);
        }
        let before = self.segment(knot - 1)?;
        if knot == SEGMENTS {
            return Some([before[1], 0.0]);
        }
        let after = self.segment(knot)?;
        Some([after[0] - before[1], after[2] - before[2]])
    }

    /// Turns the strip at a knot, and, with the weight lifted, slides it there, until it rests.
    fn relax(&mut self, knot: usize, lifted: bool) -> Option<()> {
        const H: f64 = 1e-6;
        for _ in 0..6 {
            let here = self.off(knot)?;
            let mut by = [[0.0; 2]; 2];
            for (j, by) in by.iter_mut().enumerate() {
                self.move_by(knot, j, H);
                let there = self.off(knot)?;
                self.move_by(knot, j, -H);
                *by = [0, 1].map(|i| (there[i] - here[i]) / H);
            }
            let [turn, slide] = if lifted {
                let determinant = by[0][0] * by[1][1] - by[0][1] * by[1][0];
                [
                    (here[0] * by[1][1] - here[1] * by[1][0]) / determinant,
                    (here[1] * by[0][0] - here[0] * by[0][1]) / determinant,
                ]
            } else {
                [here[0] / by[0][0], 0.0]
            };
            // No further at once than the strip stays a gentle one.
            self.move_by(knot, 0, -turn.clamp(-0.1, 0.1));
            if slide != 0.0 {
                self.move_by(knot, 1, -slide.clamp(-0.005, 0.005));
            }
        }
        Some(())
    }

    /// Turns the strip at a knot (0), or draws it through to the left (1).
    fn move_by(&mut self, knot: usize, which: usize, amount: f64) {
        if which == 0 {
            self.directions[knot] += amount;
        } else if (1..SEGMENTS).contains(&knot) {
            self.lengths[knot - 1] += amount;
            self.lengths[knot] -= amount;
        }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut out = std::io::stdout().lock();
    let free = solve(&Contour::open(KNOTS), &*catalog::spline("mec")?)?;
    // Laid out roughly: along the minimum energy curve, but a little short, and unevenly so.
    let mut strip = Strip { directions: [0.0; KNOTS.len()], lengths: [0.0; SEGMENTS] };
    for (i, segment) in free.curve.segments().iter().enumerate() {
        let slack = segment.length() - segment.chord_length();
        strip.lengths[i] = segment.chord_length() + slack * [0.55, 0.9, 0.6, 0.8][i];
        strip.directions[i] = segment.direction(0.0);
        strip.directions[i + 1] = segment.direction(segment.length());
    }
    let whole: f64 = strip.lengths.iter().sum();
    for _ in 0..40 {
        (0..KNOTS.len()).try_for_each(|knot| strip.relax(knot, false)).ok_or("pulled too tight")?;
    }
    writeln!(
        out,
        "strip of length {whole:.6}; the minimum energy curve has {:.6}",
        free.curve.length()
    )?;
    for round in 0..=60 {
        if round > 0 {
            for knot in 0..KNOTS.len() {
                strip.relax(knot, (1..SEGMENTS).contains(&knot)).ok_or("pulled too tight")?;
            }
        }
        if round % 10 == 0 {
            // The mec under the mean tension.
            let mut tension = 0.0;
            for i in 0..SEGMENTS {
                tension -= strip.segment(i).ok_or("no segment")?[2] / SEGMENTS as f64;
            }
            let params = Params::new().with("penalty", (2.0 * tension).max(0.0));
            let theory = solve(&Contour::open(KNOTS), &*catalog::build("mec", &params)?)?;
            let off = (0..KNOTS.len())
                .filter_map(|i| theory.knots[i].direction_out.or(theory.knots[i].direction_in))
                .zip(strip.directions)
                .map(|(theirs, ours)| wrap_angle(theirs - ours).abs())
                .fold(0.0, f64::max);
            let longer = whole - theory.curve.length();
            writeln!(
                out,
                "round {round:2}: penalty {:.6}, directions off by {off:.1e}, length by {longer:.1e}",
                2.0 * tension
            )?;
        }
    }
    Ok(())
}
