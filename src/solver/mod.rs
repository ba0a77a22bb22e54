//! Core of the program: mathematics and physics of elastohydrodynamic contacts, without screen, files, clock or
//! terminal.
//!
//! Dependencies point one way: `training` → `reduced` → `full` → `discrete` → `parameters` → `physics`.

pub mod discrete;
pub mod full;
pub mod limits;
pub mod observer;
pub mod parameters;
pub mod physics;
pub mod reduced;
pub mod training;
pub mod warning;
