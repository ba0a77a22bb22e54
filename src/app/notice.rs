//! A sentence about how something ended.

use std::fmt::Display;

/// A sentence about how something ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Notice {
    /// As it should.
    Done(String),
    /// Worth knowing.
    Short(String),
    Wrong(String),
}

impl Notice {
    /// Something went wrong for a reason.
    pub fn wrong(reason: impl Display) -> Self {
        Self::Wrong(reason.to_string())
    }
}
