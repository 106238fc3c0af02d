//! Polynomial spirals: curvature a cubic polynomial of arc length.

use num_complex::Complex64;

use crate::frame::{ChordAngles, chord_direction};
use crate::numeric::spiro_integral::{angle, spiro_integral, sub_parameters};
use crate::numeric::trig::argument;

/// A curve whose curvature is a cubic polynomial of arc length (thesis section 7.3), scaled to arc
/// length 1: k₀ … k₃ of eq. 8.1, curvature and its derivatives at the middle. The Euler spiral is
/// the case k₂ = k₃ = 0, the circular arc k₁ = 0 too, the line k₀ = 0 too.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct PolynomialSpiral {
    /// Curvature and its first three derivatives at the middle, for arc length 1.
    pub k: [f64; 4],
}

/// Chord over arc length and direction of the chord of a [`PolynomialSpiral`], in the frame in
/// which its middle points along +x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpiralChord {
    /// Chord length for arc length 1, in [0, 1].
    pub length: f64,
    /// ψ of eq. 8.21, here as the full-range arctangent.
    pub direction: f64,
}

impl SpiralChord {
    /// The chord that is this integral, of a spiral with this curvature in the middle.
    pub(crate) fn new(integral: Complex64, curvature: f64) -> Self {
        let direction = chord_direction(argument(integral), curvature);
        SpiralChord { length: integral.norm_sqr().sqrt(), direction }
    }
}

impl PolynomialSpiral {
    /// The spiral of these parameters.
    pub const fn new(k: [f64; 4]) -> Self {
        PolynomialSpiral { k }
    }

    /// Its chord, to the accuracy of [`spiro_integral`].
    pub fn chord(&self) -> SpiralChord {
        SpiralChord::new(spiro_integral(self.k), self.k[0])
    }

    /// The end tangents relative to the chord (eq. 8.19–8.20), not wrapped: their sum is the whole
    /// turning, windings included.
    pub fn chord_angles(&self) -> ChordAngles {
        let psi = self.chord().direction;
        ChordAngles { theta0: psi - angle(self.k, -0.5), theta1: angle(self.k, 0.5) - psi }
    }

    /// The piece between two places s ∈ [−½, ½], itself scaled to arc length 1 (eq. 8.3).
    pub fn piece(&self, from: f64, to: f64) -> Self {
        PolynomialSpiral { k: sub_parameters(self.k, (from + to) / 2.0, to - from) }
    }
}
