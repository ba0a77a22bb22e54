//! Thermal contacts. Newton steps for pressure and film thickness at fixed temperatures alternate with marches of the
//! temperatures along the lines of the grid at fixed pressure and film thickness.

mod coupled;
mod mixing;
#[cfg(test)]
mod plane_tests;
mod spike;
mod temperatures;
#[cfg(test)]
mod tests;
mod turns;

pub(in crate::solver) use coupled::one_sided;
pub(in crate::solver) use mixing::Mixing;
pub(in crate::solver) use temperatures::{NodeArrays, mid_stress_pa};
pub use temperatures::{Rises, Temperatures};
pub(super) use turns::solve;
