//! Signal that requests a repaint when a job has a message.

use crate::engine::job::Wake;

/// Returns a signal that requests a repaint when a job has a message.
pub fn wake(ctx: &egui::Context) -> Wake {
    let ctx = ctx.clone();
    Wake::new(move || ctx.request_repaint())
}
