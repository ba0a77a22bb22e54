//! Newton's method for the stationary line contact on any grid: rows, Jacobian products, damping, stopping.

mod preconditioner;

use super::gmres::{Gmres, LinearOutcome};
use super::shear::ShearState;
use super::solution::{Problem, Report, Termination};
use crate::solver::discrete::elasticity::Scratch;
use crate::solver::discrete::grid::{FIRST_UNKNOWN, LineGrid, dot};
use crate::solver::discrete::reynolds::generalized::FilmTreatment;
use crate::solver::discrete::reynolds::line::{LINE_STENCIL, Upstream};
use crate::solver::discrete::reynolds::{CENTER, Node, PENALTY, RowGeometry};
use crate::solver::observer::{NewtonStep, Observer};
use preconditioner::Preconditioner;

/// Settings of a full solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolveOptions {
    /// Stop on ‖Δz‖/‖z‖ below this, z = (P, H₀).
    pub tolerance: f64,
    /// Newton steps per attempt.
    pub max_newton: usize,
    /// Krylov iterations per Newton step.
    pub max_krylov: usize,
    /// Half-bandwidth of the kernel kept in the preconditioner.
    pub kernel_band: usize,
    /// Whether that kernel is shifted so that it ends at zero. Where the film stores, five times fewer Krylov iterations; the first Newton
    /// steps of a cold stationary solve do better without.
    pub levelled_kernel: bool,
    /// Penalty factor γ̄ of (2.36).
    pub penalty: f64,
    /// Backtracking on the residual ends at this fraction of the step; 1 takes Newton's own steps, which is right beside a solution:
    /// there the penalty makes the residual jump though the step is good.
    pub shortest_step: f64,
    /// How the film integrals of a shear-thinning lubricant are taken.
    pub film: FilmTreatment,
}

impl Default for SolveOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            max_newton: 80,
            max_krylov: 80,
            kernel_band: 6,
            levelled_kernel: false,
            penalty: PENALTY,
            shortest_step: 1.0 / 64.0,
            film: FilmTreatment::default(),
        }
    }
}

/// The discrete system of one problem on one grid, with its state and all work space.
pub struct LineSystem {
    /// The grid.
    pub grid: LineGrid,
    /// P, node array.
    pub pressure: Vec<f64>,
    /// H, node array.
    pub film: Vec<f64>,
    /// H₀.
    pub h_0: f64,
    /// 1/R̄ of (2.24); 1 where the radius does not vary.
    pub(super) curvature: f64,
    /// Coefficients of the rows, those of the grid where nothing changes in time.
    pub(super) rows: Vec<RowGeometry>,
    /// The side each row's flow comes from.
    pub(super) upstream: Vec<Upstream>,
    deformation: Vec<f64>,
    nodes: Vec<Node>,
    /// What shear-thinning adds; absent for a Newtonian problem.
    shear: Option<ShearState>,
    treatment: FilmTreatment,
    /// f_p at the unknowns.
    pub residual: Vec<f64>,
    /// ∂f/∂P and ∂f/∂H per row.
    pub d_p: Vec<[f64; LINE_STENCIL]>,
    /// ∂f/∂H per row.
    pub d_h: Vec<[f64; LINE_STENCIL]>,
    scaling: Vec<f64>,
    step: Vec<f64>,
    step_deformation: Vec<f64>,
    preconditioner: Preconditioner,
    krylov: Gmres,
    fft: Scratch,
    field: Vec<f64>,
    rhs: Vec<f64>,
    update: Vec<f64>,
}

impl LineSystem {
    /// A system on a grid, with all work space; the state is zero until it is set.
    pub fn new(grid: LineGrid) -> Self {
        let (n, u) = (grid.len(), grid.unknowns());
        Self {
            pressure: vec![0.0; n],
            film: vec![0.0; n],
            h_0: 0.0,
            curvature: 1.0,
            rows: grid.rows.clone(),
            upstream: vec![Upstream::Inlet; u],
            deformation: vec![0.0; n],
            nodes: vec![Node::default(); n],
            shear: None,
            treatment: FilmTreatment::default(),
            residual: vec![0.0; u],
            d_p: vec![[0.0; LINE_STENCIL]; u],
            d_h: vec![[0.0; LINE_STENCIL]; u],
            scaling: vec![1.0; u],
            step: vec![0.0; n],
            step_deformation: vec![0.0; n],
            preconditioner: Preconditioner::default(),
            krylov: Gmres::default(),
            fft: Scratch::default(),
            field: vec![0.0; n],
            rhs: vec![0.0; u + 1],
            update: vec![0.0; u + 1],
            grid,
        }
    }

    /// Sets the pressure (node array), scaled to carry the load exactly, and recomputes the deformation.
    pub fn set_pressure(&mut self, problem: &Problem, pressure: &[f64]) {
        let n = self.grid.len();
        self.pressure.copy_from_slice(pressure);
        for i in [0, 1, n - 1] {
            self.pressure[i] = 0.0;
        }
        let carried = dot(&self.grid.weights, &self.pressure);
        let factor = problem.load / carried;
        if factor.is_finite() && factor > 0.0 {
            self.pressure.iter_mut().for_each(|p| *p *= factor);
        }
        self.grid.deform(&self.pressure, &mut self.deformation, &mut self.fft);
    }

    /// Sets H₀ and the film.
    pub fn set_h_0(&mut self, h_0: f64) {
        self.h_0 = h_0;
        for ((h, x), d) in self.film.iter_mut().zip(&self.grid.x).zip(&self.deformation) {
            *h = h_0 + 0.5 * self.curvature * x * x + d;
        }
    }

    /// Sets H₀ so that the film at X = 0 is `film`.
    pub fn set_central_film(&mut self, film: f64) {
        self.set_h_0(0.0);
        let at_zero = self.grid.at(&self.film, 0.0);
        self.set_h_0(film - at_zero);
    }

    /// Evaluates all rows at the current state: residual and, with `derivatives`, the Jacobian bands. Returns the residual norm.
    pub fn evaluate(&mut self, problem: &Problem, penalty: f64, derivatives: bool) -> f64 {
        match &problem.shear {
            None => {
                self.shear = None;
                for ((node, &p), &h) in self.nodes.iter_mut().zip(&self.pressure).zip(&self.film) {
                    *node = Node::new(&problem.fluid, problem.inverse_lambda, p, h);
                }
            }
            Some(law) => {
                let shear = self.shear.get_or_insert_with(|| ShearState::new(&self.grid));
                let fields = (self.pressure.as_slice(), self.film.as_slice());
                shear.evaluate(problem, law, fields, self.treatment, &mut self.nodes);
            }
        }
        let mut sum = 0.0;
        for (k, (geometry, upstream)) in self.rows.iter().zip(&self.upstream).enumerate() {
            let r = upstream.row(geometry, penalty, &self.nodes, k);
            self.residual[k] = r.value;
            sum += self.grid.weights[k + FIRST_UNKNOWN] * r.value * r.value;
            if derivatives {
                (self.d_p[k], self.d_h[k]) = (r.d_p, r.d_h);
            }
        }
        if let Some(shear) = self.shear.as_mut().filter(|_| derivatives) {
            shear.differentiate(&self.grid);
        }
        sum.sqrt()
    }

    /// ρ̄H of the state evaluated last, node array.
    pub(super) fn flow(&self) -> impl Iterator<Item = f64> + '_ {
        self.nodes.iter().map(|node| node.flow)
    }

    /// Newton's method from the current state.
    pub fn newton(&mut self, problem: &Problem, options: &SolveOptions, observer: &dyn Observer, report: &mut Report) {
        self.treatment = options.film;
        if let Some(shear) = &mut self.shear {
            shear.forget();
        }
        let mut residual = self.evaluate(problem, options.penalty, true);
        let mut previous = f64::NAN;
        report.termination = Termination::IterationLimit;
        let mut forcing: f64 = 0.05;
        for _ in 0..options.max_newton {
            if observer.cancelled() {
                report.termination = Termination::Cancelled;
                break;
            }
            report.residuals.push(residual);
            if previous.is_finite() {
                // Eisenstat & Walker's second choice: no more linear accuracy than the nonlinear problem can use.
                forcing = (0.9 * (residual / previous).powi(2)).clamp(1e-5, 0.05);
            }
            previous = residual;
            let linear = self.solve_linear(options, forcing);
            report.linear_iterations += linear.iterations;
            let solved = linear.relative_residual < 0.5;
            report.newton_iterations += 1;
            let (taken, accepted) = self.damped_step(problem, options, residual);
            residual = accepted;
            report.steps.push(taken);
            observer.newton_step(&NewtonStep { iteration: report.newton_iterations, residual: previous, step: taken });
            if !(residual.is_finite() && taken.is_finite()) || residual > 1e12 {
                report.termination = Termination::Diverged;
                break;
            }
            if taken < options.tolerance && solved {
                let separated = self.film.iter().all(|&h| h > 0.0);
                report.termination = if separated { Termination::Converged } else { Termination::Diverged };
                break;
            }
        }
        report.residual_norm = residual;
    }

    /// Takes the Newton step with backtracking on the residual (to `shortest_step`, then accepts); the film may lose 90 % per step at most.
    /// Returns ‖Δz‖/‖z‖ of the undamped step, so that damping never looks like convergence, and the new residual.
    fn damped_step(&mut self, problem: &Problem, options: &SolveOptions, before: f64) -> (f64, f64) {
        let u = self.grid.unknowns();
        let dh_0 = self.update[u];
        self.step[FIRST_UNKNOWN..FIRST_UNKNOWN + u].copy_from_slice(&self.update[..u]);
        self.grid.deform(&self.step, &mut self.step_deformation, &mut self.fft);
        let mut longest: f64 = 1.0;
        for (h, d) in self.film.iter().zip(&self.step_deformation) {
            let change = d + dh_0;
            if *h > 0.0 && change < -0.9 * h {
                longest = longest.min(-0.9 * h / change);
            }
        }
        let size = (dot(&self.step, &self.step) + dh_0 * dh_0).sqrt();
        let (start_h_0, mut factor, mut taken) = (self.h_0, longest, 0.0);
        let mut residual;
        loop {
            let delta = factor - taken;
            for (p, s) in self.pressure.iter_mut().zip(&self.step) {
                *p += delta * s;
            }
            for (d, s) in self.deformation.iter_mut().zip(&self.step_deformation) {
                *d += delta * s;
            }
            taken = factor;
            self.set_h_0(start_h_0 + factor * dh_0);
            residual = self.evaluate(problem, options.penalty, true);
            let norm = (dot(&self.pressure, &self.pressure) + self.h_0 * self.h_0).sqrt();
            let relative = factor * size / norm;
            if residual < before * (1.0 - 1e-4 * factor) || factor <= longest * options.shortest_step || relative < 1e-7
            {
                // A full, fresh deformation now and then would change nothing: the increments are exact to rounding.
                return (size / norm, residual);
            }
            factor *= 0.5;
        }
    }

    /// Takes a step whose entry i (the last is ΔH₀) is `update(i)`, damped as Newton's; returns ‖Δz‖/‖z‖ (undamped) and the new residual.
    pub fn take_step(
        &mut self,
        problem: &Problem,
        options: &SolveOptions,
        before: f64,
        update: impl Fn(usize) -> f64,
    ) -> (f64, f64) {
        for (i, u) in self.update.iter_mut().enumerate() {
            *u = update(i);
        }
        self.damped_step(problem, options, before)
    }

    /// Solves the linearised system for `update` = (ΔP, ΔH₀). Returns how the linear solver ended.
    fn solve_linear(&mut self, options: &SolveOptions, tolerance: f64) -> LinearOutcome {
        let u = self.grid.unknowns();
        let diagonal = self.grid.kernel_entry(self.grid.len() / 2, self.grid.len() / 2);
        for (k, s) in self.scaling.iter_mut().enumerate() {
            let own = k + CENTER - self.upstream[k].first_node(k);
            *s = 1.0 / (self.d_p[k][own].abs() + self.d_h[k][own].abs() * diagonal);
        }
        let shear = self.shear.as_ref();
        let jacobian = (self.upstream.as_slice(), self.d_p.as_slice(), self.d_h.as_slice());
        self.preconditioner.build(
            &self.grid,
            (options.kernel_band, options.levelled_kernel),
            jacobian,
            shear,
            &self.scaling,
        );
        for ((r, f), s) in self.rhs.iter_mut().zip(&self.residual).zip(&self.scaling) {
            *r = -f * s;
        }
        // The load holds exactly from the start and every step keeps it, because the preconditioner's load row is exact.
        self.rhs[u] = 0.0;
        let Self {
            krylov,
            grid,
            fft,
            field,
            step_deformation,
            upstream,
            d_p,
            d_h,
            scaling,
            preconditioner,
            rhs,
            update,
            shear,
            ..
        } = self;
        krylov.solve(
            rhs,
            update,
            tolerance,
            options.max_krylov,
            |v, out| {
                field[FIRST_UNKNOWN..FIRST_UNKNOWN + u].copy_from_slice(&v[..u]);
                grid.deform(field, step_deformation, fft);
                for (k, out) in out[..u].iter_mut().enumerate() {
                    let (a, b, first) = (&d_p[k], &d_h[k], upstream[k].first_node(k));
                    let mut sum = 0.0;
                    for m in 0..LINE_STENCIL {
                        sum += a[m] * field[first + m] + b[m] * (step_deformation[first + m] + v[u]);
                    }
                    *out = sum * scaling[k];
                }
                if let Some(shear) = shear {
                    for (k, out) in out[..u].iter_mut().enumerate() {
                        *out += shear.product(k, field) * scaling[k];
                    }
                }
                out[u] = dot(&grid.weights, field);
            },
            |v| preconditioner.apply(grid, v),
        )
    }
}
