//! EHL Explorer: elastohydrodynamic contacts, solved in full and by reduced models, on the screen and headless.
//!
//! Imports point one way: `app` and [`cli`] use [`engine`], which uses [`scene`], which uses [`solver`]. All of them stand
//! on [`host`].
//!
//! * [`solver`] is the core: physics, the discrete equations, full and reduced systems, training.
//! * [`scene`] is the experiment as a document: read, check, write; [`scene::study`] has one file for each question.
//! * [`engine`] owns what is expensive and shared: grids, solvers, models and their files, jobs, the speed table.
//! * [`host`] owns the clock, the threads, the files and the pool for parallel work, natively and in a web page.
//! * [`cli`] holds the commands, `app` is the explorer on the screen. Without the feature `desktop` there are no commands
//!   and no native window, without `screen` there is no `app` either, for programs that only solve.

#[cfg(feature = "screen")]
pub mod app;
#[cfg(feature = "desktop")]
pub mod cli;
pub mod engine;
pub mod host;
pub mod scene;
pub mod solver;
