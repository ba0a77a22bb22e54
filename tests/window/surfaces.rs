//! Rough surfaces in the window: roughness of both bodies, mixed lubrication, Stribeck curve.

use crate::common::scratch::Scratch;
use crate::driver::{Table, Window, choose, click, export, press, set, shows, undo, wait, wait_until, write};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use std::path::Path;
use std::time::Duration;

const PATIENCE: Duration = Duration::from_secs(120);

fn window(scene: Option<&str>) -> Window {
    let mut explorer = Explorer::with_embedded_models().without_system_dialogs();
    if let Some(scene) = scene {
        explorer.open_scene(Path::new(scene)).unwrap();
    }
    let mut harness = crate::driver::window(explorer, [1280.0, 1900.0]);
    wait(&mut harness, "the picture", |app| app.central_film().is_some() && !app.busy());
    harness
}

fn enter(harness: &mut Window, field: &str, text: &str) {
    write(harness, field, text);
    press(harness, Modifiers::NONE, Key::Enter);
}

#[test]
fn roughness_changes_the_film_only_with_mixed_lubrication() {
    let mut harness = window(None);
    let smooth = harness.state().central_film().unwrap();
    click(&mut harness, "Surfaces");
    choose(&mut harness, "Measured as", "Ra");
    enter(&mut harness, "Roughness of body 1", "0.1 µm");
    choose(&mut harness, "Measured as", "Rq");
    // Ra 0.1 µm is Rq 0.1253 µm. The film ratio appears, and the film is still that of smooth surfaces.
    assert!(shows(&harness, "0.135 µm".replace(' ', "\u{2009}").as_str()), "composite of 0.1253 and 0.05");
    assert!(shows(&harness, "Film ratio") && shows(&harness, "Asperities touch"));
    assert_eq!(harness.state().central_film(), Some(smooth));
    click(&mut harness, "Mixed lubrication");
    // The badge has errors of a reduced model of rough surfaces, once it has been read.
    wait(&mut harness, "the rough contact", |app| {
        let rough = app.central_film().is_some_and(|film| (film / smooth - 1.0).abs() > 1e-3);
        rough && !app.busy() && app.badge_detail().contains("H_c")
    });
    assert!(shows(&harness, "carried by asperities") && shows(&harness, "of the load"));
    let at = harness.state().central_film().unwrap();
    set(&mut harness, Role::Slider, "Composite roughness", 0.5);
    wait(&mut harness, "the rougher contact", |app| !app.busy() && app.central_film().is_some_and(|film| film != at));
    enter(&mut harness, "Peklenik number", "20");
    assert!(shows(&harness, "The Peklenik number is 20"));
    choose(&mut harness, "Asperities", "Zhao–Maietta–Chang");
    wait(&mut harness, "the picture", |app| !app.busy());
    enter(&mut harness, "Hardness", "0");
    assert!(shows(&harness, "The hardness in Pa is 0"));
    enter(&mut harness, "Hardness", "5 GPa");
    wait(&mut harness, "the picture", |app| !app.busy());
    // Heat thins the film, and everything can be undone.
    let cold = harness.state().central_film().unwrap();
    click(&mut harness, "Heat");
    wait(&mut harness, "the thermal contact", |app| !app.busy() && app.central_film().is_some_and(|film| film < cold));
    for _ in 0..8 {
        undo(&mut harness);
    }
    wait(&mut harness, "the smooth contact", |app| !app.busy() && app.central_film() == Some(smooth));
}

#[test]
fn stribeck_curve_has_a_boundary_and_a_full_film_end() {
    let mut harness = window(Some("scenes/rough/stribeck.ron"));
    click(&mut harness, "Traction");
    click(&mut harness, "Stribeck curve");
    // The model computes 101 contacts, and full solutions continue the curve at both ends.
    wait_until(PATIENCE, &mut harness, "the curve", |window| {
        shows(window, " contacts in") && !shows(window, "101 contacts in")
    });
    assert!(harness.query_by_label("Load share of asperities along the quantity").is_some());
    let folder = Scratch::new("stribeck");
    let table = Table::of(&export(&mut harness, "Traction", "Curve as CSV…", &folder.join("curve.csv")));
    let (speed, friction) = (table.column("si.speed"), table.column("traction"));
    let (share, boundary) = (table.column("mixed.asperity_load_share"), table.column("mixed.boundary_traction"));
    let last = speed.len() - 1;
    assert!(last > 110 && (speed[last] / speed[0]).log10() > 6.9, "{speed:?}");
    assert!(speed.windows(2).all(|pair| pair[1] > pair[0]), "{speed:?}");
    assert!(share.windows(2).all(|pair| pair[1] <= pair[0]), "{share:?}");
    assert!(share[0] > 0.3 && share[last] < 1e-3 && boundary[0] > 0.9 * friction[0]);
    let least = friction.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(least < 0.8 * friction[0] && least < 0.9 * friction[last], "{friction:?}");
    // The curve follows the roughness.
    set(&mut harness, Role::Slider, "Composite roughness", 0.3);
    wait_until(PATIENCE, &mut harness, "the next curve", |window| shows(window, " contacts in"));
}
