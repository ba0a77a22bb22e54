//! Errors of the contact, of the model over its range, and of the last solve.

mod along;
mod failure_map;
mod parts;
mod random_tests;
mod residuals;
mod split;
mod tab;
mod truth;
mod worst;

pub use tab::Accuracy;
