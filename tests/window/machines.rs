//! Forms of bearing, gear pair and cam: they fill bodies, speeds and load, are undone in one step, and lead along the
//! path.

use crate::driver::{Window, choose, click, press, set, shows, undo, wait, write};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint};

fn window() -> Window {
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, 1200.0]);
    wait(&mut harness, "the first picture", |app| app.central_film().is_some());
    click(&mut harness, "Two bodies");
    harness
}

fn enter(harness: &mut Window, field: &str, text: &str) {
    write(harness, field, text);
    press(harness, Modifiers::NONE, Key::Enter);
}

fn close(value: f64, wanted: f64, relative: f64) {
    assert!((value / wanted - 1.0).abs() < relative, "{value} against {wanted}");
}

fn speeds(point: &OperatingPoint) -> [f64; 2] {
    point.surface_speeds()
}

#[test]
fn a_ball_bearing_fills_the_contact_of_its_heaviest_ball() {
    let mut harness = window();
    let before = harness.state().point();
    click(&mut harness, "From a bearing…");
    assert!(shows(&harness, "Loaded zone") && shows(&harness, "123.8"), "R_y of the 6206 is shown at once");
    enter(&mut harness, "Radial load", "3.2 kN");
    enter(&mut harness, "Inner speed", "3000 rpm");
    assert_eq!(harness.state().point(), before, "nothing changes before Use");
    click(&mut harness, "Use");
    let point = harness.state().point();
    assert_eq!(point.kind, ContactKind::Point);
    close(point.radius_m, 3.77635e-3, 1e-4);
    close(point.radius_y_m.unwrap(), 123.825e-3, 1e-6);
    // d_m (1 − γ²) ω/4, and between Stribeck's 4.37 and 5 times F_r/Z.
    close(point.speed_m_per_s, 0.046 / 4.0 * (1.0 - (9.525f64 / 46.0).powi(2)) * 314.159_265, 1e-3);
    assert!((4.37..5.0).contains(&(point.load * 9.0 / 3200.0)), "{}", point.load);
    // A crowded bearing is refused with its reason, and Use is disabled.
    enter(&mut harness, "Number of elements", "16");
    assert!(shows(&harness, "at most 15 do"));
    click(&mut harness, "Use");
    assert_eq!(harness.state().point(), point);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(!shows(&harness, "at most 15 do"));
    undo(&mut harness);
    assert_eq!(harness.state().point(), before, "one step");
}

#[test]
fn a_gear_pair_follows_its_path_of_contact() {
    let mut harness = window();
    click(&mut harness, "From a gear pair…");
    // FZG C gears at the pitch point.
    assert!(shows(&harness, "8.382") && shows(&harness, "422.3"));
    enter(&mut harness, "Pinion torque", "30 kW");
    click(&mut harness, "Use");
    let pitch = harness.state().point();
    close(pitch.load, 422.3e3 * 30e3 / (157.079_632_7 * 200.0), 1e-3);
    let [first, second] = speeds(&pitch);
    close(first, second, 1e-9);
    set(&mut harness, Role::Slider, "Position along the path", 4.0);
    click(&mut harness, "Use");
    let later = harness.state().point();
    let [first, second] = speeds(&later);
    close(first - second, 4e-3 * 157.079_632_7 * (1.0 + 16.0 / 24.0), 1e-6);
    enter(&mut harness, "Profile shift of the pinion", "0");
    assert!(shows(&harness, "is undercut"));
    enter(&mut harness, "Profile shift of the pinion", "0.1817");
    click(&mut harness, "Load cases along the path");
    assert!(shows(&harness, "41 contacts can be solved, 0 lines are refused"));
}

#[test]
fn a_cam_gives_the_inputs_of_a_transient_run() {
    let mut harness = window();
    click(&mut harness, "From a cam…");
    assert!(shows(&harness, "Acceleration"));
    enter(&mut harness, "Cam speed", "9000 rpm");
    assert!(shows(&harness, "the follower leaves the cam"));
    enter(&mut harness, "Cam speed", "1500");
    choose(&mut harness, "Follower", "Roller follower");
    enter(&mut harness, "Roller radius", "8 mm");
    click(&mut harness, "Transient run along the path");
    let point = harness.state().point();
    assert_eq!(point.kind, ContactKind::Line);
    let [first, second] = speeds(&point);
    close(first, second, 1e-12);
    harness.run_steps(3);
    assert!(harness.query_by_label("Set-up").is_some(), "the tab of the run is in front");
    if harness.query_by_label_contains("Inputs from CSV").is_none() {
        click(&mut harness, "Set-up");
    }
    assert!(harness.query_by_label_contains("Inputs from CSV").is_some(), "its inputs can be edited");
}
