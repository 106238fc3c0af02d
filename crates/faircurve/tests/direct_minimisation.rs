//! The variational splines against their definition: a fine chain of struts through the knots
//! (thesis 3.6), whose energy is made least directly, knows nothing of elastica.

use faircurve::frame::wrap_angle;
use faircurve::kurbo::{Point, Vec2};
use faircurve::{Contour, Solution, Status, catalog, solve};

const KNOTS: [(f64, f64); 4] = [(0.0, 0.0), (2.0, 1.5), (4.0, 1.0), (5.0, -1.0)];
const SEGMENTS: usize = KNOTS.len() - 1;

/// What is made least, of the turns at the pivots and the distances over which they happen, and of
/// the length of the whole.
type Objective = fn(&[f64], &[f64], f64) -> f64;

fn energy(turns: &[f64], over: &[f64], _length: f64) -> f64 {
    turns.iter().zip(over).map(|(turn, over)| turn * turn / over).sum()
}

fn energy_times_length(turns: &[f64], over: &[f64], length: f64) -> f64 {
    energy(turns, over, length) * length
}

fn variation(turns: &[f64], over: &[f64], _length: f64) -> f64 {
    let curvatures: Vec<f64> = turns.iter().zip(over).map(|(turn, over)| turn / over).collect();
    let change = |i: usize| {
        let apart = (over[i] + over[i + 1]) / 2.0;
        (curvatures[i + 1] - curvatures[i]).powi(2) / apart
    };
    (0..curvatures.len() - 1).map(change).sum()
}

/// A chain: the directions of so many struts a segment, all equally long, and the lengths of the
/// segments.
struct Chain {
    struts: usize,
    objective: Objective,
}

impl Chain {
    fn value(&self, x: &[f64]) -> f64 {
        let (directions, lengths) = x.split_at(SEGMENTS * self.struts);
        let strut = |i: usize| lengths[i / self.struts] / self.struts as f64;
        let turns: Vec<f64> = directions.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let over: Vec<f64> = (0..turns.len()).map(|i| (strut(i) + strut(i + 1)) / 2.0).collect();
        (self.objective)(&turns, &over, lengths.iter().sum())
    }

    /// How far each segment's struts miss its chord.
    fn misses(&self, x: &[f64]) -> Vec<f64> {
        let (directions, lengths) = x.split_at(SEGMENTS * self.struts);
        directions
            .chunks(self.struts)
            .enumerate()
            .flat_map(|(i, part)| {
                let strut = lengths[i] / self.struts as f64;
                let sum = part.iter().fold(Vec2::ZERO, |sum, d| sum + Vec2::from_angle(*d) * strut);
                let miss = sum - (Point::from(KNOTS[i + 1]) - Point::from(KNOTS[i]));
                [miss.x, miss.y]
            })
            .collect()
    }

    /// The gradient of objective + multipliers · misses, by differences, and the misses.
    fn stationarity(&self, unknowns: &[f64], count: usize) -> Vec<f64> {
        const H: f64 = 1e-5;
        let (x, multipliers) = unknowns.split_at(count);
        let lagrangian = |x: &[f64]| {
            let misses = self.misses(x);
            self.value(x) + multipliers.iter().zip(misses).map(|(m, miss)| m * miss).sum::<f64>()
        };
        let mut moved = x.to_vec();
        let mut all: Vec<f64> = (0..count)
            .map(|i| {
                moved[i] = x[i] + H;
                let up = lagrangian(&moved);
                moved[i] = x[i] - H;
                let down = lagrangian(&moved);
                moved[i] = x[i];
                (up - down) / (2.0 * H)
            })
            .collect();
        all.extend(self.misses(x));
        all
    }

    /// Newton's method, from a chain along a curve. The least value.
    fn least(&self, along: &Solution) -> f64 {
        const H: f64 = 1e-4;
        let segments = along.curve.segments();
        let mut unknowns: Vec<f64> = segments
            .iter()
            .flat_map(|segment| {
                let place = |i: usize| segment.length() * (i as f64 + 0.5) / self.struts as f64;
                (0..self.struts).map(move |i| segment.direction(place(i)))
            })
            .collect();
        // Directions of neighbouring segments may differ by whole turns.
        for i in 1..unknowns.len() {
            unknowns[i] = unknowns[i - 1] + wrap_angle(unknowns[i] - unknowns[i - 1]);
        }
        unknowns.extend(segments.iter().map(|segment| segment.length()));
        let count = unknowns.len();
        unknowns.resize(count + 2 * SEGMENTS, 0.0);
        let mut last = f64::INFINITY;
        for _ in 0..30 {
            let off = self.stationarity(&unknowns, count);
            let size = off.iter().fold(0.0f64, |most, off| most.max(off.abs()));
            if size >= last && size < 1e-6 {
                break;
            }
            last = size;
            let n = unknowns.len();
            let mut rows = vec![vec![0.0; n + 1]; n];
            for j in 0..n {
                let mut moved = unknowns.clone();
                moved[j] += H;
                let up = self.stationarity(&moved, count);
                moved[j] -= 2.0 * H;
                let down = self.stationarity(&moved, count);
                (0..n).for_each(|i| rows[i][j] = (up[i] - down[i]) / (2.0 * H));
            }
            (0..n).for_each(|i| rows[i][n] = -off[i]);
            let step = eliminated(rows);
            unknowns.iter_mut().zip(step).for_each(|(x, step)| *x += step);
        }
        assert!(last < 1e-6, "{last:e}");
        self.value(&unknowns[..count])
    }
}

/// The solution of linear equations, by elimination with pivoting.
fn eliminated(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for column in 0..n {
        let best =
            (column..n).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()));
        rows.swap(column, best.unwrap());
        let pivot = rows[column].clone();
        for row in rows.iter_mut().skip(column + 1) {
            let factor = row[column] / pivot[column];
            (column..=n).for_each(|j| row[j] -= factor * pivot[j]);
        }
    }
    let mut x = vec![0.0; n];
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| rows[i][j] * x[j]).sum();
        x[i] = (rows[i][n] - known) / rows[i][i];
    }
    x
}

#[test]
fn chains_of_struts_converge_to_the_splines() {
    type Value = fn(&Solution) -> f64;
    let objectives: [(&str, Objective, Value); 3] = [
        ("mec", energy, |s| s.curve.bending_energy()),
        ("simec", energy_times_length, |s| s.curve.bending_energy() * s.curve.length()),
        ("mvc", variation, |s| s.curve.variation_energy()),
    ];
    for (name, objective, of_curve) in objectives {
        let solution = solve(&Contour::open(KNOTS), &*catalog::spline(name).unwrap()).unwrap();
        assert_eq!(solution.report.status(), Status::Solved);
        let exact = of_curve(&solution);
        let [coarse, fine] = [6, 12].map(|struts| Chain { struts, objective }.least(&solution));
        // The error falls as n⁻²: four times the finer less the coarser is right to n⁻⁴.
        let extrapolated = (4.0 * fine - coarse) / 3.0;
        let (off, rest) = ((fine / exact - 1.0).abs(), (extrapolated / exact - 1.0).abs());
        assert!(off < 0.01 && rest < 0.01 * off, "{name}: {off:e} {rest:e}");
    }
}
