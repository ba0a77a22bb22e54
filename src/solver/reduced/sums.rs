//! Sums over modes, which take most of the time of a solve. They use the widest vector registers of the machine, but
//! always the same order, so that results do not depend on the machine.
//!
//! Code inside a dispatch must be inlined: each sum is a struct with a plain loop, without closures.
#![allow(clippy::needless_range_loop, reason = "neighbouring columns are read at the same place")]

use pulp::{Arch, Simd, WithSimd};

/// Number of partial sums per product.
const BESIDE: usize = 8;

/// One node of a row: modes, deformation of the modes, and derivatives of the row by both values.
#[derive(Clone, Copy)]
pub(super) struct RowNode<'a> {
    pub values: &'a [f64],
    pub deformations: &'a [f64],
    pub by_value: f64,
    pub by_deformation: f64,
}

/// Computes a row of the Jacobian: the sum over its nodes, one after the other.
pub(super) fn jacobian_row<const N: usize>(nodes: [RowNode<'_>; N], out: &mut [f64]) {
    Arch::new().dispatch(JacobianRow { nodes, out });
}

struct JacobianRow<'a, const N: usize> {
    nodes: [RowNode<'a>; N],
    out: &'a mut [f64],
}

impl<const N: usize> WithSimd for JacobianRow<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { mut nodes, out } = self;
        // Columns as long as the row avoid bounds checks in the loop.
        let modes = out.len();
        for node in &mut nodes {
            (node.values, node.deformations) = (&node.values[..modes], &node.deformations[..modes]);
        }
        for k in 0..modes {
            let mut sum = 0.0;
            for node in &nodes {
                sum += node.by_value * node.values[k] + node.by_deformation * node.deformations[k];
            }
            out[k] = sum;
        }
    }
}

/// Multiplies the first rows of a row-major matrix by x; `out` determines their number.
pub(super) fn rows_times<T: Copy + Into<f64>>(rows: &[T], x: &[f64], out: &mut [f64]) {
    Arch::new().dispatch(RowsTimes { rows, x, out });
}

/// Multiplies row `place` of a row-major matrix by x.
pub(super) fn row_times(rows: &[f64], place: usize, x: &[f64]) -> f64 {
    let mut out = [0.0];
    rows_times(&rows[place * x.len()..], x, &mut out);
    out[0]
}

struct RowsTimes<'a, T> {
    rows: &'a [T],
    x: &'a [f64],
    out: &'a mut [f64],
}

impl<T: Copy + Into<f64>> WithSimd for RowsTimes<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { rows, x, out } = self;
        let whole = x.len() - x.len() % BESIDE;
        for (row, out) in rows.chunks_exact(x.len()).zip(out) {
            let mut sums = [0.0; BESIDE];
            for (row, x) in row[..whole].chunks_exact(BESIDE).zip(x[..whole].chunks_exact(BESIDE)) {
                for k in 0..BESIDE {
                    sums[k] += row[k].into() * x[k];
                }
            }
            let (mut sum, mut rest) = (0.0, 0.0);
            for beside in sums {
                sum += beside;
            }
            for (row, x) in row[whole..].iter().zip(&x[whole..]) {
                rest += (*row).into() * x;
            }
            *out = sum + rest;
        }
    }
}

/// Adds columns times their factors to sums, one after the other.
pub(super) fn add_columns<T: Copy + Into<f64>, const N: usize>(columns: [(f64, &[T]); N], out: &mut [f64]) {
    Arch::new().dispatch(AddColumns { columns, out });
}

struct AddColumns<'a, T, const N: usize> {
    columns: [(f64, &'a [T]); N],
    out: &'a mut [f64],
}

impl<T: Copy + Into<f64>, const N: usize> WithSimd for AddColumns<'_, T, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { mut columns, out } = self;
        let size = out.len();
        for (_, column) in &mut columns {
            *column = &column[..size];
        }
        for k in 0..size {
            let mut sum = out[k];
            for (factor, column) in &columns {
                sum += factor * column[k].into();
            }
            out[k] = sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Different numbers in every column.
    fn column(own: usize, len: usize) -> Vec<f64> {
        (0..len).map(|k| ((own * 37 + k * 11) as f64 * 0.7).sin()).collect()
    }

    #[test]
    fn rows_of_any_length_are_the_plain_sums() {
        for modes in [1, 3, 8, 44, 61] {
            let (columns, x) = ((0..12).map(|own| column(own, modes)).collect::<Vec<_>>(), column(99, modes));
            let node = |m: usize| RowNode {
                values: &columns[2 * m],
                deformations: &columns[2 * m + 1],
                by_value: 0.3 + m as f64,
                by_deformation: 1.0 - 0.4 * m as f64,
            };
            let (mut out, mut sums) = (vec![f64::NAN; modes], x.clone());
            jacobian_row::<6>(std::array::from_fn(node), &mut out);
            let single: Vec<f32> = columns[0].iter().map(|value| *value as f32).collect();
            add_columns([(2.0, single.as_slice()), (-3.0, &single)], &mut sums);
            for k in 0..modes {
                let of =
                    |m: usize| node(m).by_value * columns[2 * m][k] + node(m).by_deformation * columns[2 * m + 1][k];
                assert!((out[k] - (0..6).map(of).sum::<f64>()).abs() < 1e-14, "{modes} {k}");
                assert!((sums[k] - (x[k] - f64::from(single[k]))).abs() < 1e-15, "{modes} {k}");
            }
            let rows: Vec<f64> = columns.concat();
            let mut products = [0.0; 12];
            rows_times(&rows, &x, &mut products);
            for (place, product) in products.into_iter().enumerate() {
                let plain: f64 = columns[place].iter().zip(&x).map(|(a, b)| a * b).sum();
                assert!((product - plain).abs() < 1e-13, "{modes} {place}");
                assert_eq!(product, row_times(&rows, place, &x));
            }
        }
    }
}
