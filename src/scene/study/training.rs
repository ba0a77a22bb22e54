//! Training of a reduced model as a study.

use super::question::{
    Chart, ChartAxis, Checked, Column, Experiment, Findings, Marks, Notice, Question, RunError, Setting, Table, Tell,
};
use crate::host::clock::Stopwatch;
use crate::scene::check::refuse;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::{ReducedModel, Window};
use crate::solver::training::TrainingSpec;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Trained model.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Row {
    /// The model.
    pub model: Arc<ReducedModel>,
    /// Time of the training \[s\]; almost zero if another scene of the run has trained the same model.
    pub wall_s: f64,
}

/// Columns that describe a local model.
const WINDOW: [Column<Window>; 7] = [
    ("m_from", |window| window.m.0),
    ("m_to", |window| window.m.1),
    ("nodes", |window| (window.grid.nodes().0 * window.grid.nodes().1) as f64),
    ("snapshots", |window| window.snapshots.len() as f64),
    ("basis_p", |window| window.size().pressure as f64),
    ("basis_delta", |window| window.size().deformation as f64),
    ("sampled_rows", |window| window.sampled_rows.len() as f64),
];

/// Returns the training with cavitation model, heat and surfaces of the scene.
fn of_scene(spec: &TrainingSpec, experiment: &Experiment) -> TrainingSpec {
    let Lubricant { cavitation, heat, roughness, .. } = experiment.lubricant;
    spec.clone().under(cavitation).heated(heat).on_surfaces(roughness)
}

impl Question for TrainingSpec {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        if self.contact() != experiment.contact {
            let problem = format!(
                "hold grids of {} contacts, but the scene's is a {} contact",
                self.contact().name(),
                experiment.contact.name()
            );
            return Err(refuse("study.windows", problem));
        }
        let spec = of_scene(self, experiment);
        TrainingSpec::check(&spec).map_err(|refused| refused.within("study"))
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let clock = Stopwatch::start();
        let spec = of_scene(self, setting.experiment);
        let model = setting.bench.trained(&spec, setting.observer)?;
        let wall_s = clock.seconds();
        tell(Row { model, wall_s });
        Ok(())
    }

    /// Values: `windows`, `snapshots`, `basis_p`, `basis_delta`, `sampled_rows` (the largest of all local models), and
    /// `training_s`.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        for Row { model, wall_s } in rows {
            let of_windows = |get: fn(&Window) -> f64| model.windows.iter().map(get);
            found.push("training_s", None, *wall_s);
            found.push("windows", None, model.windows.len() as f64);
            for (name, get) in &WINDOW[3..] {
                let value =
                    if *name == "snapshots" { of_windows(*get).sum() } else { of_windows(*get).fold(0.0, f64::max) };
                found.push(*name, None, value);
            }
            found.warnings.extend(model.log.iter().cloned().map(Notice::from));
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let Some(Row { model, .. }) = rows.first() else { return Vec::new() };
        let decay = |(k, window): (usize, &Window)| {
            let mut decay = Table::new(format!("singular_values_{k}"), &["k", "pressure", "deformation"]);
            let (p, d) = (&window.pressure.singular_values(), &window.deformation.singular_values);
            decay.rows.extend((0..p.len().max(d.len())).map(|i| {
                let value = |of: &[f64]| of.get(i).copied().unwrap_or(f64::NAN);
                vec![(i + 1) as f64, value(p), value(d)]
            }));
            decay
        };
        let windows = Table::of("windows", &WINDOW, &model.windows);
        model.windows.iter().enumerate().map(decay).chain([windows]).collect()
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let mut chart = Chart::new("Singular values", ChartAxis::linear("Mode"), ChartAxis::log("σ/σ₁"));
        let windows = rows.iter().flat_map(|row| &row.model.windows);
        for window in windows {
            let (from, to) = window.m;
            for (name, basis) in [("pressure", window.pressure.basis()), ("deformation", &*window.deformation)] {
                let values = &basis.singular_values;
                let first = values.first().copied().unwrap_or(1.0);
                let points = values.iter().enumerate().map(|(i, value)| [(i + 1) as f64, value / first]);
                chart.add(format!("{name}, M {from}…{to}"), Marks::Line, points);
            }
        }
        vec![chart]
    }
}
