//! Headline above the tab: title and question of an opened example scene.

use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::controls::named;
use crate::app::examples::question;
use crate::scene::Scene;
use egui::{Align, Label, Layout, RichText, Ui};

/// Title and question of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Headline {
    title: String,
    question: String,
    source: String,
}

impl Headline {
    /// Returns the headline of a scene.
    pub fn of(scene: &Scene) -> Self {
        Self { title: scene.title.clone(), question: question(scene), source: scene.source.clone() }
    }

    /// Draws it as one line.
    pub fn ui(&self, ui: &mut Ui, commands: &mut Commands) {
        ui.horizontal(|ui| {
            ui.label(RichText::new(&self.title).strong()).on_hover_text(&self.source);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let button = ui.button("Close");
                if named(ui, button, "Close the headline").clicked() {
                    commands.push(Command::CloseHeadline);
                }
                if ui.button("Examples…").clicked() {
                    commands.push(Command::Examples);
                }
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    ui.add(Label::new(RichText::new(&self.question).weak()).truncate());
                });
            });
        });
    }
}
