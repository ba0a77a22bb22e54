//! A contact in time as part of a scene.

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
    /// Two places in units of a_ref, between which the balance of mass is drawn up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_between: Option<(f64, f64)>,
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
