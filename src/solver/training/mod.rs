//! Training of reduced models: sampling plans, full solutions in parallel, bases, sampled equations.
//!
//! The same specification gives the same model: all random numbers follow from its seed, and parallel work is
//! collected in order.

mod adaptive;
mod anchors;
mod bases;
mod build;
mod calibrate;
mod cell;
mod check;
#[cfg(test)]
mod coupled_tests;
pub mod distance;
#[cfg(test)]
mod ellipse_tests;
mod error;
#[cfg(test)]
mod error_split_tests;
#[cfg(test)]
mod heat_tests;
mod indicator;
mod layout;
mod local_bases;
mod observer;
#[cfg(test)]
mod oil_tests;
mod one_thread;
mod plan;
#[cfg(test)]
mod point_tests;
pub(crate) mod responses;
#[cfg(test)]
mod responses_tests;
#[cfg(test)]
mod resume_tests;
#[cfg(test)]
mod rough_circle_tests;
#[cfg(test)]
mod rough_tests;
mod rows;
#[cfg(test)]
mod rupture_tests;
mod search;
#[cfg(test)]
mod sliding_oil_tests;
#[cfg(test)]
pub(crate) mod small;
mod spec;
mod split;
mod state;
#[cfg(test)]
mod tests;
mod traction;
mod train;
mod trajectories;
#[cfg(test)]
mod trajectories_tests;
mod trajectory_rows;

pub use crate::solver::observer::{Observer, Progress};
pub use error::TrainingError;
pub use local_bases::LocalBases;
pub use observer::TrainingObserver;
pub use one_thread::on_one_thread;
pub use plan::{random_points, random_points_while};
pub use responses::{ResponseBasis, ResponseTraining};
pub use rows::with_rows;
pub use search::{BadPoint, Search};
pub use spec::{EVIDENCE, Indicator, Plan, TrainingSpec, WindowSpec, Windows};
pub use state::{Solved, TrainingState, WindowState};
pub use train::{train, train_resumable};
pub use trajectories::{TrajectoryTraining, train_trajectories};
