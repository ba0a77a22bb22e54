//! Approximation of the Jacobian of line contacts: the derivatives of the equations and a band of the elastic kernel.

use super::Backtracking;
use crate::solver::discrete::grid::LineGrid;
use crate::solver::discrete::reynolds::CENTER;
use crate::solver::discrete::space::{LineSpace, Space};
use crate::solver::full::band::BandLu;
use crate::solver::full::newton_space::{Factors, ScaledRows};
use crate::solver::full::thinning::Thinning;

/// Factorised band matrix and the kernel from which it is made.
#[derive(Default)]
pub struct BandMatrix {
    band: BandLu,
    kernel: Vec<f64>,
    /// Half-bandwidth of the kernel, and whether it is shifted to end at zero.
    kernel_form: (usize, bool),
}

impl Factors for BandMatrix {
    fn solve(&mut self, b: &mut [f64]) {
        self.band.solve(b);
    }
}

impl BandMatrix {
    /// Assembles and factorises A + C G + trunc(B K) with scaled equations. A and B are the derivatives by pressure
    /// and film thickness, K is the elastic kernel, and C G the contribution of shear thinning. K has no columns for
    /// unknowns that are `fractions`.
    pub fn build(
        &mut self,
        space: &LineSpace,
        control: &Backtracking,
        &ScaledRows { rows, thinning, scaling, fractions }: &ScaledRows<'_>,
    ) {
        let (u, band) = (rows.len(), control.kernel_band);
        let width = 2 * band + 1;
        let stored = width + 4;
        let form = (band, control.levelled_kernel);
        if self.kernel.len() != space.grid.len() * stored || self.kernel_form != form {
            self.store_kernel(&space.grid, form);
        }
        self.band.reset(u, band, band);
        for (k, (own, s)) in rows.iter().zip(scaling).enumerate() {
            let (stencil, _) = space.row(k);
            let row = self.band.row_mut(k);
            for (e, &node) in stencil[..LineSpace::NODES].iter().enumerate() {
                // Node k + m against column node k + 2 + d, d = −band…band: offset 2 − m + d from the kernel's
                // diagonal.
                let m = node - k;
                let from = node * stored + (4 - m);
                let kernel = &self.kernel[from..from + width];
                let weight = s * own.d_h[e];
                if fractions.is_empty() {
                    for (r, kernel) in row.iter_mut().zip(kernel) {
                        *r += weight * kernel;
                    }
                } else {
                    let columns = fractions[k.saturating_sub(band)..].iter();
                    let entries = row.iter_mut().zip(kernel).skip(band - band.min(k)).zip(columns);
                    for ((r, kernel), _) in entries.filter(|(_, fraction)| !**fraction) {
                        *r += weight * kernel;
                    }
                }
                if (m + band).checked_sub(CENTER).is_some_and(|c| c < width) {
                    row[m + band - CENTER] += s * own.d_p[e];
                }
            }
            if let Some(Thinning { gradient, slopes: [slopes, _], .. }) = thinning {
                for (e, &node) in stencil[..LineSpace::NODES].iter().enumerate() {
                    for (c, weight) in gradient.along().weights[node].iter().enumerate() {
                        // Node k + m + c − 1.
                        let column = (node - k + c + band).checked_sub(CENTER + 1);
                        if let Some(r) = column.and_then(|c| row[..width].get_mut(c)) {
                            *r += s * slopes[k][e] * weight;
                        }
                    }
                }
            }
            for (c, r) in row[..width].iter_mut().enumerate() {
                if k + c < band || k + c - band >= u {
                    *r = 0.0;
                }
            }
        }
        self.band.factorise();
    }

    /// Stores the kernel entries near the diagonal for all Newton steps: node i against nodes i − band − 2 … i + band
    /// + 2.
    fn store_kernel(&mut self, grid: &LineGrid, (band, levelled): (usize, bool)) {
        let (n, stored, reach) = (grid.len(), 2 * band + 5, band + 2);
        self.kernel.clear();
        self.kernel.resize(n * stored, 0.0);
        self.kernel_form = (band, levelled);
        for i in 0..n {
            // The load of a step is zero, so adding a constant to the kernel changes only its truncation. The kernel
            // is shifted so that it ends at zero.
            let edge = if i + reach + 1 < n { i + reach } else { i - reach };
            let level = if levelled { grid.kernel_entry(i, edge) / grid.weights[edge] } else { 0.0 };
            for c in 0..stored {
                let j = i + c;
                if j >= reach && j - reach < n {
                    let j = j - reach;
                    self.kernel[i * stored + c] = grid.kernel_entry(i, j) - level * grid.weights[j];
                }
            }
        }
    }
}
