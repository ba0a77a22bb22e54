//! A campaign in the window: its progress, its failures, and its map, while other processes compute it.

use crate::common::scratch::Scratch;
use crate::driver::{Window, click, shows, wait_until, wait_within, window};
use crate::results_tab::timeless;
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use ehl_explorer::engine::campaign::compute::{Done, compute};
use ehl_explorer::engine::campaign::merge::{Merged, merge};
use ehl_explorer::engine::campaign::plan::plan;
use ehl_explorer::engine::campaign::{Folder, local};
use ehl_explorer::engine::{Workbench, run_scene};
use ehl_explorer::scene::Scene;
use std::path::Path;
use std::time::Duration;

const PATIENCE: Duration = Duration::from_secs(60);

const SCENE: &str = "Scene(version: 1, title: \"Balls in pieces\", contact: Point, \
    grid: Plane(dx: 0.04, dy: 0.1, domain: (-3.0, 1.5, -1.5)), \
    study: RandomTest(range: (axes: {Radius: (10e-3, 11e-3, Linear), Speed: (2.0, 3.0, Linear), \
    Load: (30.0, 45.0, Linear), Alpha: (8e-9, 11e-9, Linear)}, \
    fixed: {Modulus: 231e9, Viscosity: 0.01}), tests: 12, seed: 3, method: Full), \
    expect: [(name: \"tests\", value: 12, within: Absolute(0), from: \"as many as are asked for\")])";

fn planned(scratch: &Scratch) -> Folder {
    scratch.write("balls.ron", SCENE);
    let document = scratch.write("campaign.txt", "(version: 1, scene: \"balls.ron\", shard: Pieces(4))");
    plan(&document, &scratch.join("dir"), &()).unwrap()
}

fn shard(folder: &Folder, number: usize) {
    assert_eq!(compute(folder, number, 1, &(), &|| ()).unwrap(), Done::Computed);
}

fn shows_part(harness: &Window, text: &str) -> bool {
    harness.query_all_by_label_contains(text).next().is_some()
}

#[test]
fn watched_campaign_equals_a_single_run() {
    let scratch = Scratch::new("watched-campaign");
    let folder = planned(&scratch);
    // The last shard first: the display is in the order of the study all the same.
    shard(&folder, 2);
    std::fs::write(folder.path.join("shards/000001.failed"), "no room").unwrap();
    let mut harness = window(Explorer::with_embedded_models(), [1280.0, 800.0]);
    harness.state_mut().open_scene(&folder.path.join("campaign.ron")).unwrap();
    harness.run_steps(2);
    assert_eq!(harness.state().front(), Some("Results"));
    let rows = |app: &Explorer| app.result_table("random").map_or(0, |csv| csv.lines().count() - 1);
    wait_within(PATIENCE, &mut harness, "the first shard", |app| rows(app) == 4);
    wait_until(PATIENCE, &mut harness, "how far it is", |harness| shows_part(harness, "Campaign: 1 of 3 shards"));
    assert!(shows_part(&harness, "Shard 1 failed: no room") && shows(&harness, "Balls in pieces"));
    assert!(harness.state().verdict().is_none() && harness.state().running_study());
    shard(&folder, 1);
    wait_within(PATIENCE, &mut harness, "the second shard", |app| rows(app) == 8);
    wait_until(PATIENCE, &mut harness, "no failure", |harness| !shows_part(harness, "Shard 1 failed"));
    shard(&folder, 0);
    assert!(matches!(merge(&folder, &()).unwrap(), Merged::Result(_)));
    wait_within(PATIENCE, &mut harness, "the end", |app| app.verdict().is_some());
    assert_eq!(harness.state().verdict(), Some(true));
    wait_until(PATIENCE, &mut harness, "the merge", |harness| shows_part(harness, "round 1; merged"));
    let one = run_scene(&Scene::from_ron(SCENE).unwrap(), &mut Workbench::new(""), &()).unwrap();
    let shown = harness.state().result_table("random").unwrap();
    assert_eq!(timeless(&shown), timeless(&one.tables[0].to_csv()));
}

const TRAINING: &str = "Scene(version: 1, title: \"Model in pieces\", study: Training(title: \"small\", range: (axes: \
    {Radius: (2e-3, 3e-3, Linear), Speed: (3.0, 5.0, Linear), Load: (1e5, 2e5, Linear), Alpha: (6e-9, 10e-9, Linear)}, \
    fixed: {Modulus: 231e9, Viscosity: 0.01}), plan: FarthestPoint(snapshots: 14), windows: Given([(m: (1.0, 500.0), \
    grid: Uniform(dx: 0.04, domain: (-4.0, 2.0)))]), pressure_loss: 1e-6, deformation_loss: 1e-6, sampling: QDeim, \
    evidence: 0, rows_per_mode: 2.0, penalty: 1e6, seed: 3), \
    expect: [(name: \"snapshots\", value: 14, within: Absolute(0), from: \"as many as are asked for\"), \
    (name: \"training_s\", within: AtLeast(0), from: \"the shards’ seconds\")])";

#[test]
fn a_training_that_was_merged_is_judged_as_one_run_is() {
    let scratch = Scratch::new("trained-campaign");
    scratch.write("model.ron", TRAINING);
    let document = scratch.write("campaign.txt", "(version: 1, scene: \"model.ron\", shard: Pieces(7))");
    let folder = plan(&document, &scratch.join("dir"), &()).unwrap();
    (0..folder.shards()).for_each(|number| shard(&folder, number));
    let Merged::Result(whole) = merge(&folder, &()).unwrap() else { panic!("another round") };
    assert!(whole.outcome.passed());
    let mut harness = window(Explorer::with_embedded_models(), [1280.0, 800.0]);
    harness.state_mut().open_scene(&folder.path.join("campaign.ron")).unwrap();
    wait_within(PATIENCE, &mut harness, "the end", |app| app.verdict().is_some());
    assert_eq!(harness.state().verdict(), Some(true));
    wait_until(PATIENCE, &mut harness, "its verdicts", |harness| shows(harness, "All 2 hold"));
    let windows = harness.state().result_table("windows").unwrap();
    let merged = whole.outcome.tables.iter().find(|table| table.name == "windows").unwrap();
    assert_eq!(windows, merged.to_csv());
}

#[test]
fn watching_stops_and_refuses_other_folders() {
    let scratch = Scratch::new("stopped-campaign");
    let folder = planned(&scratch);
    shard(&folder, 0);
    let mut harness = window(Explorer::with_embedded_models(), [1280.0, 800.0]);
    assert!(harness.state_mut().open_scene(&scratch).unwrap_err().contains("it is a folder"));
    harness.state_mut().open_scene(&folder.path).unwrap();
    wait_within(PATIENCE, &mut harness, "the first shard", |app| app.result_table("random").is_some());
    click(&mut harness, "Stop watching");
    wait_within(PATIENCE, &mut harness, "the stop", |app| !app.running_study());
    assert!(harness.state().verdict().is_none(), "what was stopped is not judged");
    // A damaged file ends it with a sentence; the previous display stays.
    std::fs::write(folder.path.join("shards/000001.shard"), "nonsense").unwrap();
    harness.state_mut().open_scene(&folder.path).unwrap();
    wait_within(PATIENCE, &mut harness, "the refusal", |app| !app.running_study());
    harness.run_steps(2);
    assert!(shows_part(&harness, "another kind of file"));
    assert!(harness.state().result_table("random").is_some());
}

#[test]
fn a_program_that_is_not_there_is_named() {
    let scratch = Scratch::new("no-program");
    let folder = planned(&scratch);
    let refused = local::run(&folder.path, Path::new("no/such/program"), 2, &()).unwrap_err().to_string();
    assert!(refused.contains("cannot start no/such/program"), "{refused}");
}
