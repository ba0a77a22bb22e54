//! M–L chart and published film formulas.

pub mod chart;
mod tab;
mod trail;

pub use tab::Regimes;
