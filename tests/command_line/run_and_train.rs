//! Scenes on the command line: run and trained.

use crate::commands::{assert_refused, json, program};
use crate::common::cases::long;
use crate::common::scratch::Scratch;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

#[test]
fn run_returns_objects_and_exit_1_for_failed_checks() {
    let folder = Scratch::new("run");
    let scene = |name: &str, value: &str| {
        let text = format!(
            "Scene(version: 1, title: \"{name}\", at: Moes(m: 20, l: 5), grid: Graded, study: Point(methods: [Full]), \
             expect: [(name: \"moes.M\", value: {value}, within: Relative(1e-6), from: \"itself\")])"
        );
        let path = folder.join(format!("{name}.ron"));
        std::fs::write(&path, text).unwrap();
        path.to_string_lossy().into_owned()
    };
    let (good, bad) = (scene("good", "20"), scene("bad", "21"));
    let out = folder.join("out");
    let output = program(&["run", &good, "--json", "--out", &out.to_string_lossy()]);
    assert_eq!(output.status.code(), Some(0));
    let object = json(&output);
    assert_eq!(object["title"], "good");
    assert_eq!(object["expectations"][0]["verdict"], "ok");
    assert!(object["wall_s"].as_f64().unwrap() > 0.0);
    let profile = std::fs::read_to_string(out.join("good.profile_full.csv")).unwrap();
    assert!(profile.starts_with("X,Y,P,H,x_m,y_m,p_pa,h_m\n") && profile.lines().count() > 500);
    assert!(out.join("good.json").is_file());
    let output = program(&["run", &good, &bad, "--json"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(String::from_utf8(output.stdout).unwrap().lines().count(), 2);
}

/// A training of about a second on an idle core, by the automatic algorithm.
const SMALL_TRAINING: &str = "Scene(version: 1, title: \"small\", study: Training(
    title: \"small\",
    range: (axes: {Radius: (2e-3, 4e-3, Linear), Speed: (1.0, 10.0, Linear),
        Load: (1e5, 5e5, Linear), Alpha: (5e-9, 20e-9, Linear)},
        fixed: {Modulus: 231e9, Viscosity: 0.01}),
    plan: Adaptive(start: 20, indicator: Correction, tolerances: [1e-2, 1e-3], successes: 32, local_sigma: 0.1,
        local_successes: 8, vicinity: 4, limit: 32),
    windows: Given([(m: (5.0, 200.0), grid: Graded(nodes: 200, domain: (-6.0, 2.0), registered: true))]),
    pressure_loss: 1e-7, deformation_loss: 1e-6, rows_per_mode: 2.0, evidence: 120, seed: 1,
))";

/// The model that `train` makes of it, trained once for all tests.
fn trained_at_once() -> &'static [u8] {
    static MODEL: OnceLock<Vec<u8>> = OnceLock::new();
    MODEL.get_or_init(|| {
        let folder = Scratch::new("whole");
        let (scene, model) = (folder.write("small.ron", SMALL_TRAINING), folder.join("whole.rom"));
        let output = program(&["train", &scene.to_string_lossy(), "--out", &model.to_string_lossy()]);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        std::fs::read(model).unwrap()
    })
}

#[test]
fn a_training_that_is_killed_goes_on_and_gives_the_same_file() {
    use std::time::{Duration, Instant};
    let folder = Scratch::new("killed");
    let scene = folder.join("small.ron");
    std::fs::write(&scene, SMALL_TRAINING).unwrap();
    let whole = trained_at_once();
    let killed = folder.join("killed.rom");
    let kept = folder.join("killed.rom.training");
    let train = |out: &PathBuf| ["train".into(), scene.clone(), "--out".into(), out.clone()];
    let command = |out| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ehl-explorer"));
        command.args(train(out));
        command
    };
    let mut child = command(&killed).stderr(std::process::Stdio::null()).spawn().unwrap();
    let begin = Instant::now();
    while !kept.exists() {
        assert!(begin.elapsed() < Duration::from_secs(600), "nothing was kept");
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(kept.exists() && !killed.exists(), "killed in the middle");
    // Another training never overwrites a stored state.
    let other = folder.join("other.ron");
    std::fs::write(&other, SMALL_TRAINING.replace("seed: 1", "seed: 2")).unwrap();
    let before = std::fs::read(&kept).unwrap();
    let names = [&other, &killed].map(|path| path.to_string_lossy().into_owned());
    assert_refused(&["train", &names[0], "--out", &names[1]], "another training");
    assert_eq!(std::fs::read(&kept).unwrap(), before);
    let output = command(&killed).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("continuing") && said.contains("full solutions"), "{said}");
    assert!(std::fs::read(&killed).unwrap() == whole, "the files differ");
    assert!(!kept.exists(), "nothing is left beside a finished model");
}

#[test]
fn a_scene_that_trains_leaves_the_model_that_train_writes() {
    let folder = Scratch::new("left");
    let (scenes, out) = (folder.join("scenes"), folder.join("out"));
    std::fs::create_dir(&scenes).unwrap();
    let scene = scenes.join("small.ron");
    std::fs::write(&scene, SMALL_TRAINING).unwrap();
    let wanted = trained_at_once();
    let names = [&scene, &scenes, &out].map(|path| path.to_string_lossy().into_owned());
    let [scene, scenes, out] = names.each_ref().map(String::as_str);
    let left = Path::new(out).join("small.rom");
    for run in [&["run", scene, "--out", out][..], &["run", "--all", "--scenes", scenes, "--out", out]] {
        assert_eq!(program(run).status.code(), Some(0));
        assert!(std::fs::read(&left).unwrap() == wanted, "the files differ");
        std::fs::remove_file(&left).unwrap();
    }
}

/// The buffers of matrix products must not grow with the cache and the number of threads, up to a gigabyte on servers.
#[cfg(target_os = "linux")]
#[test]
fn scenes_run_in_two_gigabytes_of_address_space() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    // Room does not depend on how many contacts there are.
    let folder = Scratch::new("address-space");
    let fewer = |path: &str, at: &str, from: &str, to: &str| {
        let text = std::fs::read_to_string(scenes.join(path)).unwrap();
        assert!(text.contains(from), "{path} has no {from}");
        let to = if long() { from } else { to };
        folder.write(at, &text.replace(from, to).replace("../training/", ""))
    };
    fewer(
        "training/table_3_1_model.ron",
        "table_3_1_model.ron",
        "rows_per_mode: 2.0,",
        "rows_per_mode: 2.0, evidence: 120,",
    );
    let trajectory = fewer("reduced/fig_3_7_trajectory.ron", "trajectory.ron", "points: 201", "points: 21");
    for scene in [scenes.join("point/table_2_3.ron"), trajectory] {
        let script = "ulimit -v 2000000 && exec \"$0\" run \"$1\"";
        let mut limited = Command::new("sh");
        limited.args(["-c", script, env!("CARGO_BIN_EXE_ehl-explorer")]).arg(&scene);
        let output = limited.output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{}: {said}", scene.display());
    }
}
