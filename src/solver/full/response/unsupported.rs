//! Contacts whose linear response is not computed.

use super::linear::ResponseError;
use crate::solver::physics::lubricant::{Cavitation, Lubricant, ShearLaw};

/// Checks that the linear response of a contact with a lubricant can be computed.
///
/// # Errors
/// The first reason why it cannot.
pub fn check_lubricant(lubricant: &Lubricant) -> Result<(), ResponseError> {
    let refuse = |what: &'static str| Err(ResponseError::Unsupported(what));
    if lubricant.shear != ShearLaw::Newtonian {
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
