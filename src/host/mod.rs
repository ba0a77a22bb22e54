//! The machine below the program: its clock, its threads, and the pool for parallel work. Everything else reads time and
//! starts threads here, so that another platform needs another `host` and nothing more.

#![allow(clippy::disallowed_methods, reason = "this is their owner")]

pub mod clock;
pub mod pool;
pub mod worker;
