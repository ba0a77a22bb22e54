//! Identity of units and start values.

use crate::engine::SavedModel;
use crate::engine::coupled::{Coupled, CoupledError, InTime, Inputs, Pressed};
use std::sync::Arc;
use xxhash_rust::xxh3::xxh3_64;

/// Returns the GUID for a model's content and input mode. It shows that a library's model and a model description
/// belong together.
pub fn identity(model: &[u8], pressed: Pressed) -> String {
    let word = match pressed {
        Pressed::Load => "load",
        Pressed::Approach => "approach",
    };
    format!("{word}-{:016x}", xxh3_64(model))
}

/// Returns the input mode of a GUID, if it belongs to the model.
pub fn pressed_of(identity_given: &str, model: &[u8]) -> Option<Pressed> {
    [Pressed::Load, Pressed::Approach].into_iter().find(|pressed| identity(model, *pressed) == identity_given)
}

/// Returns the start values of a model's inputs.
///
/// # Errors
/// If the model solves no contact to start from, or if the input mode is not possible.
pub fn first_inputs(model: &SavedModel, pressed: Pressed) -> Result<Inputs, CoupledError> {
    let none = || CoupledError::NoStart(model.title().to_owned());
    match model {
        SavedModel::Stationary(model) => {
            Coupled::new(Arc::clone(model), pressed)?;
            Coupled::first_inputs(model).ok_or_else(none)
        }
        SavedModel::InTime(_) if pressed == Pressed::Approach => Err(CoupledError::ApproachInTime),
        SavedModel::InTime(model) => InTime::first_inputs(model).ok_or_else(none),
    }
}
