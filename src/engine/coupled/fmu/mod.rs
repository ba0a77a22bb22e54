//! Contact as a Functional Mock-up Unit for co-simulation (FMI 2.0 and 3.0): variables, model description, archive.
//!
//! The archive contains `modelDescription.xml`, the model, and a library that is the same for all models and for both
//! versions. The library identifies model and input mode by the identity in the model description.

mod archive;
mod description;
mod identity;
#[cfg(test)]
mod tests;
mod variables;
mod version_2;
mod version_3;

pub use archive::{FmiVersion, IDENTIFIER, MODEL, UnknownVersion, archive, library_file, library_place};
pub use identity::{first_inputs, identity, pressed_of};
pub use variables::{FIRST_TRUTH, Output, REALS, Real, Role, TIME, TRUTHS, Truth};
