//! The two-parameter families of the catalogue: a segment, and the curvature at its start, for
//! given end angles.

use faircurve::catalog::{self, Claim, ENTRIES, SplineInfo};
use faircurve::families::bespoke::BespokeCubics;
use faircurve::families::euler::EulerSpirals;
use faircurve::families::hobby::{HobbyCubics, MockCurvature};
use faircurve::families::kappa::BiParabolas;
use faircurve::families::kurgla1::SiMecs;
use faircurve::families::log_aesthetic::{self, LogAesthetic};
use faircurve::frame::ChordAngles;
use faircurve::kurbo::{Point, Vec2};
use faircurve::two_param::curvature_map::{CurvatureMap, SegmentContext};
use faircurve::two_param::generating::Cuts;
use faircurve::two_param::shape::{SegmentEnds, SegmentShape};
use faircurve::{Contour, Knot, Segment, Solution, Spline, Status};

/// The curvature map of a family, and the shape that belongs to it.
pub(crate) struct Parts {
    pub(crate) map: Box<dyn CurvatureMap>,
    pub(crate) shape: Box<dyn SegmentShape>,
}

impl Parts {
    /// Of the spline of that name, with every default; `None` where they aren't known here.
    fn of(name: &str) -> Option<Parts> {
        match name {
            "euler" => Parts::new(EulerSpirals, EulerSpirals),
            "kurgla1" => Parts::new(SiMecs, SiMecs),
            "hobby" => Parts::new(MockCurvature { tension: 1.0 }, HobbyCubics { tension: 1.0 }),
            "bespoke" => Parts::new(BespokeCubics, BespokeCubics),
            "kappa" => Parts::new(BiParabolas, BiParabolas),
            "log-aesthetic" => {
                let cuts = Cuts { curve: LogAesthetic::new(log_aesthetic::PREFERRED) };
                Parts::new(cuts, cuts)
            }
            _ => None,
        }
    }

    fn new(map: impl CurvatureMap + 'static, shape: impl SegmentShape + 'static) -> Option<Parts> {
        Some(Parts { map: Box::new(map), shape: Box::new(shape) })
    }
}

/// A family, by its parts where it has them, or else by what it does with two knots whose tangents
/// are given.
pub(crate) struct Family {
    pub(crate) info: &'static SplineInfo,
    pub(crate) parts: Option<Parts>,
    spline: Box<dyn Spline>,
}

const START: Point = Point::ORIGIN;
const END: Point = Point::new(1.0, 0.0);

impl Family {
    /// Every entry whose segments have two parameters.
    pub(crate) fn all() -> impl Iterator<Item = Family> {
        let two = |info: &&SplineInfo| info.claims.contains(&Claim::Parameters(2));
        ENTRIES.iter().copied().filter(two).filter_map(|info| {
            let spline = catalog::spline(info.name).ok()?;
            Some(Family { info, parts: Parts::of(info.name), spline })
        })
    }

    /// The folder of its source.
    pub(crate) fn folder(&self) -> String {
        self.info.name.replace('-', "_")
    }

    /// The segment on the unit chord, if there is one.
    pub(crate) fn segment(&self, angles: ChordAngles) -> Option<Segment> {
        match &self.parts {
            Some(parts) => within(parts, angles).then(|| {
                let curvatures = Some(parts.map.curvatures(angles, &SegmentContext::UNIT).value);
                let ends = SegmentEnds { angles, curvatures, context: SegmentContext::UNIT };
                parts.shape.place(START, END, &ends)
            }),
            None => self.solved(angles)?.curve.segments().first().cloned(),
        }
    }

    /// Curvature at its start, for unit chord; huge at a cusp.
    pub(crate) fn curvature(&self, angles: ChordAngles) -> Option<f64> {
        match &self.parts {
            Some(parts) => within(parts, angles).then(|| {
                let start = parts.map.curvatures(angles, &SegmentContext::UNIT).value[0];
                start.num / start.den
            }),
            None => self.solved(angles)?.knots[0].curvature_out,
        }
    }

    fn solved(&self, angles: ChordAngles) -> Option<Solution> {
        let knots = [
            Knot::new(START).tangent_out(Vec2::from_angle(angles.start_direction(0.0))),
            Knot::new(END).tangent_in(Vec2::from_angle(angles.end_direction(0.0))),
        ];
        let solution = faircurve::solve(&Contour::open(knots), &*self.spline).ok()?;
        (solution.report.status() == Status::Solved).then_some(solution)
    }
}

fn within(parts: &Parts, angles: ChordAngles) -> bool {
    angles.theta0.abs().max(angles.theta1.abs()) <= parts.map.limit()
}
