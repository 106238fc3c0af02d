//! A picture of solved glyphs: filled outlines side by side, with their knots and curvature combs
//! if asked. [`svg`](crate::svg) and [`png`](crate::png) write it.
//!
//! Outlines are filled by the nonzero rule, as fonts are: a counter is a hole when it runs against
//! the contour around it. Open contours are lines without filling. A contour of which something
//! was relaxed is drawn dashed in red, and so are the knots concerned.
//!
//! Knots have the symbols of thesis Tables 7.1 and 10.1, as far as the words there say what they
//! are; the others are our own choice:
//!
//! | symbol | meaning |
//! |---|---|
//! | square | corner |
//! | diamond | G1 |
//! | ring | G2 |
//! | disc | G4 |
//! | half disc | one-way knot; its flat side faces the terminal side, typically a straight line |
//! | triangle, pointing the way of travel | start of an open contour |
//! | bar across the curve | end of an open contour |
//!
//! A comb's teeth stand on the convex side of the curve, perpendicular to it and proportional to
//! curvature, all glyphs of a picture to one scale. The few sharpest bends would leave no room for
//! the others: teeth have a greatest length, at which they are cut.

mod comb;
mod family;
mod layout;
mod lettering;
mod sheet;
mod symbols;

use faircurve::Status;
use faircurve::kurbo::{Affine, BezPath, Point, Rect, Shape, Vec2};

use crate::solved::{SolvedContour, SolvedGlyph};
use comb::CombScale;
pub use sheet::Panel;

/// What a picture shows besides the outlines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Show {
    /// The knots, with a symbol for each kind of join.
    pub knots: bool,
    /// The curvature comb.
    pub comb: bool,
}

impl Show {
    /// Whether anything is shown besides the outlines.
    pub fn any(self) -> bool {
        self.knots || self.comb
    }
}

/// A picture, ready to be written. y is down from here on.
#[derive(Clone, Debug)]
pub struct Picture {
    pub(crate) view: View,
    /// Whether there is a white ground; a bare outline has none, so that it can be used elsewhere.
    pub(crate) ground: bool,
    /// Decimals that show all there is to see.
    pub(crate) decimals: usize,
    pub(crate) cells: Vec<Cell>,
}

/// The part of the plane that is seen; neither side is zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub(crate) origin: Point,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

/// One glyph of a picture.
#[derive(Clone, Debug)]
pub(crate) struct Cell {
    pub(crate) name: String,
    pub(crate) layer: String,
    /// From the glyph's own coordinates (y down) to the picture's.
    pub(crate) offset: Vec2,
    /// Back to front.
    pub(crate) marks: Vec<Mark>,
}

/// One thing drawn, in the glyph's own coordinates, y down.
#[derive(Clone, Debug)]
pub(crate) struct Mark {
    pub(crate) class: &'static str,
    pub(crate) path: BezPath,
    pub(crate) fill: Option<Paint>,
    pub(crate) stroke: Option<Stroke>,
    /// Whether this is the curve itself, of which no digit is dropped.
    pub(crate) exact: bool,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Stroke {
    pub(crate) paint: Paint,
    pub(crate) width: f64,
    pub(crate) dashed: bool,
}

impl Stroke {
    /// Lengths of dash and gap, if it has them.
    pub(crate) fn dashes(&self) -> Option<[f64; 2]> {
        self.dashed.then_some([4.0 * self.width, 2.5 * self.width])
    }
}

/// A colour: red, green, blue, and opacity in [0, 1].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Paint {
    pub(crate) rgb: [u8; 3],
    pub(crate) opacity: f32,
}

const fn paint(rgb: [u8; 3], opacity: f32) -> Paint {
    Paint { rgb, opacity }
}

const INK: [u8; 3] = [0x22, 0x26, 0x2e];
const PAPER: Paint = paint([0xff, 0xff, 0xff], 1.0);
/// Filling of a bare outline.
const SOLID: Paint = paint([0, 0, 0], 1.0);
/// Filling behind knots and combs.
const WASH: Paint = paint(INK, 0.10);
const LINE: Paint = paint(INK, 1.0);
const RELAXED: Paint = paint([0xd1, 0x1f, 0x2f], 1.0);
const COMB: [u8; 3] = [0x1f, 0x6f, 0xb5];
const COMB_AREA: Paint = paint(COMB, 0.10);
const COMB_TEETH: Paint = paint(COMB, 0.55);
const COMB_OUTLINE: Paint = paint(COMB, 0.90);

// Lengths below are fractions of the picture's size: the longest side of any of its glyphs.
const LINE_WIDTH: f64 = 0.0028;
const COMB_TOOTH_WIDTH: f64 = 0.0010;
const COMB_OUTLINE_WIDTH: f64 = 0.0016;
const KNOT_RADIUS: f64 = 0.0095;
const KNOT_LINE_WIDTH: f64 = 0.0024;
const MARGIN: f64 = 0.04;

/// Knots and segments beyond this many go into a mark of their own: the time to fill a path grows
/// with the square of what it holds. Only where areas of two marks overlap can it be seen.
const MOST_AT_ONCE: usize = 256;

impl Picture {
    /// The picture of these glyphs, in rows from left to right; glyphs without contours are left
    /// out.
    pub fn new(glyphs: &[SolvedGlyph], show: Show) -> Self {
        let drawn: Vec<&SolvedGlyph> = glyphs.iter().filter(|g| !g.contours.is_empty()).collect();
        let size = size(&drawn);
        let scale = show.comb.then(|| CombScale::new(&drawn, size));
        let mut cells: Vec<Cell> = drawn
            .iter()
            .map(|glyph| Cell {
                name: glyph.name.clone(),
                layer: glyph.layer.clone(),
                offset: Vec2::ZERO,
                marks: marks(glyph, show, scale.as_ref(), size),
            })
            .collect();
        let bounds = layout::arrange(&mut cells, size).inflate(MARGIN * size, MARGIN * size);
        let view = View {
            origin: bounds.origin(),
            width: bounds.width().max(MARGIN * size),
            height: bounds.height().max(MARGIN * size),
        };
        Picture { view, ground: show.any(), decimals: decimals(size), cells }
    }

    /// Width over height.
    pub fn aspect(&self) -> f64 {
        self.view.width / self.view.height
    }
}

impl Cell {
    /// What the marks cover, line widths included, in the glyph's own coordinates.
    fn bounds(&self) -> Option<Rect> {
        self.marks.iter().map(Mark::bounds).reduce(|a, b| a.union(b))
    }
}

impl Mark {
    fn bounds(&self) -> Rect {
        let half = self.stroke.map_or(0.0, |stroke| stroke.width / 2.0);
        self.path.bounding_box().inflate(half, half)
    }
}

/// Five significant digits of the size are a hundredth of a hair's breadth.
fn decimals(size: f64) -> usize {
    (5.0 - size.log10().floor()).clamp(0.0, 100.0) as usize
}

/// The longest side of any glyph, by which everything else is measured; never zero.
fn size(glyphs: &[&SolvedGlyph]) -> f64 {
    let boxes = || glyphs.iter().filter_map(|glyph| glyph.bounding_box());
    let longest = boxes().fold(0.0, |size: f64, b| size.max(b.width()).max(b.height()));
    if longest > 0.0 {
        return longest;
    }
    // Nothing but points: as large as their coordinates can show.
    boxes().fold(1.0, |size: f64, b| size.max(1e-6 * b.x0.abs()).max(1e-6 * b.y0.abs()))
}

/// What is drawn of one glyph, back to front.
fn marks(glyph: &SolvedGlyph, show: Show, scale: Option<&CombScale>, size: f64) -> Vec<Mark> {
    let mut marks = vec![filling(glyph, show)];
    if let Some(scale) = scale {
        marks.extend(comb::marks(glyph, scale, size));
    }
    marks.extend(lines(glyph, show, size));
    if show.knots {
        marks.extend(symbols::marks(glyph, size));
    }
    marks.retain(|mark| !mark.path.is_empty());
    for mark in &mut marks {
        mark.path.apply_affine(Affine::FLIP_Y);
    }
    marks
}

fn filling(glyph: &SolvedGlyph, show: Show) -> Mark {
    let closed = glyph.contours.iter().filter(|c| c.solution.curve.is_closed());
    Mark {
        class: "outline",
        path: joined(closed),
        fill: Some(if show.any() { WASH } else { SOLID }),
        stroke: None,
        exact: true,
    }
}

/// The curves as lines: all where something else is shown, or else those that no filling shows or
/// that call for attention.
fn lines(glyph: &SolvedGlyph, show: Show, size: f64) -> [Mark; 2] {
    let relaxed = |c: &&SolvedContour| c.solution.report.status() == Status::Relaxed;
    let line = |class, path, paint, dashed| Mark {
        class,
        path,
        fill: None,
        stroke: Some(Stroke { paint, width: LINE_WIDTH * size, dashed }),
        exact: true,
    };
    let bare = |c: &&SolvedContour| show.any() || !c.solution.curve.is_closed();
    let solved = joined(glyph.contours.iter().filter(|c| !relaxed(c) && bare(c)));
    let relaxed = joined(glyph.contours.iter().filter(relaxed));
    [line("line", solved, LINE, false), line("relaxed", relaxed, RELAXED, true)]
}

fn joined<'a>(contours: impl Iterator<Item = &'a SolvedContour>) -> BezPath {
    contours.flat_map(|contour| contour.path.elements().iter().copied()).collect()
}
