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

use ehl_explorer::engine::{Held, Store};
use pyo3::prelude::*;
use std::cell::RefCell;
use std::sync::LazyLock;

/// Grids, solvers and models of this process.
static STORE: LazyLock<Store> = LazyLock::new(Store::default);

thread_local! {
    /// What the thread holds that forks.
    static HELD: RefCell<Option<Held<'static>>> = const { RefCell::new(None) };
}

/// Called before and after a fork: while one thread forks, no other one is in the middle of a change to what they share.
#[pyfunction]
fn _hold(held: bool) {
    let held = held.then(|| STORE.hold());
    HELD.with(|place| *place.borrow_mut() = held);
}

/// The native half of `ehl_explorer`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::_hold;
    #[pymodule_export]
    use super::contact::Contact;
    #[pymodule_export]
    use super::many::{measure, solve_many};
    #[pymodule_export]
    use super::model::{_model, Model};
    #[pymodule_export]
    use super::result::{_result, Result, solve};
    #[pymodule_export]
    use super::study::{random_test, run, sweep, transient};
    #[pymodule_export]
    use super::work::{EhlError, MarchStopped};

    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
