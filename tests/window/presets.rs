//! Layouts on small and large screens in both themes: nothing overlaps, nothing is cut off. Also the lecture mode.

use crate::driver::{Window, click, press, set, shows, wait, wait_until, window};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect, Theme};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use std::time::Duration;

const CONTROLS: [Role; 7] =
    [Role::Button, Role::Slider, Role::CheckBox, Role::ComboBox, Role::TextInput, Role::SpinButton, Role::Label];
/// A label of several lines begins where the control before it ends, and its rectangle covers that one.
const LINE: f32 = 26.0;
/// Permitted overlap of rectangles.
const TOUCH: f32 = 1.5;

/// Returns the contents of a part of the window, by role and name.
fn inside(harness: &Window, area: Rect) -> Vec<(Role, String, Rect)> {
    let nodes = CONTROLS.into_iter().flat_map(|role| harness.query_all_by_role(role).map(move |node| (role, node)));
    let named = nodes.map(|(role, node)| {
        let told = node.accesskit_node();
        (role, told.label().or(told.value()).unwrap_or_default(), node.rect())
    });
    named.filter(|(_, _, rect)| rect.width() > 1.0 && rect.height() > 1.0 && area.contains_rect(*rect)).collect()
}

/// Returns controls and labels that cover each other.
fn overlaps(harness: &Window, area: Rect) -> Vec<String> {
    let all = inside(harness, area);
    let wrapped = |(role, _, rect): &(Role, String, Rect)| *role == Role::Label && rect.height() > LINE;
    let mut found = Vec::new();
    for (k, a) in all.iter().enumerate() {
        for b in &all[k + 1..] {
            let common = a.2.intersect(b.2);
            let apart = common.width() < TOUCH || common.height() < TOUCH;
            // A combo box contains its text, a button its label.
            let holds = a.2.expand(TOUCH).contains_rect(b.2) || b.2.expand(TOUCH).contains_rect(a.2);
            if !apart && !holds && !wrapped(a) && !wrapped(b) {
                found.push(format!("{a:?} and {b:?}"));
            }
        }
    }
    found
}

/// Returns true if a switch is on.
fn pressed(harness: &Window, name: &str) -> bool {
    harness.get_by_label(name).accesskit_node().toggled() == Some(egui::accesskit::Toggled::True)
}

/// Returns true if the axes of the profiles are fixed.
fn locked(harness: &Window) -> bool {
    pressed(harness, "Lock the axes of Profiles")
}

/// Each layout with its visible contents on small screens, and its additional contents on wide ones.
const LAYOUTS: [(&str, &[&str], &[&str]); 4] = [
    ("Layout: Explore", &["Pressure profile", "Film profile"], &["Chart of M and L"]),
    ("Layout: Teach", &["Pressure profile", "Film profile", "Chart of M and L"], &["Traction along the quantity"]),
    ("Layout: Engineer", &["Pressure profile", "Traction along the quantity"], &["Run the study"]),
    ("Layout: Model reduction", &["Loss of information and tolerances"], &["Pressure profile"]),
];

fn preset(harness: &mut Window, size: [f32; 2], layout: &str, seen: &[&str], beside: &[&str]) {
    click(harness, "View");
    click(harness, layout);
    harness.run_steps(4);
    let [width, height] = size;
    let wide = width > 2000.0;
    for name in seen.iter().chain(beside.iter().filter(|_| wide)) {
        wait_until(Duration::from_secs(120), harness, name, |window| window.query_by_label(name).is_some());
        let place = harness.get_by_label(name).rect();
        let on_screen = Rect::from_min_max([0.0, 0.0].into(), [width, height].into()).contains_rect(place);
        assert!(on_screen, "{layout} at {size:?}: {name} at {place:?}");
        let is_plot = *name != "Run the study";
        assert!(!is_plot || place.width() > 120.0 && place.height() > 60.0, "{layout} at {size:?}: {name} {place:?}");
    }
    // Panels scroll: contents above and below the visible part are excluded.
    for name in seen.iter().filter_map(|plot| plot.split_once(" profile")).map(|_| "Lock the axes of Profiles") {
        let place = harness.get_by_label(name).rect();
        assert!(
            place.left() > 330.0 && place.right() < width && place.bottom() < 64.0,
            "{layout} at {size:?}: {place:?}"
        );
    }
    let area = Rect::from_min_max([330.0, 56.0].into(), [width, height - 56.0].into());
    let found = overlaps(harness, area);
    assert!(found.is_empty(), "{layout} at {size:?}:\n{}", found.join("\n"));
    let top = Rect::from_min_max([0.0, 0.0].into(), [width, 27.0].into());
    assert!(overlaps(harness, top).is_empty(), "{layout} at {size:?}: {:?}", overlaps(harness, top));
    let bottom = Rect::from_min_max([330.0, height - 29.5].into(), [width, height].into());
    assert!(overlaps(harness, bottom).is_empty(), "{layout} at {size:?}: {:?}", overlaps(harness, bottom));
}

#[test]
fn presets_fit_small_and_large_screens() {
    for size in [[1024.0, 640.0], [2560.0, 1440.0]] {
        let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), size);
        for kind in ["Roller", "Ball", "Ellipse"] {
            harness.query_all_by_label(kind).next().unwrap().click();
            wait(&mut harness, "the picture", |app| !app.busy() && app.central_film().is_some());
            for (layout, seen, beside) in LAYOUTS {
                for theme in ["Light theme", "Dark theme"] {
                    click(&mut harness, "View");
                    click(&mut harness, theme);
                    preset(&mut harness, size, layout, seen, beside);
                }
            }
        }
    }
}

#[test]
fn lesson_below_adjacent_tabs_keeps_their_width() {
    let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), [1280.0, 800.0]);
    click(&mut harness, "View");
    click(&mut harness, "Layout: Teach");
    let before = harness.get_by_label("Chart of M and L").rect();
    click(&mut harness, "Help");
    click(&mut harness, "Lessons");
    harness.run_steps(3);
    let card = harness
        .query_all_by_role(Role::Button)
        .find(|node| node.accesskit_node().label().is_some_and(|label| label.starts_with("3. ")));
    card.unwrap().click();
    harness.run_steps(3);
    assert!(shows(&harness, "Step 1 of"));
    let after = harness.get_by_label("Chart of M and L").rect();
    assert!((after.width() - before.width()).abs() < 1.0 && after.height() > 150.0, "{before:?} {after:?}");
    for name in ["All lessons", "Next", "Close the lessons"] {
        let place = harness.get_by_label(name).rect();
        assert!(place.bottom() <= 800.0 && place.right() <= 1280.0, "{name}: {place:?}");
    }
}

#[test]
fn lesson_in_a_presentation_locks_the_axes() {
    let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), [1280.0, 800.0]);
    click(&mut harness, "Help");
    click(&mut harness, "Lessons");
    assert!(!locked(&harness), "in a window they follow the contact");
    press(&mut harness, Modifiers::NONE, Key::F11);
    assert!(locked(&harness));
    press(&mut harness, Modifiers::NONE, Key::F11);
    assert!(!locked(&harness));
    // One tab alone, without a lesson, is no lecture.
    click(&mut harness, "Close the lessons");
    press(&mut harness, Modifiers::NONE, Key::F11);
    assert!(!locked(&harness));
}

#[test]
fn an_engineer_has_axes_with_units() {
    let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), [1280.0, 800.0]);
    click(&mut harness, "View");
    click(&mut harness, "Layout: Engineer");
    let switches = harness.query_all_by_label("Units").map(|node| node.accesskit_node().toggled());
    let on: Vec<_> = switches.collect();
    assert!(on.contains(&Some(egui::accesskit::Toggled::True)), "{on:?}");
}

#[test]
fn presentation_names_regimes_and_shows_all_controls() {
    for size in [[1024.0, 768.0], [1920.0, 1080.0]] {
        let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), size);
        click(&mut harness, "View");
        click(&mut harness, "Dark theme");
        click(&mut harness, "View");
        click(&mut harness, "Layout: Teach");
        press(&mut harness, Modifiers::NONE, Key::F11);
        harness.run_steps(4);
        assert_eq!(harness.ctx.theme(), Theme::Light, "a projector shows no black");
        set(&mut harness, Role::Slider, "Lubricant number L", 5.0);
        let mut chart = None;
        let mut regimes = Vec::new();
        assert!(locked(&harness) && pressed(&harness, "Lock axes"), "in a lecture axes stand still unasked");
        for m in [2.0, 5.0, 20.0, 100.0, 500.0] {
            set(&mut harness, Role::Slider, "Load number M", m);
            wait(&mut harness, "the picture", |app| !app.busy() && app.central_film().is_some());
            let zoom = harness.ctx.zoom_factor();
            let screen = Rect::from_min_max([0.0, 0.0].into(), [size[0] / zoom, size[1] / zoom].into());
            let place = harness.get_by_label("Chart of M and L").rect();
            let first = *chart.get_or_insert(place);
            let moved = (place.min - first.min).length().max((place.max - first.max).length());
            assert!(moved < 0.1, "the axes stand still: {first} and {place}");
            let switches = ["Lock axes", "Lock the axes of Profiles"];
            let needed = ["Pressure profile", "Film profile", "Load number M", "Pin", "Undo", "End the presentation"];
            for name in needed.into_iter().chain(switches) {
                let place = harness.get_by_label(name).rect();
                assert!(screen.contains_rect(place), "{name} at {place:?} of {screen:?}, M = {m}");
            }
            for name in ["Roller", "Ball", "Ellipse"] {
                assert!(harness.query_all_by_label(name).next().is_some(), "{name}");
            }
            // Tabs without room scroll behind the controls at their end.
            let below_tabs = screen.with_min_y(44.0);
            assert!(overlaps(&harness, below_tabs).is_empty(), "{:?}", overlaps(&harness, below_tabs));
            let named = harness
                .query_all_by_label_contains("piezoviscous")
                .chain(harness.query_all_by_label_contains("isoviscous"));
            let large = named.filter(|node| node.rect().height() * zoom > 0.03 * size[1]);
            let large: Vec<String> = large.filter_map(|node| node.accesskit_node().value()).collect();
            assert!(!large.is_empty(), "the regime is named in large words at M = {m}");
            regimes.push(large[0].clone());
        }
        click(&mut harness, "Lock axes");
        assert!(!locked(&harness), "unless that is not wanted");
        click(&mut harness, "Lock axes");
        regimes.dedup();
        assert!(regimes.len() > 1, "{regimes:?}");
        press(&mut harness, Modifiers::NONE, Key::Escape);
        harness.run_steps(3);
        assert_eq!(harness.ctx.theme(), Theme::Dark, "the theme is as it was");
        assert!(!locked(&harness), "and the axes follow the contact again");
    }
}

#[test]
fn sliders_of_a_presentation_are_chosen() {
    let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), [1280.0, 800.0]);
    wait(&mut harness, "the picture", |app| !app.busy() && app.central_film().is_some());
    let film = harness.state().central_film().unwrap();
    press(&mut harness, Modifiers::NONE, Key::F11);
    assert!(harness.query_by_label("Slider of the speed").is_none());
    click(&mut harness, "Sliders");
    for name in ["Entrainment speed u_m [m/s]", "Load w [N/m or N]"] {
        click(&mut harness, name);
    }
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(harness.query_by_role_and_label(Role::Slider, "Load number M").is_none(), "only what was chosen");
    crate::driver::set(&mut harness, Role::Slider, "Slider of the speed", 10.0);
    wait(&mut harness, "the faster contact", |app| app.central_film().is_some_and(|other| other > 1.5 * film));
    crate::driver::set(&mut harness, Role::Slider, "Slider of the load", 100.0);
    // The read-outs stay in view.
    let place = harness.query_all_by_label("µ").next().expect("read-outs").rect();
    assert!(place.bottom() <= 800.0, "{place:?}");
    click(&mut harness, "Sliders");
    click(&mut harness, "Usual sliders");
    assert!(harness.query_by_role_and_label(Role::Slider, "Load number M").is_some());
}
