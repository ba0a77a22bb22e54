//! Reasons for refusing a lubricant.

use crate::solver::limits::Number;
use crate::solver::physics::surfaces::SurfaceError;

/// Message that states why a lubricant cannot be used at an operating point.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct LubricantError(pub(super) String);

impl From<SurfaceError> for LubricantError {
    fn from(error: SurfaceError) -> Self {
        Self(error.to_string())
    }
}

/// Refuses a constant that is not finite or outside its range.
pub(super) fn check_constant(constant: &str, value: f64, min: f64, max: f64) -> Result<(), LubricantError> {
    if (min..=max).contains(&value) {
        return Ok(());
    }
    let value = Number(value);
    Err(LubricantError(format!("{constant} is {value}, but must be a finite number between {min:e} and {max:e}")))
}
