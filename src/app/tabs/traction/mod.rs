//! Traction and film thickness along one quantity, and the laws of the fluid.

mod axes;
mod chart;
mod curve;
pub mod export;
mod fluid;
mod served;
mod sweep;
mod sweeps;
mod tab;

pub use curve::Curve;
pub use served::{Served, sweep};
pub use sweep::{Against, Companion, Sample, Sweep, Varied};
pub use tab::Traction;
