//! Transient reduced models on the command line: trained, shown, used by scenes, and distinguished from steady ones.

use crate::commands::{assert_refused, json, program};
use crate::common::scratch::Scratch;
use std::path::Path;

/// Oscillating load on a coarse grid.
fn scene(study: &str) -> String {
    format!(
        "Scene(version: 1, title: \"A load that breathes\", at: Si(radius: 0.002, speed: 5.0, load: 2e5, modulus: 2.31e11,
            viscosity: 0.01, alpha: 1e-8), grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)), study: Transient(
            inputs: (load: Harmonic(amplitude: 0.1, period: 0.5)), duration: 0.5, time_step: Fixed(0.01), {study}))"
    )
}

fn word(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn a_model_in_time_is_trained_saved_shown_and_used_by_a_scene() {
    let folder = Scratch::new("in-time");
    let (trains, model) = (folder.write("trains.ron", &scene("reduced: (loss: 1e-5)")), folder.join("breathes.rom"));
    let output = program(&["train", word(&trains), "--out", word(&model)]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let trained = String::from_utf8(output.stdout).unwrap();
    for words in [
        "A load that breathes",
        "transient line contacts, frame Fixed",
        "load 0.9",
        "speed constant",
        "50 steps",
        "one course of inputs",
    ] {
        assert!(trained.contains(words), "{words}: {trained}");
    }
    let arrays = folder.join("arrays.npz");
    let shown = program(&["info", word(&model), "--arrays", word(&arrays)]);
    assert_eq!(String::from_utf8(shown.stdout).unwrap(), trained);
    assert!(std::fs::metadata(&arrays).unwrap().len() > 10_000);

    // The same training gives the same file. A scene with this file gives the same march as one that trains the model.
    let again = folder.join("again.rom");
    program(&["train", word(&trains), "--out", word(&again)]);
    assert!(std::fs::read(&again).unwrap() == std::fs::read(&model).unwrap());
    let uses = folder.write("uses.ron", &scene("reduced: (model: File(\"breathes.rom\"))"));
    let values = |scene: &Path| json(&program(&["run", word(scene), "--json"]))["values"].clone();
    let of = |values: &serde_json::Value, name: &str| {
        let all = values.as_array().unwrap();
        let found = all.iter().find(|value| value["name"] == name).unwrap_or_else(|| panic!("no {name}"));
        found["value"].as_f64().unwrap()
    };
    let (own, saved) = (values(&trains), values(&uses));
    for name in ["fixed.rnsa.rows", "fixed.rnsa.modes"] {
        assert_eq!(of(&own, name), of(&saved, name), "{name}");
    }
    // Modes are stored with a limited number of digits.
    for name in ["fixed.rnsa.H_c.difference_l2", "fixed.rnsa.H_min.difference"] {
        assert!((of(&own, name) - of(&saved, name)).abs() < 1e-7, "{name}");
    }
    assert_eq!((of(&own, "fixed.rnsa.trained"), of(&saved, "fixed.rnsa.trained")), (1.0, 1.0));
    assert!(of(&saved, "fixed.rnsa.H_c.difference_l2") < 1e-4);

    // Trained by another scene in the same run.
    let trained = folder.write("trained.ron", &scene("reduced: (model: Trained(\"trains.ron\"))"));
    assert_eq!(of(&values(&trained), "fixed.rnsa.H_c.difference_l2"), of(&own, "fixed.rnsa.H_c.difference_l2"));

    // Inputs outside the trained range cause a warning.
    let fast = scene("reduced: (model: File(\"breathes.rom\"))").replace("period: 0.5", "period: 0.2");
    let fast = json(&program(&["run", word(&folder.write("fast.ron", &fast)), "--json"]));
    let warning = fast["warning"].as_str().unwrap();
    assert!(
        warning.contains("fixed.rnsa: the load changes by") && warning.contains("faster than the trained"),
        "{warning}"
    );
    assert_eq!(of(&fast["values"], "fixed.rnsa.trained"), 0.0);
    let heavy = scene("reduced: (model: File(\"breathes.rom\"))").replace("load: 2e5", "load: 2.4e5");
    let heavy = json(&program(&["run", word(&folder.write("heavy.ron", &heavy)), "--json"]));
    assert!(heavy["warning"].as_str().unwrap().contains("M = "), "{heavy}");

    // A model of the wrong kind is refused with both kinds named.
    let solve = ["solve", "--moes-m", "40", "--moes-l", "10", "--method", "reduced", "--rom", word(&model)];
    assert_refused(&solve, "is a transient reduced model");
    let stationary = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/line.rom");
    let wrong = scene(&format!("reduced: (model: File(\"{stationary}\"))"));
    assert_refused(&["run", word(&folder.write("wrong.ron", &wrong))], "of steady contacts");
    let moving = scene("frames: [ArbitraryLagrangianEulerian], reduced: (model: File(\"breathes.rom\"))");
    assert_refused(&["run", word(&folder.write("moving.ron", &moving))], "frames: [Fixed]");
    let unit = folder.join("a.fmu");
    let fmu = ["export", "fmu", word(&model), "--approach", "--out", word(&unit)];
    assert_refused(&[&fmu[..], &["--library", word(&model)]].concat(), "the input of a transient model is its load");
    assert_refused(&["train", word(&uses), "--out", word(&again)], "describes no training");
}

#[test]
fn models_in_time_that_make_no_sense_are_refused_by_name() {
    let folder = Scratch::new("in-time-refused");
    let refused = |study: &str, words: &str| {
        let path = folder.write("scene.ron", &scene(study));
        assert_refused(&["run", word(&path)], words);
    };
    refused("reduced: (model: Embedded), frames: [ArbitraryLagrangianEulerian]", "another frame");
    refused("reduced: (model: File(\"x.rom\"), loss: 1e-4)", "study.reduced.model");
    refused("reduced: (model: File(\"missing.rom\"))", "missing.rom");
    refused("reduced: (loss: 2.0)", "study.reduced.loss");
    let none = folder.write("none.ron", &scene("frames: [Fixed]"));
    assert_refused(&["train", word(&none), "--out", "x.rom"], "describes no training");
    let trains = folder.write("trains.ron", &scene("reduced: ()"));
    assert_refused(&["train", word(&trains), "--out", "/no/such/folder/x.rom"], "--out must name a file");
}

#[test]
fn transient_scenes_and_sweeps_are_written_as_animations() {
    let folder = Scratch::new("animation");
    let sweep =
        "Scene(version: 1, title: \"sweep\", at: Moes(m: 40.0, l: 10.0), grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)),
        study: Sweep(over: [(vary: M, values: Linear(from: 20.0, to: 40.0, n: 3))], methods: [Full]))";
    let film = folder.join("film.png");
    for (name, text, frames) in [("march", scene(""), 51), ("sweep", sweep.to_owned(), 3)] {
        let output = program(&["run", word(&folder.write("scene.ron", &text)), "--animate", word(&film)]);
        assert_eq!(output.status.code(), Some(0), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        let file = std::io::Cursor::new(std::fs::read(&film).unwrap());
        let reader = png::Decoder::new(file).read_info().unwrap();
        let control = reader.info().animation_control().unwrap();
        assert_eq!((reader.info().width, reader.info().height, control.num_frames), (960, 540, frames), "{name}");
    }
    let point = "Scene(version: 1, title: \"point\", study: Point(methods: [Full]))";
    let point = folder.write("point.ron", point);
    assert_refused(
        &["run", word(&point), "--animate", word(&film)],
        "--animate needs a scene with the study Transient",
    );
    assert_refused(&["run", word(&point), word(&point), "--animate", word(&film)], "--animate takes one scene, not 2");
}
