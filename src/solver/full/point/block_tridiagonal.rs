//! LU factorisation of a block-tridiagonal matrix in single precision, which is sufficient for a preconditioner. Two
//! threads eliminate the blocks from both ends towards the middle, which needs no additional arithmetic. Rows are
//! pivoted inside the blocks only.

use crate::host::pool::{both, on_all_cores};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::linalg::matmul::matmul;
use faer::perm::PermRef;
use faer::{Accum, MatMut, MatRef, Par};
use rayon::prelude::*;
use std::ops::Range;

/// Number of multiplications of each thread between two calls of `go_on`. They take about ten milliseconds.
const PRODUCTS_PER_CHECK: usize = 80_000_000;

/// Square matrix of blocks on three diagonals. [`BlockTridiagonal::factorise`] replaces it by its factors.
#[derive(Clone, Debug, Default)]
pub struct BlockTridiagonal {
    /// Number of rows of a block.
    size: usize,
    /// Number of block rows.
    blocks: usize,
    /// Diagonal blocks, stored column by column; later their LU factors.
    diagonal: Vec<f32>,
    /// Couplings of each block row to the previous block. Those towards the middle are later multiplied by D⁻¹, the
    /// inverse of the diagonal block.
    lower: Vec<f32>,
    /// Couplings of each block row to the next block, changed in the same way.
    upper: Vec<f32>,
    /// Row permutations of the factorised diagonal blocks, one after the other.
    permutation: Vec<usize>,
    /// Their inverses.
    inverse: Vec<usize>,
    /// Work space: right-hand side, then solution.
    values: Vec<f32>,
    /// Work space: permuted right-hand side of one block for each thread.
    permuted: Vec<f32>,
}

/// Three blocks of one block row, each stored column by column.
pub struct BlockRow<'a> {
    /// Index of the block row.
    pub index: usize,
    /// Diagonal block.
    pub diagonal: &'a mut [f32],
    /// Coupling to the previous block.
    pub lower: &'a mut [f32],
    /// Coupling to the next block.
    pub upper: &'a mut [f32],
}

impl BlockTridiagonal {
    /// Resizes to `blocks` × `blocks` blocks of `size` × `size` entries. Entries may keep old values until
    /// [`Self::fill`]. The call is short even for large matrices, because the system clears new memory only at its
    /// first use.
    pub fn reset(&mut self, size: usize, blocks: usize) {
        (self.size, self.blocks) = (size, blocks);
        for entries in [&mut self.diagonal, &mut self.lower, &mut self.upper] {
            if entries.len() != size * size * blocks {
                *entries = vec![0.0; size * size * blocks];
            }
        }
        for indices in [&mut self.permutation, &mut self.inverse] {
            indices.clear();
            indices.resize(size * blocks, 0);
        }
        self.values.resize(size * blocks, 0.0);
        self.permuted.resize(2 * size, 0.0);
    }

    /// Clears all block rows and calls `row` to fill each of them, on all cores. Stops and returns `None` if `row`
    /// returns `None`.
    pub fn fill(&mut self, row: impl Fn(BlockRow<'_>) -> Option<()> + Sync + Send) -> Option<()> {
        let square = (self.size * self.size).max(1);
        on_all_cores(|| {
            let couplings = self.lower.par_chunks_exact_mut(square).zip(self.upper.par_chunks_exact_mut(square));
            let blocks = self.diagonal.par_chunks_exact_mut(square).zip(couplings).enumerate();
            blocks.try_for_each(|(index, (diagonal, (lower, upper)))| {
                [&mut *diagonal, &mut *lower, &mut *upper].into_iter().for_each(|block| block.fill(0.0));
                row(BlockRow { index, diagonal, lower, upper })
            })
        })
    }

    /// Replaces the matrix by its transpose. Call it before [`Self::factorise`].
    pub fn transpose(&mut self) {
        let (size, square) = (self.size, self.size * self.size);
        for block in 1..self.blocks {
            let (upper, lower) = (&mut self.upper[(block - 1) * square..], &mut self.lower[block * square..]);
            upper[..square].swap_with_slice(&mut lower[..square]);
        }
        for entries in [&mut self.diagonal, &mut self.lower, &mut self.upper] {
            for block in entries.chunks_exact_mut(square.max(1)) {
                for column in 1..size {
                    (0..column).for_each(|row| block.swap(column * size + row, row * size + column));
                }
            }
        }
    }

    /// Factorises in place. Calls `go_on` every few milliseconds. Stops and returns `false` if `go_on` returns `false`;
    /// the factors are then incomplete.
    pub fn factorise(&mut self, go_on: impl Fn() -> bool) -> bool {
        let (size, square) = (self.size, self.size * self.size);
        let middle = self.blocks / 2;
        let [left, center, right] = parts(&mut self.diagonal, middle, square);
        let [left_lower, center_lower, right_lower] = parts(&mut self.lower, middle, square);
        let [left_upper, center_upper, right_upper] = parts(&mut self.upper, middle, square);
        let [left_order, center_order, right_order] = parts(&mut self.permutation, middle, size);
        let [left_inverse, center_inverse, right_inverse] = parts(&mut self.inverse, middle, size);
        let stride = (PRODUCTS_PER_CHECK / (size * square).max(1)).max(1);
        for from in (0..middle.max(self.blocks - middle)).step_by(stride) {
            if !go_on() {
                return false;
            }
            let steps = from..from + stride;
            both(
                || eliminate(steps.clone(), size, left, left_upper, left_lower, (left_order, left_inverse), false),
                || eliminate(steps.clone(), size, right, right_lower, right_upper, (right_order, right_inverse), true),
            );
        }
        let mut stack = stack(size);
        if middle > 0 {
            subtract_product(size, center, center_lower, &left_upper[(middle - 1) * square..]);
        }
        if middle + 1 < self.blocks {
            subtract_product(size, center, center_upper, &right_lower[..square]);
        }
        lu(size, center, center_order, center_inverse, MemStack::new(&mut stack));
        true
    }

    /// Replaces the right-hand side `b` by the solution. Call it after [`Self::factorise`]. If `b` is shorter than the
    /// matrix, the missing entries count as zero.
    pub fn solve(&mut self, b: &mut [f64]) {
        let (size, square) = (self.size, self.size * self.size);
        let middle = self.blocks / 2;
        for (v, &b) in self.values.iter_mut().zip(&*b) {
            *v = b as f32;
        }
        self.values[b.len()..].fill(0.0);
        let [left, center, right] = parts(&mut self.values, middle, size);
        let split = |all: &'_ [f32]| (middle * square, (middle + 1) * square, all.len());
        let (from, to, end) = split(&self.diagonal);
        let (work_left, work_right) = self.permuted.split_at_mut(size);
        let orders = &self.permutation;
        let (diagonal, lower, upper) = (&self.diagonal, &self.lower, &self.upper);
        both(
            || forward(size, &diagonal[..from], &lower[..from], &orders[..middle * size], left, work_left, false),
            || {
                let order = &orders[(middle + 1) * size..];
                forward(size, &diagonal[to..end], &upper[to..end], order, right, work_right, true);
            },
        );
        if middle > 0 {
            subtract_from(center, &lower[from..to], &left[(middle - 1) * size..]);
        }
        if middle + 1 < self.blocks {
            subtract_from(center, &upper[from..to], &right[..size]);
        }
        lu_solve(size, &diagonal[from..to], &orders[middle * size..(middle + 1) * size], center, work_left);
        let center = &*center;
        both(
            || backward(size, &upper[..from], left, center, false),
            || backward(size, &lower[to..end], right, center, true),
        );
        for (b, &v) in b.iter_mut().zip(&self.values) {
            *b = f64::from(v);
        }
    }
}

/// Splits an array with `stride` entries per block into the parts before, at and behind the block `middle`.
fn parts<T>(all: &mut [T], middle: usize, stride: usize) -> [&mut [T]; 3] {
    let (left, rest) = all.split_at_mut(middle * stride);
    let (center, right) = rest.split_at_mut(stride.min(rest.len()));
    [left, center, right]
}

/// Factorises some diagonal blocks D of one side. `steps` counts them from the outer end towards the middle; `reversed`
/// is true for the side behind the middle. Replaces `inward`, the couplings towards the middle, by D⁻¹ times these.
/// `outward` are the couplings towards the outer end.
fn eliminate(
    steps: Range<usize>,
    size: usize,
    diagonal: &mut [f32],
    inward: &mut [f32],
    outward: &[f32],
    (order, inverse): (&mut [usize], &mut [usize]),
    reversed: bool,
) {
    let square = size * size;
    let count = diagonal.len() / square.max(1);
    let mut stack = stack(size);
    for step in steps.start..steps.end.min(count) {
        let k = if reversed { count - 1 - step } else { step };
        let here = k * square..(k + 1) * square;
        if step > 0 {
            let previous = if reversed { k + 1 } else { k - 1 };
            let product = &inward[previous * square..(previous + 1) * square];
            subtract_product(size, &mut diagonal[here.clone()], &outward[here.clone()], product);
        }
        let (order, inverse) = (&mut order[k * size..(k + 1) * size], &mut inverse[k * size..(k + 1) * size]);
        lu(size, &mut diagonal[here.clone()], order, inverse, MemStack::new(&mut stack));
        let factors = MatRef::from_column_major_slice(&diagonal[here.clone()], size, size);
        let rhs = MatMut::from_column_major_slice_mut(&mut inward[here], size, size);
        let rows = PermRef::new_checked(order, inverse, size);
        solve::solve_in_place(factors, factors, rows, rhs, Par::Seq, MemStack::new(&mut stack));
    }
}

/// Returns work space for the factorisation of a block and for solves with it.
fn stack(size: usize) -> MemBuffer {
    let lu = factor::lu_in_place_scratch::<usize, f32>(size, size, Par::Seq, Default::default());
    MemBuffer::new(lu.or(solve::solve_in_place_scratch::<usize, f32>(size, size, Par::Seq)))
}

/// Factorises one diagonal block in place, with row pivoting.
fn lu(size: usize, block: &mut [f32], order: &mut [usize], inverse: &mut [usize], stack: &mut MemStack) {
    let block = MatMut::from_column_major_slice_mut(block, size, size);
    let _ = factor::lu_in_place(block, order, inverse, Par::Seq, stack, Default::default());
}

/// Computes block −= a b.
fn subtract_product(size: usize, block: &mut [f32], a: &[f32], b: &[f32]) {
    let view = |entries| MatRef::from_column_major_slice(entries, size, size);
    let block = MatMut::from_column_major_slice_mut(block, size, size);
    matmul(block, Accum::Add, view(a), view(&b[..size * size]), -1.0, Par::Seq);
}

/// Forward substitution on one side, from its outer end towards the middle. `reversed` is true behind the middle.
fn forward(
    size: usize,
    diagonal: &[f32],
    outward: &[f32],
    order: &[usize],
    values: &mut [f32],
    work: &mut [f32],
    reversed: bool,
) {
    let square = size * size;
    let count = values.len() / size.max(1);
    for step in 0..count {
        let k = if reversed { count - 1 - step } else { step };
        let block = k * square..(k + 1) * square;
        if step > 0 {
            let (head, tail) = values.split_at_mut(if reversed { (k + 1) * size } else { k * size });
            if reversed {
                subtract_from(&mut head[k * size..], &outward[block.clone()], &tail[..size]);
            } else {
                subtract_from(&mut tail[..size], &outward[block.clone()], &head[(k - 1) * size..]);
            }
        }
        let (order, value) = (&order[k * size..(k + 1) * size], &mut values[k * size..(k + 1) * size]);
        lu_solve(size, &diagonal[block], order, value, work);
    }
}

/// Backward substitution on one side, from the middle with the solution `center` towards its outer end.
fn backward(size: usize, inward: &[f32], values: &mut [f32], center: &[f32], reversed: bool) {
    let square = size * size;
    let count = values.len() / size.max(1);
    for step in (0..count).rev() {
        let k = if reversed { count - 1 - step } else { step };
        let block = &inward[k * square..(k + 1) * square];
        if step + 1 == count {
            subtract_from(&mut values[k * size..(k + 1) * size], block, center);
        } else if reversed {
            let (head, tail) = values.split_at_mut(k * size);
            subtract_from(&mut tail[..size], block, &head[(k - 1) * size..]);
        } else {
            let (head, tail) = values.split_at_mut((k + 1) * size);
            subtract_from(&mut head[k * size..], block, &tail[..size]);
        }
    }
}

/// Computes y −= A x for a block A stored column by column. It uses four columns at a time, so that y is read and
/// written less often.
fn subtract_from(y: &mut [f32], block: &[f32], x: &[f32]) {
    let size = y.len();
    let mut columns = block.chunks_exact(4 * size);
    for (four, x) in columns.by_ref().zip(x.chunks_exact(4)) {
        let (ab, cd) = four.split_at(2 * size);
        let ((a, b), (c, d)) = (ab.split_at(size), cd.split_at(size));
        for ((((y, a), b), c), d) in y.iter_mut().zip(a).zip(b).zip(c).zip(d) {
            *y -= a * x[0] + b * x[1] + c * x[2] + d * x[3];
        }
    }
    let rest = &x[size / 4 * 4..size];
    for (column, x) in columns.remainder().chunks_exact(size).zip(rest) {
        for (y, a) in y.iter_mut().zip(column) {
            *y -= a * x;
        }
    }
}

/// Solves with one factorised block. Replaces the right-hand side `values` by the solution.
fn lu_solve(size: usize, factors: &[f32], order: &[usize], values: &mut [f32], work: &mut [f32]) {
    for (work, &from) in work.iter_mut().zip(order) {
        *work = values[from];
    }
    for (j, column) in factors.chunks_exact(size).enumerate() {
        let (head, tail) = work.split_at_mut(j + 1);
        for (w, l) in tail.iter_mut().zip(&column[j + 1..]) {
            *w -= head[j] * l;
        }
    }
    for (j, column) in factors.chunks_exact(size).enumerate().rev() {
        let (head, tail) = work.split_at_mut(j);
        // Division by a zero pivot would give values that are not finite. Zero is sufficient for a preconditioner.
        tail[0] = if column[j] == 0.0 { 0.0 } else { tail[0] / column[j] };
        for (w, u) in head.iter_mut().zip(column) {
            *w -= tail[0] * u;
        }
    }
    values.copy_from_slice(&work[..size]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_systems_with_few_and_many_blocks() {
        let size = 7;
        for blocks in [1, 2, 3, 10, 11] {
            let entry = |i: usize, j: usize| {
                let value = ((i * 31 + j * 17) as f64 * 1.37).sin();
                // Large entries next to the diagonal, so that rows must be pivoted.
                let boost = if i / size == j / size && (i + 1) % size == j % size { 6.0 } else { 0.0 };
                if (i / size).abs_diff(j / size) > 1 { 0.0 } else { value + boost }
            };
            let mut matrix = BlockTridiagonal::default();
            // The second and the third run reuse the memory of the first one.
            for transposed in [false, false, true] {
                let entry = |i: usize, j: usize| if transposed { entry(j, i) } else { entry(i, j) };
                matrix.reset(size, blocks);
                let filled = matrix.fill(|row| {
                    for c in 0..size {
                        for r in 0..size {
                            let i = row.index * size + r;
                            row.diagonal[c * size + r] = entry(i, row.index * size + c) as f32;
                            if row.index > 0 {
                                row.lower[c * size + r] = entry(i, (row.index - 1) * size + c) as f32;
                            }
                            if row.index + 1 < blocks {
                                row.upper[c * size + r] = entry(i, (row.index + 1) * size + c) as f32;
                            }
                        }
                    }
                    Some(())
                });
                assert!(filled.is_some());
                if transposed {
                    // The matrix was filled with the transpose of the expected one.
                    matrix.transpose();
                }
                let entry = |i: usize, j: usize| if transposed { entry(j, i) } else { entry(i, j) };
                let n = size * blocks;
                let want: Vec<f64> = (0..n).map(|i| (i as f64).cos()).collect();
                let mut b: Vec<f64> = (0..n).map(|i| (0..n).map(|j| entry(i, j) * want[j]).sum()).collect();
                assert!(matrix.factorise(|| true));
                matrix.solve(&mut b);
                for (got, want) in b.iter().zip(&want) {
                    assert!((got - want).abs() < 2e-3, "{blocks} blocks: {got} against {want}");
                }
            }
        }
    }
}
