//! What every format reads into and writes from: glyphs of contours, and the splines to solve them
//! with. Plain data; the formats do the reading and writing.

use faircurve::Contour;
use faircurve::catalog::Params;

/// A drawing: glyphs, and the spline for every contour that doesn't name its own.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Document {
    /// The spline of contours that name none. A file that names none means `spiro`.
    pub spline: SplineChoice,
    /// The glyphs in the file's order; one for each layer of a glyph that has contours there.
    pub glyphs: Vec<Glyph>,
}

/// The contours of one layer of one glyph.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Glyph {
    /// The glyph's name; empty for the unnamed glyph of a simple drawing.
    pub name: String,
    /// The layer's name, such as `Fore`; empty where the file has no layers.
    pub layer: String,
    /// The contours, in drawing order.
    pub contours: Vec<DocumentContour>,
}

/// A contour, and the spline to solve it with if it has its own.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct DocumentContour {
    /// Knots and how they join; units are the file's own, y up.
    pub contour: Contour,
    /// The contour's own spline; `None` is the document's. See [`Document::spline_of`].
    pub spline: Option<SplineChoice>,
}

/// A spline by its name in the [catalogue](faircurve::catalog), with its parameters.
///
/// Documents that this crate reads hold only choices that [`faircurve::catalog::build`] accepts.
#[derive(Clone, Debug, PartialEq)]
pub struct SplineChoice {
    /// The name in the catalogue.
    pub name: String,
    /// The parameters that are set; the others have their defaults.
    pub params: Params,
}

impl Default for SplineChoice {
    /// `spiro` with every default.
    fn default() -> Self {
        SplineChoice::new("spiro")
    }
}

impl SplineChoice {
    /// That spline with every default.
    pub fn new(name: impl Into<String>) -> Self {
        SplineChoice { name: name.into(), params: Params::new() }
    }
}

impl Document {
    /// A document of one unnamed glyph, solved with `spiro`.
    pub fn unnamed(contours: impl IntoIterator<Item = Contour>) -> Self {
        let contours = contours.into_iter().map(DocumentContour::from).collect();
        Document {
            spline: SplineChoice::default(),
            glyphs: vec![Glyph { contours, ..Glyph::default() }],
        }
    }

    /// The spline to solve `contour` with: its own, or else the document's.
    pub fn spline_of<'a>(&'a self, contour: &'a DocumentContour) -> &'a SplineChoice {
        contour.spline.as_ref().unwrap_or(&self.spline)
    }
}

impl From<Contour> for DocumentContour {
    /// A contour that is solved with the document's spline.
    fn from(contour: Contour) -> Self {
        DocumentContour { contour, spline: None }
    }
}
