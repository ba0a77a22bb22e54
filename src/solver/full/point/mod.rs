//! Point contacts: step control, preconditioner and accuracy of the film thickness.

mod accuracy;
mod block_tridiagonal;
mod limited_steps;
mod preconditioner;
#[cfg(test)]
mod tests;

pub use accuracy::{Accuracy, Estimate, resolution_warning, second_grid, side_lobe_curvature, side_lobe_error};
pub(super) use block_tridiagonal::BlockTridiagonal;
pub use limited_steps::{Cycles, LimitedSteps};
pub use preconditioner::PlaneMatrix;
pub(super) use preconditioner::{KernelColumns, REACH};
