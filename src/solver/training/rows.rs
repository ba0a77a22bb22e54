//! Row sampling of a window: the all-rows reduced model runs at random parameters, and what its iterates show decides which rows stay.

use super::aside::aside;
use super::plan::random_points;
use super::{Progress, TrainingError, TrainingObserver, TrainingSpec};
use crate::solver::contact::OperatingPoint;
use crate::solver::grid::FIRST_UNKNOWN;
use crate::solver::reduced::{
    GoalEquations, Iterate, Online, ReducedModel, ReducedOptions, RowSnapshots, SampledRows, Sampling, Window,
    all_rows, cubature, greedy, interpolation_at_zero, is_finite, q_deim,
};
use faer::linalg::matmul::matmul;
use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Accum, Mat, Par};
use fastrand::Rng;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Random parameters at which iterates are collected (reduced solves only).
const ROW_SNAPSHOT_SOLVES: usize = 160;
/// Steps smaller than this are demanded to be right absolutely, larger ones relatively (`NUMERICS` 5.4, step 3).
const STEP_FLOOR: f64 = 0.03;
/// Random functionals of Δp̃ per iterate, beside the one of ΔH_c.
const RANDOM_FUNCTIONALS: usize = 6;

/// What one reduced solve contributes.
enum Evidence {
    Snapshots(RowSnapshots),
    Goals(GoalEquations),
}

/// Runs `exact` (the window alone, with all rows) at random parameters, collects every iterate, and samples. `None` when the linear algebra
/// gives up.
///
/// # Errors
/// When the observer cancels.
pub(super) fn sample_rows(
    spec: &TrainingSpec,
    exact: &Arc<ReducedModel>,
    reach: (f64, f64),
    rng: &mut Rng,
    observer: &dyn TrainingObserver,
) -> Result<Option<SampledRows>, TrainingError> {
    let Some(window) = exact.windows.first() else { return Ok(None) };
    let points = random_points(&spec.range, reach, ROW_SNAPSHOT_SOLVES, rng);
    let stage = format!("Row snapshots, M {}…{}", window.m.0, window.m.1);
    let done = AtomicUsize::new(0);
    let collected: Vec<Evidence> = points
        .par_iter()
        .enumerate()
        .map_init(
            || Online::new(Arc::clone(exact), ReducedOptions::default()),
            |online, (index, point)| {
                if observer.cancelled() {
                    return Err(TrainingError::Cancelled);
                }
                let evidence = match spec.sampling {
                    Sampling::Cubature => {
                        let mut rng = Rng::with_seed(spec.seed.wrapping_add(index as u64));
                        Evidence::Goals(goals(spec, online, window, point, &mut rng))
                    }
                    _ => Evidence::Snapshots(snapshots(spec, online, window, point)),
                };
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                observer.progress(Progress { stage: stage.clone(), done, total: points.len() });
                Ok(evidence)
            },
        )
        .collect::<Result<_, _>>()?;
    observer.progress(Progress { stage: "Row sampling".to_owned(), done: 0, total: 1 });
    let (exact, sampling, rows_per_mode) = (Arc::clone(exact), spec.sampling, spec.rows_per_mode);
    aside(observer, move || {
        let sampled = choose(exact.windows.first()?, sampling, rows_per_mode, collected);
        sampled.filter(|s| is_finite(s.reconstruction.as_ref()))
    })
}

/// The rows that all evidence together speaks for.
fn choose(window: &Window, sampling: Sampling, rows_per_mode: f64, collected: Vec<Evidence>) -> Option<SampledRows> {
    let unknowns = window.grid.xi.len() - 3;
    let mut rows = RowSnapshots::default();
    let mut equations = GoalEquations::new(unknowns);
    for part in collected {
        match part {
            Evidence::Snapshots(part) => {
                rows.residual.extend(part.residual);
                rows.jacobian.extend(part.jacobian);
            }
            Evidence::Goals(part) => equations.merge(&part),
        }
    }
    let count = ((window.pressure.modes.ncols() as f64 * rows_per_mode).round() as usize).min(unknowns);
    let (basis, weights) = (&window.pressure, &window.grid.weights);
    match sampling {
        Sampling::QDeim => q_deim(basis, weights, &rows, count),
        Sampling::Greedy => greedy(basis, weights, &rows, count),
        Sampling::Cubature => cubature(basis, weights, &equations, count),
        Sampling::All => Some(all_rows(basis, weights)),
    }
}

/// Residual and Jacobian snapshots of one solve, scaled by √w and by the largest of them. Empty when it diverges: that teaches nothing about the
/// rows a good iteration meets.
fn snapshots(spec: &TrainingSpec, online: &mut Online, window: &Window, point: &OperatingPoint) -> RowSnapshots {
    let weights = &window.grid.weights;
    let scaled =
        |v: &[f64]| -> Vec<f64> { v.iter().zip(&weights[FIRST_UNKNOWN..]).map(|(v, w)| v * w.sqrt()).collect() };
    let mut rows = RowSnapshots::default();
    let mut keep = |iterate: &Iterate<'_>| {
        rows.residual.push(scaled(iterate.residual));
        rows.jacobian.push(scaled(iterate.jacobian_step));
    };
    online.forget();
    if online.solve_observed(point, spec.lubricant, Some(&mut keep)).is_err() {
        return RowSnapshots::default();
    }
    normalise(&mut rows.residual);
    normalise(&mut rows.jacobian);
    rows
}

/// Scales the snapshots of one solve by the largest of them.
fn normalise(snapshots: &mut [Vec<f64>]) {
    let norm = |v: &Vec<f64>| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let largest = snapshots.iter().map(norm).fold(0.0, f64::max);
    if largest > 0.0 {
        for v in snapshots.iter_mut().flatten() {
            *v /= largest;
        }
    }
}

/// The goal equations of every iterate of one solve; none when it diverges.
fn goals(
    spec: &TrainingSpec,
    online: &mut Online,
    window: &Window,
    point: &OperatingPoint,
    rng: &mut Rng,
) -> GoalEquations {
    let unknowns = window.grid.xi.len() - 3;
    let mut equations = GoalEquations::new(unknowns);
    let mut keep = |iterate: &Iterate<'_>| {
        if let Some(block) = goal_block(window, iterate, rng) {
            equations.add(&block);
        }
    };
    online.forget();
    if online.solve_observed(point, spec.lubricant, Some(&mut keep)).is_err() {
        return GoalEquations::new(unknowns);
    }
    equations
}

/// Functionals of the step, each for f and for J V Δz̃.
fn goal_block(window: &Window, iterate: &Iterate<'_>, rng: &mut Rng) -> Option<Mat<f64>> {
    let modes = iterate.coefficients.len();
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let size = length(iterate.coefficients);
    // The row that turns (Δp̃, ΔH₀) into ΔH_c, and H_c itself.
    let zero = interpolation_at_zero(window, iterate.scale);
    let lift: Vec<f64> = (0..modes)
        .map(|k| iterate.scale * zero.iter().map(|(node, w)| w * window.flexed[(*node, k)]).sum::<f64>())
        .collect();
    let h_c =
        iterate.h_0 - 0.5 * iterate.scale.ln() + lift.iter().zip(iterate.coefficients).map(|(l, c)| l * c).sum::<f64>();
    let (step, dh_0) = iterate.step.split_at(modes);
    let film_step = (dh_0.first()? + lift.iter().zip(step).map(|(l, d)| l * d).sum::<f64>()) / h_c;
    let change = 5.0 * length(step) / size + film_step.abs();
    if !(h_c > 0.0 && change.is_finite() && change > 0.0) {
        return None;
    }
    let mut gauss = || (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (2.0 * PI * rng.f64()).cos();
    // Lᵀ: random functionals of Δp̃, then the one of ΔH_c.
    let count = RANDOM_FUNCTIONALS + 1;
    let functionals = Mat::from_fn(modes + 1, count, |row, column| match (column < RANDOM_FUNCTIONALS, row == modes) {
        (false, true) => 1.0 / h_c,
        (false, false) => lift[row] / h_c,
        (true, true) => 0.0,
        (true, false) => 5.0 * gauss() / size,
    });
    let goals = PartialPivLu::new(iterate.jacobian.transpose()).solve(&functionals);
    let share = 1.0 / (count as f64).sqrt();
    let (first, second) = (share / change.max(STEP_FLOOR), share / change);
    let weights = &window.grid.weights;
    // (T V_i) w_i for every row, then times f_i or (J V Δz̃)_i.
    // On one thread, so that rounding does not depend on how many there are.
    let mut tested = Mat::<f64>::zeros(window.pressure.modes.nrows(), count);
    matmul(tested.as_mut(), Accum::Replace, window.pressure.modes.as_ref(), goals.get(..modes, ..), 1.0, Par::Seq);
    Some(Mat::from_fn(2 * count, iterate.residual.len(), |equation, i| {
        let node = i + FIRST_UNKNOWN;
        let test = tested[(node, equation % count)] * weights[node];
        if equation < count { first * test * iterate.residual[i] } else { second * test * iterate.jacobian_step[i] }
    }))
}
