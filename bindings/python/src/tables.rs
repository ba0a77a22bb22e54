//! Tables as arrays.

use ehl_explorer::scene::Table;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// Rows of numbers as a structured array, one field for each column; the numbers are moved, not copied.
pub fn structured<'py>(py: Python<'py>, columns: &[impl AsRef<str>], numbers: Vec<f64>) -> PyResult<Bound<'py, PyAny>> {
    let fields = columns.iter().map(|name| (name.as_ref(), "<f8")).collect::<Vec<_>>();
    let flat = PyArray1::from_vec(py, numbers);
    flat.call_method1("view", (fields,))
}

/// A table as such an array.
pub fn array_of<'py>(py: Python<'py>, table: Table) -> PyResult<Bound<'py, PyAny>> {
    structured(py, &table.columns, table.rows.concat())
}

/// Numbers as an array of a shape; the numbers are moved, not copied.
pub fn shaped<'py>(py: Python<'py>, numbers: Vec<f64>, shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    let flat = PyArray1::from_vec(py, numbers);
    match shape {
        [_] => Ok(flat.into_any()),
        _ => Ok(flat.reshape(shape)?.into_any()),
    }
}

/// The same without the first `skipped` numbers along the first axis.
pub fn from_row<'py>(array: Bound<'py, PyAny>, skipped: usize) -> PyResult<Bound<'py, PyAny>> {
    if skipped == 0 {
        return Ok(array);
    }
    let slice = pyo3::types::PySlice::new(array.py(), skipped as isize, isize::MAX, 1);
    array.get_item(PyTuple::new(array.py(), [slice])?)
}
