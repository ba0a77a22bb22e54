//! A transient study with several frames, inputs, rules and trained loads: its results and refusals.

use ehl_explorer::engine::{SceneOutcome, Workbench, run_scene};
use ehl_explorer::scene::Scene;
use std::collections::BTreeSet;

/// Case 1 of Table 4.5 on a coarse grid.
fn scene(study: &str) -> Result<Scene, String> {
    let text = format!(
        "Scene(version: 1, title: \"study\", at: Si(radius: 0.01, speed: 2.5, load: 2e5, modulus: 231e9, viscosity: 0.01, alpha: 2e-8),
            grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)), study: Transient(time_step: Fixed(0.005), {study}))"
    );
    Scene::from_ron(&text).map_err(|error| error.to_string())
}

fn run(study: &str) -> SceneOutcome {
    let outcome = run_scene(&scene(study).unwrap(), &mut Workbench::new(""), &()).unwrap();
    assert!(outcome.found.converged, "{:?}", outcome.found.warnings);
    outcome
}

fn value(outcome: &SceneOutcome, name: &str) -> f64 {
    outcome.found.value(name, None).unwrap_or_else(|| panic!("no {name}"))
}

const SINE: &str = "inputs: (load: Harmonic(amplitude: 0.1, period: 0.5)), duration: 0.5";
const TRIANGLE: &str = "inputs: (load: TriangleToSquare(amplitude: 0.1, period: 0.5, s: 0.0)), duration: 0.5";

#[test]
fn inputs_and_rules_give_the_same_alone_and_among_others() {
    let frames = "frames: [Fixed, ArbitraryLagrangianEulerian], reduced: (loss: 1e-5)";
    let together = run(&format!(
        "{SINE}, {frames}, further: [(name: \"triangle\", {TRIANGLE})], linearised: (modes: 60, selection: Step(tolerance: 0.003),
            further: [Distance(tolerance: 0.05)], weightings: [DualTaylor, Dissertation]),
            published: [(name: \"triangle.ale.rnsa\", rows: 300)]"
    ));
    let alone = run(&format!(
        "{TRIANGLE}, {frames}, trainings: [({SINE})], linearised: (modes: 60, selection: Distance(tolerance: 0.05),
            weightings: [Dissertation, DualTaylor])"
    ));
    let pairs = [
        ("triangle.fixed.H_c.mean", "fixed.H_c.mean"),
        ("triangle.ale.H_c.difference", "ale.H_c.difference"),
        ("triangle.fixed.rnsa.H_c.difference_l2", "fixed.rnsa.H_c.difference_l2"),
        ("triangle.ale.rnsa.P_max.difference", "ale.rnsa.P_max.difference"),
        ("ale.rnsa.modes_share", "ale.rnsa.modes_share"),
        ("fixed.tpwl.distance_0.05.points", "fixed.tpwl.points"),
        ("triangle.fixed.tpwl.distance_0.05.dual_taylor.H_c.difference_l2", "fixed.tpwl.dual_taylor.H_c.difference_l2"),
        ("triangle.fixed.tpwl.distance_0.05.dissertation.reach_max", "fixed.tpwl.dissertation.reach_max"),
    ];
    for (among, own) in pairs {
        assert_eq!(value(&together, among), value(&alone, own), "{among}");
    }
    let own = value(&together, "fixed.tpwl.step_0.003.dual_taylor.H_c.difference_l2");
    assert!(own > 0.0 && own < 1e-3, "the training is reproduced: {own:e}");

    // Every march has a series and a row of costs.
    let names: BTreeSet<&str> = together.tables.iter().map(|table| table.name.as_str()).collect();
    assert_eq!(names.len(), together.tables.len(), "tables become files of their names");
    let marches = 2 * (2 + 2 + 2 * 2);
    assert_eq!(names.iter().filter(|name| name.starts_with("transient_")).count(), marches);
    let costs = together.tables.iter().find(|table| table.name == "costs").unwrap();
    assert_eq!(costs.labels.len(), marches);
    let row = &costs.rows[costs.labels.iter().position(|label| label == "triangle.ale.rnsa").unwrap()];
    assert_eq!(row[1], value(&together, "ale.rnsa.rows"));
    assert_eq!((row[6], row[8]), (value(&together, "triangle.ale.rnsa.H_c.difference_l2"), 300.0));
}

#[test]
fn models_are_trained_at_the_loads_asked_for() {
    let outcome = run(&format!(
        "{SINE}, training_loads: [180000.0, 220000.0], linearised: (modes: 60, selection: Distance(tolerance: 0.05), points: 30)"
    ));
    let points = outcome.tables.iter().find(|table| table.name == "operating_points_distance_30_points").unwrap();
    let loads: BTreeSet<u64> = points.rows.iter().map(|row| row[1] as u64).collect();
    assert_eq!(loads, BTreeSet::from([180_000, 220_000]));
    assert!((value(&outcome, "fixed.tpwl.points") - 30.0).abs() <= 2.0);
    assert!(value(&outcome, "fixed.training_s") > 0.0);
    let difference = value(&outcome, "fixed.tpwl.dual_taylor.H_c.difference_l2");
    assert!(difference > 0.0 && difference < 2e-2, "between two loads that are 10 % away: {difference:e}");
}

#[test]
fn what_makes_no_sense_is_refused_by_name() {
    let refusal = |more: &str| scene(&format!("{SINE}, {more}")).unwrap_err();
    let further = |name: &str, drive: &str| format!("(name: \"{name}\", {drive})");
    let list = |drives: &[String]| format!("further: [{}]", drives.join(", "));
    assert!(refusal(&format!("further: [({TRIANGLE})]")).contains("study.further.0.name"));
    assert!(refusal(&list(&[further("a/b", TRIANGLE)])).contains("letters, digits"));
    assert!(refusal(&list(&[further("a", TRIANGLE), further("a", SINE)])).contains("study.further.1.name"));
    let short = TRIANGLE.replace("duration: 0.5", "duration: 0.3");
    assert!(refusal(&format!("{}, window: (0.1, 0.4)", list(&[further("a", &short)]))).contains("study.window"));
    let endless = TRIANGLE.replace("duration: 0.5", "duration: inf");
    assert!(refusal(&list(&[further("a", &endless)])).contains("study.further.0.duration"));
    let deep = "inputs: (load: Harmonic(amplitude: 1.5, period: 0.5)), duration: 0.5";
    let trainings = format!("trainings: [({SINE}), ({deep})], training_loads: [2e5, 3e5], reduced: (loss: 1e-5)");
    assert!(refusal(&trainings).contains("study.trainings.1 at 200000 N/m"), "{}", refusal(&trainings));
    assert!(refusal("training_loads: [-2e5]").contains("study.training_loads"));
    let rules = "linearised: (modes: 60, selection: Step(tolerance: 0.003), further: [Step(tolerance: 0.003)])";
    assert!(refusal(rules).contains("step_0.003 twice"));
    let numbers =
        "linearised: (modes: 60, selection: Step(tolerance: 0.003), further: [Step(tolerance: 0.1)], points: 40)";
    assert!(refusal(numbers).contains("step_40_points twice"));
    assert!(refusal("published: [(name: \"triangle.fixed.full\", steps: 9)]").contains("study.published.0.name"));
    assert!(scene(&format!("{SINE}, published: [(name: \"fixed.full\", steps: 9)]")).is_ok());
}

const SCHEMES: &str = "Scene(
    version: 1, title: \"schemes\", source: \"test\", contact: Line, cavitation: Complementarity,
    at: Si(radius: 0.002, speed: 5.0, load: 200000.0, modulus: 231e9, viscosity: 0.01, alpha: 1e-8),
    grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)),
    study: SchemesInTime(
        trainings: [(inputs: (load: Harmonic(amplitude: 0.1, period: 0.5)), duration: 0.5)],
        tests: [(name: \"sine\", inputs: (load: Harmonic(amplitude: 0.1, period: 0.5)), duration: 0.5)],
        time_step: 0.005, loss: 1e-5,
        schemes: [
            (name: \"galerkin\", sampling: Cubature, rows_per_mode: 2.0),
            (name: \"gnat\", sampling: QDeim, rows_per_mode: 2.0, scheme: Gnat(weighted: true)),
            (name: \"penalty\", sampling: Cubature, rows_per_mode: 2.0, cavitation: Some(Penalty)),
        ],
    ),
)";

#[test]
fn schemes_in_time_are_held_against_the_full_march_of_their_law() {
    let run = |text: &str| run_scene(&Scene::from_ron(text).unwrap(), &mut Workbench::new("."), &());
    let outcome = run(SCHEMES).unwrap();
    let value = |name: &str| outcome.found.value(name, None).unwrap_or_else(|| panic!("{name} is missing"));
    for scheme in ["galerkin", "gnat", "penalty"] {
        assert_eq!(value(&format!("{scheme}.failures")), 0.0);
        assert!(value(&format!("{scheme}.sine.H_c.difference_l2")) < 1e-4, "{scheme}");
        assert!(value(&format!("{scheme}.sine.rows")) < 299.0 && value(&format!("{scheme}.sine.reached")) == 0.5);
    }
    assert!(outcome.tables.iter().any(|table| table.name == "schemes_sine" && table.rows.len() == 3));

    let refused = |from: &str, to: &str| {
        let text = SCHEMES.replace(from, to);
        let scene = Scene::from_ron(&text).map_err(|error| error.to_string());
        scene.and_then(|_| run(&text).map_err(|error| error.to_string())).err().unwrap()
    };
    assert!(refused("\"gnat\"", "\"galerkin\"").contains("study.schemes.name"));
    assert!(refused("Some(Penalty)", "Some(MassConserving())").contains("mass-conserving"));
    assert!(
        refused("sampling: QDeim, rows_per_mode: 2.0, scheme", "sampling: All, rows_per_mode: 2.0, scheme")
            .contains("is Gnat")
    );
}

#[test]
fn a_coarse_time_step_is_warned_of_and_a_controlled_one_is_not() {
    let swinging = "inputs: (load: Harmonic(amplitude: 0.15, period: 0.3)), duration: 1.2, reduced: (loss: 1e-5)";
    let with = |time_step: &str| {
        let text = scene(swinging).unwrap().to_ron().unwrap().replace("Fixed(0.005)", time_step);
        let read = Scene::from_ron(&text).unwrap();
        assert_eq!(Scene::from_ron(&read.to_ron().unwrap()).unwrap(), read);
        run_scene(&read, &mut Workbench::new(""), &()).unwrap()
    };
    let warned = |outcome: &SceneOutcome| {
        outcome.found.warnings.iter().any(|w| w.to_string().contains("time-step error of H_c"))
    };
    let coarse = with("Fixed(0.05)");
    let full = value(&coarse, "fixed.step_error");
    assert!(warned(&coarse) && full > 0.03, "{full:e}: {:?}", coarse.found.warnings);
    let reduced = value(&coarse, "fixed.rnsa.step_error");
    assert!((0.5 * full..2.0 * full).contains(&reduced), "steps cost about the same: {reduced:e} beside {full:e}");
    let controlled = with("Controlled(0.02)");
    assert!(!warned(&controlled), "{:?}", controlled.found.warnings);
    for march in ["fixed", "fixed.rnsa"] {
        let value = |name: &str| value(&controlled, &format!("{march}.{name}"));
        assert!(value("step_error") <= 0.02 && value("steps") > 40.0, "{march}");
    }
}
