//! The machine below the program: its clock, its threads, its files, and the pool for parallel work. Everything else reads
//! time, starts threads and asks for files here.
//!
//! What differs between a native program and a web page stands in `native` and `web`, with the same names in both.

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
