//! Contours under the hand: whatever the edits, the curve is one of the contour's, stays on its branch
//! and becomes Béziers as close as asked.

use std::f64::consts::TAU;
use std::sync::Arc;

use faircurve::kurbo::{self, ParamCurveNearest, Point};
use faircurve::{Contour, Curve, Effort, Join, Knot, LiveContour, Spline, catalog, solve};

/// Numbers in [−1, 1), the same in every run.
fn random() -> impl FnMut() -> f64 {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

fn spline(name: &str) -> Arc<dyn Spline> {
    Arc::from(catalog::spline(name).unwrap())
}

/// A calm closed outline with a waist.
fn outline(count: usize, closed: bool) -> Contour {
    let mut next = random();
    let knot = |i: usize| {
        let angle = TAU * i as f64 / count as f64;
        let radius = 300.0 + 80.0 * (2.0 * angle).cos() + 5.0 * next();
        Knot::new((radius * angle.cos(), radius * angle.sin()))
    };
    Contour { knots: (0..count).map(knot).collect(), closed }
}

/// The largest distance between points of equal share of arc length.
fn distance(a: &Curve, b: &Curve) -> f64 {
    let point =
        |curve: &Curve, i: usize| curve.at(curve.length() * i as f64 / 200.0).unwrap().point;
    (0..=200).map(|i| point(a, i).distance(point(b, i))).fold(0.0, f64::max)
}

fn assert_canonical(live: &LiveContour, what: &str) {
    let canonical = solve(live.contour(), live.spline()).unwrap();
    let off = distance(&canonical.curve, &live.solution().curve);
    assert!(off < 1e-6, "{} after {what}: {off}", live.spline().name());
    assert_eq!(canonical.report.status(), live.solution().report.status());
}

/// On calm contours there is one curve, and following the edits ends on it. (With all the effort that
/// `solve` has, since κ-curves relax some of them.)
#[test]
fn calm_contours_keep_their_canonical_curve_through_every_edit() {
    for entry in catalog::ENTRIES {
        for closed in [true, false] {
            let mut live = LiveContour::new(outline(14, closed), spline(entry.name)).unwrap();
            let mut next = random();
            for index in [3, 0, 13, 7] {
                for _ in 0..4 {
                    let mut knot = live.contour().knots[index].clone();
                    knot.point += kurbo::Vec2::new(8.0 * next(), 8.0 * next());
                    live.set_knot(index, knot);
                    live.solve_with(Effort::default()).unwrap();
                    assert_canonical(&live, "a move");
                }
            }
            for index in [0, 5, live.contour().knots.len()] {
                let count = live.contour().knots.len();
                let (a, b) = ((index + count - 1) % count, index % count);
                let [a, b] = [a, b].map(|i| live.contour().knots[i].point);
                live.insert(index, Knot::new(a.lerp(b, 0.4) + a.to_vec2() * 0.08));
                live.solve_with(Effort::default()).unwrap();
                assert_canonical(&live, "an insertion");
            }
            for index in [0, 6, live.contour().knots.len() - 3] {
                live.remove(index);
                live.solve_with(Effort::default()).unwrap();
                assert_canonical(&live, "a removal");
            }
            live.set_closed(!closed);
            live.solve_with(Effort::default()).unwrap();
            assert_canonical(&live, "closing or opening");
            let corner = live.contour().knots[4].clone().join(Join::Corner);
            live.set_knot(4, corner);
            live.solve_with(Effort::default()).unwrap();
            assert_canonical(&live, "a change of join");
        }
    }
}

/// A knot added where the curve passes doesn't move it, and following takes hardly a step.
#[test]
fn inserting_on_the_curve_is_nearly_free() {
    for name in ["spiro", "mvc"] {
        for index in [0, 4, 14] {
            let mut live = LiveContour::new(outline(14, true), spline(name)).unwrap();
            let before = live.clone();
            let segment = &before.solution().curve.segments()[(index + 13) % 14];
            live.insert(index, Knot::new(segment.point(0.3 * segment.length())));
            let solution = live.solve().unwrap();
            assert!(solution.report.iterations <= 2, "{name}: {}", solution.report.iterations);
            let (a, b) = (before.solution().curve.length(), solution.curve.length());
            assert!((a - b).abs() < 1e-8, "{name}: {a} {b}");
        }
    }
}

/// A knot that hardly moves takes fewer steps than the curve found anew: it is followed.
#[test]
fn a_small_move_takes_fewer_steps_than_solving_anew() {
    for name in ["spiro", "mvc", "euler", "log-aesthetic", "bespoke"] {
        for closed in [true, false] {
            let mut live = LiveContour::new(outline(14, closed), spline(name)).unwrap();
            let mut knot = live.contour().knots[5].clone();
            knot.point.x += 0.01;
            live.set_knot(5, knot);
            let anew = solve(live.contour(), live.spline()).unwrap().report.iterations;
            let followed = live.solve().unwrap().report.iterations;
            assert!(followed < anew, "{name}, closed {closed}: {followed} steps, anew {anew}");
            assert_canonical(&live, "a small move");
        }
    }
}

/// Out and back again: the curve that was there, where the canonical curve jumps on the way.
#[test]
fn a_drag_stays_on_its_branch() {
    let mut jumps = [0, 0];
    let mut longest: f64 = 0.0;
    for seed in 0..12 {
        let mut next = random();
        (0..100 * seed).for_each(|_| {
            next();
        });
        let knots: Vec<Knot> =
            (0..6).map(|_| Knot::new((100.0 * next(), 100.0 * next())).join(Join::G2)).collect();
        let mut live = LiveContour::new(Contour::closed(knots), spline("spiro")).unwrap();
        if !live.solution().report.relaxed.is_empty() {
            continue;
        }
        let mut canonical = live.solution().curve.clone();
        for step in 0..60 {
            let mut knot = live.contour().knots[2].clone();
            let angle = TAU * step as f64 / 60.0;
            knot.point += kurbo::Vec2::from_angle(angle) * 3.0;
            live.set_knot(2, knot);
            let before = live.solution().curve.clone();
            live.solve().unwrap();
            let anew = solve(live.contour(), live.spline()).unwrap().curve;
            let moved = [distance(&before, &live.solution().curve), distance(&canonical, &anew)];
            for (count, moved) in jumps.iter_mut().zip(moved) {
                *count += usize::from(moved > 40.0);
            }
            longest = longest.max(moved[0]);
            canonical = anew;
        }
    }
    // Of more than 40 units in steps of 3.
    assert!(jumps[0] < jumps[1] / 2, "{jumps:?}, the largest {longest}");
}

/// An edit without meaning is refused, and the curve goes on from where it was.
#[test]
fn nonsense_leaves_the_curve_as_it_was() {
    let mut live = LiveContour::new(outline(9, true), spline("spiro")).unwrap();
    let before = live.solution().clone();
    live.set_knot(2, Knot::new((f64::NAN, 0.0)));
    assert!(live.solve().is_err());
    assert!(Arc::ptr_eq(&before, live.solution()));
    live.set_knot(2, outline(9, true).knots[2].clone());
    live.solve().unwrap();
    assert_canonical(&live, "an error");
    live.set_knot(99, Knot::new((0.0, 0.0)));
    live.remove(99);
    live.insert(99, Knot::new((300.0, -20.0)));
    live.solve().unwrap();
    assert_eq!(live.solution().knots.len(), 10);
    (0..10).for_each(|_| live.remove(0));
    assert!(live.solve().is_err());
    live.insert(0, Knot::new((1.0, 2.0)));
    live.insert(1, Knot::new((5.0, 2.0)));
    assert!(live.solve().unwrap().curve.length() > 8.0);
    live.settle().unwrap();
}

/// A snapshot is the curve that was, to the bit.
#[test]
fn a_clone_is_a_snapshot() {
    let mut live = LiveContour::new(outline(20, true), spline("spiro")).unwrap();
    let snapshot = live.clone();
    let curve = snapshot.solution().curve.clone();
    live.remove(3);
    live.set_spline(spline("euler"));
    live.solve_with(Effort::default()).unwrap();
    assert_ne!(live.solution().curve, curve);
    live = snapshot;
    assert_eq!(live.solution().curve, curve);
    assert_eq!(live.contour().knots.len(), 20);
    assert_eq!(live.spline().name(), "spiro");
}

/// Kept Béziers are as near to the curve as new ones, however long the drag.
#[test]
fn beziers_stay_within_their_accuracy_through_a_drag() {
    const ACCURACY: f64 = 0.05;
    for name in ["spiro", "euler", "hobby"] {
        let mut live = LiveContour::new(outline(40, true), spline(name)).unwrap();
        let mut kept = 0;
        for step in 0..40 {
            let before = live.beziers(ACCURACY).clone();
            let mut knot = live.contour().knots[11].clone();
            knot.point += kurbo::Vec2::from_angle(0.3 * step as f64) * 2.0;
            live.set_knot(11, knot);
            live.solve().unwrap();
            let path = live.beziers(ACCURACY).clone();
            assert!(path.is_finite());
            kept += before.segments().filter(|old| path.segments().any(|new| new == *old)).count();
            let segments: Vec<_> = path.segments().collect();
            let curve = &live.solution().curve;
            for i in 0..200 {
                let point = curve.at(curve.length() * i as f64 / 200.0).unwrap().point;
                assert!(
                    from_path(&segments, point) <= ACCURACY * (1.0 + 1e-6),
                    "{name} {step} {i}"
                );
            }
        }
        let is_spiral = ["spiro", "euler"].contains(&name);
        assert!(!is_spiral || kept > 40 * 5, "{name}: {kept}");
    }
}

fn from_path(segments: &[kurbo::PathSeg], point: Point) -> f64 {
    let squared = segments.iter().map(|segment| segment.nearest(point, 1e-9).distance_sq);
    squared.fold(f64::INFINITY, f64::min).sqrt()
}
