//! Controls stand still: nothing moves while a text is typed, Escape closes one thing at a time and leaves no choice
//! behind, and tooltips are small and beside their control.

use crate::common::scratch::Scratch;
use crate::driver::{CONTROLS, TABS, Window, click, press, shows, wait, window, write};
use egui::accesskit::Role;
use egui::{Id, Key, Modifiers, Order, Pos2, Rect, Theme};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;

const ESCAPE: (Modifiers, Key) = (Modifiers::NONE, Key::Escape);
/// Largest tooltip \[points\].
const LARGEST: [f32; 2] = [330.0, 170.0];
/// Largest distance between a control and its tooltip \[points\].
const FARTHEST: f32 = 10.0;
/// Part of a control that a tooltip may cover \[points\].
const OVERLAP: f32 = 1.0;

fn open(size: [f32; 2]) -> Window {
    let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), size);
    wait(&mut harness, "the first picture", |app| app.central_film().is_some() && !app.busy());
    harness
}

/// Returns the places of buttons.
fn places(harness: &Window, names: &[&str]) -> Vec<Rect> {
    names.iter().map(|name| harness.get_by_role_and_label(Role::Button, name).rect()).collect()
}

/// Types texts into a field one after another. The buttons stay where they are, also while `said` is on the screen.
fn types(harness: &mut Window, field: &str, texts: &[(&str, &str)], buttons: &[&str]) {
    let before = places(harness, buttons);
    for (text, said) in texts {
        harness.get_by_label(field).focus();
        harness.run_steps(2);
        harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
        harness.get_by_label(field).type_text(text);
        harness.run_steps(3);
        assert!(shows(harness, said), "{said}");
        assert_eq!(places(harness, buttons), before, "{field}: {text}");
    }
}

#[test]
fn buttons_stay_while_a_path_is_typed() {
    for size in [[1024.0, 640.0], [1280.0, 800.0]] {
        let mut harness = open(size);
        click(&mut harness, "File");
        click(&mut harness, "Load cases…");
        click(&mut harness, "Open CSV…");
        let buttons = ["Read", "Browse…", "Cancel"];
        let before = places(&harness, &buttons);
        for path in ["", "no such table.csv", &"folder/".repeat(40)] {
            write(&mut harness, "Path of the file", path);
            assert_eq!(places(&harness, &buttons), before, "{path} typed");
            click(&mut harness, "Read");
            let said = if path.is_empty() { "path is needed" } else { "No such file" };
            assert!(shows(&harness, said), "{said}");
            assert_eq!(places(&harness, &buttons), before, "{path} refused");
        }
        press(&mut harness, ESCAPE.0, ESCAPE.1);
        press(&mut harness, ESCAPE.0, ESCAPE.1);
        assert!(harness.query_by_label("Read").is_none());
    }
}

#[test]
fn a_file_that_exists_is_replaced_by_the_same_button() {
    let folder = Scratch::new("replaced");
    let path = folder.write("scene.ron", "before");
    let mut harness = open([1280.0, 800.0]);
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    let before = places(&harness, &["Save", "Cancel"]);
    write(&mut harness, "Path of the file", &path.display().to_string());
    click(&mut harness, "Save");
    assert_eq!(places(&harness, &["Replace the file", "Cancel"]), before);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "before");
    click(&mut harness, "Replace the file");
    assert!(std::fs::read_to_string(&path).unwrap().contains("Scene("));
}

#[test]
fn buttons_stay_while_tables_and_links_are_typed() {
    for size in [[1024.0, 640.0], [1280.0, 800.0]] {
        let mut harness = open(size);
        click(&mut harness, "File");
        click(&mut harness, "Load cases…");
        let lines = format!("radius [mm]; speed; load\n{}", "12; 3 m/s; 300 km\n".repeat(30));
        let texts = [
            ("radius [mm]", "is empty"),
            ("radius [mm]; speed; load\n12; 3 m/s; 300 N/mm\n", "1 contacts can be solved"),
            (&lines, "30 lines are refused"),
            ("wheel\n1", "is unknown"),
        ];
        types(&mut harness, "Table of load cases", &texts, &["Solve all", "Open as a scene", "Clear"]);
        press(&mut harness, ESCAPE.0, ESCAPE.1);
        press(&mut harness, ESCAPE.0, ESCAPE.1);
        click(&mut harness, "File");
        click(&mut harness, "Measured data…");
        let lines = format!("speed [m/s]; film [nm]\n{}", "1; 200\n".repeat(30));
        let texts = [
            ("speed", "are needed"),
            ("speed [m/s]; film [nm]\n1; 200\n", "1 lines"),
            (&lines, "30 lines"),
            ("speed [m/s]; film [nm]\n1;", "is missing"),
        ];
        types(&mut harness, "Measured table", &texts, &["Start the fit", "Open CSV…", "Remove"]);
        press(&mut harness, ESCAPE.0, ESCAPE.1);
        press(&mut harness, ESCAPE.0, ESCAPE.1);
        click(&mut harness, "File");
        click(&mut harness, "Open link…");
        let before = places(&harness, &["Open", "Cancel"]);
        write(&mut harness, "An address with #, or its part from # on", "https://here");
        click(&mut harness, "Open");
        assert_eq!(places(&harness, &["Open", "Cancel"]), before);
    }
}

/// Clicks a place of the screen.
fn click_at(harness: &mut Window, place: Pos2) {
    harness.hover_at(place);
    harness.step();
    harness.drag_at(place);
    harness.step();
    harness.drop_at(place);
    harness.run_steps(3);
}

#[test]
fn a_click_after_escape_chooses_nothing() {
    let mut harness = open([1280.0, 800.0]);
    let viscosity = harness.state().lubricant().viscosity;
    harness.get_by_role_and_label(Role::ComboBox, "Fluid").click();
    harness.run_steps(3);
    let place = harness.get_by_label("Barus oil").rect().center();
    harness.hover_at(place);
    harness.run_steps(2);
    press(&mut harness, ESCAPE.0, ESCAPE.1);
    assert!(harness.query_by_label("Barus oil").is_none());
    click_at(&mut harness, place);
    assert_eq!(harness.state().lubricant().viscosity, viscosity);
    // What lies below the list may have opened another one.
    press(&mut harness, ESCAPE.0, ESCAPE.1);
    // Also if the button goes down on the option and up after Escape.
    harness.get_by_role_and_label(Role::ComboBox, "Fluid").click();
    harness.run_steps(3);
    harness.drag_at(place);
    harness.step();
    press(&mut harness, ESCAPE.0, ESCAPE.1);
    harness.drop_at(place);
    harness.run_steps(3);
    assert!(harness.query_by_label("Barus oil").is_none());
    assert_eq!(harness.state().lubricant().viscosity, viscosity);
    // What lies below the list may have opened another one.
    press(&mut harness, ESCAPE.0, ESCAPE.1);
    // Without Escape the same click chooses.
    harness.get_by_role_and_label(Role::ComboBox, "Fluid").click();
    harness.run_steps(3);
    click_at(&mut harness, place);
    assert_ne!(harness.state().lubricant().viscosity, viscosity);
    for (escape, wanted) in [(true, Theme::Dark), (false, Theme::Light)] {
        harness.ctx.set_theme(Theme::Dark);
        harness.run_steps(2);
        click(&mut harness, "View");
        let place = harness.get_by_label("Light theme").rect().center();
        harness.hover_at(place);
        harness.run_steps(2);
        if escape {
            press(&mut harness, ESCAPE.0, ESCAPE.1);
        }
        click_at(&mut harness, place);
        assert_eq!(harness.ctx.theme(), wanted);
        assert!(harness.query_by_label("Light theme").is_none());
    }
}

#[test]
fn escape_closes_lists_then_windows_then_panels() {
    let mut harness = open([1280.0, 800.0]);
    let panel = "Each lesson starts from its own contact";
    click(&mut harness, "Help");
    click(&mut harness, "Lessons");
    assert!(shows(&harness, panel));
    for (item, menu, window) in
        [("Measured data…", "File", "Measured table"), ("From a cam…", "Edit", "Position along the path")]
    {
        click(&mut harness, menu);
        click(&mut harness, item);
        assert!(shows(&harness, window), "{window}");
        harness.get_by_role_and_label(Role::ComboBox, "Fluid").click();
        harness.run_steps(3);
        press(&mut harness, ESCAPE.0, ESCAPE.1);
        assert!(harness.query_by_label("Barus oil").is_none() && shows(&harness, window), "the list first");
        click(&mut harness, "View");
        press(&mut harness, ESCAPE.0, ESCAPE.1);
        assert!(harness.query_by_label("Light theme").is_none() && shows(&harness, window), "the menu first");
        press(&mut harness, ESCAPE.0, ESCAPE.1);
        assert!(!shows(&harness, window) && shows(&harness, panel), "the window before the panel");
    }
    press(&mut harness, ESCAPE.0, ESCAPE.1);
    assert!(!shows(&harness, panel));
}

/// Returns the places of the tooltips on the screen.
fn tooltips(harness: &Window) -> Vec<Rect> {
    harness.ctx.memory(|memory| {
        let layers = memory.areas().visible_layer_ids();
        let ids: Vec<Id> =
            layers.into_iter().filter(|layer| layer.order == Order::Tooltip).map(|layer| layer.id).collect();
        ids.into_iter().filter_map(|id| memory.area_rect(id)).collect()
    })
}

/// Returns the part of the control under the pointer that is not hidden by the edge of a scroll area.
fn visible_part(harness: &Window, control: Rect) -> Rect {
    let hovered: Vec<Id> = harness.ctx.interaction_snapshot(|snapshot| snapshot.hovered.iter().copied().collect());
    let responses = hovered.into_iter().filter_map(|id| harness.ctx.read_response(id));
    let part = responses.map(|response| response.interact_rect).find(|part| control.expand(1.0).contains_rect(*part));
    part.unwrap_or(control)
}

#[test]
fn tooltips_are_small_and_beside_their_control() {
    for size in [[1024.0, 640.0], [1280.0, 800.0]] {
        let mut harness = open(size);
        let screen = Rect::from_min_size(Pos2::ZERO, size.into());
        let (mut wrong, mut seen) = (Vec::new(), 0);
        let mut known: Vec<(String, Rect)> = Vec::new();
        for tab in TABS {
            click(&mut harness, tab);
            wait(&mut harness, "rest", |app| !(app.busy() || app.marching()));
            let mut controls: Vec<(String, Rect)> = Vec::new();
            for role in CONTROLS {
                for node in harness.query_all_by_role(role) {
                    let name = node.accesskit_node().label().unwrap_or_default();
                    // Controls of the panels are looked at once.
                    let control = (name, node.rect());
                    if !known.contains(&control) {
                        known.push(control.clone());
                        controls.push(control);
                    }
                }
            }
            for (name, place) in controls.into_iter().filter(|(_, place)| screen.contains_rect(*place)) {
                harness.hover_at(place.center());
                harness.run_steps(5);
                for tip in tooltips(&harness) {
                    seen += 1;
                    let place = visible_part(&harness, place);
                    let apart = [
                        tip.top() - place.bottom(),
                        place.top() - tip.bottom(),
                        tip.left() - place.right(),
                        place.left() - tip.right(),
                    ];
                    let apart = apart.into_iter().fold(f32::NEG_INFINITY, f32::max);
                    let small = tip.width() <= LARGEST[0] && tip.height() <= LARGEST[1];
                    if !small || !(-OVERLAP..=FARTHEST).contains(&apart) || !screen.expand(1.0).contains_rect(tip) {
                        wrong.push(format!("{tab}, {name} at {place:?}: {tip:?}, {apart} apart"));
                    }
                }
            }
            harness.hover_at(Pos2::new(1.0, size[1] - 1.0));
            harness.run_steps(2);
        }
        assert!(wrong.is_empty() && seen > 60, "{seen} seen at {size:?}\n{}", wrong.join("\n"));
    }
}
