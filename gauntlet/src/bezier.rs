//! Béziers: the conversion against kurbo's fitters, on the same curves, paired in one run.

use std::hint::black_box;
use std::time::Instant;

use faircurve::convert::{Options, convert};
use faircurve::kurbo::{
    BezPath, ParamCurve, ParamCurveArclen, PathSeg, Point, Vec2, fit_to_bezpath, fit_to_bezpath_opt,
};
use faircurve::{Curve, PolynomialSpiral, Segment};
use serde_json::json;

use crate::report::{Report, table};

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
        let end =
            at + Vec2::from_angle(direction + angles.theta0) * (chord.length * length * 1000.0);
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

/// The largest distance of a path's curves from a curve, at `points` places of each, lines left out: by nearest points
/// on the segment where it should be and its neighbours.
pub(crate) fn true_error(curve: &Curve, path: &BezPath, points: usize) -> f64 {
    let segments = curve.segments();
    let ends: Vec<f64> = segments
        .iter()
        .scan(0.0, |sum, segment| {
            *sum += segment.length();
            Some(*sum)
        })
        .collect();
    let length = ends.last().copied().unwrap_or(0.0);
    let start = |i: usize| if i == 0 { 0.0 } else { ends[i - 1] };
    let (mut worst, mut s) = (0.0f64, 0.0);
    for bezier in path.segments() {
        if matches!(bezier, PathSeg::Line(_)) {
            s += bezier.arclen(1e-9);
            continue;
        }
        let mut before = bezier.eval(0.0);
        for i in 0..=points {
            let point = bezier.eval(i as f64 / points as f64);
            s = (s + (point - before).hypot()).min(length);
            before = point;
            let near = ends.partition_point(|end| *end <= s).min(ends.len() - 1);
            let window = near.saturating_sub(1)..(near + 2).min(ends.len());
            let best = window
                .map(|i| {
                    let guess = (s - start(i)).clamp(0.0, segments[i].length());
                    let (local, distance) = foot(&segments[i], point, guess);
                    (start(i) + local, distance)
                })
                .min_by(|a, b| a.1.total_cmp(&b.1));
            let Some((mut at, mut distance)) = best else { continue };
            // What Newton's method hasn't settled is searched. A search is as accurate as the distance at which it
            // starts, which may be that of the far side: its foot is settled anew.
            if distance > worst {
                let all = near.saturating_sub(1)..(near + 2).min(ends.len());
                for i in all {
                    let (searched, _) = segments[i].nearest(point, 1e-4 * distance);
                    let (local, settled) = foot(&segments[i], point, searched);
                    if settled < distance {
                        (at, distance) = (start(i) + local, settled);
                    }
                }
            }
            s = at;
            worst = worst.max(distance);
        }
    }
    worst
}

/// The foot of a perpendicular on a segment, by Newton's method, and its distance.
fn foot(segment: &Segment, point: Point, guess: f64) -> (f64, f64) {
    let mut s = guess;
    for _ in 0..20 {
        let (tangent, off) = (Vec2::from_angle(segment.direction(s)), point - segment.point(s));
        let lever = (1.0 - segment.curvature(s) * tangent.cross(off)).max(0.2);
        let next = (s + off.dot(tangent) / lever).clamp(0.0, segment.length());
        let change = (next - s).abs();
        s = next;
        if change <= 1e-16 * segment.length() {
            break;
        }
    }
    (s, (point - segment.point(s)).hypot())
}

pub(crate) fn cubics(path: &BezPath) -> usize {
    path.segments().filter(|s| matches!(s, PathSeg::Cubic(_))).count()
}

/// Seconds of the fastest of some runs of each of two, in turns.
pub(crate) fn paired(rounds: usize, mut a: impl FnMut(), mut b: impl FnMut()) -> [f64; 2] {
    let mut fastest = [f64::INFINITY; 2];
    for _ in 0..rounds {
        for which in 0..2 {
            let start = Instant::now();
            if which == 0 {
                a()
            } else {
                b()
            }
            fastest[which] = fastest[which].min(start.elapsed().as_secs_f64());
        }
    }
    fastest
}

/// Points of each Bézier at which true errors are measured.
const POINTS: usize = 4000;

/// The six curves at six accuracies.
pub(crate) fn run(rounds: usize) -> Report {
    let mut rows = Vec::new();
    let mut alarms = Vec::new();
    let mut sums = [0usize; 4];
    let (mut log_ratio, mut log_free, mut largest_ratio) = (0.0, 0.0, 0.0f64);
    for (name, curve) in curves() {
        for decade in 1..=6 {
            let accuracy = 10f64.powi(-decade);
            let options = Options { span_knots: true, ..Options::new(accuracy) };
            let free = Options { free_joints: true, ..options.clone() };
            let (ours, freely) = (convert(&curve, &options), convert(&curve, &free));
            let (bisect, opt) =
                (fit_to_bezpath(&curve, accuracy), fit_to_bezpath_opt(&curve, accuracy));
            let [time, bisect_time] = paired(
                rounds,
                || drop(black_box(convert(&curve, &options))),
                || drop(black_box(fit_to_bezpath(&curve, accuracy))),
            );
            let [free_time, _] = paired(
                rounds,
                || drop(black_box(convert(&curve, &free))),
                || drop(black_box(convert(&curve, &options))),
            );
            let [error, free_error, bisect_error, opt_error] =
                [&ours.path, &freely.path, &bisect, &opt]
                    .map(|path| true_error(&curve, path, POINTS));
            for (what, error, bound) in
                [("joints on the curve", error, ours.bound), ("free", free_error, freely.bound)]
            {
                if !(error <= bound && bound <= accuracy) {
                    alarms.push(format!(
                        "{name} at {accuracy:e}, {what}: true error {error:e}, bound {bound:e}"
                    ));
                }
            }
            let ratio = (ours.bound / error).max(freely.bound / free_error);
            largest_ratio = largest_ratio.max(ratio);
            log_ratio += (time / bisect_time).ln();
            log_free += (free_time / bisect_time).ln();
            let counts = [ours.cubics, freely.cubics, cubics(&opt), cubics(&bisect)];
            for (sum, count) in sums.iter_mut().zip(counts) {
                *sum += count;
            }
            rows.push([
                name.to_owned(),
                format!("1e-{decade}"),
                counts[0].to_string(),
                counts[1].to_string(),
                counts[2].to_string(),
                counts[3].to_string(),
                format!("{:.4}", error / accuracy),
                format!("{ratio:.4}"),
                format!("{:.3}", opt_error / accuracy),
                format!("{:.3}", bisect_error / accuracy),
                format!("{:.1}", time * 1e6),
                format!("{:.1}", bisect_time * 1e6),
                format!("{:.1}", free_time * 1e6),
                format!("{:.3}", time / bisect_time),
            ]);
        }
    }
    let [mean, free_mean] = [log_ratio, log_free].map(|log| (log / rows.len() as f64).exp());
    let header = [
        "curve",
        "accuracy",
        "ours",
        "free joints",
        "opt",
        "bisect",
        "true/accuracy",
        "bound/true",
        "opt true/acc.",
        "bisect true/acc.",
        "µs",
        "bisect µs",
        "free µs",
        "ratio",
    ];
    let text = format!(
        "Cubics for curves of arc length 1000; opt and bisect are kurbo's fit_to_bezpath_opt and fit_to_bezpath\n\n{}\n\
         cubics: ours {}, with free joints {}, opt {}, bisect {}; largest bound/true {largest_ratio:.4}; \
         time over bisect's, geometric mean {mean:.3}, with free joints {free_mean:.3}\n",
        table(header, rows),
        sums[0],
        sums[1],
        sums[2],
        sums[3],
    );
    let json = json!({
        "cubics": sums[0], "free_joints": sums[1], "opt": sums[2], "bisect": sums[3],
        "largest_bound_over_true": largest_ratio, "time_over_bisect": mean,
        "free_time_over_bisect": free_mean, "alarms": alarms,
    });
    Report { text, json, notable: Vec::new(), alarms }
}

/// Random pieces of spirals, every other case with free joints: one segment each, from the smooth to the wound up, small and large, near and far from the origin.
pub(crate) fn random(cases: usize, seed: u64) -> Report {
    let mut state = seed.wrapping_mul(2).wrapping_add(1);
    let mut random = move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let (mut alarms, mut cubics, mut ratios, mut over) = (Vec::new(), 0, Vec::new(), 0);
    for case in 0..cases {
        let mut k = [1.0, 2.0, 8.0, 48.0]
            .map(|size| if random() < 0.3 { 0.0 } else { size * (2.0 * random() - 1.0) });
        let wildness = k[0].abs() + k[1].abs() / 2.0 + k[2].abs() / 8.0 + k[3].abs() / 48.0;
        let turn = 6.0 * random();
        if wildness > 0.0 {
            k = k.map(|k| k * turn / wildness);
        }
        let size = 10f64.powf(18.0 * random() - 9.0);
        let start = Point::ZERO
            + Vec2::new(random() - 0.5, random() - 0.5) * size * 10f64.powf(4.0 * random() - 2.0);
        // A neighbour that is up to a million times larger or smaller.
        let middle = start + Vec2::from_angle(6.3 * random()) * size;
        let end =
            middle + Vec2::from_angle(6.3 * random()) * size * 10f64.powf(12.0 * random() - 6.0);
        let curve = Curve::new(
            vec![
                Segment::spiral(start, middle, PolynomialSpiral::new(k)),
                Segment::spiral(middle, end, PolynomialSpiral::new([k[1], k[0], 0.0, 0.0])),
            ],
            false,
        );
        let accuracy = size * 10f64.powf(-1.0 - 7.0 * random());
        let options = Options { free_joints: case % 2 == 1, ..Options::new(accuracy) };
        let ours = convert(&curve, &options);
        cubics += ours.cubics;
        over += usize::from(ours.bound > accuracy);
        let error = true_error(&curve, &ours.path, 24);
        if !(error <= ours.bound) {
            alarms
                .push(format!("case {case}: {k:?}: true error {error:e}, bound {:e}", ours.bound));
        }
        ratios.push(ours.bound / error);
    }
    ratios.sort_by(f64::total_cmp);
    let at = |part: f64| ratios[((ratios.len() - 1) as f64 * part) as usize];
    let text = format!(
        "{cases} random pairs of spirals, {cubics} cubics\n\
         bound/true (24 places a cubic): median {:.4}, 99 % {:.4}\n\
         bound above the accuracy (accuracies that rounding doesn't allow): {over}\n",
        at(0.5),
        at(0.99),
    );
    let json = json!({ "cases": cases, "cubics": cubics, "over": over, "alarms": alarms });
    Report { text, json, notable: Vec::new(), alarms }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Arcs of more than a turn: a point beside the start is beside the end, too, and a guess of its arc
    /// length that is off by one turn has its foot on the far side.
    #[test]
    fn true_errors_of_arcs_of_more_than_a_turn_are_settled() {
        let cases = [
            (10.570519861388778, (8795.160626055133, 18580.222693128562), 1.4898623651940402e-8),
            (6.3354866444309845, (-1015140.2436696602, 257331.0450032741), 4.496929407658138e-5),
        ];
        for (turn, end, accuracy) in cases {
            let start = Point::new(-1.2296871624566568, 1.3588808202571734);
            let arc = PolynomialSpiral::new([-turn, 0.0, 0.0, 0.0]);
            let curve = Curve::new(vec![Segment::spiral(start, end.into(), arc)], false);
            let ours = convert(&curve, &Options::new(accuracy));
            let error = true_error(&curve, &ours.path, 24);
            assert!(error <= ours.bound, "{turn}: {error:e} {:e}", ours.bound);
        }
    }
}
