//! Storage of the last session.

mod keeper;
mod layout;
mod place;
mod shown;
mod state;

pub use keeper::Keeper;
pub use layout::checked;
pub use place::Place;
pub use state::restore;
