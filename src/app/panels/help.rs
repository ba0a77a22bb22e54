//! Windows of the Help menu.

use crate::app::manual::Manual;
use egui::{Context, Window};

/// State of the Help windows.
#[derive(Default)]
pub struct Help {
    pub manual: Manual,
    /// True if the information about the program is shown.
    pub about: bool,
}

/// Draws the open Help windows.
pub fn ui(ctx: &Context, help: &mut Help) {
    help.manual.ui(ctx);
    Window::new("About EHL Explorer").open(&mut help.about).resizable(false).show(ctx, |ui| {
        ui.set_max_width(380.0);
        ui.heading("EHL Explorer");
        ui.label(format!("Version {}", env!("CARGO_PKG_VERSION")));
        ui.label(
            "Change an elastohydrodynamic contact and see pressure and film thickness at once. Profiles come from a \
             reduced model and are checked by a full solve in the background.",
        );
        ui.label("Licensed under MIT or Apache-2.0, as you prefer.");
    });
}
