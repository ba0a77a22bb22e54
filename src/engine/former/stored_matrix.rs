//! Matrices as model files keep them.
//!
//! The modes of a basis are kept to an accuracy of the fields they make ([`Multiples`]): each value is a multiple of a
//! power of two, and what is kept is by how many of them it misses the polynomial through the nodes before it: of fields that are
//! smooth small integers, which are packed by how often each of them comes. Nodes where no mode has a value are left out.

mod curves;
mod former;
mod sorted;

use crate::solver::reduced::{Multiples, PodBasis};
use curves::{Curves, Lattice, runs};
use faer::Mat;
use former::Steps;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use sorted::Sorted;

/// How far, relative to itself, a row of a cubature may lie from a multiple of the modes at its node: as rare modes do that
/// were kept once.
const ITS_OWN: f64 = 1e-3;

/// A matrix on its way to or from a file.
#[derive(Clone, Default, Serialize, Deserialize)]
pub(super) struct StoredMatrix {
    rows: usize,
    columns: usize,
    values: Values,
}

/// New variants go to the end, so that older files stay readable.
#[derive(Clone, Serialize, Deserialize)]
enum Values {
    Double(Vec<f64>),
    Single(Vec<f32>),
    Steps(Steps),
    Curves(Curves),
    /// Of each column the multiple that it is of what another matrix has there.
    Weights(Vec<f32>),
    /// Curves without their misses, and these packed.
    Packed(Curves, Vec<u8>),
    /// Curves without their misses, and these sorted by those beside them.
    Sorted(Curves, Sorted),
}

impl Default for Values {
    fn default() -> Self {
        Self::Double(Vec::new())
    }
}

/// A basis on its way to or from a file.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct StoredBasis {
    pub modes: StoredMatrix,
    singular_values: Vec<f64>,
}

impl StoredMatrix {
    /// The same with the columns of a cubature that was kept as its weights, given what so many modes are at the nodes of
    /// its rows. `None` where these do not fit it.
    pub fn of_modes(self, modes: impl FnOnce() -> Mat<f64>) -> Option<Self> {
        let Values::Weights(weights) = &self.values else { return Some(self) };
        let modes = modes();
        let fits = (self.rows, self.columns) == (modes.ncols(), modes.nrows()) && weights.len() == self.columns;
        let columns = modes.row_iter().zip(weights);
        let values = || columns.flat_map(|(node, &weight)| node.iter().map(move |value| f64::from(weight) * value));
        fits.then(|| Self { values: Values::Double(values().collect()), ..self })
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
            Values::Curves(curves) => curves.values(rows, columns)?,
            Values::Packed(curves, misses) => curves.with_misses(&misses)?.values(rows, columns)?,
            Values::Sorted(curves, misses) => curves.with_sorted(misses, rows)?.values(rows, columns)?,
            Values::Weights(_) => return None,
        };
        let sound = values.len() == count && values.iter().all(|v| v.is_finite());
        sound.then(|| Mat::from_fn(rows, columns, |i, j| values.get(j * rows + i).copied().unwrap_or_default()))
    }
}

impl StoredBasis {
    /// Entries of the node arrays that its modes say they are.
    pub fn rows(&self) -> usize {
        self.modes.rows
    }

    /// Modes that it says there are.
    pub fn columns(&self) -> usize {
        self.modes.columns
    }

    /// Singular values that it has.
    pub fn known(&self) -> usize {
        self.singular_values.len()
    }

    /// In place of a basis that is kept elsewhere: no modes over so many rows.
    pub fn elsewhere(rows: usize) -> Self {
        Self { modes: StoredMatrix { rows, ..StoredMatrix::default() }, singular_values: Vec::new() }
    }

    /// The singular values, if they are sound.
    pub fn into_singular_values(self) -> Option<Vec<f64>> {
        Some(self.singular_values).filter(|values| values.iter().all(|value| value.is_finite()))
    }

    /// The basis, if it has `rows` rows and is sound.
    pub fn into_basis(self, rows: usize) -> Option<PodBasis> {
        let sound =
            self.singular_values.len() >= self.modes.columns && self.singular_values.iter().all(|v| v.is_finite());
        let modes = self.modes.into_mat(rows).filter(|_| sound)?;
        Some(PodBasis { modes, singular_values: self.singular_values })
    }
}
