//! The Accuracy tab without a display: its studies run, can be stopped, lead to the contacts they found, and are marked
//! when they are outdated.

use crate::common::scratch::Scratch;
use crate::driver::{Table, Window, choose, click, export, set, shows, undo, wait_until};
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use ehl_explorer::engine::{SceneOutcome, Workbench, embedded, run_scene};
use ehl_explorer::scene::{Grid, Scene, Study};
use std::time::Duration;

/// Opens the Accuracy tab at one of its views, after the picture is complete.
fn open(view: &str) -> Window {
    let explorer = Explorer::new(Some(embedded("line").unwrap())).without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, 800.0]);
    wait(&mut harness, "verification", |h| h.state().badge() == "Verified" && !h.state().busy());
    click(&mut harness, "Accuracy");
    click(&mut harness, view);
    harness
}

fn wait(harness: &mut Window, what: &str, done: impl Fn(&Window) -> bool) {
    wait_until(Duration::from_secs(300), harness, what, done);
}

fn count(harness: &mut Window, name: &str, value: f64) {
    set(harness, Role::SpinButton, name, value);
}

/// Waits for the end of studies that started automatically.
fn rest(harness: &mut Window) {
    wait(harness, "what begins by itself", |h| !h.state().studying());
}

fn run_tests(harness: &mut Window, tests: f64, compared: f64) {
    rest(harness);
    count(harness, "Random contacts", tests);
    count(harness, "Compared in full", compared);
    click(harness, "Run validation");
    wait(harness, "the random tests", |h| !h.state().studying());
}

/// Writes the table of the view through the path field and reads it again.
fn exported(harness: &mut Window, item: &str, name: &str) -> Vec<String> {
    let folder = Scratch::new("accuracy");
    let text = export(harness, "Accuracy", item, &folder.join(name));
    text.lines().map(str::to_owned).collect()
}

/// Runs a study without the window at the contact that the window starts with, with the cavitation model of the
/// reduced model.
fn headless(study: &str) -> SceneOutcome {
    let of = "at: Moes(m: 40.0, l: 10.0), cavitation: Complementarity";
    let text = format!("Scene(version: 1, title: \"t\", {of}, study: {study})");
    let scene = Scene { grid: Grid::Model, ..Scene::from_ron(&text).unwrap() };
    run_scene(&scene, &mut Workbench::new(""), &()).unwrap()
}

/// Asserts that columns of an exported table are bitwise equal to those of a table computed without the window.
fn assert_same(exported: &[String], outcome: &SceneOutcome, columns: &[(&str, &str)]) {
    let (own, headless) = (Table::of(&exported.join("\n")), Table::of(&outcome.tables[0].to_csv()));
    for (name, of) in columns {
        let bits = |values: Vec<f64>| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(own.column(name)), bits(headless.column(of)), "{name}");
    }
}

/// Truncates the model as opening a scene with a view does.
fn truncate(harness: &mut Window) {
    let text = "Scene(version: 1, title: \"t\", at: Moes(m: 40.0, l: 10.0), study: Point(methods: [Full]), \
        view: (pressure_loss: 1e-5))";
    harness.state_mut().open_scene(&Scratch::new("truncated").write("scene.ron", text)).unwrap();
    harness.run_steps(2);
    // The scene's own study is shown in the profiles.
    click(harness, "Accuracy");
}

#[test]
fn the_parts_appear_when_the_sliders_rest_and_follow_them() {
    let mut harness = open("Error contributions");
    wait(&mut harness, "the parts", |h| shows(h, "Discretisation, H_min: "));
    for part in ["Basis", "Projection", "Sampling", "Reduced against full", "Reduced against the limit"] {
        assert!(shows(&harness, &format!("{part}, H_c: ")), "{part}");
    }
    let table = exported(&mut harness, "Parts of the error as CSV…", "split.csv");
    assert_eq!(table[3], "row,H_c,H_min,P");
    let parts: Vec<f64> = table[4..].iter().map(|line| line.split(',').nth(1).unwrap().parse().unwrap()).collect();
    assert!(
        (parts[0] + parts[1] + parts[2] - parts[3]).abs() < 1e-12 && (parts[3] + parts[4] - parts[5]).abs() < 1e-12
    );
    let outcome = headless("ErrorSplit(contacts: Here, method: Reduced())");
    for (part, name) in parts.iter().zip(["basis", "projection", "sampling", "reduction", "discretisation", "whole"]) {
        let value = outcome.found.value(&format!("H_c.{name}"), None).unwrap();
        assert_eq!(part.to_bits(), value.to_bits(), "{name} on the screen and headless");
    }
    harness.get_by_label("Load number M").set_value_accesskit(80.0);
    harness.run_steps(1);
    assert!(shows(&harness, "not to the sliders"));
    wait(&mut harness, "the new parts", |h| !shows(h, "not to the sliders"));
    // Outside the trained range nothing is computed automatically.
    harness.get_by_label("Load number M").set_value_accesskit(900.0);
    harness.run_steps(4);
    assert!(shows(&harness, "on request only") && !harness.state().studying());
}

#[test]
fn the_failure_map_counts_and_its_worst_case_is_a_click_away() {
    let mut harness = open("Failure map");
    run_tests(&mut harness, 200.0, 10.0);
    assert!(shows(&harness, "200 of 200 tests, no failures, 10 compared"));
    let before = harness.state().moes();
    click(&mut harness, "Go to worst case 1");
    let worst = harness.state().moes();
    assert_ne!(before, worst);
    wait(&mut harness, "its picture", |h| h.state().central_film().is_some());
    undo(&mut harness);
    assert_eq!(harness.state().moes(), before);
    let table = exported(&mut harness, "Random validation as CSV…", "map.csv");
    assert_eq!(table.len(), 4 + 200);
    assert!(table[3].starts_with("moes.M,moes.L,si.radius"));
    let model = embedded("line").unwrap();
    let mut scene = Scene::from_ron(
        "Scene(version: 1, title: \"t\", at: Moes(m: 40.0, l: 10.0), cavitation: Complementarity, \
        study: RandomTest(range: (axes: {Radius: (2e-3, 3e-3, Linear), Speed: (3.0, 5.0, Linear), \
        Load: (1e5, 2e5, Linear), Alpha: (6e-9, 10e-9, Linear)}, \
        fixed: {Modulus: 231e9, Viscosity: 0.01}), tests: 200, seed: 1, method: Reduced(), compare: 10))",
    )
    .unwrap();
    let Study::RandomTest(test) = &mut scene.study else { panic!() };
    test.range = model.domain.space.clone();
    let outcome = run_scene(&scene, &mut Workbench::new(""), &()).unwrap();
    assert_same(
        &table,
        &outcome,
        &["moes.M", "H_c", "H_min", "newton_iterations", "reduced.h_c_error_bound"].map(|name| (name, name)),
    );
    truncate(&mut harness);
    assert!(shows(&harness, "has changed since"));
}

#[test]
fn a_click_on_the_map_goes_to_the_test_there() {
    let mut harness = open("Failure map");
    run_tests(&mut harness, 400.0, 0.0);
    let before = harness.state().moes();
    let rect = harness.get_by_label("Map of the random validation").rect();
    // The tests are dense at the corners of the range (3.17). The pressure limit never cuts the lower left one.
    for k in 0..60 {
        let corner = rect.left_bottom() + egui::vec2(0.3, -0.3) * f32::from(u8::try_from(k).unwrap()) * 4.0;
        harness.hover_at(corner);
        harness.run_steps(1);
        harness.drag_at(corner);
        harness.run_steps(1);
        harness.drop_at(corner);
        harness.run_steps(2);
        if harness.state().moes() != before {
            return;
        }
    }
    panic!("no test was found along the diagonal");
}

#[test]
fn the_bound_is_held_against_the_truth() {
    let mut harness = open("Bound vs. true error");
    rest(&mut harness);
    assert!(shows(&harness, "Compared: 20"), "a few tests are made unasked");
    run_tests(&mut harness, 200.0, 20.0);
    for name in ["Compared: 20", "Rank correlation: ", "Bound holds: ", "Median effectivity: "] {
        assert!(shows(&harness, name), "{name}");
    }
    harness.get_by_label("Bound against true error");
}

#[test]
fn the_trajectory_is_followed_in_both_ranges() {
    let mut harness = open("Along the trajectory");
    rest(&mut harness);
    assert!(shows(&harness, "41 of 41 contacts through Table 3.1’s box"), "it is followed unasked");
    count(&mut harness, "Contacts", 11.0);
    click(&mut harness, "Follow the trajectory");
    wait(&mut harness, "the trajectory", |h| !h.state().studying());
    assert!(shows(&harness, "11 of 11 contacts through Table 3.1’s box, 0 failures"));
    let table = exported(&mut harness, "Trajectory as CSV…", "along.csv");
    assert_eq!(table.len(), 3 + 11);
    let range = "(axes: {Radius: (2e-3, 4e-3, Linear), Speed: (1.0, 10.0, Linear), Load: (1e5, 5e5, Linear), \
        Alpha: (5e-9, 20e-9, Linear)}, fixed: {Modulus: 231e9, Viscosity: 0.01})";
    let outcome = headless(&format!("Trajectory(range: {range}, points: 11, methods: [Reduced(), Full])"));
    assert_same(&table, &outcome, &[("H_c", "reduced.H_c"), ("full.H_c", "full.H_c")]);
    harness.get_by_label("Film along the trajectory");
    harness.get_by_label("Error along the trajectory");
    choose(&mut harness, "Through", "the trained range");
    assert!(shows(&harness, "through Table 3.1’s box"), "what was asked for stays");
    click(&mut harness, "Follow the trajectory");
    wait(&mut harness, "the other trajectory", |h| !h.state().studying());
    assert!(shows(&harness, "11 of 11 contacts through the trained range, 0 failures"));
}

#[test]
fn stopped_study_keeps_its_results() {
    let mut harness = open("Failure map");
    rest(&mut harness);
    count(&mut harness, "Random contacts", 10_000.0);
    // The duration of a stop is tested without the window, where studies are cancelled.
    for attempt in 0..3 {
        click(&mut harness, "Run validation");
        wait(&mut harness, "the first tests", |h| shows(h, " of 10000 tests") && !shows(h, "0 of 10000 tests, no"));
        harness.get_by_label("Load number M").set_value_accesskit(60.0 + f64::from(attempt));
        harness.run_steps(2);
        assert!(harness.state().central_film().is_some(), "the picture follows while the tests run");
        click(&mut harness, "Stop");
        wait(&mut harness, "the end", |h| !h.state().studying());
        assert!(shows(&harness, " of 10000 tests") && !shows(&harness, "10000 of 10000"));
    }
}

#[test]
fn accuracy_results_follow_the_model_while_visible() {
    let mut harness = open("Failure map");
    assert!(harness.state().studying(), "nobody has to press anything");
    click(&mut harness, "Profiles");
    assert!(!harness.state().studying(), "nobody looks");
    click(&mut harness, "Accuracy");
    rest(&mut harness);
    assert!(shows(&harness, "200 of 200 tests, no failures, 20 compared"));
    truncate(&mut harness);
    assert!(harness.state().studying() && !shows(&harness, "has changed since"), "another model has other errors");
    rest(&mut harness);
    assert!(shows(&harness, "200 of 200 tests"));
}

#[test]
fn residuals_remain_and_a_missing_model_is_reported() {
    let harness = open("Newton residuals");
    assert!(shows(&harness, "Last full solve"));
    let mut harness = crate::driver::window(Explorer::new(None).without_system_dialogs(), [1280.0, 800.0]);
    harness.run_steps(2);
    for view in ["Error contributions", "Failure map", "Bound vs. true error", "Along the trajectory"] {
        click(&mut harness, "Accuracy");
        click(&mut harness, view);
        assert!(shows(&harness, "no model to validate"), "{view}");
    }
}
