//! What every format writes: solved glyphs.

use faircurve::kurbo::{BezPath, Rect};
use faircurve::{Solution, convert};

/// One solved contour: the spline that solved it, the solution, and its Béziers.
#[derive(Clone, Debug)]
pub struct SolvedContour {
    /// The name of the spline in the catalogue.
    pub spline: String,
    /// The curve and its report.
    pub solution: Solution,
    /// The curve as cubic Béziers, y up.
    pub path: BezPath,
}

/// One layer of one glyph, solved.
#[derive(Clone, Debug, Default)]
pub struct SolvedGlyph {
    /// The glyph's name; empty for the unnamed glyph of a simple drawing.
    pub name: String,
    /// The layer's name; empty where the file has no layers.
    pub layer: String,
    /// The contours in drawing order.
    pub contours: Vec<SolvedContour>,
}

/// The deviation of Béziers that is allowed when none is asked for, as a fraction of the glyph's
/// larger side: a tenth of a unit on a glyph of 1000 units.
///
/// Ten times coarser begins to show in large prints; ten times finer costs about 1.5 times as many
/// Béziers.
pub const DEFAULT_ACCURACY: f64 = 1e-4;

impl SolvedGlyph {
    /// A glyph of solved contours, each with the name of its spline, as Béziers that deviate from
    /// the curves by at most `accuracy` user units; `None` is [`DEFAULT_ACCURACY`] times the larger
    /// side of the glyph.
    pub fn new(
        name: impl Into<String>,
        layer: impl Into<String>,
        contours: impl IntoIterator<Item = (String, Solution)>,
        accuracy: Option<f64>,
    ) -> Self {
        let mut glyph = SolvedGlyph::unconverted(name, layer, contours);
        let accuracy = accuracy.unwrap_or(glyph.default_accuracy());
        for contour in &mut glyph.contours {
            contour.path = convert::to_bezpath(&contour.solution.curve, accuracy);
        }
        glyph
    }

    /// The same with empty paths, for conversions of another kind.
    pub fn unconverted(
        name: impl Into<String>,
        layer: impl Into<String>,
        contours: impl IntoIterator<Item = (String, Solution)>,
    ) -> Self {
        let unconverted =
            |(spline, solution)| SolvedContour { spline, solution, path: BezPath::new() };
        let contours = contours.into_iter().map(unconverted).collect();
        SolvedGlyph { name: name.into(), layer: layer.into(), contours }
    }

    /// [`DEFAULT_ACCURACY`] in the units of the glyph.
    pub fn default_accuracy(&self) -> f64 {
        let side = self.bounding_box().map_or(0.0, |bounds| bounds.width().max(bounds.height()));
        DEFAULT_ACCURACY * side
    }

    /// The smallest box that holds every curve; `None` for a glyph without contours.
    pub fn bounding_box(&self) -> Option<Rect> {
        let boxes = self.contours.iter().filter_map(|c| c.solution.curve.bounding_box());
        boxes.reduce(|a, b| a.union(b))
    }
}
