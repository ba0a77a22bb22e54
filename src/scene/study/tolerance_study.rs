//! Tolerance study: adaptive training evaluated at each tolerance of its ladder (Fig. 3.6).
//!
//! One training covers the whole ladder. The snapshots it had when a tolerance was reached are those of a training that
//! ends at this tolerance, because the search does not depend on later tolerances.

use super::error_measures::OnlineScheme;
use super::path::trajectory_points;
use super::question::{
    Chart, ChartAxis, Checked, Column, Experiment, Findings, Marks, Notice, Question, RunError, Setting, Table, Tell,
};
use crate::host::clock::Stopwatch;
use crate::scene::check::{self, MAX_COMPARED, MAX_TESTS, count};
use crate::scene::parallel::{full_solutions, reduced_solutions};
use crate::scene::random_points::all_random_points;
use crate::scene::statistics::{mean, median, percentile};
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::{ErrorMeasures, ModelSize, Norm, Online};
use crate::solver::training::{Plan, TrainingState, Windows, train_resumable};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::sync::Arc;

/// Adaptive training evaluated at each tolerance of its ladder (Fig. 3.6).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ToleranceStudy {
    /// Scene of the training; relative paths refer to this scene's folder.
    pub training: PathBuf,
    /// Range of the random tests (3.17) and of the trajectory (3.21).
    pub range: ParameterSpace,
    /// Number of points along the trajectory, each with a full solution.
    pub points: usize,
    /// Number of random tests per tolerance.
    pub tests: usize,
    /// Seed of the random tests.
    pub seed: u64,
    /// Online scheme.
    #[serde(default)]
    pub online: OnlineScheme,
}

/// Row of the study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Row {
    /// Common data of all tolerances.
    Trained {
        /// Log of the training.
        log: Vec<String>,
        /// Number of full solutions along the trajectory that failed.
        full_failures: usize,
    },
    /// Result for one tolerance.
    Rung(Rung),
}

/// Training up to one tolerance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rung {
    /// Tolerance that was reached.
    pub tolerance: f64,
    /// Number of full solutions up to this tolerance.
    pub snapshots: usize,
    /// Size of the model.
    pub size: ModelSize,
    /// Number of random tests that failed.
    pub failures: usize,
    /// Results along the trajectory.
    pub along: Along,
}

/// Results of a model along the trajectory (3.21).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Along {
    /// Number of contacts with a full but no reduced solution.
    pub failures: usize,
    /// State errors e_z.
    pub states: Vec<f64>,
    /// Residuals e_f^I.
    pub residuals: Vec<f64>,
    /// Errors |H̃_c/H_c − 1|.
    pub films: Vec<f64>,
    /// Times of the reduced solves \[s\].
    pub seconds: Vec<f64>,
}

const COLUMNS: [Column<Rung>; 14] = [
    ("tolerance", |rung| rung.tolerance),
    ("snapshots", |rung| rung.snapshots as f64),
    ("basis_p", |rung| rung.size.pressure as f64),
    ("basis_delta", |rung| rung.size.deformation as f64),
    // Unknowns as counted in the dissertation (p̃, δ̃, H₀). The online solver iterates on modes + 1 of them.
    ("degrees_of_freedom", |rung| (rung.size.pressure + rung.size.deformation + 1) as f64),
    ("sampled_rows", |rung| rung.size.rows as f64),
    ("failures", |rung| rung.failures as f64),
    ("trajectory_failures", |rung| rung.along.failures as f64),
    ("e_z_mean", |rung| mean(&rung.along.states)),
    ("e_f_I_mean", |rung| mean(&rung.along.residuals)),
    ("H_c_error_median", |rung| median(&rung.along.films)),
    ("H_c_error_p95", |rung| percentile(&rung.along.films, 0.95)),
    ("H_c_error_max", |rung| percentile(&rung.along.films, 1.0)),
    ("online_mean_s", |rung| mean(&rung.along.seconds)),
];

impl Question for ToleranceStudy {
    type Row = Row;

    fn check(&self, _experiment: &Experiment) -> Checked {
        count("study.points", self.points, 2, MAX_COMPARED)?;
        count("study.tests", self.tests, 1, MAX_TESTS)?;
        check::space("study.range", &self.range)
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let training = setting.bench.training(&self.training)?;
        let one_window = matches!(&training.windows, Windows::Given(windows) if windows.len() == 1);
        let Some(Plan::Adaptive { tolerances, .. }) = Some(&training.plan).filter(|_| one_window) else {
            let sentence = "a tolerance study needs a training with an adaptive plan and one window";
            return Err(RunError::Study(sentence.to_owned()));
        };
        let mut state = TrainingState::new(training.clone());
        let model = train_resumable(&mut state, observer)?;
        let grid = model.windows[0].grid.clone();
        let along: Vec<OperatingPoint> =
            trajectory_points(&self.range, experiment, self.points).into_iter().map(|(_, point)| point).collect();
        let truth = full_solutions(|_| grid.clone(), &along, experiment.lubricant, observer)?;
        let full_failures = truth.iter().filter(|full| full.is_none()).count();
        tell(Row::Trained { log: model.log, full_failures });
        let points = all_random_points(&self.range, experiment.contact, self.tests, self.seed, observer)?;
        let options = self.online.options();
        let rungs = state.windows[0].search.rungs.clone();
        for (tolerance, solutions) in tolerances.iter().zip(rungs) {
            let mut cut = state.clone();
            // The study measures errors itself, so that the training needs no validation.
            cut.spec.evidence = 0;
            cut.windows[0].solved.truncate(solutions);
            let model = Arc::new(cut.model(observer)?);
            let window = &model.windows[0];
            let tested = reduced_solutions(&model, options, &points, experiment.lubricant, |_| false, observer)?;
            let failures = tested.iter().filter(|solved| solved.is_none()).count();
            let mut measured = Along::default();
            let measures = ErrorMeasures::new(window, &options, Norm::Euclidean);
            let mut online = Online::new(Arc::clone(&model), options);
            if let Some(first) = along.first() {
                online.prepare(first);
            }
            for (point, full) in along.iter().zip(&truth) {
                online.forget();
                let clock = Stopwatch::start();
                let solved = online.solve(point, experiment.lubricant);
                measured.seconds.push(clock.seconds());
                if let (Ok(solved), Some(full)) = (solved, full) {
                    let fields = online.reconstruct(&solved)?;
                    measured.residuals.push(measures.residuals(&solved.coefficients, &fields).sampled_rows);
                    measured.states.push(measures.state_error(&fields, full));
                    measured.films.push((fields.scalars.h_c / full.scalars.h_c - 1.0).abs());
                }
            }
            measured.failures = along.len() - full_failures - measured.films.len();
            let (tolerance, size) = (*tolerance, window.size());
            tell(Row::Rung(Rung { tolerance, snapshots: solutions, size, failures, along: measured }));
        }
        Ok(())
    }

    /// Values are named `1e1.snapshots`, with the tolerance. e_z and e_f^I are means along the trajectory (3.21), in
    /// the Euclidean norm.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        let rungs = only!(rows, Row::Rung);
        for rung in &rungs {
            for (column, get) in &COLUMNS[1..] {
                found.push(format!("{:e}.{column}", rung.tolerance), None, get(rung));
            }
        }
        found.push("rungs_met", None, rungs.len() as f64);
        found.push("tests", None, self.tests as f64);
        for row in rows {
            if let Row::Trained { log, full_failures } = row {
                found.warnings.extend(log.iter().cloned().map(Notice::from));
                found.push("full_failures", None, *full_failures as f64);
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        vec![Table::of("tolerances", &COLUMNS, only!(rows, Row::Rung))]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let rungs = only!(rows, Row::Rung);
        let chart = |title: &str, log: bool, shown: &[&str]| {
            let y = ChartAxis::new(title, log);
            let mut chart = Chart::new(title, ChartAxis::log("Tolerance"), y);
            for (name, get) in COLUMNS.iter().filter(|(name, _)| shown.contains(name)) {
                chart.add(*name, Marks::Line, rungs.iter().map(|rung| [rung.tolerance, get(rung)]));
            }
            chart
        };
        vec![
            chart("Errors along the trajectory", true, &["e_z_mean", "e_f_I_mean", "H_c_error_median"]),
            chart("Size", false, &["snapshots", "degrees_of_freedom", "sampled_rows"]),
            chart("Failures", false, &["failures", "trajectory_failures"]),
        ]
    }
}
