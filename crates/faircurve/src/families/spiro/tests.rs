use std::f64::consts::TAU;

use super::*;
use crate::frame::ChordAngles;

/// The response of the segment agrees with what the segment itself says, and with differences.
#[test]
fn response_agrees_with_the_segment_and_with_differences() {
    let family = PolynomialSpirals;
    for k in [
        [0.0; 4],
        [1.0, 0.0, 0.0, 0.0],
        [1.2, -3.0, 9.0, 40.0],
        [-2.0, 5.0, -30.0, 100.0],
        [0.3, 8.0, 20.0, -300.0],
    ] {
        let response = family.respond(k);
        let spiral = PolynomialSpiral::new(k);
        let ChordAngles { theta0, theta1 } = spiral.chord_angles();
        assert!((response.jets[0] - theta0).abs() < 1e-14);
        assert!((response.jets[1] - theta1).abs() < 1e-14);
        // Moving the parameters by what a change of one jet asks moves just that jet.
        let h = 1e-6;
        for jet in 0..4 {
            let moved = |sign: f64| {
                let step = |row: usize| sign * h * response.parameters_by_jets[row][jet];
                family.respond(std::array::from_fn(|row| k[row] + step(row)))
            };
            let (up, down) = (moved(1.0), moved(-1.0));
            for other in 0..4 {
                let slope = (up.jets[other] - down.jets[other]) / (2.0 * h);
                let expected = if other == jet { 1.0 } else { 0.0 };
                assert!((slope - expected).abs() < 1e-6, "{k:?} {jet} {other}: {slope}");
                let slope = (up.derivatives[other] - down.derivatives[other]) / (2.0 * h);
                let claimed = response.derivatives_by_jets[other][jet];
                assert!((slope - claimed).abs() < 1e-5 * (1.0 + claimed.abs()), "{k:?} {slope}");
            }
        }
    }
}

/// What comes out has the ends that went in, straightest first; and a segment with a flat middle is
/// found from its own ends, whatever full turns are added to its angles.
#[test]
fn segments_are_found_between_their_ends() {
    let family = PolynomialSpirals;
    for k in [
        [0.0; 4],
        [0.5, -2.0, 30.0, 100.0],
        [-1.0, 3.0, -150.0, 900.0],
        [2.0, 10.0, 300.0, -1500.0],
        [-2.5, -8.0, 420.0, 400.0],
    ] {
        let [theta0, theta1, kappa0, kappa1] = family.respond(k).jets;
        let found = family.between_ends([theta0 + TAU, theta1 - 3.0 * TAU, kappa0, kappa1]);
        let same =
            |other: &[f64; 4]| (0..4).all(|j| (other[j] - k[j]).abs() < 1e-5 * (1.0 + k[j].abs()));
        assert!(found.iter().any(same), "{k:?}: {found:?}");
        let mut straightness = 1.0;
        for found in found {
            let response = family.respond(found);
            let turns = |angle: f64| (angle / TAU - (angle / TAU).round()).abs() * TAU;
            assert!(turns(response.jets[0] - theta0) < 1e-5, "{k:?}: {found:?}");
            assert!(turns(response.jets[1] - theta1) < 1e-5, "{k:?}: {found:?}");
            assert!((response.jets[2] - kappa0).abs() < 1e-4, "{k:?}: {found:?}");
            assert!((response.jets[3] - kappa1).abs() < 1e-4, "{k:?}: {found:?}");
            assert!(response.straightness <= straightness + 1e-9);
            straightness = response.straightness;
        }
    }
}
