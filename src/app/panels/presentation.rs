//! The one bar of a presentation: the sliders in use, and the way back.

use super::sliders;
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{Entries, named};
use egui::{Align, Button, Frame, Layout, Margin, Ui};

/// Room for the button.
const END_WIDTH: f32 = 56.0;

/// The bar.
pub fn ui(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    Frame::new().inner_margin(Margin::symmetric(6, 5)).show(ui, |ui| {
        sliders::in_use(ui, context, entries, commands, END_WIDTH, |ui, commands| {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let button = ui.add(Button::new("Esc").small()).on_hover_text("Ends the presentation (Esc or F11)");
                if named(ui, button, "End the presentation").clicked() {
                    commands.push(Command::Presentation);
                }
            });
        });
    });
}
