//! Discretisation error of a full solution: the errors of its central film thickness due to the ends of the domain
//! and to the finite spacing. Each costs one linear solve.
//!
//! Both are linear responses of the converged system, −J⁻¹ times a defect of the discrete equations. J is the
//! Jacobian.
//!
//! - The domain prescribes P = 0 where an endless inlet has a pressure. Beyond the ends of the domain the gap grows
//!   like R²/2 with the distance R, and the viscosity is the ambient one. The pressure of the full film there, with
//!   the half-Sommerfeld condition, is λ̄|X|/(3H²) in a line contact and λ̄|X|/((3 + 2R_x/R_y)H²) in a point contact.
//!   It enters the equations next to the ends. The load of the missing pressure enters the load equation.
//! - A scheme of second order, evaluated on every other node of the solution, has a defect three times that of the
//!   solution itself.

use super::grid_cost::{GridCost, TOLERATED};
use super::newton_space::NewtonSpace;
use super::problem::Problem;
use super::solution::Solution;
use super::solver::Solver;
use super::system::System;
use crate::solver::discrete::grid::{INLET, that_would_do};
use crate::solver::discrete::reynolds::{EAST, NORTH, SOUTH, WEST};
use crate::solver::discrete::space::Grid;
use crate::solver::physics::contact::FilmShape;
use crate::solver::warning::{NearEnds, Warning, WideSpacing};

/// Accuracy of the linear solves, and their maximum number of iterations.
const LINEAR: (f64, usize) = (1e-4, 60);
/// Residual of such a solve, relative to its right-hand side, above which its result is not used.
const UNSOLVED: f64 = 0.05;

impl Solution {
    /// Returns a warning if the error of the central film thickness exceeds the limit, with a sufficient grid.
    pub fn grid_warning(&self) -> Option<Warning> {
        let cost = self.grid_cost?;
        let mut warning = cost.warning()?;
        let Warning::DiscretisationError { ends, spacing, .. } = &mut warning else { return Some(warning) };
        let (reach, widest) = that_would_do(&self.problem.point);
        *ends = (cost.truncation.abs() > 0.3 * TOLERATED).then(|| {
            let (x, y) = (self.x[self.first()], self.y[0]);
            let wanted = reach.max(-x * (cost.truncation.abs() / 0.01).sqrt()).ceil();
            NearEnds { x, y: (self.y.len() > 1).then_some(y), wanted }
        });
        *spacing = (cost.resolution.abs() > 0.3 * TOLERATED).then(|| {
            let behind = self.x.partition_point(|&x| x < -1.0).clamp(1, self.x.len() - 1);
            let spacing = self.x[behind] - self.x[behind - 1];
            WideSpacing { spacing, wanted: widest.min(spacing * (0.01 / cost.resolution.abs()).sqrt()) }
        });
        Some(warning)
    }
}

impl<S: NewtonSpace> Solver<S> {
    /// Returns the discretisation error of the central film thickness of a converged solution on this grid.
    pub fn grid_cost(&mut self, solution: &Solution) -> GridCost {
        let Ok(mut system) = self.system_for(&solution.problem) else {
            return GridCost { truncation: f64::NAN, resolution: f64::NAN };
        };
        system.set_pressure(&solution.problem, &solution.pressure);
        system.set_h_0(solution.scalars.h_0);
        system.fraction.clone_from(&solution.fraction);
        system.warm = solution.heat.as_ref().map(|heat| heat.film(&solution.x));
        let cost = system.grid_cost(&solution.problem, &self.options);
        system.warm = None;
        self.system = Some(system);
        cost
    }
}

impl<S: NewtonSpace> System<S> {
    /// Returns the discretisation error of the central film thickness of the current steady state.
    pub(in crate::solver::full) fn grid_cost(
        &mut self,
        problem: &Problem,
        options: &super::SolveOptions<S::Control>,
    ) -> GridCost {
        self.nodes.forget();
        self.begin_rupture(problem);
        self.evaluate(problem, options.penalty);
        let missing = self.missing_pressure(problem);
        let load = self.missing_load(&missing);
        for k in 0..self.rows.len() {
            let (stencil, _) = self.space.row(k);
            let row = &mut self.rows[k];
            row.value = [WEST, EAST, SOUTH, NORTH].iter().map(|&at| row.d_p[at] * missing[stencil[at]]).sum();
        }
        let [expected_truncation, expected_resolution] = self.space.mesh().spec.expected_errors(&problem.point);
        let truncation = self.central_response(problem, options, -load).unwrap_or(expected_truncation);
        let ruptured = self.active.nodes(self.space.grid());
        for k in 0..self.rows.len() {
            let coarse = self.space.wide_row(k).filter(|(stencil, _)| {
                // The equations are not differentiable in the cavitated region, so these are excluded.
                stencil.iter().all(|&node| self.nodes[node].pressure >= 0.0 && !ruptured[node])
            });
            self.rows[k].value = coarse
                .map_or(0.0, |(stencil, geometry)| -self.nodes.row(&geometry, options.penalty, stencil).value / 3.0);
        }
        let resolution = self.central_response(problem, options, 0.0).unwrap_or(expected_resolution);
        GridCost { truncation, resolution }
    }

    /// Returns the relative response of H_c to the values of the equations and to an additional load on the nodes.
    /// `None` if the linear solver does not converge, as on the finest grids of point contacts.
    fn central_response(
        &mut self,
        problem: &Problem,
        options: &super::SolveOptions<S::Control>,
        load: f64,
    ) -> Option<f64> {
        let options = super::SolveOptions { max_krylov: LINEAR.1, ..*options };
        let solved = self.solve_linear(&options, LINEAR.0, load, &());
        if solved.relative_residual > UNSOLVED {
            return None;
        }
        let shift = self.update[self.rows.len()];
        self.spread_update();
        let grid = self.space.grid();
        let film = grid.central(&self.film);
        // The film thickness between rough surfaces may vanish.
        let scale = problem.rough.map_or(film, |rough| film.abs().max(0.5 * rough.sigma));
        Some((grid.central(&self.step_deformation) + shift) / scale)
    }

    /// Returns the pressure of an endless film at the ends of the domain, node array. It is zero inside the domain
    /// and behind the contact.
    fn missing_pressure(&self, problem: &Problem) -> Vec<f64> {
        let (x, y) = self.space.grid().abscissae();
        let weights = self.space.grid().weights();
        let share = FilmShape::of(&problem.point).far_field_factor();
        let continues = self.space.grid().continues();
        let at = |node: usize| {
            let (x, film) = (x[node / y.len()], self.film[node]);
            // It is also zero where the surfaces carry less than fills the gap.
            if weights[node] > 0.0 || x >= 0.0 || continues || problem.supply.is_some_and(|supply| supply < film) {
                return 0.0;
            }
            -x / (share * problem.inverse_lambda * film * film)
        };
        (0..weights.len()).map(at).collect()
    }

    /// Returns the load of such a pressure beyond the domain, for both halves of a point contact. The pressure falls
    /// with the third power of the distance, so its integral is that of P x·n over the ends; in one dimension half of
    /// that.
    fn missing_load(&self, missing: &[f64]) -> f64 {
        let (x, y) = self.space.grid().abscissae();
        if S::KIND.is_line() {
            return -0.5 * missing[INLET] * x[INLET];
        }
        let along_end = |nodes: &[f64], at: &dyn Fn(usize) -> f64| -> f64 {
            (1..nodes.len()).map(|k| 0.5 * (at(k) + at(k - 1)) * (nodes[k] - nodes[k - 1])).sum()
        };
        let inlet = along_end(y, &|j| missing[j]);
        let edge = along_end(x, &|i| missing[i * y.len()]);
        -2.0 * (inlet * x[0] + edge * y[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
    use crate::solver::full::{ContactSolver, Start};
    use crate::solver::physics::contact::{ContactKind, MoesRequest, si_from_moes};
    use crate::solver::physics::lubricant::Lubricant;

    fn judged(spec: GridSpec, m: f64, l: f64) -> Solution {
        let point = si_from_moes(&MoesRequest::new(spec.kind(), m, l)).unwrap();
        let mut solver = ContactSolver::on(&spec.build().unwrap());
        let solution = solver.solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        assert!(solution.converged(), "M {m}, L {l}: {:?}", solution.report);
        solver.judged(solution)
    }

    fn uniform(dx: f64) -> GridSpec {
        GridSpec::Uniform { dx, domain: (-4.0, 2.0) }
    }

    /// Contacts on domains that end too early or with spacings that are too wide, the film of an endless domain, and
    /// what the sentence speaks of.
    #[test]
    fn large_grid_errors_are_warned_of() {
        for (m, l, dx, truth, word) in [
            (0.06, 5.0, 0.02, 261.0, "inlet"),
            (0.25, 5.86, 0.005, 16.7, "inlet"),
            (0.5, 10.0, 0.005, 5.4, "inlet"),
            (40.0, 10.0, 0.1, 0.0371, "spacing"),
        ] {
            let poor = judged(uniform(dx), m, l);
            assert!((poor.scalars.h_c / truth - 1.0).abs() > 0.05);
            let warning = poor.grid_warning().unwrap().to_string();
            assert!(warning.starts_with("H_c is off by about") && warning.contains(word), "{warning}");
            let own =
                GridSpec::explorer_for(&si_from_moes(&MoesRequest::new(ContactKind::Line, m, l)).unwrap()).unwrap();
            let good = judged(own, m, l);
            assert_eq!(good.grid_warning(), None, "M {m}, L {l}");
            assert!((good.scalars.h_c / truth - 1.0).abs() < 0.03, "M {m}, L {l}: {}", good.scalars.h_c);
        }
    }

    #[test]
    fn what_a_grid_costs_is_told_before_a_better_one_shows_it() {
        for (spec, m, l, most) in
            [(uniform(0.005), 200.0, 10.0, 0.1), (uniform(0.02), 40.0, 10.0, 0.2), (uniform(0.005), 2.0, 5.0, 0.2)]
        {
            let told = judged(spec, m, l);
            let better = judged(GridSpec::EXPLORER, m, l);
            let (cost, shown) = (told.grid_cost.unwrap().total(), better.scalars.h_c / told.scalars.h_c - 1.0);
            assert!((cost / shown - 1.0).abs() < most, "M {m}, L {l}: {cost} told, {shown} shown");
        }
        assert!(judged(uniform(0.005), 40.0, 10.0).grid_cost.unwrap().total() < 5e-3);
    }

    #[test]
    fn small_domains_and_coarse_grids_of_points_are_warned_of() {
        let quick = PointGridSpec::uniform(0.08, 0.2, (-4.0, 2.0, -2.0));
        for (m, l, word) in [(1.1, 11.2, "ends of the domain"), (200.0, 10.0, "spacing")] {
            let warning = judged(GridSpec::Plane(quick), m, l).grid_warning().unwrap().to_string();
            assert!(warning.contains(word), "M {m}, L {l}: {warning}");
        }
        let usual = judged(GridSpec::Plane(PointGridSpec { dx: 0.03, ..PointGridSpec::QUICK }), 50.0, 5.0);
        assert_eq!(usual.grid_warning(), None);
    }
}
