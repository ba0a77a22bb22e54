//! Measured data: tables are read, drawn, fitted, and the fitted oil is kept.

use crate::driver::{Window, choose, click, press, shows, undo, wait, wait_until, window, write};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use std::time::Duration;

fn enter(harness: &mut Window, field: &str, text: &str) {
    write(harness, field, text);
    press(harness, Modifiers::NONE, Key::Enter);
}

#[test]
fn an_oil_is_fitted_to_a_rig_and_kept() {
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = window(explorer, [1280.0, 1200.0]);
    wait(&mut harness, "the first picture", |app| app.central_film().is_some());
    for (field, text) in [
        ("Radius R", "10 mm"),
        ("Speed u_m", "1 m/s"),
        ("Load w", "100 N/mm"),
        ("Modulus E'", "231 GPa"),
        ("Viscosity η₀", "20 mPa·s"),
        ("Coefficient α", "15 1/GPa"),
    ] {
        enter(&mut harness, field, text);
    }
    click(&mut harness, "File");
    click(&mut harness, "Measured data…");
    click(&mut harness, "Example");
    harness.run_steps(3);
    assert!(shows(&harness, "14 lines"));
    click(&mut harness, "New table");
    click(&mut harness, "Example");
    harness.run_steps(3);
    click(&mut harness, "Fit eyring_stress");
    click(&mut harness, "Start the fit");
    let done = |harness: &Window| harness.query_by_label("Keep and use").is_some();
    wait_until(Duration::from_secs(120), &mut harness, "the fit", done);
    assert_eq!(harness.state().point().alpha_per_pa, 15e-9, "nothing changes before it is used");
    click(&mut harness, "Keep and use");
    harness.run_steps(3);
    let alpha = harness.state().point().alpha_per_pa;
    assert!((alpha / 2e-8 - 1.0).abs() < 0.03, "{alpha}");
    let eyring = harness.state().lubricant().limiting_stress.unwrap().eyring.unwrap();
    assert!((eyring / 5e6 - 1.0).abs() < 0.03, "{eyring}");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    // The oil is in the list of fluids, and another one can be chosen in between.
    choose(&mut harness, "Fluid", "Roelands oil");
    choose(&mut harness, "Fluid", "Fitted oil");
    assert_eq!(harness.state().point().alpha_per_pa, alpha);
    undo(&mut harness);
    undo(&mut harness);
    assert_eq!(harness.state().lubricant().limiting_stress.unwrap().eyring, Some(eyring));
}

#[test]
fn a_hole_in_a_table_is_named() {
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = window(explorer, [1280.0, 800.0]);
    harness.run_steps(3);
    click(&mut harness, "File");
    click(&mut harness, "Measured data…");
    let field = harness.get_by_label("Measured table");
    field.focus();
    harness.run_steps(2);
    harness.get_by_label("Measured table").type_text("speed [m/s];film [nm]\n1;200\n2;");
    harness.run_steps(3);
    assert!(shows(&harness, "Line 3: `film [nm]` is missing"));
}
