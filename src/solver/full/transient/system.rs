//! March of the full system: every step is a Newton solve from the extrapolation of the two previous ones.

use super::frame::{Conditions, Frame, point_at};
use super::history::History;
use super::march::{Marching, Step, Transient, TransientError, TransientObserver, march};
use super::signal::{Input, Signal};
use super::space::MarchSpace;
use super::surface::{MovingSurface, Scheme};
use super::trajectory::{Effort, Moment, State, Trajectory};
use crate::solver::discrete::grid::{ContactGrid, GridSpec, ReferenceGrid};
use crate::solver::discrete::space::{Grid, LineSpace, PlaneSpace};
use crate::solver::full::problem::expect_kind;
use crate::solver::full::response::widest_spacing;
use crate::solver::full::solver::interpolated;
use crate::solver::full::{Mesh, Problem, Report, SolveError, SolveOptions, Solver, Start, System, Termination};
use crate::solver::observer::Observer;
use std::sync::Arc;

/// Full system of a line or point contact, prepared for a march.
pub struct FullMarch<S: MarchSpace = LineSpace> {
    pub(super) system: System<S>,
    /// Solver of the steady start, which needs other settings than a step.
    solver: Solver<S>,
    reference: Problem,
    frame: Frame,
    surfaces: Vec<MovingSurface>,
    /// Spacing ΔX if the scheme follows the characteristics.
    characteristic: Option<f64>,
    /// Prescribed change of H₀ plus 1, if H₀ and not the load is given, and H₀ of the start.
    separation: Option<Signal>,
    h_0_of_start: f64,
    history: History,
    start: Vec<f64>,
    /// Fill fraction θ of the nearer previous state; empty if cavitation does not conserve mass.
    fraction: Vec<f64>,
}

/// Number of steps in which features are raised where a steady solve with their full height fails.
const RAISES: usize = 8;

/// Simulates a contact in time with the full system on a grid.
///
/// # Errors
/// [`TransientError`] if the contact, the grid, the inputs, the times or the lubricant are refused.
pub fn solve(
    spec: GridSpec,
    transient: &Transient,
    observer: &dyn TransientObserver,
) -> Result<Trajectory, TransientError> {
    match spec.build().map_err(SolveError::from)? {
        ContactGrid::Line(grid) => march(&mut FullMarch::new(grid, transient)?, transient, observer),
        ContactGrid::Point(grid) => march(&mut FullMarch::<PlaneSpace>::on(grid, transient)?, transient, observer),
    }
}

impl FullMarch {
    /// Creates the system of a line contact on a reference grid for one contact and frame.
    ///
    /// # Errors
    /// [`TransientError`] if the contact, the inputs, the times or the lubricant are refused.
    pub fn new(reference: Arc<ReferenceGrid>, transient: &Transient) -> Result<Self, TransientError> {
        Self::on(reference, transient)
    }
}

impl<S: MarchSpace> FullMarch<S> {
    /// Creates the system on the grid of its space.
    ///
    /// # Errors
    /// [`TransientError`] if the contact, the inputs, the times or the lubricant are refused.
    pub fn on(reference: S::Reference, transient: &Transient) -> Result<Self, TransientError> {
        let problem = transient.problem()?;
        expect_kind(S::KIND, &problem.point)?;
        let space = S::on(&reference, S::form_of(&reference, &problem))?;
        let (x, _) = space.grid().abscissae();
        transient.check_on(x)?;
        let characteristic = (transient.scheme == Scheme::Characteristic).then(|| widest_spacing(x));
        let length = space.grid().weights().len();
        Ok(Self {
            system: System::new(space),
            solver: Solver::on(reference),
            reference: problem,
            frame: transient.frame,
            surfaces: transient.surfaces.clone(),
            characteristic,
            separation: transient.separation.clone(),
            h_0_of_start: 0.0,
            history: History::default(),
            start: vec![0.0; length],
            fraction: Vec::new(),
        })
    }

    /// Solves the steady contact with the given inputs and with the features where they are at T = 0. The inner error
    /// says how the iteration ended if it did not converge.
    ///
    /// # Errors
    /// [`SolveError`] if the contact is refused.
    pub fn solve_start(
        &mut self,
        input: Input,
        observer: &dyn Observer,
    ) -> Result<Result<(Moment, State), Termination>, SolveError> {
        let at = self.frame.conditions(&self.reference, 0.0, input)?;
        let effort = self.rest(&at, observer);
        Ok(effort.map(|effort| (self.moment(&at, 0.0, effort), self.state(&at))))
    }

    /// Sets the coefficients of the rows for a step.
    fn set_rows(&mut self, step: &Step) {
        let Self { system, history, frame, characteristic, .. } = self;
        let (x, _) = system.space.grid().abscissae();
        history.carry(*frame, step, x, x);
        system.space.set_rows(step, history, *characteristic);
    }

    /// Returns H₀ at the end of a step: the prescribed one, or the given estimate.
    fn separation_at(&self, time: f64, estimate: f64) -> f64 {
        self.separation.as_ref().map_or(estimate, |separation| self.h_0_of_start + separation.at(time) - 1.0)
    }

    /// Runs Newton's method from the current state.
    fn newton(&mut self, at: &Conditions, options: &SolveOptions<S::Control>, observer: &dyn Observer) -> Report {
        let mut report = Report::empty();
        self.system.newton(&at.problem, options, observer, &mut report);
        report
    }

    fn set_state(&mut self, at: &Conditions, h_0: f64) {
        self.set_shape(at, 1.0);
        self.system.set_pressure(&at.problem, &self.start);
        self.system.set_h_0(h_0);
        self.system.fraction.clone_from(&self.fraction);
    }

    /// Sets the gap of the undeformed bodies, with a share of the height of the features.
    fn set_shape(&mut self, at: &Conditions, share: f64) {
        let Self { system, surfaces, .. } = self;
        let height = |x: f64, y: f64| share * surfaces.iter().map(|s| s.height(x, y, at.time)).sum::<f64>();
        system.space.set_shape(at.curvature, (!surfaces.is_empty()).then_some(height));
        system.renew_gap();
    }

    /// Raises the features from smooth surfaces in several steps, each a solve from the one before.
    fn raise_surfaces(&mut self, at: &Conditions, observer: &dyn Observer) -> Report {
        let mut all = Report::empty();
        for raised in 0..=RAISES {
            self.set_shape(at, raised as f64 / RAISES as f64);
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
        self.history.remember(&system.pressure, system.h_0, system.stored());
        if let Frame::Remeshed(interpolation) = self.frame {
            self.history.remember_between(interpolation, system.space.grid().abscissae().0, system.stored());
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

impl<S: MarchSpace> Marching for FullMarch<S> {
    fn mesh(&self) -> Mesh {
        self.system.space.mesh()
    }

    fn abscissae(&self) -> &[f64] {
        self.system.space.grid().abscissae().0
    }

    fn rest(&mut self, at: &Conditions, observer: &dyn Observer) -> Result<Effort, Termination> {
        let point = point_at(&self.reference.point, at.input);
        let problem = Problem::new(&point, self.reference.lubricant).map_err(|_| Termination::Diverged)?;
        let solution = self.solver.solve_problem(problem, Start::Cold, observer);
        let solution = solution.map_err(|_| Termination::Diverged)?;
        converged(&solution.report)?;
        // The same contact in the frame's scales and on its grid.
        let (half_width, film) = S::dry_scales(at.input);
        let size = half_width / at.scales.half_width;
        let (x, y) = self.system.space.grid().abscissae();
        let here = || x.iter().map(|x| x / size);
        let across: Vec<f64> = y.iter().map(|y| y / size).collect();
        self.start = interpolated(&solution, &solution.pressure, here(), &across);
        self.fraction.clear();
        if !solution.fraction.is_empty() {
            self.fraction = interpolated(&solution, &solution.fraction, here(), &across);
        }
        self.system.prescribed = false;
        self.system.space.set_steady_rows(at);
        self.set_state(at, 0.0);
        let central = solution.scalars.h_c * film / at.scales.film;
        self.system.set_central_film(central);
        let mut report = self.newton(at, &SolveOptions::default(), observer);
        if report.termination != Termination::Converged && !self.surfaces.is_empty() {
            self.set_shape(at, 0.0);
            self.system.set_pressure(&at.problem, &self.start);
            self.system.set_central_film(central);
            report = self.raise_surfaces(at, observer);
        }
        let effort = converged(&report)?;
        self.h_0_of_start = self.system.h_0;
        self.system.prescribed = self.separation.is_some();
        self.remember();
        self.history.rest();
        Ok(effort.and(effort_of(&solution.report)))
    }

    fn step(&mut self, step: &Step, observer: &dyn Observer) -> Result<Effort, Termination> {
        self.set_rows(step);
        let estimate = self.history.extrapolate(step.ratio, &mut self.start);
        self.set_state(&step.now, self.separation_at(step.now.time, estimate));
        let [beside, farther] = S::step_options(self.reference.lubricant.cavitation);
        let first = self.newton(&step.now, &beside, observer);
        if matches!(first.termination, Termination::Converged | Termination::Cancelled) {
            return converged(&first);
        }
        let extrapolation = self.start.clone();
        let (nearer, h_0) = self.history.nearer();
        self.start.copy_from_slice(nearer);
        let h_0 = self.separation_at(step.now.time, h_0);
        self.set_state(&step.now, h_0);
        // The previous state is farther away: damped as from any initial guess.
        let second = self.newton(&step.now, &farther, observer);
        self.start = extrapolation;
        Ok(converged(&second)?.and(effort_of(&first)))
    }

    fn deviation(&self) -> f64 {
        let weights = self.system.space.grid().weights();
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
        let System { space, pressure, film, .. } = &self.system;
        let mut at = *at;
        if self.separation.is_some() {
            at.input = Input { load: self.system.carried_load() / self.reference.load, ..at.input };
        }
        let moment = Moment::of_fields(&at, step, space.grid(), pressure, film, effort);
        Moment { asperity_load_share: self.system.asperity_load_share(), ..moment }
    }

    fn state(&self, at: &Conditions) -> State {
        State {
            time: at.time,
            scales: at.scales,
            pressure: self.system.pressure.clone(),
            film: self.system.film.clone(),
            multiplier: self.system.active.field(self.system.space.grid()),
            fraction: self.system.fraction.clone(),
            h_0: self.system.h_0,
        }
    }
}
