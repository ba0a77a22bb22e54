//! Commands. Each converts its options into a request to the engine, and the answer into text, JSON or files.
//!
//! Exit codes: 0 done and converged; 1 ran, but did not converge or did not meet an expectation; 2 invalid request,
//! with one sentence on standard error.

#![warn(clippy::indexing_slicing)]

mod animate;
mod bench;
mod campaign;
mod cases;
mod described;
mod export;
mod failure;
mod info;
mod model_argument;
mod options;
mod output;
mod program;
mod run;
mod run_all;
mod solve;
mod sweep;
mod train;
mod verdict;

pub use program::{NoWindow, main};
