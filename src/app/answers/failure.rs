//! Why the picture is not what the sliders say, and why the reduced model does not draw it.

use crate::app::document::Key;
use crate::solver::full::Report;

/// Why the picture is not what the sliders say.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The parameters that failed.
    pub key: Key,
    /// A sentence.
    pub message: String,
    /// How far the solve got.
    pub report: Option<Report>,
    /// True after a stop request: the failure then says nothing about the contact.
    pub stopped: bool,
}

/// Why the full solver draws the picture.
#[derive(Clone, Debug, PartialEq)]
pub enum PassedOver {
    /// There is no reduced model.
    NoModel,
    /// It is being read.
    Reading,
    /// It was not trained for this contact; a sentence says why.
    Outside(String),
    /// It did not converge; a sentence says how.
    Failed(String),
}
