//! Elliptical contacts in the window: selection of the shape, slider of the radii, map with its true shape, bodies with
//! a groove, formulas.

use crate::common::scratch::Scratch;
use crate::driver::{Window, choose, click, export, press, set, shows, undo, wait, write};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use ehl_explorer::solver::parameters::Quantity;
use ehl_explorer::solver::physics::contact::OperatingPoint;

const RATIO: &str = "Ratio of radii R_y/R";

/// An ellipse on a grid on which a full solve takes a fraction of a second.
const ELLIPSE: &str = "Scene(version: 1, title: \"An ellipse\", contact: Point, at: Moes(m: 40.0, l: 10.0, radius_y: 0.03), \
    grid: Plane(dx: 0.06, dy: 0.13, domain: (-4.0, 2.0, -2.0)), study: Point(methods: [Full]))";

/// A window on an ellipse, solved on a coarse grid.
fn ellipse() -> Window {
    let folder = Scratch::new("an-ellipse");
    let mut explorer = Explorer::new(None).without_system_dialogs();
    explorer.open_scene(&folder.write("ellipse.ron", ELLIPSE)).unwrap();
    let mut harness = crate::driver::window(explorer, [1280.0, 1500.0]);
    solved(&mut harness);
    harness
}

fn solved(harness: &mut Window) {
    wait(harness, "the ellipse", |app| app.central_film().is_some() && !app.busy() && app.badge() != "Quick grid");
    harness.run();
}

fn enter(harness: &mut Window, field: &str, text: &str) {
    write(harness, field, text);
    press(harness, Modifiers::NONE, Key::Enter);
}

/// Returns the text about the map.
fn spoken(harness: &Window) -> String {
    harness.get_by_label("Map of the contact").accesskit_node().description().unwrap_or_default()
}

#[test]
fn ellipse_slider_keeps_m_and_l_and_updates_the_map() {
    let mut harness = ellipse();
    let (before, moes, film) = (harness.state().point(), harness.state().moes(), harness.state().central_film());
    assert!((before.radius_ratio() - 3.0).abs() < 1e-12);
    click(&mut harness, "Contact map");
    assert!(spoken(&harness).contains("R_y/R 3"), "{}", spoken(&harness));
    for ratio in [1.0, 0.4, 12.0] {
        set(&mut harness, Role::Slider, RATIO, ratio);
        let after = harness.state().point();
        assert!((after.radius_ratio() / ratio - 1.0).abs() < 1e-9, "{}", after.radius_ratio());
        assert_eq!(OperatingPoint { radius_y_m: before.radius_y_m, ..after }, before, "all else stays");
        // Until it is solved, the previous picture is grey and marked.
        assert!(harness.state().central_film().is_none() && shows(&harness, "Grey: the picture belongs to"));
        solved(&mut harness);
        assert!(spoken(&harness).contains(&format!("R_y/R {ratio}")), "{}", spoken(&harness));
    }
    let moved = harness.state().moes();
    assert!((moved.m / moes.m - 1.0).abs() < 1e-12 && (moved.l / moes.l - 1.0).abs() < 1e-12);
    assert!(harness.state().central_film() > film, "less oil leaves a wide contact at its sides");
    undo(&mut harness);
    assert!((harness.state().point().radius_ratio() - 0.4).abs() < 1e-9);
}

#[test]
fn a_typed_radius_across_stays_and_comes_back_with_the_ellipse() {
    let mut harness = ellipse();
    enter(&mut harness, "Across R_y", "25 mm");
    assert!(harness.state().held().any(|quantity| quantity == Quantity::RadiusY));
    set(&mut harness, Role::Slider, RATIO, 8.0);
    assert_eq!(harness.state().point().radius_y_m, Some(0.025));
    assert!(shows(&harness, "R_y is held"));
    for shape in ["Roller", "Ball"] {
        click(&mut harness, shape);
        assert_eq!(harness.state().point().radius_y_m, None, "{shape}");
        assert!(!harness.state().held().any(|quantity| quantity == Quantity::RadiusY), "{shape}");
    }
    click(&mut harness, "Ellipse");
    assert_eq!(harness.state().point().radius_y_m, Some(0.025));
    enter(&mut harness, "Across R_y", "26 mm");
    click(&mut harness, "Free Across R_y");
    set(&mut harness, Role::Slider, RATIO, 8.0);
    assert!((harness.state().point().radius_ratio() - 8.0).abs() < 1e-9);
    // A second radius turns a circular contact into an elliptical one, and nothing moves under the pointer.
    click(&mut harness, "Ball");
    let there = harness.get_by_role_and_label(Role::TextInput, "Load w").rect();
    enter(&mut harness, "Across R_y", "4 mm");
    assert_eq!(harness.state().point().radius_y_m, Some(0.004));
    assert_eq!(harness.get_by_role_and_label(Role::TextInput, "Load w").rect(), there);
    for (text, said) in [("-4 mm", "are accepted"), ("1 km", "R_y/R"), ("thin", "is no number")] {
        enter(&mut harness, "Across R_y", text);
        assert!(shows(&harness, said), "{text}");
        press(&mut harness, Modifiers::NONE, Key::Escape);
        assert_eq!(harness.state().point().radius_y_m, Some(0.004), "{text}");
    }
}

#[test]
fn two_bodies_with_a_groove_are_an_ellipse() {
    let mut harness = crate::driver::window(Explorer::new(None).without_system_dialogs(), [1280.0, 1400.0]);
    click(&mut harness, "Ball");
    click(&mut harness, "Two bodies");
    enter(&mut harness, "Radius of body 1", "4.7625 mm");
    enter(&mut harness, "Radius of body 2", "18.2 mm");
    assert_eq!(harness.state().point().radius_y_m, None, "as round across as along");
    enter(&mut harness, "Radius across of body 2", "-5 mm");
    let point = harness.state().point();
    assert!((point.radius_m - 3.7747e-3).abs() < 1e-6, "{}", point.radius_m);
    assert!((Quantity::RadiusY.of(&point).unwrap() - 0.10026).abs() < 1e-4, "{:?}", point.radius_y_m);
    enter(&mut harness, "Radius across of body 2", "-4 mm");
    assert!(shows(&harness, "cross the rolling direction the radii of 0.0047625 m and -0.004 m"));
    assert_eq!(harness.state().point(), point);
}

#[test]
fn tables_have_both_semi_axes_and_formulas_say_where_they_end() {
    let mut harness = ellipse();
    let point = harness.state().point();
    let hertz = point.hertz();
    click(&mut harness, "Contact map");
    let folder = Scratch::new("ellipse");
    let table = export(&mut harness, "Contact map", "Map as CSV…", &folder.join("map.csv"));
    assert!(table.lines().next().unwrap().contains("; R_y "), "{:?}", table.lines().next());
    let last: Vec<f64> = table.lines().last().unwrap().split(',').map(|value| value.parse().unwrap()).collect();
    assert!((last[4] / (last[0] * hertz.half_width_m) - 1.0).abs() < 1e-12);
    assert!((last[5] / (last[1] * hertz.half_length_m) - 1.0).abs() < 1e-12);
    click(&mut harness, "Profiles");
    let across = export(&mut harness, "Profiles", "Profile across as CSV…", &folder.join("across.csv"));
    let last: Vec<f64> = across.lines().last().unwrap().split(',').map(|value| value.parse().unwrap()).collect();
    assert!((last[3] / (last[0] * hertz.half_length_m) - 1.0).abs() < 1e-12);
    click(&mut harness, "Regimes");
    for formula in ["Nijenbanning–Venner–Moes", "Chittenden, central", "Hamrock–Dowson, minimum"] {
        assert!(shows(&harness, formula), "{formula}");
    }
    assert!(!shows(&harness, "15–75 % too high"));
    set(&mut harness, Role::Slider, RATIO, 0.5);
    assert!(shows(&harness, "15–75 % too high"));
}

#[test]
fn traction_is_drawn_against_the_ratio_of_radii() {
    let mut harness = ellipse();
    set(&mut harness, Role::Slider, "Slide-to-roll ratio SRR", 10.0);
    click(&mut harness, "Traction");
    choose(&mut harness, "Against", "ratio of radii");
    wait(&mut harness, "full solutions", |app| app.traction_contacts().1 == 11 && !app.solving_along());
    click(&mut harness, "Roller");
    assert!(shows(&harness, "A roller has no radius across"));
}

#[test]
fn ellipse_model_is_read_on_demand() {
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, 1200.0]);
    click(&mut harness, "Ellipse");
    // Full solutions substitute until the model is available; no frame waits.
    wait(&mut harness, "the model of ellipses", |app| {
        let judged = ["Reduced model", "Verified", "Roughly right"].contains(&app.badge().as_str());
        judged && !app.badge_detail().contains("full solution on")
    });
    for ratio in [0.6, 1.7, 3.0] {
        set(&mut harness, Role::Slider, RATIO, ratio);
        assert!(harness.state().central_film().is_some(), "the picture follows in the frame");
    }
    set(&mut harness, Role::Slider, RATIO, 20.0);
    // While a slider is dragged, the grid is as coarse as for other contacts, and the badge reports it.
    wait(&mut harness, "a full solution", |app| app.central_film().is_some());
    let told = |app: &Explorer| (app.badge(), app.badge_detail().contains("on a quick grid"));
    assert_eq!(told(harness.state()), ("Outside the trained range".to_owned(), true));
    let detail = harness.state().badge_detail();
    assert!(
        detail.starts_with("sketch on a quick grid, error of {H_c} about ") && detail.contains("of {H_min} "),
        "{detail}"
    );
    assert!(detail.contains("lies outside the trained range 0.02…0.6"), "{detail}");
    wait(&mut harness, "the chosen grid", |app| !app.busy());
    assert_eq!(told(harness.state()), ("Outside the trained range".to_owned(), false));
}
