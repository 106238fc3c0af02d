//! The Solution: everything that solving found out, as JSON for other programs.
//!
//! ```json
//! { "faircurve": 1, "glyphs": [ { "name": "a", "layer": "Fore", "contours": [ {
//!    "spline": "spiro", "closed": true, "status": "solved", "relaxed": [], "adapted": [],
//!    "iterations": 5, "residual": 2e-13,
//!    "knots": [ {"x": 0, "y": 0, "join": "g4", "direction_in": 0.1, "direction_out": 0.1,
//!                "curvature_in": 0.01, "curvature_out": 0.01} ],
//!    "segments": [ {"length": 93.1, "kappa": [0.4, -0.1, 0.0, 0.0],
//!                   "samples": [[0.0, 0.0, 0.0, 0.1, 0.01]]} ],
//!    "length": 93.1, "bending_energy": 0.02, "variation_energy": 0.001, "path": "M0,0 C…Z" } ] } ] }
//! ```
//!
//! - Knots and segments keep the input's numbering; a zero chord is a segment of length 0.
//! - `name` and `layer` are empty where the input has none.
//! - Directions are radians; the side that an open end lacks is `null`.
//! - `relaxed` and `adapted` entries say where by `"knot"` or `"segment"`.
//! - `kappa` is k₀ … k₃ of thesis eq. 8.1 with the segment scaled to arc length 1, for polynomial
//!   spirals and lines; other segments lack it.
//! - `samples`, when asked for, are rows [s, x, y, θ, κ], equally spaced in the segment's own arc
//!   length s, both ends included.
//! - y is up. All numbers are finite, and read back as the same doubles.

use std::io::{self, Write};

use faircurve::{Adaptation, Place, Relaxation, Segment, SolvedKnot};
use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};

use crate::path::path_data;
use crate::solved::{SolvedContour, SolvedGlyph};

/// The Solution as text that ends with a newline; `samples` adds that many equal steps of arc
/// length to every segment (one row more than steps).
pub fn write(glyphs: &[SolvedGlyph], samples: Option<usize>) -> String {
    let file = File {
        faircurve: 1,
        glyphs: glyphs
            .iter()
            .map(|glyph| GlyphEntry {
                name: &glyph.name,
                layer: &glyph.layer,
                contours: glyph.contours.iter().map(|c| contour_entry(c, samples)).collect(),
            })
            .collect(),
    };
    let mut text = Vec::new();
    let mut serializer = Serializer::with_formatter(&mut text, RowFormatter::default());
    file.serialize(&mut serializer).expect("plain data into memory always serialises");
    text.push(b'\n');
    String::from_utf8(text).expect("JSON is UTF-8")
}

#[derive(Serialize)]
struct File<'a> {
    faircurve: u32,
    glyphs: Vec<GlyphEntry<'a>>,
}

#[derive(Serialize)]
struct GlyphEntry<'a> {
    name: &'a str,
    layer: &'a str,
    contours: Vec<ContourEntry<'a>>,
}

#[derive(Serialize)]
struct ContourEntry<'a> {
    spline: &'a str,
    closed: bool,
    status: &'static str,
    relaxed: Vec<RelaxedEntry<'a>>,
    adapted: Vec<AdaptedEntry>,
    iterations: usize,
    residual: f64,
    knots: Vec<KnotEntry>,
    segments: Vec<SegmentEntry>,
    length: f64,
    bending_energy: f64,
    variation_energy: f64,
    path: String,
}

#[derive(Serialize)]
#[serde(rename_all = "lowercase")]
enum PlaceEntry {
    Knot(usize),
    Segment(usize),
}

#[derive(Serialize)]
struct RelaxedEntry<'a> {
    #[serde(flatten)]
    place: PlaceEntry,
    asked: &'static str,
    got: &'static str,
    reason: &'a str,
}

#[derive(Serialize)]
struct AdaptedEntry {
    #[serde(flatten)]
    place: PlaceEntry,
    asked: &'static str,
    got: &'static str,
}

#[derive(Serialize)]
struct KnotEntry {
    x: f64,
    y: f64,
    join: &'static str,
    direction_in: Option<f64>,
    direction_out: Option<f64>,
    curvature_in: Option<f64>,
    curvature_out: Option<f64>,
}

#[derive(Serialize)]
struct SegmentEntry {
    length: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    kappa: Option<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<Vec<[f64; 5]>>,
}

fn contour_entry(contour: &SolvedContour, samples: Option<usize>) -> ContourEntry<'_> {
    let (curve, report) = (&contour.solution.curve, &contour.solution.report);
    ContourEntry {
        spline: &contour.spline,
        closed: curve.is_closed(),
        status: report.status().name(),
        relaxed: report.relaxed.iter().map(relaxed_entry).collect(),
        adapted: report.adapted.iter().map(adapted_entry).collect(),
        iterations: report.iterations,
        residual: report.residual,
        knots: contour.solution.knots.iter().map(knot_entry).collect(),
        segments: curve.segments().iter().map(|s| segment_entry(s, samples)).collect(),
        length: curve.length(),
        bending_energy: curve.bending_energy(),
        variation_energy: curve.variation_energy(),
        path: path_data(&contour.path),
    }
}

fn place_entry(place: Place) -> PlaceEntry {
    match place {
        Place::Knot(index) => PlaceEntry::Knot(index),
        Place::Segment(index) => PlaceEntry::Segment(index),
    }
}

fn relaxed_entry(relaxed: &Relaxation) -> RelaxedEntry<'_> {
    RelaxedEntry {
        place: place_entry(relaxed.place),
        asked: relaxed.asked,
        got: relaxed.got,
        reason: &relaxed.reason,
    }
}

fn adapted_entry(adapted: &Adaptation) -> AdaptedEntry {
    AdaptedEntry { place: place_entry(adapted.place), asked: adapted.asked, got: adapted.got }
}

fn knot_entry(knot: &SolvedKnot) -> KnotEntry {
    KnotEntry {
        x: knot.point.x,
        y: knot.point.y,
        join: knot.join.name(),
        direction_in: knot.direction_in,
        direction_out: knot.direction_out,
        curvature_in: knot.curvature_in,
        curvature_out: knot.curvature_out,
    }
}

fn segment_entry(segment: &Segment, samples: Option<usize>) -> SegmentEntry {
    let row = |s: f64| {
        let at = segment.at(s);
        [s, at.point.x, at.point.y, at.direction, at.curvature]
    };
    let rows = |steps: usize| {
        (0..=steps).map(|i| row(segment.length() * (i as f64 / steps.max(1) as f64))).collect()
    };
    SegmentEntry { length: segment.length(), kappa: segment.kappa(), samples: samples.map(rows) }
}

/// JSON that people can read and compare line by line: glyphs and contours are spread out; a knot,
/// a segment or anything else inside a contour's lists takes one line.
#[derive(Default)]
struct RowFormatter {
    depth: usize,
}

impl RowFormatter {
    /// Nesting deeper than this stays on its line: the file, its glyphs, a glyph, its contours, a
    /// contour and a contour's lists are spread out.
    const DEEPEST: usize = 6;

    fn separate<W: ?Sized + Write>(&self, writer: &mut W, first: bool) -> io::Result<()> {
        if !first {
            writer.write_all(b",")?;
        }
        if self.depth <= Self::DEEPEST {
            write!(writer, "\n{:1$}", "", self.depth)?;
        } else if !first {
            writer.write_all(b" ")?;
        }
        Ok(())
    }
}

impl Formatter for RowFormatter {
    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth += 1;
        writer.write_all(b"[")
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth -= 1;
        writer.write_all(b"]")
    }

    fn begin_array_value<W: ?Sized + Write>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        self.separate(writer, first)
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth += 1;
        writer.write_all(b"{")
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth -= 1;
        writer.write_all(b"}")
    }

    fn begin_object_key<W: ?Sized + Write>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        self.separate(writer, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}
