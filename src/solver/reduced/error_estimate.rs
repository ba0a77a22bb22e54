//! Estimated errors of a reduced solution, and an allowance for a cavitation model that differs from the one by which
//! the errors were measured.

use crate::solver::full::Mixed;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Cavitation;
use serde::{Deserialize, Serialize};

/// Estimate of an error that was not measured.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimated {
    /// Likely size (median of similar cases).
    pub likely: f64,
    /// Bound that holds for 99 of 100 errors.
    pub bound: f64,
}

/// Estimated errors of a reduced solution, relative if not stated otherwise, with respect to the full one on the same grid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorEstimate {
    /// Error of the central film thickness, |H̃_c/H_c − 1|. The mean planes of rough surfaces may pass each other: their
    /// errors are relative to σ/2 if H_c is smaller.
    pub h_c: Estimated,
    /// Error of the minimum film thickness, relative to the same.
    pub h_min: Estimated,
    /// Error of the state, e_z of (3.10).
    pub state: Estimated,
    /// Error of the traction coefficient (3.41); for rough surfaces of the film's part of it until
    /// [`Self::with_boundary_friction`]. `None` if the model does not include sliding, or if the isothermal
    /// traction is unphysical; for rough surfaces also without a limiting stress.
    pub traction: Option<Estimated>,
    /// Error of the mid-film temperature rise at X = 0; in kelvin for a rise below 1 K. `None` for isothermal models.
    pub rise: Option<Estimated>,
    /// Absolute error of the asperity load share. `None` for smooth surfaces.
    pub load_share: Option<Estimated>,
}

/// Largest relative change of H_c of line contacts between the full system's default penalty and complementarity.
const MOVES_H_C: f64 = 3.5e-7;
/// The same for the minimum film thickness H_min at the cavitation boundary: constant part and part per unit of M. Of
/// 2,000 contacts with M 2…1000 the change is 8e-7 in the median and 3.8e-5 at most, which exceeds most bounds without
/// this allowance.
const MOVES_H_MIN: (f64, f64) = (2e-6, 4e-8);

impl ErrorEstimate {
    /// Converts the estimate of the film's friction to that of the whole friction of rough surfaces: boundary films add
    /// the boundary friction coefficient times the asperity load share.
    pub fn with_boundary_friction(mut self, mixed: &Mixed, boundary_friction: f64) -> Self {
        let whole = (mixed.fluid_traction + mixed.boundary_traction).abs();
        let sum = |(fluid, share): (Estimated, Estimated)| {
            let of = |fluid: f64, share: f64| (fluid * mixed.fluid_traction.abs() + share * boundary_friction) / whole;
            Estimated { likely: of(fluid.likely, share.likely), bound: of(fluid.bound, share.bound) }
        };
        self.traction = self.traction.zip(self.load_share).filter(|_| whole > 0.0).map(sum);
        self
    }

    /// Converts the estimate to one with respect to a full solution with the cavitation model `asked`. Only line
    /// contacts need an allowance: for circular contacts the change is at most 1.8e-4, which is four tenths of their
    /// bounds.
    pub fn against(mut self, point: &OperatingPoint, asked: Cavitation, measured_by: Cavitation) -> Self {
        if point.kind.is_line() && (asked, measured_by) == (Cavitation::Penalty, Cavitation::Complementarity) {
            self.h_c.bound += MOVES_H_C;
            self.h_min.bound += MOVES_H_MIN.0 + MOVES_H_MIN.1 * point.moes().m;
        }
        self
    }
}
