//! Grids, the discrete Reynolds equation on them, and how they deform.

pub mod elasticity;
pub mod grid;
pub mod heat;
pub mod nodes;
pub mod reynolds;
pub mod space;
