//! Linear response of a steady contact to small changes that are periodic in time, without time stepping.
//!
//! Everything varies as the real part of a complex amplitude times e^(iΩT), with the time T = t u_m/a and the angular
//! frequency Ω. The equations are linearised at the steady solution, with a fixed cavitated set. One complex linear
//! solve per frequency gives
//!
//! - the change of the film thickness by a wavy surface that moves through the contact, [`WaveResponse`];
//! - stiffness and damping of the film, [`Dynamics`].

mod adjoint;
mod contact;
mod derivative;
mod dynamics;
mod line;
mod linear;
mod maxwell;
mod plane;
#[cfg(test)]
mod tests;
mod unsupported;
mod wave;

pub use adjoint::Adjoint;
pub use contact::ContactResponse;
pub use derivative::TimeDerivative;
pub use dynamics::{Dynamics, Stiffness};
pub use linear::{Amplitudes, LinearResponse, ResponseError, ResponseSpace};
pub use maxwell::Maxwell;
pub use unsupported::check_lubricant;
pub use wave::{
    PublishedReduction, WaveResponse, check_wavelength, is_uniform, published_reduction, reduction_parameter,
    widest_spacing,
};
