//! Glyphs side by side on common base lines, in rows where there are many.

use faircurve::kurbo::{Rect, Vec2};

use super::Cell;

/// Space between glyphs and between rows, as a fraction of the picture's size.
const GAP: f64 = 0.12;

/// One row may be this many times wider than high; what is longer is broken.
const WIDEST_ROW: f64 = 9.0;

/// Width over height that several rows aim at.
const PAGE: f64 = 1.5;

/// Places the cells and returns the box of all. A single cell keeps its own coordinates.
pub(super) fn arrange(cells: &mut [Cell], size: f64) -> Rect {
    let boxes: Vec<Rect> = cells.iter().map(|cell| cell.bounds().unwrap_or(Rect::ZERO)).collect();
    if let [only] = boxes.as_slice() {
        return *only;
    }
    let gap = GAP * size;
    let width = row_width(&boxes, gap);
    let mut placed: Vec<Rect> = Vec::with_capacity(boxes.len());
    let mut base = 0.0;
    while placed.len() < boxes.len() {
        let start = placed.len();
        let row = start..start + fitting(&boxes[start..], width, gap);
        let (top, bottom) = vertical_extent(&boxes[row.clone()]);
        if start > 0 {
            base -= top;
        }
        let mut left = 0.0;
        for index in row {
            cells[index].offset = Vec2::new(left - boxes[index].x0, base);
            placed.push(boxes[index] + cells[index].offset);
            left += boxes[index].width() + gap;
        }
        // Where the next row's top is.
        base += bottom + gap;
    }
    placed.into_iter().reduce(|a, b| a.union(b)).unwrap_or(Rect::ZERO)
}

/// How wide rows may be.
fn row_width(boxes: &[Rect], gap: f64) -> f64 {
    let total: f64 = boxes.iter().map(|b| b.width() + gap).sum();
    let (top, bottom) = vertical_extent(boxes);
    let height = bottom - top + gap;
    if total <= WIDEST_ROW * height {
        return total;
    }
    PAGE.sqrt() * total.sqrt() * height.sqrt()
}

/// How many of the boxes fit into a row; at least one.
fn fitting(boxes: &[Rect], width: f64, gap: f64) -> usize {
    let mut right = 0.0;
    let fits = |b: &&Rect| {
        right += b.width() + gap;
        right <= width * (1.0 + 1e-9)
    };
    boxes.iter().take_while(fits).count().max(1)
}

/// The highest top and the lowest bottom (y down).
fn vertical_extent(boxes: &[Rect]) -> (f64, f64) {
    boxes.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(top, bottom), b| {
        (top.min(b.y0), bottom.max(b.y1))
    })
}

#[cfg(test)]
mod tests {
    use faircurve::kurbo::Shape;

    use super::*;
    use crate::picture::{LINE, Mark};

    fn cell(bounds: Rect) -> Cell {
        let mark = Mark {
            class: "outline",
            path: bounds.to_path(0.1),
            fill: Some(LINE),
            stroke: None,
            exact: true,
        };
        Cell { name: String::new(), layer: String::new(), offset: Vec2::ZERO, marks: vec![mark] }
    }

    fn arranged(boxes: &[Rect]) -> Vec<Cell> {
        let mut cells: Vec<Cell> = boxes.iter().copied().map(cell).collect();
        let all = arrange(&mut cells, 10.0);
        for (cell, bounds) in cells.iter().zip(boxes) {
            assert_eq!(all.union(*bounds + cell.offset), all);
        }
        cells
    }

    #[test]
    fn a_few_share_a_row_and_its_base_line() {
        let cells = arranged(&[Rect::new(5.0, -7.0, 9.0, 0.0), Rect::new(-3.0, -5.0, 1.0, 2.0)]);
        assert!(cells.iter().all(|cell| cell.offset.y == 0.0));
        assert!(cells[1].offset.x - 3.0 > cells[0].offset.x + 9.0);
    }

    #[test]
    fn many_fill_a_page_without_overlap() {
        let boxes: Vec<Rect> = (0..100)
            .map(|i| Rect::from_origin_size((0.0, -8.0), (4.0 + f64::from(i % 7), 10.0)))
            .collect();
        let cells = arranged(&boxes);
        let placed: Vec<Rect> = cells.iter().zip(&boxes).map(|(c, b)| *b + c.offset).collect();
        for (i, a) in placed.iter().enumerate() {
            for b in &placed[..i] {
                assert!(a.intersect(*b).area() == 0.0);
            }
        }
        let page = placed.into_iter().reduce(|a, b| a.union(b)).unwrap();
        assert!((1.0..2.5).contains(&(page.width() / page.height())));
    }

    #[test]
    fn one_glyph_keeps_its_coordinates() {
        assert_eq!(arranged(&[Rect::new(70.0, 30.0, 90.0, 60.0)])[0].offset, Vec2::ZERO);
    }
}
