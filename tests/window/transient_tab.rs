//! The Transient tab without a display: a transient run is computed, observed, stopped, inspected, exported and saved.

use crate::common::scratch::Scratch;
use crate::driver::{
    Table, Window, assert_cheap, caption, click, export, export_plot, give_path, press, rest_in_time, run_in_time, set,
    shows, solid_curves, time, undo, wait,
};
use egui::accesskit::Role;
use egui::{Key, Modifiers, ViewportEvent};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use ehl_explorer::engine::{Workbench, run_scene};
use ehl_explorer::scene::{Scene, Study};
use ehl_explorer::solver::full::transient::{Frame, Signal};

/// A scene on a coarse grid, on which a step takes about a millisecond.
fn scene(inputs: &str, duration: f64, frames: &str) -> String {
    format!(
        "Scene(version: 1, title: \"breathing\", at: Moes(m: 20.0, l: 5.0), grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)),
            study: Transient(inputs: ({inputs}), duration: {duration}, time_step: Fixed(0.05), frames: [{frames}]))"
    )
}

const BREATHING: &str = "load: Harmonic(amplitude: 0.1, period: 2.0)";

/// Opens the Transient tab on a scene.
fn open(name: &str, text: &str) -> (Window, Scratch) {
    let folder = Scratch::new(name);
    let path = folder.write("scene.ron", text);
    let mut explorer = Explorer::new(None).without_system_dialogs();
    explorer.open_scene(&path).unwrap();
    let mut harness = crate::driver::window(explorer, [1280.0, 1000.0]);
    wait(&mut harness, "the first picture", |app| app.central_film().is_some() && !app.busy());
    click(&mut harness, "Transient");
    (harness, folder)
}

/// Opens the window without a scene.
fn fresh() -> Window {
    let explorer = Explorer::new(None).without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, 800.0]);
    wait(&mut harness, "the first picture", |app| app.central_film().is_some() && !app.busy());
    harness
}

#[test]
fn a_rough_contact_runs_in_full_with_the_load_of_its_asperities() {
    let study = scene(BREATHING, 2.0, "Fixed").replace("at: Moes", "roughness: (sigma: 3e-7), at: Moes");
    let (mut harness, _folder) = open("rough", &study);
    run_in_time(&mut harness);
    harness.get_by_role_and_label(Role::Button, "Asperities").click();
    harness.run_steps(3);
    assert!(harness.query_by_label("Asperity load share against time").is_some());
}

#[test]
fn quitting_asks_before_it_discards_a_running_transient_run() {
    let (mut harness, _folder) = open("quit", &scene(BREATHING, 2000.0, "Fixed"));
    click(&mut harness, "Run transient");
    harness.run_steps(3);
    let viewport = harness.input().viewport_id;
    harness.input_mut().viewports.entry(viewport).or_default().events.push(ViewportEvent::Close);
    harness.run_steps(3);
    assert!(shows(&harness, "This would be lost"));
    assert!(shows(&harness, "A transient run is being computed. Its results so far are not saved."));
    click(&mut harness, "Quit anyway");
    assert!(!shows(&harness, "This would be lost"));
}

#[test]
fn frames_are_run_compared_scrubbed_played_and_exported() {
    let (mut harness, folder) = open("frames", &scene(BREATHING, 2.0, "Fixed, ArbitraryLagrangianEulerian"));
    run_in_time(&mut harness);
    assert!(shows(&harness, "Film, pressure and inputs against time"));
    for (choice, plot) in [("Film", "Central film against time"), ("Pressure", "Central pressure against time")] {
        click(&mut harness, choice);
        assert!(shows(&harness, plot), "{plot}");
    }
    click(&mut harness, "Together");
    assert!(shows(&harness, "Deviation between runs"));
    assert!(shows(&harness, "Moving nodes (ALE)") && shows(&harness, "Film at this moment"));
    assert!((time(&harness) - 2.0).abs() < 1e-12, "it has followed the run to its end");

    let series = Table::of(&export(&mut harness, "Transient", "Series as CSV…", &folder.join("series.csv")));
    let (column, rows) = (|name: &str| series.at(name), &series.rows);
    let (film, moving) = (column("full.fixed.H_c"), column("full.ale.H_c"));
    assert_eq!(rows.len(), 41);
    let load = column("full.fixed.load");
    assert!((rows[10][load] - 1.1).abs() < 1e-12);
    assert!(rows.iter().all(|row| (row[moving] / row[film] - 1.0).abs() < 0.02));
    assert!(rows.iter().any(|row| (row[film] / rows[0][film] - 1.0).abs() > 0.01), "the film breathes");

    let scene = Scene::read(&folder.join("scene.ron")).unwrap();
    let outcome = run_scene(&scene, &mut Workbench::new(""), &()).unwrap();
    for (table, name) in outcome.tables.iter().zip(["full.fixed.H_c", "full.ale.H_c"]) {
        let bits = |values: Vec<f64>| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        let headless = Table::of(&table.to_csv()).column("H_c");
        assert_eq!(bits(series.column(name)), bits(headless), "{name} on the screen and headless");
    }

    // At a quarter of the period, the profiles are those of that time.
    set(&mut harness, Role::Slider, "Time T", 0.5);
    let profiles = Table::of(&export(&mut harness, "Transient", "Profiles as CSV…", &folder.join("profiles.csv")));
    let (x, h) = (profiles.at("full.ale.X"), profiles.at("full.ale.H"));
    let centre = profiles.rows.iter().min_by(|a, b| a[x].abs().total_cmp(&b[x].abs())).unwrap();
    assert!((centre[h] / rows[10][moving] - 1.0).abs() < 1e-6, "in the scales of the reference contact");

    let figure = export_plot(&mut harness, "Transient", "All plots of Transient", &folder.join("figure.svg"));
    // Film thickness and pressure of the solid run against time, and both profiles.
    assert_eq!(solid_curves(&figure), 4);
    assert!(figure.contains("Moving nodes (ALE)") && figure.ends_with("</svg>\n"));
    assert!(caption(&figure).contains(" harmonic, amplitude"), "what was run, not what the sliders say");

    harness.run_steps(4);
    assert!((time(&harness) - 0.5).abs() < 1e-9, "nothing moves by itself");
    click(&mut harness, "Play");
    wait(&mut harness, "the player", |app| !app.marching());
    assert!(time(&harness) > 0.5);
    click(&mut harness, "Pause");
    let there = time(&harness);
    harness.run_steps(4);
    assert_eq!(time(&harness), there);
}

#[test]
fn a_stopped_run_keeps_what_it_has_and_the_sliders_make_it_old() {
    let (mut harness, _folder) = open("stopped", &scene(BREATHING, 4000.0, "Fixed"));
    // Twice, since a stopped run leaves room for the next. The duration of a stop is tested without the window, where
    // studies are cancelled.
    for _ in 0..2 {
        click(&mut harness, "Run transient");
        wait(&mut harness, "some steps", |app| !app.marching() || app.transient_moments() > 20);
        assert!(harness.query_by_label("Progress of the transient runs").is_some());
        click(&mut harness, "Stop");
        wait(&mut harness, "the end", |app| !app.marching());
    }
    assert!(shows(&harness, "was cancelled at T ="));
    let kept = harness.state().transient_moments();
    assert!(kept > 20 && time(&harness) > 0.0);
    assert!(!shows(&harness, "a previous set-up"));
    harness.get_by_label("Load number M").set_value_accesskit(25.0);
    harness.run_steps(2);
    assert!(shows(&harness, "a previous set-up") && harness.state().transient_moments() == kept);
}

#[test]
fn failed_time_step_is_reported_and_results_stay() {
    // The load falls below all accepted contacts within one step.
    let inputs = "load: Sampled(times: [0.0, 1.0, 1.01, 2.0], values: [1.0, 1.0, 1e-9, 1e-9])";
    let (mut harness, folder) = open("refused", &scene(inputs, 2.0, "Fixed"));
    run_in_time(&mut harness);
    assert!(shows(&harness, "could not take the step") || shows(&harness, "stopped at T ="), "it is said");
    assert!(shows(&harness, "previous steps are kept"));
    assert!((10..=41).contains(&harness.state().transient_moments()));
    let series = Table::of(&export(&mut harness, "Transient", "Series as CSV…", &folder.join("series.csv")));
    assert_eq!(series.rows.len(), harness.state().transient_moments());
}

#[test]
fn the_set_up_is_edited_undone_refused_and_saved_with_the_scene() {
    let (mut harness, folder) = open("document", &scene(BREATHING, 2.0, "Fixed"));
    click(&mut harness, "Set-up");
    let value = |harness: &Window, name: &str| harness.get_by_role_and_label(Role::SpinButton, name).value().unwrap();
    assert_eq!(value(&harness, "Load A"), "0.1");
    set(&mut harness, Role::SpinButton, "Load A", 1.5);
    assert!(shows(&harness, "The load falls to"), "a load through zero is refused with its time");
    assert_eq!(value(&harness, "Load A"), "0.1");
    set(&mut harness, Role::SpinButton, "Load A", 0.2);
    assert!(!shows(&harness, "The load falls to") && value(&harness, "Load A") == "0.2");
    undo(&mut harness);
    assert_eq!(value(&harness, "Load A"), "0.1");
    set(&mut harness, Role::SpinButton, "Duration T", 0.01);
    assert!(shows(&harness, "time step is 0.05"));
    click(&mut harness, "Fixed frame");
    assert!(shows(&harness, "At least one frame is needed"));
    click(&mut harness, "Remeshed, spline");

    // A table with a gap changes nothing; a complete one replaces the load.
    let input = folder.join("load.csv");
    std::fs::write(&input, "T,load\n0,1\n1,\n").unwrap();
    click(&mut harness, "Inputs from CSV…");
    give_path(&mut harness, &input, "Read");
    assert!(shows(&harness, "line 3: `load` is missing"));
    std::fs::write(&input, "T,load\n0,1\n1,1.2\n2,0.9\n").unwrap();
    click(&mut harness, "Read");
    assert!(shows(&harness, "3 values"));

    press(&mut harness, Modifiers::COMMAND, Key::S);
    let Study::Transient(study) = Scene::read(&folder.join("scene.ron")).unwrap().study else { panic!() };
    assert_eq!(study.inputs.load, Signal::Sampled { times: vec![0.0, 1.0, 2.0], values: vec![1.0, 1.2, 0.9] });
    assert_eq!(study.frames.len(), 2);
    assert!(study.frames.contains(&Frame::Fixed));
}

#[test]
fn new_transient_runs_replays_and_is_checked() {
    let mut harness = fresh();
    click(&mut harness, "Transient");
    assert!(harness.state().marching(), "nobody has to press anything");
    rest_in_time(&mut harness);
    assert_eq!((harness.state().transient_moments(), harness.state().in_time()), (3 * 161, (true, 3, 0)));
    for said in ["Checked", "reduced ", "linearised ", "Film over space and time", "Film at this moment", "(×"] {
        assert!(shows(&harness, said), "{said}");
    }
    assert!(!shows(&harness, "Inputs against time"));
    click(&mut harness, "Set-up");
    assert!(shows(&harness, "Inputs against time"));
    click(&mut harness, "Set-up");

    // Both models have results before the full system, which then checks them.
    set(&mut harness, Role::Slider, "Load amplitude", 0.2);
    let live = |app: &Explorer| app.in_time() == (true, 2, 2);
    wait(&mut harness, "the models", live);
    assert!(shows(&harness, "Live") && shows(&harness, "Film at this moment"));
    rest_in_time(&mut harness);
    assert_eq!(harness.state().in_time(), (true, 3, 0));
    let folder = Scratch::new("fresh");
    let series = Table::of(&export(&mut harness, "Transient", "Series as CSV…", &folder.join("series.csv")));
    assert!((series.column("full.fixed.load")[20] - 1.2).abs() < 1e-9, "they are of the new amplitude");

    // The selected time stays, the read-outs belong to it, and the map selects another.
    set(&mut harness, Role::Slider, "Time T", 3.0);
    set(&mut harness, Role::Slider, "Load period", 8.0);
    rest_in_time(&mut harness);
    assert!((time(&harness) - 3.0).abs() < 1e-9);
    assert!(shows(&harness, "T = 3.000, ") && shows(&harness, "3.000"), "the read-outs are of that moment");
    let map = harness.get_by_label("Film over space and time").rect();
    harness.hover_at(map.center());
    harness.run_steps(1);
    harness.drag_at(map.center());
    harness.run_steps(1);
    harness.drop_at(map.center());
    harness.run_steps(2);
    assert!((time(&harness) - 4.0).abs() < 0.5, "half way up is half of the duration: {}", time(&harness));
    let map = Table::of(&export(&mut harness, "Transient", "Map as CSV…", &folder.join("map.csv")));
    assert_eq!(map.header, ["T", "X", "P", "H"]);
    assert!(map.rows.len() > 161 * 200 && map.column("H").iter().all(|h| *h > 0.0));
    click(&mut harness, "Pressure over time");
    let drawing = export_plot(&mut harness, "Transient", "Pressure over space and time", &folder.join("map.svg"));
    assert!(drawing.contains("href=\"data:image/png;base64,"));
    assert!(caption(&drawing).contains("load harmonic, amplitude"), "{}", caption(&drawing));
}

#[test]
fn a_ball_is_replayed_by_the_built_in_model_and_checked() {
    let mut harness = fresh();
    click(&mut harness, "Ball");
    click(&mut harness, "Transient");
    let live = |app: &Explorer| app.in_time() == (true, 1, 1);
    wait(&mut harness, "the reduced model", live);
    assert!(shows(&harness, "Live") && shows(&harness, "The reduced model is the built-in one"));
    set(&mut harness, Role::Slider, "Load amplitude", 0.08);
    wait(&mut harness, "the reduced model again", live);

    click(&mut harness, "Run transient");
    rest_in_time(&mut harness);
    assert_eq!((harness.state().transient_moments(), harness.state().in_time()), (3 * 101, (true, 3, 0)));
    let folder = Scratch::new("ball_models");
    let series = Table::of(&export(&mut harness, "Transient", "Series as CSV…", &folder.join("series.csv")));
    let full = series.column("full.fixed.H_c");
    for (name, within) in [("rnsa.fixed.H_c", 3e-3), ("tpwl_dual_taylor.fixed.H_c", 1e-2)] {
        let own = series.column(name);
        let worst = own.iter().zip(&full).map(|(own, full)| (own / full - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst < within, "{name}: {worst:e}");
    }
    click(&mut harness, "TPWL");
    for plot in
        ["Operating points along the trajectory", "Operating points in the plane", "Weights of the operating points"]
    {
        assert!(shows(&harness, plot), "{plot}");
    }
    assert!(harness.state().operating_points().is_some_and(|points| points >= 10));

    // Another load is outside the range of that model, and one is trained when the run starts.
    click(&mut harness, "Transient");
    click(&mut harness, "Set-up");
    set(&mut harness, Role::Slider, "Load number M", 60.0);
    assert!(shows(&harness, "The reduced model is trained here instead of the built-in one"));
    // An ellipse has the full system only.
    click(&mut harness, "Ellipse");
    assert!(shows(&harness, "Elliptical contacts run by the full system"));
    assert!(harness.query_by_role_and_label(Role::CheckBox, "Reduced model").is_none());
}

#[test]
fn a_frame_of_a_dragged_amplitude_is_cheap() {
    let mut harness = fresh();
    click(&mut harness, "Transient");
    rest_in_time(&mut harness);
    // Everything is replayed in other threads; this one draws their results.
    assert_cheap(&mut harness, 40, 6.0, |harness, k| {
        let slider = harness.get_by_role_and_label(Role::Slider, "Load amplitude");
        slider.set_value_accesskit(0.1 + 0.002 * f64::from(k));
    });
    assert!(harness.state().in_time().1 >= 2);
}

#[test]
fn what_has_not_come_to_a_moment_is_not_drawn_there() {
    let frames = "Fixed, ArbitraryLagrangianEulerian";
    let (mut harness, folder) = open("moment", &scene(BREATHING, 45.0, frames));
    assert!(!harness.state().marching(), "this takes more than a moment: it waits until it is asked for");
    assert!(shows(&harness, "Press Run transient"));
    click(&mut harness, "Run transient");
    wait(&mut harness, "the second frame", |app| !app.marching() || app.transient_moments() > 940);
    click(&mut harness, "Stop");
    rest_in_time(&mut harness);
    assert!((time(&harness) - 45.0).abs() < 1e-9 && shows(&harness, "Moving nodes (ALE): the march was cancelled"));
    let header = Table::of(&export(&mut harness, "Transient", "Profiles as CSV…", &folder.join("end.csv"))).header;
    assert!(header.iter().all(|name| name.starts_with("full.fixed.")), "{header:?}");
    set(&mut harness, Role::Slider, "Time T", 0.5);
    let header = Table::of(&export(&mut harness, "Transient", "Profiles as CSV…", &folder.join("early.csv"))).header;
    assert!(header.iter().any(|name| name.starts_with("full.ale.")), "{header:?}");
}

#[test]
fn transient_model_is_trained_and_compared() {
    let (mut harness, folder) = open("reduced", &scene(BREATHING, 2.0, "Fixed"));
    let basis = |harness: &mut Window| {
        click(harness, "Reduced basis");
        let offered = !harness.get_by_label("Transient model").accesskit_node().is_disabled();
        (offered, harness.get_by_label("Model of the contact").rect())
    };
    let (offered, before) = basis(&mut harness);
    assert!(!offered);
    click(&mut harness, "Transient");
    click(&mut harness, "Set-up");
    click(&mut harness, "Reduced model");
    run_in_time(&mut harness);
    click(&mut harness, "Set-up");
    assert!(shows(&harness, "Reduced model") && shows(&harness, "Deviation between runs"));
    assert_eq!(harness.state().transient_moments(), 2 * 41);
    let series = Table::of(&export(&mut harness, "Transient", "Series as CSV…", &folder.join("series.csv")));
    let (column, rows) = (|name: &str| series.at(name), &series.rows);
    let (full, reduced) = (column("full.fixed.H_c"), column("rnsa.fixed.H_c"));
    let worst = rows.iter().map(|row| (row[reduced] / row[full] - 1.0).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-3, "{worst:e}");
    press(&mut harness, Modifiers::COMMAND, Key::S);
    let Study::Transient(study) = Scene::read(&folder.join("scene.ron")).unwrap().study else { panic!() };
    assert_eq!(study.reduced.map(|reduced| reduced.loss), Some(1e-6));
    // Its bases are offered beside those of the contact. The choice was there before, so that nothing moves.
    assert_eq!(basis(&mut harness), (true, before));
}

#[test]
fn nothing_of_a_scene_stays_when_another_one_is_opened() {
    let (mut harness, folder) = open("another", &scene(BREATHING, 2.0, "Fixed"));
    run_in_time(&mut harness);
    assert!(harness.state().transient_moments() > 0 && shows(&harness, "Film, pressure and inputs against time"));
    // It takes longer than a moment, and does not run automatically.
    let long = scene("load: Harmonic(amplitude: 0.2, period: 1.0)", 40.0, "Fixed").replace("dx: 0.02", "dx: 0.004");
    let path = folder.write("long.ron", &long);
    harness.state_mut().open_scene(&path).unwrap();
    harness.run_steps(5);
    assert_eq!((harness.state().transient_moments(), harness.state().front()), (0, Some("Transient")));
    assert!(!shows(&harness, "Film, pressure and inputs against time") && shows(&harness, "Not run yet"));
    press(&mut harness, Modifiers::COMMAND, Key::N);
    rest_in_time(&mut harness);
    assert!(harness.state().in_time().0, "a fresh document has a contact in time of its own");
}
