//! Matrices as model files keep them.
//!
//! The modes of a basis are kept to an accuracy of the fields they make ([`Multiples`]): each value is a multiple of a
//! power of two, and what is kept is by how many of them it misses the polynomial through the nodes before it: of fields that are
//! smooth small integers, which are packed by how often each of them comes. Nodes where no mode has a value are left out.

mod curves;
mod former;
mod sorted;

use crate::host::pool::on_all_cores;
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
    /// To the last digit.
    pub fn exact(matrix: &Mat<f64>) -> Self {
        let values = matrix.col_iter().flat_map(|column| column.iter().copied()).collect();
        Self { rows: matrix.nrows(), columns: matrix.ncols(), values: Values::Double(values) }
    }

    /// A cubature by its weights, to seven digits: column r is a multiple of what all modes are at the node of row r, rows ×
    /// modes. `None` where it is not.
    pub fn weights(matrix: &Mat<f64>, modes: &Mat<f64>) -> Option<Self> {
        if (matrix.nrows(), matrix.ncols()) != (modes.ncols(), modes.nrows()) {
            return None;
        }
        let weight = |r: usize| {
            let (column, node) = (matrix.col(r), modes.row(r).transpose());
            let square = node.squared_norm_l2();
            let weight = if square > 0.0 { node.transpose() * column / square } else { 0.0 };
            let off = (column - node * faer::Scale(weight)).norm_l2();
            (off <= ITS_OWN * column.norm_l2()).then_some(weight as f32)
        };
        let weights = (0..matrix.ncols()).map(weight).collect::<Option<_>>()?;
        Some(Self { rows: matrix.nrows(), columns: matrix.ncols(), values: Values::Weights(weights) })
    }

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

    /// Columns over a grid with so many nodes across, kept as [`Multiples::keep`] does.
    pub fn stepped(matrix: &Mat<f64>, across: usize, scales: &[f64], [accuracy, least]: [f64; 2]) -> Self {
        let (rows, columns) = (matrix.nrows(), matrix.ncols());
        let (multiples, matrix) = Multiples::keep(matrix.clone(), scales, accuracy, least);
        let Multiples { rows: exponents, columns: column_exponents } = multiples;
        let used: Vec<bool> = exponents.iter().map(Option::is_some).collect();
        let row_exponents: Vec<i16> = exponents.into_iter().flatten().collect();
        let lattice = Lattice::new(&used, across, &row_exponents);
        let kept = column_exponents.par_iter().enumerate().map(|(k, exponent)| {
            let column: Vec<f64> = matrix.col(k).iter().copied().collect();
            lattice.shortest(&column, *exponent)
        });
        let (orders, misses): (Vec<_>, Vec<_>) = on_all_cores(|| kept.collect::<Vec<_>>()).into_iter().unzip();
        let (runs, misses) = (runs(&used), misses.concat());
        let curves = Curves { across, runs, row_exponents, column_exponents, orders, misses };
        Self { rows, columns, values: curves.packed(&used) }
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
    /// A basis over a grid with so many nodes across. What each mode loses changes the fields of the snapshots by
    /// `accuracy` of their size at every node at most (both as root mean squares over the snapshots).
    pub fn new(basis: &PodBasis, across: usize, accuracy: f64) -> Self {
        let modes = StoredMatrix::stepped(&basis.modes, across, &basis.scales(), [accuracy, 0.0]);
        Self { modes, singular_values: basis.singular_values.clone() }
    }

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

    /// The singular values of a basis over so many rows whose modes are kept elsewhere.
    pub fn without_modes(singular_values: &[f64], rows: usize) -> Self {
        Self { singular_values: singular_values.to_vec(), ..Self::elsewhere(rows) }
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

#[cfg(test)]
mod tests {
    use super::curves::bits;
    use super::*;
    use pco::ChunkConfig;
    use pco::standalone::simple_compress;

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
        // Two steps of a quarter, one beyond what both neighbours let expect, one of a half beyond the straight line.
        let (across, runs, row_exponents) = (1, vec![0, 3], vec![0, 0, 1]);
        let steps =
            Steps { across, runs, row_exponents, column_exponents: vec![-2, -3], steps: vec![2, 1, 1, 0, 0, 4] };
        let former = stored(Values::Steps(steps)).into_mat(3).unwrap();
        assert_eq!(former, Mat::from_fn(3, 2, |i, j| [[0.5, 1.25, 2.5], [0.0, 0.0, 1.0]][j][i]));
    }

    #[test]
    fn a_cubature_is_kept_as_its_weights() {
        let modes = Mat::from_fn(9, 4, |r, k| ((r + 2) as f64 * (0.3 + k as f64)).sin());
        let weight = |r: usize| 0.1 + (r as f64).sqrt();
        let rule = Mat::from_fn(4, 9, |k, r| weight(r) * modes[(r, k)]);
        let stored = StoredMatrix::weights(&rule, &modes).unwrap();
        let bytes = postcard::to_allocvec(&stored).unwrap();
        assert!(bytes.len() < 9 * 4 + 8, "{} bytes", bytes.len());
        let read = || postcard::from_bytes::<StoredMatrix>(&bytes).unwrap();
        let again = read().of_modes(|| modes.clone()).unwrap().into_mat(4).unwrap();
        assert!((&again - &rule).norm_max() < 1e-6 * rule.norm_max());
        // Once kept it is kept as it is.
        let twice = StoredMatrix::weights(&again, &modes).unwrap();
        assert_eq!(postcard::to_allocvec(&twice).unwrap(), bytes);
        // Rows that only their own nodes do not make are none.
        let mut other = rule.clone();
        other[(2, 5)] += 1e-2 * rule.norm_max();
        assert!(StoredMatrix::weights(&other, &modes).is_none());
        assert!(StoredMatrix::weights(&rule.transpose().to_owned(), &modes).is_none());
        assert!(read().into_mat(4).is_none(), "weights alone are no matrix");
        assert!(read().of_modes(|| modes.get(..8, ..).to_owned()).is_none());
        assert!(StoredMatrix::exact(&rule).of_modes(Mat::new).unwrap().into_mat(4).unwrap() == rule);
    }

    #[test]
    fn parts_that_do_not_fit_each_other_are_refused() {
        let stored = || StoredBasis::new(&basis(), 5, 1e-6);
        assert!(stored().into_basis(149).is_none() && stored().into_basis(usize::MAX).is_none());
        let spoiled = |spoil: &dyn Fn(&mut Curves, &mut Vec<u8>)| {
            let mut stored = stored();
            let Values::Packed(curves, packed) = &mut stored.modes.values else { panic!("misses are packed") };
            spoil(curves, packed);
            stored.into_basis(150).is_none()
        };
        assert!(!spoiled(&|_, _| {}));
        assert!(spoiled(&|curves, _| curves.runs.push(usize::MAX)));
        assert!(spoiled(&|curves, _| curves.runs[0] += 1));
        assert!(spoiled(&|curves, _| curves.across = 0));
        assert!(spoiled(&|curves, _| curves.row_exponents[0] = i16::MAX));
        assert!(spoiled(&|curves, _| curves.row_exponents.resize(1 << 20, 0)));
        assert!(spoiled(&|curves, _| curves.column_exponents.truncate(1)));
        assert!(spoiled(&|curves, _| curves.orders[2].0 = 200));
        assert!(spoiled(&|curves, _| curves.orders.truncate(1)));
        assert!(spoiled(&|_, packed| packed.truncate(packed.len() / 2)));
        assert!(spoiled(&|_, packed| packed.fill(0x55)));
        assert!(spoiled(&|_, packed| *packed = simple_compress(&[7i64; 571], &ChunkConfig::default()).unwrap()));
    }

    #[test]
    fn misses_are_kept_packed_or_as_they_are() {
        let mut stored = StoredBasis::new(&basis(), 5, 1e-6);
        let modes = stored.clone().into_basis(150).unwrap().modes;
        let Values::Packed(curves, packed) = stored.modes.values else { panic!("misses are packed") };
        // As version 12 has them.
        let plain = curves.with_misses(&packed).unwrap();
        let bytes: u32 = plain.misses.iter().map(|miss| bits(*miss).div_ceil(7).max(1)).sum();
        assert!(packed.len() < bytes as usize, "{} packed into {}", bytes, packed.len());
        stored.modes.values = Values::Curves(plain.clone());
        assert!(stored.into_basis(150).unwrap().modes == modes);
        // What packs so well that a few bytes would ask for much is not packed.
        let still = Curves { misses: vec![0; plain.misses.len()], ..plain };
        assert!(matches!(still.packed(&[true; 150]), Values::Curves(_)));
    }
}
