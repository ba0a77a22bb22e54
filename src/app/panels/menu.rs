//! The menu bar.

use crate::app::command::Command;
use crate::app::files::Pending;
use crate::app::state::State;
use crate::app::theme::Palette;
use egui::{Button, MenuBar, RichText, Ui};

/// The menu bar; chosen commands are added to `chosen`.
pub fn ui(ui: &mut Ui, state: &mut State, chosen: &mut Vec<Command>) {
    MenuBar::new().ui(ui, |ui| {
        ui.menu_button("File", |ui| {
            item(ui, Command::New, true, chosen);
            item(ui, Command::Open, true, chosen);
            recent(ui, state);
            ui.separator();
            item(ui, Command::Save, true, chosen);
            item(ui, Command::SaveAs, true, chosen);
            ui.separator();
            item(ui, Command::ExportPlot, true, chosen);
            ui.separator();
            item(ui, Command::Quit, true, chosen);
        });
        ui.menu_button("Edit", |ui| {
            item(ui, Command::Undo, state.history.can_undo(&state.document), chosen);
            item(ui, Command::Redo, state.history.can_redo(), chosen);
            ui.separator();
            item(ui, Command::Pin, state.picture.is_some(), chosen);
            item(ui, Command::Unpin, !state.pins.is_empty(), chosen);
            ui.separator();
            item(ui, Command::CopyReadouts, state.picture.is_some(), chosen);
        });
        ui.menu_button("View", |ui| {
            item(ui, Command::LightTheme, true, chosen);
            item(ui, Command::DarkTheme, true, chosen);
            item(ui, Command::SystemTheme, true, chosen);
            ui.separator();
            item(ui, Command::LargerText, true, chosen);
            item(ui, Command::SmallerText, true, chosen);
            item(ui, Command::NormalText, true, chosen);
            ui.separator();
            item(ui, Command::FitPlots, true, chosen);
            item(ui, Command::ResetLayout, true, chosen);
        });
        ui.menu_button("Run", |ui| {
            item(ui, Command::Verify, true, chosen);
            item(ui, Command::SolveAlong, state.sweep().is_some(), chosen);
            let background = state.training.job().is_some() || state.study().is_some();
            item(ui, Command::Cancel, background || !state.jobs.running().is_empty(), chosen);
        });
        ui.menu_button("Help", |ui| {
            item(ui, Command::Keyboard, true, chosen);
            item(ui, Command::About, true, chosen);
        });
        title(ui, state);
    });
}

fn item(ui: &mut Ui, command: Command, enabled: bool, chosen: &mut Vec<Command>) {
    let mut button = Button::new(command.name());
    if let Some(shortcut) = command.shortcut() {
        button = button.shortcut_text(ui.ctx().format_shortcut(&shortcut));
    }
    if ui.add_enabled(enabled, button).clicked() {
        chosen.push(command);
        ui.close();
    }
}

fn recent(ui: &mut Ui, state: &mut State) {
    let mut wanted = None;
    ui.add_enabled_ui(!state.files.recent.is_empty(), |ui| {
        ui.menu_button("Recent", |ui| {
            for path in &state.files.recent {
                let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
                if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
                    wanted = Some(path.clone());
                    ui.close();
                }
            }
        });
    });
    if let Some(path) = wanted {
        let ctx = ui.ctx().clone();
        state.request(&ctx, Pending::Open(path));
    }
}

/// Name of the document and what the last file action did, at the right end.
fn title(ui: &mut Ui, state: &mut State) {
    let palette = Palette::of(ui);
    let name = match &state.files.path {
        Some(path) => path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default(),
        None => state.document.title.clone(),
    };
    let mark = if state.dirty() { " •" } else { "" };
    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
        ui.label(RichText::new(format!("{name}{mark}")).color(palette.quiet)).on_hover_text(if state.dirty() {
            "Changed since it was last saved"
        } else {
            "Saved"
        });
        let mut dismissed = false;
        if let Some(notice) = &state.files.notice {
            let (text, color) = match notice {
                Ok(text) => (text, palette.quiet),
                Err(text) => (text, palette.wrong),
            };
            dismissed = ui.small_button("Dismiss").clicked();
            ui.add(egui::Label::new(RichText::new(text).small().color(color)).truncate()).on_hover_text(text);
        }
        if dismissed {
            state.files.notice = None;
        }
    });
}
