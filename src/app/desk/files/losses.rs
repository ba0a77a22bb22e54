//! Dialog that asks for confirmation before an action discards unsaved data. It lists the losses. An action without
//! losses needs no confirmation.

use super::open::is_model;
use super::state::Pending;
use crate::app::desk::Desk;
use egui::{Context, Id, Modal};

impl Pending {
    /// Returns the label of the button that confirms the loss.
    fn consent(&self) -> &'static str {
        match self {
            Self::New | Self::OpenDialog | Self::Open(_) | Self::OpenScene(_) | Self::OpenLink(_) => "Discard changes",
            Self::Quit => "Quit anyway",
            Self::Train => "Start anyway",
            Self::DiscardTraining | Self::ThrowModelAway => "Discard it",
        }
    }
}

impl Desk {
    /// Returns the losses of an action, one sentence each.
    pub(super) fn losses(&self, pending: &Pending) -> Vec<String> {
        let edits = || {
            let text = "The operating point or its settings have changed since they were last saved.";
            self.dirty().then(|| text.to_owned())
        };
        let study = || {
            let text = "The study of the scene is running. Its results so far are not saved.";
            self.tabs.results.would_lose().then(|| text.to_owned())
        };
        let transient_run = || {
            let text = "A transient run is being computed. Its results so far are not saved.";
            self.transient.runs_by_hand().then(|| text.to_owned())
        };
        match pending {
            Pending::Open(path) if is_model(path) => Vec::new(),
            Pending::New | Pending::OpenDialog | Pending::Open(_) | Pending::OpenScene(_) | Pending::OpenLink(_) => {
                edits().into_iter().chain(study()).chain(transient_run()).collect()
            }
            Pending::Quit => {
                let tabs = study().into_iter().chain(transient_run()).chain(self.tabs.training.work.unkept());
                edits().into_iter().chain(tabs).collect()
            }
            Pending::Train => self.tabs.training.work.replaced(),
            Pending::DiscardTraining => {
                let solutions = self.tabs.training.work.unfinished.as_ref().map_or(0, |state| state.solutions());
                vec![format!("{solutions} full solutions of the stopped training will be discarded.")]
            }
            Pending::ThrowModelAway => self.tabs.training.work.unsaved().into_iter().collect(),
        }
    }

    /// Draws the dialog for the pending action, if there is one, and carries out the choice.
    pub(super) fn losses_ui(&mut self, ctx: &Context) {
        let Some(pending) = self.files.pending.clone() else { return };
        let losses = self.losses(&pending);
        let closes_document =
            |pending: &Pending| !matches!(pending, Pending::Train | Pending::DiscardTraining | Pending::ThrowModelAway);
        let edits = self.dirty() && closes_document(&pending);
        let (mut save, mut discard, mut cancel) = (false, false, false);
        let response = Modal::new(Id::unique("unsaved changes")).show(ctx, |ui| {
            ui.set_width(380.0);
            ui.heading(if edits { "Save the changes?" } else { "This would be lost" });
            for sentence in &losses {
                ui.label(sentence);
            }
            ui.add_space(6.0);
            ui.horizontal(|ui| {
                save = edits && ui.button("Save…").clicked();
                let consent = if losses.len() == 1 && edits { "Discard changes" } else { pending.consent() };
                discard = ui.button(consent).clicked();
                cancel = ui.button("Cancel").clicked();
            });
        });
        if discard {
            self.files.pending = None;
            self.proceed(ctx, pending);
        } else if save {
            self.files.pending = None;
            self.save(ctx);
            if self.files.window.is_some() {
                self.files.after_save = Some(pending);
            } else if !self.dirty() {
                self.request(ctx, pending);
            }
        } else if cancel || response.should_close() {
            self.files.pending = None;
        }
    }
}
