//! The reduced basis: singular values, modes, sampled equations.

mod curves;
mod field;
mod given_modes;
mod in_time;
mod losses;
mod modes;
mod plane;
mod sizes;
mod tab;

pub use given_modes::ModesTask;
pub use tab::Basis;
