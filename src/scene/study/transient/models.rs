//! The models of a contact in time: trained on the spot, then marched beside the full system.

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
use crate::solver::reduced::tpwl::{TpwlError, TpwlMarch, TpwlModel, TpwlTraining, Weighting};
use crate::solver::reduced::transient::{ReducedMarch, TrajectoryModel};
use crate::solver::training::{TrajectoryTraining, on_one_thread, train_trajectories};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Most modes in a table of losses.
const MOST_LOSSES: usize = 300;

/// A trained model.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Model {
    /// What its values begin with.
    pub name: String,
    /// Its frame.
    pub frame: Frame,
    /// What it is.
    pub kind: Kind,
    /// Seconds of its making; of a further rule those of its points alone.
    pub wall_s: f64,
}

/// Which kind of model it is.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Kind {
    /// With sampled rows.
    Reduced(Arc<TrajectoryModel>),
    /// Trajectory-piecewise-linear.
    Linearised {
        /// The model.
        model: Arc<TpwlModel>,
        /// The rule of its points, in a word.
        label: String,
        /// Weightings, each a march of its own.
        weightings: Vec<Weighting>,
    },
}

/// The linearised model that a study asks for by its first rule, of given trajectories.
///
/// # Errors
/// When the trajectories do not go together.
fn train_linearised(linearised: &LinearisedTransient, trajectories: &[&Trajectory]) -> Result<TpwlModel, TpwlError> {
    let training = TpwlTraining { modes: linearised.modes, selection: linearised.selection };
    match linearised.points {
        Some(points) => TpwlModel::train_with_points(trajectories, training, points),
        None => TpwlModel::train(trajectories, training),
    }
}

/// What the values of a reduced model of a frame begin with.
fn reduced_name(frame: Frame) -> String {
    format!("{}.rnsa", frame.name())
}

impl Model {
    /// A reduced one that was made before.
    pub(super) fn saved(model: Arc<TrajectoryModel>) -> Self {
        let frame = model.frame;
        Self { name: reduced_name(frame), frame, kind: Kind::Reduced(model), wall_s: 0.0 }
    }

    /// Pressure modes.
    pub fn modes(&self) -> usize {
        match &self.kind {
            Kind::Reduced(model) => model.modes(),
            Kind::Linearised { model, .. } => model.space.modes(),
        }
    }

    /// Sampled rows or operating points.
    pub fn chosen(&self) -> usize {
        match &self.kind {
            Kind::Reduced(model) => model.rows(),
            Kind::Linearised { model, .. } => model.points.len(),
        }
    }

    /// Values of a reduced one: `modes` and `rows`, of a local basis at most where it has `bases` of them, `modes_share` (the
    /// whole basis over the first frame's), `deformation_modes`; of a linearised one `modes`, `points`,
    /// `tolerance`; of both `model_s`.
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

    /// Loss of information (2.90) of pressure and deformation against the number of modes, Fig. 4.5; or where operating points lie, Fig. 4.10.
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
    /// The models of the frame of the study's own full march.
    pub fn models(&self, own: Trajectory) -> Result<Vec<Model>, RunError> {
        let TransientStudy { reduced, linearised, .. } = self.study;
        let frame = own.transient.frame;
        let linearised = linearised.as_ref().filter(|_| frame == Frame::Fixed);
        let mut models = Vec::new();
        if let Some(saved) = self.saved.as_ref().filter(|saved| saved.frame == frame) {
            let model = Model::saved(Arc::clone(saved));
            (self.tell)(Row::Model(model.clone()));
            models.push(model);
        }
        let training = reduced.as_ref().and_then(ReducedTransient::training);
        if training.is_none() && linearised.is_none() {
            return Ok(models);
        }
        let trained = self.trainings(&own)?;
        let trainings = Arc::new(if trained.is_empty() { vec![own] } else { trained });
        // The linearised one is there sooner.
        if let Some(linearised) = linearised {
            self.linearised(linearised, frame, &trainings, &mut models)?;
        }
        if let Some(training) = training {
            models.push(self.reduced(&training, frame, &trainings)?);
        }
        Ok(models)
    }

    /// Full marches that models are trained by, where it is not the study's own.
    pub(super) fn trainings(&self, own: &Trajectory) -> Result<Vec<Trajectory>, RunError> {
        let (frame, begun) = (own.transient.frame.name(), Stopwatch::start());
        let transients = self.study.training_marches(&own.transient);
        let mut trained = Vec::with_capacity(transients.len());
        let mut cut_short = Vec::new();
        for (k, transient) in transients.iter().enumerate() {
            let stage = format!("{frame}, training {} of {}", k + 1, transients.len());
            let mut model = FullMarch::new(Arc::clone(&self.grid), transient)?;
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

    fn reduced(
        &self,
        training: &TrajectoryTraining,
        frame: Frame,
        trainings: &[Trajectory],
    ) -> Result<Model, RunError> {
        let begun = Stopwatch::start();
        let model = Arc::new(train_trajectories(&self.grid, trainings, training, self.setting.observer)?);
        let (name, wall_s) = (reduced_name(frame), begun.seconds());
        let model = Model { name, frame, kind: Kind::Reduced(model), wall_s };
        (self.tell)(Row::Model(model.clone()));
        Ok(model)
    }

    /// One model for each rule; their names tell the rule where there are several.
    fn linearised(
        &self,
        linearised: &LinearisedTransient,
        frame: Frame,
        trainings: &Arc<Vec<Trajectory>>,
        models: &mut Vec<Model>,
    ) -> Result<(), RunError> {
        let mut first: Option<Arc<TpwlModel>> = None;
        for selection in linearised.selections() {
            let begun = Stopwatch::start();
            let (asked, known, trainings) = (linearised.clone(), first.clone(), Arc::clone(trainings));
            // Nothing can interrupt it: a cancel need not wait.
            let model = Arc::new(on_one_thread(self.setting.observer, move || match &known {
                None => train_linearised(&asked, &trainings.iter().collect::<Vec<_>>()),
                Some(first) => {
                    first.reselected(asked.points.map_or(selection, |points| first.selection_of(selection, points)))
                }
            })??);
            first.get_or_insert_with(|| Arc::clone(&model));
            let label = linearised.label(selection);
            let mut name = format!("{}.tpwl", frame.name());
            if !linearised.further.is_empty() {
                name = format!("{name}.{label}");
            }
            let kind = Kind::Linearised { model, label, weightings: linearised.weightings.clone() };
            let model = Model { name, frame, kind, wall_s: begun.seconds() };
            (self.tell)(Row::Model(model.clone()));
            models.push(model);
        }
        Ok(())
    }

    /// Marches a model along some inputs, to be held against the full march of a name.
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
