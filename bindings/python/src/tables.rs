//! Tables as numpy arrays.

use ehl_explorer::scene::Table;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyString, PyTuple};
use std::collections::HashMap;

/// Returns a structured array with one field per number column, followed by the text columns. Without text columns, the
/// numbers are moved and not copied.
pub fn structured<'py>(
    py: Python<'py>,
    columns: &[impl AsRef<str>],
    numbers: Vec<f64>,
    texts: &[(&str, &[String])],
) -> PyResult<Bound<'py, PyAny>> {
    let mut fields = columns.iter().map(|name| (name.as_ref(), "<f8")).collect::<Vec<_>>();
    let Some((_, first)) = texts.first() else {
        return PyArray1::from_vec(py, numbers).call_method1("view", (fields,));
    };
    fields.extend(texts.iter().map(|(title, _)| (*title, "O")));
    let array = py.import("numpy")?.call_method1("empty", (first.len(), fields))?;
    for (k, name) in columns.iter().enumerate() {
        let column = numbers.iter().skip(k).step_by(columns.len()).copied();
        array.set_item(name.as_ref(), PyArray1::from_iter(py, column))?;
    }
    // Most texts are empty and many are equal: each is stored as one object.
    let mut kept: HashMap<&str, Bound<'py, PyString>> = HashMap::new();
    for (title, texts) in texts {
        let texts = texts.iter().map(|text| kept.entry(text).or_insert_with(|| PyString::new(py, text)).clone());
        array.set_item(title, texts.collect::<Vec<_>>())?;
    }
    Ok(array)
}

/// Returns a table as a structured array.
pub fn array_of<'py>(py: Python<'py>, table: Table) -> PyResult<Bound<'py, PyAny>> {
    let texts: Vec<(&str, &[String])> = table.remarks.iter().map(|(title, texts)| (*title, &texts[..])).collect();
    structured(py, &table.columns, table.rows.concat(), &texts)
}

/// Returns numbers as an array of a shape, without copying.
pub fn shaped<'py>(py: Python<'py>, numbers: Vec<f64>, shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    let flat = PyArray1::from_vec(py, numbers);
    match shape {
        [_] => Ok(flat.into_any()),
        _ => Ok(flat.reshape(shape)?.into_any()),
    }
}

/// Returns the array without the first `skipped` elements along the first axis.
pub fn from_row<'py>(array: Bound<'py, PyAny>, skipped: usize) -> PyResult<Bound<'py, PyAny>> {
    if skipped == 0 {
        return Ok(array);
    }
    let slice = pyo3::types::PySlice::new(array.py(), skipped as isize, isize::MAX, 1);
    array.get_item(PyTuple::new(array.py(), [slice])?)
}
