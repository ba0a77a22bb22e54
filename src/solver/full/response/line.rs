//! Approximation of the complex system of a line contact: a band of the kernel, in alternating real and imaginary
//! parts.

use super::linear::{ComplexRow, ResponseSpace};
use crate::solver::discrete::reynolds::CENTER;
use crate::solver::discrete::space::{LineSpace, Space};
use crate::solver::full::band::BandLu;
use crate::solver::full::newton_space::Factors;
use realfft::num_complex::Complex64;

/// Half-bandwidth of the kernel, in unknowns.
const BAND: usize = 8;

/// Factorised band matrix of twice the number of unknowns.
#[derive(Default)]
pub struct ComplexBand(BandLu);

impl Factors for ComplexBand {
    fn solve(&mut self, b: &mut [f64]) {
        self.0.solve(b);
    }
}

impl ResponseSpace for LineSpace {
    type ComplexFactors = ComplexBand;

    fn factorise(&self, ComplexBand(band): &mut ComplexBand, rows: &[ComplexRow], scaling: &[f64]) {
        let grid = &self.grid;
        let (unknowns, half) = (rows.len(), 2 * BAND + 1);
        let last = grid.len() - 1;
        // The kernel is shifted so that it ends at zero: a change of the load-free pressure does not notice.
        let level = |node: usize| {
            let reach = BAND + CENTER;
            let edge = if node + reach < last { node + reach } else { node - reach };
            grid.kernel_entry(node, edge) / grid.weights[edge]
        };
        band.reset(2 * unknowns, half, half);
        for (k, (row, s)) in rows.iter().zip(scaling).enumerate() {
            let (stencil, _) = self.row(k);
            let stencil = &stencil[..Self::NODES];
            let levels: Vec<f64> = stencil.iter().map(|&node| level(node)).collect();
            for column in k.saturating_sub(BAND)..(k + BAND + 1).min(unknowns) {
                let other = column + CENTER;
                let mut entry = Complex64::ZERO;
                for (e, (&node, level)) in stencil.iter().zip(&levels).enumerate() {
                    entry += row.d_h[e] * (grid.kernel_entry(node, other) - level * grid.weights[other]);
                    if node == other {
                        entry += row.d_p[e];
                    }
                }
                entry *= s;
                let at = 2 * column + half - 2 * k;
                let real = band.row_mut(2 * k);
                (real[at], real[at + 1]) = (entry.re, -entry.im);
                let imaginary = band.row_mut(2 * k + 1);
                (imaginary[at - 1], imaginary[at]) = (entry.im, entry.re);
            }
        }
        band.factorise();
    }
}
