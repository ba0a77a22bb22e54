//! How density and viscosity depend on pressure.

use super::free_volume::{Doolittle, Tait};
use serde::{Deserialize, Serialize};

/// Pressure \[Pa\] under which laws are frozen: no physical state, only passing Newton iterates, gets there.
pub const CAVITATION_FLOOR_PA: f64 = -1e7;

/// Roelands' reference pressure p_Roe \[Pa\], (2.12).
pub const ROELANDS_PRESSURE_PA: f64 = 1.96e8;

/// Largest ln(η/η₀) that is evaluated: beyond it the fluid is a solid for every purpose of the discretisation, and exp
/// would overflow.
pub(super) const LOG_VISCOSITY_CEILING: f64 = 250.0;

/// How density depends on pressure.
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

/// How viscosity depends on pressure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum ViscosityLaw {
    /// (2.11), Barus 1893: η = η₀ exp(αp); overestimates above some 0.5 GPa.
    Barus,
    /// (2.12), Roelands 1966, with p_Roe = 0.196 GPa and ln η₀ + 9.67 > 0.
    #[default]
    Roelands,
    /// (3.39); its α is no free constant but follows from it.
    Doolittle(Doolittle),
}

impl ViscosityLaw {
    /// Ambient viscosity \[Pa·s\] that Roelands' law must exceed.
    pub fn thinnest_of_roelands() -> f64 {
        (0.05f64 - 9.67).exp()
    }
}
