//! A killed window: its changes are restored.

use crate::alone;
use crate::common::cases::cases;
use crate::common::scratch::Scratch;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

/// Environment variable with the folder of the window to be killed.
const FOLDER: &str = "EHL_KILLED_FOLDER";
/// Time from the last change to the end.
const PATIENCE: Duration = Duration::from_secs(10);

fn window(folder: &Path) -> Harness<'static, Explorer> {
    let explorer = Explorer::new(None).without_system_dialogs().keeping_session_in(folder, true);
    Harness::builder().with_size([1280.0, 800.0]).build_ui_state(|ui, app: &mut Explorer| app.ui(ui), explorer)
}

/// Returns the value of M after the `count`-th change.
fn changed(count: usize) -> f64 {
    20.0 + count as f64
}

/// Not a test by itself: the window of the test below, which draws no frame after its change.
#[test]
fn a_window_to_be_killed() {
    let Some(folder) = std::env::var_os(FOLDER).map(PathBuf::from) else { return };
    let mut window = window(&folder);
    let count: usize = std::fs::read_to_string(folder.join("count")).unwrap().parse().unwrap();
    window.get_by_role_and_label(Role::Slider, "Load number M").set_value_accesskit(changed(count));
    window.run_steps(2);
    std::fs::write(folder.join("done"), "").unwrap();
    std::thread::sleep(Duration::from_secs(600));
}

#[test]
fn ten_seconds_after_a_change_a_kill_loses_nothing() {
    if std::env::var_os(FOLDER).is_some() {
        return;
    }
    let folder = Scratch::new("killed");
    for count in 0..cases(1, 50) {
        std::fs::write(folder.join("count"), count.to_string()).unwrap();
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "killed::a_window_to_be_killed"])
            .env(FOLDER, folder.as_os_str())
            .spawn()
            .unwrap();
        let begin = Instant::now();
        while !folder.join("done").exists() {
            assert!(begin.elapsed() < Duration::from_secs(120), "the window does not open");
            std::thread::sleep(Duration::from_millis(20));
        }
        std::thread::sleep(PATIENCE);
        // On Unix this is SIGKILL: the program stops immediately.
        child.kill().unwrap();
        child.wait().unwrap();
        std::fs::remove_file(folder.join("done")).unwrap();
        // Other tests count bytes while this one waits.
        let _alone = alone();
        let mut again = window(&folder);
        again.step();
        let m = again.state().moes().m;
        assert!((m / changed(count) - 1.0).abs() < 1e-9, "change {count}: {m}");
    }
}
