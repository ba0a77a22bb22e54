//! Where the explorer's reduced model comes from.

use crate::solver::reduced::ReducedModel;
use std::sync::Arc;

/// The model embedded in the program, when there is one.
pub fn load_model() -> Option<Arc<ReducedModel>> {
    None
}
