//! Density and viscosity laws with their exact derivatives, sources and ranges of validity.
//!
//! A [`Lubricant`] selects the laws. [`Lubricant::scaled`] computes their constants at one operating point and
//! evaluates them in the solver's variable P = p/p_H, where p_H is the Hertzian pressure. Slightly negative
//! pressures, which reach about −1e-5 p_H with the penalty, use the analytic laws. Below [`CAVITATION_FLOOR_PA`] the
//! laws are constant, so that no Newton iterate leaves their range.

mod cavitation;
mod definition;
mod elementary;
mod error;
mod free_volume;
mod heat;
mod heat_reduction;
mod laws;
mod pressure_coefficient;
mod scaled;
mod shear_thinning;
mod warm;
mod words;

pub use super::contact::Sliding;
pub use cavitation::Cavitation;
pub use definition::Lubricant;
pub(crate) use definition::{LubricantOfModel, WholeLubricant};
pub use error::LubricantError;
pub use free_volume::{Doolittle, Tait};
pub use heat::{FreeVolumeHeat, Heat, LARGEST_HEATED_SRR, OilHeat, ScaledHeat};
pub use heat_reduction::HeatReduction;
pub use laws::{CAVITATION_FLOOR_PA, DensityLaw, ROELANDS_PRESSURE_PA, ViscosityLaw};
pub use pressure_coefficient::GAUSS_6;
pub use scaled::{FluidState, ScaledFluid, roelands_exponent};
pub use shear_thinning::{Fluidity, LimitingStress, ScaledShear, ShearLaw};
pub use warm::{Across, WarmFluid};
