//! Bar of a presentation: the regime in large letters, a few commands, the sliders in use, and a button to end it.

use super::sliders::{ChosenSliders, PRESENTED};
use super::{operating_point, sliders};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{Entries, named};
use crate::app::document::Shape;
use crate::solver::parameters::Quantity;
use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{Align, Button, Frame, Label, Layout, Margin, PopupCloseBehavior, RichText, Ui};

/// Text size of the regime.
const LARGE: f32 = 20.0;

/// Minimum width for the hint.
const HINT: f32 = 120.0;

/// Draws the bar.
pub fn ui(
    ui: &mut Ui,
    context: &Context<'_>,
    (locked, chosen): (bool, ChosenSliders),
    entries: &mut Entries,
    commands: &mut Commands,
) {
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
                    (
                        "Swap",
                        pins > 0,
                        "Exchanges this contact with the last pinned one: the sliders move the other",
                        Command::SwapPin,
                    ),
                    ("Pin", true, "Keep this curve for comparison", Command::Pin),
                ];
                for (name, enabled, tip, command) in buttons {
                    if ui.add_enabled(enabled, Button::new(name)).on_hover_text(tip).clicked() {
                        commands.push(command);
                    }
                }
                sliders_ui(ui, context, chosen, commands);
                let lock = ui.selectable_label(locked, Command::LockAxes.name());
                if lock
                    .on_hover_text("Locks the axes, so that changes are visible (F8). F2 fits the axes once")
                    .clicked()
                {
                    commands.push(Command::LockAxes);
                }
                if ui.available_width() > HINT {
                    ui.add(Label::new(RichText::new("Drag a slider; Esc ends").weak()).truncate());
                }
            });
        });
        sliders::in_use(ui, context, chosen, entries, commands);
    });
}

/// Draws the menu that chooses the sliders.
fn sliders_ui(ui: &mut Ui, context: &Context<'_>, chosen: ChosenSliders, commands: &mut Commands) {
    // Several sliders are chosen one after the other.
    let stays = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (button, _) = MenuButton::new("Sliders").config(stays).ui(ui, |ui| {
        for quantity in PRESENTED {
            let name = match quantity {
                Quantity::InletTemperature => "Oil temperature",
                other => other.label(),
            };
            if ui.checkbox(&mut chosen.contains(quantity), name).clicked() {
                commands.push(Command::PresentSliders(chosen.toggled(quantity)));
            }
        }
        if ui.add_enabled(!chosen.is_empty(), Button::new("Usual sliders")).clicked() {
            commands.push(Command::PresentSliders(ChosenSliders::default()));
        }
    });
    let tip = match context.document.view.oil {
        Some(_) => "Chooses the sliders of presentations",
        None => "Chooses the sliders of presentations. The temperature needs an oil by its grade, or Heat",
    };
    button.on_hover_text(tip);
}
