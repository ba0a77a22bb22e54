//! Reduced operators of one local model for chosen numbers of modes, composed of parts. Nothing in them is of large
//! scale.

mod asperities;
mod assembled;
mod case;
mod deformation;
mod equations;
mod front;
mod heat;
mod least_squares;
mod newton;
mod part;
mod parts;
mod readings;
mod sampled_system;
mod shaped;
mod support;
mod tangent;
#[cfg(test)]
mod tests;
mod traction;

pub(crate) use assembled::Operators;
pub(crate) use case::{Case, Start, Stop};
pub(crate) use front::{cut_off, fronts, passed_rows};
pub(crate) use heat::{Stations, carried};
pub(crate) use newton::{Iterate, OnlineOutcome, RowObserver};
pub(crate) use part::Flow;
pub use readings::RuleTraction;
