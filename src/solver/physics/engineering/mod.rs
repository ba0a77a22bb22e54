//! The same contact as engineers know it: an oil of a grade at a temperature, units, the stress under the surface.
//! Nothing here enters the equations: it becomes an operating point, or is read off a solution.

mod oil;
mod subsurface;
mod units;

pub use oil::{Grade, ISO_VG, Oil, OilError, OilFamily, OilState};
pub use subsurface::{LargestShear, largest_shear};
pub use units::{Dimension, KELVIN, UnitError, parse};
