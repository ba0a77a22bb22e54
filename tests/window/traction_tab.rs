//! Shear-thinning in the window: four live sliders, selection of lubricants, the Traction tab.

use crate::common::scratch::Scratch;
use crate::driver::{
    Table, Window, caption, choose, click, export, export_plot, give_path, press, set, shows, solid_curves, undo, wait,
    write,
};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use ehl_explorer::engine::{Workbench, run_scene};
use ehl_explorer::scene::Scene;
use std::path::Path;

fn window(explorer: Explorer) -> Window {
    let explorer = explorer.without_system_dialogs();
    crate::driver::window(explorer, [1280.0, 1000.0])
}

/// Opens the window on Table 3.5's lubricant with sliding, with the embedded models.
fn squalane() -> Window {
    let mut explorer = Explorer::with_embedded_models();
    explorer.open_scene(Path::new("scenes/shear/fig_3_14_line.ron")).unwrap();
    let mut harness = window(explorer);
    wait(&mut harness, "the picture", |app| app.central_film().is_some());
    harness
}

fn slide(harness: &mut Window, name: &str, to: f64) {
    set(harness, Role::Slider, name, to);
}

fn enter(harness: &mut Window, field: &str, text: &str) {
    write(harness, field, text);
    press(harness, Modifiers::NONE, Key::Enter);
}

fn film(harness: &Window) -> f64 {
    harness.state().central_film().expect("a picture of the sliders")
}

/// Asserts that eleven full solutions agree with a reduced curve of 41 contacts: film thicknesses to 1 %, tractions to
/// the given tolerance of each.
fn assert_full_beside_reduced(rows: &[Vec<f64>], within: impl Fn(f64) -> f64) {
    let (full, reduced): (Vec<_>, Vec<_>) = rows.iter().partition(|row| row[0] == 1.0);
    assert_eq!((full.len(), reduced.len()), (11, 41));
    for full in full {
        let reduced = reduced.iter().find(|row| (row[1] - full[1]).abs() < 1e-9).unwrap();
        let (traction, film) = ((reduced[6] - full[6]).abs(), (reduced[7] / full[7] - 1.0).abs());
        assert!(traction <= within(full[6]) && film < 1e-2, "at SRR {}: {traction} and {film}", full[1]);
    }
}

#[test]
fn four_sliders_are_live_with_shear_thinning() {
    let mut harness = squalane();
    assert_eq!(harness.state().sliding(), (0.0, 0.2227));
    assert_eq!(harness.state().traction(), Some(0.0));
    let at_rest = film(&harness);
    slide(&mut harness, "Slide-to-roll ratio SRR", 50.0);
    let slid = film(&harness);
    // Fig. 3.14: µ 0.0321 at 0.74 m/s; the model has another grid.
    let traction = harness.state().traction().unwrap();
    assert!((traction / 0.0320523 - 1.0).abs() < 0.02, "{traction}");
    assert!(slid < 0.995 * at_rest, "sliding thins the film: {slid} of {at_rest}");
    slide(&mut harness, "Newtonian plateau ratio NPR", 0.6);
    let thick = film(&harness);
    assert!(thick > 1.1 * slid, "a higher plateau thickens it: {thick} of {slid}");
    slide(&mut harness, "Load number M", 20.0);
    assert!((film(&harness) / thick - 1.0).abs() > 0.05);
    wait(&mut harness, "verification", |app| app.badge() == "Verified");
    assert!(harness.state().badge_detail().contains("Δ{µ}"), "{}", harness.state().badge_detail());
    // Outside the trained range the full solver is used.
    slide(&mut harness, "Slide-to-roll ratio SRR", 150.0);
    wait(&mut harness, "the full solver", |app| app.badge() == "Outside the trained range" && !app.busy());
    assert!(harness.state().badge_detail().contains("SRR = 150 %"), "{}", harness.state().badge_detail());
    for _ in 0..5 {
        undo(&mut harness);
    }
    assert_eq!(harness.state().sliding(), (0.0, 0.2227));
    assert!((film(&harness) / at_rest - 1.0).abs() < 1e-9);
}

#[test]
fn newtonian_sliding_keeps_npr_and_film() {
    let mut harness = window(Explorer::with_embedded_models());
    wait(&mut harness, "verification", |app| app.badge() == "Verified");
    let npr = harness.get_by_label("Newtonian plateau ratio NPR");
    assert!(npr.accesskit_node().is_disabled());
    assert!(npr.accesskit_node().description().unwrap().contains("no shear constants"));
    let before = film(&harness);
    slide(&mut harness, "Slide-to-roll ratio SRR", 30.0);
    // Neither the film thickness nor its error changes: no other solve is needed.
    assert_eq!(film(&harness), before);
    assert_eq!(harness.state().badge(), "Verified");
    assert!(harness.state().traction().unwrap() > 0.0);
    // α* p_H is 25 here: without a limiting stress the traction is unphysical, which a warning reports.
    click(&mut harness, "Traction");
    assert!(harness.state().traction().unwrap() < 0.1, "the first look at friction is believable");
    click(&mut harness, "Limiting shear stress");
    assert!(shows(&harness, "isothermal traction without a limiting shear stress is unphysical"));
    wait(&mut harness, "the curve", |app| app.traction_contacts().0 == Some(41));
    assert!(shows(&harness, "unphysical") && shows(&harness, "it is drawn grey"));
    let folder = Scratch::new("traction");
    let table = Table::of(&export(&mut harness, "Traction", "Curve as CSV…", &folder.join("unlimited.csv")));
    assert!(table.column("unphysical").iter().skip(1).all(|mark| *mark == 1.0), "marked in the table too");
    let unlimited = harness.state().traction().unwrap();
    click(&mut harness, "Limiting shear stress");
    assert!(!shows(&harness, "without a limiting shear stress is unphysical"));
    assert_eq!(film(&harness), before);
    let limited = harness.state().traction().unwrap();
    assert!(limited < 0.2 && limited < unlimited, "{limited} of {unlimited}");
    choose(&mut harness, "Against", "plateau ratio");
    assert!(shows(&harness, "there is no plateau ratio to vary"));
}

#[test]
fn lubricant_with_its_contact_is_selected_and_undone() {
    let mut harness = window(Explorer::with_embedded_models());
    wait(&mut harness, "the picture", |app| app.central_film().is_some());
    let (moes, before) = (harness.state().moes(), film(&harness));
    let radius = harness.state().point().radius_m;
    choose(&mut harness, "Fluid", "Squalane with PIP");
    assert_eq!(harness.state().point().radius_m, radius, "the contact stays");
    click(&mut harness, "Use its published contact");
    assert!((harness.state().moes().l / 6.69 - 1.0).abs() < 1e-3, "{:?}", harness.state().moes());
    assert!(harness.state().badge_detail().contains("within") || harness.state().badge() == "Verified");
    slide(&mut harness, "Newtonian plateau ratio NPR", 0.5);
    assert_eq!(harness.state().sliding().1, 0.5);
    choose(&mut harness, "Fluid", "PAO 650");
    assert_eq!(harness.state().sliding().1, 0.0);
    wait(&mut harness, "the full solver", |app| app.badge() == "Outside the trained range" && !app.busy());
    assert!(harness.state().badge_detail().contains("other lubricant laws"));
    let folder = Scratch::new("traction");
    let path = folder.join("pao.ron");
    press(&mut harness, Modifiers::COMMAND, Key::S);
    give_path(&mut harness, &path, "Save");
    let scene = Scene::read(&path).unwrap();
    assert_eq!(scene.lubricant, ehl_explorer::scene::named_lubricant::by_name("pao-650").unwrap().laws);
    for _ in 0..4 {
        undo(&mut harness);
    }
    assert_eq!(harness.state().moes(), moes);
    assert!((film(&harness) / before - 1.0).abs() < 1e-9);
}

#[test]
fn bad_constants_of_a_lubricant_are_refused() {
    let mut harness = squalane();
    let before = film(&harness);
    choose(&mut harness, "Fluid", "Own");
    for (field, bad, said) in [
        ("Critical stress", "0", "critical shear stress is 0"),
        ("Critical stress", "-1", "critical shear stress is -1000000"),
        ("Exponent n_c", "1.4", "power-law exponent n is 1.4"),
        ("Occupied volume R_0", "0.97", "relative volume falls under its occupied volume"),
        ("Bulk modulus K_0", "abc", "is no number"),
        ("NPR value", "1.2", "Newtonian plateau ratio is 1.2"),
        ("NPR value", "-0.1", "Newtonian plateau ratio is -0.1"),
        ("SRR value", "1e9", "slide-to-roll ratio is 10000000"),
    ] {
        enter(&mut harness, field, bad);
        assert!(shows(&harness, said), "no message about {field} {bad}");
        assert_eq!(harness.state().central_film(), Some(before), "{field} {bad}");
    }
    enter(&mut harness, "Critical stress", "0.1");
    assert!(!shows(&harness, "critical shear stress is"));
    wait(&mut harness, "the full solver", |app| app.badge() == "Outside the trained range" && !app.busy());
    assert!(film(&harness) > 1.05 * before, "a lubricant that thins later keeps a thicker film");
    undo(&mut harness);
    // Newton's method has another initial guess now: equal within its tolerance.
    assert!((film(&harness) / before - 1.0).abs() < 1e-6, "{} and {before}", film(&harness));
}

#[test]
fn traction_curve_follows_sliders_and_clicks() {
    let mut harness = squalane();
    click(&mut harness, "Traction");
    wait(&mut harness, "the curve", |app| app.traction_contacts().0 == Some(41));
    slide(&mut harness, "Newtonian plateau ratio NPR", 0.4);
    assert_eq!(harness.state().traction_contacts().0, None, "the former curve is not taken for the present one");
    wait(&mut harness, "the next curve", |app| app.traction_contacts().0 == Some(41));
    click(&mut harness, "Add full solutions");
    wait(&mut harness, "the full solutions", |app| app.traction_contacts().1 == 11 && !app.solving_along());
    assert!(shows(&harness, "full solutions differ by"));
    let folder = Scratch::new("traction");
    let table = export(&mut harness, "Traction", "Curve as CSV…", &folder.join("traction.csv"));
    let table = Table::of(&table);
    // Half of the contacts are where traction increases; with a Newtonian lubricant it would increase without limit.
    assert_eq!(table.column("srr").iter().take(41).filter(|srr| **srr <= 0.05 + 1e-9).count(), 21);
    let newtonian = table.column("newtonian_traction").into_iter().zip(table.column("traction")).skip(1).take(40);
    assert!(newtonian.into_iter().all(|(newtonian, traction)| newtonian > traction));
    let rows = table.rows;
    click(&mut harness, "0–100 %");
    assert_full_beside_reduced(&rows, |_| 1e-4);
    // The same sweep without the window gives the same numbers.
    let mut scene = Scene::read(Path::new("scenes/shear/fig_3_14_line.ron")).unwrap();
    let axis = "Scene(version: 1, title: \"t\", at: Moes(m: 40.0, l: 10.0), study: Sweep(over: \
        [(vary: SlideToRollRatio, values: Graded(from: 0.0, half: 0.05, to: 1.0, n: 41))], methods: [Reduced()]))";
    (scene.study, scene.npr) = (Scene::from_ron(axis).unwrap().study, Some(0.4));
    let outcome = run_scene(&scene, &mut Workbench::new(""), &()).unwrap();
    let headless = Table::of(&outcome.tables[0].to_csv()).column("reduced.traction");
    let curve: Vec<f64> = rows.iter().filter(|row| row[0] == 0.0).map(|row| row[6]).collect();
    assert!(curve.iter().zip(&headless).all(|(a, b)| a.to_bits() == b.abs().to_bits()), "{curve:?} and {headless:?}");
    let figure = export_plot(&mut harness, "Traction", "All plots of Traction", &folder.join("traction.svg"));
    // Traction and central film thickness are solid. Each full solution has a ring for its traction and both film
    // thicknesses, with one in the legend of each plot.
    assert_eq!((solid_curves(&figure), figure.matches("r=\"1.9\" fill=\"none\"").count()), (2, 33 + 2));
    assert!(caption(&figure).contains("first contact is described above"));
    // A press in a plot selects that contact.
    let place = harness.get_by_label("Film along the quantity").rect().center();
    harness.hover_at(place);
    harness.run_steps(1);
    harness.drag_at(place);
    harness.run_steps(1);
    harness.drop_at(place);
    harness.run_steps(3);
    let srr = harness.state().sliding().0;
    assert!((0.3..0.7).contains(&srr), "{srr}");
    assert_eq!(harness.state().traction_contacts(), (Some(41), 11), "along the curve nothing is computed anew");
    slide(&mut harness, "Load number M", 15.0);
    assert!(shows(&harness, "full solutions of another sweep"));
    // Speeds in three units are one sweep.
    choose(&mut harness, "Against", "speed");
    wait(&mut harness, "the curve against speed", |app| app.traction_contacts().0 == Some(41));
    choose(&mut harness, "Against", "Stribeck number");
    assert_eq!(harness.state().traction_contacts().0, Some(41));
    click(&mut harness, "Laws of the fluid");
    for name in ["Viscosity against pressure", "Viscosity against shear stress"] {
        assert!(harness.query_by_label(name).is_some(), "{name}");
    }
    assert!(shows(&harness, "Pressures in this contact reach"));
}

#[test]
fn point_contact_curve_needs_a_model() {
    let (path, folder) = (Path::new("scenes/shear/fig_3_14_point.ron"), Scratch::new("traction"));
    let text = std::fs::read_to_string(path).unwrap();
    // Full solutions are waited for, whatever their grid.
    let coarse = text.replace("Plane(dx: 0.02, dy: 0.05,", "Plane(dx: 0.06, dy: 0.1,");
    assert_ne!(coarse, text);
    let coarse = folder.write("coarse.ron", &coarse);
    let opened = [(Explorer::with_embedded_models(), path), (Explorer::new(None), &coarse)];
    let [with, without] = opened.map(|(mut explorer, path)| {
        explorer.open_scene(path).unwrap();
        let mut harness = window(explorer);
        click(&mut harness, "Traction");
        harness
    });
    let mut harness = with;
    wait(&mut harness, "the curve", |app| app.traction_contacts().0 == Some(41));
    assert!(!shows(&harness, "No curve by the reduced model"));
    let mut harness = without;
    assert!(shows(&harness, "No curve by the reduced model"));
    wait(&mut harness, "full solutions that nobody asked for", |app| app.traction_contacts().1 > 0);
    // They end when the contact changes.
    slide(&mut harness, "Load number M", 30.0);
    wait(&mut harness, "those of the next contact", |app| app.busy() || app.traction_contacts().1 > 0);
}

#[test]
fn curve_of_an_untrained_fluid_is_marked() {
    let mut explorer = Explorer::with_embedded_models();
    // PAO 650's point contact; the model was trained with squalane with polyisoprene.
    explorer.open_scene(Path::new("scenes/shear/fig_3_16.ron")).unwrap();
    let mut harness = window(explorer);
    click(&mut harness, "Traction");
    wait(&mut harness, "the curve", |app| app.traction_contacts().0 == Some(41));
    let said = "it is outside the trained range: the model was trained with other lubricant laws";
    assert!(shows(&harness, said) && shows(&harness, "there is no error bound"));
    // Full solutions check it automatically.
    wait(&mut harness, "the full solutions", |app| app.traction_contacts().1 == 11 && !app.solving_along());
    assert!(shows(&harness, "full solutions differ by"));
    let folder = Scratch::new("traction");
    let table = export(&mut harness, "Traction", "Curve as CSV…", &folder.join("sketch.csv"));
    assert!(table.contains("there is no error bound"));
    let rows = Table::of(&table).rows;
    assert_full_beside_reduced(&rows, |traction| 1e-2 * traction);
    let figure = export_plot(&mut harness, "Traction", "All plots of Traction", &folder.join("sketch.svg"));
    assert_eq!(solid_curves(&figure), 0, "no line is firm");
    assert!(caption(&figure).contains("outside the trained range of the reduced model"));
    // Pictures are full solutions nevertheless.
    wait(&mut harness, "the full solver", |app| app.badge() == "Outside the trained range" && !app.busy());
    // The model's lubricant brings solid lines back; its plateau ratio is one of the range.
    choose(&mut harness, "Fluid", "Squalane with PIP");
    click(&mut harness, "Use its published contact");
    wait(&mut harness, "the curve of its own fluid", |app| app.traction_contacts().0 == Some(41));
    assert!(!shows(&harness, "curve is a sketch"));
}

#[test]
fn sketch_follows_own_constants_and_newtonian_fluids() {
    let mut harness = squalane();
    click(&mut harness, "Traction");
    choose(&mut harness, "Fluid", "Own");
    enter(&mut harness, "Critical stress", "0.02");
    wait(&mut harness, "the curve of one's own", |app| app.traction_contacts().0 == Some(41));
    assert!(shows(&harness, "curve is a sketch"));
    // A plateau ratio below all trained ones belongs to the lubricant: the sweep extends down to it.
    enter(&mut harness, "NPR value", "0.1");
    choose(&mut harness, "Against", "plateau ratio");
    wait(&mut harness, "the curve against NPR", |app| app.traction_contacts().0 == Some(41));
    let folder = Scratch::new("traction");
    let table = export(&mut harness, "Traction", "Curve as CSV…", &folder.join("plateau.csv"));
    let rows = Table::of(&table).rows;
    assert!((rows[0][2] - 0.1).abs() < 1e-9 && (rows[40][2] - 1.0).abs() < 1e-9, "{:?}", rows[0]);
    choose(&mut harness, "Against", "slide-to-roll ratio");
    choose(&mut harness, "Fluid", "Barus oil, compressible");
    enter(&mut harness, "L value", "5");
    wait(&mut harness, "the curve of a Newtonian fluid", |app| app.traction_contacts().0 == Some(41));
    assert!(shows(&harness, "curve is a sketch"));
    // There is no curve for shapes of pressure and film outside the trained ones.
    enter(&mut harness, "M value", "1");
    assert!(shows(&harness, "No curve by the reduced model: M = 1 lies outside"));
}

#[test]
fn contacts_outside_a_sketch_are_left_out_with_reason() {
    let mut harness = window(Explorer::with_embedded_models());
    click(&mut harness, "Traction");
    wait(&mut harness, "the curve", |app| app.traction_contacts().0 == Some(41));
    // Barus' viscosity at a pressure of 25/α* is far outside the trained range.
    choose(&mut harness, "Fluid", "Barus oil");
    slide(&mut harness, "Load number M", 20.0);
    slide(&mut harness, "Lubricant number L", 12.0);
    wait(&mut harness, "a sketch with gaps", |app| app.traction_contacts().0.is_some_and(|contacts| contacts < 41));
    let left_out = 41 - harness.state().traction_contacts().0.unwrap();
    assert!(shows(&harness, &format!("did not converge at {left_out} contacts, which are left out")));
}

#[test]
fn shear_across_the_film_is_shown_on_request() {
    let mut harness = squalane();
    click(&mut harness, "Profiles");
    assert!(harness.query_by_label("Shear across the film").is_none());
    choose(&mut harness, "Across the film", "shear stress");
    assert!(harness.query_by_label("Shear across the film").is_some());
    choose(&mut harness, "Across the film", "shear rate");
    assert!(shows(&harness, "1/s"));
}
