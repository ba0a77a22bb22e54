//! Rough surfaces: composite roughness, flow between two rough surfaces, and pressure of their asperities.
//!
//! All laws depend on the separation l = h/σ. h is the distance of the mean planes of both surfaces, and σ the composite
//! rms roughness. h is negative if the asperities are compressed below the mean planes.

mod asperity_laws;
mod asperity_table;
mod finish;
mod flow_factors;
mod mean_gap;
mod profile;
mod roughness;
mod scaled;
#[cfg(test)]
mod tests;

pub use asperity_laws::AsperityLaw;
pub use asperity_table::AsperityTable;
pub use finish::{FINISHES, Finish, HeightMeasure};
pub use flow_factors::{FlowFactors, PEKLENIK};
pub use mean_gap::{mean_gap, separation_of_gap};
pub use profile::{HeightProfile, ProfileError, ProfileStatistics};
pub use roughness::{LARGEST_RMS, Roughness, SurfaceConstant, SurfaceError};
pub use scaled::ScaledRoughness;
