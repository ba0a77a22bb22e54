//! Working state of the window, and the commands on it.

pub mod files;
mod opened;
mod refusal;
mod workspace;

pub use opened::Opened;
pub use workspace::Desk;
