//! Campaigns as schedulers run them: shards that are killed, run twice, or have no disk space.

use crate::commands::{assert_refused, json, program};
use crate::common::scratch::Scratch;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Cold full point contacts on a coarse grid, some hundredths of a second each.
const SCENE: &str = "Scene(version: 1, title: \"balls\", contact: Point, \
    grid: Plane(dx: 0.04, dy: 0.1, domain: (-3.0, 1.5, -1.5)), \
    study: RandomTest(range: (axes: {Radius: (10e-3, 12e-3, Linear), Speed: (1.0, 3.0, Linear), \
    Load: (20.0, 60.0, Linear), Alpha: (8e-9, 11e-9, Linear)}, \
    fixed: {Modulus: 231e9, Viscosity: 0.01}), tests: 60, seed: 3, method: Full), \
    expect: [(name: \"tests\", value: 60, within: Absolute(0), from: \"as many as are asked for\")])";

/// Five full solutions, then a round for each one that the search adds.
const ADAPTIVE: &str = "Scene(version: 1, title: \"adaptive\", study: Training(title: \"t\", \
    range: (axes: {Radius: (3e-3, 4e-3, Linear), Speed: (2.0, 4.0, Linear), \
    Load: (2e5, 4e5, Linear), Alpha: (8e-9, 12e-9, Linear)}, \
    fixed: {Modulus: 231e9, Viscosity: 0.01}), plan: Adaptive(start: 5, indicator: Correction, tolerances: [1e-7], successes: 16, \
    local_sigma: 0.2, local_successes: 0, vicinity: 2, limit: 8), windows: Given([(m: (1.0, 500.0), \
    grid: Graded(nodes: 240, domain: (-6.0, 1.9), registered: true))]), pressure_loss: 1e-6, deformation_loss: 1e-6, \
    rows_per_mode: 2.0, evidence: 0, seed: 5))";

fn planned(scratch: &Scratch, folder: &str, pieces: usize) -> PathBuf {
    planned_of(scratch, SCENE, folder, pieces)
}

fn planned_of(scratch: &Scratch, scene: &str, folder: &str, pieces: usize) -> PathBuf {
    scratch.write("scene.ron", scene);
    let document = format!("(version: 1, scene: \"scene.ron\", shard: Pieces({pieces}))");
    let document = scratch.write("campaign.txt", &document);
    let folder = scratch.join(folder);
    let output = program(&["campaign", "plan", text(&document), "--out", text(&folder)]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    folder
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Returns all files of a result with their bytes.
fn result(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let files = std::fs::read_dir(folder.join("result")).unwrap().map(|entry| entry.unwrap());
    files.map(|file| (file.file_name().into_string().unwrap(), std::fs::read(file.path()).unwrap())).collect()
}

fn shards(folder: &Path) -> usize {
    let files = std::fs::read_dir(folder.join("shards")).unwrap().map(|entry| entry.unwrap().path());
    files.filter(|path| path.extension().is_some_and(|extension| extension == "shard")).count()
}

/// The result of one process, shard after shard; computed once for all tests.
fn one_machine() -> &'static BTreeMap<String, Vec<u8>> {
    static RESULT: OnceLock<BTreeMap<String, Vec<u8>>> = OnceLock::new();
    RESULT.get_or_init(|| {
        let scratch = Scratch::new("one-machine");
        let folder = planned(&scratch, "one", 60);
        let output = program(&["campaign", "run", text(&folder), "--on", "local", "--workers", "1"]);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        result(&folder)
    })
}

#[cfg(target_os = "linux")]
#[test]
fn a_worker_that_is_killed_in_the_middle_changes_no_byte() {
    let scratch = Scratch::new("killed-worker");
    let folder = planned(&scratch, "many", 6);
    let mut run = Command::new(env!("CARGO_BIN_EXE_ehl-explorer"))
        .args(["campaign", "run", text(&folder), "--on", "local", "--workers", "2"])
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let children = format!("/proc/{0}/task/{0}/children", run.id());
    let (begun, mut killed) = (Instant::now(), 0);
    while run.try_wait().unwrap().is_none() {
        let worker = std::fs::read_to_string(&children).unwrap_or_default();
        // Wait until something is done, so that the kill comes in the middle.
        if let (Some(worker), true) = (worker.split_whitespace().next(), killed < 2 && shards(&folder) > killed) {
            Command::new("kill").args(["-KILL", worker]).status().unwrap();
            killed += 1;
        }
        assert!(begun.elapsed() < Duration::from_secs(300), "it does not end");
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(run.wait().unwrap().success() && killed > 0);
    assert!(result(&folder) == *one_machine(), "another result");
}

#[test]
fn two_processes_may_share_a_shard() {
    let scratch = Scratch::new("twice");
    let folder = planned(&scratch, "dir", 30);
    let shard = |k: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ehl-explorer"));
        command.args(["campaign", "shard", text(&folder), k]).stdout(Stdio::piped()).stderr(Stdio::piped());
        command.spawn().unwrap()
    };
    let both = [shard("0"), shard("0")].map(|child| child.wait_with_output().unwrap());
    for output in &both {
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    }
    assert_eq!(shards(&folder), 1);
    let open = program(&["campaign", "status", text(&folder), "--open"]);
    assert_eq!(String::from_utf8_lossy(&open.stdout), "1\n");
    let status = json(&program(&["campaign", "status", text(&folder), "--json"]));
    assert_eq!((&status["done"], &status["shards"], &status["merged"]), (&1.into(), &2.into(), &false.into()));
    assert_refused(&["campaign", "merge", text(&folder)], "1 of 2 shards are missing, the first of them is shard 1");
    assert_refused(&["campaign", "shard", text(&folder), "2"], "there is no shard 2");
    assert_refused(&["campaign", "status", text(&scratch)], "holds no campaign");
    assert!(!folder.join("result").exists());
    assert!(shard("1").wait().unwrap().success());
    assert_eq!(program(&["campaign", "merge", text(&folder)]).status.code(), Some(0));
    assert!(result(&folder) == *one_machine(), "another result");
    // Merged again it is the same again.
    assert_eq!(program(&["campaign", "merge", text(&folder)]).status.code(), Some(0));
    assert!(result(&folder) == *one_machine());
}

#[test]
fn a_campaign_of_another_build_is_refused_by_shard_and_merge() {
    let scratch = Scratch::new("build");
    let folder = planned(&scratch, "dir", 30);
    let plan = folder.join("campaign.ron");
    let own = std::fs::read_to_string(&plan).unwrap();
    let at = own.find("program_hash: \"").unwrap() + "program_hash: \"".len();
    let other = format!("{}0123456789abcdef{}", &own[..at], &own[at + 16..]);
    std::fs::write(&plan, other).unwrap();
    let words = "planned by another build of the program (version";
    assert_refused(&["campaign", "shard", text(&folder), "0"], words);
    assert_refused(&["campaign", "merge", text(&folder)], words);
    assert_eq!(program(&["campaign", "status", text(&folder)]).status.code(), Some(0), "whoever looks may look");
}

#[test]
fn model_of_another_version_is_refused_first() {
    let scratch = Scratch::new("version");
    let mut model = std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/line.rom")).unwrap();
    model[8] = 3;
    std::fs::write(scratch.join("former.rom"), model).unwrap();
    scratch.write(
        "scene.ron",
        "Scene(version: 1, title: \"lines\", study: RandomTest(range: (axes: {Radius: (2e-3, 4e-3, Linear), Speed: (1.0, 10.0, Linear), \
    Load: (1e5, 5e5, Linear), Alpha: (5e-9, 20e-9, Linear)}, \
    fixed: {Modulus: 231e9, Viscosity: 0.01}), tests: 4, seed: 3, \
         method: Reduced(model: File(\"former.rom\"))))",
    );
    let document = scratch.write("campaign.txt", "(version: 1, scene: \"scene.ron\", shard: Pieces(2))");
    let folder = scratch.join("dir");
    let arguments = ["campaign", "plan", text(&document), "--out", text(&folder)];
    assert_refused(&arguments, "former.rom cannot be used: the model file has version 3");
    assert!(!folder.exists());
}

/// Mounts a disk of a few pages, if this user may.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_sentence_and_what_was_there_stays() {
    let scratch = Scratch::new("full");
    let folder = planned(&scratch, "dir", 30);
    assert_eq!(program(&["campaign", "shard", text(&folder), "0"]).status.code(), Some(0));
    let script = "mount -t tmpfs -o size=64k none \"$2/shards\" && cp \"$3\" \"$2/shards/\" && \
                  head -c 1m /dev/zero > \"$2/shards/fill\"; \"$1\" campaign shard \"$2\" 1; code=$?; \
                  ls \"$2/shards\"; exit $code";
    let kept = scratch.join("kept.shard");
    std::fs::copy(folder.join("shards/000000.shard"), &kept).unwrap();
    let output = Command::new("unshare")
        .args(["-rm", "sh", "-c", script, "sh", env!("CARGO_BIN_EXE_ehl-explorer"), text(&folder), text(&kept)])
        .output();
    let Ok(output) = output else { return };
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    if said.contains("unshare") || said.contains("mount") {
        return;
    }
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("cannot write") && said.contains("000001.shard"), "{said}");
    let listed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(listed.contains("kept.shard") && !listed.contains("000001.shard") && !listed.contains(".part"), "{listed}");
}

/// Runs the script as a job of its array would be run, without Slurm.
#[cfg(unix)]
#[test]
fn the_script_for_slurm_takes_every_open_shard_once() {
    let scratch = Scratch::new("slurm");
    let folder = planned(&scratch, "dir", 20);
    let output = under_a_stand_in_for_slurm(&scratch, &folder, Path::new(env!("CARGO_BIN_EXE_ehl-explorer")));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert_eq!((shards(&folder), said.matches(": done").count()), (3, 3), "{said}");
    assert!(result(&folder) == *one_machine(), "another result");
}

/// A process of the first round and one of a round that the training added are killed and submitted again.
#[cfg(unix)]
#[test]
fn slurm_training_survives_killed_jobs() {
    let scratch = Scratch::new("slurm-training");
    let folder = planned_of(&scratch, ADAPTIVE, "dir", 2);
    let killed = "#!/bin/bash\nif [ \"$2\" = shard ] && [[ $4 = [14] ]] && mkdir \"$3/killed$4\" 2>/dev/null; then \
                  kill -KILL $$; fi\n";
    let program = scratch.write("killed.sh", &format!("{killed}exec {} \"$@\"\n", env!("CARGO_BIN_EXE_ehl-explorer")));
    Command::new("chmod").arg("+x").arg(&program).status().unwrap();
    let output = under_a_stand_in_for_slurm(&scratch, &folder, &program);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(["killed1", "killed4"].iter().all(|name| folder.join(name).is_dir()), "{said}");
    let one = planned_of(&scratch, ADAPTIVE, "one", 5);
    let alone = self::program(&["campaign", "run", text(&one), "--on", "local", "--workers", "1"]);
    assert_eq!(alone.status.code(), Some(0), "{}", String::from_utf8_lossy(&alone.stderr));
    assert!(shards(&folder) == shards(&one) + 2 && shards(&one) > 2, "{said}");
    assert!(result(&folder) == result(&one), "another result");
    let model = scratch.join("plain.rom");
    let trained = self::program(&["train", text(&scratch.join("scene.ron")), "--out", text(&model)]);
    assert_eq!(trained.status.code(), Some(0), "{}", String::from_utf8_lossy(&trained.stderr));
    assert!(result(&folder)["scene.rom"] == std::fs::read(&model).unwrap(), "another model");
}

#[cfg(unix)]
fn under_a_stand_in_for_slurm(scratch: &Scratch, folder: &Path, program: &Path) -> std::process::Output {
    // Jobs run at once instead of queuing: two tasks of an array, then the job that depends on it.
    let bin = scratch.join("bin");
    std::fs::create_dir(&bin).unwrap();
    let sbatch = "#!/bin/bash\narray=\nwhile [[ \"$1\" == --* ]]; do [[ \"$1\" == --array=* ]] && array=${1#--array=0-}; \
                  shift; done\nif [ -n \"$array\" ]; then for ((t = 0; t <= array; t++)); do \
                  SLURM_ARRAY_TASK_ID=$t bash \"$@\" >&2; done; echo 7; else bash \"$@\" >&2; fi\n";
    let stand_in = bin.join("sbatch");
    std::fs::write(&stand_in, sbatch).unwrap();
    Command::new("chmod").arg("+x").arg(&stand_in).status().unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    Command::new("bash")
        .arg(folder.join("slurm.sh"))
        .env("PATH", path)
        .env("EHL_TASKS", "2")
        .env("EHL_EXPLORER", program)
        .output()
        .unwrap()
}
