//! Reduced models of transient contacts (RNSA): Galerkin projection on bases of trajectories, equations sampled by
//! cubature, and Newton's method in every step.
//!
//! The march is that of the full system ([`crate::solver::full::transient::march`]). The cost of a step depends only on
//! the numbers of modes and sampled equations. Only a remeshed frame needs the mass flow ρ̄H at all nodes once per
//! step, for the spline interpolation to the next grid. States of a long march have little in common. So a model may
//! have local bases, each with its own sampled equations, and a step uses the one with the nearest centre.

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
