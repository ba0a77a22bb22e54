//! Reduced models of contacts in time (RNSA): Galerkin's projection on bases of trajectories, rows by cubature, Newton
//! in every step.
//!
//! The march is that of the full system ([`crate::solver::full::transient::march`]); what a step costs depends on the
//! modes and the sampled rows alone. Only a remeshed frame needs ρ̄H at all nodes once per step, for the spline that
//! carries it to the next grid. A long march passes states that have little in common: a model may have local bases, each
//! with rows of its own, and a step takes the one whose centre is nearest.

mod coupled;
mod domain;
mod model;
mod nearest;
mod part;
mod steps;

pub use coupled::{CoupledError, CoupledMarch, MOST_PARTS_AT_ONCE, MarchState};
pub use domain::{Reach, TrajectoryDomain, only_course};
pub use model::{LocalBasis, TrajectoryModel, TrajectoryStart};
pub(crate) use nearest::HYSTERESIS;
pub use steps::ReducedMarch;
