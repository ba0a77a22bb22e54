//! Approximation A + trunc(B K) of the Jacobian of point contacts. A and B are the derivatives by pressure and film
//! thickness, K is the elastic kernel. The product is kept up to a few columns away along X, with all couplings
//! across.

use super::block_tridiagonal::BlockTridiagonal;
use crate::solver::discrete::grid::PointGrid;
use crate::solver::discrete::reynolds::{CENTER, EAST, NORTH, SOUTH, STENCIL, WEST, WEST2};
use crate::solver::full::newton_space::{Factors, ScaledRows};

/// Number of columns of the product B K kept on either side. With one, contacts of low load and thick film do not
/// converge; three are not faster.
pub const REACH: usize = 2;

/// K from cells 0…REACH + 2 columns away. Each column has n_y entries followed by a zero.
#[derive(Default)]
pub struct KernelColumns(Vec<Vec<f32>>);

/// Factorised matrix and its work space.
#[derive(Default)]
pub struct PlaneMatrix {
    kernel: KernelColumns,
    matrix: BlockTridiagonal,
    /// Scaled derivatives with respect to H, one stencil entry after the other for each column of unknowns.
    d_h: Vec<f32>,
}

impl Factors for PlaneMatrix {
    fn solve(&mut self, b: &mut [f64]) {
        self.matrix.solve(b);
    }
}

impl PlaneMatrix {
    /// Assembles and factorises the matrix for the given equations and their scaling. Returns `false` if `go_on`
    /// stopped it. K has no columns for unknowns that are `fractions`.
    pub fn build(&mut self, grid: &PointGrid, rows: &ScaledRows<'_>, go_on: impl Fn() -> bool + Sync) -> bool {
        self.fill(grid, rows, &go_on) && self.matrix.factorise(go_on)
    }

    /// Assembles and factorises the transpose of the same matrix.
    pub fn build_transposed(&mut self, grid: &PointGrid, rows: &ScaledRows<'_>) -> bool {
        let filled = self.fill(grid, rows, || true);
        self.matrix.transpose();
        filled && self.matrix.factorise(|| true)
    }

    fn fill(
        &mut self,
        grid: &PointGrid,
        &ScaledRows { rows, scaling, fractions, .. }: &ScaledRows<'_>,
        go_on: impl Fn() -> bool + Sync,
    ) -> bool {
        let (m, ny) = (grid.column_unknowns(), grid.ny());
        let columns = grid.nx() - 2;
        self.kernel.prepare(grid);
        let size = REACH * m;
        self.matrix.reset(size, columns.div_ceil(REACH));
        self.d_h.resize(columns * STENCIL * m, 0.0);
        for (k, (row, s)) in rows.iter().zip(scaling).enumerate() {
            let at = k / m * STENCIL * m + k % m;
            for (n, value) in row.d_h.iter().enumerate() {
                self.d_h[at + n * m] = (value * s) as f32;
            }
        }
        let (kernel, d_h32) = (&self.kernel, &self.d_h);
        let assembled = self.matrix.fill(|row| {
            if !go_on() {
                return None;
            }
            for part in 0..REACH {
                let c = row.index * REACH + part;
                if c >= columns {
                    for r in part * m..size {
                        row.diagonal[r * size + r] = 1.0;
                    }
                    break;
                }
                let weights = &d_h32[c * STENCIL * m..(c + 1) * STENCIL * m];
                for t in c.saturating_sub(REACH)..(c + REACH + 1).min(columns) {
                    let block = match (t / REACH).cmp(&row.index) {
                        std::cmp::Ordering::Less => &mut *row.lower,
                        std::cmp::Ordering::Equal => &mut *row.diagonal,
                        std::cmp::Ordering::Greater => &mut *row.upper,
                    };
                    let from = t % REACH * m * size + part * m;
                    let deforms = |cell: &usize| !fractions.get(t * m + cell).is_some_and(|fraction| *fraction);
                    for cell in (0..m).filter(deforms) {
                        let entries = &mut block[from + cell * size..from + cell * size + m];
                        kernel.combine(entries, weights, (c, t), cell * (ny + 1));
                    }
                    for j in 0..m {
                        let a = &rows[c * m + j].d_p;
                        let s = scaling[c * m + j];
                        let mut add = |cell: usize, value: f64| block[from + cell * size + j] += (value * s) as f32;
                        if t == c {
                            add(j, a[CENTER]);
                            if j > 0 {
                                add(j - 1, a[SOUTH]);
                            }
                            if j + 1 < m {
                                add(j + 1, a[NORTH]);
                            }
                        } else if t + 1 == c {
                            add(j, a[WEST]);
                        } else if t + 2 == c {
                            add(j, a[WEST2]);
                        } else if t == c + 1 {
                            add(j, a[EAST]);
                        }
                    }
                }
            }
            Some(())
        });
        assembled.is_some()
    }
}

impl KernelColumns {
    /// Stores the kernel of a grid, unless it is stored already.
    pub fn prepare(&mut self, grid: &PointGrid) {
        if !self.0.is_empty() {
            return;
        }
        let ny = grid.ny();
        let columns = (0..=REACH + 2).map(|distance| {
            let block = grid.flexibility.column_block(distance);
            let padded = |column: &[f64]| column.iter().map(|&k| k as f32).chain([0.0]).collect::<Vec<f32>>();
            block.chunks_exact(ny).flat_map(padded).collect()
        });
        self.0 = columns.collect();
    }

    /// Computes the entries of B K of all equations of column `c` against one cell of column `t`: six kernel entries
    /// each, weighted by the derivatives with respect to H. The cell's entries begin at `at`.
    #[inline]
    pub fn combine(&self, entries: &mut [f32], weights: &[f32], (c, t): (usize, usize), at: usize) {
        let m = entries.len();
        let weight = |n: usize| &weights[n * m..(n + 1) * m];
        let (west2, west, center, east) = (weight(WEST2), weight(WEST), weight(CENTER), weight(EAST));
        let (south, north) = (weight(SOUTH), weight(NORTH));
        // The kernels from WEST2, WEST, the column itself and EAST.
        let [w2, w, own, e] = [(t + 2).abs_diff(c), (t + 1).abs_diff(c), t.abs_diff(c), t.abs_diff(c + 1)]
            .map(|distance| self.0[distance].as_slice());
        let from = at + 1;
        let (k_west2, k_west, k_own, k_east) =
            (&w2[from..from + m], &w[from..from + m], &own[from..from + m], &e[from..from + m]);
        let (k_south, k_north) = (&own[at..at + m], &own[at + 2..at + 2 + m]);
        for j in 0..m {
            entries[j] = west2[j] * k_west2[j]
                + west[j] * k_west[j]
                + center[j] * k_own[j]
                + east[j] * k_east[j]
                + south[j] * k_south[j]
                + north[j] * k_north[j];
        }
    }
}
