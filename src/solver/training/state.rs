//! State of a training: sufficient to stop after any full solution, continue later, and obtain the same model.

use super::search::Search;
use super::spec::{TrainingSpec, WindowSpec};
use crate::solver::discrete::grid::{ContactGrid, GridSpec};
use crate::solver::full::{GridCost, Solution};
use crate::solver::parameters::REFERENCE_ROUGHNESS_M;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::fronts;
use serde::{Deserialize, Serialize};

/// Factor in M by which training points extend beyond the ends of a local model, so that its edge is not a corner.
pub(super) const OVERLAP: f64 = 1.221_402_758_160_17;

/// Minimum number of full solutions for a local model.
pub(super) const FEWEST: usize = 4;

/// Film pressure P_h of rough surfaces up to which a node counts as cavitated.
const NO_FILM_PRESSURE: f64 = 1e-8;

/// Training with all its results; full solutions are never computed twice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingState {
    /// Specification of the training.
    pub spec: TrainingSpec,
    /// Grids on trial for automatic local models; empty after the grid is selected.
    pub trials: Vec<WindowState>,
    /// Local models by ascending M; automatic ones are split during the training.
    pub windows: Vec<WindowState>,
    /// Decisions on grid and local models, for the model's log.
    pub decisions: Vec<String>,
    /// Number of full solutions computed so far; overlapping local models may share them.
    pub solves: usize,
}

/// State of one local model, or of one trial.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WindowState {
    /// Specification: interval of M and grid.
    pub window: WindowSpec,
    /// Seed of its random numbers.
    pub seed: u64,
    /// Number of inherited solutions.
    pub inherited: usize,
    /// Full solutions, in the order of planning.
    pub solved: Vec<Solved>,
    /// Planned points that are not solved yet, with their places.
    pub pending: Vec<(usize, OperatingPoint)>,
    /// True after the first points are planned.
    pub planned: bool,
    /// State of the search for bad approximations.
    pub search: Search,
}

/// Owner of full solutions.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    Trial(usize),
    Window(usize),
}

/// Full solution stored by a training.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Solved {
    /// Place in the order of planning.
    pub place: usize,
    /// Operating point.
    pub point: OperatingPoint,
    /// P over the node array.
    pub pressure: Vec<f64>,
    /// Rigid-body separation H₀.
    pub h_0: f64,
    /// Central film thickness H_c.
    pub h_c: f64,
    /// Discretisation error, if requested.
    pub grid_cost: Option<GridCost>,
    /// First cavitated column of each line along X, of rough surfaces. Empty for smooth ones, whose pressures show it.
    pub fronts: Vec<usize>,
}

impl Solved {
    /// Returns the film thickness to which errors of the central one are relative: for rough surfaces at least σ/2.
    pub(super) fn least_film(&self) -> f64 {
        match self.fronts.is_empty() {
            true => self.h_c,
            false => self.h_c.abs().max(0.5 * REFERENCE_ROUGHNESS_M / self.point.film_scale_m()),
        }
    }

    /// Extracts the data that a training needs from a solution on a grid.
    pub fn new(place: usize, solution: Solution, grid: &ContactGrid) -> Self {
        let fronts = solution.problem.rough.map_or_else(Vec::new, |_| {
            let film_pressure = solution.film_pressure();
            fronts(grid, |node| film_pressure[node] - NO_FILM_PRESSURE)
        });
        let Solution { problem, pressure, scalars, grid_cost, .. } = solution;
        Self { place, point: problem.point, pressure, h_0: scalars.h_0, h_c: scalars.h_c, grid_cost, fronts }
    }
}

impl TrainingState {
    /// Creates a training that has not started.
    pub fn new(spec: TrainingSpec) -> Self {
        Self { spec, trials: Vec::new(), windows: Vec::new(), decisions: Vec::new(), solves: 0 }
    }

    /// Returns the number of full solutions so far.
    pub fn solutions(&self) -> usize {
        self.solves
    }

    /// Returns the contacts that must be solved in full next, with their places and their grid; `None` if none are
    /// planned.
    pub fn awaited(&self) -> Option<(GridSpec, &[(usize, OperatingPoint)])> {
        let part = self.trials.iter().chain(&self.windows).find(|part| !part.pending.is_empty())?;
        Some((part.window.grid, &part.pending))
    }

    pub(super) fn part(&mut self, part: Part) -> &mut WindowState {
        match part {
            Part::Trial(k) => &mut self.trials[k],
            Part::Window(k) => &mut self.windows[k],
        }
    }
}

impl WindowState {
    /// Creates a local model with inherited solutions only.
    pub(super) fn new(window: WindowSpec, seed: u64, inherited: impl IntoIterator<Item = Solved>) -> Self {
        let renumbered = inherited.into_iter().enumerate().map(|(place, solved)| Solved { place, ..solved });
        let solved: Vec<Solved> = renumbered.collect();
        let (pending, planned, search) = (Vec::new(), false, Search::default());
        Self { window, seed, inherited: solved.len(), solved, pending, planned, search }
    }

    /// Plans further points.
    pub(super) fn decide(&mut self, points: impl IntoIterator<Item = OperatingPoint>) {
        let from = self.solved.len() + self.pending.len();
        self.pending.extend(points.into_iter().enumerate().map(|(i, p)| (from + i, p)));
    }

    /// Removes contacts without a full solution; later places move up.
    pub(super) fn give_up(&mut self, places: impl IntoIterator<Item = usize>) {
        let mut given_up: Vec<usize> = places.into_iter().collect();
        given_up.sort_unstable();
        self.pending.retain(|(place, _)| given_up.binary_search(place).is_err());
        let moved = |place: &mut usize| *place -= given_up.partition_point(|given_up| given_up < place);
        self.pending.iter_mut().for_each(|(place, _)| moved(place));
        self.solved.iter_mut().for_each(|solved| moved(&mut solved.place));
    }

    /// Adds finished solutions and sorts by place.
    pub(super) fn keep(&mut self, finished: Vec<Solved>) {
        self.pending.retain(|(place, _)| finished.iter().all(|s| s.place != *place));
        self.solved.extend(finished);
        self.solved.sort_by_key(|s| s.place);
    }
}
