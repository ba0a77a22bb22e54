//! Time derivative ∂(ρ̄H)/∂T of a periodic change, exact or as a march computes it.

use crate::solver::discrete::reynolds::{CENTER, WEST, WEST2};
use realfft::num_complex::Complex64;
use serde::{Deserialize, Serialize};

/// Time derivative of a change e^(iΩT).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum TimeDerivative {
    /// iΩ.
    #[default]
    Exact,
    /// Backward difference (2.34) with equal steps ΔT, as a march with the scheme `Bdf2` computes it.
    Bdf2 {
        /// Step ΔT.
        step: f64,
    },
    /// Backward difference along the characteristics X − T = const, which replaces the derivatives by X and by T
    /// together. Requires a uniform grid with ΔX = ΔT.
    Characteristic {
        /// Step ΔT = ΔX.
        step: f64,
    },
}

impl TimeDerivative {
    /// Returns what the time derivative adds to the steady upwind weights of ρ̄H at [`WEST2`], [`WEST`] and
    /// [`CENTER`].
    pub fn added_weights(self, upwind: [f64; 3], omega: f64) -> [Complex64; 3] {
        let zero = Complex64::ZERO;
        match self {
            Self::Exact => [zero, zero, Complex64::new(0.0, omega)],
            Self::Bdf2 { step } => {
                let [once, twice] = [1.0, 2.0].map(|steps| Complex64::cis(-steps * omega * step));
                [zero, zero, (1.5 - 2.0 * once + 0.5 * twice) / step]
            }
            Self::Characteristic { step } => {
                let mut added = [zero; 3];
                for (node, steps) in [(WEST2, 2.0), (WEST, 1.0)] {
                    added[node] = upwind[node] * (Complex64::cis(-steps * omega * step) - 1.0);
                }
                added[CENTER] = zero;
                added
            }
        }
    }
}
