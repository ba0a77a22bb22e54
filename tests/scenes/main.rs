//! Scenes: those of the repository, and every kind of study at a small size.
#![cfg(test)]
#![allow(clippy::disallowed_methods, reason = "tests wait by the clock")]

#[path = "../common/mod.rs"]
mod common;

mod cancel;
mod fit;
mod passing;
mod plans;
mod points;
mod repository;
mod sampling;
mod surfaces;
mod transient;
