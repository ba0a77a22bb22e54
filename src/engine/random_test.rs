//! Random points (3.17): failures, speed, and errors against full solutions.

use super::answer::Request;
use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::parallel::full_solutions;
use super::run::{request_of, step};
use super::statistics::{median, percentile};
use super::table::Table;
use super::workbench::Workbench;
use crate::scene::{Method, Scene};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::ErrorEstimate;
use crate::solver::training::{Range, TrainingObserver, random_points};

/// What is tested.
pub(super) struct RandomTest<'a> {
    /// Where points are drawn.
    pub range: &'a Range,
    /// How many.
    pub tests: usize,
    /// Seed of the points.
    pub seed: u64,
    /// The tested method.
    pub method: &'a Method,
    /// How many are compared with full solutions.
    pub compare: usize,
}

/// Solves without telling the observer, every so many.
const REPORT_EVERY: usize = 32;

/// Runs the test. Times are those of single solves, one after the other.
pub(super) fn run(
    scene: &Scene,
    test: &RandomTest<'_>,
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let mut points = random_points(test.range, scene.contact, test.tests, test.seed);
    if points.len() < test.tests {
        return Err(EngineError::Study(format!(
            "`study.range` holds hardly any point below its largest Hertzian pressure; only {} of {} were found",
            points.len(),
            test.tests
        )));
    }
    if !matches!(test.range, Range::Sliding(_)) {
        points.iter_mut().for_each(|point| point.sliding = scene.sliding());
    }
    let template = request_of(scene)?;
    let of = Some(test.method);
    let mut table = Table::new(
        "random",
        &[
            "M",
            "L",
            "alpha",
            "p_h_pa",
            "converged",
            "H_c",
            "newton_iterations",
            "wall_s",
            "H_c_full",
            "H_min",
            "H_min_full",
            "srr",
            "npr",
            "traction",
            "traction_full",
        ],
    );
    let mut untrained = 0;
    let mut estimates = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        if i.is_multiple_of(REPORT_EVERY) {
            step(observer, "random tests", i, points.len())?;
        }
        let request = Request { point: *point, ..template.clone() };
        let answer = workbench.answer(&request, test.method, None, observer)?;
        untrained += usize::from(answer.reduced.as_ref().is_some_and(|facts| !facts.trained));
        estimates.push(answer.reduced.as_ref().and_then(|facts| facts.error));
        let scalars = answer.result().map(|solution| solution.scalars);
        let moes = point.moes();
        table.rows.push(vec![
            moes.m,
            moes.l,
            point.alpha_per_pa,
            point.hertz().pressure_pa,
            f64::from(u8::from(answer.converged)),
            scalars.map_or(f64::NAN, |s| s.h_c),
            answer.newton_iterations as f64,
            answer.wall_s,
            f64::NAN,
            scalars.map_or(f64::NAN, |s| s.h_min),
            f64::NAN,
            point.sliding.slide_to_roll_ratio,
            point.sliding.newtonian_plateau_ratio.unwrap_or(1.0),
            answer.traction().unwrap_or(f64::NAN),
            f64::NAN,
        ]);
    }
    let column = |k: usize| table.rows.iter().map(|row| row[k]).collect::<Vec<f64>>();
    let (converged, newton, seconds) = (column(4), column(6), column(7));
    let failures = converged.iter().filter(|&&c| c == 0.0).count();
    outcome.converged &= failures == 0;
    outcome.push("tests", of, points.len() as f64);
    outcome.push("failures", of, failures as f64);
    outcome.push("failure_percent", of, 100.0 * failures as f64 / points.len() as f64);
    outcome.push("newton_median", of, median(&newton));
    outcome.push("newton_max", of, percentile(&newton, 1.0));
    outcome.push("median_s", of, median(&seconds));
    outcome.push("p99_s", of, percentile(&seconds, 0.99));
    if let Some(source) = test.method.model() {
        outcome.push("untrained", of, untrained as f64);
        let model = workbench.model_for(source, scene.contact, &scene.lubricant, observer)?;
        let grid = |point: &OperatingPoint| model.windows[model.window_for(point.moes())].grid.clone();
        let full = full_solutions(grid, &points[..test.compare], scene.lubricant, observer)?;
        let mut errors: [Vec<f64>; 3] = Default::default();
        let mut bounds: [Vec<f64>; 3] = Default::default();
        let mut full_failures = 0;
        for ((row, full), estimate) in table.rows.iter_mut().zip(full).zip(&estimates) {
            full_failures += usize::from(full.is_none());
            if let Some(full) = full {
                (row[8], row[10]) = (full.scalars.h_c, full.scalars.h_min);
                // Without a meaning there is nothing to compare.
                row[14] = if full.traction_warning().is_none() { full.traction_coefficient() } else { f64::NAN };
            }
            let pairs = [(row[5], row[8]), (row[9], row[10]), (row[13], row[14])];
            let bound = |e: &ErrorEstimate| [Some(e.h_c), Some(e.h_min), e.traction].map(|e| e.map(|e| e.bound));
            let promised = estimate.as_ref().map_or([None; 3], bound);
            let kept = errors.iter_mut().zip(&mut bounds);
            for (((errors, bounds), (reduced, full)), promised) in kept.zip(pairs).zip(promised) {
                let error = Some((reduced / full - 1.0).abs()).filter(|error| error.is_finite());
                errors.extend(error);
                bounds.extend(error.zip(promised).map(|(error, bound)| bound / error));
            }
        }
        if test.compare > 0 {
            outcome.push("compared", of, errors[0].len() as f64);
            outcome.push("full_failures", of, full_failures as f64);
            let all = ["H_c", "H_min", "traction"].into_iter().zip(&errors).zip(&bounds);
            for ((name, errors), bounds) in all.filter(|((_, errors), _)| !errors.is_empty()) {
                outcome.push(format!("{name}_error_median"), of, median(errors));
                outcome.push(format!("{name}_error_p95"), of, percentile(errors, 0.95));
                outcome.push(format!("{name}_error_max"), of, percentile(errors, 1.0));
                if !bounds.is_empty() {
                    outcome.push_bounds(name, of, bounds);
                }
            }
        }
    }
    outcome.tables.push(table);
    Ok(())
}
