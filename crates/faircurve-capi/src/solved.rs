//! A document solved: what a `fc_solution` holds. No pointer comes in here.

use std::ffi::{CStr, CString};

use faircurve::convert::{Options, convert};
use faircurve::kurbo::{PathEl, Point};
use faircurve::{Curve, CurvePoint, Effort, Place, Relaxation, catalog, solve_with};
use faircurve_format::{Document, Glyph, SolvedContour, SolvedGlyph, solution_json};

use crate::failure::Failure;
use crate::{fc_element, fc_element_kind, fc_options, fc_status};

/// A document solved.
#[derive(Debug)]
pub(crate) struct Solved {
    glyphs: Vec<SolvedGlyph>,
    /// The contours of all glyphs, in order.
    contours: Vec<ContourPlace>,
}

/// Where a contour is among the glyphs, and its words for C.
#[derive(Debug)]
struct ContourPlace {
    glyph: usize,
    contour: usize,
    glyph_name: CString,
    layer_name: CString,
    relaxed: Vec<Relaxed>,
}

/// Something that could not be met, in words for C.
#[derive(Debug)]
pub(crate) struct Relaxed {
    pub(crate) place: Place,
    pub(crate) asked: CString,
    pub(crate) got: CString,
    pub(crate) reason: CString,
}

impl From<&Relaxation> for Relaxed {
    fn from(relaxation: &Relaxation) -> Self {
        Relaxed {
            place: relaxation.place,
            asked: words(relaxation.asked),
            got: words(relaxation.got),
            reason: words(&relaxation.reason),
        }
    }
}

/// Words for C; a NUL, which would end them early, is replaced.
fn words(text: &str) -> CString {
    CString::new(text.replace('\0', "\u{fffd}")).unwrap_or_default()
}

impl Solved {
    /// Solves every contour, and makes Béziers of it. The first that is at fault fails the whole.
    pub(crate) fn new(document: &Document, options: &fc_options) -> Result<Self, Failure> {
        let options = Checked::new(options)?;
        let mut solved = Solved { glyphs: Vec::new(), contours: Vec::new() };
        for glyph in &document.glyphs {
            let solved_glyph = solve_glyph(document, glyph, &options)?;
            for (index, contour) in solved_glyph.contours.iter().enumerate() {
                solved.contours.push(ContourPlace {
                    glyph: solved.glyphs.len(),
                    contour: index,
                    glyph_name: words(&glyph.name),
                    layer_name: words(&glyph.layer),
                    relaxed: contour.solution.report.relaxed.iter().map(Relaxed::from).collect(),
                });
            }
            solved.glyphs.push(solved_glyph);
        }
        Ok(solved)
    }

    pub(crate) fn contour_count(&self) -> usize {
        self.contours.len()
    }

    fn place(&self, contour: usize) -> Result<&ContourPlace, fc_status> {
        self.contours.get(contour).ok_or(fc_status::FC_OUT_OF_RANGE)
    }

    fn contour(&self, contour: usize) -> Result<&SolvedContour, fc_status> {
        let place = self.place(contour)?;
        Ok(&self.glyphs[place.glyph].contours[place.contour])
    }

    /// The name of the contour's glyph, and of its layer.
    pub(crate) fn names(&self, contour: usize) -> Option<[&CStr; 2]> {
        let place = self.contours.get(contour)?;
        Some([&place.glyph_name, &place.layer_name])
    }

    pub(crate) fn curve(&self, contour: usize) -> Result<&Curve, fc_status> {
        Ok(&self.contour(contour)?.solution.curve)
    }

    /// The arc length at a knot. A closed curve of n knots has an n-th, its end.
    pub(crate) fn knot_position(&self, contour: usize, knot: usize) -> Result<f64, fc_status> {
        let segments = self.curve(contour)?.segments();
        let before = segments.get(..knot).ok_or(fc_status::FC_OUT_OF_RANGE)?;
        Ok(before.iter().map(|segment| segment.length()).sum())
    }

    pub(crate) fn at(&self, contour: usize, s: f64) -> Result<CurvePoint, fc_status> {
        if s.is_nan() {
            return Err(fc_status::FC_OUT_OF_RANGE);
        }
        self.curve(contour)?.at(s).ok_or(fc_status::FC_NO_CURVE)
    }

    /// The pieces of a contour.
    pub(crate) fn elements(
        &self,
        contour: usize,
    ) -> Result<impl ExactSizeIterator<Item = fc_element>, fc_status> {
        Ok(self.contour(contour)?.path.elements().iter().copied().map(element))
    }

    pub(crate) fn relaxed(&self, contour: usize) -> Result<&[Relaxed], fc_status> {
        Ok(&self.place(contour)?.relaxed)
    }

    /// The solution as JSON, with so many samples of each segment, or none.
    pub(crate) fn to_json(&self, samples: usize) -> CString {
        words(&solution_json::write(&self.glyphs, (samples > 0).then_some(samples)))
    }
}

/// Options that mean something.
struct Checked {
    /// `None`: by the size of the glyph.
    accuracy: Option<f64>,
    effort: Effort,
    /// All but the accuracy.
    beziers: Options,
}

impl Checked {
    fn new(options: &fc_options) -> Result<Self, Failure> {
        let fc_options { accuracy, effort, .. } = *options;
        if !(accuracy >= 0.0 && accuracy.is_finite()) {
            let hint = "give a number of units above 0, or 0 for a ten-thousandth of the glyph";
            return Err(Failure::option(&format!("accuracy can't be {accuracy}"), hint));
        }
        if !(effort >= 0.0) {
            let hint = "give a multiple of the default, which is 1";
            return Err(Failure::option(&format!("effort can't be {effort}"), hint));
        }
        let beziers = Options {
            span_knots: options.span_knots != 0,
            at_extrema: options.at_extrema != 0,
            at_inflections: options.at_inflections != 0,
            free_joints: options.free_joints != 0,
            ..Options::new(0.0)
        };
        let accuracy = (accuracy > 0.0).then_some(accuracy);
        let effort = Effort::times(effort);
        let effort = if options.no_loops != 0 { effort.avoiding_loops() } else { effort };
        Ok(Checked { accuracy, effort, beziers })
    }
}

fn solve_glyph(
    document: &Document,
    glyph: &Glyph,
    options: &Checked,
) -> Result<SolvedGlyph, Failure> {
    let mut solutions = Vec::with_capacity(glyph.contours.len());
    for (index, contour) in glyph.contours.iter().enumerate() {
        let choice = document.spline_of(contour);
        let spline = catalog::build(&choice.name, &choice.params)?;
        let solution = solve_with(&contour.contour, &*spline, options.effort)
            .map_err(|error| Failure::contour(&place_in(glyph, index), &error))?;
        solutions.push((choice.name.clone(), solution));
    }
    let mut solved = SolvedGlyph::unconverted(&glyph.name, &glyph.layer, solutions);
    let accuracy = options.accuracy.unwrap_or(solved.default_accuracy());
    let beziers = Options { accuracy, ..options.beziers.clone() };
    for contour in &mut solved.contours {
        contour.path = convert(&contour.solution.curve, &beziers).path;
    }
    Ok(solved)
}

/// Words that name a contour in messages.
fn place_in(glyph: &Glyph, contour: usize) -> String {
    let named = |what: &str, name: &str| match name {
        "" => String::new(),
        name => format!("{what} `{name}`, "),
    };
    format!("{}{}contour {contour}", named("glyph", &glyph.name), named("layer", &glyph.layer))
}

fn element(element: PathEl) -> fc_element {
    use fc_element_kind::*;
    let zero = Point::ZERO;
    let (kind, [p1, p2, end]) = match element {
        PathEl::MoveTo(end) => (FC_MOVE_TO, [zero, zero, end]),
        PathEl::LineTo(end) => (FC_LINE_TO, [zero, zero, end]),
        PathEl::QuadTo(p1, end) => (FC_QUAD_TO, [p1, zero, end]),
        PathEl::CurveTo(p1, p2, end) => (FC_CUBIC_TO, [p1, p2, end]),
        PathEl::ClosePath => (FC_CLOSE, [zero; 3]),
    };
    fc_element { kind, x1: p1.x, y1: p1.y, x2: p2.x, y2: p2.y, x: end.x, y: end.y }
}
