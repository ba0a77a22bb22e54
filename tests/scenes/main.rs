//! Scenes: those of the repository, and every kind of study at a small size.
#![cfg(test)]

#[path = "../common/mod.rs"]
mod common;

mod cancel;
mod plans;
mod points;
mod repository;
mod sampling;
mod transient;
