//! The window without a display: first steps of a user, and errors.

use crate::common::processor_time::{of_this_thread, on_one_thread};
use crate::common::scratch::Scratch;
use crate::driver::{Window, assert_cheap, click, export, give_path, press, rest, shows, undo, wait, write};
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use ehl_explorer::engine::{embedded, model_file};
use ehl_explorer::scene::{Scene, Study};
use ehl_explorer::solver::physics::contact::{ContactKind, MoesRequest, si_from_moes};
use ehl_explorer::solver::reduced::ReducedModel;
use ehl_explorer::solver::training::train;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

fn open_with(model: Option<Arc<ReducedModel>>) -> Window {
    crate::driver::window(Explorer::new(model).without_system_dialogs(), [1280.0, 800.0])
}

fn open() -> Window {
    open_with(None)
}

fn settled(harness: &mut Window) {
    wait(harness, "the picture", |app| app.central_film().is_some() && !app.busy());
    harness.run();
}

#[test]
fn a_live_verified_picture_appears_by_itself() {
    let mut harness = open();
    wait(&mut harness, "verification", |app| app.badge() == "Verified" && app.central_film().is_some());
    let film = harness.state().central_film().unwrap();
    assert!((0.03..0.2).contains(&film), "{film}");
}

/// Every tab with the texts that only it shows, whatever the model. The first one is open at the start.
const TABS: [(&str, &[&str]); 9] = [
    ("Profiles", &["Pin curve", "Pressure profile", "Film profile"]),
    ("Regimes", &["Chart of M and L"]),
    ("Traction", &["Laws of the fluid"]),
    ("Contact map", &["Show a circular contact"]),
    ("Reduced basis", &[]),
    ("Accuracy", &[]),
    ("Training", &["Start training", "Pre-computed"]),
    ("Transient", &["Load amplitude"]),
    ("TPWL", &["Number of operating points"]),
];

/// Opens all tabs in turn. Each shows its own texts and `more`, and no texts of the others.
fn assert_tabs_open(harness: &mut Window, more: &[(&str, &[&str])]) {
    let own = |tab: &str| -> Vec<&str> {
        let lists = TABS.iter().chain(more).filter(|(name, _)| *name == tab);
        lists.flat_map(|(_, texts)| texts.iter().copied()).collect()
    };
    for (tab, _) in TABS.iter().skip(1).chain(&TABS[..1]) {
        click(harness, tab);
        assert!(!own(tab).is_empty(), "nothing is known of {tab}");
        for (other, _) in TABS {
            for text in own(other) {
                assert_eq!(shows(harness, text), other == *tab, "{text:?} of {other} while {tab} is open");
            }
        }
    }
}

#[test]
fn every_tab_opens() {
    let mut harness = open();
    settled(&mut harness);
    let without =
        [("Reduced basis", &["there is no basis to show"][..]), ("Accuracy", &["there is no model to validate"])];
    assert_tabs_open(&mut harness, &without);
}

#[test]
fn a_model_draws_the_picture_and_a_full_solve_checks_it() {
    let mut harness = open_with(Some(Arc::new(small_model())));
    harness.step();
    assert!(harness.state().central_film().is_some(), "the reduced picture is there in the first frames");
    wait(&mut harness, "verification", |app| app.badge() == "Verified");
    harness.get_by_label("Load number M").set_value_accesskit(500.0);
    wait(&mut harness, "the full solver", |app| app.badge() == "Outside the trained range" && !app.busy());
    harness.get_by_label("Load number M").set_value_accesskit(500.0 / 1.01);
    harness.step();
    // A live solve that ends after the sliders have returned to the model must not replace its picture.
    harness.get_by_label("Load number M").set_value_accesskit(50.0);
    wait(&mut harness, "the reduced model", |app| app.badge() == "Verified");
    settled(&mut harness);
    let with = [("Reduced basis", &["Mode shapes", "Singular values"][..]), ("Accuracy", &["Failure map"])];
    assert_tabs_open(&mut harness, &with);
}

#[test]
fn the_slider_moves_the_load_and_undo_brings_it_back() {
    let mut harness = open();
    settled(&mut harness);
    let before = harness.state().load();
    harness.get_by_label("Load number M").set_value_accesskit(80.0);
    harness.run();
    let after = harness.state().load();
    assert!((harness.state().moes().m / 80.0 - 1.0).abs() < 1e-6);
    assert!((after / before - 2.0).abs() < 1e-6, "{before} to {after}");
    wait(&mut harness, "the new picture", |app| app.central_film().is_some());
    undo(&mut harness);
    assert!((harness.state().load() / before - 1.0).abs() < 1e-12);
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert!((harness.state().load() / after - 1.0).abs() < 1e-12);
}

#[test]
fn a_refused_entry_leaves_a_message_and_the_last_picture() {
    let mut harness = open();
    settled(&mut harness);
    let film = harness.state().central_film();
    for bad in ["abc", "-3", "0", "NaN", "1e99"] {
        write(&mut harness, "Radius R", bad);
        press(&mut harness, Modifiers::NONE, Key::Enter);
        let said = harness.query_by_label_contains("is no number").is_some()
            || harness.query_by_label_contains("Radius is").is_some();
        assert!(said, "no message about {bad}");
        assert_eq!(harness.state().central_film(), film, "{bad}");
    }
}

#[test]
fn pinning_comparing_and_exporting_survive() {
    let mut harness = open();
    settled(&mut harness);
    click(&mut harness, "Pin curve");
    harness.get_by_label("Lubricant number L").set_value_accesskit(5.0);
    harness.run();
    settled(&mut harness);
    click(&mut harness, "Pin curve");
    click(&mut harness, "Remove pin 1");
    let folder = Scratch::new("export");
    let path = folder.join("profiles.csv");
    let text = export(&mut harness, "Profiles", "Profiles as CSV…", &path);
    let head: Vec<&str> = text.lines().take(4).collect();
    assert!(head[2].starts_with("# pin2: M ") && head[2].contains("; L "), "{head:?}");
    assert_eq!(head[3], "X,P,H,x_m,p_pa,h_m,pin2.X,pin2.P,pin2.H,pin2.x_m,pin2.p_pa,pin2.h_m");
    assert!(text.lines().skip(4).all(|line| line.split(',').count() == 12));
    assert!(text.lines().count() > 500);
}

#[test]
fn an_unwritable_path_is_a_sentence() {
    let mut harness = open();
    settled(&mut harness);
    press(&mut harness, Modifiers::COMMAND, Key::S);
    give_path(&mut harness, Path::new("/no/such/folder/contact.ron"), "Save");
    assert!(harness.query_by_label_contains("Cannot write").is_some());
}

#[test]
fn idle_means_idle() {
    let mut harness = open();
    settled(&mut harness);
    harness.run_steps(4);
    let delay = rest(&mut harness);
    assert!(delay > Duration::from_secs(60), "repaint after {delay:?}");
}

#[test]
fn a_frame_is_cheap() {
    let mut harness = open();
    settled(&mut harness);
    assert_cheap(&mut harness, 40, 2.5, |_, _| ());
}

#[test]
fn a_dragged_frame_of_the_embedded_model_is_cheap() {
    let mut harness = open_embedded();
    settled(&mut harness);
    assert_cheap(&mut harness, 120, 3.0, |harness, k| {
        assert!(harness.state().central_film().is_some(), "the picture follows within the frame");
        // Through the local models, from nearly rigid to nearly Hertzian.
        harness.get_by_label("Load number M").set_value_accesskit(5.0 * 1.027f64.powi(k.into()));
    });
    assert!(harness.state().central_film().is_some(), "the picture follows within the frame");
}

#[test]
fn previous_picture_is_grey_until_a_late_answer_arrives() {
    let explorer = Explorer::new(Some(embedded("line").unwrap())).without_system_dialogs();
    let mut harness = crate::driver::impatient_window(explorer.waiting_for_answers(Duration::ZERO), [1280.0, 800.0]);
    let arrived = |app: &Explorer| app.central_film().is_some();
    wait(&mut harness, "the first picture", arrived);
    let (mut late, first) = (0, harness.state().central_film());
    for k in 0..40 {
        harness.get_by_label("Load number M").set_value_accesskit(5.0 * 1.05f64.powi(k));
        harness.step();
        let app = harness.state();
        if !arrived(app) {
            late += 1;
            assert!(app.busy() && app.badge() == "Computing", "{} {}", app.busy(), app.badge());
            assert!(app.drawn().any(|(name, present, grey)| name == "profiles" && !present && grey));
        }
    }
    println!("{late} of 40 answers were late");
    assert!(late > 0);
    wait(&mut harness, "the last picture", arrived);
    assert_ne!(harness.state().central_film(), first);
    assert_eq!(harness.state().badge(), "Reduced model");
    wait(&mut harness, "verification", |app| app.badge() == "Verified");
}

#[test]
fn the_first_picture_is_there_within_a_second() {
    // In processor time, independent of other load on the machine.
    let (model, read) = on_one_thread(|| {
        let begin = of_this_thread();
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/line.rom");
        (model_file::read(&path).unwrap(), of_this_thread() - begin)
    });
    let begin = of_this_thread();
    let mut harness = open_with(Some(Arc::new(model)));
    harness.step();
    assert!(harness.state().central_film().is_some(), "the first frame has a picture");
    let drawn = of_this_thread() - begin;
    println!("model read in {read:.0?}, first frame with a picture after {drawn:.0?} more");
    let most = Duration::from_secs(if cfg!(debug_assertions) { 30 } else { 1 });
    assert!(read + drawn < most, "{read:?} {drawn:?}");
}

#[test]
fn the_badge_estimates_first_and_knows_later() {
    let mut harness = open_embedded();
    harness.step();
    assert_eq!(harness.state().badge(), "Reduced model");
    let promise = harness.state().badge_detail();
    assert!(promise.starts_with("{H_c} within") && promise.contains("{H_min} within"), "{promise}");
    wait(&mut harness, "verification", |app| app.badge() == "Verified");
    let detail = harness.state().badge_detail();
    assert!(detail.contains("Δ{H_c}") && detail.contains('%') && !detail.contains("e−7"), "{detail}");
}

#[test]
fn answer_by_a_neighbouring_model_warns_until_checked() {
    let mut model = ReducedModel::clone(&embedded("line").unwrap());
    let window = |m: f64| model.window_for(&si_from_moes(&MoesRequest::new(ContactKind::Line, m, 10.0)).unwrap());
    let (own, beyond) = (window(100.0), (1..40).map(|k| 100.0 / 1.05f64.powi(k)).find(|m| window(*m) != window(100.0)));
    // A system of zero equations has no solution: one local model has none.
    let others = model.windows.iter_mut().enumerate().filter(|(k, _)| *k != own);
    others.for_each(|(_, window)| window.reconstruction.fill(0.0));
    let (mut harness, folder) = (open_with(Some(Arc::new(model))), Scratch::new("stands-in"));
    let near = |m: f64| {
        let scene =
            format!("Scene(version: 1, title: \"t\", at: Moes(m: {m}, l: 10.0), study: Point(methods: [Full]))");
        folder.write(&format!("{m}.ron"), &scene)
    };
    let mut promised = |m: f64| {
        harness.state_mut().open_scene(&near(m)).unwrap();
        harness.step();
        assert_eq!(harness.state().badge(), "Reduced model");
        let why = harness.get_by_label("Trust in the picture").accesskit_node().description().unwrap_or_default();
        (harness.state().badge_detail(), why)
    };
    let (detail, why) = promised(100.0);
    assert!(detail.starts_with("{H_c} within") && why.starts_with("99 % empirical error bounds"), "{detail}; {why}");
    let (detail, why) = promised(beyond.unwrap());
    assert!(detail.starts_with("no error bound: a neighbouring local model is used"), "{detail}");
    assert!(why.starts_with("The local model of this contact found no solution"), "{why}");
    assert!(!why.contains(".."), "{why}");
    wait(&mut harness, "verification", |app| ["Verified", "Roughly right", "Far off"].contains(&app.badge().as_str()));
}

#[test]
fn far_outside_the_model_the_full_solver_takes_over_visibly() {
    let mut harness = open_embedded();
    settled(&mut harness);
    harness.get_by_label("Load number M").set_value_accesskit(1000.0);
    harness.step();
    assert_eq!(harness.state().badge(), "Outside the trained range");
    harness.get_by_label("Lubricant number L").set_value_accesskit(25.0);
    harness.step();
    assert_eq!(harness.state().badge(), "Outside the trained range");
    wait(&mut harness, "the full solver", |app| !app.busy());
    harness.run();
    // Either a converged full solution, or a sentence and the previous picture; never a reduced result.
    match harness.state().badge().as_str() {
        "Outside the trained range" => assert!(harness.state().central_film().is_some()),
        "No solution here" => assert!(harness.state().central_film().is_none()),
        other => panic!("{other}"),
    }
    assert!(harness.query_by_label_contains("full solver draws").is_some());
}

#[test]
fn a_reduced_solve_that_fails_hands_over_to_the_full_solver() {
    // One mode is not sufficient for the load: the reduced equations have no solution.
    let text = "Scene(version: 1, title: \"t\", at: Moes(m: 200.0, l: 3.0), study: Point(methods: [Full]), \
        view: (pressure_loss: 0.9))";
    let folder = Scratch::new("failing");
    let path = folder.write("failing.ron", text);
    let mut harness = open_embedded();
    settled(&mut harness);
    harness.state_mut().open_scene(&path).unwrap();
    harness.step();
    wait(&mut harness, "the full solver", |app| app.central_film().is_some() && !app.busy());
    harness.run();
    assert_eq!(harness.state().badge(), "Reduced model failed");
    assert_eq!(harness.state().badge_detail(), "full solution");
}

#[test]
fn what_is_not_active_says_why_to_everybody() {
    let mut harness = open();
    settled(&mut harness);
    let node = harness.get_by_label("Newtonian plateau ratio NPR").accesskit_node();
    let why = node.description().unwrap_or_default();
    assert!(why.starts_with("The lubricant has no shear constants, so it is Newtonian"), "{why}");
    assert!(node.is_disabled());
}

#[test]
fn a_whole_drag_is_one_step_back() {
    let mut harness = open();
    settled(&mut harness);
    let before = harness.state().load();
    let rail = harness.get_by_label("Load number M").rect();
    let at = |t: f32| egui::pos2(rail.left() + t * rail.width(), rail.center().y);
    harness.hover_at(at(0.5));
    harness.step();
    harness.drag_at(at(0.5));
    harness.step();
    let mut passed = Vec::new();
    for k in 1..=12 {
        harness.hover_at(at(0.5 + 0.02 * k as f32));
        harness.step();
        passed.push(harness.state().load());
    }
    harness.drop_at(at(0.74));
    harness.step();
    assert!(passed.windows(2).all(|w| w[0] < w[1]), "{passed:?}");
    let after = harness.state().load();
    assert!(after > 2.0 * before, "{before} to {after}");
    undo(&mut harness);
    assert!((harness.state().load() / before - 1.0).abs() < 1e-12, "one step back is the whole drag");
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert!((harness.state().load() / after - 1.0).abs() < 1e-12);
}

fn open_embedded() -> Window {
    open_with(Some(embedded("line").unwrap()))
}

/// Training around the middle of the sliders, sufficient for every view of a model.
const SMALL_MODEL: &str = "Scene(version: 1, title: \"Small model\", study: Training(
    title: \"Small model\",
    range: (axes: {M: (20.0, 100.0), L: (5.0, 14.0), Alpha: (8e-9, 20e-9)}, limits: {HertzPressure: (0.0, 3.2e9)},
        fixed: {Viscosity: 0.01}),
    plan: FarthestPoint(snapshots: 40),
    windows: Given([(m: (20.0, 100.0), grid: Graded(nodes: 400, domain: (-8.0, 1.9), registered: true))]),
    pressure_loss: 1e-7, deformation_loss: 1e-8, rows_per_mode: 2.0, evidence: 0, seed: 1,
))";

fn small_model() -> ReducedModel {
    let Study::Training(spec) = Scene::from_ron(SMALL_MODEL).unwrap().study else { panic!("no training") };
    train(&spec, &()).unwrap()
}

#[test]
fn a_deep_zoom_draws_dashed_lines_that_leave_the_screen_by_far() {
    let mut harness = crate::driver::window(Explorer::new(None).without_system_dialogs(), [1280.0, 800.0]);
    wait(&mut harness, "the first picture", |app| app.central_film().is_some() && !app.busy());
    harness.hover_at(egui::pos2(800.0, 300.0));
    for _ in 0..60 {
        harness.event(egui::Event::Zoom(2.0));
        harness.step();
    }
    assert!(harness.output().shapes.len() < 100_000, "{} shapes", harness.output().shapes.len());
}
