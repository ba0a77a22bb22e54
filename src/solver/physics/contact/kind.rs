//! The kinds of contact.

use serde::{Deserialize, Serialize};

/// The shape of the contact: an infinitely long line or a circular point contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum ContactKind {
    /// Line contact: loads in N/m, unknowns along X only.
    #[default]
    Line,
    /// Point contact, a circle or an ellipse: loads in N.
    Point,
}

impl ContactKind {
    /// The word that stands for it in options and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Point => "point",
        }
    }
}
