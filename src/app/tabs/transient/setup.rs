//! Set-up of a transient contact, and its study as a scene.

use crate::app::document::{Document, Key};
use crate::app::in_use::question;
use crate::engine::in_time;
use crate::scene::{Grid, LinearisedTransient, ModelSource, ReducedTransient, Scene, Study, TransientStudy};
use crate::solver::full::Problem;
use crate::solver::full::transient::TimeStep;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use std::path::{Path, PathBuf};

/// Set-up of transient runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// Reference contact.
    pub point: OperatingPoint,
    pub lubricant: Lubricant,
    /// Inputs, duration and methods.
    pub study: TransientStudy,
    /// Table from which inputs are read at the start of a run.
    pub sampled: Option<PathBuf>,
    /// Grid of the full system.
    pub grid: Grid,
}

/// Returns why the built-in transient model does not support a study that names it. A model is then trained
/// instead.
fn unserved(document: &Document, study: &TransientStudy) -> Option<String> {
    study.reduced.as_ref().filter(|reduced| reduced.is_embedded())?;
    // Another place reports a damaged model.
    let model = in_time(document.point.kind).ok()?;
    if study.frames != [model.frame] {
        return Some("it supports the fixed frame only".to_owned());
    }
    if document.transient_grid().spec_for(document.point.kind) != Some(model.window.grid.spec()) {
        return Some("it has another grid".to_owned());
    }
    let problem = Problem::new(&document.point, document.lubricant).ok()?;
    model.domain.leaves(&problem, &study.inputs, study.duration)
}

/// Returns a sentence about the reduced model if a document names the built-in one.
pub fn model_in_use(document: &Document) -> Option<String> {
    let study = document.transient_study();
    study.reduced.as_ref().filter(|reduced| reduced.is_embedded())?;
    Some(match unserved(document, &study) {
        None => "The reduced model is the built-in one".to_owned(),
        Some(why) => format!("The reduced model is trained here instead of the built-in one: {why}"),
    })
}

/// Maximum product of nodes and time steps of all full runs for an automatic start. It takes about two seconds.
const QUICK: f64 = 5e5;
/// Computing time of a node of a point contact relative to that of a line contact.
const OF_A_PLANE: f64 = 5.0;

impl Setup {
    /// Returns the set-up of a document. A path of an input table is relative to the folder of the document's file.
    pub fn of(document: &Document, file: Option<&Path>) -> Self {
        let mut study = document.transient_study();
        let folder = file.and_then(Path::parent).unwrap_or(Path::new(""));
        if let Some(ModelSource::File(path) | ModelSource::Trained(path)) =
            study.reduced.as_mut().and_then(|reduced| reduced.model.as_mut())
        {
            *path = folder.join(&*path);
        }
        if unserved(document, &study).is_some() {
            study.reduced = Some(ReducedTransient::trained(document.point.kind));
        }
        Self {
            point: document.point,
            lubricant: document.lubricant,
            sampled: study.sampled.as_ref().map(|path| folder.join(path)),
            study,
            grid: document.transient_grid(),
        }
    }

    /// Returns the study as a scene, without the comparisons that only headless runs make.
    pub(super) fn question(&self) -> Scene {
        let once = |linearised: &LinearisedTransient| LinearisedTransient { further: Vec::new(), ..linearised.clone() };
        let study = TransientStudy {
            sampled: self.sampled.clone(),
            further: Vec::new(),
            published: Vec::new(),
            mass_between: None,
            linearised: self.study.linearised.as_ref().map(once),
            ..self.study.clone()
        };
        let key = Key { point: self.point, lubricant: self.lubricant };
        question("Transient contact", &key, self.grid, Study::Transient(study))
    }

    /// Returns the number of runs.
    pub fn runs(&self) -> usize {
        let TransientStudy { frames, reduced, linearised, .. } = &self.study;
        let linearised = linearised.as_ref().map_or(0, |linearised| linearised.weightings.len());
        frames.len() * (1 + usize::from(reduced.is_some())) + linearised
    }

    /// Returns true if it is fast enough to start automatically.
    pub fn is_quick(&self) -> bool {
        let step = match self.study.time_step {
            // Estimated maximum number of time steps.
            TimeStep::Controlled(tolerance) => 0.1 * tolerance.sqrt(),
            other => other.longest(self.study.duration),
        };
        let nodes = match self.grid {
            _ if self.point.kind.is_point() => {
                let nodes = self.grid.point_spec().and_then(|spec| spec.nodes().ok());
                nodes.map_or(f64::INFINITY, |(along, across)| OF_A_PLANE * (along * across) as f64)
            }
            Grid::Uniform { dx, domain } => (domain.1 - domain.0) / dx,
            Grid::GradedNodes { nodes, .. } => nodes as f64,
            _ => 600.0,
        };
        if self.study.responses().is_some() {
            return false;
        }
        let modelled = self.study.trains(self.point.kind);
        let trained: f64 = self.study.trainings.iter().map(|drive| drive.duration).sum();
        let trained = if modelled {
            trained * self.study.training_loads.len().max(self.study.training_contacts.len()).max(1) as f64
        } else {
            0.0
        };
        (self.study.duration + trained) / step * nodes * self.study.frames.len() as f64 <= QUICK
    }

    /// Returns the seconds per unit of T: a/u_m of the reference contact.
    pub fn time_scale_s(&self) -> f64 {
        self.point.hertz().half_width_m / self.point.speed_m_per_s
    }
}
