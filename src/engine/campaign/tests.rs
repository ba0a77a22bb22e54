//! Tests that campaigns give the same rows and files as a single run.

use super::CampaignError;
use super::compute::{Done, compute};
use super::folder::{Folder, RESULT, SHARDS};
use super::merge::{Merged, merge};
use super::plan::plan;
use crate::engine::{Workbench, model_file, run_scene};
use crate::scene::{Scene, StudyObserver, StudyRow};
use crate::solver::observer::Observer;
use crate::solver::training::{TrainingObserver, train};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

#[derive(Default)]
struct Rows(Mutex<Vec<StudyRow>>);

impl Observer for Rows {}
impl TrainingObserver for Rows {}
impl StudyObserver for Rows {
    fn row(&self, row: StudyRow) {
        self.0.lock().unwrap().push(row);
    }
}

impl Rows {
    /// Returns the rows without measured times, as bytes.
    fn bytes(self) -> Vec<Vec<u8>> {
        let mut rows = self.0.into_inner().unwrap();
        rows.iter_mut().flat_map(StudyRow::seconds).for_each(|seconds| *seconds = 0.0);
        let mut bytes: Vec<_> = rows.iter().map(|row| postcard::to_allocvec(row).unwrap()).collect();
        for (row, bytes) in rows.iter().zip(&bytes) {
            let again: StudyRow = postcard::from_bytes(bytes).unwrap();
            assert_eq!(postcard::to_allocvec(&again).unwrap(), *bytes, "{row:?}");
        }
        bytes.sort();
        bytes
    }
}

#[test]
fn pieces_in_any_order_give_every_bit_of_one_run() {
    let table = "range: (axes: {Radius: (2e-3, 4e-3, Linear), Speed: (1.0, 10.0, Linear), \
    Load: (1e5, 5e5, Linear), Alpha: (5e-9, 20e-9, Linear)}, \
    fixed: {Modulus: 231e9, Viscosity: 0.01})";
    for study in [
        format!("RandomTest({table}, tests: 9, seed: 7, method: Reduced(), compare: 2, worst: 2)"),
        "Sweep(over: [(vary: L, values: List([4.0, 6.0, 8.0])), (vary: M, values: Log(from: 10.0, to: 30.0, n: 3))], \
         methods: [Full, Reduced()])"
            .to_owned(),
        "Sweep(over: [(vary: M, values: Log(from: 10.0, to: 30.0, n: 4))], methods: [Full], cold: true)".to_owned(),
        "LoadCases(cases: Text(\"M,L\\n20,6\\nx,6\\n30,6\\n\"), methods: [Full, Reduced()])".to_owned(),
    ] {
        let text = format!("Scene(version: 1, title: \"t\", at: Moes(m: 20.0, l: 6.0), study: {study})");
        let scene = Scene::from_ron(&text).unwrap_or_else(|refused| panic!("{text}: {refused}"));
        let (one, parts, experiment) = (Rows::default(), Rows::default(), scene.experiment());
        scene.study.run(&experiment, &mut Workbench::new(""), &one).unwrap();
        let mut bench = Workbench::new("");
        for round in 0.. {
            let before: Vec<StudyRow> = parts.0.lock().unwrap().clone();
            let pieces = scene.study.pieces(&experiment, &mut bench, round, &before).unwrap();
            if pieces.is_empty() {
                break;
            }
            // Tests are numbered by their order; full solutions may arrive in any order.
            let whole = if round == 0 && study.starts_with("Random") { pieces } else { rotated(pieces) };
            for some in whole.chunks(2) {
                scene.study.work(&experiment, &mut bench, (round, some), &parts).unwrap();
            }
        }
        let (one, parts) = (one.bytes(), parts.bytes());
        assert!(one.len() > 2 && one == parts, "{study}: {} and {} rows", one.len(), parts.len());
    }
}

fn rotated(mut pieces: Vec<usize>) -> Vec<usize> {
    pieces.rotate_left(1);
    pieces
}

#[test]
fn other_studies_say_that_they_are_whole() {
    let scene = Scene::at_moes(20.0, 6.0);
    let refused = scene.study.pieces(&scene.experiment(), &mut Workbench::new(""), 0, &[]).unwrap_err();
    assert!(refused.to_string().contains("a campaign is a sweep"), "{refused}");
}

const RANDOM: &str = "study: RandomTest(range: (axes: {Radius: (2e-3, 4e-3, Linear), Speed: (1.0, 10.0, Linear), \
    Load: (1e5, 5e5, Linear), Alpha: (5e-9, 20e-9, Linear)}, \
    fixed: {Modulus: 231e9, Viscosity: 0.01}), tests: 7, seed: 7, method: Reduced(), compare: 3)";

const ADAPTIVE: &str = "study: Training(title: \"t\", range: (axes: {Radius: (3e-3, 4e-3, Linear), Speed: (2.0, 4.0, Linear), \
    Load: (2e5, 4e5, Linear), Alpha: (8e-9, 12e-9, Linear)}, \
    fixed: {Modulus: 231e9, Viscosity: 0.01}), plan: Adaptive(start: 5, \
    indicator: Correction, tolerances: [1e-7], successes: 16, local_sigma: 0.2, local_successes: 0, vicinity: 2, \
    limit: 8), windows: Given([(m: (1.0, 500.0), grid: Graded(nodes: 240, domain: (-6.0, 1.9), registered: true))]), \
    pressure_loss: 1e-6, deformation_loss: 1e-6, rows_per_mode: 2.0, evidence: 0, seed: 5)";

/// Folder that is deleted when the test ends.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("ehl-campaign-{name}-{}", std::process::id()));
        let _former = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// Plans a campaign of a scene, with this number of pieces per shard.
    fn planned(&self, study: &str, pieces: usize, folder: &str) -> Folder {
        let scene = format!("Scene(version: 1, title: \"t\", at: Moes(m: 20.0, l: 6.0), {study})");
        std::fs::write(self.0.join("a.ron"), scene).unwrap();
        std::fs::write(self.0.join("c.ron"), format!("(version: 1, scene: \"a.ron\", shard: Pieces({pieces}))"))
            .unwrap();
        plan(&self.0.join("c.ron"), &self.0.join(folder), &()).unwrap_or_else(|refused| panic!("{refused}"))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _gone = std::fs::remove_dir_all(&self.0);
    }
}

fn shard(folder: &Folder, number: usize) -> Result<Done, CampaignError> {
    compute(folder, number, 1, &(), &|| ())
}

/// Computes everything, the last shards first, and returns the files of the result.
fn through(mut folder: Folder) -> (Vec<(String, Vec<u8>)>, usize) {
    loop {
        for number in folder.status().open.into_iter().rev() {
            assert_eq!(shard(&folder, number).unwrap(), Done::Computed);
        }
        match merge(&folder, &()).unwrap() {
            Merged::Round(_) => folder = Folder::open(&folder.path).unwrap(),
            Merged::Result(_) => return (files(&folder.path.join(RESULT)), folder.rounds.len()),
        }
    }
}

fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let all = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let mut all: Vec<_> =
        all.map(|e| (e.file_name().into_string().unwrap(), std::fs::read(e.path()).unwrap())).collect();
    all.sort();
    all
}

#[test]
fn campaigns_give_the_bytes_of_one_run_for_any_division() {
    let scratch = Scratch::new("cut");
    let (one, rounds) = through(scratch.planned(RANDOM, 100, "one"));
    let (many, _) = through(scratch.planned(RANDOM, 2, "many"));
    assert_eq!(rounds, 2);
    assert!(one == many && one.len() == 2, "{:?}", one.iter().map(|(name, _)| name).collect::<Vec<_>>());
    let scene = Scene::read(&scratch.0.join("a.ron")).unwrap();
    let outcome = run_scene(&scene, &mut Workbench::new(""), &()).unwrap();
    let merged = String::from_utf8(one[0].1.clone()).unwrap();
    for value in outcome.found.values.iter().filter(|value| !["median_s", "p99_s"].contains(&value.name.as_str())) {
        assert!(merged.contains(&serde_json::json!(value.value).to_string()), "{}: {merged}", value.name);
    }
    assert!(!merged.contains("median_s") && merged.contains("\"wall_s\": null"), "{merged}");
}

#[test]
fn adaptive_training_in_rounds_equals_that_of_one_machine() {
    let scratch = Scratch::new("training");
    let (files, rounds) = through(scratch.planned(ADAPTIVE, 2, "dir"));
    let spec = Scene::read(&scratch.0.join("a.ron")).unwrap().training().unwrap();
    let model = train(&spec, &()).unwrap();
    let own = files.iter().find(|(name, _)| name == "a.rom").unwrap();
    assert!(rounds > 2, "{rounds} rounds");
    assert!(own.1 == model_file::to_bytes(&model).unwrap(), "{:?}", model.log);
}

#[test]
fn missing_damaged_or_foreign_results_are_not_merged() {
    let scratch = Scratch::new("refused");
    let folder = scratch.planned(RANDOM, 3, "dir");
    let other = scratch.planned(&RANDOM.replace("seed: 7", "seed: 8"), 3, "other");
    let refused = |part: &str| {
        let sentence = merge(&folder, &()).unwrap_err().to_string();
        assert!(sentence.contains(part) && !folder.result_path().exists(), "{sentence}");
    };
    assert_eq!(shard(&folder, 1).unwrap(), Done::Computed);
    assert_eq!(shard(&folder, 1).unwrap(), Done::There);
    refused("2 of 3 shards are missing, the first of them is shard 0");
    assert!(shard(&folder, 3).unwrap_err().to_string().contains("there is no shard 3; so far the campaign has 3"));
    shard(&folder, 0).unwrap();
    shard(&other, 2).unwrap();
    std::fs::copy(other.shard_path(2), folder.shard_path(2)).unwrap();
    refused("another scene or with another model");
    std::fs::copy(folder.shard_path(1), folder.shard_path(2)).unwrap();
    refused("another campaign or place");
    let whole = std::fs::read(folder.shard_path(1)).unwrap();
    std::fs::write(folder.shard_path(2), &whole[..whole.len() - 3]).unwrap();
    refused("cut off");
    std::fs::write(folder.shard_path(2), b"nonsense").unwrap();
    refused("another kind of file");
    // A shard that is computed again replaces the existing file.
    assert_eq!(shard(&folder, 2).unwrap(), Done::Computed);
    assert!(matches!(merge(&folder, &()).unwrap(), Merged::Round(_)));
    let leftovers = files(&folder.path.join(SHARDS)).into_iter().filter(|(name, _)| !name.ends_with(".shard")).count();
    assert_eq!(leftovers, 0);
}

#[test]
fn campaigns_that_make_no_sense_are_refused_in_a_sentence() {
    let scratch = Scratch::new("documents");
    let folder = scratch.planned(RANDOM, 3, "dir");
    let document = scratch.0.join("c.ron");
    for (text, part) in [
        ("(version: 1, scene: \"a.ron\", shards: Pieces(3))", "line 1, column"),
        ("(version: 2, scene: \"a.ron\")", "its version is 2"),
        ("(version: 1, scene: \"a.ron\", shard: Seconds(5.0))", "between 10 and 86400"),
        ("(version: 1, scene: \"a.ron\", shard: Seconds(NaN))", "between 10 and 86400"),
        ("(version: 1, scene: \"a.ron\", shard: Pieces(0))", "at least 1"),
        ("(version: 1, scene: \"none.ron\")", "none.ron"),
    ] {
        std::fs::write(&document, text).unwrap();
        let refused = plan(&document, &scratch.0.join("new"), &()).unwrap_err().to_string();
        assert!(refused.contains(part) && !scratch.0.join("new/campaign.ron").exists(), "{text}: {refused}");
    }
    let whole = Scratch::new("whole");
    std::fs::write(scratch.0.join("a.ron"), "Scene(version: 1, title: \"u\", study: Point(methods: [Full]))").unwrap();
    std::fs::write(&document, "(version: 1, scene: \"a.ron\")").unwrap();
    let refused = plan(&document, &whole.0, &()).unwrap_err().to_string();
    assert!(refused.contains("a campaign is a sweep"), "{refused}");
    let refused = plan(&document, &folder.path, &()).unwrap_err().to_string();
    assert!(refused.contains("already contains the campaign “t”"), "{refused}");
    std::fs::write(folder.path.join("scene.ron"), "Scene()").unwrap();
    let refused = Folder::open(&folder.path).unwrap_err().to_string();
    assert!(refused.contains("has changed since"), "{refused}");
    assert!(Folder::open(&scratch.0).unwrap_err().to_string().contains("holds no campaign"));
}
