//! Reasons why transient simulations do not support a contact, and the checks that find them.

use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::{Cavitation, Lubricant, ShearLaw};

/// Reason why a contact is not supported. The message is a sentence; each interface adds in its own terms what it
/// accepts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unsupported {
    /// Point contact, with a method that supports line contacts only.
    #[error("transient runs by this method cover line contacts only")]
    PointContact,
    /// Frame or time integration scheme that is not available for point contacts.
    #[error("transient runs of point contacts use the fixed frame and the scheme Bdf2")]
    PointFrame,
    /// Inputs that are not available for point contacts: a variable radius or a speed that reverses.
    #[error("transient runs of point contacts need a constant radius and a speed that does not reverse")]
    PointInputs,
    /// Lubricant whose viscosity depends on the shear stress.
    #[error("transient runs cover Newtonian lubricants only, not shear-thinning ones")]
    ShearThinning,
    /// Thermal contact.
    #[error("transient runs cover isothermal contacts only")]
    Heat,
    /// Rough surfaces in a reduced or linearised model.
    #[error("transient models cover smooth surfaces only")]
    RoughModel,
    /// Mass-conserving cavitation in a reduced or linearised model.
    #[error("transient models cover cavitation by the penalty and by complementarity, not mass-conserving cavitation")]
    MassConservingModel,
}

impl Unsupported {
    /// Checks that transient simulations of line contacts support a contact. For reduced and linearised models, call
    /// [`Self::check_model`] too.
    ///
    /// # Errors
    /// With the first reason why they do not.
    pub fn check(kind: ContactKind, lubricant: &Lubricant) -> Result<(), Self> {
        if kind.is_point() { Err(Self::PointContact) } else { Self::check_lubricant(lubricant) }
    }

    /// Checks that full transient simulations support a lubricant.
    ///
    /// # Errors
    /// With the first reason why they do not.
    pub fn check_lubricant(lubricant: &Lubricant) -> Result<(), Self> {
        if lubricant.shear != ShearLaw::Newtonian {
            Err(Self::ShearThinning)
        } else if lubricant.heat.is_some() {
            Err(Self::Heat)
        } else {
            Ok(())
        }
    }

    /// Checks that reduced and linearised transient models support the cavitation model and the roughness of a contact.
    /// Both are part of the lubricant.
    ///
    /// # Errors
    /// With the first reason why they do not.
    pub fn check_model(lubricant: &Lubricant) -> Result<(), Self> {
        match lubricant.cavitation {
            _ if lubricant.is_rough() => Err(Self::RoughModel),
            Cavitation::Penalty | Cavitation::Complementarity => Ok(()),
            Cavitation::MassConserving { .. } => Err(Self::MassConservingModel),
        }
    }
}
