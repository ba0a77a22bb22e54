//! Where random operating points are drawn.

use crate::solver::training::{QuantityBox, SlidingRange};
use serde::{Deserialize, Serialize};

/// Where random points are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum TestRange {
    /// A box of SI quantities, (3.17) in each.
    Box(QuantityBox),
    /// M and L in the default realisation, (3.17) in ln M and L; points beyond the pressure are drawn again.
    Realisation {
        /// Load number.
        m: (f64, f64),
        /// Lubricant number.
        l: (f64, f64),
        /// Largest Hertzian pressure \[Pa\].
        max_hertz_pressure: f64,
    },
    /// M, L and α at the default R (3 mm line, 10 mm point) and E′ = 231 GPa, (3.17) in ln M, L and α; points beyond the pressure are drawn again.
    Moes {
        /// Load number.
        m: (f64, f64),
        /// Lubricant number.
        l: (f64, f64),
        /// Pressure–viscosity coefficient \[1/Pa\].
        alpha: (f64, f64),
        /// Largest Hertzian pressure \[Pa\].
        max_hertz_pressure: f64,
        /// Viscosity at ambient pressure \[Pa·s\].
        viscosity: f64,
    },
    /// M, L, SRR and NPR of a shear-thinning lubricant, (3.17) in ln M, L, SRR and NPR; points beyond the pressure are drawn again.
    Sliding(SlidingRange),
}
