//! Segments by their end angles: figures 3.11, 3.13 and 3.14.

use std::f64::consts::{FRAC_PI_4, PI};

use faircurve::Segment;
use faircurve::families::mec::{MecSegment, all_rectangular, envelope, fit_mec};
use faircurve::frame::ChordAngles;
use faircurve::kurbo::{Point, Rect, Vec2};

use crate::page::{Axes, BLUE, GREY, INK, Page, RED, steps};

fn placed(segment: &MecSegment) -> Segment {
    Segment::elastica(Point::ZERO, Point::new(1.0, 0.0), segment.elastica)
}

fn trace(segment: &Segment, count: usize) -> Vec<Point> {
    steps(0.0, segment.length(), count)
        .map(|s| segment.point(s))
        .map(|p| Point::new(p.x, -p.y))
        .collect()
}

/// Figure 3.11: the multiplicity of solutions for the same tangents, π/4 and π/4, with λ = ½.
pub(crate) fn all_with_the_same_tangents() -> String {
    const CELL: f64 = 200.0;
    const MOST: usize = 12;
    // Arcs above their chord, as the thesis draws them.
    let angles = ChordAngles::new(-FRAC_PI_4, -FRAC_PI_4);
    let mut all = all_rectangular(angles, 4);
    // Those that are mirror images of one another, left to right, are one.
    all.dedup_by(|a, b| (a.length - b.length).abs() < 1e-9);
    all.truncate(MOST);
    let rows = all.len().div_ceil(4);
    let mut page = Page::new(4.0 * CELL, CELL * rows as f64);
    for (i, segment) in all.iter().enumerate() {
        let corner = Point::new(CELL * (i % 4) as f64, CELL * (i / 4) as f64);
        let points = trace(&placed(segment), 400);
        let bounds = points.iter().fold(Rect::ZERO, |bounds, p| bounds.union_pt(*p));
        let scale = 150.0 / bounds.width().max(bounds.height());
        let centre = corner + Vec2::new(CELL / 2.0, CELL / 2.0 - 10.0);
        let place = |p: &Point| centre + (*p - bounds.center()) * scale;
        page.line(points.iter().map(place), INK, 1.4);
        page.dashed([Point::ZERO, Point::new(1.0, 0.0)].iter().map(place), GREY);
        for end in [Point::ZERO, Point::new(1.0, 0.0)] {
            page.dot(place(&end), 3.0, RED);
        }
        let words = format!("length {:.3}", segment.length);
        page.words(corner + Vec2::new(CELL / 2.0, CELL - 8.0), "middle", &words);
    }
    page.finish()
}

/// Degrees between neighbouring segments.
const STEP: i32 = 20;

/// The half of the parameter space on and above the diagonal that the thesis shows, as (angles in
/// degrees, place).
fn places(cell: f64) -> Vec<(ChordAngles, Point, f64)> {
    let mut all = Vec::new();
    for left in -6..=6 {
        for right in left..=6 {
            let angles = [left, right].map(|i| f64::from(i * STEP).to_radians());
            let at = Point::new(f64::from(left + 7) * cell, f64::from(7 - right) * cell);
            all.push((ChordAngles::new(angles[0], angles[1]), at, cell));
        }
    }
    all
}

fn frame(page: &mut Page, cell: f64) {
    let degrees = |angle: f64| angle.to_degrees() / f64::from(STEP) + 7.0;
    // The envelope, above the diagonal.
    let bound = steps(FRAC_PI_4, FRAC_PI_4 + PI, 240).map(envelope);
    page.line(
        bound.map(|b| Point::new(degrees(b.theta0) * cell, (14.0 - degrees(b.theta1)) * cell)),
        RED,
        1.4,
    );
    for i in -6..=6 {
        let (at, words) = (f64::from(i + 7) * cell, format!("{}°", i * STEP));
        page.words(Point::new(at, 14.3 * cell), "middle", &words);
        page.words(Point::new(2.0, 14.0 * cell - at + 4.0), "start", &words);
    }
}

/// Figure 3.13: angle-constrained minimum energy curves, and their envelope.
pub(crate) fn minimum_energy_curves() -> String {
    const CELL: f64 = 50.0;
    let mut page = Page::new(14.0 * CELL, 14.6 * CELL);
    frame(&mut page, CELL);
    for (angles, at, cell) in places(CELL) {
        let Ok(segment) = fit_mec(angles, 0.0) else { continue };
        let points = trace(&placed(&segment), 60);
        let bounds = points.iter().fold(Rect::ZERO, |bounds, p| bounds.union_pt(*p));
        let scale = 0.72 * cell / bounds.width().max(bounds.height());
        page.line(points.iter().map(|p| at + (*p - bounds.center()) * scale), INK, 1.3);
    }
    page.finish()
}

/// Figure 3.14: curvature plots of angle-constrained minimum energy curves.
pub(crate) fn curvatures() -> String {
    const CELL: f64 = 50.0;
    let mut page = Page::new(14.0 * CELL, 14.6 * CELL);
    frame(&mut page, CELL);
    for (angles, at, cell) in places(CELL) {
        let Ok(segment) = fit_mec(angles, 0.0) else { continue };
        let axes = Axes {
            corner: at - Vec2::new(0.38, 0.38) * cell,
            size: Vec2::new(0.76, 0.76) * cell,
            x: [0.0, 1.0],
            y: [-6.0, 6.0],
        };
        let segment = placed(&segment);
        page.line([axes.at(0.0, 0.0), axes.at(1.0, 0.0)], GREY, 0.8);
        page.line(
            steps(0.0, 1.0, 50).map(|u| axes.at(u, segment.curvature(u * segment.length()))),
            BLUE,
            1.3,
        );
    }
    page.finish()
}
