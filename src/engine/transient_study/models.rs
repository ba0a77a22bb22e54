//! The models of a contact in time: trained on the spot, then marched beside the full system.

use super::{Runner, values};
use crate::engine::error::EngineError;
use crate::engine::statistics::{median, percentile};
use crate::engine::table::Table;
use crate::engine::timed_march::{Timed, timed_march};
use crate::scene::{Drive, LinearisedTransient, ReducedTransient};
use crate::solver::full::transient::{Frame, FullMarch, Keep, Trajectory, Transient};
use crate::solver::reduced::tpwl::{TpwlError, TpwlMarch, TpwlModel, TpwlStep, TpwlTraining, Weighting};
use crate::solver::reduced::transient::{ReducedMarch, TrajectoryModel};
use crate::solver::training::{TrajectoryTraining, train_trajectories};
use std::sync::Arc;
use std::time::Instant;

/// Most modes in a table of losses.
const MOST_LOSSES: usize = 300;

/// Said of inputs that a linearised model cannot carry.
pub(crate) const TOO_STEEP: &str =
    "the inputs are too steep for linearised models; a reduced model with sampled rows is the right choice";

/// A trained model and what its values begin with.
pub(super) enum Model {
    Reduced(String, TrajectoryModel),
    Linearised(String, TpwlModel, Vec<Weighting>),
}

/// The linearised model that a study asks for by its first rule, of given trajectories.
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

impl Runner<'_> {
    /// The models of the frame of the study's own full march. Values of a reduced one, after `<frame>.rnsa`: `modes`, `modes_share` (of the
    /// first frame's), `deformation_modes`, `rows`; of a linearised one `modes`, `points`, `tolerance`; of both `model_s`, the seconds of its
    /// making, of a further rule those of its points alone.
    pub fn models(&mut self, own: &Timed) -> Result<Vec<Model>, EngineError> {
        let frame = own.trajectory.transient.frame;
        let linearised = self.study.linearised.as_ref().filter(|_| frame == Frame::Fixed);
        let mut models = Vec::new();
        if self.study.reduced.is_none() && linearised.is_none() {
            return Ok(models);
        }
        let trained = self.trainings(&own.trajectory)?;
        let trainings = if trained.is_empty() { std::slice::from_ref(&own.trajectory) } else { &trained[..] };
        if let Some(reduced) = &self.study.reduced {
            models.push(self.reduced(reduced, frame, trainings)?);
        }
        if let Some(linearised) = linearised {
            models.extend(self.linearised(linearised, frame, trainings)?);
        }
        Ok(models)
    }

    /// Full marches that models are trained by, where it is not the study's own.
    fn trainings(&mut self, own: &Trajectory) -> Result<Vec<Trajectory>, EngineError> {
        let (frame, begun) = (own.transient.frame.name(), Instant::now());
        let transients = self.study.training_marches(&own.transient);
        let mut trained = Vec::with_capacity(transients.len());
        for (k, transient) in transients.iter().enumerate() {
            let stage = format!("{frame}, training {} of {}", k + 1, transients.len());
            let mut model = FullMarch::new(Arc::clone(&self.grid), transient)?;
            let Timed { trajectory, .. } = timed_march(&mut model, transient, stage.clone(), self.observer)?;
            values::end(&stage, &trajectory, self.outcome);
            trained.push(trajectory);
        }
        if !trained.is_empty() {
            self.outcome.push(format!("{frame}.training_s"), None, begun.elapsed().as_secs_f64());
        }
        Ok(trained)
    }

    fn reduced(
        &mut self,
        reduced: &ReducedTransient,
        frame: Frame,
        trainings: &[Trajectory],
    ) -> Result<Model, EngineError> {
        let begun = Instant::now();
        let ReducedTransient { loss, rows_per_mode, seed } = *reduced;
        let settings = TrajectoryTraining { loss, rows_per_mode, seed };
        let model = train_trajectories(&self.grid, trainings, &settings, self.observer)?;
        let (name, window) = (format!("{}.rnsa", frame.name()), &model.window);
        let modes = window.pressure.modes.ncols() as f64;
        for (what, value) in [
            ("modes", modes),
            ("modes_share", modes / *self.first_modes.get_or_insert(modes)),
            ("deformation_modes", window.deformation.modes.ncols() as f64),
            ("rows", window.sampled_rows.len() as f64),
            ("model_s", begun.elapsed().as_secs_f64()),
        ] {
            self.outcome.push(format!("{name}.{what}"), None, value);
        }
        self.outcome.tables.push(loss_table(&format!("loss_{}", frame.name()), &model));
        Ok(Model::Reduced(name, model))
    }

    /// One model for each rule; their names tell the rule where there are several.
    fn linearised(
        &mut self,
        linearised: &LinearisedTransient,
        frame: Frame,
        trainings: &[Trajectory],
    ) -> Result<Vec<Model>, EngineError> {
        let mut models: Vec<TpwlModel> = Vec::new();
        let mut names = Vec::new();
        for selection in linearised.selections() {
            let begun = Instant::now();
            let model = match models.first() {
                None => train_linearised(linearised, &trainings.iter().collect::<Vec<_>>())?,
                Some(first) => first
                    .reselected(linearised.points.map_or(selection, |points| first.selection_of(selection, points)))?,
            };
            let label = linearised.label(selection);
            let mut name = format!("{}.tpwl", frame.name());
            if !linearised.further.is_empty() {
                name = format!("{name}.{label}");
            }
            for (what, value) in [
                ("modes", model.space.modes() as f64),
                ("points", model.points.len() as f64),
                ("tolerance", model.training.selection.tolerance()),
                ("model_s", begun.elapsed().as_secs_f64()),
            ] {
                self.outcome.push(format!("{name}.{what}"), None, value);
            }
            self.outcome.tables.push(points_table(&label, &model));
            names.push(name);
            models.push(model);
        }
        let all = names.into_iter().zip(models);
        Ok(all.map(|(name, model)| Model::Linearised(name, model, linearised.weightings.clone())).collect())
    }

    /// Marches a model along some inputs, beside the full march along them.
    pub fn beside(&mut self, model: &Model, drive: &Drive, full: &Timed) -> Result<(), EngineError> {
        let transient = Transient { keep: Keep::Scalars, ..full.trajectory.transient.clone() };
        match model {
            Model::Reduced(of, model) => {
                let name = drive.result(of);
                let march = timed_march(&mut ReducedMarch::new(model)?, &transient, name.clone(), self.observer)?;
                self.compared(&name, format!("{of}."), "rnsa", &march, drive, full);
            }
            Model::Linearised(of, model, weightings) => {
                for &weighting in weightings {
                    let name = format!("{}.{}", drive.result(of), weighting.name());
                    let mut marching = TpwlMarch::new(model, &transient, weighting)?;
                    let march = timed_march(&mut marching, &transient, name.clone(), self.observer)?;
                    self.compared(&name, format!("{of}."), "tpwl", &march, drive, full);
                    let record = marching.record();
                    let mut reach: Vec<f64> = record.steps().iter().map(TpwlStep::reach).collect();
                    reach.retain(|reach| reach.is_finite());
                    self.outcome.push(format!("{name}.reach_median"), None, median(&reach));
                    self.outcome.push(format!("{name}.reach_max"), None, percentile(&reach, 1.0));
                    if record.too_steep() {
                        self.outcome.warnings.push(format!("{name}: {TOO_STEEP}"));
                    }
                }
            }
        }
        Ok(())
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
