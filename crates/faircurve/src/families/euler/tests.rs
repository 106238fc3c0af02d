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
    let family = Euler::default();
    for (theta0, theta1) in [(0.0, 0.0), (0.3, -0.8), (1.5, 1.4), (-2.5, 1.0), (2.8, 2.0)] {
        let exact = family.curvatures(ChordAngles::new(theta0, theta1));
        let h = 1e-6;
        for angle in 0..2 {
            let at = |sign: f64| {
                let mut angles = [theta0, theta1];
                angles[angle] += sign * h;
                family.curvatures(ChordAngles::new(angles[0], angles[1]))
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
