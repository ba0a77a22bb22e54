//! Trajectory-piecewise-linear models against the full system: how near they come, with how many operating points, at what cost.

use super::error::HarnessError;
use super::march_costs::{self, March};
use super::outcome::SceneOutcome;
use super::run::request_of;
use super::statistics::{median, percentile};
use super::table::Table;
use super::transient_study::timed_march;
use super::workbench::Workbench;
use crate::scene::{Drive, Grid, Scene, TpwlStudy};
use crate::solver::contact::OperatingPoint;
use crate::solver::full::transient::{Frame, FullMarch, Keep, Quantity, TimeStep, Trajectory, Transient};
use crate::solver::grid::ReferenceGrid;
use crate::solver::reduced::tpwl::{Selection, TpwlMarch, TpwlModel, TpwlStep, TpwlTraining};
use crate::solver::reduced::transient::ReducedMarch;
use crate::solver::training::{TrainingObserver, TrajectoryTraining, train_trajectories};
use std::sync::Arc;
use std::time::Instant;

/// A test's full march, with its cost.
struct Reference {
    transient: Transient,
    trajectory: Trajectory,
    step_s: f64,
    march_s: f64,
}

/// Runs the study. Values: `training_s` (full marches), and of each test `T.full.steps`, `T.full.step_s_median`, `T.full.march_s`. Of each model
/// `modes`, `points` and `model_s`, and of each of its weightings W (`dual_taylor`, `dissertation`) on each test `T.W.H_c.difference` (greatest,
/// relative), `T.W.H_c.difference_l2`, the same of P_c, `T.W.steps`, `T.W.step_s_median`, `T.W.step_s_p99`, `T.W.march_s`, `T.W.speedup` (of the
/// whole march), and `T.W.reach_median` and `T.W.reach_max`: how far steps lie from the trained trajectories, in distances between
/// operating points. Of a model with sampled rows `rnsa.model_s`, `rnsa.modes`, `rnsa.rows` and, with W = `rnsa`, the same values. With more than one model, all its names begin with its rule and tolerance, as in `step_0.001.points`. Tables: the time
/// series of each test; the operating points of each model; what all marches cost.
pub(super) fn run(
    scene: &Scene,
    study: &TpwlStudy,
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), HarnessError> {
    let request = request_of(scene)?;
    if request.grid == Grid::Model {
        return Err(HarnessError::Study("a contact in time needs a `grid` of its own, not Model".to_owned()));
    }
    let grid = workbench.full_solver(&request, observer)?.reference().clone();
    let transient = |drive: &Drive, load: f64, keep: Keep| Transient {
        point: OperatingPoint { load, ..request.point },
        lubricant: request.lubricant,
        inputs: drive.inputs.clone(),
        frame: Frame::Fixed,
        duration: drive.duration,
        time_step: study.time_step,
        keep,
    };
    let own = request.point.load;
    let mut trained = Vec::new();
    let begun = Instant::now();
    for load in study.loads(own) {
        for drive in &study.training {
            let stage = format!("training, {}, {} N/mm", drive.name, load / 1e3);
            let transient = transient(drive, load, training_states(drive.duration, study.time_step));
            trained.push(full_march(&grid, transient, stage, observer, outcome)?.trajectory);
        }
    }
    outcome.push("training_s", None, begun.elapsed().as_secs_f64());
    let mut references = Vec::new();
    for test in &study.tests {
        let stage = format!("{}, full", test.name);
        let reference = full_march(&grid, transient(test, own, Keep::Scalars), stage, observer, outcome)?;
        for (what, value) in [
            ("steps", reference.trajectory.moments.len().saturating_sub(1) as f64),
            ("step_s_median", reference.step_s),
            ("march_s", reference.march_s),
        ] {
            outcome.push(format!("{}.full.{what}", test.name), None, value);
        }
        references.push(reference);
    }
    let mut series: Vec<Table> =
        study.tests.iter().zip(&references).map(|(test, reference)| reference_table(&test.name, reference)).collect();
    for &selection in &study.selections {
        let (label, prefix) = (label_of(selection), prefix_of(study, selection));
        let begun = Instant::now();
        let model =
            TpwlModel::train(&trained.iter().collect::<Vec<_>>(), TpwlTraining { modes: study.modes, selection })?;
        outcome.push(format!("{prefix}model_s"), None, begun.elapsed().as_secs_f64());
        outcome.push(format!("{prefix}modes"), None, model.space.modes() as f64);
        outcome.push(format!("{prefix}points"), None, model.points.len() as f64);
        outcome.tables.push(points_table(&label, &model));
        for ((test, reference), table) in study.tests.iter().zip(&references).zip(&mut series) {
            for &weighting in &study.weightings {
                let name = format!("{prefix}{}.{}", test.name, weighting.name());
                let mut march = TpwlMarch::new(&model, &reference.transient, weighting)?;
                let (trajectory, seconds) = timed_march(&mut march, &reference.transient, name.clone(), observer)?;
                note_end(&name, &trajectory, outcome);
                compare(&name, &trajectory, reference, &seconds, outcome);
                let mut reach: Vec<f64> = march.record().steps().iter().map(TpwlStep::reach).collect();
                reach.retain(|reach| reach.is_finite());
                outcome.push(format!("{name}.reach_median"), None, median(&reach));
                outcome.push(format!("{name}.reach_max"), None, percentile(&reach, 1.0));
                if march.record().too_steep() {
                    outcome.warnings.push(format!(
                        "{name}: the inputs are too steep for linearised models; a reduced model with sampled rows is the right choice"
                    ));
                }
                add_series(table, &name, &trajectory);
            }
        }
        if observer.cancelled() {
            return Err(HarnessError::Cancelled);
        }
    }
    if let Some(loss) = study.rnsa_loss {
        let settings = TrajectoryTraining { loss, ..TrajectoryTraining::default() };
        let begun = Instant::now();
        let model = train_trajectories(&grid, &trained, &settings, observer)?;
        outcome.push("rnsa.model_s", None, begun.elapsed().as_secs_f64());
        outcome.push("rnsa.modes", None, model.window.pressure.modes.ncols() as f64);
        outcome.push("rnsa.rows", None, model.window.sampled_rows.len() as f64);
        for ((test, reference), table) in study.tests.iter().zip(&references).zip(&mut series) {
            let name = format!("{}.rnsa", test.name);
            let mut march = ReducedMarch::new(&model)?;
            let (trajectory, seconds) = timed_march(&mut march, &reference.transient, name.clone(), observer)?;
            note_end(&name, &trajectory, outcome);
            compare(&name, &trajectory, reference, &seconds, outcome);
            add_series(table, &name, &trajectory);
        }
    }
    outcome.tables.extend(series);
    let table = march_costs::table(outcome, &marches_of(study), &study.published);
    outcome.tables.push(table);
    Ok(())
}

/// What the values of a model begin with: nothing where it is the only one.
fn prefix_of(study: &TpwlStudy, selection: Selection) -> String {
    if study.selections.len() > 1 { format!("{}.", label_of(selection)) } else { String::new() }
}

fn label_of(selection: Selection) -> String {
    format!("{}_{}", selection.name(), selection.tolerance())
}

/// The marches of a study: test by test, the full one first.
fn marches_of(study: &TpwlStudy) -> Vec<March> {
    let mut marches = Vec::new();
    for test in &study.tests {
        let mut add = |name: String, model: String, method: &str| {
            let of = |method: &str| format!("{}.{method}", test.name);
            marches.push(March { name, model, full: of("full"), published: of(method) });
        };
        add(format!("{}.full", test.name), "full.".to_owned(), "full");
        if study.rnsa_loss.is_some() {
            add(format!("{}.rnsa", test.name), "rnsa.".to_owned(), "rnsa");
        }
        for &selection in &study.selections {
            let model = prefix_of(study, selection);
            for weighting in &study.weightings {
                add(format!("{model}{}.{}", test.name, weighting.name()), model.clone(), "tpwl");
            }
        }
    }
    marches
}

/// Most moments of a training trajectory whose fields are kept.
const TRAINING_STATES: f64 = 3000.0;

fn training_states(duration: f64, time_step: TimeStep) -> Keep {
    let (TimeStep::Fixed(longest) | TimeStep::Adaptive { longest, .. }) = time_step;
    Keep::Every(((duration / longest / TRAINING_STATES).ceil() as usize).max(1))
}

fn full_march(
    grid: &Arc<ReferenceGrid>,
    transient: Transient,
    stage: String,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<Reference, HarnessError> {
    let mut model = FullMarch::new(grid.clone(), &transient)?;
    let (trajectory, seconds) = timed_march(&mut model, &transient, stage.clone(), observer)?;
    if observer.cancelled() {
        return Err(HarnessError::Cancelled);
    }
    note_end(&stage, &trajectory, outcome);
    Ok(Reference { transient, trajectory, step_s: median(&seconds), march_s: seconds.iter().sum() })
}

fn note_end(name: &str, trajectory: &Trajectory, outcome: &mut SceneOutcome) {
    if !trajectory.finished() {
        outcome.converged = false;
        outcome.warnings.push(format!("{name}: the march {}", trajectory.ended.describe()));
    }
}

fn compare(name: &str, trajectory: &Trajectory, reference: &Reference, seconds: &[f64], outcome: &mut SceneOutcome) {
    let whole = (0.0, reference.transient.duration);
    for (quantity_name, quantity) in [("H_c", Quantity::CentralFilm), ("P_c", Quantity::CentralPressure)] {
        if let Some((greatest, l2)) = trajectory.difference(&reference.trajectory, quantity, whole) {
            outcome.push(format!("{name}.{quantity_name}.difference"), None, greatest);
            outcome.push(format!("{name}.{quantity_name}.difference_l2"), None, l2);
        }
    }
    let march_s: f64 = seconds.iter().sum();
    for (what, value) in [
        ("steps", seconds.len() as f64),
        ("step_s_median", median(seconds)),
        ("step_s_p99", percentile(seconds, 0.99)),
        ("march_s", march_s),
        ("speedup", reference.march_s / march_s),
    ] {
        outcome.push(format!("{name}.{what}"), None, value);
    }
}

fn reference_table(name: &str, reference: &Reference) -> Table {
    let columns = ["T", "radius", "speed", "load", "H_c full", "P_c full"];
    let mut table = Table::new(format!("tpwl_{name}"), &columns);
    table.rows.extend(
        reference
            .trajectory
            .moments
            .iter()
            .map(|m| vec![m.time, m.input.radius, m.input.speed, m.input.load, m.h_c, m.p_c]),
    );
    table
}

/// Adds H_c and P_c of a march at the times of the table.
fn add_series(table: &mut Table, name: &str, trajectory: &Trajectory) {
    table.columns.extend([format!("H_c {name}"), format!("P_c {name}")]);
    for row in &mut table.rows {
        let at = |quantity| trajectory.at(quantity, row[0]).unwrap_or(f64::NAN);
        let values = [at(Quantity::CentralFilm), at(Quantity::CentralPressure)];
        row.extend(values);
    }
}

/// Where the operating points lie, Fig. 4.10.
fn points_table(label: &str, model: &TpwlModel) -> Table {
    let mut table = Table::new(
        format!("operating_points_{label}"),
        &["trajectory", "reference load N/m", "T", "radius", "speed", "load", "H_0", "spacing"],
    );
    table.rows.extend(model.points.iter().map(|point| {
        let input = point.moment.input;
        let h_0 = point.moment.state.last().copied().unwrap_or(f64::NAN);
        let load = model.sets[point.set].problem.point.load;
        vec![
            (point.trajectory + 1) as f64,
            load,
            point.moment.time,
            input.radius,
            input.speed,
            input.load,
            h_0,
            point.spacing,
        ]
    }));
    table
}
