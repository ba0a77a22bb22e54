//! What a contact and its fluid are, before anything is discretised.

pub mod bodies;
pub mod contact;
pub mod engineering;
pub mod lubricant;
pub mod optics;
