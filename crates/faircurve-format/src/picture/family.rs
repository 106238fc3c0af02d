//! Pictures of two-parameter families: what the segments look like over the square of their end
//! angles (thesis figures 3.13, 4.5, 4.10), and how curvature at their start depends on both (8.6,
//! 12.1; Bespoke figures 1, 3, 4).
//!
//! What is drawn has the same structure whatever rounding does, so that pictures can be compared
//! number by number: every segment is as many Béziers as any other.

use std::f64::consts::PI;

use faircurve::Segment;
use faircurve::frame::ChordAngles;
use faircurve::kurbo::{Affine, BezPath, Point, Rect, Shape, Vec2};

use super::sheet::{line_of, written};
use super::{Cell, INK, LINE, Mark, Paint, Picture, View, lettering, paint};

/// Width of the square of angles, in the picture's units.
const SQUARE: f64 = 440.0;
const TEXT: f64 = 9.0;
const TITLE: f64 = 11.0;
/// Room for labels to the left of the square, and below it.
const LEFT: f64 = 46.0;
const BELOW: f64 = 34.0;
const ABOVE: f64 = 30.0;
/// Tenths of a unit are finer than any line.
const DECIMALS: usize = 1;

const LABEL_INK: Paint = paint(INK, 0.75);
const AXIS: Paint = paint(INK, 0.18);
const EDGE: Paint = paint(INK, 0.6);

/// Curvatures for unit chord at which contour lines run and colours change.
const LEVELS: [f64; 9] = [-8.0, -4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0, 8.0];

/// Colours between the levels: clockwise blue, counterclockwise red.
const COLOURS: [(&str, [u8; 3]); 10] = [
    ("below--8", [0x2a, 0x5c, 0x9e]),
    ("below--4", [0x5a, 0x8a, 0xc0]),
    ("below--2", [0x8f, 0xb4, 0xd9]),
    ("below--1", [0xc0, 0xd7, 0xeb]),
    ("below-0", [0xe7, 0xef, 0xf6]),
    ("above-0", [0xf9, 0xec, 0xe6]),
    ("above-1", [0xf3, 0xcf, 0xc0]),
    ("above-2", [0xe6, 0xa4, 0x8c]),
    ("above-4", [0xd2, 0x72, 0x58]),
    ("above-8", [0xb0, 0x3f, 0x2e]),
];

impl Picture {
    /// The segments of a family over the square of end angles, every 30 degrees up to 150: theta0 to the
    /// right, theta1 upward. Each is scaled to the same size; where `segment` has none there
    /// is a gap.
    pub fn parameter_space(
        title: &str,
        segment: &dyn Fn(ChordAngles) -> Option<Segment>,
    ) -> Picture {
        const MOST: i32 = 5;
        const STEP: f64 = 30.0;
        /// The larger side of every segment, as a part of the space that it has.
        const FILLED: f64 = 0.74;
        let pitch = SQUARE / f64::from(2 * MOST + 1);
        let at = |i: i32| (f64::from(i + MOST) + 0.5) * pitch;
        let mut path = BezPath::new();
        for j in -MOST..=MOST {
            for i in -MOST..=MOST {
                let radians = |i: i32| (f64::from(i) * STEP).to_radians();
                let Some(segment) = segment(ChordAngles::new(radians(i), radians(j))) else {
                    continue;
                };
                let drawn = beziers(&segment);
                let bounds = drawn.bounding_box();
                let side = bounds.width().max(bounds.height());
                if !(side > 0.0 && side.is_finite()) {
                    continue;
                }
                let place = Affine::translate((at(i), SQUARE - at(j)))
                    * Affine::FLIP_Y
                    * Affine::scale(FILLED * pitch / side)
                    * Affine::translate(-bounds.center().to_vec2());
                path.extend((place * drawn).iter());
            }
        }
        let mut axes = BezPath::new();
        for i in -MOST..=MOST {
            let x = at(i);
            axes.extend(kurbo_line(Point::new(x, 0.0), Point::new(x, SQUARE)));
            axes.extend(kurbo_line(Point::new(0.0, x), Point::new(SQUARE, x)));
        }
        let labels: Vec<(f64, f64)> =
            (-MOST..=MOST).map(|i| (at(i), f64::from(i) * STEP)).collect();
        let marks =
            vec![Mark::line("axes", axes, AXIS, 0.4), Mark::line("segments", path, LINE, 1.3)];
        framed(title, marks, &labels, 0.0)
    }

    /// Curvature at a segment's start, for unit chord, over the square of end angles up to half a turn:
    /// theta0 to the right, theta1 upward; in colours, with contour lines. Where
    /// `curvature` has none there is a gap.
    pub fn curvature_map(title: &str, curvature: &dyn Fn(ChordAngles) -> Option<f64>) -> Picture {
        /// Odd, so that no place lies where families have exact symmetries, and rounding decides nothing.
        const CELLS: usize = 41;
        /// At half a turn itself many families have nothing.
        const EDGE: f64 = 0.996 * PI;
        let pitch = SQUARE / CELLS as f64;
        let radians = |i: usize| EDGE * (2.0 * i as f64 / CELLS as f64 - 1.0);
        let value = |i: usize, j: usize| {
            let curvature = curvature(ChordAngles::new(radians(i), radians(j)));
            curvature.filter(|curvature| !curvature.is_nan()).map(squeezed)
        };
        let values: Vec<Vec<Option<f64>>> =
            (0..=CELLS).map(|j| (0..=CELLS).map(|i| value(i, j)).collect()).collect();
        let corner = |i: usize, j: usize| {
            Some((Point::new(i as f64 * pitch, SQUARE - j as f64 * pitch), values[j][i]?))
        };
        let mut bands: [BezPath; 10] = Default::default();
        let (mut lines, mut zero) = (BezPath::new(), BezPath::new());
        for j in 0..CELLS {
            // Neighbours of one colour are one rectangle, which makes small files.
            let mut run: Option<(usize, Rect)> = None;
            for i in 0..CELLS {
                let corners =
                    [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
                let [Some(a), Some(b), Some(c), Some(d)] = corners else { continue };
                let (low, high) = range(&[a, b, c, d]);
                if band(low) == band(high) {
                    let square = Rect::from_points(a.0, c.0);
                    run = Some(match run {
                        Some((here, r)) if here == band(low) && r.x1 == square.x0 => {
                            (here, r.union(square))
                        }
                        before => {
                            flush(&mut bands, before);
                            (band(low), square)
                        }
                    });
                    continue;
                }
                fill(&mut bands, [a, b, c, d]);
                for level in LEVELS {
                    let lines = if level == 0.0 { &mut zero } else { &mut lines };
                    contour_line(lines, [a, b, c, d], squeezed(level));
                }
            }
            flush(&mut bands, run);
        }
        let mark = |(path, (class, rgb)): (BezPath, (&'static str, [u8; 3]))| Mark {
            class,
            path,
            fill: Some(paint(rgb, 1.0)),
            stroke: None,
            exact: false,
        };
        let mut marks: Vec<Mark> = bands.into_iter().zip(COLOURS).map(mark).collect();
        marks.push(Mark::line("contours", lines, paint(INK, 0.55), 0.7));
        marks.push(Mark::line("zero", zero, LINE, 1.4));
        let degrees = [-180.0, -90.0, 0.0, 90.0, 180.0];
        let labels = degrees.map(|degrees| ((degrees / 180.0 + 1.0) / 2.0 * SQUARE, degrees));
        let legend = legend(&mut marks);
        framed(title, marks, &labels, legend)
    }
}

fn kurbo_line(from: Point, to: Point) -> BezPath {
    let mut path = BezPath::new();
    path.move_to(from);
    path.line_to(to);
    path
}

/// A segment as so many cubics whose arms are a third of their arcs: within a hundredth of a turn
/// of it, which no picture shows.
fn beziers(segment: &Segment) -> BezPath {
    const PIECES: usize = 8;
    /// Directions are those just inside a piece, since at a cusp they are those of the other side.
    const INSIDE: f64 = 1e-6;
    let step = segment.length() / PIECES as f64;
    let mut path = BezPath::new();
    path.move_to(segment.start());
    for i in 0..PIECES {
        let (from, to) = (step * i as f64, step * (i + 1) as f64);
        let arm = |s: f64| Vec2::from_angle(segment.direction(s)) * (step / 3.0);
        let (start, end) = (segment.point(from), segment.point(to));
        path.curve_to(start + arm(from + INSIDE * step), end - arm(to - INSIDE * step), end);
    }
    path
}

/// All curvatures in (−1, 1), so that interpolation stays sensible near a cusp.
fn squeezed(curvature: f64) -> f64 {
    (curvature / 4.0).atan() * (2.0 / PI)
}

/// Beyond this difference of squeezed curvatures, a square holds a jump or a cusp, and nothing is
/// interpolated.
const JUMP: f64 = 0.7;

fn range(corners: &[(Point, f64)]) -> (f64, f64) {
    let values = || corners.iter().map(|corner| corner.1);
    (values().fold(1.0, f64::min), values().fold(-1.0, f64::max))
}

/// The colour of a squeezed curvature.
fn band(value: f64) -> usize {
    LEVELS.iter().take_while(|level| value > squeezed(**level)).count()
}

/// Fills a run of squares with their colour.
fn flush(bands: &mut [BezPath; 10], run: Option<(usize, Rect)>) {
    if let Some((band, area)) = run {
        bands[band].extend(area.to_path(0.1));
    }
}

/// Divides a square between the colours that it has.
fn fill(bands: &mut [BezPath; 10], corners: [(Point, f64); 4]) {
    let (low, high) = range(&corners);
    if high - low > JUMP {
        // Each corner has its own quarter.
        let middle = corners[0].0.midpoint(corners[2].0);
        for (corner, value) in corners {
            polygon(
                &mut bands[band(value)],
                &[
                    (corner, 0.0),
                    (Point::new(middle.x, corner.y), 0.0),
                    (middle, 0.0),
                    (Point::new(corner.x, middle.y), 0.0),
                ],
            );
        }
        return;
    }
    for here in band(low)..=band(high) {
        let mut area = corners.to_vec();
        if here > 0 {
            area = clipped(&area, squeezed(LEVELS[here - 1]), 1.0);
        }
        if here < LEVELS.len() {
            area = clipped(&area, squeezed(LEVELS[here]), -1.0);
        }
        polygon(&mut bands[here], &area);
    }
}

/// What of a polygon lies above a level (`side` = 1) or below it (−1).
fn clipped(polygon: &[(Point, f64)], level: f64, side: f64) -> Vec<(Point, f64)> {
    let mut kept = Vec::with_capacity(polygon.len() + 2);
    for (i, &a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        let (above_a, above_b) = ((a.1 - level) * side >= 0.0, (b.1 - level) * side >= 0.0);
        if above_a {
            kept.push(a);
        }
        if above_a != above_b {
            kept.push((a.0.lerp(b.0, (level - a.1) / (b.1 - a.1)), level));
        }
    }
    kept
}

fn polygon(path: &mut BezPath, corners: &[(Point, f64)]) {
    let Some((first, rest)) = corners.split_first() else { return };
    path.move_to(first.0);
    rest.iter().for_each(|corner| path.line_to(corner.0));
    path.close_path();
}

/// The line through a square on which the corners' values, interpolated, are `level`.
fn contour_line(path: &mut BezPath, corners: [(Point, f64); 4], level: f64) {
    let (low, high) = range(&corners);
    if high - low > JUMP {
        return;
    }
    let crossing = |a: (Point, f64), b: (Point, f64)| {
        let crosses = (a.1 < level) != (b.1 < level);
        crosses.then(|| a.0.lerp(b.0, (level - a.1) / (b.1 - a.1)))
    };
    let points: Vec<Point> =
        (0..4).filter_map(|i| crossing(corners[i], corners[(i + 1) % 4])).collect();
    for pair in points.chunks_exact(2) {
        path.move_to(pair[0]);
        path.line_to(pair[1]);
    }
}

/// The colours and their curvatures, to the right of the square; how wide it is.
fn legend(marks: &mut Vec<Mark>) -> f64 {
    const GAP: f64 = 16.0;
    const WIDTH: f64 = 12.0;
    const HEIGHT: f64 = 26.0;
    let left = SQUARE + GAP;
    let top = (SQUARE - HEIGHT * COLOURS.len() as f64) / 2.0;
    let mut labels = BezPath::new();
    for (i, (class, rgb)) in COLOURS.into_iter().rev().enumerate() {
        let y = top + HEIGHT * i as f64;
        let area = Rect::new(left, y, left + WIDTH, y + HEIGHT).to_path(0.1);
        let fill = Some(paint(rgb, 1.0));
        marks.push(Mark { class, path: area, fill, stroke: None, exact: false });
    }
    for (i, level) in LEVELS.into_iter().rev().enumerate() {
        let y = top + HEIGHT * (i + 1) as f64 + TEXT / 2.0;
        labels.extend(line_of(&number(level), TEXT, left + WIDTH + 6.0, y).iter());
    }
    let above = top - 10.0;
    labels.extend(line_of("κ", TEXT, left + 1.0, above).iter());
    marks.push(written("legend", labels, LABEL_INK, TEXT));
    let widest = LEVELS.into_iter().map(|level| lettering::width(&number(level), TEXT));
    GAP + WIDTH + 6.0 + widest.fold(0.0, f64::max)
}

fn number(x: f64) -> String {
    format!("{x}").replace('-', "−")
}

/// The marks of a square with its frame, the labels of both axes (place and degrees), and the title.
fn framed(title: &str, mut marks: Vec<Mark>, labels: &[(f64, f64)], right: f64) -> Picture {
    let frame = Rect::new(0.0, 0.0, SQUARE, SQUARE).to_path(0.1);
    marks.push(Mark::line("frame", frame, EDGE, 0.8));
    let mut words = BezPath::new();
    for (place, degrees) in labels {
        let label = number(*degrees) + "°";
        let width = lettering::width(&label, TEXT);
        words.extend(line_of(&label, TEXT, place - width / 2.0, SQUARE + 16.0).iter());
        let y = SQUARE - place + TEXT / 2.0;
        words.extend(line_of(&label, TEXT, -8.0 - width, y).iter());
    }
    let axis = |words: &str| lettering::width(words, TEXT);
    words.extend(line_of("θ0", TEXT, (SQUARE - axis("θ0")) / 2.0, SQUARE + 32.0).iter());
    words.extend(line_of("θ1", TEXT, -8.0 - axis("θ1"), -14.0).iter());
    marks.push(written("labels", words, LABEL_INK, TEXT));
    let left = (SQUARE - lettering::width(title, TITLE)) / 2.0;
    marks.push(written("title", line_of(title, TITLE, left, -12.0), LINE, TITLE));
    marks.retain(|mark| !mark.path.is_empty());
    let name = title.split(':').next().unwrap_or_default().to_owned();
    Picture {
        view: View {
            origin: Point::new(-LEFT, -ABOVE),
            width: LEFT + SQUARE + right + 12.0,
            height: ABOVE + SQUARE + BELOW,
        },
        ground: true,
        decimals: DECIMALS,
        cells: vec![Cell { name, layer: String::new(), offset: Vec2::ZERO, marks }],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contours_cross_where_the_level_is() {
        let corner = |x: f64, y: f64| (Point::new(x, y), (x + y) / 4.0);
        let corners = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
        let mut path = BezPath::new();
        contour_line(&mut path, corners, 0.125);
        let bounds = path.bounding_box();
        assert_eq!(bounds, Rect::new(0.0, 0.0, 0.5, 0.5));
        let mut none = BezPath::new();
        contour_line(&mut none, corners, 0.9);
        assert!(none.is_empty());
    }

    #[test]
    fn gaps_stay_empty_and_structure_is_the_same() {
        let line = |angles: ChordAngles| {
            (angles.theta0 >= 0.0).then(|| Segment::line(Point::ORIGIN, Point::new(1.0, 0.0)))
        };
        let picture = Picture::parameter_space("line", &line);
        let segments = &picture.cells[0].marks[1];
        assert_eq!(segments.path.elements().len(), 6 * 11 * (1 + 8));
        let map = Picture::curvature_map("sum", &|angles| Some(angles.turning()));
        assert!(map.cells[0].marks.iter().any(|mark| mark.class == "zero"));
        let none = Picture::curvature_map("none", &|_| None);
        assert!(none.cells[0].marks.iter().all(|mark| mark.class != "zero"));
    }
}
