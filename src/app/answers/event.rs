//! Events of the state machine of the answers, and the computations that it requests.

use super::ask::Ask;
use super::failure::PassedOver;
use super::jobs::{JobKind, Outcome};
use super::picture::Cuts;
use crate::app::document::Key;
use crate::engine::Answer;
use crate::solver::discrete::grid::GridSpec;

/// Event that changes the answers.
pub enum Event {
    /// The document requests something else. With the time \[s\], and the reason if its reduced model is not even
    /// tried.
    Asked(Ask, Option<PassedOver>, f64),
    /// Full solutions of the present line contact use another grid from now on: the grid of the model in use.
    LineGrid(Option<GridSpec>),
    /// The reduced model has returned a solution.
    Reduced(Ask, Box<Answer>),
    /// The reduced solve was cancelled.
    ReducedStopped(Ask),
    /// The reduced model has found no solution. With the reason as a sentence.
    ReducedFailed(Ask, String),
    /// A full solve of a contact has ended.
    Full(JobKind, Key, Outcome),
    /// Point contacts are cut at another place.
    Cut(Cuts),
    /// The sliders have been idle for [`super::REST_S`].
    Rested,
    /// The user requested a full solution.
    VerificationAsked,
    /// The user requested an estimate of the discretisation error.
    EstimateAsked,
    /// Other models are in use.
    ModelsChanged,
}

/// Computation that the present request needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wish {
    /// A reduced solution.
    Reduced,
    /// A full solution.
    Full(JobKind),
}
