//! Choice of the density law and of the viscosity law of a lubricant, and the limits of these laws. Equation numbers
//! are those of the dissertation.

use super::free_volume::{Doolittle, Tait};
use serde::{Deserialize, Serialize};

/// Pressure \[Pa\] below which density and viscosity are constant. Lower pressures occur in intermediate Newton
/// iterates only.
pub const CAVITATION_FLOOR_PA: f64 = -1e7;

/// Roelands' reference pressure p_Roe \[Pa\], (2.12).
pub const ROELANDS_PRESSURE_PA: f64 = 1.96e8;

/// Upper limit of ln(η/η₀). The lubricant is effectively solid there. The limit prevents an overflow of exp.
pub(super) const LOG_VISCOSITY_CEILING: f64 = 250.0;

/// Dependence of the density ρ on the pressure p. ρ₀ is the density at ambient pressure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum DensityLaw {
    /// Constant density, ρ = ρ₀.
    Incompressible,
    /// Dowson & Higginson 1966, (2.10): for mineral oils up to about 1 GPa. The density approaches 1.34 ρ₀.
    #[default]
    DowsonHigginson,
    /// Density from Tait's equation of state, (3.37) and (3.38).
    Tait(Tait),
}

/// Dependence of the viscosity η on the pressure p. η₀ \[Pa·s\] is the viscosity at ambient pressure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum ViscosityLaw {
    /// Barus 1893, (2.11): η = η₀ exp(αp). Overestimates the viscosity above about 0.5 GPa.
    Barus,
    /// Roelands 1966, (2.12), with p_Roe = 0.196 GPa. Defined for ln η₀ + 9.67 > 0.
    #[default]
    Roelands,
    /// Doolittle 1951, (3.39). The pressure–viscosity coefficient α is not an input but follows from the law.
    Doolittle(Doolittle),
}

impl ViscosityLaw {
    /// Returns the lower limit of the ambient viscosity η₀ \[Pa·s\] for Roelands' law. At the limit ln η₀ + 9.67 is
    /// 0.05.
    pub fn thinnest_of_roelands() -> f64 {
        (0.05f64 - 9.67).exp()
    }
}
