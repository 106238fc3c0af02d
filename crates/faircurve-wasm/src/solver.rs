//! The solver modules: curves from knots, and what they answer.

use std::sync::Arc;

use faircurve::catalog::{self, CatalogError, ParamValue, Params, SplineInfo};
use faircurve::convert::{self, Cuts, Fit, Metric, Options};
use faircurve::kurbo::{BezPath, PathEl, Point, Vec2};
use faircurve::measure::fairness::{Fairness, Jump, jumps};
use faircurve::{
    Contour, Curve, CurvePoint, Effort, InputError, Join, Knot, LiveContour, Place, Segment,
    Solution, Spline, solve_with,
};
use js_sys::{Array, Error, Object, Reflect};
use wasm_bindgen::prelude::*;

/// Numbers a knot crosses as: x, y, join, `tangent_in`, `tangent_out`, `curvature_in`,
/// `curvature_out`, `tension_in`, `tension_out`, `curl`. NaN stands for what isn't given.
const KNOT: usize = 12;

/// The splines of this module: some, so that it is small, or all.
#[cfg(not(feature = "splines"))]
const SPLINES: &[&SplineInfo] = {
    use faircurve::families::{euler, hobby, spiro};
    &[&spiro::INFO, &euler::INFO, &hobby::INFO]
};
#[cfg(feature = "splines")]
const SPLINES: &[&SplineInfo] = catalog::ENTRIES;

type Result<T> = std::result::Result<T, JsValue>;

/// An error with its hint, as the package's `FaircurveError` has them.
fn error(message: &str, hint: &str) -> JsValue {
    let error = Error::new(message);
    set(&error, "hint", hint.into());
    error.into()
}

fn input_error(error_at: &InputError) -> JsValue {
    error(&error_at.to_string(), error_at.hint())
}

fn catalog_error(wrong: &CatalogError) -> JsValue {
    error(&wrong.to_string(), &wrong.hint())
}

fn set(object: &JsValue, key: &str, value: JsValue) {
    // Setting a property of a plain object of our own can't fail.
    let _ = Reflect::set(object, &key.into(), &value);
}

fn object<const N: usize>(entries: [(&str, JsValue); N]) -> JsValue {
    let object = Object::new();
    entries.into_iter().for_each(|(key, value)| set(&object, key, value));
    object.into()
}

fn list<T: Into<JsValue>>(items: impl IntoIterator<Item = T>) -> JsValue {
    items.into_iter().map(Into::into).collect::<Array>().into()
}

/// The names of the joins, in the order of their numbers.
#[wasm_bindgen]
pub fn joins() -> JsValue {
    list(Join::ALL.map(Join::name))
}

/// The names of the splines of this module.
#[wasm_bindgen]
pub fn splines() -> JsValue {
    list(SPLINES.iter().map(|info| info.name))
}

/// Words that name the candidates nearest to what was asked.
#[wasm_bindgen]
pub fn suggest(asked: &str, candidates: Vec<String>) -> String {
    catalog::suggest(asked, candidates.iter().map(String::as_str))
}

/// A spline of the catalogue, to be built.
#[wasm_bindgen]
#[derive(Default)]
pub struct Choice {
    params: Params,
}

#[wasm_bindgen]
impl Choice {
    /// With every default.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Choice {
        Choice::default()
    }

    /// Sets a parameter to a number.
    pub fn number(&mut self, name: &str, value: f64) {
        self.params.set(name, value);
    }

    /// Sets a parameter to a word or text.
    pub fn text(&mut self, name: &str, value: &str) {
        self.params.set(name, ParamValue::Text(value.to_owned()));
    }

    /// The spline of that name with these parameters.
    pub fn build(self, name: &str) -> Result<Built> {
        let spline = catalog::build_among(SPLINES, name, &self.params);
        let spline = spline.map_err(|e| catalog_error(&e))?;
        Ok(Built { spline: Arc::from(spline) })
    }
}

/// A spline of the catalogue, built.
#[wasm_bindgen]
pub struct Built {
    spline: Arc<dyn Spline>,
}

/// The canonical curve through the knots.
#[wasm_bindgen]
pub fn solve(
    built: &Built,
    knots: &[f64],
    closed: bool,
    effort: f64,
    no_loops: bool,
) -> Result<Solved> {
    let contour = Contour { knots: knots_of(knots), closed };
    let effort = Effort::times(effort);
    let effort = if no_loops { effort.avoiding_loops() } else { effort };
    let solution = solve_with(&contour, &*built.spline, effort);
    solution.map(Solved::new).map_err(|e| input_error(&e))
}

fn knots_of(rows: &[f64]) -> Vec<Knot> {
    rows.chunks_exact(KNOT).map(knot_of).collect()
}

fn knot_of(row: &[f64]) -> Knot {
    let number = |i: usize| row.get(i).copied().filter(|x| !x.is_nan());
    let vector = |i: usize| Some(Vec2::new(number(i)?, number(i + 1)?));
    let place = |i: usize| row.get(i).copied().unwrap_or(f64::NAN);
    Knot {
        point: Point::new(place(0), place(1)),
        join: number(2).and_then(|code| Join::ALL.get(code as usize).copied()),
        tangent_in: vector(3),
        tangent_out: vector(5),
        curvature_in: number(7),
        curvature_out: number(8),
        tension_in: number(9),
        tension_out: number(10),
        curl: number(11),
    }
}

/// A solved contour.
#[wasm_bindgen]
#[derive(Clone)]
pub struct Solved {
    solution: Arc<Solution>,
}

impl Solved {
    fn new(solution: Solution) -> Solved {
        Solved { solution: Arc::new(solution) }
    }

    fn curve(&self) -> &Curve {
        &self.solution.curve
    }

    /// Arc lengths on the whole curve, from those on each segment.
    fn along(&self, places: impl Fn(&Segment) -> Vec<f64>) -> Vec<f64> {
        let mut before = 0.0;
        let mut all = Vec::new();
        for segment in self.curve().segments() {
            all.extend(places(segment).into_iter().map(|s| before + s));
            before += segment.length();
        }
        all
    }
}

#[wasm_bindgen]
impl Solved {
    /// Whether nothing is relaxed.
    pub fn is_solved(&self) -> bool {
        self.solution.report.relaxed.is_empty()
    }

    /// What could not be met, as objects.
    pub fn relaxed(&self) -> JsValue {
        list(self.solution.report.relaxed.iter().map(|r| {
            let entry = object([
                ("asked", r.asked.into()),
                ("got", r.got.into()),
                ("reason", r.reason.as_str().into()),
            ]);
            set_place(&entry, r.place);
            entry
        }))
    }

    /// What the spline doesn't have, as objects.
    pub fn adapted(&self) -> JsValue {
        list(self.solution.report.adapted.iter().map(|a| {
            let entry = object([("asked", a.asked.into()), ("got", a.got.into())]);
            set_place(&entry, a.place);
            entry
        }))
    }

    /// Newton steps taken.
    pub fn iterations(&self) -> usize {
        self.solution.report.iterations
    }

    /// The largest violated equation.
    pub fn residual(&self) -> f64 {
        self.solution.report.residual
    }

    /// The stage that the curve comes from.
    pub fn stage(&self) -> String {
        self.solution.report.stage.name().to_owned()
    }

    /// Rows of x, y, join, directions and curvatures on both sides; NaN where there is no side.
    pub fn knots(&self) -> Vec<f64> {
        let or_nan = |x: Option<f64>| x.unwrap_or(f64::NAN);
        let row = |knot: &faircurve::SolvedKnot| {
            let join = Join::ALL.iter().position(|join| *join == knot.join).unwrap_or(0);
            [
                knot.point.x,
                knot.point.y,
                join as f64,
                or_nan(knot.direction_in),
                or_nan(knot.direction_out),
                or_nan(knot.curvature_in),
                or_nan(knot.curvature_out),
            ]
        };
        self.solution.knots.iter().flat_map(row).collect()
    }

    /// Rows of length and k₀ … k₃; NaN where the segment is no polynomial spiral.
    pub fn segments(&self) -> Vec<f64> {
        let row = |segment: &Segment| {
            let [k0, k1, k2, k3] = segment.kappa().unwrap_or([f64::NAN; 4]);
            [segment.length(), k0, k1, k2, k3]
        };
        self.curve().segments().iter().flat_map(row).collect()
    }

    /// Arc length.
    pub fn length(&self) -> f64 {
        self.curve().length()
    }

    /// Length, bending energy, variation energy, largest curvature, largest variation, turning,
    /// extrema, inflections, scale-free energy.
    pub fn measures(&self) -> Vec<f64> {
        let fairness = Fairness::of(self.curve());
        vec![
            fairness.length,
            fairness.bending_energy,
            fairness.variation_energy,
            fairness.largest_curvature,
            fairness.largest_variation,
            fairness.turning,
            fairness.extrema as f64,
            fairness.inflections as f64,
            fairness.scale_free_energy(),
        ]
    }

    /// A row a knot: the jumps of direction, κ, κ′, κ″ and the size; NaN where there is no jump.
    pub fn jumps(&self) -> Vec<f64> {
        let row = |jump: Option<Jump>| match jump {
            Some(j) => [j.direction, j.curvature, j.first_derivative, j.second_derivative, j.size],
            None => [f64::NAN; 5],
        };
        jumps(self.curve()).into_iter().flat_map(row).collect()
    }

    /// Rows of x, y, direction and curvature at these arc lengths.
    pub fn at(&self, places: &[f64]) -> Vec<f64> {
        let numbers = |at: CurvePoint| [at.point.x, at.point.y, at.direction, at.curvature];
        places.iter().filter_map(|s| self.curve().at(*s)).flat_map(numbers).collect()
    }

    /// Rows of arc length, x, y, direction and curvature, so many steps in every segment that has a
    /// length, both its ends included.
    pub fn comb(&self, steps: u32) -> Vec<f64> {
        let steps = steps.max(1);
        let mut rows = Vec::new();
        let mut before = 0.0;
        for segment in self.curve().segments().iter().filter(|s| s.length() > 0.0) {
            for i in 0..=steps {
                let s = segment.length() * (f64::from(i) / f64::from(steps));
                let at = segment.at(s);
                rows.extend([before + s, at.point.x, at.point.y, at.direction, at.curvature]);
            }
            before += segment.length();
        }
        rows
    }

    /// Arc lengths at which the curvature changes its sign within segments.
    pub fn inflections(&self) -> Vec<f64> {
        self.along(Segment::inflections)
    }

    /// Arc lengths at which curvature is largest or least within segments.
    pub fn curvature_extrema(&self) -> Vec<f64> {
        self.along(Segment::curvature_extrema)
    }

    /// Arc lengths at which the curve is horizontal or vertical.
    pub fn axis_extrema(&self) -> Vec<f64> {
        self.along(Segment::axis_extrema)
    }

    /// The segment, the arc length within it and the distance of the nearest point; empty for a
    /// curve without segments.
    pub fn nearest(&self, x: f64, y: f64, accuracy: f64) -> Vec<f64> {
        let nearest = self.curve().nearest(Point::new(x, y), accuracy);
        nearest.map_or_else(Vec::new, |(segment, s, distance)| vec![segment as f64, s, distance])
    }

    /// Smallest x and y, largest x and y; empty for a curve without a point.
    pub fn bounding_box(&self) -> Vec<f64> {
        let bounds = self.curve().bounding_box();
        bounds.map_or_else(Vec::new, |b| vec![b.x0, b.y0, b.x1, b.y1])
    }

    /// The curve as Béziers: see [`elements`].
    pub fn path(&self, accuracy: f64) -> Vec<f64> {
        elements(&convert::to_bezpath(self.curve(), accuracy))
    }

    /// The curve as Béziers as the options say: first the bound, the error, and the numbers of cubics,
    /// lines and quadratics, then the [`elements`].
    #[allow(clippy::too_many_arguments)]
    pub fn convert(
        &self,
        accuracy: f64,
        metric: &str,
        fit: &str,
        cuts: &str,
        at_extrema: bool,
        at_inflections: bool,
        span_knots: bool,
        free_joints: bool,
    ) -> Result<Vec<f64>> {
        let options = Options {
            metric: named("metric", metric, Metric::ALL)?,
            fit: named("fit", fit, Fit::ALL)?,
            cuts: named("cuts", cuts, Cuts::ALL)?,
            at_extrema,
            at_inflections,
            span_knots,
            free_joints,
            ..Options::new(accuracy)
        };
        let done = convert::convert(self.curve(), &options);
        let counts = [done.cubics, done.lines, done.quadratics].map(|count| count as f64);
        let mut all = vec![done.bound, done.error];
        all.extend(counts);
        all.extend(elements(&done.path));
        Ok(all)
    }
}

fn set_place(entry: &JsValue, place: Place) {
    match place {
        Place::Knot(index) => set(entry, "knot", (index as f64).into()),
        Place::Segment(index) => set(entry, "segment", (index as f64).into()),
    }
}

/// The value of that name; the default for an empty one.
fn named<T: Copy + Default>(what: &str, name: &str, all: &[(T, &str)]) -> Result<T> {
    if name.is_empty() {
        return Ok(T::default());
    }
    all.iter().find(|(_, known)| *known == name).map(|(value, _)| *value).ok_or_else(|| {
        let hint = catalog::suggest(name, all.iter().map(|(_, known)| *known));
        error(&format!("there is no {what} `{name}`"), &hint)
    })
}

/// The commands of a path, each with its numbers: 0 move, 1 line, 2 quadratic, 3 cubic, 4 close.
fn elements(path: &BezPath) -> Vec<f64> {
    let mut numbers = Vec::with_capacity(7 * path.elements().len());
    let mut command = |code: f64, points: &[Point]| {
        numbers.push(code);
        points.iter().for_each(|p| numbers.extend([p.x, p.y]));
    };
    for element in path.elements() {
        match *element {
            PathEl::MoveTo(p) => command(0.0, &[p]),
            PathEl::LineTo(p) => command(1.0, &[p]),
            PathEl::QuadTo(p1, p2) => command(2.0, &[p1, p2]),
            PathEl::CurveTo(p1, p2, p3) => command(3.0, &[p1, p2, p3]),
            PathEl::ClosePath => command(4.0, &[]),
        }
    }
    numbers
}

/// A contour under the hand.
#[wasm_bindgen]
#[derive(Clone)]
pub struct Live {
    live: LiveContour,
}

#[wasm_bindgen]
impl Live {
    /// The contour with its canonical curve.
    #[wasm_bindgen(constructor)]
    pub fn new(built: &Built, knots: &[f64], closed: bool) -> Result<Live> {
        let contour = Contour { knots: knots_of(knots), closed };
        let live = LiveContour::new(contour, built.spline.clone());
        live.map(|live| Live { live }).map_err(|e| input_error(&e))
    }

    /// The same as it is now.
    pub fn snapshot(&self) -> Live {
        self.clone()
    }

    /// Moves a knot.
    pub fn move_to(&mut self, index: usize, x: f64, y: f64) {
        if let Some(knot) = self.live.contour().knots.get(index) {
            let knot = Knot { point: Point::new(x, y), ..knot.clone() };
            self.live.set_knot(index, knot);
        }
    }

    /// Changes a knot, given as a row.
    pub fn set_knot(&mut self, index: usize, row: &[f64]) {
        self.live.set_knot(index, knot_of(row));
    }

    /// Changes all knots, given as rows.
    pub fn set_knots(&mut self, rows: &[f64]) {
        self.live.set_knots(knots_of(rows));
    }

    /// Puts a knot in, given as a row.
    pub fn insert(&mut self, index: usize, row: &[f64]) {
        self.live.insert(index, knot_of(row));
    }

    /// Takes a knot out.
    pub fn remove(&mut self, index: usize) {
        self.live.remove(index);
    }

    /// Closes or opens.
    pub fn set_closed(&mut self, closed: bool) {
        self.live.set_closed(closed);
    }

    /// Changes the spline.
    pub fn set_spline(&mut self, built: &Built) {
        self.live.set_spline(built.spline.clone());
    }

    /// Brings the curve up to date; an effort that is no number is that for a hand.
    pub fn solve(&mut self, effort: f64) -> Result<()> {
        let effort = if effort.is_nan() { LiveContour::in_hand() } else { Effort::times(effort) };
        self.live.solve_with(effort).map(drop).map_err(|e| input_error(&e))
    }

    /// The canonical curve.
    pub fn settle(&mut self) -> Result<()> {
        self.live.settle().map(drop).map_err(|e| input_error(&e))
    }

    /// The curve.
    pub fn solved(&self) -> Solved {
        Solved { solution: self.live.solution().clone() }
    }

    /// The curve as Béziers: see [`elements`].
    pub fn path(&mut self, accuracy: f64) -> Vec<f64> {
        elements(self.live.beziers(accuracy))
    }
}
