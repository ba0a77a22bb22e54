//! Contacts that transient simulations support.

use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::{Cavitation, Lubricant, ShearLaw};

/// Reason why a contact is not supported, as a sentence. The interfaces add what they accept, in their own terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unsupported {
    /// Point contact, by a method for line contacts.
    #[error("transient runs by this method cover line contacts only")]
    PointContact,
    /// Frame or scheme that point contacts do not have.
    #[error("transient runs of point contacts use the fixed frame and the scheme Bdf2")]
    PointFrame,
    /// Inputs that point contacts do not have.
    #[error("transient runs of point contacts need a constant radius and a speed that does not reverse")]
    PointInputs,
    /// Lubricant whose viscosity depends on the shear stress.
    #[error("transient runs cover Newtonian lubricants only, not shear-thinning ones")]
    ShearThinning,
    /// Thermal contact.
    #[error("transient runs cover isothermal contacts only")]
    Heat,
    /// Rough surfaces, by a reduced or linearised model.
    #[error("transient models cover smooth surfaces only")]
    RoughModel,
    /// Mass-conserving cavitation in a reduced or linearised model.
    #[error("transient models cover cavitation by the penalty and by complementarity, not mass-conserving cavitation")]
    MassConservingModel,
}

impl Unsupported {
    /// Checks that transient simulations by all methods support a contact.
    ///
    /// # Errors
    /// The first reason why they do not.
    pub fn check(kind: ContactKind, lubricant: &Lubricant) -> Result<(), Self> {
        if kind.is_point() { Err(Self::PointContact) } else { Self::check_lubricant(lubricant) }
    }

    /// Checks that full transient simulations support a lubricant.
    ///
    /// # Errors
    /// The first reason why they do not.
    pub fn check_lubricant(lubricant: &Lubricant) -> Result<(), Self> {
        if lubricant.shear != ShearLaw::Newtonian {
            Err(Self::ShearThinning)
        } else if lubricant.heat.is_some() {
            Err(Self::Heat)
        } else {
            Ok(())
        }
    }

    /// Checks that reduced and linearised transient models support a lubricant.
    ///
    /// # Errors
    /// The reason why they do not.
    pub fn check_model(lubricant: &Lubricant) -> Result<(), Self> {
        match lubricant.cavitation {
            _ if lubricant.is_rough() => Err(Self::RoughModel),
            Cavitation::Penalty | Cavitation::Complementarity => Ok(()),
            Cavitation::MassConserving { .. } => Err(Self::MassConservingModel),
        }
    }
}
