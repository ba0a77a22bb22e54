//! Resources that compute the answers.

use super::jobs::Jobs;
use super::live::Live;
use crate::app::model_source::Models;
use crate::engine::Store;
use crate::engine::job::Job;
use crate::solver::reduced::ReducedModel;
use std::sync::Arc;

/// Store, models, and the solves that wait or run.
pub struct Work {
    /// Grids, solvers, models and operators.
    pub store: Store,
    /// Reduced models in use.
    pub models: Models,
    /// Full solves.
    pub jobs: Jobs,
    /// Reduced solves.
    pub live: Live,
    /// Built-in model that is being read.
    pub reading: Option<Job<Arc<ReducedModel>>>,
}

impl Work {
    /// Creates the resources without running jobs.
    pub fn new(models: Models, store: Store) -> Self {
        Self { jobs: Jobs::new(&store), live: Live::new(&store), store, models, reading: None }
    }
}
