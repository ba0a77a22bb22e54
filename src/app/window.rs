//! Native window.

use crate::app::explorer::Explorer;
use crate::app::refusal::Refusal;
use std::path::PathBuf;

/// Name of the application for the operating system and for the folder of the session.
const APP_ID: &str = "ehl-explorer";

/// Opens the window with a scene or with the last session. Returns when it is closed.
///
/// # Errors
/// One sentence if the scene cannot be read or there is no display.
pub fn run(scene: Option<PathBuf>) -> Result<(), Refusal> {
    let mut explorer = Explorer::with_embedded_models();
    if let Some(folder) = eframe::storage_dir(APP_ID) {
        explorer.lessons.look_in(&folder.join("lessons"));
        explorer = explorer.keeping_trainings_in(&folder).keeping_session_in(&folder, scene.is_none());
    }
    if let Some(path) = &scene {
        let of_the_session = explorer.desk.files.notice.take();
        explorer.open_scene(path)?;
        let files = &mut explorer.desk.files;
        files.notice = of_the_session.or_else(|| files.notice.take());
    }
    let options = eframe::NativeOptions {
        viewport: explorer.place.window().with_app_id(APP_ID).with_title("EHL Explorer"),
        renderer: eframe::Renderer::Glow,
        // The session is stored by its own keeper. The toolkit would store its state without checks and not
        // atomically.
        persist_window: false,
        persistence_path: Some(PathBuf::new()),
        ..eframe::NativeOptions::default()
    };
    eframe::run_native(
        APP_ID,
        options,
        Box::new(move |creation| {
            // A session that ended during a presentation starts in a normal window.
            creation.egui_ctx.send_viewport_cmd(egui::ViewportCommand::Fullscreen(false));
            Ok(Box::new(explorer))
        }),
    )
    .map_err(|error| {
        let error = error.to_string();
        let reason = error.rsplit(": ").next().unwrap_or(&error).trim_end_matches('.');
        Refusal::new(format!(
            "no window can be opened here ({reason}); without a display use the headless commands \
             `ehl-explorer solve`, `ehl-explorer run` or `ehl-explorer bench`"
        ))
    })
}
