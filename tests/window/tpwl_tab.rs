//! Linearised models without a display: trained and run together with the full system, inspected, tried with other
//! numbers of points, exported, stopped and saved. Any plot as a picture.

use crate::common::processor_time::of_this_thread;
use crate::common::scratch::Scratch;
use crate::driver::{
    Table, Window, click, export, export_plot, give_path, press, rest_in_time, run_in_time, set, shows, time, undo,
    wait, wait_until, wait_within,
};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use ehl_explorer::engine::{Workbench, run_scene};
use ehl_explorer::scene::{LinearisedTransient, Scene, Study};
use ehl_explorer::solver::reduced::tpwl::Selection;
use std::path::Path;
use std::time::{Duration, Instant};

/// Case 1 of Table 4.5 on a coarse grid, its load over one period.
fn scene(load: &str, linearised: &str) -> String {
    format!(
        "Scene(version: 1, title: \"linearised\", at: Si(radius: 0.01, speed: 2.5, load: 2e5, modulus: 231e9, viscosity: 0.01, alpha: 2e-8),
            grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)),
            study: Transient(inputs: (load: {load}), duration: 0.5, time_step: Fixed(0.005), {linearised}))"
    )
}

const SINE: &str = "Harmonic(amplitude: 0.1, period: 0.5)";
const BOTH: &str = "linearised: (modes: 90, selection: Step(tolerance: 1e-3), weightings: [DualTaylor, Dissertation])";

fn open(name: &str, text: &str, size: [f32; 2]) -> (Window, Scratch) {
    let folder = Scratch::new(name);
    let path = folder.write("scene.ron", text);
    let mut explorer = Explorer::new(None).without_system_dialogs();
    explorer.open_scene(&path).unwrap();
    let mut harness = crate::driver::window(explorer, size);
    wait(&mut harness, "the first picture", |app| app.central_film().is_some() && !app.busy());
    click(&mut harness, "TPWL");
    (harness, folder)
}

#[test]
fn a_linearised_model_is_run_looked_into_and_exported() {
    let (mut harness, folder) = open("look", &scene(SINE, BOTH), [1280.0, 900.0]);
    run_in_time(&mut harness);
    assert_eq!(harness.state().transient_moments(), 3 * 101, "full, dual Taylor, dissertation");
    let points = harness.state().operating_points().unwrap();
    assert!((10..=101).contains(&points), "{points} points");
    for plot in [
        "Operating points along the trajectory",
        "Operating points in the plane",
        "Weights of the operating points",
        "Deviation between runs",
        "no steeper than trained, and their amplitudes no larger",
    ] {
        assert!(shows(&harness, plot), "{plot}");
    }
    wait_until(Duration::from_secs(900), &mut harness, "the first numbers of points", |harness| {
        shows(harness, "Error against the number of operating points")
    });
    click(&mut harness, "Other rule");
    assert!(shows(&harness, "Points of the other rule"));
    assert!(shows(&harness, &format!("Missed step, in use: {points} points")));
    assert!(shows(&harness, "Distance, the other rule"));
    assert!(!shows(&harness, "too steep"), "it follows its own training");
    click(&mut harness, "Table");

    // In the middle of the run: weights of both kinds add up to one, and the nearest point has the largest.
    set(&mut harness, Role::Slider, "Time T", 0.2);
    let table = Table::of(&export(&mut harness, "TPWL", "Points as CSV…", &folder.join("points.csv")));
    assert_eq!(table.rows.len(), points);
    for name in ["weight_dual_taylor", "weight_dissertation"] {
        let sum: f64 = table.column(name).iter().sum();
        assert!((sum - 1.0).abs() < 1e-9, "{name}: {sum}");
    }
    let (times, distances) = (table.column("T"), table.column("distance"));
    let nearest = (0..points).min_by(|&a, &b| distances[a].total_cmp(&distances[b])).unwrap();
    assert!((times[nearest] - 0.2).abs() < 0.05, "T {} at T 0.2", times[nearest]);
    assert!(table.column("weight_dissertation")[nearest] > 0.3);
    // H_c of a point is that of the training at its time: all are in the range of the oscillating film thickness.
    assert!(table.column("H_c").iter().all(|h| (0.08..0.12).contains(h)));

    let weights = Table::of(&export(&mut harness, "TPWL", "Weights as CSV…", &folder.join("weights.csv")));
    let at = |weighting: f64, time: f64| -> f64 {
        let (kinds, instants, shares) = (weights.column("weighting"), weights.column("T"), weights.column("weight"));
        (0..shares.len())
            .filter(|&k| kinds[k] == weighting && (instants[k] - time).abs() < 1e-9)
            .map(|k| shares[k])
            .sum()
    };
    for time in [0.0, 0.2, 0.5] {
        assert!((at(1.0, time) - 1.0).abs() < 1e-9 && (at(2.0, time) - 1.0).abs() < 1e-9);
    }

    // A row selects its time; the table can be sorted in both directions.
    click(&mut harness, "Sort by T");
    click(&mut harness, "Go to operating point 3");
    assert!((time(&harness) - times[2]).abs() < 1e-12);
    click(&mut harness, "Why");
    assert!(shows(&harness, "replaced by their tangents"));
}

/// Returns the slowdown of work due to other load on the processor.
fn business() -> f64 {
    let (begin, own) = (Instant::now(), of_this_thread());
    while of_this_thread() - own < Duration::from_millis(100) {
        std::hint::black_box((0..10_000).map(f64::from).sum::<f64>());
    }
    begin.elapsed().as_secs_f64() / (of_this_thread() - own).as_secs_f64()
}

#[test]
fn new_window_shows_operating_points_quickly() {
    let explorer = Explorer::new(None).without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, 800.0]);
    wait(&mut harness, "the first picture", |app| app.central_film().is_some() && !app.busy());
    let busy = business();
    let begin = Instant::now();
    click(&mut harness, "TPWL");
    wait(&mut harness, "operating points", |app| app.operating_points().is_some());
    let taken = begin.elapsed().as_secs_f64();
    let busy = busy.max(business());
    println!("operating points after {taken:.2} s on a machine that is {busy:.1} times as slow as alone");
    let slower = if cfg!(debug_assertions) { 60.0 } else { 1.0 };
    assert!(taken < 2.0 * busy * slower, "{taken} s");
    wait(&mut harness, "all methods", |app| !app.marching() && app.in_time() == (true, 3, 0));
    wait(&mut harness, "the study of numbers", |app| app.studying_points());
    // Fewer points by the slider at the top.
    let before = harness.state().operating_points().unwrap();
    set(&mut harness, Role::Slider, "Number of operating points", 12.0);
    rest_in_time(&mut harness);
    let after = harness.state().operating_points().unwrap();
    assert!(after < before && after <= 16, "{before} {after}");
}

#[test]
fn more_points_err_less_and_the_study_can_be_stopped() {
    // The film thickness responds in the second period, where the weightings differ.
    let twice = scene(SINE, BOTH).replace("duration: 0.5", "duration: 1.0");
    let (mut harness, folder) = open("number", &twice, [1280.0, 900.0]);
    run_in_time(&mut harness);
    wait(&mut harness, "the study, which begins by itself", |app| app.studying_points());
    wait_within(Duration::from_secs(900), &mut harness, "the study", |app| !app.studying_points());
    let text = export(&mut harness, "TPWL", "Numbers as CSV…", &folder.join("numbers.csv"));
    let table = Table::of(&text);
    let (rules, kinds) = (table.column("rule"), table.column("weighting"));
    let (points, errors) = (table.column("points"), table.column("H_c_difference_l2"));
    for rule in [1.0, 2.0] {
        let of = |kind: f64| -> Vec<(f64, f64)> {
            let own = (0..points.len()).filter(|&k| rules[k] == rule && kinds[k] == kind);
            own.map(|k| (points[k], errors[k])).collect()
        };
        let (dual, dissertation) = (of(1.0), of(2.0));
        assert!(dual.len() >= 3 && dual.len() == dissertation.len(), "rule {rule}: {dual:?}");
        assert!(dual.windows(2).all(|pair| pair[0].0 < pair[1].0), "ever more points");
        let (first, last) = (dual[0].1, dual[dual.len() - 1].1);
        assert!(last < 0.1 * first && last < 1e-3, "rule {rule}: {first:e} with few points, {last:e} with many");
        // The dual Taylor form needs fewer points for the same error.
        let better = dual.iter().zip(&dissertation).filter(|(a, b)| a.1 < b.1).count();
        assert!(2 * better > dual.len(), "{dual:?} {dissertation:?}");
    }
    assert!(shows(&harness, "Error against the number of operating points"));
    for _ in 0..2 {
        click(&mut harness, "Error vs. number of points");
        click(&mut harness, "Stop the study");
        wait(&mut harness, "the end of the study", |app| !app.studying_points());
    }
}

#[test]
fn steep_inputs_warn_and_reversals_are_refused() {
    // Trained on a gentle sine, run with a steep wave of three times its amplitude.
    let other = "trainings: [(inputs: (load: Harmonic(amplitude: 0.1, period: 0.5)), duration: 0.5)],
        linearised: (modes: 90, selection: Step(tolerance: 1e-3))";
    let steep = "TriangleToSquare(amplitude: 0.3, period: 0.2, s: 0.9)";
    let (mut harness, _folder) = open("steep", &scene(steep, other), [1024.0, 640.0]);
    run_in_time(&mut harness);
    assert!(shows(&harness, "The inputs are too steep for linearised models"));
    // The reduced model was not run: no advice to use it.
    assert!(shows(&harness, "× steeper than trained: train on inputs like these, or tick Reduced model"));
    assert!(!shows(&harness, "use the reduced model"));
    assert_eq!(harness.state().transient_moments(), 2 * 101);

    let turning = scene(SINE, BOTH).replace("inputs: (", "inputs: (speed: Harmonic(amplitude: 1.5, period: 0.5), ");
    let (mut harness, _folder) = open("turning", &turning, [1024.0, 640.0]);
    run_in_time(&mut harness);
    assert!(shows(&harness, "needs one that stays above zero"));
    assert_eq!(harness.state().transient_moments(), 101, "the full run stays");
}

#[test]
fn the_model_is_set_up_undone_refused_and_saved_with_the_scene() {
    let (mut harness, folder) = open("document", &scene(SINE, ""), [1280.0, 900.0]);
    click(&mut harness, "Linearise this run");
    click(&mut harness, "Model set-up");
    let value = |harness: &Window, name: &str| harness.get_by_role_and_label(Role::SpinButton, name).value().unwrap();
    assert_eq!(value(&harness, "Modes"), "100");
    set(&mut harness, Role::SpinButton, "Tolerance β", -1.0);
    assert!(shows(&harness, "study.linearised.selection.tolerance"));
    assert_eq!(value(&harness, "Tolerance β"), "0.001");
    let tick = |harness: &mut Window, name: &str| {
        harness.get_by_role_and_label(Role::CheckBox, name).click();
        harness.run_steps(3);
    };
    tick(&mut harness, "Dual Taylor");
    assert!(shows(&harness, "At least one kind of weights is needed"));
    tick(&mut harness, "Exponential weights");
    set(&mut harness, Role::SpinButton, "Modes", 80.0);
    undo(&mut harness);
    assert_eq!(value(&harness, "Modes"), "100");
    click(&mut harness, "Train on these inputs");
    assert!(shows(&harness, "Trained on other inputs"));
    // A linearised model needs the fixed frame.
    click(&mut harness, "Transient");
    click(&mut harness, "Set-up");
    click(&mut harness, "Moving nodes (ALE)");
    click(&mut harness, "Fixed frame");
    assert!(shows(&harness, "must hold Fixed for a linearised model"));

    press(&mut harness, Modifiers::COMMAND, Key::S);
    let Study::Transient(study) = Scene::read(&folder.join("scene.ron")).unwrap().study else { panic!() };
    assert_eq!(study.trainings.len(), 1);
    let linearised = study.linearised.unwrap();
    assert_eq!((linearised.modes, linearised.weightings.len()), (100, 2));
    assert_eq!(linearised.selection, LinearisedTransient::default().selection);
    assert!(matches!(linearised.selection, Selection::Step { .. }));
}

#[test]
fn study_of_several_inputs_opens_and_is_saved() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/time/fig_4_17_quick.ron");
    let asked = Scene::read(&path).unwrap();
    let Study::Transient(study) = &asked.study else { panic!() };
    let (mut harness, folder) = open("study", &std::fs::read_to_string(path).unwrap(), [1280.0, 900.0]);
    let trainings = study.trainings.len() * study.training_loads.len();
    click(&mut harness, "Model set-up");
    assert!(trainings > study.trainings.len() && shows(&harness, &format!("Trained on {trainings} other inputs")));
    assert!(shows(&harness, "At reference loads of 400.0\u{2009}N/mm, 600.0\u{2009}N/mm"));
    let modes = harness.get_by_role_and_label(Role::SpinButton, "Modes");
    assert_eq!(modes.value().unwrap(), study.linearised.as_ref().unwrap().modes.to_string());
    modes.set_value_accesskit(80.0);
    harness.run_steps(2);
    click(&mut harness, "Transient");
    click(&mut harness, "Set-up");
    assert!(shows(&harness, "Headless runs follow further inputs too: s_0_5, s_0_9"));
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::S);
    harness.run_steps(2);
    let mut wanted = study.clone();
    wanted.linearised.as_mut().unwrap().modes = 80;
    let saved = Scene::read(&folder.join("scene.ron")).unwrap();
    assert_eq!(saved, Scene { study: Study::Transient(wanted), ..asked });
}

#[test]
fn scene_runs_headless_only_in_the_fixed_frame() {
    let wanted = "reduced: (loss: 1e-6), linearised: (modes: 90, selection: Distance(tolerance: 0.1), points: 40)";
    let run = |text: &str| run_scene(&Scene::from_ron(text).unwrap(), &mut Workbench::new(Path::new(".")), &());
    let outcome = run(&scene(SINE, wanted)).unwrap();
    assert!(outcome.found.converged && outcome.found.warnings.is_empty(), "{:?}", outcome.found.warnings);
    let value = |name: &str| outcome.found.values.iter().find(|value| value.name == name).unwrap().value;
    assert!((value("fixed.tpwl.points") - 40.0).abs() <= 2.0, "{} points", value("fixed.tpwl.points"));
    assert_eq!((value("fixed.tpwl.modes"), value("fixed.tpwl.dual_taylor.steps")), (90.0, 100.0));
    let difference = value("fixed.tpwl.dual_taylor.H_c.difference_l2");
    assert!(difference < 1e-3 && difference > 0.0, "{difference:e}");
    assert!(value("fixed.rnsa.H_c.difference_l2") < difference, "it solves the nonlinear equations");
    assert!(outcome.tables.iter().any(|table| table.name == "transient_fixed_tpwl_dual_taylor"));
    let moving = scene(SINE, &format!("frames: [ArbitraryLagrangianEulerian], {BOTH}"));
    assert!(Scene::from_ron(&moving).unwrap_err().to_string().contains("must hold Fixed for a linearised model"));
}

#[test]
fn any_plot_leaves_as_a_drawing_with_its_name_axes_and_contact() {
    let (mut harness, folder) = open("drawing", &scene(SINE, BOTH), [1280.0, 900.0]);
    run_in_time(&mut harness);
    let drawing = export_plot(&mut harness, "TPWL", "Operating points in the plane", &folder.join("plane.svg"));
    assert!(drawing.starts_with("<svg ") && drawing.ends_with("</svg>\n"));
    assert!(drawing.contains(">Operating points in the plane</text>"));
    let caption = crate::driver::caption(&drawing);
    assert!(caption.contains("load 200.0 N/mm") && caption.contains("E' 231.0 GPa"), "the contact: {caption}");
    assert!(caption.contains("load harmonic, amplitude"), "what varies: {caption}");
    assert!(drawing.contains("Pressure mode 1") && drawing.contains("Pressure mode 2"), "titles of the axes");
    let points = harness.state().operating_points().unwrap();
    assert!(drawing.matches("<circle ").count() >= points, "one dot for each operating point");
    assert_eq!(drawing.matches("<g").count(), drawing.matches("</g>").count());
    // The same function serves every tab: a film-thickness profile by the key.
    click(&mut harness, "Profiles");
    press(&mut harness, Modifiers::COMMAND, Key::E);
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::ComboBox, "Plot").click();
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::Button, "Film profile").click();
    harness.run_steps(3);
    click(&mut harness, "SVG…");
    give_path(&mut harness, &folder.join("film.svg"), "Export");
    let drawing = std::fs::read_to_string(folder.join("film.svg")).unwrap();
    assert!(drawing.contains("<polyline ") && drawing.contains("font-style=\"italic\""));
}
