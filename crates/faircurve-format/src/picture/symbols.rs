//! The symbols of knots: thesis Tables 7.1 and 10.1. The legend is in the module above.

use std::collections::HashSet;

use faircurve::kurbo::{Affine, BezPath, Circle, CircleSegment, Rect, Shape};
use faircurve::{Join, Place, SolvedKnot};

use super::{KNOT_LINE_WIDTH, KNOT_RADIUS, LINE, MOST_AT_ONCE, Mark, PAPER, RELAXED, Stroke};
use crate::solved::{SolvedContour, SolvedGlyph};

/// What stands at a knot.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Symbol {
    Joint(Join),
    Start,
    End,
}

impl Symbol {
    fn of(knot: &SolvedKnot) -> Symbol {
        match (knot.direction_in, knot.direction_out) {
            (None, Some(_)) => Symbol::Start,
            (Some(_), None) => Symbol::End,
            _ => Symbol::Joint(knot.join),
        }
    }

    /// Solid symbols are ink with a halo, the others paper with an ink line.
    fn is_solid(self) -> bool {
        !matches!(self, Symbol::Joint(Join::Corner | Join::G1 | Join::G2))
    }

    /// Whether it turns with the curve. The others stand upright, so that squares and diamonds
    /// differ.
    fn turns(self) -> bool {
        matches!(
            self,
            Symbol::Start
                | Symbol::End
                | Symbol::Joint(Join::CurveToTerminal | Join::TerminalToCurve)
        )
    }

    /// The symbol about the origin, of about unit radius, for travel along +x.
    fn path(self) -> BezPath {
        /// Symbols are a tenth of a unit wide on the sheet at most; this keeps circles round.
        const ROUND: f64 = 1e-3;
        let half_disc = |from: f64| {
            CircleSegment::new((0.0, 0.0), 1.4, 0.0, from, std::f64::consts::PI).to_path(ROUND)
        };
        match self {
            Symbol::Joint(Join::Corner) => Rect::new(-0.85, -0.85, 0.85, 0.85).to_path(ROUND),
            Symbol::Joint(Join::G1) => polygon(&[(1.2, 0.0), (0.0, 1.2), (-1.2, 0.0), (0.0, -1.2)]),
            Symbol::Joint(Join::G2 | Join::G4) => Circle::new((0.0, 0.0), 1.0).to_path(ROUND),
            // The flat side lies across the curve and faces the terminal side.
            Symbol::Joint(Join::CurveToTerminal) => half_disc(std::f64::consts::FRAC_PI_2),
            Symbol::Joint(Join::TerminalToCurve) => half_disc(-std::f64::consts::FRAC_PI_2),
            Symbol::Start => polygon(&[(1.6, 0.0), (-0.8, 1.2), (-0.8, -1.2)]),
            Symbol::End => Rect::new(-0.4, -1.6, 0.4, 1.6).to_path(ROUND),
        }
    }
}

fn polygon(points: &[(f64, f64)]) -> BezPath {
    let mut path = BezPath::new();
    path.move_to(points[0]);
    points[1..].iter().for_each(|point| path.line_to(*point));
    path.close_path();
    path
}

/// The knots of a glyph: hollow and solid symbols, as asked and relaxed.
pub(super) fn marks(glyph: &SolvedGlyph, size: f64) -> Vec<Mark> {
    let knots: Vec<PlacedSymbol<'_>> = glyph.contours.iter().flat_map(placed_symbols).collect();
    knots.chunks(MOST_AT_ONCE).flat_map(|some| symbols(some, size)).collect()
}

struct PlacedSymbol<'a> {
    symbol: Symbol,
    knot: &'a SolvedKnot,
    relaxed: bool,
}

fn placed_symbols(contour: &SolvedContour) -> impl Iterator<Item = PlacedSymbol<'_>> {
    let relaxed: HashSet<Place> =
        contour.solution.report.relaxed.iter().map(|entry| entry.place).collect();
    contour.solution.knots.iter().enumerate().map(move |(index, knot)| PlacedSymbol {
        symbol: Symbol::of(knot),
        knot,
        relaxed: relaxed.contains(&Place::Knot(index)),
    })
}

fn symbols(placed: &[PlacedSymbol<'_>], size: f64) -> [Mark; 4] {
    let mut paths: [BezPath; 4] = Default::default();
    for PlacedSymbol { symbol, knot, relaxed } in placed {
        let direction = knot.direction_out.or(knot.direction_in).filter(|_| symbol.turns());
        let mut path = symbol.path();
        path.apply_affine(
            Affine::translate(knot.point.to_vec2())
                * Affine::rotate(direction.unwrap_or(0.0))
                * Affine::scale(KNOT_RADIUS * size),
        );
        paths[usize::from(symbol.is_solid()) + 2 * usize::from(*relaxed)].extend(path);
    }
    let [hollow, solid, relaxed_hollow, relaxed_solid] = paths;
    let mark = |class, path, fill, line| Mark {
        class,
        path,
        fill: Some(fill),
        stroke: Some(Stroke { paint: line, width: KNOT_LINE_WIDTH * size, dashed: false }),
        exact: false,
    };
    [
        mark("knots-hollow", hollow, PAPER, LINE),
        mark("knots-solid", solid, LINE, PAPER),
        mark("knots-hollow relaxed", relaxed_hollow, PAPER, RELAXED),
        mark("knots-solid relaxed", relaxed_solid, RELAXED, PAPER),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_sides_face_the_terminal_side() {
        // Travel is along +x: what leaves is at x > 0.
        let bounds = |join| Symbol::Joint(join).path().bounding_box();
        let leaving = bounds(Join::CurveToTerminal);
        assert!(leaving.x1.abs() < 1e-9 && leaving.x0 < -1.0);
        let arriving = bounds(Join::TerminalToCurve);
        assert!(arriving.x0.abs() < 1e-9 && arriving.x1 > 1.0);
    }

    #[test]
    fn every_kind_of_knot_looks_different() {
        let mut looks: Vec<(bool, String)> = Join::ALL
            .map(Symbol::Joint)
            .into_iter()
            .chain([Symbol::Start, Symbol::End])
            .map(|symbol| (symbol.is_solid(), symbol.path().to_svg()))
            .collect();
        let count = looks.len();
        looks.sort();
        looks.dedup();
        assert_eq!(looks.len(), count);
    }
}
