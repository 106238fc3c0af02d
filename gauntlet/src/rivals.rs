//! Both programs on one contour, each judged by the same residual.

use std::borrow::Cow;

use faircurve::kurbo::{BezPath, Vec2};
use faircurve::{Contour, Curve, InputError, Join, Knot, Place, Solution, Spline, Status};
#[cfg(libspiro)]
use faircurve::{PolynomialSpiral, Segment};

use crate::residual::{Piece, PlacedCurve, Residual};

/// Residuals up to this count as solved when libspiro is judged: a hundred times its own aim.
pub(crate) const TRULY_SOLVED: f64 = 1e-5;

/// What faircurve makes of a contour.
#[derive(Clone, Debug)]
pub(crate) struct Ours {
    /// The solution as the library gives it.
    pub(crate) solution: Solution,
    /// k₀ … k₃ and length of each segment.
    pub(crate) pieces: Vec<Piece>,
    /// Recomputed, with the joins that the contour asks for.
    pub(crate) as_asked: Residual,
    /// Recomputed, with the joins that hold after relaxing.
    pub(crate) as_claimed: Residual,
    /// Length over chord of the longest segment.
    pub(crate) longest: f64,
    /// Length over chord of each segment that has a chord.
    pub(crate) lengths: Vec<f64>,
    /// ∫|κ| ds, radians.
    pub(crate) turning: f64,
}

impl Ours {
    /// Solves with the given spline.
    ///
    /// # Errors
    /// That of the input.
    pub(crate) fn solve(contour: &Contour, spline: &dyn Spline) -> Result<Ours, InputError> {
        Ok(Ours::judge(contour, spline, faircurve::solve(contour, spline)?))
    }

    /// Judges what the spline made of a contour.
    pub(crate) fn judge(contour: &Contour, spline: &dyn Spline, solution: Solution) -> Ours {
        let pieces: Vec<Piece> = solution
            .curve
            .segments()
            .iter()
            .map(|segment| Piece {
                k: segment.kappa().unwrap_or_default(),
                length: Some(segment.length()),
            })
            .collect();
        let placed = PlacedCurve::new(contour, &pieces);
        let claimed: Vec<Join> = solution.knots.iter().map(|knot| knot.join).collect();
        let asked = without_ignored(contour, &placed, &solution);
        let held = with_relaxed_as_given(&asked, &placed, &solution);
        Ours {
            as_asked: placed.residual(&asked, &asked_joins(contour, spline)),
            as_claimed: placed.residual(&held, &claimed),
            longest: placed.longest_in_chords(),
            lengths: placed.lengths_in_chords().collect(),
            turning: placed.total_turning(),
            solution,
            pieces,
        }
    }

    /// Whether faircurve says that all is as asked.
    pub(crate) fn is_solved(&self) -> bool {
        self.solution.report.status() == Status::Solved
    }

    /// What is wrong with the report, in words: the curve is called solved and isn't, or what is
    /// said to hold after relaxing doesn't, or a relaxed knot asked for something else. The judge
    /// allows a little more than the solver's own limit, since the two round differently.
    pub(crate) fn falsehood(&self, contour: &Contour) -> Option<String> {
        let report = &self.solution.report;
        let (claim, found) = match report.status() {
            Status::Solved => ("solved", &self.as_asked),
            Status::Relaxed => ("right after relaxing", &self.as_claimed),
        };
        // What holds where a whole segment is of another spline isn't for this judge to say.
        let is_knots_only = report.relaxed.iter().all(|r| matches!(r.place, Place::Knot(_)));
        if is_knots_only && found.value > 2.0 * faircurve::tolerance::SOLVED {
            return Some(format!(
                "called {claim} at {:.1e}, is {:.1e} at knot {}: {}",
                report.residual, found.value, found.knot, found.equation,
            ));
        }
        report.relaxed.iter().find_map(|relaxation| {
            let Place::Knot(knot) = relaxation.place else { return None };
            let join = contour.knots[knot].join?;
            let is_mirrored = relaxation.asked != join.name();
            (is_mirrored && relaxation.asked == join.reversed().name()).then(|| {
                format!("knot {knot} asks {join}; relaxed as if it asked {}", relaxation.asked)
            })
        })
    }

    /// Whether every number of the curve and of its knots is finite.
    pub(crate) fn is_finite(&self) -> bool {
        let pieces = self.pieces.iter().all(|piece| {
            piece.length.is_some_and(f64::is_finite) && piece.k.iter().all(|k| k.is_finite())
        });
        let knots = self.solution.knots.iter().all(|knot| {
            [knot.direction_in, knot.direction_out, knot.curvature_in, knot.curvature_out]
                .into_iter()
                .flatten()
                .all(f64::is_finite)
        });
        let (report, curve) = (&self.solution.report, &self.solution.curve);
        let box_is_finite = curve.bounding_box().is_none_or(|bounds| bounds.is_finite());
        pieces
            && knots
            && report.residual.is_finite()
            && curve.length().is_finite()
            && box_is_finite
    }
}

/// Each knot's join, with the spline's own where none is named or it lacks the one that is.
pub(crate) fn asked_joins(contour: &Contour, spline: &dyn Spline) -> Vec<Join> {
    let join = |knot: &Knot| spline.adapt(knot.join.unwrap_or(spline.default_join()));
    contour.knots.iter().map(join).collect()
}

/// The contour without the curvatures that the report lists as ignored: all at a smooth knot, at a
/// corner and an end those beside a tangent.
fn without_ignored<'a>(
    contour: &'a Contour,
    placed: &PlacedCurve,
    solution: &Solution,
) -> Cow<'a, Contour> {
    let mut rest = Cow::Borrowed(contour);
    for adaptation in &solution.report.adapted {
        if (adaptation.asked, adaptation.got) != ("curvature", "ignored") {
            continue;
        }
        let Place::Knot(first) = adaptation.place else { continue };
        let is_smooth = solution.knots[first].join.is_smooth();
        change_at(&mut rest, placed, adaptation.place, |knot| {
            knot.curvature_in =
                knot.curvature_in.filter(|_| !is_smooth && knot.tangent_in.is_none());
            knot.curvature_out =
                knot.curvature_out.filter(|_| !is_smooth && knot.tangent_out.is_none());
        });
    }
    rest
}

/// The contour as it is after relaxing: where the report says that something gave way, NaN is given,
/// which the judge takes for whatever the curve has there, so that nothing is required of it and of
/// the conditions in whose place it stands.
fn with_relaxed_as_given<'a>(
    contour: &'a Contour,
    placed: &PlacedCurve,
    solution: &Solution,
) -> Cow<'a, Contour> {
    let mut rest = Cow::Borrowed(contour);
    for relaxation in &solution.report.relaxed {
        let loses_tangent = relaxation.asked == "tangent" || relaxation.got == Join::Corner.name();
        change_at(&mut rest, placed, relaxation.place, |knot| {
            let given = [knot.tangent_in, knot.tangent_out].iter().any(Option::is_some)
                || [knot.curvature_in, knot.curvature_out].iter().any(Option::is_some);
            if loses_tangent {
                let any = Some(Vec2::new(f64::NAN, f64::NAN));
                (knot.tangent_in, knot.tangent_out) = (any, any);
            }
            if loses_tangent || given {
                (knot.curvature_in, knot.curvature_out) = (Some(f64::NAN), Some(f64::NAN));
            }
        });
    }
    rest
}

/// Changes the knots of one place.
fn change_at(
    contour: &mut Cow<'_, Contour>,
    placed: &PlacedCurve,
    place: Place,
    change: impl Fn(&mut Knot),
) {
    if let Place::Knot(first) = place {
        for knot in placed.knots_in_place_of(first, contour.knots.len()) {
            change(&mut contour.to_mut().knots[knot]);
        }
    }
}

/// The joins by libspiro's letters, such as `voo[`, for messages.
pub(crate) fn letters(contour: &Contour) -> String {
    let last = contour.knots.len().saturating_sub(1);
    contour
        .knots
        .iter()
        .enumerate()
        .map(|(i, knot)| match i {
            0 if !contour.closed => '{',
            _ if i == last && !contour.closed => '}',
            _ => knot.join.map_or('o', letter),
        })
        .collect()
}

fn letter(join: Join) -> char {
    match join {
        Join::Corner => 'v',
        Join::G1 => 'a',
        Join::G2 => 'c',
        Join::G4 => 'o',
        Join::CurveToTerminal => '[',
        Join::TerminalToCurve => ']',
    }
}

/// What libspiro makes of a contour.
#[derive(Clone, Debug)]
pub(crate) struct Theirs {
    /// Whether the entry point that FontForge calls returns 1.
    pub(crate) returns_one: bool,
    /// Whether it was spared the contour: one that libspiro lacks a word for, or of one or two
    /// points, which it doesn't check.
    pub(crate) is_spared: bool,
    /// Its curve, unless it refuses.
    pub(crate) curve: Option<TheirCurve>,
}

/// A curve by libspiro.
#[derive(Clone, Debug)]
pub(crate) struct TheirCurve {
    /// The residual of its k₀ … k₃.
    pub(crate) residual: Residual,
    /// Length over chord of the longest segment.
    pub(crate) longest: f64,
    /// ∫|κ| ds, radians.
    pub(crate) turning: f64,
    /// Direction in which each knot is reached, by `get_knot_th`; `None` at an open start and where
    /// the segment has no chord (libspiro says 0 there).
    pub(crate) directions_in: Vec<Option<f64>>,
    /// Direction in which each knot is left: of the first by `get_knot_th`, of the others, which it
    /// doesn't tell, from k₀ … k₃. `None` at an open end and where the segment has no chord.
    pub(crate) directions_out: Vec<Option<f64>>,
}

/// Whether this build has libspiro.
pub(crate) const HAS_LIBSPIRO: bool = cfg!(libspiro);

/// libspiro's version, `None` without it.
pub(crate) fn libspiro_version() -> Option<String> {
    #[cfg(libspiro)]
    return Some(crate::ffi::version());
    #[cfg(not(libspiro))]
    None
}

/// A contour as libspiro takes it.
#[derive(Clone, Debug)]
pub(crate) struct LibspiroInput {
    #[cfg(libspiro)]
    points: Vec<crate::ffi::SpiroCp>,
}

#[cfg(not(libspiro))]
impl LibspiroInput {
    /// `None`: there is no libspiro.
    pub(crate) fn new(_: &Contour) -> Option<Self> {
        None
    }

    /// Never called: there is no libspiro.
    pub(crate) fn solve_only(&self) {}

    /// Never called either.
    pub(crate) fn curve_and_beziers(&self, _: &Contour) -> Option<(Curve, BezPath)> {
        None
    }
}

#[cfg(libspiro)]
impl LibspiroInput {
    /// `None` if the contour has something that libspiro lacks a word for, or is one of those of one
    /// or two points that it doesn't check.
    pub(crate) fn new(contour: &Contour) -> Option<Self> {
        use crate::ffi::{SpiroCp, is_well_formed};
        let is_plain = |knot: &Knot| {
            knot.join != Some(Join::G1) && Knot { join: None, ..knot.clone() } == knot.point.into()
        };
        let mut points: Vec<SpiroCp> = contour
            .knots
            .iter()
            .zip(letters(contour).bytes())
            .map(|(knot, letter)| SpiroCp::new(knot.point.x, knot.point.y, letter))
            .collect();
        if contour.closed {
            points.push(SpiroCp::new(0.0, 0.0, b'z'));
        }
        let is_fit = contour.knots.iter().all(is_plain) && is_well_formed(&points);
        is_fit.then_some(LibspiroInput { points })
    }

    /// Solves and throws away the result: what is timed.
    pub(crate) fn solve_only(&self) {
        std::hint::black_box(crate::ffi::SolvedSegments::solve(&self.points));
    }

    /// libspiro's curve as one of ours, and its own Béziers of it.
    pub(crate) fn curve_and_beziers(&self, contour: &Contour) -> Option<(Curve, BezPath)> {
        let solved = crate::ffi::SolvedSegments::solve(&self.points)?;
        let path = crate::ffi::beziers(&self.points)?;
        let knots = &contour.knots;
        let place = |(i, segment): (usize, &crate::ffi::SpiroSeg)| {
            let (start, end) = (knots[i].point, knots[(i + 1) % knots.len()].point);
            // Zeros are libspiro's lines.
            if segment.ks == [0.0; 4] {
                Segment::line(start, end)
            } else {
                Segment::spiral(start, end, PolynomialSpiral::new(segment.ks))
            }
        };
        let segments = solved.segments().iter().take(contour.segment_count()).enumerate();
        Some((Curve::new(segments.map(place).collect(), contour.closed), path))
    }

    fn solve(&self, contour: &Contour) -> Option<TheirCurve> {
        let solved = crate::ffi::SolvedSegments::solve(&self.points)?;
        let pieces: Vec<Piece> =
            solved.segments().iter().map(|segment| Piece { k: segment.ks, length: None }).collect();
        let knots = contour.knots.len();
        let placed = PlacedCurve::new(contour, &pieces);
        let ends = placed.end_directions(contour);
        let direction_in = |knot: usize| {
            // The first knot of a closed contour is reached by the last segment.
            let reached = if knot == 0 { knots } else { knot };
            ends.get(reached - 1).copied().flatten()?;
            solved.knot_direction(reached)
        };
        let direction_out = |knot: usize| {
            let (start, _) = ends.get(knot).copied().flatten()?;
            if knot == 0 { solved.knot_direction(0) } else { Some(start) }
        };
        let joins: Vec<Join> =
            contour.knots.iter().map(|knot| knot.join.unwrap_or(Join::G4)).collect();
        Some(TheirCurve {
            residual: placed.residual(contour, &joins),
            longest: placed.longest_in_chords(),
            turning: placed.total_turning(),
            directions_in: (0..knots).map(direction_in).collect(),
            directions_out: (0..knots).map(direction_out).collect(),
        })
    }
}

impl Theirs {
    /// Solves with libspiro.
    pub(crate) fn solve(contour: &Contour) -> Theirs {
        match LibspiroInput::new(contour) {
            None => Theirs { returns_one: false, is_spared: true, curve: None },
            #[cfg(libspiro)]
            Some(input) => Theirs {
                returns_one: crate::ffi::returns_one(&input.points),
                is_spared: false,
                curve: input.solve(contour),
            },
            #[cfg(not(libspiro))]
            Some(_) => Theirs { returns_one: false, is_spared: true, curve: None },
        }
    }

    /// Called solved, and solved by the true residual of what it drew.
    pub(crate) fn is_truly_solved(&self) -> bool {
        self.returns_one && self.residual() <= TRULY_SOLVED
    }

    /// Its residual; infinite where it refuses.
    pub(crate) fn residual(&self) -> f64 {
        self.curve.as_ref().map_or(f64::INFINITY, |curve| curve.residual.value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[expect(clippy::print_stdout, reason = "tests say why they are skipped")]
    fn libspiro_solves_what_is_easy_by_the_common_judge() {
        if !HAS_LIBSPIRO {
            println!("skipped: built without libspiro");
            return;
        }
        let points = [(0.0, 0.0), (100.0, 10.0), (180.0, 90.0), (150.0, 200.0), (20.0, 180.0)];
        for joins in [
            [Join::G4; 5],
            [Join::G2; 5],
            [Join::Corner, Join::G4, Join::CurveToTerminal, Join::Corner, Join::G2],
            [Join::G4, Join::Corner, Join::TerminalToCurve, Join::G4, Join::Corner],
        ] {
            let knots = || points.into_iter().zip(joins).map(|(p, join)| Knot::new(p).join(join));
            for contour in [Contour::closed(knots()), Contour::open(knots())] {
                let theirs = Theirs::solve(&contour);
                let curve = theirs
                    .curve
                    .as_ref()
                    .unwrap_or_else(|| panic!("refuses {}", letters(&contour)));
                assert!(theirs.returns_one && theirs.is_truly_solved());
                assert!(curve.residual.value < 1e-6, "{}: {:?}", letters(&contour), curve.residual);
                // At smooth knots what it tells is what follows from k₀ … k₃.
                for (knot, join) in joins.into_iter().enumerate() {
                    let sides = (curve.directions_in[knot], curve.directions_out[knot]);
                    if let ((Some(a), Some(b)), true) = (sides, join.is_smooth()) {
                        assert!(faircurve::frame::wrap_angle(a - b).abs() < 1e-7, "{a} {b}");
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_given_takes_the_place_that_the_decision_says() {
        let points = [(0.0, 0.0), (100.0, 10.0), (180.0, 90.0), (150.0, 200.0), (20.0, 180.0)];
        let (tangent, curvature) = (Vec2::new(1.0, 0.9), 0.005);
        for spline in ["spiro", "euler"].map(|name| faircurve::catalog::spline(name).unwrap()) {
            for join in Join::ALL {
                for (given_tangent, given_curvature, closed) in
                    (0..32).map(|i| ([i & 1 > 0, i & 2 > 0], [i & 4 > 0, i & 8 > 0], i & 16 > 0))
                {
                    let mut knots = points.map(|point| Knot::new(point).join(Join::G4)).to_vec();
                    knots[2] = Knot {
                        tangent_in: given_tangent[0].then_some(tangent),
                        tangent_out: given_tangent[1].then_some(tangent),
                        curvature_in: given_curvature[0].then_some(curvature),
                        curvature_out: given_curvature[1].then_some(curvature),
                        ..Knot::new(points[2]).join(join)
                    };
                    let contour = Contour { knots, closed };
                    let ours = Ours::solve(&contour, &*spline).unwrap();
                    assert_eq!(ours.falsehood(&contour), None, "{contour:?}");
                }
            }
        }
    }

    #[test]
    fn what_libspiro_lacks_is_not_passed_on() {
        let takes = |contour: Contour| LibspiroInput::new(&contour).is_some();
        let knots = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)].map(Knot::new);
        assert_eq!(takes(Contour::closed(knots.clone())), HAS_LIBSPIRO);
        assert!(!takes(Contour::open(knots[..2].to_vec())));
        let mut given = knots.clone();
        given[1].tangent_in = Some((1.0, 0.0).into());
        assert!(!takes(Contour::closed(given)));
        let mut g1 = knots;
        g1[1].join = Some(Join::G1);
        assert!(!takes(Contour::closed(g1)));
    }
}
