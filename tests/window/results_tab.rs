//! Every study runs in the window as on the command line: the same contacts, bitwise equal numbers, and its verdicts.

use crate::common::scratch::Scratch;
use crate::driver::{
    Window, choose, click, export, export_plot, run_in_time, set, shows, wait_until, wait_within, window,
};
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use ehl_explorer::engine::{Workbench, run_scene};
use ehl_explorer::scene::Scene;
use std::path::Path;
use std::time::Duration;

const PATIENCE: Duration = Duration::from_secs(240);

const BOX: &str = "(axes: {Radius: (2e-3, 3e-3, Linear), Speed: (3.0, 5.0, Linear), Load: (1e5, 2e5, Linear), \
    Alpha: (6e-9, 10e-9, Linear)}, fixed: {Modulus: 231e9, Viscosity: 0.01})";
const POINT_BOX: &str = "(axes: {Radius: (10e-3, 11e-3, Linear), Speed: (2.0, 3.0, Linear), Load: (30.0, 45.0, Linear), \
    Alpha: (8e-9, 11e-9, Linear)}, fixed: {Modulus: 231e9, Viscosity: 0.01})";

/// Columns with seconds, or derived from them, which differ between runs.
const CLOCK: [&str; 7] = ["wall_s", "ms per step", "s", "times faster", "solve_s", "median_s", "online_mean_s"];

fn scene(title: &str, rest: &str, study: &str) -> String {
    format!("Scene(version: 1, title: \"{title}\", source: \"a test\", {rest} study: {study})")
}

fn training(plan: &str) -> String {
    format!(
        "Training(title: \"small\", range: {BOX}, plan: {plan}, windows: Given([(m: (1.0, 500.0), grid: \
         Uniform(dx: 0.04, domain: (-4.0, 2.0)))]), pressure_loss: 1e-6, deformation_loss: 1e-6, sampling: QDeim, \
         evidence: 0, rows_per_mode: 2.0, penalty: 1e6, seed: 3)"
    )
}

/// Opens a scene with a study in the window and runs it without the window. All tables agree, and the window shows the
/// results of its expectations.
fn agrees(folder: &Path, name: &str, text: &str, runs_by_itself: bool) {
    let path = folder.join(format!("{name}.ron"));
    std::fs::write(&path, text).unwrap();
    let headless = Scene::read(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
    let headless =
        run_scene(&headless, &mut Workbench::new(folder), &()).unwrap_or_else(|error| panic!("{name}: {error}"));
    let mut harness = window(Explorer::with_embedded_models(), [1280.0, 800.0]);
    harness.state_mut().open_scene(&path).unwrap();
    harness.run_steps(2);
    if !runs_by_itself {
        click(&mut harness, "Results");
        click(&mut harness, "Run the study");
    }
    assert_eq!(harness.state().front(), Some("Results"), "{name}");
    wait_within(PATIENCE, &mut harness, name, |app| app.verdict().is_some());
    assert_eq!(harness.state().verdict(), Some(headless.passed()), "{name}");
    assert!(shows(&harness, "Expectations") && shows(&harness, &headless.title), "{name}");
    for table in &headless.tables {
        let shown = harness.state().result_table(&table.name).unwrap_or_else(|| panic!("{name}: no {}", table.name));
        let same = timeless(&table.to_csv()) == timeless(&shown);
        assert!(same, "{name}, {}:\n{}\n{}", table.name, table.to_csv(), shown);
    }
}

/// Returns a table without measured times.
pub fn timeless(csv: &str) -> Vec<Vec<String>> {
    let mut lines = csv.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let of_clock =
        |title: &String| CLOCK.iter().any(|clock| title.split('.').next_back() == Some(clock) || title == clock);
    let kept: Vec<usize> = (0..header.len()).filter(|&k| !of_clock(&header[k])).collect();
    assert!(!kept.is_empty());
    lines.map(|line| kept.iter().filter_map(|&k| line.get(k).cloned()).collect()).collect()
}

#[test]
fn studies_of_contacts_give_the_same_on_the_screen_and_headless() {
    let folder = Scratch::new("results-contacts");
    let graded = "grid: Graded,";
    let uniform = "grid: Uniform(dx: 0.04, domain: (-4.0, 2.0)),";
    let studies = [
        ("sweep", "grid: Model,", "Sweep(over: [(vary: M, values: Log(from: 20, to: 60, n: 4))], methods: [Full, Reduced(model: Embedded)])".to_owned()),
        ("trajectory", "grid: Model,", format!("Trajectory(range: {BOX}, points: 3, methods: [Full, Reduced(model: Embedded)])")),
        ("random_test", "grid: Model,", "RandomTest(range: (axes: {M: (2.0, 300.0), L: (1.0, 20.0)}, limits: {HertzPressure: (0.0, 3.2e9)}), tests: 60, seed: 20, method: Reduced(model: Embedded), compare: 5)".to_owned()),
        ("error_split", "", "ErrorSplit(contacts: Here, method: Reduced(model: Embedded))".to_owned()),
        ("grid_study", uniform, "GridStudy(dx: [0.08, 0.04, 0.02])".to_owned()),
        ("dimensions", uniform, "Dimensions(over: [(vary: M, values: Log(from: 20, to: 60, n: 4))], losses: [1e-2, 1e-3])".to_owned()),
        ("error_measures", "", format!("ErrorMeasures(range: {BOX}, points: 4, seed: 31, model: Embedded)")),
        ("model_sizes", "grid: Model,", "ModelSizes(contacts: 4, seed: 5, modes: 3, rows_per_mode: [1.5])".to_owned()),
        ("distance_measure", graded, format!("DistanceMeasure(range: {BOX}, points: 8, seed: 5)")),
        ("formula_comparison", "lubricant: (viscosity: Barus, density: Incompressible), grid: Graded,", "FormulaComparison(formula: Moes, m: [20, 50], l: [5])".to_owned()),
        ("starvation", uniform, "Starvation(ratios: [0.3, 1.5])".to_owned()),
        ("amplitude", uniform, "Amplitude(wavelengths: [1.0, 0.5], derivatives: [Exact, Bdf2])".to_owned()),
        ("transition", uniform, "Transition(m: [20, 50], l: 5)".to_owned()),
        ("flow_curve", "lubricant: (shear: Eyring(critical_stress: 5e6)),", "FlowCurve(plateaus: [0.0, 0.2], stress: (1e4, 1e8))".to_owned()),
        ("measured_film", uniform, "MeasuredFilm(between: (-1e-4, 1e-4), films: [(name: \"other\", from: \"nobody\", points: [(-200, 300), (0, 200), (200, 300)])])".to_owned()),
    ];
    for (name, rest, study) in &studies {
        agrees(&folder, name, &scene(name, rest, study), true);
    }
    agrees(&folder, "point", &scene("point", graded, "Point(methods: [Full, Reduced(model: Embedded)])"), false);
}

#[test]
fn training_studies_agree_on_screen_and_headless() {
    let folder = Scratch::new("results-trainings");
    let farthest = training("FarthestPoint(snapshots: 14)");
    agrees(&folder, "training", &scene("training", "", &farthest), false);
    let plans = format!(
        "PlanComparison(plans: [(name: \"farthest\", training: \"training.ron\")], range: {BOX}, tests: 12, seed: 4, compare: 4, trajectory: 3)"
    );
    agrees(&folder, "plans", &scene("plans", "", &plans), true);
    let adaptive = "Adaptive(start: 8, tolerances: [100.0, 30.0], successes: 48, local_sigma: 0.1, local_successes: 8, \
        vicinity: 4, limit: 60)";
    std::fs::write(folder.join("ladder.ron"), scene("ladder", "", &training(adaptive))).unwrap();
    let ladder = format!("ToleranceStudy(training: \"ladder.ron\", range: {BOX}, points: 3, tests: 12, seed: 4)");
    agrees(&folder, "tolerances", &scene("tolerances", "", &ladder), true);
    let small = format!(
        "Training(title: \"small\", range: {POINT_BOX}, plan: FarthestPoint(snapshots: 8), windows: Given([(m: (1.0, \
         2000.0), grid: Plane(dx: 0.06, dy: 0.1, domain: (-2.7, 1.5, -1.5)))]), pressure_loss: 1e-3, deformation_loss: \
         1e-3, sampling: All, rows_per_mode: 3.0, penalty: 1e5, evidence: 0, seed: 2)"
    );
    std::fs::write(folder.join("ball.ron"), scene("ball", "contact: Point,", &small)).unwrap();
    let ways = format!(
        "SamplingComparison(training: \"ball.ron\", samplings: [(name: \"all\", sampling: All, rows_per_mode: 3.0, penalty: \
         1e5)], range: {POINT_BOX}, tests: 6, seed: 3, compare: 2)"
    );
    agrees(&folder, "samplings", &scene("samplings", "contact: Point,", &ways), true);
}

#[test]
fn a_contact_in_time_gives_the_same_on_the_screen_and_headless() {
    let folder = Scratch::new("results-time");
    let study = "Transient((inputs: (load: Harmonic(amplitude: 0.1, period: 0.5)), duration: 0.5, time_step: Fixed(0.01), \
        reduced: (loss: 1e-5)))";
    let study = study.replace("Transient((", "Transient(").replace("1e-5)))", "1e-5))");
    let rest = "grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)),";
    agrees(&folder, "transient", &scene("transient", rest, &study), false);
}

#[test]
fn a_contact_without_a_study_shows_what_it_amounts_to() {
    let folder = Scratch::new("results-contact");
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = window(explorer, [1280.0, 800.0]);
    click(&mut harness, "Results");
    let checked = |harness: &Window| shows(harness, "Full solution");
    wait_until(PATIENCE, &mut harness, "the check", checked);
    for text in
        ["Central film thickness H", "Maximum pressure P", "Full solution", "Deviation", "Dowson–Higginson", "N/mm"]
    {
        assert!(shows(&harness, text), "{text}");
    }
    set(&mut harness, Role::Slider, "Load number M", 90.0);
    assert!(!shows(&harness, "Full solution"), "a former one is not beside it");
    wait_until(PATIENCE, &mut harness, "the check", checked);
    let table = export(&mut harness, "Results", "Table as CSV…", &folder.join("contact.csv"));
    let line = table.lines().find(|line| line.starts_with("H_c,")).unwrap().to_owned();
    let [reduced, full] = [1, 2].map(|k| line.split(',').nth(k).unwrap().parse::<f64>().unwrap());
    assert_eq!(Some(reduced), harness.state().central_film());
    assert!((reduced / full - 1.0).abs() < 2e-3 && reduced != full, "{line}");
}

#[test]
fn a_study_can_be_stopped_and_what_it_found_stays() {
    let folder = Scratch::new("results-stopped");
    let study = "RandomTest(range: (axes: {M: (2.0, 300.0), L: (1.0, 20.0)}, limits: {HertzPressure: (0.0, 3.2e9)}), tests: 100000, \
        seed: 1, method: Reduced(model: Embedded))";
    let path = folder.join("long.ron");
    std::fs::write(&path, scene("long", "", study)).unwrap();
    let mut harness = window(Explorer::with_embedded_models(), [1280.0, 800.0]);
    harness.state_mut().open_scene(&path).unwrap();
    wait_within(PATIENCE, &mut harness, "first rows", |app| app.result_table("random").is_some());
    click(&mut harness, "Stop");
    wait_within(PATIENCE, &mut harness, "the end", |app| !app.running_study());
    assert_eq!(harness.state().verdict(), None, "what was stopped has no verdict");
    let rows = harness.state().result_table("random").unwrap().lines().count();
    assert!(rows > 1 && rows < 100_000, "{rows}");
    assert!(shows(&harness, "Not complete yet"));
}

const HARMONIC: &str = "inputs: (load: Harmonic(amplitude: 0.1, period: 0.5)), duration: 0.5, time_step: Fixed(0.01)";

/// Returns a transient scene with expectations about central film thickness, mass balance and mean load.
fn expecting(more: &str, expect: &str) -> String {
    let study = format!("Transient({HARMONIC}{more})");
    let rest = format!("grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)), expect: [{expect}],");
    scene("harmonic load", &rest, &study)
}

const HOLDS: &str = "(name: \"fixed.H_c.amplitude\", within: Between(1e-6, 1.0), from: \"a test\")";
const SHORT: &str = "(name: \"fixed.H_c.start\", value: 7.0, within: Relative(0.01), from: \"a test\")";
const BALANCE: &str = "(name: \"fixed.mass_defect\", within: AtMost(0.1), from: \"a test\")";

#[test]
fn results_have_the_verdicts_of_transient_runs() {
    let folder = Scratch::new("results-of-runs");
    for (name, text, verdict, said) in [
        ("holds", expecting("", HOLDS), Some(true), "All 1 hold"),
        ("short", expecting("", &format!("{HOLDS}, {SHORT}")), Some(false), "1 of 2 hold"),
    ] {
        let path = folder.write(&format!("{name}.ron"), &text);
        let mut harness = window(Explorer::with_embedded_models(), [1280.0, 800.0]);
        harness.state_mut().open_scene(&path).unwrap();
        run_in_time(&mut harness);
        assert_eq!(harness.state().front(), Some("Transient"));
        click(&mut harness, "Results");
        wait_within(PATIENCE, &mut harness, name, |app| app.verdict().is_some());
        assert_eq!(harness.state().verdict(), verdict, "{name}");
        assert!(shows(&harness, said) && shows(&harness, "Transient runs"), "{name}: {said}");
        assert!(!harness.state().running_study());
        // The numbers are those of a run without the window.
        let headless = Scene::read(&path).unwrap();
        let headless = run_scene(&headless, &mut Workbench::new(&*folder), &()).unwrap();
        let table = headless.tables.first().unwrap();
        let shown = harness.state().result_table(&table.name).unwrap();
        assert_eq!(timeless(&table.to_csv()), timeless(&shown), "{name}");
        // Another load: these verdicts are grey, and a run started by hand brings new ones.
        let grey =
            |harness: &Window| harness.state().drawn().any(|(name, _, grey)| name == "results of a study" && grey);
        assert!(!grey(&harness));
        set(&mut harness, Role::Slider, "Load number M", 60.0);
        harness.run_steps(3);
        assert!(grey(&harness) && shows(&harness, "previous state of the scene"));
        click(&mut harness, "Run");
        click(&mut harness, "Run transient");
        crate::driver::rest_in_time(&mut harness);
        click(&mut harness, "Results");
        wait_within(PATIENCE, &mut harness, name, |app| app.verdict().is_some());
        assert!(!grey(&harness), "{name}");
        assert_ne!(harness.state().result_table(&table.name), Some(shown), "{name}");
    }
}

#[test]
fn values_that_runs_leave_out_stay_open() {
    let folder = Scratch::new("results-left-out");
    let path = folder.write("balance.ron", &expecting(", mass_between: (-1.0, 1.0)", &format!("{HOLDS}, {BALANCE}")));
    let mut harness = window(Explorer::with_embedded_models(), [1280.0, 800.0]);
    harness.state_mut().open_scene(&path).unwrap();
    run_in_time(&mut harness);
    click(&mut harness, "Results");
    let done = |harness: &Window| shows(harness, "1 of 2 hold. Run the study computes 1 more");
    wait_until(PATIENCE, &mut harness, "the evaluation", done);
    assert_eq!(harness.state().verdict(), None);
    assert!(shows(&harness, "open") && !shows(&harness, "short"));
    click(&mut harness, "Run the study");
    wait_within(PATIENCE, &mut harness, "the study", |app| app.verdict().is_some());
    assert_eq!(harness.state().verdict(), Some(true));
    assert!(shows(&harness, "All 2 hold") && !shows(&harness, "Transient runs"));
    // The study stays when another tab has been in front.
    click(&mut harness, "Transient");
    crate::driver::rest_in_time(&mut harness);
    click(&mut harness, "Results");
    harness.run_steps(3);
    assert!(shows(&harness, "All 2 hold"));
}

/// Selects an option of a list that may be scrolled out of sight.
fn pick(harness: &mut Window, list: &str, option: &str) {
    harness.get_by_role_and_label(Role::ComboBox, list).click();
    harness.run_steps(3);
    harness.get_by_label(option).click_accesskit();
    harness.run_steps(3);
    // Only a click of the pointer closes the list.
    crate::driver::press(harness, egui::Modifiers::NONE, egui::Key::Escape);
}

/// A sweep over the speed with a measured table in its scene.
#[test]
fn measured_points_are_drawn_over_a_sweep() {
    let folder = Scratch::new("results-measured");
    let study = "Sweep(over: [(vary: Speed, values: Log(from: 1, to: 3, n: 4))], methods: [Reduced(model: Embedded)])";
    let view = "view: (measured: [\"speed [m/s],film [nm]\\n1.5,300\\n2.5,420\\n\"]),";
    let si = "Si(radius: 0.012, speed: 2.0, load: 2e5, modulus: 231e9, viscosity: 0.02, alpha: 2e-8)";
    let text = scene("speeds", view, study).replace("source: \"a test\",", &format!("source: \"a test\", at: {si},"));
    let path = folder.write("speeds.ron", &text);
    let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), [1280.0, 800.0]);
    harness.state_mut().open_scene(&path).unwrap();
    wait_within(PATIENCE, &mut harness, "the sweep", |app| app.verdict().is_some());
    let diamonds = |harness: &Window| harness.query_all_by_label("measured").count();
    assert_eq!(diamonds(&harness), 1, "in the key of the chart of H_c");
    let svg = export_plot(&mut harness, "Results", "Central film thickness H_c", &folder.join("h_c.svg"));
    assert!(svg.contains(">measured<"), "{svg}");
    choose(&mut harness, "Shown of the results", "Table sweep");
    pick(&mut harness, "Plotted column", "reduced h_c [µm]");
    assert_eq!(diamonds(&harness), 1);
    pick(&mut harness, "Horizontal axis", "Line");
    assert_eq!(diamonds(&harness), 0, "lines have no measured values");
    pick(&mut harness, "Horizontal axis", "u_m [m/s]");
    assert_eq!(diamonds(&harness), 1);
}
