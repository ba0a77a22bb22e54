//! Menu bar.

use crate::app::command::{Command, Item, MENUS};
use crate::app::context::Commands;
use crate::app::controls::named;
use crate::app::desk::Desk;
use crate::app::notice::Notice;
use crate::app::theme::Palette;
use egui::{Align, Button, Label, Layout, MenuBar, RichText, Ui};

/// Draws the menu bar and adds the chosen commands.
pub fn ui(ui: &mut Ui, desk: &Desk, commands: &mut Commands) {
    MenuBar::new().ui(ui, |ui| {
        for menu in MENUS.chunk_by(|a, b| a.menu == b.menu) {
            let name = menu.first().map_or("", |item| item.menu);
            ui.menu_button(name, |ui| {
                for (k, group) in menu.chunk_by(|a, b| a.group == b.group).enumerate() {
                    if k > 0 {
                        ui.separator();
                    }
                    group.iter().filter(|item| item.is_there()).for_each(|item| item_ui(ui, desk, item, commands));
                    if group.iter().any(|item| item.command == Command::Open) {
                        recent(ui, desk, commands);
                    }
                }
            });
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            palette(ui, commands);
            title(ui, desk, commands);
        });
    });
}

fn item_ui(ui: &mut Ui, desk: &Desk, item: &Item, commands: &mut Commands) {
    let mut button = Button::new(item.name);
    if let Some(shortcut) = item.shortcut() {
        button = button.shortcut_text(ui.ctx().format_shortcut(&shortcut));
    }
    let refusal = desk.refusal(&item.command);
    let state = desk.state(&item.command);
    if let Some(on) = state {
        button = button.selected(on);
    }
    let mut response = ui.add_enabled(refusal.is_none(), button);
    if let Some(on) = state {
        ui.ctx().accesskit_node_builder(response.id, |node| node.set_toggled(on.into()));
    }
    if let Some(why) = refusal {
        response = response.on_disabled_hover_text(why);
    }
    if response.clicked() {
        commands.push(item.command.clone());
        ui.close();
    }
}

fn recent(ui: &mut Ui, desk: &Desk, commands: &mut Commands) {
    ui.add_enabled_ui(!desk.files.recent.is_empty(), |ui| {
        ui.menu_button("Recent", |ui| {
            for path in &desk.files.recent {
                let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
                if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
                    commands.push(Command::OpenPath(path.clone()));
                    ui.close();
                }
            }
        });
    });
}

/// Draws the button of the command palette at the right end.
fn palette(ui: &mut Ui, commands: &mut Commands) {
    let quiet = |text: String| RichText::new(text).color(Palette::of(ui).quiet);
    let mut button = Button::new(quiet("Find a command".to_owned()));
    if let Some(shortcut) = Command::Palette.shortcut() {
        button = button.shortcut_text(quiet(ui.ctx().format_shortcut(&shortcut)));
    }
    let response = ui.add(button).on_hover_text("All commands, found by typing part of their name");
    if named(ui, response, "Command palette").clicked() {
        commands.push(Command::Palette);
    }
}

/// Draws the name of the document and the last file notice, to the right of the menus.
fn title(ui: &mut Ui, desk: &Desk, commands: &mut Commands) {
    let palette = Palette::of(ui);
    let name = match &desk.files.path {
        Some(path) => path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default(),
        None => desk.document.title.clone(),
    };
    let mark = if desk.dirty() { " •" } else { "" };
    let label = Label::new(RichText::new(format!("{name}{mark}")).color(palette.quiet)).truncate();
    ui.add(label).on_hover_text(if desk.dirty() { "Changed since it was last saved" } else { "Saved" });
    if let Some(notice) = &desk.files.notice {
        let (text, color) = match notice {
            Notice::Done(text) | Notice::Short(text) => (text, palette.quiet),
            Notice::Wrong(text) => (text, palette.wrong),
        };
        if ui.small_button("Dismiss").clicked() {
            commands.push(Command::Dismiss);
        }
        ui.add(Label::new(RichText::new(text).small().color(color)).truncate()).on_hover_text(text);
    }
}
