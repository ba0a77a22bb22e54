//! What a screen reader is told, and where the Tab key leads.

use crate::driver::{Window, click, press, wait};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;

const TABS: [&str; 10] = [
    "Profiles",
    "Contact map",
    "Regimes",
    "Traction",
    "Reduced basis",
    "Accuracy",
    "Training",
    "Transient",
    "TPWL",
    "Results",
];
const CONTROLS: [Role; 7] =
    [Role::Button, Role::Slider, Role::SpinButton, Role::CheckBox, Role::RadioButton, Role::ComboBox, Role::TextInput];
/// Rows whose middles lie closer than this are one row to the eye.
const ROW: f32 = 8.0;

fn open() -> Window {
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, 1400.0]);
    wait(&mut harness, "the picture", |app| app.central_film().is_some());
    harness
}

/// Controls without a name, or without the value that their kind has.
fn nameless(harness: &Window) -> Vec<String> {
    let mut faults = Vec::new();
    for role in CONTROLS {
        for node in harness.query_all_by_role(role) {
            let told = node.accesskit_node();
            let name = told.label().unwrap_or_default();
            let value = match role {
                Role::Slider | Role::SpinButton => told.numeric_value().is_some() || told.value().is_some(),
                Role::ComboBox | Role::TextInput => told.value().is_some(),
                Role::CheckBox | Role::RadioButton => told.toggled().is_some(),
                _ => true,
            };
            if name.trim().is_empty() || !value {
                faults.push(format!("{role:?} “{name}” at {:?} ({:?})", node.rect(), told.value()));
            }
        }
    }
    faults
}

#[test]
fn every_control_of_every_tab_has_a_name_and_its_value() {
    let mut harness = open();
    let mut faults = Vec::new();
    for kind in ["Line contact", "Point contact"] {
        harness.query_all_by_label(kind).next().unwrap().click();
        harness.run_steps(3);
        for tab in TABS {
            click(&mut harness, tab);
            harness.run_steps(2);
            faults.extend(nameless(&harness).into_iter().map(|fault| format!("{kind}, {tab}: {fault}")));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Where the Tab key leads, once round.
fn round(harness: &mut Window) -> Vec<(String, Rect)> {
    let mut places: Vec<(String, Rect)> = Vec::new();
    for _ in 0..120 {
        press(harness, Modifiers::NONE, Key::Tab);
        let focused = CONTROLS.into_iter().flat_map(|role| harness.query_all_by_role(role));
        let Some(node) = focused.into_iter().find(|node| node.accesskit_node().is_focused()) else { continue };
        let place = (node.accesskit_node().label().unwrap_or_default(), node.rect());
        if places.first() == Some(&place) {
            break;
        }
        if places.last() != Some(&place) {
            places.push(place);
        }
    }
    places
}

#[test]
fn the_tab_key_follows_the_eye_down_the_panel_and_along_its_rows() {
    let mut harness = open();
    harness.run_steps(3);
    let places = round(&mut harness);
    let edge = 330.0;
    let panel: Vec<&(String, Rect)> =
        places.iter().filter(|(_, rect)| rect.right() < edge && rect.top() > 30.0 && rect.bottom() < 1370.0).collect();
    assert!(panel.len() > 15, "{panel:?}");
    for pair in panel.windows(2) {
        let ((before, a), (after, b)) = (pair[0], pair[1]);
        let down = b.center().y - a.center().y;
        let follows = down > ROW || down.abs() <= ROW && b.left() > a.left();
        assert!(follows, "{after} at {b:?} comes after {before} at {a:?}");
    }
}
