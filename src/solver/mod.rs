//! The core: pure mathematics and physics of elastohydrodynamic contacts. It knows no screen, file, clock or terminal.
//!
//! Arrows point one way: `training` → `reduced` → `full` → `discrete` → `parameters` → `physics`.

pub mod discrete;
pub mod full;
pub mod limits;
pub mod observer;
pub mod parameters;
pub mod physics;
pub mod reduced;
pub mod training;
pub mod warning;
