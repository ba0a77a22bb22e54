//! Equations of a Newton step: Galerkin's, or those of residual minimisation.

use super::case::Case;
use super::least_squares::LeastSquares;
use super::part::Part;
use super::sampled_system::SampledSystem;
use crate::solver::reduced::minimisation::Scheme;
use crate::solver::reduced::model::Window;
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, Mat, MatRef, Par};

/// Combination of the sampled equations.
pub(super) enum Equations {
    /// As many equations as modes: G with Vᵀ W f ≈ G f_I, modes × rows.
    Galerkin(Mat<f64>),
    /// Least squares of the rows, each with its factor, 1 × rows, (2.69).
    LeastSquares { factors: Mat<f64>, least: LeastSquares },
    /// Least squares of the reconstructions by two bases, equations × rows each, (2.80)–(2.82).
    Gnat { of_jacobian: Mat<f64>, of_residual: Mat<f64>, least: LeastSquares },
}

impl Equations {
    /// Returns the equations of a local model for its first modes.
    pub fn of(window: &Window, modes: usize) -> Self {
        let own = &window.reconstruction;
        match (window.scheme, &window.residual_reconstruction) {
            (Scheme::Galerkin, _) => Self::Galerkin(own.get(..modes, ..).to_owned()),
            (_, None) => {
                let least = LeastSquares::new(window.sampled_rows.len() + 1, modes + 1);
                Self::LeastSquares { factors: own.clone(), least }
            }
            (_, Some(of_residual)) => {
                let least = LeastSquares::new(own.nrows() + 1, modes + 1);
                Self::Gnat { of_jacobian: own.clone(), of_residual: of_residual.clone(), least }
            }
        }
    }

    /// Returns true if the factors of one step can be used for another.
    pub fn have_factors(&self) -> bool {
        matches!(self, Self::Galerkin(_))
    }

    /// Solves for the step, which is stored in `system.step.rhs`. Returns false if the equations are singular. If
    /// `keep`, a copy of Galerkin's matrix is kept for an observer.
    pub fn step(
        &mut self,
        system: &mut SampledSystem,
        parts: &mut [Box<dyn Part>],
        case: &Case<'_>,
        coefficients: &[f64],
        keep: bool,
    ) -> bool {
        let SampledSystem { modes, active, values, jacobian_rows, film_column, load_row, step, jacobian, .. } = system;
        let modes = *modes;
        let rows = (
            MatRef::from_row_major_slice(jacobian_rows, values.len(), modes),
            ColRef::from_slice(film_column),
            ColRef::from_slice(values),
        );
        let load = (load_row.as_slice(), case.scale, case.problem.load);
        match self {
            Self::Galerkin(own) => {
                reduce((own.as_ref(), own.as_ref()), rows, (&mut step.matrix, &mut step.rhs));
                for part in parts {
                    part.equations(coefficients, Some(step.matrix.get_mut(..modes, ..modes)), &mut step.rhs[..modes]);
                }
                carry(load, coefficients, modes, (&mut step.matrix, &mut step.rhs));
                if case.prescribed {
                    hold(modes, (&mut step.matrix, &mut step.rhs));
                }
                if keep {
                    jacobian.copy_from(&step.matrix);
                }
                // The coefficients of omitted modes do not change.
                for k in *active..modes {
                    step.matrix.row_mut(k).fill(0.0);
                    step.matrix.col_mut(k).fill(0.0);
                    (step.matrix[(k, k)], step.rhs[k]) = (1.0, 0.0);
                }
                step.solve();
            }
            Self::LeastSquares { factors, least } => {
                let LeastSquares { matrix, rhs, .. } = least;
                for (r, factor) in factors.row(0).iter().enumerate() {
                    for k in 0..modes {
                        matrix[(r, k)] = factor * rows.0[(r, k)];
                    }
                    (matrix[(r, modes)], rhs[r]) = (factor * film_column[r], -factor * values[r]);
                }
                carry(load, coefficients, values.len(), (matrix, rhs));
                if case.prescribed {
                    hold(values.len(), (matrix, rhs));
                }
                least.solve();
                step.rhs.copy_from_slice(&least.rhs[..=modes]);
            }
            Self::Gnat { of_jacobian, of_residual, least } => {
                let bases = (of_jacobian.as_ref(), of_residual.as_ref());
                reduce(bases, rows, (&mut least.matrix, &mut least.rhs));
                carry(load, coefficients, of_jacobian.nrows(), (&mut least.matrix, &mut least.rhs));
                if case.prescribed {
                    hold(of_jacobian.nrows(), (&mut least.matrix, &mut least.rhs));
                }
                least.solve();
                step.rhs.copy_from_slice(&least.rhs[..=modes]);
            }
        }
        step.rhs.iter().all(|v| v.is_finite())
    }

    /// Solves for the step with the current values and the factors of the last [`Self::step`]. Returns false if they
    /// are singular or if the equations have no factors.
    pub fn step_again(
        &self,
        system: &mut SampledSystem,
        parts: &mut [Box<dyn Part>],
        case: &Case<'_>,
        coefficients: &[f64],
    ) -> bool {
        let Self::Galerkin(own) = self else { return false };
        let SampledSystem { modes, active, values, load_row, step, .. } = system;
        let (modes, rhs) = (*modes, &mut step.rhs);
        let reduced = ColMut::from_slice_mut(&mut rhs[..modes]);
        let residual = ColRef::from_slice(values);
        matmul(reduced.as_mat_mut(), Accum::Replace, own.as_ref(), residual.as_mat(), -1.0, Par::Seq);
        for part in parts {
            part.equations(coefficients, None, &mut rhs[..modes]);
        }
        rhs[*active..modes].fill(0.0);
        let carried: f64 = load_row.iter().zip(coefficients).map(|(l, c)| case.scale * l * c).sum();
        rhs[modes] = if case.prescribed { 0.0 } else { case.problem.load - carried };
        step.solve_again();
        step.rhs.iter().all(|v| v.is_finite())
    }
}

/// Applies two bases to the rows: to their derivatives by coefficients and by the rigid-body separation H₀, and to
/// their values with opposite sign.
fn reduce(
    (of_jacobian, of_residual): (MatRef<'_, f64>, MatRef<'_, f64>),
    (jacobian, films, values): (MatRef<'_, f64>, ColRef<'_, f64>, ColRef<'_, f64>),
    (matrix, rhs): (&mut Mat<f64>, &mut [f64]),
) {
    let (equations, modes) = (of_jacobian.nrows(), jacobian.ncols());
    matmul(matrix.get_mut(..equations, ..modes), Accum::Replace, of_jacobian, jacobian, 1.0, Par::Seq);
    matmul(matrix.get_mut(..equations, modes..), Accum::Replace, of_jacobian, films.as_mat(), 1.0, Par::Seq);
    let right = ColMut::from_slice_mut(&mut rhs[..equations]);
    matmul(right.as_mat_mut(), Accum::Replace, of_residual, values.as_mat(), -1.0, Par::Seq);
}

/// Writes row `last` of the equations: the pressures carry the load.
fn carry(
    (load_row, scale, load): (&[f64], f64, f64),
    coefficients: &[f64],
    last: usize,
    (matrix, rhs): (&mut Mat<f64>, &mut [f64]),
) {
    let mut carried = 0.0;
    for (k, (l, c)) in load_row.iter().zip(coefficients).enumerate() {
        matrix[(last, k)] = scale * l;
        carried += scale * l * c;
    }
    (matrix[(last, load_row.len())], rhs[last]) = (0.0, load - carried);
}

/// Replaces row `last` of the equations: H₀, the last unknown, does not change.
fn hold(last: usize, (matrix, rhs): (&mut Mat<f64>, &mut [f64])) {
    matrix.row_mut(last).fill(0.0);
    let unknown = matrix.ncols() - 1;
    (matrix[(last, unknown)], rhs[last]) = (1.0, 0.0);
}
