//! One cubic for one piece, by the metric and the kind of fit that are asked for.

use kurbo::CubicBez;

use super::certificate::{Sharpness, distance_bound};
use super::contact;
use super::metric::angle_error;
use super::minimax::{Fit as Arms, LocalCubic, first_params, measure, minimax};
use super::options::{Fit, Metric};
use super::piece::{Piece, Shift, Stretch, unit};
use super::single;
use super::tuning::{HOPELESS, PLAIN_ARMS, PLAIN_BOUND, SHORT, UNSEEN};

/// Fits cubics to pieces of one stretch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fitter<'a> {
    pub(super) stretch: &'a Stretch<'a>,
    pub(super) metric: Metric,
    pub(super) fit: Fit,
    /// What errors are held against, in the metric's units.
    pub(super) accuracy: f64,
    /// Each cubic is to be as near as it can be, with a sharp bound; else only those are for which it matters.
    pub(super) is_thorough: bool,
    /// How cubics start and end.
    pub(super) shifts: [Shift; 2],
}

/// A cubic that may do.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) piece: Piece,
    pub(super) arms: Arms,
    /// Its error in the metric's units; of distances an estimate.
    pub(super) error: f64,
}

/// A cubic that is part of the result.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cubic {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) shifts: [Shift; 2],
    /// Arm lengths in user units.
    pub(super) arms: [f64; 2],
    /// Error in the metric's units; of distances the bound.
    pub(super) error: f64,
    /// A bound of the distance, in user units.
    pub(super) bound: f64,
}

impl Fitter<'_> {
    /// The best cubic for a piece.
    pub(super) fn try_piece(&self, from: f64, to: f64) -> Candidate {
        let piece = self.stretch.piece(from, to).shifted(self.shifts);
        let measured = |arms: [f64; 2]| measure(&piece, arms, first_params(arms));
        let arms = match (self.fit, self.metric) {
            (Fit::ArcThird, _) => measured(single::ARC_THIRD),
            (Fit::EqualArms, _) => measured(single::equal_arms(&piece)),
            (Fit::EndCurvature, _) => {
                let exists = single::with_end_curvatures(&piece);
                let is_short = to - from < SHORT * self.stretch.length();
                exists.unwrap_or_else(|| if is_short { minimax(&piece, 0.0) } else { Arms::none() })
            }
            (Fit::Optimal, Metric::Distance) => {
                minimax(&piece, (self.enough(PLAIN_ARMS) / piece.half).min(UNSEEN))
            }
            (Fit::Optimal, metric) => {
                measured(single::least_angle_error(self.stretch, &piece, metric))
            }
        };
        let error = match self.metric {
            Metric::Distance => arms.error * piece.half,
            metric => {
                let cubic = LocalCubic::with_arms(&piece, arms.arms);
                angle_error(self.stretch, &piece, &cubic, metric).unwrap_or(f64::INFINITY)
            }
        };
        Candidate { piece, arms, error }
    }

    /// This part of the accuracy, where it is enough to be so near.
    fn enough(&self, part: f64) -> f64 {
        if self.is_thorough || self.metric != Metric::Distance { 0.0 } else { part * self.accuracy }
    }

    /// The power of its length with which the error of a piece grows, on short pieces.
    pub(super) fn order(&self) -> f64 {
        let order = match self.fit {
            Fit::Optimal | Fit::EndCurvature => 6.0,
            Fit::EqualArms => 5.0,
            Fit::ArcThird => 4.0,
        };
        if self.metric == Metric::SquaredAngle { order - 0.5 } else { order }
    }

    /// What the sixth-order theory says of the error of the best cubic for a piece; `None` where the
    /// piece isn't one spiral's, or the theory says nothing.
    pub(super) fn law(&self, from: f64, to: f64) -> Option<f64> {
        if self.metric != Metric::Distance || self.fit != Fit::Optimal {
            return None;
        }
        let e6 = contact::expansions(self.stretch.curvature_about_middle(from, to)?).least()?;
        Some(contact::MINIMAX_ERROR * e6 * (to - from) / 2.0)
    }

    /// The candidate with its bound.
    pub(super) fn certify(&self, candidate: &Candidate) -> Cubic {
        let Candidate { piece, arms, error } = candidate;
        let lengths = arms.arms.map(|arm| arm * piece.half);
        let is_hopeless =
            arms.error * piece.half > HOPELESS * self.accuracy && self.metric == Metric::Distance;
        // The other metrics set the distance no limit.
        let limit = if self.metric == Metric::Distance { self.accuracy } else { f64::INFINITY };
        let sharpness = Sharpness { is_hopeless, limit, enough: self.enough(PLAIN_BOUND) };
        let mut bound = distance_bound(self.stretch, piece, arms, sharpness);
        if !bound.is_finite() {
            bound = farthest_apart(piece, lengths);
        }
        let error = if self.metric == Metric::Distance { bound } else { *error };
        let shifts = self.shifts;
        Cubic { from: piece.from, to: piece.to, shifts, arms: lengths, error, bound }
    }

    /// The cubic in place.
    pub(super) fn place(&self, cubic: &Cubic) -> CubicBez {
        let mut ends = [cubic.from, cubic.to].map(|s| self.stretch.joint(s));
        for (joint, shift) in ends.iter_mut().zip(cubic.shifts) {
            // Exact where there is nothing to move.
            if shift != Shift::NONE {
                joint.point += joint.tangent.turn_90() * shift.offset;
                joint.tangent = joint.tangent.rotate_scale(unit(shift.turn));
            }
        }
        let [from, to] = ends;
        CubicBez::new(
            from.point,
            from.point + from.tangent * cubic.arms[0],
            to.point - to.tangent * cubic.arms[1],
            to.point,
        )
    }
}

/// How far apart a piece and a cubic on the same ends can be at most, whatever their shapes: both
/// start in one place, the piece ends within its length of it, and control points lie within the longer arm
/// of the ends.
fn farthest_apart(piece: &Piece, arms: [f64; 2]) -> f64 {
    let offset = piece.offsets[0].abs().max(piece.offsets[1].abs()) * piece.half;
    4.0 * piece.half + arms[0].max(arms[1]) + offset
}
