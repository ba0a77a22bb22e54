//! Engineering data of a contact: an oil of a grade at a temperature, units, and the stress below the surface. None
//! of it enters the equations: it is converted to an operating point, or derived from a solution.

mod losses;
mod oil;
mod subsurface;
mod unit_system;
mod units;

pub use losses::{Extent, Losses};
pub use oil::{Grade, ISO_VG, Oil, OilError, OilFamily, OilState};
pub use subsurface::{LargestShear, largest_shear};
pub use unit_system::{Digits, QuantityKind, Unit, UnitSystem};
pub use units::{Dimension, KELVIN, UnitError, parse};
