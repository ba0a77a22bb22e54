//! Training of a transient reduced model without the marches of a study, and loading of a saved one.

use super::data::ReducedTransient;
use super::timed_march::timed_march;
use super::{MarchedBy, Runner, TransientStudy};
use crate::scene::bench::Bench;
use crate::scene::error::RunError;
use crate::scene::notice::Notice;
use crate::scene::sampled;
use crate::scene::study::Study;
use crate::scene::study::question::Setting;
use crate::scene::{Scene, SceneError};
use crate::solver::full::Mesh;
use crate::solver::full::transient::{FullMarch, Trajectory, Transient};
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::training::{ResponseTraining, TrainingObserver, TrajectoryTraining, train_trajectories};
use std::sync::Arc;

impl TransientStudy {
    /// Returns the training of the study's reduced model; `None` if it trains none.
    pub fn training(&self) -> Option<TrajectoryTraining> {
        self.reduced.as_ref().and_then(ReducedTransient::training)
    }

    /// Returns the training of the study's reduced model of a circular contact; `None` if it trains none.
    pub fn responses(&self) -> Option<ResponseTraining> {
        self.reduced.as_ref().and_then(|reduced| reduced.responses)
    }

    /// Loads the reduced model that the study refers to; `None` if it trains one or has none.
    pub(super) fn saved_model(&self, setting: &mut Setting<'_>) -> Result<Option<Arc<TrajectoryModel>>, RunError> {
        let Some(source) = self.reduced.as_ref().and_then(|reduced| reduced.model.as_ref()) else { return Ok(None) };
        let model = setting.bench.trajectory_model(source, setting.experiment.contact, setting.observer)?;
        if !self.frames.contains(&model.frame) {
            return Err(RunError::Study(format!(
                "the reduced model has another frame than the study: write `frames: [{:?}]`, or add this frame to the \
                 others",
                model.frame
            )));
        }
        Ok(Some(model))
    }
}

impl Scene {
    /// Returns true if the scene is a transient study that trains a reduced model.
    pub fn trains_in_time(&self) -> bool {
        matches!(&self.study, Study::Transient(study) if study.training().is_some() || study.responses().is_some())
    }

    /// Trains the transient reduced model of the scene, in the first of its frames. Only the full marches for training
    /// are computed. Also returns which of them ended early.
    ///
    /// # Errors
    /// If the scene is refused or trains no such model, if the training fails, or if the observer cancels.
    pub fn train_in_time(
        &self,
        bench: &mut dyn Bench,
        observer: &dyn TrainingObserver,
    ) -> Result<(TrajectoryModel, Vec<Notice>), RunError> {
        self.check()?;
        let none = || RunError::Study("the scene trains no transient reduced model".to_owned());
        let Study::Transient(study) = &self.study else { return Err(none()) };
        if !self.trains_in_time() {
            return Err(none());
        }
        let mut study = study.clone();
        // Linearised models would need more states than a basis does.
        study.linearised = None;
        let experiment = self.experiment();
        let request = experiment.request()?;
        if let Some(path) = &study.sampled {
            sampled::read_into(&mut study.inputs, &bench.resolve(path), &request.point.into())?;
        }
        let grid = bench.grid(&request, observer)?;
        let frame = study.frames.first().copied().unwrap_or_default();
        let own = study.own_march(request.point, request.lubricant, frame);
        let setting = Setting { experiment: &experiment, bench, observer, wants_states: false };
        let runner = Runner { study: &study, grid, saved: None, setting: &setting, tell: &|_| {} };
        let (mut model, stopped) = match (study.responses(), study.training()) {
            (Some(responses), _) => (runner.responses(&responses, &own)?.reduced(observer)?, Vec::new()),
            (None, Some(training)) => runner.trained_by_marches(&training, &own)?,
            (None, None) => return Err(none()),
        };
        model.title.clone_from(&self.title);
        model.scene = self.to_ron().map_err(|refused: SceneError| RunError::Scene(refused))?;
        Ok((model, stopped))
    }
}

impl Runner<'_, '_> {
    /// Trains the model of a line contact from full marches. Also returns which of them ended early.
    fn trained_by_marches(
        &self,
        training: &TrajectoryTraining,
        own: &Transient,
    ) -> Result<(TrajectoryModel, Vec<Notice>), RunError> {
        let (grid, observer) = (self.line()?, self.setting.observer);
        let line = grid.scaled(1.0);
        let mut trainings = self.trainings(&Trajectory::begun(own, Mesh::of_line(&line), &line.x)?)?;
        if trainings.is_empty() {
            let mut model = FullMarch::new(Arc::clone(grid), own)?;
            trainings.push(timed_march(&mut model, own, MarchedBy::Full.stage(own.frame), observer, None)?.trajectory);
        }
        let mut model = train_trajectories(grid, &trainings, training, observer)?;
        let stopped = trainings.iter().enumerate().filter_map(|(k, trajectory)| {
            Some(Notice::Warning { part: format!("training {}", k + 1), warning: trajectory.stopped()? })
        });
        let told = |(k, trajectory): (usize, &Trajectory)| {
            let (steps, states) = (trajectory.moments.len().saturating_sub(1), trajectory.states.len());
            let ended = trajectory.ended.describe();
            format!("training {}: {steps} steps, {states} states stored; the march {ended}", k + 1)
        };
        model.log = trainings.iter().enumerate().map(told).collect();
        Ok((model, stopped.collect()))
    }
}
