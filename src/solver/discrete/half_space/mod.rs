//! Stresses below the surface of a loaded elastic half-space, by Fourier transforms.
//!
//! A pressure p and a shear traction q along X act on the surface. Their Fourier components with wave numbers k_x, k_y
//! decay with the depth as e^{−kz}, k² = k_x² + k_y². The factors of each component follow from the equations of
//! elasticity in closed form. A line contact has k_y = 0 only, which is plane strain.
//!
//! The surface is continued periodically. Zeros around the contact keep the images away: at a distance of N half widths
//! they change the stress by about 2/N² of the Hertzian pressure.

mod field;
mod mode;
mod stress;
#[cfg(test)]
mod tests;

pub use field::{SurfaceLoad, stress_below};
pub use stress::{Stress, StressMeasure};
