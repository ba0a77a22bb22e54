//! Ways of sampling rows side by side: one set of full solutions, one basis, the same random tests.

use super::question::{
    Chart, ChartAxis, Checked, Column, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::host::clock::Stopwatch;
use crate::scene::check::{self, MAX_COMPARED, MAX_TESTS, count, number};
use crate::scene::parallel::{film_errors, full_solutions, reduced_solutions};
use crate::scene::random_points::all_random_points;
use crate::scene::statistics::{median, percentile};
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Cavitation, Lubricant};
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, Sampling, Scheme};
use crate::solver::training::{TrainingSpec, TrainingState, Windows, train_resumable};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::sync::Arc;

/// Ways of sampling rows, on the same full solutions and basis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SamplingComparison {
    /// The scene of the training; relative paths refer to this scene's folder.
    pub training: PathBuf,
    /// The ways.
    pub samplings: Vec<ComparedSampling>,
    /// The box of random tests (3.17).
    pub range: ParameterSpace,
    /// Random tests of each.
    pub tests: usize,
    /// Seed of the random tests.
    pub seed: u64,
    /// Full solutions are compared at this many of them.
    pub compare: usize,
}

/// One of the compared ways of sampling rows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ComparedSampling {
    /// Its name in results.
    pub name: String,
    /// How rows are sampled.
    pub sampling: Sampling,
    /// Sampled rows per pressure mode.
    pub rows_per_mode: f64,
    /// Penalty factor γ̄ of the reduced equations.
    pub penalty: f64,
    /// By what the online step is found.
    #[serde(default)]
    pub scheme: Scheme,
    /// How its films rupture, where that is not as in the full solutions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cavitation: Option<Cavitation>,
}

/// What comes of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Row {
    /// What all ways share.
    Trained {
        /// Full solutions.
        snapshots: usize,
        /// Pressure modes.
        modes: usize,
    },
    /// One way of sampling.
    Way(Way),
}

/// What one way of sampling is worth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Way {
    /// Its name.
    pub name: String,
    /// Sampled rows.
    pub rows: usize,
    /// Penalty factor γ̄.
    pub penalty: f64,
    /// Random tests.
    pub tests: usize,
    /// Those that failed.
    pub failures: usize,
    /// Those of them that were to be compared.
    pub failures_compared: usize,
    /// Newton steps of the others.
    pub newton: Vec<f64>,
    /// Relative errors of H_c and of H_min.
    pub errors: [Vec<f64>; 2],
    /// Seconds of single solves, of some of the tests.
    pub seconds: Vec<f64>,
}

/// Solves that are timed.
const TIMED: usize = 40;

/// Seconds of single solves, one after the other.
fn one_by_one(
    model: &Arc<ReducedModel>,
    options: ReducedOptions,
    points: &[OperatingPoint],
    lubricant: Lubricant,
) -> Vec<f64> {
    let mut online = Online::new(Arc::clone(model), options);
    let timed = |point: &OperatingPoint| {
        online.prepare(point);
        online.forget();
        let clock = Stopwatch::start();
        let _ = online.solve(point, lubricant);
        clock.seconds()
    };
    points.iter().take(TIMED).map(timed).collect()
}

const COLUMNS: [Column<Way>; 8] = [
    ("rows", |way| way.rows as f64),
    ("penalty", |way| way.penalty),
    ("tests", |way| way.tests as f64),
    ("failures", |way| way.failures as f64),
    ("failures_compared", |way| way.failures_compared as f64),
    ("newton_median", |way| median(&way.newton)),
    ("newton_p95", |way| percentile(&way.newton, 0.95)),
    ("median_s", |way| median(&way.seconds)),
];

impl Question for SamplingComparison {
    type Row = Row;

    fn check(&self, _experiment: &Experiment) -> Checked {
        count("study.samplings (how many)", self.samplings.len(), 1, 16)?;
        count("study.tests", self.tests, 1, MAX_TESTS)?;
        count("study.compare", self.compare, 0, self.tests.min(MAX_COMPARED))?;
        check::names("study.samplings.name", self.samplings.iter().map(|way| way.name.as_str()))?;
        for way in &self.samplings {
            number("study.samplings.rows_per_mode", way.rows_per_mode, 1.0, 20.0)?;
            number("study.samplings.penalty", way.penalty, 1e2, 1e9)?;
        }
        check::space("study.range", &self.range)
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let training = setting.bench.training(&self.training)?;
        if !matches!(&training.windows, Windows::Given(windows) if windows.len() == 1) {
            let sentence = "a comparison of samplings needs a training with one given window";
            return Err(RunError::Study(sentence.to_owned()));
        }
        let points = all_random_points(&self.range, experiment.contact, self.tests, self.seed, observer)?;
        let own_law = training.lubricant.cavitation;
        // Errors are measured here, against full solutions.
        let mut state = TrainingState::new(TrainingSpec { evidence: 0, ..training });
        let trained = train_resumable(&mut state, observer)?;
        let window = &trained.windows[0];
        tell(Row::Trained { snapshots: state.solutions(), modes: window.pressure.count() });
        let truth = full_solutions(|_| window.grid.clone(), &points[..self.compare], experiment.lubricant, observer)?;
        for way in &self.samplings {
            (state.spec.sampling, state.spec.rows_per_mode) = (way.sampling, way.rows_per_mode);
            (state.spec.penalty, state.spec.scheme) = (way.penalty, way.scheme);
            state.spec.lubricant.cavitation = way.cavitation.unwrap_or(own_law);
            let model = Arc::new(state.model(observer)?);
            let (options, fields) = (ReducedOptions::default(), |i: usize| i < self.compare);
            let tested = reduced_solutions(&model, options, &points, experiment.lubricant, fields, observer)?;
            let seconds = one_by_one(&model, options, &points, experiment.lubricant);
            let failures = |tested: &[Option<_>]| tested.iter().filter(|solved| solved.is_none()).count();
            tell(Row::Way(Way {
                name: way.name.clone(),
                rows: model.windows[0].sampled_rows.len(),
                penalty: way.penalty,
                tests: points.len(),
                failures: failures(&tested),
                failures_compared: failures(&tested[..self.compare]),
                newton: tested.iter().flatten().map(|reduced| reduced.solved.iterations as f64).collect(),
                errors: film_errors(&tested, &truth),
                seconds,
            }));
        }
        Ok(())
    }

    /// Values are named `Cubature.failures`, with the name of the sampling: `rows`, `failures` among the tests,
    /// `newton_median`, and the errors of H_c and H_min at the first `compare` of them.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        for row in rows {
            match row {
                Row::Trained { snapshots, modes } => {
                    found.push("snapshots", None, *snapshots as f64);
                    found.push("basis_p", None, *modes as f64);
                }
                Row::Way(way) => {
                    for name in ["rows", "failures", "newton_median", "newton_p95", "median_s"] {
                        let value = COLUMNS.iter().find(|(column, _)| *column == name).map(|(_, get)| get(way));
                        found.push(format!("{}.{name}", way.name), None, value.unwrap_or(f64::NAN));
                    }
                    found.push_spread(&format!("{}.H_c_error", way.name), None, &way.errors[0]);
                    found.push_spread(&format!("{}.H_min_error", way.name), None, &way.errors[1]);
                }
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        vec![Table::of("samplings", &COLUMNS, only!(rows, Row::Way))]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let y = ChartAxis::log("Relative error of H_c");
        let mut chart = Chart::new("Errors of H_c, from the least to the largest", ChartAxis::linear("Share"), y);
        for way in only!(rows, Row::Way) {
            let mut errors = way.errors[0].clone();
            errors.sort_by(f64::total_cmp);
            let count = errors.len() as f64;
            let points = errors.iter().enumerate().map(|(i, error)| [(i as f64 + 0.5) / count, *error]);
            chart.add(way.name.as_str(), Marks::Line, points);
        }
        let mut failures = Chart::new("Failures", ChartAxis::linear("Sampled rows"), ChartAxis::linear("Failures"));
        for way in only!(rows, Row::Way) {
            failures.add(way.name.as_str(), Marks::Dots, [[way.rows as f64, way.failures as f64]]);
        }
        vec![chart, failures]
    }
}
