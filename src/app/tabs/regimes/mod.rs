//! The M–L chart and the published film formulas.

pub mod chart;
mod tab;
mod trail;

pub use tab::Regimes;
