//! The Training tab without a display: a training is started, observed, stopped, resumed, used, saved and compared.

use crate::common::scratch::Scratch;
use crate::driver::{Table, Window, assert_cheap, click, give_path, undo, wait};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use ehl_explorer::engine::{embedded, model_file, training_file};
use std::path::Path;

/// A scene with a training of a small box; full solves take about a millisecond.
fn scene(title: &str, plan: &str) -> String {
    format!(
        "Scene(version: 1, title: \"{title}\", at: Si(radius: 2.5e-3, speed: 4, load: 1.5e5, modulus: 231e9, viscosity: 0.01, alpha: 9e-9), study: Training(
            title: \"{title}\",
            range: (axes: {{Radius: (2e-3, 3e-3, Linear), Speed: (3.0, 5.0, Linear),
                Load: (1e5, 2e5, Linear), Alpha: (6e-9, 12e-9, Linear)}},
                fixed: {{Modulus: 231e9, Viscosity: 0.01}}),
            plan: {plan},
            windows: Given([(m: (5.0, 100.0), grid: Graded(nodes: 200, domain: (-6.0, 2.0), registered: true))]),
            pressure_loss: 1e-6, deformation_loss: 1e-6, rows_per_mode: 2.0, evidence: 110, seed: 1,
        ))"
    )
}

const TINY: &str = "Adaptive(start: 12, indicator: Correction, tolerances: [1e-7], successes: 16, local_sigma: 0.1, \
    local_successes: 8, vicinity: 4, limit: 15)";
/// Longer than the test waits, on a grid on which a full solve takes some milliseconds.
const LONG: &str = "FarthestPoint(snapshots: 1500)";

/// Opens the Training tab on a scene with a training.
fn open(folder: &Path, title: &str, plan: &str) -> Window {
    let path = folder.join("scene.ron");
    let nodes = if plan == LONG { "nodes: 500" } else { "nodes: 200" };
    std::fs::write(&path, scene(title, plan).replace("nodes: 200", nodes)).unwrap();
    let mut explorer =
        Explorer::new(Some(embedded("line").unwrap())).without_system_dialogs().keeping_trainings_in(folder);
    explorer.open_scene(&path).unwrap();
    let mut harness = crate::driver::window(explorer, [1280.0, 1400.0]);
    wait(&mut harness, "the first picture", |app| !app.training() && !app.busy() && app.central_film().is_some());
    click(&mut harness, "Training");
    harness
}

#[test]
fn a_small_training_is_watched_used_compared_and_saved() {
    let folder = Scratch::new("training-tab-small");
    let mut harness = open(&folder, "Small box", TINY);
    let embedded = harness.state().model_title().unwrap().to_owned();
    click(&mut harness, "Start training");
    wait(&mut harness, "the training", |app| !app.training());
    assert!(harness.query_by_label_contains("Done with 15 full solutions").is_some());
    assert!(harness.query_by_label_contains("tolerance 1e-7 could not be met").is_some());
    assert!(harness.query_by_label("Indicator against full solutions").is_some());
    assert_eq!(harness.state().model_title(), Some(embedded.as_str()), "nothing is replaced unasked");
    click(&mut harness, "Compare models");
    wait(&mut harness, "the comparison", |app| !app.training());
    assert!(harness.query_by_label_contains("Models compared").is_some());
    assert!(harness.query_by_label("Online median").is_some());
    assert!(harness.query_by_label("Pre-computed 12").is_some(), "the chart stays");
    click(&mut harness, "Use this model");
    assert_eq!(harness.state().model_title(), Some("Small box"));
    wait(&mut harness, "verification", |app| ["Verified", "Roughly right", "Far off"].contains(&app.badge().as_str()));
    click(&mut harness, "Restore previous model");
    assert_eq!(harness.state().model_title(), Some(embedded.as_str()));
    click(&mut harness, "Save model…");
    let path = folder.join("small.rom");
    give_path(&mut harness, &path, "Save");
    assert_eq!(model_file::read(&path).unwrap().title, "Small box");
    assert!(!folder.join("unfinished.training").exists());
    assert!(!folder.join("trained.rom").exists(), "what is saved need not be kept");
    // In a comparison with other models it is not in use.
    click(&mut harness, "Add a model…");
    give_path(&mut harness, &path, "Add");
    assert!(harness.query_by_label("small").is_some() && harness.state().model_title() == Some(embedded.as_str()));
    click(&mut harness, "Compare models");
    wait(&mut harness, "the comparison of three", |app| !app.training());
    assert!(harness.query_by_label("Small").is_some(), "a column of the table");
    click(&mut harness, "Leave out small");
    assert!(harness.query_by_label("Leave out small").is_none());
    harness.state_mut().open_scene(&path).unwrap();
    wait(&mut harness, "the model from the file", |app| app.model_title() == Some("Small box"));
}

#[test]
fn a_stopped_training_is_kept_used_and_resumed_after_a_crash() {
    let folder = Scratch::new("training-tab-stopped");
    let kept = folder.join("unfinished.training");
    let mut harness = open(&folder, "Long box", LONG);
    click(&mut harness, "Start training");
    wait(&mut harness, "the first file", |_| kept.exists());
    assert!(harness.query_by_label("Progress of the training").is_some());
    assert!(harness.query_by_label("Start training").is_none());
    // Meanwhile the picture is dragged, and is updated within the frame.
    assert_cheap(&mut harness, 40, 12.0, |harness, k| {
        assert!(harness.state().training() && harness.state().central_film().is_some());
        harness.get_by_label("Load number M").set_value_accesskit(20.0 * 1.02f64.powi(k.into()));
    });
    assert!(harness.state().training() && harness.state().central_film().is_some());
    click(&mut harness, "Stop");
    wait(&mut harness, "the model of what there is", |app| !app.training());
    assert!(harness.query_by_label_contains("Stopped at").is_some());
    click(&mut harness, "Use this model");
    assert_eq!(harness.state().model_title(), Some("Long box"));
    let solutions = training_file::read(&kept).unwrap().solutions();
    assert!((16..1500).contains(&solutions));
    drop(harness);
    // The window is closed; the next one offers to continue.
    let mut harness = open(&folder, "Long box", LONG);
    assert!(harness.query_by_label_contains("was left unfinished").is_some());
    assert!(harness.get_by_label("Start training").accesskit_node().is_disabled());
    click(&mut harness, "Resume training");
    harness.step();
    assert!(harness.state().training());
    click(&mut harness, "Stop");
    wait(&mut harness, "the end", |app| !app.training());
    click(&mut harness, "Discard…");
    assert!(kept.exists(), "it asks first");
    click(&mut harness, "Discard it");
    assert!(!kept.exists());
    assert!(!harness.get_by_label("Start training").accesskit_node().is_disabled());
}

#[test]
fn unsaved_models_are_kept_and_asked_about() {
    let folder = Scratch::new("training-tab-kept");
    let kept = folder.join("trained.rom");
    let mut harness = open(&folder, "Small box", TINY);
    click(&mut harness, "Start training");
    wait(&mut harness, "the training", |app| !app.training());
    assert_eq!(model_file::read(&kept).unwrap().title, "Small box");
    drop(harness);
    // The next window has it, and offers to save it.
    let mut harness = open(&folder, "Small box", TINY);
    assert!(harness.query_by_label_contains("of a previous session is not saved").is_some());
    // Models are compared over its range, whatever training the form shows.
    click(&mut harness, "Whole slider range");
    click(&mut harness, "Compare models");
    wait(&mut harness, "the comparison", |app| !app.training());
    assert!(harness.query_by_label_contains("of the range of “Small box”").is_some());
    click(&mut harness, "Export comparison…");
    let path = folder.join("comparison.csv");
    give_path(&mut harness, &path, "Export");
    let loads = Table::of(&std::fs::read_to_string(&path).unwrap()).column("moes.M");
    let (low, high) = model_file::read(&kept).unwrap().domain.m();
    assert!(loads.len() == 200 && loads.iter().all(|m| (low..=high).contains(m)), "{low} {high}: {loads:?}");
    undo(&mut harness);
    click(&mut harness, "Use this model");
    assert_eq!(harness.state().model_title(), Some("Small box"));
    // Another training would replace it, so a confirmation is requested. Cancel changes nothing.
    click(&mut harness, "Start training");
    assert!(harness.query_by_label_contains("was trained and is not saved").is_some());
    click(&mut harness, "Cancel");
    assert!(!harness.state().training() && kept.exists());
    click(&mut harness, "Discard model…");
    click(&mut harness, "Discard it");
    assert!(!kept.exists() && harness.query_by_label("Save model…").is_none());
    // Nothing would be lost now, and no confirmation is requested.
    click(&mut harness, "Start training");
    assert!(harness.state().training());
    click(&mut harness, "Stop");
    wait(&mut harness, "the end", |app| !app.training());
}

#[test]
fn a_bad_range_is_a_sentence_and_edits_can_be_undone() {
    let folder = Scratch::new("training-tab-range");
    let mut harness = open(&folder, "Small box", TINY);
    let value = |harness: &Window, name: &str| harness.get_by_label(name).value().unwrap();
    let before = value(&harness, "Radius R from");
    harness.get_by_label("Radius R from").set_value_accesskit(7.0);
    harness.run_steps(2);
    assert!(harness.query_by_label_contains("`range.axes.Radius` runs from 0.007 down to 0.003").is_some());
    assert_eq!(value(&harness, "Radius R from"), before, "what is refused changes nothing");
    harness.get_by_label("Radius R to").set_value_accesskit(4.0);
    harness.run_steps(2);
    assert!(harness.query_by_label_contains("`range.axes.Radius`").is_none());
    let after = value(&harness, "Radius R to");
    undo(&mut harness);
    assert_ne!(value(&harness, "Radius R to"), after);
    // The presets fill the form; the sliders' range is given in M and L.
    click(&mut harness, "Whole slider range");
    assert_eq!(value(&harness, "Load number M to"), "500");
    undo(&mut harness);
    assert_eq!(value(&harness, "Radius R from"), before);
}

#[test]
fn failing_full_solves_of_a_training_are_reported() {
    let folder = Scratch::new("training-tab-failing");
    // A grid that is too coarse at high loads: some contact there has no full solution.
    let text = scene("Failing box", "FarthestPoint(snapshots: 60)")
        .replace("Load: (1e5, 2e5, Linear)", "Load: (1e5, 4e6, Linear)")
        .replace("Alpha: (6e-9, 12e-9, Linear)", "Alpha: (6e-9, 40e-9, Linear)")
        .replace("m: (5.0, 100.0)", "m: (5.0, 4000.0)")
        .replace("nodes: 200", "nodes: 61");
    let mut harness = open(&folder, "Failing box", TINY);
    let path = folder.join("failing.ron");
    std::fs::write(&path, text).unwrap();
    harness.state_mut().open_scene(&path).unwrap();
    harness.run_steps(2);
    click(&mut harness, "Start training");
    wait(&mut harness, "the failure", |app| !app.training());
    assert!(harness.query_by_label_contains("full solver did not converge at M =").is_some());
    assert!(harness.query_by_label_contains("until then are kept").is_some());
    assert!(harness.query_by_label("Resume training").is_some());
}
