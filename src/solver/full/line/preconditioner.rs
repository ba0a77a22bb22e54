//! The preconditioner of line contacts: the rows' own derivatives and a band of the elastic kernel, bordered by the load.

use crate::solver::discrete::grid::{FIRST_UNKNOWN, LineGrid, dot};
use crate::solver::discrete::reynolds::CENTER;
use crate::solver::discrete::reynolds::line::{LINE_STENCIL, Upstream};
use crate::solver::full::band::BandLu;
use crate::solver::full::shear::ShearState;

/// A bordered band matrix near the Jacobian, factorised.
#[derive(Default)]
pub(super) struct Preconditioner {
    band: BandLu,
    /// Band⁻¹ applied to the H₀ column.
    column: Vec<f64>,
    /// wᵀ column.
    schur: f64,
    kernel: Vec<f64>,
    /// Its half-bandwidth, and whether it is levelled.
    kernel_form: (usize, bool),
}

impl Preconditioner {
    /// Assembles and factorises A + C G + trunc(B K), rows scaled, and the H₀ column; C G is what shear-thinning adds.
    pub fn build(
        &mut self,
        grid: &LineGrid,
        (band, levelled): (usize, bool),
        (upstream, d_p, d_h): (&[Upstream], &[[f64; LINE_STENCIL]], &[[f64; LINE_STENCIL]]),
        shear: Option<&ShearState>,
        scaling: &[f64],
    ) {
        let u = grid.unknowns();
        let n = grid.len();
        let width = 2 * band + 1;
        // Kernel entries near the diagonal, kept between Newton steps: node i against nodes i − band−2 … i + band+2.
        let stored = width + 4;
        if self.kernel.len() != n * stored || self.kernel_form != (band, levelled) {
            self.kernel.clear();
            self.kernel.resize(n * stored, 0.0);
            self.kernel_form = (band, levelled);
            let reach = band + 2;
            for i in 0..n {
                // The load of a step is zero, so a constant added to the kernel changes nothing but its truncation: it ends at zero.
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
        self.band.reset(u, band, band);
        for k in 0..u {
            let (a, b, s) = (&d_p[k], &d_h[k], scaling[k]);
            let shift = upstream[k].first_node(k) - k;
            let row = self.band.row_mut(k);
            for (j, m) in (shift..shift + LINE_STENCIL).enumerate() {
                // Node k + m against column node k + 2 + d, d = −band…band: offset 2 − m + d from its own diagonal.
                let from = (k + m) * stored + (4 - m);
                let kernel = &self.kernel[from..from + width];
                let weight = s * b[j];
                for (r, kernel) in row.iter_mut().zip(kernel) {
                    *r += weight * kernel;
                }
                if (m + band).checked_sub(CENTER).is_some_and(|c| c < width) {
                    row[m + band - CENTER] += s * a[j];
                }
            }
            if let Some(shear) = shear {
                for (m, slope) in shear.slopes[k].iter().enumerate() {
                    for (c, weight) in shear.gradient.weights[k + m].iter().enumerate() {
                        // Node k + m + c − 1.
                        if let Some(r) = (m + c + band).checked_sub(CENTER + 1).and_then(|c| row[..width].get_mut(c)) {
                            *r += s * slope * weight;
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
        self.column.clear();
        self.column.extend(d_h.iter().zip(scaling).map(|(b, s)| s * b.iter().sum::<f64>()));
        self.band.solve(&mut self.column);
        self.schur = dot(&grid.weights[FIRST_UNKNOWN..FIRST_UNKNOWN + u], &self.column);
    }

    /// v ← M⁻¹ v for the bordered preconditioner.
    pub fn apply(&self, grid: &LineGrid, v: &mut [f64]) {
        let u = grid.unknowns();
        let (head, last) = v.split_at_mut(u);
        self.band.solve(head);
        let carried = dot(&grid.weights[FIRST_UNKNOWN..FIRST_UNKNOWN + u], head);
        let dh_0 = if self.schur == 0.0 { 0.0 } else { (carried - last[0]) / self.schur };
        for (v, c) in head.iter_mut().zip(&self.column) {
            *v -= dh_0 * c;
        }
        last[0] = dh_0;
    }
}
