//! PNG of a [`Picture`].

use std::fmt;

use faircurve::kurbo::{Affine, BezPath, PathEl, Point, Vec2};
use tiny_skia::{
    Color, FillRule, LineJoin, Paint as Brush, Path, PathBuilder, Pixmap, StrokeDash, Transform,
};

use crate::picture::{Mark, Paint, Picture, Stroke};

/// The widest and highest picture, in pixels.
pub const LARGEST_SIDE: u32 = 16_384;

/// The most pixels of a picture: at four bytes each, 400 MB of memory.
pub const MOST_PIXELS: u64 = 100_000_000;

/// The width at which a picture of this shape has about two million pixels.
pub fn default_width(picture: &Picture) -> u32 {
    const PIXELS: f64 = 2e6;
    (PIXELS * picture.aspect()).sqrt().round().clamp(1.0, f64::from(LARGEST_SIDE)) as u32
}

/// The picture can't be drawn at this size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PngError {
    /// The width asked for, in pixels.
    pub width: u32,
    /// The height that goes with it, in pixels.
    pub height: u64,
}

impl fmt::Display for PngError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a PNG of {} × {} pixels can't be drawn", self.width, self.height)
    }
}

impl std::error::Error for PngError {}

/// The picture as a PNG file on white, `width` pixels wide and as high as its aspect wants.
///
/// # Errors
/// [`PngError`] if a side is zero or beyond [`LARGEST_SIDE`], or there are more than
/// [`MOST_PIXELS`].
pub fn write(picture: &Picture, width: u32) -> Result<Vec<u8>, PngError> {
    let scale = f64::from(width) / picture.view.width;
    let height = (picture.view.height * scale).ceil().max(1.0) as u64;
    let error = PngError { width, height };
    if width > LARGEST_SIDE || u64::from(width) * height > MOST_PIXELS {
        return Err(error);
    }
    let height =
        u32::try_from(height).ok().filter(|height| *height <= LARGEST_SIDE).ok_or(error)?;
    let mut pixels = Pixmap::new(width, height).ok_or(error)?;
    pixels.fill(Color::WHITE);
    // In double precision up to here, so that pictures of any scale come out the same.
    let place = Affine::scale(scale) * Affine::translate(-picture.view.origin.to_vec2());
    for cell in &picture.cells {
        for mark in &cell.marks {
            draw(&mut pixels, mark, place, cell.offset, scale);
        }
    }
    pixels.encode_png().map_err(|_| error)
}

fn draw(pixels: &mut Pixmap, mark: &Mark, place: Affine, offset: Vec2, scale: f64) {
    let Some(path) = skia_path(&mark.path, place * Affine::translate(offset)) else {
        return;
    };
    let identity = Transform::identity();
    if let Some(fill) = mark.fill {
        pixels.fill_path(&path, &brush(fill), FillRule::Winding, identity, None);
    }
    if let Some(stroke) = mark.stroke {
        let pen = pen(stroke, scale);
        pixels.stroke_path(&path, &brush(stroke.paint), &pen, identity, None);
    }
}

fn brush(paint: Paint) -> Brush<'static> {
    let [r, g, b] = paint.rgb;
    let mut brush = Brush::default();
    brush.set_color_rgba8(r, g, b, (255.0 * paint.opacity).round() as u8);
    brush
}

fn pen(stroke: Stroke, scale: f64) -> tiny_skia::Stroke {
    let pixels = |length: f64| (length * scale) as f32;
    tiny_skia::Stroke {
        width: pixels(stroke.width),
        line_join: LineJoin::Round,
        dash: stroke.dashes().and_then(|d| StrokeDash::new(d.map(pixels).to_vec(), 0.0)),
        ..tiny_skia::Stroke::default()
    }
}

fn skia_path(path: &BezPath, place: Affine) -> Option<Path> {
    let at = |p: Point| {
        let p = place * p;
        tiny_skia::Point::from_xy(p.x as f32, p.y as f32)
    };
    let mut builder = PathBuilder::new();
    for element in path.elements() {
        match *element {
            PathEl::MoveTo(p) => builder.move_to(at(p).x, at(p).y),
            PathEl::LineTo(p) => builder.line_to(at(p).x, at(p).y),
            PathEl::QuadTo(a, p) => builder.quad_to(at(a).x, at(a).y, at(p).x, at(p).y),
            PathEl::CurveTo(a, b, p) => {
                builder.cubic_to(at(a).x, at(a).y, at(b).x, at(b).y, at(p).x, at(p).y);
            }
            PathEl::ClosePath => builder.close(),
        }
    }
    builder.finish()
}
