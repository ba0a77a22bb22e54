//! Ways of sampling rows side by side: one set of full solutions, one basis, the same random tests.

use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::parallel::{full_solutions, reduced_solutions};
use super::statistics::median;
use super::table::Table;
use crate::scene::{ComparedSampling, QuantityBox, Scene};
use crate::solver::reduced::ReducedOptions;
use crate::solver::training::{
    Range, TrainingObserver, TrainingSpec, TrainingState, Windows, random_points, train_resumable,
};
use std::sync::Arc;

/// What is sampled how, and where each way is tested.
pub(super) struct SamplingStudy<'a> {
    pub training: TrainingSpec,
    pub samplings: &'a [ComparedSampling],
    pub range: &'a QuantityBox,
    pub tests: usize,
    pub seed: u64,
    pub compare: usize,
}

const COLUMNS: [&str; 6] = ["rows", "penalty", "tests", "failures", "failures_compared", "newton_median"];

/// Values are named `Cubature.failures`, with the name of the sampling: `rows`, `failures` among the tests, `newton_median`, and the
/// errors of H_c and H_min at the first `compare` of them.
pub(super) fn run(
    scene: &Scene,
    study: &SamplingStudy<'_>,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let Windows::Given(windows) = &study.training.windows else { return Err(one_window()) };
    if windows.len() != 1 {
        return Err(one_window());
    }
    // Errors are measured here, against full solutions.
    let mut state = TrainingState::new(TrainingSpec { evidence: 0, ..study.training.clone() });
    let trained = train_resumable(&mut state, observer)?;
    outcome.push("snapshots", None, state.solutions() as f64);
    outcome.push("basis_p", None, trained.windows[0].pressure.modes.ncols() as f64);
    let grid = trained.windows[0].grid.clone();
    let points = random_points(&Range::Box(*study.range), scene.contact, study.tests, study.seed);
    let truth = full_solutions(|_| grid.clone(), &points[..study.compare], scene.lubricant, observer)?;
    let mut table = Table::new("samplings", &COLUMNS);
    for way in study.samplings {
        (state.spec.sampling, state.spec.rows_per_mode) = (way.sampling, way.rows_per_mode);
        state.spec.penalty = way.penalty;
        let model = Arc::new(state.model(observer)?);
        let fields = |i: usize| i < study.compare;
        let tested = reduced_solutions(&model, ReducedOptions::default(), &points, scene.lubricant, fields, observer)?;
        let failures = |tested: &[Option<_>]| tested.iter().filter(|solved| solved.is_none()).count() as f64;
        let newton: Vec<f64> = tested.iter().flatten().map(|reduced| reduced.solved.iterations as f64).collect();
        let mut errors: [Vec<f64>; 2] = Default::default();
        for (reduced, full) in tested.iter().zip(&truth) {
            let (Some(fields), Some(full)) = (reduced.as_ref().and_then(|r| r.fields.as_ref()), full) else { continue };
            let (reduced, full) = (fields.scalars, full.scalars);
            errors[0].push((reduced.h_c / full.h_c - 1.0).abs());
            errors[1].push((reduced.h_min / full.h_min - 1.0).abs());
        }
        let (name, rows) = (&way.name, model.windows[0].sampled_rows.len() as f64);
        let among = failures(&tested[..study.compare]);
        table.rows.push(vec![rows, way.penalty, points.len() as f64, failures(&tested), among, median(&newton)]);
        outcome.push(format!("{name}.rows"), None, rows);
        outcome.push(format!("{name}.failures"), None, failures(&tested));
        outcome.push(format!("{name}.newton_median"), None, median(&newton));
        outcome.push_spread(&format!("{name}.H_c_error"), &errors[0]);
        outcome.push_spread(&format!("{name}.H_min_error"), &errors[1]);
    }
    outcome.tables.push(table);
    Ok(())
}

fn one_window() -> EngineError {
    EngineError::Study("a comparison of samplings needs a training with one given window".to_owned())
}
