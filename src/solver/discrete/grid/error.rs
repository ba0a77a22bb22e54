//! Reasons for refusing a grid.

use crate::solver::discrete::elasticity::KernelError;
use crate::solver::limits::Number;

/// Maximum memory \[bytes\] of a point grid's kernel and factors.
pub const MAX_BYTES: f64 = 3e9;

/// Reason for refusing a grid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GridError {
    /// Its domain cuts the contact, or it has too few, too many or too widely spaced nodes. Contains the message.
    #[error("{0}")]
    Refused(String),
    /// The elastic kernel cannot be computed.
    #[error(transparent)]
    Kernel(#[from] KernelError),
}

impl GridError {
    /// Creates the error of a line contact's grid whose number of nodes is not accepted.
    pub(super) fn nodes(nodes: f64, max: usize) -> Self {
        let nodes = Number(nodes);
        Self::Refused(format!("the grid would have {nodes} nodes; between 61 and {max} are accepted"))
    }
}
