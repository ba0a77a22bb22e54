//! Contacts whose linear response is not computed.

use super::linear::ResponseError;
use crate::solver::full::Solution;
use crate::solver::physics::lubricant::{Cavitation, ShearLaw};

/// Checks that the linear response of a solution can be computed.
///
/// # Errors
/// The first reason why it cannot.
pub(super) fn check(solution: &Solution) -> Result<(), ResponseError> {
    let lubricant = &solution.problem.lubricant;
    let refuse = |what: &'static str| Err(ResponseError::Unsupported(what));
    if !solution.converged() {
        Err(ResponseError::NotConverged)
    } else if lubricant.shear != ShearLaw::Newtonian {
        refuse("Newtonian lubricants only, not shear-thinning ones")
    } else if lubricant.heat.is_some() {
        refuse("isothermal contacts only")
    } else if lubricant.is_rough() {
        refuse("smooth surfaces only")
    } else if let Cavitation::MassConserving { .. } = lubricant.cavitation {
        refuse("cavitation by the penalty and by complementarity, not mass-conserving cavitation")
    } else {
        Ok(())
    }
}
