//! The program as it is called: its commands, its speed table, and what the papers promise of it.

#[path = "../common/mod.rs"]
mod common;

mod bench;
mod commands;
mod readme;
