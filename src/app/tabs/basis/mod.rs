//! The reduced basis: singular values, modes, sampled equations.

mod curves;
mod field;
mod in_time;
mod losses;
mod modes;
mod plane;
mod sizes;
mod tab;

pub use tab::Basis;
