//! Selection of the sampled equations, and reconstruction of the projected residual from them.
//!
//! Every method returns rows I and a matrix G (modes × rows) with Vᵀ W f ≈ G f_I (modes V, weights W, residual f), so
//! that the online phase is independent of the method.

use super::minimisation::Scheme;
use super::pod::PodBasis;
use crate::solver::discrete::grid::ContactGrid;
use faer::linalg::solvers::{ColPivQr, PartialPivLu, Solve, Svd};
use faer::{Mat, MatRef};
use serde::{Deserialize, Serialize};

/// Sampling method of the reduced equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum Sampling {
    /// Every row: no sampling error, large-scale cost.
    All,
    /// Greedy selection of the dissertation, Fig. 2.9, with the rows of V_p themselves, (2.106).
    Greedy,
    /// Q-DEIM with the fixed reconstruction V_pᵀ Φ_J (Φ_J,I)⁻¹; pivoted QR selects the rows.
    #[default]
    QDeim,
    /// Goal-oriented cubature: rows with non-negative weights that reproduce the Newton steps, G = V_Iᵀ diag(w).
    Cubature,
}

/// Sampled equations (unknown indices, ascending) and the matrix G.
#[derive(Clone, Debug)]
pub struct SampledRows {
    /// Row indices.
    pub rows: Vec<usize>,
    /// Reconstruction from their values, see [`super::Window::reconstruction`].
    pub reconstruction: Mat<f64>,
    /// Scheme that determines the step.
    pub scheme: Scheme,
    /// GNAT's reconstruction of the residual.
    pub residual: Option<Mat<f64>>,
}

/// Residual and Jacobian snapshots (2.108), (2.109) over the unknowns, one per column, rows scaled by √w.
#[derive(Clone, Debug, Default)]
pub struct RowSnapshots {
    /// f_p at the iterates.
    pub residual: Vec<Vec<f64>>,
    /// J V Δz̃ at the iterates (the Δ is missing in (2.109) as printed).
    pub jacobian: Vec<Vec<f64>>,
}

/// Test space of the rows of the Reynolds equation: V and the quadrature weights at the unknowns.
#[derive(Clone, Debug)]
pub struct TestSpace {
    /// V, unknowns × modes.
    pub modes: Mat<f64>,
    /// Weights at the unknowns, all positive.
    pub weights: Vec<f64>,
}

impl TestSpace {
    /// Returns the test space of a pressure basis on a grid.
    pub fn new(basis: &PodBasis, grid: &ContactGrid) -> Self {
        let nodes: Vec<usize> = (0..grid.unknowns()).map(|unknown| grid.node(unknown)).collect();
        Self {
            modes: Mat::from_fn(nodes.len(), basis.modes.ncols(), |i, k| basis.modes[(nodes[i], k)]),
            weights: nodes.iter().map(|&node| grid.weights()[node]).collect(),
        }
    }

    /// Returns the rows with G = V_Iᵀ W_I.
    fn rows(&self, rows: Vec<usize>) -> SampledRows {
        let reconstruction =
            Mat::from_fn(self.modes.ncols(), rows.len(), |k, r| self.weights[rows[r]] * self.modes[(rows[r], k)]);
        SampledRows::tested(rows, reconstruction)
    }
}

impl SampledRows {
    /// Creates sampled equations for Galerkin's scheme: the combinations G f_I vanish.
    pub fn tested(rows: Vec<usize>, reconstruction: Mat<f64>) -> Self {
        Self { rows, reconstruction, scheme: Scheme::Galerkin, residual: None }
    }
}

/// Returns every row with its quadrature weight.
pub fn all_rows(test: &TestSpace) -> SampledRows {
    test.rows((0..test.weights.len()).collect())
}

/// Returns the leading left singular vectors of snapshots.
pub(super) fn leading_modes(snapshots: &[Vec<f64>], count: usize) -> Option<Mat<f64>> {
    let n = snapshots.first()?.len();
    let matrix = Mat::from_fn(n, snapshots.len(), |i, j| snapshots[j][i]);
    let svd = Svd::new_thin(matrix.as_ref()).ok()?;
    let count = count.min(svd.U().ncols());
    Some(svd.U().get(.., ..count).to_owned())
}

/// Selects rows by the greedy algorithm of the dissertation, Fig. 2.9, on the POD bases of residual and Jacobian
/// snapshots. `None` if the linear algebra fails.
pub fn greedy(test: &TestSpace, snapshots: &RowSnapshots, count: usize) -> Option<SampledRows> {
    Some(test.rows(greedy_rows(snapshots, count)?))
}

/// Selects rows by pivoted QR of the Jacobian snapshots, or by the greedy algorithm.
pub(super) fn gappy_rows(sampling: Sampling, snapshots: &RowSnapshots, count: usize) -> Option<Vec<usize>> {
    if sampling == Sampling::Greedy {
        return greedy_rows(snapshots, count);
    }
    Some(pivots(leading_modes(&snapshots.jacobian, count)?.as_ref()))
}

fn greedy_rows(snapshots: &RowSnapshots, count: usize) -> Option<Vec<usize>> {
    let residual = leading_modes(&snapshots.residual, count)?;
    let jacobian = leading_modes(&snapshots.jacobian, count)?;
    let count = count.min(residual.ncols()).min(jacobian.ncols());
    let n = residual.nrows();
    let mut rows: Vec<usize> = Vec::with_capacity(count);
    let mut taken = vec![false; n];
    for mode in 0..count {
        let parts = [interpolation_error(&residual, &rows, mode), interpolation_error(&jacobian, &rows, mode)];
        let size = |j: usize| parts[0][j].powi(2) + parts[1][j].powi(2);
        let next = (0..n).filter(|&j| !taken[j]).max_by(|&a, &b| size(a).total_cmp(&size(b)))?;
        taken[next] = true;
        rows.push(next);
    }
    rows.sort_unstable();
    Some(rows)
}

/// Selects as many rows as modes by QR with column pivoting, ascending.
fn pivots(phi: MatRef<'_, f64>) -> Vec<usize> {
    let qr = ColPivQr::new(phi.transpose());
    let (forward, _) = qr.P().arrays();
    let mut rows: Vec<usize> = forward[..phi.ncols()].to_vec();
    rows.sort_unstable();
    rows
}

/// Returns the error of column `mode` interpolated from the previous columns at the selected rows.
fn interpolation_error(modes: &Mat<f64>, rows: &[usize], mode: usize) -> Vec<f64> {
    let n = modes.nrows();
    let mut error: Vec<f64> = (0..n).map(|i| modes[(i, mode)]).collect();
    if rows.is_empty() {
        return error;
    }
    let m = rows.len();
    let system = Mat::from_fn(m, m, |r, c| modes[(rows[r], c)]);
    let rhs = Mat::from_fn(m, 1, |r, _| modes[(rows[r], mode)]);
    let coefficients = PartialPivLu::new(system.as_ref()).solve(&rhs);
    for (i, e) in error.iter_mut().enumerate() {
        *e -= (0..m).map(|c| modes[(i, c)] * coefficients[(c, 0)]).sum::<f64>();
    }
    error
}

/// Selects rows by Q-DEIM on the Jacobian snapshots: as many rows as POD modes Φ, by QR with column pivoting of Φᵀ
/// (Drmač & Gugercin 2016).
///
/// Returns one result for each of the counts; `None` if the linear algebra fails.
pub fn q_deim(test: &TestSpace, snapshots: &RowSnapshots, counts: &[usize]) -> Vec<Option<SampledRows>> {
    let most = counts.iter().copied().max().unwrap_or(0);
    let modes = leading_modes(&snapshots.jacobian, most);
    let of = |count: usize| {
        let modes = modes.as_ref()?;
        Some(q_deim_of(test, modes.get(.., ..count.min(modes.ncols()))))
    };
    counts.iter().map(|count| of(*count)).collect()
}

/// Returns the rows for one basis Φ.
fn q_deim_of(test: &TestSpace, phi: MatRef<'_, f64>) -> SampledRows {
    let count = phi.ncols();
    let unknowns = phi.nrows();
    let rows = pivots(phi);
    // The snapshots are scaled by √w. So are the test functions, and G removes the scale from the sampled values.
    let modes = test.modes.ncols();
    let scaled = Mat::from_fn(unknowns, modes, |i, k| test.weights[i].sqrt() * test.modes[(i, k)]);
    let projected: Mat<f64> = phi.transpose() * &scaled;
    let sampled = Mat::from_fn(count, count, |r, c| phi[(rows[r], c)]);
    // G′ = projectedᵀ Φ_I⁻¹, so Φ_Iᵀ G′ᵀ = projected.
    let solution = PartialPivLu::new(sampled.transpose()).solve(&projected);
    let reconstruction = Mat::from_fn(modes, count, |k, r| solution[(r, k)] * test.weights[rows[r]].sqrt());
    SampledRows::tested(rows, reconstruction)
}

/// Returns true if a matrix has only finite entries.
pub fn is_finite(matrix: MatRef<'_, f64>) -> bool {
    matrix.col_iter().all(|c| c.iter().all(|v| v.is_finite()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> (TestSpace, RowSnapshots) {
        let unknowns = 40;
        let weights: Vec<f64> = (0..unknowns).map(|i| 0.05 + 0.001 * i as f64).collect();
        let modes = Mat::from_fn(unknowns, 4, |i, k| ((i * (k + 1)) as f64 * 0.11).cos());
        // Snapshots from a six-dimensional space.
        let column = |j: usize| {
            (0..unknowns)
                .map(|i| (0..6).map(|q| ((j * 7 + q) as f64).sin() * ((i * (q + 2)) as f64 * 0.07).sin()).sum())
                .collect()
        };
        let snapshots =
            RowSnapshots { residual: (0..20).map(column).collect(), jacobian: (5..30).map(column).collect() };
        (TestSpace { modes, weights }, snapshots)
    }

    #[test]
    fn q_deim_reconstructs_what_the_snapshots_span_exactly() {
        let (test, snapshots) = example();
        let sampled = q_deim(&test, &snapshots, &[6]).pop().flatten().unwrap();
        assert_eq!(sampled.rows.len(), 6);
        let all = all_rows(&test);
        for column in &snapshots.jacobian {
            // Residual f whose √w-scaled values lie in the snapshot space.
            let f: Vec<f64> = column.iter().enumerate().map(|(i, v)| v / test.weights[i].sqrt()).collect();
            for k in 0..4 {
                let exact: f64 = f.iter().enumerate().map(|(i, f)| all.reconstruction[(k, i)] * f).sum();
                let from_rows: f64 =
                    sampled.rows.iter().enumerate().map(|(r, &i)| sampled.reconstruction[(k, r)] * f[i]).sum();
                assert!((exact - from_rows).abs() < 1e-9 * (1.0 + exact.abs()));
            }
        }
    }

    #[test]
    fn greedy_takes_distinct_rows() {
        let (test, snapshots) = example();
        let sampled = greedy(&test, &snapshots, 6).unwrap();
        let mut rows = sampled.rows.clone();
        rows.dedup();
        assert_eq!(rows.len(), 6);
    }
}
