//! The program as it is called: its commands, and what the papers promise of it.
#![cfg(test)]

#[path = "../common/mod.rs"]
mod common;

mod commands;
mod ellipses;
mod readme;
mod take_away;
