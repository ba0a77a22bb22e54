//! Error measures of section 3.1.2: e_z with respect to a full solution (3.10), and the residuals e_f (3.14) and
//! e_f^I (3.15).
//!
//! The state is that of the dissertation, z = (P, δ, H₀), with pressure P, elastic deformation δ = H − H₀ − (X² +
//! Y²)/2 and rigid-body separation H₀; P and δ are node arrays. f_δ = δ − K P is taken in the reference coordinate of
//! the reduced model. [`Norm`] selects the norm ‖·‖. A model with the exact deformation K V_p has f_δ = 0 and no δ̃.
//! With deformation modes V_δ the Galerkin rows give δ̃ = V_δᵀ W K V_p p̃.
//!
//! ‖f_δ‖² = z̃ᵀ E_δ z̃ needs no large-scale work, but is a difference of large numbers. Below about 1e-7 ‖K V_p p̃‖
//! it is rounding, and a negative result counts as zero. This level is far below the other parts of the residual.

use super::dense::{product, quadratic_form};
use super::model::{Window, deformation_weights};
use super::online::ReducedOptions;
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::discrete::nodes::Nodes;
use crate::solver::full::Solution;
use faer::{ColRef, Mat};
use serde::{Deserialize, Serialize};

/// Norm of states and residuals. H₀ and the load balance count once in either.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum Norm {
    /// All nodes count equally: the dissertation's ‖·‖₂, which grows with the number of nodes.
    Euclidean,
    /// Nodes count by their cell sizes, so that grids can be compared: the L2 norm over X (and Y). The online
    /// residual uses this norm.
    #[default]
    Quadrature,
}

/// Residual of a reduced solution and its parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residuals {
    /// e_f of (3.14): all rows of the Reynolds equation.
    pub all_rows: f64,
    /// e_f^I of (3.15): the sampled equations only.
    pub sampled_rows: f64,
    /// ‖f_δ‖ by (3.13).
    pub deformation: f64,
    /// f_h0, the load-balance residual.
    pub load: f64,
}

/// Error measures of one local model for given options.
pub struct ErrorMeasures {
    norm: Norm,
    penalty: f64,
    grid: ContactGrid,
    sampled_rows: Vec<usize>,
    /// V_δᵀ W K V_p, which gives δ̃; without rows for the exact deformation.
    projection: Mat<f64>,
    /// E_δ over (p̃, δ̃).
    deformation_error: Mat<f64>,
}

impl ErrorMeasures {
    /// Computes E_δ for a local model and the number of modes in the options.
    pub fn new(window: &Window, options: &ReducedOptions, norm: Norm) -> Self {
        let modes = options.pressure_modes.unwrap_or(usize::MAX).clamp(1, window.pressure.count());
        let kept = options.deformation_modes.map_or(0, |k| k.clamp(1, window.deformation.modes.ncols()));
        let flexed = window.pressure.flexed().get(.., ..modes);
        let basis = window.deformation.modes.get(.., ..kept);
        let cells = deformation_weights(&window.grid);
        let weighted = Mat::from_fn(basis.nrows(), kept, |i, j| cells[i] * basis[(i, j)]);
        let projection = product(weighted.transpose(), flexed);
        // f_δ = [−K V_p, V_δ] (p̃, δ̃), (3.12). E_δ is its Gram matrix, so both off-diagonal blocks have the minus sign
        // that is missing in the lower left block of (3.13) as printed. The zero row and column of H₀ are omitted.
        let size = modes + if kept > 0 { kept } else { 0 };
        let weight = |i: usize| match norm {
            Norm::Euclidean => 1.0,
            Norm::Quadrature => cells[i].sqrt(),
        };
        let row_of = |i: usize, k: usize| if k < modes { -flexed[(i, k)] } else { basis[(i, k - modes)] };
        let f = Mat::from_fn(if kept > 0 { flexed.nrows() } else { 0 }, size, |i, k| weight(i) * row_of(i, k));
        let deformation_error = product(f.transpose(), f.as_ref());
        Self {
            norm,
            penalty: options.penalty.unwrap_or(window.penalty),
            grid: window.grid.clone(),
            sampled_rows: window.sampled_rows.clone(),
            projection,
            deformation_error,
        }
    }

    /// Returns E_δ of (3.13) over (p̃, δ̃); zero for the exact deformation.
    pub fn deformation_error(&self) -> &Mat<f64> {
        &self.deformation_error
    }

    /// Returns (p̃, δ̃) for the pressure coefficients of a reduced solution.
    pub fn state(&self, coefficients: &[f64]) -> Vec<f64> {
        let coefficients = ColRef::from_slice(coefficients);
        let deformation = product(self.projection.as_ref(), coefficients.as_mat());
        coefficients.iter().chain(deformation.col(0).iter()).copied().collect()
    }

    /// Returns e_f and e_f^I of a reduced solution from its pressure coefficients and its reconstructed fields.
    pub fn residuals(&self, coefficients: &[f64], fields: &Solution) -> Residuals {
        let problem = &fields.problem;
        let (scale, weights) = (fields.mesh.scale, self.grid.weights());
        let (gradient, kappa) = (fields.gradient(), problem.point.ellipse().kappa);
        let nodes = Nodes::of(problem.laws(), &gradient, &fields.pressure, &fields.film);
        let squared: Vec<f64> = (0..self.grid.unknowns())
            .map(|unknown| {
                let (stencil, geometry) = self.grid.row(unknown);
                // Behind the cavitation boundary the multiplier λ balances the row.
                let multiplier = fields.multiplier.get(self.grid.node(unknown)).copied().unwrap_or(0.0);
                let value =
                    nodes.row(&geometry.scaled(scale).across_by(kappa), self.penalty, stencil).value + multiplier;
                self.weight(scale * weights[self.grid.node(unknown)]) * value * value
            })
            .collect();
        let state = self.state(coefficients);
        let deformation = self.weight(scale) * quadratic_form(self.deformation_error.as_ref(), &state).max(0.0);
        let load = scale * weights.iter().zip(&fields.pressure).map(|(w, p)| w * p).sum::<f64>() - problem.load;
        let linear = deformation + load * load;
        let sampled: f64 = self.sampled_rows.iter().map(|&r| squared[r]).sum();
        Residuals {
            all_rows: (squared.iter().sum::<f64>() + linear).sqrt(),
            sampled_rows: (sampled + linear).sqrt(),
            deformation: deformation.sqrt(),
            load,
        }
    }

    /// Returns e_z of (3.10): ‖z − Vz̃‖/‖z‖ of reconstructed fields with respect to a full solution on the same grid.
    pub fn state_error(&self, fields: &Solution, full: &Solution) -> f64 {
        let cells = deformation_weights(&self.grid);
        let (bent, approximate) = (full.deformation(), fields.deformation());
        let (mut error, mut size) = ((fields.scalars.h_0 - full.scalars.h_0).powi(2), full.scalars.h_0.powi(2));
        for (i, cell) in cells.iter().enumerate() {
            let weight = self.weight(cell * full.mesh.scale);
            error += weight * (fields.pressure[i] - full.pressure[i]).powi(2);
            error += weight * (approximate[i] - bent[i]).powi(2);
            size += weight * (full.pressure[i].powi(2) + bent[i].powi(2));
        }
        (error / size).sqrt()
    }

    fn weight(&self, cell: f64) -> f64 {
        match self.norm {
            Norm::Euclidean => 1.0,
            Norm::Quadrature => cell,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Online, Sampling, Starts};
    use super::*;
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::full::{ContactSolver, Start};
    use crate::solver::physics::contact::ContactKind;
    use crate::solver::physics::lubricant::Lubricant;
    use crate::solver::training::small::{line, trained};
    use crate::solver::training::{TrainingSpec, WindowSpec, Windows, random_points};
    use std::sync::Arc;

    fn spec(sampling: Sampling, registered: bool) -> TrainingSpec {
        let grid = GridSpec::Graded { nodes: 200, domain: (-6.0, 1.9), registered };
        let windows = Windows::Given(vec![WindowSpec::new((1.0, 500.0), grid)]);
        TrainingSpec { windows, pressure_loss: 1e-5, deformation_loss: 1e-4, ..line(sampling, 24) }
    }

    /// Calls `look` with reduced solutions at random points.
    fn for_solutions(
        sampling: Sampling,
        options: ReducedOptions,
        mut look: impl FnMut(&Window, &Online, super::super::ReducedSolution),
    ) {
        let spec = spec(sampling, true);
        let model = trained(&spec);
        let mut online = Online::new(Arc::clone(&model), options);
        let points = random_points(&spec.range, ContactKind::Line, 6, 2);
        for point in points {
            let solved = online.solve(&point, Lubricant::default()).unwrap();
            look(&model.windows[0], &online, solved);
        }
    }

    #[test]
    fn the_deformation_form_is_the_norm_of_the_large_scale_residual() {
        let options = ReducedOptions { deformation_modes: Some(3), ..ReducedOptions::default() };
        for norm in [Norm::Euclidean, Norm::Quadrature] {
            for_solutions(Sampling::QDeim, options, |window, online, solved| {
                let measures = ErrorMeasures::new(window, &options, norm);
                let e = measures.deformation_error();
                assert!((0..e.nrows()).all(|i| (0..i).all(|j| e[(i, j)] == e[(j, i)])), "symmetric");
                let fields = online.reconstruct(&solved).unwrap();
                let state = measures.state(&solved.coefficients);
                let modes = solved.coefficients.len();
                let kept_modes = state.len() - modes;
                let cells = deformation_weights(&window.grid);
                let direct: f64 = (0..cells.len())
                    .map(|i| {
                        let bent: f64 = (0..modes).map(|k| window.pressure.flexed()[(i, k)] * state[k]).sum();
                        let kept: f64 =
                            (0..kept_modes).map(|k| window.deformation.modes[(i, k)] * state[modes + k]).sum();
                        let weight = if norm == Norm::Euclidean { 1.0 } else { cells[i] * fields.mesh.scale };
                        weight * (kept - bent).powi(2)
                    })
                    .sum::<f64>()
                    .sqrt();
                let form = measures.residuals(&solved.coefficients, &fields).deformation;
                assert!((form / direct - 1.0).abs() < 1e-5, "{norm:?}: {form} {direct}");
                // As printed, without the second minus sign, the form is not even small.
                let (p, d) = state.split_at(modes);
                let mixed: f64 = (0..modes)
                    .flat_map(|i| (0..kept_modes).map(move |j| (i, j)))
                    .map(|(i, j)| p[i] * e[(i, modes + j)] * d[j])
                    .sum();
                assert!(-2.0 * mixed > 100.0 * direct * direct);
            });
        }
    }

    #[test]
    fn the_sampled_residual_is_the_one_of_the_online_iteration() {
        for deformation_modes in [None, Some(12)] {
            for starts in [Starts::Explorer, Starts::Nearest] {
                let options = ReducedOptions { deformation_modes, starts, ..ReducedOptions::default() };
                for_solutions(Sampling::QDeim, options, |window, online, solved| {
                    let fields = online.reconstruct(&solved).unwrap();
                    let measures = ErrorMeasures::new(window, &options, Norm::Quadrature);
                    let found = measures.residuals(&solved.coefficients, &fields);
                    assert!((found.sampled_rows / solved.residual_estimate - 1.0).abs() < 1e-4, "{found:?}");
                    assert!(found.all_rows >= found.sampled_rows && found.load.abs() < 1e-10);
                    assert_eq!(found.deformation > 0.0, deformation_modes.is_some());
                });
            }
        }
    }

    #[test]
    fn with_all_rows_sampled_both_residuals_are_one() {
        let options = ReducedOptions::default();
        for norm in [Norm::Euclidean, Norm::Quadrature] {
            for_solutions(Sampling::All, options, |window, online, solved| {
                let fields = online.reconstruct(&solved).unwrap();
                let found = ErrorMeasures::new(window, &options, norm).residuals(&solved.coefficients, &fields);
                assert!((found.all_rows / found.sampled_rows - 1.0).abs() < 1e-12);
            });
        }
    }

    #[test]
    fn the_state_error_sees_each_part() {
        let options = ReducedOptions::default();
        for_solutions(Sampling::QDeim, options, |window, online, solved| {
            let full =
                ContactSolver::on(&window.grid).solve(&solved.point, Lubricant::default(), Start::Cold, &()).unwrap();
            for norm in [Norm::Euclidean, Norm::Quadrature] {
                let measures = ErrorMeasures::new(window, &options, norm);
                assert_eq!(measures.state_error(&full, &full), 0.0);
                let error = measures.state_error(&online.reconstruct(&solved).unwrap(), &full);
                assert!(error > 1e-9 && error < 1e-2, "{error}");
                let mut shifted = full.clone();
                shifted.scalars.h_0 += 1e-3;
                shifted.film.iter_mut().for_each(|h| *h += 1e-3);
                let by_shift = measures.state_error(&shifted, &full);
                // Only H₀ differs, not the deformation H − H₀ − X²/2.
                assert!(by_shift > 0.0 && by_shift < 1e-3 / full.scalars.h_0.abs(), "{by_shift}");
                let mut stretched = full.clone();
                stretched.pressure.iter_mut().for_each(|p| *p *= 1.01);
                assert!((1e-4..=1e-2).contains(&measures.state_error(&stretched, &full)));
            }
        });
    }
}
