//! Reduced model in use, with the truncation that the document chooses.

use super::document::{Document, Key};
use super::model_source::Models;
use super::wake::wake;
use crate::app::refusal::Refusal;
use crate::engine::job::Job;
use crate::engine::{Store, Workbench};
use crate::scene::{At, Grid, Method, ModelSource, Scene, Study, StudyRow, View};
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::{OperatingPoint, Sliding};
use crate::solver::reduced::{ReducedModel, ReducedOptions};
use crate::solver::training::random_points;
use std::sync::Arc;

/// Reduced model with its truncation. A study stores it to detect whether its results are out of date.
#[derive(Clone, Debug)]
pub struct InUse {
    pub model: Arc<ReducedModel>,
    pressure_loss: Option<f64>,
    /// Set if the deformation is projected onto its basis.
    deformation_loss: Option<f64>,
}

impl PartialEq for InUse {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.model, &other.model)
            && self.pressure_loss == other.pressure_loss
            && self.deformation_loss == other.deformation_loss
    }
}

impl InUse {
    /// Creates it from a model and a document's view.
    pub fn new(model: &Arc<ReducedModel>, view: &View) -> Self {
        let deformation_loss = view.projected_deformation.then(|| view.deformation_loss.unwrap_or(0.0));
        Self { model: Arc::clone(model), pressure_loss: view.pressure_loss, deformation_loss }
    }

    /// Returns the model for a document's contact, with the document's view.
    pub fn of(document: &Document, models: &Models) -> Option<Self> {
        let model = models.of(&document.point, &document.lubricant)?;
        Some(Self::new(model, &document.view))
    }

    /// Returns the method for a study that uses this model instead of the built-in one.
    pub fn method(&self) -> Method {
        let Self { pressure_loss, deformation_loss, .. } = *self;
        Method::Reduced { model: ModelSource::Embedded, pressure_loss, deformation_loss }
    }

    /// Returns the online options for a contact.
    pub fn options_at(&self, point: &OperatingPoint) -> ReducedOptions {
        let window = self.model.windows.get(self.model.window_for(point));
        window.map_or_else(ReducedOptions::default, |window| self.method().options(window))
    }

    /// Returns the parameter range that the model covers.
    pub fn trained_range(&self) -> ParameterSpace {
        self.model.domain.space.clone()
    }

    /// Returns a study of the model as a scene. The scene contains a contact of the trained range; full solutions
    /// use the model's grid.
    ///
    /// # Errors
    /// If the trained range contains no admissible contact.
    pub fn question(&self, title: &str, study: Study) -> Result<Scene, Refusal> {
        let none = "the model’s range holds no admissible contact to test";
        let points = random_points(&self.trained_range(), self.model.contact(), 1, 1);
        let point = OperatingPoint { sliding: Sliding::NONE, ..*points.first().ok_or_else(|| Refusal::new(none))? };
        Ok(question(title, &Key { point, lubricant: self.model.domain.lubricant }, Grid::Model, study))
    }

    /// Starts a study of the model.
    pub fn ask(&self, ctx: &egui::Context, store: &Store, question: Scene) -> Job<StudyRow> {
        question.ask(Workbench::on(store, "").using(&self.model), wake(ctx))
    }

    /// Returns a description for the screen and for the heads of tables.
    pub fn describe(&self) -> String {
        let pressure =
            self.pressure_loss.map_or_else(|| "all modes".to_owned(), |loss| format!("pressure loss {loss:.1e}"));
        let deformation = match self.deformation_loss {
            None => String::new(),
            Some(0.0) => ", deformation through its basis".to_owned(),
            Some(loss) => format!(", deformation loss {loss:.1e}"),
        };
        format!("{}, {pressure}{deformation}", self.model.title)
    }
}

/// Returns a study of a contact as a scene for the engine.
pub fn question(title: &str, key: &Key, grid: Grid, study: Study) -> Scene {
    let point = &key.point;
    let Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: npr } = point.sliding;
    let moes = point.moes();
    let mut scene = Scene {
        title: title.to_owned(),
        contact: point.kind,
        at: At::from(*point),
        srr,
        npr,
        grid,
        study,
        ..Scene::at_moes(moes.m, moes.l)
    };
    scene.set_laws(key.lubricant);
    scene
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::lubricant::{Cavitation, Heat, Lubricant};

    #[test]
    fn a_question_has_all_laws_of_the_contact_it_is_about() {
        let Document { point, lubricant, .. } = Document::default();
        let laws = Lubricant { cavitation: Cavitation::Complementarity, heat: Some(Heat::default()), ..lubricant };
        let asked = question("", &Key { point, lubricant: laws }, Grid::Graded, Scene::at_moes(40.0, 10.0).study);
        assert_eq!(asked.laws(), laws);
    }
}
