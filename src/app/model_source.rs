//! Where the explorer's reduced model comes from.

use crate::harness::model_file;
use crate::solver::reduced::ReducedModel;
use std::sync::Arc;

/// The model embedded in the program. Without it (a damaged build) the full solver draws the picture.
pub fn load_model() -> Option<Arc<ReducedModel>> {
    model_file::embedded().ok()
}
