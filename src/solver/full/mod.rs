//! Full-order system of a contact. Its unknowns are the pressure P and the rigid-body separation H₀; the deformation
//! is eliminated. Newton's method with a preconditioned Krylov solver solves it.

mod active_set;
mod band;
mod cut;
pub mod dense;
mod far_field;
mod film_fraction;
mod gmres;
mod grid_cost;
pub mod heat;
mod line;
mod mesh;
mod mixed;
mod newton_space;
pub mod point;
mod problem;
mod report;
pub mod response;
mod rolling;
mod rough;
mod solution;
mod solver;
mod subsurface;
mod system;
#[cfg(test)]
mod tests;
mod thinning;
mod traction;
pub mod transient;
mod trust;
mod walk;

pub use crate::solver::warning::PLAUSIBLE_TRACTION;
pub use grid_cost::{GridCost, grid_doubts};
pub use line::Backtracking;
pub use mesh::Mesh;
pub use mixed::{Lubrication, Mixed};
pub use newton_space::Turn;
pub use point::LimitedSteps;
pub use problem::{Problem, SolveError};
pub use report::{Report, Termination};
pub(crate) use solution::under_contact;
pub use solution::{Scalars, Solution, Traction, scalars_of};
pub use solver::{ContactSolver, FullSolver, PointSolver, Solver, Start, most_newton};
pub use subsurface::{StressMaximum, SubsurfaceStress};
pub use system::{SolveOptions, System};
pub(crate) use traction::mid_film_stresses;
pub use traction::{Shear, TractionDoubt};
pub use walk::most_walked;
