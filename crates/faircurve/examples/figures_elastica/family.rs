//! The family by λ: figures 3.1, 3.2, 3.5 and 5.15.

use std::f64::consts::PI;

use faircurve::kurbo::{Point, Rect, Vec2};
use faircurve::numeric::elastica::Elastica;

use crate::page::{Axes, BLUE, GREY, INK, Page, RED, steps};

/// The circle, curves without inflections, the solitary wave, curves with loops, the lemnoid, the
/// rectangular elastica, and what becomes a sine wave.
const LAMBDAS: [f64; 12] =
    [0.0, 0.1, 0.2, 0.249, 0.25, 0.251, 0.28, 0.302_621_391_474_496_8, 0.35, 0.5, 1.0, 2.0];

fn name(lambda: f64) -> String {
    format!("λ = {}", (lambda * 1e4).round() / 1e4)
}

/// The elastica so far to both sides, y down, and its box.
fn traced(elastica: &Elastica, length: f64, count: usize) -> (Vec<Point>, Rect) {
    let points: Vec<Point> = steps(-length, length, count)
        .map(|s| elastica.at(s).point)
        .map(|p| Point::new(p.re, -p.im))
        .collect();
    let bounds = points
        .iter()
        .fold(Rect::from_points(points[0], points[0]), |bounds, p| bounds.union_pt(*p));
    (points, bounds)
}

/// Figure 3.1: the family of elastica solutions.
pub(crate) fn curves() -> String {
    const CELL: Vec2 = Vec2::new(230.0, 190.0);
    let mut page = Page::new(3.0 * CELL.x, 4.0 * CELL.y);
    for (i, lambda) in LAMBDAS.into_iter().enumerate() {
        let corner = Point::new(CELL.x * (i % 3) as f64, CELL.y * (i / 3) as f64);
        // As many periods as make a picture.
        let length = match lambda {
            0.0 => PI,
            l if l < 0.24 => 20.0,
            _ => 14.0,
        };
        let elastica = Elastica::with_lambda(lambda);
        let (points, bounds) = traced(&elastica, length, 600);
        let scale = (200.0 / bounds.width()).min(140.0 / bounds.height());
        let centre = corner + CELL / 2.0 - Vec2::new(0.0, 8.0);
        let place = |p: &Point| centre + (*p - bounds.center()) * scale;
        page.line(points.iter().map(place), INK, 1.3);
        page.words(corner + Vec2::new(CELL.x / 2.0, CELL.y - 8.0), "middle", &name(lambda));
    }
    page.finish()
}

/// Figure 3.2: their curvature, 25 units of arc length to either side.
pub(crate) fn curvatures() -> String {
    const ROW: f64 = 74.0;
    let mut page = Page::new(640.0, ROW * LAMBDAS.len() as f64 + 30.0);
    for (i, lambda) in LAMBDAS.into_iter().enumerate() {
        let axes = Axes {
            corner: Point::new(110.0, 10.0 + ROW * i as f64),
            size: Vec2::new(510.0, ROW - 14.0),
            x: [-25.0, 25.0],
            y: [-1.05, 1.05],
        };
        page.line([axes.at(-25.0, 0.0), axes.at(25.0, 0.0)], GREY, 1.0);
        let elastica = Elastica::with_lambda(lambda);
        page.line(steps(-25.0, 25.0, 500).map(|s| axes.at(s, elastica.at(s).curvature)), INK, 1.3);
        page.words(axes.at(-26.0, 0.0) + Vec2::new(0.0, 4.0), "end", &name(lambda));
        if i + 1 == LAMBDAS.len() {
            for s in [-20.0, -10.0, 0.0, 10.0, 20.0] {
                page.words(axes.at(s, -1.05) + Vec2::new(0.0, 16.0), "middle", &s.to_string());
            }
        }
    }
    page.finish()
}

/// Figure 3.5: examples of the pendulum analogy. How high the pendulum of the same λ swings, beside
/// its elastica; its places are apart by equal times.
pub(crate) fn pendulums() -> String {
    const SHOWN: [f64; 5] = [0.1, 0.249, 0.302_621_391_474_496_8, 0.5, 1.5];
    const ROW: f64 = 150.0;
    let mut page = Page::new(620.0, ROW * SHOWN.len() as f64);
    for (i, lambda) in SHOWN.into_iter().enumerate() {
        let pivot = Point::new(130.0, ROW * (i as f64 + 0.5));
        let elastica = Elastica::with_lambda(lambda);
        let quarter = elastica.quarter_period();
        // The direction of the elastica is the angle of the pendulum from its lowest place.
        let bob = |angle: f64| pivot + Vec2::new(angle.sin(), angle.cos()) * 60.0;
        page.circle(pivot, 60.0, "#eee");
        for s in steps(-quarter, quarter, 16) {
            let at = bob(elastica.at(s).direction);
            page.line([pivot, at], GREY, 0.8);
            page.dot(at, 2.5, BLUE);
        }
        let highest = bob(elastica.at(quarter).direction);
        page.line([pivot, highest], INK, 1.5);
        page.dot(highest, 5.0, RED);
        page.dot(pivot, 2.5, INK);
        let (points, bounds) = traced(&elastica, 3.0 * quarter, 400);
        let scale = (300.0 / bounds.width()).min(120.0 / bounds.height());
        let centre = Point::new(420.0, pivot.y);
        page.line(points.iter().map(|p| centre + (*p - bounds.center()) * scale), INK, 1.3);
        page.words(Point::new(8.0, pivot.y - 58.0), "start", &name(lambda));
    }
    page.finish()
}

/// Figure 5.15: the rectangular elastica as the curve of the centre of a rectangular hyperbola that
/// rolls along a line.
pub(crate) fn roulette() -> String {
    let mut page = Page::new(640.0, 330.0);
    // Of the hyperbola x² − y² = 1 the point at a distance r from the centre has a tangent at a distance
    // 1/r. So the centre is as high above the line as its way to the point of contact is long, inverted:
    // the cosine of its direction is the square of its height, which is the rectangular elastica.
    let line = 250.0;
    let scale = 95.0;
    let rectangular = Elastica::with_lambda(0.5);
    let quarter = rectangular.quarter_period();
    // With κ = 1 at the vertex the distance from the line of action is 2κ.
    let at = |s: f64| {
        let here = rectangular.at(s);
        Point::new(here.point.re / 2.0, here.curvature)
    };
    let place = |p: Point| Point::new(320.0 + scale * p.x, line - scale * p.y);
    page.line([Point::new(10.0, line), Point::new(630.0, line)], INK, 1.0);
    page.line(steps(-0.999 * quarter, 0.999 * quarter, 300).map(|s| place(at(s))), INK, 2.0);
    let beyond = |sign: f64| {
        steps(sign * quarter, sign * 2.2 * quarter, 200).map(|s| place(at(s))).collect::<Vec<_>>()
    };
    page.dashed(beyond(1.0), GREY);
    page.dashed(beyond(-1.0), GREY);
    for (s, colour) in [(-0.62, GREY), (0.0, BLUE), (0.62, GREY)].map(|(u, c)| (u * quarter, c)) {
        // Mirrored: the thesis's elastica bends upwards from its vertex.
        let (centre, direction) = (at(s), -rectangular.at(s).direction);
        // The centre moves at right angles to the way from it to the point of contact.
        let normal = Vec2::from_angle(direction - PI / 2.0);
        let contact = centre + normal * (centre.y / -normal.y);
        let radius = (contact - centre).hypot();
        // The point of the hyperbola at that distance: cosh 2t = r².
        let t = -s.signum() * (radius * radius).max(1.0).acosh() / 2.0;
        let own = Vec2::new(t.cosh(), t.sinh()).atan2();
        let turn = (contact - centre).atan2() - own;
        for branch in [0.0, PI] {
            page.line(
                steps(-1.35, 1.35, 60)
                    .map(|t| Vec2::new(t.cosh(), t.sinh()))
                    .map(|v| Vec2::from_angle(v.atan2() + turn + branch) * v.hypot())
                    .map(|v| place(centre + v)),
                colour,
                1.2,
            );
        }
        page.line([place(centre), place(contact)], colour, 0.8);
        page.dot(place(centre), 3.5, RED);
        page.dot(place(contact), 2.5, INK);
    }
    page.finish()
}
