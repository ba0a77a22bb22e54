//! Dependence of density and viscosity on pressure.

use super::free_volume::{Doolittle, Tait};
use serde::{Deserialize, Serialize};

/// Pressure \[Pa\] below which the laws are constant. Only intermediate Newton iterates have lower pressures.
pub const CAVITATION_FLOOR_PA: f64 = -1e7;

/// Roelands' reference pressure p_Roe \[Pa\], (2.12).
pub const ROELANDS_PRESSURE_PA: f64 = 1.96e8;

/// Upper limit of ln(η/η₀). Beyond it the lubricant is effectively solid, and exp would overflow.
pub(super) const LOG_VISCOSITY_CEILING: f64 = 250.0;

/// Density law: dependence of the density on pressure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum DensityLaw {
    /// ρ = ρ₀.
    Incompressible,
    /// (2.10), Dowson & Higginson 1966; mineral oils to about 1 GPa, saturates at 1.34 ρ₀.
    #[default]
    DowsonHigginson,
    /// (3.37), (3.38).
    Tait(Tait),
}

/// Viscosity law: dependence of the viscosity on pressure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum ViscosityLaw {
    /// (2.11), Barus 1893: η = η₀ exp(αp); overestimates the viscosity above about 0.5 GPa.
    Barus,
    /// (2.12), Roelands 1966, with p_Roe = 0.196 GPa and ln η₀ + 9.67 > 0.
    #[default]
    Roelands,
    /// (3.39); its α is not a free constant but follows from the law.
    Doolittle(Doolittle),
}

impl ViscosityLaw {
    /// Returns the ambient viscosity \[Pa·s\] that must be exceeded for Roelands' law.
    pub fn thinnest_of_roelands() -> f64 {
        (0.05f64 - 9.67).exp()
    }
}
