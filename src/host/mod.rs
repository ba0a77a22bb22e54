//! Interface to the machine: clock, threads, files, and the thread pool for parallel work. All other modules read
//! the time, start threads and request files through this module.
//!
//! Code that differs between a native program and a web page is in `native` and `web`, with the same names in both.

#![allow(clippy::disallowed_methods, reason = "this is their owner")]

pub mod clock;
pub mod pool;
pub mod wanted;

#[cfg(not(target_arch = "wasm32"))]
#[path = "native/mod.rs"]
mod platform;
#[cfg(target_arch = "wasm32")]
#[path = "web/mod.rs"]
mod platform;

pub use platform::*;
