//! March of the full system: every step is a Newton solve from the extrapolation of the two previous ones.

use super::frame::{Conditions, Frame, point_at};
use super::history::History;
use super::march::{Marching, Step, Transient, TransientError, TransientObserver, march};
use super::pace::ROUNDING;
use super::surface::{MovingSurface, Scheme};
use super::trajectory::{Effort, Moment, State, Trajectory};
use crate::solver::discrete::grid::{FIRST_UNKNOWN, GridSpec, LineGrid, ReferenceGrid};
use crate::solver::discrete::reynolds::line::Upstream;
use crate::solver::discrete::space::LineSpace;
use crate::solver::full::response::widest_spacing;
use crate::solver::full::solver::interpolated;
use crate::solver::full::{
    Backtracking, FullSolver, Problem, Report, SolveError, SolveOptions, Start, System, Termination,
};
use crate::solver::observer::Observer;
use crate::solver::physics::lubricant::Cavitation;
use std::sync::Arc;

/// Full system prepared for a march.
pub struct FullMarch {
    pub(super) system: System<LineSpace>,
    /// Solver of the steady start, which needs other settings than a step.
    solver: FullSolver,
    reference: Problem,
    frame: Frame,
    surfaces: Vec<MovingSurface>,
    /// Spacing ΔX if the scheme follows the characteristics.
    characteristic: Option<f64>,
    history: History,
    start: Vec<f64>,
    /// Fill fraction θ of the nearer previous state; empty if cavitation does not conserve mass.
    fraction: Vec<f64>,
}

/// Number of steps in which features are raised where a steady solve with their full height fails.
const RAISES: usize = 8;
/// Stopping tolerance of a step's Newton iteration for ‖Δz‖/‖z‖, with the unknowns z. Convergence is quadratic, so
/// the remaining error is far smaller.
const STEP_TOLERANCE: f64 = 1e-6;
/// Stopping tolerance for cavitation by active sets, with the bounds of the tolerance of its linear solves. A step ends
/// when the set is steady, so that accuracy costs only Krylov iterations, and mass is conserved to 1e-9 of the flow.
const HELD_TOLERANCE: f64 = 1e-8;
const HELD_FORCING: (f64, f64) = (1e-12, 1e-5);

/// Simulates a contact in time with the full system on a grid.
///
/// # Errors
/// [`TransientError`] if the contact, the grid, the inputs, the times or the lubricant are refused.
pub fn solve(
    spec: GridSpec,
    transient: &Transient,
    observer: &dyn TransientObserver,
) -> Result<Trajectory, TransientError> {
    let reference = spec.line().map_err(SolveError::from)?;
    march(&mut FullMarch::new(reference, transient)?, transient, observer)
}

impl FullMarch {
    /// Creates the system on a reference grid for one contact and frame.
    ///
    /// # Errors
    /// [`TransientError`] if the contact, the inputs, the times or the lubricant are refused.
    pub fn new(reference: Arc<ReferenceGrid>, transient: &Transient) -> Result<Self, TransientError> {
        let problem = transient.problem()?;
        let grid = reference.for_contact(problem.moes);
        let length = grid.len();
        transient.check_on(&grid.x)?;
        let characteristic = (transient.scheme == Scheme::Characteristic).then(|| widest_spacing(&grid.x));
        Ok(Self {
            system: System::new(LineSpace::new(grid)),
            solver: FullSolver::on(reference),
            reference: problem,
            frame: transient.frame,
            surfaces: transient.surfaces.clone(),
            characteristic,
            history: History::default(),
            start: vec![0.0; length],
            fraction: Vec::new(),
        })
    }

    /// Sets the coefficients of the rows for a step.
    fn set_rows(&mut self, step: &Step) {
        let LineSpace { grid, rows, upstream, .. } = &mut self.system.space;
        self.history.carry(self.frame, step, &grid.x, &grid.x);
        // A step that had to be divided does not meet the nodes of the characteristics.
        if self.characteristic.is_some_and(|spacing| (step.length / spacing - 1.0).abs() < ROUNDING && (step.ratio - 1.0).abs() < ROUNDING) {
            let weight = 1.0 / step.length;
            for (k, (row, geometry)) in rows.iter_mut().zip(&grid.rows).enumerate() {
                let node = k + FIRST_UNKNOWN;
                let former = 0.5 * self.history.flow(1, node - 2) - 2.0 * self.history.flow(0, node - 1);
                *row = geometry.in_time(0.0, 1.5 * weight, weight * former);
            }
            return;
        }
        let (unknowns, weights) = (grid.unknowns(), step.history_weights());
        for (k, (row, upstream)) in rows.iter_mut().zip(upstream).enumerate() {
            let node = k + FIRST_UNKNOWN;
            let velocity = step.velocity(grid.x[node]);
            *upstream = Upstream::of(velocity, k, unknowns);
            let geometry = match upstream {
                Upstream::Inlet => grid.rows[k],
                Upstream::Outlet | Upstream::Edge => upstream.geometry(&grid.x, k),
            };
            *row = geometry.in_time(velocity.abs(), step.quotient.now, self.history.at(weights, node));
        }
    }

    /// Runs Newton's method from the current state.
    fn newton(&mut self, at: &Conditions, options: &SolveOptions<Backtracking>, observer: &dyn Observer) -> Report {
        let mut report = Report::empty();
        self.system.newton(&at.problem, options, observer, &mut report);
        report
    }

    fn set_state(&mut self, at: &Conditions, h_0: f64) {
        self.place_surfaces(at.time, 1.0);
        self.system.set_curvature(at.curvature);
        self.system.set_pressure(&at.problem, &self.start);
        self.system.set_h_0(h_0);
        self.system.fraction.clone_from(&self.fraction);
    }

    /// Sets the features where they are at a time, with a share of their height.
    fn place_surfaces(&mut self, time: f64, share: f64) {
        if self.surfaces.is_empty() {
            return;
        }
        let LineSpace { grid, features, .. } = &mut self.system.space;
        features.clear();
        features.extend(grid.x.iter().map(|&x| share * self.surfaces.iter().map(|s| s.height(x, time)).sum::<f64>()));
    }

    /// Raises the features from smooth surfaces in several steps, each a solve from the one before.
    fn raise_surfaces(&mut self, at: &Conditions, observer: &dyn Observer) -> Report {
        let mut all = Report::empty();
        for raised in 0..=RAISES {
            self.place_surfaces(at.time, raised as f64 / RAISES as f64);
            self.system.renew_gap();
            self.system.set_h_0(self.system.h_0);
            let report = self.newton(at, &SolveOptions::default(), observer);
            let newton_iterations = all.newton_iterations + report.newton_iterations;
            let linear_iterations = all.linear_iterations + report.linear_iterations;
            all = Report { newton_iterations, linear_iterations, ..report };
            if all.termination != Termination::Converged {
                break;
            }
        }
        all
    }

    /// Stores the current state as the nearer previous one.
    fn remember(&mut self) {
        let system = &self.system;
        self.fraction.clone_from(&system.fraction);
        self.history.remember(&system.pressure, system.h_0, system.flow());
        if let Frame::Remeshed(interpolation) = self.frame {
            self.history.remember_between(interpolation, &system.space.grid.x, system.flow());
        }
    }
}

fn effort_of(report: &Report) -> Effort {
    Effort { newton_iterations: report.newton_iterations, linear_iterations: report.linear_iterations }
}

fn converged(report: &Report) -> Result<Effort, Termination> {
    match report.termination {
        Termination::Converged => Ok(effort_of(report)),
        termination => Err(termination),
    }
}

impl Marching for FullMarch {
    fn grid(&self) -> &LineGrid {
        &self.system.space.grid
    }

    fn rest(&mut self, at: &Conditions, observer: &dyn Observer) -> Result<Effort, Termination> {
        let point = point_at(&self.reference.point, at.input);
        let problem = Problem::new(&point, self.reference.lubricant).map_err(|_| Termination::Diverged)?;
        let solution = self.solver.solve_problem(problem, Start::Cold, observer);
        let solution = solution.map_err(|_| Termination::Diverged)?;
        converged(&solution.report)?;
        // The same contact in the frame's scales and on its grid.
        let size = (at.input.load * at.input.radius).sqrt() / at.scales.half_width;
        let LineSpace { grid, rows, upstream, .. } = &mut self.system.space;
        let here = || grid.x.iter().map(|x| x / size);
        self.start = interpolated(&solution, &solution.pressure, here(), &[0.0]);
        self.fraction.clear();
        if !solution.fraction.is_empty() {
            self.fraction = interpolated(&solution, &solution.fraction, here(), &[0.0]);
        }
        for (row, geometry) in rows.iter_mut().zip(&grid.rows) {
            *row = geometry.in_time(at.speed, 0.0, 0.0);
        }
        upstream.fill(Upstream::Inlet);
        self.set_state(at, 0.0);
        let central = solution.scalars.h_c * at.input.load / at.scales.film;
        self.system.set_central_film(central);
        let mut report = self.newton(at, &SolveOptions::default(), observer);
        if report.termination != Termination::Converged && !self.surfaces.is_empty() {
            self.place_surfaces(at.time, 0.0);
            self.system.set_curvature(at.curvature);
            self.system.set_pressure(&at.problem, &self.start);
            self.system.set_central_film(central);
            report = self.raise_surfaces(at, observer);
        }
        let effort = converged(&report)?;
        self.remember();
        self.history.rest();
        Ok(effort.and(effort_of(&solution.report)))
    }

    fn step(&mut self, step: &Step, observer: &dyn Observer) -> Result<Effort, Termination> {
        self.set_rows(step);
        let h_0 = self.history.extrapolate(step.ratio, &mut self.start);
        self.set_state(&step.now, h_0);
        let mut control = Backtracking { levelled_kernel: true, ..Backtracking::default() };
        let mut tolerance = STEP_TOLERANCE;
        if self.reference.lubricant.cavitation != Cavitation::Penalty {
            (tolerance, control.forcing) = (HELD_TOLERANCE, HELD_FORCING);
        }
        let farther = SolveOptions { tolerance, control, ..SolveOptions::default() };
        let control = Backtracking { shortest_step: 1.0, ..control };
        let beside = SolveOptions { max_newton: 12, control, ..farther };
        let first = self.newton(&step.now, &beside, observer);
        if matches!(first.termination, Termination::Converged | Termination::Cancelled) {
            return converged(&first);
        }
        let extrapolation = self.start.clone();
        let (nearer, h_0) = self.history.nearer();
        self.start.copy_from_slice(nearer);
        self.set_state(&step.now, h_0);
        // The previous state is farther away: damped as from any initial guess.
        let second = self.newton(&step.now, &farther, observer);
        self.start = extrapolation;
        Ok(converged(&second)?.and(effort_of(&first)))
    }

    fn deviation(&self) -> f64 {
        let weights = &self.system.space.grid.weights;
        let (mut difference, mut norm) = (0.0, 0.0);
        for ((p, e), w) in self.system.pressure.iter().zip(&self.start).zip(weights) {
            difference += w * (p - e) * (p - e);
            norm += w * p * p;
        }
        (difference / norm).sqrt()
    }

    fn accept(&mut self, _: &Conditions) {
        self.remember();
    }

    fn moment(&self, at: &Conditions, step: f64, effort: Effort) -> Moment {
        Moment::of_fields(at, step, &self.system.space.grid, &self.system.pressure, &self.system.film, effort)
    }

    fn state(&self, at: &Conditions) -> State {
        State {
            time: at.time,
            scales: at.scales,
            pressure: self.system.pressure.clone(),
            film: self.system.film.clone(),
            multiplier: self.system.active.field(&self.system.space.grid),
            fraction: self.system.fraction.clone(),
            h_0: self.system.h_0,
        }
    }
}
