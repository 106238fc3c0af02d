//! Pictures of hard contours, with captions: thesis figure 2.7, one contour of each kind of hardness,
//! and the worst that the classes hold.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use faircurve::kurbo::{Affine, BezPath, PathEl, Point, Rect, Shape, Vec2};
use faircurve::{Contour, Place, convert};
use serde_json::json;

use crate::generate::{Class, classes};
use crate::progress::Progress;
use crate::report::Report;
use crate::rivals::Ours;
use crate::{Failure, search, spiro};

/// Columns of a picture.
const COLUMNS: usize = 4;

/// Side of the square that a curve is fitted into, in pixels.
const SIDE: f64 = 220.0;

/// Room around it.
const MARGIN: f64 = 24.0;

/// Room for a line of a caption.
const LINE: f64 = 15.0;

/// Lines of a caption at most.
const LINES: usize = 3;

/// The most panels of a kind among the worst.
const WORST: usize = 4;

/// One contour of each kind.
const KINDS: [(&str, &str); 12] = [
    ("near-coincident closed g4 8", "knots that nearly coincide"),
    ("collinear closed g4 10", "knots in line"),
    ("hairpin closed g4 7", "a hairpin"),
    ("half-turn open g4 6", "a turn of 180°"),
    ("spiral closed g4 160", "20 turns"),
    ("ratio-1e6 open g4 8", "chords in ratio 10⁶"),
    ("zigzag open g4 12", "a zigzag"),
    ("star closed g4 7", "a star"),
    ("ragged-star closed g4 14", "a ragged star"),
    ("crossing closed g4 16", "crossing itself"),
    ("round closed one-way 4", "one-way knots"),
    ("walk closed mixed 16", "all joins"),
];

/// A curve with its caption.
struct Panel {
    caption: Vec<String>,
    path: BezPath,
    knots: Vec<Point>,
    /// What is seen.
    bounds: Rect,
    /// Numbers of the knots at which something was relaxed.
    relaxed: BTreeSet<usize>,
}

impl Panel {
    fn new(contour: &Contour, ours: &Ours, caption: Vec<String>) -> Panel {
        let curve = &ours.solution.curve;
        let size = contour_box(contour).size().max_side();
        let places = ours.solution.report.relaxed.iter().flat_map(|relaxed| match relaxed.place {
            Place::Knot(knot) => vec![knot],
            Place::Segment(segment) => vec![segment, (segment + 1) % contour.knots.len()],
        });
        let path = convert::to_bezpath(curve, 1e-4 * size.max(f64::MIN_POSITIVE));
        Panel {
            caption,
            bounds: path.bounding_box().union(contour_box(contour)),
            path,
            knots: contour.knots.iter().map(|knot| knot.point).collect(),
            relaxed: places.collect(),
        }
    }
}

/// Draws all into a folder. The worst are those among `cases` contours of each class.
///
/// # Errors
/// If nothing can be written there.
pub(crate) fn run(folder: &Path, cases: usize) -> Result<Report, Failure> {
    let pictures = [
        ("figure-2-7.svg", figure_2_7()?),
        ("hard-cases.svg", kinds()?),
        ("worst.svg", worst(cases)?),
    ];
    let failure = |error: std::io::Error| Failure {
        message: format!("can't write to {}: {error}", folder.display()),
        hint: "name a folder that can be written to".to_owned(),
    };
    std::fs::create_dir_all(folder).map_err(failure)?;
    let mut text = String::new();
    for (name, panels) in &pictures {
        std::fs::write(folder.join(name), draw(panels)).map_err(failure)?;
        let _ = writeln!(text, "{name}");
        for panel in panels {
            let _ = writeln!(text, "  {}", panel.caption.join("; "));
        }
    }
    let json = json!({ "pictures": pictures.map(|(name, _)| name) });
    Ok(Report { text, json, notable: Vec::new(), alarms: Vec::new() })
}

/// Two curves through the same five points, both as asked and without loops; the first is ours.
fn figure_2_7() -> Result<Vec<Panel>, Failure> {
    let spline = spiro()?;
    let Some(class) = classes().into_iter().find(|class| class.name == "five open g2 5") else {
        return Ok(Vec::new());
    };
    for case in 0..200 {
        let contour = class.contour(case);
        let Ok(ours) = Ours::solve(&contour, &*spline) else { continue };
        let roots = search::roots(&contour, &*spline);
        let other = roots
            .iter()
            .find(|root| root.longest < 2.5 && (root.turning - ours.turning).abs() > 1e-3);
        if let (true, Some(other)) = (ours.is_solved() && ours.longest < 2.5, other) {
            let panel = |what: &str, curve: &Ours| {
                Panel::new(
                    &contour,
                    curve,
                    vec![what.to_owned(), format!("{} case {case}", class.name), measures(curve)],
                )
            };
            let mut panels = vec![panel("the curve", &ours), panel("another one", other)];
            let bounds = panels[0].bounds.union(panels[1].bounds);
            panels.iter_mut().for_each(|panel| panel.bounds = bounds);
            return Ok(panels);
        }
    }
    Ok(Vec::new())
}

fn kinds() -> Result<Vec<Panel>, Failure> {
    let spline = spiro()?;
    let mut panels = Vec::new();
    for (name, what) in KINDS {
        let Some(class) = classes().into_iter().find(|class| class.name == name) else { continue };
        let contour = class.contour(0);
        let Ok(ours) = Ours::solve(&contour, &*spline) else { continue };
        let how = format!("{name}: {}", outcome(&ours));
        panels.push(Panel::new(&contour, &ours, vec![what.to_owned(), how, measures(&ours)]));
    }
    Ok(panels)
}

/// Of each class only the worst counts: with the longest segment in chords, the most turning for its
/// knots, and the most places relaxed.
fn worst(cases: usize) -> Result<Vec<Panel>, Failure> {
    let spline = spiro()?;
    type Measure = fn(&Ours, usize) -> f64;
    let measures_of: [(&str, Measure); 3] = [
        ("the longest segment", |ours, _| if ours.is_solved() { ours.longest } else { 0.0 }),
        ("the most turning a knot", |ours, knots| {
            if ours.is_solved() { ours.turning / knots as f64 } else { 0.0 }
        }),
        ("the most relaxed", |ours, knots| {
            ours.solution.report.relaxed.len() as f64 / knots as f64
        }),
    ];
    let all: Vec<Class> = classes();
    let mut progress = Progress::new(all.len());
    let mut found: [Vec<(f64, String, Contour, Ours)>; 3] = Default::default();
    for class in &all {
        progress.step(&class.name);
        let solved: Vec<(usize, Contour, Ours)> = (0..cases)
            .filter_map(|case| {
                let contour = class.contour(case);
                let ours = Ours::solve(&contour, &*spline).ok()?;
                Some((case, contour, ours))
            })
            .collect();
        for ((_, measure), found) in measures_of.iter().zip(&mut found) {
            let of =
                |(_, contour, ours): &&(usize, Contour, Ours)| measure(ours, contour.knots.len());
            let worst = solved.iter().max_by(|a, b| of(a).total_cmp(&of(b)));
            if let Some(worst) = worst {
                let name = format!("{} case {}", class.name, worst.0);
                found.push((of(&worst), name, worst.1.clone(), worst.2.clone()));
            }
        }
    }
    progress.done();
    let mut panels = Vec::new();
    for ((what, _), mut found) in measures_of.into_iter().zip(found) {
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (_, name, contour, ours) in found.into_iter().take(WORST) {
            let how = format!("{name}: {}", outcome(&ours));
            panels.push(Panel::new(&contour, &ours, vec![what.to_owned(), how, measures(&ours)]));
        }
    }
    Ok(panels)
}

fn outcome(ours: &Ours) -> String {
    if ours.is_solved() {
        ours.solution.report.stage.name().to_owned()
    } else {
        format!("{} relaxed", ours.solution.report.relaxed.len())
    }
}

fn measures(ours: &Ours) -> String {
    format!("∫|κ| ds {:.1}, longest {:.1} chords", ours.turning, ours.longest)
}

fn contour_box(contour: &Contour) -> Rect {
    let points = contour.knots.iter().map(|knot| Rect::from_points(knot.point, knot.point));
    points.reduce(|a, b| a.union(b)).unwrap_or(Rect::ZERO)
}

/// The panels in rows, as an SVG file.
fn draw(panels: &[Panel]) -> String {
    const CELL: Vec2 = Vec2::new(SIDE + 2.0 * MARGIN, SIDE + 2.0 * MARGIN + LINES as f64 * LINE);
    let rows = panels.len().div_ceil(COLUMNS);
    let (width, height) = (CELL.x * COLUMNS.min(panels.len()) as f64, CELL.y * rows as f64);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"11\" text-anchor=\"middle\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    for (i, panel) in panels.iter().enumerate() {
        let corner = Vec2::new((i % COLUMNS) as f64 * CELL.x, (i / COLUMNS) as f64 * CELL.y);
        draw_panel(&mut svg, panel, corner + Vec2::new(MARGIN, MARGIN));
    }
    svg.push_str("</svg>\n");
    svg
}

fn draw_panel(svg: &mut String, panel: &Panel, corner: Vec2) {
    let bounds = panel.bounds;
    let scale = SIDE / bounds.size().max_side().max(f64::MIN_POSITIVE);
    let place = Affine::translate(corner + Vec2::new(SIDE, SIDE) / 2.0)
        * Affine::scale_non_uniform(scale, -scale)
        * Affine::translate(-bounds.center().to_vec2());
    let color = if panel.relaxed.is_empty() { "#22262e" } else { "#d11f2f" };
    let _ = writeln!(
        svg,
        "<path fill=\"none\" stroke=\"{color}\" stroke-width=\"1.2\" d=\"{}\"/>",
        data(&(place * &panel.path))
    );
    for (i, knot) in panel.knots.iter().enumerate() {
        let Point { x, y } = place * *knot;
        let fill = if panel.relaxed.contains(&i) { "#d11f2f" } else { "#1f6fb5" };
        let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.2\" fill=\"{fill}\"/>");
    }
    for (i, line) in panel.caption.iter().enumerate() {
        let (x, y) = (corner.x + SIDE / 2.0, corner.y + SIDE + MARGIN + i as f64 * LINE);
        let weight = if i == 0 { " font-weight=\"bold\"" } else { "" };
        let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\"{weight}>{line}</text>");
    }
}

/// Path data to a tenth of a pixel.
fn data(path: &BezPath) -> String {
    let mut data = String::new();
    let mut add = |letter: char, points: &[Point]| {
        data.push(letter);
        for (i, point) in points.iter().enumerate() {
            let space = if i > 0 { " " } else { "" };
            let _ = write!(data, "{space}{:.1} {:.1}", point.x, point.y);
        }
    };
    for element in path.elements() {
        match *element {
            PathEl::MoveTo(a) => add('M', &[a]),
            PathEl::LineTo(a) => add('L', &[a]),
            PathEl::QuadTo(a, b) => add('Q', &[a, b]),
            PathEl::CurveTo(a, b, c) => add('C', &[a, b, c]),
            PathEl::ClosePath => add('Z', &[]),
        }
    }
    data
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_a_class() {
        let names: BTreeSet<String> = classes().into_iter().map(|class| class.name).collect();
        assert!(KINDS.iter().all(|(name, _)| names.contains(*name)));
    }

    #[test]
    fn figure_2_7_has_two_curves() {
        let panels = figure_2_7().unwrap_or_else(|failure| panic!("{}", failure.message));
        assert_eq!(panels.len(), 2);
        assert_eq!(panels[0].knots, panels[1].knots);
        assert!(draw(&panels).contains("</svg>"));
    }
}
