//! The core: pure mathematics and physics of elastohydrodynamic contacts. It knows no screen, file, clock or terminal.

pub mod contact;
pub mod elasticity;
pub mod full;
pub mod grid;
pub mod lubricant;
pub mod observer;
pub mod optics;
pub mod reduced;
pub mod reynolds;
pub mod training;
