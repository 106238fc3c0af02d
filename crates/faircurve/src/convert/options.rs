//! What a conversion is asked for.

use std::fmt;

/// How the error of one cubic is measured (thesis section 9.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Metric {
    /// The largest distance, in the drawing's units. What is compared with the accuracy is a proved
    /// bound of the Fréchet distance.
    #[default]
    Distance,
    /// E_abs = ∫|θ_approx − θ| ds (eq. 9.1), a length; it bounds the distance where the arc lengths agree.
    /// Computed to a relative 1e-4.
    AbsoluteAngle,
    /// E_sq = (∫(θ_approx − θ)² ds)^½ (eq. 9.4), in √length; √l·E_sq ≥ E_abs. Computed to a relative
    /// 1e-8 of what rounding leaves.
    SquaredAngle,
}

/// How one cubic is fitted to its piece. All keep ends and end tangents exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Fit {
    /// Both arms free: the least error of all local minima that are found (thesis section 9.5).
    #[default]
    Optimal,
    /// Arms of a third of the arc length (section 9.3). The error falls as n⁻⁴ only.
    ArcThird,
    /// Equal arms at which the arc lengths agree (section 9.4). The error falls as n⁻⁵ only.
    EqualArms,
    /// Arms at which the end curvatures are those of the curve, too, so that the Béziers join with
    /// continuous curvature where the curve does; about 1.45 times as many cubics. Where even
    /// a thousandth of a stretch has no such arms, the optimal ones.
    EndCurvature,
}

/// Where the curve is cut between the places at which it must be (thesis section 9.6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Cuts {
    /// Each cubic as long as the accuracy allows (section 9.6.4). The fewest, in nearly all cases; the last of a stretch has room to spare.
    #[default]
    Greedy,
    /// As many as greedy, with the same error for each of a stretch: the rounder result.
    EqualErrors,
    /// Two neighbours at a time get the same error, again and again (section 9.6.3), with as few as greedy.
    Balanced,
    /// In half by arc length until the accuracy is met (section 9.6.2).
    Halving,
    /// In half by ∫|κ| ds, likewise.
    HalvingBend,
}

macro_rules! names {
    ($type:ident: $($variant:ident = $name:literal),+ $(,)?) => {
        impl $type {
            /// All of them with their names.
            pub const ALL: &'static [($type, &'static str)] =
                &[$(($type::$variant, $name)),+];

            /// Its name, as on the command line.
            pub const fn name(self) -> &'static str {
                match self {
                    $($type::$variant => $name),+
                }
            }

            /// The one of this name.
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.iter().find(|(_, known)| *known == name).map(|(value, _)| *value)
            }
        }

        impl fmt::Display for $type {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.name())
            }
        }
    };
}

names!(Metric: Distance = "distance", AbsoluteAngle = "abs-angle", SquaredAngle = "sq-angle");
names!(Fit:
    Optimal = "optimal",
    ArcThird = "arc-third",
    EqualArms = "equal-arms",
    EndCurvature = "end-curvature",
);
names!(Cuts:
    Greedy = "greedy",
    EqualErrors = "equal-errors",
    Balanced = "balanced",
    Halving = "halving",
    HalvingBend = "halving-bend",
);

/// How a curve becomes Béziers.
///
/// ```
/// use faircurve::convert::{Cuts, Options, convert};
/// use faircurve::{Contour, catalog, solve};
/// let contour = Contour::open([(0.0, 0.0), (100.0, 50.0), (200.0, 0.0), (250.0, 80.0)]);
/// let curve = solve(&contour, &*catalog::spline("spiro")?)?.curve;
/// let options = Options { span_knots: true, cuts: Cuts::EqualErrors, ..Options::new(0.01) };
/// let beziers = convert(&curve, &options);
/// assert!(beziers.bound <= 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The largest error of each cubic, in the metric's units. Errors below 1e-12 of a stretch's length (1e-8
    /// where a segment has no bounds of its curvature's derivatives,
    /// [`Segment::curvature_bounds`](crate::Segment::curvature_bounds)), zero, negative numbers and NaN count as that.
    pub accuracy: f64,
    /// How errors are measured.
    pub metric: Metric,
    /// How one cubic is fitted.
    pub fit: Fit,
    /// Where the curve is cut.
    pub cuts: Cuts,
    /// Cut where the tangent is horizontal or vertical, as outline fonts want it.
    pub at_extrema: bool,
    /// Cut where the curvature changes sign.
    pub at_inflections: bool,
    /// Cut at these arc lengths, measured from the start of the curve.
    pub at: Vec<f64>,
    /// Let a cubic run through knots at which the curve is smooth. Else every knot is the end of a
    /// cubic. Where straight lines begin and end, and at the start, there are always ends.
    pub span_knots: bool,
    /// Let ends of cubics leave the curve, within the accuracy, where that needs fewer: along its normal, or, where
    /// neighbours bend away to different sides, with a tangent that is turned by up to 0.05 radians. Neighbours share
    /// point and tangent. Not at knots (unless they are spanned), nor at places that are asked for. For
    /// [`Metric::Distance`] and [`Fit::Optimal`] only; some ten times the work.
    pub free_joints: bool,
}

impl Options {
    /// The defaults at an accuracy in the drawing's units: the fewest cubics within that distance, with
    /// ends at all knots and on the curve.
    pub fn new(accuracy: f64) -> Self {
        Options {
            accuracy,
            metric: Metric::default(),
            fit: Fit::default(),
            cuts: Cuts::default(),
            at_extrema: false,
            at_inflections: false,
            at: Vec::new(),
            span_knots: false,
            free_joints: false,
        }
    }
}
