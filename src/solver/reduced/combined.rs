//! Pressure modes that are linear combinations of one basis shared by several local models.
//!
//! The pressures of the local models of one model are similar. A few hundred modes represent all of them, and the few
//! dozen modes of one local model are combinations of these. A file stores one shared basis, and its deformation is
//! computed once.

use super::dense;
use super::multiples::{factor_scales, kept_factors};
use super::pod::PodBasis;
use super::sums::rows_times;
use crate::host::pool::computed;
use crate::solver::discrete::grid::ContactGrid;
use faer::{Mat, MatRef};
use std::sync::{Arc, OnceLock};

/// Basis of the pressures of several local models.
#[derive(Debug)]
pub struct SharedBasis {
    /// Modes over the node array.
    pub basis: PodBasis,
    /// K V in the reference coordinate ξ over the node array: deformation of the modes V by the flexibility matrix K.
    flexed: Mat<f64>,
    /// wᵀ V: load carried by each mode, with the quadrature weights w.
    carried: Vec<f64>,
}

/// Modes of one local model as combinations of a shared basis.
#[derive(Clone, Debug)]
pub struct Combined {
    /// Shared basis.
    pub shared: Arc<SharedBasis>,
    /// Coefficients of the combinations: modes of the shared basis × modes of the local model.
    pub factors: Mat<f64>,
}

/// Pressure modes of a local model, and their deformation. Combinations of a shared basis are computed at all nodes
/// only on request, because a solve needs few nodes.
#[derive(Clone, Debug)]
pub struct PressureModes {
    count: usize,
    singular_values: Vec<f64>,
    combined: Option<Combined>,
    basis: OnceLock<PodBasis>,
    flexed: OnceLock<Mat<f64>>,
    /// Combinations in single precision, row-major nodes × modes, for the display of fields.
    single: OnceLock<Vec<f32>>,
    /// Grid of modes with their own basis, by which they are deformed.
    grid: Option<ContactGrid>,
}

/// Number of nodes whose modes are converted to single precision at once.
const TOGETHER: usize = 512;

/// Returns wᵀ V.
fn carried(weights: &[f64], modes: MatRef<'_, f64>) -> Vec<f64> {
    modes.col_iter().map(|mode| weights.iter().zip(mode.iter()).map(|(w, v)| w * v).sum()).collect()
}

/// Returns the given rows of the first columns of a matrix.
fn rows(matrix: &Mat<f64>, nodes: &[usize], columns: usize) -> Mat<f64> {
    let mut out = Mat::zeros(nodes.len(), columns);
    for k in 0..columns {
        // Column slices are much faster than access to single entries.
        let column = matrix.col_as_slice(k);
        out.col_as_slice_mut(k).iter_mut().zip(nodes).for_each(|(out, node)| *out = column[*node]);
    }
    out
}

impl SharedBasis {
    /// Creates the shared basis on a grid.
    pub fn new(basis: PodBasis, grid: &ContactGrid) -> Self {
        let (flexed, carried) = (grid.flex(&basis.modes), carried(grid.weights(), basis.modes.as_ref()));
        Self { basis, flexed, carried }
    }
}

impl Combined {
    /// Computes the best combinations for pressures, one per column over the node array: their POD within the shared
    /// basis. The number of modes is limited by the loss of information, by `most`, and by the precision in which the
    /// factors are stored. `None` if the decomposition fails.
    pub fn of(
        shared: &Arc<SharedBasis>,
        pressures: &Mat<f64>,
        weights: &[f64],
        (loss, most): (f64, usize),
    ) -> Option<PressureModes> {
        let coefficients = shared.basis.best_coefficients(weights, pressures.as_ref());
        let PodBasis { modes: factors, singular_values } =
            PodBasis::new(coefficients.as_ref(), &vec![1.0; coefficients.nrows()], loss)?.cut(most);
        let factors = kept_factors(factors, &factor_scales(&singular_values, most));
        Some(Self { shared: Arc::clone(shared), factors }.into_modes(singular_values))
    }

    /// Converts the combinations to pressure modes with the given singular values.
    pub fn into_modes(self, singular_values: Vec<f64>) -> PressureModes {
        let (basis, flexed) = (OnceLock::new(), OnceLock::new());
        PressureModes {
            count: self.factors.ncols(),
            singular_values,
            combined: Some(self),
            basis,
            flexed,
            single: OnceLock::new(),
            grid: None,
        }
    }

    /// Evaluates the first combinations at some nodes; `whole` holds the shared modes or their deformation.
    fn over(&self, whole: &Mat<f64>, nodes: &[usize], columns: usize) -> Mat<f64> {
        let factors = self.factors.get(.., ..columns);
        dense::product(rows(whole, nodes, whole.ncols()).as_ref(), factors)
    }

    /// Returns all combinations over the node array, in single precision and row-major.
    fn in_single_precision(&self) -> Vec<f32> {
        let (whole, modes) = (self.shared.basis.modes.as_ref(), self.factors.ncols());
        let mut rows = Vec::with_capacity(whole.nrows() * modes);
        for first in (0..whole.nrows()).step_by(TOGETHER) {
            let some = whole.get(first..(first + TOGETHER).min(whole.nrows()), ..);
            let own = dense::product(some, self.factors.as_ref());
            rows.extend(own.row_iter().flat_map(|row| row.iter().map(|value| *value as f32)));
        }
        rows
    }
}

impl PressureModes {
    /// Creates modes with their own basis.
    pub fn own(basis: PodBasis, grid: &ContactGrid) -> Self {
        Self {
            count: basis.modes.ncols(),
            singular_values: basis.singular_values.clone(),
            combined: None,
            basis: OnceLock::from(basis),
            flexed: OnceLock::new(),
            single: OnceLock::new(),
            grid: Some(grid.clone()),
        }
    }

    /// Returns true for modes of an outline, of which only the number and the singular values are there.
    pub fn is_outline(&self) -> bool {
        self.combined.is_none() && self.basis.get().is_some_and(|basis| basis.modes.nrows() == 0)
    }

    /// Returns the number of modes.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns all singular values of the pressures.
    pub fn singular_values(&self) -> &[f64] {
        &self.singular_values
    }

    /// Returns the combinations, if the modes have a shared basis.
    pub fn combined(&self) -> Option<&Combined> {
        self.combined.as_ref()
    }

    /// Returns the modes at all nodes.
    pub fn basis(&self) -> &PodBasis {
        self.basis.get_or_init(|| PodBasis {
            modes: self.whole(|shared| &shared.basis.modes),
            singular_values: self.singular_values.clone(),
        })
    }

    /// Returns the coefficients of fields, one per column over the node array: modes × fields. For combinations they
    /// are the best approximation; otherwise inner products, which are sufficient for initial guesses.
    pub fn coefficients(&self, weights: &[f64], fields: &Mat<f64>) -> Mat<f64> {
        if self.combined.is_some() {
            return self.basis().best_coefficients(weights, fields.as_ref());
        }
        let columns: Vec<Vec<f64>> =
            fields.col_iter().map(|field| self.basis().coefficients(weights, |i| field[i])).collect();
        Mat::from_fn(self.count, columns.len(), |k, j| columns[j][k])
    }

    /// Returns K V in ξ over the node array.
    pub fn flexed(&self) -> &Mat<f64> {
        computed(&self.flexed, || match &self.grid {
            Some(grid) => grid.flex(&self.basis().modes),
            None => self.whole(|shared| &shared.flexed),
        })
    }

    /// Computes the combinations at all nodes.
    fn whole(&self, of: impl Fn(&SharedBasis) -> &Mat<f64>) -> Mat<f64> {
        let made = |own: &Combined| dense::product(of(&own.shared).as_ref(), own.factors.as_ref());
        self.combined.as_ref().map_or_else(Mat::new, made)
    }

    /// Evaluates the pressure of the first modes with these coefficients at the first nodes; the lengths of the
    /// slices determine the numbers. `single` permits single precision for combinations. It is faster because reading
    /// memory dominates.
    pub fn field(&self, coefficients: &[f64], single: bool, field: &mut [f64]) {
        match &self.combined {
            Some(own) if single && coefficients.len() == self.count => {
                rows_times(self.single.get_or_init(|| own.in_single_precision()), coefficients, field);
            }
            _ => dense::times(self.basis().modes.get(..field.len(), ..coefficients.len()), coefficients, field),
        }
    }

    /// Returns the first modes at some nodes.
    pub fn at(&self, nodes: &[usize], modes: usize) -> Mat<f64> {
        match &self.combined {
            Some(own) => own.over(&own.shared.basis.modes, nodes, modes),
            None => rows(&self.basis().modes, nodes, modes),
        }
    }

    /// Returns K V of the first modes at some nodes.
    pub(super) fn flexed_at(&self, nodes: &[usize], modes: usize) -> Mat<f64> {
        match &self.combined {
            Some(own) => own.over(&own.shared.flexed, nodes, modes),
            None => rows(self.flexed(), nodes, modes),
        }
    }

    /// Returns wᵀ V of the first modes, with the quadrature weights of their grid.
    pub(super) fn carried(&self, weights: &[f64], modes: usize) -> Vec<f64> {
        match &self.combined {
            Some(own) => {
                let of = |k: usize| own.shared.carried.iter().zip(own.factors.col(k).iter()).map(|(w, f)| w * f).sum();
                (0..modes).map(of).collect()
            }
            None => carried(weights, self.basis().modes.get(.., ..modes)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::{GridSpec, PointGridSpec};

    /// Pressures similar to those of contacts, each shifted along X and steeper than the one before.
    fn bumps(grid: &ContactGrid, count: usize, (further, steeper): (f64, f64)) -> Mat<f64> {
        Mat::from_fn(grid.len(), count, |i, k| {
            let ((x, y), k) = (grid.place(i), k as f64);
            let inside = (1.0 - (x - further * k).powi(2) - y * y).max(0.0);
            if grid.weights()[i] > 0.0 { inside.powf(0.5 + steeper * k) } else { 0.0 }
        })
    }

    #[test]
    fn combinations_are_modes_within_the_shared_basis() {
        let grid = GridSpec::Plane(PointGridSpec::uniform(0.1, 0.2, (-4.0, 2.0, -2.0))).build().unwrap();
        let weights = grid.weights();
        let pressures = bumps(&grid, 12, (0.02, 0.05));
        let shared = Arc::new(SharedBasis::new(PodBasis::new(pressures.as_ref(), weights, 0.0).unwrap(), &grid));
        let own = pressures.get(.., ..5).to_owned();
        let made = Combined::of(&shared, &own, weights, (0.0, 4)).unwrap();
        let plain = PodBasis::new(own.as_ref(), weights, 0.0).unwrap().cut(4);
        let (deformed, basis) = (made.flexed(), made.basis());
        let directly = grid.flex(&basis.modes);
        let nodes = [3, 17, grid.len() / 2];
        let (few, few_deformed) = (made.at(&nodes, 3), made.flexed_at(&nodes, 3));
        let load = made.carried(weights, 4);
        for k in 0..4 {
            let carried: f64 = (0..grid.len()).map(|i| weights[i] * basis.modes[(i, k)]).sum();
            assert!((carried - load[k]).abs() < 1e-12, "{carried} {}", load[k]);
            for (i, &node) in nodes.iter().enumerate().filter(|_| k < 3) {
                assert!((few[(i, k)] - basis.modes[(node, k)]).abs() < 1e-12);
                assert!((few_deformed[(i, k)] - deformed[(node, k)]).abs() < 1e-12);
            }
            assert!((made.singular_values()[k] / plain.singular_values[k] - 1.0).abs() < 1e-9);
            let inner: f64 = (0..grid.len()).map(|i| weights[i] * basis.modes[(i, k)] * plain.modes[(i, k)]).sum();
            // The stored factors are rounded: the relative error of the pressures is a millionth.
            let share = made.singular_values()[k] / made.singular_values()[0];
            assert!((inner.abs() - 1.0).abs() * share < 1e-6, "mode {k}: {inner}");
            let off = (0..grid.len()).map(|i| (deformed[(i, k)] - directly[(i, k)]).abs()).fold(0.0, f64::max);
            assert!(off < 1e-12, "{off:e}");
        }
    }

    #[test]
    fn rounded_combinations_are_as_accurate_as_the_shared_basis() {
        let grid = GridSpec::Plane(PointGridSpec::uniform(0.05, 0.1, (-4.0, 2.0, -2.0))).build().unwrap();
        let weights = grid.weights();
        let pressures = bumps(&grid, 30, (0.01, 0.02));
        let rounded = PodBasis::new(pressures.as_ref(), weights, 0.0).unwrap().cut(25).kept(3e-8);
        let missed = |basis: &PodBasis, own: &Mat<f64>| {
            let made = dense::product(basis.modes.as_ref(), basis.best_coefficients(weights, own.as_ref()).as_ref());
            let of = |k: usize| (0..grid.len()).map(|i| weights[i] * (own[(i, k)] - made[(i, k)]).powi(2)).sum::<f64>();
            (0..own.ncols()).map(of).fold(0.0, f64::max).sqrt()
        };
        let own = pressures.get(.., ..12).to_owned();
        let shared = Arc::new(SharedBasis::new(rounded, &grid));
        let made = Combined::of(&shared, &own, weights, (0.0, 12)).unwrap();
        let (least, most) = (missed(&shared.basis, &own), missed(made.basis(), &own));
        assert!(least > 1e-7 && most < 1.5 * least, "{least:.1e}, {most:.1e}");
        // By inner products, rare modes would receive the part that they share with the first mode.
        let inner = |k: usize| made.basis().coefficients(weights, |i| own[(i, 0)])[k];
        let best = made.coefficients(weights, &own);
        let apart = (0..12).map(|k| (inner(k) - best[(k, 0)]).abs()).fold(0.0, f64::max);
        assert!(apart > 10.0 * best[(11, 0)].abs(), "{apart:.1e}, {:.1e}", best[(11, 0)]);
    }

    #[test]
    fn single_precision_fields_have_seven_digits() {
        let grid = GridSpec::Plane(PointGridSpec::uniform(0.1, 0.2, (-4.0, 2.0, -2.0))).build().unwrap();
        let pressures = Mat::from_fn(grid.len(), 9, |i, k| ((i * (k + 2)) as f64 * 0.01).sin());
        let shared = PodBasis::new(pressures.as_ref(), grid.weights(), 0.0).unwrap();
        let shared = Arc::new(SharedBasis::new(shared, &grid));
        let made = Combined::of(&shared, &pressures, grid.weights(), (0.0, 9)).unwrap();
        let coefficients: Vec<f64> = (0..9).map(|k| 1.0 / (1.0 + k as f64)).collect();
        let nodes = grid.len() - 7;
        let mut fields = [false, true].map(|_| vec![0.0; nodes]);
        for (single, field) in [false, true].into_iter().zip(&mut fields) {
            made.field(&coefficients, single, field);
        }
        let largest = fields[0].iter().fold(0.0f64, |a, b| a.max(b.abs()));
        let off = fields[0].iter().zip(&fields[1]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off > 0.0 && off < 1e-6 * largest, "{off:e} of {largest}");
        for (node, p) in fields[0].iter().enumerate() {
            let sum: f64 = coefficients.iter().enumerate().map(|(k, c)| c * made.basis().modes[(node, k)]).sum();
            assert!((sum - p).abs() < 1e-13 * largest, "{node}");
        }
    }
}
