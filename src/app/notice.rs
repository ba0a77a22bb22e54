//! Notice about the result of an action.

use std::fmt::Display;

/// Notice about the result of an action.
#[derive(Clone, Debug, PartialEq)]
pub enum Notice {
    /// Success.
    Done(String),
    /// Result with a reservation.
    Short(String),
    Wrong(String),
}

impl Notice {
    /// Creates the notice of a failure from its reason.
    pub fn wrong(reason: impl Display) -> Self {
        Self::Wrong(reason.to_string())
    }
}
