//! Fair curves through points.
//!
//! A designer gives a few knots and says how they join; faircurve finds the fairest curve through
//! them, measures it, and turns it into Béziers. The whole pipeline:
//!
//! ```
//! use faircurve::{Contour, Join, Knot, catalog, convert, solve};
//!
//! // The problem: knots and how they join.
//! let contour = Contour::closed([
//!     Knot::new((0.0, 0.0)).join(Join::Corner),
//!     Knot::new((300.0, 100.0)),
//!     Knot::new((200.0, 400.0)),
//! ]);
//!
//! // The method, by name, and the solution.
//! let spiro = catalog::spline("spiro")?;
//! let solution = solve(&contour, &*spiro)?;
//! assert!(solution.report.relaxed.is_empty());
//! assert!(solution.report.residual < 1e-9);
//!
//! // The curve answers questions, and becomes Béziers as close to it as asked.
//! let top = solution.curve.at(solution.curve.length() / 2.0).unwrap();
//! println!("{} {} {}", top.point, top.direction, top.curvature);
//! println!("{}", convert::to_bezpath(&solution.curve, 0.1).to_svg());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Words: see `docs/vocabulary.md` in the repository. Signs and frames: [`frame`].

pub mod convert;
pub mod curve;
pub mod families;
pub mod four_param;
pub mod frame;
pub mod live;
pub mod measure;
pub mod numeric;
pub mod outline;
pub mod plan;
pub mod segment;
pub mod spline;
pub mod tolerance;
pub mod two_param;

pub use families::catalog;
pub use kurbo;

pub use curve::Curve;
pub use live::LiveContour;
pub use outline::{Contour, Join, Knot, Outline};
pub use plan::InputError;
pub use segment::{CurvePoint, PolynomialSpiral, Segment, Shape, UnitCurve};
pub use spline::{
    Adaptation, Effort, Place, Relaxation, Solution, SolveReport, SolvedKnot, Spline, Stage,
    Status, solve, solve_near, solve_with,
};
