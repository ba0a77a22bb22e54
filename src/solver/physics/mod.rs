//! Physical models of the contact, the bodies, their surfaces and the lubricant, before discretisation.

pub mod bodies;
pub mod contact;
pub mod engineering;
pub mod lubricant;
pub mod machines;
pub mod optics;
pub mod surfaces;
