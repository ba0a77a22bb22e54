//! Matrices as model files keep them.
//!
//! The modes of a basis are kept to an accuracy of the fields they make, relative to the fields' own size at each node:
//! a mode that hardly appears in any solution needs few digits, and a node where pressures are small as many as any
//! other, since the mobility of thick films multiplies what is lost there. Each value is the one that its neighbours
//! let expect plus a multiple of a power of two; the multiples are small, and small integers take one or two bytes.
//! Nodes where no mode has a value are left out.

use crate::solver::reduced::PodBasis;
use faer::Mat;
use serde::{Deserialize, Serialize};

/// Modes are kept as if none were rarer than this, relative to the first one.
const RAREST: f64 = 1e-5;
/// Fields are nowhere kept as if they were smaller than this, relative to their largest value.
const SMALLEST: f64 = 1e-30;
/// Exponents beyond these belong to no field.
const EXPONENTS: std::ops::RangeInclusive<i16> = -400..=400;

/// A matrix on its way to or from a file.
#[derive(Serialize, Deserialize)]
pub(super) struct StoredMatrix {
    rows: usize,
    columns: usize,
    values: Values,
}

/// New variants go to the end, so that older files stay readable.
#[derive(Serialize, Deserialize)]
enum Values {
    Double(Vec<f64>),
    Single(Vec<f32>),
    Steps(Steps),
}

/// Columns over a grid in steps of 2^(exponent of the row + exponent of the column).
#[derive(Serialize, Deserialize)]
struct Steps {
    /// Nodes across: rows i and i − across are neighbours along X.
    across: usize,
    /// Lengths of runs of rows without and with values, in turn.
    runs: Vec<usize>,
    /// Of the rows with values.
    row_exponents: Vec<i16>,
    column_exponents: Vec<i16>,
    /// Steps from the prediction at the rows with values, column after column.
    steps: Vec<i64>,
}

/// A basis on its way to or from a file.
#[derive(Serialize, Deserialize)]
pub(super) struct StoredBasis {
    pub modes: StoredMatrix,
    singular_values: Vec<f64>,
}

impl StoredMatrix {
    /// To the last digit.
    pub fn exact(matrix: &Mat<f64>) -> Self {
        let values = matrix.col_iter().flat_map(|column| column.iter().copied()).collect();
        Self { rows: matrix.nrows(), columns: matrix.ncols(), values: Values::Double(values) }
    }

    /// Columns over a grid with so many nodes across, kept to `accuracy` relative to the size Σ_k (scale_k V_ik)² of
    /// each row.
    fn stepped(matrix: &Mat<f64>, across: usize, scales: &[f64], accuracy: f64) -> Self {
        let (rows, columns) = (matrix.nrows(), matrix.ncols());
        let size = |i: usize| scales.iter().enumerate().map(|(k, s)| (s * matrix[(i, k)]).powi(2)).sum::<f64>().sqrt();
        let sizes: Vec<f64> = (0..rows).map(size).collect();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        let used: Vec<bool> = sizes.iter().map(|size| *size > SMALLEST * largest).collect();
        let exponent = |step: f64| step.log2().floor() as i16;
        let row_exponents =
            sizes.iter().zip(&used).filter(|(_, used)| **used).map(|(size, _)| exponent(*size)).collect();
        let column_exponents = scales.iter().map(|scale| exponent(accuracy / scale)).collect();
        let mut steps = Steps { across, runs: runs(&used), row_exponents, column_exponents, steps: Vec::new() };
        for k in 0..columns {
            let mut taken = Vec::with_capacity(steps.row_exponents.len());
            steps.walk(k, &used, |i, predicted, step| {
                let count = ((matrix[(i, k)] - predicted) / step).round() as i64;
                taken.push(count);
                Some(count)
            });
            steps.steps.extend(taken);
        }
        Self { rows, columns, values: Values::Steps(steps) }
    }

    /// Rows that it says it has.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The matrix, if it has `rows` rows and is sound.
    pub fn into_mat(self, rows: usize) -> Option<Mat<f64>> {
        let columns = self.columns;
        let count = rows.checked_mul(columns).filter(|_| self.rows == rows)?;
        let values = match self.values {
            Values::Double(values) => values,
            Values::Single(values) => values.into_iter().map(f64::from).collect(),
            Values::Steps(steps) => steps.values(rows, columns)?,
        };
        let sound = values.len() == count && values.iter().all(|v| v.is_finite());
        sound.then(|| Mat::from_fn(rows, columns, |i, j| values.get(j * rows + i).copied().unwrap_or_default()))
    }
}

impl Steps {
    /// Column after column; `None` when its parts do not fit each other.
    fn values(self, rows: usize, columns: usize) -> Option<Vec<f64>> {
        let used = flags(&self.runs, rows)?;
        let per_column = used.iter().filter(|used| **used).count();
        let sane = |exponents: &[i16]| exponents.iter().all(|exponent| EXPONENTS.contains(exponent));
        let fits = self.across > 0
            && (self.row_exponents.len(), self.column_exponents.len()) == (per_column, columns)
            && sane(&self.row_exponents)
            && sane(&self.column_exponents)
            && per_column.checked_mul(columns) == Some(self.steps.len());
        if !fits {
            return None;
        }
        let mut counts = self.steps.iter();
        let mut values = Vec::with_capacity(rows * columns);
        for k in 0..columns {
            values.extend(self.walk(k, &used, |_, _, _| counts.next().copied())?);
        }
        Some(values)
    }

    /// Goes through a column: `count` says how many steps the value of a row lies from its prediction, given both.
    fn walk(
        &self,
        column: usize,
        used: &[bool],
        mut count: impl FnMut(usize, f64, f64) -> Option<i64>,
    ) -> Option<Vec<f64>> {
        let mut values = vec![0.0; used.len()];
        let mut exponents = self.row_exponents.iter();
        let of_column = self.column_exponents.get(column)?;
        for (i, _) in used.iter().enumerate().filter(|(_, used)| **used) {
            let step = f64::from(exponents.next()? + of_column).exp2();
            let predicted = predicted(&values, i, self.across);
            *values.get_mut(i)? = predicted + step * count(i, predicted, step)? as f64;
        }
        Some(values)
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

/// Lengths of runs of rows that are not and that are used, in turn.
fn runs(used: &[bool]) -> Vec<usize> {
    let mut runs = Vec::new();
    let (mut current, mut length) = (false, 0);
    for &used in used {
        if used != current {
            runs.push(length);
            (current, length) = (used, 0);
        }
        length += 1;
    }
    runs.push(length);
    runs
}

/// The rows that runs say are used; `None` when they make another number of rows.
fn flags(runs: &[usize], rows: usize) -> Option<Vec<bool>> {
    let total = runs.iter().try_fold(0usize, |sum, run| sum.checked_add(*run))?;
    if total != rows {
        return None;
    }
    Some(runs.iter().enumerate().flat_map(|(k, &run)| std::iter::repeat_n(k % 2 == 1, run)).collect())
}

impl StoredBasis {
    /// A basis over a grid with so many nodes across. What each mode loses changes the fields of the snapshots by
    /// `accuracy` of their size at every node at most (both as root mean squares over the snapshots).
    pub fn new(basis: &PodBasis, across: usize, accuracy: f64) -> Self {
        let sigma = &basis.singular_values;
        let (largest, count) = (sigma.first().copied().unwrap_or(1.0).max(f64::MIN_POSITIVE), sigma.len() as f64);
        // σ_k is √N times the root mean square of the coefficients of mode k.
        let scales = sigma.iter().take(basis.modes.ncols()).map(|s| s.max(RAREST * largest) / count.sqrt());
        let scales: Vec<f64> = scales.collect();
        Self { modes: StoredMatrix::stepped(&basis.modes, across, &scales, accuracy), singular_values: sigma.clone() }
    }

    /// Entries of the node arrays that its modes say they are.
    pub fn rows(&self) -> usize {
        self.modes.rows
    }

    /// Modes that it says there are.
    pub fn columns(&self) -> usize {
        self.modes.columns
    }

    /// The basis, if it has `rows` rows and is sound.
    pub fn into_basis(self, rows: usize) -> Option<PodBasis> {
        let sound =
            self.singular_values.len() >= self.modes.columns && self.singular_values.iter().all(|v| v.is_finite());
        let modes = self.modes.into_mat(rows).filter(|_| sound)?;
        Some(PodBasis { modes, singular_values: self.singular_values })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Modes over 30 × 5 nodes that vanish at the first seven rows and have falling singular values.
    fn basis() -> PodBasis {
        let value = |i: usize, k: usize| ((i / 5 + 3 * k) as f64 * 0.2).sin() * (1.0 + 0.1 * (i % 5) as f64);
        let modes = Mat::from_fn(150, 4, |i, k| if i < 7 { 0.0 } else { value(i, k) });
        PodBasis { modes, singular_values: vec![20.0, 1.0, 1e-2, 1e-4, 1e-6] }
    }

    #[test]
    fn modes_keep_the_accuracy_of_the_fields_they_make() {
        let basis = basis();
        for (across, accuracy) in [(5, 1e-6), (1, 1e-9)] {
            let again = StoredBasis::new(&basis, across, accuracy).into_basis(150).unwrap();
            assert_eq!(again.singular_values, basis.singular_values);
            for (k, sigma) in basis.singular_values.iter().take(4).enumerate() {
                let off = (0..150).map(|i| (again.modes[(i, k)] - basis.modes[(i, k)]).abs()).fold(0.0, f64::max);
                // The first mode makes the size of the fields.
                let size = |i: usize| {
                    (0..4).map(|k| (basis.modes[(i, k)] * basis.singular_values[k]).powi(2)).sum::<f64>().sqrt()
                };
                let largest = (0..150).map(size).fold(0.0, f64::max);
                let field = off * sigma / largest;
                assert!(field > 0.0 && field <= accuracy, "mode {k}: {field:e}");
                assert!((0..7).all(|i| again.modes[(i, k)] == 0.0));
            }
        }
    }

    #[test]
    fn what_was_kept_once_is_kept_exactly_and_takes_few_bytes() {
        let encode = |basis: &PodBasis| postcard::to_allocvec(&StoredBasis::new(basis, 5, 1e-6)).unwrap();
        let bytes = encode(&basis());
        assert!(bytes.len() < 3 * 4 * 143, "{} bytes", bytes.len());
        let stored: StoredBasis = postcard::from_bytes(&bytes).unwrap();
        assert_eq!(encode(&stored.into_basis(150).unwrap()), bytes);
    }

    #[test]
    fn matrices_of_former_versions_are_understood() {
        let matrix = Mat::from_fn(3, 2, |i, j| 0.5 * i as f64 - j as f64);
        let values: Vec<f32> = vec![0.0, 0.5, 1.0, -1.0, -0.5, 0.0];
        let stored = |values| StoredMatrix { rows: 3, columns: 2, values };
        assert!(stored(Values::Single(values.clone())).into_mat(3).unwrap() == matrix);
        assert!(stored(Values::Double(values.iter().map(|v| f64::from(*v)).collect())).into_mat(3).unwrap() == matrix);
        assert!(StoredMatrix::exact(&matrix).into_mat(3).unwrap() == matrix);
        assert!(stored(Values::Single(values[1..].to_vec())).into_mat(3).is_none());
        assert!(stored(Values::Double(vec![f64::NAN; 6])).into_mat(3).is_none());
    }

    #[test]
    fn parts_that_do_not_fit_each_other_are_refused() {
        let stored = || StoredBasis::new(&basis(), 5, 1e-6);
        assert!(stored().into_basis(149).is_none() && stored().into_basis(usize::MAX).is_none());
        let spoiled = |spoil: &dyn Fn(&mut Steps)| {
            let mut stored = stored();
            if let Values::Steps(steps) = &mut stored.modes.values {
                spoil(steps);
            }
            stored.into_basis(150).is_none()
        };
        assert!(spoiled(&|steps| steps.runs.push(usize::MAX)));
        assert!(spoiled(&|steps| steps.runs[0] += 1));
        assert!(spoiled(&|steps| steps.across = 0));
        assert!(spoiled(&|steps| steps.row_exponents[0] = i16::MAX));
        assert!(spoiled(&|steps| steps.column_exponents.truncate(1)));
        assert!(spoiled(&|steps| steps.steps.truncate(1)));
    }
}
