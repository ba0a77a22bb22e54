//! What calls the window when a job has news.

use crate::engine::job::Wake;

/// Repaints when a job has news.
pub fn wake(ctx: &egui::Context) -> Wake {
    let ctx = ctx.clone();
    Wake::new(move || ctx.request_repaint())
}
