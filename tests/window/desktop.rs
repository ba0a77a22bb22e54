//! Desktop features: all commands through the command palette, and a picture for a lecture.

use crate::common::scratch::Scratch;
use crate::driver::{Window, click, press, set, shows, undo, wait};
use egui::accesskit::Role;
use egui::{Key, Modifiers, ViewportCommand};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use std::path::Path;

fn open() -> Window {
    let mut harness = crate::driver::window(Explorer::new(None).without_system_dialogs(), [1280.0, 800.0]);
    settled(&mut harness);
    harness
}

fn settled(harness: &mut Window) {
    wait(harness, "the picture", |app| app.central_film().is_some() && !app.busy());
}

/// Opens the palette and types.
fn ask(harness: &mut Window, query: &str) {
    press(harness, Modifiers::COMMAND, Key::P);
    harness.get_by_role_and_label(Role::TextInput, "Find a command").type_text(query);
    harness.run_steps(3);
}

fn enter(harness: &mut Window) {
    press(harness, Modifiers::NONE, Key::Enter);
}

fn palette_is_open(harness: &Window) -> bool {
    harness.query_by_role_and_label(Role::TextInput, "Find a command").is_some()
}

/// Returns the selected line of the palette.
fn chosen(harness: &Window) -> String {
    let lines = harness.query_all_by_role(Role::ListBoxOption);
    let chosen = lines.filter(|line| line.accesskit_node().is_selected() == Some(true));
    chosen.map(|line| line.accesskit_node().label().unwrap_or_default()).collect()
}

#[test]
fn what_is_typed_is_found_and_done() {
    let mut harness = open();
    ask(&mut harness, "regim");
    assert_eq!(chosen(&harness), "Go to Regimes");
    enter(&mut harness);
    assert!(!palette_is_open(&harness));
    assert!(harness.query_by_label("Chart of M and L").is_some(), "the tab is in front");
    ask(&mut harness, "theme light");
    enter(&mut harness);
    assert_eq!(harness.ctx.theme(), egui::Theme::Light);
    let load = harness.state().load();
    set(&mut harness, Role::Slider, "Load number M", 80.0);
    ask(&mut harness, "undo");
    enter(&mut harness);
    assert!((harness.state().load() / load - 1.0).abs() < 1e-12);
    let before = harness.state().moes();
    ask(&mut harness, "point cont");
    enter(&mut harness);
    let after = harness.state().moes();
    assert!(harness.state().is_point() && (after.m / before.m - 1.0).abs() < 1e-9);
    ask(&mut harness, "line");
    enter(&mut harness);
    ask(&mut harness, "squalane with pip");
    enter(&mut harness);
    assert_eq!((harness.state().sliding().1, harness.state().point().viscosity_pa_s), (0.2227, 0.0705));
    ask(&mut harness, "run transient");
    assert_eq!(chosen(&harness), "Run transient");
    enter(&mut harness);
    assert!(palette_is_open(&harness), "what cannot be done is not done");
    assert!(shows(&harness, "Run transient"));
}

#[test]
fn a_short_list_of_matches_does_not_keep_a_longer_one_short() {
    let mut harness = open();
    ask(&mut harness, "regim");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    harness.run_steps(3);
    press(&mut harness, Modifiers::COMMAND, Key::P);
    harness.run_steps(3);
    // A press on a line that is cut off would be outside the palette.
    harness.get_by_role_and_label(Role::ListBoxOption, "Go to Transient").click();
    harness.run_steps(3);
    assert!(!palette_is_open(&harness) && shows(&harness, "Run transient"));
}

#[test]
fn palette_handles_arrows_escape_and_keys() {
    let mut harness = open();
    harness.get_by_role_and_label(Role::TextInput, "Radius R").focus();
    harness.run_steps(2);
    press(&mut harness, Modifiers::COMMAND, Key::P);
    assert_eq!(chosen(&harness), "Go to Profiles");
    press(&mut harness, Modifiers::NONE, Key::ArrowDown);
    press(&mut harness, Modifiers::NONE, Key::ArrowDown);
    assert_eq!(chosen(&harness), "Go to Regimes");
    for _ in 0..3 {
        press(&mut harness, Modifiers::NONE, Key::ArrowUp);
    }
    // Around the upper end to commands that are disabled.
    let last = harness.get_all_by_role(Role::ListBoxOption).last().unwrap().accesskit_node();
    assert_eq!(Some(chosen(&harness)), last.label());
    assert!(last.is_disabled() && last.description().is_some_and(|why| !why.is_empty()));
    press(&mut harness, Modifiers::COMMAND, Key::D);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(!palette_is_open(&harness));
    assert!(harness.query_by_label("Remove pin 1").is_none(), "Ctrl+D has not reached what lies below");
    harness.run_steps(4);
    let field = harness.get_by_role_and_label(Role::TextInput, "Radius R");
    assert!(field.accesskit_node().is_focused(), "the focus is where it was");
    assert_eq!(field.value().as_deref(), Some("3.000"));
    // The button at the right end of the menus opens it as well, and a second Ctrl+P closes it.
    click(&mut harness, "Command palette");
    assert!(palette_is_open(&harness));
    press(&mut harness, Modifiers::COMMAND, Key::P);
    assert!(!palette_is_open(&harness));
    crate::driver::write(&mut harness, "Radius R", "4");
    ask(&mut harness, "nothing at all");
    assert!(shows(&harness, "No command has this name") && chosen(&harness).is_empty());
}

#[test]
fn palette_opens_recent_scenes_and_asks_first() {
    let folder = Scratch::new("palette");
    let path = folder.join("bearing_47.ron");
    let text = "Scene(version: 1, title: \"t\", at: Moes(m: 17.0, l: 7.0), study: Point(methods: [Full]))";
    std::fs::write(&path, text).unwrap();
    let mut harness = open();
    harness.state_mut().open_scene(&path).unwrap();
    settled(&mut harness);
    set(&mut harness, Role::Slider, "Load number M", 80.0);
    ask(&mut harness, "47");
    harness.get_by_role_and_label(Role::ListBoxOption, "Open bearing_47.ron").click();
    harness.run_steps(4);
    assert!(!palette_is_open(&harness) && shows(&harness, "Save the changes?"));
    click(&mut harness, "Discard changes");
    assert!((harness.state().moes().m / 17.0 - 1.0).abs() < 1e-9);
}

fn full_screen(harness: &Window) -> Option<bool> {
    let commands = harness.output().viewport_output.values().flat_map(|viewport| &viewport.commands);
    commands
        .filter_map(|command| if let ViewportCommand::Fullscreen(on) = command { Some(*on) } else { None })
        .next_back()
}

#[test]
fn presentation_shows_plots_and_ends_with_escape() {
    let mut harness = open();
    let before = harness.ctx.zoom_factor();
    harness.key_down(Key::F11);
    harness.step();
    assert_eq!(full_screen(&harness), Some(true));
    harness.run_steps(4);
    assert!(harness.ctx.zoom_factor() > 1.2 * before, "{}", harness.ctx.zoom_factor());
    for gone in
        ["File", "Radius R", "Slide-to-roll ratio SRR", "Newtonian plateau ratio NPR", "Export from Profiles", "Ready"]
    {
        assert!(harness.query_by_label(gone).is_none(), "{gone}");
    }
    for there in ["Pressure profile", "Film profile", "Regimes"] {
        assert!(harness.query_by_label(there).is_some(), "{there}");
    }
    set(&mut harness, Role::Slider, "Load number M", 80.0);
    assert!((harness.state().moes().m / 80.0 - 1.0).abs() < 1e-6);
    crate::driver::write(&mut harness, "L value", "-3");
    press(&mut harness, Modifiers::NONE, Key::Enter);
    assert!(shows(&harness, "L is -3"), "a refused entry says why");
    // The palette is available there too, and has its own Escape.
    ask(&mut harness, "squalane");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(harness.query_by_label("File").is_none());
    ask(&mut harness, "squalane");
    enter(&mut harness);
    for there in ["Load number M", "Lubricant number L", "Slide-to-roll ratio SRR", "Newtonian plateau ratio NPR"] {
        assert!(harness.query_by_label(there).is_some(), "{there}");
    }
    harness.run_steps(4);
    harness.key_down(Key::Escape);
    harness.step();
    assert_eq!(full_screen(&harness), Some(false));
    harness.run_steps(4);
    assert!(harness.query_by_label("File").is_some());
    assert!((harness.ctx.zoom_factor() - before).abs() < 1e-6);
    harness.key_press(Key::F11);
    harness.run_steps(4);
    click(&mut harness, "End the presentation");
    assert!(harness.query_by_label("File").is_some() && (harness.ctx.zoom_factor() - before).abs() < 1e-6);
}

#[test]
fn either_of_two_contacts_in_a_presentation_is_moved() {
    let mut harness = open();
    let first = harness.state().moes().m;
    press(&mut harness, Modifiers::NONE, Key::F11);
    let swap = |harness: &Window| !harness.get_by_label("Swap").accesskit_node().is_disabled();
    assert!(!swap(&harness), "nothing is pinned");
    click(&mut harness, "Pin");
    set(&mut harness, Role::Slider, "Load number M", 80.0);
    settled(&mut harness);
    let film = harness.state().central_film().unwrap();
    assert!(swap(&harness));
    click(&mut harness, "Swap");
    settled(&mut harness);
    assert!((harness.state().moes().m / first - 1.0).abs() < 1e-9);
    set(&mut harness, Role::Slider, "Load number M", 30.0);
    settled(&mut harness);
    click(&mut harness, "Swap");
    settled(&mut harness);
    assert!((harness.state().moes().m / 80.0 - 1.0).abs() < 1e-6);
    assert!((harness.state().central_film().unwrap() / film - 1.0).abs() < 1e-6, "the contact that was pinned");
    undo(&mut harness);
    assert!((harness.state().moes().m / 30.0 - 1.0).abs() < 1e-6);
}

#[test]
fn a_presentation_keeps_maps_and_series_usable() {
    let mut explorer = Explorer::with_embedded_models().without_system_dialogs();
    explorer.open_scene(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/shear/fig_3_14_point.ron")).unwrap();
    let mut harness = crate::driver::window(explorer, [760.0, 475.0]);
    settled(&mut harness);
    press(&mut harness, Modifiers::NONE, Key::F11);
    click(&mut harness, "Contact map");
    let map = harness.get_by_label("Map of the contact").rect();
    assert!(map.width() > 400.0 && map.height() > 250.0, "{map:?}");
    assert!(
        harness.query_by_label("Interferogram").is_some()
            && harness.query_by_label("Export from Contact map").is_none()
    );
    for name in ["Load number M", "Newtonian plateau ratio NPR", "NPR value", "End the presentation"] {
        let place = harness.get_by_label(name).rect();
        assert!(place.left() >= 0.0 && place.right() <= 760.0 && place.bottom() <= 475.0, "{name}: {place:?}");
    }
}

#[test]
fn escape_closes_menus_and_lists_first() {
    let mut harness = open();
    press(&mut harness, Modifiers::NONE, Key::F11);
    assert!(harness.query_by_label("End the presentation").is_some());
    click(&mut harness, "Sliders");
    assert!(harness.query_by_label("Usual sliders").is_some());
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(harness.query_by_label("Usual sliders").is_none());
    assert!(harness.query_by_label("End the presentation").is_some(), "the presentation goes on");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(harness.query_by_label("End the presentation").is_none());
    // A list closes without a choice, and the settings below it stay open.
    harness.get_by_role_and_label(Role::ComboBox, "When M moves").click();
    harness.run_steps(3);
    assert!(harness.query_by_label("radius R").is_some());
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(harness.query_by_label("radius R").is_none());
    click(&mut harness, "View");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(harness.query_by_label("Light theme").is_none());
}
