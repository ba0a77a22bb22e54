//! A contact in time as part of a scene.

use super::At;
use crate::solver::full::transient::{Frame, Inputs, TimeStep};
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
    /// Two places in units of a_ref, between which the balance of mass is drawn up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_between: Option<(f64, f64)>,
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
}
