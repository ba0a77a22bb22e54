//! How a film ruptures where the gap opens.

use super::error::LubricantError;
use crate::solver::limits::Number;
use serde::{Deserialize, Serialize};

/// What replaces Reynolds' equation where a liquid could only be pulled.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum Cavitation {
    /// A penalty keeps pressures from going negative, (2.36); what it leaves of them goes with 1/γ̄.
    #[default]
    Penalty,
    /// P ≥ 0, a multiplier λ ≥ 0 joins Reynolds' equation, and P λ = 0 at every node (appendix D).
    Complementarity,
    /// P ≥ 0, and where P = 0 the gap is filled to a fraction θ ≤ 1, by which it carries what flows in (Elrod and
    /// Adams).
    MassConserving {
        /// Thickness of the film that the surfaces bring to the inlet, in metres; without one the inlet is flooded.
        #[serde(rename = "supply_film", default)]
        supply_film_m: Option<f64>,
    },
}

impl Cavitation {
    /// Its words in sentences.
    pub fn name(self) -> &'static str {
        match self {
            Self::Penalty => "penalty",
            Self::Complementarity => "complementarity",
            Self::MassConserving { .. } => "mass-conserving",
        }
    }

    /// Refuses a supply that is no film.
    ///
    /// # Errors
    /// When it is not a thickness above zero.
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

    /// Thickness of the film that the surfaces bring to the inlet \[m\]; none where the inlet is flooded.
    pub fn supply_film_m(self) -> Option<f64> {
        match self {
            Self::MassConserving { supply_film_m } => supply_film_m,
            Self::Penalty | Self::Complementarity => None,
        }
    }
}
