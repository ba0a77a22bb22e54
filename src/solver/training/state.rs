//! What a training has done so far: enough to stop after any full solution, go on later, and arrive at the same model.

use super::adaptive::Search;
use super::aside::aside;
use super::build::{Shop, alone, check, domain};
use super::calibrate::calibrate;
use super::plan::{farthest_points, grid_points};
use super::{Plan, TrainingError, TrainingObserver, TrainingSpec, WindowSpec};
use crate::solver::contact::OperatingPoint;
use crate::solver::full::Solution;
use crate::solver::reduced::{ReducedModel, Window};
use fastrand::Rng;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Training reaches beyond a window's ends by this factor in M, so that its edge is not a corner.
const OVERLAP: f64 = 1.221_402_758_160_17;

/// Fewest full solutions that make a window.
pub(super) const FEWEST: usize = 4;

/// A training with everything it has computed; full solutions are never computed twice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingState {
    /// What is being trained.
    pub spec: TrainingSpec,
    /// One entry per window that was begun.
    pub windows: Vec<WindowState>,
}

/// How far one window is.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct WindowState {
    /// Full solutions, by their place in the order in which they were decided on.
    pub solved: Vec<Solved>,
    /// Decided on, not yet solved.
    pub pending: Vec<(usize, OperatingPoint)>,
    /// Whether the first points were decided on.
    pub planned: bool,
    /// Where the search for bad approximations is.
    pub search: Search,
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
}

impl Solved {
    /// Keeps what a training needs of a solution.
    pub fn new(place: usize, solution: Solution) -> Self {
        let Solution { problem, pressure, scalars, .. } = solution;
        Self { place, point: problem.point, pressure, h_0: scalars.h_0, h_c: scalars.h_c }
    }
}

impl TrainingState {
    /// A training that has not begun.
    pub fn new(spec: TrainingSpec) -> Self {
        Self { spec, windows: Vec::new() }
    }

    /// Full solutions so far.
    pub fn solutions(&self) -> usize {
        self.windows.iter().map(|w| w.solved.len()).sum()
    }

    /// The model of what there is, without another full solution: what a stopped training is worth. Its domain ends where the
    /// windows do that have solutions enough.
    ///
    /// # Errors
    /// When the first window has fewer than four solutions, or the observer cancels.
    pub fn model(&self, observer: &dyn TrainingObserver) -> Result<ReducedModel, TrainingError> {
        check(&self.spec)?;
        let mut rest = self.clone();
        for window in &mut rest.windows {
            window.pending.clear();
            window.search.finished = true;
        }
        let usable = rest.windows.iter().take_while(|w| w.solved.len() >= FEWEST).count();
        if usable == 0 {
            return Err(TrainingError::Specification(format!(
                "{} full solutions are too few for a model; at least {FEWEST} are needed",
                self.solutions()
            )));
        }
        go(&mut rest, usable, observer)
    }
}

impl WindowState {
    /// Decides on further points.
    pub(super) fn decide(&mut self, points: impl IntoIterator<Item = OperatingPoint>) {
        let from = self.solved.len() + self.pending.len();
        self.pending.extend(points.into_iter().enumerate().map(|(i, p)| (from + i, p)));
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
    go(state, state.spec.windows.len(), observer)
}

/// Makes the first `count` windows.
fn go(state: &mut TrainingState, count: usize, observer: &dyn TrainingObserver) -> Result<ReducedModel, TrainingError> {
    let spec = state.spec.clone();
    let mut rng = Rng::with_seed(spec.seed);
    let mut windows = Vec::with_capacity(spec.windows.len());
    let mut log = Vec::new();
    for (k, window) in spec.windows.iter().take(count).enumerate() {
        if state.windows.len() == k {
            state.windows.push(WindowState::default());
        }
        let mut trained = train_window(&spec, k, &mut rng, state, observer)?;
        if spec.evidence > 0 {
            trained.calibration = calibrate(&spec, &Arc::new(alone(&spec, &trained)), k, observer)?;
        }
        log.push(format!(
            "M {}…{}: {} full solutions, {} pressure and {} deformation modes, {} of {} rows",
            window.m.0,
            window.m.1,
            trained.snapshots.len(),
            trained.pressure.modes.ncols(),
            trained.deformation.modes.ncols(),
            trained.sampled_rows.len(),
            trained.grid.xi.len() - 3,
        ));
        log.extend(state.windows[k].search.describe(&spec.plan));
        log.push(match &trained.calibration {
            Some(c) => format!("errors measured at {} random points by two full Newton steps each", c.evidence()),
            None => "no error bound: errors were measured at too few points".to_owned(),
        });
        windows.push(trained);
    }
    let mut domain = domain(&spec);
    if count < spec.windows.len()
        && let Some(last) = windows.last()
    {
        domain.m.1 = domain.m.1.min(last.m.1);
    }
    Ok(ReducedModel { title: spec.title.clone(), domain, windows, scene: String::new(), log })
}

/// The range of M from which a window is trained.
fn reach(windows: &[WindowSpec], k: usize) -> (f64, f64) {
    let (low, high) = windows[k].m;
    (if k == 0 { 0.0 } else { low / OVERLAP }, if k + 1 == windows.len() { f64::INFINITY } else { high * OVERLAP })
}

fn train_window(
    spec: &TrainingSpec,
    k: usize,
    rng: &mut Rng,
    state: &mut TrainingState,
    observer: &dyn TrainingObserver,
) -> Result<Window, TrainingError> {
    let mut shop = Shop::new(spec, k, reach(&spec.windows, k), observer)?;
    if state.windows[k].solved.iter().any(|s| s.pressure.len() != shop.grid.xi.len()) {
        return Err(TrainingError::Specification("the stored full solutions belong to another grid".to_owned()));
    }
    // Drawn again when resumed, so that the random numbers behind it are the same.
    let points = match spec.plan {
        Plan::Grid { nodes } => {
            let mut points = grid_points(&spec.range, nodes);
            points.retain(|p| (shop.reach.0..=shop.reach.1).contains(&p.moes().m));
            points
        }
        Plan::FarthestPoint { snapshots: wanted }
        | Plan::Adaptive { start: wanted, .. }
        | Plan::WorstOfPool { start: wanted, .. } => {
            let (range, reach, mut random) = (spec.range.clone(), shop.reach, rng.clone());
            let (points, random) = aside(observer, move || {
                let points = farthest_points(&range, reach, wanted, &mut random);
                (points, random)
            })?;
            *rng = random;
            points
        }
    };
    if points.len() < FEWEST {
        return Err(shop.too_few(points.len()));
    }
    let own = &mut state.windows[k];
    if !own.planned {
        own.decide(points);
        own.planned = true;
    }
    shop.solve_pending(state, k)?;
    if !spec.plan.searches() {
        return shop.assemble(&state.windows[k].solved, rng);
    }
    // Two seeds from the common sequence; the rows are sampled at the same random points in every round.
    let (search_seed, row_seed) = (rng.u64(..), rng.u64(..));
    state.windows[k].search.begin(search_seed);
    super::adaptive::search(&mut shop, state, k, row_seed)
}
