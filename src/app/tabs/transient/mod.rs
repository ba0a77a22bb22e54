//! The contact in time: what drives it, how film and pressure answer, and how the frames differ.

mod cost;
mod form;
mod profiles;
mod series;

use super::in_time;
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::figure::{self, Subject};
use crate::app::form::LastField;
use crate::app::transient::{InTimeCommand, export};
use egui::{Button, ScrollArea, Ui};

/// Width of the form.
const FORM_WIDTH: f32 = 300.0;
/// Width from which on the profiles stand beside the series.
const SIDE_BY_SIDE: f32 = 560.0;
/// Heights below which plots cannot be read.
const LEAST_HEIGHT: f32 = 104.0;

/// The tab: whether its form is put away, and what is being entered there.
#[derive(Default)]
pub struct Transient {
    form_hidden: bool,
    last: LastField,
}

impl Transient {
    /// The tab.
    pub fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        if let Some(why) = context.document.no_transient() {
            ui.centered_and_justified(|ui| ui.weak(why));
            return;
        }
        ui.horizontal_top(|ui| {
            if !self.form_hidden {
                ui.vertical(|ui| {
                    ui.set_width(FORM_WIDTH);
                    let area = ScrollArea::vertical().id_salt("transient form").auto_shrink(false);
                    area.show(ui, |ui| form::ui(ui, &mut self.last, context, commands));
                });
                ui.separator();
            }
            ui.vertical(|ui| {
                let area = ScrollArea::vertical().id_salt("transient").auto_shrink(false);
                area.show(ui, |ui| self.results(ui, context, commands));
            });
        });
    }

    fn results(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let (top, height) = (ui.cursor().top(), ui.available_height());
        self.buttons(ui, context, commands);
        in_time::status(ui, context);
        if context.transient.runs.iter().all(|run| run.trajectory.moments.is_empty()) {
            if context.transient.standing().is_none() {
                ui.weak("Run it in time to see pressure and film follow the inputs.");
            }
            return;
        }
        in_time::player(ui, context.transient, commands);
        let all = ui.vertical(|ui| {
            cost::ui(ui, context.transient);
            plots(ui, context, height - (ui.cursor().top() - top) - 18.0)
        });
        figure::offer_of(ui, "Series and profiles", all.response.rect, Subject::InTime);
        commands.extend(all.inner.map(|time| Command::InTime(InTimeCommand::GoTo(time))));
    }

    fn buttons(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let view = context.transient;
        ui.horizontal_wrapped(|ui| {
            let mut form = !self.form_hidden;
            ui.toggle_value(&mut form, "Set-up")
                .on_hover_text("Shows what drives the contact, or leaves the room to plots");
            self.form_hidden = !form;
            in_time::run_button(ui, context, commands);
            let there = view.runs.iter().any(|run| !run.trajectory.moments.is_empty());
            let tip = "All moments of every run with their SI twins, each run in columns of its own";
            if ui.add_enabled(there, Button::new("Export series…")).on_hover_text(tip).clicked() {
                commands.extend(export::series(view).map(Command::csv));
            }
            let tip = "Pressure and film of every run at the moment that is shown";
            if ui.add_enabled(there, Button::new("Export profiles…")).on_hover_text(tip).clicked() {
                commands.extend(export::profiles(view).map(Command::csv));
            }
            let tip = "Any of these plots, or the whole tab, as SVG or PNG with axes and parameters";
            if ui.add_enabled(there, Button::new("Export plot…")).on_hover_text(tip).clicked() {
                commands.push(Command::ExportPlot);
            }
        });
    }
}

/// Series and profiles, beside each other where there is room; returns the time that was clicked at.
fn plots(ui: &mut Ui, context: &Context<'_>, height: f32) -> Option<f64> {
    let view = context.transient;
    let several = view.runs.len() > 1;
    let parts = if several { 2.7 } else { 2.0 };
    if ui.available_width() < SIDE_BY_SIDE {
        let clicked = series::ui(ui, view, (0.55 * height / parts).max(LEAST_HEIGHT));
        profiles::ui(ui, view, context.fit, (0.5 * height).max(LEAST_HEIGHT));
        return clicked;
    }
    let (unit, width) = ((height / parts).max(LEAST_HEIGHT), ui.available_width());
    let both = ui.horizontal_top(|ui| {
        let series = ui.vertical(|ui| {
            ui.set_width(0.56 * width);
            series::ui(ui, view, unit)
        });
        ui.vertical(|ui| profiles::ui(ui, view, context.fit, 0.5 * unit * parts));
        series.inner
    });
    both.inner
}

/// Marks of an axis of this width that leave their labels room.
fn marks(width: f32) -> f64 {
    f64::from((width - 60.0).max(60.0) / 60.0)
}

/// The same for an axis of this height.
fn rows(height: f32) -> f64 {
    f64::from((height - 24.0).max(48.0) / 24.0).min(6.0)
}
