//! A native program: threads, a file system, dialogs of the system.

pub mod browser;
#[cfg(feature = "screen")]
pub mod dialogs;
pub mod files;
pub mod models;
pub mod remote;
pub mod worker;
