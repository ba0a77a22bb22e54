//! Full solves for the picture.

mod request;
mod solves;

pub use request::{FullSolve, GridChoice, JobKind, Outcome};
pub use solves::{Jobs, Running};
