//! Sampled equations of a transient reduced model, selected by the steps that the model with all rows takes along the
//! training trajectories.

use super::error::TrainingError;
use super::one_thread::on_one_thread;
use super::rows::{add_goals, rows_by};
use super::trajectories::{TrajectoryTraining, test_space};
use crate::host::pool::on_all_cores;
use crate::solver::full::transient::{Keep, MarchProgress, Trajectory, Transient, march};
use crate::solver::observer::{Observer, Progress};
use crate::solver::reduced::transient::{ReducedMarch, TrajectoryModel};
use crate::solver::reduced::{
    GoalEquations, Iterate, RowSnapshots, SampledRows, Sampling, Scheme, TestSpace, Window, all_rows, is_finite,
};
use fastrand::Rng;
use rayon::prelude::*;
use std::sync::Arc;

/// Number of iterates for the sampling of one basis, and of each local one.
const ITERATES: usize = 600;
const LOCAL_ITERATES: usize = 300;

/// Contribution of one march.
#[derive(Clone)]
struct Evidence {
    goals: GoalEquations,
    rows: RowSnapshots,
}

/// Samples the equations of each basis of a model with all rows. An entry is `None` if the linear algebra fails, or
/// if no rule of few rows reproduces the steps.
pub(super) fn sampled_rows(
    exact: &Arc<TrajectoryModel>,
    sizes: &[f64],
    trajectories: &[Trajectory],
    training: &TrajectoryTraining,
    observer: &dyn Observer,
) -> Result<Vec<Option<SampledRows>>, TrainingError> {
    let TrajectoryTraining { scheme, sampling, rows_per_mode, .. } = *training;
    let space = |window: &Window| test_space(window.pressure.basis(), &window.grid, sizes, scheme);
    let tests: Vec<TestSpace> = exact.serving().map(space).collect();
    if sampling == Sampling::All && scheme == Scheme::Galerkin {
        return Ok(tests.iter().map(|test| Some(all_rows(test))).collect());
    }
    let mut seen = no_evidence(exact);
    if sampling != Sampling::All {
        for part in evidence(exact, &tests, trajectories, training, observer)?.into_iter().flatten().enumerate() {
            let (of, part) = (part.0 % seen.len(), part.1);
            seen[of].goals.merge(&part.goals);
            seen[of].rows.residual.extend(part.rows.residual);
            seen[of].rows.jacobian.extend(part.rows.jacobian);
        }
    }
    let total = tests.len();
    let sample = |(done, (test, seen)): (usize, (TestSpace, Evidence))| {
        observer.progress(Progress { stage: "Row sampling".to_owned(), done, total });
        let target = (test.modes.ncols() as f64 * rows_per_mode).round() as usize;
        let of = (scheme, sampling);
        let sampled = on_one_thread(observer, move || rows_by(&test, of, (&seen.rows, &seen.goals), &[target]).pop())?;
        Ok(sampled.flatten().filter(|rows| is_finite(rows.reconstruction.as_ref())))
    };
    tests.into_iter().zip(seen).enumerate().map(sample).collect()
}

/// Returns empty evidence for each basis. Candidates are the rows that matter, whatever their weight.
fn no_evidence(exact: &TrajectoryModel) -> Vec<Evidence> {
    let goals = |window: &Window| GoalEquations::over(&TestSpace::new(window.pressure.basis(), &window.grid));
    exact.serving().map(|window| Evidence { goals: goals(window), rows: RowSnapshots::default() }).collect()
}

/// Marches the model with all rows along the training trajectories and collects goal equations or snapshots from its
/// iterates. Returns the evidence of each trajectory for each basis.
fn evidence(
    exact: &Arc<TrajectoryModel>,
    tests: &[TestSpace],
    trajectories: &[Trajectory],
    training: &TrajectoryTraining,
    observer: &dyn Observer,
) -> Result<Vec<Vec<Evidence>>, TrainingError> {
    let none = no_evidence(exact);
    let factors: Vec<Vec<f64>> = tests.iter().map(|test| training.scheme.factors(test)).collect();
    let scaled = |v: &[f64], factors: &[f64]| -> Vec<f64> { v.iter().zip(factors).map(|(v, by)| v * by).collect() };
    // About three iterates per step, of which every n-th is kept.
    let steps: usize = trajectories.iter().map(|t| t.moments.len()).sum();
    let wanted = if exact.locals.is_empty() { ITERATES } else { LOCAL_ITERATES * exact.locals.len() };
    let every = (3 * steps).div_ceil(wanted).max(1);
    let along = |(index, trajectory): (usize, &Trajectory)| {
        let mut evidence = none.clone();
        let mut rng = Rng::with_seed(training.seed.wrapping_add(index as u64));
        let mut seen = 0;
        let mut model = ReducedMarch::new(exact, &trajectory.transient)?;
        model.observe(Box::new(|number, iterate: &Iterate<'_>| {
            // The whole basis keeps all rows if there are local ones.
            let of = if exact.locals.is_empty() { Some(number) } else { number.checked_sub(1) };
            if let (Some(of), 0) = (of, seen % every) {
                let Evidence { goals, rows } = &mut evidence[of];
                if training.sampling == Sampling::Cubature {
                    add_goals(goals, &tests[of], iterate, &mut rng);
                } else {
                    rows.residual.push(scaled(iterate.residual, &factors[of]));
                    rows.jacobian.push(scaled(iterate.jacobian_step, &factors[of]));
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
    on_all_cores(|| trajectories.par_iter().enumerate().map(along).collect())
}
