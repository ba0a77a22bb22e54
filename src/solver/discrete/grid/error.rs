//! Why a grid is refused.

use crate::solver::discrete::elasticity::KernelError;

/// Most memory \[bytes\] a point grid's kernel and factors may take.
pub const MAX_BYTES: f64 = 3e9;

/// Why a grid is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GridError {
    /// The domain of a line contact does not hold the contact.
    #[error(
        "the domain {from}…{to} cuts the contact; its inlet must lie between −200 and −1.5 and its outlet between 1.2 and 20"
    )]
    Domain {
        /// Inlet.
        from: f64,
        /// Outlet.
        to: f64,
    },
    /// Too few or too many nodes.
    #[error("the grid would have {nodes} nodes; between {min} and {max} are accepted")]
    Size {
        /// Nodes asked for.
        nodes: f64,
        /// Fewest accepted.
        min: usize,
        /// Most accepted.
        max: usize,
    },
    /// The half domain of a point contact does not hold the contact.
    #[error(
        "the half domain {from} ≤ X ≤ {to}, {edge} ≤ Y ≤ 0 cuts the contact; its inlet must lie between −50 and −1.5, its outlet between 1.2 and 20, its edge between −20 and −1.2"
    )]
    HalfDomain {
        /// Inlet.
        from: f64,
        /// Outlet.
        to: f64,
        /// Outer edge.
        edge: f64,
    },
    /// The refinement is none.
    #[error("the refinement of the side lobes is {0}, but must lie between 1 (equidistant) and 8")]
    Refinement(f64),
    /// The spacing is no spacing, or too wide for the contact.
    #[error("{name} is {spacing}, but must lie between 1e-4 and {widest}: fewer nodes cannot hold the contact")]
    Spacing {
        /// Which spacing.
        name: &'static str,
        /// Its value.
        spacing: f64,
        /// Widest accepted.
        widest: f64,
    },
    /// The kernel and the factors would not fit into memory.
    #[error(
        "a grid of {nx}×{ny} nodes would need {:.1} GB of memory; at most {:.1} GB are accepted: take a wider spacing, above all across (dy)",
        bytes / 1e9, MAX_BYTES / 1e9
    )]
    Memory {
        /// Nodes along X.
        nx: usize,
        /// Nodes across.
        ny: usize,
        /// Bytes needed.
        bytes: f64,
    },
    /// The elastic kernel cannot be made.
    #[error(transparent)]
    Kernel(#[from] KernelError),
}
