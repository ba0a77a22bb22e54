//! Trajectory-piecewise-linear models of transient contacts (2.2.4, 4.2): a weighted sum of reduced linearised systems.
//!
//! The full system is d/dT g(z, u) = f(z, u), (4.16), with the mass flow g = ρ̄H, the state z and the inputs u. Along
//! training trajectories both functions are linearised in state and inputs and reduced, (4.17) to (4.26). A step
//! superposes the systems of the operating points near the state and solves one small linear system. Deformation and
//! load are linear and condensed, so the reduced state is ỹ = (p̃, H₀): pressure coefficients and rigid-body
//! separation.

mod grid;
mod linearisation;
mod march;
mod model;
mod record;
mod search;
mod selection;
mod space;
mod superposition;
#[cfg(test)]
mod tests;
mod weights;

pub use grid::{Plane, SpaceGrid};
pub use linearisation::{LinearFunction, Linearisation, SystemFunctions};
pub use march::{TpwlMarch, solve};
pub use model::{ParameterSet, TpwlError, TpwlModel, TpwlTraining, TrainedPoint};
pub use record::{TpwlRecord, TpwlStep};
pub use selection::{Selection, TrainedMoment};
pub use space::{INPUTS, ReducedSpace, input_vector};
pub use weights::{Weight, Weighting};
