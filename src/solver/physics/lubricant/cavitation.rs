//! Cavitation of a film where the gap widens.

use super::error::LubricantError;
use crate::solver::limits::Number;
use serde::{Deserialize, Serialize};

/// Cavitation model. It replaces the Reynolds equation where the pressure would become negative.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum Cavitation {
    /// Penalty on negative pressures, (2.36). The remaining negative pressures are proportional to 1/γ̄, with the
    /// penalty factor γ̄.
    #[default]
    Penalty,
    /// Complementarity: pressure P ≥ 0, multiplier λ ≥ 0 in the Reynolds equation, and P λ = 0 at every node
    /// (appendix D).
    Complementarity,
    /// Mass-conserving cavitation (Elrod and Adams): P ≥ 0, and where P = 0 the gap is filled to a fraction θ ≤ 1,
    /// which carries the flow.
    MassConserving {
        /// Inlet film thickness carried by the surfaces \[m\]; `None` for a flooded inlet.
        #[serde(rename = "supply_film", default)]
        supply_film_m: Option<f64>,
    },
}

impl Cavitation {
    /// Returns its name in sentences.
    pub fn name(self) -> &'static str {
        match self {
            Self::Penalty => "penalty",
            Self::Complementarity => "complementarity",
            Self::MassConserving { .. } => "mass-conserving",
        }
    }

    /// Checks the inlet film thickness.
    ///
    /// # Errors
    /// If it is not a positive number.
    pub fn check(self) -> Result<(), LubricantError> {
        match self.supply_film_m() {
            Some(film) if !(film.is_finite() && film > 0.0) => Err(LubricantError(format!(
                "the film supplied to the inlet is {} m thick, but a supply must be a thickness above zero; leave it \
                 out for a flooded inlet",
                Number(film)
            ))),
            _ => Ok(()),
        }
    }

    /// Returns the inlet film thickness \[m\], or `None` for a flooded inlet.
    pub fn supply_film_m(self) -> Option<f64> {
        match self {
            Self::MassConserving { supply_film_m } => supply_film_m,
            Self::Penalty | Self::Complementarity => None,
        }
    }
}
