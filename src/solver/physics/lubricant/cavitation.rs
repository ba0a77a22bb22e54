//! How a film ruptures where the gap opens.

use serde::{Deserialize, Serialize};

/// What replaces Reynolds' equation where a liquid could only be pulled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum Cavitation {
    /// A penalty keeps pressures from going negative, (2.36); what it leaves of them goes with 1/γ̄.
    #[default]
    Penalty,
    /// P ≥ 0, a multiplier λ ≥ 0 joins Reynolds' equation, and P λ = 0 at every node (appendix D).
    Complementarity,
}

impl Cavitation {
    /// Its words in sentences.
    pub fn name(self) -> &'static str {
        match self {
            Self::Penalty => "penalty",
            Self::Complementarity => "complementarity",
        }
    }
}
