//! Proper orthogonal decomposition under quadrature weights, (2.88)–(2.95).

use super::dense;
use faer::linalg::solvers::Svd;
use faer::{ColRef, Mat, MatRef};

/// POD basis with all its singular values.
#[derive(Clone, Debug)]
pub struct PodBasis {
    /// One mode per column over the node array, orthonormal under the grid's weights: Vᵀ W V = I.
    pub modes: Mat<f64>,
    /// All singular values of the snapshots, including those of modes that were not kept.
    pub singular_values: Vec<f64>,
}

impl PodBasis {
    /// Decomposes snapshots (one per column, node arrays) under the weights and keeps the modes up to a loss of
    /// information. Nodes with zero weight get zero modes. `None` if the decomposition fails (non-finite snapshots).
    pub fn new(snapshots: MatRef<'_, f64>, weights: &[f64], loss: f64) -> Option<Self> {
        let (nodes, columns) = (snapshots.nrows(), snapshots.ncols());
        if snapshots.row_iter().flat_map(|r| r.iter()).any(|v| !v.is_finite()) {
            return None;
        }
        let scaled = Mat::from_fn(nodes, columns, |i, j| weights[i].sqrt() * snapshots[(i, j)]);
        let svd = Svd::new_thin(scaled.as_ref()).ok()?;
        let singular_values: Vec<f64> = svd.S().column_vector().iter().copied().collect();
        let mut basis = Self { modes: Mat::zeros(nodes, 0), singular_values };
        let keep = basis.modes_within(loss, basis.singular_values.len());
        let left = svd.U();
        basis.modes =
            Mat::from_fn(nodes, keep, |i, j| if weights[i] > 0.0 { left[(i, j)] / weights[i].sqrt() } else { 0.0 });
        Some(basis)
    }

    /// Decomposes snapshots such that the modes have the smallest error under the weights `emphasis`, for equations
    /// to which some places matter more than others. `emphasis` must be positive where `weights` are. The number of
    /// modes is that of [`Self::new`] for `loss`, at most `most`. The modes are orthonormal under `weights`, and the
    /// singular values are those of [`Self::new`]. `None` if a decomposition fails (non-finite snapshots).
    pub fn emphasised(
        snapshots: MatRef<'_, f64>,
        weights: &[f64],
        emphasis: &[f64],
        (loss, most): (f64, usize),
    ) -> Option<Self> {
        let plain = Self::new(snapshots, weights, loss)?;
        let keep = plain.modes.ncols().min(most);
        let chosen = Self::new(snapshots, emphasis, 0.0)?;
        let chosen = chosen.modes.get(.., ..keep.min(chosen.modes.ncols()));
        let weighted = Mat::from_fn(snapshots.nrows(), snapshots.ncols(), |i, j| emphasis[i] * snapshots[(i, j)]);
        let projected: Mat<f64> = chosen * (chosen.transpose() * &weighted);
        let modes = Self::new(projected.as_ref(), weights, 0.0)?.modes;
        Some(Self { modes: modes.get(.., ..keep.min(modes.ncols())).to_owned(), ..plain })
    }

    /// Reduces the number of modes to at most `most`, but at least one.
    pub fn cut(mut self, most: usize) -> Self {
        if most < self.modes.ncols() {
            self.modes = self.modes.get(.., ..most.max(1)).to_owned();
        }
        self
    }

    /// Returns Vᵀ W v: the coefficients of a node array, given by its value at each node.
    pub fn coefficients(&self, weights: &[f64], value: impl Fn(usize) -> f64) -> Vec<f64> {
        let of = |mode: ColRef<'_, f64>| mode.iter().zip(weights).enumerate().map(|(i, (v, w))| w * v * value(i)).sum();
        self.modes.col_iter().map(of).collect()
    }

    /// Returns the coefficients of the best approximations of fields, one per column over the node array: modes ×
    /// fields; not finite if the modes are linearly dependent. Rounded modes are not quite orthonormal: for a rare
    /// one, [`Self::coefficients`] mostly contains the part that it shares with the first mode.
    pub fn best_coefficients(&self, weights: &[f64], fields: MatRef<'_, f64>) -> Mat<f64> {
        let modes = self.modes.as_ref();
        let weighted =
            |fields: MatRef<'_, f64>| Mat::from_fn(fields.nrows(), fields.ncols(), |i, j| weights[i] * fields[(i, j)]);
        let inner = |fields: MatRef<'_, f64>| dense::product(modes.transpose(), weighted(fields).as_ref());
        dense::solved(inner(modes).as_ref(), inner(fields))
    }

    /// Returns the loss of information with the first `k` modes, (2.90).
    pub fn loss(&self, k: usize) -> f64 {
        let total: f64 = self.singular_values.iter().sum();
        self.singular_values.iter().skip(k).sum::<f64>() / total
    }

    /// Returns the smallest number of modes whose loss does not exceed `loss`, (2.92); at least one and at most all
    /// modes.
    pub fn modes_for(&self, loss: f64) -> usize {
        self.modes_within(loss, self.modes.ncols())
    }

    fn modes_within(&self, loss: f64, available: usize) -> usize {
        let total: f64 = self.singular_values.iter().sum();
        let mut rest = total;
        for (k, sigma) in self.singular_values.iter().take(available).enumerate() {
            rest -= sigma;
            if rest <= loss * total {
                return k + 1;
            }
        }
        available.max(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_are_orthonormal_and_reproduce_the_snapshots() {
        let weights: Vec<f64> = (0..30).map(|i| 0.01 + 0.002 * f64::from(i)).collect();
        let snapshots = Mat::from_fn(30, 6, |i, j| ((i + 1) as f64 * (j + 1) as f64 * 0.07).sin());
        let basis = PodBasis::new(snapshots.as_ref(), &weights, 0.0).unwrap();
        let product = |a: usize, b: usize| -> f64 {
            (0..30).map(|i| weights[i] * basis.modes[(i, a)] * basis.modes[(i, b)]).sum()
        };
        for a in 0..basis.modes.ncols() {
            for b in 0..basis.modes.ncols() {
                assert!((product(a, b) - f64::from(u8::from(a == b))).abs() < 1e-10);
            }
        }
        for j in 0..6 {
            let coefficients = basis.coefficients(&weights, |i| snapshots[(i, j)]);
            for i in 0..30 {
                let rebuilt: f64 = coefficients.iter().enumerate().map(|(k, c)| c * basis.modes[(i, k)]).sum();
                assert!((rebuilt - snapshots[(i, j)]).abs() < 1e-10);
            }
        }
    }

    #[test]
    fn loss_of_information_is_the_dissertations() {
        let basis = PodBasis { modes: Mat::zeros(5, 3), singular_values: vec![8.0, 1.0, 0.9, 0.1] };
        assert!((basis.loss(0) - 1.0).abs() < 1e-15 && basis.loss(4) < 1e-15);
        assert!((basis.loss(1) - 0.2).abs() < 1e-15);
        assert_eq!(basis.modes_for(0.2 + 1e-12), 1);
        assert_eq!(basis.modes_for(0.05), 3);
        assert_eq!(basis.modes_for(0.0), 3, "no more than what is kept");
    }

    #[test]
    fn emphasised_modes_are_best_under_their_weights() {
        let weights: Vec<f64> = (0..40).map(|i| 0.01 + 0.002 * f64::from(i)).collect();
        let strong: Vec<f64> = (0..40).map(|i| if i >= 30 { 1e4 * weights[i] } else { weights[i] }).collect();
        let snapshots = Mat::from_fn(40, 12, |i, j| (-(i as f64 / 40.0 - j as f64 / 12.0).powi(2) * 30.0).exp());
        // Smallest error of the snapshots in the span of a basis, under weights.
        let missed = |basis: &PodBasis, weights: &[f64]| -> f64 {
            let own = PodBasis::new(basis.modes.as_ref(), weights, 0.0).unwrap().modes;
            let weighted = Mat::from_fn(40, 12, |i, j| weights[i] * snapshots[(i, j)]);
            let rest = &snapshots - &own * (own.transpose() * &weighted);
            Mat::from_fn(40, 12, |i, j| weights[i].sqrt() * rest[(i, j)]).norm_l2()
        };
        let plain = PodBasis::new(snapshots.as_ref(), &weights, 0.05).unwrap();
        let emphasised = PodBasis::emphasised(snapshots.as_ref(), &weights, &strong, (0.05, 40)).unwrap();
        let keep = plain.modes.ncols();
        assert_eq!((emphasised.modes.ncols(), &emphasised.singular_values), (keep, &plain.singular_values));
        // Eckart and Young: no span of that many modes has a smaller error than the further singular values.
        let singular_values = PodBasis::new(snapshots.as_ref(), &strong, 0.0).unwrap().singular_values;
        let least = singular_values[keep..].iter().map(|s| s * s).sum::<f64>().sqrt();
        assert!((missed(&emphasised, &strong) / least - 1.0).abs() < 1e-6);
        assert!(missed(&plain, &strong) > 1.01 * least);
        let weighted = Mat::from_fn(40, keep, |i, k| weights[i] * emphasised.modes[(i, k)]);
        let products: Mat<f64> = emphasised.modes.transpose() * &weighted;
        assert!((products - Mat::<f64>::identity(keep, keep)).norm_l2() < 1e-10);
        let same = PodBasis::emphasised(snapshots.as_ref(), &weights, &weights, (0.05, 40)).unwrap();
        assert!((missed(&same, &weights) - missed(&plain, &weights)).abs() < 1e-10);
    }

    #[test]
    fn non_finite_snapshots_are_refused() {
        let snapshots = Mat::from_fn(4, 2, |i, j| if i == 2 && j == 1 { f64::NAN } else { 1.0 });
        assert!(PodBasis::new(snapshots.as_ref(), &[1.0; 4], 0.0).is_none());
    }
}
