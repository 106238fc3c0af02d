//! Plain SVG path data, y up.
//!
//! Every number is the shortest decimal that reads back as the same double, so that knots, corners
//! and straight lines are exactly where the document has them. Absolute commands `M L C Z` only.

use faircurve::kurbo::BezPath;

use crate::solved::SolvedGlyph;

/// The path data of one curve, on one line, without a newline.
///
/// ```
/// use faircurve::kurbo::BezPath;
/// let mut path = BezPath::new();
/// path.move_to((0.0, 0.1));
/// path.line_to((1e-7, 2.5));
/// assert_eq!(faircurve_format::path::path_data(&path), "M0,0.1 L0.0000001,2.5");
/// ```
pub fn path_data(path: &BezPath) -> String {
    path.to_svg()
}

/// The glyphs' outlines, one line for each glyph, contours separated by a space. A glyph without
/// contours is an empty line.
pub fn write(glyphs: &[SolvedGlyph]) -> String {
    let mut text = String::new();
    for glyph in glyphs {
        let contours: Vec<String> = glyph.contours.iter().map(|c| path_data(&c.path)).collect();
        text.push_str(&contours.join(" "));
        text.push('\n');
    }
    text
}
