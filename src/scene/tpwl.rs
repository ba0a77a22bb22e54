//! A trajectory-piecewise-linear model as part of a scene: what it is trained by, and what it is tried on.

use super::check::{Checked, count, newtonian_line_in_time, number, refuse};
use super::{PublishedMarch, Scene, published};
use crate::solver::contact::OperatingPoint;
use crate::solver::full::transient::{Frame, Inputs, Keep, TimeStep, Transient};
use crate::solver::reduced::tpwl::{Selection, Weighting};
use serde::{Deserialize, Serialize};

/// Trains models in the fixed frame and compares their marches with the full system's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TpwlStudy {
    /// Training trajectories; each is computed for every reference load.
    pub training: Vec<Drive>,
    /// Reference loads \[N/m\] trained; the scene's own where none is given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub loads: Vec<f64>,
    /// Steps of all marches, full and reduced.
    pub time_step: TimeStep,
    /// Pressure modes.
    pub modes: usize,
    /// Loss of information of the bases of a reduced model with sampled rows, trained by the same trajectories, where one is wanted beside.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rnsa_loss: Option<f64>,
    /// Rules for the operating points; each gives a model.
    pub selections: Vec<Selection>,
    /// Weightings tried with each model.
    #[serde(default = "both", skip_serializing_if = "are_both")]
    pub weightings: Vec<Weighting>,
    /// What the models are tried on, at the scene's own load.
    pub tests: Vec<Drive>,
    /// What was published of their marches.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub published: Vec<PublishedMarch>,
}

/// Inputs with a name, over a time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drive {
    /// The name results go by.
    pub name: String,
    /// R̄, ū and w̄ as functions of T.
    pub inputs: Inputs,
    /// The last T.
    pub duration: f64,
}

fn both() -> Vec<Weighting> {
    vec![Weighting::DualTaylor, Weighting::Dissertation]
}

fn are_both(weightings: &Vec<Weighting>) -> bool {
    *weightings == both()
}

impl TpwlStudy {
    /// The reference loads trained, where the scene's own is `own`.
    pub fn loads(&self, own: f64) -> Vec<f64> {
        if self.loads.is_empty() { vec![own] } else { self.loads.clone() }
    }

    /// Refuses values that are not finite or make no sense, naming the field.
    ///
    /// # Errors
    /// With the first such field.
    pub(super) fn check(&self, scene: &Scene) -> Checked {
        newtonian_line_in_time(scene)?;
        count("study.training (how many)", self.training.len(), 1, 32)?;
        count("study.loads (how many)", self.loads.len(), 0, 16)?;
        count("study.modes", self.modes, 1, 1000)?;
        self.rnsa_loss.iter().try_for_each(|&loss| number("study.rnsa_loss", loss, 1e-12, 0.5))?;
        count("study.selections (how many)", self.selections.len(), 1, 32)?;
        count("study.weightings (how many)", self.weightings.len(), 1, 2)?;
        count("study.tests (how many)", self.tests.len(), 1, 64)?;
        published::check(&self.published, self.tests.iter().map(|test| test.name.as_str()))?;
        for selection in &self.selections {
            number("study.selections.tolerance", selection.tolerance(), 1e-9, 10.0)?;
        }
        let point = scene.point()?;
        for load in self.loads(point.load) {
            for drive in self.training.iter().chain(&self.tests) {
                let transient = Transient {
                    point: OperatingPoint { load, ..point },
                    lubricant: scene.lubricant,
                    inputs: drive.inputs.clone(),
                    frame: Frame::Fixed,
                    duration: drive.duration,
                    time_step: self.time_step,
                    keep: Keep::Scalars,
                };
                let refusal = |problem| refuse("study", format!("is refused, {}: {problem}", drive.name));
                transient.problem().map_err(refusal)?;
            }
        }
        Ok(())
    }
}
