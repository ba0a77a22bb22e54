//! The same contact as engineers know it: bodies of a material, radii and surface speeds; an oil of a grade at a
//! temperature; roughness, friction and the stress under the surface. Nothing here enters the equations: it becomes an
//! operating point, or is read off a solution.

mod bodies;
mod oil;
mod subsurface;
mod units;

pub use bodies::{BodyError, MATERIALS, Material, Pair, film_regime, lambda_ratio, surface_speed};
pub use oil::{ISO_VG, OilError, OilFamily, ViscosityTemperature, density_at};
pub use subsurface::{LargestShear, largest_shear};
pub use units::{Dimension, KELVIN, UnitError, parse};
