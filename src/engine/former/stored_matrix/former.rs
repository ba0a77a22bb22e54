//! Columns over a grid as former versions kept them.

use super::curves::{flags, sane};
use serde::{Deserialize, Serialize};

/// What former versions kept: values in steps of 2^(exponent of the row + exponent of the column) from the straight
/// continuation of the values before them.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Steps {
    /// Nodes across: rows i and i − across are neighbours along X.
    pub across: usize,
    /// Lengths of runs of rows without and with values, in turn.
    pub runs: Vec<usize>,
    /// Of the rows with values.
    pub row_exponents: Vec<i16>,
    pub column_exponents: Vec<i16>,
    /// Steps from the prediction at the rows with values, column after column.
    pub steps: Vec<i64>,
}

impl Steps {
    /// Column after column; `None` when its parts do not fit each other.
    pub fn values(self, rows: usize, columns: usize) -> Option<Vec<f64>> {
        let used = flags(&self.runs, rows)?;
        let per_column = used.iter().filter(|used| **used).count();
        let fits = self.across > 0
            && (self.row_exponents.len(), self.column_exponents.len()) == (per_column, columns)
            && sane(&self.row_exponents)
            && sane(&self.column_exponents)
            && per_column.checked_mul(columns) == Some(self.steps.len());
        if !fits {
            return None;
        }
        let mut counts = self.steps.iter();
        let mut all = Vec::with_capacity(rows * columns);
        for of_column in &self.column_exponents {
            let mut values = vec![0.0; rows];
            let mut exponents = self.row_exponents.iter();
            for (i, _) in used.iter().enumerate().filter(|(_, used)| **used) {
                let step = f64::from(exponents.next()? + of_column).exp2();
                let value = predicted(&values, i, self.across) + step * *counts.next()? as f64;
                *values.get_mut(i)? = value;
            }
            all.append(&mut values);
        }
        Some(all)
    }
}

/// What the rows before row `i` of a column let expect there: along a line the straight continuation, in the plane that
/// of both directions.
fn predicted(column: &[f64], i: usize, across: usize) -> f64 {
    let at = |row: Option<usize>| row.and_then(|row| column.get(row)).copied().unwrap_or_default();
    let beside = if across > 1 && i.is_multiple_of(across) { None } else { i.checked_sub(1) };
    let before = i.checked_sub(across);
    let corner = beside.and_then(|row| row.checked_sub(across));
    at(beside) + at(before) - at(corner)
}
