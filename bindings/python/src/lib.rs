//! Python module `ehl_explorer._native`: contacts, models, studies and scenes for numpy.
//!
//! It is an interface to the engine, like the command line and the explorer. Keywords are fields of
//! `ehl_explorer::scene::ContactSpec`, so that refusals are those of the command line with keywords in place of flags.
//! Results become arrays. Long computations run without Python's global lock ([`work`]).

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
    /// Lock held by a thread during a fork.
    static HELD: RefCell<Option<Held<'static>>> = const { RefCell::new(None) };
}

/// Called before and after a fork. Holding the lock ensures that no other thread is changing shared data during the
/// fork.
#[pyfunction]
fn _hold(held: bool) {
    let held = held.then(|| STORE.hold());
    HELD.with(|place| *place.borrow_mut() = held);
}

/// Native part of `ehl_explorer`.
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
