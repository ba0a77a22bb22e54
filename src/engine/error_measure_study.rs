//! Error measures at random points, ordered by the true error (Fig. 3.1), and how well each ranks what is wanted.

use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::parallel::{full_solutions, reduced_solutions};
use super::statistics::rank_correlation;
use super::table::Table;
use super::workbench::Workbench;
use crate::scene::{ModelSource, OnlineScheme, Scene};
use crate::solver::reduced::{ErrorEstimate, ErrorMeasures, Norm};
use crate::solver::training::{Range, TrainingObserver, random_points};

/// What is measured where.
pub(super) struct ErrorMeasureStudy<'a> {
    pub range: &'a Range,
    pub points: usize,
    pub seed: u64,
    pub model: &'a ModelSource,
    pub online: OnlineScheme,
    pub norm: Norm,
}

const COLUMNS: [&str; 10] = [
    "M",
    "L",
    "e_z",
    "e_f",
    "e_f_I",
    "H_c_error",
    "H_min_error",
    "e_z_normalised",
    "e_f_normalised",
    "e_f_I_normalised",
];
/// Columns of e_z, e_f, e_f^I and the film errors.
const MEASURES: [usize; 3] = [2, 3, 4];
const TRUTHS: [usize; 3] = [2, 5, 6];

/// Values: `e_z_median`, …, `rank.e_f_I.e_z` and its kind: Spearman's correlation of a measure with an error. Points at which the reduced
/// iteration fails are counted (`failures`) and take no part.
pub(super) fn run(
    scene: &Scene,
    study: &ErrorMeasureStudy<'_>,
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let points = random_points(study.range, scene.contact, study.points, study.seed);
    let model = workbench.model(study.model, scene.contact, observer)?;
    let options = study.online.options();
    let measures: Vec<ErrorMeasures> =
        model.windows.iter().map(|window| ErrorMeasures::new(window, &options, study.norm)).collect();
    let reduced = reduced_solutions(&model, options, &points, scene.lubricant, |_| true, observer)?;
    let grid = |point: &crate::solver::physics::contact::OperatingPoint| {
        model.windows[model.window_for(point.moes())].grid.clone()
    };
    let full = full_solutions(grid, &points, scene.lubricant, observer)?;
    let mut table = Table::new("error_measures", &COLUMNS);
    let mut failures = 0;
    let mut bounds = Vec::new();
    for (point, (reduced, full)) in points.iter().zip(reduced.iter().zip(&full)) {
        let Some(reduced) = reduced else {
            failures += 1;
            continue;
        };
        let (Some(fields), Some(full)) = (&reduced.fields, full) else { continue };
        let measure = &measures[reduced.solved.window];
        let residuals = measure.residuals(&reduced.solved.coefficients, fields);
        let error = |reduced: f64, full: f64| (reduced / full - 1.0).abs();
        let moes = point.moes();
        let truth = [
            measure.state_error(fields, full),
            error(fields.scalars.h_c, full.scalars.h_c),
            error(fields.scalars.h_min, full.scalars.h_min),
        ];
        bounds.extend(reduced.solved.error.map(|estimate| (estimate, truth)));
        let [state, h_c, h_min] = truth;
        table.rows.push(vec![moes.m, moes.l, state, residuals.all_rows, residuals.sampled_rows, h_c, h_min]);
    }
    table.rows.sort_by(|a, b| a[2].total_cmp(&b[2]));
    let column = |k: usize| table.rows.iter().map(|row| row[k]).collect::<Vec<f64>>();
    let columns: Vec<Vec<f64>> = (0..7).map(column).collect();
    outcome.push("points", None, points.len() as f64);
    outcome.push("failures", None, failures as f64);
    outcome.push("full_failures", None, full.iter().filter(|full| full.is_none()).count() as f64);
    for k in 2..7 {
        outcome.push_spread(COLUMNS[k], &columns[k]);
    }
    for measure in MEASURES {
        for truth in TRUTHS.into_iter().filter(|&truth| truth != measure) {
            let name = format!("rank.{}.{}", COLUMNS[measure], COLUMNS[truth]);
            outcome.push(name, None, rank_correlation(&columns[measure], &columns[truth]));
        }
    }
    outcome.push("rank.e_f_I.e_f", None, rank_correlation(&columns[4], &columns[3]));
    if !bounds.is_empty() {
        judge_bounds(&bounds, outcome);
    }
    // As Fig. 3.1 draws them: each divided by its largest.
    for measure in MEASURES {
        let largest = columns[measure].iter().copied().fold(0.0, f64::max);
        table.rows.iter_mut().for_each(|row| row.push(row[measure] / largest));
    }
    outcome.tables.push(table);
    Ok(())
}

/// What the calibrated estimates are worth against the true e_z and errors of H_c and H_min.
fn judge_bounds(bounds: &[(ErrorEstimate, [f64; 3])], outcome: &mut SceneOutcome) {
    let (states, truths): (Vec<f64>, Vec<f64>) = bounds.iter().map(|(e, truth)| (e.state.likely, truth[0])).unzip();
    outcome.push("rank.estimate.e_z", None, rank_correlation(&states, &truths));
    let h_c: Vec<f64> = bounds.iter().map(|(e, truth)| e.h_c.bound / truth[1]).collect();
    let h_min: Vec<f64> = bounds.iter().map(|(e, truth)| e.h_min.bound / truth[2]).collect();
    outcome.push_bounds("H_c", None, &h_c);
    outcome.push_bounds("H_min", None, &h_min);
}
