//! Pressure and film thickness against X.

mod curves;
mod film_shear;
mod plots;
mod stress;
mod tab;
mod temperatures;
mod why;

pub use stress::StressTask;
pub use tab::{Profiles, with_difference};
