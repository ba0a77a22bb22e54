//! Kinds of contact.

use serde::{Deserialize, Serialize};

/// Kind of contact: an infinitely long line contact, or a circular or elliptical point contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum ContactKind {
    /// Line contact: loads in N/m, unknowns along X only.
    #[default]
    Line,
    /// Point contact, circular or elliptical: loads in N.
    Point,
}

impl ContactKind {
    /// Returns its name in options and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Point => "point",
        }
    }
}
