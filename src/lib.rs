//! EHL Explorer: elastohydrodynamic contacts, solved in full and by reduced models, on the screen and headless.
//!
//! Imports point one way: [`app`] and [`cli`] use [`engine`], which uses [`scene`], which uses [`solver`].
//!
//! * [`solver`] is the core: contact, lubricant, grid, Reynolds row, full and reduced systems, training.
//! * [`scene`] is the experiment as a document: read, check, write.
//! * [`engine`] runs experiments headless: results by name, expectations, tables, CSV and JSON, the speed table.
//! * [`cli`] holds the commands.
//! * [`app`] is the explorer on the screen.

pub mod app;
pub mod cli;
pub mod engine;
pub mod scene;
pub mod solver;
