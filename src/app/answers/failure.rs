//! Reasons why there is no picture for the sliders, and why the reduced model does not draw it.

use crate::app::document::Key;
use crate::solver::full::Report;

/// Reason why there is no picture for the sliders.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Parameters of the failed solve.
    pub key: Key,
    /// Reason as a sentence.
    pub message: String,
    /// Report of the solve as far as it ran.
    pub report: Option<Report>,
    /// True after a stop request. The failure then says nothing about the contact.
    pub stopped: bool,
}

/// Reason why the full solver draws the picture.
#[derive(Clone, Debug, PartialEq)]
pub enum PassedOver {
    /// There is no reduced model.
    NoModel,
    /// The reduced model is still being read.
    Reading,
    /// The reduced model was not trained for this contact. With the reason as a sentence.
    Outside(String),
    /// The reduced model did not converge. With the reason as a sentence.
    Failed(String),
}
