//! Newton's method of the full solver for line contacts. Steps are damped by backtracking on the residual. Linear
//! solves are only as accurate as the nonlinear convergence requires.

mod preconditioner;

use super::mesh::Mesh;
use super::newton_space::{NewtonSpace, ScaledRows, StepControl, Taken, Turn};
use super::problem::{Problem, SolveError};
use super::system::{SolveOptions, System};
use crate::solver::discrete::grid::{GridSpec, INLET, ReferenceGrid, dot};
use crate::solver::discrete::reynolds::PENALTY;
use crate::solver::discrete::reynolds::generalized::FilmTreatment;
use crate::solver::discrete::space::LineSpace;
use crate::solver::physics::contact::ContactKind;
pub use preconditioner::BandMatrix;
use std::sync::Arc;

/// Step control of line contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Backtracking {
    /// Half-bandwidth of the elastic kernel in the preconditioner \[nodes\].
    pub kernel_band: usize,
    /// Shifts this truncated kernel so that it ends at zero. In transient contacts this saves most Krylov iterations.
    /// The first Newton steps of a steady solve without a starting solution converge better without it.
    pub levelled_kernel: bool,
    /// Shortest share of a step in backtracking on the residual. With 1 there is no backtracking. This is appropriate
    /// near a solution, where the penalty makes the residual jump although the step is good.
    pub shortest_step: f64,
    /// Evaluates the residual after a step. Only a control without backtracking can omit this.
    pub looks_back: bool,
    /// Largest change of P in one step.
    pub largest_step: f64,
    /// Largest reduction of the film thickness H in one step, relative to H.
    pub film_loss: f64,
    /// Finest and coarsest accuracy of a linear solve, relative to its right-hand side.
    pub forcing: (f64, f64),
}

impl Default for Backtracking {
    fn default() -> Self {
        Self {
            kernel_band: 6,
            levelled_kernel: false,
            shortest_step: 1.0 / 64.0,
            looks_back: true,
            largest_step: f64::INFINITY,
            film_loss: 0.9,
            forcing: (1e-5, 0.05),
        }
    }
}

impl StepControl for Backtracking {
    fn options() -> SolveOptions<Self> {
        SolveOptions {
            tolerance: 1e-10,
            max_newton: 80,
            max_krylov: 80,
            penalty: PENALTY,
            film: FilmTreatment::default(),
            control: Self::default(),
        }
    }
}

/// Largest change of P in one step if a cavitated set, and not the penalty, prevents negative pressures.
const LARGEST_STEP: f64 = 0.6;

/// Memory of the step control: the residual before the previous step, NaN before the first one.
pub struct Residuals {
    previous: f64,
}

impl Default for Residuals {
    fn default() -> Self {
        Self { previous: f64::NAN }
    }
}

impl NewtonSpace for LineSpace {
    type Control = Backtracking;
    type Memory = Residuals;
    type Matrix = BandMatrix;
    type Spec = GridSpec;
    type Reference = Arc<ReferenceGrid>;
    type Form = f64;

    const KIND: ContactKind = ContactKind::Line;
    const WORST_RESIDUAL: f64 = 1e12;
    const CLIPS: bool = false;
    // In units of the film thickness by Moes' formula.
    const COLD_FILMS: [f64; 3] = [2.0, 1.2, 4.0];
    const FIRST_COLUMN: usize = INLET;
    const EASY_M: (f64, f64) = (15.0, 60.0);
    const EASY_L: f64 = 8.0;
    const COLD_M: (f64, f64) = (f64::INFINITY, f64::INFINITY);

    fn build(spec: GridSpec) -> Result<Arc<ReferenceGrid>, SolveError> {
        Ok(spec.line()?)
    }

    fn unknowns(reference: &Arc<ReferenceGrid>) -> usize {
        reference.xi.len() - 3
    }

    fn form_of(reference: &Arc<ReferenceGrid>, problem: &Problem) -> f64 {
        reference.scale(problem.moes)
    }

    fn on(reference: &Arc<ReferenceGrid>, scale: f64) -> Result<Self, SolveError> {
        Ok(Self::new(reference.scaled(scale)))
    }

    fn form(&self) -> f64 {
        self.grid.scale
    }

    fn mesh(&self) -> Mesh {
        Mesh::of_line(&self.grid)
    }

    fn forcing(control: &Backtracking, memory: &mut Residuals, residual: f64) -> f64 {
        let Backtracking { forcing: (finest, coarsest), .. } = *control;
        let Residuals { previous } = std::mem::replace(memory, Residuals { previous: residual });
        if !previous.is_finite() {
            return coarsest;
        }
        // Eisenstat and Walker's second choice: no more linear accuracy than the nonlinear convergence requires.
        (0.9 * (residual / previous).powi(2)).clamp(finest, coarsest)
    }

    fn step(
        system: &mut System<Self>,
        problem: &Problem,
        options: &SolveOptions<Backtracking>,
        _: &mut Residuals,
        before: f64,
    ) -> Taken {
        let (size, residual) = system.backtrack(problem, options, before);
        Taken { size, shift: 0.0, residual }
    }

    fn beside_heat(control: Backtracking, turn: Turn) -> Backtracking {
        let Turn { largest_step, film_loss, shortest_step, looks_back, last } = turn;
        let forcing = if last { 1e-9 } else { 1e-3 };
        Backtracking { shortest_step, largest_step, film_loss, looks_back, forcing: (forcing, forcing), ..control }
    }

    fn assemble(
        &self,
        matrix: &mut BandMatrix,
        control: &Backtracking,
        rows: &ScaledRows<'_>,
        _: impl Fn() -> bool,
    ) -> bool {
        matrix.build(self, control, rows);
        true
    }
}

impl System<LineSpace> {
    /// Takes the Newton step with backtracking on the residual. The shortest step is accepted in any case. The film
    /// thickness falls at most by the share `film_loss`. Returns ‖Δz‖/‖z‖ of the undamped step and the new residual.
    /// z contains the pressures P and the rigid-body separation H₀; Δz also contains the changes of film fractions.
    fn backtrack(&mut self, problem: &Problem, options: &SolveOptions<Backtracking>, before: f64) -> (f64, f64) {
        let dh_0 = self.update[self.rows.len()];
        self.spread_update();
        let Backtracking { largest_step, film_loss, .. } = options.control;
        let rough = self.longest_rough_step(problem, dh_0);
        let mut longest = rough.unwrap_or(1.0);
        for (h, d) in self.film.iter().zip(&self.step_deformation) {
            let change = d + dh_0;
            if rough.is_none() && *h > 0.0 && change < -film_loss * h {
                longest = longest.min(-film_loss * h / change);
            }
        }
        let largest_step = if self.active.holds() { largest_step.min(LARGEST_STEP) } else { largest_step };
        if largest_step.is_finite() {
            let largest = self.step.iter().fold(0.0f64, |largest, s| largest.max(s.abs()));
            longest = longest.min(largest_step / largest);
        }
        let fractions = self.active.square_of_fractions(&self.update);
        let size = (dot(&self.step, &self.step) + fractions + dh_0 * dh_0).sqrt();
        let (start_h_0, mut factor, mut taken) = (self.h_0, longest, 0.0);
        // A step is also accepted if the residual without the equations of the film fractions falls. These equations
        // are nearly linear, so the next full step removes their error.
        let of_film = self.of_film(before);
        let shortest = longest * options.control.shortest_step;
        loop {
            let delta = factor - taken;
            for (p, s) in self.pressure.iter_mut().zip(&self.step) {
                *p += delta * s;
            }
            for (d, s) in self.deformation.iter_mut().zip(&self.step_deformation) {
                *d += delta * s;
            }
            self.active.add_fractions(delta, &self.update);
            taken = factor;
            self.set_h_0(start_h_0 + factor * dh_0);
            let residual = if options.control.looks_back { self.evaluate(problem, options.penalty) } else { before };
            let norm = (dot(&self.pressure, &self.pressure) + self.h_0 * self.h_0).sqrt();
            let relative = factor * size / norm;
            let share = 1.0 - 1e-4 * factor;
            let better = residual < before * share || self.of_film(residual) < of_film * share;
            if better || factor <= shortest || relative < 1e-7 {
                // The deformation is not computed again, because its increments are exact to rounding.
                return (size / norm, residual);
            }
            factor *= 0.5;
        }
    }

    /// Returns a residual norm without the share of the equations of the film fractions.
    fn of_film(&self, residual: f64) -> f64 {
        (residual * residual - self.of_fractions * self.of_fractions).max(0.0).sqrt()
    }

    /// Takes a given step, damped like a Newton step. `update(i)` is the change of unknown i; the last one is ΔH₀.
    /// Returns ‖Δz‖/‖z‖ of the undamped step and the new residual.
    pub fn take_step(
        &mut self,
        problem: &Problem,
        options: &SolveOptions<Backtracking>,
        before: f64,
        update: impl Fn(usize) -> f64,
    ) -> (f64, f64) {
        for (i, u) in self.update.iter_mut().enumerate() {
            *u = update(i);
        }
        self.backtrack(problem, options, before)
    }
}
