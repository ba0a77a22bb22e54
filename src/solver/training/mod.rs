//! Making reduced models: sampling plans, snapshots in parallel, bases, row sampling.
//!
//! The same specification gives the same model: everything random comes from its seed, and parallel work is collected in order.

mod build;
mod plan;
mod rows;
#[cfg(test)]
mod tests;

pub use build::train;
pub use plan::{farthest_points, grid_points, random_points, test_point};

use super::lubricant::Lubricant;
use super::reduced::Sampling;
use serde::{Deserialize, Serialize};

/// Where the training solutions are taken.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Plan {
    /// Farthest point by (3.16) with the distance (3.20).
    FarthestPoint {
        /// Number of full solutions (per window).
        snapshots: usize,
    },
    /// A tensor grid over the box, Table 3.2: nodes of R, u_m, w (logarithmic), α.
    Grid {
        /// Nodes along radius, speed, load and alpha.
        nodes: [usize; 4],
    },
}

/// What a model is trained for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Range {
    /// A box of SI quantities, (3.16): R \[m\], u_m \[m/s\], w \[N/m\], α \[1/Pa\] at fixed E′ and η₀. Table 3.1.
    Box {
        /// Smallest and largest radius \[m\].
        radius: (f64, f64),
        /// Smallest and largest speed \[m/s\].
        speed: (f64, f64),
        /// Smallest and largest load \[N/m\].
        load: (f64, f64),
        /// Smallest and largest α \[1/Pa\].
        alpha: (f64, f64),
        /// E′ \[Pa\].
        modulus: f64,
        /// η₀ \[Pa·s\].
        viscosity: f64,
    },
    /// All contacts with M, L, α in these intervals and p_H up to a limit, at η₀.
    Moes {
        /// Load number.
        m: (f64, f64),
        /// Lubricant number.
        l: (f64, f64),
        /// α \[1/Pa\].
        alpha: (f64, f64),
        /// Largest p_H \[Pa\].
        max_hertz_pressure: f64,
        /// η₀ \[Pa·s\].
        viscosity: f64,
    },
}

/// Everything that determines a reduced model: the same specification gives the same model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrainingSpec {
    /// Title the model carries.
    pub title: String,
    /// What it is for.
    pub range: Range,
    /// Laws of the lubricant.
    #[serde(default)]
    pub lubricant: Lubricant,
    /// Where the solutions are taken.
    pub plan: Plan,
    /// Windows of M with the grid of each.
    pub windows: Vec<WindowSpec>,
    /// Loss of information that pressure modes may neglect, (2.92).
    pub pressure_loss: f64,
    /// Loss of information that deformation modes may neglect, (2.93).
    pub deformation_loss: f64,
    /// How rows are sampled.
    #[serde(default)]
    pub sampling: Sampling,
    /// Sampled rows per pressure mode.
    pub rows_per_mode: f64,
    /// Seed of everything random.
    pub seed: u64,
}

/// One window of a model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WindowSpec {
    /// Range of M it serves (training reaches beyond by an overlap).
    pub m: (f64, f64),
    /// Its grid.
    pub grid: super::grid::GridSpec,
}

/// How far a training is.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// What is being done, for people.
    pub stage: String,
    /// Work done.
    pub done: usize,
    /// Work in all of this stage.
    pub total: usize,
}

/// Watches a training from its worker threads.
pub trait TrainingObserver: Sync {
    /// Called as work proceeds.
    fn progress(&self, _progress: Progress) {}
    /// Asked between full solutions; `true` stops the training.
    fn cancelled(&self) -> bool {
        false
    }
}

impl TrainingObserver for () {}

/// Why a training gives no model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TrainingError {
    /// The specification is refused.
    #[error("{0}")]
    Specification(String),
    /// A full solution the plan asks for could not be had.
    #[error(
        "the full solver did not converge at M = {m:.4}, L = {l:.4}; leave that corner out of the range or refine the grid"
    )]
    NotConverged {
        /// Load number of the point.
        m: f64,
        /// Lubricant number of the point.
        l: f64,
    },
    /// A grid or a point is refused.
    #[error(transparent)]
    Solve(#[from] super::full::SolveError),
    /// Linear algebra gave up (non-finite snapshots).
    #[error("the snapshots of the window M {from}…{to} could not be decomposed")]
    Decomposition {
        /// Lower end of the window.
        from: f64,
        /// Upper end of the window.
        to: f64,
    },
    /// The observer asked to stop.
    #[error("the training was cancelled")]
    Cancelled,
}
