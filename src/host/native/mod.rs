//! Native program: threads, a file system, and dialogs of the operating system.

pub mod browser;
#[cfg(feature = "screen")]
pub mod dialogs;
pub mod files;
pub mod models;
pub mod remote;
pub mod worker;
