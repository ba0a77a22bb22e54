//! Training of a transient reduced model. The bases are built from full trajectories. The equations are sampled by a
//! cubature of the steps that the model with all rows takes along the same inputs. Both account for the sensitivity
//! of each row to its pressure.

use super::check;
use super::error::TrainingError;
use super::local_bases::{LocalBases, local_bases};
use super::one_thread::on_one_thread;
use super::trajectory_rows::sampled_rows;
use crate::solver::discrete::grid::{ContactGrid, FIRST_UNKNOWN, ReferenceGrid};
use crate::solver::discrete::reynolds::PENALTY;
use crate::solver::full::transient::{Frame, State, Trajectory, Transient};
use crate::solver::observer::{Observer, Progress};
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::transient::{TrajectoryDomain, TrajectoryModel, TrajectoryStart};
use crate::solver::reduced::{
    PodBasis, PressureModes, Sampling, Scheme, Snapshot, TestSpace, Window, all_rows, deformation_weights, fronts,
    mean_diagonals,
};
use faer::Mat;
use std::sync::Arc;

/// Settings of a transient training.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrajectoryTraining {
    /// Loss of information of both bases, (2.90).
    pub loss: f64,
    /// Number of sampled equations per pressure mode.
    pub rows_per_mode: f64,
    /// Seed of the cubature's random functionals.
    pub seed: u64,
    /// Scheme that determines a step.
    pub scheme: Scheme,
    /// Sampling method; residual minimisation does not support the cubature.
    pub sampling: Sampling,
    /// Local bases instead of one basis for all states.
    pub local: Option<LocalBases>,
}

impl Default for TrajectoryTraining {
    /// Loss of 1e-6, two rows per mode, Galerkin's scheme with a cubature.
    fn default() -> Self {
        let (scheme, sampling) = (Scheme::Galerkin, Sampling::Cubature);
        Self { loss: 1e-6, rows_per_mode: 2.0, seed: 1, scheme, sampling, local: None }
    }
}

/// Message: requirements on the trajectories.
const NONE: &str = "a training needs trajectories of one frame on one unregistered grid that stored their fields, each \
                    with at least its start";
/// Message: requirements on their cavitation models.
const RUPTURE: &str = "a transient training needs trajectories that all have cavitation by the penalty or all by \
                       complementarity; only full transient solutions support mass-conserving cavitation";
/// Message: requirements on their lubricants.
const LUBRICANT: &str =
    "a transient training needs trajectories of one lubricant, with one viscosity at ambient pressure";
/// Message: advice for trajectories that are not sufficient.
const DEGENERATE: &str = "the trajectories could not be decomposed, or their steps need too many sampled equations; try a \
                          larger loss of information or more rows per mode";
/// Maximum number of states for the bases; of longer trajectories every n-th state is used.
const MOST_SNAPSHOTS: usize = 900;

/// Trains a model of one frame from full trajectories with stored states.
///
/// # Errors
/// [`TrainingError`] if the trajectories have no states or are of different frames or grids, if the linear algebra
/// fails, or if the observer cancels.
pub fn train_trajectories(
    grid: &Arc<ReferenceGrid>,
    trajectories: &[Trajectory],
    training: &TrajectoryTraining,
    observer: &dyn Observer,
) -> Result<TrajectoryModel, TrainingError> {
    let frame = trajectories.first().ok_or(TrainingError::Trajectories(NONE))?.transient.frame;
    let length = grid.xi.len();
    let of_one_kind = |t: &Trajectory| {
        t.transient.frame == frame && !t.states.is_empty() && t.x == grid.xi && t.states[0].pressure.len() == length
    };
    if !trajectories.iter().all(of_one_kind) {
        return Err(TrainingError::Trajectories(NONE));
    }
    let law = |t: &Trajectory| t.problem.lubricant.cavitation;
    let cavitation = law(&trajectories[0]);
    if !trajectories.iter().all(|t| law(t) == cavitation) || matches!(cavitation, Cavitation::MassConserving { .. }) {
        return Err(TrainingError::Trajectories(RUPTURE));
    }
    let oil = |t: &Trajectory| (t.problem.lubricant, t.problem.point.viscosity_pa_s);
    if !trajectories.iter().all(|t| oil(t) == oil(&trajectories[0])) {
        return Err(TrainingError::Trajectories(LUBRICANT));
    }
    check::scheme(training.scheme, training.sampling, training.rows_per_mode)?;
    // There are no rows behind a cavitation boundary.
    let penalty = if cavitation == Cavitation::Penalty { PENALTY } else { 0.0 };
    let sizes = mean_diagonals(&grid.scaled(1.0), &trajectories.iter().collect::<Vec<_>>(), penalty);
    let mut exact = bases(grid, trajectories, (&sizes, training), frame, observer)?;
    if let Some(wanted) = training.local {
        let (emphasis, contact) = (emphasis(grid, &sizes), exact.window.grid.clone());
        let test = |basis: &PodBasis| test_space(basis, &contact, &sizes, training.scheme);
        let locals = local_bases(&exact, trajectories, (&emphasis, training.loss), wanted, test);
        exact.locals = locals.ok_or(TrainingError::Trajectories(DEGENERATE))?;
    }
    let exact = Arc::new(exact);
    let sampled = sampled_rows(&exact, &sizes, trajectories, training, observer)?;
    let mut model = Arc::unwrap_or_clone(exact);
    let serving: Vec<&mut Window> = if model.locals.is_empty() {
        vec![&mut model.window]
    } else {
        model.locals.iter_mut().map(|local| &mut local.window).collect()
    };
    for (window, rows) in serving.into_iter().zip(sampled) {
        match rows {
            Some(rows) => window.set_rows(training.sampling, rows),
            // A basis in which few steps were taken keeps all its rows.
            None if training.local.is_some() => {}
            None => return Err(TrainingError::Trajectories(DEGENERATE)),
        }
    }
    Ok(model)
}

/// Returns the test space: V, with each row weighted by its cell size divided by the fourth root of the row's own
/// size. Together with the weights of [`emphasis`] for the modes, this balances rows and modes. The rows in the far
/// inlet and at the nodes that the cavitation boundary passes are up to 10⁸ times as sensitive as those in the
/// contact. Without the weights, small errors of the modes there would dominate the film thickness. Residual
/// minimisation uses the weights D of (D.10) only; both together would give much larger errors.
pub(super) fn test_space(basis: &PodBasis, grid: &ContactGrid, sizes: &[f64], scheme: Scheme) -> TestSpace {
    let mut test = TestSpace::new(basis, grid);
    if scheme == Scheme::Galerkin {
        test.weights.iter_mut().zip(sizes).for_each(|(weight, size)| *weight /= size.sqrt().sqrt());
    }
    test
}

/// Returns the weights for the selection of modes: cell sizes times the square root of the rows' sizes.
fn emphasis(grid: &ReferenceGrid, sizes: &[f64]) -> Vec<f64> {
    let mut weights = grid.weights.clone();
    let unknowns = weights[FIRST_UNKNOWN..].iter_mut();
    unknowns.zip(sizes).for_each(|(weight, size)| *weight *= size.sqrt());
    weights
}

/// Builds the model with all rows, whose sizes are given.
fn bases(
    grid: &Arc<ReferenceGrid>,
    trajectories: &[Trajectory],
    (sizes, training): (&[f64], &TrajectoryTraining),
    frame: Frame,
    observer: &dyn Observer,
) -> Result<TrajectoryModel, TrainingError> {
    observer.progress(Progress { stage: "Bases".to_owned(), done: 0, total: 1 });
    let states: usize = trajectories.iter().map(|t| t.states.len()).sum();
    let every = states.div_ceil(MOST_SNAPSHOTS);
    let chosen: Vec<&[f64]> =
        trajectories.iter().flat_map(|t| t.states.iter().step_by(every)).map(|s| s.pressure.as_slice()).collect();
    let pressures = Mat::from_fn(grid.xi.len(), chosen.len(), |i, j| chosen[j][i]);
    let (contact, loss) = (ContactGrid::Line(Arc::clone(grid)), training.loss);
    let (weights, emphasis) = (grid.weights.clone(), emphasis(grid, sizes));
    let (pressure, deformation) = on_one_thread(observer, {
        let contact = contact.clone();
        move || {
            let pressure = PodBasis::emphasised(pressures.as_ref(), &weights, &emphasis, (loss, usize::MAX));
            let deformations = contact.flex(&pressures);
            let deformation = PodBasis::new(deformations.as_ref(), &deformation_weights(&contact), loss);
            (pressure, deformation)
        }
    })?;
    let pressure = pressure.ok_or(TrainingError::Trajectories(DEGENERATE))?;
    let deformation = deformation.ok_or(TrainingError::Trajectories(DEGENERATE))?;
    let cavitation = trajectories.first().map(|t| t.problem.lubricant.cavitation).unwrap_or_default();
    let ruptures = cavitation == Cavitation::Complementarity;
    let starts = trajectories
        .iter()
        .filter_map(|t| {
            let state = t.states.first()?;
            let coefficients = pressure.coefficients(&grid.weights, |i| state.pressure[i]);
            let fronts = if ruptures { fronts(&contact, |node| state.pressure[node]) } else { Vec::new() };
            let Transient { point, inputs, .. } = &t.transient;
            let duration = t.moments.last().map_or(0.0, |moment| moment.time);
            Some(TrajectoryStart {
                point: *point,
                inputs: inputs.clone(),
                duration,
                coefficients,
                h_0: state.h_0,
                fronts,
            })
        })
        .collect();
    let rows = all_rows(&test_space(&pressure, &contact, sizes, Scheme::Galerkin));
    let boundaries = if ruptures {
        let states = trajectories.iter().flat_map(|t| t.states.iter().map(move |state| (t, state)));
        boundaries(states, &contact, &pressure)
    } else {
        Vec::new()
    };
    let pressure = PressureModes::own(pressure, &contact);
    let mut window = Window::new((0.0, f64::INFINITY), contact, pressure, deformation, boundaries, Sampling::All, rows);
    (window.penalty, window.cavitation) = (PENALTY, cavitation);
    let domain = TrajectoryDomain::of(trajectories).ok_or(TrainingError::Trajectories(NONE))?;
    let (title, scene, locals, log) = (String::new(), String::new(), Vec::new(), Vec::new());
    Ok(TrajectoryModel { title, frame, window, locals, starts, domain, scene, log })
}

/// Returns one state for each position of the cavitation boundary along trajectories.
pub(super) fn boundaries<'a>(
    states: impl Iterator<Item = (&'a Trajectory, &'a State)>,
    grid: &ContactGrid,
    basis: &PodBasis,
) -> Vec<Snapshot> {
    let mut seen: Vec<Snapshot> = Vec::new();
    for (t, state) in states {
        let fronts = fronts(grid, |node| state.pressure[node]);
        if seen.iter().all(|other| other.fronts != fronts) {
            let coefficients = basis.coefficients(grid.weights(), |i| state.pressure[i]);
            seen.push(Snapshot {
                point: t.transient.point,
                coefficients,
                h_0: state.h_0,
                h_c: state.h_0,
                fronts,
                grid_cost: None,
            });
        }
    }
    seen
}
