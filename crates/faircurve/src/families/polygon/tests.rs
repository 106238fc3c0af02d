use super::*;
use crate::{Adaptation, Contour, Knot, Place, catalog, solve};

#[test]
fn segments_are_the_chords() {
    let spline = catalog::spline("polygon").unwrap();
    let points = [(0.0, 0.0), (3.0, 4.0), (6.0, 0.0)];
    for closed in [false, true] {
        let contour = Contour { closed, ..Contour::open(points) };
        let solution = solve(&contour, &*spline).unwrap();
        assert!(solution.curve.segments().iter().all(Segment::is_line));
        assert_eq!(solution.curve.length(), if closed { 16.0 } else { 10.0 });
        assert!(solution.knots.iter().all(|knot| knot.join == Join::Corner));
        assert_eq!(solution.report.residual, 0.0);
    }
}

#[test]
fn given_tangents_are_ignored_and_smooth_joins_adapted() {
    let knots = [
        Knot::new((0.0, 0.0)),
        Knot::new((3.0, 4.0)).tangent((1.0, 0.0)),
        Knot::new((6.0, 0.0)).join(Join::G2),
    ];
    let solution = solve(&Contour::closed(knots), &*catalog::spline("polygon").unwrap()).unwrap();
    let said = |knot, asked, got| Adaptation { place: Place::Knot(knot), asked, got };
    assert_eq!(solution.report.adapted, [said(1, "tangent", "ignored"), said(2, "g2", "corner")]);
    assert_eq!(solution.knots[1].join, Join::Corner);
    assert!(solution.report.relaxed.is_empty());
}
