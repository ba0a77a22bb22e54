//! Driving the window without a display: what the tests of its tabs have in common.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use std::time::{Duration, Instant};

/// The explorer in a window of its own.
pub type Window = Harness<'static, Explorer>;

/// A window of a size in points.
pub fn window(explorer: Explorer, size: [f32; 2]) -> Window {
    Harness::builder().with_size(size).build_ui_state(|ui, app: &mut Explorer| app.ui(ui), explorer)
}

/// Steps until `done`, for at most a while.
pub fn wait_within(patience: Duration, harness: &mut Window, what: &str, done: impl Fn(&Explorer) -> bool) {
    let begin = Instant::now();
    loop {
        harness.step();
        if done(harness.state()) {
            harness.run_steps(2);
            return;
        }
        assert!(begin.elapsed() < patience, "waited in vain for {what}: {}", harness.state().badge());
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Clicks what bears a name.
pub fn click(harness: &mut Window, name: &str) {
    harness.get_by_label(name).click();
    harness.run_steps(3);
}
