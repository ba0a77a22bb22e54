//! Comparison of methods of sampling equations, with one set of full solutions, one basis, and the same random tests.

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

/// Methods of sampling equations, with the same full solutions and basis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SamplingComparison {
    /// Scene of the training; relative paths refer to this scene's folder.
    pub training: PathBuf,
    /// Methods to compare.
    pub samplings: Vec<ComparedSampling>,
    /// Range of the random tests (3.17).
    pub range: ParameterSpace,
    /// Number of random tests per method.
    pub tests: usize,
    /// Seed of the random tests.
    pub seed: u64,
    /// Number of tests that are compared with full solutions.
    pub compare: usize,
}

/// Method of sampling equations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ComparedSampling {
    /// Name in results.
    pub name: String,
    /// Sampling method.
    pub sampling: Sampling,
    /// Number of sampled equations per pressure mode.
    pub rows_per_mode: f64,
    /// Penalty factor γ̄ of the reduced equations.
    pub penalty: f64,
    /// Scheme of the online solver.
    #[serde(default)]
    pub scheme: Scheme,
    /// Cavitation model of the reduced equations, if it differs from that of the full solutions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cavitation: Option<Cavitation>,
}

/// Row of the study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Row {
    /// Common data of all methods.
    Trained {
        /// Number of full solutions.
        snapshots: usize,
        /// Number of pressure modes.
        modes: usize,
    },
    /// Result of one method.
    Way(Way),
}

/// Result of one method of sampling.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Way {
    /// Name.
    pub name: String,
    /// Number of sampled equations.
    pub rows: usize,
    /// Penalty factor γ̄.
    pub penalty: f64,
    /// Number of random tests.
    pub tests: usize,
    /// Number of tests that failed.
    pub failures: usize,
    /// Number of failed tests among those to be compared.
    pub failures_compared: usize,
    /// Newton steps of the successful tests.
    pub newton: Vec<f64>,
    /// Relative errors of H_c and of H_min.
    pub errors: [Vec<f64>; 2],
    /// Times of single solves for some of the tests \[s\].
    pub seconds: Vec<f64>,
}

/// Number of timed solves.
const TIMED: usize = 40;

/// Returns the times of solves, run one after the other \[s\].
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
        // The study measures errors itself, so that the training needs no validation.
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

    /// Values are named `Cubature.failures`, with the name of the method: `rows`, `failures` among the tests,
    /// `newton_median`, and the errors of H_c and H_min at the first `compare` tests.
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
        let mut failures =
            Chart::new("Failures", ChartAxis::linear("Sampled equations"), ChartAxis::linear("Failures"));
        for way in only!(rows, Row::Way) {
            failures.add(way.name.as_str(), Marks::Dots, [[way.rows as f64, way.failures as f64]]);
        }
        vec![chart, failures]
    }
}
