//! Cavitation models, selected next to the lubricant. An inlet film thickness starves the contact on the screen.

use crate::driver::{Window, choose, click, press, shows, undo, wait, write};
use egui::{Key, Modifiers};
use ehl_explorer::app::Explorer;

fn film(harness: &Window) -> f64 {
    harness.state().central_film().expect("a picture")
}

#[test]
fn inlet_film_starves_the_contact_by_the_full_solver() {
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, 1600.0]);
    wait(&mut harness, "verification", |app| app.badge() == "Verified");
    let flooded = film(&harness);
    choose(&mut harness, "Cavitation", "Mass-conserving");
    wait(&mut harness, "verification", |app| app.badge() == "Verified" && !app.busy());
    assert!((film(&harness) / flooded - 1.0).abs() < 1e-6, "a flooded film is the same");
    click(&mut harness, "Starved inlet");
    let outside = |app: &Explorer| app.badge() == "Outside the trained range" && !app.busy();
    wait(&mut harness, "the full solver", outside);
    assert!(harness.state().badge_detail().contains("flooded inlet"), "{}", harness.state().badge_detail());
    write(&mut harness, "Inlet film thickness", "40");
    press(&mut harness, Modifiers::NONE, Key::Enter);
    wait(&mut harness, "the starved film", |app| outside(app) && app.central_film().is_some_and(|h| h < 0.6 * flooded));
    assert!(shows(&harness, "nm"));
    let starved = film(&harness);
    write(&mut harness, "Inlet film thickness", "-3");
    press(&mut harness, Modifiers::NONE, Key::Enter);
    wait(&mut harness, "rest", |app| !app.busy());
    assert!((film(&harness) / starved - 1.0).abs() < 1e-9, "a supply below zero is refused");
    for _ in 0..3 {
        undo(&mut harness);
    }
    wait(&mut harness, "verification", |app| app.badge() == "Verified");
    assert!((film(&harness) / flooded - 1.0).abs() < 1e-3);
}
