//! The Help windows.

use crate::app::command::Command;
use egui::{Context, Grid, Window};

/// Which Help window is open.
#[derive(Clone, Copy, Debug, Default)]
pub struct Help {
    /// The list of keys.
    pub keyboard: bool,
    /// What this program is.
    pub about: bool,
}

/// The Help windows that are open.
pub fn ui(ctx: &Context, help: &mut Help) {
    Window::new("Keyboard").open(&mut help.keyboard).resizable(false).show(ctx, |ui| {
        Grid::new("keys").num_columns(2).striped(true).show(ui, |ui| {
            for (_, command) in Command::all() {
                if let Some(shortcut) = command.shortcut() {
                    ui.label(command.name().trim_end_matches('…'));
                    ui.monospace(ui.ctx().format_shortcut(&shortcut));
                    ui.end_row();
                }
            }
            for (what, key) in [
                ("Next, previous widget", "Tab, Shift+Tab"),
                ("Step the focused slider or number", "Arrow keys"),
                ("Ten times larger step of a number", "Shift+Arrow keys"),
                ("Reset a slider or a plot", "Double click"),
                ("Zoom a plot", "Ctrl+Wheel, right-button drag"),
            ] {
                ui.label(what);
                ui.monospace(key);
                ui.end_row();
            }
        });
    });
    Window::new("About EHL Explorer").open(&mut help.about).resizable(false).show(ctx, |ui| {
        ui.set_max_width(380.0);
        ui.heading("EHL Explorer");
        ui.label(format!("Version {}", env!("CARGO_PKG_VERSION")));
        ui.label(
            "Drag an elastohydrodynamic contact and watch pressure and film answer at once. \
             Profiles come from a reduced model and are checked by a full solve in the background.",
        );
        ui.label("Licensed under MIT or Apache-2.0, as you prefer.");
    });
}
