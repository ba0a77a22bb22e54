//! Newton's method for the stationary point contact on its half domain: rows, Jacobian products, damping, stopping.
//!
//! Unknowns are (P, H₀), the deformation is condensed. The Jacobian A + B K is never assembled: A and B are six-point stencils, K is
//! a fast convolution. There is no line search on the residual: the penalty makes it jump at the cavitation front, and the steps would
//! collapse. Steps are limited by what pressure and film can bear instead.

mod accuracy;
mod block_tridiagonal;
mod preconditioner;
mod shear;
mod start;
#[cfg(test)]
mod tests;

pub use accuracy::{Accuracy, Estimate, resolution_warning, second_grid, side_lobe_curvature};
pub use start::PointSolver;

use super::gmres::{Gmres, LinearOutcome};
use super::solution::{Problem, Report, Termination};
use crate::solver::discrete::elasticity::PointScratch;
use crate::solver::discrete::grid::{PointGrid, dot};
use crate::solver::discrete::reynolds::generalized::FilmTreatment;
use crate::solver::discrete::reynolds::{CENTER, Node, PENALTY, STENCIL, row};
use crate::solver::observer::{NewtonStep, Observer};
use preconditioner::PointPreconditioner;
use rayon::prelude::*;
use shear::PointShear;
use std::sync::Arc;

/// Settings of a full solve of a point contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointOptions {
    /// Stop when max|ΔP| falls below this and |ΔH₀| below a tenth of it.
    pub tolerance: f64,
    /// Newton steps per attempt.
    pub max_newton: usize,
    /// Krylov iterations per Newton step.
    pub max_krylov: usize,
    /// Penalty factor γ̄ of (2.36).
    pub penalty: f64,
    /// Largest change of P in one step.
    pub largest_step: f64,
    /// Largest share of the film that one step may take away.
    pub film_loss: f64,
    /// Accuracy of the linear solves, relative to the right-hand side.
    pub forcing: f64,
    /// How the film integrals of a shear-thinning lubricant are taken.
    pub film: FilmTreatment,
}

impl Default for PointOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-6,
            max_newton: 60,
            max_krylov: 60,
            penalty: PENALTY,
            largest_step: 0.4,
            film_loss: 0.8,
            forcing: 1e-2,
            film: FilmTreatment::default(),
        }
    }
}

/// Steps smaller than this only move the cavitation front.
const LATE_STEP: f64 = 1e-2;
/// The share of a late step that is taken when the front cycles: nodes that all change sides at once, there and back, then do so in smaller
/// groups. The golden ratio spreads the shares over 0.035…0.7 and never repeats them: a repeating pattern can become part of a cycle.
fn cycle_breaker(cycles: usize) -> f64 {
    0.7 * 0.05f64.powf((cycles as f64 * 0.618_033_988_749_895).fract())
}

/// Pressures are cut off here after each step: lower ones are no state, only an overshoot of the penalty.
const LOWEST_PRESSURE: f64 = -1e-4;

/// The discrete system of one problem on one grid, with its state and all work space.
pub struct PointSystem {
    /// The grid.
    pub grid: Arc<PointGrid>,
    /// P, node array.
    pub pressure: Vec<f64>,
    /// H, node array.
    pub film: Vec<f64>,
    /// H₀.
    pub h_0: f64,
    deformation: Vec<f64>,
    parabola: Vec<f64>,
    nodes: Vec<Node>,
    /// What shear-thinning adds; absent for a Newtonian problem.
    shear: Option<PointShear>,
    treatment: FilmTreatment,
    /// f_p at the unknowns.
    pub residual: Vec<f64>,
    /// ∂f/∂P of each row at its six nodes.
    pub d_p: Vec<[f64; STENCIL]>,
    /// ∂f/∂H of each row at its six nodes.
    pub d_h: Vec<[f64; STENCIL]>,
    scaling: Vec<f64>,
    step: Vec<f64>,
    step_deformation: Vec<f64>,
    preconditioner: PointPreconditioner,
    krylov: Gmres,
    fft: PointScratch,
    rhs: Vec<f64>,
    update: Vec<f64>,
}

/// Rows handled by one task.
const SHARE: usize = 2048;

impl PointSystem {
    /// A system on a grid, with all work space; the state is zero until it is set.
    pub fn new(grid: Arc<PointGrid>) -> Self {
        let (n, u) = (grid.len(), grid.unknowns());
        Self {
            pressure: vec![0.0; n],
            film: vec![0.0; n],
            h_0: 0.0,
            deformation: vec![0.0; n],
            parabola: (0..n).map(|node| grid.parabola(node)).collect(),
            nodes: vec![Node::default(); n],
            shear: None,
            treatment: FilmTreatment::default(),
            residual: vec![0.0; u],
            d_p: vec![[0.0; STENCIL]; u],
            d_h: vec![[0.0; STENCIL]; u],
            scaling: vec![1.0; u],
            step: vec![0.0; n],
            step_deformation: vec![0.0; n],
            preconditioner: PointPreconditioner::default(),
            krylov: Gmres::default(),
            fft: PointScratch::default(),
            rhs: vec![0.0; u + 1],
            update: vec![0.0; u + 1],
            grid,
        }
    }

    /// Sets the pressure (node array), scaled to carry the load exactly, and recomputes the deformation.
    pub fn set_pressure(&mut self, problem: &Problem, pressure: &[f64]) {
        for ((p, &given), &weight) in self.pressure.iter_mut().zip(pressure).zip(&self.grid.weights) {
            *p = if weight > 0.0 { given } else { 0.0 };
        }
        let factor = problem.load / dot(&self.grid.weights, &self.pressure);
        if factor.is_finite() && factor > 0.0 {
            self.pressure.iter_mut().for_each(|p| *p *= factor);
        }
        self.grid.deform(&self.pressure, &mut self.deformation, &mut self.fft);
    }

    /// Sets H₀ and the film.
    pub fn set_h_0(&mut self, h_0: f64) {
        self.h_0 = h_0;
        for ((h, parabola), d) in self.film.iter_mut().zip(&self.parabola).zip(&self.deformation) {
            *h = h_0 + parabola + d;
        }
    }

    /// Sets H₀ so that the film at X = Y = 0 is `film`.
    pub fn set_central_film(&mut self, film: f64) {
        self.set_h_0(0.0);
        let at_zero = self.grid.on_axis(&self.film, 0.0);
        self.set_h_0(film - at_zero);
    }

    /// Evaluates all rows at the current state: residual and Jacobian stencils. Returns the residual norm.
    pub fn evaluate(&mut self, problem: &Problem, penalty: f64) -> f64 {
        match &problem.shear {
            None => {
                self.shear = None;
                let state = self.pressure.par_iter().zip(&self.film).with_min_len(SHARE);
                self.nodes.par_iter_mut().zip(state).for_each(|(node, (&p, &h))| {
                    *node = Node::new(&problem.fluid, problem.inverse_lambda, p, h);
                });
            }
            Some(law) => {
                let shear = self.shear.get_or_insert_with(|| PointShear::new(&self.grid));
                let fields = (self.pressure.as_slice(), self.film.as_slice());
                shear.evaluate(problem, law, fields, self.treatment, &mut self.nodes);
            }
        }
        let (grid, nodes) = (&*self.grid, &self.nodes);
        let derivatives = self.d_p.par_iter_mut().zip(&mut self.d_h);
        self.residual.par_iter_mut().zip(derivatives).enumerate().with_min_len(SHARE).for_each(
            |(k, (value, (d_p, d_h)))| {
                let (stencil, geometry) = grid.row(k);
                let r = row(&geometry, penalty, stencil.map(|node| &nodes[node]));
                (*value, *d_p, *d_h) = (r.value, r.d_p, r.d_h);
            },
        );
        if let Some(shear) = &mut self.shear {
            shear.differentiate(grid);
        }
        let square = |(k, f): (usize, &f64)| grid.weights[grid.node(k)] * f * f;
        self.residual.iter().enumerate().map(square).sum::<f64>().sqrt()
    }

    /// Newton's method from the current state.
    pub fn newton(&mut self, problem: &Problem, options: &PointOptions, observer: &dyn Observer, report: &mut Report) {
        self.treatment = options.film;
        if let Some(shear) = &mut self.shear {
            shear.forget();
        }
        let mut residual = self.evaluate(problem, options.penalty);
        let (mut recent, mut cycles) = ([f64::INFINITY; 2], 0);
        report.termination = Termination::IterationLimit;
        for _ in 0..options.max_newton {
            if observer.cancelled() {
                report.termination = Termination::Cancelled;
                break;
            }
            report.residuals.push(residual);
            let linear = self.solve_linear(problem, options, options.forcing, observer);
            report.linear_iterations += linear.iterations;
            if observer.cancelled() {
                report.termination = Termination::Cancelled;
                break;
            }
            report.newton_iterations += 1;
            let (step, shift) = self.damped_step(options, |step| {
                // A step as large as the one before the last, late: the front moves to and fro.
                if step > LATE_STEP || step < 0.9 * recent[0] {
                    return 1.0;
                }
                cycles += 1;
                cycle_breaker(cycles)
            });
            recent = [recent[1], step];
            let before = residual;
            residual = self.evaluate(problem, options.penalty);
            report.steps.push(step);
            observer.newton_step(&NewtonStep { iteration: report.newton_iterations, residual: before, step });
            if !(residual.is_finite() && step.is_finite() && shift.is_finite()) {
                report.termination = Termination::Diverged;
                break;
            }
            let solved = linear.relative_residual < 0.5;
            if step < options.tolerance && shift.abs() < 0.1 * options.tolerance && solved {
                let separated = self.film.iter().all(|&h| h > 0.0);
                report.termination = if separated { Termination::Converged } else { Termination::Diverged };
                break;
            }
        }
        report.residual_norm = residual;
    }

    /// Takes the Newton step as far as pressure and film can bear it, and as `share` of its max|ΔP| allows. Returns max|ΔP| and ΔH₀ of the
    /// undamped step, so that damping never looks like convergence.
    fn damped_step(&mut self, options: &PointOptions, share: impl FnOnce(f64) -> f64) -> (f64, f64) {
        let u = self.grid.unknowns();
        let dh_0 = self.update[u];
        scatter(&self.grid, &self.update, &mut self.step);
        let largest = self.step.iter().fold(0.0f64, |largest, s| if s.is_nan() { *s } else { largest.max(s.abs()) });
        self.grid.deform(&self.step, &mut self.step_deformation, &mut self.fft);
        let mut factor = (options.largest_step / largest).min(share(largest));
        for (h, d) in self.film.iter().zip(&self.step_deformation) {
            let change = d + dh_0;
            if change < -options.film_loss * h {
                factor = factor.min(-options.film_loss * h / change);
            }
        }
        let mut cut = false;
        for (p, s) in self.pressure.iter_mut().zip(&self.step) {
            *p += factor * s;
            if *p < LOWEST_PRESSURE {
                *p = LOWEST_PRESSURE;
                cut = true;
            }
        }
        if cut {
            self.grid.deform(&self.pressure, &mut self.deformation, &mut self.fft);
        } else {
            for (d, s) in self.deformation.iter_mut().zip(&self.step_deformation) {
                *d += factor * s;
            }
        }
        self.set_h_0(self.h_0 + factor * dh_0);
        (largest, dh_0)
    }

    /// Solves the linearised system for `update` = (ΔP, ΔH₀). Returns how the linear solver ended.
    fn solve_linear(
        &mut self,
        problem: &Problem,
        options: &PointOptions,
        tolerance: f64,
        observer: &dyn Observer,
    ) -> LinearOutcome {
        let u = self.grid.unknowns();
        let middle = self.grid.node(u / 2);
        let diagonal = self.grid.flexibility.entry(middle, middle);
        for ((s, a), b) in self.scaling.iter_mut().zip(&self.d_p).zip(&self.d_h) {
            *s = 1.0 / (a[CENTER].abs() + b[CENTER].abs() * diagonal);
        }
        if !self.preconditioner.build(&self.grid, &self.d_p, &self.d_h, &self.scaling, || !observer.cancelled()) {
            return LinearOutcome { iterations: 0, relative_residual: f64::NAN };
        }
        for ((r, f), s) in self.rhs.iter_mut().zip(&self.residual).zip(&self.scaling) {
            *r = -f * s;
        }
        self.rhs[u] = problem.load - dot(&self.grid.weights, &self.pressure);
        let Self {
            krylov,
            grid,
            fft,
            step,
            step_deformation,
            d_p,
            d_h,
            scaling,
            preconditioner,
            rhs,
            update,
            shear,
            ..
        } = self;
        let grid = &**grid;
        krylov.solve_watched(
            rhs,
            update,
            (tolerance, options.max_krylov),
            |v, out| {
                scatter(grid, v, step);
                grid.deform(step, step_deformation, fft);
                let (field, film, shift) = (&*step, &*step_deformation, v[u]);
                let m = grid.column_unknowns();
                out[..u].par_chunks_mut(m).enumerate().with_min_len(SHARE.div_ceil(m)).for_each(|(column, out)| {
                    let ny = m + 1;
                    let west2 = if column == 0 { ny } else { 2 * ny };
                    for (j, out) in out.iter_mut().enumerate() {
                        let (k, n) = (column * m + j, (column + 1) * ny + j + 1);
                        let (a, b) = (&d_p[k], &d_h[k]);
                        let mut sum = 0.0;
                        for (e, node) in [n - west2, n - ny, n, n + ny, n - 1, n + 1].into_iter().enumerate() {
                            sum += a[e] * field[node] + b[e] * (film[node] + shift);
                        }
                        *out = sum * scaling[k];
                    }
                });
                if let Some(shear) = shear {
                    shear.add_product(grid, field, scaling, &mut out[..u]);
                }
                out[u] = dot(&grid.weights, field);
            },
            |v| preconditioner.apply(v),
            |iterations| {
                observer.krylov_iteration(iterations);
                !observer.cancelled()
            },
        )
    }
}

/// Writes the unknowns into a node array; the boundary stays zero.
fn scatter(grid: &PointGrid, unknowns: &[f64], nodes: &mut [f64]) {
    let (m, ny) = (grid.column_unknowns(), grid.ny());
    let columns = unknowns[..grid.unknowns()].chunks_exact(m);
    for (column, values) in nodes.chunks_exact_mut(ny).skip(1).zip(columns) {
        column[1..].copy_from_slice(values);
    }
}
