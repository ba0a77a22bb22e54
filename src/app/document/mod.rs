//! Content that the user edits and that a file stores.

mod edit;
mod engineering;
mod experiment;
pub mod features;
mod held;
mod history;
pub mod input;
mod key;
mod shape;
mod surfaces;
mod transient;

pub use edit::Edit;
pub use experiment::{Document, HOME};
pub use history::History;
pub use key::Key;
pub use shape::Shape;
