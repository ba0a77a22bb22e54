//! Serialisation of matrices: numbers of rows and columns, and the entries column by column.

use faer::Mat;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Serialises a matrix.
///
/// # Errors
/// Those of the serialiser.
pub fn serialize<S: Serializer>(matrix: &Mat<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    let entries: Vec<f64> = matrix.col_iter().flat_map(|column| column.iter()).copied().collect();
    (matrix.nrows(), matrix.ncols(), entries).serialize(serializer)
}

/// Reads a matrix.
///
/// # Errors
/// If the number of entries is not rows × columns.
pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Mat<f64>, D::Error> {
    let (rows, columns, entries) = <(usize, usize, Vec<f64>)>::deserialize(deserializer)?;
    if rows.checked_mul(columns) != Some(entries.len()) {
        return Err(D::Error::custom(format!(
            "a matrix of {rows} rows and {columns} columns has {} entries",
            entries.len()
        )));
    }
    Ok(Mat::from_fn(rows, columns, |i, j| entries[j * rows + i]))
}
