//! Everything the window works with, and the commands on it.

pub mod files;
mod opened;
mod refusal;
mod workspace;

pub use opened::Opened;
pub use workspace::Desk;
