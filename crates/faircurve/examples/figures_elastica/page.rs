//! A page to draw on, and plots on it.

use std::fmt::Write as _;

use faircurve::kurbo::{Point, Vec2};

pub(crate) const INK: &str = "#222";
pub(crate) const BLUE: &str = "#2b62c9";
pub(crate) const RED: &str = "#c33";
pub(crate) const GREY: &str = "#bbb";

pub(crate) struct Page {
    text: String,
    width: f64,
    height: f64,
}

impl Page {
    pub(crate) fn new(width: f64, height: f64) -> Self {
        Page { text: String::new(), width, height }
    }

    /// A line through points; `style` is a colour, with what else is to be said of the stroke.
    pub(crate) fn line(
        &mut self,
        points: impl IntoIterator<Item = Point>,
        style: &str,
        width: f64,
    ) {
        let mut d = String::new();
        for p in points {
            let _ = write!(d, "{}{:.1},{:.1}", if d.is_empty() { "M" } else { "L" }, p.x, p.y);
        }
        let _ = writeln!(
            self.text,
            "<path d=\"{d}\" fill=\"none\" stroke=\"{style}\" stroke-width=\"{width}\"/>"
        );
    }

    pub(crate) fn dashed(&mut self, points: impl IntoIterator<Item = Point>, colour: &str) {
        self.line(points, &format!("{colour}\" stroke-dasharray=\"4 3"), 1.0);
    }

    pub(crate) fn dot(&mut self, at: Point, radius: f64, colour: &str) {
        let _ = writeln!(
            self.text,
            "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"{radius}\" fill=\"{colour}\"/>",
            at.x, at.y
        );
    }

    pub(crate) fn circle(&mut self, at: Point, radius: f64, colour: &str) {
        let _ = writeln!(
            self.text,
            "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"{radius:.1}\" fill=\"none\" stroke=\"{colour}\"/>",
            at.x, at.y
        );
    }

    /// Words around a place: `anchor` is start, middle or end.
    pub(crate) fn words(&mut self, at: Point, anchor: &str, words: &str) {
        let _ = writeln!(
            self.text,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\" fill=\"{INK}\">{words}</text>",
            at.x, at.y
        );
    }

    pub(crate) fn finish(self) -> String {
        let Page { text, width, height } = self;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{text}</svg>\n"
        )
    }
}

/// The axes of a plot.
#[derive(Clone, Copy)]
pub(crate) struct Axes {
    /// The corner of the frame, and its size.
    pub(crate) corner: Point,
    pub(crate) size: Vec2,
    /// What lies at the frame's edges.
    pub(crate) x: [f64; 2],
    pub(crate) y: [f64; 2],
}

impl Axes {
    pub(crate) fn at(&self, x: f64, y: f64) -> Point {
        let along = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
        let (u, v) = (along(x, self.x), along(y, self.y));
        self.corner + Vec2::new(u * self.size.x, (1.0 - v) * self.size.y)
    }

    /// Grid lines with their numbers.
    pub(crate) fn draw(&self, page: &mut Page, x: &[f64], y: &[f64]) {
        for x in x {
            let [low, high] = self.y.map(|y| self.at(*x, y));
            page.line([low, high], "#ddd", 1.0);
            page.words(low + Vec2::new(0.0, 16.0), "middle", &x.to_string());
        }
        for y in y {
            let [low, high] = self.x.map(|x| self.at(x, *y));
            page.line([low, high], "#ddd", 1.0);
            page.words(low + Vec2::new(-6.0, 4.0), "end", &y.to_string());
        }
    }
}

/// So many places from one to another, both included.
pub(crate) fn steps(from: f64, to: f64, count: usize) -> impl Iterator<Item = f64> {
    (0..=count).map(move |i| from + (to - from) * i as f64 / count as f64)
}
