//! The Python module `ehl_explorer._native`: contacts, models, studies and scenes for numpy.
//!
//! It is a face of the engine beside the command line and the explorer: keywords are fields of
//! `ehl_explorer::scene::ContactSpec`, so that everything is refused as on the command line, in the words of Python, and the
//! engine's answers become arrays. What takes long runs without Python's lock ([`work`]).

mod contact;
mod many;
mod model;
mod result;
mod study;
mod tables;
mod work;

use ehl_explorer::engine::Store;
use pyo3::prelude::*;
use std::sync::LazyLock;

/// Grids, solvers and models of this process.
static STORE: LazyLock<Store> = LazyLock::new(Store::default);

/// The native half of `ehl_explorer`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::contact::Contact;
    #[pymodule_export]
    use super::many::{measure, solve_many};
    #[pymodule_export]
    use super::model::Model;
    #[pymodule_export]
    use super::result::{Result, solve};
    #[pymodule_export]
    use super::study::{random_test, run, sweep, transient};
    #[pymodule_export]
    use super::work::EhlError;

    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
