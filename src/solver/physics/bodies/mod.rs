//! The two bodies of a contact: material, radii, surface speeds and roughness of each, and their combined properties.

mod body;
mod material;
mod pair;

pub use body::{Body, Transverse};
pub use material::{BodyHeat, MATERIALS, Material};
pub use pair::{Bodies, BodyError, film_regime, reduced_radius_m, surface_speeds};
