//! No text is cut off: on every tab and in every lesson, in small, usual and large windows, in both themes.
//!
//! The shapes of a frame contain each text with its size and its clip rectangle. A text is cut off if it was shortened
//! with an ellipsis, or if a part of it lies outside its clip rectangle to the left or right. Above and below, texts of
//! a list that scrolls may be cut.

use crate::driver::{TABS, Window, click, press, set, wait, window, write};
use egui::accesskit::Role;
use egui::epaint::{ClippedShape, Shape, TextShape};
use egui::{Key, Modifiers, Rect};
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use std::collections::BTreeSet;

const SIZES: [[f32; 2]; 3] = [[1024.0, 640.0], [1280.0, 800.0], [1920.0, 1080.0]];
/// Width that may be cut off \[points\]: less than the margin around a letter.
const SLACK: f32 = 2.0;

/// Lower end of the strip of the tabs \[points\].
const STRIP_END: f32 = 64.0;

/// Calls a function with every text of a shape.
fn texts<'a>(shape: &'a Shape, visit: &mut impl FnMut(&'a TextShape)) {
    match shape {
        Shape::Text(text) => visit(text),
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| texts(shape, visit)),
        _ => {}
    }
}

/// Returns the texts of a frame that are cut off.
fn cut_off(shapes: &[ClippedShape], screen: Rect, fields: &[Rect]) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for ClippedShape { clip_rect, shape, .. } in shapes {
        texts(shape, &mut |text| {
            let (place, clip) = (text.visual_bounding_rect(), clip_rect.intersect(screen));
            let words = text.galley.text().trim();
            if words.is_empty() || text.override_text_color.is_some_and(|color| color.a() == 0) {
                return;
            }
            // The strip of the tabs scrolls to the tab in front, and a text field to its cursor.
            let in_strip = TABS.contains(&words) && place.top() < STRIP_END;
            if in_strip || fields.iter().any(|field| field.contains(place.intersect(clip).center())) {
                return;
            }
            // Text that is scrolled out of sight is not cut off.
            let visible = place.intersect(clip);
            if !visible.is_positive() || visible.height() < 0.5 * place.height().min(12.0) {
                return;
            }
            let outside = (clip.left() - place.left()).max(place.right() - clip.right());
            if text.galley.elided {
                found.insert(format!("shortened: “{words}” at {place:?}"));
            } else if outside > SLACK {
                found.insert(format!("{outside:.0} points of “{words}” at {place:?} in {clip:?}"));
            }
        });
    }
    found
}

/// Looks at the texts to the right of an abscissa.
fn look(harness: &mut Window, place: &str, from: f32, found: &mut Vec<String>) {
    harness.run_steps(3);
    let screen = harness.ctx.content_rect();
    let screen = Rect::from_min_max([from.max(screen.left()), screen.top()].into(), screen.max);
    let fields: Vec<Rect> = harness.query_all_by_role(Role::TextInput).map(|field| field.rect()).collect();
    let cut = cut_off(&harness.output().shapes, screen, &fields);
    found.extend(cut.into_iter().map(|text| format!("{place}: {text}")));
}

fn open(size: [f32; 2], theme: &str) -> Window {
    let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), size);
    harness.run_steps(3);
    click(&mut harness, "View");
    click(&mut harness, theme);
    harness.run_steps(2);
    harness
}

#[test]
fn a_text_that_is_cut_off_is_noticed() {
    let mut harness = egui_kittest::Harness::new_ui(|ui| {
        ui.set_clip_rect(Rect::from_min_size([0.0, 0.0].into(), [60.0, 200.0].into()));
        ui.add(egui::Label::new("a text that is wider than its clip rectangle").extend());
        ui.add(egui::Label::new("short"));
        ui.set_max_width(50.0);
        ui.add(egui::Label::new("a text that is shortened").truncate());
    });
    harness.run_steps(2);
    let found = cut_off(&harness.output().shapes, harness.ctx.content_rect(), &[]);
    assert_eq!(found.len(), 2, "{found:?}");
}

#[test]
fn no_text_of_a_tab_is_cut_off() {
    let mut found = Vec::new();
    for size in SIZES {
        for theme in ["Light theme", "Dark theme"] {
            let mut harness = open(size, theme);
            for tab in TABS {
                click(&mut harness, tab);
                look(&mut harness, &format!("{tab} at {size:?}, {theme}"), 0.0, &mut found);
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn no_text_of_a_lesson_is_cut_off() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lessons");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let mut found = Vec::new();
    for (size, theme) in SIZES.into_iter().zip(["Light theme", "Dark theme", "Light theme"]) {
        let mut harness = open(size, theme);
        // In a small window the panel takes the room of the read-outs beside it. There only its own texts count.
        let from = if size[0] < 1200.0 { 697.0 } else { 0.0 };
        click(&mut harness, "Help");
        click(&mut harness, "Lessons");
        look(&mut harness, &format!("list of lessons at {size:?}"), from, &mut found);
        for (k, file) in files.iter().enumerate() {
            let text = std::fs::read_to_string(file).unwrap();
            let title = text.lines().next().unwrap().trim_start_matches("# ");
            click(&mut harness, &format!("{}. {title}", k + 1));
            let steps = text.matches("\n## ").count();
            for step in 1..=steps {
                look(&mut harness, &format!("{title}, step {step} at {size:?}"), from, &mut found);
                click(&mut harness, if step == steps { "Finish" } else { "Next" });
            }
        }
        harness.key_press_modifiers(Modifiers::NONE, Key::Escape);
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Film ratio, friction force and power of a rough contact that slides, with a pinned curve to compare with.
#[test]
fn read_outs_of_rough_sliding_contacts_are_whole() {
    let mut found = Vec::new();
    for size in SIZES {
        let mut harness = open(size, "Light theme");
        // The panel may be scrolled out of sight.
        harness.get_by_label("Surfaces").click_accesskit();
        harness.run_steps(3);
        for (field, text) in [("Roughness of body 1", "0.2"), ("Roughness of body 2", "0.1")] {
            write(&mut harness, field, text);
            press(&mut harness, Modifiers::NONE, Key::Enter);
        }
        press(&mut harness, Modifiers::COMMAND, Key::D);
        set(&mut harness, Role::Slider, "Slide-to-roll ratio SRR", 0.2);
        set(&mut harness, Role::Slider, "Load number M", 80.0);
        wait(&mut harness, "the picture", |app| !app.busy() && app.traction().is_some_and(|traction| traction > 0.0));
        look(&mut harness, &format!("read-outs at {size:?}"), 0.0, &mut found);
        let screen = Rect::from_min_size([0.0, 0.0].into(), size.into());
        for part in ["λ", "lost", "at SRR"] {
            let places: Vec<Rect> = harness.query_all_by_label_contains(part).map(|node| node.rect()).collect();
            let below = places.iter().filter(|place| place.top() > 0.5 * size[1]);
            assert!(below.clone().any(|place| screen.contains_rect(*place)), "{part} at {size:?}: {places:?}");
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}
