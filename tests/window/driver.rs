//! Control of the window without a display: shared helpers of the tests of its tabs.

use crate::common::processor_time::{fixed_work, of_this_thread};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use std::path::Path;
use std::time::{Duration, Instant};

/// Titles of all tabs.
pub const TABS: [&str; 10] = [
    "Profiles",
    "Contact map",
    "Regimes",
    "Traction",
    "Reduced basis",
    "Accuracy",
    "Training",
    "Transient",
    "TPWL",
    "Results",
];
/// Roles of controls.
pub const CONTROLS: [Role; 7] =
    [Role::Button, Role::Slider, Role::SpinButton, Role::CheckBox, Role::RadioButton, Role::ComboBox, Role::TextInput];

/// Longer than any reduced solve on the busiest machine, so that the picture in a test's frame does not depend on it.
pub const PATIENCE: Duration = Duration::from_secs(60);

/// Opens the explorer in a window.
pub type Window = Harness<'static, Explorer>;

/// Opens a window of a size in points.
pub fn window(explorer: Explorer, size: [f32; 2]) -> Window {
    impatient_window(explorer.waiting_for_answers(PATIENCE), size)
}

/// The same with the explorer's own waiting time within a frame.
pub fn impatient_window(explorer: Explorer, size: [f32; 2]) -> Window {
    Harness::builder().with_size(size).build_ui_state(|ui, app: &mut Explorer| app.ui(ui), explorer)
}

/// How long a window rests between two frames when it has waited for so long: frames want the processor too, and take it
/// from what is waited for.
fn pause(waited: Duration) -> Duration {
    (waited / 10).clamp(Duration::from_millis(5), Duration::from_millis(40))
}

/// Steps until `done`, for at most a while.
pub fn wait_until(patience: Duration, harness: &mut Window, what: &str, done: impl Fn(&Window) -> bool) {
    let begin = Instant::now();
    loop {
        harness.step();
        if done(harness) {
            harness.run_steps(2);
            return;
        }
        let app = harness.state();
        assert!(begin.elapsed() < patience, "waited in vain for {what}: {}, {}", app.badge(), app.badge_detail());
        std::thread::sleep(pause(begin.elapsed()));
    }
}

/// The same for a condition on the explorer's state.
pub fn wait_within(patience: Duration, harness: &mut Window, what: &str, done: impl Fn(&Explorer) -> bool) {
    wait_until(patience, harness, what, |harness| done(harness.state()));
}

/// The same for at most five minutes, since a busy machine may take long.
pub fn wait(harness: &mut Window, what: &str, done: impl Fn(&Explorer) -> bool) {
    wait_within(Duration::from_secs(300), harness, what, done);
}

/// Clicks the control with this name.
pub fn click(harness: &mut Window, name: &str) {
    harness.get_by_label(name).click();
    harness.run_steps(3);
}

/// Returns true if a text is on the screen, possibly as part of a longer one.
pub fn shows(harness: &Window, text: &str) -> bool {
    harness.query_all_by_label_contains(text).next().is_some()
}

/// Presses a key.
pub fn press(harness: &mut Window, modifiers: Modifiers, key: Key) {
    harness.key_press_modifiers(modifiers, key);
    harness.run_steps(3);
}

/// Undoes the last edit.
pub fn undo(harness: &mut Window) {
    press(harness, Modifiers::COMMAND, Key::Z);
}

/// Sets a slider or a number to a value.
pub fn set(harness: &mut Window, role: Role, name: &str, value: f64) {
    harness.get_by_role_and_label(role, name).set_value_accesskit(value);
    harness.run_steps(2);
}

/// Selects an option of a combo box.
pub fn choose(harness: &mut Window, picker: &str, option: &str) {
    harness.get_by_role_and_label(Role::ComboBox, picker).click();
    harness.run_steps(3);
    click(harness, option);
}

/// Replaces the text of a field.
pub fn write(harness: &mut Window, field: &str, text: &str) {
    harness.get_by_role_and_label(Role::TextInput, field).focus();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.get_by_role_and_label(Role::TextInput, field).type_text(text);
    harness.run_steps(2);
}

/// Enters a path into the path field, and confirms it.
pub fn give_path(harness: &mut Window, path: &Path, action: &str) {
    write(harness, "Path of the file", &path.display().to_string());
    click(harness, action);
}

/// Exports an item of a tab's Export menu to a path, and reads it.
pub fn export(harness: &mut Window, tab: &str, item: &str, path: &Path) -> String {
    click(harness, &format!("Export from {tab}"));
    click(harness, item);
    give_path(harness, path, "Export");
    std::fs::read_to_string(path).unwrap()
}

/// Exports a plot of a tab as SVG to a path, and reads it.
pub fn export_plot(harness: &mut Window, tab: &str, plot: &str, path: &Path) -> String {
    click(harness, &format!("Export from {tab}"));
    click(harness, "Figure…");
    harness.get_by_role_and_label(Role::ComboBox, "Plot").click();
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::Button, plot).click();
    harness.run_steps(3);
    click(harness, "SVG…");
    give_path(harness, path, "Export");
    std::fs::read_to_string(path).unwrap()
}

/// Returns the caption of a drawing without line ends.
pub fn caption(drawing: &str) -> String {
    let lines = drawing.lines().filter(|line| line.contains("class=\"caption\""));
    let words = |line: &str| line.split_once('>').map(|(_, rest)| rest.trim_end_matches("</text>").to_owned());
    lines.filter_map(words).collect::<Vec<_>>().join(" ")
}

/// Returns the number of solid curves of a drawing.
pub fn solid_curves(drawing: &str) -> usize {
    let curve = |line: &&str| line.starts_with("<polyline") && line.matches(',').count() > 30;
    drawing.lines().filter(curve).filter(|line| !line.contains("stroke-dasharray")).count()
}

/// Starts the transient runs, unless they have started automatically, and waits for their end.
pub fn run_in_time(harness: &mut Window) {
    harness.run_steps(3);
    rest_in_time(harness);
    let (current, runs, replayed) = harness.state().in_time();
    if !current || runs == 0 || replayed > 0 {
        click(harness, "Run transient");
        rest_in_time(harness);
    }
}

/// Waits for the end of transient runs.
pub fn rest_in_time(harness: &mut Window) {
    wait_within(Duration::from_secs(900), harness, "the run", |app| !app.marching());
}

/// Returns the displayed time.
pub fn time(harness: &Window) -> f64 {
    harness.get_by_role_and_label(Role::Slider, "Time T").accesskit_node().numeric_value().unwrap()
}

/// Time of [`fixed_work`] on the machine that the limits of frames are stated for, in milliseconds.
const FIXED_WORK_MS: f64 = 0.33;

/// Asserts the mean processor time of a frame in this thread, in milliseconds on a machine with [`FIXED_WORK_MS`] for
/// [`fixed_work`]. `change` runs before each frame. The speed of machines and the load on them vary by more than the
/// permitted range, so both are measured in turns and compared by their ratio.
pub fn assert_cheap(harness: &mut Window, frames: u16, most_ms: f64, mut change: impl FnMut(&mut Window, u16)) {
    // Turns much longer than a tick of the processor-time clock.
    let (frames_in_turn, works_in_turn) = (10, 50);
    let (mut drawn, mut beside) = (Duration::ZERO, Duration::ZERO);
    for turn in 0..frames / frames_in_turn {
        let begin = of_this_thread();
        for k in 0..frames_in_turn {
            change(harness, turn * frames_in_turn + k);
            harness.step();
        }
        let middle = of_this_thread();
        (0..works_in_turn).for_each(|_| _ = std::hint::black_box(fixed_work()));
        drawn += middle - begin;
        beside += of_this_thread() - middle;
    }
    let ms = |sum: Duration, times: u16| 1e3 * sum.as_secs_f64() / f64::from(frames / frames_in_turn * times);
    let (frame_ms, work_ms) = (ms(drawn, frames_in_turn), ms(beside, works_in_turn));
    let stated_ms = frame_ms * FIXED_WORK_MS / work_ms;
    println!("a frame takes {stated_ms:.2} ms: {frame_ms:.2} ms here, where the fixed work takes {work_ms:.3} ms");
    // Without optimisation everything is many times slower.
    let slower = if cfg!(debug_assertions) { 60.0 } else { 1.0 };
    assert!(stated_ms < slower * most_ms, "a frame takes {stated_ms} ms, here {frame_ms} ms");
}

/// Finds a line that can be moved sideways along a row of the screen, and drags it to the right.
pub fn drag_line(harness: &mut Window, (from, to): (f32, f32), y: f32, by: f32) {
    // In steps shorter than the range of the line.
    let movable = (0..((to - from) / 3.0) as usize).map(|k| from + 3.0 * k as f32).find(|&x| {
        harness.hover_at(egui::pos2(x, y));
        harness.step();
        harness.output().platform_output.cursor_icon == egui::CursorIcon::ResizeHorizontal
    });
    let x = movable.expect("the line shows under the pointer that it can be moved");
    harness.drag_at(egui::pos2(x, y));
    harness.step();
    for k in 1..=10 {
        harness.hover_at(egui::pos2(x + 0.1 * by * k as f32, y));
        harness.step();
    }
    harness.drop_at(egui::pos2(x + by, y));
    harness.run();
}

/// Returns the time until the next repaint of the idle window.
pub fn rest(harness: &mut Window) -> Duration {
    harness.run();
    harness.output().viewport_output.values().map(|viewport| viewport.repaint_delay).min().unwrap()
}

/// Rows of numbers by the names of their columns, without comments.
pub struct Table {
    pub header: Vec<String>,
    pub rows: Vec<Vec<f64>>,
}

impl Table {
    pub fn of(text: &str) -> Self {
        let mut lines = text.lines().filter(|line| !line.starts_with('#'));
        let header = lines.next().unwrap().split(',').map(str::to_owned).collect();
        let row = |line: &str| line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
        Self { header, rows: lines.map(row).collect() }
    }

    pub fn at(&self, name: &str) -> usize {
        self.header.iter().position(|title| title == name).unwrap()
    }

    pub fn column(&self, name: &str) -> Vec<f64> {
        let at = self.at(name);
        self.rows.iter().map(|row| row[at]).collect()
    }
}
