//! Method of the dissertation, the baseline of `bench`: Newton's method with a dense LU factorisation of the whole
//! Jacobian in every step.

use super::line::Backtracking;
use super::problem::Problem;
use super::system::{SolveOptions, System};
use crate::solver::discrete::grid::{FIRST_UNKNOWN, LineGrid};
use crate::solver::discrete::space::LineSpace;
use faer::linalg::solvers::Solve;
use faer::{Mat, linalg::solvers::PartialPivLu};

/// Runs dense Newton steps from the current state of `system` until ‖Δz‖/‖z‖ < 1e-10. `kernel` is K over the node
/// arrays. Returns the number of steps.
pub fn dense_newton(
    system: &mut System<LineSpace>,
    problem: &Problem,
    options: &SolveOptions<Backtracking>,
    kernel: &Mat<f64>,
) -> usize {
    let u = system.rows.len();
    let mut before = system.evaluate(problem, options.penalty);
    for iteration in 1..=options.max_newton {
        let mut jacobian = Mat::<f64>::zeros(u + 1, u + 1);
        for j in 0..u {
            let column = kernel.col(j + FIRST_UNKNOWN);
            for k in 0..u {
                let b = &system.rows[k].d_h;
                jacobian[(k, j)] = (0..4).map(|m| b[m] * column[k + m]).sum();
            }
        }
        for k in 0..u {
            for m in 0..4 {
                if (FIRST_UNKNOWN..FIRST_UNKNOWN + u).contains(&(k + m)) {
                    jacobian[(k, k + m - FIRST_UNKNOWN)] += system.rows[k].d_p[m];
                }
            }
            jacobian[(k, u)] = system.rows[k].d_h.iter().sum();
            jacobian[(u, k)] = system.space.grid.weights[k + FIRST_UNKNOWN];
        }
        let rhs = Mat::from_fn(u + 1, 1, |i, _| if i < u { -system.rows[i].value } else { 0.0 });
        let update = PartialPivLu::new(jacobian.as_ref()).solve(&rhs);
        let (step, residual) = system.take_step(problem, options, before, |i| update[(i, 0)]);
        before = residual;
        if step < options.tolerance || !residual.is_finite() {
            return iteration;
        }
    }
    options.max_newton
}

/// Returns the dense kernel of a grid over its node arrays.
pub fn dense_kernel(grid: &LineGrid) -> Mat<f64> {
    Mat::from_fn(grid.len(), grid.len(), |i, j| grid.kernel_entry(i, j))
}
