//! Systems of units: what panels show, and what a bare number means.

use crate::driver::{Window, click, press, shows, wait, window, write};
use egui::{Key, Modifiers};
use ehl_explorer::app::Explorer;

fn enter(harness: &mut Window, field: &str, text: &str) {
    write(harness, field, text);
    press(harness, Modifiers::NONE, Key::Enter);
}

fn choose_system(harness: &mut Window, name: &str) {
    click(harness, "View");
    click(harness, name);
    harness.run_steps(2);
}

fn close(value: f64, wanted: f64) {
    assert!((value / wanted - 1.0).abs() < 1e-9, "{value} against {wanted}");
}

#[test]
fn panels_follow_the_system_and_read_bare_numbers_in_it() {
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = window(explorer, [1280.0, 1200.0]);
    wait(&mut harness, "the first picture", |app| app.central_film().is_some());
    assert!(shows(&harness, "GPa") && shows(&harness, "N/mm"), "engineering units at first");
    enter(&mut harness, "SRR value", "10");
    close(harness.state().sliding().0, 0.1);
    choose_system(&mut harness, "Units: Imperial");
    for unit in ["lbf/in", "ksi", "in/s", "cP", "µin"] {
        assert!(shows(&harness, unit), "{unit}");
    }
    enter(&mut harness, "Radius R", "1");
    close(harness.state().point().radius_m, 0.0254);
    enter(&mut harness, "Load w", "1000");
    close(harness.state().load(), 175_126.835_246_476_4);
    enter(&mut harness, "SRR value", "5");
    close(harness.state().sliding().0, 0.05);
    choose_system(&mut harness, "Units: SI");
    assert!(shows(&harness, "N/m") && shows(&harness, "Pa·s"));
    enter(&mut harness, "Radius R", "0.01");
    close(harness.state().point().radius_m, 0.01);
    enter(&mut harness, "Load w", "300 N/mm");
    close(harness.state().load(), 3e5);
}
