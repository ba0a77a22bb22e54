//! Kinds of machines that have a form.

use crate::solver::physics::engineering::QuantityKind;
use crate::solver::physics::machines::{Bearing, CamFollower, GearPair, Machine};

/// Kind of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MachineKind {
    Bearing,
    Gear,
    Cam,
}

impl MachineKind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Bearing, Self::Gear, Self::Cam];

    /// Returns the kind of a machine.
    pub fn of(machine: &Machine) -> Self {
        match machine {
            Machine::Bearing(_) => Self::Bearing,
            Machine::Gear(_) => Self::Gear,
            Machine::Cam(_) => Self::Cam,
        }
    }

    /// Returns a real machine of this kind.
    pub fn example(self) -> Machine {
        match self {
            Self::Bearing => Machine::Bearing(Bearing::default()),
            Self::Gear => Machine::Gear(GearPair::default()),
            Self::Cam => Machine::Cam(CamFollower::default()),
        }
    }

    /// Returns the name on buttons and in menus.
    pub fn title(self) -> &'static str {
        match self {
            Self::Bearing => "From a bearing…",
            Self::Gear => "From a gear pair…",
            Self::Cam => "From a cam…",
        }
    }

    /// Returns the description.
    pub fn tip(self) -> &'static str {
        match self {
            Self::Bearing => {
                "Radii, speeds and load of the heaviest contact of a ball or roller bearing, by the equilibrium of its ring"
            }
            Self::Gear => "Radii, speeds and load per length of two tooth flanks along the path of contact",
            Self::Cam => "Radii, speeds and load of a cam with a flat or a roller follower, at a cam angle",
        }
    }

    /// Returns the name of the position along the path and its kind.
    pub(super) fn position(self) -> (&'static str, QuantityKind) {
        match self {
            Self::Bearing => ("Orbit angle", QuantityKind::Angle),
            Self::Gear => ("Distance from the pitch point", QuantityKind::Length),
            Self::Cam => ("Cam angle", QuantityKind::Angle),
        }
    }
}
