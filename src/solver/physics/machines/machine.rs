//! Any of the machine elements.

use super::bearing::{Bearing, Element};
use super::cam::CamFollower;
use super::contact::MachineContact;
use super::error::MachineError;
use super::gear::GearPair;
use crate::solver::physics::contact::ContactKind;
use serde::{Deserialize, Serialize};

/// Machine element whose contact is computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Machine {
    /// Rolling bearing.
    Bearing(Bearing),
    /// Pair of external involute gears.
    Gear(GearPair),
    /// Cam with its follower.
    Cam(CamFollower),
}

impl Machine {
    /// Returns the contact at the position of the machine. `modulus_pa` is E′ of both bodies, which determines how
    /// the elements of a bearing share the load.
    ///
    /// # Errors
    /// A sentence if the machine does not exist or has no loaded contact there.
    pub fn contact(&self, modulus_pa: f64) -> Result<MachineContact, MachineError> {
        match self {
            Self::Bearing(bearing) => bearing.contact(modulus_pa),
            Self::Gear(pair) => pair.contact(),
            Self::Cam(cam) => cam.contact(),
        }
    }

    /// Returns contacts at `count` equidistant positions along the path. The first has the time 0.
    ///
    /// # Errors
    /// A sentence if the machine does not exist.
    pub fn path(&self, modulus_pa: f64, count: usize) -> Result<Vec<MachineContact>, MachineError> {
        let mut path = match self {
            Self::Bearing(bearing) => bearing.path(modulus_pa, count),
            Self::Gear(pair) => pair.path(count),
            Self::Cam(cam) => cam.path(count),
        }?;
        let first = path.first().map_or(0.0, |contact| contact.time_s);
        path.iter_mut().for_each(|contact| contact.time_s -= first);
        Ok(path)
    }

    /// Returns the first and last position of the path, in the unit of [`MachineContact::position`].
    ///
    /// # Errors
    /// A sentence if the machine does not exist.
    pub fn extent(&self, modulus_pa: f64) -> Result<(f64, f64), MachineError> {
        match self {
            Self::Bearing(bearing) => bearing.extent(modulus_pa),
            Self::Gear(pair) => Ok(pair.geometry()?.path),
            Self::Cam(cam) => cam.extent(),
        }
    }

    /// Returns the machine at another position of its path.
    pub fn at(&self, position: f64) -> Self {
        match self.clone() {
            Self::Bearing(bearing) => Self::Bearing(Bearing { orbit_deg: position.to_degrees(), ..bearing }),
            Self::Gear(pair) => Self::Gear(GearPair { position_m: position, ..pair }),
            Self::Cam(cam) => Self::Cam(CamFollower { angle_deg: position.to_degrees(), ..cam }),
        }
    }

    /// Returns the kind of its contact.
    pub fn kind(&self) -> ContactKind {
        match self {
            Self::Bearing(Bearing { element: Element::Roller { crown_radius_m: None, .. }, .. })
            | Self::Gear(_)
            | Self::Cam(_) => ContactKind::Line,
            Self::Bearing(_) => ContactKind::Point,
        }
    }

    /// Returns the name of the machine in sentences.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Bearing(_) => "bearing",
            Self::Gear(_) => "gear pair",
            Self::Cam(_) => "cam",
        }
    }
}

/// Returns `count` equidistant positions between two, both included; at least two.
pub(super) fn positions((from, to): (f64, f64), count: usize) -> impl Iterator<Item = f64> {
    let steps = count.max(2) - 1;
    (0..=steps).map(move |k| from + (to - from) * k as f64 / steps as f64)
}
