//! Sequence of a training: local models one after the other, from full solutions to a calibrated model.

use super::adaptive::search;
use super::anchors;
use super::bases::InCommon;
use super::build::WindowTraining;
use super::calibrate::{calibrate, measured};
use super::cell::{Cell, anchor};
use super::check::check;
use super::error::TrainingError;
use super::layout;
use super::observer::TrainingObserver;
use super::one_thread::on_one_thread;
use super::plan::Within;
use super::spec::{Plan, TrainingSpec, Windows};
use super::split::{may_split, split};
use super::state::{FEWEST, OVERLAP, Part, TrainingState, WindowState};
use super::traction::traction_rule;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::{ModelSize, ReducedModel, Snapshot, Window};
use fastrand::Rng;
use std::sync::Arc;

/// Trains a model: full solutions on all cores, then bases, sampling and operators.
///
/// # Errors
/// [`TrainingError`] if the specification is refused, a full solve fails, or the observer cancels.
pub fn train(spec: &TrainingSpec, observer: &dyn TrainingObserver) -> Result<ReducedModel, TrainingError> {
    train_resumable(&mut TrainingState::new(spec.clone()), observer)
}

/// Continues a training from a state. The state contains all finished work, also after an error.
///
/// # Errors
/// [`TrainingError`] if the specification is refused, a full solve fails, or the observer cancels.
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

impl TrainingState {
    /// Builds the model from the current state without further full solutions, for a stopped training. Its domain
    /// includes only the local models with enough solutions.
    ///
    /// # Errors
    /// [`TrainingError`] if the first local model has fewer than four solutions, or if the observer cancels.
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
}

/// Expected relative discretisation error of the central film thickness above which the log contains a note.
const TOO_COSTLY: f64 = 0.1;

/// Trains every local model; if `ended`, from the existing solutions only.
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
            let alone = Arc::new(spec.model_of(&trained));
            trained.traction = traction_rule(&spec, &alone, served, state.windows[k].seed, observer)?;
        }
        if spec.evidence > 0 {
            let ends = ends(&state.windows, k);
            let cell = cell(&state.windows, k);
            evidence.push(measured(&spec, &Arc::new(spec.model_of(&trained)), (k, ends, cell), observer)?);
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
            log.push(format!(
                "the discretisation error of H_c reaches about {:.0} %: choose a longer domain or a finer grid",
                100.0 * worst
            ));
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

/// Returns the cell of a local model around an anchor.
fn cell(windows: &[WindowState], k: usize) -> Option<Cell> {
    Cell::of(windows.iter().map(|state| anchor(&state.window)), k)
}

/// Returns the interval of M of a local model's training points.
fn reach(windows: &[WindowState], k: usize) -> (f64, f64) {
    if windows[k].window.anchor.is_some() {
        return (0.0, f64::INFINITY);
    }
    let ((low, high), (first, last)) = (windows[k].window.m, ends(windows, k));
    (if first { 0.0 } else { low / OVERLAP }, if last { f64::INFINITY } else { high * OVERLAP })
}

/// Returns whether a local model has the lowest and the highest M among those with its radius ratios.
fn ends(windows: &[WindowState], k: usize) -> (bool, bool) {
    let own = &windows[k].window;
    let beside = |other: &&WindowState| other.window.has_shapes_of(own);
    let first = windows[..k].iter().filter(beside).count() == 0;
    (first, windows[k + 1..].iter().filter(beside).count() == 0)
}

/// Trains local model `k` to the end; `None` if it must be split.
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
    // Drawn again after a resume, so that the following random numbers are the same.
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
    // Two seeds from the common sequence; the equations are sampled at the same random points in every round.
    let (search_seed, row_seed) = (rng.u64(..), rng.u64(..));
    state.windows[k].search.begin(search_seed);
    search(&mut work, state, k, row_seed)
}
