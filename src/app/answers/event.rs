//! What can happen to the answers, and what is to be computed then.

use super::ask::Ask;
use super::failure::PassedOver;
use super::jobs::{JobKind, Outcome};
use super::picture::Cuts;
use crate::app::document::Key;
use crate::engine::Answer;
use crate::solver::discrete::grid::GridSpec;

/// What happened.
pub enum Event {
    /// The document asks for something else, at a time \[s\]; and why its reduced model is not even tried, if it is not.
    Asked(Ask, Option<PassedOver>, f64),
    /// Full solutions of the present line contact lie on another grid from now on: that of the model in use.
    LineGrid(Option<GridSpec>),
    /// The reduced model has answered.
    Reduced(Ask, Box<Answer>),
    /// The reduced solve was cancelled.
    ReducedStopped(Ask),
    /// The reduced model has found no solution; a sentence says why.
    ReducedFailed(Ask, String),
    /// A full solve of a contact has ended.
    Full(JobKind, Key, Outcome),
    /// Point contacts are cut elsewhere.
    Cut(Cuts),
    /// The sliders have rested for [`super::REST_S`].
    Rested,
    /// A full solution was asked for by hand.
    VerificationAsked,
    /// An estimate of the discretisation error was asked for.
    EstimateAsked,
    /// Other models are in use.
    ModelsChanged,
}

/// What is to be computed for the present ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wish {
    /// A reduced solution.
    Reduced,
    /// A full solution.
    Full(JobKind),
}
