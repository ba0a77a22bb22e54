//! Engineering inputs: typed values stay, units are accepted, lubricants and bodies define the contact.

use crate::driver::{Window, choose, click, press, set, shows, wait, write};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use ehl_explorer::scene::named_lubricant::MINERAL_OIL;
use ehl_explorer::solver::discrete::grid::GridSpec;
use ehl_explorer::solver::full::{ContactSolver, Problem, Start};
use ehl_explorer::solver::parameters::Quantity;
use ehl_explorer::solver::physics::bodies::Material;
use ehl_explorer::solver::physics::contact::reduced_modulus;

fn window() -> Window {
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, 1400.0]);
    wait(&mut harness, "the first picture", |app| app.central_film().is_some());
    harness
}

fn enter(harness: &mut Window, field: &str, text: &str) {
    write(harness, field, text);
    press(harness, Modifiers::NONE, Key::Enter);
}

#[test]
fn roller_with_oil_grade_equals_the_command_line() {
    let mut harness = window();
    enter(&mut harness, "Radius R", "12 mm");
    enter(&mut harness, "Speed u_m", "3 m/s");
    choose(&mut harness, "Oil", "ISO VG 68");
    enter(&mut harness, "Oil temperature", "60 °C");
    enter(&mut harness, "Load w", "300 N/mm");
    enter(&mut harness, "SRR value", "5 %");
    let point = harness.state().point();
    for (quantity, value, within) in [
        (Quantity::Radius, 0.012, 1e-12),
        (Quantity::Speed, 3.0, 1e-12),
        (Quantity::Load, 3e5, 1e-12),
        (Quantity::Viscosity, 0.0242, 0.01),
        (Quantity::Alpha, 19.35e-9, 0.01),
        (Quantity::SlideToRollRatio, 0.05, 1e-12),
    ] {
        let entered = quantity.of(&point).unwrap();
        assert!((entered / value - 1.0).abs() < within, "{}: {entered}", quantity.name());
    }
    wait(&mut harness, "a verified picture", |app| app.central_film().is_some() && !app.busy());
    // Without the window: the same contact and lubricant on the grid of `solve`.
    let mut solver = ContactSolver::on(&GridSpec::EXPLORER.build().unwrap());
    let headless = solver.solve(&point, MINERAL_OIL, Start::Cold, &()).unwrap();
    let film = harness.state().central_film().unwrap();
    let wanted = headless.scalars.h_c;
    assert!((film / wanted - 1.0).abs() < 2e-3, "{film} against {wanted}");
    let traction = harness.state().traction().unwrap();
    assert!((traction / headless.traction_coefficient() - 1.0).abs() < 2e-2, "{traction}");
    assert!((0.02..0.1).contains(&traction), "friction at first sight is believable: {traction}");
}

#[test]
fn typed_values_stay_while_sliders_move() {
    let mut harness = window();
    enter(&mut harness, "Radius R", "12");
    enter(&mut harness, "Load w", "300 N/mm");
    let before = harness.state().point();
    set(&mut harness, Role::Slider, "Load number M", 60.0);
    let after = harness.state().point();
    assert!((harness.state().moes().m / 60.0 - 1.0).abs() < 1e-9);
    assert_eq!((after.radius_m, after.load), (before.radius_m, before.load));
    assert_ne!(after.speed_m_per_s, before.speed_m_per_s);
    for field in ["Speed u_m", "Coefficient α"] {
        click(&mut harness, &format!("Hold {field}"));
    }
    set(&mut harness, Role::Slider, "Load number M", 80.0);
    assert!((harness.state().moes().m / 60.0 - 1.0).abs() < 1e-9, "nothing is left to give way");
    assert!(shows(&harness, "M cannot change"));
    click(&mut harness, "Free Load w");
    set(&mut harness, Role::Slider, "Load number M", 80.0);
    assert!((harness.state().moes().m / 80.0 - 1.0).abs() < 1e-9);
    // Neither the contact kind nor a lubricant changes them.
    let held = harness.state().point();
    click(&mut harness, "Ball");
    choose(&mut harness, "Fluid", "Barus oil");
    let point = harness.state().point();
    assert_eq!(
        (point.radius_m, point.speed_m_per_s, point.alpha_per_pa),
        (held.radius_m, held.speed_m_per_s, held.alpha_per_pa)
    );
}

#[test]
fn a_rejected_text_stays_with_its_reason_and_moves_nothing() {
    let mut harness = window();
    let before = harness.state().point();
    let place = |harness: &Window| harness.get_by_label_contains("Hertz pressure").rect();
    let there = place(&harness);
    for (text, said) in
        [("12 mPa·s", "is no unit of a load per length"), ("thick", "is no number"), ("1e30", "are accepted")]
    {
        enter(&mut harness, "Load w", text);
        assert!(shows(&harness, said), "{text}");
        assert_eq!((harness.state().point(), place(&harness)), (before, there), "{text}");
    }
    harness.get_by_role_and_label(Role::TextInput, "Load w").focus();
    harness.run_steps(2);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(!shows(&harness, "are accepted"));
}

#[test]
fn two_bodies_give_the_contact_and_say_when_they_no_longer_do() {
    let mut harness = window();
    click(&mut harness, "Two bodies");
    enter(&mut harness, "Radius of body 1", "10 mm");
    enter(&mut harness, "Radius of body 2", "-50 mm");
    enter(&mut harness, "Speed of body 1", "1500 rpm");
    click(&mut harness, "Surfaces");
    enter(&mut harness, "Roughness of body 1", "0.2");
    let point = harness.state().point();
    assert!((point.radius_m - 0.0125).abs() < 1e-12, "{}", point.radius_m);
    assert!(shows(&harness, "λ"));
    enter(&mut harness, "Radius of body 2", "-5 mm");
    assert!(shows(&harness, "concave surface must be flatter"));
    assert_eq!(harness.state().point(), point);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    enter(&mut harness, "Radius R", "9 mm");
    assert!(shows(&harness, "no longer match these bodies"));
    click(&mut harness, "Use the bodies’ values");
    assert!((harness.state().point().radius_m - 0.0125).abs() < 1e-12);
}

#[test]
fn a_glass_disc_that_is_entered_as_body_1_is_body_1_with_heat() {
    let mut harness = window();
    click(&mut harness, "Two bodies");
    choose(&mut harness, "Material of body 1", "Glass");
    enter(&mut harness, "Speed of body 1", "0.5");
    enter(&mut harness, "Speed of body 2", "1.5");
    click(&mut harness, "Heat");
    harness.run_steps(2);
    let (point, laws) = (harness.state().point(), harness.state().lubricant());
    let heat = Problem::new(&point, laws).unwrap().heat.unwrap();
    assert_eq!(heat.heat.bodies, [Material::GLASS.heat, Material::STEEL.heat]);
    for (own, entered) in heat.speeds.into_iter().zip([0.5, 1.5]) {
        assert!((own * point.speed_m_per_s - entered).abs() < 1e-12, "{own}");
    }
    // A material selected at Heat is that of the body.
    choose(&mut harness, "Body 2", "Glass");
    let glass = reduced_modulus(81e9, 0.21, 81e9, 0.21).unwrap();
    assert!((harness.state().point().modulus_pa / glass - 1.0).abs() < 1e-12);
}
