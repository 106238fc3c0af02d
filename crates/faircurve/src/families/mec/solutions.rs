//! Elastica with given ends, end angles and length (thesis section 3.7): the principal one, and
//! all others.

use super::segment::{Asked, Fit, Last, MecSegment, fit, newton};
use crate::frame::ChordAngles;
use crate::numeric::elastica::Elastica;
use crate::numeric::order::sort_by;

/// The elastica with these end tangents and this arc length, above 1, on the unit chord: the one
/// that continues the curve of least energy times length, bent or pulled to its length.
///
/// `None` where there is no such, for instance where `length` is below what the angles take, and for
/// lengths above 10⁴.
///
/// ```
/// use faircurve::{families::mec::fit_of_length, frame::ChordAngles};
/// use std::f64::consts::{FRAC_PI_2, PI};
/// // Pulled tight, half a circle becomes a hairpin, λ nearly ¼ (thesis figure 3.10).
/// let bent = fit_of_length(ChordAngles::new(FRAC_PI_2, FRAC_PI_2), PI / 2.0).unwrap();
/// assert!(bent.elastica.lambda() < 1e-12);
/// let tight = fit_of_length(ChordAngles::new(FRAC_PI_2, FRAC_PI_2), 1.05).unwrap();
/// assert!((tight.elastica.lambda() - 0.25).abs() < 1e-3);
/// ```
pub fn fit_of_length(angles: ChordAngles, length: f64) -> Option<MecSegment> {
    /// From one length to the next.
    const STRIDE: f64 = 0.1;
    const LEAST_STRIDE: f64 = 1e-4;
    const LONGEST: f64 = 1e4;
    if !(length > 1.0 && length <= LONGEST) {
        return None;
    }
    // Under a tension with which a segment exists for wide angles, too.
    let mean = angles.theta0.powi(2) + angles.theta1.powi(2) - angles.theta0 * angles.theta1;
    let mut here = fit(angles, -2.0 * mean.min(4.0)).ok()?;
    // By the part of the arc that the chord lacks.
    let lack = |straightness: f64| (1.0 - straightness).ln();
    let wanted = 1.0 / length;
    let mut stride = STRIDE;
    loop {
        let (from, to) = (here.segment(angles).length.recip(), wanted);
        let whole = if to > 0.5 && from > 0.5 { lack(to) - lack(from) } else { to - from };
        let is_last = whole.abs() <= stride;
        let share = if is_last { 1.0 } else { stride / whole.abs() };
        let next = match () {
            () if is_last => to,
            () if to > 0.5 && from > 0.5 => 1.0 - (lack(from) + share * whole).exp(),
            () => from + share * whole,
        };
        match newton(&Asked::new(angles, Last::Straightness(next)), here.state) {
            Some(found) if is_last => return Some(found.segment(angles)),
            Some(found) => (here, stride) = (found, (2.0 * stride).min(STRIDE)),
            None if stride > LEAST_STRIDE => stride /= 4.0,
            None => return None,
        }
    }
}

/// Every elastica with these end tangents, up to whole turns, and this arc length on the unit chord,
/// that has at most so many inflections; those of least bending energy first.
///
/// Newton's method from a grid over the whole family finds them, 36 phases and steps of half of a
/// quarter period: what is missing, if anything, differs little from what is there.
pub fn all_of_length(angles: ChordAngles, length: f64, inflections: usize) -> Vec<MecSegment> {
    const LAMBDAS: [f64; 14] =
        [0.0, 0.05, 0.12, 0.2, 0.24, 0.26, 0.28, 0.32, 0.4, 0.5, 0.7, 1.2, 3.0, 10.0];
    if !(length > 1.0 && length.is_finite()) {
        return Vec::new();
    }
    let asked = Asked::new(angles, Last::Straightness(1.0 / length)).up_to_turns();
    search(angles, &asked, &LAMBDAS, inflections)
}

/// Every piece of the rectangular elastica, λ = ½, with these end tangents, up to whole turns, on
/// the unit chord, that has at most so many inflections, as for [`all_of_length`] (thesis figure 3.11).
pub fn all_rectangular(angles: ChordAngles, inflections: usize) -> Vec<MecSegment> {
    let asked = Asked::new(angles, Last::Constant(0.0)).up_to_turns();
    search(angles, &asked, &[0.5], inflections)
}

fn search(
    angles: ChordAngles,
    asked: &Asked,
    lambdas: &[f64],
    inflections: usize,
) -> Vec<MecSegment> {
    const PHASES: usize = 36;
    let mut found: Vec<MecSegment> = Vec::new();
    for lambda in lambdas {
        let family = Elastica::with_lambda(*lambda);
        // The solitary wave has no period; some length will do.
        let quarter = family.quarter_period().min(8.0);
        for phase in 0..PHASES {
            let middle = family.moved(4.0 * quarter * phase as f64 / PHASES as f64);
            for span in 1..=4 * (inflections + 2) {
                let piece = middle.scaled(quarter * span as f64 / 2.0);
                for piece in [piece, piece.mirrored()] {
                    let state = [piece.curvature(), piece.slope(), piece.constant()];
                    if let Some(fit) = newton(asked, state) {
                        add(&mut found, &fit, angles, inflections);
                    }
                }
            }
        }
    }
    sort_by(&mut found, |a, b| energy(a).total_cmp(&energy(b)));
    found
}

/// Adds a segment, unless it is there already or has too many inflections.
fn add(found: &mut Vec<MecSegment>, fit: &Fit, angles: ChordAngles, most_inflections: usize) {
    /// Of curvature; solutions are apart by much more.
    const SAME: f64 = 1e-7;
    let new = fit.segment(angles);
    let state = |segment: &MecSegment| {
        [segment.elastica.curvature(), segment.elastica.slope(), segment.elastica.constant()]
    };
    let size = |segment: &MecSegment| 1.0 + segment.elastica.largest_curvature();
    let is_same = |old: &MecSegment| {
        let (a, b) = (state(old), state(&new));
        (0..3).all(|i| (a[i] - b[i]).abs() <= SAME * size(&new).powi(i as i32 + 1))
    };
    if inflections(&new.elastica) <= most_inflections && !found.iter().any(is_same) {
        found.push(new);
    }
}

/// The inflections of the arc from −½ to ½: one each half period.
fn inflections(elastica: &Elastica) -> usize {
    // Curvature changes its sign at most once between places closer than a quarter period.
    let quarter = elastica.quarter_period();
    let places = (1.0 / quarter).ceil().clamp(1.0, 1000.0) as usize * 2;
    let curvature = |i: usize| elastica.at(i as f64 / places as f64 - 0.5).curvature;
    (0..places).filter(|&i| curvature(i) * curvature(i + 1) < 0.0).count()
}

/// ∫ κ² ds for unit chord.
fn energy(segment: &MecSegment) -> f64 {
    segment.elastica.arc_energy() * segment.length.recip()
}
