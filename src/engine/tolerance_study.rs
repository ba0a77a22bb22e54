//! The adaptive plan cut at each tolerance of its ladder (Fig. 3.6): what every rung costs and what it is worth.
//!
//! One training runs down the whole ladder. What it had solved when a tolerance was met is the training with that tolerance as its last:
//! the search does not look ahead.

use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::parallel::{full_solutions, reduced_solutions};
use super::statistics::{median, percentile};
use super::table::Table;
use crate::scene::{OnlineScheme, QuantityBox, Scene};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::{ErrorMeasures, Norm, Online};
use crate::solver::training::{
    Plan, Range, TrainingObserver, TrainingSpec, TrainingState, Windows, random_points, train_resumable,
};
use std::sync::Arc;
use std::time::Instant;

/// What is cut, and where each cut is tested.
pub(super) struct ToleranceStudy<'a> {
    pub training: TrainingSpec,
    pub range: &'a QuantityBox,
    pub points: usize,
    pub tests: usize,
    pub seed: u64,
    pub online: OnlineScheme,
}

const COLUMNS: [&str; 14] = [
    "tolerance",
    "snapshots",
    "basis_p",
    "basis_delta",
    "degrees_of_freedom",
    "sampled_rows",
    "failures",
    "trajectory_failures",
    "e_z_mean",
    "e_f_I_mean",
    "H_c_error_median",
    "H_c_error_p95",
    "H_c_error_max",
    "online_mean_s",
];

/// Values are named `1e1.snapshots`, with the tolerance of the rung. e_z and e_f^I are Euclidean, means along the trajectory (3.21).
pub(super) fn run(
    scene: &Scene,
    study: &ToleranceStudy<'_>,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let one_window = matches!(&study.training.windows, Windows::Given(windows) if windows.len() == 1);
    let Some(Plan::Adaptive { tolerances, .. }) = Some(&study.training.plan).filter(|_| one_window) else {
        let sentence = "a tolerance study needs a training with an adaptive plan and one window";
        return Err(EngineError::Study(sentence.to_owned()));
    };
    let mut state = TrainingState::new(study.training.clone());
    let model = train_resumable(&mut state, observer)?;
    outcome.warnings.extend(model.log.iter().cloned());
    let grid = model.windows[0].grid.clone();
    let along: Vec<OperatingPoint> = (0..study.points)
        .map(|i| study.range.trajectory(scene.contact, 2.0 * i as f64 / (study.points - 1) as f64))
        .collect();
    let truth = full_solutions(|_| grid.clone(), &along, scene.lubricant, observer)?;
    let points = random_points(&Range::Box(*study.range), scene.contact, study.tests, study.seed);
    let options = study.online.options();
    let mut table = Table::new("tolerances", &COLUMNS);
    let rungs = state.windows[0].search.rungs.clone();
    for (tolerance, solutions) in tolerances.iter().zip(rungs) {
        let mut cut = state.clone();
        // The cut models' errors are measured here, against full solutions.
        cut.spec.evidence = 0;
        cut.windows[0].solved.truncate(solutions);
        let model = Arc::new(cut.model(observer)?);
        let window = &model.windows[0];
        let tested = reduced_solutions(&model, options, &points, scene.lubricant, |_| false, observer)?;
        let failures = tested.iter().filter(|solved| solved.is_none()).count();
        let measures = ErrorMeasures::new(window, &options, Norm::Euclidean);
        let mut online = Online::new(Arc::clone(&model), options);
        let (mut states, mut residuals, mut films, mut seconds) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        if let Some(first) = along.first() {
            online.prepare(first.moes());
        }
        for (point, full) in along.iter().zip(&truth) {
            online.forget();
            let clock = Instant::now();
            let solved = online.solve(point, scene.lubricant);
            seconds.push(clock.elapsed().as_secs_f64());
            if let (Ok(solved), Some(full)) = (solved, full) {
                let fields = online.reconstruct(&solved)?;
                residuals.push(measures.residuals(&solved.coefficients, &fields).sampled_rows);
                states.push(measures.state_error(&fields, full));
                films.push((fields.scalars.h_c / full.scalars.h_c - 1.0).abs());
            }
        }
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let (modes, deformation) = (window.pressure.modes.ncols(), window.deformation.modes.ncols());
        let row = vec![
            *tolerance,
            solutions as f64,
            modes as f64,
            deformation as f64,
            // The dissertation's count of unknowns (p̃, δ̃, H₀); online, modes + 1 of them are iterated on.
            (modes + deformation + 1) as f64,
            window.sampled_rows.len() as f64,
            failures as f64,
            (truth.iter().flatten().count() - films.len()) as f64,
            mean(&states),
            mean(&residuals),
            median(&films),
            percentile(&films, 0.95),
            percentile(&films, 1.0),
            mean(&seconds),
        ];
        for (column, value) in COLUMNS.iter().zip(&row).skip(1) {
            outcome.push(format!("{tolerance:e}.{column}"), None, *value);
        }
        table.rows.push(row);
    }
    outcome.push("rungs_met", None, table.rows.len() as f64);
    outcome.push("tests", None, points.len() as f64);
    outcome.push("full_failures", None, truth.iter().filter(|full| full.is_none()).count() as f64);
    outcome.tables.push(table);
    Ok(())
}
