//! Matrices as model files keep them.
//!
//! The modes of a basis are kept to an accuracy of the fields they make ([`Multiples`]): each value is a multiple of a
//! power of two, and what is kept is by how many of them it misses the polynomial through the nodes before it: of fields that are
//! smooth small integers, which are packed by how often each of them comes. Nodes where no mode has a value are left out.

use crate::solver::reduced::{Multiples, PodBasis};
use faer::Mat;
use pco::standalone::{simple_compress, simple_decompress_into};
use pco::{ChunkConfig, DeltaSpec, ModeSpec};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Exponents beyond these belong to no field.
const EXPONENTS: std::ops::RangeInclusive<i16> = -400..=400;
/// Highest orders of the polynomials that are continued along X and across.
const MOST_ALONG: u8 = 5;
const MOST_BESIDE: u8 = 2;
/// So many packed misses take a byte at most: what is read takes no more memory than its bytes may ask for.
const MOST_PACKED: usize = 4;

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
}

impl Default for Values {
    fn default() -> Self {
        Self::Double(Vec::new())
    }
}

/// Columns over a grid as multiples of 2^(exponent of the row + exponent of the column).
#[derive(Clone, Serialize, Deserialize)]
struct Curves {
    /// Nodes across: rows i and i − across are neighbours along X.
    across: usize,
    /// Lengths of runs of rows without and with values, in turn.
    runs: Vec<usize>,
    /// Of the rows with values.
    row_exponents: Vec<i16>,
    column_exponents: Vec<i16>,
    /// Of each column the orders along X and across of the polynomial that is continued.
    orders: Vec<(u8, u8)>,
    /// By how many multiples the rows with values miss it, column after column.
    misses: Vec<i64>,
}

/// What former versions kept: values in steps of 2^(exponent of the row + exponent of the column) from the straight
/// continuation of the values before them.
#[derive(Clone, Serialize, Deserialize)]
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

    /// Columns over a grid with so many nodes across, kept to `accuracy` relative to the size Σ_k (scale_k V_ik)² of
    /// each row.
    pub fn stepped(matrix: &Mat<f64>, across: usize, scales: &[f64], accuracy: f64) -> Self {
        let (rows, columns) = (matrix.nrows(), matrix.ncols());
        let (multiples, matrix) = Multiples::keep(matrix.clone(), scales, accuracy);
        let Multiples { rows: exponents, columns: column_exponents } = multiples;
        let used: Vec<bool> = exponents.iter().map(Option::is_some).collect();
        let row_exponents: Vec<i16> = exponents.into_iter().flatten().collect();
        let lattice = Lattice::new(&used, across, &row_exponents);
        let kept = column_exponents.par_iter().enumerate().map(|(k, exponent)| {
            let column: Vec<f64> = matrix.col(k).iter().copied().collect();
            lattice.shortest(&column, *exponent)
        });
        let (orders, misses): (Vec<_>, Vec<_>) = kept.collect::<Vec<_>>().into_iter().unzip();
        let (runs, misses) = (runs(&used), misses.concat());
        let curves = Curves { across, runs, row_exponents, column_exponents, orders, misses };
        Self { rows, columns, values: curves.packed() }
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
            Values::Weights(_) => return None,
        };
        let sound = values.len() == count && values.iter().all(|v| v.is_finite());
        sound.then(|| Mat::from_fn(rows, columns, |i, j| values.get(j * rows + i).copied().unwrap_or_default()))
    }
}

impl Curves {
    /// With the misses packed, unless they are so few bytes that reading them would make much of little.
    fn packed(mut self) -> Values {
        let settings = ChunkConfig::default().with_mode_spec(ModeSpec::Classic).with_delta_spec(DeltaSpec::NoOp);
        match simple_compress(&self.misses, &settings) {
            Ok(packed) if self.misses.len() <= MOST_PACKED * packed.len() => {
                self.misses.clear();
                Values::Packed(self, packed)
            }
            _ => Values::Curves(self),
        }
    }

    /// With the misses that were packed; `None` when these are not as many as the rest says, or more than so many bytes
    /// can be.
    fn with_misses(mut self, packed: &[u8]) -> Option<Self> {
        let count = self.row_exponents.len().checked_mul(self.column_exponents.len())?;
        if count > MOST_PACKED * packed.len() {
            return None;
        }
        self.misses = vec![0; count];
        let read = simple_decompress_into(packed, &mut self.misses).ok()?;
        (read.finished && read.n_processed == count).then_some(self)
    }

    /// Column after column; `None` when its parts do not fit each other.
    fn values(self, rows: usize, columns: usize) -> Option<Vec<f64>> {
        let Self { across, runs, row_exponents, column_exponents, orders, misses } = self;
        let used = flags(&runs, rows)?;
        let per_column = used.iter().filter(|used| **used).count();
        let known = |(along, beside): &(u8, u8)| *along <= MOST_ALONG && *beside <= MOST_BESIDE;
        let fits = across > 0
            && (row_exponents.len(), column_exponents.len(), orders.len()) == (per_column, columns, columns)
            && sane(&row_exponents)
            && sane(&column_exponents)
            && orders.iter().all(known)
            && per_column.checked_mul(columns) == Some(misses.len());
        if !fits {
            return None;
        }
        let lattice = Lattice::new(&used, across, &row_exponents);
        let column = |k: usize| {
            let own = misses.get(k * per_column..(k + 1) * per_column).unwrap_or_default();
            let mut values = vec![0.0; rows];
            lattice.walk(&mut values, *column_exponents.get(k)?, *orders.get(k)?, |place, _, expected| {
                own.get(place).map_or(0, |miss| expected.saturating_add(*miss))
            });
            Some(values)
        };
        Some((0..columns).into_par_iter().map(column).collect::<Option<Vec<_>>>()?.concat())
    }
}

/// Where the values of a column lie, and on which multiples.
struct Lattice<'a> {
    used: &'a [bool],
    across: usize,
    /// 2^exponent of the rows with values.
    row_steps: Vec<f64>,
}

impl<'a> Lattice<'a> {
    fn new(used: &'a [bool], across: usize, row_exponents: &[i16]) -> Self {
        Self { used, across, row_steps: row_exponents.iter().map(|exponent| f64::from(*exponent).exp2()).collect() }
    }

    /// The orders whose continuation takes the fewest bits to correct, and by how much it misses each row.
    fn shortest(&self, column: &[f64], exponent: i16) -> ((u8, u8), Vec<i64>) {
        let most_beside = if self.across > 1 { MOST_BESIDE } else { 0 };
        let candidates = (1..=MOST_ALONG).flat_map(|along| (0..=most_beside).map(move |beside| (along, beside)));
        let missed = candidates.map(|orders| {
            let (mut misses, mut values) = (Vec::with_capacity(self.row_steps.len()), vec![0.0; column.len()]);
            self.walk(&mut values, exponent, orders, |_, (row, step), expected| {
                let count = (column.get(row).copied().unwrap_or_default() / step).round() as i64;
                misses.push(count.saturating_sub(expected));
                count
            });
            (orders, misses)
        });
        let size = |(_, misses): &(_, Vec<i64>)| misses.iter().map(|miss| bits(*miss)).sum::<u32>();
        missed.min_by_key(size).unwrap_or_default()
    }

    /// Goes through a column, whose values are found as it goes: `count` says which multiple the value of a row is,
    /// given the place among those with values, the row with its step, and the multiple that is expected.
    fn walk(
        &self,
        values: &mut [f64],
        exponent: i16,
        (along, beside): (u8, u8),
        mut count: impl FnMut(usize, (usize, f64), i64) -> i64,
    ) {
        // v − (1 − S)^along (1 − S')^beside v, with S and S' the shifts by a node along X and across.
        let mut terms = Vec::new();
        for (i, a) in signed_binomials(along).into_iter().enumerate() {
            for (j, b) in signed_binomials(beside).into_iter().enumerate().filter(|(j, _)| i + j > 0) {
                terms.push((i * self.across, j, -a * b));
            }
        }
        let rows = self.used.iter().enumerate().filter(|(_, used)| **used).map(|(row, _)| row);
        let of_column = f64::from(exponent).exp2();
        for (place, (row, own)) in rows.zip(&self.row_steps).enumerate() {
            let step = own * of_column;
            let in_line = row % self.across;
            let reached = terms.iter().filter(|(back, aside, _)| *aside <= in_line && back + aside <= row);
            let at = |back: usize| values.get(row - back).copied().unwrap_or_default();
            let expected: f64 = reached.map(|(back, aside, factor)| factor * at(back + aside)).sum();
            let count = count(place, (row, step), (expected / step).round() as i64);
            if let Some(value) = values.get_mut(row) {
                *value = step * count as f64;
            }
        }
    }
}

/// The coefficients of (1 − s)^order.
fn signed_binomials(order: u8) -> Vec<f64> {
    let mut term = 1.0;
    let rest = (1..=order).map(|k| {
        term *= -f64::from(order - k + 1) / f64::from(k);
        term
    });
    std::iter::once(1.0).chain(rest).collect()
}

/// Bits of an integer, the sign among them.
fn bits(value: i64) -> u32 {
    i64::BITS - ((value << 1) ^ (value >> 63)).leading_zeros()
}

fn sane(exponents: &[i16]) -> bool {
    exponents.iter().all(|exponent| EXPONENTS.contains(exponent))
}

impl Steps {
    /// Column after column; `None` when its parts do not fit each other.
    fn values(self, rows: usize, columns: usize) -> Option<Vec<f64>> {
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
        let modes = StoredMatrix::stepped(&basis.modes, across, &basis.scales(), accuracy);
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
    fn what_misses_are_counted_from_is_the_polynomial_through_the_nodes_before() {
        // A cubic along X with a parabola across is met exactly from the fifth line on.
        let (rows, across) = (40, 6);
        let value = |i: usize, j: usize| (i * i * i) as f64 - 40.0 + (j * j) as f64 * (i + 1) as f64;
        let column: Vec<f64> = (0..rows * across).map(|k| value(k / across, k % across)).collect();
        let (used, exponents) = (vec![true; rows * across], vec![0; rows * across]);
        let lattice = Lattice::new(&used, across, &exponents);
        let (orders, misses) = lattice.shortest(&column, 0);
        assert!(orders.0 >= 3, "{orders:?}");
        let mut values = vec![0.0; rows * across];
        let mut missed = Vec::new();
        lattice.walk(&mut values, 0, (4, 2), |_, (row, _), expected| {
            missed.push(column[row] as i64 - expected);
            column[row] as i64
        });
        let within = |k: usize| k / across >= 4 && k % across >= 2;
        assert!(missed.iter().enumerate().filter(|(k, _)| within(*k)).all(|(_, miss)| *miss == 0));
        let size = |misses: &[i64]| misses.iter().map(|miss| bits(*miss)).sum::<u32>();
        assert!(size(&misses) <= size(&missed));
        for (value, size) in
            [(0, 0), (-1, 1), (1, 2), (-2, 2), (2, 3), (63, 7), (-64, 7), (i64::MAX, 64), (i64::MIN, 64)]
        {
            assert_eq!(bits(value), size);
        }
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
        assert!(matches!(still.packed(), Values::Curves(_)));
    }
}
