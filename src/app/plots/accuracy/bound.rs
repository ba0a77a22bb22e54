//! The error estimate that these studies judge, in one place.

use crate::solver::reduced::ReducedSolution;

/// What the estimate must be read with, symbols in braces; `None` once it is a bound.
pub const NOTE: Option<&str> = Some(
    "The estimate is the uncalibrated residual {e_f} of (3.15): judge how it ranks the errors, not its size against them.",
);

/// The estimated relative error of H_c.
pub fn bound_of(solution: &ReducedSolution) -> Option<f64> {
    Some(solution.residual_estimate)
}
