//! The reduced operators of one window for a chosen truncation. Nothing in them is of large scale.

mod assembled;
mod front;
mod heat;
mod least_squares;
mod newton;
mod shaped;
mod support;
mod traction;
mod turns;

pub(crate) use assembled::Operators;
pub(crate) use front::{cut_off, fronts, passed_rows};
pub(crate) use heat::{Stations, carried};
pub(crate) use newton::{Case, Iterate, OnlineOutcome, RowObserver, Stop};
pub use traction::RuleTraction;
