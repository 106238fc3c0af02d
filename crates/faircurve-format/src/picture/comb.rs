//! The curvature comb.

use faircurve::kurbo::{BezPath, Point, Vec2};
use faircurve::{Curve, Segment};

use super::{
    COMB_AREA, COMB_OUTLINE, COMB_OUTLINE_WIDTH, COMB_TEETH, COMB_TOOTH_WIDTH, MOST_AT_ONCE, Mark,
    Stroke,
};
use crate::solved::SolvedGlyph;

/// Fraction of the curved length that bends less than the tooth of [`TYPICAL_TOOTH`].
const TYPICAL: f64 = 0.9;
/// Length of the tooth at the [`TYPICAL`] curvature, as a fraction of the picture's size.
const TYPICAL_TOOTH: f64 = 0.085;
/// Length at which teeth are cut, as a fraction of the picture's size.
const LONGEST_TOOTH: f64 = 0.14;
/// Distance of teeth, as a fraction of the picture's size.
const SPACING: f64 = 0.011;
/// The comb's outline is drawn through this many points from tooth to tooth.
const FINE: usize = 3;
/// No segment has more teeth than this, however it winds.
const MOST_TEETH: f64 = 500.0;

/// How long teeth are and how far apart: the same for every glyph of a picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct CombScale {
    /// The curvature whose tooth has the length [`TYPICAL_TOOTH`]; 0 where nothing is curved.
    typical: f64,
    size: f64,
}

impl CombScale {
    pub(super) fn new(glyphs: &[&SolvedGlyph], size: f64) -> Self {
        const SAMPLES: usize = 16;
        let mut bends: Vec<(f64, f64)> = Vec::new();
        for segment in glyphs.iter().flat_map(|glyph| curves(glyph)).flat_map(Curve::segments) {
            let step = segment.length() / SAMPLES as f64;
            let curvature = |i: usize| segment.curvature(step * (i as f64 + 0.5)).abs();
            bends.extend((0..SAMPLES).map(|i| (curvature(i), step)).filter(|b| b.0 > 0.0));
        }
        bends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let total: f64 = bends.iter().map(|bend| bend.1).sum();
        let mut below = 0.0;
        let reaches = |bend: &&(f64, f64)| {
            below += bend.1;
            below >= TYPICAL * total
        };
        let typical = bends.iter().find(reaches).or(bends.last()).map_or(0.0, |bend| bend.0);
        CombScale { typical, size }
    }

    /// The tooth's vector at arc length `s`, pointing to the convex side.
    fn tooth(&self, segment: &Segment, s: f64) -> Vec2 {
        if self.typical == 0.0 {
            return Vec2::ZERO;
        }
        let length = segment.curvature(s) / self.typical * TYPICAL_TOOTH;
        let length = length.clamp(-LONGEST_TOOTH, LONGEST_TOOTH) * self.size;
        Vec2::from_angle(segment.direction(s)).turn_90() * -length
    }
}

fn curves(glyph: &SolvedGlyph) -> impl Iterator<Item = &Curve> {
    glyph.contours.iter().map(|contour| &contour.solution.curve)
}

/// A glyph's comb: the area that it covers, its teeth, and the line through their tips.
pub(super) fn marks(glyph: &SolvedGlyph, scale: &CombScale, size: f64) -> Vec<Mark> {
    let segments = curves(glyph).flat_map(Curve::segments).filter(|segment| !segment.is_line());
    let segments: Vec<&Segment> = segments.collect();
    segments.chunks(MOST_AT_ONCE).flat_map(|some| comb(some, scale, size)).collect()
}

fn comb(segments: &[&Segment], scale: &CombScale, size: f64) -> [Mark; 3] {
    let (mut area, mut teeth, mut outline) = (BezPath::new(), BezPath::new(), BezPath::new());
    for segment in segments {
        let count = (segment.length() / (SPACING * size)).ceil().clamp(1.0, MOST_TEETH) as usize;
        // What is shorter than the distance of two teeth needs no points between them.
        let fine = if count == 1 { 1 } else { FINE };
        let steps = count * fine;
        let place = |i: usize| {
            let s = segment.length() * (i as f64 / steps as f64);
            let foot = segment.point(s);
            (foot, foot + scale.tooth(segment, s))
        };
        let places: Vec<(Point, Point)> = (0..=steps).map(place).collect();
        for (foot, tip) in places.iter().step_by(fine) {
            teeth.move_to(*foot);
            teeth.line_to(*tip);
        }
        polyline(&mut outline, places.iter().map(|place| place.1));
        let there = places.iter().map(|place| place.0);
        polyline(&mut area, there.chain(places.iter().rev().map(|place| place.1)));
        area.close_path();
    }
    let line = |class, path, paint, width: f64| Mark {
        class,
        path,
        fill: None,
        stroke: Some(Stroke { paint, width: width * size, dashed: false }),
        exact: false,
    };
    [
        Mark { class: "comb-area", path: area, fill: Some(COMB_AREA), stroke: None, exact: false },
        line("comb-teeth", teeth, COMB_TEETH, COMB_TOOTH_WIDTH),
        line("comb-outline", outline, COMB_OUTLINE, COMB_OUTLINE_WIDTH),
    ]
}

fn polyline(path: &mut BezPath, points: impl Iterator<Item = Point>) {
    for (index, point) in points.enumerate() {
        if index == 0 {
            path.move_to(point);
        } else {
            path.line_to(point);
        }
    }
}

#[cfg(test)]
mod tests {
    use faircurve::kurbo::PathEl;
    use faircurve::{Contour, catalog, solve};

    use super::*;

    fn glyph(contour: &Contour) -> SolvedGlyph {
        let spline = catalog::spline("euler").unwrap();
        let solution = solve(contour, &*spline).unwrap();
        SolvedGlyph::new("", "", [("euler".to_owned(), solution)], None)
    }

    fn teeth(path: &BezPath) -> Vec<(Point, Point)> {
        path.elements()
            .chunks(2)
            .map(|pair| match pair {
                [PathEl::MoveTo(foot), PathEl::LineTo(tip)] => (*foot, *tip),
                other => panic!("not a tooth: {other:?}"),
            })
            .collect()
    }

    #[test]
    fn teeth_of_a_circle_are_equal_and_point_outward() {
        let circle = Contour::closed([(3.0, 0.0), (0.0, 3.0), (-3.0, 0.0), (0.0, -3.0)]);
        for contour in [circle.clone(), circle.reversed()] {
            let glyph = glyph(&contour);
            let marks = marks(&glyph, &CombScale::new(&[&glyph], 6.0), 6.0);
            let teeth = teeth(&marks[1].path);
            assert!(teeth.len() > 40);
            for (foot, tip) in teeth {
                assert!((foot.to_vec2().hypot() - 3.0).abs() < 1e-9);
                assert!((tip.to_vec2().hypot() - (3.0 + 6.0 * TYPICAL_TOOTH)).abs() < 1e-9);
                assert!((tip.to_vec2().normalize() - foot.to_vec2().normalize()).hypot() < 1e-9);
            }
        }
    }

    #[test]
    fn one_scale_holds_for_all_and_no_tooth_is_too_long() {
        let large = glyph(&Contour::closed([(3.0, 0.0), (0.0, 3.0), (-3.0, 0.0), (0.0, -3.0)]));
        let half = glyph(&Contour::closed([(1.5, 0.0), (0.0, 1.5), (-1.5, 0.0), (0.0, -1.5)]));
        let tiny = glyph(&Contour::closed([(0.01, 0.0), (0.0, 0.01), (-0.01, 0.0)]));
        let scale = CombScale::new(&[&large, &half, &tiny], 6.0);
        let length = |glyph: &SolvedGlyph| {
            let (foot, tip) = teeth(&marks(glyph, &scale, 6.0)[1].path)[0];
            (tip - foot).hypot()
        };
        assert!((length(&half) / length(&large) - 2.0).abs() < 1e-9);
        assert!((length(&tiny) - 6.0 * LONGEST_TOOTH).abs() < 1e-9);
    }

    #[test]
    fn straight_lines_have_no_comb() {
        let glyph = glyph(&Contour::open([(0.0, 0.0), (5.0, 5.0), (9.0, 9.0)]));
        assert!(marks(&glyph, &CombScale::new(&[&glyph], 9.0), 9.0).is_empty());
    }
}
