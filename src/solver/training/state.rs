//! What a training has done so far: enough to stop after any full solution, go on later, and arrive at the same model.

use super::search::Search;
use super::spec::{TrainingSpec, WindowSpec};
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::{GridCost, Solution};
use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};

/// Training reaches beyond a window's ends by this factor in M, so that its edge is not a corner.
pub(super) const OVERLAP: f64 = 1.221_402_758_160_17;

/// Fewest full solutions that make a window.
pub(super) const FEWEST: usize = 4;

/// A training with everything it has computed; full solutions are never computed twice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingState {
    /// What is being trained.
    pub spec: TrainingSpec,
    /// Grids under trial for automatic windows; none once a grid was chosen.
    pub trials: Vec<WindowState>,
    /// The windows by ascending M; automatic ones are split as the training goes on.
    pub windows: Vec<WindowState>,
    /// What was decided on grid and windows, for the model's log.
    pub decisions: Vec<String>,
    /// Full solutions computed so far; windows that overlap may share them.
    pub solves: usize,
}

/// How far one window, or one trial, is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WindowState {
    /// Its range of M and its grid.
    pub window: WindowSpec,
    /// Seed of everything random in it.
    pub seed: u64,
    /// How many of its solutions were there before its own were planned.
    pub inherited: usize,
    /// Full solutions, by their place in the order in which they were decided on.
    pub solved: Vec<Solved>,
    /// Decided on, not yet solved.
    pub pending: Vec<(usize, OperatingPoint)>,
    /// Whether the first points were decided on.
    pub planned: bool,
    /// Where the search for bad approximations is.
    pub search: Search,
}

/// What full solutions are computed for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    Trial(usize),
    Window(usize),
}

/// A full solution as a training keeps it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Solved {
    /// Its place in the order.
    pub place: usize,
    /// The operating point.
    pub point: OperatingPoint,
    /// P over the node array.
    pub pressure: Vec<f64>,
    /// H₀.
    pub h_0: f64,
    /// Central film.
    pub h_c: f64,
    /// What the grid costs it, where that was asked for.
    pub grid_cost: Option<GridCost>,
}

impl Solved {
    /// Keeps what a training needs of a solution.
    pub fn new(place: usize, solution: Solution) -> Self {
        let Solution { problem, pressure, scalars, grid_cost, .. } = solution;
        Self { place, point: problem.point, pressure, h_0: scalars.h_0, h_c: scalars.h_c, grid_cost }
    }
}

impl TrainingState {
    /// A training that has not begun.
    pub fn new(spec: TrainingSpec) -> Self {
        Self { spec, trials: Vec::new(), windows: Vec::new(), decisions: Vec::new(), solves: 0 }
    }

    /// Full solutions so far.
    pub fn solutions(&self) -> usize {
        self.solves
    }

    /// The contacts that are to be solved in full before anything else, each with its place in the order, and their
    /// grid; none of a training that has not planned any.
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
    /// A window of which nothing was computed but the solutions `inherited`.
    pub(super) fn new(window: WindowSpec, seed: u64, inherited: impl IntoIterator<Item = Solved>) -> Self {
        let renumbered = inherited.into_iter().enumerate().map(|(place, solved)| Solved { place, ..solved });
        let solved: Vec<Solved> = renumbered.collect();
        let (pending, planned, search) = (Vec::new(), false, Search::default());
        Self { window, seed, inherited: solved.len(), solved, pending, planned, search }
    }

    /// Decides on further points.
    pub(super) fn decide(&mut self, points: impl IntoIterator<Item = OperatingPoint>) {
        let from = self.solved.len() + self.pending.len();
        self.pending.extend(points.into_iter().enumerate().map(|(i, p)| (from + i, p)));
    }

    /// Gives up contacts without a full solution; those decided on behind them move up.
    pub(super) fn give_up(&mut self, places: impl IntoIterator<Item = usize>) {
        let mut given_up: Vec<usize> = places.into_iter().collect();
        given_up.sort_unstable();
        self.pending.retain(|(place, _)| given_up.binary_search(place).is_err());
        let moved = |place: &mut usize| *place -= given_up.partition_point(|given_up| given_up < place);
        self.pending.iter_mut().for_each(|(place, _)| moved(place));
        self.solved.iter_mut().for_each(|solved| moved(&mut solved.place));
    }

    /// Keeps finished solutions in their order.
    pub(super) fn keep(&mut self, finished: Vec<Solved>) {
        self.pending.retain(|(place, _)| finished.iter().all(|s| s.place != *place));
        self.solved.extend(finished);
        self.solved.sort_by_key(|s| s.place);
    }
}
