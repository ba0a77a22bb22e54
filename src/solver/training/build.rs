//! Building a local model from a specification: full solutions, bases, row snapshots, sampled equations.

use super::bases::{InCommon, bases, modes_missing, modes_missing_of_any};
use super::cell::{Cell, anchor};
use super::error::TrainingError;
use super::observer::TrainingObserver;
use super::one_thread::on_one_thread;
use super::plan::Within;
use super::rows::sample_rows;
use super::spec::{TrainingSpec, WindowSpec, Windows};
use super::state::{FEWEST, Part, Solved, TrainingState};
use crate::host::pool::on_all_cores;
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::full::{ContactSolver, SolveError, Start};
use crate::solver::observer::Progress;
use crate::solver::parameters::{CIRCLES, Metric};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::{
    Keeping, RowSnapshots, Sampling, Scheme, Shapes, TestSpace, Window, all_rows, fronts, kept_rule, minimised_rows,
};
use fastrand::Rng;
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Local model in training, with all data to build it.
pub(super) struct WindowTraining<'a> {
    pub spec: &'a TrainingSpec,
    pub window: WindowSpec,
    pub grid: ContactGrid,
    /// Interval of M of its training points.
    pub reach: (f64, f64),
    /// Number of pressure modes above which it is split instead of being built.
    pub most_modes: Option<usize>,
    /// Cell of its anchor, if it has one.
    pub cell: Option<Cell>,
    /// Bases shared with other local models, if any.
    pub in_common: Option<InCommon>,
    /// True if contacts without a full solution are omitted and named.
    pub named: bool,
    pub observer: &'a dyn TrainingObserver,
}

/// Number of full solutions between two checkpoints.
const SOLVED_AT_ONCE: usize = 16;

impl<'a> WindowTraining<'a> {
    pub fn new(
        spec: &'a TrainingSpec,
        window: WindowSpec,
        reach: (f64, f64),
        most_modes: Option<usize>,
        observer: &'a dyn TrainingObserver,
    ) -> Result<Self, TrainingError> {
        let wanted = window.grid;
        let grid = on_one_thread(observer, move || wanted.build())?.map_err(SolveError::from)?;
        Ok(Self { spec, window, grid, reach, most_modes, cell: None, in_common: None, named: false, observer })
    }

    /// Returns the set of its training points.
    pub fn within(&self) -> Within {
        Within { cell: self.cell.clone(), ..self.spec.within(self.reach).beyond(&self.window) }
    }

    pub fn too_few(&self, count: usize) -> TrainingError {
        let (from, to) = self.window.m;
        TrainingError::Specification(format!(
            "the window M {from}…{to} holds {count} training points of the range; it needs at least 4"
        ))
    }

    /// Computes full solutions at all pending points of a part, in parallel, in order. Finished solutions are kept on
    /// errors.
    pub fn solve_pending(&self, state: &mut TrainingState, part: Part) -> Result<(), TrainingError> {
        loop {
            let own = state.part(part);
            if own.pending.is_empty() {
                return Ok(());
            }
            let before = own.solved.len();
            let total = before + own.pending.len();
            let asked = own.pending[..own.pending.len().min(SOLVED_AT_ONCE)].to_vec();
            let results = match self.observer.solved_elsewhere(&asked) {
                Some(results) => results,
                None => self.solve_all(&asked, before, total),
            };
            let mut finished = Vec::new();
            let mut first_error = None;
            let mut unsolved = Vec::new();
            for (result, asked) in results.into_iter().zip(asked) {
                match result {
                    Ok(solved) => finished.push(solved),
                    Err(TrainingError::NotConverged { .. }) if self.named => unsolved.push(asked),
                    Err(error) => first_error = first_error.or(Some(error)),
                }
            }
            let count = finished.len();
            own.keep(finished);
            own.give_up(unsolved.iter().map(|(place, _)| *place));
            state.solves += count;
            state.decisions.extend(unsolved.iter().map(|(_, point)| without_solution(point)));
            self.observer.checkpoint(state);
            if let Some(error) = first_error {
                return Err(error);
            }
        }
    }

    fn solve_all(
        &self,
        points: &[(usize, OperatingPoint)],
        before: usize,
        total: usize,
    ) -> Vec<Result<Solved, TrainingError>> {
        let (spec, observer) = (self.spec, self.observer);
        let stage = format!("Full solutions, M {}…{}", self.window.m.0, self.window.m.1);
        let done = AtomicUsize::new(before);
        let solve = |solver: &mut ContactSolver, (place, point): &(usize, OperatingPoint)| {
            if observer.cancelled() {
                return Err(TrainingError::Cancelled);
            }
            let solution = solver.solve(point, spec.lubricant_of(point), Start::Cold, observer)?;
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            observer.progress(Progress { stage: stage.clone(), done, total });
            if solution.converged() {
                let solution = if spec.tells_grid_costs() { solver.judged(solution) } else { solution };
                Ok(Solved::new(*place, solution, &self.grid))
            } else if observer.cancelled() {
                Err(TrainingError::Cancelled)
            } else {
                let moes = point.moes();
                Err(TrainingError::NotConverged { m: moes.m, l: moes.l })
            }
        };
        on_all_cores(|| points.par_iter().map_init(|| ContactSolver::on(&self.grid), solve).collect())
    }

    /// Builds the bases from given solutions, with all rows; `None` if they need more modes than permitted.
    pub fn assemble(&self, solutions: &[Solved]) -> Result<Option<Window>, TrainingError> {
        let Self { spec, window, grid, most_modes, observer, .. } = self;
        if solutions.len() < FEWEST {
            return Err(self.too_few(solutions.len()));
        }
        observer.progress(Progress { stage: format!("Bases, M {}…{}", window.m.0, window.m.1), done: 0, total: 1 });
        let (from, to) = window.m;
        let failed = || TrainingError::Decomposition { from, to };
        let pressure_loss = window.pressure_loss.unwrap_or(spec.pressure_loss);
        let (losses, positive) = ([pressure_loss, spec.deformation_loss], spec.positive_modes);
        let (most, missing) = match spec.windows {
            Windows::Anchored { modes, missing, missing_of_any, .. } => (modes, [missing, missing_of_any]),
            Windows::Given(_) | Windows::Automatic { .. } => (usize::MAX, [0.0; 2]),
        };
        let (grid, solutions, shared) = (grid.clone(), solutions.to_vec(), self.in_common.clone());
        let own: Vec<bool> = solutions.iter().map(|s| spec.lubricant_of(&s.point) == spec.lubricant).collect();
        let cavitation = spec.lubricant.cavitation;
        let ratio = spec.shapes_of(window);
        let (anchored, shapes) = (anchor(window).is_some() || spec.range.is_rough(), ratio != CIRCLES);
        let keeping = Keeping { kind: grid.kind(), anchored, heat: spec.heats(), shapes };
        let mut model = on_one_thread(*observer, move || {
            let mut asked = Vec::new();
            if missing[0] > 0.0 {
                asked.push(modes_missing(&solutions, &grid, missing[0])?);
            }
            if missing[1] > 0.0 {
                asked.push(modes_missing_of_any(&solutions, &grid, missing[1])?);
            }
            let most = asked.into_iter().max().map_or(most, |asked| most.min(asked));
            let limits = (losses, most, keeping);
            let (pressure, deformation, mut snapshots) = bases(limits, positive, &grid, (&solutions, &own), shared)?;
            if cavitation == Cavitation::Complementarity {
                for (snapshot, solution) in snapshots.iter_mut().zip(&solutions) {
                    snapshot.fronts = match solution.fronts.is_empty() {
                        true => fronts(&grid, |node| solution.pressure[node]),
                        false => solution.fronts.clone(),
                    };
                }
            }
            let shapes = match (&grid, ratio == CIRCLES) {
                (ContactGrid::Point(plane), false) => Some(Shapes::new(plane, ratio).ok()?),
                _ => None,
            };
            let rows = all_rows(&TestSpace::new(pressure.basis(), &grid));
            let window = Window::new((from, to), grid, pressure, deformation, snapshots, Sampling::All, rows);
            Some(Window { shapes, ..window })
        })?
        .ok_or_else(failed)?;
        (model.penalty, model.cavitation, model.anchor) = (spec.penalty, cavitation, anchor(window));
        model.metric = Metric::of_solutions(&spec.range);
        if most_modes.is_some_and(|most| model.pressure.count() > most) {
            return Ok(None);
        }
        Ok(Some(model))
    }

    /// Samples the equations of a local model as specified.
    pub fn sample(&self, mut window: Window, rng: &mut Rng) -> Result<Window, TrainingError> {
        let Self { spec, observer, .. } = self;
        if spec.sampling == Sampling::All && spec.scheme != Scheme::Galerkin {
            let test = TestSpace::new(window.pressure.basis(), &window.grid);
            let (of, count) = ((spec.scheme, spec.sampling), test.weights.len());
            let (from, to) = window.m;
            let rows = minimised_rows(&test, of, &RowSnapshots::default(), count);
            window.set_rows(spec.sampling, rows.ok_or(TrainingError::Decomposition { from, to })?);
        }
        if spec.sampling != Sampling::All {
            let (from, to) = window.m;
            let served = self.within().served_by(&window, self.cell.clone());
            let sampled = sample_rows(spec, &Arc::new(spec.model_of(&window)), &served, rng, *observer)?;
            let mut rows = sampled.ok_or(TrainingError::Decomposition { from, to })?;
            let short = Keeping::of(&window, spec.heats()).shortens_rules();
            if short && spec.sampling != Sampling::Cubature {
                rows.reconstruction = kept_rule(rows.reconstruction);
            }
            window.set_rows(spec.sampling, rows);
        }
        Ok(window)
    }
}

/// Returns a sentence about an omitted contact.
fn without_solution(point: &OperatingPoint) -> String {
    let (moes, oil) = (point.moes(), (point.viscosity_pa_s * 1e3, point.alpha_per_pa * 1e9));
    format!(
        "the full solver did not converge at M = {:.4}, L = {:.4}, p_H = {:.3} GPa, η₀ = {:.3} mPa·s, α = {:.3}/GPa: left out",
        moes.m,
        moes.l,
        point.hertz().pressure_pa * 1e-9,
        oil.0,
        oil.1
    )
}
