//! What a training has done so far: enough to stop after any full solution, go on later, and arrive at the same model.

use super::adaptive::Search;
use super::anchors::{self, Cell, InCommon, anchor};
use super::build::{WindowTraining, alone};
use super::calibrate::{calibrate, measured};
use super::check::check;
use super::one_thread::on_one_thread;
use super::plan::Within;
use super::split::{may_split, split};
use super::traction::traction_rule;
use super::{Plan, TrainingError, TrainingObserver, TrainingSpec, WindowSpec, Windows, layout};
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::{GridCost, Solution};
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::{ModelSize, ReducedModel, Snapshot, Window};
use fastrand::Rng;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

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

    /// The model of what there is, without another full solution: what a stopped training is worth. Its domain ends
    /// where the windows do that have solutions enough.
    ///
    /// # Errors
    /// When the first window has fewer than four solutions, or the observer cancels.
    pub fn model(&self, observer: &dyn TrainingObserver) -> Result<ReducedModel, TrainingError> {
        check(&self.spec)?;
        let mut rest = self.clone();
        if let (Windows::Anchored { .. }, [pool], []) = (&rest.spec.windows, &mut *rest.trials, &*rest.windows) {
            pool.pending.clear();
            pool.planned = true;
            anchors::choose(&mut rest, observer)?;
        }
        let usable = rest.windows.iter().take_while(|w| w.solved.len() >= FEWEST).count();
        if usable == 0 {
            let there = rest.windows.first().map_or(0, |window| window.solved.len());
            return Err(TrainingError::Specification(format!(
                "{there} full solutions in the first window are too few for a model; at least {FEWEST} are needed"
            )));
        }
        rest.windows.truncate(usable);
        for window in &mut rest.windows {
            window.pending.clear();
            window.planned = true;
            window.search.finished = true;
        }
        go(&mut rest, true, observer)
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

/// Trains on from a state, which holds whatever was finished also when this ends with an error.
///
/// # Errors
/// When the specification is refused, a full solve fails, or the observer cancels.
pub fn train_resumable(
    state: &mut TrainingState,
    observer: &dyn TrainingObserver,
) -> Result<ReducedModel, TrainingError> {
    check(&state.spec)?;
    if state.windows.is_empty() {
        match &state.spec.windows {
            Windows::Given(windows) => {
                let seeds = std::iter::successors(Some(state.spec.seed), |seed| Some(Rng::with_seed(*seed).u64(..)));
                let begun = windows.iter().zip(seeds).map(|(window, seed)| WindowState::new(*window, seed, []));
                state.windows = begun.collect();
            }
            Windows::Automatic { .. } => layout::choose(state, observer)?,
            Windows::Anchored { .. } => anchors::choose(state, observer)?,
        }
    }
    go(state, false, observer)
}

/// A window whose grid is expected to cost more than this share of H_c is told so.
const TOO_COSTLY: f64 = 0.1;

/// Trains every window; `ended` takes them as they are.
fn go(state: &mut TrainingState, ended: bool, observer: &dyn TrainingObserver) -> Result<ReducedModel, TrainingError> {
    let spec = state.spec.clone();
    let mut windows = Vec::with_capacity(state.windows.len());
    let (mut logs, mut evidence) = (Vec::new(), Vec::new());
    let in_common = anchors::in_common(&spec, &state.windows, observer)?;
    while windows.len() < state.windows.len() {
        let k = windows.len();
        let Some(mut trained) = train_window(&spec, k, (ended, &in_common), state, observer)? else {
            split(state, k, observer)?;
            continue;
        };
        if spec.range.slides() {
            let served = Within { cell: cell(&state.windows, k), ..spec.within(reach(&state.windows, k)) };
            let alone = Arc::new(alone(&spec, &trained));
            trained.traction = traction_rule(&spec, &alone, served, state.windows[k].seed, observer)?;
        }
        if spec.evidence > 0 {
            let ends = ends(&state.windows, k);
            let cell = cell(&state.windows, k);
            evidence.push(measured(&spec, &Arc::new(alone(&spec, &trained)), (k, ends, cell), observer)?);
        }
        let ((from, to), solutions, rows) = (trained.m, trained.snapshots.len(), trained.sampled_rows.len());
        let ModelSize { pressure, deformation, .. } = trained.size();
        let mut log = vec![format!(
            "M {from}…{to}: {solutions} full solutions, {pressure} pressure and {deformation} deformation modes, \
             {rows} of {} rows",
            trained.grid.unknowns()
        )];
        let cost = |snapshot: &Snapshot| trained.grid.spec().expected_cost(&snapshot.point);
        let worst = trained.snapshots.iter().map(cost).fold(0.0, f64::max);
        if worst > TOO_COSTLY {
            log.push(format!("this grid costs H_c up to some {:.0} %: take a longer or a finer one", 100.0 * worst));
        }
        log.extend(state.windows[k].search.describe(&spec.plan));
        if let Some(rule) = &trained.traction {
            log.push(format!("traction from the stress at {} nodes", rule.over(&trained.grid).0.len()));
        }
        logs.push(log);
        windows.push(trained);
    }
    let mut domain = spec.domain();
    calibrate(&mut windows, evidence, observer)?;
    let mut log = state.decisions.clone();
    for (own, window) in logs.into_iter().zip(&windows) {
        log.extend(own);
        log.push(match &window.calibration {
            Some(c) => {
                let by = if domain.measured_in_full() { "a full solution" } else { "three full Newton steps" };
                format!("errors measured at {} random points by {by} each", c.evidence())
            }
            None => "no error bound: errors were measured at too few points".to_owned(),
        });
    }
    let anchored = matches!(spec.windows, Windows::Anchored { .. });
    if !windows.is_empty() && !anchored {
        let lowest = windows.iter().map(|window| window.m.0).fold(f64::INFINITY, f64::min);
        let highest = windows.iter().map(|window| window.m.1).fold(0.0, f64::max);
        let (low, high) = domain.m();
        domain.space.set_limit(Quantity::M, (low.max(lowest), high.min(highest)));
    }
    Ok(ReducedModel { title: spec.title, domain, windows, scene: String::new(), log })
}

/// The cell of a window around an anchor.
fn cell(windows: &[WindowState], k: usize) -> Option<Cell> {
    Cell::of(windows.iter().map(|state| anchor(&state.window)), k)
}

/// The range of M from which a window is trained.
fn reach(windows: &[WindowState], k: usize) -> (f64, f64) {
    if windows[k].window.anchor.is_some() {
        return (0.0, f64::INFINITY);
    }
    let ((low, high), (first, last)) = (windows[k].window.m, ends(windows, k));
    (if first { 0.0 } else { low / OVERLAP }, if last { f64::INFINITY } else { high * OVERLAP })
}

/// Whether a window has the lowest and the highest M of all of its shapes.
fn ends(windows: &[WindowState], k: usize) -> (bool, bool) {
    let own = &windows[k].window;
    let beside = |other: &&WindowState| other.window.radius_ratio == own.radius_ratio;
    let first = windows[..k].iter().filter(beside).count() == 0;
    (first, windows[k + 1..].iter().filter(beside).count() == 0)
}

/// Trains window `k` to the end; `None` when it is to be split.
fn train_window(
    spec: &TrainingSpec,
    k: usize,
    (ended, in_common): (bool, &Option<InCommon>),
    state: &mut TrainingState,
    observer: &dyn TrainingObserver,
) -> Result<Option<Window>, TrainingError> {
    let most_modes = match spec.windows {
        Windows::Automatic { modes } if !ended && may_split(state, k) => Some(modes),
        _ => None,
    };
    let reach = reach(&state.windows, k);
    let cell = cell(&state.windows, k);
    let own = &mut state.windows[k];
    let mut rng = Rng::with_seed(own.seed);
    let mut work = WindowTraining::new(spec, own.window, reach, most_modes, observer)?;
    (work.named, work.cell, work.in_common) = (cell.is_some(), cell, in_common.clone());
    let known: Vec<OperatingPoint> = own.solved.iter().take(own.inherited).map(|s| s.point).collect();
    if own.solved.iter().any(|s| s.pressure.len() != work.grid.len()) {
        return Err(TrainingError::Specification("the stored full solutions belong to another grid".to_owned()));
    }
    // Drawn again when resumed, so that the random numbers behind it are the same.
    let points = match spec.plan {
        Plan::Grid { nodes } => {
            let mut points = spec.range.grid_points(spec.contact(), nodes);
            points.retain(|p| (reach.0..=reach.1).contains(&p.moes().m) && !known.contains(p));
            points
        }
        Plan::FarthestPoint { snapshots: wanted }
        | Plan::Adaptive { start: wanted, .. }
        | Plan::WorstOfPool { start: wanted, .. } => {
            let (within, known, mut random) = (work.within(), known.clone(), rng.clone());
            let more = wanted.saturating_sub(known.len());
            let (points, random) = on_one_thread(observer, move || {
                let points = within.farthest_points(&known, more, &mut random);
                (points, random)
            })?;
            rng = random;
            points
        }
    };
    if known.len() + points.len() < FEWEST {
        return Err(work.too_few(known.len() + points.len()));
    }
    if !own.planned {
        own.decide(points);
        own.planned = true;
    }
    work.solve_pending(state, Part::Window(k))?;
    if !spec.plan.searches() {
        let window = work.assemble(&state.windows[k].solved)?;
        return window.map(|window| work.sample(window, &mut rng)).transpose();
    }
    // Two seeds from the common sequence; the rows are sampled at the same random points in every round.
    let (search_seed, row_seed) = (rng.u64(..), rng.u64(..));
    state.windows[k].search.begin(search_seed);
    super::adaptive::search(&mut work, state, k, row_seed)
}
