//! State of a training, with all full solutions so far. A training that was stopped after any full solution continues
//! from its state and gives the same model as without the stop.

use super::search::Search;
use super::spec::{TrainingSpec, WindowSpec};
use crate::solver::discrete::grid::{ContactGrid, GridSpec};
use crate::solver::full::{GridCost, Solution};
use crate::solver::parameters::REFERENCE_ROUGHNESS_M;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::fronts;
use serde::{Deserialize, Serialize};

/// Factor in M and in the radius ratio by which the training points of a local model extend beyond its intervals.
/// Contacts near an end of an interval then have training points on both sides.
pub(super) const OVERLAP: f64 = 1.221_402_758_160_17;

/// Minimum number of full solutions for a local model.
pub(super) const FEWEST: usize = 4;

/// Film pressure P_h up to which a node of a contact with rough surfaces counts as cavitated.
const NO_FILM_PRESSURE: f64 = 1e-8;

/// State of a training. Stored full solutions are used again and not computed twice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingState {
    /// Specification of the training.
    pub spec: TrainingSpec,
    /// Trials: candidate grids for automatic local models, with their solutions. Empty after a grid is selected.
    pub trials: Vec<WindowState>,
    /// Local models in the order of ascending M. Automatic ones may be split during the training.
    pub windows: Vec<WindowState>,
    /// Decisions on grids and local models, one sentence each, for the log of the model.
    pub decisions: Vec<String>,
    /// Number of full solutions computed so far. A solution that overlapping local models share counts once.
    pub solves: usize,
}

/// State of one local model, or of one trial.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WindowState {
    /// Specification, with the interval of M and the grid.
    pub window: WindowSpec,
    /// Seed of the random numbers of this local model.
    pub seed: u64,
    /// Number of solutions at the beginning of `solved` that it took over, for instance from the local model that was
    /// split into this one.
    pub inherited: usize,
    /// Full solutions, in the order in which their points were planned.
    pub solved: Vec<Solved>,
    /// Planned points that are not solved yet, with their places in the order of planning.
    pub pending: Vec<(usize, OperatingPoint)>,
    /// True once the first points have been planned.
    pub planned: bool,
    /// State of the search for bad approximations.
    pub search: Search,
}

/// Part of a training that has full solutions.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    /// Trial, by its index in [`TrainingState::trials`].
    Trial(usize),
    /// Local model, by its index in [`TrainingState::windows`].
    Window(usize),
}

/// Full solution stored by a training.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Solved {
    /// Place in the order of planning.
    pub place: usize,
    /// Operating point.
    pub point: OperatingPoint,
    /// Pressure P, node array.
    pub pressure: Vec<f64>,
    /// Rigid-body separation H₀.
    pub h_0: f64,
    /// Central film thickness H_c.
    pub h_c: f64,
    /// Discretisation error of H_c, if it was requested.
    pub grid_cost: Option<GridCost>,
    /// For rough surfaces, the first cavitated column of each line along X. Empty for smooth surfaces, where it follows
    /// from the pressures.
    pub fronts: Vec<usize>,
}

impl Solved {
    /// Returns the film thickness by which errors of H_c are divided to get relative errors. It is H_c itself for
    /// smooth surfaces. For rough surfaces it is at least half the reference roughness.
    pub(super) fn least_film(&self) -> f64 {
        match self.fronts.is_empty() {
            true => self.h_c,
            false => self.h_c.abs().max(0.5 * REFERENCE_ROUGHNESS_M / self.point.film_scale_m()),
        }
    }

    /// Extracts the data that a training needs from a solution on a grid. `place` is its place in the order of
    /// planning.
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

    /// Returns the number of full solutions computed so far.
    pub fn solutions(&self) -> usize {
        self.solves
    }

    /// Returns the contacts that must be solved in full next, with their places, and the grid for them. `None` if none
    /// are planned.
    pub fn awaited(&self) -> Option<(GridSpec, &[(usize, OperatingPoint)])> {
        let part = self.trials.iter().chain(&self.windows).find(|part| !part.pending.is_empty())?;
        Some((part.window.grid, &part.pending))
    }

    /// Returns the state of a trial or of a local model.
    pub(super) fn part(&mut self, part: Part) -> &mut WindowState {
        match part {
            Part::Trial(k) => &mut self.trials[k],
            Part::Window(k) => &mut self.windows[k],
        }
    }
}

impl WindowState {
    /// Creates the state of a local model that has only solutions from other parts of the training.
    pub(super) fn new(window: WindowSpec, seed: u64, inherited: impl IntoIterator<Item = Solved>) -> Self {
        let renumbered = inherited.into_iter().enumerate().map(|(place, solved)| Solved { place, ..solved });
        let solved: Vec<Solved> = renumbered.collect();
        let (pending, planned, search) = (Vec::new(), false, Search::default());
        Self { window, seed, inherited: solved.len(), solved, pending, planned, search }
    }

    /// Adds points to be solved, with the next free places.
    pub(super) fn decide(&mut self, points: impl IntoIterator<Item = OperatingPoint>) {
        let from = self.solved.len() + self.pending.len();
        self.pending.extend(points.into_iter().enumerate().map(|(i, p)| (from + i, p)));
    }

    /// Removes planned contacts for which no full solution was found, given by their places. Later places move up.
    pub(super) fn give_up(&mut self, places: impl IntoIterator<Item = usize>) {
        let mut given_up: Vec<usize> = places.into_iter().collect();
        given_up.sort_unstable();
        self.pending.retain(|(place, _)| given_up.binary_search(place).is_err());
        let moved = |place: &mut usize| *place -= given_up.partition_point(|given_up| given_up < place);
        self.pending.iter_mut().for_each(|(place, _)| moved(place));
        self.solved.iter_mut().for_each(|solved| moved(&mut solved.place));
    }

    /// Moves contacts from the planned to the solved ones. The solutions stay sorted by place.
    pub(super) fn keep(&mut self, finished: Vec<Solved>) {
        self.pending.retain(|(place, _)| finished.iter().all(|s| s.place != *place));
        self.solved.extend(finished);
        self.solved.sort_by_key(|s| s.place);
    }
}
