//! Discrete Reynolds equation (2.31): one row at one node (`row`), the integrals across the film of a generalized
//! row, and the upwind stencils of a line contact.

pub mod film_integrals;
pub mod generalized;
pub mod line;
mod row;

pub use row::{CENTER, EAST, NORTH, Node, PENALTY, Row, RowGeometry, SOUTH, STENCIL, WEST, WEST2, row};
