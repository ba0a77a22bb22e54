//! Elastic deformation of the half-space: under line loads ([`mod@line`], (2.27)) and under pressures on a plane
//! ([`mod@point`], (2.25)).

mod convolution;
pub mod line;
pub mod point;

pub(crate) use convolution::Convolution;
pub use convolution::KernelError;
pub use line::{Flexibility, Scratch, Toeplitz};
pub use point::{PointFlexibility, PointScratch, rectangle_kernel};
