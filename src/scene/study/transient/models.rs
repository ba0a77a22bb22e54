//! Models of a transient study: trained, then marched and compared with the full solver.

use super::data::{Drive, LinearisedTransient, ReducedTransient, TransientStudy};
use super::march::{By, March, MarchedBy};
use super::timed_march::{Timed, timed_march};
use super::{Row, Runner};
use crate::host::clock::Stopwatch;
use crate::scene::error::RunError;
use crate::scene::names;
use crate::scene::notice::Notice;
use crate::scene::outcome::Findings;
use crate::scene::table::Table;
use crate::solver::full::transient::{Frame, FullMarch, Keep, Marching, Trajectory, Transient};
use crate::solver::reduced::tpwl::{Selection, TpwlError, TpwlMarch, TpwlModel, TpwlTraining, Weighting};
use crate::solver::reduced::transient::{ReducedMarch, TrajectoryModel};
use crate::solver::training::{ResponseBasis, ResponseTraining, TrajectoryTraining, on_one_thread, train_trajectories};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Largest number of modes in a table of losses.
const MOST_LOSSES: usize = 300;

/// Trained model.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Model {
    /// Prefix of its values.
    pub name: String,
    /// Frame of reference.
    pub frame: Frame,
    /// Kind of model.
    pub kind: Kind,
    /// Time of the training \[s\]; for a further rule only that of selecting its points.
    pub wall_s: f64,
}

/// Kind of model.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Kind {
    /// Reduced model with sampled equations.
    Reduced(Arc<TrajectoryModel>),
    /// Trajectory-piecewise-linear.
    Linearised {
        /// The model.
        model: Arc<TpwlModel>,
        /// Name of the selection rule.
        label: String,
        /// Weightings, each with its own march.
        weightings: Vec<Weighting>,
    },
}

/// Trains the linearised model with the study's first rule from given trajectories.
///
/// # Errors
/// If the trajectories are inconsistent.
fn train_linearised(linearised: &LinearisedTransient, trajectories: &[&Trajectory]) -> Result<TpwlModel, TpwlError> {
    let training = TpwlTraining { modes: linearised.modes, selection: linearised.selection };
    match linearised.points {
        Some(points) => TpwlModel::train_with_points(trajectories, training, points),
        None => TpwlModel::train(trajectories, training),
    }
}

/// Returns the prefix of the values of a frame's reduced model.
fn reduced_name(frame: Frame) -> String {
    format!("{}.rnsa", frame.name())
}

impl Model {
    /// Returns an existing reduced model.
    pub(super) fn saved(model: Arc<TrajectoryModel>) -> Self {
        let frame = model.frame;
        Self { name: reduced_name(frame), frame, kind: Kind::Reduced(model), wall_s: 0.0 }
    }

    /// Returns the number of pressure modes.
    pub fn modes(&self) -> usize {
        match &self.kind {
            Kind::Reduced(model) => model.modes(),
            Kind::Linearised { model, .. } => model.space.modes(),
        }
    }

    /// Returns the number of sampled equations or operating points.
    pub fn chosen(&self) -> usize {
        match &self.kind {
            Kind::Reduced(model) => model.rows(),
            Kind::Linearised { model, .. } => model.points.len(),
        }
    }

    /// Values of a reduced model: `modes` and `rows` (with local bases the largest, and their number `bases`),
    /// `modes_share` (the whole basis over that of the first frame), `deformation_modes`. Values of a linearised model:
    /// `modes`, `points`, `tolerance`. Values of both: `model_s`.
    pub(super) fn findings(&self, models: &[&Self], found: &mut Findings) {
        let (modes, chosen) = (self.modes() as f64, self.chosen() as f64);
        let mut push = |what: &str, value: f64| found.push(format!("{}.{what}", self.name), None, value);
        push("modes", modes);
        match &self.kind {
            Kind::Reduced(model) => {
                let whole = |model: &TrajectoryModel| model.window.pressure.count() as f64;
                let first = models.iter().find_map(|model| match &model.kind {
                    Kind::Reduced(first) => Some(whole(first)),
                    Kind::Linearised { .. } => None,
                });
                push("modes_share", whole(model) / first.unwrap_or(whole(model)));
                push("deformation_modes", model.window.deformation.modes.ncols() as f64);
                push("rows", chosen);
                if !model.locals.is_empty() {
                    push("bases", model.locals.len() as f64);
                }
            }
            Kind::Linearised { model, .. } => {
                push("points", chosen);
                push("tolerance", model.training.selection.tolerance());
            }
        }
        push("model_s", self.wall_s);
    }

    /// Returns the loss of information (2.90) of pressure and deformation over the number of modes (Fig. 4.5), or the
    /// positions of operating points (Fig. 4.10).
    pub(super) fn table(&self) -> Table {
        match &self.kind {
            Kind::Reduced(model) => {
                let name = format!("loss_{}", self.frame.name());
                let mut table = Table::new(name, &["modes", "pressure_loss", "deformation_loss"]);
                let window = &model.window;
                let most = window.pressure.singular_values().len().min(MOST_LOSSES);
                let row = |k| vec![k as f64, window.pressure.basis().loss(k), window.deformation.loss(k)];
                table.rows.extend((0..=most).map(row));
                table
            }
            Kind::Linearised { model, label, .. } => {
                let mut table = Table::new(
                    format!("operating_points_{label}"),
                    &["trajectory", names::LOAD, "T", "radius", "speed", "load", "H_0", "spacing"],
                );
                table.rows.extend(model.points.iter().map(|point| {
                    let (input, time) = (point.moment.input, point.moment.time);
                    let h_0 = point.moment.state.last().copied().unwrap_or(f64::NAN);
                    let load = model.sets[point.set].problem.point.load;
                    let trajectory = (point.trajectory + 1) as f64;
                    vec![trajectory, load, time, input.radius, input.speed, input.load, h_0, point.spacing]
                }));
                table
            }
        }
    }
}

impl Runner<'_, '_> {
    /// Trains or loads the models for the frame of the study's own full march.
    pub fn models(&self, own: Trajectory) -> Result<Vec<Model>, RunError> {
        let TransientStudy { reduced, linearised, .. } = self.study;
        let frame = own.transient.frame;
        let linearised: Option<&LinearisedTransient> = linearised.as_ref().filter(|_| frame == Frame::Fixed);
        let mut models = Vec::new();
        if let Some(saved) = self.saved.as_ref().filter(|saved| saved.frame == frame) {
            let model = Model::saved(Arc::clone(saved));
            (self.tell)(Row::Model(model.clone()));
            models.push(model);
        }
        if self.grid.point().is_some() {
            self.models_of_a_circle(&own.transient, linearised, &mut models)?;
            return Ok(models);
        }
        let training = reduced.as_ref().and_then(ReducedTransient::training);
        if training.is_none() && linearised.is_none() {
            return Ok(models);
        }
        let trained = self.trainings(&own)?;
        let trainings = Arc::new(if trained.is_empty() { vec![own] } else { trained });
        // The linearised model is trained first because it takes less time.
        if let Some(linearised) = linearised {
            self.linearised(linearised, &trainings, &mut models)?;
        }
        if let Some(training) = training {
            models.push(self.reduced(&training, frame, &trainings)?);
        }
        Ok(models)
    }

    /// Computes the full marches for training, if they are not the study's own march.
    pub(super) fn trainings(&self, own: &Trajectory) -> Result<Vec<Trajectory>, RunError> {
        let (frame, begun) = (own.transient.frame.name(), Stopwatch::start());
        let transients = self.study.training_marches(&own.transient);
        let mut trained = Vec::with_capacity(transients.len());
        let mut cut_short = Vec::new();
        for (k, transient) in transients.iter().enumerate() {
            let stage = format!("{frame}, training {} of {}", k + 1, transients.len());
            let mut model = FullMarch::new(Arc::clone(self.line()?), transient)?;
            let Timed { trajectory, .. } =
                timed_march(&mut model, transient, stage.clone(), self.setting.observer, None)?;
            cut_short.extend(trajectory.stopped().map(|warning| Notice::Warning { part: stage, warning }));
            trained.push(trajectory);
        }
        if !trained.is_empty() {
            let moments = trained.iter().map(|trajectory| trajectory.moments.clone()).collect();
            let wall_s = begun.seconds();
            (self.tell)(Row::Trained { frame: own.transient.frame, wall_s, moments, cut_short });
        }
        Ok(trained)
    }

    /// Trains the models of a circular contact around the reference contact of a march. A linearised model shares the
    /// basis of the reduced one.
    fn models_of_a_circle(
        &self,
        own: &Transient,
        linearised: Option<&LinearisedTransient>,
        models: &mut Vec<Model>,
    ) -> Result<(), RunError> {
        let (begun, observer) = (Stopwatch::start(), self.setting.observer);
        let asked = self.study.responses();
        let saved = self.saved.as_ref().filter(|_| asked.is_none() && linearised.is_some());
        let basis = match (asked, saved) {
            (Some(training), _) => self.responses(&training, own)?,
            (None, Some(model)) => ResponseBasis::of_model(model, (own.point, own.lubricant), observer)?,
            (None, None) => return Ok(()),
        };
        let basis = Arc::new(basis);
        let (moments, cut_short) = (vec![basis.swept().to_vec()], Vec::new());
        (self.tell)(Row::Trained { frame: own.frame, wall_s: begun.seconds(), moments, cut_short });
        for selection in linearised.iter().flat_map(|linearised| linearised.selections()) {
            let (begun, basis) = (Stopwatch::start(), Arc::clone(&basis));
            let LinearisedTransient { modes, points, .. } = linearised.cloned().unwrap_or_default();
            let train = move || basis.linearised(modes, selection, points);
            let model = Arc::new(on_one_thread(observer, train)??);
            self.push_linearised(model, linearised, selection, begun.seconds(), models);
        }
        if asked.is_some() {
            let begun = Stopwatch::start();
            let model = Arc::new(basis.reduced(observer)?);
            let (name, wall_s) = (reduced_name(model.frame), begun.seconds());
            let model = Model { name, frame: model.frame, kind: Kind::Reduced(model), wall_s };
            (self.tell)(Row::Model(model.clone()));
            models.push(model);
        }
        Ok(())
    }

    /// Computes the basis of a circular contact around the reference contact of a march.
    pub(super) fn responses(&self, training: &ResponseTraining, own: &Transient) -> Result<ResponseBasis, RunError> {
        let grid = self.grid.point().ok_or_else(|| RunError::Study("responses need a point contact".to_owned()))?;
        Ok(ResponseBasis::new(grid, own.point, own.lubricant, training, self.setting.observer)?)
    }

    /// Reports the linearised model of a rule. Its name contains the rule if there are several.
    fn push_linearised(
        &self,
        model: Arc<TpwlModel>,
        linearised: Option<&LinearisedTransient>,
        selection: Selection,
        wall_s: f64,
        models: &mut Vec<Model>,
    ) {
        let Some(linearised) = linearised else { return };
        let label = linearised.label(selection);
        let mut name = format!("{}.tpwl", Frame::Fixed.name());
        if !linearised.further.is_empty() {
            name = format!("{name}.{label}");
        }
        let kind = Kind::Linearised { model, label, weightings: linearised.weightings.clone() };
        let model = Model { name, frame: Frame::Fixed, kind, wall_s };
        (self.tell)(Row::Model(model.clone()));
        models.push(model);
    }

    fn reduced(
        &self,
        training: &TrajectoryTraining,
        frame: Frame,
        trainings: &[Trajectory],
    ) -> Result<Model, RunError> {
        let begun = Stopwatch::start();
        let model = Arc::new(train_trajectories(self.line()?, trainings, training, self.setting.observer)?);
        let (name, wall_s) = (reduced_name(frame), begun.seconds());
        let model = Model { name, frame, kind: Kind::Reduced(model), wall_s };
        (self.tell)(Row::Model(model.clone()));
        Ok(model)
    }

    /// Trains one model for each rule. The names contain the rule if there are several.
    fn linearised(
        &self,
        linearised: &LinearisedTransient,
        trainings: &Arc<Vec<Trajectory>>,
        models: &mut Vec<Model>,
    ) -> Result<(), RunError> {
        let mut first: Option<Arc<TpwlModel>> = None;
        for selection in linearised.selections() {
            let begun = Stopwatch::start();
            let (asked, known, trainings) = (linearised.clone(), first.clone(), Arc::clone(trainings));
            // Training cannot be interrupted. It runs on a separate thread, so that a cancel does not wait for it.
            let model = Arc::new(on_one_thread(self.setting.observer, move || match &known {
                None => train_linearised(&asked, &trainings.iter().collect::<Vec<_>>()),
                Some(first) => {
                    first.reselected(asked.points.map_or(selection, |points| first.selection_of(selection, points)))
                }
            })??);
            first.get_or_insert_with(|| Arc::clone(&model));
            self.push_linearised(model, Some(linearised), selection, begun.seconds(), models);
        }
        Ok(())
    }

    /// Marches a model along some inputs, for comparison with the named full march.
    pub fn compared(
        &self,
        model: &Model,
        drive: &Drive,
        (full, transient): (&str, &Transient),
    ) -> Result<(), RunError> {
        let transient = Transient { keep: Keep::Scalars, ..transient.clone() };
        let by = |method: &'static str| By::Model {
            model: model.name.clone(),
            method: method.into(),
            full: full.to_owned(),
        };
        let march = |name: &str, method: MarchedBy, marching: &mut dyn Marching| {
            let stage = method.stage(transient.frame);
            timed_march(marching, &transient, stage, self.setting.observer, self.told(name, method))
        };
        match &model.kind {
            Kind::Reduced(reduced) => {
                let name = drive.result(&model.name);
                let mut marching = ReducedMarch::new(reduced, &transient)?;
                let mut timed = march(&name, MarchedBy::Reduced, &mut marching)?;
                timed.trajectory.estimate_step_error(&mut marching, self.setting.observer);
                let outside = reduced.domain.left_by(&timed.trajectory);
                (self.tell)(Row::Marched(Arc::new(March { outside, ..March::new(&name, by("rnsa"), timed) })));
            }
            Kind::Linearised { model: linearised, weightings, .. } => {
                for &weighting in weightings {
                    let name = format!("{}.{}", drive.result(&model.name), weighting.name());
                    let mut marching = TpwlMarch::new(linearised, &transient, weighting)?;
                    let mut timed = march(&name, MarchedBy::Linearised(weighting), &mut marching)?;
                    let record = Some(marching.record().clone());
                    timed.trajectory.estimate_step_error(&mut marching, self.setting.observer);
                    (self.tell)(Row::Marched(Arc::new(March { record, ..March::new(&name, by("tpwl"), timed) })));
                }
            }
        }
        Ok(())
    }
}
