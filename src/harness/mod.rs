//! Headless work around the solver.

pub mod model_file;
