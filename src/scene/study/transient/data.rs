//! Data of a transient study in a scene: inputs, frames, and the models to compare.

use super::coverage;
use super::marches::training_contact;
use super::published::{self, PublishedMarch};
use super::surfaces::{self, SurfaceFeature};
use crate::scene::check::{Checked, count, interval, number, refuse};
use crate::scene::experiment::Experiment;
use crate::scene::grid::Grid;
use crate::scene::method::ModelSource;
use crate::scene::written::is_default;
use crate::solver::full::transient::{Frame, Inputs, Scheme, Signal, TimeStep, Transient, Unsupported};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::reduced::tpwl::{Selection, Weighting};
use crate::solver::training::{LocalBases, ResponseTraining, TrajectoryTraining};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Transient study of a contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TransientStudy {
    /// R̄, ū and w̄ as functions of T, relative to the scene's operating point.
    #[serde(default, skip_serializing_if = "is_default")]
    pub inputs: Inputs,
    /// CSV file whose columns replace the inputs of the same names; relative paths refer to this scene's folder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sampled: Option<PathBuf>,
    /// End time T, in units of a_ref/u_ref.
    pub duration: f64,
    /// Further inputs, each computed by the same models and by the full solver.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub further: Vec<Drive>,
    /// Time step of all marches.
    pub time_step: TimeStep,
    /// Prescribed rigid-body separation: H₀ of the start plus this signal minus 1, in units of a²/R. The load is then a
    /// result, in the column `load` of the series. Linearised models do not support it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub separation: Option<Signal>,
    /// Features of the surfaces that move through the contact. They need the full solver.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub surfaces: Vec<SurfaceFeature>,
    /// Time scheme of the full solver.
    #[serde(default, skip_serializing_if = "is_default")]
    pub scheme: Scheme,
    /// Frames of reference, each with its own march. The others are compared with the first.
    #[serde(default = "fixed", skip_serializing_if = "is_fixed")]
    pub frames: Vec<Frame>,
    /// Interval of T for means, amplitudes and differences; the whole duration if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub window: Option<(f64, f64)>,
    /// Inputs for training the models; the study's own inputs if empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub trainings: Vec<Drive>,
    /// Reference loads \[N/m\] for training; the scene's own load if empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub training_loads: Vec<f64>,
    /// Reference contacts (M, L) for training, with radius and lubricant of the scene's contact; the scene's contact if
    /// empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub training_contacts: Vec<(f64, f64)>,
    /// Reduced model of each frame, in addition to the full solver.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reduced: Option<ReducedTransient>,
    /// Linearised models in the fixed frame, in addition to the full solver.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub linearised: Option<LinearisedTransient>,
    /// Two positions in units of a_ref between which the mass balance is evaluated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_between: Option<(f64, f64)>,
    /// Published data of the marches.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub published: Vec<PublishedMarch>,
}

/// Inputs over an interval of time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drive {
    /// Name in results; trainings need none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// R̄, ū and w̄ as functions of T.
    pub inputs: Inputs,
    /// End time T.
    pub duration: f64,
}

/// Transient reduced model: trained in the study or loaded, then marched along all inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReducedTransient {
    /// Saved model, or model that another scene trains. If absent, the study trains one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<ModelSource>,
    /// Loss of information of the bases, (2.90).
    #[serde(default = "millionth", skip_serializing_if = "is_millionth")]
    pub loss: f64,
    /// Number of sampled equations per pressure mode.
    #[serde(default = "two", skip_serializing_if = "is_two")]
    pub rows_per_mode: f64,
    /// Seed of the cubature.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub seed: u64,
    /// Local bases along the trainings. If absent, one basis covers all states.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub local: Option<LocalBases>,
    /// Training of a circular contact, from linear responses and one march. It replaces the trainings of the study and
    /// the settings above.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub responses: Option<ResponseTraining>,
}

/// Trajectory-piecewise-linear models of a transient contact, (4.27): trained in the study, then marched along all
/// inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinearisedTransient {
    /// Number of pressure modes.
    pub modes: usize,
    /// Rule that selects operating points among the moments of the training.
    pub selection: Selection,
    /// Further rules or tolerances, each for a separate model.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub further: Vec<Selection>,
    /// Requested number of operating points. If given, it determines the tolerances of the rules.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<usize>,
    /// Weightings, each with its own march.
    #[serde(default = "dual_taylor", skip_serializing_if = "is_dual_taylor")]
    pub weightings: Vec<Weighting>,
}

impl Default for ReducedTransient {
    /// Returns a loss of 1e-6 and two equations per mode.
    fn default() -> Self {
        Self { model: None, loss: millionth(), rows_per_mode: two(), seed: one(), local: None, responses: None }
    }
}

impl Default for LinearisedTransient {
    /// Returns 100 modes, a step-error tolerance of 0.001 (4.30), and dual Taylor weights.
    fn default() -> Self {
        let selection = Selection::Step { tolerance: 1e-3 };
        Self { modes: 100, selection, further: Vec::new(), points: None, weightings: dual_taylor() }
    }
}

fn dual_taylor() -> Vec<Weighting> {
    vec![Weighting::DualTaylor]
}

fn is_dual_taylor(weightings: &Vec<Weighting>) -> bool {
    *weightings == dual_taylor()
}

fn millionth() -> f64 {
    1e-6
}

fn is_millionth(loss: &f64) -> bool {
    *loss == millionth()
}

fn two() -> f64 {
    2.0
}

fn is_two(rows: &f64) -> bool {
    *rows == two()
}

fn one() -> u64 {
    1
}

fn is_one(seed: &u64) -> bool {
    *seed == one()
}

fn fixed() -> Vec<Frame> {
    vec![Frame::Fixed]
}

fn is_fixed(frames: &Vec<Frame>) -> bool {
    *frames == fixed()
}

impl Drive {
    /// Returns the name of a result: the name of a frame or model, preceded by the name of the inputs if they have one.
    pub fn result(&self, name: &str) -> String {
        if self.name.is_empty() { name.to_owned() } else { format!("{}.{name}", self.name) }
    }
}

impl ReducedTransient {
    /// Returns the usual training of a circular contact.
    pub fn by_responses() -> Self {
        Self { responses: Some(ResponseTraining::default()), ..Self::default() }
    }

    /// Returns the usual training of a contact.
    pub fn trained(kind: ContactKind) -> Self {
        if kind.is_line() { Self::default() } else { Self::by_responses() }
    }

    /// Returns the embedded model.
    pub fn embedded() -> Self {
        Self { model: Some(ModelSource::Embedded), ..Self::default() }
    }

    /// Returns true for the embedded model.
    pub fn is_embedded(&self) -> bool {
        self.model == Some(ModelSource::Embedded)
    }

    /// Returns the training of the model from full marches; `None` if a saved model is given, or if the model is of a
    /// circular contact.
    pub fn training(&self) -> Option<TrajectoryTraining> {
        let &Self { ref model, loss, rows_per_mode, seed, local, responses } = self;
        (model.is_none() && responses.is_none()).then(|| TrajectoryTraining {
            loss,
            rows_per_mode,
            seed,
            local,
            ..Default::default()
        })
    }

    fn check(&self, experiment: &Experiment) -> Checked {
        let (grid, kind) = (&experiment.grid, experiment.contact);
        if experiment.point().is_ok_and(|point| point.is_elliptic()) {
            return Err(coverage::refused(Unsupported::PointContact));
        }
        if self.model.is_some() {
            if *self != (Self { model: self.model.clone(), ..Self::default() }) {
                let problem = "must be the only field: all other fields belong to a training";
                return Err(refuse("study.reduced.model", problem));
            }
            return Ok(());
        }
        if let Some(responses) = &self.responses {
            if *self != (Self { responses: self.responses, ..Self::default() }) {
                let problem = "must be the only field: it has its own numbers of modes and rows";
                return Err(refuse("study.reduced.responses", problem));
            }
            if kind.is_line() {
                return Err(refuse(
                    "study.reduced.responses",
                    "is for point contacts; leave it out for a line contact",
                ));
            }
            if !matches!(grid, Grid::Plane(_)) {
                return Err(refuse("grid", "must be Plane for a transient reduced model of a circular contact"));
            }
            return responses
                .check()
                .map_err(|problem| refuse("study.reduced.responses", format!("is refused: {problem}")));
        }
        if kind.is_point() {
            let problem = "must hold `responses: ()` or a model, because the contact is a point contact";
            return Err(refuse("study.reduced", problem));
        }
        if !matches!(grid, Grid::Uniform { .. } | Grid::GradedNodes { registered: false, .. }) {
            return Err(refuse(
                "grid",
                "must be Uniform, or GradedNodes without registration, for a transient reduced model",
            ));
        }
        number("study.reduced.loss", self.loss, 1e-12, 0.5)?;
        number("study.reduced.rows_per_mode", self.rows_per_mode, 1.0, 20.0)?;
        self.local.iter().try_for_each(|local| {
            count("study.reduced.local.clusters", local.clusters, 2, 64)?;
            count("study.reduced.local.modes", local.modes, 5, 500)
        })
    }
}

impl LinearisedTransient {
    /// Returns the usual settings for a contact. A circular contact has the modes of its reduced model, and fewer points.
    pub fn usual(kind: ContactKind) -> Self {
        match kind {
            ContactKind::Line => Self::default(),
            ContactKind::Point => {
                Self { modes: 80, selection: Selection::Distance { tolerance: 0.07 }, ..Self::default() }
            }
        }
    }

    /// Returns all selection rules, starting with the first.
    pub fn selections(&self) -> impl Iterator<Item = Selection> {
        std::iter::once(self.selection).chain(self.further.iter().copied())
    }

    /// Returns the name of the model of a rule, as in `step_0.001` or `step_40_points`.
    pub fn label(&self, selection: Selection) -> String {
        match self.points {
            Some(points) => format!("{}_{points}_points", selection.name()),
            None => format!("{}_{}", selection.name(), selection.tolerance()),
        }
    }

    fn check(&self, frames: &[Frame]) -> Checked {
        if !frames.contains(&Frame::Fixed) {
            return Err(refuse(
                "study.frames",
                "must hold Fixed for a linearised model, which lives in the fixed frame",
            ));
        }
        let tolerance =
            |selection: Selection| number("study.linearised.selection.tolerance", selection.tolerance(), 1e-9, 10.0);
        count("study.linearised.modes", self.modes, 1, 1000)?;
        count("study.linearised.further (how many)", self.further.len(), 0, 31)?;
        self.selections().try_for_each(tolerance)?;
        self.points.iter().try_for_each(|&points| count("study.linearised.points", points, 1, 10_000))?;
        let labels: Vec<String> = self.selections().map(|selection| self.label(selection)).collect();
        if let Some(twice) = (1..labels.len()).find(|&i| labels[..i].contains(&labels[i])) {
            let problem = format!(
                "gives {} twice; results are named by rule and tolerance, or by rule and number",
                labels[twice]
            );
            return Err(refuse("study.linearised.further", problem));
        }
        count("study.linearised.weightings (how many)", self.weightings.len(), 1, 2)?;
        if self.weightings.get(1) == self.weightings.first() {
            return Err(refuse("study.linearised.weightings", "must not name a weighting twice"));
        }
        Ok(())
    }
}

impl TransientStudy {
    /// Creates a study of the full system in the fixed frame.
    pub fn new(inputs: Inputs, duration: f64, time_step: TimeStep) -> Self {
        Self {
            inputs,
            sampled: None,
            duration,
            further: Vec::new(),
            time_step,
            separation: None,
            surfaces: Vec::new(),
            scheme: Scheme::Default,
            frames: fixed(),
            window: None,
            trainings: Vec::new(),
            training_loads: Vec::new(),
            training_contacts: Vec::new(),
            reduced: None,
            linearised: None,
            mass_between: None,
            published: Vec::new(),
        }
    }

    /// Removes the trainings of the models, so that they are trained on the study's own inputs.
    pub fn drop_trainings(&mut self) {
        self.trainings.clear();
        self.training_loads.clear();
        self.training_contacts.clear();
    }

    /// Removes the models and their trainings.
    pub fn drop_models(&mut self) {
        (self.reduced, self.linearised) = (None, None);
        self.drop_trainings();
    }

    /// Refuses values that are not finite or out of range, and names the field.
    ///
    /// # Errors
    /// With the first invalid field.
    pub(super) fn check_with(&self, experiment: &Experiment) -> Checked {
        let by_model = self.reduced.is_some() || self.linearised.is_some();
        coverage::check_full(experiment, self.mass_between.is_some())?;
        count("study.frames (how many)", self.frames.len(), 1, 4)?;
        if (1..self.frames.len()).any(|i| self.frames[..i].contains(&self.frames[i])) {
            return Err(refuse("study.frames", "must not name a frame twice: results are named by it"));
        }
        self.check_names()?;
        let drives = self.drives();
        // Data may have been published for a frame that the study leaves out.
        let names = Frame::ALL.iter().flat_map(|&frame| drives.iter().map(move |drive| drive.result(frame.name())));
        let names: Vec<String> = names.collect();
        published::check(&self.published, names.iter().map(String::as_str))?;
        number("study.duration", self.duration, 1e-6, 1e6)?;
        for (list, drives) in [("further", &self.further), ("trainings", &self.trainings)] {
            for (i, drive) in drives.iter().enumerate() {
                number(&format!("study.{list}.{i}.duration"), drive.duration, 1e-6, 1e6)?;
            }
        }
        if let Some(window) = self.window {
            let shortest = drives.iter().map(|drive| drive.duration).fold(self.duration, f64::min);
            interval("study.window", window, 0.0, shortest)?;
        }
        if let Some(places) = self.mass_between {
            interval("study.mass_between", places, -4.0, 1.0)?;
        }
        self.training_loads.iter().try_for_each(|&load| number("study.training_loads", load, 1e-6, 1e10))?;
        surfaces::check(&self.surfaces)?;
        self.check_contacts(experiment)?;
        self.check_marches(experiment)?;
        let full_only =
            [("study.surfaces", !self.surfaces.is_empty()), ("study.scheme", self.scheme == Scheme::Characteristic)];
        if let Some((field, _)) = full_only.into_iter().find(|(_, given)| *given && by_model) {
            return Err(refuse(field, "needs the full solver; leave it out, or leave out reduced and linearised"));
        }
        if self.separation.is_some() && self.linearised.is_some() {
            return Err(refuse("study.separation", "is not supported by linearised models; leave out linearised"));
        }
        if by_model {
            coverage::check_models(experiment)?;
        }
        self.reduced.iter().try_for_each(|reduced| reduced.check(experiment))?;
        if experiment.contact.is_point() && self.linearised.is_some() && self.reduced.is_none() {
            let problem = "needs `reduced` for a point contact: both models have one basis";
            return Err(refuse("study.linearised", problem));
        }
        self.linearised.iter().try_for_each(|linearised| linearised.check(&self.frames))
    }

    /// Refuses too many inputs, and names of further inputs that cannot be part of result and file names.
    fn check_names(&self) -> Checked {
        count("study.further (how many)", self.further.len(), 0, 63)?;
        count("study.trainings (how many)", self.trainings.len(), 0, 64)?;
        count("study.training_loads (how many)", self.training_loads.len(), 0, 16)?;
        count("study.training_contacts (how many)", self.training_contacts.len(), 0, 64)?;
        for (i, drive) in self.further.iter().enumerate() {
            let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
            if drive.name.is_empty() || !drive.name.chars().all(plain) {
                let problem = format!(
                    "is `{}`, but must be made of letters, digits, _ and -: results are named by it",
                    drive.name
                );
                return Err(refuse(format!("study.further.{i}.name"), problem));
            }
            if self.further[..i].iter().any(|other| other.name == drive.name) {
                let problem = format!("is `{}` again; results are named by it", drive.name);
                return Err(refuse(format!("study.further.{i}.name"), problem));
            }
        }
        Ok(())
    }

    /// Refuses reference contacts for training that are invalid or that the models do not support.
    fn check_contacts(&self, experiment: &Experiment) -> Checked {
        let Some(first) = self.training_contacts.first() else { return Ok(()) };
        let field = |i: usize| format!("study.training_contacts.{i}");
        let others = if self.linearised.is_some() {
            Some("a linearised model, whose reference contacts differ in their load alone")
        } else if self.training_loads.is_empty() {
            None
        } else {
            Some("training_loads")
        };
        if let Some(others) = others {
            return Err(refuse(field(0), format!("is {first:?}, but must be left out with {others}")));
        }
        let own = experiment.point().map_err(|problem| refuse("at", format!("is refused: {problem}")))?;
        self.training_contacts.iter().enumerate().try_for_each(|(i, contact)| {
            let made = training_contact(&own, *contact);
            made.map(|_| ()).map_err(|problem| refuse(field(i), format!("is refused: {problem}")))
        })
    }

    /// Checks every march of the study.
    fn check_marches(&self, experiment: &Experiment) -> Checked {
        let point = experiment.point().map_err(|problem| refuse("at", format!("is refused: {problem}")))?;
        let lubricant = experiment.lubricant;
        let check = |field: String, transient: &Transient| {
            transient.check().map_err(|problem| refuse(field, format!("is refused: {problem}")))
        };
        let own = self.own_march(point, lubricant, Frame::Fixed);
        let sliding = OperatingPoint { sliding: experiment.sliding, ..point };
        // The run reads and checks profiles.
        let stated = self.surfaces.iter().filter_map(|surface| surface.moving(&sliding, |_| Err(())).ok());
        let frame = self.frames.iter().copied().find(|frame| *frame != Frame::Fixed).unwrap_or_default();
        let own = Transient { surfaces: stated.collect(), ..own };
        check("study".to_owned(), &Transient { frame, ..own.clone() })?;
        let spacing = match experiment.grid {
            Grid::Uniform { dx, .. } => Some(dx),
            Grid::Plane(spec) => Some(spec.dx),
            _ => None,
        };
        if let Some(dx) = spacing {
            let x: Vec<f64> = (-200..=200).map(|k| dx * f64::from(k)).collect();
            own.check_on(&x).map_err(|problem| refuse("study", format!("is refused: {problem}")))?;
        }
        for (i, drive) in self.further.iter().enumerate() {
            check(format!("study.further.{i}"), &self.march(drive, point, lubricant, Frame::Fixed))?;
        }
        let per_contact = self.trainings.len().max(1);
        for (i, training) in self.training_marches(&own).iter().enumerate() {
            let OperatingPoint { load, speed_m_per_s, .. } = training.point;
            let other = match (self.training_loads.is_empty(), self.training_contacts.is_empty()) {
                (true, true) => String::new(),
                (false, _) => format!(" at {load} N/m"),
                (true, false) => format!(" at {load} N/m, {speed_m_per_s} m/s"),
            };
            check(format!("study.trainings.{}{other}", i % per_contact), training)?;
        }
        Ok(())
    }
}
