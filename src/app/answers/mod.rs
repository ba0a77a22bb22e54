//! What has been asked of the engine and what came of it: the picture, the truth about it, or why there is none.
//!
//! An [`ask::Ask`] is read off the document in every frame. It is answered by the reduced model, as a rule within the frame,
//! else by the full solver in a worker; when the sliders rest, a full solution checks the reduced one. [`Answers`] is a
//! state machine: events change it, and everybody else reads it through functions.

mod ask;
mod event;
mod failure;
pub mod grid_error;
pub mod jobs;
mod live;
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
