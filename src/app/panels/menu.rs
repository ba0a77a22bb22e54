//! The menu bar.

use crate::app::command::{Command, MENUS};
use crate::app::controls::named;
use crate::app::files::Pending;
use crate::app::state::State;
use crate::app::theme::Palette;
use egui::{Align, Button, Label, Layout, MenuBar, RichText, Ui};

/// The menu bar; chosen commands are added to `chosen`.
pub fn ui(ui: &mut Ui, state: &mut State, chosen: &mut Vec<Command>) {
    MenuBar::new().ui(ui, |ui| {
        for (menu, groups) in MENUS {
            ui.menu_button(menu, |ui| {
                for (k, group) in groups.iter().enumerate() {
                    if k > 0 {
                        ui.separator();
                    }
                    group.iter().for_each(|command| item(ui, state, *command, chosen));
                    if group.contains(&Command::Open) {
                        recent(ui, state);
                    }
                }
            });
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            palette(ui, chosen);
            title(ui, state);
        });
    });
}

fn item(ui: &mut Ui, state: &State, command: Command, chosen: &mut Vec<Command>) {
    let mut button = Button::new(command.name());
    if let Some(shortcut) = command.shortcut() {
        button = button.shortcut_text(ui.ctx().format_shortcut(&shortcut));
    }
    let refusal = command.refusal(state);
    let mut response = ui.add_enabled(refusal.is_none(), button);
    if let Some(why) = refusal {
        response = response.on_disabled_hover_text(why);
    }
    if response.clicked() {
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

/// What opens the command palette, at the very right.
fn palette(ui: &mut Ui, chosen: &mut Vec<Command>) {
    let quiet = |text: String| RichText::new(text).color(Palette::of(ui).quiet);
    let mut button = Button::new(quiet("Find a command".to_owned()));
    if let Some(shortcut) = Command::Palette.shortcut() {
        button = button.shortcut_text(quiet(ui.ctx().format_shortcut(&shortcut)));
    }
    let response = ui.add(button).on_hover_text("Everything that can be done now, by typing a part of its name");
    if named(ui, response, "Command palette").clicked() {
        chosen.push(Command::Palette);
    }
}

/// Name of the document and what the last file action did, right of the menus.
fn title(ui: &mut Ui, state: &mut State) {
    let palette = Palette::of(ui);
    let name = match &state.files.path {
        Some(path) => path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default(),
        None => state.document.title.clone(),
    };
    let mark = if state.dirty() { " •" } else { "" };
    let label = Label::new(RichText::new(format!("{name}{mark}")).color(palette.quiet)).truncate();
    ui.add(label).on_hover_text(if state.dirty() { "Changed since it was last saved" } else { "Saved" });
    let mut dismissed = false;
    if let Some(notice) = &state.files.notice {
        let (text, color) = match notice {
            Ok(text) => (text, palette.quiet),
            Err(text) => (text, palette.wrong),
        };
        dismissed = ui.small_button("Dismiss").clicked();
        ui.add(Label::new(RichText::new(text).small().color(color)).truncate()).on_hover_text(text);
    }
    if dismissed {
        state.files.notice = None;
    }
}
