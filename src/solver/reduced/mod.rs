//! Reduced models: POD bases, row sampling, reduced operators and the online Newton iteration without large-scale work.

mod model;
mod online;

pub use model::{Domain, PodBasis, ReducedModel, Sampling, Snapshot, Trust, Window};
pub use online::{Online, ReducedError, ReducedOptions, ReducedSolution};
