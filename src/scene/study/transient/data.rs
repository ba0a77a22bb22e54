//! A contact in time as part of a scene: what drives it, in which frames and by which models it is followed.

use super::coverage;
use super::marches::training_contact;
use super::published::{self, PublishedMarch};
use crate::scene::check::{Checked, count, interval, number, refuse};
use crate::scene::experiment::Experiment;
use crate::scene::grid::Grid;
use crate::scene::method::ModelSource;
use crate::scene::written::is_default;
use crate::solver::full::transient::{Frame, Inputs, TimeStep, Transient};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::tpwl::{Selection, Weighting};
use crate::solver::training::{LocalBases, TrajectoryTraining};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What is asked of a contact in time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TransientStudy {
    /// R̄, ū and w̄ as functions of T; the scene's operating point is the reference.
    #[serde(default, skip_serializing_if = "is_default")]
    pub inputs: Inputs,
    /// A CSV file whose columns take the place of the inputs of their names; relative paths refer to this scene's folder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sampled: Option<PathBuf>,
    /// The last T, in units of a_ref/u_ref.
    pub duration: f64,
    /// Further inputs, each followed by the same models beside the full system.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub further: Vec<Drive>,
    /// Lengths of the steps of all marches.
    pub time_step: TimeStep,
    /// Frames, each marched on its own; the others are compared with the first.
    #[serde(default = "fixed", skip_serializing_if = "is_fixed")]
    pub frames: Vec<Frame>,
    /// Window of T over which means, amplitudes and differences are taken; the whole duration where there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub window: Option<(f64, f64)>,
    /// Inputs that the models are trained by; the study's own where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub trainings: Vec<Drive>,
    /// Reference loads \[N/m\] at which they are trained; the scene's own where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub training_loads: Vec<f64>,
    /// Reference contacts (M, L) at which they are trained, with the radius and the oil of the scene's own; that one where
    /// there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub training_contacts: Vec<(f64, f64)>,
    /// A reduced model of each frame beside the full system.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reduced: Option<ReducedTransient>,
    /// Linearised models in the fixed frame beside the full system.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub linearised: Option<LinearisedTransient>,
    /// Two places in units of a_ref, between which the balance of mass is drawn up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_between: Option<(f64, f64)>,
    /// What was published of the marches.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub published: Vec<PublishedMarch>,
}

/// Inputs over a time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drive {
    /// The name results go by; trainings need none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// R̄, ū and w̄ as functions of T.
    pub inputs: Inputs,
    /// The last T.
    pub duration: f64,
}

/// A reduced model of a contact in time: trained on the spot or saved before, then marched along all inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReducedTransient {
    /// One that was saved, or that another scene trains, in place of one that is trained on the spot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<ModelSource>,
    /// Loss of information of the bases, (2.90).
    #[serde(default = "millionth", skip_serializing_if = "is_millionth")]
    pub loss: f64,
    /// Sampled rows per pressure mode.
    #[serde(default = "two", skip_serializing_if = "is_two")]
    pub rows_per_mode: f64,
    /// Seed of the cubature.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub seed: u64,
    /// Local bases along the trainings in place of one that serves all states.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub local: Option<LocalBases>,
}

/// Trajectory-piecewise-linear models of a contact in time, (4.27): trained on the spot, then marched along all inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinearisedTransient {
    /// Pressure modes.
    pub modes: usize,
    /// The rule by which moments become operating points.
    pub selection: Selection,
    /// Further rules or tolerances, each a model of its own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub further: Vec<Selection>,
    /// Number of operating points wanted; the rules' tolerances then follow from it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<usize>,
    /// Weightings, each a march of its own.
    #[serde(default = "dual_taylor", skip_serializing_if = "is_dual_taylor")]
    pub weightings: Vec<Weighting>,
}

impl Default for ReducedTransient {
    /// A loss of 1e-6, two rows per mode.
    fn default() -> Self {
        Self { model: None, loss: millionth(), rows_per_mode: two(), seed: one(), local: None }
    }
}

impl Default for LinearisedTransient {
    /// 100 modes, steps missed by 0.001 (4.30), dual Taylor weights.
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
    /// What a result of it is called: a frame's or a model's name, behind its own where it has one.
    pub fn result(&self, name: &str) -> String {
        if self.name.is_empty() { name.to_owned() } else { format!("{}.{name}", self.name) }
    }
}

impl ReducedTransient {
    /// The model of the program.
    pub fn embedded() -> Self {
        Self { model: Some(ModelSource::Embedded), ..Self::default() }
    }

    /// Whether it is the model of the program.
    pub fn is_embedded(&self) -> bool {
        self.model == Some(ModelSource::Embedded)
    }

    /// What a study trains by it; none where it has a model already.
    pub fn training(&self) -> Option<TrajectoryTraining> {
        let &Self { ref model, loss, rows_per_mode, seed, local } = self;
        model.is_none().then(|| TrajectoryTraining { loss, rows_per_mode, seed, local, ..Default::default() })
    }

    fn check(&self, grid: &Grid) -> Checked {
        if self.model.is_some() {
            if *self != (Self { model: self.model.clone(), ..Self::default() }) {
                let problem = "has nothing beside it: loss, rows_per_mode, seed and local belong to a training";
                return Err(refuse("study.reduced.model", problem));
            }
            return Ok(());
        }
        if !matches!(grid, Grid::Uniform { .. } | Grid::GradedNodes { registered: false, .. }) {
            return Err(refuse(
                "grid",
                "must be Uniform, or GradedNodes without registration, for a reduced model in time",
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
    /// All rules, its own first.
    pub fn selections(&self) -> impl Iterator<Item = Selection> {
        std::iter::once(self.selection).chain(self.further.iter().copied())
    }

    /// The name of the model that a rule gives, as in `step_0.001` or `step_40_points`.
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
    /// Refuses values that are not finite or make no sense, naming the field.
    ///
    /// # Errors
    /// With the first such field.
    pub(super) fn check_with(&self, experiment: &Experiment) -> Checked {
        coverage::check(experiment)?;
        count("study.frames (how many)", self.frames.len(), 1, 4)?;
        if (1..self.frames.len()).any(|i| self.frames[..i].contains(&self.frames[i])) {
            return Err(refuse("study.frames", "must not name a frame twice: results are named by it"));
        }
        self.check_names()?;
        let drives = self.drives();
        // A frame that was left out may have been published of.
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
        self.check_contacts(experiment)?;
        self.check_marches(experiment)?;
        let models = self.reduced.is_some() || self.linearised.is_some();
        if models {
            coverage::check_models(experiment)?;
        }
        self.reduced.iter().try_for_each(|reduced| reduced.check(&experiment.grid))?;
        self.linearised.iter().try_for_each(|linearised| linearised.check(&self.frames))
    }

    /// Refuses more inputs than make sense, and further ones whose names cannot stand in those of results and of their files.
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

    /// Refuses reference contacts of trainings that are none, or that models cannot learn.
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
            return Err(refuse(field(0), format!("is {first:?}, but must be left out beside {others}")));
        }
        let own = experiment.point().map_err(|problem| refuse("at", format!("is refused: {problem}")))?;
        self.training_contacts.iter().enumerate().try_for_each(|(i, contact)| {
            let made = training_contact(&own, *contact);
            made.map(|_| ()).map_err(|problem| refuse(field(i), format!("is refused: {problem}")))
        })
    }

    /// Checks every march that it asks for.
    fn check_marches(&self, experiment: &Experiment) -> Checked {
        let point = experiment.point().map_err(|problem| refuse("at", format!("is refused: {problem}")))?;
        let lubricant = experiment.lubricant;
        let check = |field: String, transient: &Transient| {
            transient.check().map_err(|problem| refuse(field, format!("is refused: {problem}")))
        };
        let own = self.own_march(point, lubricant, Frame::Fixed);
        check("study".to_owned(), &own)?;
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
