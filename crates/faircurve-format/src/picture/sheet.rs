//! Several splines on the same knots: one sheet, a panel for each, with their numbers.

use faircurve::kurbo::{Affine, BezPath, Rect, Vec2};

use super::comb::CombScale;
use super::{
    Cell, INK, Mark, Paint, Picture, RELAXED, Show, Stroke, View, lettering, marks, paint, size,
};
use crate::solved::SolvedGlyph;

/// One panel of a [sheet](Picture::sheet).
#[derive(Clone, Debug, Default)]
pub struct Panel {
    /// What stands above: the spline.
    pub title: String,
    /// What calls for attention, below the title; empty for nothing.
    pub warning: String,
    /// The curves. Panels of a sheet have the same glyphs.
    pub glyphs: Vec<SolvedGlyph>,
    /// Name and value of each number below.
    pub numbers: Vec<(String, String)>,
}

// Fractions of the size of the drawing, as everywhere in pictures.
const TITLE: f64 = 0.040;
const TEXT: f64 = 0.030;
/// From one base line to the next.
const LINE: f64 = 0.056;
/// Between panels.
const GUTTER: f64 = 0.13;
/// Between the glyphs of a panel.
const GAP: f64 = 0.12;
const MARGIN: f64 = 0.06;
/// Width over height that the sheet aims at.
const PAGE: f64 = 1.5;
/// The hair line between curves and numbers.
const RULE_WIDTH: f64 = 0.0016;

const TITLE_INK: Paint = paint(INK, 1.0);
const NAME_INK: Paint = paint(INK, 0.62);
const RULE: Paint = paint(INK, 0.25);

impl Picture {
    /// One sheet of all panels, in rows: the curves stand in the same places of every panel, with their
    /// knots and combs to one scale, and the numbers under them in columns.
    pub fn sheet(panels: &[Panel]) -> Picture {
        let drawn: Vec<&SolvedGlyph> = panels.iter().flat_map(|panel| &panel.glyphs).collect();
        let size = size(&drawn);
        let scale = CombScale::new(&drawn, size);
        let show = Show { knots: true, comb: true };
        let glyphs = panels.iter().map(|panel| panel.glyphs.len()).max().unwrap_or(0);
        let drawings: Vec<Vec<Vec<Mark>>> = panels
            .iter()
            .map(|p| p.glyphs.iter().map(|g| marks(g, show, Some(&scale), size)).collect())
            .collect();
        // Where each glyph's marks lie in any panel, and where they go.
        let boxes: Vec<Rect> = (0..glyphs)
            .map(|glyph| {
                let there = drawings.iter().filter_map(|panel| panel.get(glyph));
                let boxes = there.flatten().map(Mark::bounds);
                boxes.reduce(|a, b| a.union(b)).unwrap_or(Rect::ZERO)
            })
            .collect();
        let width = boxes.iter().map(|b| b.width() + GAP * size).sum::<f64>() - GAP * size;
        let top = boxes.iter().map(|b| b.y0).fold(f64::INFINITY, f64::min);
        let bottom = boxes.iter().map(|b| b.y1).fold(f64::NEG_INFINITY, f64::max);
        let curves =
            Rect::new(0.0, 0.0, width.max(0.0), if bottom > top { bottom - top } else { 0.0 });

        let panel = PanelLayout::new(panels, curves, size);
        let columns = panel.columns(panels.len(), size);
        let rows = panels.len().div_ceil(columns).max(1);
        let step = Vec2::new(panel.width + GUTTER * size, panel.height + GUTTER * size);
        let mut cells = Vec::new();
        for (index, (shown, drawing)) in panels.iter().zip(drawings).enumerate() {
            let place =
                Vec2::new(step.x * (index % columns) as f64, step.y * (index / columns) as f64);
            let mut left = (panel.width - curves.width()) / 2.0;
            for (glyph, marks) in drawing.into_iter().enumerate() {
                let to = Vec2::new(left - boxes[glyph].x0, panel.curves_top - top);
                left += boxes[glyph].width() + GAP * size;
                let (name, layer) = (&shown.glyphs[glyph].name, &shown.glyphs[glyph].layer);
                cells.push(Cell {
                    name: name.clone(),
                    layer: layer.clone(),
                    offset: place + to,
                    marks,
                });
            }
            let marks = panel.words(shown, size);
            cells.push(Cell {
                name: shown.title.clone(),
                layer: String::new(),
                offset: place,
                marks,
            });
        }
        let sheet = Rect::new(
            0.0,
            0.0,
            step.x * columns as f64 - GUTTER * size,
            step.y * rows as f64 - GUTTER * size,
        );
        let sheet = sheet.inflate(MARGIN * size, MARGIN * size);
        Picture {
            view: View {
                origin: sheet.origin(),
                width: sheet.width().max(MARGIN * size),
                height: sheet.height().max(MARGIN * size),
            },
            ground: true,
            decimals: super::decimals(size),
            cells,
        }
    }
}

/// Where things are in a panel, y down from its top left corner.
struct PanelLayout {
    width: f64,
    height: f64,
    curves_top: f64,
    curves_bottom: f64,
    /// The columns of names and values start and end here.
    names: f64,
    values: f64,
}

impl PanelLayout {
    fn new(panels: &[Panel], curves: Rect, size: f64) -> Self {
        let widest = |of: &dyn Fn(&Panel) -> f64| panels.iter().map(of).fold(0.0, f64::max);
        let text = |words: &str| lettering::width(words, TEXT * size);
        let names = |p: &Panel| p.numbers.iter().map(|(name, _)| text(name)).fold(0.0, f64::max);
        let values = |p: &Panel| p.numbers.iter().map(|(_, value)| text(value)).fold(0.0, f64::max);
        let numbers = widest(&names) + 1.5 * LINE * size + widest(&values);
        let titles = widest(&|p| lettering::width(&p.title, TITLE * size));
        let warnings = widest(&|p| text(&p.warning));
        let width = curves.width().max(numbers).max(titles).max(warnings);
        let warned = panels.iter().any(|panel| !panel.warning.is_empty());
        let head = if warned { 2.6 } else { 1.6 } * LINE * size;
        let lines = panels.iter().map(|panel| panel.numbers.len()).max().unwrap_or(0);
        let curves_bottom = head + curves.height();
        PanelLayout {
            width,
            height: curves_bottom + (lines as f64 + 0.8) * LINE * size,
            curves_top: head,
            curves_bottom,
            names: (width - numbers) / 2.0,
            values: (width + numbers) / 2.0,
        }
    }

    /// How many panels a row has, for a sheet of about [`PAGE`] without gaps where that can be.
    fn columns(&self, panels: usize, size: f64) -> usize {
        let badness = |columns: &usize| {
            let rows = panels.div_ceil(*columns);
            let (width, height) = (self.width + GUTTER * size, self.height + GUTTER * size);
            let aspect = width * *columns as f64 / (height * rows as f64);
            let empty = (rows * columns - panels) as f64 / panels as f64;
            (aspect / PAGE).ln().abs() + empty
        };
        (1..=panels).min_by(|a, b| badness(a).total_cmp(&badness(b))).unwrap_or(1)
    }

    fn words(&self, panel: &Panel, size: f64) -> Vec<Mark> {
        let (mut names, mut values) = (BezPath::new(), BezPath::new());
        for (line, (name, value)) in panel.numbers.iter().enumerate() {
            let y = self.curves_bottom + (line as f64 + 1.5) * LINE * size;
            let right = self.values - lettering::width(value, TEXT * size);
            names.extend(line_of(name, TEXT * size, self.names, y));
            values.extend(line_of(value, TEXT * size, right, y));
        }
        let middle = |words: &str, text: f64| (self.width - lettering::width(words, text)) / 2.0;
        let title =
            line_of(&panel.title, TITLE * size, middle(&panel.title, TITLE * size), LINE * size);
        let left = middle(&panel.warning, TEXT * size);
        let warning = line_of(&panel.warning, TEXT * size, left, 1.9 * LINE * size);
        let rule_y = self.curves_bottom + 0.45 * LINE * size;
        let mut rule = BezPath::new();
        if !panel.numbers.is_empty() {
            rule.move_to((self.names, rule_y));
            rule.line_to((self.values, rule_y));
        }
        let mut marks = vec![
            written("title", title, TITLE_INK, TITLE * size),
            written("warning", warning, RELAXED, TEXT * size),
            written("names", names, NAME_INK, TEXT * size),
            written("values", values, TITLE_INK, TEXT * size),
            Mark::line("rule", rule, RULE, RULE_WIDTH * size),
        ];
        marks.retain(|mark| !mark.path.is_empty());
        marks
    }
}

/// A line of text with its base line at (x, y), y down.
pub(super) fn line_of(words: &str, text: f64, x: f64, y: f64) -> BezPath {
    Affine::translate((x, y)) * Affine::FLIP_Y * lettering::text(words, text)
}

/// The mark of text whose capitals are `text` high.
pub(super) fn written(class: &'static str, path: BezPath, ink: Paint, text: f64) -> Mark {
    Mark::line(class, path, ink, lettering::weight() * text)
}

impl Mark {
    /// A plain line.
    pub(super) fn line(class: &'static str, path: BezPath, paint: Paint, width: f64) -> Mark {
        let stroke = Some(Stroke { paint, width, dashed: false });
        Mark { class, path, fill: None, stroke, exact: false }
    }
}

#[cfg(test)]
mod tests {
    use faircurve::{Contour, catalog, solve};

    use super::*;

    fn panel(title: &str) -> Panel {
        let contour = Contour::closed([(0.0, 0.0), (300.0, -40.0), (250.0, 200.0), (20.0, 160.0)]);
        let solution = solve(&contour, &*catalog::spline("euler").unwrap()).unwrap();
        let glyph = SolvedGlyph::new("a", "", [("euler".to_owned(), solution)], None);
        let numbers = vec![("length".to_owned(), "12.5".to_owned()); 5];
        Panel { title: title.to_owned(), glyphs: vec![glyph], numbers, ..Panel::default() }
    }

    #[test]
    fn panels_are_alike_and_do_not_overlap() {
        let panels: Vec<Panel> =
            ["euler", "a name that is much longer than the others", "x"].map(panel).into();
        let picture = Picture::sheet(&panels);
        assert_eq!(picture.cells.len(), 6);
        let boxes: Vec<Rect> = picture
            .cells
            .chunks(2)
            .map(|pair| {
                let boxes = pair.iter().map(|cell| cell.bounds().unwrap() + cell.offset);
                boxes.reduce(|a, b| a.union(b)).unwrap()
            })
            .collect();
        for (i, a) in boxes.iter().enumerate() {
            for b in &boxes[..i] {
                assert_eq!(a.intersect(*b).area(), 0.0);
            }
        }
        let offset = |i: usize| picture.cells[2 * i].offset - picture.cells[2 * i + 1].offset;
        assert!((offset(0) - offset(1)).hypot() < 1e-9 && (offset(0) - offset(2)).hypot() < 1e-9);
        let view =
            Rect::from_origin_size(picture.view.origin, (picture.view.width, picture.view.height));
        assert!(boxes.iter().all(|b| view.union(*b) == view));
    }

    #[test]
    fn an_empty_sheet_is_a_picture_too() {
        assert!(Picture::sheet(&[]).aspect() > 0.0);
        assert!(Picture::sheet(&[Panel::default()]).aspect().is_finite());
    }
}
