//! Training a reduced model and saying what came of it.

use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::table::Table;
use crate::solver::reduced::ReducedModel;
use crate::solver::training::{TrainingObserver, TrainingSpec, train};
use std::time::Instant;

/// Trains and reports. Values: `windows`, `snapshots`, `basis_p`, `basis_delta`, `sampled_rows` (the largest of all windows), `training_s`.
pub(super) fn run(
    spec: &TrainingSpec,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let clock = Instant::now();
    let model = train(spec, observer)?;
    outcome.push("training_s", None, clock.elapsed().as_secs_f64());
    describe(&model, outcome);
    Ok(())
}

fn describe(model: &ReducedModel, outcome: &mut SceneOutcome) {
    let mut table =
        Table::new("windows", &["m_from", "m_to", "nodes", "snapshots", "basis_p", "basis_delta", "sampled_rows"]);
    for window in &model.windows {
        let (nx, ny) = window.grid.nodes();
        table.rows.push(vec![
            window.m.0,
            window.m.1,
            (nx * ny) as f64,
            window.snapshots.len() as f64,
            window.pressure.modes.ncols() as f64,
            window.deformation.modes.ncols() as f64,
            window.sampled_rows.len() as f64,
        ]);
    }
    let largest = |k: usize| table.rows.iter().map(|row| row[k]).fold(0.0, f64::max);
    outcome.push("windows", None, model.windows.len() as f64);
    outcome.push("snapshots", None, table.rows.iter().map(|row| row[3]).sum());
    for (name, k) in [("basis_p", 4), ("basis_delta", 5), ("sampled_rows", 6)] {
        outcome.push(name, None, largest(k));
    }
    for (k, window) in model.windows.iter().enumerate() {
        let mut decay = Table::new(format!("singular_values_{k}"), &["k", "pressure", "deformation"]);
        let (p, d) = (&window.pressure.singular_values, &window.deformation.singular_values);
        decay.rows.extend((0..p.len().max(d.len())).map(|i| {
            let value = |of: &[f64]| of.get(i).copied().unwrap_or(f64::NAN);
            vec![(i + 1) as f64, value(p), value(d)]
        }));
        outcome.tables.push(decay);
    }
    outcome.warnings.extend(model.log.iter().cloned());
    outcome.tables.push(table);
}
