//! A contact in time: one march for each frame, its statistics, and how far the frames lie apart.

use super::error::HarnessError;
use super::march_costs::{self, March};
use super::outcome::SceneOutcome;
use super::run::request_of;
use super::statistics::{median, percentile};
use super::table::Table;
use super::workbench::{Request, Workbench};
use crate::scene::{Grid, LinearisedTransient, ReducedTransient, Scene, TrainingInputs, TransientStudy, sampled};
use crate::solver::full::transient::{
    Frame, FullMarch, Keep, Marching, Moment, Quantity, TimeStep, Trajectory, Transient, TransientObserver, march,
};
use crate::solver::reduced::tpwl::{TpwlError, TpwlMarch, TpwlModel, TpwlTraining};
use crate::solver::reduced::transient::{ReducedMarch, TrajectoryModel};
use crate::solver::training::{Progress, TrainingObserver, TrajectoryTraining, train_trajectories};
use std::time::Instant;

/// Quantities that statistics are taken of, with their names.
const QUANTITIES: [(&str, Quantity); 4] = [
    ("H_c", Quantity::CentralFilm),
    ("H_min", Quantity::MinimumFilm),
    ("P_c", Quantity::CentralPressure),
    ("P_max", Quantity::MaximumPressure),
];

/// States of a training trajectory that are kept, about.
const TRAINING_STATES: f64 = 700.0;
/// The same where a linearised model is trained.
const LINEARISED_STATES: f64 = 3000.0;
/// Most modes in a table of losses.
const MOST_LOSSES: usize = 300;

/// Runs the study. Values of each frame, after its name (`fixed`, `ale`, `remeshed`, `remeshed_linear`): `H_c.start`, `H_c.mean`,
/// `H_c.amplitude`, `H_c.offset` (mean over start, less 1) over the window, and so on for H_min, P_c, P_max; `steps`, `rejected_steps`,
/// `newton_per_step`, `krylov_per_step`, `step_s_median`, `step_s_p99`, `wall_s`, `mass_defect` where places are given. Of the second frame
/// on: `H_c.difference` (greatest, relative) and `H_c.difference_l2` from the first one within the window. Tables: the time series of each frame;
/// with other models beside the full system, what all of them cost.
pub(super) fn run(
    scene: &Scene,
    study: &TransientStudy,
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), HarnessError> {
    let mut inputs = study.inputs.clone();
    if let Some(path) = &study.sampled {
        sampled::read_into(&mut inputs, &workbench.resolve(path))?;
    }
    let request = request_of(scene)?;
    let mut first: Option<Trajectory> = None;
    let mut first_modes = None;
    for &frame in &study.frames {
        let transient = Transient {
            point: request.point,
            lubricant: request.lubricant,
            inputs: inputs.clone(),
            frame,
            duration: study.duration,
            time_step: study.time_step,
            keep: if study.mass_between.is_some() { Keep::Every(1) } else { kept_states(study) },
        };
        let (trajectory, seconds) = full_march(&request, &transient, workbench, observer)?;
        if observer.cancelled() {
            return Err(HarnessError::Cancelled);
        }
        let name = frame.name();
        if !trajectory.finished() {
            outcome.converged = false;
            outcome.warnings.push(format!("{name}: the march {}", trajectory.ended.describe()));
        }
        statistics(name, &trajectory, study.window(), outcome);
        costs(name, &trajectory, &seconds, outcome);
        if let Some(balance) = study.mass_between.and_then(|places| trajectory.mass_balance(places)) {
            outcome.push(format!("{name}.mass_defect"), None, balance.defect());
        }
        if let Some(first) = &first {
            differences(name, &trajectory, first, study.window(), outcome);
        }
        outcome.tables.push(series(&format!("transient_{name}"), &trajectory));
        let mut trainings = Vec::new();
        if let Some(reduced) = &study.reduced {
            trainings = train_marches(scene, study, &reduced.trainings, &trajectory, workbench, observer)?;
            let all = if trainings.is_empty() { std::slice::from_ref(&trajectory) } else { &trainings[..] };
            let trained = train(&request, reduced, all, workbench, observer)?;
            let modes = trained.window.pressure.modes.ncols() as f64;
            outcome.push(format!("{name}.rnsa.modes_share"), None, modes / *first_modes.get_or_insert(modes));
            outcome.tables.push(loss_table(&format!("loss_{name}"), &trained));
            reduced_march(&trained, &trajectory, &seconds, study.window(), observer, outcome)?;
        }
        if let Some(linearised) = study.linearised.as_ref().filter(|_| frame == Frame::Fixed) {
            if study.reduced.as_ref().is_none_or(|reduced| reduced.trainings != linearised.trainings) {
                trainings = train_marches(scene, study, &linearised.trainings, &trajectory, workbench, observer)?;
            }
            let all = if trainings.is_empty() { std::slice::from_ref(&trajectory) } else { &trainings[..] };
            linearised_march(linearised, all, &trajectory, &seconds, study.window(), observer, outcome)?;
        }
        first.get_or_insert(trajectory);
    }
    if study.reduced.is_some() || study.linearised.is_some() {
        let table = march_costs::table(outcome, &marches_of(study), &study.published);
        outcome.tables.push(table);
    }
    Ok(())
}

/// The marches of a study, in the order they were made.
fn marches_of(study: &TransientStudy) -> Vec<March> {
    let mut marches = Vec::new();
    for frame in &study.frames {
        let frame = frame.name();
        let mut add = |method: &str, weighting: &str| {
            let of = if method == "full" { frame.to_owned() } else { format!("{frame}.{method}") };
            let (name, model) = (format!("{of}{weighting}"), format!("{of}."));
            marches.push(March { name, model, full: frame.to_owned(), published: format!("{frame}.{method}") });
        };
        add("full", "");
        if study.reduced.is_some() {
            add("rnsa", "");
        }
        for weighting in study.linearised.iter().filter(|_| frame == Frame::Fixed.name()).flat_map(|l| &l.weightings) {
            add("tpwl", &format!(".{}", weighting.name()));
        }
    }
    marches
}

/// Which states the study's own march keeps: those that models are to be trained by.
pub(crate) fn kept_states(study: &TransientStudy) -> Keep {
    let own = |trainings: &[TrainingInputs]| trainings.is_empty();
    let reduced = study.reduced.as_ref().is_some_and(|reduced| own(&reduced.trainings));
    let linearised = study.linearised.as_ref().is_some_and(|linearised| own(&linearised.trainings));
    if reduced || linearised { training_states(study, study.duration) } else { Keep::Scalars }
}

/// Which states a training keeps. Linearised models choose among them, so that they want more than bases do.
pub(crate) fn training_states(study: &TransientStudy, duration: f64) -> Keep {
    let (TimeStep::Fixed(longest) | TimeStep::Adaptive { longest, .. }) = study.time_step;
    let most = if study.linearised.is_some() { LINEARISED_STATES } else { TRAINING_STATES };
    Keep::Every(((duration / longest / most) as usize).max(1))
}

/// Full marches along training inputs, in the frame of the study's own.
fn train_marches(
    scene: &Scene,
    study: &TransientStudy,
    trainings: &[TrainingInputs],
    own: &Trajectory,
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
) -> Result<Vec<Trajectory>, HarnessError> {
    let mut request = request_of(scene)?;
    let mut marched = Vec::new();
    for training in trainings {
        let at = training.at.unwrap_or(scene.at).with_alpha_of(&scene.lubricant);
        request.point = at.point(scene.contact)?;
        let transient = Transient {
            point: request.point,
            inputs: training.inputs.clone(),
            duration: training.duration,
            keep: training_states(study, training.duration),
            ..own.transient.clone()
        };
        marched.push(full_march(&request, &transient, workbench, observer)?.0);
        if observer.cancelled() {
            return Err(HarnessError::Cancelled);
        }
    }
    Ok(marched)
}

/// The model of a frame.
fn train(
    request: &Request,
    reduced: &ReducedTransient,
    trainings: &[Trajectory],
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
) -> Result<TrajectoryModel, HarnessError> {
    let settings = TrajectoryTraining { loss: reduced.loss, rows_per_mode: reduced.rows_per_mode, seed: reduced.seed };
    let grid = workbench.full_solver(request, observer)?.reference().clone();
    Ok(train_trajectories(&grid, trainings, &settings, observer)?)
}

/// Marches a linearised model by each of its weightings beside the full trajectory. Values, after `fixed.tpwl`: `modes`, `points`,
/// `tolerance`; after `fixed.tpwl.dual_taylor` and `fixed.tpwl.dissertation` the differences, [`costs`] and `speed_up` of
/// [`reduced_march`]. A warning says where the inputs are too steep for it.
fn linearised_march(
    linearised: &LinearisedTransient,
    trainings: &[Trajectory],
    full: &Trajectory,
    full_seconds: &[f64],
    window: (f64, f64),
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), HarnessError> {
    let model = train_linearised(linearised, &trainings.iter().collect::<Vec<_>>())?;
    let frame = full.transient.frame.name();
    for (what, value) in [
        ("modes", model.space.modes() as f64),
        ("points", model.points.len() as f64),
        ("tolerance", model.training.selection.tolerance()),
    ] {
        outcome.push(format!("{frame}.tpwl.{what}"), None, value);
    }
    let transient = Transient { keep: Keep::Scalars, ..full.transient.clone() };
    for &weighting in &linearised.weightings {
        let name = format!("{frame}.tpwl.{}", weighting.name());
        let stage = format!("{frame} frame, linearised, {}", weighting.name());
        let mut march = TpwlMarch::new(&model, &transient, weighting)?;
        let (trajectory, seconds) = timed_march(&mut march, &transient, stage, observer)?;
        if march.record().too_steep() {
            outcome.warnings.push(format!("{name}: {TOO_STEEP}"));
        }
        compare(&name, &trajectory, &seconds, (full, full_seconds), window, observer, outcome)?;
    }
    Ok(())
}

/// Said of inputs that a linearised model cannot carry.
pub(crate) const TOO_STEEP: &str =
    "the inputs are too steep for linearised models; a reduced model with sampled rows is the right choice";

/// The linearised model that a study asks for, of given trajectories.
///
/// # Errors
/// When the trajectories do not go together.
pub(crate) fn train_linearised(
    linearised: &LinearisedTransient,
    trajectories: &[&Trajectory],
) -> Result<TpwlModel, TpwlError> {
    let training = TpwlTraining { modes: linearised.modes, selection: linearised.selection };
    match linearised.points {
        Some(points) => TpwlModel::train_with_points(trajectories, training, points),
        None => TpwlModel::train(trajectories, training),
    }
}

/// Loss of information (2.90) of pressure and deformation against the number of modes: Fig. 4.5.
fn loss_table(name: &str, model: &TrajectoryModel) -> Table {
    let mut table = Table::new(name, &["modes", "pressure_loss", "deformation_loss"]);
    let window = &model.window;
    let most = window.pressure.singular_values.len().min(MOST_LOSSES);
    table.rows.extend((0..=most).map(|k| vec![k as f64, window.pressure.loss(k), window.deformation.loss(k)]));
    table
}

/// Marches a reduced model beside the full trajectory of its frame. Values, after `<frame>.rnsa`: `modes`, `modes_share` (of the first
/// frame's), `deformation_modes`, `rows`,
/// `H_c.difference`, `H_c.difference_l2` and so on from the full trajectory, those of [`costs`], and `speed_up` (medians of the steps).
fn reduced_march(
    model: &TrajectoryModel,
    full: &Trajectory,
    full_seconds: &[f64],
    window: (f64, f64),
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), HarnessError> {
    let frame = full.transient.frame.name();
    let name = format!("{frame}.rnsa");
    let transient = Transient { keep: Keep::Scalars, ..full.transient.clone() };
    let stage = format!("{frame} frame, reduced");
    let (trajectory, seconds) = timed_march(&mut ReducedMarch::new(model)?, &transient, stage, observer)?;
    for (what, value) in [
        ("modes", model.window.pressure.modes.ncols()),
        ("deformation_modes", model.window.deformation.modes.ncols()),
        ("rows", model.window.sampled_rows.len()),
    ] {
        outcome.push(format!("{name}.{what}"), None, value as f64);
    }
    compare(&name, &trajectory, &seconds, (full, full_seconds), window, observer, outcome)
}

/// How a model's march ended, what it cost, how far it lies from the full one of its frame, and its series as a table.
fn compare(
    name: &str,
    trajectory: &Trajectory,
    seconds: &[f64],
    (full, full_seconds): (&Trajectory, &[f64]),
    window: (f64, f64),
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), HarnessError> {
    if observer.cancelled() {
        return Err(HarnessError::Cancelled);
    }
    if !trajectory.finished() {
        outcome.converged = false;
        outcome.warnings.push(format!("{name}: the march {}", trajectory.ended.describe()));
    }
    costs(name, trajectory, seconds, outcome);
    outcome.push(format!("{name}.speed_up"), None, median(full_seconds) / median(seconds));
    // A march that ended early agrees with nothing.
    if trajectory.finished() {
        differences(name, trajectory, full, window, outcome);
    }
    outcome.tables.push(series(&format!("transient_{}", name.replace('.', "_")), trajectory));
    Ok(())
}

fn differences(name: &str, trajectory: &Trajectory, from: &Trajectory, window: (f64, f64), outcome: &mut SceneOutcome) {
    for (quantity_name, quantity) in QUANTITIES {
        if let Some((greatest, l2)) = trajectory.difference(from, quantity, window) {
            outcome.push(format!("{name}.{quantity_name}.difference"), None, greatest);
            outcome.push(format!("{name}.{quantity_name}.difference_l2"), None, l2);
        }
    }
}

/// A march of the full system, and the seconds of each step.
fn full_march(
    request: &Request,
    transient: &Transient,
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
) -> Result<(Trajectory, Vec<f64>), HarnessError> {
    if request.grid == Grid::Model {
        return Err(HarnessError::Study("a contact in time needs a `grid` of its own, not Model".to_owned()));
    }
    let reference = workbench.full_solver(request, observer)?.reference().clone();
    let mut model = FullMarch::new(reference, transient)?;
    let stage = format!("{} frame, full", transient.frame.name());
    timed_march(&mut model, transient, stage, observer)
}

/// Marches and times each step.
pub(super) fn timed_march(
    model: &mut dyn Marching,
    transient: &Transient,
    stage: String,
    observer: &dyn TrainingObserver,
) -> Result<(Trajectory, Vec<f64>), HarnessError> {
    let mut watch = StepClock { observer, stage, duration: transient.duration, begun: None, seconds: Vec::new() };
    let trajectory = march(model, transient, &mut watch)?;
    Ok((trajectory, watch.seconds))
}

/// Measures every step, and tells how far the march is in thousandths of its duration.
struct StepClock<'a> {
    observer: &'a dyn TrainingObserver,
    stage: String,
    duration: f64,
    begun: Option<Instant>,
    seconds: Vec<f64>,
}

impl TransientObserver for StepClock<'_> {
    fn moment(&mut self, moment: &Moment) {
        if let Some(begun) = self.begun {
            self.seconds.push(begun.elapsed().as_secs_f64());
        }
        let done = (1000.0 * moment.time / self.duration) as usize;
        self.observer.progress(Progress { stage: self.stage.clone(), done, total: 1000 });
        self.begun = Some(Instant::now());
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}

fn statistics(name: &str, trajectory: &Trajectory, window: (f64, f64), outcome: &mut SceneOutcome) {
    let Some(start) = trajectory.moments.first() else { return };
    for (quantity_name, quantity) in QUANTITIES {
        let mut push = |what: &str, value| outcome.push(format!("{name}.{quantity_name}.{what}"), None, value);
        push("start", start.value(quantity));
        if let (Some(mean), Some(amplitude)) =
            (trajectory.mean(quantity, window), trajectory.amplitude(quantity, window))
        {
            push("mean", mean);
            push("offset", mean / start.value(quantity) - 1.0);
            push("amplitude", amplitude);
        }
    }
}

fn costs(name: &str, trajectory: &Trajectory, seconds: &[f64], outcome: &mut SceneOutcome) {
    let taken = trajectory.moments.get(1..).unwrap_or(&[]);
    let per_step = |count: fn(&Moment) -> usize| taken.iter().map(count).sum::<usize>() as f64 / taken.len() as f64;
    for (what, value) in [
        ("steps", taken.len() as f64),
        ("rejected_steps", trajectory.rejected_steps as f64),
        ("newton_per_step", per_step(|moment| moment.effort.newton_iterations)),
        ("krylov_per_step", per_step(|moment| moment.effort.linear_iterations)),
        ("step_s_median", median(seconds)),
        ("step_s_p99", percentile(seconds, 0.99)),
        ("march_s", seconds.iter().sum()),
    ] {
        outcome.push(format!("{name}.{what}"), None, value);
    }
}

/// The time series of a trajectory.
fn series(name: &str, trajectory: &Trajectory) -> Table {
    let columns = [
        "T", "step", "radius", "speed", "load", "H_c", "H_min", "X_H_min", "P_c", "P_max", "X_P_max", "newton",
        "krylov",
    ];
    let mut table = Table::new(name, &columns);
    table.rows.extend(trajectory.moments.iter().map(|m| {
        let Moment { time, step, input, h_c, h_min, x_h_min, p_c, p_max, x_p_max, effort, .. } = *m;
        let effort = [effort.newton_iterations as f64, effort.linear_iterations as f64];
        [&[time, step, input.radius, input.speed, input.load, h_c, h_min, x_h_min, p_c, p_max, x_p_max][..], &effort]
            .concat()
    }));
    table
}
