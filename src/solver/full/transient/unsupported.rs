//! Which contacts transient runs cover.

use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::{Cavitation, Lubricant, ShearLaw};

/// Why a contact cannot be taken through time, as a sentence. Interfaces add what they accept, in their own words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unsupported {
    /// A point contact.
    #[error("transient runs cover line contacts only")]
    PointContact,
    /// A lubricant whose viscosity depends on the shear stress.
    #[error("transient runs cover Newtonian lubricants only, not shear-thinning ones")]
    ShearThinning,
    /// Temperatures.
    #[error("transient runs cover isothermal contacts only")]
    Heat,
    /// Mass-conserving cavitation of a reduced or linearised model.
    #[error("transient models cover cavitation by the penalty and by complementarity, not mass-conserving cavitation")]
    MassConservingModel,
}

impl Unsupported {
    /// Refuses contacts that transient runs do not cover.
    ///
    /// # Errors
    /// With the first reason.
    pub fn check(kind: ContactKind, lubricant: &Lubricant) -> Result<(), Self> {
        if kind == ContactKind::Point {
            Err(Self::PointContact)
        } else if lubricant.shear != ShearLaw::Newtonian {
            Err(Self::ShearThinning)
        } else if lubricant.heat.is_some() {
            Err(Self::Heat)
        } else {
            Ok(())
        }
    }

    /// Refuses lubricants that reduced and linearised transient models do not cover.
    ///
    /// # Errors
    /// With the reason.
    pub fn check_model(lubricant: &Lubricant) -> Result<(), Self> {
        match lubricant.cavitation {
            Cavitation::Penalty | Cavitation::Complementarity => Ok(()),
            Cavitation::MassConserving { .. } => Err(Self::MassConservingModel),
        }
    }
}
