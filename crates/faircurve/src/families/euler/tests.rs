use super::*;

#[test]
fn the_fit_has_the_angles_asked_for_over_the_whole_square() {
    let n = 64;
    let limit = PI - 1e-6;
    let mut worst = 0.0f64;
    for i in -n..=n {
        for j in -n..=n {
            let angles = ChordAngles::new(
                limit * f64::from(i) / f64::from(n),
                limit * f64::from(j) / f64::from(n),
            );
            let spiral = fit_euler(angles).unwrap();
            let chord = spiral.chord();
            let found = spiral.chord_angles();
            // The direction of a short chord is known only to rounding over its length.
            let error =
                (found.theta0 - angles.theta0).abs().max((found.theta1 - angles.theta1).abs());
            worst = worst.max(error * chord.length);
            assert!(error * chord.length < 1e-14, "{angles:?} {found:?} {spiral:?}");
        }
    }
}

#[test]
fn derivatives_agree_with_differences() {
    for (theta0, theta1) in [(0.0, 0.0), (0.3, -0.8), (1.5, 1.4), (-2.5, 1.0), (2.8, 2.0)] {
        let exact =
            EulerSpirals.curvatures(ChordAngles::new(theta0, theta1), &SegmentContext::UNIT);
        let h = 1e-6;
        for angle in 0..2 {
            let at = |sign: f64| {
                let mut angles = [theta0, theta1];
                angles[angle] += sign * h;
                EulerSpirals
                    .curvatures(ChordAngles::new(angles[0], angles[1]), &SegmentContext::UNIT)
            };
            let (up, down) = (at(1.0), at(-1.0));
            for end in 0..2 {
                let slope = (up.value[end].num - down.value[end].num) / (2.0 * h);
                let claimed = exact.by_angle[end][angle].num;
                assert!((slope - claimed).abs() < 1e-7, "{theta0} {theta1} {end} {angle}");
            }
        }
    }
}

/// The fit is the winding that continues the straight line, found here by following it in small
/// steps; close to the square's edges too.
#[test]
fn the_fit_continues_the_straight_line() {
    let mut state = 1u64;
    let mut random = move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    for n in 0..600 {
        let mut edge = || PI * (1.0 - 10f64.powf(-8.0 * random().abs())) * random().signum();
        let (mut theta0, mut theta1) = (edge(), edge());
        if n % 3 != 0 {
            (theta0, theta1) = (theta0 * random(), theta1);
        }
        let mut k1 = 0.0f64;
        for step in 1..=400 {
            let t = f64::from(step) / 400.0;
            let (k0, difference) = (t * (theta0 + theta1), t * (theta1 - theta0));
            for _ in 0..30 {
                let moments = spiro_moments([k0, k1, 0.0, 0.0]);
                let ratio = moments.0[2] * moments.integral().inv();
                let error = difference + 2.0 * moments.integral().arg() - k1 / 4.0;
                let change = -error / (ratio.re - 0.25);
                k1 += change.clamp(-0.5, 0.5);
                if change.abs() < 1e-14 * (1.0 + k1.abs()) {
                    break;
                }
            }
        }
        let fitted = fit_euler(ChordAngles::new(theta0, theta1)).unwrap().k[1];
        let error = (fitted - k1).abs() / (1.0 + k1.abs());
        assert!(error < 1e-13, "{theta0} {theta1}: {fitted} {k1}");
    }
}

#[test]
fn corners_and_what_lies_beyond_are_errors() {
    for (theta0, theta1, error) in [
        (PI, PI, FitError::ClosedCircle),
        (-PI, -PI, FitError::ClosedCircle),
        (3.2, 0.0, FitError::OutOfRange),
        (0.0, f64::NAN, FitError::OutOfRange),
        (f64::INFINITY, 0.0, FitError::OutOfRange),
    ] {
        assert_eq!(fit_euler(ChordAngles::new(theta0, theta1)), Err(error));
    }
    for (theta0, theta1) in [(PI, -PI), (-PI, PI), (PI, 0.0), (0.0, -PI)] {
        assert!(fit_euler(ChordAngles::new(theta0, theta1)).is_ok());
    }
}

#[test]
fn the_estimate_is_as_near_as_it_says() {
    let steps = 200;
    for i in -steps..=steps {
        for j in -steps..=steps {
            let angle = |i: i32| 2.2 * f64::from(i) / f64::from(steps);
            let angles = ChordAngles::new(angle(i), angle(j));
            let off = (estimate(angles) - fit_euler(angles).unwrap().k[1]).abs();
            assert!(off < 1.51e-5, "{angles:?}: {off:e}");
        }
    }
}
