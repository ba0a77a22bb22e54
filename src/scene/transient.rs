//! A contact in time as part of a scene.

use super::check::{Checked, count, interval, newtonian_line_in_time, number, refuse};
use super::{At, Grid, PublishedMarch, Scene, published};
use crate::solver::contact::ContactKind;
use crate::solver::full::transient::{Frame, Inputs, Keep, TimeStep, Transient};
use crate::solver::reduced::tpwl::{Selection, Weighting};
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
    /// Lengths of the steps.
    pub time_step: TimeStep,
    /// Frames, each marched on its own; the others are compared with the first.
    #[serde(default = "fixed", skip_serializing_if = "is_fixed")]
    pub frames: Vec<Frame>,
    /// Window of T over which means, amplitudes and differences are taken; the whole duration where there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub window: Option<(f64, f64)>,
    /// A reduced model of each frame beside the full system.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reduced: Option<ReducedTransient>,
    /// A linearised model in the fixed frame beside the full system.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub linearised: Option<LinearisedTransient>,
    /// Two places in units of a_ref, between which the balance of mass is drawn up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_between: Option<(f64, f64)>,
    /// What was published of the frames' marches.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub published: Vec<PublishedMarch>,
}

/// A reduced model of a contact in time: trained on the spot, then marched along the study's inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReducedTransient {
    /// The training trajectories; the study's own where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub trainings: Vec<TrainingInputs>,
    /// Loss of information of the bases, (2.90).
    pub loss: f64,
    /// Sampled rows per pressure mode.
    #[serde(default = "two", skip_serializing_if = "is_two")]
    pub rows_per_mode: f64,
    /// Seed of the cubature.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub seed: u64,
}

/// A trajectory-piecewise-linear model of a contact in time, (4.27): trained on the spot, then marched along the study's inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinearisedTransient {
    /// The training trajectories, which may differ in their loads; the study's own where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub trainings: Vec<TrainingInputs>,
    /// Pressure modes.
    pub modes: usize,
    /// The rule by which moments become operating points.
    pub selection: Selection,
    /// Number of operating points wanted; the rule's tolerance then follows from it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<usize>,
    /// Weightings, each a march of its own.
    #[serde(default = "dual_taylor", skip_serializing_if = "is_dual_taylor")]
    pub weightings: Vec<Weighting>,
}

impl Default for LinearisedTransient {
    /// 100 modes, steps missed by 0.001 (4.30), dual Taylor weights.
    fn default() -> Self {
        let selection = Selection::Step { tolerance: 1e-3 };
        Self { trainings: Vec::new(), modes: 100, selection, points: None, weightings: dual_taylor() }
    }
}

/// A training trajectory; it takes the study's time step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrainingInputs {
    /// Its reference contact; the scene's where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<At>,
    /// Its inputs.
    pub inputs: Inputs,
    /// Its last T.
    pub duration: f64,
}

fn dual_taylor() -> Vec<Weighting> {
    vec![Weighting::DualTaylor]
}

fn is_dual_taylor(weightings: &Vec<Weighting>) -> bool {
    *weightings == dual_taylor()
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

fn is_default(inputs: &Inputs) -> bool {
    *inputs == Inputs::default()
}

fn fixed() -> Vec<Frame> {
    vec![Frame::Fixed]
}

fn is_fixed(frames: &Vec<Frame>) -> bool {
    *frames == fixed()
}

impl TransientStudy {
    /// The window of its statistics.
    pub fn window(&self) -> (f64, f64) {
        self.window.unwrap_or((0.0, self.duration))
    }

    /// Refuses values that are not finite or make no sense, naming the field.
    ///
    /// # Errors
    /// With the first such field.
    pub(super) fn check(&self, scene: &Scene) -> Checked {
        newtonian_line_in_time(scene)?;
        count("study.frames (how many)", self.frames.len(), 1, 4)?;
        if (1..self.frames.len()).any(|i| self.frames[..i].contains(&self.frames[i])) {
            return Err(refuse("study.frames", "must not name a frame twice: results are named by it"));
        }
        published::check(&self.published, self.frames.iter().map(|frame| frame.name()))?;
        number("study.duration", self.duration, 1e-6, 1e6)?;
        if let Some(window) = self.window {
            interval("study.window", window, 0.0, self.duration)?;
        }
        if let Some(places) = self.mass_between {
            interval("study.mass_between", places, -4.0, 1.0)?;
        }
        self.check_march(scene, "study", None, &self.inputs, self.duration)?;
        if let Some(reduced) = &self.reduced {
            if !matches!(scene.grid, Grid::Uniform { .. } | Grid::GradedNodes { registered: false, .. }) {
                return Err(refuse(
                    "grid",
                    "must be Uniform, or GradedNodes without registration, for a reduced model in time",
                ));
            }
            number("study.reduced.loss", reduced.loss, 1e-12, 0.5)?;
            number("study.reduced.rows_per_mode", reduced.rows_per_mode, 1.0, 20.0)?;
            self.check_trainings(scene, "study.reduced", &reduced.trainings)?;
        }
        let Some(linearised) = &self.linearised else { return Ok(()) };
        if !self.frames.contains(&Frame::Fixed) {
            return Err(refuse(
                "study.frames",
                "must hold Fixed for a linearised model, which lives in the fixed frame",
            ));
        }
        let LinearisedTransient { modes, selection, points, weightings, trainings } = linearised;
        count("study.linearised.modes", *modes, 1, 1000)?;
        number("study.linearised.selection.tolerance", selection.tolerance(), 1e-9, 10.0)?;
        points.iter().try_for_each(|&points| count("study.linearised.points", points, 1, 10_000))?;
        count("study.linearised.weightings (how many)", weightings.len(), 1, 2)?;
        if weightings.get(1) == weightings.first() {
            return Err(refuse("study.linearised.weightings", "must not name a weighting twice"));
        }
        self.check_trainings(scene, "study.linearised", trainings)
    }

    /// Checks the training trajectories of a model.
    fn check_trainings(&self, scene: &Scene, model: &str, trainings: &[TrainingInputs]) -> Checked {
        count(&format!("{model}.trainings (how many)"), trainings.len(), 0, 64)?;
        for (i, training) in trainings.iter().enumerate() {
            let field = format!("{model}.trainings.{i}");
            number(&format!("{field}.duration"), training.duration, 1e-6, 1e6)?;
            self.check_march(scene, &field, training.at, &training.inputs, training.duration)?;
        }
        Ok(())
    }

    /// Checks a march with the study's steps; at the scene's own contact where no other is given.
    fn check_march(&self, scene: &Scene, field: &str, at: Option<At>, inputs: &Inputs, duration: f64) -> Checked {
        let (lubricant, time_step, inputs) = (scene.lubricant, self.time_step, inputs.clone());
        let point = match at {
            Some(at) => at.with_alpha_of(&lubricant).point(ContactKind::Line)?,
            None => scene.point()?,
        };
        let (frame, keep) = (Frame::Fixed, Keep::Scalars);
        let transient = Transient { point, lubricant, inputs, frame, duration, time_step, keep };
        transient.check().map_err(|problem| refuse(field, format!("is refused: {problem}")))
    }
}
