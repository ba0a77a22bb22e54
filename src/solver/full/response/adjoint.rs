//! Solves the adjoint of the linearised equations of a steady point contact. Its solutions are the test functions of
//! reduced transient models.
//!
//! With the derivatives A by pressure and B by film thickness, the elastic kernel K, the quadrature weights w and the
//! vector 1 of ones, the linearised system is (A + B K) p + B 1 h₀ = −f, wᵀ p = load. Its adjoint is
//! (A + B K)ᵀ z + w ζ = v, (B 1)ᵀ z = l.

use crate::solver::discrete::elasticity::PointScratch;
use crate::solver::discrete::grid::{PointGrid, dot};
use crate::solver::discrete::reynolds::{CENTER, Row};
use crate::solver::discrete::space::{PlaneSpace, Space};
use crate::solver::full::System;
use crate::solver::full::gmres::Gmres;
use crate::solver::full::newton_space::{Factors, ScaledRows};
use crate::solver::full::point::PlaneMatrix;
use crate::solver::full::problem::Problem;
use std::sync::Arc;

/// Tolerance of a solve, relative to its right-hand side.
const TOLERANCE: f64 = 1e-8;
/// Largest number of Krylov iterations.
const MOST_KRYLOV: usize = 150;
/// Relative residual below which a solve is accepted. Test functions need only a few digits.
const ACCEPTED: f64 = 1e-5;

/// Factorised adjoint system.
pub struct Adjoint {
    grid: Arc<PointGrid>,
    rows: Vec<Row>,
    /// Factor of each equation.
    scaling: Vec<f64>,
    /// Quadrature weights w of the unknowns.
    weights: Vec<f64>,
    /// B 1 of the scaled equations.
    film_column: Vec<f64>,
    preconditioner: Bordered,
    krylov: Gmres,
    scratch: PointScratch,
}

/// Factors of the transposed equations, bordered by w and (B 1)ᵀ.
struct Bordered {
    matrix: PlaneMatrix,
    /// Solution for the right-hand side w.
    column: Vec<f64>,
    /// Product of this solution with B 1.
    schur: f64,
}

impl Adjoint {
    /// Creates the adjoint at the state of a system, which must be a solution of the problem. In the cavitated region,
    /// the equations have the slope of the given penalty γ̄. `None` if the matrix cannot be factorised.
    pub(in crate::solver::full) fn around(
        mut system: System<PlaneSpace>,
        problem: &Problem,
        penalty: f64,
    ) -> Option<Self> {
        system.begin(problem, &Default::default());
        let cavitated_set = std::mem::take(&mut system.active.ruptured);
        system.evaluate(problem, 0.0);
        let System { space, mut rows, pressure, .. } = system;
        for (k, row) in rows.iter_mut().enumerate() {
            let cavitated = cavitated_set.get(k).copied().unwrap_or(pressure[space.grid.node(k)] < 0.0);
            row.d_p[CENTER] -= if cavitated { penalty } else { 0.0 };
        }
        let diagonal = space.own_deformation();
        let scaling: Vec<f64> =
            rows.iter().map(|row| 1.0 / (row.d_p[CENTER].abs() + row.d_h[CENTER].abs() * diagonal)).collect();
        let grid = space.grid;
        let weights: Vec<f64> = (0..rows.len()).map(|k| grid.weights[grid.node(k)]).collect();
        let film_column: Vec<f64> = rows.iter().zip(&scaling).map(|(row, s)| s * row.d_h.iter().sum::<f64>()).collect();
        let mut matrix = PlaneMatrix::default();
        let scaled = ScaledRows { rows: &rows, thinning: None, scaling: &scaling, fractions: &[] };
        if !matrix.build_transposed(&grid, &scaled) {
            return None;
        }
        let mut column = weights.clone();
        matrix.solve(&mut column);
        let schur = dot(&film_column, &column);
        let preconditioner = Bordered { matrix, column, schur };
        let (krylov, scratch) = (Gmres::default(), PointScratch::default());
        Some(Self { grid, rows, scaling, weights, film_column, preconditioner, krylov, scratch })
    }

    /// Returns (z, ζ) for the right-hand sides v, one entry per unknown, and l. `None` if the solve does not converge.
    pub fn solve(&mut self, v: &[f64], l: f64) -> Option<(Vec<f64>, f64)> {
        let Self { grid, rows, scaling, weights, film_column, preconditioner, krylov, scratch } = self;
        let n = rows.len();
        // Aᵀ z, Bᵀ z and Kᵀ Bᵀ z as node arrays.
        let [mut by_pressure, mut by_film, mut by_deformation] = [(); 3].map(|()| vec![0.0; grid.len()]);
        let rhs: Vec<f64> = v.iter().copied().chain([l]).collect();
        let mut solution = vec![0.0; n + 1];
        let outcome = krylov.solve(
            &rhs,
            &mut solution,
            (TOLERANCE, MOST_KRYLOV),
            |z, out| {
                by_pressure.fill(0.0);
                by_film.fill(0.0);
                for (k, ((row, s), z)) in rows.iter().zip(&*scaling).zip(z).enumerate() {
                    let factor = s * z;
                    for ((node, d_p), d_h) in grid.row(k).0.into_iter().zip(row.d_p).zip(row.d_h) {
                        by_pressure[node] += factor * d_p;
                        by_film[node] += factor * d_h;
                    }
                }
                grid.flexibility.apply_transposed(&by_film, &mut by_deformation, scratch);
                for (k, (out, weight)) in out.iter_mut().zip(&*weights).enumerate() {
                    let node = grid.node(k);
                    *out = by_pressure[node] + by_deformation[node] + weight * z[n];
                }
                out[n] = dot(film_column, &z[..n]);
            },
            |z| preconditioner.apply(z, film_column),
            |_| true,
        );
        if outcome.relative_residual.is_nan() || outcome.relative_residual >= ACCEPTED {
            return None;
        }
        let zeta = solution.pop()?;
        solution.iter_mut().zip(scaling).for_each(|(z, s)| *z *= *s);
        Some((solution, zeta))
    }
}

impl Bordered {
    /// Solves the bordered system in place. The last entry of `z` is l before and ζ after it.
    fn apply(&mut self, z: &mut [f64], film_column: &[f64]) {
        let (head, last) = z.split_at_mut(film_column.len());
        self.matrix.solve(head);
        let zeta = if self.schur == 0.0 { 0.0 } else { (dot(film_column, head) - last[0]) / self.schur };
        head.iter_mut().zip(&self.column).for_each(|(z, c)| *z -= zeta * c);
        last[0] = zeta;
    }
}
