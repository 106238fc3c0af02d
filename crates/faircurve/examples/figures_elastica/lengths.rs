//! Elastica of given length: figures 3.10 and 3.15 to 3.17.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

use faircurve::families::kurgla1::fit_si_mec;
use faircurve::families::mec::{MecSegment, fit_mec, fit_of_length};
use faircurve::frame::ChordAngles;
use faircurve::kurbo::{Point, Vec2};
use num_complex::Complex64;

use crate::page::{Axes, BLUE, GREY, INK, Page, RED, steps};

/// The elastica between these angles for arc length 1, by chord length.
fn by_chord(angles: ChordAngles, count: usize) -> Vec<(f64, MecSegment)> {
    steps(0.004, 0.996, count)
        .filter_map(|chord| Some((chord, fit_of_length(angles, 1.0 / chord)?)))
        .collect()
}

/// Figure 3.10: values of λ for varying chord lengths, the end tangents at right angles to the chord.
pub(crate) fn lambda_by_chord() -> String {
    let mut page = Page::new(560.0, 380.0);
    let axes = Axes {
        corner: Point::new(60.0, 20.0),
        size: Vec2::new(470.0, 310.0),
        x: [0.0, 1.0],
        y: [0.0, 0.55],
    };
    axes.draw(&mut page, &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0], &[0.0, 0.1, 0.2, 0.3, 0.4, 0.5]);
    let found = by_chord(ChordAngles::new(FRAC_PI_2, FRAC_PI_2), 600);
    page.line(found.iter().map(|(chord, s)| axes.at(*chord, s.elastica.lambda())), INK, 1.6);
    page.words(Point::new(295.0, 368.0), "middle", "chord length over arc length");
    page.words(Point::new(14.0, 40.0), "start", "λ");
    page.finish()
}

/// Figure 3.15: MEC and SI-MEC energies for varying lengths (π/2).
pub(crate) fn energies_of_right_angles() -> String {
    energies(ChordAngles::new(-FRAC_PI_2, -FRAC_PI_2), &[0.1, 0.3, 0.457, 0.637, 0.8, 0.93])
}

/// Figure 3.16: the same for π/3.
pub(crate) fn energies_of_60_degrees() -> String {
    energies(ChordAngles::new(-FRAC_PI_3, -FRAC_PI_3), &[0.2, 0.45, 0.65, 0.8, 0.9, 0.97])
}

/// Figure 3.17: the same for (π/2, −π/2).
pub(crate) fn energies_of_opposite_angles() -> String {
    energies(ChordAngles::new(-FRAC_PI_2, FRAC_PI_2), &[0.2, 0.4, 0.6, 0.72, 0.79, 0.9])
}

/// Energy by chord over arc length, for unit chord (MEC, blue) and for unit arc (SI-MEC, black), with
/// the places of MEC and SI-MEC themselves; below, some of the curves, how they go on (dashed), and the line of action, as
/// long as the force.
fn energies(angles: ChordAngles, shown: &[f64]) -> String {
    let mut page = Page::new(720.0, 560.0);
    let found = by_chord(angles, 400);
    let of = |segment: &MecSegment| segment.elastica.arc_energy();
    let axes = Axes {
        corner: Point::new(60.0, 20.0),
        size: Vec2::new(630.0, 260.0),
        x: [0.0, 1.0],
        y: [0.0, 60.0],
    };
    axes.draw(
        &mut page,
        &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0],
        &[0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0],
    );
    let mut plot = |energy: &dyn Fn(&(f64, MecSegment)) -> f64, colour: &str| {
        let points = found.iter().map(|one| (one.0, energy(one))).filter(|(_, e)| *e <= 60.0);
        page.line(points.map(|(x, e)| axes.at(x, e)), colour, 1.6);
    };
    plot(&|(_, segment)| of(segment), INK);
    plot(&|(chord, segment)| of(segment) * chord, BLUE);
    page.words(axes.at(0.02, 55.0), "start", "SI-MEC (black): energy for unit arc length");
    page.words(axes.at(0.02, 50.0), "start", "MEC (blue): energy for unit chord");
    // The minima in closed form.
    let mec = fit_mec(angles, 0.0).map(|segment| 1.0 / segment.length).ok();
    let si_mec = fit_si_mec(angles).map(|segment| 1.0 / segment.length).ok();
    for (chord, words) in [(mec, "MEC"), (si_mec, "SI-MEC")] {
        if let Some(chord) = chord {
            page.dashed([axes.at(chord, 0.0), axes.at(chord, 60.0)], RED);
            page.words(axes.at(chord, 61.0), "middle", words);
        }
    }
    let cell = 630.0 / shown.len() as f64;
    for (i, chord) in shown.iter().enumerate() {
        let Some(segment) = fit_of_length(angles, 1.0 / chord) else { continue };
        let centre = Point::new(60.0 + cell * (i as f64 + 0.5), 430.0);
        let (whole, ends) = (segment.elastica, segment.elastica.at(-0.5).point);
        let chord_way = whole.at(0.5).point - ends;
        let turn = chord_way.conj() / chord_way.norm();
        let middle = (whole.at(0.5).point + ends) / 2.0;
        let place = |z: Complex64| {
            let z = (z - middle) * turn * 88.0;
            centre + Vec2::new(z.re, -z.im)
        };
        page.dashed(steps(-1.1, 1.1, 160).map(|s| place(whole.at(s).point)), GREY);
        page.line(steps(-0.5, 0.5, 120).map(|s| place(whole.at(s).point)), INK, 1.8);
        if let Some((foot, along)) = whole.line_of_action() {
            // A force of 100 is as long as the strip; the strongest don't fit.
            let reach = Complex64::from_polar((whole.force().norm() / 200.0).min(0.6), along);
            // From where it is nearest to the middle of the chord.
            let direction = Complex64::cis(along);
            let foot = foot + direction * ((middle - foot) * direction.conj()).re;
            page.line([place(foot - reach), place(foot + reach)], RED, 1.4);
        }
        let words = format!("{chord}: λ = {:.3}", whole.lambda());
        page.words(Point::new(centre.x, 540.0), "middle", &words);
    }
    page.finish()
}
