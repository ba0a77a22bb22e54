//! A curve belongs to what was asked. Where that is not what is asked now it is drawn grey: here it is decided, and noted
//! for everything that a frame draws.

use super::context::Context;
use super::document::Key;
use super::in_use::InUse;
use crate::app::tabs::transient::Setup;
use crate::scene::Scene;
use crate::solver::training::TrainingSpec;
use egui::{Color32, Id, Ui};
use std::sync::Arc;

/// Opacity of what belongs to a former question, and of it while its answer is about to come.
const FORMER: f32 = 0.4;
const COMING: f32 = 0.7;

/// What something drawn belongs to.
#[derive(Clone, Debug, PartialEq)]
pub enum Owner {
    Contact(Key),
    /// A reduced model, as it is truncated.
    Model(InUse),
    /// A contact by a reduced model.
    ContactByModel(Key, InUse),
    /// A transient contact.
    Transient(Arc<Setup>),
    Training(Box<TrainingSpec>),
    /// The question of a scene.
    Question(Box<Scene>),
}

impl Owner {
    /// Whether that is what is asked now.
    pub fn is_present(&self, context: &Context<'_>) -> bool {
        let document = context.document;
        let serves = |model: &InUse| context.answers.in_use(document).as_ref() == Some(model);
        match self {
            Self::Contact(key) => *key == document.key(),
            Self::Model(model) => serves(model),
            Self::ContactByModel(key, model) => *key == document.key() && serves(model),
            Self::Transient(setup) => **setup == Setup::of(document, context.file),
            Self::Training(spec) => document.training_spec() == Some(spec.as_ref()),
            Self::Question(scene) => asks_the_same(scene, &document.to_scene()),
        }
    }
}

/// Whether two scenes ask the same question of the same contact.
pub fn asks_the_same(a: &Scene, b: &Scene) -> bool {
    a.study == b.study && a.experiment() == b.experiment()
}

/// Something drawn: what it is called, what it belongs to, and whether it is grey.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    pub name: &'static str,
    /// What it belongs to.
    pub of: Owner,
    /// Whether it stands back because that is not what is asked now.
    pub grey: bool,
}

fn id() -> Id {
    Id::unique("drawn")
}

/// Forgets what the last frame drew.
pub fn begin(ctx: &egui::Context) {
    ctx.data_mut(|data| data.get_temp_mut_or_default::<Vec<Drawn>>(id()).clear());
}

/// What this frame has drawn so far.
pub fn all(ctx: &egui::Context) -> Vec<Drawn> {
    ctx.data_mut(|data| data.get_temp_mut_or_default::<Vec<Drawn>>(id()).clone())
}

/// Notes something that is drawn grey or not.
pub fn note(ctx: &egui::Context, name: &'static str, of: Owner, grey: bool) {
    ctx.data_mut(|data| data.get_temp_mut_or_default::<Vec<Drawn>>(id()).push(Drawn { name, of, grey }));
}

/// Whether what belongs to something is to be grey, for something else is asked now; noted.
pub fn is_grey(ctx: &egui::Context, name: &'static str, of: Owner, context: &Context<'_>) -> bool {
    let grey = !of.is_present(context);
    note(ctx, name, of, grey);
    grey
}

/// Lets the rest of a room stand back, a little where it is about to be replaced.
pub fn fade(ui: &mut Ui, coming: bool) {
    ui.multiply_opacity(if coming { COMING } else { FORMER });
}

/// What an image is multiplied with, grey or not.
pub fn tint(grey: bool) -> Color32 {
    if grey { Color32::from_gray(120) } else { Color32::WHITE }
}
