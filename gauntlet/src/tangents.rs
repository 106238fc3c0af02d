//! Directions at the knots against those of libspiro.

use faircurve::frame::wrap_angle;
use faircurve_format::Document;
use serde::Serialize;
use serde_json::json;

use crate::fonts_input::FontContour;
use crate::report::{Report, describe, list, table, tiny};
use crate::rivals::{Ours, Theirs};
use crate::{Failure, spiro};

/// Directions further apart than this are listed, radians.
const DIFFERENT: f64 = 1e-6;

/// The knot of a contour at which the directions differ most.
#[derive(Debug, Serialize)]
struct Difference {
    contour: String,
    /// How many sides of knots differ.
    sides: usize,
    knot: usize,
    side: &'static str,
    ours: f64,
    libspiro: f64,
    difference: f64,
    our_residual: f64,
    libspiro_residual: f64,
    our_longest: f64,
    libspiro_longest: f64,
    status: &'static str,
}

/// Compares every knot of the contours that libspiro solves.
pub(crate) fn run(contours: &[FontContour]) -> Result<Report, Failure> {
    let spline = spiro()?;
    let (mut compared, mut sides, mut largest_same) = (0, 0, 0.0f64);
    let mut differences: Vec<Difference> = Vec::new();
    let (mut notable, mut alarms, mut descriptions) = (Vec::new(), Vec::new(), Vec::new());
    for FontContour { font, place, contour } in contours {
        let theirs = Theirs::solve(contour);
        let (Some(curve), true) = (&theirs.curve, theirs.returns_one) else {
            continue;
        };
        let Ok(ours) = Ours::solve(contour, &*spline) else {
            continue;
        };
        compared += 1;
        let mut worst: Option<Difference> = None;
        let mut differing = 0;
        for (knot, solved) in ours.solution.knots.iter().enumerate() {
            for (side, mine, other) in [
                ("in", solved.direction_in, curve.directions_in[knot]),
                ("out", solved.direction_out, curve.directions_out[knot]),
            ] {
                let (Some(mine), Some(other)) = (mine, other) else {
                    continue;
                };
                let difference = wrap_angle(mine - other).abs();
                // NaN from libspiro is a difference too.
                let difference = if difference.is_nan() { f64::INFINITY } else { difference };
                sides += 1;
                if difference <= DIFFERENT {
                    largest_same = largest_same.max(difference);
                    continue;
                }
                differing += 1;
                if worst.as_ref().is_none_or(|worst| difference > worst.difference) {
                    worst = Some(Difference {
                        contour: format!("{font} {place}"),
                        sides: 0,
                        knot,
                        side,
                        ours: mine,
                        libspiro: wrap_angle(other),
                        difference,
                        our_residual: ours.as_asked.value,
                        libspiro_residual: curve.residual.value,
                        our_longest: ours.longest,
                        libspiro_longest: curve.longest,
                        status: ours.solution.report.status().name(),
                    });
                }
            }
        }
        if let Some(mut worst) = worst {
            worst.sides = differing;
            if worst.our_residual >= worst.libspiro_residual {
                descriptions.push(format!("{}: {}", worst.contour, describe(contour)));
            }
            if let Some(falsehood) = ours.falsehood(contour) {
                alarms.push(format!("{}: {falsehood}", worst.contour));
            }
            notable.push((
                format!("tangents {}", worst.contour),
                Document::unnamed([contour.clone()]),
            ));
            differences.push(worst);
        }
    }
    differences.sort_by(|a, b| b.difference.total_cmp(&a.difference));
    let excused = differences.iter().filter(|d| d.our_residual < d.libspiro_residual).count();
    let summary = format!(
        "contours that libspiro solves: {compared}; sides of knots compared: {sides}\n\
         contours with a side more than {DIFFERENT:e} rad apart: {}; of these our residual is the \
         smaller in {excused}\n\
         largest difference among the others: {}\n\n",
        differences.len(),
        tiny(largest_same),
    );
    let text = [
        summary,
        if differences.is_empty() { String::new() } else { difference_table(&differences) },
        list("where our residual is not the smaller", &descriptions),
    ]
    .concat();
    let json = json!({
        "compared_contours": compared,
        "compared_sides": sides,
        "largest_difference_below_limit": largest_same,
        "differences": differences,
    });
    Ok(Report { text, json, notable, alarms })
}

fn difference_table(differences: &[Difference]) -> String {
    let rows = differences
        .iter()
        .map(|d| {
            [
                d.contour.clone(),
                d.sides.to_string(),
                format!("{} {}", d.knot, d.side),
                format!("{:.7}", d.ours),
                format!("{:.7}", d.libspiro),
                tiny(d.difference),
                tiny(d.our_residual),
                tiny(d.libspiro_residual),
                format!("{:.2}", d.our_longest),
                format!("{:.2}", d.libspiro_longest),
                d.status.to_owned(),
            ]
        })
        .collect();
    let header = [
        "contour",
        "sides",
        "worst at",
        "ours",
        "libspiro",
        "apart",
        "our residual",
        "libspiro's",
        "our longest/chord",
        "libspiro's",
        "status",
    ];
    table(header, rows)
}
