//! Heat, switched on beside the lubricant: full solutions with temperatures draw the contact on the screen.

use crate::common::scratch::Scratch;
use crate::driver::{Window, choose, click, export, press, shows, undo, wait, wait_until, write};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use std::time::{Duration, Instant};

const PATIENCE: Duration = Duration::from_secs(300);

#[test]
fn a_contact_with_heat_is_drawn_by_the_full_solver_and_its_temperatures_stand_in_results() {
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, 1900.0]);
    wait(&mut harness, "verification", |app| app.badge() == "Verified");
    let cold = harness.state().central_film().expect("a picture");
    click(&mut harness, "Heat");
    let outside = |app: &Explorer| app.badge() == "Outside the reduced model" && !app.busy();
    wait(&mut harness, "the full solver", outside);
    assert!(harness.state().badge_detail().contains("heat"), "{}", harness.state().badge_detail());
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
    choose(&mut harness, "Body 2", "Glass");
    wait(&mut harness, "the full solver", outside);
    click(&mut harness, "Results");
    wait(&mut harness, "rest", |app| !app.busy());
    assert!(shows(&harness, "Rise at mid-film") && shows(&harness, "Heat into body 2"));
    write(&mut harness, "Inlet temperature", "20");
    press(&mut harness, Modifiers::NONE, Key::Enter);
    wait(&mut harness, "rest", |app| !app.busy());
    assert!(harness.state().central_film().is_some_and(|film| film < cold), "20 K is no inlet temperature");
    for _ in 0..2 {
        undo(&mut harness);
    }
    wait(&mut harness, "verification", |app| app.badge() == "Verified");
    assert!(harness.query_by_label("Temperatures").is_none());
}

#[test]
fn a_traction_curve_with_heat_lies_below_the_one_without() {
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, 1900.0]);
    wait(&mut harness, "verification", |app| app.badge() == "Verified");
    click(&mut harness, "Heat");
    click(&mut harness, "Traction");
    let folder = Scratch::new("traction-with-heat");
    let stops = |window: &Window| window.query_by_label("Stop").is_some();
    wait_until(PATIENCE, &mut harness, "the first full solutions", stops);
    wait_until(PATIENCE, &mut harness, "the last one", |window| !stops(window));
    let (begin, mut count) = (Instant::now(), 0);
    let (warm, cold) = loop {
        harness.run_steps(5);
        count += 1;
        let path = folder.join(format!("curve_{count}.csv"));
        let table = export(&mut harness, "Traction", "Curve as CSV…", &path);
        assert!(table.contains("a film with heat"));
        let lines: Vec<&str> = table.lines().filter(|line| !line.starts_with('#')).collect();
        let names: Vec<&str> = lines[0].split(',').collect();
        let column = |name: &str| -> Vec<f64> {
            let at = names.iter().position(|own| *own == name).unwrap_or_else(|| panic!("{name}: {names:?}"));
            lines[1..].iter().filter_map(|line| line.split(',').nth(at)?.parse().ok()).collect()
        };
        let curves = (column("traction"), column("isothermal_traction"));
        if curves.0.len() == 21 && curves.1.len() == 21 {
            break curves;
        }
        assert!(begin.elapsed() < PATIENCE, "{table}");
    };
    assert!(warm[20] < 0.95 * cold[20] && (warm[1] / cold[1] - 1.0).abs() < 0.1, "{warm:?} {cold:?}");
}
