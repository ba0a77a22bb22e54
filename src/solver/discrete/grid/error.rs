//! Why a grid is refused.

use crate::solver::discrete::elasticity::KernelError;
use crate::solver::limits::Number;

/// Most memory \[bytes\] a point grid's kernel and factors may take.
pub const MAX_BYTES: f64 = 3e9;

/// Why a grid is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GridError {
    /// Its domain cuts the contact, or its nodes are too few, too many or too far apart: a sentence.
    #[error("{0}")]
    Refused(String),
    /// The elastic kernel cannot be made.
    #[error(transparent)]
    Kernel(#[from] KernelError),
}

impl GridError {
    /// A number of nodes of a line contact's grid that is not accepted.
    pub(super) fn nodes(nodes: f64, max: usize) -> Self {
        let nodes = Number(nodes);
        Self::Refused(format!("the grid would have {nodes} nodes; between 61 and {max} are accepted"))
    }
}
