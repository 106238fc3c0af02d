//! Béziers of whole fonts: the conversion against libspiro's own and kurbo's, on libspiro's curves.

use std::collections::BTreeMap;
use std::time::Instant;

use faircurve::Curve;
use faircurve::convert::{Options, convert};
use faircurve::kurbo::{BezPath, fit_to_bezpath, fit_to_bezpath_opt};
use serde_json::json;

use crate::Failure;
use crate::bezier::{cubics, true_error};
use crate::fonts_input::FontContour;
use crate::report::{Report, table};
use crate::rivals::{LibspiroInput, Theirs};

/// Font units.
const ACCURACIES: [f64; 3] = [0.5, 0.1, 0.01];

/// Places of each Bézier at which true errors are measured.
const POINTS: usize = 32;

#[derive(Default)]
struct Tally {
    cubics: usize,
    /// The largest error, measured.
    error: f64,
    /// Contours with an error beyond twice the accuracy.
    astray: usize,
    bound: Option<f64>,
    seconds: f64,
}

impl Tally {
    /// `accuracy`: what was asked for.
    fn add(
        &mut self,
        curve: &Curve,
        path: &BezPath,
        accuracy: f64,
        bound: Option<f64>,
        seconds: f64,
    ) {
        let error = true_error(curve, path, POINTS);
        self.cubics += cubics(path);
        self.error = self.error.max(error);
        self.astray += usize::from(error > 2.0 * accuracy);
        if let Some(bound) = bound {
            self.bound = Some(self.bound.unwrap_or(0.0).max(bound));
        }
        self.seconds += seconds;
    }
}

/// kurbo's fitters take a closed smooth curve for one without a chord, and fail: each half by itself.
fn by_halves(curve: &Curve, fit: impl Fn(&Curve) -> BezPath) -> BezPath {
    let (first, second) = curve.segments().split_at(curve.segments().len() / 2);
    let mut path = BezPath::new();
    for half in [first, second] {
        if !half.is_empty() {
            path.extend(fit(&Curve::new(half.to_vec(), false)));
        }
    }
    path
}

fn timed<T>(f: impl Fn() -> T) -> (T, f64) {
    // The faster of two.
    let run = || {
        let start = Instant::now();
        let result = f();
        (result, start.elapsed().as_secs_f64())
    };
    let (_, first) = run();
    let (result, second) = run();
    (result, first.min(second))
}

/// Every contour that libspiro truly solves, on the curve that it found: segments of the curve, its own Béziers, ours and kurbo's.
///
/// # Errors
/// None now.
pub(crate) fn run(contours: &[FontContour], with_opt: bool) -> Result<Report, Failure> {
    let mut tallies: BTreeMap<(String, usize, &str), Tally> = BTreeMap::new();
    let mut alarms = Vec::new();
    let mut counted: BTreeMap<&str, usize> = BTreeMap::new();
    for FontContour { font, place, contour } in contours {
        let Some(input) = LibspiroInput::new(contour) else { continue };
        let Some((curve, theirs)) = input.curve_and_beziers(contour) else { continue };
        // What libspiro calls solved and isn't may wind anywhere.
        if !Theirs::solve(contour).is_truly_solved() || !theirs.is_finite() {
            continue;
        }
        *counted.entry(font).or_default() += 1;
        let mut add = |row: usize, who, path: &BezPath, bound, seconds| {
            let accuracy = if row == 0 { f64::INFINITY } else { ACCURACIES[row - 1] };
            let tally = tallies.entry((font.clone(), row, who)).or_default();
            tally.add(&curve, path, accuracy, bound, seconds);
        };
        add(0, "libspiro", &theirs, None, 0.0);
        for (row, accuracy) in ACCURACIES.into_iter().enumerate() {
            let options = Options::new(accuracy);
            let spanning = Options { span_knots: true, ..Options::new(accuracy) };
            for (who, options) in [("ours", options), ("ours, knots spanned", spanning)] {
                let (ours, seconds) = timed(|| convert(&curve, &options));
                add(row + 1, who, &ours.path, Some(ours.bound), seconds);
                let error = true_error(&curve, &ours.path, POINTS);
                if !(error <= ours.bound && ours.bound <= accuracy) {
                    alarms.push(format!(
                        "{font} {place} at {accuracy}: true error {error:e}, bound {:e}",
                        ours.bound
                    ));
                }
            }
            let (bisect, seconds) =
                timed(|| by_halves(&curve, |half| fit_to_bezpath(half, accuracy)));
            add(row + 1, "fit_to_bezpath", &bisect, None, seconds);
            if with_opt {
                let start = Instant::now();
                let opt = by_halves(&curve, |half| fit_to_bezpath_opt(half, accuracy));
                add(row + 1, "fit_to_bezpath_opt", &opt, None, start.elapsed().as_secs_f64());
            }
        }
    }
    let rows: Vec<[String; 9]> = tallies
        .iter()
        .map(|((font, row, who), tally)| {
            let accuracy =
                if *row == 0 { "–".to_owned() } else { ACCURACIES[row - 1].to_string() };
            [
                font.clone(),
                counted[font.as_str()].to_string(),
                accuracy,
                (*who).to_owned(),
                tally.cubics.to_string(),
                tally.bound.map_or("–".to_owned(), |bound| format!("{bound:.4}")),
                format!("{:.4}", tally.error),
                tally.astray.to_string(),
                if *row == 0 { "–".to_owned() } else { format!("{:.1}", tally.seconds * 1e3) },
            ]
        })
        .collect();
    let json = json!(rows);
    let header = [
        "font",
        "contours",
        "accuracy",
        "who",
        "cubics",
        "bound",
        "true error",
        "contours off by twice the accuracy",
        "milliseconds",
    ];
    Ok(Report { text: table(header, rows), json, notable: Vec::new(), alarms })
}
