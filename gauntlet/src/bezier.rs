//! Béziers: the conversion against kurbo's fitters, on the same curves, paired in one run.

use std::time::Instant;

use faircurve::convert::{Options, convert};
use faircurve::kurbo::{BezPath, CurveFitSample, ParamCurve, ParamCurveFit, PathSeg, Point, Vec2, fit_to_bezpath, fit_to_bezpath_opt};
use faircurve::{Curve, PolynomialSpiral, Segment};
use serde_json::json;

use crate::Failure;
use crate::report::{Report, table};

struct Source<'a>{curve:&'a Curve, ends: Vec<f64>}
impl Source<'_> {
    fn locate(&self, t:f64, sign:f64)->(usize,f64){
        let s=t*self.ends[self.ends.len()-1];
        let i=if sign>=0.0 {self.ends.partition_point(|e| *e<=s)} else {self.ends.partition_point(|e| *e<s)}.min(self.ends.len()-1);
        (i, s-if i>0 {self.ends[i-1]} else {0.0})
    }
}
impl ParamCurveFit for Source<'_> {
    fn sample_pt_tangent(&self,t:f64,sign:f64)->CurveFitSample{
        let (i,s)=self.locate(t,sign); let g=&self.curve.segments()[i];
        CurveFitSample{p:g.point(s),tangent:Vec2::from_angle(g.direction(s))}
    }
    fn sample_pt_deriv(&self,t:f64)->(Point,Vec2){
        let (i,s)=self.locate(t,1.0); let g=&self.curve.segments()[i];
        (g.point(s), Vec2::from_angle(g.direction(s))*self.ends[self.ends.len()-1])
    }
    fn break_cusp(&self,_:std::ops::Range<f64>)->Option<f64>{None}
}

/// The six curves of arc length 1000.
pub(crate) fn curves() -> Vec<(&'static str, Curve)> {
    // Curvature over unit arc length s by powers of s, to derivatives at the middle.
    let single = |c: [f64; 4]| {
        let m = 0.5;
        let k = [
            c[0] + m * (c[1] + m * (c[2] + m * c[3])),
            c[1] + m * (2.0 * c[2] + m * 3.0 * c[3]),
            2.0 * c[2] + 6.0 * m * c[3],
            6.0 * c[3],
        ];
        chain(&[(1.0, k)])
    };
    vec![
        ("arc", single([std::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0])),
        ("2.4 s", single([0.0, 2.4, 0.0, 0.0])),
        ("−6 + 12 s", single([-6.0, 12.0, 0.0, 0.0])),
        ("9π s", single([0.0, 9.0 * std::f64::consts::PI, 0.0, 0.0])),
        ("cubic", single([1.0, 8.0, -20.0, 16.0])),
        ("G4, 8 pieces", natural()),
    ]
}

/// Spirals end to end: (length as a part of 1, k for arc length 1).
fn chain(parts: &[(f64, [f64; 4])]) -> Curve {
    let mut at = Point::ZERO;
    let mut direction = 0.0;
    let mut segments = Vec::new();
    for &(length, k) in parts {
        let spiral = PolynomialSpiral::new(k);
        let angles = spiral.chord_angles();
        let chord = spiral.chord();
        let end = at + Vec2::from_angle(direction + angles.theta0) * (chord.length * length * 1000.0);
        segments.push(Segment::spiral(at, end, spiral));
        direction += angles.turning();
        at = end;
    }
    Curve::new(segments, false)
}

/// The natural cubic spline of curvature.
fn natural() -> Curve {
    const S: [f64; 9] = [0.0, 0.11, 0.25, 0.4, 0.52, 0.66, 0.78, 0.9, 1.0];
    const K: [f64; 9] = [2.0, 9.0, -4.0, 14.0, 16.0, -8.0, 3.0, 20.0, 5.0];
    let n = 8;
    // Second derivatives by the tridiagonal system.
    let h: Vec<f64> = S.windows(2).map(|w| w[1] - w[0]).collect();
    let (mut diagonal, mut right) = (vec![1.0; n + 1], vec![0.0; n + 1]);
    let mut upper = vec![0.0; n + 1];
    for i in 1..n {
        let (lower, d, u) = (h[i - 1] / 6.0, (h[i - 1] + h[i]) / 3.0, h[i] / 6.0);
        let r = (K[i + 1] - K[i]) / h[i] - (K[i] - K[i - 1]) / h[i - 1];
        let w = lower / diagonal[i - 1];
        diagonal[i] = d - w * upper[i - 1];
        right[i] = r - w * right[i - 1];
        upper[i] = u;
    }
    let mut m = vec![0.0; n + 1];
    for i in (1..n).rev() {
        m[i] = (right[i] - upper[i] * m[i + 1]) / diagonal[i];
    }
    let parts: Vec<(f64, [f64; 4])> = (0..n)
        .map(|i| {
            let (h, third) = (h[i], (m[i + 1] - m[i]) / h[i]);
            let second = (m[i] + m[i + 1]) / 2.0;
            let value = (K[i] + K[i + 1]) / 2.0 - second * h * h / 8.0;
            let slope = (K[i + 1] - K[i]) / h - third * h * h / 24.0;
            (h, [value * h, slope * h * h, second * h * h * h, third * h * h * h * h])
        })
        .collect();
    chain(&parts)
}

/// The largest distance of the path's cubics from the curve, at `points` places of each, by nearest points in
/// order along the curve: exact to rounding between samples.
pub(crate) fn true_error(curve: &Curve, path: &BezPath, points: usize) -> f64 {
    let mut ends = Vec::new();
    let mut sum = 0.0;
    for segment in curve.segments() {
        sum += segment.length();
        ends.push(sum);
    }
    let at = |s: f64| {
        let i = ends.partition_point(|end| *end <= s).min(ends.len() - 1);
        let local = s - if i > 0 { ends[i - 1] } else { 0.0 };
        let segment = &curve.segments()[i];
        (segment.point(local), segment.direction(local), segment.curvature(local))
    };
    let mut worst = 0.0f64;
    let mut s = 0.0f64;
    for bezier in path.segments() {
        let PathSeg::Cubic(cubic) = bezier else { continue };
        let mut before = cubic.p0;
        for i in 0..=points {
            let point = cubic.eval(i as f64 / points as f64);
            s = (s + (point - before).hypot()).clamp(0.0, sum);
            before = point;
            for _ in 0..8 {
                let (on, direction, curvature) = at(s);
                let (tangent, off) = (Vec2::from_angle(direction), point - on);
                let along = off.dot(tangent);
                let lever = (1.0 - curvature * tangent.cross(off)).max(0.2);
                let next = (s + along / lever).clamp(0.0, sum);
                let change = (next - s).abs();
                s = next;
                if change < 1e-10 * sum {
                    break;
                }
            }
            worst = worst.max((point - at(s).0).hypot());
        }
    }
    worst
}

fn cubics(path: &BezPath) -> usize {
    path.segments().filter(|s| matches!(s, PathSeg::Cubic(_))).count()
}

fn seconds(rounds: usize, mut f: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..rounds)
        .map(|_| {
            let start = Instant::now();
            f();
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[0]
}

pub(crate) fn run(with_opt: bool) -> Result<Report, Failure> {
    let mut rows = Vec::new();
    let mut sums = [0usize; 3];
    let (mut log_time, mut count) = (0.0, 0);
    let mut worst_ratio = 0.0f64;
    let mut alarms=vec![];
    for (name, curve) in curves() {
        let mut sum=0.0; let ends=curve.segments().iter().map(|s|{sum+=s.length();sum}).collect();
        let source=Source{curve:&curve,ends};
        for decade in 1..=6 {
            let accuracy = 10f64.powi(-decade);
            let options = Options { span_knots: true, ..Options::new(accuracy) };
            let ours = convert(&curve, &options);
            let bisect = fit_to_bezpath(&source, accuracy);
            let opt = with_opt.then(|| fit_to_bezpath_opt(&source, accuracy));
            let (mut t_ours, mut t_bisect) = (f64::INFINITY, f64::INFINITY);
            for _ in 0..15 {
                t_ours = t_ours.min(seconds(3, || { std::hint::black_box(convert(&curve, &options)); }));
                t_bisect = t_bisect.min(seconds(3, || { std::hint::black_box(fit_to_bezpath(&source, accuracy)); }));
            }
            let error = true_error(&curve, &ours.path, 4000);
            let kurbo_error = true_error(&curve, &bisect, 400);
            sums[0] += ours.cubics;
            sums[1] += opt.as_ref().map_or(0, cubics);
            sums[2] += cubics(&bisect);
            log_time += (t_ours / t_bisect).ln();
            count += 1;
            worst_ratio = worst_ratio.max(ours.bound / error);
            if !(error<=accuracy && ours.bound<=accuracy && error <= ours.bound) {alarms.push(format!("{name} {accuracy:e}: true {error:e} bound {:e}",ours.bound));}
            rows.push([
                name.to_owned(),
                format!("1e-{decade}"),
                ours.cubics.to_string(),
                opt.as_ref().map_or(String::new(), |p| cubics(p).to_string()),
                cubics(&bisect).to_string(),
                format!("{:.4}", error / accuracy),
                format!("{:.4}", ours.bound / error),
                format!("{:.3}", kurbo_error / accuracy),
                format!("{:.1}", t_ours * 1e6),
                format!("{:.1}", t_bisect * 1e6),
                format!("{:.3}", t_ours / t_bisect),
            ]);
        }
    }
    let text = table(["curve","accuracy","ours","opt","bisect","true/acc","bound/true","bisect true/acc","µs","bisect µs","ratio"], rows)
        + &format!("\ncubics: ours {}, opt {}, bisect {}; worst bound/true {worst_ratio:.4}; time ratio {:.3}\n", sums[0], sums[1], sums[2], (log_time / f64::from(count)).exp());
    Ok(Report { text, json: json!({}), notable: vec![], alarms })
}
