//! Splines: figures 4.2, 4.14 and 7.1.

use std::f64::consts::{PI, TAU};

use faircurve::families::euler::fit_euler;
use faircurve::families::kurgla1::fit_si_mec;
use faircurve::families::mec::fit_mec;
use faircurve::frame::ChordAngles;
use faircurve::kurbo::{Point, Vec2};
use faircurve::{Contour, Join, Knot, Segment, Solution, catalog, solve};

use crate::page::{Axes, BLUE, INK, Page, RED, steps};

fn solved(contour: &Contour, name: &str) -> Option<Solution> {
    solve(contour, &*catalog::spline(name).ok()?).ok()
}

/// Figure 4.2: the minimum energy curve through the corners of an equilateral triangle, thick, and the
/// circle, thin.
pub(crate) fn roundness() -> String {
    let mut page = Page::new(360.0, 360.0);
    let (centre, radius) = (Point::new(180.0, 180.0), 150.0);
    page.circle(centre, radius, BLUE);
    let knots =
        (0..3).map(|i| centre + Vec2::from_angle(PI / 2.0 + TAU * f64::from(i) / 3.0) * -radius);
    let knots: Vec<Point> = knots.collect();
    if let Some(solution) = solved(&Contour::closed(knots.clone()), "mec") {
        let curve = &solution.curve;
        let points = steps(0.0, curve.length(), 300).filter_map(|s| curve.at(s));
        page.line(points.map(|at| at.point), INK, 2.5);
        let farthest = curve.segments()[0].point(curve.segments()[0].length() / 2.0) - centre;
        let words = format!("radius up to {:.4}", farthest.hypot() / radius);
        page.words(centre, "middle", &words);
    }
    for knot in knots {
        page.dot(knot, 4.0, RED);
    }
    page.finish()
}

/// Figure 4.14: MEC, SI-MEC and Euler spiral compared. Along each of the curves ticks meter curvature;
/// each is drawn along the lines on which the rate of change is constant: curvature grows along the
/// line of action's normal, along the chord, and along the curve itself.
pub(crate) fn gradients() -> String {
    let mut page = Page::new(820.0, 270.0);
    let angles = ChordAngles::new(0.2, 1.2);
    let ends = (Point::ZERO, Point::new(1.0, 0.0));
    let (Ok(mec), Ok(si_mec), Ok(euler)) =
        (fit_mec(angles, 0.0), fit_si_mec(angles), fit_euler(angles))
    else {
        return page.finish();
    };
    let segments = [
        ("MEC", Segment::elastica(ends.0, ends.1, mec.elastica)),
        ("SI-MEC", Segment::elastica(ends.0, ends.1, si_mec.elastica())),
        ("Euler spiral", Segment::spiral(ends.0, ends.1, euler)),
    ];
    for (i, (name, segment)) in segments.iter().enumerate() {
        let corner = Point::new(30.0 + 265.0 * i as f64, 80.0);
        let place = |p: Point| corner + Vec2::new(p.x, -p.y) * 225.0;
        let length = segment.length();
        page.line(steps(0.0, length, 120).map(|s| place(segment.point(s))), INK, 1.8);
        let [low, high] = [0.0, length].map(|s| segment.curvature(s));
        // Of an elastica the lines of equal curvature are parallel to the line of action.
        let along = match segment.shape() {
            faircurve::Shape::Elastica(elastica) => {
                let middle = segment.direction(length / 2.0);
                elastica.line_of_action().map(|(_, direction)| middle + direction)
            }
            _ => None,
        };
        for curvature in steps(low, high, 12) {
            // Curvature grows steadily on this piece, but for the MEC's end.
            let places: Vec<f64> = steps(0.0, length, 2000).collect();
            let Some(at) = places.windows(2).find(|s| {
                let [a, b] = [s[0], s[1]].map(|s| segment.curvature(s) - curvature);
                a * b <= 0.0
            }) else {
                continue;
            };
            let here = segment.at(at[0]);
            let tick = Vec2::from_angle(along.unwrap_or(here.direction + PI / 2.0)) * 0.035;
            page.line([place(here.point - tick), place(here.point + tick)], RED, 1.1);
        }
        page.words(Point::new(corner.x + 112.0, 250.0), "middle", name);
    }
    page.finish()
}

/// Figure 7.1: an oval of eccentricity 0.56199 with G2 and with G4 continuity, and its curvature.
pub(crate) fn oval() -> String {
    const ECCENTRICITY: f64 = 0.56199;
    let mut page = Page::new(760.0, 470.0);
    let minor = (1.0 - ECCENTRICITY * ECCENTRICITY).sqrt();
    let knots: Vec<Point> = (0..4)
        .map(|i| TAU * f64::from(i) / 4.0)
        .map(|t| Point::new(t.cos(), minor * t.sin()))
        .collect();
    let contour = |join: Join| Contour::closed(knots.iter().map(|p| Knot::new(*p).join(join)));
    let all =
        [("G2: Euler spirals", Join::G2, "euler"), ("G4: minimum variation", Join::G4, "mvc")];
    for (i, (words, join, name)) in all.into_iter().enumerate() {
        let Some(solution) = solved(&contour(join), name) else { continue };
        let curve = &solution.curve;
        let centre = Point::new(200.0 + 370.0 * i as f64, 150.0);
        let place = |p: Point| centre + Vec2::new(p.x, -p.y) * 130.0;
        let places = || steps(0.0, curve.length(), 400).filter_map(|s| Some((s, curve.at(s)?)));
        page.line(places().map(|(_, at)| place(at.point)), INK, 2.0);
        for knot in &knots {
            page.dot(place(*knot), 4.0, RED);
        }
        let axes = Axes {
            corner: Point::new(50.0 + 370.0 * i as f64, 310.0),
            size: Vec2::new(300.0, 110.0),
            x: [0.0, curve.length()],
            y: [0.6, 1.5],
        };
        axes.draw(&mut page, &[], &[0.75, 1.0, 1.25, 1.5]);
        page.line(places().map(|(s, at)| axes.at(s, at.curvature)), BLUE, 1.6);
        page.words(Point::new(centre.x, 450.0), "middle", words);
    }
    page.finish()
}
