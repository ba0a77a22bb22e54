//! Window of measured data: tables of the document, the fit of constants, and lubricants that it gives.

use super::fit::FitRun;
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{Entries, message_ui, named, reserved, standing_ui, warning_ui};
use crate::app::document::Edit;
use crate::app::numbers;
use crate::app::purpose::Purpose;
use crate::app::refusal::Refusal;
use crate::app::theme::Palette;
use crate::engine::Warning;
use crate::scene::study::fit::{FitParameter, Row};
use crate::scene::{CaseTable, KeptLubricant, MeasuredError, MeasuredTable, View, measured_points};
use crate::solver::parameters::Estimated;
use crate::solver::physics::engineering::QuantityKind;
use egui::{Button, Checkbox, FontId, Grid, ScrollArea, TextEdit, Ui, Window};
use std::path::Path;

/// Example tables: film thickness over speed, and friction over sliding.
const EXAMPLES: [&str; 2] =
    [include_str!("../../../scenes/fit/film.csv"), include_str!("../../../scenes/fit/friction.csv")];
/// Name under which refusals of the fitted lubricant are stored.
const GROUP: &str = "measured data";
/// Largest number of tables.
const MOST_TABLES: usize = 6;

/// Window of measured data.
pub struct MeasuredWindow {
    open: bool,
    /// Table being edited, from 0.
    shown: usize,
    /// Text of that table while it is edited; `None` shows the table of the document.
    draft: Option<String>,
    /// Text that was read last, and what it holds.
    checked: Option<(String, Result<usize, MeasuredError>)>,
    chosen: [bool; FitParameter::ALL.len()],
    fit: FitRun,
    /// Name of the lubricant to keep.
    name: String,
}

impl Default for MeasuredWindow {
    fn default() -> Self {
        Self {
            open: false,
            shown: 0,
            draft: None,
            checked: None,
            chosen: [true, false, false, false],
            fit: FitRun::default(),
            name: "Fitted oil".to_owned(),
        }
    }
}

impl MeasuredWindow {
    /// Returns true if the window is open. Escape then closes it.
    pub fn is_open(&self) -> bool {
        self.open
    }

    pub fn open(&mut self) {
        self.open = true;
    }

    /// Closes the window. The fit continues.
    pub fn close(&mut self) {
        self.open = false;
    }

    /// Reads a table from a file as the text of the edited table.
    ///
    /// # Errors
    /// A sentence if the file cannot be read.
    pub fn read(&mut self, path: &Path) -> Result<(), Refusal> {
        if let CaseTable::Text(text) = CaseTable::pasted(path)? {
            self.draft = Some(text);
        }
        Ok(())
    }

    /// Receives the result of the fit.
    pub fn receive(&mut self) {
        self.fit.receive();
    }

    /// Returns the progress of the fit.
    pub fn standing(&self) -> Option<crate::engine::job::Standing> {
        self.fit.standing()
    }

    /// Stops the fit.
    pub fn stop(&self) {
        self.fit.stop();
    }

    /// Draws the window if it is open.
    pub fn ui(&mut self, ctx: &egui::Context, context: &Context<'_>, entries: &Entries, commands: &mut Commands) {
        if !self.open {
            return;
        }
        let mut open = true;
        let room = ctx.content_rect().size();
        let window = Window::new("Measured data").open(&mut open).collapsible(false).resizable(false);
        window.default_pos((0.3 * room.x, 0.08 * room.y)).show(ctx, |ui| {
            ui.set_width((0.5 * room.x).clamp(420.0, 560.0));
            self.table_ui(ui, context, commands);
            ui.separator();
            self.fit_ui(ui, context, commands);
            reserved(ui, 1, |ui| entries.message_ui(ui, GROUP));
        });
        self.open = open;
    }

    /// Draws the tables and takes over what was typed.
    fn table_ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let tables = &context.document.view.measured;
        self.shown = self.shown.min(tables.len());
        let mut wanted = self.shown;
        ui.horizontal_wrapped(|ui| {
            for k in 0..=tables.len().min(MOST_TABLES - 1) {
                let name = if k == tables.len() { "New table".to_owned() } else { format!("Table {}", k + 1) };
                if ui.selectable_label(self.shown == k, name).clicked() {
                    wanted = k;
                }
            }
        });
        let kept = tables.get(self.shown).map_or("", |table| table.text.as_str());
        let mut text = self.draft.clone().unwrap_or_else(|| kept.to_owned());
        let before = text.clone();
        let mut left = false;
        ui.horizontal(|ui| {
            if ui.button("Open CSV…").clicked() {
                commands.push(Command::Ask(Purpose::Measured));
            }
            let tip = "Film thickness over speed; in the second table friction over sliding. Of R 10 mm, 100 N/mm, E’ 231 GPa, \
                       η₀ 20 mPa·s, 1 m/s";
            if ui.button("Example").on_hover_text(tip).clicked() {
                (text, left) = (EXAMPLES[self.shown.min(1)].to_owned(), true);
            }
            if ui.add_enabled(!text.is_empty(), Button::new("Remove")).clicked() {
                (text, left) = (String::new(), true);
            }
        });
        let height = (0.22 * ui.ctx().content_rect().height()).max(90.0);
        ScrollArea::both()
            .id_salt("measured table")
            .max_height(height)
            .min_scrolled_height(height)
            .auto_shrink(false)
            .show(ui, |ui| {
                let hint = "speed [mm/s]; film [nm]\n50; 61,2\n100; 98,5\n\nor: srr [%]; friction";
                let field = TextEdit::multiline(&mut text).code_editor().hint_text(hint).desired_rows(6);
                let field = ui.add(field.desired_width(f32::INFINITY).font(FontId::monospace(12.0)));
                left |= field.lost_focus();
                named(ui, field, "Measured table");
            });
        if text != before || self.draft.is_some() {
            self.draft = Some(text.clone());
        }
        let opened = self.draft.is_some() && !ui.ctx().memory(|memory| memory.focused().is_some());
        if self.checked.as_ref().is_none_or(|(checked, _)| *checked != text) {
            self.checked = Some((text.clone(), measured_points(&text).map(|points| points.len())));
        }
        let Some((_, points)) = &self.checked else { return };
        reserved(ui, 2, |ui| match points {
            _ if text.trim().is_empty() => {
                _ = ui.weak("Speed or SRR, and film thickness or friction; units stand in the titles")
            }
            Err(refused) => message_ui(ui, &refused.to_string()),
            Ok(count) => {
                let palette = Palette::of(ui);
                ui.colored_label(
                    palette.verified,
                    format!("{count} lines. Traction and Results draw them as diamonds"),
                );
            }
        });
        let valid = points.is_ok() || text.trim().is_empty();
        if (left || opened) && valid && text != kept {
            let mut measured = tables.clone();
            match tables.len() {
                _ if text.trim().is_empty() => drop(measured.drain(self.shown..(self.shown + 1).min(tables.len()))),
                count if self.shown == count => measured.push(MeasuredTable { text }),
                _ => measured[self.shown].text = text,
            }
            let view = View { measured, ..context.document.view.clone() };
            commands.edit(Edit::View(Box::new(view)), GROUP);
            self.draft = None;
        }
        // The edited table has been taken over by now, if it is valid.
        if wanted != self.shown {
            (self.shown, self.draft) = (wanted, None);
        }
    }

    fn fit_ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let document = context.document;
        ui.horizontal(|ui| {
            ui.label("Fit").on_hover_text("Constants of the lubricant; all others keep the values of the contact");
            for (parameter, chosen) in FitParameter::ALL.into_iter().zip(&mut self.chosen) {
                let there = parameter.of(&document.point, &document.lubricant).is_some();
                *chosen &= there;
                let check = ui.add_enabled(there, Checkbox::new(chosen, parameter.symbol()));
                let check = check.on_hover_text(tip(parameter)).on_disabled_hover_text(parameter.needs());
                named(ui, check, &format!("Fit {}", parameter.name()));
            }
            let parameters: Vec<FitParameter> =
                FitParameter::ALL.into_iter().zip(self.chosen).filter(|(_, chosen)| *chosen).map(|(p, _)| p).collect();
            let runs = self.fit.standing().is_some();
            let ready = !parameters.is_empty() && !document.view.measured.is_empty() && !runs;
            let button = ui.add_enabled(ready, Button::new("Start the fit"));
            if button.on_disabled_hover_text("Needs a table and a constant").clicked() {
                self.fit.start(ui.ctx(), context, parameters);
            }
            if runs && ui.button("Stop").clicked() {
                self.fit.stop();
            }
        });
        standing_ui(ui, self.fit.standing(), "Progress of the fit");
        if let Some(why) = self.fit.message() {
            message_ui(ui, &why);
        }
        let Some((row, stale)) = self.fit.result(document) else { return };
        ui.scope(|ui| {
            if stale {
                ui.disable();
            }
            result_ui(ui, row, context);
        });
        if stale {
            ui.weak("Of another contact or other tables");
            return;
        }
        ui.horizontal(|ui| {
            let field =
                ui.add(TextEdit::singleline(&mut self.name).char_limit(KeptLubricant::LONGEST).desired_width(180.0));
            named(ui, field, "Name of the fitted lubricant");
            let tip = "Adds a lubricant with these constants to Fluid, where this scene keeps it, and uses it";
            let ready = !self.name.trim().is_empty();
            if ui.add_enabled(ready, Button::new("Keep and use")).on_hover_text(tip).clicked() {
                let kept = KeptLubricant::of(self.name.trim(), &row.point, &row.lubricant);
                let mut lubricants = document.view.lubricants.clone();
                lubricants.retain(|other| other.name != kept.name);
                lubricants.push(kept.clone());
                commands.edit(Edit::View(Box::new(View { lubricants, ..document.view.clone() })), GROUP);
                let (point, lubricant) = kept.in_place(&document.point, &document.lubricant);
                commands.edit(Edit::Contact(point, Box::new(lubricant)), GROUP);
            }
        });
    }
}

fn tip(parameter: FitParameter) -> &'static str {
    match parameter {
        FitParameter::Alpha => "Pressure–viscosity coefficient, from film thickness over speed",
        FitParameter::Viscosity => "Viscosity at ambient pressure; film thicknesses give it or α, hardly both",
        FitParameter::EyringStress => "Eyring stress, from friction at small slide-to-roll ratios",
        FitParameter::LimitingSlope => {
            "Slope of the limiting shear stress, from friction at large slide-to-roll ratios"
        }
    }
}

fn kind(parameter: FitParameter) -> QuantityKind {
    match parameter {
        FitParameter::Alpha => QuantityKind::PressureCoefficient,
        FitParameter::Viscosity => QuantityKind::Viscosity,
        FitParameter::EyringStress => QuantityKind::Stress,
        FitParameter::LimitingSlope => QuantityKind::Number,
    }
}

fn result_ui(ui: &mut Ui, row: &Row, context: &Context<'_>) {
    Grid::new("fitted constants").num_columns(4).striped(true).spacing([14.0, 4.0]).show(ui, |ui| {
        for title in ["", "Value", "Standard error", "95 % interval"] {
            ui.weak(title);
        }
        ui.end_row();
        for (parameter, Estimated { value, relative_error, interval: (low, high) }) in &row.parameters {
            let unit = kind(*parameter).unit(context.system);
            let text = |si: f64| numbers::significant(unit.number(si));
            ui.label(parameter.symbol()).on_hover_text(tip(*parameter));
            ui.strong(numbers::quantity(unit.number(*value), unit.name));
            ui.label(format!("{} %", numbers::digits(100.0 * relative_error, 2)));
            ui.label(format!("{} … {}", text(*low), text(*high)));
            ui.end_row();
        }
    });
    let deviation = numbers::error_percent(row.deviation);
    ui.label(format!("Measured values differ from the fit by {deviation} (standard deviation)"));
    if row.is_correlated() {
        warning_ui(
            ui,
            "two constants act nearly alike on these values; the intervals hold, but each depends on the other",
        );
    }
    for warning in Warning::summary(row.warnings.iter().map(Vec::as_slice)) {
        warning_ui(ui, &warning.to_string());
    }
}
