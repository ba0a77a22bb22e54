//! A scene in, its outcome out.

use super::answer::{Answer, Request};
use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::report::{PointReport, profile_table};
use super::workbench::Workbench;
use super::{
    dimension_study, distance_study, error_measure_study, formula_comparison, grid_study, plan_comparison, random_test,
    sampling_study, series, split_study, tolerance_study, training_study, transient_study,
};
use crate::scene::{Method, Scene, Study};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::training::{Progress, TrainingObserver};
use std::time::Instant;

/// Answers a scene's question and holds its expectations against the answer.
///
/// # Errors
/// When the scene is refused, a model cannot be had, or the observer cancels. Solves that do not converge and expectations
/// that fall short are part of the outcome.
pub fn run_scene(
    scene: &Scene,
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
) -> Result<SceneOutcome, EngineError> {
    scene.check()?;
    let clock = Instant::now();
    let mut outcome = SceneOutcome::of(scene);
    outcome.warnings.extend(scene.unused_alpha());
    match &scene.study {
        Study::Point { methods } => point(scene, methods, workbench, observer, &mut outcome)?,
        Study::Sweep { over, methods, cold, compare_on_model_grid } => {
            let how = (*cold, *compare_on_model_grid);
            series::sweep(scene, (over, methods, how), workbench, observer, &mut outcome)?;
        }
        Study::Trajectory { range, points, methods } => {
            series::trajectory(scene, range, *points, methods, workbench, observer, &mut outcome)?;
        }
        Study::RandomTest { range, tests, seed, method, compare } => {
            let test = random_test::RandomTest { range, tests: *tests, seed: *seed, method, compare: *compare };
            random_test::run(scene, &test, workbench, observer, &mut outcome)?;
        }
        Study::ErrorSplit { contacts, method } => {
            split_study::run(scene, contacts, method, workbench, observer, &mut outcome)?;
        }
        Study::GridStudy { dx } => grid_study::run(scene, dx, workbench, observer, &mut outcome)?,
        Study::Dimensions { over, losses } => {
            dimension_study::run(scene, (over, losses), workbench, observer, &mut outcome)?;
        }
        Study::Training(spec) => training_study::run(spec, observer, &mut outcome)?,
        Study::ErrorMeasures { range, points, seed, model, online, norm } => {
            let (points, seed, online, norm) = (*points, *seed, *online, *norm);
            let study = error_measure_study::ErrorMeasureStudy { range, points, seed, model, online, norm };
            error_measure_study::run(scene, &study, workbench, observer, &mut outcome)?;
        }
        Study::DistanceMeasure { range, points, seed } => {
            distance_study::run(scene, (range, *points, *seed), workbench, observer, &mut outcome)?;
        }
        Study::PlanComparison { plans, range, tests, seed, compare, trajectory, online } => {
            let (tests, seed, compare, trajectory, online) = (*tests, *seed, *compare, *trajectory, *online);
            let study = plan_comparison::PlanComparison { plans, range, tests, seed, compare, trajectory, online };
            plan_comparison::run(scene, &study, workbench, observer, &mut outcome)?;
        }
        Study::ToleranceStudy { training, range, points, tests, seed, online } => {
            let training = workbench.training(training)?;
            let (points, tests, seed, online) = (*points, *tests, *seed, *online);
            let study = tolerance_study::ToleranceStudy { training, range, points, tests, seed, online };
            tolerance_study::run(scene, &study, observer, &mut outcome)?;
        }
        Study::SamplingComparison { training, samplings, range, tests, seed, compare } => {
            let training = workbench.training(training)?;
            let (tests, seed, compare) = (*tests, *seed, *compare);
            let study = sampling_study::SamplingStudy { training, samplings, range, tests, seed, compare };
            sampling_study::run(scene, &study, observer, &mut outcome)?;
        }
        Study::Transient(study) => transient_study::run(scene, study, workbench, observer, &mut outcome)?,
        Study::FormulaComparison { formula, m, l } => {
            formula_comparison::run(scene, *formula, m, l, workbench, observer, &mut outcome)?;
        }
    }
    outcome.wall_s = clock.elapsed().as_secs_f64();
    outcome.judge(scene);
    Ok(outcome)
}

/// The request of a scene at its own operating point.
pub(super) fn request_of(scene: &Scene) -> Result<Request, EngineError> {
    Ok(Request {
        point: OperatingPoint { sliding: scene.sliding(), ..scene.point()? },
        lubricant: scene.lubricant,
        grid: scene.grid,
        grid_model: scene.study.grid_model(),
    })
}

/// Tells the observer how far a stage is, and stops where that is wanted.
pub(super) fn step(observer: &dyn TrainingObserver, stage: &str, done: usize, total: usize) -> Result<(), EngineError> {
    observer.progress(Progress { stage: stage.to_owned(), done, total });
    if observer.cancelled() { Err(EngineError::Cancelled) } else { Ok(()) }
}

fn point(
    scene: &Scene,
    methods: &[Method],
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let request = request_of(scene)?;
    let mut answers: Vec<Answer> = Vec::new();
    for (i, method) in methods.iter().enumerate() {
        step(observer, "solving", i, methods.len())?;
        let answer = workbench.answer(&request, method, None, observer)?;
        for (name, value) in PointReport::from(&answer).values() {
            outcome.push(name, Some(method), value);
        }
        outcome.warnings.extend(answer.warnings.iter().map(|warning| format!("{}: {warning}", method.name())));
        outcome.converged &= answer.converged;
        if let Some(solution) = answer.result() {
            let suffix = if i == 0 { String::new() } else { format!("_{i}") };
            outcome.tables.push(profile_table(format!("profile_{}{suffix}", method.name()), solution));
        }
        answers.push(answer);
    }
    if let Some(full) = answers.iter().find(|a| a.method == Method::Full).and_then(Answer::result) {
        for answer in answers.iter().filter(|a| a.reduced.is_some()) {
            if let Some(reduced) = answer.result() {
                let error = (reduced.scalars.h_c / full.scalars.h_c - 1.0).abs();
                outcome.push("H_c_error", Some(&answer.method), error);
            }
        }
    }
    Ok(())
}
