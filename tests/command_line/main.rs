//! The program on the command line: its commands, and the statements of README and manual.
#![cfg(test)]
#![allow(clippy::disallowed_methods, reason = "tests wait by the clock")]

#[path = "../common/mod.rs"]
mod common;

mod campaigns;
mod commands;
mod ellipses;
mod heat;
mod in_time;
mod installed;
mod interfaces;
mod language;
mod load_cases;
mod machines;
mod readme;
mod refused;
mod run_and_train;
mod sliding;
mod take_away;
