//! Columns over a grid in whole numbers: by how many multiples of a power of two they miss the polynomial through the nodes
//! before.

use super::Values;
use super::sorted::{Neighbours, Sorted};
use crate::engine::former::packed::{packed, unpacked};
use pco::{ChunkConfig, DeltaSpec, ModeSpec};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Exponents beyond these belong to no field.
const EXPONENTS: std::ops::RangeInclusive<i16> = -400..=400;
/// Highest orders of the polynomials that are continued along X and across.
const MOST_ALONG: u8 = 5;
const MOST_BESIDE: u8 = 2;
/// So many packed misses take a byte at most.
const MOST_PACKED: usize = 4;
/// Bytes that kinds may take beside their packed misses: some six for each of some fifty.
const OF_KINDS: usize = 300;

/// Columns over a grid as multiples of 2^(exponent of the row + exponent of the column).
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Curves {
    /// Nodes across: rows i and i − across are neighbours along X.
    pub across: usize,
    /// Lengths of runs of rows without and with values, in turn.
    pub runs: Vec<usize>,
    /// Of the rows with values.
    pub row_exponents: Vec<i16>,
    pub column_exponents: Vec<i16>,
    /// Of each column the orders along X and across of the polynomial that is continued.
    pub orders: Vec<(u8, u8)>,
    /// By how many multiples the rows with values miss it, column after column.
    pub misses: Vec<i64>,
}

impl Curves {
    /// With the misses that were packed; `None` when these are not as many as the rest says, or more than so many bytes
    /// can be.
    pub fn with_misses(mut self, packed: &[u8]) -> Option<Self> {
        let count = self.row_exponents.len().checked_mul(self.column_exponents.len())?;
        self.misses = unpacked(count, packed, MOST_PACKED)?;
        Some(self)
    }

    /// The same of misses that were sorted, of so many rows.
    pub fn with_sorted(mut self, sorted: Sorted, rows: usize) -> Option<Self> {
        let fits =
            |used: &Vec<bool>| self.across > 0 && used.iter().filter(|used| **used).count() == self.row_exponents.len();
        let neighbours = Neighbours::of(&flags(&self.runs, rows).filter(fits)?, self.across);
        self.misses = sorted.into_numbers(&neighbours, self.column_exponents.len(), MOST_PACKED)?;
        Some(self)
    }

    /// Column after column; `None` when its parts do not fit each other.
    pub fn values(self, rows: usize, columns: usize) -> Option<Vec<f64>> {
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
pub(super) struct Lattice<'a> {
    used: &'a [bool],
    across: usize,
    /// 2^exponent of the rows with values.
    row_steps: Vec<f64>,
}

impl<'a> Lattice<'a> {
    pub fn new(used: &'a [bool], across: usize, row_exponents: &[i16]) -> Self {
        Self { used, across, row_steps: row_exponents.iter().map(|exponent| f64::from(*exponent).exp2()).collect() }
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
pub(super) fn bits(value: i64) -> u32 {
    i64::BITS - ((value << 1) ^ (value >> 63)).leading_zeros()
}

pub(super) fn sane(exponents: &[i16]) -> bool {
    exponents.iter().all(|exponent| EXPONENTS.contains(exponent))
}

/// Lengths of runs of rows that are not and that are used, in turn.
pub(super) fn runs(used: &[bool]) -> Vec<usize> {
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
pub(super) fn flags(runs: &[usize], rows: usize) -> Option<Vec<bool>> {
    let total = runs.iter().try_fold(0usize, |sum, run| sum.checked_add(*run))?;
    if total != rows {
        return None;
    }
    Some(runs.iter().enumerate().flat_map(|(k, &run)| std::iter::repeat_n(k % 2 == 1, run)).collect())
}
