//! A hand that changes everything at random: what is drawn belongs to what is asked or is grey, what was typed stays,
//! and nothing moves under the pointer while a field is edited or work runs.

use crate::driver::{Window, press, undo, write};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use ehl_explorer::solver::physics::contact::Quantity;
use fastrand::Rng;
use std::collections::{BTreeMap, HashMap};
use std::time::Duration;

const SLIDERS: [(&str, f64, f64); 4] = [
    ("Load number M", 3.0, 400.0),
    ("Lubricant number L", 2.0, 18.0),
    ("Slide-to-roll ratio SRR", 1e-3, 1.5),
    ("Newtonian plateau ratio NPR", 0.1, 1.0),
];
const FIELDS: [(Quantity, &str); 6] = [
    (Quantity::Radius, "Radius R"),
    (Quantity::Speed, "Speed u_m"),
    (Quantity::Load, "Load w"),
    (Quantity::Modulus, "Modulus E'"),
    (Quantity::Viscosity, "Viscosity η₀"),
    (Quantity::Alpha, "Coefficient α"),
];
const TABS: [&str; 5] = ["Profiles", "Contact map", "Regimes", "Traction", "Reduced basis"];
const FLUIDS: [&str; 4] = ["Mineral oil", "Roelands oil", "Squalane with PIP", "Barus oil, compressible"];
const KINDS: [&str; 2] = ["Line contact", "Point contact"];
/// What a hand can be laid on.
const CONTROLS: [Role; 7] =
    [Role::Button, Role::Slider, Role::SpinButton, Role::CheckBox, Role::RadioButton, Role::ComboBox, Role::TextInput];

/// What a gesture may have changed of what is held.
#[derive(PartialEq)]
enum Touched {
    Nothing,
    Typed(Quantity),
    /// Undo and redo bring former values back.
    All,
}

fn one<'a, T>(rng: &mut Rng, all: &'a [T]) -> &'a T {
    &all[rng.usize(..all.len())]
}

/// Clicks the first of what bears a name, if there is one that can be clicked.
fn click_if_there(window: &mut Window, role: Option<Role>, name: &str) {
    let there = match role {
        Some(role) => window.query_all_by_role_and_label(role, name).next(),
        None => window.query_all_by_label(name).next(),
    };
    if let Some(node) = there.filter(|node| !node.accesskit_node().is_disabled()) {
        node.click();
        window.step();
    }
}

/// One gesture.
fn gesture(rng: &mut Rng, window: &mut Window, moved: &mut BTreeMap<String, String>) -> Touched {
    match rng.u8(..24) {
        0..=8 => {
            let (name, from, to) = *one(rng, &SLIDERS);
            let value = from * f64::powf(to / from, rng.f64());
            let node = window.get_by_role_and_label(Role::Slider, name);
            if !node.accesskit_node().is_disabled() {
                node.set_value_accesskit(value);
                window.step();
            }
        }
        9..=11 => {
            let (quantity, field) = *one(rng, &FIELDS);
            let present = window.query_by_role_and_label(Role::TextInput, field).and_then(|node| node.value());
            let Some(present) = present.and_then(|text| text.replace('−', "-").parse::<f64>().ok()) else {
                return Touched::Nothing;
            };
            let typed = if rng.u8(..5) == 0 {
                "nonsense".to_owned()
            } else {
                format!("{:.3e}", present * (0.7 + 0.8 * rng.f64()))
            };
            let before = layout(window);
            write(window, field, &typed);
            note_moved(&before, window, "while it was typed", moved);
            window.key_press(*one(rng, &[Key::Enter, Key::Enter, Key::Escape]));
            window.step();
            note_moved(&before, window, "as what was typed was taken", moved);
            return Touched::Typed(quantity);
        }
        12 | 13 => {
            let (_, field) = *one(rng, &FIELDS);
            let verb = *one(rng, &["Hold", "Free"]);
            click_if_there(window, Some(Role::Button), &format!("{verb} {field}"));
        }
        14 => {
            window.get_by_role_and_label(Role::ComboBox, "Fluid").click();
            window.run_steps(2);
            let fluid = *one(rng, &FLUIDS);
            window.query_all_by_label(fluid).last().expect("the list is open").click();
            window.step();
        }
        15 => {
            let kind = *one(rng, &KINDS);
            click_if_there(window, None, kind);
        }
        16..=19 => {
            let tab = *one(rng, &TABS);
            click_if_there(window, None, tab);
        }
        20 => {
            undo(window);
            return Touched::All;
        }
        21 => {
            press(window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
            return Touched::All;
        }
        22 => {
            let view =
                *one(rng, &["0–10 %", "0–100 %", "Log", "Film map", "Pressure map", "Interferogram", "Full solution"]);
            click_if_there(window, None, view);
        }
        _ => press(window, Modifiers::COMMAND, Key::D),
    }
    Touched::Nothing
}

/// Where everything is that a hand can be laid on; what is there twice is left out.
fn layout(window: &Window) -> HashMap<(Role, String), Rect> {
    let mut all: HashMap<(Role, String), Option<Rect>> = HashMap::new();
    for role in CONTROLS {
        for node in window.query_all_by_role(role) {
            let Some(name) = node.accesskit_node().label() else { continue };
            all.entry((role, name)).and_modify(|rect| *rect = None).or_insert(Some(node.rect()));
        }
    }
    all.into_iter().filter_map(|(key, rect)| Some((key, rect?))).collect()
}

/// Notes what moved from where it was, and when.
fn note_moved(
    before: &HashMap<(Role, String), Rect>,
    window: &Window,
    when: &str,
    moved: &mut BTreeMap<String, String>,
) {
    let now = layout(window);
    for (key, rect) in before {
        let Some(there) = now.get(key) else { continue };
        if (there.min - rect.min).length() + (there.max - rect.max).length() > 1.0 {
            let tab = window.state().front().unwrap_or_default();
            moved.entry(format!("{key:?} in {tab} {when}")).or_insert(format!("from {rect:?} to {there:?}"));
        }
    }
}

/// Every curve belongs to the contact on the screen, or it is grey.
fn assert_nothing_stale(window: &Window, step: usize) {
    let app = window.state();
    for (name, point, lubricant, grey) in app.drawn() {
        let present = point == app.point() && lubricant == app.lubricant();
        assert!(grey || present, "step {step}: the {name} of {point:?} is drawn for {:?}", app.point());
    }
}

fn held(window: &Window) -> Vec<(Quantity, f64)> {
    let app = window.state();
    app.held().filter_map(|quantity| Some((quantity, quantity.of(&app.point())?))).collect()
}

/// What is held now and was before has the value that it had, unless it was typed itself.
fn assert_held(before: &[(Quantity, f64)], window: &Window, touched: &Touched, step: usize) {
    let after = held(window);
    for (quantity, value) in before {
        let typed = *touched == Touched::All || *touched == Touched::Typed(*quantity);
        if let Some((_, now)) = after.iter().find(|(other, _)| other == quantity).filter(|_| !typed) {
            assert_eq!(now, value, "step {step}: {} was held", quantity.name());
        }
    }
}

#[test]
fn a_hand_that_changes_everything_sees_nothing_stale_loses_nothing_held_and_moves_nothing() {
    let steps = if std::env::var_os("EHL_LONG").is_some() { 10_000 } else { 300 };
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut window = crate::driver::window(explorer, [1280.0, 1000.0]);
    window.run_steps(5);
    let (mut rng, mut seen, mut greyed, mut locked) = (Rng::with_seed(15), 0, 0, 0);
    let mut moved = BTreeMap::new();
    for step in 0..steps {
        let before = held(&window);
        let touched = gesture(&mut rng, &mut window, &mut moved);
        assert_nothing_stale(&window, step);
        assert_held(&before, &window, &touched, step);
        // What the gesture brought has its place after a frame; work that runs and ends moves nothing.
        window.step();
        let layout = layout(&window);
        let frames = if rng.u8(..10) == 0 { 12 } else { 1 };
        for _ in 0..frames {
            std::thread::sleep(Duration::from_millis(if frames > 1 { 4 } else { 0 }));
            window.step();
            assert_nothing_stale(&window, step);
        }
        note_moved(&layout, &window, "while work ran", &mut moved);
        let drawn: Vec<bool> = window.state().drawn().map(|(.., grey)| grey).collect();
        seen += drawn.len();
        greyed += drawn.into_iter().filter(|grey| *grey).count();
        locked += before.len();
    }
    println!("{steps} steps, {seen} curves, {greyed} of them grey, {locked} held values");
    assert!(moved.is_empty(), "{moved:#?}");
    assert!(seen > steps && greyed > 0 && locked > steps / 4);
    // At rest everything is of the present contact.
    crate::driver::wait(&mut window, "rest", |app| !app.busy() && app.central_film().is_some());
    assert!(
        window.state().drawn().all(|(name, .., grey)| !grey || name == "full solutions" || name == "full solution")
    );
}
