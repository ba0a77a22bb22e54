//! Decision whether a curve is drawn grey. A curve belongs to a request; if the present request differs, the curve
//! is grey. Every frame records what it has drawn.

use super::context::Context;
use super::document::Key;
use super::in_use::InUse;
use super::load_cases;
use crate::app::tabs::transient::Setup;
use crate::scene::Scene;
use crate::solver::training::TrainingSpec;
use egui::{Color32, Id, Ui};
use std::sync::Arc;

/// Opacity of results of a previous request, and of results whose replacement is being computed.
const FORMER: f32 = 0.4;
const COMING: f32 = 0.7;

/// Request or object that a drawing belongs to.
#[derive(Clone, Debug, PartialEq)]
pub enum Owner {
    Contact(Key),
    /// Reduced model with its truncation.
    Model(InUse),
    /// Contact solved by a reduced model.
    ContactByModel(Key, InUse),
    /// Transient contact.
    Transient(Arc<Setup>),
    Training(Box<TrainingSpec>),
    /// Question of a scene.
    Question(Box<Scene>),
    /// Table of load cases.
    Cases(Box<Scene>),
}

impl Owner {
    /// Returns true if the owner belongs to the present request.
    pub fn is_present(&self, context: &Context<'_>) -> bool {
        let document = context.document;
        let serves = |model: &InUse| context.answers.in_use(document).as_ref() == Some(model);
        match self {
            Self::Contact(key) => *key == document.key() || context.answers.shows(key),
            Self::Model(model) => serves(model),
            Self::ContactByModel(key, model) => *key == document.key() && serves(model),
            Self::Transient(setup) => **setup == Setup::of(document, context.file),
            Self::Training(spec) => document.training_spec() == Some(spec.as_ref()),
            Self::Question(scene) => asks_the_same(scene, &document.to_scene()),
            Self::Cases(scene) => asks_the_same(scene, &load_cases::scene_like(document, scene)),
        }
    }
}

/// Returns true if two scenes ask the same question about the same contact.
pub fn asks_the_same(a: &Scene, b: &Scene) -> bool {
    a.study == b.study && a.experiment() == b.experiment()
}

/// Record of a drawing: its name, its owner, and whether it is grey.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    pub name: &'static str,
    /// Owner.
    pub of: Owner,
    /// True if it is grey, because the present request differs.
    pub grey: bool,
}

fn id() -> Id {
    Id::unique("drawn")
}

/// Clears the record of the last frame.
pub fn begin(ctx: &egui::Context) {
    ctx.data_mut(|data| data.get_temp_mut_or_default::<Vec<Drawn>>(id()).clear());
}

/// Returns what this frame has drawn so far.
pub fn all(ctx: &egui::Context) -> Vec<Drawn> {
    ctx.data_mut(|data| data.get_temp_mut_or_default::<Vec<Drawn>>(id()).clone())
}

/// Records a drawing.
pub fn note(ctx: &egui::Context, name: &'static str, of: Owner, grey: bool) {
    ctx.data_mut(|data| data.get_temp_mut_or_default::<Vec<Drawn>>(id()).push(Drawn { name, of, grey }));
}

/// Returns true if results of an owner are drawn grey, because the present request differs. Records the drawing.
pub fn is_grey(ctx: &egui::Context, name: &'static str, of: Owner, context: &Context<'_>) -> bool {
    let grey = !of.is_present(context);
    note(ctx, name, of, grey);
    grey
}

/// Reduces the opacity of the remaining widgets. The reduction is smaller if a replacement is being computed.
pub fn fade(ui: &mut Ui, coming: bool) {
    ui.multiply_opacity(if coming { COMING } else { FORMER });
}

/// Returns the colour that tints an image, grey or not.
pub fn tint(grey: bool) -> Color32 {
    if grey { Color32::from_gray(120) } else { Color32::WHITE }
}
