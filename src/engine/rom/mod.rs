//! Reduced models in files (`.rom`): one container for steady and transient models.

mod calibrations;
mod catalogue;
mod container;
mod error;
mod multiples;
mod saved;
mod serialised;
mod snapshots;
mod sound;
mod steady;
mod transient;
mod window;

pub use catalogue::Catalogue;
pub use container::ModelKind;
#[cfg(not(feature = "models"))]
pub(super) use container::{head, head_length};
pub use error::ModelFileError;
pub use saved::SavedModel;
pub(super) use saved::{from_own_bytes, outline_from_own_bytes, read_watched, to_bytes, write_proven};

#[cfg(test)]
mod tests;
#[cfg(test)]
mod transient_tests;
