//! Transient contacts: inputs that vary in time, second-order time integration, three frames, and the resulting
//! trajectory.
//!
//! [`march()`] advances any [`Marching`] model in time, independent of how a step is solved. [`solve`] does so with
//! the full system. All scalars of a [`Trajectory`] are in the scales of the reference contact in every frame, so
//! that trajectories can be compared. Its fields are in the frame's own scales.

mod check;
mod difference;
mod frame;
mod grid_cost;
mod history;
mod march;
mod mass;
mod pace;
mod response;
#[cfg(test)]
mod rough_tests;
mod signal;
mod space;
mod spline;
mod step_error;
mod surface;
mod system;
#[cfg(test)]
mod tests;
mod trajectory;
mod unsupported;

pub use difference::{BackwardDifference, extrapolated};
pub use frame::{Conditions, Frame, Scales, point_at};
pub use history::History;
pub use march::{Keep, MarchProgress, Marching, Step, Transient, TransientError, TransientObserver, march};
pub use mass::MassBalance;
pub use pace::TimeStep;
pub(crate) use pace::{GREATEST_RATIO, MOST_PARTS, ROUNDING};
pub use signal::{Input, InputError, Inputs, Signal};
pub use spline::{Interpolated, Interpolation};
pub use surface::{MovingSurface, Scheme, Shape, SurfaceError};
pub use system::{FullMarch, solve};
pub use trajectory::{Effort, Ended, Moment, Quantity, State, Trajectory};
pub use unsupported::Unsupported;
