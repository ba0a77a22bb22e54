//! Random changes of everything: the picture belongs to the request or is grey, typed values stay, and nothing moves
//! under the pointer while a field is edited or work runs.

use crate::common::cases::cases;
use crate::driver::{CONTROLS, TABS, Window, press, undo, write};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect};
use egui_kittest::kittest::{By, NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use ehl_explorer::solver::parameters::Quantity;
use fastrand::Rng;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::time::Duration;

const SLIDERS: [(&str, f64, f64); 5] = [
    ("Load number M", 3.0, 400.0),
    ("Lubricant number L", 2.0, 18.0),
    ("Ratio of radii R_y/R", 0.1, 40.0),
    ("Slide-to-roll ratio SRR", 0.1, 150.0),
    ("Newtonian plateau ratio NPR", 0.1, 1.0),
];
/// Controls that can be clicked in any tab.
const VIEWS: [&str; 15] = [
    "0–10 %",
    "0–100 %",
    "Log",
    "Film map",
    "Pressure map",
    "Interferogram",
    "Full solution",
    "Error contributions",
    "Failure map",
    "Bound vs. true error",
    "Along the trajectory",
    "Newton residuals",
    "Film over time",
    "Pressure over time",
    "Run the study",
];
/// Sliders of transient contacts.
const IN_TIME: [(&str, f64, f64); 4] = [
    ("Load amplitude", 0.02, 0.3),
    ("Load period", 2.0, 8.0),
    ("Number of operating points", 6.0, 60.0),
    ("Time T", 0.1, 8.0),
];
const FLUIDS: [&str; 4] = ["Mineral oil", "Roelands oil", "Squalane with PIP", "Barus oil, compressible"];
const KINDS: [&str; 3] = ["Roller", "Ball", "Ellipse"];
/// Values that a gesture may have changed.
#[derive(PartialEq)]
enum Touched {
    Nothing,
    Typed(Quantity),
    /// Undo and redo restore previous values.
    All,
}

fn one<'a, T>(rng: &mut Rng, all: &'a [T]) -> &'a T {
    &all[rng.usize(..all.len())]
}

/// Clicks the first enabled control with this name, if there is one.
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

/// Sets one of some sliders to a value between its ends, if it is visible.
fn slide(rng: &mut Rng, window: &mut Window, sliders: &[(&str, f64, f64)]) {
    let (name, from, to) = *one(rng, sliders);
    let value = from * f64::powf(to / from, rng.f64());
    let node = window.query_by_role_and_label(Role::Slider, name);
    if let Some(node) = node.filter(|node| !node.accesskit_node().is_disabled()) {
        node.set_value_accesskit(value);
        window.step();
    }
}

/// Selects one of some options of a combo box, if it is visible.
fn choose(rng: &mut Rng, window: &mut Window, picker: &str, options: &[&str]) {
    let Some(node) = window.query_by_role_and_label(Role::ComboBox, picker) else { return };
    node.click();
    window.run_steps(2);
    let option = *one(rng, options);
    // The list is open if the box is visible.
    if let Some(node) = window.query_all_by_label(option).last() {
        node.click();
        window.step();
    }
}

/// Makes one random gesture.
fn gesture(rng: &mut Rng, window: &mut Window, moved: &mut BTreeMap<String, String>) -> Touched {
    match rng.u8(..28) {
        0..=8 => slide(rng, window, &SLIDERS),
        24 | 25 => {
            slide(rng, window, &IN_TIME);
            // The effect of a tab's change is visible in the next frame.
            window.step();
        }
        26 => choose(rng, window, "Deformation", &["exact", "through its basis"]),
        9..=11 => {
            let (quantity, field) = *one(rng, &Explorer::fields());
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
            let (_, field) = *one(rng, &Explorer::fields());
            let verb = *one(rng, &["Hold", "Free"]);
            click_if_there(window, Some(Role::Button), &format!("{verb} {field}"));
        }
        14 => choose(rng, window, "Fluid", &FLUIDS),
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
        22 | 27 => {
            let view = *one(rng, &VIEWS);
            click_if_there(window, None, view);
        }
        _ => press(window, Modifiers::COMMAND, Key::D),
    }
    Touched::Nothing
}

/// Returns the positions of all controls, without those that occur twice.
fn layout(window: &Window) -> HashMap<(Role, String), Rect> {
    let mut all: HashMap<(Role, String), Option<Rect>> = HashMap::new();
    for node in window.query_all(By::new().predicate(|node| CONTROLS.contains(&node.role()))) {
        let Some(name) = node.accesskit_node().label() else { continue };
        let role = node.accesskit_node().role();
        all.entry((role, name)).and_modify(|rect| *rect = None).or_insert(Some(node.rect()));
    }
    all.into_iter().filter_map(|(key, rect)| Some((key, rect?))).collect()
}

/// Records controls that moved, and when.
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

/// Asserts that every curve belongs to the request on the screen, or is grey.
fn assert_nothing_stale(window: &Window, step: usize) {
    let app = window.state();
    for (name, present, grey) in app.drawn() {
        let front = app.front().unwrap_or_default();
        assert!(grey || present, "step {step}, {front}: the {name} is none of {:?}, and not grey", app.point());
    }
}

fn held(window: &Window) -> Vec<(Quantity, f64)> {
    let app = window.state();
    app.held().filter_map(|quantity| Some((quantity, quantity.of(&app.point())?))).collect()
}

/// Asserts that held values are unchanged, unless they were typed.
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
fn random_changes_show_nothing_stale_and_keep_held_values() {
    let steps = cases(180, 10_000);
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut window = crate::driver::window(explorer, [1280.0, 1000.0]);
    window.run_steps(5);
    let (mut rng, mut seen, mut greyed, mut locked) = (Rng::with_seed(15), 0, 0, 0);
    let (mut moved, mut drawn) = (BTreeMap::new(), BTreeSet::new());
    for step in 0..steps {
        let before = held(&window);
        let touched = gesture(&mut rng, &mut window, &mut moved);
        assert_nothing_stale(&window, step);
        assert_held(&before, &window, &touched, step);
        // Changes of layout by the gesture are complete after a frame; work that runs and ends moves nothing.
        window.step();
        let layout = layout(&window);
        let frames = if rng.u8(..10) == 0 { 12 } else { 1 };
        for _ in 0..frames {
            std::thread::sleep(Duration::from_millis(if frames > 1 { 4 } else { 0 }));
            window.step();
            assert_nothing_stale(&window, step);
            drawn.extend(window.state().drawn().map(|(name, ..)| name));
        }
        note_moved(&layout, &window, "while work ran", &mut moved);
        seen += window.state().drawn().count();
        greyed += window.state().drawn().filter(|(.., grey)| *grey).count();
        locked += before.len();
    }
    println!("{steps} steps, {seen} curves, {greyed} of them grey, {locked} held values: {drawn:?}");
    assert!(moved.is_empty(), "{moved:#?}");
    assert!(seen > steps && greyed > 0 && locked > steps / 4);
    // When idle, everything belongs to the present request, except results that the user requested.
    let rests = |app: &Explorer| !(app.busy() || app.marching() || app.studying() || app.running_study());
    crate::driver::wait(&mut window, "rest", |app| rests(app) && app.central_film().is_some());
    let by_hand = ["full solutions", "full solution", "results of a study"];
    let former: Vec<_> = window.state().drawn().filter(|(name, _, grey)| *grey && !by_hand.contains(name)).collect();
    assert!(former.is_empty(), "{former:?}");
}
