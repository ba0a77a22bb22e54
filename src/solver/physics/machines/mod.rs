//! Machine elements that run in elastohydrodynamic contact: rolling bearings, gear pairs, cams with followers. Each
//! determines the radii of both bodies, the speeds of their surfaces and the load, at one position and along the path
//! of the contact.

mod bearing;
mod cam;
mod contact;
mod error;
mod gear;
mod lift;
mod load_distribution;
mod machine;

pub use bearing::{Bearing, BearingState, Element, Race};
pub use cam::{CamFollower, CamState, Follower};
pub use contact::{MachineContact, Surface};
pub use error::MachineError;
pub use gear::{GearGeometry, GearPair};
pub use lift::{Lift, LiftCurve, lift_table};
pub use machine::Machine;
