//! EHL Explorer: elastohydrodynamic contacts, solved in full and by reduced models, on the screen and headless.
//!
//! * [`solver`] is the core: contact, lubricant, grid, Reynolds row, full and reduced systems, training.

pub mod solver;

pub mod harness;
