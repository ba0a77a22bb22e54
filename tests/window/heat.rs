//! Thermal contacts in the window, switched on next to the lubricant. The embedded thermal model is used inside its
//! range, and full solutions outside.

use crate::common::scratch::Scratch;
use crate::driver::{Window, choose, click, export, press, set, shows, undo, wait, wait_until, write};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use std::time::{Duration, Instant};

const PATIENCE: Duration = Duration::from_secs(300);

/// Opens the window with the embedded models at its first contact.
fn verified() -> Window {
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, 1900.0]);
    wait(&mut harness, "verification", |app| app.badge() == "Verified");
    harness
}

#[test]
fn thermal_contact_is_live_with_temperatures() {
    let mut harness = verified();
    let cold = harness.state().central_film().expect("a picture");
    click(&mut harness, "Heat");
    // The model is read, used, and checked against a thermal full solution.
    let warmer = |app: &Explorer| app.central_film().is_some_and(|film| film < cold);
    wait(&mut harness, "verification", |app| warmer(app) && app.badge() == "Verified" && !app.busy());
    assert!(harness.query_by_label_contains("reduced model").is_some(), "by the model");
    let warm = harness.state().central_film().expect("a picture");
    assert!(warm < cold, "{warm} {cold}");
    for plot in ["Rises of temperature", "Temperatures of the film"] {
        assert!(harness.query_by_label(plot).is_some(), "{plot}");
    }
    assert!(shows(&harness, "% into body 1") && shows(&harness, "% with the oil"));
    click(&mut harness, "Temperatures");
    assert!(harness.query_by_label("Temperatures of the film").is_none());
    click(&mut harness, "Temperatures");
    click(&mut harness, "Regimes");
    assert!(shows(&harness, "Murch–Wilson") && shows(&harness, "Gupta"));
    click(&mut harness, "Profiles");
    // Silicon nitride conducts less heat and is inside the model's range; glass is outside.
    choose(&mut harness, "Body 2", "Silicon nitride");
    let other = |app: &Explorer| app.central_film().is_some_and(|film| film != warm);
    wait(&mut harness, "verification", |app| other(app) && app.badge() == "Verified" && !app.busy());
    choose(&mut harness, "Body 2", "Glass");
    let outside = |app: &Explorer| app.badge() == "Outside the trained range" && !app.busy();
    wait(&mut harness, "the full solver", outside);
    assert!(harness.state().badge_detail().contains("√(kρc) of body 2"), "{}", harness.state().badge_detail());
    click(&mut harness, "Results");
    wait(&mut harness, "rest", |app| !app.busy());
    assert!(shows(&harness, "Rise at mid-film") && shows(&harness, "Heat into body 2"));
    assert!(shows(&harness, "Largest rise in the film"));
    write(&mut harness, "Inlet temperature", "20");
    press(&mut harness, Modifiers::NONE, Key::Enter);
    wait(&mut harness, "rest", |app| !app.busy());
    assert!(harness.state().central_film().is_some_and(|film| film < cold), "20 K is no inlet temperature");
    for _ in 0..3 {
        undo(&mut harness);
    }
    wait(&mut harness, "verification", |app| app.badge() == "Verified");
    assert!(harness.query_by_label("Temperatures").is_none());
}

#[test]
fn a_traction_curve_with_heat_lies_below_the_one_without() {
    let mut harness = verified();
    click(&mut harness, "Heat");
    click(&mut harness, "Traction");
    let folder = Scratch::new("traction-with-heat");
    wait_until(PATIENCE, &mut harness, "the curve", |window| shows(window, "41 contacts in"));
    let (begin, mut count) = (Instant::now(), 0);
    let (warm, cold) = loop {
        harness.run_steps(5);
        count += 1;
        let path = folder.join(format!("curve_{count}.csv"));
        let table = export(&mut harness, "Traction", "Curve as CSV…", &path);
        assert!(table.contains("a thermal contact over"));
        let lines: Vec<&str> = table.lines().filter(|line| !line.starts_with('#')).collect();
        let names: Vec<&str> = lines[0].split(',').collect();
        let column = |name: &str| -> Vec<f64> {
            let at = names.iter().position(|own| *own == name).unwrap_or_else(|| panic!("{name}: {names:?}"));
            // Full solutions are distinguished from it by the first column.
            let own = lines[1..].iter().filter(|line| line.starts_with("0,"));
            own.filter_map(|line| line.split(',').nth(at)?.parse().ok()).collect()
        };
        let curves = (column("traction"), column("isothermal_traction"));
        if curves.0.len() == 41 && curves.1.len() == 41 {
            break curves;
        }
        assert!(begin.elapsed() < PATIENCE, "{table}");
    };
    assert!(warm[40] < 0.95 * cold[40] && (warm[1] / cold[1] - 1.0).abs() < 0.1, "{warm:?} {cold:?}");
}

#[test]
fn a_ball_with_heat_has_a_map_of_its_temperatures() {
    let mut harness = verified();
    click(&mut harness, "Ball");
    wait(&mut harness, "verification", |app| app.badge() == "Verified" && !app.busy());
    click(&mut harness, "Contact map");
    assert!(harness.query_by_label("Temperature map").is_none(), "there is none without heat");
    let cold = harness.state().central_film().expect("a picture");
    set(&mut harness, Role::Slider, "Slide-to-roll ratio SRR", 30.0);
    click(&mut harness, "Heat");
    // The thermal model of circular contacts is read, used, and checked against a full solution.
    let warm = |app: &Explorer| app.central_film().is_some_and(|film| film < 0.999 * cold);
    wait(&mut harness, "verification", |app| warm(app) && app.badge() == "Verified" && !app.busy());
    click(&mut harness, "Temperature map");
    harness.run_steps(3);
    let said = harness.get_by_label("Map of the contact").accesskit_node().description().unwrap_or_default();
    assert!(said.contains("Temperature map") && said.contains("temperature rise"), "{said}");
    click(&mut harness, "Profiles");
    assert!(harness.query_by_label("Temperatures of the film").is_some());
    click(&mut harness, "Contact map");
    click(&mut harness, "Heat");
    wait(&mut harness, "verification", |app| app.badge() == "Verified" && !app.busy());
    assert!(harness.query_by_label("Temperature map").is_none(), "the map of the film is back");
}

#[test]
fn a_film_hotter_than_lubricants_endure_is_said_to_be_so() {
    const HOT: &str = r#"Scene(
        version: 1,
        title: "A film too hot",
        source: "none",
        lubricant: (limiting_stress: (ambient: 5e6, slope: 0.1, eyring: 5e6)),
        heat: (inlet_temperature: 390.0, oil: (viscosity_temperature: 0.021, conductivity: 0.105)),
        at: Si(radius: 40e-3, speed: 1.9, load: 3.6e6, modulus: 200e9, viscosity: 0.05, alpha: 2.4e-8),
        srr: 1.0,
        grid: Model,
        study: Point(methods: [Reduced(model: Embedded)]),
    )"#;
    let mut harness = verified();
    let folder = Scratch::new("too-hot");
    harness.state_mut().open_scene(&folder.write("scene.ron", HOT)).unwrap();
    wait(&mut harness, "the hot film", |app| app.badge() == "Verified" && !app.busy());
    click(&mut harness, "Profiles");
    assert!(shows(&harness, "oils decompose above 573 K") && shows(&harness, "% into body 1"));
    assert!(!shows(&harness, "Colours: from the inlet"));
}
