//! Settings window. Settings apply to all documents and are stored with the session.

use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::controls::{Entries, heading, named, row_name, typed_field};
use crate::app::desk::Desk;
use crate::app::display::{Display, Thresholds};
use crate::app::refusal::Refusal;
use crate::app::reports::ReportSettings;
use crate::app::theme::name_and_symbol;
use crate::scene::Paper;
use crate::solver::physics::engineering::{self, Dimension, UnitSystem};
use egui::{Context, Id, TextEdit, ThemePreference, Ui, Window};

/// Label, tooltip and accessible name of the fields of the thresholds.
const THRESHOLDS: [(&str, &str, &str); 2] = [
    (
        "Verified up to",
        "Maximum error of H_c or H_min, against a full solution on the same grid, that is called Verified",
        "Error that is verified",
    ),
    (
        "Far off from",
        "Errors beyond this are called Far off; between both the picture is Roughly right",
        "Error that is far off",
    ),
];
const PERCENT: f64 = 0.01;

const THEMES: [(ThemePreference, &str); 3] =
    [(ThemePreference::System, "As the system"), (ThemePreference::Light, "Light"), (ThemePreference::Dark, "Dark")];

/// Settings window.
#[derive(Default)]
pub struct Settings {
    pub open: bool,
    entries: Entries,
}

impl Settings {
    /// Draws the window if it is open.
    pub fn ui(&mut self, ctx: &Context, desk: &Desk, commands: &mut Commands) {
        let mut open = self.open;
        let window = Window::new("Settings").id(Id::unique("settings")).open(&mut open).collapsible(false);
        window.resizable(false).default_pos(ctx.content_rect().center() - egui::vec2(200.0, 160.0)).show(ctx, |ui| {
            ui.set_width(360.0);
            heading(ui, "The badge");
            self.thresholds_ui(ui, desk.display.thresholds, commands);
            heading(ui, "Units");
            system_ui(ui, desk.display.system, commands);
            heading(ui, "Report");
            report_ui(ui, &desk.reports.settings, commands);
            heading(ui, "Appearance");
            appearance_ui(ui, &desk.display, commands);
        });
        self.open = open;
    }

    fn thresholds_ui(&mut self, ui: &mut Ui, present: Thresholds, commands: &mut Commands) {
        let mut wanted = present;
        let mut entered = None;
        let values = [&mut wanted.verified, &mut wanted.far_off];
        for ((row, tip, name), value) in THRESHOLDS.into_iter().zip(values) {
            ui.horizontal(|ui| {
                row_name(ui, name_and_symbol(ui, row, "", ""), tip);
                let read = |text: &str| {
                    engineering::parse(text, Dimension::Ratio, "%").map(|si| si / PERCENT).map_err(Refusal::from)
                };
                if let Some(typed) = typed_field(ui, &mut self.entries, name, *value / PERCENT, 70.0, tip, read) {
                    *value = typed * PERCENT;
                    entered = Some(name);
                }
                ui.label("%");
            });
        }
        if let Some(name) = entered {
            let checked = wanted.check();
            if checked.is_ok() {
                commands.push(Command::SetThresholds(wanted));
            }
            self.entries.answer(name, checked);
        }
        self.entries.reserved_ui(ui, THRESHOLDS.map(|(.., name)| name));
        let usual = Thresholds::default();
        if ui.add_enabled(present != usual, egui::Button::new("Usual thresholds")).clicked() {
            self.entries.clear();
            commands.push(Command::SetThresholds(usual));
        }
    }
}

fn report_ui(ui: &mut Ui, present: &ReportSettings, commands: &mut Commands) {
    let mut wanted = present.clone();
    let tip = "In the heading of a report; it may stay empty";
    for (name, text) in [("Author", &mut wanted.author), ("Company", &mut wanted.company)] {
        ui.horizontal(|ui| {
            row_name(ui, name_and_symbol(ui, name, "", ""), tip);
            let field = TextEdit::singleline(text).char_limit(ReportSettings::LONGEST).desired_width(200.0);
            let field = ui.add(field);
            named(ui, field, name).on_hover_text(tip);
        });
    }
    ui.horizontal(|ui| {
        row_name(ui, name_and_symbol(ui, "Paper", "", ""), "Size of the page of a report");
        for paper in Paper::ALL {
            ui.selectable_value(&mut wanted.paper, paper, paper.name());
        }
    });
    if wanted != *present {
        commands.push(Command::Reports(wanted));
    }
}

fn system_ui(ui: &mut Ui, present: UnitSystem, commands: &mut Commands) {
    ui.horizontal(|ui| {
        let tip = "Units of panels, axes, tables and reports. A number without a unit is read in them; every field also \
                   accepts other units";
        row_name(ui, name_and_symbol(ui, "System", "", ""), tip);
        for system in UnitSystem::ALL {
            if ui.selectable_label(present == system, system.name()).on_hover_text(system.about()).clicked() {
                commands.push(Command::System(system));
            }
        }
    });
    ui.weak(present.about());
}

fn appearance_ui(ui: &mut Ui, display: &Display, commands: &mut Commands) {
    ui.horizontal(|ui| {
        row_name(ui, name_and_symbol(ui, "Colours", "", ""), "Light, dark, or the setting of the system");
        for (theme, name) in THEMES {
            if ui.selectable_label(display.theme == theme, name).clicked() {
                commands.push(Command::Theme(theme));
            }
        }
    });
    ui.horizontal(|ui| {
        row_name(ui, name_and_symbol(ui, "Presentation", "", ""), "Display in presentation mode (F11)");
        let mut light = display.light_presentation;
        let tip = "Light colours in any theme, because a projector cannot show black";
        if ui.checkbox(&mut light, "Light, for a projector").on_hover_text(tip).changed() {
            commands.push(Command::LightPresentation);
        }
    });
    ui.horizontal(|ui| {
        row_name(ui, name_and_symbol(ui, "Text", "", ""), "Size of everything in the window");
        for command in [Command::SmallerText, Command::NormalText, Command::LargerText] {
            if ui.button(command.name()).clicked() {
                commands.push(command);
            }
        }
    });
}
