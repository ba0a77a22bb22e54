//! Shared helpers of the tests.
#![allow(dead_code, reason = "every test binary needs its own part of these")]

pub mod cases;
pub mod processor_time;
pub mod scene_files;
pub mod scratch;
pub mod six_contacts;
pub mod stop_after;
