//! EHL Explorer: elastohydrodynamic contacts, solved in full and by reduced models, on the screen and headless.
//!
//! * [`app`] is the explorer: panels, plots, worker threads.
//! * [`solver`] is the core: contact, lubricant, grid, Reynolds row, full and reduced systems, training.

pub mod app;
pub mod solver;
