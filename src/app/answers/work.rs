//! Resources that compute the picture of the contact: stored grids and solvers, reduced models, and solves that wait or
//! run.

use super::jobs::Jobs;
use super::live::Live;
use crate::app::model_source::Models;
use crate::engine::Store;
use crate::engine::job::Job;
use crate::solver::reduced::ReducedModel;
use std::sync::Arc;

/// Resources that compute the picture.
pub struct Work {
    /// Stored grids, full and reduced solvers, and models.
    pub store: Store,
    /// Reduced models in use.
    pub models: Models,
    /// Full solves for the picture.
    pub jobs: Jobs,
    /// Reduced solves for the picture.
    pub live: Live,
    /// Job that reads a built-in model. `None` if no model is being read.
    pub reading: Option<Job<Arc<ReducedModel>>>,
}

impl Work {
    /// Creates the resources. No job runs yet.
    pub fn new(models: Models, store: Store) -> Self {
        Self { jobs: Jobs::new(&store), live: Live::new(&store), store, models, reading: None }
    }
}
