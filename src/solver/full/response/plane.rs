//! Approximation of the complex system of a point contact, in alternating real and imaginary parts: the stencil and
//! the nearest columns of B K, as for steady contacts.

use super::linear::{ComplexRow, ResponseSpace};
use crate::solver::discrete::reynolds::{CENTER, EAST, NORTH, SOUTH, STENCIL, WEST, WEST2};
use crate::solver::discrete::space::PlaneSpace;
use crate::solver::full::newton_space::Factors;
use crate::solver::full::point::{BlockTridiagonal, KernelColumns, REACH};
use realfft::num_complex::Complex64;

/// Factorised block matrix of twice the number of unknowns, and the kernel.
#[derive(Default)]
pub struct ComplexBlocks {
    matrix: BlockTridiagonal,
    kernel: KernelColumns,
    /// Scaled derivatives with respect to H, real and imaginary, one stencil entry after the other for each column.
    d_h: [Vec<f32>; 2],
}

impl Factors for ComplexBlocks {
    fn solve(&mut self, b: &mut [f64]) {
        self.matrix.solve(b);
    }
}

impl ResponseSpace for PlaneSpace {
    type ComplexFactors = ComplexBlocks;

    fn factorise(&self, factors: &mut ComplexBlocks, rows: &[ComplexRow], scaling: &[f64]) {
        let grid = &*self.grid;
        let (m, ny) = (grid.column_unknowns(), grid.ny());
        let columns = grid.nx() - 2;
        let ComplexBlocks { matrix, kernel, d_h } = factors;
        kernel.prepare(grid);
        let size = 2 * REACH * m;
        matrix.reset(size, columns.div_ceil(REACH));
        d_h.iter_mut().for_each(|part| part.resize(columns * STENCIL * m, 0.0));
        for (k, (row, s)) in rows.iter().zip(scaling).enumerate() {
            let at = k / m * STENCIL * m + k % m;
            for (n, value) in row.d_h.iter().enumerate() {
                (d_h[0][at + n * m], d_h[1][at + n * m]) = ((value.re * s) as f32, (value.im * s) as f32);
            }
        }
        let (kernel, d_h) = (&*kernel, &*d_h);
        let filled = matrix.fill(|blocks| {
            let mut entries = [0, 1].map(|_| vec![0.0; m]);
            for part in 0..REACH {
                let c = blocks.index * REACH + part;
                if c >= columns {
                    for r in 2 * part * m..size {
                        blocks.diagonal[r * size + r] = 1.0;
                    }
                    break;
                }
                for t in c.saturating_sub(REACH)..(c + REACH + 1).min(columns) {
                    let block = match (t / REACH).cmp(&blocks.index) {
                        std::cmp::Ordering::Less => &mut *blocks.lower,
                        std::cmp::Ordering::Equal => &mut *blocks.diagonal,
                        std::cmp::Ordering::Greater => &mut *blocks.upper,
                    };
                    // Row j of column c against a cell of column t.
                    let mut add = |cell: usize, j: usize, [re, im]: [f32; 2]| {
                        let at = 2 * (t % REACH * m + cell) * size + 2 * (part * m + j);
                        block[at] += re;
                        block[at + 1] += im;
                        block[at + size] -= im;
                        block[at + size + 1] += re;
                    };
                    for cell in 0..m {
                        for (entries, d_h) in entries.iter_mut().zip(d_h) {
                            let weights = &d_h[c * STENCIL * m..(c + 1) * STENCIL * m];
                            kernel.combine(entries, weights, (c, t), cell * (ny + 1));
                        }
                        for (j, (re, im)) in entries[0].iter().zip(&entries[1]).enumerate() {
                            add(cell, j, [*re, *im]);
                        }
                    }
                    for j in 0..m {
                        let (a, s) = (&rows[c * m + j].d_p, scaling[c * m + j]);
                        let mut stencil = |cell: usize, value: Complex64| {
                            add(cell, j, [(value.re * s) as f32, (value.im * s) as f32]);
                        };
                        if t == c {
                            stencil(j, a[CENTER]);
                            if j > 0 {
                                stencil(j - 1, a[SOUTH]);
                            }
                            if j + 1 < m {
                                stencil(j + 1, a[NORTH]);
                            }
                        } else if t + 1 == c {
                            stencil(j, a[WEST]);
                        } else if t + 2 == c {
                            stencil(j, a[WEST2]);
                        } else if t == c + 1 {
                            stencil(j, a[EAST]);
                        }
                    }
                }
            }
            Some(())
        });
        if filled.is_some() {
            matrix.factorise(|| true);
        }
    }
}
