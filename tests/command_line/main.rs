//! The program as it is called: its commands, its speed table, and what the papers promise of it.
#![cfg(test)]

#[path = "../common/mod.rs"]
mod common;

mod bench;
mod commands;
mod readme;
