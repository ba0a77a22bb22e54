//! Grids, elastic deformation, and the discrete Reynolds and energy equations.

pub mod elasticity;
pub mod grid;
pub mod half_space;
pub mod heat;
pub mod nodes;
pub mod reynolds;
pub mod rough;
pub mod space;
