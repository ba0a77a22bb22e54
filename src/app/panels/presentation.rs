//! Bar of a presentation: the regime in large letters, a few commands, the sliders in use, and a button to end it.

use super::{operating_point, sliders};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{Entries, named};
use crate::app::document::Shape;
use egui::{Align, Button, Frame, Label, Layout, Margin, RichText, Ui};

/// Text size of the regime.
const LARGE: f32 = 20.0;

/// Draws the bar.
pub fn ui(ui: &mut Ui, context: &Context<'_>, locked: bool, entries: &mut Entries, commands: &mut Commands) {
    Frame::new().inner_margin(Margin::symmetric(6, 5)).show(ui, |ui| {
        ui.horizontal(|ui| {
            let point = &context.document.point;
            operating_point::shape_ui(ui, Shape::of(point), commands);
            let ratios = context.regime_ratios();
            let title = RichText::new(ratios.regime().title()).size(LARGE).strong();
            ui.label(title).on_hover_text(ratios.describe());
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let button = ui.add(Button::new("Esc").small()).on_hover_text("Ends the presentation (Esc or F11)");
                if named(ui, button, "End the presentation").clicked() {
                    commands.push(Command::Presentation);
                }
                let pins = context.answers.pins().len();
                let buttons = [
                    ("Undo", true, "Reverts the last change", Command::Undo),
                    ("Unpin", pins > 0, "Remove all pinned curves", Command::Unpin),
                    ("Pin", true, "Keep this curve for comparison", Command::Pin),
                ];
                for (name, enabled, tip, command) in buttons {
                    if ui.add_enabled(enabled, Button::new(name)).on_hover_text(tip).clicked() {
                        commands.push(command);
                    }
                }
                let lock = ui.selectable_label(locked, Command::LockAxes.name());
                if lock
                    .on_hover_text("Locks the axes, so that changes are visible (F8). F2 fits the axes once")
                    .clicked()
                {
                    commands.push(Command::LockAxes);
                }
                ui.add(Label::new(RichText::new("Drag a slider; Esc ends").weak()).truncate());
            });
        });
        sliders::in_use(ui, context, entries, commands);
    });
}
