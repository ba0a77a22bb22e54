//! The same contact as engineers know it: bodies of a material, radii and surface speeds; an oil of a grade at a
//! temperature; roughness, friction and the stress under the surface. Nothing here enters the equations: it becomes an
//! operating point, or is read off a solution.

mod bodies;
mod oil;
mod subsurface;
mod units;

pub use bodies::{Bodies, Body, BodyError, MATERIALS, Material, Transverse, film_regime, surface_speeds};
pub use oil::{Grade, ISO_VG, Oil, OilError, OilFamily, OilState};
pub use subsurface::{LargestShear, largest_shear};
pub use units::{Dimension, KELVIN, UnitError, parse};
