//! The full-order system: unknowns (P, H₀), deformation condensed, solved by Newton's method with a preconditioned Krylov solver.

mod attempts;
mod band;
mod contact_solver;
mod cut;
pub mod dense;
mod gmres;
mod line;
pub mod point;
mod shear;
mod solution;
mod start;
#[cfg(test)]
mod tests;
mod traction;
pub mod transient;

pub use contact_solver::ContactSolver;
pub use line::{LineSystem, SolveOptions};
pub use point::{PointOptions, PointSolver, PointSystem};
pub(crate) use solution::under_contact;
pub use solution::{
    Mesh, Problem, Report, Scalars, Solution, SolveError, Termination, Traction, point_scalars_of, scalars_of,
};
pub use start::{FullSolver, Start};
pub(crate) use traction::mid_film_stress;
pub use traction::{PLAUSIBLE_EXPONENT, Shear};
