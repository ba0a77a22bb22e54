//! Requests to the engine and their results: the picture, the full solution that checks it, or the reason why there
//! is none.
//!
//! An [`ask::Ask`] is read from the document in every frame. The reduced model usually returns the picture within
//! the frame. If no model covers the contact, the full solver computes it in a worker. When the sliders are idle, a
//! full solution checks the reduced one. [`Answers`] is a state machine: events change it, and all other code reads
//! it through functions.

mod ask;
mod event;
mod failure;
pub mod grid_error;
pub mod jobs;
pub mod live;
pub mod picture;
mod pins;
mod runner;
mod state;
mod times;
mod work;

pub use ask::REST_S;
pub use failure::PassedOver;
pub use pins::{MOST_PINS, Pin};
pub use state::Answers;
