//! Rows of a reduced model in time: what the steps of the all-rows model along the trainings show decides which stay.

use super::one_thread::on_one_thread;
use super::rows::{add_goals, rows_by};
use super::trajectories::{TrajectoryTraining, test_space};
use super::{Observer, Progress, TrainingError};
use crate::solver::full::transient::{Keep, MarchProgress, Trajectory, Transient, march};
use crate::solver::reduced::transient::{ReducedMarch, TrajectoryModel};
use crate::solver::reduced::{
    GoalEquations, Iterate, RowSnapshots, SampledRows, Sampling, Scheme, TestSpace, all_rows, is_finite,
};
use fastrand::Rng;
use rayon::prelude::*;
use std::sync::Arc;

/// Iterates that the rows have to satisfy.
const ITERATES: usize = 600;

/// Share of the wanted rows below which a cubature does not carry steps in time: pruning has gone too far.
const SHARE: f64 = 0.85;

/// What one march contributes.
#[derive(Clone)]
struct Evidence {
    goals: GoalEquations,
    rows: RowSnapshots,
}

/// The rows that a training asks for, of a model with all of them; `None` where the linear algebra gives up, or no rule
/// of few rows carries the steps.
pub(super) fn sampled_rows(
    exact: &Arc<TrajectoryModel>,
    sizes: &[f64],
    trajectories: &[Trajectory],
    training: &TrajectoryTraining,
    observer: &dyn Observer,
) -> Result<Option<SampledRows>, TrainingError> {
    let TrajectoryTraining { scheme, sampling, rows_per_mode, .. } = *training;
    let test = test_space(exact.window.pressure.basis(), &exact.window.grid, sizes, scheme);
    if sampling == Sampling::All && scheme == Scheme::Galerkin {
        return Ok(Some(all_rows(&test)));
    }
    let mut seen = Evidence { goals: candidates(exact), rows: RowSnapshots::default() };
    if sampling != Sampling::All {
        for part in evidence(exact, &test, trajectories, training, observer)? {
            seen.goals.merge(&part.goals);
            seen.rows.residual.extend(part.rows.residual);
            seen.rows.jacobian.extend(part.rows.jacobian);
        }
    }
    observer.progress(Progress { stage: "Row sampling".to_owned(), done: 0, total: 1 });
    let target = (test.modes.ncols() as f64 * rows_per_mode).round() as usize;
    let of = (scheme, sampling);
    let sampled =
        on_one_thread(observer, move || rows_by(&test, of, (&seen.rows, &seen.goals), (&[target], SHARE)).pop())?;
    Ok(sampled.flatten().filter(|rows| is_finite(rows.reconstruction.as_ref())))
}

/// Equations with candidate rows: those where something happens, whatever they count.
fn candidates(exact: &TrajectoryModel) -> GoalEquations {
    GoalEquations::over(&TestSpace::new(exact.window.pressure.basis(), &exact.window.grid))
}

/// Marches the all-rows model along the trainings and collects what its iterates demand of a rule, or what they are.
fn evidence(
    exact: &Arc<TrajectoryModel>,
    test: &TestSpace,
    trajectories: &[Trajectory],
    training: &TrajectoryTraining,
    observer: &dyn Observer,
) -> Result<Vec<Evidence>, TrainingError> {
    let none = Evidence { goals: candidates(exact), rows: RowSnapshots::default() };
    let factors = training.scheme.factors(test);
    let scaled = |v: &[f64]| -> Vec<f64> { v.iter().zip(&factors).map(|(v, factor)| v * factor).collect() };
    // About three iterates in a step, of which every n-th is kept.
    let steps: usize = trajectories.iter().map(|t| t.moments.len()).sum();
    let every = (3 * steps).div_ceil(ITERATES).max(1);
    let along = |(index, trajectory): (usize, &Trajectory)| {
        let mut evidence = none.clone();
        let mut rng = Rng::with_seed(training.seed.wrapping_add(index as u64));
        let mut seen = 0;
        let mut model = ReducedMarch::new(exact, &trajectory.transient)?;
        model.observe(Box::new(|iterate: &Iterate<'_>| {
            if seen % every == 0 {
                if training.sampling == Sampling::Cubature {
                    add_goals(&mut evidence.goals, test, iterate, &mut rng);
                } else {
                    evidence.rows.residual.push(scaled(iterate.residual));
                    evidence.rows.jacobian.push(scaled(iterate.jacobian_step));
                }
            }
            seen += 1;
        }));
        let transient = Transient { keep: Keep::Scalars, ..trajectory.transient.clone() };
        let stage = format!("Rows along training {} of {}", index + 1, trajectories.len());
        march(&mut model, &transient, &MarchProgress { observer, stage, duration: transient.duration })?;
        drop(model);
        if observer.cancelled() { Err(TrainingError::Cancelled) } else { Ok(evidence) }
    };
    trajectories.par_iter().enumerate().map(along).collect()
}
